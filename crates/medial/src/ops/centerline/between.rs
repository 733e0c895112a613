//! The way along an axis between given points.
//!
//! # Method
//! 1. Each point is led to the point of the axis that is nearest to it, of those in sight.
//! 2. Paths are cut there, and the shortest ways from each point to the others are found.

use super::graph::{Graph, Pieces, Way};
use super::line::Centerline;
use super::wall::Wall;
use super::{CenterlineError, CenterlineOptions, Extension, extend};
use crate::axis::MedialAxis;
use crate::domain::Domain;
use crate::geom::Point;

/// A point of an axis.
#[derive(Clone, Copy)]
struct Place {
    /// Which of the axes it lies on.
    axis: usize,
    path: u32,
    parameter: f64,
    position: Point,
}

/// The line between two of these points, on one of some axes, of each of which some paths count.
pub(super) fn line(
    domain: &Domain,
    axes: [(&MedialAxis, &[u32]); 2],
    points: &[Point],
    options: &CenterlineOptions,
) -> Result<Centerline, CenterlineError> {
    if points.len() < 2 {
        return Err(CenterlineError::FewPoints);
    }
    let wall = Wall::new(domain);
    let bounds = wall.bounds();
    if let Some(&point) = points.iter().find(|&&point| !bounds.holds(point)) {
        return Err(CenterlineError::Outside { point, low: bounds.min, high: bounds.max });
    }
    let place = |&point: &Point| nearest(&wall, axes, point);
    let places: Vec<Place> =
        points.iter().map(place).collect::<Option<_>>().ok_or(CenterlineError::NoAxis)?;
    let first = places[0];
    if let Some(k) = places.iter().position(|place| place.axis != first.axis) {
        return Err(CenterlineError::Apart { points: [points[0], points[k]] });
    }
    let (axis, paths) = axes[first.axis];
    let (mut graph, nodes) = cut(axis, paths, &places);
    let components = graph.components(graph.nodes());
    let (way, [from, to]) = longest(&graph, &components, &nodes, points)?;
    if way.pieces.is_empty() {
        return Err(CenterlineError::OnePlace { nearest: first.position });
    }
    let mut line = graph.line(&way);
    line.extensions = match options.extension {
        Extension::None => [None; 2],
        Extension::Boundary => extend::to_boundary(domain, &line),
        Extension::Anchors => [from, to].map(|k| {
            let (point, position) = (points[k], places[k].position);
            let distance = || if wall.holds(point) { wall.distance(point) } else { 0.0 };
            (point != position).then(|| (point, distance()))
        }),
    };
    Ok(line)
}

/// The nearest point of the axes to a point, of those in sight; else of all.
fn nearest(wall: &Wall, axes: [(&MedialAxis, &[u32]); 2], point: Point) -> Option<Place> {
    let all = axes.iter().enumerate().flat_map(|(number, &(axis, paths))| {
        paths.iter().map(move |&path| {
            let curve = axis.curve(&axis.paths().at(path));
            let parameter = curve.nearest_parameter(point);
            let position = curve.point_at(parameter);
            ((position - point).norm(), Place { axis: number, path, parameter, position })
        })
    });
    let mut all: Vec<(f64, Place)> = all.collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_seen = |place: &Place| place.position == point || wall.is_clear(point, place.position);
    let seen = all.iter().find(|(_, place)| is_seen(place));
    seen.or(all.first()).map(|&(_, place)| place)
}

/// The graph of some paths, cut at these places, with the nodes there.
fn cut<'a>(axis: &'a MedialAxis, paths: &[u32], places: &[Place]) -> (Graph<'a>, Vec<u32>) {
    let mut order: Vec<usize> = (0..places.len()).collect();
    let key = |&k: &usize| (places[k].path, places[k].parameter);
    order.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut nodes = vec![0; places.len()];
    let mut pieces = Pieces::of(axis);
    for &path in paths {
        let first = order.partition_point(|&k| places[k].path < path);
        let here = order[first..].iter().copied().take_while(|&k| places[k].path == path);
        let here: Vec<usize> = here.collect();
        let mut at = vec![0.0];
        at.extend(here.iter().map(|&k| places[k].parameter));
        at.push(1.0);
        at.dedup();
        let cuts = pieces.add(path, &at);
        for k in here {
            let found = at.iter().position(|&u| u >= places[k].parameter);
            nodes[k] = cuts[found.unwrap_or(0)];
        }
    }
    (Graph::new(pieces), nodes)
}

/// The longest of the shortest ways between these nodes, with the numbers of its ends.
fn longest(
    graph: &Graph,
    components: &[Vec<u32>],
    nodes: &[u32],
    points: &[Point],
) -> Result<(Way, [usize; 2]), CenterlineError> {
    let holder = |&node: &u32| components.iter().position(|component| component.contains(&node));
    let holders: Vec<Option<usize>> = nodes.iter().map(holder).collect();
    if let Some(k) = holders.iter().position(|&holder| holder != holders[0]) {
        return Err(CenterlineError::Apart { points: [points[0], points[k]] });
    }
    let n = holders[0].map_or(0, |holder| components[holder].len());
    let mut best = (Way::default(), [0, 0]);
    for (from, &start) in nodes.iter().enumerate() {
        let ways = graph.ways_from(start, n);
        for (to, &end) in nodes.iter().enumerate().skip(from + 1) {
            if graph.distance(&ways, end) > best.0.value {
                best = (graph.way(&ways, end), [from, to]);
            }
        }
    }
    Ok(best)
}
