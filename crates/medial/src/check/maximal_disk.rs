use std::cell::OnceCell;
use std::cmp::Ordering;

use super::enclosure::Enclosure;
use crate::domain::{Corner, Domain, Site};
use crate::geom::Point;
use crate::geom::predicates::{Element, ExactDisk};

/// Rounded exact disks are right to this many units in the last place of the local scale.
const ROUNDING_ULPS: f64 = 1.0;

/// The disk touching three sites: bounds decide most questions, exact numbers the rest.
pub(super) struct MaximalDisk<'a> {
    domain: &'a Domain,
    /// Three sites whose contacts follow one another counterclockwise; a corner may stand here for
    /// a straight joint.
    sites: [Site; 3],
    enclosure: Enclosure,
    exact: OnceCell<Option<ExactDisk>>,
}

impl<'a> MaximalDisk<'a> {
    /// The disk touching three sites in counterclockwise order, if there is one.
    pub(super) fn new(domain: &'a Domain, sites: [Site; 3], guess: (Point, f64)) -> Option<Self> {
        if let Some(enclosure) = Enclosure::certify(domain, sites, guess) {
            return Some(Self { domain, sites, enclosure, exact: OnceCell::new() });
        }
        let disk = ExactDisk::new(sites.map(|s| domain.element(s)))?;
        let (centre, radius) = disk.approximate();
        let enclosure = Enclosure::certify(domain, sites, (centre, radius)).unwrap_or_else(|| {
            Enclosure::around(centre, radius, ROUNDING_ULPS * ulp_of_scale(centre, radius))
        });
        let exact = OnceCell::from(Some(disk));
        (radius > 0.0).then_some(Self { domain, sites, enclosure, exact })
    }

    /// A disk found before.
    pub(super) fn again(domain: &'a Domain, sites: [Site; 3], enclosure: Enclosure) -> Self {
        Self { domain, sites, enclosure, exact: OnceCell::new() }
    }

    pub(super) fn sites(&self) -> [Site; 3] {
        self.sites
    }

    pub(super) fn enclosure(&self) -> &Enclosure {
        &self.enclosure
    }

    fn exact(&self) -> Option<&ExactDisk> {
        self.exact
            .get_or_init(|| ExactDisk::new(self.sites.map(|s| self.domain.element(s))))
            .as_ref()
    }

    /// Takes the sign of a value with its error bound, or else asks the exact disk.
    fn decide(&self, (value, error): (f64, f64), ask: impl Fn(&ExactDisk) -> Ordering) -> Ordering {
        if value > error {
            Ordering::Greater
        } else if value < -error {
            Ordering::Less
        } else {
            // The exact disk exists whenever the bounds were proved; if not, nothing is known to be
            // wrong.
            self.exact().map_or(Ordering::Equal, ask)
        }
    }

    /// Orders the distance from a corner, or the signed distance from the supporting line of an
    /// edge, against the radius.
    pub(super) fn side(&self, site: Site) -> Ordering {
        if self.sites.contains(&site) {
            return Ordering::Equal;
        }
        self.decide(self.enclosure.residual(self.domain, site), |disk| {
            disk.side(self.domain.element(site))
        })
    }

    /// Orders the distance from an edge whose zone holds the centre against the radius; `None` if
    /// the centre lies in another zone, or does not see the edge from its front and the edge is no
    /// nearer than the radius.
    pub(super) fn touch(&self, edge: u32) -> Option<Ordering> {
        let (start, end) = (self.domain.edge(edge).start, self.domain.end(edge));
        if !self.in_zone(Site::edge(edge)) {
            return None;
        }
        if self.across(start, end).is_ge() {
            return Some(self.side(Site::edge(edge)));
        }
        let (distance, error) = self.enclosure.across(end, start);
        let residual = (distance - self.enclosure.radius.value(), error + f64::EPSILON * distance);
        let side = self.decide(residual, |disk| disk.side(Element::Edge(end, start)));
        side.is_lt().then_some(side)
    }

    /// The sign of `(b - a)·(c - p)` for the centre `c`.
    pub(super) fn along(&self, a: Point, b: Point, p: Point) -> Ordering {
        self.decide(self.enclosure.along(a, b, p), |disk| disk.along(a, b, p))
    }

    /// On which side of the line from `a` to `b` the centre lies; `Greater` is left.
    pub(super) fn across(&self, a: Point, b: Point) -> Ordering {
        self.decide(self.enclosure.across(a, b), |disk| disk.front(a, b))
    }

    /// Whether the centre lies in the closed zone of a site it touches.
    pub(super) fn in_zone(&self, site: Site) -> bool {
        let edge = site.index();
        let (start, end) = (self.domain.edge(edge).start, self.domain.end(edge));
        if site.is_edge() {
            self.along(start, end, start).is_ge() && self.along(start, end, end).is_le()
        } else {
            let before = self.domain.edge(self.domain.edge(edge).prev).start;
            self.domain.edge(edge).corner == Corner::Reflex
                && self.along(before, start, start).is_ge()
                && self.along(start, end, start).is_le()
        }
    }

    /// Orders the centres of two disks along (`across` false) or across (true, to the left) the
    /// direction from `a` to `b`: the sign for this one less the other one.
    pub(super) fn compare(&self, other: &Self, a: Point, b: Point, across: bool) -> Ordering {
        let place = |disk: &Self| {
            if across { disk.enclosure.across(a, b) } else { disk.enclosure.along(a, b, a) }
        };
        let ((ours, e1), (theirs, e2)) = (place(self), place(other));
        self.decide(
            (ours - theirs, e1 + e2 + 4.0 * f64::EPSILON * (ours.abs() + theirs.abs())),
            |disk| {
                other.exact().map_or(Ordering::Equal, |other| {
                    if across {
                        disk.compare_across(other, a, b)
                    } else {
                        disk.compare_along(other, a, b)
                    }
                })
            },
        )
    }
}

/// One unit in the last place of the largest of |x|, |y| and the radius.
pub(super) fn ulp_of_scale(centre: Point, radius: f64) -> f64 {
    let scale = centre.x.abs().max(centre.y.abs()).max(radius.abs());
    if scale.is_finite() { scale.next_up() - scale } else { f64::INFINITY }
}
