//! The header of a geometry in a GeoPackage [OGC 12-128r17, 2.1.3].

use crate::{Error, Feature, wkb};

/// Reads a geometry into a feature.
///
/// # Errors
/// If it is malformed.
pub(super) fn read(blob: &[u8], feature: &mut Feature) -> Result<(), Error> {
    let wrong = |why: String| Error::Value { place: "geometry".to_owned(), why };
    let [b'G', b'P', _version, flags, _, _, _, _, rest @ ..] = blob else {
        return Err(wrong("it has no header of a GeoPackage".to_owned()));
    };
    const EXTENDED: u8 = 0x20;
    if flags & EXTENDED != 0 {
        feature.geometry = "a geometry of an extension".to_owned();
        return Ok(());
    }
    let envelope = match flags >> 1 & 7 {
        0 => 0,
        1 => 32,
        2 | 3 => 48,
        4 => 64,
        other => return Err(wrong(format!("{other} is no kind of envelope"))),
    };
    let wkb = rest.get(envelope..).ok_or_else(|| wrong("it ends too early".to_owned()))?;
    wkb::read_alone(wkb, feature)
}

/// A geometry with its header: the number of its reference system, its box, and its well-known binary.
pub(super) fn write(srs: i32, [x, y, x_max, y_max]: [f64; 4], wkb: &[u8], out: &mut Vec<u8>) {
    const LITTLE_ENDIAN: u8 = 1;
    const BOX: u8 = 1 << 1;
    out.extend([b'G', b'P', 0, LITTLE_ENDIAN | BOX]);
    out.extend(srs.to_le_bytes());
    [x, x_max, y, y_max].iter().for_each(|value| out.extend(value.to_le_bytes()));
    out.extend(wkb);
}
