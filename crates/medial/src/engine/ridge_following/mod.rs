//! Ridge following after Volkmann and St. Clair [VS87]: medial pixels, found from one another.
//!
//! # Contract
//! A pixel is medial if the distances of its centre from the two nearest edges differ by less than the size of a
//! cell, of edges that make a pair. All medial pixels are found, in as many connected sets as there are; how
//! many is told. Radii are distances from the edges after merging: within the drift of the true ones, half a
//! cell unless something else is said, and within a cell for masks. Every way to search but the six vertices gives
//! the same.
//!
//! The axis has as many components as sets were found, which may be more than the shape has. It is never complete:
//! pixels that the boundary is drawn with are not medial, and there are no others in corners; and thinning shortens
//! branches that are broad for their length.
//!
//! # Method
//! Sections of the report in brackets.
//! 1. Initialising (A.3, steps 1 to 6): which pixels are inside, boundary drawn after Bresenham, vertex types
//!    with their angular tolerance, nearly straight edges merged, line coefficients.
//! 2. The first medial pixel (III.B, A.3 steps 5 and 7): an interior point from the highest vertex and its
//!    neighbours, lowered to the highest concave vertex, and from there up and down.
//! 3. The rest (step 8): neighbours of medial pixels, never over the boundary.
//! 4. Thinning (III.D): the worst simple pixel first, or one of the rules of the report.
//!
//! Mediality (III.C, A.6): the nearest edge by lower bounds, then the nearest of all others that make a pair
//! with it. Outside (V.B.2) the array reaches as far as is asked, and its border is no boundary. Curves (V.B.1)
//! make no branches where they are rounder than the disk.
//!
//! # Departures
//! From the report, by what was found wrong or wanting in it:
//! - (a) A.6.b and A.6.c compare a lower bound of a distance with the square of one; here both are squares. As the
//!   report breaks ties by the order of its list, they go to the smaller number here, and so edges at the same
//!   distance are looked at as well.
//! - (b) Sorting all edges for each pixel costs O(E log E); the default is a tree of boxes with the same answers.
//!   [`RidgeSearch::Sorted`] is the report's.
//! - (c) The interior point lies on the boundary where several vertices are highest, and needs nothing lowered
//!   where no vertex is concave; where its pixel is not inside, the middle of the longest run in the row halfway
//!   up takes its place.
//! - (d) Only two edges at one concave vertex make no pair in the report ([`RidgePairs::Adjacent`]), so around a
//!   chain of them edges two apart do. Here none do that the boundary joins over concave vertices only, turning
//!   by at most half a turn: no disk can touch such a chain twice. Neither do edges with their back to the pixel,
//!   as on the other side of a gap that is thinner than a cell.
//! - (e) Vertex types look at the angle only where the boundary turns by no more than a quarter of a turn, as in
//!   the report, and merging goes on as long as no vertex drifts farther than half a cell from its edge; types
//!   are then seen anew.
//! - (f) Pixels wait on a stack, not in recursive calls.
//! - (g) Outside, the array is padded, its border is no boundary, and every bounded set of the outside has a seed.
//!
//! "All medial pixels are reached from one" does not hold on a grid. After the seeds all pixels inside that are
//! left are scanned, with strides that the distances of the last one allow. Lines are drawn from where edges end
//! and not from centres, and pixels whose centre is outside are never entered, so no rounding opens a way out.
//!
//! Where ridges run beside each other medial pixels enclose others that are not medial, and the axis would have
//! holes that the shape has not. The queue takes these pixels in before it thins, as the worst of all. Outside it
//! thins ridges at the border of the array as if they went on beyond.
//!
//! V.B.1 says to disqualify a pixel nearer to one of its edges than that edge's radius of curvature. But no
//! maximal disk is larger than that, so almost all would go. What holds is that a curve between two feet of a disk
//! is somewhere at most as round as the disk: so two edges make no pair if the curve between them is rounder
//! everywhere, by a cell, and the next one is looked at.
//!
//! A mask has no edges. Its outline runs along the sides of cells, where every step would be a convex corner and
//! flood the inside, as IV.A describes. So steps of one cell are cut at their middles, then what turns by less than
//! 50 degrees and drifts no farther than the middles of one digital line is merged (`rings.rs`). No line is drawn: the mask itself says what
//! is inside.

mod edges;
mod follow;
mod nearest;
mod rings;
mod thin;

use std::time::{Duration, Instant};

use super::exterior::exterior_frame;
use super::sampled::{
    Boundary, DomainBoundary, Foot, Label, OutlineBoundary, axis_of_cells, cells_of, features_of,
};
use super::watch::Watch;
use super::{EngineError, Options};
use crate::axis::{Engine, MedialAxis, Side, Site};
use crate::domain::{Complement, Curves, Domain};
use crate::raster::{
    Bits, Cracks, DigitiseError, Grid, Mask, PixelGraph, default_cell, digitise, grid_around,
    line_cells,
};
use edges::{Edges, Merging};
use follow::Field;
use nearest::Searcher;
use rings::Ring;
use thin::Medial;

pub use edges::RidgePairs;
pub use follow::RidgePixel;
pub use nearest::RidgeSearch;
pub use thin::RidgeThinning;

/// The angle by which the boundary of a domain turns at most where it is straight: that of the report.
pub const STRAIGHT_ANGLE: f64 = 5.0 * DEGREE;

/// The same for the outline of a mask, once its steps are cut: more than a digital line turns.
pub const STRAIGHT_ANGLE_OF_MASKS: f64 = 50.0 * DEGREE;

/// How far vertices may drift where nothing else is said, in cells.
const DRIFT: f64 = 0.5;

/// The same for masks: the middles of the steps of one digital line are at most so far from any edge between two of
/// them. A line of slope s up to 1 takes a step of one row within s rows of the same height above it, which is less
/// than √½ cells across.
const DRIFT_OF_MASKS: f64 = 0.71;

/// How far the corners of steps may drift, in cells: radii are to be within one of the true ones.
const CORNER_DRIFT: f64 = 0.99;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// What is added to the tolerance of one cell, as a share of it: a pixel just as medial as it may be must not be
/// lost to rounding, as others are reached through it (A.3, step 6).
const VERY_SMALL: f64 = 1e-9;

/// How ridges are followed.
#[derive(Clone, Copy, Debug)]
pub struct RidgeOptions<'a> {
    /// How the two nearest edges are found.
    pub search: RidgeSearch,
    /// How excess pixels are taken away.
    pub thinning: RidgeThinning,
    /// Which edges make a pair.
    pub pairs: RidgePairs,
    /// The angle up to which a vertex is straight, in radians; by default [`STRAIGHT_ANGLE`], and
    /// [`STRAIGHT_ANGLE_OF_MASKS`].
    pub angle: Option<f64>,
    /// How far, in cells, a straight vertex may be from the edge that it is merged into; by default half a cell,
    /// and 0.71 for masks.
    pub drift: Option<f64>,
    /// The curves that the edges of a domain stand for.
    pub curves: Option<&'a Curves>,
    /// The side of the boundary. Masks have no outside.
    pub side: Side,
    /// How far the array reaches beyond the box of the domain for an exterior axis, in units of the input; by
    /// default as far as the longer side of the box.
    pub margin: Option<f64>,
}

impl Default for RidgeOptions<'_> {
    fn default() -> Self {
        Self {
            search: RidgeSearch::default(),
            thinning: RidgeThinning::default(),
            pairs: RidgePairs::default(),
            angle: None,
            drift: None,
            curves: None,
            side: Side::Interior,
            margin: None,
        }
    }
}

/// Medial pixels, and the axis made of them.
#[derive(Clone, Debug)]
pub struct RidgeAxis {
    /// The axis: a keypoint for each pixel that is left.
    pub axis: MedialAxis,
    /// The array.
    pub grid: Grid,
    /// The medial pixels that are left, by increasing column within increasing row.
    pub pixels: Vec<RidgePixel>,
    /// How many medial pixels there were before thinning.
    pub n_found: usize,
    /// In how many sets they were that no step leads between.
    pub n_components: u32,
    /// How many pixels were tested for mediality.
    pub n_tested: u64,
    /// How many edges there were after merging.
    pub n_edges: usize,
    /// What took how long.
    pub times: RidgeTimes,
}

/// Wall time of the phases of the report, and of what comes after them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RidgeTimes {
    /// Digitising, vertex types, merging, line coefficients.
    pub initialise: Duration,
    /// Seeds, and the first medial pixel of each.
    pub first: Duration,
    /// The rest of the medial pixels from there.
    pub follow: Duration,
    /// Other sets of medial pixels.
    pub scan: Duration,
    /// Thinning.
    pub thin: Duration,
    /// The axis as a graph with its sites.
    pub assemble: Duration,
}

/// What is followed.
struct Shape {
    grid: Grid,
    /// Pixels of the side of the axis.
    inside: Bits,
    /// Pixels that the boundary is drawn with.
    boundary: Bits,
    rings: Vec<Ring>,
    /// The angle up to which a vertex is straight, and how far it may drift, in cells.
    straight: [f64; 2],
}

/// The medial pixels of a domain, on cells of the size that the options say, and the sampled axis made of them.
///
/// ```
/// use medial::domain::{self, Domain};
/// use medial::engine::{Options, RidgeOptions, ridge_following};
/// use medial::geom::Point;
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &domain::Options::default())?;
/// let options = Options { cell: Some(0.1), ..Options::default() };
/// let ridges = ridge_following(&domain, &RidgeOptions::default(), &options)?;
/// assert_eq!((ridges.n_components, ridges.n_edges), (1, 4));
/// // Along the middle the distances are those of the centres of cells from the longer sides.
/// let middle = ridges.pixels.iter().filter(|p| (p.position.x - 3.0).abs() < 0.1);
/// assert!(middle.into_iter().all(|p| (p.radius - 0.95).abs() < 1e-9));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the cells are too many or have no size, the margin is no frame, or the options say to stop.
pub fn ridge_following(
    domain: &Domain,
    ridge: &RidgeOptions<'_>,
    options: &Options<'_>,
) -> Result<RidgeAxis, EngineError> {
    let start = Instant::now();
    let straight = [ridge.angle.unwrap_or(STRAIGHT_ANGLE), ridge.drift.unwrap_or(DRIFT)];
    if ridge.side == Side::Exterior {
        return outside(domain, straight, start, ridge, options);
    }
    let mask = cells_of(domain, options)?;
    let (grid, inside) = (*mask.grid(), mask.bits);
    let boundary = line_cells(domain, &grid).map_err(DigitiseError::from)?.bits;
    let rings = rings::of_domain(domain, ridge.curves, |_| true);
    let shape = Shape { grid, inside, boundary, rings, straight };
    Ridges::new(shape, start, ridge, options)?.axis(ridge, |grid| DomainBoundary::new(domain, grid))
}

/// The same outside of the polygons.
fn outside(
    domain: &Domain,
    straight: [f64; 2],
    start: Instant,
    ridge: &RidgeOptions<'_>,
    options: &Options<'_>,
) -> Result<RidgeAxis, EngineError> {
    let cell = options.cell.unwrap_or_else(|| default_cell(domain));
    let frame = exterior_frame(domain, ridge.margin)?;
    let margin = ((frame.max.x - domain.bounds().max.x) / cell).ceil().max(1.0);
    // A margin of too many cells is found out by the grid.
    let grid = grid_around(domain, cell, margin as u32)?;
    let covered = digitise(domain, &grid).map_err(DigitiseError::from)?.bits;
    let mut inside = Bits::new(grid.columns, grid.rows);
    for y in 0..grid.rows {
        inside.set_run(y, 0, grid.columns);
        covered.runs(y).for_each(|(from, to)| inside.clear_run(y, from, to));
    }
    let boundary = line_cells(domain, &grid).map_err(DigitiseError::from)?.bits;
    let outside = Complement::new(domain, &frame).map_err(|_| {
        let place = domain.edges().first().map(|edge| edge.start).unwrap_or_default();
        EngineError::Internal { stage: "turning a domain inside out", place }
    })?;
    let is_kept = |walk: &crate::domain::Walk| !outside.is_frame(walk.first);
    let rings = rings::of_domain(outside.domain(), ridge.curves, is_kept);
    let shape = Shape { grid, inside, boundary, rings, straight };
    let ridges = Ridges::new(shape, start, ridge, options)?;
    ridges.axis(ridge, |grid| DomainBoundary::outside(&outside, grid))
}

/// The medial pixels of a mask, and the sampled axis made of them, with the edges of the mask's
/// [outline](crate::raster::outline) as sites.
///
/// ```
/// use medial::engine::{Options, RidgeOptions, ridge_following_of_mask};
/// use medial::raster::{Grid, Mask};
/// let mask = Mask::new(Grid::of_image(9, 3), |_, _| true)?;
/// let ridges = ridge_following_of_mask(&mask, &RidgeOptions::default(), &Options::default())?;
/// let middle: Vec<u32> = ridges.pixels.iter().filter(|p| p.row == 1).map(|p| p.column).collect();
/// assert_eq!(middle, [1, 2, 3, 4, 5, 6, 7]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the outside is asked for, or the options say to stop.
pub fn ridge_following_of_mask(
    mask: &Mask,
    ridge: &RidgeOptions<'_>,
    options: &Options<'_>,
) -> Result<RidgeAxis, EngineError> {
    let start = Instant::now();
    if ridge.side == Side::Exterior {
        return Err(EngineError::NoExterior { engine: Engine::RidgeFollowing });
    }
    let grid = *mask.grid();
    let cracks = Cracks::contours_of(&mask.bits);
    let shape = Shape {
        grid,
        inside: mask.bits.clone(),
        boundary: Bits::new(grid.columns, grid.rows),
        rings: rings::of_mask(&cracks, &grid),
        straight: [
            ridge.angle.unwrap_or(STRAIGHT_ANGLE_OF_MASKS),
            ridge.drift.unwrap_or(DRIFT_OF_MASKS),
        ],
    };
    let ridges = Ridges::new(shape, start, ridge, options)?;
    let features = features_of(mask, options);
    let cracks = Cracks::new(&mask.bits);
    let boundary = OutlineBoundary { mask, features: &features, cracks: &cracks };
    ridges.axis(ridge, |_| boundary)
}

/// What was found, before it is an axis.
struct Ridges {
    grid: Grid,
    boundary: Bits,
    medial: Medial,
    n_found: usize,
    n_components: u32,
    n_tested: u64,
    n_edges: usize,
    times: RidgeTimes,
}

impl Ridges {
    /// Follows the ridges of a shape, and thins them.
    fn new(
        shape: Shape,
        start: Instant,
        ridge: &RidgeOptions<'_>,
        options: &Options<'_>,
    ) -> Result<Self, EngineError> {
        let watch = Watch::new(options);
        watch.check_now()?;
        let Shape { grid, inside, boundary, rings, straight } = shape;
        let cell = grid.cell_size();
        let [angle, drift] = straight;
        let (sine, drift) = (angle.sin(), drift * cell);
        let merging = Merging { sine, drift, corner_drift: drift.max(CORNER_DRIFT * cell) };
        let edges = Edges::new(&rings, grid.origin, merging, ridge.pairs, cell);
        let mut open = inside;
        for y in 0..grid.rows {
            boundary.ones(y).for_each(|x| open.clear(x as i32, y as i32));
        }
        let mut field = Field {
            grid: &grid,
            open,
            boundary,
            checked: Bits::new(grid.columns, grid.rows),
            searcher: Searcher::new(&edges, ridge.search),
            tolerance: cell * (1.0 + VERY_SMALL),
            watch: &watch,
            found: Vec::new(),
            components: 0,
            n_tested: 0,
            stack: Vec::new(),
        };
        let mut clock = Clock { last: start };
        let mut times = RidgeTimes { initialise: clock.lap(), ..RidgeTimes::default() };
        if edges.has_pairs() {
            for (point, bounds) in edges.seeds() {
                field.first(point, bounds)?;
                times.first += clock.lap();
                field.rest()?;
                times.follow += clock.lap();
            }
            field.scan()?;
            times.scan = clock.lap();
        }
        let n_found = field.found.len();
        if ridge.thinning == RidgeThinning::Queue {
            field.take_islands()?;
        }
        let found = std::mem::take(&mut field.found);
        let mut medial = Medial::new(found, field.boundary.clone(), ridge.side == Side::Exterior);
        match ridge.thinning {
            RidgeThinning::Queue => medial.thin_by_queue(&field)?,
            RidgeThinning::Report => medial.thin_by_passes(&field)?,
            RidgeThinning::FiveByFive => medial.thin_five_by_five(&mut field)?,
            RidgeThinning::Full => {}
        }
        let medial = medial.shrink();
        times.thin = clock.lap();
        watch.check_now()?;
        let Field { boundary, components, n_tested, .. } = field;
        Ok(Self {
            grid,
            boundary,
            medial,
            n_found,
            n_components: components,
            n_tested,
            n_edges: edges.edges.len(),
            times,
        })
    }

    /// The axis, given who tells what boundary elements there are.
    fn axis<'a, B: Boundary>(
        &'a self,
        ridge: &RidgeOptions<'_>,
        names: impl FnOnce(&'a Grid) -> B,
    ) -> Result<RidgeAxis, EngineError> {
        let mut clock = Clock { last: Instant::now() };
        let Self { grid, boundary, medial, .. } = self;
        let mut graph = PixelGraph::of(&medial.bits);
        let crosses = |a: u32, b: u32| {
            let ([x1, y1], [x2, y2]) = (graph.cells[a as usize], graph.cells[b as usize]);
            let is_drawn = |x: u32, y: u32| boundary.get(x as i32, y as i32);
            x1 != x2 && y1 != y2 && is_drawn(x1, y2) && is_drawn(x2, y1)
        };
        let steps: Vec<[u32; 2]> =
            graph.steps.iter().copied().filter(|&[a, b]| !crosses(a, b)).collect();
        graph.steps = steps;
        match ridge.thinning {
            RidgeThinning::FiveByFive => graph.steps.clear(),
            RidgeThinning::Queue => {
                // One node for each junction.
                let radius = |cell| medial.radius(cell) / grid.cell[0].abs();
                graph.drop_stubs(grid.aspect(), radius);
                graph.join_junctions(radius);
            }
            RidgeThinning::Report | RidgeThinning::Full => {}
        }
        let cell = grid.cell_size();
        let label =
            Label { engine: Engine::RidgeFollowing, side: ridge.side, complete: false, cell };
        let names = names(grid);
        let boundary = Measured { names, medial, grid };
        let axis = axis_of_cells(&graph, grid, &boundary, label)?;
        Ok(RidgeAxis {
            axis,
            grid: *grid,
            pixels: medial.pixels.clone(),
            n_found: self.n_found,
            n_components: self.n_components,
            n_tested: self.n_tested,
            n_edges: self.n_edges,
            times: RidgeTimes { assemble: clock.lap(), ..self.times },
        })
    }
}

/// Tells the time from one phase to the next.
struct Clock {
    last: Instant,
}

impl Clock {
    fn lap(&mut self) -> Duration {
        let now = Instant::now();
        let lap = now.duration_since(self.last);
        self.last = now;
        lap
    }
}

/// Boundary elements with the distances that were found from merged edges.
struct Measured<'a, B> {
    names: B,
    medial: &'a Medial,
    grid: &'a Grid,
}

impl<B: Boundary> Boundary for Measured<'_, B> {
    fn foot(&self, x: i32, y: i32) -> Foot {
        let foot = self.names.foot(x, y);
        let centre = self.grid.centre(x as u32, y as u32);
        let own = self.medial.number(x as u32, y as u32).map(|k| &self.medial.pixels[k]);
        // A better point within the pixel has another distance than the centre.
        match own.filter(|pixel| pixel.position == centre) {
            Some(pixel) => Foot { radius: pixel.radius, ..foot },
            None => foot,
        }
    }

    fn beside(&self, x: i32, y: i32, from: [i32; 2]) -> u32 {
        self.names.beside(x, y, from)
    }

    fn len(&self) -> u32 {
        self.names.len()
    }

    fn record(&self, element: u32) -> Site {
        self.names.record(element)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain;
    use crate::geom::Point;
    use std::f64::consts::TAU;

    /// A star with corners at random distances, and holes in it that may not fit.
    fn star(seed: u64) -> Option<Domain> {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut unit = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 33) as f64 / f64::from(u32::MAX >> 1)
        };
        let mut ring = |at: Point, size: f64, n: u32| -> Vec<Point> {
            let angle = |k: u32| f64::from(k) * TAU / f64::from(n);
            (0..n)
                .map(|k| (angle(k).sin_cos(), size * (0.2 + unit())))
                .map(|((sin, cos), r)| at + Point::new(cos, sin) * r)
                .collect()
        };
        let n = 3 + (seed % 40) as u32;
        let mut rings = vec![ring(Point::default(), 10.0, n)];
        for k in 0..seed % 4 {
            let at = Point::new(k as f64 * 2.0 - 2.0, (seed % 5) as f64 - 2.0);
            rings.push(ring(at, 0.9, 3 + (seed % 9) as u32));
        }
        Domain::from_polygons(&[rings], &domain::Options::default()).ok()
    }

    #[test]
    fn no_medial_pixel_is_missed() {
        let mut compared = 0;
        for (seed, domain) in (0..120).filter_map(|seed| star(seed).map(|domain| (seed, domain))) {
            let cell = 20.0 / (40.0 + (seed % 60) as f64);
            let options = Options { cell: Some(cell), ..Options::default() };
            for pairs in [RidgePairs::Linked, RidgePairs::Adjacent] {
                let thinning = RidgeThinning::Full;
                let ridge = RidgeOptions { pairs, thinning, ..RidgeOptions::default() };
                let found = ridge_following(&domain, &ridge, &options).unwrap();
                // Every pixel inside that is not drawn.
                let grid = found.grid;
                let inside = digitise(&domain, &grid).unwrap().bits;
                let drawn = line_cells(&domain, &grid).unwrap().bits;
                let rings = rings::of_domain(&domain, None, |_| true);
                let merging =
                    Merging { sine: STRAIGHT_ANGLE.sin(), drift: 0.5 * cell, corner_drift: cell };
                let edges = Edges::new(&rings, grid.origin, merging, pairs, cell);
                let mut searcher = Searcher::new(&edges, RidgeSearch::Sorted);
                let mut expected = Vec::new();
                for y in 0..grid.rows {
                    for x in inside.ones(y).filter(|&x| !drawn.get(x as i32, y as i32)) {
                        let two = searcher.two(grid.centre(x, y) - grid.origin);
                        if two.quality() < cell * (1.0 + VERY_SMALL) {
                            expected.push((y, x));
                        }
                    }
                }
                let places: Vec<(u32, u32)> =
                    found.pixels.iter().map(|pixel| (pixel.row, pixel.column)).collect();
                let missed: Vec<_> =
                    expected.iter().filter(|place| !places.contains(place)).collect();
                assert!(missed.is_empty(), "{seed} {pairs:?}: {missed:?} of {}", expected.len());
                assert_eq!(places.len(), expected.len(), "{seed} {pairs:?}");
                compared += 1;
            }
        }
        assert!(compared > 80, "{compared}");
    }
}
