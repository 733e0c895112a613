//! Samples of a boundary: rings of points that know what of it they lie on.

use std::collections::{BTreeSet, HashSet};
use std::ops::Range;

use crate::domain::{Corner, Domain, Site, Walk};
use crate::engine::EngineError;
use crate::geom::{Delaunay, Point};
use crate::raster::{Bits, Cracks, Grid};

/// Samples up to which a boundary can be triangulated: each needs some 200 bytes.
const MOST: f64 = 2e7;

/// Points along closed rings, with the shape to the left.
#[derive(Clone, Debug, Default)]
pub(super) struct Samples {
    pub points: Vec<Point>,
    /// The element that a sample lies on, twice; at a convex corner that before and that after it.
    pub elements: Vec<[u32; 2]>,
    pub rings: Vec<Range<u32>>,
    /// Those within an edge where another polygon has a sample too: a corner, or one on the same edge.
    pub touched: Vec<u32>,
}

impl Samples {
    /// Samples of walks, at most so far from one another: all corners, corners of other polygons that touch an edge, if
    /// any polygons touch, and points between them but on some edges.
    pub fn of_walks(
        domain: &Domain,
        walks: &[Walk],
        spacing: f64,
        touched: Option<&[(u32, Point)]>,
        whole: &BTreeSet<u32>,
    ) -> Result<Self, EngineError> {
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(EngineError::Spacing { spacing });
        }
        let stops = |edge: u32| {
            let touched = touched.unwrap_or_default();
            let from = touched.partition_point(|touch| touch.0 < edge);
            let to = from + touched[from..].partition_point(|touch| touch.0 == edge);
            touched[from..to].iter().map(|touch| touch.1)
        };
        // The pieces of an edge between these.
        let parts = |edge: u32| {
            let starts = std::iter::once(domain.edge(edge).start).chain(stops(edge));
            starts.zip(stops(edge).chain(std::iter::once(domain.end(edge))))
        };
        let pieces = |edge: u32, length: f64| match whole.contains(&edge) {
            false => (length / spacing).ceil().max(1.0),
            true => 1.0,
        };
        let edges = || walks.iter().flat_map(Walk::edges);
        let most =
            |edge: u32| pieces(edge, domain.edge(edge).length) + 2.0 * stops(edge).len() as f64;
        let n = edges().map(most).sum::<f64>();
        if n > MOST {
            return Err(EngineError::Samples { samples: n, spacing });
        }
        let bits = |p: Point| [p.x + 0.0, p.y + 0.0].map(f64::to_bits);
        let all: HashSet<_> = match touched {
            Some(_) => edges().flat_map(parts).map(|(a, b)| (bits(a), bits(b))).collect(),
            None => HashSet::new(),
        };
        let mut samples = Self::with_room(n as usize, walks.len());
        for walk in walks {
            let first = samples.len();
            for edge in walk.edges() {
                let sides = [domain.edge(edge).prev, edge].map(|edge| Site::edge(edge).0);
                let at_start = match domain.edge(edge).corner {
                    Corner::Convex => sides,
                    Corner::Reflex => [Site::corner(edge).0; 2],
                    Corner::Straight => [sides[1]; 2],
                };
                let within = [Site::edge(edge).0; 2];
                for (k, (from, to)) in parts(edge).enumerate() {
                    if k > 0 {
                        samples.touched.push(samples.len());
                    }
                    samples.push(from, if k == 0 { at_start } else { within });
                    let length = if k == 0 && to == domain.end(edge) {
                        domain.edge(edge).length
                    } else {
                        (to - from).norm()
                    };
                    let next = samples.len();
                    samples.push_between(from, to, pieces(edge, length), within);
                    // What two polygons share has the same samples on both sides.
                    if all.contains(&(bits(to), bits(from))) {
                        samples.touched.extend(next..samples.len());
                    }
                }
            }
            samples.rings.push(first..samples.len());
        }
        Ok(samples)
    }

    /// Points between two places, in so many pieces; the same ones on the way back.
    fn push_between(&mut self, from: Point, to: Point, pieces: f64, elements: [u32; 2]) {
        let is_forward = from.lexicographic(to).is_lt();
        let (low, high) = if is_forward { (from, to) } else { (to, from) };
        for k in 1..pieces as u32 {
            let k = if is_forward { f64::from(k) } else { pieces - f64::from(k) };
            self.push(low + (high - low) * (k / pieces), elements);
        }
    }

    /// Samples of the outline of a mask, at most so far from one another, in sides of cells: the middles of cracks,
    /// and points between these, twice as many where cells touch at a corner only: the outline leaves half a diagonal
    /// between them there. The plane is that of columns and rows, both times a factor.
    pub fn of_cracks(
        bits: &Bits,
        cracks: &Cracks,
        factors: [f64; 2],
        spacing: f64,
    ) -> Result<Self, EngineError> {
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(EngineError::Spacing { spacing });
        }
        // Halves of halves, so that all coordinates are short binary fractions. Cracks are at most 1 apart.
        let pieces = (1.0 / spacing).ceil().max(1.0).log2().ceil().exp2();
        let n = cracks.n_cracks as f64 * pieces;
        if n > MOST {
            return Err(EngineError::Samples { samples: n, spacing });
        }
        let mut samples = Self::with_room(n as usize, cracks.contours.len());
        let place = |[x, y]: [f64; 2]| Point::new(x * factors[0], y * factors[1]);
        let mut middles: Vec<([f64; 2], u32)> = Vec::new();
        for contour in 0..cracks.contours.len() as u32 {
            middles.clear();
            let number = cracks.contours[contour as usize].first;
            for (number, edge) in (number..).zip(cracks.edges_of(contour)) {
                let (from, to) = (edge.from(), cracks.end_of(number));
                let ways = [0, 1].map(|k| f64::from(to[k]) - f64::from(from[k]));
                // All of these are short binary fractions.
                let steps = ways.map(|way| if way == 0.0 { 0.0 } else { way.signum() });
                for k in 0..(ways[0].abs() + ways[1].abs()) as u32 {
                    let along = f64::from(k) + 0.5;
                    let middle = [0, 1].map(|k| f64::from(from[k]) + steps[k] * along);
                    middles.push((middle, number));
                }
            }
            let first = samples.len();
            for (k, &(from, edge)) in middles.iter().enumerate() {
                let (to, next) = middles[(k + 1) % middles.len()];
                let pieces = if is_pinched(bits, from, to) { 2.0 * pieces } else { pieces };
                for k in 0..pieces as u32 {
                    let share = f64::from(k) / pieces;
                    let point = [0, 1].map(|k| from[k] + (to[k] - from[k]) * share);
                    samples.push(place(point), [if share > 0.5 { next } else { edge }; 2]);
                }
            }
            samples.rings.push(first..samples.len());
        }
        Ok(samples)
    }

    fn with_room(samples: usize, rings: usize) -> Self {
        Self {
            points: Vec::with_capacity(samples),
            elements: Vec::with_capacity(samples),
            rings: Vec::with_capacity(rings),
            touched: Vec::new(),
        }
    }

    pub fn len(&self) -> u32 {
        self.points.len() as u32
    }

    fn push(&mut self, point: Point, elements: [u32; 2]) {
        self.points.push(point);
        self.elements.push(elements);
    }

    /// Whether a sample lies at a corner less than half a turn wide.
    pub fn is_convex(&self, sample: u32) -> bool {
        let [before, after] = self.elements[sample as usize];
        before != after
    }

    /// The edge between whose ends a sample lies, if it is one of no other polygon.
    pub fn edge_within(&self, domain: &Domain, sample: u32) -> Option<u32> {
        let site = Site(self.elements[sample as usize][0]);
        let is_within = site.is_edge()
            && !self.is_convex(sample)
            && self.touched.binary_search(&sample).is_err()
            && self.points[sample as usize] != domain.edge(site.index()).start;
        is_within.then(|| site.index())
    }

    /// Samples between corners that are where another one is.
    pub fn merged(&self, domain: &Domain, triangles: &Delaunay) -> Vec<u32> {
        if triangles.n_vertices() == self.len() {
            return Vec::new();
        }
        let known = |sample: u32| triangles.point_of(triangles.vertex_of(sample));
        let merged = (0..self.len()).map(|k| [k, known(k)]).filter(|[k, known]| k != known);
        let all = merged.flatten();
        all.filter(|&sample| self.edge_within(domain, sample).is_some()).collect()
    }

    /// The ring of a sample.
    pub fn ring_of(&self, sample: u32) -> &Range<u32> {
        let ring = self.rings.partition_point(|ring| ring.end <= sample);
        &self.rings[ring]
    }

    /// The samples before and after one along its ring.
    fn around(&self, sample: u32) -> [u32; 2] {
        let ring = self.ring_of(sample);
        let before = if sample == ring.start { ring.end } else { sample } - 1;
        let after = if sample + 1 == ring.end { ring.start } else { sample + 1 };
        [before, after]
    }

    /// The element at a sample that is nearer to a point: at a convex corner one of two edges.
    #[inline]
    pub fn element(&self, sample: u32, to: Point) -> u32 {
        let [before, after] = self.elements[sample as usize];
        if before == after { before } else { self.nearer(sample, to) }
    }

    fn nearer(&self, sample: u32, to: Point) -> u32 {
        let way = to - self.points[sample as usize];
        let elements = self.elements[sample as usize];
        elements[usize::from(self.bisector(sample).cross(way) < 0.0)]
    }

    /// The direction into a corner, between its two sides.
    pub fn bisector(&self, sample: u32) -> Point {
        let at = self.points[sample as usize];
        let [before, after] = self.around(sample).map(|k| {
            let way = self.points[k as usize] - at;
            way * (1.0 / way.norm())
        });
        // Near half a turn the sum of both says little.
        if before.dot(after) < 0.0 { (after - before).perp() } else { before + after }
    }

    /// All pairs of neighbours along rings.
    pub fn pairs(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.rings.iter().flat_map(|ring| {
            ring.clone().map(|k| (k, if k + 1 == ring.end { ring.start } else { k + 1 }))
        })
    }

    /// The largest distance between neighbours.
    pub fn gap(&self) -> f64 {
        let way = |(a, b): (u32, u32)| self.points[b as usize] - self.points[a as usize];
        self.pairs().map(|pair| way(pair).norm()).fold(0.0, f64::max)
    }

    /// The length of the ring from its first sample on to each one.
    pub fn along(&self) -> Vec<f64> {
        let mut along = vec![0.0; self.points.len()];
        for ring in &self.rings {
            for k in ring.start + 1..ring.end {
                let way = self.points[k as usize] - self.points[k as usize - 1];
                along[k as usize] = along[k as usize - 1] + way.norm();
            }
        }
        along
    }
}

/// Whether the outline turns, between the middles of two cracks, at a corner where cells touch.
fn is_pinched(bits: &Bits, from: [f64; 2], to: [f64; 2]) -> bool {
    if from[0] == to[0] || from[1] == to[1] {
        return false;
    }
    // Columns are whole on cracks between columns, rows on those between rows.
    let corner = if from[0].fract() == 0.0 { [from[0], to[1]] } else { [to[0], from[1]] };
    let [x, y] = corner.map(|at| at as i32);
    let [a, b, c, d] =
        [[x - 1, y - 1], [x, y - 1], [x - 1, y], [x, y]].map(|[x, y]| bits.get(x, y));
    a == d && b == c
}

/// From the plane of samples to that of the input.
#[derive(Clone, Copy, Debug)]
pub(super) enum Plane {
    Given,
    /// That of columns and rows times these factors, lengths there times a unit.
    Cells {
        grid: Grid,
        factors: [f64; 2],
        unit: f64,
    },
}

impl Plane {
    /// The plane of the cells of a grid: columns and rows, the longer sides of cells times their length in shorter ones.
    /// That is a short binary fraction, so that points of a lattice lie on one, and what is on one circle stays there.
    pub fn of_cells(grid: &Grid) -> Self {
        const STEPS: f64 = (1 << 24) as f64;
        let [width, height] = grid.cell.map(f64::abs);
        let unit = width.min(height);
        let factor = |side: f64| (side / unit * STEPS).round() / STEPS;
        let factors = if grid.is_square() { [1.0; 2] } else { [factor(width), factor(height)] };
        Self::Cells { grid: *grid, factors, unit }
    }

    pub fn place(&self, point: Point) -> Point {
        match self {
            Self::Given => point,
            Self::Cells { grid, factors, .. } => {
                grid.place(point.x / factors[0], point.y / factors[1])
            }
        }
    }

    /// What columns and rows are times.
    pub fn factors(&self) -> [f64; 2] {
        match self {
            Self::Given => [1.0; 2],
            Self::Cells { factors, .. } => *factors,
        }
    }

    /// What lengths are to be multiplied by.
    pub fn unit(&self) -> f64 {
        match self {
            Self::Given => 1.0,
            Self::Cells { unit, .. } => *unit,
        }
    }

    /// Whether left is right.
    pub fn is_mirrored(&self) -> bool {
        matches!(self, Self::Cells { grid, .. } if grid.is_mirrored())
    }
}
