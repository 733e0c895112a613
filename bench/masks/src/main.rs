//! Compresses bitmaps in every way, and tells what is lost: `masks FILE.pbm...`.
//!
//! A line for each bitmap and way: the name of the file, the way, bits, the share of the cells that is lost, the
//! Hausdorff distance in pixels, and how many disks or squares there are. Whatever is written is read again first.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use fax::encoder::Encoder;
use fax::{Color, VecWriter};
use medial::ops::{Compressed, MaskMethod, MaskOptions, compress_mask};
use medial::raster::{Mask, crack_chains};
use medial_bench::bitmap;
use medial_io::maxis::{self, Record};
use medial_io::{Format, ReadOptions, image};

type Fallible<T> = Result<T, Box<dyn Error>>;

fn main() -> Fallible<()> {
    for file in std::env::args().skip(1) {
        let mask = bitmap::read(&file)?;
        let name = Path::new(&file).file_stem().unwrap_or_default().to_string_lossy();
        for (way, bits) in rivals(&mask)? {
            println!("{name}\t{way}\t{bits}\t0\t0\t0\t0");
        }
        for (way, options) in ways() {
            let start = Instant::now();
            let code = compress_mask(&mask, &options)?;
            let seconds = start.elapsed().as_secs_f64();
            let shape = Compressed::Mask(code.clone());
            let bytes =
                maxis::write(None, &[Record { feature: 0, id: None, shape: shape.clone() }]);
            let read = maxis::records(&bytes)?.next().ok_or("no record")??;
            if read.shape != shape || code.mask()?.count() + code.missing != mask.count() {
                return Err(format!("{name}: {way} is not read back").into());
            }
            let lost = code.missing as f64 / mask.count().max(1) as f64;
            let (bits, n) = (8 * bytes.len(), code.balls().len());
            println!("{name}\t{way}\t{bits}\t{lost}\t{}\t{n}\t{seconds}", code.error);
        }
    }
    Ok(())
}

/// Bits of a mask in formats that are usual for such images, and of its cracks at two bits each.
fn rivals(mask: &Mask) -> Fallible<Vec<(&'static str, usize)>> {
    let png = image::write_png(mask);
    if image::read_mask(Format::Png, &png, &ReadOptions::default())?.0 != *mask {
        return Err("the PNG is another image".into());
    }
    let chains = crack_chains(mask);
    let side = |n: u32| (u32::BITS - n.leading_zeros()) as usize;
    let start = side(mask.grid().columns) + side(mask.grid().rows);
    let cracks: usize = chains.iter().map(|chain| 2 * chain.turns.len() + start).sum();
    Ok(vec![
        ("raw", mask.grid().n_cells() as usize),
        ("PNG", 8 * png.len()),
        ("CCITT G4", 8 * group_4(mask)?.len()),
        ("crack code, 2 bits", cracks),
    ])
}

/// The mask as fax machines code it, without a head.
fn group_4(mask: &Mask) -> Fallible<Vec<u8>> {
    let (columns, rows) = (mask.grid().columns, mask.grid().rows);
    let width = u16::try_from(columns)?;
    let mut encoder = Encoder::new(VecWriter::new());
    let row =
        |y| (0..columns).map(move |x| if mask.get(x, y) { Color::Black } else { Color::White });
    for y in 0..rows {
        encoder.encode_line(row(y), width)?;
    }
    let bytes = encoder.finish()?.finish();
    let mut y = 0;
    let mut same = true;
    let height = u16::try_from(rows)?;
    let _ = fax::decoder::decode_g4(bytes.iter().copied(), width, Some(height), |line| {
        same = same && fax::decoder::pels(line, width).eq(row(y));
        y += 1;
    });
    if same && y == rows { Ok(bytes) } else { Err("the fax is another image".into()) }
}

/// All ways to compress a mask, with their names.
fn ways() -> Vec<(String, MaskOptions)> {
    let usual = MaskOptions::default();
    let exact = MaskOptions { radius_steps: 0, ..usual };
    let of = |method| MaskOptions { method, residual: None, ..usual };
    let mut ways = vec![
        ("crack".to_owned(), of(MaskMethod::Crack)),
        ("chain, none".to_owned(), of(MaskMethod::Chain)),
    ];
    for chord in [0.5, 1.0, 2.0, 4.0] {
        ways.push((
            format!("chain, chord={chord}"),
            MaskOptions { residual: Some(chord), ..usual },
        ));
    }
    ways.push(("chain, chord=2, exact radii".to_owned(), exact));
    for steps in [2, 1] {
        let options = MaskOptions { radius_steps: steps, ..usual };
        ways.push((format!("chain, chord=2, radii in 1/{steps}"), options));
    }
    for error in [1.0, 2.0, 4.0] {
        ways.push((
            format!("chain, error {error}"),
            MaskOptions { max_error: Some(error), ..usual },
        ));
    }
    for method in [MaskMethod::Cover, MaskMethod::Squares] {
        for coverage in [1.0, 0.999, 0.99, 0.95] {
            let options = MaskOptions { coverage, ..of(method) };
            ways.push((format!("{method}, {}%", 100.0 * coverage), options));
        }
    }
    ways
}
