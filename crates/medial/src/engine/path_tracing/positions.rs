//! Positions and radii of keypoints, from one fixed triple of governors.
//!
//! The triple depends on the governor list, and not on how the keypoint was found, so engines,
//! orders of tracing and numbers of threads agree; the centre found serves to weigh corners, with a
//! margin. Newton steps with residuals in twice the precision of doubles; where their bound is too
//! large, the exact disk is evaluated instead.

use super::contacts::follows;
use super::search::Start;
use crate::domain::{Domain, Site};
use crate::geom::predicates::ExactDisk;
use crate::geom::{Double, Governor, Point, TouchingDisk};

/// How many times the doubt about a start goes into the radius before no second disk of the same
/// triple can be meant.
const FAR_APART: f64 = 64.0;

/// Least spread of the normals with which Newton steps in doubles converge; below it the exact
/// disk is evaluated.
const LEAST_SPREAD: f64 = 1e-12;

/// How much wider the normals of a triple must spread to be preferred to an earlier one, so that
/// the rounding of the centre does not choose.
const CLEARLY_WIDER: f64 = 1.0 + 1e-6;

/// Contact runs up to which every triple is weighed.
const FEW_RUNS: usize = 6;

/// Rounding of one residual in [`Double`] arithmetic, relative to the sizes that enter it.
///
/// Twenty operations of at most 2^-100 each, with room to spare.
const RESIDUAL_ERROR: f64 = 1.0 / (1_u128 << 90) as f64;

/// Centre and radius of a keypoint, within 4 ulp of max(|x|, |y|, radius).
///
/// `found` is a start, within its bounds, and if `own` one that depends on the governors only;
/// `known` is a triple that defines the disk.
pub(super) fn position(
    domain: &Domain,
    list: &[Site],
    known: &[Site; 3],
    found: Start,
    own: bool,
) -> Option<(Point, f64)> {
    let triple = best_triple(domain, list, found.centre).unwrap_or(*known);
    let governors = domain.governors(triple);
    // Far from the start there may be another disk of the same three elements.
    let near = |c: Point, r: f64, doubt: f64| {
        (c - found.centre).norm() + (r - found.radius).abs() <= 4.0 * doubt
            && doubt <= r / FAR_APART
    };
    // Where the steps begin may tell in the last bit: at the disk that doubles find for the triple
    // alone.
    let start = if own && list.len() == 3 {
        Some(found)
    } else {
        let disk = TouchingDisk::touching(&governors);
        let start = disk.map(|disk| Start::at(&disk));
        let start = start.filter(|s| near(s.centre, s.radius, found.doubt + s.doubt));
        if let (Some(disk), Some(_)) = (disk, start)
            && disk.is_precise()
        {
            return Some((disk.position(), disk.radius));
        }
        start
    };
    if let Some(Start { centre, radius, doubt, .. }) = start {
        let precise = Precise::new(&governors, centre, radius).and_then(|mut p| p.refine());
        if let Some(precise) = precise.filter(|&(c, r)| near(c, r, found.doubt + doubt)) {
            return Some(precise);
        }
    }
    let exact = |t: &[Site; 3]| ExactDisk::new(t.map(|s| domain.element(s)));
    exact(&triple).or_else(|| exact(known)).map(|disk| disk.approximate())
}

/// The triple of a governor list with the widest spread of normals; of equal ones the first.
fn best_triple(domain: &Domain, list: &[Site], centre: Point) -> Option<[Site; 3]> {
    let n = list.len();
    let least = (0..n).min_by_key(|&k| list[k])?;
    let at = |k: usize| list[(least + k) % n];
    // Contact runs, each as its first and last site.
    let mut runs: Vec<(Site, Site)> = Vec::new();
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
    let sites: Vec<Site> = runs.iter().map(|r| r.0.min(r.1)).collect();
    let normals: Vec<Point> = sites.iter().map(|&s| normal(domain, s, centre)).collect();
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

fn normal(domain: &Domain, site: Site, centre: Point) -> Point {
    let edge = domain.edge(site.index());
    if site.is_edge() {
        edge.direction.perp()
    } else {
        let away = centre - edge.start;
        away * (1.0 / away.norm())
    }
}

/// A vector of [`Double`]s.
#[derive(Clone, Copy)]
struct Vector {
    x: Double,
    y: Double,
}

impl Vector {
    fn difference(a: Point, b: Point) -> Self {
        Self { x: Double::difference(a.x, b.x), y: Double::difference(a.y, b.y) }
    }

    fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }

    fn dot(self, other: Self) -> Double {
        self.x * other.x + self.y * other.y
    }

    fn value(self) -> Point {
        Point::new(self.x.value(), self.y.value())
    }
}

/// A governor relative to the local origin.
enum Element {
    Corner(Vector),
    /// A point of the edge's line and the unit normal.
    Edge(Vector, Vector),
}

struct Precise {
    origin: Point,
    elements: [Element; 3],
    /// Position of the edge, and of the corner at its end, if the centre lies on that normal.
    on_normal: Option<(usize, usize)>,
    centre: Vector,
    radius: Double,
}

impl Precise {
    fn new(governors: &[Governor; 3], centre: Point, radius: f64) -> Option<Self> {
        let corner_of = |g: &Governor| match *g {
            Governor::Corner(p) => p,
            Governor::Edge { start, end, .. } => {
                if (start - centre).norm2() <= (end - centre).norm2() { start } else { end }
            }
        };
        let mut on_normal = None;
        for (i, e) in governors.iter().enumerate() {
            for (j, c) in governors.iter().enumerate() {
                if let (Governor::Edge { start, end, .. }, Governor::Corner(p)) = (e, c)
                    && (start == p || end == p)
                {
                    on_normal = Some((i, j));
                }
            }
        }
        let origin = match on_normal {
            Some((_, corner)) => corner_of(&governors[corner]),
            None => governors
                .iter()
                .map(corner_of)
                .min_by(|a, b| (*a - centre).norm2().total_cmp(&(*b - centre).norm2()))?,
        };
        let elements = [0, 1, 2].map(|k| match governors[k] {
            Governor::Corner(p) => Element::Corner(Vector::difference(p, origin)),
            Governor::Edge { start, end, .. } => {
                let d = Vector::difference(end, start);
                let length = d.dot(d).sqrt();
                let normal = Vector { x: -d.y / length, y: d.x / length };
                Element::Edge(Vector::difference(corner_of(&governors[k]), origin), normal)
            }
        });
        Some(Self {
            origin,
            elements,
            on_normal,
            centre: Vector::difference(centre, origin),
            radius: Double::from(radius),
        })
    }

    /// Normal and distance of an element from the centre.
    fn distance(&self, element: &Element) -> (Point, Double) {
        match element {
            Element::Corner(p) => {
                let q = self.centre.minus(*p);
                let distance = q.dot(q).sqrt();
                (q.value() * (1.0 / distance.value()), distance)
            }
            Element::Edge(a, normal) => (normal.value(), self.centre.minus(*a).dot(*normal)),
        }
    }

    fn refine(&mut self) -> Option<(Point, f64)> {
        let bound = match self.on_normal {
            Some((edge, corner)) => self.refine_on_normal(edge, 3 - edge - corner)?,
            None => self.refine_freely()?,
        };
        let x = Double::from(self.origin.x) + self.centre.x;
        let y = Double::from(self.origin.y) + self.centre.y;
        let (x, y, r) = (x.value(), y.value(), self.radius.value());
        let scale = x.abs().max(y.abs()).max(r);
        let sound = r > 0.0 && x.is_finite() && y.is_finite();
        // Half an ulp of rounding comes on top.
        (sound && bound <= f64::EPSILON / 4.0 * scale).then(|| (Point::new(x, y), r))
    }

    fn sizes(&self) -> f64 {
        let mut size = self.radius.value() + self.centre.value().norm();
        for element in &self.elements {
            let (Element::Corner(a) | Element::Edge(a, _)) = element;
            size += a.value().norm();
        }
        size
    }

    /// Newton steps on three residuals; gives a bound on the error left.
    fn refine_freely(&mut self) -> Option<f64> {
        let mut bound = f64::INFINITY;
        for _ in 0..6 {
            let [(n1, d1), (n2, d2), (n3, d3)] =
                [0, 1, 2].map(|k| self.distance(&self.elements[k]));
            let rho = [d1, d2, d3].map(|d| (d - self.radius).value());
            let (b, e) = (n2 - n1, n3 - n1);
            let d = b.cross(e);
            // Below this the solution in doubles no longer converges.
            if d.is_nan() || d <= LEAST_SPREAD {
                return None;
            }
            let (p12, p13) = (rho[0] - rho[1], rho[0] - rho[2]);
            let dx = Point::new((p12 * e.y - p13 * b.y) / d, (b.x * p13 - e.x * p12) / d);
            let spread = (n2 - n3).norm() + (n3 - n1).norm() + (n1 - n2).norm();
            let rest = rho.iter().map(|r| r.abs()).fold(0.0, f64::max);
            let error = RESIDUAL_ERROR * self.sizes();
            let new = 4.0 * spread / d * (rest + error);
            if new >= bound / 2.0 {
                break;
            }
            bound = new;
            self.centre.x = self.centre.x + Double::from(dx.x);
            self.centre.y = self.centre.y + Double::from(dx.y);
            self.radius = self.radius + Double::from(rho[0] + n1.dot(dx));
            if rest <= 16.0 * error {
                break;
            }
        }
        // The last step was taken on residuals of this size and left far less.
        bound.is_finite().then_some(bound)
    }

    /// The centre on the normal of an edge at its end, which is the origin: one residual.
    fn refine_on_normal(&mut self, edge: usize, other: usize) -> Option<f64> {
        let Element::Edge(_, normal) = self.elements[edge] else { return None };
        let mut bound = f64::INFINITY;
        for _ in 0..6 {
            self.centre = Vector { x: normal.x * self.radius, y: normal.y * self.radius };
            let (n, distance) = self.distance(&self.elements[other]);
            let g = 1.0 - n.dot(normal.value());
            if g.is_nan() || g <= LEAST_SPREAD {
                return None;
            }
            let rho = (distance - self.radius).value();
            let error = RESIDUAL_ERROR * self.sizes();
            let new = 4.0 * (rho.abs() + error) / g;
            if new >= bound / 2.0 {
                break;
            }
            bound = new;
            self.radius = self.radius + Double::from(rho / g);
            if rho.abs() <= 16.0 * error {
                break;
            }
        }
        self.centre = Vector { x: normal.x * self.radius, y: normal.y * self.radius };
        bound.is_finite().then_some(bound)
    }
}
