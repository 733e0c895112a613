use std::fmt;

use super::Name;
use super::verdict::Identity;
use crate::axis::KeypointKind;
use crate::geom::Point;

/// Something wrong with an axis; `Display` says it in a sentence with its place.
///
/// Numbers are those of the axis: its sites, keypoints and paths. `at` is where to look.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Defect {
    /// A site names no edge and no reflex corner of the domain.
    UnknownSite {
        /// Number of the site.
        site: u32,
        /// What it claims to be.
        name: Name,
        /// Its first point.
        at: Point,
    },
    /// A site has other coordinates than the domain, or its ends swapped.
    MovedSite {
        /// Number of the site.
        site: u32,
        /// What it claims to be.
        name: Name,
        /// Where it is in the domain.
        at: Point,
    },
    /// Two sites are the same boundary element.
    RepeatedSite {
        /// Number of the first one.
        first: u32,
        /// Number of the second one.
        second: u32,
        /// Its first point.
        at: Point,
    },
    /// A site is listed but governs nothing.
    IdleSite {
        /// Number of the site.
        site: u32,
        /// Its first point.
        at: Point,
    },
    /// The kind of a keypoint does not fit its paths.
    Kind {
        /// Number of the keypoint.
        keypoint: u32,
        /// What it claims to be.
        kind: KeypointKind,
        /// Number of path ends there.
        degree: usize,
        /// Its position.
        at: Point,
    },
    /// A governor list does not start with its smallest number.
    ListStart {
        /// Number of the keypoint.
        keypoint: u32,
        /// Its position.
        at: Point,
    },
    /// A keypoint lists a governor twice.
    RepeatedGovernor {
        /// Number of the keypoint.
        keypoint: u32,
        /// Number of the site.
        site: u32,
        /// Its position.
        at: Point,
    },
    /// The governors are not listed counterclockwise by footpoint, or not in boundary order where
    /// several have one footpoint.
    Order {
        /// Number of the keypoint.
        keypoint: u32,
        /// The governor before the wrong one.
        first: u32,
        /// The governor out of order.
        second: u32,
        /// Its position.
        at: Point,
    },
    /// No disk touches the governors in the order of their list.
    NoDisk {
        /// Number of the keypoint.
        keypoint: u32,
        /// Its position.
        at: Point,
    },
    /// The disk of the other governors does not touch this one.
    NotTouching {
        /// Number of the keypoint.
        keypoint: u32,
        /// Number of the site.
        site: u32,
        /// Position of the keypoint.
        at: Point,
    },
    /// The disk touches a governor outside its zone: beyond an end of an edge, or on the wrong side
    /// of a corner.
    OutsideZone {
        /// Number of the keypoint.
        keypoint: u32,
        /// Number of the site.
        site: u32,
        /// Position of the keypoint.
        at: Point,
    },
    /// A boundary element lies inside the disk of a keypoint.
    Cut {
        /// Number of the keypoint.
        keypoint: u32,
        /// The element.
        by: Name,
        /// Position of the keypoint.
        at: Point,
    },
    /// The disk of a keypoint touches a boundary element that it does not list.
    MissingGovernor {
        /// Number of the keypoint.
        keypoint: u32,
        /// The element.
        site: Name,
        /// Position of the keypoint.
        at: Point,
    },
    /// A keypoint is not where its governors put it.
    Position {
        /// Number of the keypoint.
        keypoint: u32,
        /// Larger distance in one coordinate, in units in the last place of the local scale.
        ulps: f64,
        /// Where it should be.
        at: Point,
    },
    /// The radius is not what the governors make it.
    Radius {
        /// Number of the keypoint.
        keypoint: u32,
        /// Distance in units in the last place of the local scale.
        ulps: f64,
        /// Position of the keypoint.
        at: Point,
    },
    /// The radius differs from the distance to the boundary by more than the sample distance.
    SampledRadius {
        /// Number of the keypoint.
        keypoint: u32,
        /// By how much.
        off: f64,
        /// Position of the keypoint.
        at: Point,
    },
    /// A point of the boundary is farther from every disk of a sampled axis than twice the sample distance.
    Uncovered {
        /// The edge.
        edge: Name,
        /// How far it is from the nearest disk.
        away: f64,
        /// The point.
        at: Point,
    },
    /// A path of a sampled axis runs farther than its samples allow outside of the disks at its ends.
    Jump {
        /// Number of the path.
        path: u32,
        /// What lies between the disks, in units of the input.
        between: f64,
        /// Where it starts.
        at: Point,
    },
    /// An end is not exactly a convex corner with its two edges and radius 0.
    End {
        /// Number of the keypoint.
        keypoint: u32,
        /// Its position.
        at: Point,
    },
    /// A convex corner has no end of the axis, or several.
    Corner {
        /// The corner.
        corner: Name,
        /// Number of ends there.
        ends: usize,
        /// The corner's place.
        at: Point,
    },
    /// A keypoint of degree two where no governor changes.
    FakeTransition {
        /// Number of the keypoint.
        keypoint: u32,
        /// Its position.
        at: Point,
    },
    /// Two keypoints have the same cyclic list of governors.
    RepeatedKeypoint {
        /// Number of the first one.
        first: u32,
        /// Number of the second one.
        second: u32,
        /// Position of the first one.
        at: Point,
    },
    /// The governors of a path are not neighbours, in its direction, in the list of one end.
    Gap {
        /// Number of the path.
        path: u32,
        /// Number of the keypoint.
        keypoint: u32,
        /// Position of the keypoint.
        at: Point,
    },
    /// No path leaves between two neighbouring governors.
    EmptyGap {
        /// Number of the keypoint.
        keypoint: u32,
        /// The governor to the right of the missing path, seen from the keypoint.
        right: u32,
        /// The governor to its left.
        left: u32,
        /// Position of the keypoint.
        at: Point,
    },
    /// Several paths leave between two neighbouring governors.
    CrowdedGap {
        /// Number of the keypoint.
        keypoint: u32,
        /// Number of the first path there.
        first: u32,
        /// Number of another one.
        second: u32,
        /// Position of the keypoint.
        at: Point,
    },
    /// A path between a corner and an edge that ends there, or between an element and itself: such
    /// normals are no paths of the axis.
    OwnEdge {
        /// Number of the path.
        path: u32,
        /// Where it starts.
        at: Point,
    },
    /// Both ends of a path have one disk: a keypoint of higher degree was left in pieces.
    Uncontracted {
        /// Number of the path.
        path: u32,
        /// Where it starts.
        at: Point,
    },
    /// A path runs against the direction its governors give it.
    Reversed {
        /// Number of the path.
        path: u32,
        /// Where it starts.
        at: Point,
    },
    /// A boundary element is nearer to the middle of a path than its governors.
    PathCut {
        /// Number of the path.
        path: u32,
        /// The element.
        by: Name,
        /// The middle of the path.
        at: Point,
    },
    /// A boundary walk governs nothing, as if its hole did not exist.
    LostWalk {
        /// Number of the walk in the domain.
        walk: u32,
        /// Its first edge.
        first: Name,
        /// Where that starts.
        at: Point,
    },
    /// No path of an exterior axis goes to infinity between two neighbouring corners of the convex hull.
    LostGap {
        /// The corner to the right, as seen outwards.
        right: Name,
        /// The corner to the left.
        left: Name,
        /// Half-way between them.
        at: Point,
    },
    /// A path of an exterior axis is cut that does not go to infinity, or once too often.
    StrayCut {
        /// The keypoint of kind `clipped`.
        keypoint: u32,
        /// Where it is.
        at: Point,
    },
    /// A path of an exterior axis is cut elsewhere than the others, or a keypoint lies beyond the frame.
    OffFrame {
        /// The keypoint.
        keypoint: u32,
        /// How far the box of the polygons must grow to reach it, in units of the input.
        margin: f64,
        /// The same for the frame, as the cut that is farthest away has it.
        frame: f64,
        /// Where it is.
        at: Point,
    },
    /// The outside of the domain could not be made a domain of its own: a fault of ours.
    NoOutside,
    /// The footpoints of the paths do not tile a boundary element from its start to its end.
    Untiled {
        /// The element.
        site: Name,
        /// How many chains of paths start along it; 1 in an axis.
        starts: usize,
        /// How many chains of paths end along it; 1 in an axis.
        ends: usize,
        /// Its first point.
        at: Point,
    },
    /// A count or sum over the whole axis is not what the domain demands.
    Identity(Identity),
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownSite { site, name, .. } => {
                write!(f, "site {site}: the domain has no {name} that could govern")
            }
            Self::MovedSite { site, name, .. } => {
                write!(f, "site {site}: coordinates differ from those of {name}, or are swapped")
            }
            Self::RepeatedSite { first, second, .. } => {
                write!(f, "sites {first} and {second} are the same boundary element")
            }
            Self::IdleSite { site, .. } => write!(f, "site {site} governs nothing"),
            Self::Kind { keypoint, kind, degree, .. } => {
                write!(f, "keypoint {keypoint}: {degree} paths meet at a keypoint of kind {kind}")
            }
            Self::ListStart { keypoint, .. } => {
                write!(f, "keypoint {keypoint}: the list does not start with its smallest governor")
            }
            Self::RepeatedGovernor { keypoint, site, .. } => {
                write!(f, "keypoint {keypoint}: governor {site} is listed twice")
            }
            Self::Order { keypoint, first, second, .. } => write!(
                f,
                "keypoint {keypoint}: governor {second} does not follow {first} counterclockwise"
            ),
            Self::NoDisk { keypoint, .. } => {
                write!(f, "keypoint {keypoint}: no disk touches its governors in their order")
            }
            Self::NotTouching { keypoint, site, .. } => {
                write!(f, "keypoint {keypoint}: its disk does not touch governor {site}")
            }
            Self::OutsideZone { keypoint, site, .. } => {
                write!(f, "keypoint {keypoint}: governor {site} is touched outside its zone")
            }
            Self::Cut { keypoint, by, .. } => {
                write!(f, "keypoint {keypoint}: {by} lies inside its disk")
            }
            Self::MissingGovernor { keypoint, site, .. } => {
                write!(f, "keypoint {keypoint}: its disk touches {site}, which is not listed")
            }
            Self::Position { keypoint, ulps, .. } => {
                write!(f, "keypoint {keypoint}: the position is {ulps:.1} ulps off")
            }
            Self::Radius { keypoint, ulps, .. } => {
                write!(f, "keypoint {keypoint}: the radius is {ulps:.1} ulps off")
            }
            Self::SampledRadius { keypoint, off, .. } => write!(
                f,
                "keypoint {keypoint}: the radius is {off} off, more than the sample distance"
            ),
            Self::Uncovered { edge, away, .. } => {
                write!(f, "{edge}: {away} from every disk, more than twice the sample distance")
            }
            Self::Jump { path, between, .. } => {
                write!(f, "path {path} runs {between:e} outside of the disks at its ends")
            }
            Self::End { keypoint, .. } => write!(
                f,
                "keypoint {keypoint}: an end must be a convex corner with its two edges, radius 0"
            ),
            Self::Corner { corner, ends, .. } => {
                write!(f, "convex {corner}: {ends} ends of the axis instead of one")
            }
            Self::FakeTransition { keypoint, .. } => {
                write!(f, "keypoint {keypoint}: no governor changes at this transition")
            }
            Self::RepeatedKeypoint { first, second, .. } => {
                write!(f, "keypoints {first} and {second} have the same list of governors")
            }
            Self::Gap { path, keypoint, .. } => write!(
                f,
                "path {path}: its governors are no neighbours in the list of keypoint {keypoint}"
            ),
            Self::EmptyGap { keypoint, right, left, .. } => write!(
                f,
                "keypoint {keypoint}: no path leaves between governors {right} and {left}"
            ),
            Self::CrowdedGap { keypoint, first, second, .. } => write!(
                f,
                "keypoint {keypoint}: paths {first} and {second} leave between the same governors"
            ),
            Self::OwnEdge { path, .. } => {
                write!(f, "path {path}: a corner and its own edge govern no path")
            }
            Self::Uncontracted { path, .. } => {
                write!(f, "path {path}: both ends have the same disk and should be one keypoint")
            }
            Self::Reversed { path, .. } => {
                write!(f, "path {path}: it runs against the direction of its governors")
            }
            Self::PathCut { path, by, .. } => {
                write!(f, "path {path}: {by} is nearer to its middle than its governors")
            }
            Self::LostWalk { walk, first, .. } => {
                write!(f, "boundary walk {walk}, with {first}, governs nothing")
            }
            Self::LostGap { right, left, .. } => {
                write!(f, "no path goes to infinity between {right} and {left}")
            }
            Self::StrayCut { keypoint, .. } => {
                write!(f, "keypoint {keypoint}: a path that does not go to infinity is cut here")
            }
            Self::OffFrame { keypoint, margin, frame, .. } => {
                write!(
                    f,
                    "keypoint {keypoint} is {margin} away from the box of the polygons, the frame {frame}"
                )
            }
            Self::NoOutside => return write!(f, "the outside of the domain cannot be judged"),
            Self::Untiled { site, starts, ends, .. } => {
                write!(f, "{site}: the cells along it start {starts} times and end {ends} times")
            }
            Self::Identity(identity) => return write!(f, "{identity}"),
        }?;
        self.at().map_or(Ok(()), |at| write!(f, ", at ({}, {})", at.x, at.y))
    }
}

impl Defect {
    /// Where to look; `None` for what concerns the whole axis.
    #[must_use]
    pub fn at(&self) -> Option<Point> {
        match *self {
            Self::UnknownSite { at, .. }
            | Self::MovedSite { at, .. }
            | Self::RepeatedSite { at, .. }
            | Self::IdleSite { at, .. }
            | Self::Kind { at, .. }
            | Self::ListStart { at, .. }
            | Self::RepeatedGovernor { at, .. }
            | Self::Order { at, .. }
            | Self::NoDisk { at, .. }
            | Self::NotTouching { at, .. }
            | Self::OutsideZone { at, .. }
            | Self::Cut { at, .. }
            | Self::MissingGovernor { at, .. }
            | Self::Position { at, .. }
            | Self::Radius { at, .. }
            | Self::SampledRadius { at, .. }
            | Self::Uncovered { at, .. }
            | Self::Jump { at, .. }
            | Self::End { at, .. }
            | Self::Corner { at, .. }
            | Self::FakeTransition { at, .. }
            | Self::RepeatedKeypoint { at, .. }
            | Self::Gap { at, .. }
            | Self::EmptyGap { at, .. }
            | Self::CrowdedGap { at, .. }
            | Self::OwnEdge { at, .. }
            | Self::Uncontracted { at, .. }
            | Self::Reversed { at, .. }
            | Self::PathCut { at, .. }
            | Self::LostWalk { at, .. }
            | Self::LostGap { at, .. }
            | Self::StrayCut { at, .. }
            | Self::OffFrame { at, .. }
            | Self::Untiled { at, .. } => Some(at),
            Self::Identity(_) | Self::NoOutside => None,
        }
    }
}
