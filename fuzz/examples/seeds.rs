//! Writes first inputs for both targets, or tells about given ones:
//! `seeds write FOLDER` fills `FOLDER/domain` and `FOLDER/axis`;
//! `seeds tell TARGET FILE…` counts the accepted inputs and prints the WKT of a single one.

use std::path::Path;
use std::process::ExitCode;
use std::{env, fs};

use medial_fuzz::{FAMILIES, Polygons, any_polygons, check_axis, check_domain, shape, to_wkt};

/// Inputs written for each family of shapes.
const EACH: u64 = 60;

fn main() -> ExitCode {
    let args: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = args.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["write", folder] => write(Path::new(folder)),
        ["tell", target, files @ ..] => tell(target, files),
        _ => Err("seeds write FOLDER, or seeds tell TARGET FILE…".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::FAILURE
        }
    }
}

fn write(folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let mut state = 1u64;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 24) as u8
    };
    for target in ["domain", "axis"] {
        fs::create_dir_all(folder.join(target))?;
        let families = FAMILIES as u64;
        for number in 0..families * EACH {
            let family = (number % families) as u8;
            let len = 8 + 2 * u64::from(random()) * (number / families) / EACH;
            let mut input: Vec<u8> = (0..len).map(|_| random()).collect();
            if target == "axis" {
                input[0] = family;
            } else if family < 8 {
                // Three in four are untangled, cleared of short rings and sifted.
                input[0] |= 0xe0;
            }
            fs::write(folder.join(target).join(format!("seed_{number:03}")), input)?;
        }
    }
    Ok(())
}

fn tell(target: &str, files: &[&str]) -> Result<(), Box<dyn std::error::Error>> {
    let (mut accepted, mut faults) = (0, 0);
    let mut by_family = [[0; 2]; FAMILIES];
    for file in files {
        let data = fs::read(file)?;
        let show = |polygons: &Polygons| {
            if files.len() == 1 {
                println!("{}", to_wkt(polygons));
            }
        };
        let result = if target == "domain" {
            let polygons = any_polygons(&data);
            show(&polygons);
            check_domain(&polygons)
        } else {
            let family = &mut by_family[data.first().map_or(0, |&b| usize::from(b) % FAMILIES)];
            family[1] += 1;
            let Some(shape) = shape(&data) else { continue };
            family[0] += 1;
            show(&shape.polygons);
            check_axis(&shape).map(|()| true)
        };
        match result {
            Ok(yes) => accepted += usize::from(yes),
            Err(why) => {
                faults += 1;
                println!("{file}: {why}");
            }
        }
    }
    println!("{accepted} accepted of {}, {faults} with a fault", files.len());
    if target == "axis" {
        println!("accepted and all by family: {by_family:?}");
    }
    Ok(())
}
