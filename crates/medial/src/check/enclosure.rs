use crate::domain::{Domain, Site};
use crate::geom::{Double, Point};

/// Rounding unit of the doubles.
const UNIT: f64 = 1.0 / (1u64 << 53) as f64;

/// Relative error that covers every formula here in double-doubles: some twenty operations, each
/// right to about 2^-103.
const EPSILON: f64 = 1.0 / (1u128 << 98) as f64;

/// Newton steps before giving up: from a rounded position two suffice, each doubles the digits.
const STEPS: usize = 8;

/// A disk known up to a bound: there is exactly one disk near that touches three sites, and for
/// every unit vector `w` its `w·centre - radius` differs from the one here by at most `bound`.
///
/// So centre and radius err by at most `bound` each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Enclosure {
    pub(super) x: Double,
    pub(super) y: Double,
    pub(super) radius: Double,
    pub(super) bound: f64,
}

impl Enclosure {
    /// What a rounded disk says, each number off by at most `bound`.
    pub(super) fn around(centre: Point, radius: f64, bound: f64) -> Self {
        // Centre and radius err independently here.
        let bound = 3.0 * bound;
        Self { x: centre.x.into(), y: centre.y.into(), radius: radius.into(), bound }
    }

    /// The disk whose contacts with three sites follow one another counterclockwise, found from a
    /// guess; `None` if the bound cannot be proved.
    ///
    /// An edge and a corner that bounds it, or the other way round, may stand side by side; then
    /// the contact of both is the corner.
    pub(super) fn certify(domain: &Domain, sites: [Site; 3], guess: (Point, f64)) -> Option<Self> {
        let (centre, radius) = guess;
        let finite = centre.x.is_finite() && centre.y.is_finite() && radius.is_finite();
        if !finite || radius <= 0.0 {
            return None;
        }
        for first in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|k| sites[(first + k) % 3]);
            if let Some((corner, edge)) = common_contact(domain, a, b) {
                return at_end(domain, corner, edge, c, radius);
            }
        }
        touching(domain, sites, centre, radius)
    }

    /// The centre, rounded.
    pub(super) fn centre(&self) -> Point {
        Point::new(self.x.value(), self.y.value())
    }

    /// Size of the coordinates: what relative errors of double-doubles refer to.
    fn size(&self) -> f64 {
        self.x.value().abs() + self.y.value().abs() + self.radius.value().abs()
    }

    /// Distance of the centre from a corner, or signed distance from the supporting line of an
    /// edge, less the radius; and how far the exact value may be from that.
    pub(super) fn residual(&self, domain: &Domain, site: Site) -> (f64, f64) {
        let (distance, error) = if site.is_edge() {
            let (start, end) = (domain.edge(site.index()).start, domain.end(site.index()));
            (self.distance_to_line(start, end), EPSILON * (self.size() + norm1(start) + norm1(end)))
        } else {
            let p = domain.edge(site.index()).start;
            (self.distance_to_point(p), EPSILON * (self.size() + norm1(p)))
        };
        ((distance - self.radius).value(), self.bound + error)
    }

    /// `t·(centre - p)` for the unit vector `t` from `a` to `b`, and its error.
    pub(super) fn along(&self, a: Point, b: Point, p: Point) -> (f64, f64) {
        let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
        let (qx, qy) = (self.x - p.x.into(), self.y - p.y.into());
        let value = (dx * qx + dy * qy) / (dx * dx + dy * dy).sqrt();
        (value.value(), self.bound + EPSILON * (self.size() + norm1(p)))
    }

    /// Signed distance of the centre from the line from `a` to `b`, positive to its left, and its
    /// error.
    pub(super) fn across(&self, a: Point, b: Point) -> (f64, f64) {
        let error = self.bound + EPSILON * (self.size() + norm1(a) + norm1(b));
        (self.distance_to_line(a, b).value(), error)
    }

    fn distance_to_line(&self, a: Point, b: Point) -> Double {
        let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
        let (qx, qy) = (self.x - a.x.into(), self.y - a.y.into());
        (dx * qy - dy * qx) / (dx * dx + dy * dy).sqrt()
    }

    fn distance_to_point(&self, p: Point) -> Double {
        let (qx, qy) = (self.x - p.x.into(), self.y - p.y.into());
        (qx * qx + qy * qy).sqrt()
    }

    /// Unit vector from the contact with a site towards the centre, rounded.
    fn normal(&self, domain: &Domain, site: Site) -> Point {
        let v = if site.is_edge() {
            (domain.end(site.index()) - domain.edge(site.index()).start).perp()
        } else {
            let p = domain.edge(site.index()).start;
            Point::new((self.x - p.x.into()).value(), (self.y - p.y.into()).value())
        };
        v * (1.0 / v.norm())
    }
}

/// The corner and the edge, if one of two sites is an edge and the other a corner that bounds it.
pub(super) fn common_contact(domain: &Domain, a: Site, b: Site) -> Option<(Site, Site)> {
    let (corner, edge) = match (a.is_edge(), b.is_edge()) {
        (false, true) => (a, b),
        (true, false) => (b, a),
        _ => return None,
    };
    let ends = [edge.index(), domain.edge(edge.index()).next];
    ends.contains(&corner.index()).then_some((corner, edge))
}

/// The disk touching three sites with three distinct contacts.
fn touching(domain: &Domain, sites: [Site; 3], centre: Point, radius: f64) -> Option<Enclosure> {
    let mut disk = Enclosure::around(centre, radius, 0.0);
    for step in 0..=STEPS {
        let normals = sites.map(|site| disk.normal(domain, site));
        let [(r1, e1), (r2, e2), (r3, e3)] = sites.map(|site| disk.residual(domain, site));
        let [n1, n2, n3] = normals;
        let (b, e) = (n2 - n1, n3 - n1);
        // Twice the area of the triangle of the normals, positive in counterclockwise order.
        let area = b.cross(e) - 12.0 * UNIT;
        if area.is_nan() || area <= 0.0 {
            return None;
        }
        let settled = r1.abs() <= e1 && r2.abs() <= e2 && r3.abs() <= e3;
        if settled || step == STEPS {
            let sides = [(n2 - n3).norm(), (n3 - n1).norm(), (n1 - n2).norm()];
            let bound = 2.0 / area
                * (sides[0] * (r1.abs() + e1)
                    + sides[1] * (r2.abs() + e2)
                    + sides[2] * (r3.abs() + e3));
            let amplification = 2.0 / area * (sides[0] + sides[1] + sides[2]);
            let curved = sites.iter().any(|site| !site.is_edge());
            return disk.bounded(bound, curved, 32.0 * amplification);
        }
        let (r12, r13) = (r1 - r2, r1 - r3);
        let area = b.cross(e);
        let move_by = Point::new(r12 * e.y - r13 * b.y, b.x * r13 - e.x * r12) * (1.0 / area);
        disk.x = disk.x + move_by.x.into();
        disk.y = disk.y + move_by.y.into();
        disk.radius = disk.radius + (r1 + n1.dot(move_by)).into();
    }
    None
}

/// The disk that touches an edge at its end, the corner, and a third site.
fn at_end(
    domain: &Domain,
    corner: Site,
    edge: Site,
    other: Site,
    radius: f64,
) -> Option<Enclosure> {
    let (a, b) = (domain.edge(edge.index()).start, domain.end(edge.index()));
    let v = domain.edge(corner.index()).start;
    let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
    let length = (dx * dx + dy * dy).sqrt();
    let (nx, ny) = (-dy / length, dx / length);
    let normal = Point::new(nx.value(), ny.value());
    let mut radius = Double::from(radius);
    for step in 0..=STEPS {
        let x = Double::from(v.x) + radius * nx;
        let y = Double::from(v.y) + radius * ny;
        let disk = Enclosure { x, y, radius, bound: 0.0 };
        let (residual, error) = disk.residual(domain, other);
        let gain = 1.0 - disk.normal(domain, other).dot(normal);
        if gain.is_nan() || gain <= 32.0 * UNIT {
            return None;
        }
        if residual.abs() <= error || step == STEPS {
            let slack = EPSILON * (disk.size() + norm1(v));
            let bound = 2.0 * (residual.abs() + error + slack) / (gain - 8.0 * UNIT) + slack;
            return disk.bounded(bound, !other.is_edge(), 64.0 / gain);
        }
        radius = radius + (residual / gain).into();
    }
    None
}

impl Enclosure {
    /// The disk with its bound, if that is small enough for the curvature of corners.
    fn bounded(mut self, bound: f64, curved: bool, steepness: f64) -> Option<Self> {
        if curved && steepness * bound > self.radius.value() {
            return None;
        }
        self.bound = if curved { 1.25 * bound } else { bound };
        // A radius that is not surely positive belongs to no inner keypoint.
        (self.bound < self.radius.value()).then_some(self)
    }
}

/// Sum of the magnitudes of the coordinates.
pub(super) fn norm1(p: Point) -> f64 {
    p.x.abs() + p.y.abs()
}
