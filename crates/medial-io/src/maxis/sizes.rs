use super::Record;
use super::write::{EFFORT, write};
use crate::Json;
use medial::ops::Compressed;

/// Bytes of features, as a compressed axis and as the polygons they came from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// The compressed axis, with its head and checksum.
    pub maxis: usize,
    /// Well-known binary.
    pub wkb: usize,
    /// Well-known binary, deflated as the compressed axis is.
    pub deflated_wkb: usize,
}

impl Sizes {
    /// How many times as long the well-known binary is.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.wkb as f64 / self.maxis as f64
    }

    /// How many times as long the deflated well-known binary is.
    #[must_use]
    pub fn deflated_ratio(&self) -> f64 {
        self.deflated_wkb as f64 / self.maxis as f64
    }
}

/// The sizes of these features in a file of their own, and of their polygons, given as well-known binary.
#[must_use]
pub fn sizes(crs: Option<&Json>, records: &[Record], wkb: &[u8]) -> Sizes {
    Sizes {
        maxis: write(crs, records).len(),
        wkb: wkb.len(),
        deflated_wkb: miniz_oxide::deflate::compress_to_vec(wkb, EFFORT).len(),
    }
}

/// The one of two shapes that takes fewer bytes alone; the second if neither does.
#[must_use]
pub fn smaller(first: Compressed, second: Compressed) -> Compressed {
    let size = |shape: &Compressed| {
        write(None, &[Record { feature: 0, id: None, shape: shape.clone() }]).len()
    };
    if size(&first) < size(&second) { first } else { second }
}
