//! What `delaunay_dual` takes and gives on bitmaps and shapes, as JSON.

use std::hint;

use cpu_time::ThreadTime;
use medial::axis::MedialAxis;
use medial::check::difference;
use medial::domain::{Domain, Options};
use medial::engine::{self, DelaunayDual, DualPruning, crust, path_tracing, two_step_crust};
use medial::geom::{DisjointSets, Point};
use medial::raster::{Mask, outline, topology};

use crate::bitmap;
use crate::measure::Error;
use crate::shapes;

/// The chord residual of what is timed, in pixels.
const RESIDUAL: f64 = 2.0;

/// Times the axis of a bitmap at the default spacing, pruned by the chord residual, and tells how well its samples
/// stand for its outline.
pub fn bitmap(file: &str) -> Result<(), Error> {
    let mask = bitmap::read(file)?;
    let options = engine::Options::default();
    let (mut graphs, mut axes) = (Vec::new(), Vec::new());
    let begun = ThreadTime::now();
    while graphs.len() < 3 || begun.elapsed().as_secs_f64() < 0.05 {
        let start = ThreadTime::now();
        let dual = DelaunayDual::of_mask(&mask, &options)?;
        graphs.push(start.elapsed().as_nanos() as f64);
        let start = ThreadTime::now();
        hint::black_box(dual.axis(DualPruning::Chord(RESIDUAL))?);
        axes.push(start.elapsed().as_nanos() as f64);
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let dual = DelaunayDual::of_mask(&mask, &options)?;
    let axis = dual.axis(DualPruning::Chord(RESIDUAL))?;
    let sampling = dual.sampling();
    let n = sampling.n_samples.max(1) as f64;
    let [one, two] = crusts(&dual);
    println!(
        "{{\"samples\": {}, \"missing\": {}, \"outside_crust\": {}, \"false_crust\": {}, \"sparse\": {}, \
         \"graph_ns\": {:.1}, \"axis_ns\": {:.1}, \"broken\": {}, \"ends\": {}, \"one_step_ns\": {:.1}, \
         \"two_step_ns\": {:.1}, \"two_step_missing\": {}, \"two_step_false\": {}}}",
        sampling.n_samples,
        sampling.n_missing,
        sampling.n_outside_crust,
        sampling.n_false_crust,
        sampling.n_sparse,
        median(&mut graphs) / n,
        median(&mut axes) / n,
        components(&axis).abs_diff(topology(&mask).components as usize),
        axis.degrees().iter().filter(|&&degree| degree == 1).count(),
        one.nanoseconds / n,
        two.nanoseconds / n,
        two.missing,
        two.spurious,
    );
    Ok(())
}

/// How a crust fares.
struct Crust {
    nanoseconds: f64,
    /// Pairs of neighbours that are not in it.
    missing: usize,
    /// Edges of it between others.
    spurious: usize,
}

/// The crusts of one step and of two, from the samples alone.
fn crusts(dual: &DelaunayDual<'_>) -> [Crust; 2] {
    let rings = dual.samples();
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut first = 0;
    for ring in &rings {
        let n = ring.len() as u32;
        pairs.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
        first += n;
    }
    pairs.iter_mut().for_each(|pair| pair.sort_unstable());
    pairs.sort_unstable();
    let points = rings.concat();
    let kinds: [fn(&[Point]) -> Option<Vec<[u32; 2]>>; 2] = [crust, two_step_crust];
    kinds.map(|found| {
        let start = ThreadTime::now();
        let edges = found(&points).unwrap_or_default();
        let nanoseconds = start.elapsed().as_nanos() as f64;
        let shared = pairs.iter().filter(|pair| edges.binary_search(pair).is_ok()).count();
        Crust { nanoseconds, missing: pairs.len() - shared, spurious: edges.len() - shared }
    })
}

fn components(axis: &MedialAxis) -> usize {
    let mut sets = DisjointSets::new(axis.keypoints().len());
    for path in axis.paths() {
        sets.join(path.from, path.to);
    }
    sets.count()
}

/// How far the axis is from the exact one as the spacing is halved, a line each; lengths are shares of the longer
/// side of the box.
pub fn spacing(shape: &str, edges: usize) -> Result<(), Error> {
    let ring = |ring: shapes::Ring| ring.into_iter().map(|(x, y)| Point::new(x, y)).collect();
    let rings = shapes::draw(shape, edges).ok_or("no such shape")?;
    of_polygons(&[rings.into_iter().map(ring).collect()])
}

/// The same for the outline of a bitmap along the sides of its pixels.
pub fn spacing_of_bitmap(file: &str) -> Result<(), Error> {
    let mask: Mask = bitmap::read(file)?;
    of_polygons(&outline(&mask))
}

fn of_polygons(polygons: &[Vec<Vec<Point>>]) -> Result<(), Error> {
    let domain = Domain::from_polygons(polygons, &Options::default())?;
    let exact = path_tracing(&domain)?;
    let size = domain.bounds().max - domain.bounds().min;
    let size = size.x.max(size.y);
    for halvings in 0..8 {
        let share = 0.02 * 0.5_f64.powi(halvings);
        let options = engine::Options { spacing: Some(share * size), ..engine::Options::default() };
        let dual = DelaunayDual::new(&domain, &options)?;
        let found = difference(&exact, &dual.axis(DualPruning::Nothing)?);
        let sampling = dual.sampling();
        println!(
            "{{\"spacing\": {share}, \"samples\": {}, \"outside_crust\": {}, \"distance\": {:e}, \"missed\": {:e}}}",
            sampling.n_samples,
            sampling.n_outside_crust,
            found.distance / size,
            found.missed / size,
        );
    }
    Ok(())
}
