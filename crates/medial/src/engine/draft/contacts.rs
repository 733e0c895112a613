use std::cmp::Ordering;

use smallvec::SmallVec;

use crate::domain::{Corner, Domain, Site};
use crate::geom::predicates::ExactDisk;
use crate::geom::{Point, TouchingDisk, cross_directions};

/// Angles of footpoints closer than this, in quarters of a turn or less, are ordered exactly.
///
/// Where the disk's bound is not far below that share of its radius, all are.
const CLEAR_ANGLE: f64 = 1e-6;

/// Governors of a keypoint; more than a few are rare.
pub(in crate::engine) type Contacts = SmallVec<[Site; 8]>;

/// A cyclic list from its smallest member on.
pub(in crate::engine) fn from_least(list: &[Site]) -> Contacts {
    if let [a, b, c] = *list {
        return Contacts::from_slice(&three_from_least([a, b, c]));
    }
    if let [a, b, c, d] = *list {
        let turned = match [a, b, c, d].into_iter().min() {
            least if least == Some(a) => [a, b, c, d],
            least if least == Some(b) => [b, c, d, a],
            least if least == Some(c) => [c, d, a, b],
            _ => [d, a, b, c],
        };
        return Contacts::from_slice(&turned);
    }
    let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
    let (mut from_least, (end, start)) = (Contacts::new(), list.split_at(least));
    from_least.extend_from_slice(start);
    from_least.extend_from_slice(end);
    from_least
}

/// The same of three.
#[inline]
pub(in crate::engine) fn three_from_least([a, b, c]: [Site; 3]) -> [Site; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Sorts contacts counterclockwise by footpoint and drops repetitions.
pub(in crate::engine) fn sort(
    domain: &Domain,
    disk: &TouchingDisk,
    exact: Option<&ExactDisk>,
    triple: &[Site; 3],
    contacts: &mut Contacts,
) {
    if contacts.len() == 3 && contacts[..] == triple[..] {
        // Certified in this order.
        return;
    }
    contacts.sort_unstable();
    contacts.dedup();
    if contacts.len() == 3 && triple.iter().all(|s| contacts.contains(s)) {
        contacts.copy_from_slice(triple);
        return;
    }
    let centre = disk.position();
    let rounding = f64::EPSILON * (centre.x.abs() + centre.y.abs());
    if let Some(exact) = exact
        && 8.0 * (disk.bound + rounding) > CLEAR_ANGLE * disk.radius
    {
        sort_exactly(domain, exact, contacts);
        return;
    }
    let mut by_angle: SmallVec<[(f64, Site); 8]> =
        contacts.iter().map(|&s| (angle(domain, disk, s), s)).collect();
    by_angle.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    // Cut the circle at its widest gap, so that no doubtful pair is torn apart.
    let n = by_angle.len();
    let gap = |k: usize| {
        let turn = if k == 0 { TURN } else { 0.0 };
        by_angle[k].0 + turn - by_angle[(k + n - 1) % n].0
    };
    let first = (0..n).max_by(|&a, &b| gap(a).total_cmp(&gap(b))).unwrap_or(0);
    by_angle.rotate_left(first);
    let mut start = 0;
    while start < n {
        let mut end = start + 1;
        while end < n {
            let step = by_angle[end].0 - by_angle[end - 1].0;
            let step = if step < 0.0 { step + TURN } else { step };
            if step > CLEAR_ANGLE {
                break;
            }
            end += 1;
        }
        by_angle[start..end].sort_by(|a, b| exact_order(domain, exact, a.1, b.1));
        start = end;
    }
    contacts.clear();
    contacts.extend(by_angle.iter().map(|&(_, s)| s));
}

/// Sorts without any angle: by the side of one contact, then by turns within each half.
fn sort_exactly(domain: &Domain, disk: &ExactDisk, contacts: &mut Contacts) {
    // Runs share a footpoint; each is sorted by its first site.
    let heads: Vec<Site> = contacts
        .iter()
        .copied()
        .filter(|&s| !contacts.iter().any(|&before| follows(domain, before, s)))
        .collect();
    let Some((&first, others)) = heads.split_first() else { return };
    let order = |a: Site, b: Site| exact_order(domain, Some(disk), a, b);
    // Less: counterclockwise of the first one by less than half a turn; equal: opposite.
    let mut others: Vec<(Ordering, Site)> = others.iter().map(|&s| (order(first, s), s)).collect();
    others.sort_by(|a, b| a.0.cmp(&b.0).then_with(|| order(a.1, b.1)));
    let all = std::mem::take(contacts);
    for head in std::iter::once(first).chain(others.into_iter().map(|o| o.1)) {
        let mut next = Some(head);
        while let Some(site) = next {
            contacts.push(site);
            next = all.iter().copied().find(|&s| follows(domain, site, s));
        }
    }
}

/// A whole turn, as [`angle`] counts.
const TURN: f64 = 4.0;

/// The direction of a footpoint as a number that grows counterclockwise, by one each quarter of a turn
/// and nowhere faster than the angle in radians.
fn angle(domain: &Domain, disk: &TouchingDisk, site: Site) -> f64 {
    let edge = domain.edge(site.index());
    let foot = if site.is_edge() {
        -edge.direction.perp()
    } else {
        (edge.start - disk.origin) - disk.centre
    };
    let share = foot.y / (foot.x.abs() + foot.y.abs());
    if foot.x >= 0.0 {
        share
    } else if foot.y >= 0.0 {
        2.0 - share
    } else {
        -2.0 - share
    }
}

/// The counterclockwise order of two contacts less than half a turn apart.
fn exact_order(domain: &Domain, exact: Option<&ExactDisk>, a: Site, b: Site) -> Ordering {
    if follows(domain, a, b) {
        return Ordering::Less;
    }
    if follows(domain, b, a) {
        return Ordering::Greater;
    }
    if a == b {
        return Ordering::Equal;
    }
    let Some(disk) = exact else { return a.cmp(&b) };
    let ends = |s: Site| (domain.edge(s.index()).start, domain.end(s.index()));
    let ((pa, qa), (pb, qb)) = (ends(a), ends(b));
    // Positive: `b` comes after `a`.
    let turn = match (a.is_edge(), b.is_edge()) {
        (true, true) => direction_turn(pa, qa, pb, qb),
        (true, false) => disk.along(pa, qa, pb).reverse(),
        (false, true) => disk.along(pb, qb, pa),
        (false, false) => disk.orientation(pa, pb),
    };
    turn.reverse()
}

/// The sign of `(qa - pa) × (qb - pb)`, exactly.
fn direction_turn(pa: Point, qa: Point, pb: Point, qb: Point) -> Ordering {
    // Zero has two signs.
    cross_directions(pa, qa, pb, qb).partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// Whether `b` comes directly after `a` along the boundary.
#[inline]
pub(in crate::engine) fn follows(domain: &Domain, a: Site, b: Site) -> bool {
    let next = if a.is_edge() { domain.edge(a.index()).next } else { a.index() };
    if a.is_edge() {
        b == Site::corner(next)
            || (b == Site::edge(next) && domain.edge(next).corner == Corner::Straight)
    } else {
        b == Site::edge(next)
    }
}
