//! The experiments of [VS87, IV] again: regular polygons, triangles, holes, flipped vertices.

use std::f64::consts::TAU;
use std::time::Duration;

use medial::domain::{Domain, Options};
use medial::engine::{
    self, RidgeAxis, RidgeOptions, RidgePairs, RidgeSearch, RidgeThinning, ridge_following,
};
use medial::geom::Point;

use crate::measure::Error;
use crate::text::Polygons;

/// The size of a cell: the report does not tell it. A triangle of area 70 has some 120 rows then.
const CELL: f64 = 0.1;

/// How often each shape is run; the least time of each phase counts.
const ROUNDS: usize = 5;

/// The names of the experiments, and the values of each.
pub const EXPERIMENTS: [(&str, u32, u32); 4] =
    [("edges", 3, 70), ("area", 3, 70), ("holes", 0, 20), ("concave", 0, 9)];

/// A shape of an experiment.
fn shape(experiment: &str, value: u32) -> Option<Polygons> {
    Some(vec![match experiment {
        // The first vertex on the positive x axis, as in the report; all of one area.
        "edges" => vec![regular(value, radius(value, 30.0))],
        "area" => vec![regular(3, radius(3, f64::from(value)))],
        "holes" => comb(value),
        "concave" => vec![flipped(value)],
        _ => return None,
    }])
}

/// The radius of a regular polygon of some area.
fn radius(edges: u32, area: f64) -> f64 {
    let n = f64::from(edges);
    (2.0 * area / (n * (TAU / n).sin())).sqrt()
}

fn regular(edges: u32, radius: f64) -> Vec<Point> {
    let corner = |k: u32| {
        let (sin, cos) = (f64::from(k) / f64::from(edges) * TAU).sin_cos();
        Point::new(radius * cos, radius * sin)
    };
    (0..edges).map(corner).collect()
}

/// A bar with twenty groups of teeth of six edges on its upper side, some of which are holes instead: a longer
/// edge takes their place, and the other five are a triangle dented on two sides, so that there are always as
/// many concave and convex vertices.
fn comb(holes: u32) -> Vec<Vec<Point>> {
    const GROUPS: u32 = 20;
    let mut upper = Vec::new();
    let mut rings = Vec::new();
    for group in (0..GROUPS).rev() {
        let x = f64::from(group) * 1.5;
        let p = |dx: f64, y: f64| Point::new(x + dx, y);
        // Not in line with the next one, so that the longer edge stays one of its own.
        upper.push(p(1.4, 4.1));
        if group < holes {
            rings.push(vec![p(0.3, 2.6), p(0.75, 3.4), p(1.2, 2.6), p(0.85, 2.8), p(0.65, 2.8)]);
        } else {
            let teeth = [(1.2, 3.2), (0.95, 3.8), (0.75, 2.8), (0.55, 3.8), (0.3, 3.2)];
            upper.extend(teeth.map(|(dx, y)| p(dx, y)));
        }
        upper.push(p(0.1, 4.0));
    }
    let mut outer = vec![Point::new(0.0, 0.0), Point::new(30.0, 0.0)];
    outer.extend(upper);
    rings.insert(0, outer);
    rings
}

/// A regular polygon of twenty edges with some of every second vertex flipped to the other side of the line
/// between its neighbours.
fn flipped(concave: u32) -> Vec<Point> {
    let ring = regular(20, 3.5);
    let n = ring.len();
    let vertex = |k: usize| {
        let is_flipped = k % 2 == 1 && (k as u32) / 2 < concave;
        if is_flipped { ring[k - 1] + ring[(k + 1) % n] - ring[k] } else { ring[k] }
    };
    (0..n).map(vertex).collect()
}

/// Runs an experiment with one value and one search, and prints a line: the name, the value, the search, edges,
/// microseconds of the phases, and how many pixels were found and kept.
pub fn run(experiment: &str, value: u32, search: RidgeSearch) -> Result<(), Error> {
    let polygons = shape(experiment, value).ok_or("no such experiment")?;
    let domain = Domain::from_polygons(&polygons, &Options::default())?;
    let options = engine::Options { cell: Some(CELL), ..engine::Options::default() };
    let (thinning, pairs) = (RidgeThinning::Report, RidgePairs::Adjacent);
    let ridge = RidgeOptions { search, thinning, pairs, ..RidgeOptions::default() };
    let mut least = [Duration::MAX; 4];
    let mut last: Option<RidgeAxis> = None;
    for _ in 0..ROUNDS {
        let found = ridge_following(&domain, &ridge, &options)?;
        let times = found.times;
        let phases = [times.initialise, times.first, times.follow + times.scan, times.thin];
        least.iter_mut().zip(phases).for_each(|(least, time)| *least = (*least).min(time));
        last = Some(found);
    }
    let Some(found) = last else { return Ok(()) };
    let micros = least.map(|time| format!("{:.2}", time.as_secs_f64() * 1e6)).join(" ");
    let (edges, kept) = (domain.edges().len(), found.pixels.len());
    println!("{experiment} {value} {search} {edges} {micros} {} {kept}", found.n_found);
    Ok(())
}
