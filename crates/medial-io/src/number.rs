/// Hands on, in one piece or several, the shortest decimal that reads back to this double, a whole
/// number with `.0`, as in GeoJSON: `4.0`, `0.1`, `1e300`. It is what `{:?}` writes, sooner.
#[inline]
pub(crate) fn decimal(value: f64, mut put: impl FnMut(&str)) {
    let whole = value as u32;
    // Neither a fraction nor too large, and no negative zero.
    if f64::from(whole).to_bits() == value.to_bits() {
        put(itoa::Buffer::new().format(whole));
        put(".0");
        return;
    }
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format(value);
    let size = value.abs();
    if size >= 1e16 || text.len() > 16 && may_be_halfway(value) {
        put(&format!("{value:?}"));
    } else if size < 1e-4 && text.contains("0.0000") {
        // `{:?}` has an exponent from here on, the algorithm only below 1e-5.
        let (sign, digits) = text.split_once("0.0000").unwrap_or(("", text));
        let (first, more) = digits.split_at(1);
        let point = if more.is_empty() { "" } else { "." };
        [sign, first, point, more, "e-5"].into_iter().for_each(put);
    } else {
        put(text);
    }
}

/// Whether the double may lie half-way between two decimals that are as short, where `{:?}` takes
/// the greater one and the fast algorithm the even one.
///
/// With `q` binary places it has `q` decimal ones, and is a multiple of 5^q units of the last one.
/// A decimal has at most 17 digits, so the double has 18, and 5^26 has more.
fn may_be_halfway(value: f64) -> bool {
    let bits = value.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32;
    let places = 1075 - exponent - (bits | 1 << 52).trailing_zeros() as i32;
    (1..=25).contains(&places)
}

/// Appends the shortest decimal that reads back to this double, as in WKT and CSV: `4`, `0.1`,
/// `1e300`.
pub(crate) fn push_shortest(out: &mut String, value: f64) {
    decimal(value, |text| out.push_str(text));
    if out.ends_with(".0") {
        out.truncate(out.len() - 2);
    }
}

/// The shortest decimal that reads back to this double, as in WKT and CSV: `4`, `0.1`, `1e300`.
pub(crate) fn shortest(value: f64) -> String {
    let mut out = String::new();
    push_shortest(&mut out, value);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_read_back_exactly() {
        for value in [0.1, 4.0, -0.0, 1e300, 5e-324, 1830874.975, 1.0 / 3.0, f64::MAX] {
            assert_eq!(shortest(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
        assert_eq!(shortest(4.0), "4");
        assert_eq!(shortest(-0.0), "-0");
        assert_eq!(shortest(1e300), "1e300");
        assert_eq!(shortest(2e-5), "2e-5");
    }

    #[test]
    fn decimals_are_those_of_the_standard_library() {
        let same = |value: f64| {
            let mut written = String::new();
            decimal(value, |text| written.push_str(text));
            assert_eq!(written, format!("{value:?}"));
        };
        for exponent in -324..=308 {
            let power: f64 = format!("1e{exponent}").parse().unwrap();
            let near = [power, power.next_up(), power.next_down(), 2.5 * power, power / 3.0];
            near.into_iter().for_each(|value| {
                same(value);
                same(-value);
            });
        }
        for exponent in 0..2047_u64 {
            same(f64::from_bits(exponent << 52));
            same(f64::from_bits((exponent << 52) + 1));
        }
        // Every bit pattern is as likely: a sequence of full period modulo 2^64.
        let mut bits = 1_u64;
        for _ in 0..200_000 {
            bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            same(f64::from_bits(bits));
            // Few binary digits at any place: decimals of 18 digits are among them.
            let (digits, places) = (bits >> 7 & 63, bits >> 1 & 63);
            same((bits >> digits) as f64 / (1_u64 << places) as f64);
        }
        for whole in [1, 9, 10, u32::MAX - 1, u32::MAX] {
            [whole as f64, whole as f64 + 1.0, -(whole as f64)].into_iter().for_each(same);
        }
        // 2^-25 and 2^51 + 1/4 lie half-way between decimals of 17 digits.
        [2.0_f64.powi(-25), 2.0_f64.powi(51) + 0.25].into_iter().for_each(same);
        [0.0, -0.0, f64::NAN, f64::INFINITY, f64::MIN_POSITIVE, f64::MAX]
            .into_iter()
            .for_each(same);
    }
}
