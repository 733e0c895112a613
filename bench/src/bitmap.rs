//! Bitmaps of the kind P4 of Netpbm.

use std::fs;

use medial::raster::{Grid, Mask};

use crate::measure::Error;

/// Reads the mask in a file: ones are of the shape.
pub fn read(file: &str) -> Result<Mask, Error> {
    parse(&fs::read(file)?).ok_or_else(|| "no bitmap of the kind P4".into())
}

fn parse(bytes: &[u8]) -> Option<Mask> {
    let mut fields = bytes.splitn(4, |byte| byte.is_ascii_whitespace());
    let kind = fields.next()?;
    let mut number = || std::str::from_utf8(fields.next()?).ok()?.parse().ok();
    let (columns, rows): (u32, u32) = (number()?, number()?);
    let data = fields.next().filter(|_| kind == b"P4")?;
    let mut mask = Mask::empty(Grid::of_image(columns, rows)).ok()?;
    let stride = (columns as usize).div_ceil(8);
    for (y, row) in (0..rows).zip(data.chunks_exact(stride)) {
        let turned: Vec<u8> = row.iter().map(|byte| byte.reverse_bits()).collect();
        mask.put_row(y, &turned);
    }
    Some(mask)
}
