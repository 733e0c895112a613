//! Prints a digest of every result of the operations on axes, for changes that shall not change any.
//!
//! `digest [SHAPE EDGES]` prints a line for each result: the shape, the side, the operation, and a hash of
//! all that there is in it, to the last bit. Two states of the library give the same where the lines are
//! the same; `diff` says where they are not. `digest value SHAPE EDGES SIDE OPERATION` prints the result
//! itself.

use std::fmt::{self, Debug, Write};

use medial::axis::{Engine, MedialAxis};
use medial::domain::{Domain, Options};
use medial::engine::{Options as EngineOptions, exterior, interior};
use medial::geom::Point;
use medial::ops::{
    CenterlineOptions, Hierarchy, Measure, Outline, Route, branches, centerlines, polygons_of,
    smoothed,
};
use medial_bench::measure::Error;
use medial_bench::shapes;

const SHAPES: [&str; 9] =
    ["star", "ngon", "ellipse", "holes", "holes3", "lattice", "comb", "rmaze", "corridor"];
const EDGES: usize = 3_000;

const MEASURES: [Measure; 12] = [
    Measure::Excess,
    Measure::RelativeExcess,
    Measure::Prominence,
    Measure::Potential,
    Measure::Chord,
    Measure::Circularity,
    Measure::Erosion,
    Measure::Length,
    Measure::Angle,
    Measure::HalfChord,
    Measure::Radius,
    Measure::Scale,
];

/// Shares of the greatest finite value at which axes are pruned.
const SHARES: [f64; 4] = [1e-6, 1e-3, 0.03, 0.4];

fn main() -> Result<(), Error> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match args.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        [] => SHAPES.iter().try_for_each(|shape| digests(shape, EDGES, None)),
        [shape, edges] => digests(shape, edges.parse()?, None),
        ["value", shape, edges, side, operation] => {
            digests(shape, edges.parse()?, Some((side, operation)))
        }
        _ => Err("digest [SHAPE EDGES] or digest value SHAPE EDGES SIDE OPERATION".into()),
    }
}

/// Prints those of a shape, or one result.
fn digests(shape: &str, edges: usize, only: Option<(&str, &str)>) -> Result<(), Error> {
    let domain = domain(shape, edges)?;
    let (engine, options) = (Engine::PathTracing, EngineOptions::default());
    let inside = ("interior", interior(&domain, engine, &options)?);
    let outside = ("exterior", exterior(&domain, engine, None, &options)?);
    for (side, axis) in [inside, outside] {
        each(&domain, &axis, |operation, value| match only {
            None => println!("{shape} {side} {operation} {:016x}", hash(value)),
            Some(wanted) if wanted == (side, operation) => println!("{value:#?}"),
            Some(_) => {}
        });
    }
    Ok(())
}

/// Does all operations on an axis.
fn each(domain: &Domain, axis: &MedialAxis, mut done: impl FnMut(&str, &dyn Debug)) {
    done("branches", &branches(axis));
    done("outline", &Outline::new(axis));
    done("reconstruct", &polygons_of(axis));
    let hierarchy = match Hierarchy::new(domain, axis) {
        Ok(hierarchy) => hierarchy,
        Err(error) => return done("hierarchy", &error),
    };
    for measure in MEASURES {
        let all = hierarchy.significance(measure);
        done(&format!("significance/{measure}"), &all);
        done(&format!("removal/{measure}"), &hierarchy.removal(measure));
        let finite = all.paths.iter().map(|span| span.most).filter(|most| most.is_finite());
        let greatest = finite.fold(0.0, f64::max);
        for share in SHARES {
            let name = |what: &str| format!("{what}/{measure}/{share}");
            let pruned = hierarchy.pruned(measure, share * greatest);
            done(&name("pruned"), &pruned);
            done(&name("kept"), &hierarchy.significance_of(measure, &pruned));
            done(&name("branches"), &branches(&pruned.axis));
            done(&name("outline"), &Outline::new(&pruned.axis));
            done(&name("smooth"), &smoothed(domain, axis, measure, share * greatest));
        }
    }
    for count in [1, 3] {
        for (name, route) in [("longest", Route::Longest), ("label", Route::Label { height: None })]
        {
            let mut options = CenterlineOptions { count, route, ..CenterlineOptions::default() };
            done(&format!("centerline/{name}/{count}"), &centerlines(domain, axis, &options));
            for measure in [Measure::Excess, Measure::Prominence, Measure::Erosion] {
                options.ends = (measure, 1e6);
                done(
                    &format!("centerline/{name}/{count}/{measure}"),
                    &centerlines(domain, axis, &options),
                );
            }
        }
    }
}

/// A shape of `medial-bench draw`, or a long corridor between walls of many edges.
fn domain(shape: &str, edges: usize) -> Result<Domain, Error> {
    let rings = match shape {
        "corridor" => vec![corridor(edges)],
        _ => shapes::draw(shape, edges).ok_or("no such shape")?,
    };
    let point = |(x, y)| Point::new(x, y);
    let rings = rings.into_iter().map(|ring| ring.into_iter().map(point).collect()).collect();
    Ok(Domain::from_polygons(&[rings], &Options::default())?)
}

/// A sine of 3 waves, 1e7 wide.
fn corridor(edges: usize) -> shapes::Ring {
    let half = edges / 2;
    let height = |x: f64| (1e8 * (x / 1e9 * 6.0 * std::f64::consts::TAU).sin()).round();
    let at = |k: usize| (k as f64 * 1e9 / half as f64).round();
    let below = (0..half).map(|k| (at(k), height(at(k))));
    below.clone().chain(below.rev().map(|(x, y)| (x, y + 1e7))).collect()
}

/// FNV-1a of the text of a value, which has every double to its last bit.
fn hash(value: &dyn Debug) -> u64 {
    struct Hash(u64);
    impl Write for Hash {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            for byte in text.bytes() {
                self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
            Ok(())
        }
    }
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    // Hashing cannot fail.
    let _ = write!(hash, "{value:?}");
    hash.0
}
