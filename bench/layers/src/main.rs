//! Prints the features of polygon files as the programs of the comparison read them.
//!
//! `layers given FILE...` prints coordinates as they are, `layers rounded FILE...` each feature
//! enlarged by the power of two, and shifted by the corner of its box, that make it fill the whole
//! numbers of 31 bits, and rounded. Both print the same features: those that bound a domain as
//! given, and still do when rounded, with edges that meet at ends only, as Boost.Polygon wants.
//! Standard error has one line with the numbers of features that are printed, are no domain, or
//! are lost by rounding.

use std::path::Path;
use std::{env, fs};

use medial::domain::{Domain, Options, Repair, Report};
use medial::geom::Point;
use medial_bench::measure::Error;
use medial_bench::text::{self, Polygons};
use medial_io::{Content, Format};

/// Largest coordinate after rounding.
const SIZE: f64 = (1 << 30) as f64;

fn main() -> Result<(), Error> {
    let args: Vec<String> = env::args().skip(1).collect();
    let (rounded, files) = match args.split_first() {
        Some((word, files)) if word == "given" => (false, files),
        Some((word, files)) if word == "rounded" => (true, files),
        _ => return Err("layers given FILE..., or layers rounded FILE...".into()),
    };
    let mut printed = String::new();
    let (mut kept, mut refused, mut lost) = (0, 0, 0);
    for file in files {
        let bytes = fs::read(file)?;
        for feature in medial_io::read(format(file, &bytes)?, &bytes)? {
            let given = match feature {
                Ok(feature) if feature.polygons.iter().any(|p| !p.is_empty()) => feature.polygons,
                _ => continue,
            };
            let whole = rounding(&given);
            if Domain::from_polygons(&given, &Options::default()).is_err() {
                refused += 1;
            } else if !suits(&whole) {
                lost += 1;
            } else {
                kept += 1;
                text::write(&mut printed, if rounded { &whole } else { &given });
            }
        }
    }
    print!("{printed}");
    eprintln!("{kept} {refused} {lost}");
    Ok(())
}

/// The format by the extension, or for JSON by the content.
fn format(file: &str, bytes: &[u8]) -> Result<Format, Error> {
    match Format::from_path(Path::new(file)) {
        Ok(format) if format != Format::Json => Ok(format),
        _ => match Format::of_content(bytes)? {
            Content::Polygons(format) => Ok(format),
            Content::Axes | Content::CompressedAxes => Err("axes".into()),
        },
    }
}

/// The polygons in whole numbers, without corners that fall together.
fn rounding(polygons: &Polygons) -> Polygons {
    let points = || polygons.iter().flatten().flatten();
    let least = |of: fn(&Point) -> f64| points().map(of).fold(f64::INFINITY, f64::min);
    let most = |of: fn(&Point) -> f64| points().map(of).fold(f64::NEG_INFINITY, f64::max);
    let (x, y) = (least(|p| p.x), least(|p| p.y));
    let extent = (most(|p| p.x) - x).max(most(|p| p.y) - y);
    let scale = (SIZE / extent).log2().floor().exp2();
    let whole = |p: &Point| Point::new(((p.x - x) * scale).round(), ((p.y - y) * scale).round());
    let ring = |ring: &Vec<Point>| {
        let mut ring: Vec<Point> = ring.iter().map(whole).collect();
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        ring
    };
    polygons.iter().map(|rings| rings.iter().map(ring).collect()).collect()
}

/// Whether rounded polygons bound a domain, and none of their edges meet but at ends.
fn suits(polygons: &Polygons) -> bool {
    let whole = |report: &Report| {
        report.entries().iter().all(|entry| {
            use Repair::{Bridge, DegenerateHole, Spike, SplitEdge};
            ![Bridge, DegenerateHole, Spike, SplitEdge].contains(&entry.repair)
        })
    };
    Domain::from_polygons(polygons, &Options::default()).is_ok_and(|d| whole(d.report()))
}
