//! Encodings of text in tables of dBase.

use encoding_rs::{UTF_8, WINDOWS_1252};
use oem_cp::code_table::DECODING_TABLE_CP_MAP;
use oem_cp::code_table_type::TableType;

/// How text is encoded.
pub(super) enum Encoding {
    Kept(&'static encoding_rs::Encoding),
    /// A code page of DOS.
    Dos(&'static TableType),
    /// It is not said: UTF-8 where it can be, else Windows-1252.
    Guessed,
}

impl Encoding {
    /// The encoding that a `.cpg` names, else that of the number in the header of a table, its language
    /// driver; with a warning for each that is not known.
    pub(super) fn of(name: Option<&str>, driver: u8, warnings: &mut Vec<String>) -> Self {
        let name = name.map(|name| name.trim_start_matches('\u{feff}').trim());
        let mut unknown = |what: String| {
            warnings.push(format!(
                "{what} is not known, and text may be garbled; name its encoding in the `.cpg`"
            ));
        };
        if let Some(name) = name.filter(|name| !name.is_empty()) {
            match named(name) {
                Some(found) => return found,
                None => unknown(format!("the text encoding `{name}` of the `.cpg`")),
            }
        }
        numbered(driver).unwrap_or_else(|| {
            if driver != 0 {
                unknown(format!("the text encoding of the `.dbf` (language driver {driver})"));
            }
            Self::Guessed
        })
    }

    /// A text.
    pub(super) fn decode(&self, bytes: &[u8]) -> String {
        match self {
            Self::Kept(encoding) => encoding.decode_without_bom_handling(bytes).0.into_owned(),
            Self::Dos(table) => table.decode_string_lossy(bytes),
            Self::Guessed => UTF_8
                .decode_without_bom_handling_and_without_replacement(bytes)
                .unwrap_or_else(|| WINDOWS_1252.decode_without_bom_handling(bytes).0)
                .into_owned(),
        }
    }
}

/// The encoding that a `.cpg` names.
fn named(name: &str) -> Option<Encoding> {
    let name = name.to_ascii_lowercase();
    if let Some(driver) = name.strip_prefix("ldid/") {
        return numbered(driver.parse().ok()?);
    }
    let labelled = |label: &str| encoding_rs::Encoding::for_label(label.as_bytes());
    if let Some(encoding) = labelled(&name) {
        return Some(Encoding::Kept(encoding));
    }
    // `CP1252`, `ANSI 1252`.
    let number = name.trim_start_matches(|c: char| !c.is_ascii_digit());
    if let Some(found) = number.parse().ok().and_then(page) {
        return Some(found);
    }
    // `ISO 8859-1`, `88591`.
    let digits: String = name.chars().filter(char::is_ascii_digit).collect();
    labelled(&format!("iso-8859-{}", digits.strip_prefix("8859")?)).map(Encoding::Kept)
}

/// The code page with a number.
fn page(number: u16) -> Option<Encoding> {
    let kept = match number {
        65001 => UTF_8,
        866 => encoding_rs::IBM866,
        874 => encoding_rs::WINDOWS_874,
        932 => encoding_rs::SHIFT_JIS,
        936 => encoding_rs::GBK,
        949 => encoding_rs::EUC_KR,
        950 => encoding_rs::BIG5,
        1250..=1258 => encoding_rs::Encoding::for_label(format!("windows-{number}").as_bytes())?,
        10_000 => encoding_rs::MACINTOSH,
        10_007 => encoding_rs::X_MAC_CYRILLIC,
        _ => return DECODING_TABLE_CP_MAP.get(&number).map(Encoding::Dos),
    };
    Some(Encoding::Kept(kept))
}

/// The encoding with this number in the header of a table.
fn numbered(driver: u8) -> Option<Encoding> {
    page(match driver {
        1 | 11 | 13 | 15 | 17 | 21 | 24 | 25 | 27 => 437,
        2 | 10 | 14 | 16 | 18 | 20 | 22 | 26 | 29 | 37 | 55 => 850,
        3 | 87..=89 => 1252,
        4 => 10_000,
        8 | 23 | 102 => 865,
        28 | 108 => 863,
        31 | 34 | 35 | 64 | 100 | 135 => 852,
        36 => 860,
        38 | 101 => 866,
        19 | 123 => 932,
        77 | 122 => 936,
        78 | 121 => 949,
        79 | 120 => 950,
        80 | 124 => 874,
        103 => 861,
        106 | 134 => 737,
        107 | 136 => 857,
        150 => 10_007,
        200 => 1250,
        201 => 1251,
        202 => 1254,
        203 => 1253,
        204 => 1257,
        _ => return None,
    })
}
