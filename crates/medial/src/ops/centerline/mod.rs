//! The main lines of a shape: the best ways through its axis.
//!
//! # Contract
//! A line runs through what is left of the axis when blunt corners are taken away; which way it takes, is
//! a [`Route`].
//! - The longest runs between those two ends that are farthest apart, the way between them being the
//!   shortest. Without holes that is the longest path of the axis. Around holes the longest simple path is
//!   not to be had in reasonable time, nor is it what a river user expects, who passes each island once, on
//!   the shorter side; a ring without any end is one closed line.
//! - The best for a label is long and straight, and wide enough for a text along it: see `label.rs`.
//! - The way between points runs between the points of the axis that are nearest to them.
//!
//! A line can go on straight to the boundary, or to the points that were given. As a polyline
//! ([`polylines`]) it can be smoothed and simplified within a tolerance, and stays inside.
//!
//! # Method
//! 1. Ends: corners below a relative excess are pruned (`hierarchy/mod.rs`). A component that is pruned to a
//!    single point, or to no more than rounding leaves, keeps its whole axis instead; for the longest line it
//!    comes after all others.
//! 2. What is left is a graph of pieces of paths (`graph.rs`), in which the best way of each component is
//!    looked for (`longest.rs`, `label.rs`, `between.rs`).
//! 3. Further lines are the best ones that use no piece of those before.

mod between;
mod chains;
mod extend;
mod graph;
mod label;
mod line;
mod longest;
mod polyline;
mod simplify;
mod smooth;
mod wall;

pub use line::{Centerline, Widths};
pub use polyline::{LineOptions, polylines};

use super::hierarchy::{Hierarchy, HierarchyError};
use super::measure::Measure;
use super::rest::{Origin, Pruned, Rest};
use crate::axis::MedialAxis;
use crate::domain::Domain;
use crate::geom::{Point, Rect};
use graph::{Graph, Way};
use longest::HasCycles;

/// What lines are asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct CenterlineOptions {
    /// Which way they take.
    pub route: Route,
    /// How many lines, at most; between points there is one.
    pub count: usize,
    /// What lies below this value of a measure is no part of a line.
    pub ends: (Measure, f64),
    /// How far lines go on straight.
    pub extension: Extension,
}

impl Default for CenterlineOptions {
    /// The longest line, between ends sharper than some 84 degrees, inside the axis.
    fn default() -> Self {
        let (route, extension) = (Route::Longest, Extension::None);
        Self { route, count: 1, ends: (Measure::RelativeExcess, 0.5), extension }
    }
}

/// Which way through an axis is the best.
#[derive(Clone, Debug, PartialEq)]
pub enum Route {
    /// The longest.
    Longest,
    /// The best to set a text along.
    ///
    /// It stays where the text fits, and is worth its length less, for each radian by which it turns, the
    /// height of the text. How it turns is seen from as far as letters are: it is straightened within a
    /// quarter of the height before, and stretches between branchings that are shorter than half of it
    /// have no direction. In a rectangle it is the spine, in an L the longer arm, or both if a turn costs
    /// less than the shorter one brings.
    ///
    /// Each cycle is opened where it is narrowest: the text goes along the wider side of a hole.
    Label {
        /// The height of the text, in units of the input; by default half of the greatest width of the
        /// shape. Where the text is too high there is no line.
        height: Option<f64>,
    },
    /// The shortest between the points of the axis that are nearest to two points, or to those two of
    /// several that are farthest apart along the axis.
    ///
    /// Nearest is what is nearest of the points that are in sight: without the boundary in between. Where
    /// none is, and for a point outside, it is the nearest of all.
    Between(Vec<Point>),
}

/// How far a line goes on straight beyond the axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extension {
    /// Not at all.
    #[default]
    None,
    /// Up to the boundary, from ends that are not on another line, a cycle or the boundary already.
    Boundary,
    /// To the points of [`Route::Between`] that it belongs to. Other lines have no such points, and end with
    /// the axis.
    Anchors,
}

/// Why there are no lines.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CenterlineError {
    /// The axis is not a complete exact one of this domain.
    #[error(transparent)]
    Hierarchy(#[from] HierarchyError),
    /// There are not two points to run between.
    #[error("a line between points needs two of them at least")]
    FewPoints,
    /// A point lies outside the box around the domain, or is not finite.
    #[error("the point ({}, {}) lies outside its box, from ({}, {}) to ({}, {}); give a point inside",
        point.x, point.y, low.x, low.y, high.x, high.y)]
    Outside {
        /// The point.
        point: Point,
        /// The lower left corner of the box.
        low: Point,
        /// Its upper right corner.
        high: Point,
    },
    /// No way along the axis joins the points.
    #[error("the points ({}, {}) and ({}, {}) lie in parts that nothing joins; give points of one part",
        points[0].x, points[0].y, points[1].x, points[1].y)]
    Apart {
        /// Two of them.
        points: [Point; 2],
    },
    /// The axis has no paths to run along.
    #[error("the axis has no paths to run along")]
    NoAxis,
    /// The points are nearest to one point of the axis.
    #[error("the point of the axis at ({}, {}) is nearest to all points given; give points farther apart",
        nearest.x, nearest.y)]
    OnePlace {
        /// That point of the axis.
        nearest: Point,
    },
}

/// The main lines of a shape, the best first.
///
/// A component that is pruned to a single point has the best way through its whole axis; among the longest
/// lines it comes after those of all others. Around cycles a line may be longer than one before, as it uses no
/// piece of those.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{CenterlineOptions, Extension, Route, centerlines};
///
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// let options = CenterlineOptions { extension: Extension::Boundary, ..CenterlineOptions::default() };
/// let lines = centerlines(&domain, &axis, &options)?;
/// let mut ends = lines[0].polyline(0.01);
/// ends.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
/// assert_eq!((ends[0].0, ends.last().unwrap().0), (Point::new(0.0, 1.0), Point::new(6.0, 1.0)));
/// assert_eq!((lines[0].length(), lines[0].widths().mean), (6.0, 2.0));
///
/// // Between two points of the boundary, and on to them.
/// let banks = vec![Point::new(2.0, 0.0), Point::new(4.0, 2.0)];
/// let (route, extension) = (Route::Between(banks), Extension::Anchors);
/// let options = CenterlineOptions { route, extension, ..CenterlineOptions::default() };
/// let lines = centerlines(&domain, &axis, &options)?;
/// let points = lines[0].polyline(0.01);
/// assert_eq!((points[0].0, points[3].0), (Point::new(2.0, 0.0), Point::new(4.0, 2.0)));
/// assert!((lines[0].length() - 4.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not complete and exact, or not of this domain; for a line between points also if there
/// are fewer than two, if one lies outside the box of the domain, if they lie in different components,
/// or if one point of the axis is nearest to all of them.
pub fn centerlines(
    domain: &Domain,
    axis: &MedialAxis,
    options: &CenterlineOptions,
) -> Result<Vec<Centerline>, CenterlineError> {
    Hierarchy::new(domain, axis)?.centerlines(options)
}

impl Hierarchy<'_> {
    /// What [`centerlines`] gives, for who has the hierarchy already.
    ///
    /// # Errors
    /// If points between which a line is to run are too few, or in different components.
    pub fn centerlines(
        &self,
        options: &CenterlineOptions,
    ) -> Result<Vec<Centerline>, CenterlineError> {
        let (measure, value) = options.ends;
        let (rest, lost) = self.rest(measure, value);
        // Mostly there is one line to be found in one forest.
        if options.route == Route::Longest
            && options.count == 1
            && let Ok(line) = self.longest_in_forest(&rest)
        {
            let line = line.into_iter();
            return Ok(line.map(|line| extended(self.given, line, options)).collect());
        }
        best_lines(self, &rest.finish(&self.fire.roots, &lost), options)
    }

    /// The longest line through what is left of an axis without cycles; through all of it if that is no more than
    /// points.
    fn longest_in_forest(&self, rest: &Rest<'_>) -> Result<Option<Centerline>, HasCycles> {
        if !self.fire.is_all() {
            return Err(HasCycles);
        }
        let length = |path: u32| self.fire.lengths[path as usize];
        let line = match longest::in_forest(rest, length)? {
            Some((length, line)) if length > self.tiny() => Some((length, line)),
            _ => longest::in_forest(&Rest::of(self.axis), length)?,
        };
        Ok(line.map(|(_, line)| line))
    }

    /// A length that rounding may leave of what is pruned to a point.
    fn tiny(&self) -> f64 {
        /// As a share of the coordinates.
        const ROUNDING: f64 = 1.0 / (1_u64 << 40) as f64;
        let Rect { min, max } = self.given.bounds();
        ROUNDING * [min.x, min.y, max.x, max.y].map(f64::abs).into_iter().fold(0.0, f64::max)
    }
}

/// The best lines through what was left of an axis.
fn best_lines(
    hierarchy: &Hierarchy<'_>,
    Pruned { axis: pruned, origins, .. }: &Pruned,
    options: &CenterlineOptions,
) -> Result<Vec<Centerline>, CenterlineError> {
    let (domain, axis) = (hierarchy.given, hierarchy.axis);
    let [left, of_points] = graph::parts(pruned, axis, hierarchy.tiny());
    let parts = [(pruned, &left[..]), (axis, &of_points[..])];
    let count = options.count;
    let lines = match &options.route {
        Route::Between(points) => {
            let line = between::line(domain, parts, points, options)?;
            return Ok(if count > 0 { vec![line] } else { Vec::new() });
        }
        Route::Longest => {
            let length = |path: u32| match origins[path as usize] {
                Origin { path, part: [0.0, 1.0] } => hierarchy.fire.lengths[path as usize],
                _ => pruned.length_of(&pruned.paths().at(path)),
            };
            let graphs = [
                Graph::whole(pruned, &left, length),
                Graph::whole(axis, &of_points, |path| hierarchy.fire.lengths[path as usize]),
            ];
            ranked(graphs, count, longest::way, true)
        }
        Route::Label { height } => {
            let height = height.unwrap_or_else(|| pruned.radius_max());
            let graphs = parts.map(|(axis, paths)| label::graph(axis, paths, height));
            ranked(graphs, count, |graph, component| label::way(graph, component, height), false)
        }
    };
    Ok(lines.into_iter().map(|line| extended(domain, line, options)).collect())
}

fn extended(domain: &Domain, mut line: Centerline, options: &CenterlineOptions) -> Centerline {
    if options.extension == Extension::Boundary {
        line.extensions = extend::to_boundary(domain, &line);
    }
    line
}

/// A component of one of some graphs, with its best way.
struct Component {
    graph: usize,
    nodes: Vec<u32>,
    way: Way,
}

/// The best ways through two graphs, each without the pieces of those before; those through the second one after
/// all through the first, if these come first.
fn ranked<'a>(
    mut graphs: [Graph<'a>; 2],
    count: usize,
    best: impl Fn(&Graph<'a>, &[u32]) -> Option<Way>,
    first_comes_first: bool,
) -> Vec<Centerline> {
    let mut left = Vec::new();
    for (number, graph) in graphs.iter_mut().enumerate() {
        let all: Vec<u32> = graph.nodes().collect();
        left.extend(components(graph, number, &all, &best));
    }
    let mut lines = Vec::new();
    while lines.len() < count {
        let order = |&a: &usize, &b: &usize| {
            let (a, b) = (&left[a], &left[b]);
            let (by_graph, by_value) = (b.graph.cmp(&a.graph), a.way.value.total_cmp(&b.way.value));
            if first_comes_first { by_graph.then(by_value) } else { by_value }
        };
        let Some(first) = (0..left.len()).max_by(order) else { break };
        let Component { graph: number, nodes, way } = left.swap_remove(first);
        let graph = &mut graphs[number];
        graph.take(&way);
        lines.push(graph.line(&way));
        if lines.len() == count {
            break;
        }
        left.extend(components(graph, number, &nodes, &best));
    }
    lines
}

/// The components in which these nodes of a graph lie, each with its best way.
fn components<'a>(
    graph: &mut Graph<'a>,
    number: usize,
    nodes: &[u32],
    best: impl Fn(&Graph<'a>, &[u32]) -> Option<Way>,
) -> Vec<Component> {
    let found = graph.components(nodes.iter().copied()).into_iter();
    found
        .filter_map(|nodes| best(graph, &nodes).map(|way| Component { graph: number, nodes, way }))
        .collect()
}
