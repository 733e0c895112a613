//! Any bytes as what a compressed axis stores, and any mask through every way to compress it.
//!
//! The first byte says which. Bytes get the head and the checksum that they need to be looked at; features are
//! read or refused, and masks drawn or refused. A mask must come back as near as is told, and bit for bit
//! where nothing is lost.

#![no_main]

use libfuzzer_sys::fuzz_target;
use medial::ops::{Compressed, MaskMethod, MaskOptions, compress_mask};
use medial::raster::{Grid, Mask};
use medial_io::maxis::{self, MAGIC, Record};

/// The features in a body that is not deflated.
fn read(body: &[u8]) {
    let stored = [&[0], body].concat();
    let file = [&MAGIC[..], &crc32fast::hash(&stored).to_le_bytes(), &stored].concat();
    let Ok(records) = maxis::records(&file) else { return };
    for record in records.map_while(Result::ok) {
        if let Compressed::Mask(code) = &record.shape {
            // Larger ones are well, but take their time.
            if code.grid.n_cells() < 1 << 20
                && let Ok(mask) = code.mask()
                && mask.grid().n_cells() < 1 << 14
            {
                let _ = code.axis();
            }
        }
        // What is read can be written, and read again.
        let bytes = maxis::write(None, &[Record { feature: 0, ..record }]);
        if let Err(error) =
            maxis::records(&bytes).and_then(|mut read| read.next().expect("it was written"))
        {
            panic!("{error}");
        }
    }
}

/// A mask with these bits.
fn through(data: &[u8]) {
    let Some((&[width, way], bits)) = data.split_first_chunk() else { return };
    let columns = 1 + u32::from(width % 80);
    let rows = (8 * bits.len() as u32).div_ceil(columns).min(200);
    let is_inside = |x: u32, y: u32| {
        let place = (y * columns + x) as usize;
        bits.get(place / 8).is_some_and(|byte| byte >> (place % 8) & 1 != 0)
    };
    let mask = Mask::new(Grid::of_image(columns, rows), is_inside).expect("it is small");
    let method = MaskMethod::ALL[usize::from(way % 4)];
    let options = MaskOptions {
        method,
        residual: (way & 4 != 0).then_some(f64::from(way >> 6)),
        radius_steps: u32::from(way >> 4 & 3),
        coverage: if way & 8 == 0 { 1.0 } else { 0.9 },
        max_error: (way & 12 == 12).then_some(f64::from(way >> 6)),
    };
    let code = compress_mask(&mask, &options).expect("it is small");
    let shape = Compressed::Mask(code.clone());
    let bytes = maxis::write(None, &[Record { feature: 0, id: None, shape: shape.clone() }]);
    let read = maxis::records(&bytes).expect("it was written").next().expect("one").expect("whole");
    assert!(read.shape == shape);
    let part = code.mask().expect("it was compressed");
    assert_eq!(part.count() + code.missing, mask.count());
    for y in 0..rows {
        assert!(part.cells(y).all(|x| mask.get(x, y)));
    }
    assert!(options.max_error.is_none_or(|error| code.error <= error));
}

fuzz_target!(|data: &[u8]| {
    match data.split_first() {
        Some((0..128, body)) => read(body),
        Some((_, bits)) => through(bits),
        None => {}
    }
});
