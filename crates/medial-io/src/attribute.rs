//! Values of columns as JSON, the same way for every format that has columns.

use crate::Json;
use serde::Serialize;
use serde_json::value::to_raw_value;

/// A value as JSON; every value that is given here has such a form.
fn raw(value: &(impl Serialize + ?Sized)) -> Json {
    to_raw_value(value).unwrap_or_else(|_| null())
}

/// Nothing.
pub(crate) fn null() -> Json {
    serde_json::value::RawValue::NULL.to_owned()
}

/// Yes or no.
pub(crate) fn boolean(value: bool) -> Json {
    raw(&value)
}

/// A whole number.
pub(crate) fn integer(value: impl Into<i128>) -> Json {
    raw(&value.into())
}

/// A number, with a point or an exponent so that it stays one; what is not finite is nothing.
pub(crate) fn real(value: f64) -> Json {
    raw(&value)
}

/// The same for single precision, as the shortest text that gives it back.
pub(crate) fn single(value: f32) -> Json {
    raw(&value)
}

/// A text.
pub(crate) fn text(value: &str) -> Json {
    raw(value)
}

/// A text that is JSON itself, else as it is.
pub(crate) fn json(value: &str) -> Json {
    serde_json::value::RawValue::from_string(value.to_owned()).unwrap_or_else(|_| text(value))
}

/// Bytes, in base 64.
pub(crate) fn bytes(value: &[u8]) -> Json {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(value.len().div_ceil(3) * 4);
    for chunk in value.chunks(3) {
        let word = chunk.iter().fold(0_u32, |word, &byte| word << 8 | u32::from(byte));
        let word = word << (8 * (3 - chunk.len()));
        for k in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * k) & 63) as usize];
            out.push(if k <= chunk.len() { char::from(digit) } else { '=' });
        }
    }
    text(&out)
}

/// A day as `2026-11-29`, so many days after 1970-01-01.
pub(crate) fn date(days: i64) -> String {
    // The years of the civil calendar from March on, after Hinnant's `civil_from_days`.
    let days = i128::from(days) + 719_468;
    let era = days.div_euclid(146_097);
    let day_of_era = days.rem_euclid(146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = year_of_era + era * 400 + i128::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}")
}

/// A time of day as `13:30:00.25`, of so many units of which a second has `per_second`.
pub(crate) fn time(units: i64, per_second: i64) -> String {
    let (seconds, rest) = (units.div_euclid(per_second), units.rem_euclid(per_second));
    let mut out =
        format!("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds.rem_euclid(60));
    if rest > 0 {
        let digits = per_second.ilog10() as usize;
        let fraction = format!("{rest:0digits$}");
        out.push('.');
        out.push_str(fraction.trim_end_matches('0'));
    }
    out
}

/// A moment as `2026-11-29T13:30:00Z`, so many units after 1970.
pub(crate) fn moment(units: i64, per_second: i64, is_utc: bool) -> String {
    let day = 86_400 * per_second;
    let (days, rest) = (units.div_euclid(day), units.rem_euclid(day));
    format!("{}T{}{}", date(days), time(rest, per_second), if is_utc { "Z" } else { "" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_times_are_those_of_the_calendar() {
        assert_eq!(date(0), "1970-01-01");
        assert_eq!(date(-1), "1969-12-31");
        assert_eq!(date(11_016), "2000-02-29");
        assert_eq!(date(20_786), "2026-11-29");
        assert_eq!(moment(1_500, 1000, true), "1970-01-01T00:00:01.5Z");
        assert_eq!(moment(-1, 1_000_000, false), "1969-12-31T23:59:59.999999");
        assert_eq!(time(48_600, 1), "13:30:00");
        // Made-up numbers are no reason to stop.
        date(i64::MIN);
        moment(i64::MAX, 1_000_000_000, true);
    }

    #[test]
    fn values_have_their_types() {
        assert_eq!(real(4.0).get(), "4.0");
        assert_eq!(real(f64::NAN).get(), "null");
        assert_eq!(single(0.1).get(), "0.1");
        assert_eq!(integer(u64::MAX).get(), "18446744073709551615");
        assert_eq!(bytes(b"Man").get(), "\"TWFu\"");
        assert_eq!(bytes(b"Ma").get(), "\"TWE=\"");
        assert_eq!(bytes(b"M").get(), "\"TQ==\"");
        assert_eq!(json("[1, 2]").get(), "[1, 2]");
        assert_eq!(json("[1, ").get(), "\"[1, \"");
    }
}
