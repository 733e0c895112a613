//! The third engine: every triple of sites, for small shapes.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use medial::axis::{
    Accuracy, Engine, KeypointKind, MedialAxis, Path, Side, Site as AxisSite, SiteKind,
};
use medial::domain::{Corner, Domain, Site};
use medial::geom::predicates::{Element, ExactDisk};
use medial::geom::{Point, TouchingDisk, cross_directions, orient2d};

/// A site nearer than this share of the box's size below the radius is surely inside a disk.
///
/// Rounded disks are right to an ulp, so this only saves exact arithmetic.
const CLEARLY: f64 = 1e-9;

/// The medial axis of a small domain, from the disks of all triples of sites.
///
/// # Panics
/// If the paths do not match up.
pub fn axis(domain: &Domain) -> MedialAxis {
    try_axis(domain).unwrap_or_else(|e| panic!("{e}"))
}

/// The same, or why it cannot be told.
pub fn try_axis(domain: &Domain) -> Result<MedialAxis, String> {
    let disks = disks(domain)?;
    let mut points: Vec<Found> = ends(domain);
    points.extend(disks);
    let used: BTreeSet<Site> = points.iter().flat_map(|p| p.list.iter().copied()).collect();
    let number: BTreeMap<Site, u32> = used.iter().copied().zip(0..).collect();
    let paths = paths(domain, &points, &number)?;
    let mut degrees = vec![0; points.len()];
    for path in &paths {
        degrees[path.from as usize] += 1;
        degrees[path.to as usize] += 1;
    }
    let from_least = |p: &Found| {
        let mut list: Vec<u32> = p.list.iter().map(|site| number[site]).collect();
        let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
        list.rotate_left(least);
        list
    };
    let lists: Vec<Vec<u32>> = points.iter().map(from_least).collect();
    let keypoints = points.iter().zip(&degrees).zip(&lists).map(|((p, &degree), list)| {
        let kind = match degree {
            _ if p.disk.is_none() => KeypointKind::End,
            2 => KeypointKind::Transition,
            _ => KeypointKind::Junction,
        };
        (p.centre, p.radius, kind, list.as_slice())
    });
    MedialAxis::from_parts(
        Engine::PathTracing,
        Side::Interior,
        Accuracy::Exact,
        true,
        used.iter().map(|&site| axis_site(domain, site)).collect(),
        keypoints,
        paths,
    )
    .ok_or_else(|| "numbers point outside their tables".into())
}

/// A site of the domain as the axis names it.
pub fn axis_site(domain: &Domain, site: Site) -> AxisSite {
    let origin = domain.origin(site.index());
    let a = domain.edge(site.index()).start;
    if site.is_edge() {
        AxisSite {
            kind: SiteKind::Edge,
            polygon: origin.polygon,
            ring: origin.ring,
            index: origin.index,
            part: origin.part,
            a,
            b: domain.end(site.index()),
        }
    } else {
        AxisSite {
            kind: SiteKind::Vertex,
            polygon: origin.corner.polygon,
            ring: origin.corner.ring,
            index: origin.corner.index,
            part: origin.corner.part,
            a,
            b: a,
        }
    }
}

/// A keypoint.
struct Found {
    centre: Point,
    radius: f64,
    /// `None` at an end.
    disk: Option<ExactDisk>,
    /// Governors counterclockwise.
    list: Vec<Site>,
    /// The list cut into contacts: first and last governor of each.
    contacts: Vec<(Site, Site)>,
}

fn ends(domain: &Domain) -> Vec<Found> {
    let edges = (0..domain.edges().len() as u32)
        .filter(|&e| domain.edge(e).corner == Corner::Convex)
        .map(|e| (domain.edge(e).start, Site::edge(domain.edge(e).prev), Site::edge(e)));
    edges
        .map(|(centre, before, after)| Found {
            centre,
            radius: 0.0,
            disk: None,
            list: vec![before, after],
            // A path leaves between the edge after the corner, on its right, and the one before.
            contacts: vec![(after, after), (before, before)],
        })
        .collect()
}

/// Everything that can be touched: edges, and corners that are not convex. Straight ones are no
/// sites but show where one edge takes over from another.
fn candidates(domain: &Domain) -> Vec<Site> {
    (0..domain.edges().len() as u32)
        .flat_map(|e| [Site::corner(e), Site::edge(e)])
        .filter(|s| s.is_edge() || domain.edge(s.index()).corner != Corner::Convex)
        .collect()
}

fn element(domain: &Domain, site: Site) -> Element {
    let a = domain.edge(site.index()).start;
    if site.is_edge() { Element::Edge(a, domain.end(site.index())) } else { Element::Corner(a) }
}

/// All maximal disks with three governors or more.
fn disks(domain: &Domain) -> Result<Vec<Found>, String> {
    let all = candidates(domain);
    let mut found: BTreeMap<Vec<Site>, Found> = BTreeMap::new();
    for (i, &a) in all.iter().enumerate() {
        for (j, &b) in all.iter().enumerate().skip(i + 1) {
            if !may_share(domain, a, b) {
                continue;
            }
            let third = all[j + 1..].iter().copied();
            for c in third.filter(|&c| may_share(domain, a, c) && may_share(domain, b, c)) {
                for triple in [[a, b, c], [a, c, b]] {
                    if clearly_cut(domain, triple) {
                        continue;
                    }
                    let Some(disk) = ExactDisk::new(triple.map(|s| element(domain, s))) else {
                        continue;
                    };
                    if let Some(touched) = maximal(domain, &disk, triple, &all)
                        && let Some(point) = keypoint(domain, disk, &touched)?
                    {
                        found.insert(point.list.clone(), point);
                    }
                }
            }
        }
    }
    Ok(found.into_values().collect())
}

/// Whether a disk may touch both: no edge has the other element behind its line.
fn may_share(domain: &Domain, a: Site, b: Site) -> bool {
    let ends = |site: Site| {
        let edge = domain.edge(site.index());
        [edge.start, if site.is_edge() { domain.end(site.index()) } else { edge.start }]
    };
    let in_front = |edge: Site, other: Site| {
        let [start, end] = ends(edge);
        !edge.is_edge() || ends(other).iter().any(|&p| orient2d(start, end, p) >= 0.0)
    };
    in_front(a, b) && in_front(b, a)
}

/// Whether doubles prove that an edge lies inside the disk; saves most of the exact arithmetic.
fn clearly_cut(domain: &Domain, three: [Site; 3]) -> bool {
    let governors = three.map(|site| domain.governor(site));
    let near = domain.edge(three[0].index()).start;
    let Some(disk) = TouchingDisk::guess(&governors, near).and_then(|d| d.certified(&governors))
    else {
        return false;
    };
    let (centre, radius) = (disk.position(), disk.radius);
    let scale = centre.x.abs() + centre.y.abs() + radius;
    let inside = radius - disk.bound - CLEARLY * scale;
    (0..domain.edges().len() as u32).any(|edge| closed_distance(domain, centre, edge) < inside)
}

/// Everything a disk touches, if nothing cuts it.
fn maximal(domain: &Domain, disk: &ExactDisk, three: [Site; 3], all: &[Site]) -> Option<Vec<Site>> {
    let (centre, radius) = disk.approximate();
    if radius <= 0.0 {
        return None;
    }
    let scale = centre.x.abs() + centre.y.abs() + radius;
    for edge in 0..domain.edges().len() as u32 {
        if closed_distance(domain, centre, edge) < radius - CLEARLY * scale {
            return None;
        }
    }
    if !three.iter().all(|&site| in_zone(domain, disk, site)) {
        return None;
    }
    let mut touched = Vec::new();
    for &site in all {
        if three.contains(&site) {
            touched.push(site);
            continue;
        }
        if !in_zone(domain, disk, site) {
            continue;
        }
        if site.is_edge() {
            let (a, b) = (domain.edge(site.index()).start, domain.end(site.index()));
            if disk.front(a, b).is_lt() {
                // Seen from behind it governs nothing, but may still cut.
                if disk.side(Element::Edge(b, a)).is_lt() {
                    return None;
                }
                continue;
            }
        }
        match disk.side(element(domain, site)) {
            Ordering::Less => return None,
            Ordering::Equal => touched.push(site),
            Ordering::Greater => {}
        }
    }
    // A convex corner can be nearest only from outside.
    for edge in 0..domain.edges().len() as u32 {
        if disk.side(Element::Corner(domain.edge(edge).start)).is_lt() {
            return None;
        }
    }
    Some(touched)
}

fn closed_distance(domain: &Domain, p: Point, edge: u32) -> f64 {
    let (a, b) = (domain.edge(edge).start, domain.end(edge));
    let d = b - a;
    let t = ((p - a).dot(d) / d.norm2()).clamp(0.0, 1.0);
    (p - (a + d * t)).norm()
}

fn in_zone(domain: &Domain, disk: &ExactDisk, site: Site) -> bool {
    let edge = domain.edge(site.index());
    let (start, end) = (edge.start, domain.end(site.index()));
    if site.is_edge() {
        disk.along(start, end, start).is_ge() && disk.along(start, end, end).is_le()
    } else {
        let before = domain.edge(edge.prev).start;
        disk.along(before, start, start).is_ge() && disk.along(start, end, start).is_le()
    }
}

/// Sorts what a disk touches; `None` if there are fewer than two contacts, or nothing changes.
fn keypoint(domain: &Domain, disk: ExactDisk, touched: &[Site]) -> Result<Option<Found>, String> {
    let (centre, radius) = disk.approximate();
    let Some(&first) = touched.first() else { return Ok(None) };
    // Counterclockwise, from the first one on.
    let order = |a: Site, b: Site| {
        let part = |site| quarter(domain, &disk, first, site);
        part(a).cmp(&part(b)).then_with(|| turn(domain, &disk, a, b).reverse())
    };
    let mut sorted = touched.to_vec();
    sorted.sort_by(|&a, &b| order(a, b));
    let mut runs: Vec<Vec<Site>> = Vec::new();
    for (k, &here) in sorted.iter().enumerate() {
        match runs.last_mut() {
            Some(run) if order(sorted[k - 1], here).is_eq() => run.push(here),
            _ => runs.push(vec![here]),
        }
    }
    for run in &mut runs {
        along_boundary(domain, run)?;
        run.retain(|s| s.is_edge() || domain.edge(s.index()).corner == Corner::Reflex);
    }
    let mut list: Vec<Site> = runs.concat();
    if runs.len() < 2 || list.len() < 3 {
        return Ok(None);
    }
    runs.retain(|run| !run.is_empty());
    let contacts = runs.iter().map(|run| (run[0], run[run.len() - 1])).collect();
    let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
    list.rotate_left(least);
    Ok(Some(Found { centre, radius, disk: Some(disk), list, contacts }))
}

/// 0 if both contacts are one, and then 1, 2, 3 for less than half a turn counterclockwise from
/// `a` to `b`, half a turn, and more.
fn quarter(domain: &Domain, disk: &ExactDisk, a: Site, b: Site) -> u8 {
    let ends = |site: Site| (domain.edge(site.index()).start, domain.end(site.index()));
    let ((p, p_end), (q, q_end)) = (ends(a), ends(b));
    match turn(domain, disk, a, b) {
        Ordering::Greater => 1,
        Ordering::Less => 3,
        Ordering::Equal => {
            let one = match (a.is_edge(), b.is_edge()) {
                (true, true) => (p_end - p).dot(q_end - q) > 0.0,
                (true, false) => orient2d(p, p_end, q) == 0.0,
                (false, true) => orient2d(q, q_end, p) == 0.0,
                (false, false) => p == q,
            };
            if one { 0 } else { 2 }
        }
    }
}

/// `Greater` if from the centre the contact with `b` lies counterclockwise of that with `a` by less
/// than half a turn.
fn turn(domain: &Domain, disk: &ExactDisk, a: Site, b: Site) -> Ordering {
    let ends = |site: Site| (domain.edge(site.index()).start, domain.end(site.index()));
    let ((p, p_end), (q, q_end)) = (ends(a), ends(b));
    match (a.is_edge(), b.is_edge()) {
        (true, true) => {
            let turn = cross_directions(p, p_end, q, q_end);
            turn.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
        }
        // A contact with an edge is found from the centre by a right turn from its direction.
        (true, false) => disk.along(p, p_end, q).reverse(),
        (false, true) => disk.along(q, q_end, p),
        (false, false) => disk.orientation(p, q),
    }
}

/// Puts the governors with one contact in boundary order.
fn along_boundary(domain: &Domain, run: &mut [Site]) -> Result<(), String> {
    // Around a corner only its edge before, itself and its edge after can share a contact.
    let before = |a: Site, b: Site| match (a.is_edge(), b.is_edge()) {
        (false, true) => a.index() == b.index(),
        (true, _) => domain.edge(a.index()).next == b.index(),
        (false, false) => false,
    };
    if run.len() > 3 {
        return Err(format!("contacts too close: {run:?}"));
    }
    for _ in 0..run.len() {
        for k in 1..run.len() {
            if before(run[k], run[k - 1]) {
                run.swap(k, k - 1);
            }
        }
    }
    if run.windows(2).all(|pair| before(pair[0], pair[1])) {
        Ok(())
    } else {
        Err(format!("contacts too close: {run:?}"))
    }
}

/// Links the keypoints: along the bisector of two sites a path starts wherever they are neighbours
/// in one order and ends at the next place where they are in the other.
fn paths(
    domain: &Domain,
    points: &[Found],
    number: &BTreeMap<Site, u32>,
) -> Result<Vec<Path>, String> {
    // For right < left: keypoints with the gap (right, left), and whether a path starts there.
    let mut lines: BTreeMap<(Site, Site), Vec<(usize, bool)>> = BTreeMap::new();
    for (k, point) in points.iter().enumerate() {
        let n = point.contacts.len();
        let gaps = if point.disk.is_none() { 1 } else { n };
        for gap in 0..gaps {
            let right = point.contacts[gap].1;
            let left = point.contacts[(gap + 1) % n].0;
            lines.entry((right.min(left), right.max(left))).or_default().push((k, right < left));
        }
    }
    let mut paths = Vec::new();
    for ((right, left), mut line) in lines {
        let r = (domain.edge(right.index()).start, domain.end(right.index()));
        let l = (domain.edge(left.index()).start, domain.end(left.index()));
        line.sort_by(|&(a, a_starts), &(b, b_starts)| {
            match (&points[a].disk, &points[b].disk) {
                (Some(a), Some(b)) if right.is_edge() => a.compare_along(b, r.0, r.1),
                (Some(a), Some(b)) if left.is_edge() => b.compare_along(a, l.0, l.1),
                (Some(a), Some(b)) => b.compare_across(a, r.0, l.0),
                // A corner between the two edges is the first or the last point of the bisector.
                (None, Some(_)) => {
                    if a_starts {
                        Ordering::Less
                    } else {
                        Ordering::Greater
                    }
                }
                (Some(_), None) => {
                    if b_starts {
                        Ordering::Greater
                    } else {
                        Ordering::Less
                    }
                }
                (None, None) => Ordering::Equal,
            }
        });
        for pair in line.chunks(2) {
            let &[(from, true), (to, false)] = pair else {
                return Err(format!("paths between {right:?} and {left:?} do not match: {line:?}"));
            };
            paths.push(Path {
                from: from as u32,
                to: to as u32,
                left: number[&left],
                right: number[&right],
            });
        }
    }
    Ok(paths)
}
