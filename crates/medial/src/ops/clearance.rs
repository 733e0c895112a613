//! How wide a shape is, or how far apart shapes are: necks, and the largest inscribed disks.
//!
//! # Contract
//! A neck is a place where the radius is least: smaller than everywhere near on the axis. Inside it is a width of
//! the polygons, outside a spacing between them, or between two parts of one. Between parallel edges it may
//! be as long as a passage. Which places are necks, whether one is narrower than a limit, and which disks
//! are the largest, with all ties, is decided exactly; only positions and widths are rounded. Convex corners,
//! where the radius falls to zero, are no necks.
//!
//! Two elements may be near without a neck between them: where one tiny edge joins them, the radius falls
//! all the way into its corners [Lee82]. So a polygon may have a short edge and no neck there.
//!
//! # Method
//! Along a path the radius has one least place at most. Paths between parallel edges are level; what they join is
//! one place, a neck if the radius grows on every other path that leaves it. What level paths join to a
//! keypoint with the largest radius has it all over. O(n).

use super::groups::Groups;
use super::hierarchy::HierarchyError;
use super::outline::foot_on;
use super::radii::Radii;
use crate::axis::{KeypointKind, MedialAxis, Path, Side, SiteShape};
use crate::domain::Domain;
use crate::geom::Point;
use crate::geom::predicates::compare_gap;

/// A place where a shape, or the space around it, is narrower than near by.
#[derive(Clone, Debug, PartialEq)]
pub struct Neck {
    /// Inside it is a width, outside a spacing.
    pub side: Side,
    /// Twice the radius, in units of the input.
    pub width: f64,
    /// How long the place is along the axis: 0 but for passages between parallel edges.
    pub length: f64,
    /// The middle of it, on the axis.
    pub middle: Point,
    /// The numbers of the two sites of the axis between which it lies.
    pub governors: [u32; 2],
    /// Where they are nearest to the middle.
    pub footpoints: [Point; 2],
    /// The paths on which it lies: one, or those of a passage.
    pub paths: Vec<u32>,
}

/// All necks of an axis, the narrowest first, equal ones by their place; with a limit, those narrower than it.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::necks;
///
/// // Two rooms, and a passage of width 1 and length 2 between them.
/// let ring = [
///     (0., 0.), (4., 0.), (4., 2.), (6., 2.), (6., 0.), (9., 0.),
///     (9., 4.), (6., 4.), (6., 3.), (4., 3.), (4., 4.), (0., 4.),
/// ];
/// let ring = ring.map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// let all = necks(&domain, &axis, None)?;
/// assert_eq!((all.len(), all[0].width, all[0].length), (1, 1.0, 2.0));
/// assert_eq!(all[0].middle, Point::new(5.0, 2.5));
/// assert_eq!(necks(&domain, &axis, Some(1.0))?, []);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not exact, or pruned, or not of this domain.
pub fn necks(
    domain: &Domain,
    axis: &MedialAxis,
    limit: Option<f64>,
) -> Result<Vec<Neck>, HierarchyError> {
    let radii = Radii::new(domain, axis)?;
    let at = Groups::paths_at_keypoints(axis);
    let mut necks = inside_paths(&radii, axis, limit);
    let mut is_met = vec![false; axis.keypoints().len()];
    for start in 0..axis.keypoints().len() as u32 {
        if !is_met[start as usize] {
            necks.extend(place(&radii, axis, &at, start, &mut is_met, limit));
        }
    }
    necks.sort_by(|one, other| {
        one.width.total_cmp(&other.width).then_with(|| one.middle.lexicographic(other.middle))
    });
    Ok(necks)
}

/// The necks that lie inside a path.
fn inside_paths(radii: &Radii<'_>, axis: &MedialAxis, limit: Option<f64>) -> Vec<Neck> {
    let neck = |(number, path): (u32, Path)| {
        if !radii.has_neck(&path) {
            return None;
        }
        let [one, other] = radii.elements(&path);
        if limit.is_some_and(|limit| compare_gap(one, other, limit).is_ge()) {
            return None;
        }
        let curve = axis.curve(&path);
        // At an end only by rounding.
        let nearer = if curve.radius_from() <= curve.radius_to() { 0.0 } else { 1.0 };
        let middle = curve.point_at(curve.neck().unwrap_or(nearer));
        Some(neck_at(axis, &path, middle, 2.0 * curve.radius_min(), 0.0, vec![number]))
    };
    (0..).zip(axis.paths()).filter_map(neck).collect()
}

/// What level paths join to a keypoint, if it is a neck.
fn place(
    radii: &Radii<'_>,
    axis: &MedialAxis,
    at: &Groups,
    start: u32,
    is_met: &mut [bool],
    limit: Option<f64>,
) -> Option<Neck> {
    let Joined { keypoints, level, others } = joined(radii, axis, at, start, is_met);
    // Convex corners, and where the axis is cut off.
    let ends =
        |&k: &u32| matches!(axis.keypoints().at(k).kind, KeypointKind::End | KeypointKind::Clipped);
    // A path that ends where it starts has its least place inside.
    let rises = |(_, path): &(u32, Path)| path.from != path.to && radii.rises(path);
    if keypoints.iter().any(ends)
        || !others.iter().all(rises)
        || limit.is_some_and(|limit| radii.compare(start, 0.5 * limit).is_ge())
    {
        return None;
    }
    let width = 2.0 * axis.keypoints().at(start).radius;
    if let Some(passage) = Passage::new(radii, axis, at, &level) {
        let Passage { length, middle, path, .. } = passage;
        return Some(neck_at(axis, &path, middle, width, length, level));
    }
    let &(number, _) = others.iter().min_by_key(|(number, _)| *number)?;
    let middle = axis.keypoints().at(start).position;
    let path = axis.paths().at(number);
    Some(neck_at(axis, &path, middle, width, 0.0, vec![number]))
}

/// What level paths join to a keypoint.
struct Joined {
    /// The keypoints, in no order.
    keypoints: Vec<u32>,
    /// The level paths between them, in ascending order.
    level: Vec<u32>,
    /// The other paths that leave them, with their numbers; one that comes back is there twice.
    others: Vec<(u32, Path)>,
}

fn joined(
    radii: &Radii<'_>,
    axis: &MedialAxis,
    at: &Groups,
    start: u32,
    is_met: &mut [bool],
) -> Joined {
    let (mut keypoints, mut level, mut others) = (vec![start], Vec::new(), Vec::new());
    is_met[start as usize] = true;
    let mut k = 0;
    while let Some(&keypoint) = keypoints.get(k) {
        k += 1;
        for &number in at.of(keypoint) {
            let path = axis.paths().at(number);
            let path = if path.from == keypoint { path } else { path.reversed() };
            if radii.is_level(&path) {
                level.push(number);
                if !std::mem::replace(&mut is_met[path.to as usize], true) {
                    keypoints.push(path.to);
                }
            } else {
                others.push((number, path));
            }
        }
    }
    // Level paths were met from both ends.
    level.sort_unstable();
    level.dedup();
    Joined { keypoints, level, others }
}

/// What level paths make together.
struct Passage {
    /// Their numbers, in the order in which they lead through it.
    numbers: Vec<u32>,
    length: f64,
    middle: Point,
    /// The one on which the middle lies, as it leads through the passage.
    path: Path,
}

impl Passage {
    /// The passage of level paths that hang together; `None` without any.
    fn new(radii: &Radii<'_>, axis: &MedialAxis, at: &Groups, level: &[u32]) -> Option<Self> {
        let way = in_a_row(radii, axis, at, level);
        let lengths: Vec<f64> = way.iter().map(|(_, path)| axis.curve(path).length()).collect();
        let length: f64 = lengths.iter().sum();
        let (mut along, mut k) = (0.5 * length, 0);
        while k + 1 < way.len() && along > lengths[k] {
            along -= lengths[k];
            k += 1;
        }
        let &(_, path) = way.get(k)?;
        let curve = axis.curve(&path);
        let middle = curve.point_at(curve.parameter_at_length(along));
        Some(Self {
            numbers: way.iter().map(|&(number, _)| number).collect(),
            length,
            middle,
            path,
        })
    }
}

/// Level paths with their numbers in the order of the passage through which they lead, from its end with the
/// lesser number: a disk touches its two walls at the ends of one diameter, so all of it is straight and no
/// three meet.
fn in_a_row(radii: &Radii<'_>, axis: &MedialAxis, at: &Groups, level: &[u32]) -> Vec<(u32, Path)> {
    let path = |k: u32| axis.paths().at(k);
    let levels = |k: u32| at.of(k).iter().copied().filter(|&p| radii.is_level(&path(p)));
    let all = level.iter().flat_map(|&k| [path(k).from, path(k).to]);
    let end = all.clone().filter(|&k| levels(k).count() == 1).min();
    let mut keypoint = end.or(all.min()).unwrap_or_default();
    let mut way = Vec::with_capacity(level.len());
    let mut last = None;
    while way.len() < level.len() {
        let Some(next) = levels(keypoint).find(|&k| Some(k) != last) else { break };
        let path = path(next);
        let path = if path.from == keypoint { path } else { path.reversed() };
        (keypoint, last) = (path.to, Some(next));
        way.push((next, path));
    }
    way
}

fn neck_at(
    axis: &MedialAxis,
    path: &Path,
    middle: Point,
    width: f64,
    length: f64,
    paths: Vec<u32>,
) -> Neck {
    let governors = [path.left, path.right];
    let footpoints = governors.map(|site| {
        let SiteShape { a, b, .. } = axis.site_shape(site);
        foot_on(a, b, middle)
    });
    Neck { side: axis.side, width, length, middle, governors, footpoints, paths }
}

/// A place of largest disks: a point, or a straight passage between parallel edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Plateau {
    /// The radius all over it, in units of the input.
    pub radius: f64,
    /// Its keypoints, in ascending order.
    pub keypoints: Vec<u32>,
    /// The paths between them, in the order in which they lead through it; none at a point.
    pub paths: Vec<u32>,
    /// How long it is along the axis: 0 but for passages.
    pub length: f64,
    /// The middle of it, on the axis.
    pub middle: Point,
}

impl Plateau {
    /// Its keypoints in the order in which its paths lead through it.
    ///
    /// # Panics
    /// If the axis is not the one it was found on.
    #[must_use]
    pub fn keypoints_along(&self, axis: &MedialAxis) -> Vec<u32> {
        let path = |&number: &u32| axis.paths().at(number);
        let Some(first) = self.paths.first().map(path) else { return self.keypoints.clone() };
        // The first path starts where the second one does not go on.
        let next = self.paths.get(1).map(path);
        let goes_on = next.is_some_and(|next| next.from == first.from || next.to == first.from);
        let mut along = vec![if goes_on { first.to } else { first.from }];
        for path in self.paths.iter().map(path) {
            along.push(if along.last() == Some(&path.from) { path.to } else { path.from });
        }
        along
    }
}

/// Where the radius is exactly the largest: each connected set of such places, by the least of its keypoints.
///
/// None if the axis has no keypoint, and outside, where the radius grows without end.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::largest_disks;
///
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// // All of the spine, from (1, 1) to (5, 1).
/// let largest = largest_disks(&domain, &axis)?;
/// assert_eq!((largest.len(), largest[0].radius, largest[0].length), (1, 1.0, 4.0));
/// assert_eq!((largest[0].keypoints.len(), largest[0].paths.len()), (2, 1));
/// assert_eq!(largest[0].middle, Point::new(3.0, 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not exact, or pruned, or not of this domain.
pub fn largest_disks(domain: &Domain, axis: &MedialAxis) -> Result<Vec<Plateau>, HierarchyError> {
    let radii = Radii::new(domain, axis)?;
    if axis.side == Side::Exterior {
        return Ok(Vec::new());
    }
    let mut largest: Vec<u32> = Vec::new();
    for keypoint in 0..axis.keypoints().len() as u32 {
        match largest.first().map(|&first| radii.compare_two(keypoint, first)) {
            Some(std::cmp::Ordering::Less) => {}
            Some(std::cmp::Ordering::Equal) => largest.push(keypoint),
            None | Some(std::cmp::Ordering::Greater) => largest = vec![keypoint],
        }
    }
    let at = Groups::paths_at_keypoints(axis);
    let mut is_met = vec![false; axis.keypoints().len()];
    let mut plateaus = Vec::new();
    for start in largest {
        if !is_met[start as usize] {
            // The radius is convex along a path, so it is the largest inside of level ones only.
            plateaus.push(plateau(&radii, axis, &at, start, &mut is_met));
        }
    }
    Ok(plateaus)
}

/// What level paths join to a keypoint with the largest radius.
fn plateau(
    radii: &Radii<'_>,
    axis: &MedialAxis,
    at: &Groups,
    start: u32,
    is_met: &mut [bool],
) -> Plateau {
    let Joined { mut keypoints, level, .. } = joined(radii, axis, at, start, is_met);
    keypoints.sort_unstable();
    let disk = axis.keypoints().at(start);
    let (paths, length, middle) = match Passage::new(radii, axis, at, &level) {
        Some(Passage { numbers, length, middle, .. }) => (numbers, length, middle),
        None => (Vec::new(), 0.0, disk.position),
    };
    Plateau { radius: disk.radius, keypoints, paths, length, middle }
}
