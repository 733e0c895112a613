//! Polygons from an axis.
//!
//! # Contract
//! [`polygons_of`] gives back what a complete exact axis was made of, bit for bit: every edge governs
//! something, so all are there, with their places in the input. Vertices that a domain merges away, because
//! they repeat another or lie straight between their neighbours, stay away.
//! [`tangent_polygons`] takes any axis of the interior, and points along it: the algorithm of Volkmann and
//! St. Clair [VS87, II.C]. [`disks`] gives the disks at such points, whose union the shape is.
//!
//! # Method
//! II.C puts a point on each side of every disk, where its tangent is parallel to the tangent that its two
//! neighbours share on that side. Both sides are passed as in `outline.rs`, so the points come in the order
//! of the boundary.
//!
//! # Departures
//! None: at branch points nothing is done, as in the paper, and ends get a few points around them.

use std::collections::BTreeMap;

#[cfg(feature = "union")]
use i_overlay::core::fill_rule::FillRule;
#[cfg(feature = "union")]
use i_overlay::core::solver::Solver;
#[cfg(feature = "union")]
use i_overlay::float::overlay::OverlayOptions;
#[cfg(feature = "union")]
use i_overlay::float::simplify::SimplifyShape;

use super::outline::{Component, OutlineError, Turns, WRAPPED};
use crate::axis::{Accuracy, Curve, MedialAxis, Side, Site, SiteKind};
use crate::check::Name;
#[cfg(feature = "union")]
use crate::geom::Rect;
use crate::geom::{DisjointSets, Point, orient2d, signed_area};

/// Why an axis does not give back its polygons.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReconstructError {
    /// Something was removed, or the axis was found from samples.
    #[error("the axis is pruned or sampled; only a complete exact one holds all of its polygons")]
    Incomplete,
    /// The axis is that of the exterior.
    #[error("the axis is that of the exterior; polygons are rebuilt from that of the interior")]
    Exterior,
    /// The edges of a ring do not follow one another.
    #[error("{name} does not begin where the edge before it ends")]
    Open {
        /// The edge.
        name: Name,
    },
    /// A corner is of a ring that has no edges.
    #[error("{name} is of a ring without edges")]
    Lone {
        /// The corner.
        name: Name,
    },
}

/// The polygons that a complete exact axis is that of, in the order and the direction in which they were
/// given: for each polygon its rings, for each ring its corners, from the first one of the input that is
/// left. Where what was given were no polygons, as a hole outside or an island in a hole, each outer ring
/// has the holes that are its own.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::polygons_of;
///
/// let ring = [(0.1, 0.2), (0.7, 3.1), (5.3, 1e-7)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// assert_eq!(polygons_of(&path_tracing(&domain)?)?, [[ring]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not complete, exact, and of the interior, or its edges do not close.
pub fn polygons_of(axis: &MedialAxis) -> Result<Vec<Vec<Vec<Point>>>, ReconstructError> {
    if axis.side != Side::Interior {
        return Err(ReconstructError::Exterior);
    }
    if !axis.complete || axis.accuracy != Accuracy::Exact {
        return Err(ReconstructError::Incomplete);
    }
    let mut edges: Vec<Site> = Vec::with_capacity(axis.sites().len());
    edges.extend(axis.sites().in_order().filter(|site| site.kind == SiteKind::Edge));
    edges.sort_by_key(|e| (e.polygon, e.ring, e.index, e.part));
    let mut rings: Vec<Ring> = Vec::new();
    for ring in edges.chunk_by(|e, f| (e.polygon, e.ring) == (f.polygon, f.ring)) {
        // Edges have the interior on their left, whichever way the ring was given.
        let next = |k: usize| &ring[if k + 1 < ring.len() { k + 1 } else { 0 }];
        let last = |k: usize| &ring[if k > 0 { k - 1 } else { ring.len() - 1 }];
        let ends = |edge: &Site, forwards: bool| {
            if forwards { (edge.a, edge.b) } else { (edge.b, edge.a) }
        };
        let gap = |way: bool| {
            (0..ring.len()).find(|&k| ends(&ring[k], way).1 != ends(next(k), way).0).map(next)
        };
        let Some(way) = [true, false].into_iter().find(|&way| gap(way).is_none()) else {
            let edge = gap(true).unwrap_or(&ring[0]);
            let Site { kind, polygon, ring, index, part, .. } = *edge;
            return Err(ReconstructError::Open { name: Name { kind, polygon, ring, index, part } });
        };
        // Pieces of an edge that another ring touches begin at no corner of this ring.
        let is_corner = |k: &usize| {
            let (start, end) = ends(&ring[*k], way);
            ring[*k].part == 0 || orient2d(ends(last(*k), way).0, start, end) != 0.0
        };
        let mut corners = Vec::with_capacity(ring.len());
        corners.extend((0..ring.len()).filter(is_corner).map(|k| ends(&ring[k], way).0));
        let is_outer = is_left_turning(&corners) == way;
        rings.push(Ring { name: (ring[0].polygon, ring[0].ring), corners, is_outer });
    }
    grouped(axis, rings)
}

/// A ring of an axis, as it was given.
struct Ring {
    /// The polygon and the number in it.
    name: (u32, u32),
    corners: Vec<Point>,
    /// Whether the inside of the shape is inside of it.
    is_outer: bool,
}

/// Whether a ring runs around its inside counterclockwise.
fn is_left_turning(corners: &[Point]) -> bool {
    let n = corners.len();
    let least = (0..n).min_by(|&a, &b| corners[a].lexicographic(corners[b])).unwrap_or(0);
    let turn = orient2d(corners[(least + n - 1) % n], corners[least], corners[(least + 1) % n]);
    if turn == 0.0 { signed_area(corners) > 0.0 } else { turn > 0.0 }
}

/// The polygons that rings were given in, if each is an outer ring with its own holes; else each outer ring
/// with the holes that belong to it.
///
/// Rings that govern one path belong together, and so do those that others join.
///
/// # Errors
/// If a site is of no ring.
fn grouped(
    axis: &MedialAxis,
    mut rings: Vec<Ring>,
) -> Result<Vec<Vec<Vec<Point>>>, ReconstructError> {
    let is_first = |k: usize| k == 0 || rings[k - 1].name.0 != rings[k].name.0;
    // Without holes there is nothing to belong to.
    if (0..rings.len()).all(|k| is_first(k) && rings[k].is_outer) {
        return Ok(rings.into_iter().map(|ring| vec![ring.corners]).collect());
    }
    let mut trees = DisjointSets::new(rings.len());
    let mut ring_of = Vec::with_capacity(axis.sites().len());
    let mut last = 0;
    for site in axis.sites().in_order() {
        let name = (site.polygon, site.ring);
        if rings.get(last).is_none_or(|ring| ring.name != name) {
            last = rings.partition_point(|ring| ring.name < name);
            if rings.get(last).is_none_or(|ring| ring.name != name) {
                return Err(ReconstructError::Lone { name: Name::from(&site) });
            }
        }
        ring_of.push(last as u32);
    }
    for path in axis.paths() {
        let [left, right] = [path.left, path.right].map(|site| ring_of[site as usize]);
        if left != right {
            trees.join(left, right);
        }
    }
    let roots: Vec<u32> = (0..rings.len() as u32).map(|ring| trees.first(ring)).collect();
    // Of each polygon the first ring is the outer one, and the only one, and the others belong to it.
    let is_given = (0..rings.len())
        .all(|k| rings[k].is_outer == is_first(k) && (is_first(k) || roots[k] == roots[k - 1]));
    let key = |k: usize| if is_given { rings[k].name.0 } else { roots[k] };
    let mut place = BTreeMap::new();
    let mut polygons: Vec<Vec<Vec<Point>>> = Vec::new();
    let keys: Vec<u32> = (0..rings.len()).map(key).collect();
    for (key, ring) in keys.into_iter().zip(&mut rings) {
        let polygon = *place.entry(key).or_insert(polygons.len());
        if polygon == polygons.len() {
            polygons.push(Vec::new());
        }
        // The outer ring comes first.
        let rings = &mut polygons[polygon];
        let at = if ring.is_outer { 0 } else { rings.len() };
        rings.insert(at, std::mem::take(&mut ring.corners));
    }
    Ok(polygons)
}

/// A disk of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    /// Its centre.
    pub centre: Point,
    /// Its radius.
    pub radius: f64,
}

/// Disks along an axis, no farther apart than a step: those of all keypoints, and so many between them
/// that the boundary of their union is nowhere farther than the step from that of the shape. Those of
/// radius 0 are points of the boundary.
#[must_use]
pub fn disks(axis: &MedialAxis, step: f64) -> Vec<Disk> {
    let mut disks: Vec<Disk> =
        axis.keypoints().iter().map(|k| disk(k.position, k.radius)).collect();
    for path in axis.paths() {
        let curve = axis.curve(&path);
        let between = samples(&curve, step);
        disks.extend(&between[1..between.len() - 1]);
    }
    disks
}

fn disk(centre: Point, radius: f64) -> Disk {
    Disk { centre, radius }
}

/// Disks along a curve from its start to its end, at equal shares of its parameter.
fn samples(curve: &Curve, step: f64) -> Vec<Disk> {
    let pieces = (curve.length() / step).ceil();
    // A curve without length and a step of nothing have no quotient.
    let pieces = if pieces.is_nan() { 1.0 } else { pieces.clamp(1.0, MAX_PIECES) };
    let at = |k: u32| f64::from(k) / pieces;
    (0..=pieces as u32).map(|k| disk(curve.point_at(at(k)), curve.radius_at(at(k)))).collect()
}

/// Most pieces a path is cut into: a mistyped step would fill the memory.
const MAX_PIECES: f64 = 65_536.0;

/// Points that the report puts between the two tangent points of an end, on the side away from the axis.
const AROUND_AN_END: u32 = 4;

/// Polygons after Volkmann and St. Clair (II.C), from points along an axis no farther apart than a step.
///
/// For each component its contours: the outer one, counterclockwise, first.
///
/// # Errors
/// If the axis is that of the exterior, or its graph is not that of an axis.
pub fn tangent_polygons(
    axis: &MedialAxis,
    step: f64,
) -> Result<Vec<Vec<Vec<Point>>>, OutlineError> {
    if axis.side != Side::Interior {
        return Err(OutlineError::Exterior);
    }
    let turns = Turns::new(axis)?;
    let polygon = |Component { keypoint, contours: mut rings }: Component<Vec<Point>>| {
        if rings.is_empty() {
            let keypoint = axis.keypoints().at(keypoint);
            rings.push(around(&disk(keypoint.position, keypoint.radius)));
        }
        if let Some(outer) = rings.iter().position(|ring| signed_area(ring) > 0.0) {
            rings.swap(0, outer);
        }
        rings
    };
    let components =
        turns.components(|around| tangent_ring(axis, &turns, &around.collect::<Vec<u32>>(), step));
    Ok(components.into_iter().map(polygon).collect())
}

/// The union of disks as polygons inside of it, no farther away than a tolerance: for each of its parts
/// the outer ring, counterclockwise, and the holes. The feature `union` has it.
#[cfg(feature = "union")]
#[must_use]
pub fn union_of_disks(disks: &[Disk], tolerance: f64) -> Vec<Vec<Vec<Point>>> {
    let flattened = |disk: &Disk| {
        let half = (1.0 - tolerance / disk.radius).clamp(-1.0, 1.0).acos();
        let n = (std::f64::consts::PI / half).ceil().clamp(6.0, MAX_PIECES) as u32;
        let point = |k: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
            let p = disk.centre + Point::new(cos, sin) * disk.radius;
            [p.x, p.y]
        };
        (0..n).map(point).collect::<Vec<[f64; 2]>>()
    };
    let mut disks: Vec<Disk> = disks.iter().filter(|disk| disk.radius > 0.0).copied().collect();
    without_slivers(united(&mut disks, &|disk| disk.centre, &flattened), 0.0)
}

/// The union of all disks of an axis along whose paths centre and radius are linear, as those of sampled axes
/// are, as polygons inside of it, no farther away than a tolerance. The feature `union` has it.
///
/// Between two disks it is their convex hull. Paths of radius 0 have no part in it.
#[cfg(feature = "union")]
#[must_use]
pub fn union_of_linked_disks(axis: &MedialAxis, tolerance: f64) -> Vec<Vec<Vec<Point>>> {
    let disk_of = |keypoint: u32| {
        let (centre, radius) = axis.disk(keypoint);
        disk(centre, radius)
    };
    let lone = (0..).zip(axis.degrees()).filter(|&(_, degree)| degree == 0);
    let lone = lone.map(|(keypoint, _)| [keypoint; 2]);
    let pairs = lone.chain(axis.paths().all_ends()).map(|ends| ends.map(disk_of));
    let mut pairs: Vec<[Disk; 2]> =
        pairs.filter(|pair| pair.iter().any(|disk| disk.radius > 0.0)).collect();
    let middle = |[from, to]: &[Disk; 2]| (from.centre + to.centre) * 0.5;
    without_slivers(united(&mut pairs, &middle, &|pair| hull(pair, tolerance)), 0.0)
}

/// The convex hull of two disks, or the one that holds the other, as a polygon inside of it.
#[cfg(feature = "union")]
fn hull([from, to]: &[Disk; 2], tolerance: f64) -> Contour {
    let larger = if from.radius > to.radius { from } else { to };
    let mut contour: Contour = Vec::new();
    let mut arc = |disk: &Disk, start: Point, sweep: f64| {
        let half = (1.0 - tolerance / disk.radius).clamp(-1.0, 1.0).acos();
        // Whatever the tolerance, no chord cuts off more than a sixth of a circle.
        let n = (0.5 * sweep / half).max(3.0 * sweep / std::f64::consts::PI);
        let n = if disk.radius > 0.0 { n.ceil().clamp(1.0, MAX_PIECES) } else { 0.0 };
        for k in 0..=n as u32 {
            let (sin, cos) = (sweep * f64::from(k) / n.max(1.0)).sin_cos();
            let p = disk.centre + (start * cos + start.perp() * sin) * disk.radius;
            contour.push([p.x, p.y]);
        }
    };
    match (normal(from, to), normal(to, from)) {
        (Some(right), Some(left)) => {
            let turn = right.cross(left).atan2(right.dot(left)).rem_euclid(std::f64::consts::TAU);
            arc(to, right, turn);
            arc(from, left, std::f64::consts::TAU - turn);
        }
        _ => arc(larger, Point::new(1.0, 0.0), std::f64::consts::TAU),
    }
    contour
}

/// Polygons without crossings that hold what these rings wind around, but for rings that are smaller than a
/// square of the tolerance, as where the rings nearly touch themselves. The feature `union` has it.
#[cfg(feature = "union")]
#[must_use]
pub fn without_crossings(polygons: &[Vec<Vec<Point>>], tolerance: f64) -> Vec<Vec<Vec<Point>>> {
    let contour = |ring: &Vec<Point>| ring.iter().map(|p| [p.x, p.y]).collect();
    let all: Vec<Contour> = polygons.iter().flatten().map(contour).collect();
    without_slivers(simplified(all, FillRule::Positive), tolerance * tolerance)
}

/// Contours without crossings, in shapes that meet at points at most, and so do their rings.
#[cfg(feature = "union")]
fn simplified(mut contours: Vec<Contour>, rule: FillRule) -> Vec<Vec<Contour>> {
    // Coordinates beyond all numbers are nowhere.
    for contour in &mut contours {
        contour.retain(|p| p.iter().all(|v| v.is_finite()));
    }
    contours.simplify_shape_custom_as::<i64>(rule, OverlayOptions::ogc(), Solver::default())
}

#[cfg(feature = "union")]
type Contour = Vec<[f64; 2]>;

/// The rings of shapes, but for those that rounding made: their area is nothing beside that of the box of
/// all shapes, or less than that given.
#[cfg(feature = "union")]
fn without_slivers(shapes: Vec<Vec<Contour>>, least: f64) -> Vec<Vec<Vec<Point>>> {
    /// That share is no ring anybody drew.
    const NOTHING: f64 = 1e-12;
    let points = |contour: &Contour| -> Vec<Point> {
        contour.iter().map(|&[x, y]| Point::new(x, y)).collect()
    };
    let mut polygons: Vec<Vec<Vec<Point>>> =
        shapes.iter().map(|shape| shape.iter().map(points).collect()).collect();
    let bounds = polygons.iter().flatten().flatten().fold(Rect::EMPTY, |all, &p| all.with(p));
    let least = least.max(NOTHING * (bounds.max - bounds.min).norm2());
    let is_ring = |ring: &Vec<Point>| signed_area(ring).abs() > least;
    polygons.retain(|rings| rings.first().is_some_and(is_ring));
    polygons.iter_mut().for_each(|rings| rings.retain(is_ring));
    polygons
}

/// The union of parts, by halves that lie apart: what is inside of a half is gone before the halves meet. Given are
/// where a part lies, and its contour, which is made only then.
#[cfg(feature = "union")]
fn united<T>(
    parts: &mut [T],
    place: &impl Fn(&T) -> Point,
    contour: &impl Fn(&T) -> Contour,
) -> Vec<Vec<Contour>> {
    /// Parts that are put together at once.
    const FEW: usize = 8;
    let contours: Vec<Contour> = if parts.len() <= FEW {
        parts.iter().map(contour).collect()
    } else {
        let bounds = parts.iter().fold(Rect::EMPTY, |all, part| all.with(place(part)));
        let size = bounds.max - bounds.min;
        let along = |part: &T| if size.x > size.y { place(part).x } else { place(part).y };
        let middle = parts.len() / 2;
        parts.select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)));
        let (one, other) = parts.split_at_mut(middle);
        let halves = [one, other].map(|half| united(half, place, contour));
        halves.into_iter().flatten().flatten().collect()
    };
    simplified(contours, FillRule::NonZero)
}

/// What the report does with a disk.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    Normal,
    Branch,
    End,
}

/// The points on one side of the paths that are passed.
fn tangent_ring(axis: &MedialAxis, turns: &Turns<'_>, darts: &[u32], step: f64) -> Vec<Point> {
    let mut nodes: Vec<(Disk, Role)> = Vec::new();
    for (k, &dart) in darts.iter().enumerate() {
        let path = turns.path(dart);
        let before = darts[if k == 0 { darts.len() - 1 } else { k - 1 }];
        let role = match turns.leaving(path.from).count() {
            _ if before == dart ^ 1 => Role::End,
            2 => Role::Normal,
            _ => Role::Branch,
        };
        let disks = samples(&axis.curve(&path), step);
        nodes.push((disks[0], role));
        nodes.extend(disks[1..disks.len() - 1].iter().map(|&disk| (disk, Role::Normal)));
    }
    let mut ring = Vec::new();
    let n = nodes.len();
    for (k, &(disk, role)) in nodes.iter().enumerate() {
        let (before, after) = (&nodes[(k + n - 1) % n].0, &nodes[(k + 1) % n].0);
        match role {
            Role::Branch => {}
            Role::Normal => {
                ring.extend(normal(before, after).map(|normal| disk.centre + normal * disk.radius));
            }
            Role::End if disk.radius == 0.0 => ring.push(disk.centre),
            Role::End => {
                let (Some(first), Some(last)) = (normal(before, &disk), normal(&disk, after))
                else {
                    continue;
                };
                let mut turn = first.cross(last).atan2(first.dot(last));
                if turn < -WRAPPED {
                    turn += std::f64::consts::TAU;
                }
                if turn <= 0.0 {
                    ring.push(disk.centre + first * disk.radius);
                    continue;
                }
                for k in 0..=AROUND_AN_END + 1 {
                    let (sin, cos) = (turn * f64::from(k) / f64::from(AROUND_AN_END + 1)).sin_cos();
                    ring.push(disk.centre + (first * cos + first.perp() * sin) * disk.radius);
                }
            }
        }
    }
    ring.dedup();
    ring
}

/// Points around a disk that is all there is.
fn around(disk: &Disk) -> Vec<Point> {
    let n = 4 * (AROUND_AN_END + 1);
    let point = |k: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
        disk.centre + Point::new(cos, sin) * disk.radius
    };
    (0..n).map(point).collect()
}

/// Distance of two centres, as a share of their coordinates, below which their rounding makes more of their
/// difference than is told by it.
const SAME: f64 = 1e-12;

/// The direction away from the line that touches two disks on the right of the way from one to the other;
/// `None` if one holds the other, or they are the same but for rounding.
fn normal(from: &Disk, to: &Disk) -> Option<Point> {
    let way = to.centre - from.centre;
    let length2 = way.norm2();
    let size = SAME * (from.centre.norm() + from.radius);
    if length2 < size * size {
        return None;
    }
    let closing = from.radius - to.radius;
    let across2 = length2 - closing * closing;
    // Along the way as much as the radius shrinks, the rest to the right.
    (across2 > 0.0).then(|| (way * closing - way.perp() * across2.sqrt()) * (1.0 / length2))
}
