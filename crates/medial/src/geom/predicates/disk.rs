//! The exact disk and the questions it answers.

use std::cmp::Ordering;
use std::sync::OnceLock;

use super::Element;
use super::construct::{construct, corners_first};
use super::counts::count;
use super::dyadic::Dyadic;
use super::fine::Fine;
use super::grid::Vector;
use super::homogeneous::Homogeneous;
use super::near::{Near, is_impossible};
use super::stages::special_side;
use super::transition;
use crate::geom::{Pinned, Point, TouchingDisk};

/// Error of a disk in doubles, as a share of its radius, up to which it is taken as it is.
const SHARP: f64 = 64.0 * f64::EPSILON;

/// The disk that touches three elements, its contacts counterclockwise in the order given.
///
/// ```
/// use std::cmp::Ordering;
/// use medial::geom::Point;
/// use medial::geom::predicates::{Element, ExactDisk};
/// let [a, b, c] = [Point::new(0.0, 0.0), Point::new(4.0, 0.0), Point::new(0.0, 3.0)];
/// let incircle = ExactDisk::new([Element::Edge(a, b), Element::Edge(b, c), Element::Edge(c, a)]);
/// let incircle = incircle.expect("the sides of a triangle in their order");
/// assert_eq!(incircle.approximate(), (Point::new(1.0, 1.0), 1.0));
/// assert_eq!(incircle.side(Element::Corner(Point::new(1.0, 2.0))), Ordering::Equal);
/// ```
#[derive(Clone, Debug)]
pub struct ExactDisk {
    /// What it touches, corners first. There is such a disk.
    elements: [Element; 3],
    /// The same disk in doubles.
    near: Near,
    /// The same disk in short integers, once a tie asks for them and if it has any.
    dyadic: OnceLock<Option<Dyadic>>,
    /// The same disk in pairs of doubles, once a near tie needs them and if they can prove it.
    fine: OnceLock<Option<Fine>>,
    /// The same disk in integers, once a question needs them.
    form: OnceLock<Option<Homogeneous>>,
}

impl ExactDisk {
    /// The disk touching three elements, whose contacts follow one another counterclockwise.
    ///
    /// Any rotation of the three is the same; their reversal is another disk.
    /// A corner touches by lying on the circle, an edge by its supporting line being a tangent with
    /// the disk on its left. Where a corner lies on a supporting line both have one contact, which
    /// fits either order.
    /// `None` if there is no such disk: a corner lies behind an edge, two elements are the same, two
    /// edges have one direction, or the order is impossible.
    /// The radius is positive, or zero for three edges whose lines meet in one point.
    #[must_use]
    pub fn new(elements: [Element; 3]) -> Option<Self> {
        let elements = corners_first(elements);
        if is_impossible(&elements) {
            return None;
        }
        let found = Near::found(&elements);
        if let Some(near) = found.filter(Near::is_certain) {
            return Some(Self::known(elements, near));
        }
        if let Some(fine) = found.and_then(|found| Fine::new(&elements, &found)) {
            return Some(Self { fine: Some(fine).into(), ..Self::known(elements, fine.near()) });
        }
        let form = construct(&elements)?;
        let near = Near::new(&form);
        Some(Self { form: Some(form).into(), ..Self::known(elements, near) })
    }

    /// The same disk, for its position: pairs of doubles first.
    pub(crate) fn precise(elements: [Element; 3]) -> Option<Self> {
        let elements = corners_first(elements);
        let fine = Near::guessed(&elements).and_then(|guess| Fine::new(&elements, &guess.0));
        match fine {
            Some(fine) => {
                Some(Self { fine: Some(fine).into(), ..Self::known(elements, fine.near()) })
            }
            None => Self::new(elements),
        }
    }

    /// The disk of three elements that was certified in doubles.
    pub(crate) fn of_certified(elements: [Element; 3], disk: &TouchingDisk) -> Self {
        Self::known(corners_first(elements), Near::from(disk))
    }

    /// The disk of three edges that is known relative to a circle.
    pub(crate) fn of_pinned(elements: [Element; 3], disk: &Pinned) -> Self {
        let fine = Fine::pinned(disk);
        let known = Self::known(elements, fine.near());
        if disk.is_sharp() { Self { fine: Some(fine).into(), ..known } } else { known }
    }

    fn known(elements: [Element; 3], near: Near) -> Self {
        count(|counts| counts.disks += 1);
        let (dyadic, fine, form) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { elements, near, dyadic, fine, form }
    }

    /// Makes the disk as precise as doubles hold, for many questions.
    pub(crate) fn sharpen(&mut self) {
        if let Some(fine) = self.fine() {
            let near = fine.near();
            if near.error < self.near.error {
                self.near = near;
            }
        }
    }

    /// The disk in doubles as pairs of doubles know it, if they know it better.
    pub(crate) fn sharper(&self) -> Option<TouchingDisk> {
        let near = self.fine()?.near();
        (near.error < self.near.error).then(|| TouchingDisk::from(&near))
    }

    /// The disk in doubles, within a few ulp.
    pub(crate) fn rounded(&self) -> TouchingDisk {
        // Where integers too would not tell, both are infinite.
        if self.near.error < SHARP * self.near.radius {
            return TouchingDisk::from(&self.near);
        }
        if let Some(near) = self.fine().map(Fine::near).filter(|n| n.error <= SHARP * n.radius) {
            return TouchingDisk::from(&near);
        }
        let (position, radius) = self.approximate();
        let origin = self.near.origin;
        let centre = position - origin;
        let scale = position.x.abs().max(position.y.abs()).max(radius);
        let size = centre.x.abs().max(centre.y.abs());
        TouchingDisk { origin, centre, radius, bound: 2.0 * f64::EPSILON * (scale + size) }
    }

    /// Orders the distance of the centre from a corner, or its signed distance from the supporting
    /// line of an edge, positive in front, against the radius.
    ///
    /// `Less` means that the disk is cut and `Equal` that it is touched. For an edge this is about the
    /// whole line: whether it is seen from its front and within its ends, [`front`](Self::front) and
    /// [`along`](Self::along) tell.
    #[must_use]
    pub fn side(&self, element: Element) -> Ordering {
        if self.elements.contains(&element) {
            count(|counts| counts.structure += 1);
            return Ordering::Equal;
        }
        // A corner that ends a governing edge lies on a tangent: outside, or it is the contact.
        if let Element::Corner(p) = element
            && let Some((a, b)) = self.edge_ending_at(p)
        {
            return if self.along(a, b, p).is_eq() { Ordering::Equal } else { Ordering::Greater };
        }
        // Edges seldom tie where coordinates use all their bits.
        let likely = match element {
            Element::Corner(_) => true,
            Element::Edge(a, b) => [a.x, a.y, b.x, b.y].iter().all(|&v| v as i64 as f64 == v),
        };
        rounded(self.near.side(element))
            .or_else(|| self.in_integers(|disk| disk.side(element)))
            .or_else(|| self.fine_now(|fine| fine.side(element)))
            .or_else(|| likely.then(|| special_side(self.elements, element)).flatten())
            .or_else(|| match element {
                Element::Corner(p) => on_normal(transition::side_of_corner(&self.elements, p)),
                Element::Edge(..) => None,
            })
            .or_else(|| self.fine_first(|fine| fine.side(element)))
            .or_else(|| (!likely).then(|| special_side(self.elements, element)).flatten())
            .unwrap_or_else(|| self.side_in_tower(element))
    }

    /// The side by the tower alone.
    pub(super) fn side_in_tower(&self, element: Element) -> Ordering {
        self.in_tower(|form| match element {
            Element::Corner(p) => form.side_of_corner(p),
            Element::Edge(a, b) => form.side_of_line(a, b),
        })
    }

    pub(super) fn front_in_tower(&self, a: Point, b: Point) -> Ordering {
        self.in_tower(|form| form.front(a, b))
    }

    pub(super) fn along_in_tower(&self, a: Point, b: Point, p: Point) -> Ordering {
        self.in_tower(|form| form.along(a, b, p))
    }

    /// An answer of the tower.
    fn in_tower(&self, question: impl FnOnce(&Homogeneous) -> Ordering) -> Ordering {
        count(|counts| counts.tower += 1);
        // A disk that exists has integers.
        self.form().map_or(Ordering::Equal, question)
    }

    fn dyadic(&self) -> Option<&Dyadic> {
        self.dyadic.get_or_init(|| Dyadic::new(&self.elements, &self.near)).as_ref()
    }

    /// An answer of short integers.
    fn in_integers(&self, ask: impl FnOnce(&Dyadic) -> Option<Ordering>) -> Option<Ordering> {
        let answer = ask(self.dyadic()?);
        answer.inspect(|_| count(|counts| counts.dyadic += 1))
    }

    fn fine(&self) -> Option<&Fine> {
        self.fine.get_or_init(|| Fine::new(&self.elements, &self.near)).as_ref()
    }

    /// An answer of the pairs of doubles, if they are there already.
    fn fine_now(&self, ask: impl FnOnce(&Fine) -> Option<Ordering>) -> Option<Ordering> {
        let answer = ask(self.fine.get()?.as_ref()?);
        answer.inspect(|_| count(|counts| counts.fine += 1))
    }

    /// An answer of the pairs of doubles, if they were not asked yet.
    fn fine_first(&self, ask: impl FnOnce(&Fine) -> Option<Ordering>) -> Option<Ordering> {
        if self.fine.get().is_some() {
            return None;
        }
        let answer = ask(self.fine()?);
        answer.inspect(|_| count(|counts| counts.fine += 1))
    }

    fn form(&self) -> Option<&Homogeneous> {
        self.form.get_or_init(|| construct(&self.elements)).as_ref()
    }

    fn edge_ending_at(&self, p: Point) -> Option<(Point, Point)> {
        self.elements.iter().find_map(|&element| match element {
            Element::Edge(a, b) if a == p || b == p => Some((a, b)),
            _ => None,
        })
    }

    /// Orders the signed distance of the centre from the line through `a` and `b` against zero:
    /// `Greater` if the centre sees the edge from its front, which is on the left.
    #[must_use]
    pub fn front(&self, a: Point, b: Point) -> Ordering {
        rounded(self.near.product((b - a).perp(), a))
            .or_else(|| self.in_integers(|disk| disk.front(a, b)))
            .or_else(|| self.fine_now(|fine| fine.front(a, b)))
            .or_else(|| on_normal(transition::product_across(&self.elements, [a, b])))
            .or_else(|| self.fine_first(|fine| fine.front(a, b)))
            .unwrap_or_else(|| self.front_in_tower(a, b))
    }

    /// Orders the centre against `p` along the direction from `a` to `b`: the sign of
    /// `(b - a)·(c - p)`.
    ///
    /// With `p = a` and `p = b` this is the zone of an edge, with a reflex corner as `p` one of the
    /// two walls of its zone.
    #[must_use]
    pub fn along(&self, a: Point, b: Point, p: Point) -> Ordering {
        // A corner that ends an edge is the contact of both.
        if (p == a || p == b)
            && [Element::Corner(p), Element::Edge(a, b)].iter().all(|e| self.elements.contains(e))
        {
            count(|counts| counts.structure += 1);
            return Ordering::Equal;
        }
        rounded(self.near.product(b - a, p))
            .or_else(|| self.in_integers(|disk| disk.along(a, b, p)))
            .or_else(|| self.fine_now(|fine| fine.along(a, b, p)))
            .or_else(|| on_normal(transition::product_along(&self.elements, [a, b], p)))
            .or_else(|| self.fine_first(|fine| fine.along(a, b, p)))
            .unwrap_or_else(|| self.along_in_tower(a, b, p))
    }

    /// Orders the centres of two disks along the direction from `a` to `b`: the sign of
    /// `(b - a)·(c - c')` for the centre `c'` of the other one.
    #[must_use]
    pub fn compare_along(&self, other: &Self, a: Point, b: Point) -> Ordering {
        self.compare(other, (a, b), false)
    }

    /// Orders the centres of two disks across the direction from `a` to `b`: the sign of
    /// `(b - a)×(c - c')`, which is `Greater` if this one lies further to the left.
    #[must_use]
    pub fn compare_across(&self, other: &Self, a: Point, b: Point) -> Ordering {
        self.compare(other, (a, b), true)
    }

    /// Orders the radius against a length, which is not negative and has an exponent within ±200.
    #[must_use]
    pub fn compare_radius(&self, length: f64) -> Ordering {
        let gap = self.near.radius - length;
        // Twice the error holds the rounding of the gap.
        if gap.abs() > 2.0 * self.near.error {
            return gap.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
        }
        self.in_tower(|form| form.compare_radius(length))
    }

    /// Orders the radii of two disks.
    #[must_use]
    pub fn compare_radii(&self, other: &Self) -> Ordering {
        let gap = self.near.radius - other.near.radius;
        // Twice the errors hold the rounding of the gap.
        if gap.abs() > 2.0 * (self.near.error + other.near.error) {
            return gap.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
        }
        self.in_tower(|form| {
            other.form().map_or(Ordering::Equal, |other| form.compare_radii(other))
        })
    }

    fn compare(&self, other: &Self, (a, b): (Point, Point), across: bool) -> Ordering {
        let v = if across { (b - a).perp() } else { b - a };
        rounded(self.near.difference(&other.near, v))
            .or_else(|| {
                self.in_integers(|disk| {
                    let (way, direction) = disk.way_from(other.dyadic()?, a, b)?;
                    let product = if across { direction.cross(way) } else { direction.dot(way) };
                    Some(product.cmp(&0))
                })
            })
            .or_else(|| {
                let answer = self.fine()?.compare(other.fine()?, (a, b), across);
                answer.inspect(|_| count(|counts| counts.fine += 1))
            })
            .unwrap_or_else(|| self.compare_in_tower(other, (a, b), across))
    }

    pub(super) fn compare_in_tower(
        &self,
        other: &Self,
        (a, b): (Point, Point),
        across: bool,
    ) -> Ordering {
        self.in_tower(|form| {
            let turn = |along: Vector| if across { along.perp() } else { along };
            other.form().map_or(Ordering::Equal, |other| form.compare(other, a, b, turn))
        })
    }

    /// The sign of `(p - c)×(q - c)`: `Greater` if from the centre `q` lies counterclockwise of `p`
    /// by less than half a turn.
    #[must_use]
    pub fn orientation(&self, p: Point, q: Point) -> Ordering {
        // The centre lies to the left of the line from p to q.
        self.front(p, q)
    }

    /// The centre and the radius, each coordinate rounded to the nearest double.
    ///
    /// The next double only where the exact value lies too close to the middle of two to tell; exactly
    /// zero where the value is.
    #[must_use]
    pub fn approximate(&self) -> (Point, f64) {
        let fine = if self.form.get().is_none() { self.fine() } else { None };
        fine.and_then(Fine::nearest)
            .or_else(|| self.form().map(Homogeneous::nearest))
            .unwrap_or_else(|| self.near.values())
    }

    /// Centre and radius, each rounded once where pairs of doubles know them well, so that coordinates
    /// far smaller than the disk are right to an ulp of the disk only; else as of
    /// [`approximate`](Self::approximate).
    pub(crate) fn rounded_once(&self) -> (Point, f64) {
        let fine = if self.form.get().is_none() { self.fine() } else { None };
        fine.and_then(Fine::rounded).unwrap_or_else(|| self.approximate())
    }
}

/// Notes an answer of the forms for a centre on the normal at an edge's end.
fn on_normal(answer: Option<Ordering>) -> Option<Ordering> {
    answer.inspect(|_| count(|counts| counts.transitions += 1))
}

/// Notes an answer of the doubles.
fn rounded(answer: Option<Ordering>) -> Option<Ordering> {
    answer.inspect(|_| count(|counts| counts.rounded += 1))
}
