//! How wide a shape is, or how far apart shapes are: necks, and the largest inscribed disks.
//!
//! # Contract
//! A neck is a place where the radius is least: smaller than everywhere near on the axis. Inside it is a width of
//! the polygons, outside a spacing between them, or between two parts of one. Between parallel edges it may
//! be as long as a passage. Which places are necks, whether one is narrower than a limit, and which disks
//! are the largest, is decided exactly; only positions and widths are rounded. Convex corners, where the
//! radius falls to zero, are no necks.
//!
//! Two elements may be near without a neck between them: where one tiny edge joins them, the radius falls
//! all the way into its corners [Lee82]. So a polygon may have a short edge and no neck there.
//!
//! # Method
//! Along a path the radius has one least place at most. Paths between parallel edges are level; what they join is
//! one place, a neck if the radius grows on every other path that leaves it. O(n).

use super::groups::Groups;
use super::hierarchy::HierarchyError;
use super::outline::foot;
use super::radii::Radii;
use crate::axis::{KeypointKind, MedialAxis, Path, Side};
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
    let (mut open, mut level, mut others) = (vec![start], Vec::new(), Vec::new());
    let mut is_neck = true;
    is_met[start as usize] = true;
    while let Some(keypoint) = open.pop() {
        // Convex corners, and where the axis is cut off.
        is_neck &= !matches!(
            axis.keypoints().at(keypoint).kind,
            KeypointKind::End | KeypointKind::Clipped
        );
        for &number in at.of(keypoint) {
            let path = axis.paths().at(number);
            let path = if path.from == keypoint { path } else { path.reversed() };
            if radii.is_level(&path) {
                level.push(number);
                if !std::mem::replace(&mut is_met[path.to as usize], true) {
                    open.push(path.to);
                }
            } else {
                others.push(number);
                is_neck = is_neck && radii.rises(&path);
                // A path that ends where it starts has its least place inside.
                is_neck &= path.from != path.to;
            }
        }
    }
    if !is_neck || limit.is_some_and(|limit| radii.compare(start, 0.5 * limit).is_ge()) {
        return None;
    }
    // Level paths were met from both ends.
    level.sort_unstable();
    level.dedup();
    let width = 2.0 * axis.keypoints().at(start).radius;
    if level.is_empty() {
        let number = *others.iter().min()?;
        let middle = axis.keypoints().at(start).position;
        let path = axis.paths().at(number);
        return Some(neck_at(axis, &path, middle, width, 0.0, vec![number]));
    }
    let way = in_a_row(radii, axis, at, &level);
    let lengths: Vec<f64> = way.iter().map(|path| axis.curve(path).length()).collect();
    let length: f64 = lengths.iter().sum();
    let (mut along, mut k) = (0.5 * length, 0);
    while k + 1 < way.len() && along > lengths[k] {
        along -= lengths[k];
        k += 1;
    }
    let path = way[k];
    let middle = axis.curve(&path).point_at((along / lengths[k]).clamp(0.0, 1.0));
    Some(neck_at(axis, &path, middle, width, length, level))
}

/// Level paths in the order of the passage through which they lead, from its end with the lesser number:
/// no three meet, as their edges would need three directions.
fn in_a_row(radii: &Radii<'_>, axis: &MedialAxis, at: &Groups, level: &[u32]) -> Vec<Path> {
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
        way.push(path);
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
    let footpoints = governors.map(|site| foot(&axis.sites().at(site), middle));
    Neck { side: axis.side, width, length, middle, governors, footpoints, paths }
}

/// The keypoints with the largest radius: one, or several of exactly the same, in ascending order. All of a
/// path between two of them that is level has it too.
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
/// // Both ends of the spine.
/// let largest = largest_disks(&domain, &axis)?;
/// let mut x: Vec<f64> = largest.iter().map(|&k| axis.keypoints().at(k).position.x).collect();
/// x.sort_by(f64::total_cmp);
/// assert_eq!(x, [1.0, 5.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not exact, or pruned, or not of this domain.
pub fn largest_disks(domain: &Domain, axis: &MedialAxis) -> Result<Vec<u32>, HierarchyError> {
    let radii = Radii::new(domain, axis)?;
    let mut largest: Vec<u32> = Vec::new();
    if axis.side == Side::Exterior {
        return Ok(largest);
    }
    for keypoint in 0..axis.keypoints().len() as u32 {
        match largest.first().map(|&first| radii.compare_two(keypoint, first)) {
            Some(std::cmp::Ordering::Less) => {}
            Some(std::cmp::Ordering::Equal) => largest.push(keypoint),
            None | Some(std::cmp::Ordering::Greater) => largest = vec![keypoint],
        }
    }
    Ok(largest)
}
