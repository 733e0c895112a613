//! The dual of the Delaunay graph of samples of the boundary [ASM09].
//!
//! # Contract
//! The axis has the components and cycles of the domain, whatever the spacing; where the boundary touches itself it
//! goes through that point between corners less than 180 degrees wide. Polygons that share a part of an edge are pieces of
//! their own. Distances of keypoints from the boundary are
//! within the spacing of their radii, and with the spacing the axis tends to the exact one.
//! A mask is taken as the polygon through the middles of the cracks of its outline: cells that touch at a corner hang
//! together, holes do not. Expected O(n log n) for n samples.
//!
//! # Method
//! 1. All corners, and points between them at most `spacing` apart, are samples; of a mask the middles of cracks and
//!    points between them, half a cell apart or less, whose coordinates are short binary fractions.
//! 2. Their Delaunay triangulation ([`Delaunay`]), in which neighbours along the boundary are joined. Where they are
//!    not of themselves the sampling is too coarse, which [`Sampling`] tells.
//! 3. The dual graph by the rules of [ASM09, §III], in their order: a node for each triangle inside; one for all
//!    triangles on one circle, decided exactly, or on circles whose centres are rounded to one point; at vertices of more than two boundary edges a node of its own, joined
//!    to the triangles between two of these, or to their circle; an edge between nodes on both sides of an inner edge.
//! 4. Nodes move from the middles of their triangles to the centres of their circles, so edges of the dual graph
//!    become Voronoi edges; the elements that their two samples lie on govern them.
//! 5. Branches into corners of a domain go on to these from the centre of the last circle.
//! 6. Leaves go, if that is asked for, by the chord residual [OK95], or those of one triangle [ASM09, §VII].
//!
//! # Departures
//! [ASM09] finds the boundary by the crust, which it has no other way to know. Here boundary edges are known and kept,
//! so that the dual graph is right with any samples; the crust is what tells where they are too few.
//!
//! Rule 3 joins a shared vertex to any circle through it; here only to one that lies between two boundary edges, as
//! rule 4 says of triangles: others lie in corners wider than half a turn, which no branch enters.
//!
//! Where a circle has its centre beyond the boundary, because that is nearer to itself than samples are apart, the node
//! is the centre of the circle that touches that edge.

mod axis;
mod crust;
mod dual;
mod residuals;
mod samples;
mod smooth;

use super::draft::site_record;
use super::exterior::exterior_frame;
use super::sampled::{outline_record, outside_record};
use super::watch::Watch;
use super::{EngineError, Options};
use crate::axis::{MedialAxis, Side};
use crate::domain::{self, Complement, Domain, Site};
use crate::geom::{Blocked, Delaunay, Point, Rect, parted, signed_area};
use crate::raster::{Cracks, Mask, default_cell};
use axis::{Drawn, Label};
pub use crust::{Border, border, crust, two_step_crust};
pub use dual::DualKind;
use dual::{Dual, DualEdge};
use residuals::{Left, residuals};
use samples::{Plane, Samples};
use std::collections::{BTreeSet, HashSet};

/// The distance between samples of masks where nothing else is said, in sides of a cell: with it the crust of
/// silhouettes has all their edges and, of others, little more than one in a thousand.
const MASK_SPACING: f64 = 0.5;

/// How often the way a border is smoothed or drawn back is halved before it stays where it is.
const HALVINGS: i32 = 5;

/// How dense samples have to be for the crust to be the boundary, as a share of the distance from the axis \[ABE98\].
const DENSE: f64 = 0.252;

/// A node of the dual graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualNode {
    /// What it is, by its degree.
    pub kind: DualKind,
    /// The middle of the corners of its triangles, where the dual graph has it.
    pub middle: Point,
    /// Where the axis has it.
    pub position: Point,
    /// How far that is from the samples.
    pub radius: f64,
    /// How many sides of it lie on the boundary.
    pub n_walls: usize,
}

/// What leaves a dual graph before it becomes an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DualPruning {
    /// Nothing.
    Nothing,
    /// Leaves that are one triangle beside a ramification.
    Leaves,
    /// Leaves for as long as their chord residual is no more than this, in units of the input.
    Chord(f64),
}

/// How well samples stand for the boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sampling {
    /// How many samples there are.
    pub n_samples: usize,
    /// The largest distance between neighbours, in units of the input.
    pub spacing: f64,
    /// Pairs of neighbours that are not joined in the Delaunay graph of the samples.
    pub n_missing: usize,
    /// Pairs of neighbours that are not in the crust.
    pub n_outside_crust: usize,
    /// Edges of the crust that join no neighbours.
    pub n_false_crust: usize,
    /// Pairs of neighbours farther apart than twice 0.252 of the distance between their middle and the nearer
    /// Voronoi vertex beside them, which bounds the local feature size from above: where samples are not dense enough
    /// for the theorem of \[ABE98\].
    pub n_sparse: usize,
    /// The first of these.
    pub first_sparse: Option<Point>,
}

/// Samples of a boundary, their Delaunay graph, and the dual graph of what of it is inside.
#[derive(Debug)]
pub struct DelaunayDual<'a> {
    source: Source<'a>,
    /// Where the axis outside ends.
    frame: Option<Rect>,
    samples: Samples,
    plane: Plane,
    triangles: Delaunay,
    n_missing: u32,
    dual: Dual,
    disks: Vec<(Point, f64)>,
    spacing: f64,
}

/// What is sampled.
#[derive(Debug)]
enum Source<'a> {
    Domain(&'a Domain),
    Outside(Box<Complement>),
    Mask(&'a Mask, Box<Cracks>),
}

impl<'a> DelaunayDual<'a> {
    /// The dual graph of a domain, sampled as the options say.
    ///
    /// ```
    /// use medial::domain::{self, Domain};
    /// use medial::engine::{DelaunayDual, DualKind, DualPruning, Options};
    /// use medial::geom::Point;
    /// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
    /// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &domain::Options::default())?;
    /// let options = Options { spacing: Some(0.25), ..Options::default() };
    /// let dual = DelaunayDual::new(&domain, &options)?;
    /// let nodes = dual.nodes();
    /// let count = |kind| nodes.iter().filter(|node| node.kind == kind).count();
    /// // An end in each corner, and two circles of radius 1 that touch three sides.
    /// assert_eq!((count(DualKind::Dangling), count(DualKind::RamificationI)), (4, 2));
    /// // The axis goes on into the four corners.
    /// assert_eq!(dual.axis(DualPruning::Nothing)?.keypoints().len(), nodes.len() + 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the spacing is none, makes too many samples, or puts them on other edges by rounding, or the options say to
    /// stop.
    pub fn new(domain: &'a Domain, options: &Options<'_>) -> Result<Self, EngineError> {
        let spacing = options.spacing.unwrap_or_else(|| default_cell(domain));
        Self::sampled(Source::Domain(domain), None, spacing, &Watch::new(options))
    }

    /// The dual graph of the outside of a domain, sampled as the options say. Its axis ends at a frame, as that of
    /// [`exterior`](super::exterior()).
    ///
    /// # Errors
    /// Those of [`new`](Self::new), and if the margin makes no frame.
    pub fn outside(
        domain: &Domain,
        margin: Option<f64>,
        options: &Options<'_>,
    ) -> Result<Self, EngineError> {
        let spacing = options.spacing.unwrap_or_else(|| default_cell(domain));
        let frame = exterior_frame(domain, margin)?;
        let outside = Complement::new(domain, &frame).map_err(|_| {
            let place = domain.edges().first().map(|edge| edge.start).unwrap_or_default();
            EngineError::Internal { stage: "turning a domain inside out", place }
        })?;
        let source = Source::Outside(Box::new(outside));
        Self::sampled(source, Some(frame), spacing, &Watch::new(options))
    }

    /// The dual graph of what is to the left of the walks of a domain.
    fn sampled(
        source: Source<'a>,
        frame: Option<Rect>,
        spacing: f64,
        watch: &Watch<'_>,
    ) -> Result<Self, EngineError> {
        // Edges that are taken whole, as points between their ends would come to lie on others by rounding.
        let mut whole = BTreeSet::new();
        let mut touched = None;
        loop {
            let (domain, walks) = match &source {
                Source::Domain(domain) => (*domain, domain.walks()),
                Source::Outside(outside) => (outside.domain(), &outside.domain().walks()[1..]),
                Source::Mask(..) => break Err(EngineError::Spacing { spacing }),
            };
            let touched: &Option<Vec<_>> = touched.get_or_insert_with(|| domain.touched_edges());
            let touched = touched.as_deref();
            let samples = Samples::of_walks(domain, walks, spacing, touched, &whole)?;
            watch.check_now()?;
            let crowded = match triangulated(&samples, watch)? {
                Ok(graph) => match samples.merged(domain, &graph.0) {
                    merged if merged.is_empty() => {
                        let spacing = match whole.is_empty() {
                            true => spacing,
                            false => samples.gap().max(spacing),
                        };
                        let plane = Plane::Given;
                        return Self::of(source, frame, samples, plane, graph, spacing, watch);
                    }
                    merged => merged,
                },
                Err(crowded) => crowded.to_vec(),
            };
            let before = whole.len();
            whole.extend(crowded.iter().filter_map(|&k| samples.edge_within(domain, k)));
            if whole.len() == before {
                let place = samples.points[crowded[0] as usize];
                return Err(EngineError::Crowded { place });
            }
        }
    }

    /// The dual graph of a mask, whose outline is sampled as the options say, at least once a crack.
    ///
    /// # Errors
    /// If the spacing is none or makes too many samples, or the options say to stop.
    pub fn of_mask(mask: &'a Mask, options: &Options<'_>) -> Result<Self, EngineError> {
        Self::of_smoothed_mask(mask, 0.0, options)
    }

    /// The same for an outline that is smoothed by a Gaussian of that width along it, in sides of cells. No sample moves
    /// by more than a quarter of the shorter side of these, so components and holes stay.
    ///
    /// # Errors
    /// Those of [`of_mask`](Self::of_mask).
    pub fn of_smoothed_mask(
        mask: &'a Mask,
        width: f64,
        options: &Options<'_>,
    ) -> Result<Self, EngineError> {
        let watch = Watch::new(options);
        let cracks = Cracks::contours_of(&mask.bits);
        watch.check_now()?;
        let plane = Plane::of_cells(mask.grid());
        let size = mask.grid().cell_size();
        let mut spacing = options.spacing.unwrap_or(MASK_SPACING * size);
        let mut samples = Samples::of_cracks(&mask.bits, &cracks, plane.factors(), spacing / size)?;
        // However dense they are, samples cut off corners of cells, which are up to a third of a cell away.
        spacing = spacing.max(MASK_SPACING * size);
        let source = Source::Mask(mask, Box::new(cracks));
        if width <= 0.0 {
            let graph = graph_of(&samples, &plane, &watch)?;
            return Self::of(source, None, samples, plane, graph, spacing, &watch);
        }
        let given = samples.points.clone();
        // Where cells are no squares, the plane of samples has the size of the cells.
        let [longer, shorter] = [size, mask.grid().shorter_side()].map(|v| v / plane.unit());
        let moved = smooth::average(&mut samples, width * longer, shorter);
        watch.check_now()?;
        let (graph, share) =
            as_far_as(&mut samples, &given, |samples, _| graph_of(samples, &plane, &watch))?;
        spacing += share * moved * plane.unit();
        Self::of(source, None, samples, plane, graph, spacing, &watch)
    }

    /// The same with the border drawn back to where hairs begin \[TG00\]: what lies behind branches with a chord residual
    /// of no more than this, in units of the input, becomes arcs of the circles where these begin, or nearly.
    ///
    /// A border that would meet itself is drawn back less far. The elements that govern the axis are those of the border
    /// as it was.
    ///
    /// # Errors
    /// [`EngineError::Crowded`] if the border would come to lie on itself, or the options say to stop.
    pub fn retracted(self, residual: f64, options: &Options<'_>) -> Result<Self, EngineError> {
        let left = self.left(DualPruning::Chord(residual));
        let Self { source, frame, mut samples, plane, triangles, dual, disks, spacing, .. } = self;
        let given = samples.points.clone();
        let moved = smooth::retract(&mut samples, &triangles, &dual, &disks, &left);
        let watch = Watch::new(options);
        // Rings of polygons may touch as they are given, those around cells do not.
        let may_touch = !matches!(source, Source::Mask(..));
        let (graph, share) = as_far_as(&mut samples, &given, |samples, is_moved| {
            let is_border = || {
                let polygons = grouped(&source, &plane, samples);
                is_border(&polygons, samples.rings.len(), may_touch)
            };
            if is_moved && !is_border() {
                return Err(crowded(samples, &plane, 0));
            }
            graph_of(samples, &plane, &watch)
        })?;
        let spacing = spacing + share * moved * plane.unit();
        Self::of(source, frame, samples, plane, graph, spacing, &watch)
    }

    fn of(
        source: Source<'a>,
        frame: Option<Rect>,
        samples: Samples,
        plane: Plane,
        (triangles, n_missing): (Delaunay, u32),
        spacing: f64,
        watch: &Watch<'_>,
    ) -> Result<Self, EngineError> {
        watch.check_now()?;
        let mut inner = HashSet::new();
        let (dual, disks) = loop {
            let dual = Dual::new(&triangles, &samples, &inner);
            watch.check_now()?;
            let disks = dual::disks(&triangles, &dual);
            watch.check_now()?;
            let before = inner.len();
            let n = disks.len() as u32;
            let edges = dual.edges.iter().filter(|edge| edge.from.max(edge.to) < n);
            inner.extend(edges.filter(|edge| is_one(edge, &disks, &plane)).map(|edge| edge.across));
            if inner.len() == before {
                break (dual, disks);
            }
        };
        Ok(Self { source, frame, samples, plane, triangles, n_missing, dual, disks, spacing })
    }

    /// The samples, ring by ring, in the plane of the input.
    #[must_use]
    pub fn samples(&self) -> Vec<Vec<Point>> {
        placed(&self.plane, &self.samples)
    }

    /// The border as it was sampled, smoothed or drawn back: polygons of samples in the plane of the input, each of rings
    /// with the shape on their left, the outer one first; of the outside a polygon for each ring.
    #[must_use]
    pub fn border(&self) -> Vec<Vec<Vec<Point>>> {
        grouped(&self.source, &self.plane, &self.samples)
    }

    /// The nodes of the dual graph.
    #[must_use]
    pub fn nodes(&self) -> Vec<DualNode> {
        let kinds = self.dual.kinds();
        let mut outline = Vec::new();
        let group = |(node, &(centre, radius)): (usize, &(Point, f64))| {
            self.dual.outline(&self.triangles, node as u32, &mut outline);
            let corners = outline.iter().map(|&e| self.triangles.point(self.triangles.origin(e)));
            let sum = corners.fold(Point::default(), |sum, p| sum + p);
            DualNode {
                kind: kinds[node],
                middle: self.plane.place(sum * (1.0 / outline.len() as f64)),
                position: self.plane.place(centre),
                radius: radius * self.plane.unit(),
                n_walls: outline.iter().filter(|&&edge| self.triangles.is_kept(edge)).count(),
            }
        };
        let mut nodes: Vec<DualNode> = self.disks.iter().enumerate().map(group).collect();
        let shared = (0..self.dual.shared.len()).map(|k| {
            let middle = self.plane.place(self.triangles.point(self.dual.shared[k].0));
            let n_walls = 2 * self.dual.spokes_of(k).len();
            let kind = DualKind::RamificationII;
            DualNode { kind, middle, position: middle, radius: 0.0, n_walls }
        });
        nodes.extend(shared);
        nodes
    }

    /// The edges of the dual graph, as pairs of nodes; without those to infinity.
    pub fn edges(&self) -> impl Iterator<Item = [u32; 2]> {
        let n = (self.disks.len() + self.dual.shared.len()) as u32;
        let pairs = self.dual.edges.iter().map(|edge| [edge.from, edge.to]);
        pairs.filter(move |[_, to]| *to < n)
    }

    /// The edges of the Delaunay graph inside, as pairs of points, and whether they are on the boundary.
    pub fn delaunay_edges(&self) -> impl Iterator<Item = ([Point; 2], bool)> {
        let inside = |edge: &u32| {
            let sides = [*edge, self.triangles.reversed(*edge)];
            sides.iter().any(|&side| self.dual.group_on_left(&self.triangles, side) != dual::NONE)
        };
        self.triangles.edges().filter(inside).map(|edge| {
            let ends = [self.triangles.origin(edge), self.triangles.target(edge)];
            let ends = ends.map(|vertex| self.plane.place(self.triangles.point(vertex)));
            (ends, self.triangles.is_kept(edge))
        })
    }

    /// The edges of the one-step crust of the samples, as pairs of points: those that tell the boundary from the samples
    /// alone, inside and outside.
    pub fn crust_edges(&self) -> impl Iterator<Item = [Point; 2]> {
        self.triangles.edges().filter(|&edge| self.triangles.is_crust(edge)).map(|edge| {
            let ends = [self.triangles.origin(edge), self.triangles.target(edge)];
            ends.map(|vertex| self.plane.place(self.triangles.point(vertex)))
        })
    }

    /// How well the samples stand for the boundary.
    #[must_use]
    pub fn sampling(&self) -> Sampling {
        let (triangles, unit) = (&self.triangles, self.plane.unit());
        let mut sampling = Sampling {
            n_samples: self.samples.points.len(),
            spacing: 0.0,
            n_missing: self.n_missing as usize,
            n_outside_crust: 0,
            n_false_crust: 0,
            n_sparse: 0,
            first_sparse: None,
        };
        for edge in triangles.edges().filter(|&edge| !triangles.is_kept(edge)) {
            sampling.n_false_crust += usize::from(triangles.is_crust(edge));
        }
        sampling.spacing = self.samples.gap() * unit;
        for &wall in &self.dual.walls {
            let [a, b] =
                [triangles.origin(wall), triangles.target(wall)].map(|v| triangles.point(v));
            let (middle, length) = ((a + b) * 0.5, (b - a).norm());
            sampling.n_outside_crust += usize::from(!triangles.is_crust(wall));
            let centres = [wall, triangles.reversed(wall)].map(|edge| triangles.left(edge));
            let finite = centres.into_iter().filter(|&face| face < triangles.n_faces());
            let away = finite.map(|face| (triangles.circle(face).0 - middle).norm());
            let feature = away.fold(f64::INFINITY, f64::min);
            if length > 2.0 * DENSE * feature {
                sampling.n_sparse += 1;
                sampling.first_sparse = sampling.first_sparse.or(Some(self.plane.place(middle)));
            }
        }
        sampling
    }

    /// What pruning leaves of the dual graph.
    fn left(&self, pruning: DualPruning) -> Left {
        let Self { samples, triangles, dual, plane, .. } = self;
        match pruning {
            DualPruning::Nothing => Left::all(dual),
            DualPruning::Leaves => Left::without_leaves(dual),
            DualPruning::Chord(most) => {
                let residuals = residuals(triangles, samples, dual);
                let most = most / plane.unit();
                Left::without(dual, |edge| residuals[edge as usize] <= most)
            }
        }
    }

    /// The axis: what pruning leaves of the dual graph, its edges replaced by Voronoi edges.
    ///
    /// # Errors
    /// If there are more elements than 32-bit numbers tell apart.
    pub fn axis(&self, pruning: DualPruning) -> Result<MedialAxis, EngineError> {
        let Self { samples, triangles, dual, disks, plane, .. } = self;
        let left = self.left(pruning);
        let (plane, frame) = (*plane, self.frame);
        // What lies beyond the last circle of a branch into a corner has less than any residual.
        let ends = pruning == DualPruning::Nothing && !matches!(self.source, Source::Mask(..));
        let drawn = Drawn { samples, triangles, dual, disks, plane, frame, left: &left, ends };
        // Outside, the boundary has parts that no disk within the frame is near.
        let complete = pruning == DualPruning::Nothing && self.frame.is_none();
        let spacing = self.spacing;
        let label = |side| Label { side, complete, spacing };
        match &self.source {
            Source::Domain(domain) => {
                let record = |element| site_record(domain, Site(element));
                drawn.axis(2 * domain.edges().len(), record, &label(Side::Interior))
            }
            Source::Outside(outside) => {
                let record = |element| outside_record(outside.domain(), Site(element));
                let n_elements = 2 * outside.domain().edges().len();
                drawn.axis(n_elements, record, &label(Side::Exterior))
            }
            Source::Mask(mask, cracks) => {
                let record = |element| outline_record(cracks, mask.grid(), element);
                drawn.axis(cracks.edges.len(), record, &label(Side::Interior))
            }
        }
    }
}

/// Whether the circles at both ends of an edge of the dual graph have one centre, as rounded.
fn is_one(edge: &DualEdge, disks: &[(Point, f64)], plane: &Plane) -> bool {
    let [a, b] = [edge.from, edge.to].map(|node| plane.place(disks[node as usize].0));
    a == b
}

/// The triangulation of samples in which neighbours are joined, and how many are not of themselves; or samples that
/// are in the way of one another.
fn triangulated(
    samples: &Samples,
    watch: &Watch<'_>,
) -> Result<Result<(Delaunay, u32), [u32; 4]>, EngineError> {
    let triangles = Delaunay::new_unless(&samples.points, || watch.is_over());
    watch.check_now()?;
    let Some(mut triangles) = triangles else { return Ok(Err([0; 4])) };
    let vertex = |sample: u32| triangles.vertex_of(sample);
    let pairs: Vec<(u32, u32)> = samples.pairs().map(|(a, b)| (vertex(a), vertex(b))).collect();
    Ok(match triangles.constrain(pairs) {
        Ok(n_missing) => Ok((triangles, n_missing)),
        Err(Blocked { pair: [a, b], by: [c, d] }) => {
            Err([a, b, c, d].map(|vertex| triangles.point_of(vertex)))
        }
    })
}

/// The samples, ring by ring, in the plane of the input.
fn placed(plane: &Plane, samples: &Samples) -> Vec<Vec<Point>> {
    let ring = |ring: &std::ops::Range<u32>| {
        ring.clone().map(|k| plane.place(samples.points[k as usize])).collect()
    };
    samples.rings.iter().map(ring).collect()
}

/// The same as polygons; see [`DelaunayDual::border`].
fn grouped(source: &Source<'_>, plane: &Plane, samples: &Samples) -> Vec<Vec<Vec<Point>>> {
    let mut rings = placed(plane, samples);
    if plane.is_mirrored() {
        rings.iter_mut().for_each(|ring| ring[1..].reverse());
    }
    // The polygon of each ring, and whether the ring is a hole of it.
    let of: Vec<(u32, bool)> = match source {
        Source::Domain(domain) => {
            domain.walks().iter().map(|walk| (walk.component, walk.hole)).collect()
        }
        Source::Outside(_) => (0..rings.len() as u32).map(|ring| (ring, false)).collect(),
        Source::Mask(_, cracks) => {
            cracks.contours.iter().map(|ring| (ring.polygon, ring.ring > 0)).collect()
        }
    };
    let n = of.iter().map(|&(polygon, _)| polygon as usize + 1).max().unwrap_or(0);
    let mut polygons = vec![Vec::new(); n];
    for (ring, (polygon, is_hole)) in rings.into_iter().zip(of) {
        let polygon: &mut Vec<Vec<Point>> = &mut polygons[polygon as usize];
        // A walk along rings that touch is each of these, all but one of them holes.
        let parts = parted(ring);
        let is_one = parts.len() == 1;
        for part in parts {
            let is_outer = !is_hole && (is_one || signed_area(&part) > 0.0);
            polygon.insert(if is_outer { 0 } else { polygon.len() }, part);
        }
    }
    polygons
}

/// What is made of samples that were moved, as far as their boundary is not crowded: the way there is halved as often
/// as needed, and in the end they stay where they were. Gives the share of the way, too.
fn as_far_as<T>(
    samples: &mut Samples,
    given: &[Point],
    mut made: impl FnMut(&Samples, bool) -> Result<T, EngineError>,
) -> Result<(T, f64), EngineError> {
    let goal = samples.points.clone();
    for halvings in 0..HALVINGS {
        let share = 0.5_f64.powi(halvings);
        let between = |(&from, &to): (&Point, &Point)| from + (to - from) * share;
        if halvings > 0 {
            samples.points = given.iter().zip(&goal).map(between).collect();
        }
        match made(samples, true) {
            Err(EngineError::Crowded { .. }) => {}
            made => return made.map(|made| (made, share)),
        }
    }
    samples.points = given.to_vec();
    made(samples, false).map(|made| (made, 0.0))
}

/// The boundary is too near to itself at a sample.
fn crowded(samples: &Samples, plane: &Plane, sample: u32) -> EngineError {
    EngineError::Crowded { place: plane.place(samples.points[sample as usize]) }
}

/// Whether these are the polygons of a domain with so many walks, each with one outer ring.
fn is_border(polygons: &[Vec<Vec<Point>>], n_walks: usize, may_touch: bool) -> bool {
    if polygons.is_empty() {
        return true;
    }
    let options = domain::Options { strict: !may_touch, ..domain::Options::default() };
    let domain = Domain::from_polygons(polygons, &options);
    domain.is_ok_and(|domain| {
        let walks = domain.walks();
        walks.len() == n_walks && domain.n_components() == polygons.len()
    })
}

/// The triangulation of samples in a plane.
fn graph_of(
    samples: &Samples,
    plane: &Plane,
    watch: &Watch<'_>,
) -> Result<(Delaunay, u32), EngineError> {
    if samples.len() == 0 {
        return Ok((Delaunay::default(), 0));
    }
    triangulated(samples, watch)?.map_err(|at| crowded(samples, plane, at[0]))
}

/// The sampled medial axis of a domain, complete; see [`DelaunayDual`].
///
/// # Errors
/// Those of [`DelaunayDual::new`] and [`DelaunayDual::axis`].
pub fn delaunay_dual(domain: &Domain, options: &Options<'_>) -> Result<MedialAxis, EngineError> {
    DelaunayDual::new(domain, options)?.axis(DualPruning::Nothing)
}

/// The sampled medial axis of the outside of a domain, within a frame; see [`DelaunayDual::outside`].
///
/// # Errors
/// Those of [`DelaunayDual::outside`] and [`DelaunayDual::axis`].
pub(super) fn outside(
    domain: &Domain,
    margin: Option<f64>,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    DelaunayDual::outside(domain, margin, options)?.axis(DualPruning::Nothing)
}

/// The sampled medial axis of a mask, pruned by the chord residual of the options, if there is one; see
/// [`DelaunayDual`].
///
/// # Errors
/// Those of [`DelaunayDual::of_mask`] and [`DelaunayDual::axis`].
pub fn delaunay_dual_of_mask(
    mask: &Mask,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    let cell = mask.grid().cell_size();
    let pruning = match options.residual {
        Some(residual) => DualPruning::Chord(residual * cell),
        None => DualPruning::Nothing,
    };
    DelaunayDual::of_mask(mask, options)?.axis(pruning)
}
