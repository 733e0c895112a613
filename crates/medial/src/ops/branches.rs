//! The branches of an axis and the primitives they consist of, after Blum and Nagel [BN78].
//!
//! # Contract
//! A point of the axis is an end, a normal point or a branch point: its disk touches the boundary in one
//! place, in two, or in more. That is its degree. Branches are the ways through normal points, each in one
//! direction; a component without any other point is one closed branch. A branch is cut where its primitive
//! changes, which is decided by the governors and never by a radius that was computed.
//!
//! # Method
//! What the radius does along a path depends on its governors only: between parallel edges it stays (worm),
//! between other edges it grows or shrinks at one rate (wedge), with a corner the rate itself grows
//! (flare), and changes its sign at the neck. An axis of polygons has no cups.
//!
//! # Departures
//! The paper allows axes of any curvature. Those of polygons are straight, or spirals: a parabola bends
//! most at its apex. Circular axes do not occur.

use smallvec::SmallVec;

use super::groups::Groups;
use super::outline::foot;
use crate::axis::{Curve, MedialAxis, Path, Site, SiteKind, names};
use crate::geom::{Point, cross_directions};

/// What the radius does along a piece of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Primitive {
    /// It stays.
    Worm,
    /// It changes at one rate.
    Wedge,
    /// Its rate falls.
    Cup,
    /// Its rate grows.
    Flare,
}

names!(
    Primitive, "primitive",
    Worm => "worm", Wedge => "wedge", Cup => "cup", Flare => "flare",
);

/// Whether the radius grows along a piece of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Trend {
    /// It grows.
    Opening,
    /// It shrinks.
    Closing,
}

names!(Trend, "trend", Opening => "opening", Closing => "closing");

/// How a piece of a branch bends, in its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Bend {
    /// Not at all.
    Straight,
    /// To the left, the same all along.
    LeftCircular,
    /// To the right, the same all along.
    RightCircular,
    /// To the left, more and more.
    SpiralInLeft,
    /// To the right, more and more.
    SpiralInRight,
    /// To the left, less and less.
    SpiralOutLeft,
    /// To the right, less and less.
    SpiralOutRight,
}

names!(
    Bend, "bend",
    Straight => "straight", LeftCircular => "left_circular", RightCircular => "right_circular",
    SpiralInLeft => "spiral_in_left", SpiralInRight => "spiral_in_right",
    SpiralOutLeft => "spiral_out_left", SpiralOutRight => "spiral_out_right",
);

/// A way through an axis between two points that are no normal points, or around a cycle of normal points.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The paths, in the direction of the branch.
    pub paths: Vec<Path>,
    /// Their numbers in the axis.
    pub numbers: Vec<u32>,
    /// What it consists of, in its direction.
    pub pieces: Vec<BranchPiece>,
    /// All of it.
    pub extent: Extent,
    /// The boundary to its left, from where it starts.
    pub left: BoundaryPiece,
    /// The boundary to its right, from where it starts.
    pub right: BoundaryPiece,
    /// Whether it is a cycle of normal points.
    pub is_closed: bool,
}

/// A piece of a branch with one primitive.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchPiece {
    /// What the radius does.
    pub primitive: Primitive,
    /// Whether it grows; nothing for a worm.
    pub trend: Option<Trend>,
    /// How the axis bends.
    pub bend: Bend,
    /// The curves, in the direction of the branch.
    pub curves: Vec<Curve>,
    /// All of it.
    pub extent: Extent,
}

/// Lengths, areas and radii of a part of an axis, in units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Length along the axis.
    pub length: f64,
    /// Area of the shape nearest to it: all points that are on a line from the axis to a footpoint.
    pub area: f64,
    /// The radius where it starts.
    pub radius_start: f64,
    /// The radius where it ends.
    pub radius_end: f64,
    /// The least radius.
    pub radius_min: f64,
    /// The greatest radius.
    pub radius_max: f64,
    /// The mean radius along the length.
    pub radius_mean: f64,
}

/// The boundary on one side of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryPiece {
    /// Its points: the first footpoint, corners, the last footpoint.
    pub points: Vec<Point>,
    /// The sites along it, as numbers of the axis.
    pub sites: Vec<u32>,
    /// Its length, in units of the input.
    pub length: f64,
}

/// The branches of an axis: each path is in just one of them.
///
/// Those with a free end come first and start there, closed ones come last. Of an axis that was pruned a
/// boundary goes straight past what was removed.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{Primitive, branches};
///
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// let branches = branches(&axis);
/// // Four corners and the spine.
/// assert_eq!(branches.len(), 5);
/// let spine = branches.iter().find(|b| b.pieces[0].primitive == Primitive::Worm).unwrap();
/// assert_eq!((spine.extent.length, spine.extent.area, spine.left.length), (4.0, 8.0, 4.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn branches(axis: &MedialAxis) -> Vec<Branch> {
    let incidence = Groups::paths_at_keypoints(axis);
    let mut is_used = vec![false; axis.paths().len()];
    let mut branches = Vec::new();
    let n = axis.keypoints().len() as u32;
    let is_normal = |keypoint: u32| incidence.of(keypoint).len() == 2;
    let mut follow = |start: u32, number: u32, is_closed: bool| {
        if is_used[number as usize] {
            return;
        }
        let (mut paths, mut numbers) = (Vec::new(), Vec::new());
        let (mut keypoint, mut number) = (start, number);
        loop {
            is_used[number as usize] = true;
            let path = axis.paths().at(number);
            // A loop at one keypoint is passed from its start.
            let path = if path.from == keypoint { path } else { path.reversed() };
            paths.push(path);
            numbers.push(number);
            keypoint = path.to;
            if !is_normal(keypoint) {
                break;
            }
            let next = incidence.of(keypoint).iter().find(|&&k| !is_used[k as usize]);
            let Some(&next) = next else { break };
            number = next;
        }
        branches.push(Branch::of(axis, paths, numbers, is_closed));
    };
    let degree = |keypoint: u32| incidence.of(keypoint).len();
    let leaves = (0..n).filter(|&k| degree(k) == 1);
    let junctions = (0..n).filter(|&k| degree(k) > 2);
    for keypoint in leaves.chain(junctions) {
        for &number in incidence.of(keypoint) {
            follow(keypoint, number, false);
        }
    }
    for keypoint in (0..n).filter(|&k| is_normal(k)) {
        follow(keypoint, incidence.of(keypoint)[0], true);
    }
    branches
}

impl Branch {
    /// Keypoint where it starts.
    #[must_use]
    pub fn from(&self) -> u32 {
        self.paths.first().map_or(0, |path| path.from)
    }

    /// Keypoint where it ends.
    #[must_use]
    pub fn to(&self) -> u32 {
        self.paths.last().map_or(0, |path| path.to)
    }

    fn of(axis: &MedialAxis, paths: Vec<Path>, numbers: Vec<u32>, is_closed: bool) -> Self {
        let mut pieces: Vec<BranchPiece> = Vec::new();
        for path in &paths {
            let sites = [path.left, path.right].map(|site| axis.sites().at(site));
            let curve = axis.curve(path);
            // On one side of the neck it closes, on the other it opens.
            let parts = match curve.neck() {
                Some(neck) => vec![curve.piece(0.0, neck), curve.piece(neck, 1.0)],
                None => vec![curve],
            };
            let count = parts.len();
            for (k, part) in parts.into_iter().enumerate() {
                let trend = match (count, k) {
                    (2, 0) => Some(Trend::Closing),
                    (2, _) => Some(Trend::Opening),
                    _ => None,
                };
                let (primitive, trend, bend) = kind(&sites, &part, trend);
                match pieces.last_mut() {
                    Some(last) if last.kind() == (primitive, trend, bend) => {
                        last.curves.push(part);
                    }
                    _ => {
                        let (curves, extent) = (vec![part], Extent::NOTHING);
                        pieces.push(BranchPiece { primitive, trend, bend, curves, extent });
                    }
                }
            }
        }
        for piece in &mut pieces {
            let parts: SmallVec<[Extent; 4]> = piece.curves.iter().map(Extent::of).collect();
            piece.extent = Extent::joined(&parts);
        }
        let parts: SmallVec<[Extent; 4]> = pieces.iter().map(|piece| piece.extent).collect();
        let extent = Extent::joined(&parts);
        let left = BoundaryPiece::beside(axis, &paths, |path| path.left);
        let right = BoundaryPiece::beside(axis, &paths, |path| path.right);
        Self { paths, numbers, pieces, extent, left, right, is_closed }
    }
}

impl BranchPiece {
    fn kind(&self) -> (Primitive, Option<Trend>, Bend) {
        (self.primitive, self.trend, self.bend)
    }
}

/// The primitive of a curve with these governors, left and right, on which the radius is monotone.
fn kind(
    sites: &[Site; 2],
    curve: &Curve,
    trend: Option<Trend>,
) -> (Primitive, Option<Trend>, Bend) {
    let trend_of = |opens: bool| if opens { Trend::Opening } else { Trend::Closing };
    let [left, right] = sites;
    if left.kind == SiteKind::Edge && right.kind == SiteKind::Edge {
        // One of them runs in the direction of the path and the other against it: inside the right one
        // does, outside the left one.
        let turn = cross_directions(right.a, right.b, left.b, left.a);
        return if turn == 0.0 {
            (Primitive::Worm, None, Bend::Straight)
        } else {
            (Primitive::Wedge, Some(trend_of(turn > 0.0)), Bend::Straight)
        };
    }
    let trend = trend.unwrap_or_else(|| trend_of(curve.growth_at(0.5) > 0.0));
    let bend = match (left.kind, right.kind, trend) {
        (SiteKind::Vertex, SiteKind::Vertex, _) => Bend::Straight,
        (SiteKind::Vertex, _, Trend::Opening) => Bend::SpiralOutLeft,
        (SiteKind::Vertex, _, Trend::Closing) => Bend::SpiralInLeft,
        (_, _, Trend::Opening) => Bend::SpiralOutRight,
        (_, _, Trend::Closing) => Bend::SpiralInRight,
    };
    (Primitive::Flare, Some(trend), bend)
}

impl Extent {
    const NOTHING: Self = Self {
        length: 0.0,
        area: 0.0,
        radius_start: 0.0,
        radius_end: 0.0,
        radius_min: 0.0,
        radius_max: 0.0,
        radius_mean: 0.0,
    };

    /// That of parts that follow one another.
    fn joined(parts: &[Self]) -> Self {
        let (Some(first), Some(last)) = (parts.first(), parts.last()) else {
            return Self::NOTHING;
        };
        let length: f64 = parts.iter().map(|e| e.length).sum();
        let radius_max = parts.iter().map(|e| e.radius_max).fold(0.0, f64::max);
        let radius_min = parts.iter().map(|e| e.radius_min).fold(radius_max, f64::min);
        let sum: f64 = parts.iter().map(|e| e.length * e.radius_mean).sum();
        let mean = if length > 0.0 { sum / length } else { radius_max };
        Self {
            length,
            area: parts.iter().map(|e| e.area).sum(),
            radius_start: first.radius_start,
            radius_end: last.radius_end,
            radius_min,
            radius_max,
            radius_mean: mean.clamp(radius_min, radius_max),
        }
    }

    fn of(curve: &Curve) -> Self {
        Self {
            length: curve.length(),
            area: curve.strip_area(),
            radius_start: curve.radius_from(),
            radius_end: curve.radius_to(),
            radius_min: curve.radius_min(),
            radius_max: curve.radius_max(),
            radius_mean: curve.radius_mean(),
        }
    }
}

impl BoundaryPiece {
    /// The boundary on one side of paths that follow one another.
    fn beside(axis: &MedialAxis, paths: &[Path], governor: impl Fn(&Path) -> u32) -> Self {
        let mut piece = Self { points: Vec::new(), sites: Vec::new(), length: 0.0 };
        let foot_at = |site: u32, keypoint: u32| {
            foot(&axis.sites().at(site), axis.keypoints().at(keypoint).position)
        };
        for path in paths {
            let site = governor(path);
            if piece.sites.last() != Some(&site) {
                piece.sites.push(site);
                piece.push(foot_at(site, path.from));
            }
        }
        if let Some(last) = paths.last() {
            piece.push(foot_at(governor(last), last.to));
        }
        piece.length = piece.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        piece
    }

    fn push(&mut self, p: Point) {
        if self.points.last() != Some(&p) {
            self.points.push(p);
        }
    }
}
