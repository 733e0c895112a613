use super::super::{Record, records, write};
use medial::geom::Point;
use medial::ops::{Compressed, CompressedMask, MaskMethod, MaskOptions, compress_mask};
use medial::raster::{Grid, Mask};

fn dice(seed: u64) -> impl FnMut() -> u64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33
    }
}

fn random(seed: u64) -> Mask {
    let mut dice = dice(seed);
    let (columns, rows, fill) = (dice() as u32 % 40, dice() as u32 % 40, dice() % 101);
    let mut grid = Grid::of_image(columns, rows);
    if seed.is_multiple_of(3) {
        (grid.origin, grid.cell) = (Point::new(1e6 / 3.0, -7.25), [0.1, -0.3]);
    }
    // Blocks of cells, so that there are disks of some size.
    let block = 1 + dice() as u32 % 9;
    let noise: Vec<bool> = (0..2000).map(|_| dice() % 100 < fill).collect();
    Mask::new(grid, |x, y| noise[(y / block * 40 + x / block) as usize]).unwrap()
}

fn ways() -> Vec<MaskOptions> {
    let all = MaskMethod::ALL.iter();
    let mut ways: Vec<MaskOptions> = all
        .map(|&method| MaskOptions { method, residual: None, ..MaskOptions::default() })
        .collect();
    for radius_steps in 0..=4 {
        // Radii as they are, and in steps of which each has a unit of its own.
        ways.push(MaskOptions { radius_steps, residual: Some(1.0), ..MaskOptions::default() });
    }
    ways.push(MaskOptions { method: MaskMethod::Cover, coverage: 0.7, ..MaskOptions::default() });
    ways
}

fn file(code: &CompressedMask) -> Vec<u8> {
    let shape = Compressed::Mask(code.clone());
    write(None, &[Record { feature: 0, id: None, shape }])
}

/// The mask of a file, or why there is none.
fn read(bytes: &[u8]) -> Result<CompressedMask, String> {
    let mut records = records(bytes).map_err(|error| error.to_string())?;
    let record = records.next().ok_or("no record")?.map_err(|error| error.to_string())?;
    match record.shape {
        Compressed::Mask(code) => Ok(code),
        _ => Err("no mask".to_owned()),
    }
}

#[test]
fn whatever_stands_for_a_mask_is_read_back() {
    for seed in 1..250 {
        let mask = random(seed);
        for options in ways() {
            let code = compress_mask(&mask, &options).unwrap();
            let bytes = file(&code);
            assert_eq!(read(&bytes), Ok(code.clone()), "{seed} {options:?}");
            if code.missing == 0 {
                assert_eq!(read(&bytes).unwrap().mask().unwrap(), mask);
            }
        }
    }
}

/// The file with another body, under a checksum that is right.
fn sealed(body: &[u8]) -> Vec<u8> {
    let stored = [&[super::super::PLAIN][..], body].concat();
    [&super::super::MAGIC[..], &crc32fast::hash(&stored).to_le_bytes(), &stored].concat()
}

#[test]
fn damage_under_a_good_checksum_is_an_error_or_another_mask() {
    let mut n_errors = 0;
    for seed in 1..40 {
        let mask = random(seed);
        for options in ways() {
            let code = compress_mask(&mask, &options).unwrap();
            let bytes = file(&code);
            if bytes[12] != super::super::PLAIN {
                continue;
            }
            let mut dice = dice(seed);
            for _ in 0..20 {
                let mut body = bytes[13..].to_vec();
                let at = dice() as usize % body.len();
                body[at] ^= 1 << (dice() % 8);
                match read(&sealed(&body)) {
                    // What is read can be drawn, or is refused.
                    Ok(code) => drop(code.mask()),
                    Err(_) => n_errors += 1,
                }
            }
        }
    }
    assert!(n_errors > 100, "{n_errors}");
}

#[test]
fn a_code_that_is_cut_off_is_told() {
    let mask = Mask::new(Grid::of_image(60, 60), |x, y| (x * y) % 7 > 2).unwrap();
    for options in ways() {
        let code = compress_mask(&mask, &options).unwrap();
        let (_, bytes) = super::coded(&code);
        for end in [0, 1, bytes.len() / 2] {
            // The plan with a shorter code.
            let mut whole = super::super::write::Columns::new();
            super::write(&mut whole, &code);
            let plan = whole.of(super::Column::Plan);
            let head = plan.len() - bytes.len();
            plan.truncate(head + end);
            let mut own = Vec::new();
            super::push(&mut own, bytes.len() as u64);
            let tail = head - own.len();
            let mut short = plan[..tail].to_vec();
            super::push(&mut short, end as u64);
            short.extend_from_slice(&plan[head..]);
            let mut body = Vec::new();
            let plan = [&[0, 1, 0, 0][..], &short].concat();
            super::push(&mut body, plan.len() as u64);
            body.extend([0, 0, 0]);
            body.extend(plan);
            assert!(read(&sealed(&body)).is_err(), "{options:?} {end}");
        }
    }
}

#[test]
fn a_horse_takes_less_than_its_png() {
    let bytes = include_bytes!("../../../../../fixtures/images/horse.png");
    let read = crate::ReadOptions { invert: true, ..crate::ReadOptions::default() };
    let (mask, _) = crate::image::read_mask(crate::Format::Png, bytes, &read).unwrap();
    let size = |options: &MaskOptions| file(&compress_mask(&mask, options).unwrap()).len();
    let method = |method| MaskOptions { method, ..MaskOptions::default() };
    let (chain, crack) = (size(&MaskOptions::default()), size(&method(MaskMethod::Crack)));
    let cover = size(&MaskOptions { coverage: 0.99, ..method(MaskMethod::Cover) });
    assert!(crack < 330 && chain < 640 && cover < 430, "{crack} {chain} {cover}");
}
