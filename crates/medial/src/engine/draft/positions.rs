//! Positions and radii of keypoints, from one fixed triple of governors.
//!
//! The triple depends on the governor list, and not on how the keypoint was found, so engines,
//! orders of tracing and numbers of threads agree; the centre found serves to weigh corners, with a
//! margin. Where the bound of what is computed in twice the precision of doubles ([`super::refine`])
//! is too large, the exact disk is evaluated instead.

use smallvec::SmallVec;

use super::contacts::{Contacts, follows};
use super::refine::refined;
use crate::domain::{Domain, Site};
use crate::geom::predicates::ExactDisk;
use crate::geom::{Point, TouchingDisk};

/// How many times the doubt about a start goes into the radius before no second disk of the same
/// triple can be meant.
const FAR_APART: f64 = 64.0;

/// How much wider the normals of a triple must spread to be preferred to an earlier one, so that
/// the rounding of the centre does not choose.
const CLEARLY_WIDER: f64 = 1.0 + 1e-6;

/// Contact runs up to which every triple is weighed.
const FEW_RUNS: usize = 6;

/// Where a disk is, in the coordinates of the input.
#[derive(Clone, Copy, Debug)]
pub(in crate::engine) struct Place {
    pub centre: Point,
    pub radius: f64,
    /// Bound on the error of both.
    pub doubt: f64,
}

impl Place {
    /// That of a certified disk.
    pub fn of(disk: &TouchingDisk) -> Self {
        let centre = disk.position();
        let size = |p: Point| p.x.abs() + p.y.abs();
        let rounding = f64::EPSILON * (size(centre) + size(disk.origin));
        Self { centre, radius: disk.radius, doubt: disk.bound + rounding }
    }
}

/// The disk of a keypoint as it was found.
pub(in crate::engine) struct Fixed<'a> {
    /// The disk, if it depends on the governors only, and not on how it was found.
    pub own: Option<&'a TouchingDisk>,
    /// Whether that is what doubles find for the governors, which are three.
    pub sought: bool,
    /// The disk within its bound.
    pub found: &'a TouchingDisk,
    /// Sites that define it exactly.
    pub triple: [Site; 3],
}

/// Centre and radius of a keypoint with these governors, within 4 ulp of max(|x|, |y|, radius).
#[inline(never)]
pub(in crate::engine) fn position(
    domain: &Domain,
    list: &[Site],
    disk: &Fixed<'_>,
) -> Option<(Point, f64)> {
    let whole = disk.own.unwrap_or(disk.found);
    let found = Place::of(whole);
    let triple = best_triple(domain, list, whole).unwrap_or(disk.triple);
    let governors = domain.governors(triple);
    // Far from the start there may be another disk of the same three elements.
    let near = |c: Point, r: f64, doubt: f64| {
        (c - found.centre).norm() + (r - found.radius).abs() <= 4.0 * doubt
            && doubt <= r / FAR_APART
    };
    // Where the steps begin may tell in the last bit: at the disk that doubles find for the triple
    // alone.
    let start = if disk.own.is_some() && list.len() == 3 {
        Some(found)
    } else if disk.sought && disk.own.is_none() && triple.iter().all(|site| list.contains(site)) {
        None
    } else {
        let disk = TouchingDisk::touching(&governors);
        let start = disk.map(|disk| Place::of(&disk));
        let start = start.filter(|s| near(s.centre, s.radius, found.doubt + s.doubt));
        if let (Some(disk), Some(_)) = (disk, start)
            && disk.is_precise()
        {
            return Some((disk.position(), disk.radius));
        }
        start
    };
    if let Some(Place { centre, radius, doubt }) = start {
        let precise = refined(&governors, centre, radius);
        if let Some(precise) = precise.filter(|&(c, r)| near(c, r, found.doubt + doubt)) {
            return Some(precise);
        }
    }
    // The same for every rotation of the three, bit for bit.
    let exact = |&[a, b, c]: &[Site; 3]| {
        let turned = [[a, b, c], [b, c, a], [c, a, b]].into_iter().min_by_key(|t| t[0]);
        ExactDisk::precise(turned?.map(|s| domain.element(s)))
    };
    exact(&triple).or_else(|| exact(&disk.triple)).map(|disk| disk.rounded_once())
}

/// The triple of a governor list with the widest spread of normals; of equal ones the first.
///
/// The disk is taken relative to its origin: rounded to the coordinates of a small shape far from
/// the origin of the plane, its centre would let rounding choose.
fn best_triple(domain: &Domain, list: &[Site], disk: &TouchingDisk) -> Option<[Site; 3]> {
    if let [a, b, c] = *list
        && !follows(domain, a, b)
        && !follows(domain, b, c)
        && !follows(domain, c, a)
    {
        return Some([a, b, c]);
    }
    let n = list.len();
    let least = (0..n).min_by_key(|&k| list[k])?;
    let at = |k: usize| list[(least + k) % n];
    // Contact runs, each as its first and last site.
    let mut runs: SmallVec<[(Site, Site); 8]> = SmallVec::new();
    let first = (0..n).find(|&k| !follows(domain, at((k + n - 1) % n), at(k)))?;
    for k in first..first + n {
        let site = at(k % n);
        match runs.last_mut() {
            Some(run) if k > first && follows(domain, run.1, site) => run.1 = site,
            _ => runs.push((site, site)),
        }
    }
    if runs.len() == 2 {
        let (run, other) =
            if runs[0].0 == runs[0].1 { (runs[1], runs[0].0) } else { (runs[0], runs[1].0) };
        if run.0 == run.1 {
            return None;
        }
        // Two pieces of a straight line meet at a corner that is no site, but defines the disk.
        let straight = run.0.is_edge() && run.1.is_edge();
        let second = if straight { Site::corner(run.1.index()) } else { run.1 };
        return Some([run.0, second, other]);
    }
    let sites: Contacts = runs.iter().map(|r| r.0.min(r.1)).collect();
    let normals: SmallVec<[Point; 8]> = sites.iter().map(|&s| normal(domain, s, disk)).collect();
    let mut best: Option<(f64, [usize; 3])> = None;
    let mut weigh = |i: usize, j: usize, k: usize| {
        let spread = (normals[j] - normals[i]).cross(normals[k] - normals[i]);
        if best.is_none_or(|(b, _)| spread > b * CLEARLY_WIDER) {
            best = Some((spread, [i, j, k]));
        }
    };
    let m = sites.len();
    if m <= FEW_RUNS {
        for i in 0..m {
            for j in i + 1..m {
                for k in j + 1..m {
                    weigh(i, j, k);
                }
            }
        }
    } else {
        for i in 0..m {
            weigh(i, (i + m / 3) % m, (i + 2 * m / 3) % m);
        }
    }
    best.map(|(_, t)| t.map(|k| sites[k]))
}

fn normal(domain: &Domain, site: Site, disk: &TouchingDisk) -> Point {
    let edge = domain.edge(site.index());
    if site.is_edge() {
        edge.direction.perp()
    } else {
        let away = disk.centre + (disk.origin - edge.start);
        away * (1.0 / away.norm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::{Corner, Options};

    #[test]
    fn far_from_the_origin_rounding_does_not_choose_the_triple() {
        // A cross of 37 ulp, whose four inner corners touch the disk in its middle: half an ulp from
        // any double.
        let ulp = f64::EPSILON * (1_u32 << 23) as f64;
        let at = |x: f64, y: f64| Point::new(1e7 + 37.0 * x * ulp, 1e7 + 37.0 * y * ulp);
        let ring = [
            (0., -1.),
            (1., -1.),
            (1., 0.),
            (2., 0.),
            (2., 1.),
            (1., 1.),
            (1., 2.),
            (0., 2.),
            (0., 1.),
            (-1., 1.),
            (-1., 0.),
            (0., 0.),
        ];
        let ring = ring.map(|(x, y)| at(x, y)).to_vec();
        let domain = Domain::from_polygons(&[vec![ring]], &Options::default()).unwrap();
        let corners: Vec<Site> = (0..12)
            .filter(|&k| domain.edge(k).corner == Corner::Reflex)
            .map(Site::corner)
            .collect();
        assert_eq!(corners.len(), 4);
        let half = 18.5 * ulp;
        let triple = |off: f64| {
            let centre = Point::new(half + off, half + off);
            let radius = half * 2.0_f64.sqrt();
            let disk = TouchingDisk { origin: at(0.0, 0.0), centre, radius, bound: 1e-12 * radius };
            best_triple(&domain, &corners, &disk)
        };
        assert!(triple(0.0).is_some());
        assert_eq!(triple(1e-13 * half), triple(0.0));
        assert_eq!(triple(-1e-13 * half), triple(0.0));
    }
}
