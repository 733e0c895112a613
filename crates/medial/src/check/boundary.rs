//! Along the boundary: every convex corner has its end, every site is tiled, every walk governs.

use super::context::{Context, is_site};
use super::keypoints::Keypoints;
use super::{Defect, Name};
use crate::domain::{Corner, Site};

/// Checks what the keypoints and paths leave along the boundary of the domain.
///
/// At an inner keypoint a chain of paths along a site goes on, unless the contact is a corner,
/// where one chain ends and another starts. Footpoints move strictly forward along every path, so
/// a site with one start and one end is tiled from its start to its end. An edge on the hull as seen
/// from outside has no chain, and the corners at its ends none on its side: their common normal goes
/// to infinity.
pub(super) fn check(context: &Context, found: &Keypoints, defects: &mut Vec<Defect>) {
    let domain = context.domain;
    let mut governs = vec![false; 2 * domain.edges().len()];
    for path in context.axis.paths() {
        for number in [path.left, path.right] {
            if let Some(site) = context.sites[number as usize] {
                governs[site.0 as usize] = true;
            }
        }
    }
    for (number, walk) in context.walks() {
        let edges = walk.edges();
        let sites = |edge: u32| [Site::corner(edge), Site::edge(edge)];
        if !edges.clone().flat_map(sites).any(|site| governs[site.0 as usize]) {
            // What is convex has no axis outside.
            if edges.clone().all(|edge| context.is_on_hull(edge)) {
                continue;
            }
            let first = Site::edge(walk.first);
            defects.push(Defect::LostWalk {
                walk: number as u32,
                first: Name::of(domain, first),
                at: domain.edge(walk.first).start,
            });
            continue;
        }
        for edge in edges {
            check_edge(context, found, edge, defects);
        }
    }
}

/// The corner at the start of an edge, and the edge.
fn check_edge(context: &Context, found: &Keypoints, edge: u32, defects: &mut Vec<Defect>) {
    let domain = context.domain;
    let at = domain.edge(edge).start;
    let convex = |edge: u32| domain.edge(edge).corner == Corner::Convex;
    let chains = |site: Site| {
        let site = site.0 as usize;
        (found.starts[site] as usize, found.ends[site] as usize)
    };
    let site = Site::edge(edge);
    let (starts, ends) = chains(site);
    let wanted = |edge: u32| usize::from(!context.is_on_hull(edge));
    // At a convex corner only an end starts the chain of its second edge.
    if convex(edge) && starts != wanted(edge) {
        let corner = Name::of(domain, Site::corner(edge));
        defects.push(Defect::Corner { corner, ends: starts, at });
    }
    let start_is_wrong = !convex(edge) && starts != wanted(edge);
    let end_is_wrong = !convex(domain.edge(edge).next) && ends != wanted(edge);
    if start_is_wrong || end_is_wrong {
        defects.push(Defect::Untiled { site: Name::of(domain, site), starts, ends, at });
    }
    let corner = Site::corner(edge);
    let (starts, ends) = chains(corner);
    let both = (wanted(domain.edge(edge).prev), wanted(edge));
    if is_site(domain, corner) && (starts, ends) != both {
        defects.push(Defect::Untiled { site: Name::of(domain, corner), starts, ends, at });
    }
}
