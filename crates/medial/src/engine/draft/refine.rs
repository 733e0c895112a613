//! The disk of three governors in about twice the precision of doubles, rounded once.
//!
//! # Method
//! Everything is relative to the end of a governor nearest to the centre; differences of
//! coordinates are exact sums of two doubles.
//! - Where the centre lies on the normal of an edge at its end `v`, with `d` along the edge, the
//!   disk is `v + t d⊥` with radius `t |d|`, and `t` a quotient of products.
//! - Else Newton steps: residuals `distance - r` in twice the precision, normals and the solution in
//!   doubles. For an edge `(q × d - r |d|) / |d|`, for a corner `(q·q - r²) / (|q| + r)`: one root and
//!   no division is precise.

use crate::geom::{Doubled, Fused, Governor, Point};

/// Least spread of the normals with which Newton steps in doubles converge.
const LEAST_SPREAD: f64 = 1e-12;

/// Rounding of one residual in [`Double`] arithmetic, relative to the sizes that enter it.
///
/// Twenty operations of at most 2^-100 each, with room to spare.
const RESIDUAL_ERROR: f64 = 1.0 / (1_u128 << 90) as f64;

/// Error, relative to the largest of the numbers, below which no other step is taken: far below what
/// rounding adds in the end.
const SMALL: f64 = f64::EPSILON / 64.0;

/// Newton steps that are tried.
const MOST_STEPS: usize = 6;

/// Centre and radius near a start, right to about half an ulp of max(|x|, |y|, radius); `None` where
/// that cannot be had.
#[inline]
pub(super) fn refined(
    governors: &[Governor; 3],
    centre: Point,
    radius: f64,
) -> Option<(Point, f64)> {
    #[cfg(target_arch = "x86_64")]
    if let Some(fused) = Fused::detect() {
        return fused.refined(governors, centre, radius);
    }
    refined_by::<false>(governors, centre, radius)
}

#[cfg(target_arch = "x86_64")]
impl Fused {
    #[inline]
    #[allow(unsafe_code, reason = "only the machine itself tells what instructions it has")]
    fn refined(
        self,
        governors: &[Governor; 3],
        centre: Point,
        radius: f64,
    ) -> Option<(Point, f64)> {
        // SAFETY: `self` is made only where the machine has them.
        unsafe { refined_fused(governors, centre, radius) }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "fma")]
fn refined_fused(governors: &[Governor; 3], centre: Point, radius: f64) -> Option<(Point, f64)> {
    refined_by::<true>(governors, centre, radius)
}

#[inline(always)]
fn refined_by<const F: bool>(
    governors: &[Governor; 3],
    centre: Point,
    radius: f64,
) -> Option<(Point, f64)> {
    let Refined { centre, radius, bound } = match on_normal(governors) {
        Some((direction, at, other)) => at_end::<F>(direction, at, other)?,
        None => steps::<F>(governors, centre, radius)?,
    };
    let scale = size(centre, radius);
    let sound = radius > 0.0 && centre.x.is_finite() && centre.y.is_finite();
    // Half an ulp of rounding comes on top.
    (sound && bound <= f64::EPSILON / 4.0 * scale).then_some((centre, radius))
}

/// A disk whose centre and radius have been rounded once, and the error before that.
struct Refined {
    centre: Point,
    radius: f64,
    bound: f64,
}

fn size(centre: Point, radius: f64) -> f64 {
    centre.x.abs().max(centre.y.abs()).max(radius)
}

/// A vector of pairs of doubles.
#[derive(Clone, Copy)]
struct Vector<const F: bool> {
    x: Doubled<F>,
    y: Doubled<F>,
}

impl<const F: bool> Vector<F> {
    #[inline(always)]
    fn difference(a: Point, b: Point) -> Self {
        Self { x: Doubled::difference(a.x, b.x), y: Doubled::difference(a.y, b.y) }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self { x: self.x.minus(other.x), y: self.y.minus(other.y) }
    }

    #[inline(always)]
    fn dot(self, other: Self) -> Doubled<F> {
        Doubled::sum_of_products(self.x, other.x, self.y, other.y)
    }

    #[inline(always)]
    fn cross(self, other: Self) -> Doubled<F> {
        Doubled::sum_of_products(self.x, other.y, -self.y, other.x)
    }

    #[inline(always)]
    fn value(self) -> Point {
        Point::new(self.x.value(), self.y.value())
    }
}

/// The ends of an edge among the governors that ends at another one, that corner first, and the
/// third governor.
fn on_normal(governors: &[Governor; 3]) -> Option<((Point, Point), Point, &Governor)> {
    let mut found = None;
    for (i, edge) in governors.iter().enumerate() {
        let Governor::Edge { start, end, .. } = *edge else { continue };
        for (j, corner) in governors.iter().enumerate() {
            if let Governor::Corner(p) = *corner
                && (start == p || end == p)
            {
                found = Some(((start, end), p, &governors[3 - i - j]));
            }
        }
    }
    found
}

/// The disk with its centre on the normal of an edge at one of its ends.
#[inline(always)]
fn at_end<const F: bool>(
    (start, end): (Point, Point),
    at: Point,
    other: &Governor,
) -> Option<Refined> {
    let d = Vector::<F>::difference(end, start);
    let length = d.dot(d).sqrt();
    // The radius is t |d|, with an error relative to it.
    let (t, error) = match *other {
        Governor::Corner(w) => {
            // w·w = 2 t d⊥·w
            let w = Vector::difference(w, at);
            let (square, across) = (w.dot(w), d.cross(w));
            let lost = length.value() * square.value().sqrt() / across.value();
            (square / (across + across), 4.0 + lost)
        }
        Governor::Edge { start, end, .. } => {
            // h = t (|d| |e| - d·e) for the distance h / |e| of the edge's line
            let e = Vector::difference(end, start);
            let (q, p) = (Vector::difference(at, start), Vector::difference(at, end));
            let q = if q.value().norm2() <= p.value().norm2() { q } else { p };
            let (h, along) = (e.cross(q), d.dot(e));
            let width = e.dot(e).sqrt();
            let both = length * width;
            let lost = width.value() * q.value().norm() / h.value();
            if along.value() <= 0.0 {
                (h / (both - along), 4.0 + lost)
            } else {
                // (|d| |e| - d·e) (|d| |e| + d·e) = (d × e)²
                let across = d.cross(e);
                let more = both.value() / across.value().abs();
                (h / across * ((both + along) / across), 8.0 + lost + 2.0 * more)
            }
        }
    };
    let radius = (length * t).value();
    let x = Doubled::from(at.x) - d.y * t;
    let y = Doubled::from(at.y) + d.x * t;
    let sound = t.value() > 0.0 && error * RESIDUAL_ERROR <= 0.125;
    let centre = Point::new(x.value(), y.value());
    sound.then_some(Refined { centre, radius, bound: radius * error * RESIDUAL_ERROR })
}

/// The disk that Newton steps lead to.
#[inline(always)]
fn steps<const F: bool>(governors: &[Governor; 3], centre: Point, radius: f64) -> Option<Refined> {
    // As below, for normals that no step changes.
    if let [
        Governor::Edge { direction: t1, .. },
        Governor::Edge { direction: t2, .. },
        Governor::Edge { direction: t3, .. },
    ] = *governors
        && (t2 - t1).cross(t3 - t1) <= LEAST_SPREAD
    {
        return None;
    }
    let away = |p: Point| (p - centre).norm2();
    let anchors = [0, 1, 2].map(|k| match governors[k] {
        Governor::Corner(p) => p,
        Governor::Edge { start, end, .. } if away(start) <= away(end) => start,
        Governor::Edge { end, .. } => end,
    });
    let [a, b, c] = anchors;
    let nearer = if away(b) < away(a) { b } else { a };
    let origin = if away(c) < away(nearer) { c } else { nearer };
    let frames =
        [0, 1, 2].map(|k| (Frame::<F>::new(&governors[k]), Vector::difference(anchors[k], origin)));
    let curved = governors.iter().any(|g| matches!(g, Governor::Corner(_)));
    let mut local = Vector::difference(centre, origin);
    let mut r = Doubled::<F>::from(radius);
    let mut best: Option<Refined> = None;
    for _ in 0..MOST_STEPS {
        let [(n1, p1, s1), (n2, p2, s2), (n3, p3, s3)] =
            [seen(&frames[0], local, r), seen(&frames[1], local, r), seen(&frames[2], local, r)];
        let (b, e) = (n2 - n1, n3 - n1);
        let d = b.cross(e);
        // Below this the solution in doubles no longer converges.
        if d.is_nan() || d <= LEAST_SPREAD {
            return None;
        }
        let per = 1.0 / d;
        let (p12, p13) = (p1 - p2, p1 - p3);
        let dx = Point::new((p12 * e.y - p13 * b.y) * per, (b.x * p13 - e.x * p12) * per);
        let dr = p1 + n1.dot(dx);
        // Any unit vector is an affine combination of the normals with weights of at most half that.
        let gain = 4.0 * ((n2 - n3).norm() + e.norm() + b.norm()) * per;
        let c = local.value();
        let error = RESIDUAL_ERROR * (radius + c.x.abs() + c.y.abs() + s1 + s2 + s3);
        let step = gain * (p1.abs().max(p2.abs()).max(p3.abs()) + error);
        let x = Doubled::from(origin.x) + (local.x + Doubled::from(dx.x));
        let y = Doubled::from(origin.y) + (local.y + Doubled::from(dx.y));
        // What the step leaves: the roundings of its normals and its solution, and the curvature of
        // the distance from corners, where it is so short that the normals stay about the same.
        let mut left = error + 16.0 * f64::EPSILON * step;
        if curved {
            left += if 16.0 * gain * step <= radius { step * step / radius } else { step };
        }
        let bound = gain * left + 32.0 * f64::EPSILON * step * per;
        (local.x, local.y) = (local.x + Doubled::from(dx.x), local.y + Doubled::from(dx.y));
        r = r + Doubled::from(dr);
        if best.as_ref().is_some_and(|best| bound.is_nan() || bound >= best.bound / 2.0) {
            break;
        }
        let refined =
            Refined { centre: Point::new(x.value(), y.value()), radius: r.value(), bound };
        let small = bound <= SMALL * size(refined.centre, refined.radius);
        best = Some(refined);
        if small {
            break;
        }
    }
    best
}

/// The residual of a governor, given with what leads to its anchor, and the size of that.
#[inline(always)]
fn seen<const F: bool>(
    (frame, a): &(Frame<F>, Vector<F>),
    local: Vector<F>,
    r: Doubled<F>,
) -> (Point, f64, f64) {
    let (normal, rho) = frame.residual(local.minus(*a), r);
    (normal, rho, a.value().x.abs() + a.value().y.abs())
}

/// A governor as residuals need it.
enum Frame<const F: bool> {
    Corner,
    /// The way along an edge, its length, and the unit normal, rounded.
    Edge(Vector<F>, Doubled<F>, Point),
}

impl<const F: bool> Frame<F> {
    #[inline(always)]
    fn new(governor: &Governor) -> Self {
        match *governor {
            Governor::Corner(_) => Self::Corner,
            Governor::Edge { start, end, direction } => {
                let d = Vector::difference(end, start);
                Self::Edge(d, d.dot(d).sqrt(), direction.perp())
            }
        }
    }

    /// Unit normal towards the centre, rounded, and distance less radius; `q` leads from the corner, or
    /// from an end of the edge, to the centre.
    #[inline(always)]
    fn residual(&self, q: Vector<F>, r: Doubled<F>) -> (Point, f64) {
        match *self {
            Self::Corner => {
                let square = q.dot(q);
                let distance = square.value().sqrt();
                let rho = square.less_product(r, r) / (distance + r.value());
                (q.value() * (1.0 / distance), rho)
            }
            Self::Edge(d, length, normal) => {
                (normal, d.cross(q).less_product(r, length) / length.value())
            }
        }
    }
}
