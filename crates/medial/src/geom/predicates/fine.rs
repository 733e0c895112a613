//! A disk in pairs of doubles with a bound on its error, which decides near ties.

use std::cmp::Ordering;

use super::Element;
use super::near::{Near, SHORT, sign};
use crate::geom::{Double, Doubled, Fused, Pinned, Point, U};

/// Rounding of a distance, or of a sum of two products, relative to the sizes that enter it.
///
/// A direction is right to 4·2^-100 of its components, a difference to 2^-100 of its operands, and
/// products and sums add three more: less than 16·2^-100 in all.
const ROUNDING: f64 = 1.0 / (1_u128 << 96) as f64;

/// Error, as a share of the largest number of a disk, up to which rounding loses more: a quarter of an ulp.
const CLEAR: f64 = f64::EPSILON / 4.0;

/// Newton steps before a disk is left to integers; each one gains at least a bit.
const STEPS: usize = 12;

/// A vector of pairs of doubles.
type Pair = Paired<false>;

/// The same, with numbers that are multiplied and added at once, or not.
#[derive(Clone, Copy, Debug)]
struct Paired<const F: bool> {
    x: Doubled<F>,
    y: Doubled<F>,
}

impl<const F: bool> Paired<F> {
    const ZERO: Self = Self { x: Doubled::ZERO, y: Doubled::ZERO };

    /// The same vector, to be computed with in that way.
    #[inline(always)]
    fn cast<const OTHER: bool>(self) -> Paired<OTHER> {
        Paired { x: self.x.cast(), y: self.y.cast() }
    }

    /// The difference of two points, without error.
    #[inline(always)]
    fn between(from: Point, to: Point) -> Self {
        Self { x: Doubled::difference(to.x, from.x), y: Doubled::difference(to.y, from.y) }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }

    #[inline(always)]
    fn dot(self, other: Self) -> Doubled<F> {
        self.x * other.x + self.y * other.y
    }

    #[inline(always)]
    fn perp(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    #[inline(always)]
    fn times(self, factor: Doubled<F>) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }

    #[inline(always)]
    fn value(self) -> Point {
        Point::new(self.x.value(), self.y.value())
    }

    /// Sum of the sizes of the components.
    #[inline(always)]
    fn size(self) -> f64 {
        self.x.value().abs() + self.y.value().abs()
    }
}

/// An element relative to the origin.
#[derive(Clone, Copy)]
enum Local {
    Corner(Pair),
    /// A point of the supporting line and the unit normal.
    Edge(Pair, Pair),
}

/// A distance from the centre less the radius, with the unit vector towards the centre, and what the
/// distance may be off.
struct Residual {
    normal: Pair,
    rest: Double,
    error: f64,
}

/// An element relative to the origin, its normal in doubles.
#[derive(Clone, Copy)]
enum Plain<const F: bool> {
    Corner(Paired<F>),
    /// A point of the supporting line, the way along it and its length, and the unit normal, each
    /// component within 4u of its own.
    Edge(Paired<F>, Paired<F>, Doubled<F>, Point),
}

impl<const F: bool> Plain<F> {
    #[inline(always)]
    fn new(element: Element, origin: Point, near: Point) -> Self {
        match element {
            Element::Corner(p) => Self::Corner(Paired::<F>::between(origin, p)),
            Element::Edge(a, b) => {
                let nearest = if (a - near).norm2() <= (b - near).norm2() { a } else { b };
                let d = Paired::<F>::between(a, b);
                let length = Doubled::<F>::sum_of_products(d.x, d.x, d.y, d.y).sqrt();
                let normal = d.value().perp() * (1.0 / length.value());
                Self::Edge(Paired::<F>::between(origin, nearest), d, length, normal)
            }
        }
    }

    /// Unit normal towards the centre, distance less radius, and what that may be off.
    ///
    /// For an edge `(d × q - r |d|) / |d|`, for a corner `(q·q - r²) / (|q| + r)`: one root and no
    /// division is precise.
    #[inline(always)]
    fn residual(&self, disk: &Fine) -> (Point, f64, f64) {
        let (Self::Corner(p) | Self::Edge(p, ..)) = *self;
        let (q, r) = (disk.centre.cast().minus(p), disk.radius.cast());
        let (normal, rest) = match *self {
            Self::Corner(_) => {
                let square = Doubled::<F>::sum_of_products(q.x, q.x, q.y, q.y);
                let distance = square.value().sqrt();
                let rest = square.less_product(r, r) / (distance + r.value());
                (q.value() * (1.0 / distance), rest)
            }
            Self::Edge(_, d, length, normal) => {
                let cross = Doubled::<F>::sum_of_products(d.x, q.y, -d.y, q.x);
                (normal, cross.less_product(r, length) / length.value())
            }
        };
        let size = q.size() + disk.centre.size() + p.size() + r.value().abs();
        (normal, rest, ROUNDING * size + SHORT + 16.0 * U * rest.abs())
    }
}

/// What is seen of three elements from the centre of a disk.
struct Seen {
    /// Normal of the first one.
    first: Point,
    /// Differences of the normals: from the first to the second, to the third, and from that to the second.
    b: Point,
    e: Point,
    across: Point,
    /// What differences of normals may be off, beyond u of their own.
    blur: f64,
    /// Distances less the radius, and what they may be off.
    rests: [f64; 3],
    errors: [f64; 3],
}

impl Seen {
    #[inline(always)]
    fn plain<const F: bool>(disk: &Fine, [g1, g2, g3]: &[Plain<F>; 3]) -> Self {
        let [(n1, p1, e1), (n2, p2, e2), (n3, p3, e3)] =
            [g1.residual(disk), g2.residual(disk), g3.residual(disk)];
        let (b, e, across) = (n2 - n1, n3 - n1, n2 - n3);
        let blur = 16.0 * U;
        Self { first: n1, b, e, across, blur, rests: [p1, p2, p3], errors: [e1, e2, e3] }
    }

    fn precise(disk: &Fine, elements: &[Local; 3]) -> Self {
        let [r1, r2, r3] = elements.map(|local| disk.residual(local));
        let difference = |a: &Residual, b: &Residual| b.normal.minus(a.normal).value();
        Self {
            first: r1.normal.value(),
            b: difference(&r1, &r2),
            e: difference(&r1, &r3),
            across: difference(&r3, &r2),
            blur: 4.0 * ROUNDING,
            rests: [&r1, &r2, &r3].map(|r| r.rest.value()),
            errors: [r1.error, r2.error, r3.error],
        }
    }

    /// Whether the normals are so far apart that what they are off hardly tells.
    fn is_wide(&self) -> bool {
        self.b.cross(self.e) > 64.0 * self.blur * (self.b.norm() + self.e.norm())
    }
}

/// A disk, each of its numbers, and its distance to anything less its radius, within `error`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fine {
    origin: Point,
    /// Relative to the origin.
    centre: Pair,
    radius: Double,
    error: f64,
}

impl Fine {
    /// The disk touching three elements, contacts counterclockwise, found from one nearby.
    ///
    /// `None` if pairs of doubles cannot prove it.
    pub(super) fn new(elements: &[Element; 3], start: &Near) -> Option<Self> {
        if let Some((v, edge, other)) = super::transition::touching_end(elements) {
            return Self::on_normal(v, edge, other, start.radius);
        }
        let origin = start.origin;
        let disk = Self {
            origin,
            centre: Pair { x: start.centre.x.into(), y: start.centre.y.into() },
            radius: start.radius.into(),
            error: f64::INFINITY,
        };
        let centre = origin + start.centre;
        let corners = elements.iter().any(|e| matches!(e, Element::Corner(_)));
        // Where the normals are clearly apart doubles hold them well enough.
        if let Some(found) = disk.plain_steps(elements, centre, corners) {
            return Some(found);
        }
        let locals = [
            disk.local(elements[0], centre)?,
            disk.local(elements[1], centre)?,
            disk.local(elements[2], centre)?,
        ];
        Self::steps(disk, corners, |disk| Seen::precise(disk, &locals))
    }

    /// The disk that Newton steps with normals in doubles lead to, if these are clearly apart.
    fn plain_steps(&self, elements: &[Element; 3], centre: Point, corners: bool) -> Option<Self> {
        #[cfg(target_arch = "x86_64")]
        if let Some(fused) = Fused::detect() {
            return fused.plain_steps(self, elements, centre, corners);
        }
        self.plain_steps_by::<false>(elements, centre, corners)
    }

    #[inline(always)]
    fn plain_steps_by<const F: bool>(
        &self,
        &[a, b, c]: &[Element; 3],
        centre: Point,
        corners: bool,
    ) -> Option<Self> {
        let plain = [
            Plain::<F>::new(a, self.origin, centre),
            Plain::new(b, self.origin, centre),
            Plain::new(c, self.origin, centre),
        ];
        let wide = Seen::plain(self, &plain).is_wide();
        wide.then(|| Self::steps(*self, corners, |disk| Seen::plain(disk, &plain))).flatten()
    }

    /// The disk that Newton steps lead to.
    #[inline(always)]
    fn steps(mut disk: Self, corners: bool, see: impl Fn(&Self) -> Seen) -> Option<Self> {
        let mut best: Option<Self> = None;
        for _ in 0..STEPS {
            let Seen { first, b, e, across, blur, rests, errors } = see(&disk);
            let (lb, le) = (b.norm(), e.norm());
            // The components are off by u of their own and what the normals are.
            let cross = b.cross(e);
            let d = cross - (8.0 * U * lb * le + blur * (lb + le + blur));
            if d.is_nan() || d <= 0.0 {
                return best;
            }
            let sides = [across.norm(), le, lb].map(|l| l + blur);
            let open = |k: usize| rests[k].abs() + errors[k];
            // What is left is rounding, which no step makes less.
            let last = (0..3).all(|k| rests[k].abs() <= errors[k]);
            let factor = 2.0 / d;
            let mut error = factor * (sides[0] * open(0) + sides[1] * open(1) + sides[2] * open(2));
            if corners {
                let k = factor * (sides[0] + sides[1] + sides[2]);
                let near = 32.0 * k * error <= disk.radius.value();
                error = if near { 1.25 * error } else { f64::INFINITY };
            }
            let error = error * (1.0 + 64.0 * U);
            if error < disk.radius.value() && best.is_none_or(|known| error < known.error) {
                let done = last || best.is_some_and(|known| 2.0 * error > known.error);
                best = Some(Self { error, ..disk });
                if done {
                    return best;
                }
            } else if best.is_some() {
                return best;
            }
            let (p12, p13) = (rests[0] - rests[1], rests[0] - rests[2]);
            let dx = Point::new((p12 * e.y - p13 * b.y) / cross, (b.x * p13 - e.x * p12) / cross);
            let step = rests[0] + first.dot(dx);
            disk.centre.x = disk.centre.x + dx.x.into();
            disk.centre.y = disk.centre.y + dx.y.into();
            disk.radius = disk.radius + step.into();
        }
        best
    }

    /// A disk that is known relative to a circle.
    pub(super) fn pinned(disk: &Pinned) -> Self {
        let Pinned { base, base_radius, centre, radius, bound, .. } = *disk;
        let centre = Pair { x: centre.x.into(), y: centre.y.into() };
        let radius = Double::from(base_radius) + radius.into();
        let error = (bound + ROUNDING * radius.value()) * (1.0 + 8.0 * U);
        Self { origin: base, centre, radius, error }
    }

    /// The disk with its centre on the normal of an edge at its end `v`.
    fn on_normal(v: Point, [a, b]: [Point; 2], other: Element, radius: f64) -> Option<Self> {
        let mut disk =
            Self { origin: v, centre: Pair::ZERO, radius: radius.into(), error: f64::INFINITY };
        let normal = unit(Pair::between(a, b))?.perp();
        let other = disk.local(other, v + normal.value() * radius)?;
        let mut best: Option<Self> = None;
        for _ in 0..STEPS {
            disk.centre = normal.times(disk.radius);
            let Residual { normal: n, rest, error } = disk.residual(other);
            let between = n.minus(normal).value().norm();
            let g = between * between / 2.0;
            let least = g * (1.0 - 16.0 * U) - 8.0 * ROUNDING * between;
            let r = disk.radius.value();
            if least.is_nan() || least <= 0.0 || r.is_nan() || r <= 0.0 {
                return best;
            }
            let rounding = 2.0 * ROUNDING * r;
            let mut bound = 2.0 * (rest.value().abs() + error + rounding) / least + rounding;
            if let Local::Corner(_) = other {
                bound = if 64.0 * bound <= r * least { 1.25 * bound } else { f64::INFINITY };
            }
            let bound = bound * (1.0 + 64.0 * U);
            if bound < r && best.is_none_or(|known| bound < known.error) {
                let done = rest.value().abs() <= error
                    || best.is_some_and(|known| 2.0 * bound > known.error);
                best = Some(Self { error: bound, ..disk });
                if done {
                    return best;
                }
            } else if best.is_some() {
                return best;
            }
            disk.radius = disk.radius + (rest.value() / g).into();
        }
        best
    }

    fn local(&self, element: Element, near: Point) -> Option<Local> {
        Some(match element {
            Element::Corner(p) => Local::Corner(Pair::between(self.origin, p)),
            Element::Edge(a, b) => {
                let nearest = if (a - near).norm2() <= (b - near).norm2() { a } else { b };
                let normal = unit(Pair::between(a, b))?.perp();
                Local::Edge(Pair::between(self.origin, nearest), normal)
            }
        })
    }

    fn residual(&self, local: Local) -> Residual {
        let (Local::Corner(p) | Local::Edge(p, _)) = local;
        let q = self.centre.minus(p);
        let (normal, distance) = match local {
            Local::Corner(_) => {
                let distance = q.dot(q).sqrt();
                (q.times(Double::from(1.0) / distance), distance)
            }
            Local::Edge(_, normal) => (normal, q.dot(normal)),
        };
        let size = q.size() + self.centre.size() + p.size() + self.radius.value().abs();
        Residual { normal, rest: distance - self.radius, error: ROUNDING * size + SHORT }
    }

    /// The disk in doubles.
    pub(super) fn near(&self) -> Near {
        let (centre, radius) = (self.centre.value(), self.radius.value());
        let size = centre.x.abs() + centre.y.abs() + radius.abs();
        let error = (self.error + U * size) * (1.0 + 8.0 * U);
        Near { origin: self.origin, centre, radius, error }
    }

    /// Centre and radius, each coordinate rounded to the nearest double, if that is certain.
    pub(super) fn nearest(&self) -> Option<(Point, f64)> {
        let coordinate = |origin: f64, local: Double| {
            let sum = Double::from(origin) + local;
            nearest(sum, self.error + ROUNDING * (origin.abs() + local.value().abs()))
        };
        let x = coordinate(self.origin.x, self.centre.x)?;
        let y = coordinate(self.origin.y, self.centre.y)?;
        Some((Point::new(x, y), nearest(self.radius, self.error)?))
    }

    /// Centre and radius, rounded, if they are known to a quarter of an ulp of the largest of the three
    /// numbers.
    pub(super) fn rounded(&self) -> Option<(Point, f64)> {
        let x = (Double::from(self.origin.x) + self.centre.x).value();
        let y = (Double::from(self.origin.y) + self.centre.y).value();
        let radius = self.radius.value();
        let size = x.abs().max(y.abs()).max(radius);
        (self.error <= CLEAR * size).then_some((Point::new(x, y), radius))
    }

    /// The centre relative to a point, and a bound on the error of its distances and coordinates.
    fn centre_from(&self, p: Point) -> (Pair, f64) {
        let local = Pair::between(self.origin, p);
        (self.centre.minus(local), self.error + ROUNDING * (local.size() + self.centre.size()))
    }

    /// The sign of `(b - a)·(c - p)`.
    pub(super) fn along(&self, a: Point, b: Point, p: Point) -> Option<Ordering> {
        self.product(Pair::between(a, b), p)
    }

    /// The sign of `(b - a)×(c - a)`.
    pub(super) fn front(&self, a: Point, b: Point) -> Option<Ordering> {
        self.product(Pair::between(a, b).perp(), a)
    }

    fn product(&self, v: Pair, p: Point) -> Option<Ordering> {
        let (c, error) = self.centre_from(p);
        let value = v.dot(c).value();
        sign(value, 2.0 * v.size() * (error + ROUNDING * c.size()) + 2.0 * U * value.abs())
    }

    /// The sign of `v·(c - c')` for the centre of another disk, and `v` the way from `a` to `b`, or that
    /// turned by a quarter to the left.
    pub(super) fn compare(
        &self,
        other: &Self,
        (a, b): (Point, Point),
        across: bool,
    ) -> Option<Ordering> {
        let (from, error) = self.centre_from(other.origin);
        let c = from.minus(other.centre);
        let v = Pair::between(a, b);
        let v = if across { v.perp() } else { v };
        let value = v.dot(c).value();
        let error = error + other.error + ROUNDING * (from.size() + other.centre.size() + c.size());
        sign(value, 2.0 * v.size() * error + 2.0 * U * value.abs())
    }

    /// The sign of the distance of an element less the radius.
    pub(super) fn side(&self, element: Element) -> Option<Ordering> {
        let radius = self.radius.value();
        match element {
            Element::Corner(p) => {
                // (|q| - r)(|q| + r)
                let (q, error) = self.centre_from(p);
                let value = (q.dot(q) - self.radius * self.radius).value();
                let size = q.size() + radius;
                sign(value, 2.0 * size * (error + ROUNDING * size + SHORT) + 2.0 * U * value.abs())
            }
            Element::Edge(a, b) => {
                let (q, error) = self.centre_from(a);
                let d = Pair::between(a, b);
                let length = d.dot(d).sqrt();
                let value = (d.perp().dot(q) - length * self.radius).value();
                let error = error + ROUNDING * (q.size() + radius) + SHORT;
                sign(value, 2.0 * d.size() * error + 2.0 * U * value.abs())
            }
        }
    }
}

#[cfg(target_arch = "x86_64")]
impl Fused {
    #[inline]
    #[allow(unsafe_code, reason = "only the machine itself tells what instructions it has")]
    fn plain_steps(
        self,
        disk: &Fine,
        elements: &[Element; 3],
        centre: Point,
        corners: bool,
    ) -> Option<Fine> {
        // SAFETY: `self` is made only where the machine has them.
        unsafe { plain_steps_fused(disk, elements, centre, corners) }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "fma")]
fn plain_steps_fused(
    disk: &Fine,
    elements: &[Element; 3],
    centre: Point,
    corners: bool,
) -> Option<Fine> {
    disk.plain_steps_by::<true>(elements, centre, corners)
}

/// The unit vector of a direction.
fn unit(d: Pair) -> Option<Pair> {
    let length = d.dot(d).sqrt();
    (length.value() > 0.0).then(|| d.times(Double::from(1.0) / length))
}

/// The double nearest to all numbers within `error` of a value, if there is one.
fn nearest(value: Double, error: f64) -> Option<f64> {
    let high = value.value();
    let low = (value - high.into()).value();
    // Rounding is monotonic.
    let error = error * (1.0 + 4.0 * U) + U * low.abs();
    (high + (low + error) == high && high + (low - error) == high).then_some(high)
}
