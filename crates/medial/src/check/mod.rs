//! The judge: every defect of an axis, found without trusting anything in it.
//!
//! # Contract
//! A complete exact axis without a defect is the medial axis of the domain: graph, governors and
//! their order exactly, positions and radii within four units in the last place.
//! O(n log n) for n edges.
//!
//! # Method
//! 1. Match the sites with the domain by name and bits.
//! 2. Keypoint by keypoint, enclose the disk that touches the governors and decide that all touch
//!    it inside their zones, counterclockwise, and that nothing else touches or cuts it.
//! 3. Path by path, match the governors with the gaps between neighbouring contacts at both ends,
//!    and decide that the two disks are distinct and follow one another.
//! 4. Along the boundary, see that the footpoints tile every site.
//! 5. Compare counts and areas with what the domain demands.
//!
//! In a complete axis steps 3 and 4 and the contacts of step 2 leave no room for anything nearer:
//! each site has a cell between it and its paths, two cells meet at each path, from both sides, and
//! cells fill the full turn around each keypoint. Glued together they are a compact surface that
//! lies in the plane without folds and has the boundary of the domain as its own, run through in
//! its direction. So it covers each point as often as that boundary winds around it: once inside,
//! never outside. That rules out spokes that turn around a corner beyond its zone as well, and
//! paths that close around one. It is the domain, covered once. The distance to the site of one's
//! own cell is continuous over it, so it shrinks no faster than one goes; on the straight way to
//! the nearest site it shrinks to zero, so it is no larger than that way. Looking at what is near
//! each disk finds faults earlier and names them better; but where hundreds of edges are near one,
//! as in smooth shapes, it stops there.
//!
//! An exterior axis is judged as that of the complement, without the walls that make it a domain.
//! Where its paths are cut the cells reach infinity: the cuts must be just those between the corners
//! of each gap of the convex hull, and edges of the hull have no footpoints. In the argument the
//! point at infinity takes the place of a boundary walk: the surface covers the sphere there once,
//! because the unbounded cells follow one another as the hull does.
//!
//! Bounds in double-double decide nearly everything, exact numbers what is left; floats alone are
//! used only where a failure is sure in spite of rounding.

mod areas;
mod boundary;
mod context;
mod defect;
mod difference;
mod direction;
mod disks;
mod enclosure;
mod frame;
mod horizon;
mod identities;
mod keypoints;
mod maximal_disk;
mod name;
mod paths;
mod sampled;
mod verdict;

pub use defect::Defect;
pub use difference::{Difference, difference};
pub use name::Name;
pub use verdict::{Counts, Identity, LeftOut, Relation, Verdict};

use crate::axis::{Accuracy, MedialAxis, Side};
use crate::domain::{Complement, Domain};
use crate::geom::{Point, Rect};
use context::Context;

/// Every defect of an axis of a domain, with counts and identities.
///
/// Works on any axis, however wrong.
///
/// ```
/// use medial::check::{self, Defect};
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// let corners = [(0.0, 0.0), (5.0, 0.0), (5.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
/// let rectangle = Domain::from_polygons(&[vec![corners.to_vec()]], &Options::default())?;
/// let verdict = check::defects(&rectangle, &path_tracing(&rectangle)?);
/// assert!(verdict.defects.is_empty());
/// assert_eq!((verdict.counts.ends, verdict.counts.junctions, verdict.counts.paths), (4, 2, 5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn defects(domain: &Domain, axis: &MedialAxis) -> Verdict {
    match axis.side {
        Side::Interior => judge(domain, None, axis),
        Side::Exterior => match Complement::new(domain, &around(domain)) {
            Ok(outside) => judge(outside.domain(), Some(&outside), axis),
            Err(_) => Verdict { defects: vec![Defect::NoOutside], ..Verdict::default() },
        },
    }
}

/// A box with a domain in its inside.
fn around(domain: &Domain) -> Rect {
    let bounds = domain.edges().iter().fold(Rect::EMPTY, |all, edge| all.with(edge.start));
    // Twice as far from the origin, on both sides, whatever the rounding.
    let far = |p: Point| 2.0 * p.x.abs().max(p.y.abs());
    let reach = far(bounds.min).max(far(bounds.max));
    Rect { min: Point::new(-reach, -reach), max: Point::new(reach, reach) }
}

/// Every defect of an axis of a domain, which may be the outside of the one of the input.
fn judge(domain: &Domain, outside: Option<&Complement>, axis: &MedialAxis) -> Verdict {
    let mut defects = Vec::new();
    let context = Context::new(domain, outside, axis, &mut defects);
    let counts = identities::counts(&context);
    let mut left_out = Vec::new();
    let exact = match axis.accuracy {
        Accuracy::Exact => {
            check_idle(&context, &mut defects);
            let found = keypoints::check(&context, &mut defects);
            paths::check(&context, &found, &mut defects);
            frame::check(&context, &mut defects);
            if axis.complete {
                boundary::check(&context, &found, &mut defects);
                horizon::check(&context, &mut defects);
            }
            true
        }
        Accuracy::Sampled(spacing) => {
            sampled::check_radii(&context, spacing, &mut defects);
            sampled::check_steps(&context, spacing, &mut defects);
            if axis.complete {
                sampled::check_cover(&context, spacing, &mut defects);
            }
            left_out.push(LeftOut::Governors);
            false
        }
    };
    if !(axis.complete && exact) {
        left_out.extend([LeftOut::Leaves, LeftOut::Tiling, LeftOut::Area]);
    }
    let mut all = Vec::new();
    // Whatever pruning took from a sampled axis, it hangs together as before.
    if axis.complete || !exact {
        all = identities::identities(&context, &counts);
        if exact && outside.is_none() {
            all.push(areas::identity(&context));
        } else if exact {
            left_out.push(LeftOut::Area);
        }
    } else {
        left_out.push(LeftOut::Counts);
    }
    let broken = all.iter().filter(|identity| !identity.holds());
    defects.extend(broken.map(|&identity| Defect::Identity(identity)));
    Verdict { defects, counts, identities: all, left_out }
}

/// Sites that neither a keypoint nor a path uses.
fn check_idle(context: &Context, defects: &mut Vec<Defect>) {
    let axis = context.axis;
    let mut used = vec![false; axis.sites().len()];
    for k in 0..axis.keypoints().len() as u32 {
        axis.governors(k).iter().for_each(|&g| used[g as usize] = true);
    }
    for path in axis.paths() {
        used[path.left as usize] = true;
        used[path.right as usize] = true;
    }
    for (site, _) in (0..).zip(&used).filter(|&(_, &used)| !used) {
        let at = axis.sites().at(site).a;
        defects.push(Defect::IdleSite { site, at });
    }
}
