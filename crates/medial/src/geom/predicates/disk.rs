//! The exact disk and the questions it answers.

use std::borrow::Cow;
use std::cmp::Ordering;

use dashu_int::IBig;

use super::Element;
use super::construct::{Homogeneous, construct, corners_first, local_origin};
use super::counts::count;
use super::grid::{Grid, Vector};
use super::tower::{Surd, Tower};
use crate::geom::Point;

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
    /// What it touches, corners first.
    elements: [Element; 3],
    /// Where the integers count from, and what they count.
    pub(super) grid: Grid,
    /// The radius is a corner's distance: the grid's origin lies on the circle.
    through_origin: bool,
    /// The roots all the numbers below are made of.
    pub(super) tower: Tower,
    /// Centre relative to the origin, times `w`.
    pub(super) x: Surd,
    pub(super) y: Surd,
    /// Always positive.
    pub(super) w: Surd,
    pub(super) radius: Radius,
}

/// A radius, given through a number `part` of the tower.
#[derive(Clone, Debug)]
pub(super) enum Radius {
    /// `part/(√n·w)`
    Over { part: Surd, n: IBig },
    /// `part·√n/w`
    Times { part: Surd, n: IBig },
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
        let points: Vec<Point> = elements.iter().flat_map(points).collect();
        let grid = Grid::new(local_origin(&elements), &points);
        let Homogeneous { tower, x, y, w, radius } = construct(&elements, grid)?;
        let through_origin = matches!(elements[0], Element::Corner(_));
        count(|counts| counts.disks += 1);
        Some(Self { elements, grid, through_origin, tower, x, y, w, radius })
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
        match element {
            Element::Corner(p) => self.side_of_end(p).unwrap_or_else(|| self.side_of_corner(p)),
            Element::Edge(a, b) => self.side_of_line(a, b),
        }
    }

    /// The side of a corner that ends a governing edge: it lies on a tangent, so it is outside unless
    /// it is the contact.
    fn side_of_end(&self, p: Point) -> Option<Ordering> {
        self.elements.iter().find_map(|&element| match element {
            Element::Edge(a, b) if a == p || b == p => {
                Some(if self.along(a, b, p).is_eq() { Ordering::Equal } else { Ordering::Greater })
            }
            _ => None,
        })
    }

    fn side_of_corner(&self, p: Point) -> Ordering {
        let disk = self.on_grid_of(&[p]);
        let p = disk.grid.local(p);
        if disk.through_origin {
            // (|p - c|² - |c|²)·w
            let chord = disk.linear(&p).scale(&IBig::from(2));
            return disk.sign(&disk.w.scale(&p.norm2()).sub(&chord));
        }
        let (x, y) = disk.centre_from(&p);
        let distance = disk.tower.square(&x).add(&disk.tower.square(&y));
        let difference = match &disk.radius {
            Radius::Over { part, n } => distance.scale(n).sub(&disk.tower.square(part)),
            Radius::Times { part, n } => distance.sub(&disk.tower.square(part).scale(n)),
        };
        disk.sign(&difference)
    }

    fn side_of_line(&self, a: Point, b: Point) -> Ordering {
        let mut disk = self.on_grid_of(&[a, b]).into_owned();
        let d = disk.grid.difference(a, b).direction();
        let distance = disk.linear_from(&disk.grid.local(a), &d.perp());
        let mut root = |n: &IBig| disk.tower.root(Surd::integer(n * d.norm2()));
        // The two distances times w·√(d·d), and in the first case also times n.
        let (distance, radius) = match &disk.radius {
            Radius::Over { part, n } => {
                let root = root(n);
                (distance.scale(n), disk.tower.mul(part, &root))
            }
            Radius::Times { part, n } => {
                let root = root(n);
                (distance, disk.tower.mul(part, &root))
            }
        };
        disk.sign(&distance.sub(&radius))
    }

    /// Orders the signed distance of the centre from the line through `a` and `b` against zero:
    /// `Greater` if the centre sees the edge from its front, which is on the left.
    #[must_use]
    pub fn front(&self, a: Point, b: Point) -> Ordering {
        let disk = self.on_grid_of(&[a, b]);
        let across = disk.grid.difference(a, b).direction().perp();
        disk.sign(&disk.linear_from(&disk.grid.local(a), &across))
    }

    /// Orders the centre against `p` along the direction from `a` to `b`: the sign of
    /// `(b - a)·(c - p)`.
    ///
    /// With `p = a` and `p = b` this is the zone of an edge, with a reflex corner as `p` one of the
    /// two walls of its zone.
    #[must_use]
    pub fn along(&self, a: Point, b: Point, p: Point) -> Ordering {
        let disk = self.on_grid_of(&[a, b, p]);
        let direction = disk.grid.difference(a, b).direction();
        disk.sign(&disk.linear_from(&disk.grid.local(p), &direction))
    }

    /// Orders the centres of two disks along the direction from `a` to `b`: the sign of
    /// `(b - a)·(c - c')` for the centre `c'` of the other one.
    #[must_use]
    pub fn compare_along(&self, other: &Self, a: Point, b: Point) -> Ordering {
        self.compare_centres(other, a, b, |direction| direction)
    }

    /// Orders the centres of two disks across the direction from `a` to `b`: the sign of
    /// `(b - a)×(c - c')`, which is `Greater` if this one lies further to the left.
    #[must_use]
    pub fn compare_across(&self, other: &Self, a: Point, b: Point) -> Ordering {
        self.compare_centres(other, a, b, |direction| direction.perp())
    }

    fn compare_centres(
        &self,
        other: &Self,
        a: Point,
        b: Point,
        turn: impl Fn(Vector) -> Vector,
    ) -> Ordering {
        // Both disks on one grid unit, each with its own origin.
        let grid = self.grid.refined(&[a, b, other.grid.origin]).at_most(other.grid.unit);
        let (this, other) = (self.on_unit(grid.unit), other.on_unit(grid.unit));
        let direction = turn(grid.difference(a, b).direction());
        let offset = direction.dot(&grid.difference(this.grid.origin, other.grid.origin));
        let ours = this.linear(&direction).sub(&this.w.scale(&offset));
        let theirs = other.linear(&direction);
        let mut tower = this.tower.clone();
        let roots = tower.adjoin(&other.tower);
        let theirs = tower.mul(&tower.image(&theirs, &roots), &this.w);
        let ours = tower.mul(&ours, &tower.image(&other.w, &roots));
        count(|counts| counts.tower += 1);
        tower.sign(&ours.sub(&theirs))
    }

    /// The sign of `(p - c)×(q - c)`: `Greater` if from the centre `q` lies counterclockwise of `p`
    /// by less than half a turn.
    #[must_use]
    pub fn orientation(&self, p: Point, q: Point) -> Ordering {
        let disk = self.on_grid_of(&[p, q]);
        let across = disk.grid.difference(p, q).perp();
        disk.sign(&disk.linear_from(&disk.grid.local(p), &across))
    }

    /// The sign of a number of this disk's tower.
    fn sign(&self, number: &Surd) -> Ordering {
        count(|counts| counts.tower += 1);
        self.tower.sign(number)
    }

    /// `v·c·w`, for the centre from the origin.
    fn linear(&self, v: &Vector) -> Surd {
        self.x.scale(&v.x).add(&self.y.scale(&v.y))
    }

    /// `v·(c - p)·w`, for `p` from the origin.
    fn linear_from(&self, p: &Vector, v: &Vector) -> Surd {
        self.linear(v).sub(&self.w.scale(&v.dot(p)))
    }

    /// `(c - p)·w`, for `p` from the origin.
    fn centre_from(&self, p: &Vector) -> (Surd, Surd) {
        (self.x.sub(&self.w.scale(&p.x)), self.y.sub(&self.w.scale(&p.y)))
    }

    /// The same disk on a grid that also holds the given points.
    fn on_grid_of(&self, points: &[Point]) -> Cow<'_, Self> {
        self.on_unit(self.grid.refined(points).unit)
    }

    /// The same disk on a finer grid, or as it is.
    fn on_unit(&self, unit: i32) -> Cow<'_, Self> {
        if unit >= self.grid.unit {
            return Cow::Borrowed(self);
        }
        // Only lengths change: the centre and the radius, not the ratios.
        let bits = (self.grid.unit - unit) as usize;
        let radius = match &self.radius {
            Radius::Over { part, n } => Radius::Over { part: part.shift(bits), n: n.clone() },
            Radius::Times { part, n } => Radius::Times { part: part.shift(bits), n: n.clone() },
        };
        Cow::Owned(Self {
            elements: self.elements,
            grid: Grid { unit, ..self.grid },
            through_origin: self.through_origin,
            tower: self.tower.clone(),
            x: self.x.shift(bits),
            y: self.y.shift(bits),
            w: self.w.clone(),
            radius,
        })
    }
}

/// The points that define an element.
fn points(element: &Element) -> impl Iterator<Item = Point> + use<> {
    let (first, second) = match *element {
        Element::Corner(p) => (p, None),
        Element::Edge(a, b) => (a, Some(b)),
    };
    std::iter::once(first).chain(second)
}
