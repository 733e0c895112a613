//! The curve of a path, from its governors and its two keypoints.
//!
//! # Contract
//! Every form keeps full precision on short paths far from the apex; the ends of a curve are the
//! keypoints, bit for bit. Nothing here decides anything about the graph.
//!
//! # Method
//! A natural parameter along the bisector (position along the edge for a parabola, distance from
//! the midpoint between two corners, length between two edges) makes positions and radii
//! polynomials or single roots of it. Public parameters run from 0 at `from` to 1 at `to` and are
//! affine in the natural parameter, so a parameter of a parabola is also that of its Bézier form.

use super::hyperbolic::{asinh, hypot};
use super::roots::{crossing, cubic_roots};
use super::sites::SiteShape;
use super::{Accuracy, CurveKind, Keypoint, MedialAxis, Path, Site, SiteKind};
use crate::geom::Point;

/// Most pieces a curve is drawn with.
///
/// Drawing only. Reached when the tolerance is some 1e-11 of the curve; finer polylines would
/// show nothing more, and a mistyped tolerance would fill the memory.
const MAX_PIECES: f64 = 65_536.0;

/// The curve of a path: a line or a piece of a parabola, with the radius along it.
///
/// ```
/// use medial::axis::{Curve, Site};
/// use medial::geom::Point;
///
/// // The focus (0, 2) over the edge y = 0: the apex lies in the middle, at (0, 1).
/// let edge = Site::edge(Point::new(-9.0, 0.0), Point::new(9.0, 0.0));
/// let corner = Site::vertex(Point::new(0.0, 2.0));
/// let from = (Point::new(-2.0, 2.0), 2.0);
/// let to = (Point::new(2.0, 2.0), 2.0);
/// let curve = Curve::new(&corner, &edge, from, to);
/// assert_eq!(curve.point_at(0.5), Point::new(0.0, 1.0));
/// assert_eq!(curve.control(), Some(Point::new(0.0, 0.0)));
/// assert_eq!((curve.radius_min(), curve.radius_max()), (1.0, 2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    from: Point,
    to: Point,
    radius_from: f64,
    radius_to: f64,
    form: Form,
}

/// What the radius does along the curve, with its natural parameters at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// Between two edges: a line, the radius linear in the length.
    Linear,
    /// Between two corners `2 half` apart: a line, the radius `√(half² + s²)` at `s` from their
    /// midpoint.
    Corners { half: f64, s: [f64; 2] },
    /// Between a corner at distance `d > 0` from a line and that line: `x` along the line.
    Parabola { d: f64, x: [f64; 2], focus: Point, tangent: Point },
}

impl Curve {
    /// The curve between two keypoints, given as centre and radius, with these governors.
    ///
    /// A corner on the line of its own edge has no parabola; the result is then the straight
    /// line between the keypoints. Such a pair governs no path of an axis.
    #[must_use]
    pub fn new(left: &Site, right: &Site, from: (Point, f64), to: (Point, f64)) -> Self {
        Self::between(&left.into(), &right.into(), from, to)
    }

    /// The same without places in the input.
    #[inline]
    pub(crate) fn between(
        left: &SiteShape,
        right: &SiteShape,
        from: (Point, f64),
        to: (Point, f64),
    ) -> Self {
        let form = match (left.kind, right.kind) {
            (SiteKind::Edge, SiteKind::Edge) => Form::Linear,
            (SiteKind::Vertex, SiteKind::Vertex) => corners(left.a, right.a, from.0, to.0),
            (SiteKind::Vertex, SiteKind::Edge) => parabola(left.a, right, from, to),
            (SiteKind::Edge, SiteKind::Vertex) => parabola(right.a, left, from, to),
        };
        Self { from: from.0, to: to.0, radius_from: from.1, radius_to: to.1, form }
    }

    /// Line or parabola.
    #[must_use]
    pub fn kind(&self) -> CurveKind {
        match self.form {
            Form::Linear | Form::Corners { .. } => CurveKind::Line,
            Form::Parabola { .. } => CurveKind::Parabola,
        }
    }

    /// Where the curve starts.
    #[must_use]
    pub fn from(&self) -> Point {
        self.from
    }

    /// Where the curve ends.
    #[must_use]
    pub fn to(&self) -> Point {
        self.to
    }

    /// The radius at the start.
    #[must_use]
    pub fn radius_from(&self) -> f64 {
        self.radius_from
    }

    /// The radius at the end.
    #[must_use]
    pub fn radius_to(&self) -> f64 {
        self.radius_to
    }

    /// The middle control point of the exact quadratic Bézier form; `None` for a line.
    #[must_use]
    pub fn control(&self) -> Option<Point> {
        let Form::Parabola { d, x: [x1, x2], focus, tangent } = self.form else { return None };
        let height = (x1 * x2 - d * d) / (2.0 * d); // above the focus
        Some(focus + tangent * (0.5 * (x1 + x2)) + tangent.perp() * height)
    }

    /// The middle control point of the exact form in space, with the radius as height: a rational quadratic
    /// Bézier curve whose ends have weight 1. The point, the radius and the weight; `None` between two edges,
    /// where the curve is a line in space too.
    ///
    /// On a parabola the weight is 1; between two corners the curve in space is a hyperbola.
    ///
    /// ```
    /// use medial::axis::{Curve, Site};
    /// use medial::geom::Point;
    /// let corners = [-3.0, 3.0].map(|y| Site::vertex(Point::new(0.0, y)));
    /// let ends = [-4.0, 4.0].map(|x| (Point::new(x, 0.0), 5.0));
    /// let curve = Curve::new(&corners[1], &corners[0], ends[0], ends[1]);
    /// let (point, radius, weight) = curve.control_in_space().unwrap();
    /// assert_eq!(point, Point::new(0.0, 0.0));
    /// // Both tangents meet at radius 9/5, and the middle of the curve has radius 3.
    /// assert!((radius - 1.8).abs() < 1e-15 && ((5.0 + weight * radius) / (1.0 + weight) - 3.0).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn control_in_space(&self) -> Option<(Point, f64, f64)> {
        match self.form {
            Form::Linear => None,
            Form::Parabola { d, x: [x1, x2], .. } => {
                self.control().map(|control| (control, (x1 * x2 + d * d) / (2.0 * d), 1.0))
            }
            Form::Corners { half, s } => {
                // With s = half sinh t the weight is cosh of half the difference of t.
                let sinh = Spread::new(half, s).sinh;
                let square = 0.5 * (1.0 + hypot(1.0, sinh));
                let at = 0.5 * (s[0] + s[1]) / square;
                let u = ((at - s[0]) / (s[1] - s[0])).clamp(0.0, 1.0);
                let u = if u.is_nan() { 0.5 } else { u };
                let radius = 0.5 * (self.radius_from + self.radius_to) / square;
                Some((self.point_at(u), radius, square.sqrt()))
            }
        }
    }

    /// The point at parameter `u`, 0 at the start and 1 at the end.
    #[must_use]
    pub fn point_at(&self, u: f64) -> Point {
        if u <= 0.0 {
            return self.from;
        }
        if u >= 1.0 {
            return self.to;
        }
        let p = self.from * (1.0 - u) + self.to * u;
        let Form::Parabola { d, x: [x1, x2], tangent, .. } = self.form else { return p };
        // Below the chord by u (1-u) (x2-x1)² / (2d): small terms stay small.
        let span = x2 - x1;
        p - tangent.perp() * (u * (1.0 - u) * span * span / (2.0 * d))
    }

    /// The radius at parameter `u`, 0 at the start and 1 at the end.
    #[must_use]
    pub fn radius_at(&self, u: f64) -> f64 {
        if u <= 0.0 {
            return self.radius_from;
        }
        if u >= 1.0 {
            return self.radius_to;
        }
        let between = |[a, b]: [f64; 2]| a * (1.0 - u) + b * u;
        match self.form {
            Form::Linear => between([self.radius_from, self.radius_to]),
            Form::Corners { half, s } => hypot(half, between(s)),
            Form::Parabola { d, x, .. } => {
                let x = between(x);
                (x * x + d * d) / (2.0 * d)
            }
        }
    }

    /// The coefficients of point and radius as polynomials in the parameter, from the constant ones on; `None`
    /// between two corners.
    pub(crate) fn polynomial(&self) -> Option<[(Point, f64); 3]> {
        let chord = self.to - self.from;
        match self.form {
            Form::Linear => {
                let slope = self.radius_to - self.radius_from;
                Some([(self.from, self.radius_from), (chord, slope), (Point::default(), 0.0)])
            }
            Form::Parabola { d, x: [x1, x2], tangent, .. } => {
                let span = x2 - x1;
                let sag = span * span / (2.0 * d);
                let bend = tangent.perp() * sag;
                let radius = (x1 * x1 + d * d) / (2.0 * d);
                Some([(self.from, radius), (chord - bend, x1 * span / d), (bend, sag)])
            }
            Form::Corners { .. } => None,
        }
    }

    /// The parameter strictly inside the curve where the radius is least: the apex of a parabola
    /// or the midpoint between two corners. `None` if the radius is monotone.
    #[must_use]
    pub fn neck(&self) -> Option<f64> {
        let [a, b] = match self.form {
            Form::Linear => return None,
            Form::Corners { s, .. } => s,
            Form::Parabola { x, .. } => x,
        };
        (a < 0.0 && 0.0 < b || b < 0.0 && 0.0 < a).then(|| a / (a - b))
    }

    /// The least radius along the curve.
    #[must_use]
    pub fn radius_min(&self) -> f64 {
        let ends = self.radius_from.min(self.radius_to);
        match (self.form, self.neck()) {
            (Form::Corners { half, .. }, Some(_)) => half.min(ends),
            (Form::Parabola { d, .. }, Some(_)) => (0.5 * d).min(ends),
            _ => ends,
        }
    }

    /// The greatest radius along the curve: always that of an end.
    #[must_use]
    pub fn radius_max(&self) -> f64 {
        self.radius_from.max(self.radius_to)
    }

    /// The parameters strictly inside the curve where the radius passes through `radius`, in
    /// ascending order: at most two. A plateau passes through nothing.
    #[must_use]
    pub fn parameters_at_radius(&self, radius: f64) -> [Option<f64>; 2] {
        let inside = |u: f64| (0.0 < u && u < 1.0).then_some(u);
        let ([a, b], root) = match self.form {
            Form::Linear => {
                let u = (radius - self.radius_from) / (self.radius_to - self.radius_from);
                return [inside(u), None];
            }
            Form::Corners { half, s } => (s, ((radius - half) * (radius + half)).sqrt()),
            Form::Parabola { d, x, .. } => (x, (d * (2.0 * radius - d)).sqrt()),
        };
        // A root of a negative number is NaN and lies nowhere inside.
        let u = |x: f64| (x - a) / (b - a);
        match [inside(u(-root).min(u(root))), inside(u(-root).max(u(root)))] {
            [None, second] => [second, None],
            both => both,
        }
    }

    /// The length of the curve.
    #[inline]
    #[must_use]
    pub fn length(&self) -> f64 {
        let Form::Parabola { d, x, .. } = self.form else {
            return (self.to - self.from).norm();
        };
        Spread::new(d, x).length_of_parabola(d)
    }

    /// The parameter of the point so far along the curve from its start, in units of the input.
    ///
    /// ```
    /// use medial::axis::{Curve, Site};
    /// use medial::geom::Point;
    /// let edge = Site::edge(Point::new(-9.0, 0.0), Point::new(9.0, 0.0));
    /// let corner = Site::vertex(Point::new(0.0, 2.0));
    /// let ends = [-2.0, 2.0].map(|x| (Point::new(x, 2.0), 2.0));
    /// let curve = Curve::new(&corner, &edge, ends[0], ends[1]);
    /// assert!((curve.parameter_at_length(0.5 * curve.length()) - 0.5).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn parameter_at_length(&self, length: f64) -> f64 {
        let whole = self.length();
        if length <= 0.0 || whole == 0.0 {
            return 0.0;
        }
        if length >= whole {
            return 1.0;
        }
        match self.form {
            Form::Linear | Form::Corners { .. } => length / whole,
            Form::Parabola { .. } => crossing(|u| self.piece(0.0, u).length() - length)[1],
        }
    }

    /// The mean radius along the length of the curve; between two radii that differ only by rounding it is
    /// their mean.
    ///
    /// ```
    /// use medial::axis::{Curve, Site};
    /// use medial::geom::Point;
    /// let walls = [Site::edge(Point::new(0.0, 0.0), Point::new(9.0, 0.0)), Site::edge(Point::new(9.0, 9.0), Point::new(0.0, 0.0))];
    /// let curve = Curve::new(&walls[1], &walls[0], (Point::new(0.0, 0.0), 0.0), (Point::new(5.0, 2.0), 2.0));
    /// assert_eq!(curve.radius_mean(), 1.0);
    /// ```
    #[must_use]
    pub fn radius_mean(&self) -> f64 {
        self.length_and_mean().1
    }

    /// The length and the mean radius.
    pub(crate) fn length_and_mean(&self) -> (f64, f64) {
        // With x = d sinh t the radius is d cosh t between corners, (d/2) cosh² t on a parabola, and sums
        // along x or along the curve are those of powers of cosh t.
        let (d, x) = match self.form {
            Form::Linear => return (self.length(), 0.5 * (self.radius_from + self.radius_to)),
            Form::Corners { half, s } => (half, s),
            Form::Parabola { d, x, .. } => (d, x),
        };
        let spread = Spread::new(d, x);
        let Spread { span, sinh, difference, .. } = spread;
        let length = match self.form {
            Form::Parabola { .. } => spread.length_of_parabola(d),
            _ => self.length(),
        };
        if difference == 0.0 {
            return (length, 0.5 * (self.radius_from + self.radius_to));
        }
        // cosh(t1 + t2), and twice the integral of cosh² t.
        let cosh = (spread.w[0] * spread.w[1] + x[0] * x[1]) / (d * d);
        let squares = difference + cosh * sinh;
        let mean = match self.form {
            Form::Parabola { .. } => {
                // Four times that of cosh⁴ t is 3/2 t + sinh 2t + sinh 4t / 8.
                let double = 2.0 * cosh * sinh;
                let quadruple = 4.0 * (2.0 * cosh * cosh - 1.0) * sinh * (1.0 + sinh * sinh).sqrt();
                let fourths = 1.5 * difference + double + 0.125 * quadruple;
                0.25 * d * fourths / squares
            }
            _ => 0.5 * d * squares / (span / d),
        };
        (length, mean.clamp(self.radius_min(), self.radius_max()))
    }

    /// The area between the curve and the boundary on both sides: all lines from its points to their
    /// footpoints.
    ///
    /// ```
    /// use medial::axis::{Curve, Site};
    /// use medial::geom::Point;
    /// // The focus (0, 2) over the edge y = 0: 16/3 below, half of that above.
    /// let edge = Site::edge(Point::new(-9.0, 0.0), Point::new(9.0, 0.0));
    /// let corner = Site::vertex(Point::new(0.0, 2.0));
    /// let curve = Curve::new(&corner, &edge, (Point::new(-2.0, 2.0), 2.0), (Point::new(2.0, 2.0), 2.0));
    /// assert!((curve.strip_area() - 8.0).abs() < 1e-14);
    /// ```
    #[must_use]
    pub fn strip_area(&self) -> f64 {
        let (r1, r2) = (self.radius_from, self.radius_to);
        match self.form {
            // Two trapezoids.
            Form::Linear => {
                let (chord, rise) = ((self.to - self.from).norm(), r2 - r1);
                ((chord - rise) * (chord + rise)).max(0.0).sqrt() * (r1 + r2)
            }
            // Two triangles.
            Form::Corners { half, s: [a, b] } => half * (b - a).abs(),
            // What lies below a parabola, and half as much on the side of the corner.
            Form::Parabola { x: [a, b], .. } => {
                (b - a).abs() * (r1 + r2 + 4.0 * self.radius_at(0.5)) / 4.0
            }
        }
    }

    /// How fast the radius grows along the curve, as a share of the length: 1 is as fast as it can.
    ///
    /// It is the cosine of half the angle of the disk's arc that lies behind, between both footpoints.
    #[must_use]
    pub fn growth_at(&self, u: f64) -> f64 {
        let u = u.clamp(0.0, 1.0);
        let slope = |[a, b]: [f64; 2], scale: f64| {
            let x = a * (1.0 - u) + b * u;
            if a <= b { x / hypot(x, scale) } else { -x / hypot(x, scale) }
        };
        match self.form {
            Form::Linear => {
                let length = (self.to - self.from).norm();
                if length == 0.0 { 0.0 } else { (self.radius_to - self.radius_from) / length }
            }
            Form::Corners { half, s } => slope(s, half),
            Form::Parabola { d, x, .. } => slope(x, d),
        }
    }

    /// Whether the radius grows there.
    #[inline]
    pub(crate) fn grows_at(&self, u: f64) -> bool {
        match self.form {
            Form::Linear => self.growth_at(u) > 0.0,
            Form::Corners { s: [a, b], .. } | Form::Parabola { x: [a, b], .. } => {
                let x = a * (1.0 - u) + b * u;
                if a <= b { x > 0.0 } else { x < 0.0 }
            }
        }
    }

    /// The same curve from its end to its start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let form = match self.form {
            Form::Linear => Form::Linear,
            Form::Corners { half, s: [a, b] } => Form::Corners { half, s: [b, a] },
            Form::Parabola { d, x: [a, b], focus, tangent } => {
                Form::Parabola { d, x: [b, a], focus, tangent }
            }
        };
        let Self { from, to, radius_from, radius_to, .. } = *self;
        Self { from: to, to: from, radius_from: radius_to, radius_to: radius_from, form }
    }

    /// The same curve with ends that are its own but for rounding.
    pub(crate) fn with_ends(self, from: (Point, f64), to: (Point, f64)) -> Self {
        Self { from: from.0, to: to.0, radius_from: from.1, radius_to: to.1, form: self.form }
    }

    /// The distance of `p` from the nearest point of the curve, rounded.
    ///
    /// ```
    /// use medial::axis::{Curve, Site};
    /// use medial::geom::Point;
    /// let walls = [(4.0, 0.0), (0.0, 2.0)].map(|(x, y)| {
    ///     Site::edge(Point::new(4.0 - x, y), Point::new(x, y))
    /// });
    /// let (from, to) = ((Point::new(1.0, 1.0), 1.0), (Point::new(3.0, 1.0), 1.0));
    /// let spine = Curve::new(&walls[1], &walls[0], from, to);
    /// assert_eq!(spine.distance(Point::new(2.0, 1.5)), 0.5);
    /// assert_eq!(spine.distance(Point::new(6.0, 5.0)), 5.0);
    /// ```
    #[must_use]
    pub fn distance(&self, p: Point) -> f64 {
        (p - self.point_at(self.nearest_parameter(p))).norm()
    }

    /// The parameter of the point of the curve that is nearest to `p`, rounded; of several the first.
    ///
    /// ```
    /// use medial::axis::{Curve, Site};
    /// use medial::geom::Point;
    /// // The apex of the parabola lies under its focus.
    /// let edge = Site::edge(Point::new(-9.0, 0.0), Point::new(9.0, 0.0));
    /// let corner = Site::vertex(Point::new(0.0, 2.0));
    /// let ends = [-2.0, 2.0].map(|x| (Point::new(x, 2.0), 2.0));
    /// let curve = Curve::new(&corner, &edge, ends[0], ends[1]);
    /// assert_eq!(curve.nearest_parameter(Point::new(0.0, -5.0)), 0.5);
    /// assert_eq!(curve.nearest_parameter(Point::new(9.0, 3.0)), 1.0);
    /// ```
    #[must_use]
    pub fn nearest_parameter(&self, p: Point) -> f64 {
        let feet = match self.form {
            Form::Linear | Form::Corners { .. } => {
                let d = self.to - self.from;
                [d.dot(p - self.from) / d.norm2(); 3]
            }
            Form::Parabola { d, x: [x1, x2], focus, tangent } => {
                // Where the curve is square to the way to p = (u, v) over the foot of the focus:
                // x³ + d(3d - 2v)x - 2ud² = 0, in units in which the curve is of size 1.
                let size = x1.abs().max(x2.abs()).max(d);
                let (d, a, b) = (d / size, x1 / size, x2 / size);
                let q = (p - focus) * (1.0 / size);
                let (u, v) = (tangent.dot(q), tangent.perp().dot(q) + d);
                cubic_roots(d * (3.0 * d - 2.0 * v), -2.0 * u * d * d).map(|x| (x - a) / (b - a))
            }
        };
        let away = |u: f64| (p - self.point_at(u)).norm();
        let mut nearest = (0.0, away(0.0));
        for u in feet.into_iter().filter(|&u| 0.0 < u && u < 1.0).chain([1.0]) {
            let distance = away(u);
            if distance < nearest.1 {
                nearest = (u, distance);
            }
        }
        nearest.0
    }

    /// The part between parameters `u` and `v`, as a curve of its own.
    #[must_use]
    pub fn piece(&self, u: f64, v: f64) -> Self {
        let between = |[a, b]: [f64; 2]| {
            let at = |u: f64| {
                if u <= 0.0 {
                    a
                } else if u >= 1.0 {
                    b
                } else {
                    a * (1.0 - u) + b * u
                }
            };
            [at(u), at(v)]
        };
        let form = match self.form {
            Form::Linear => Form::Linear,
            Form::Corners { half, s } => Form::Corners { half, s: between(s) },
            Form::Parabola { d, x, focus, tangent } => {
                Form::Parabola { d, x: between(x), focus, tangent }
            }
        };
        Self {
            from: self.point_at(u),
            to: self.point_at(v),
            radius_from: self.radius_at(u),
            radius_to: self.radius_at(v),
            form,
        }
    }

    /// The curve as a polyline no farther than `tolerance` from it: its points with their radii,
    /// both ends included. A line is its two ends; no curve has more than 65536 pieces.
    #[must_use]
    pub fn polyline(&self, tolerance: f64) -> Vec<(Point, f64)> {
        let pieces = match self.form {
            Form::Linear | Form::Corners { .. } => 1.0,
            Form::Parabola { d, x, .. } => (x[1] - x[0]).abs() / (8.0 * d * tolerance).sqrt(),
        };
        self.sampled(pieces)
    }

    /// The curve in space, with the radius as height, as a polyline no farther than `tolerance`
    /// from it. Between two corners it is a hyperbola and needs inner points too.
    #[must_use]
    pub fn polyline_in_space(&self, tolerance: f64) -> Vec<(Point, f64)> {
        let pieces = match self.form {
            Form::Linear => 1.0,
            Form::Corners { half, s: [a, b] } => {
                // r'' = half²/r³, greatest where the radius is least.
                let r = self.radius_min();
                (b - a).abs() * half / r / (8.0 * r * tolerance).sqrt()
            }
            Form::Parabola { d, x, .. } => {
                // The height bends as much as the plane curve: √2 as far from the chord.
                let tolerance = tolerance * std::f64::consts::FRAC_1_SQRT_2;
                (x[1] - x[0]).abs() / (8.0 * d * tolerance).sqrt()
            }
        };
        self.sampled(pieces)
    }

    fn sampled(&self, pieces: f64) -> Vec<(Point, f64)> {
        let pieces = if pieces.is_nan() { 1.0 } else { pieces.ceil().clamp(1.0, MAX_PIECES) };
        let n = pieces as u32;
        (0..=n)
            .map(|k| f64::from(k) / pieces)
            .map(|u| (self.point_at(u), self.radius_at(u)))
            .collect()
    }
}

impl MedialAxis {
    /// The curve of a path of this axis.
    ///
    /// # Panics
    /// If `path` names a keypoint or a site the axis does not have.
    #[inline]
    #[must_use]
    pub fn curve(&self, path: &Path) -> Curve {
        let sites = [self.site_shape(path.left), self.site_shape(path.right)];
        self.curve_between(&sites, [self.disk(path.from), self.disk(path.to)])
    }

    /// The maximal disk at a keypoint.
    #[inline(always)]
    pub(crate) fn disk(&self, keypoint: u32) -> (Point, f64) {
        let Keypoint { position, radius, .. } = self.keypoints().at(keypoint);
        (position, radius)
    }

    /// The curve of a path with these sites and disks at its ends: straight between samples.
    #[inline]
    pub(crate) fn curve_between(
        &self,
        [left, right]: &[SiteShape; 2],
        [from, to]: [(Point, f64); 2],
    ) -> Curve {
        match self.accuracy {
            Accuracy::Exact => Curve::between(left, right, from, to),
            Accuracy::Sampled(_) => Curve {
                from: from.0,
                to: to.0,
                radius_from: from.1,
                radius_to: to.1,
                form: Form::Linear,
            },
        }
    }
}

/// How far both ends of a curve are apart in the parameter `t` of `x = d sinh t`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread {
    /// `x2 - x1`.
    span: f64,
    /// `d cosh t` at both ends, and the difference of the two.
    w: [f64; 2],
    rise: f64,
    /// `t2 - t1`, and its hyperbolic sine.
    difference: f64,
    sinh: f64,
    x1: f64,
}

impl Spread {
    #[inline]
    pub fn new(d: f64, [x1, x2]: [f64; 2]) -> Self {
        let w = [hypot(x1, d), hypot(x2, d)];
        let span = x2 - x1;
        let rise = span * (x1 + x2) / (w[0] + w[1]); // w2 - w1 without cancellation
        let sinh = (span * w[0] - x1 * rise) / (d * d);
        Self { span, w, rise, difference: asinh(sinh), sinh, x1 }
    }

    /// The length of the parabola whose focus is `d` from its line.
    #[inline]
    pub fn length_of_parabola(&self, d: f64) -> f64 {
        let chordal = (self.span * self.w[1] + self.x1 * self.rise) / (2.0 * d);
        (chordal + 0.5 * d * self.difference).abs()
    }
}

fn corners(p: Point, q: Point, from: Point, to: Point) -> Form {
    let w = q - p;
    let distance = w.norm();
    if distance == 0.0 {
        return Form::Linear;
    }
    let along = w.perp() * (1.0 / distance);
    let middle = p + w * 0.5;
    Form::Corners { half: 0.5 * distance, s: [along.dot(from - middle), along.dot(to - middle)] }
}

fn parabola(focus: Point, edge: &SiteShape, from: (Point, f64), to: (Point, f64)) -> Form {
    let Some(frame) = Frame::new(focus, edge) else { return Form::Linear };
    let x = [frame.position(from), frame.position(to)];
    Form::Parabola { d: frame.d, x, focus, tangent: frame.tangent }
}

/// Where positions along a parabola are measured: from its focus along its edge.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub d: f64,
    focus: Point,
    tangent: Point,
}

impl Frame {
    /// That of a corner and an edge; none if the corner lies on the line of the edge.
    #[inline]
    pub fn new(focus: Point, edge: &SiteShape) -> Option<Self> {
        // On the exterior the focus lies to the right of the edge.
        let across = accurate_cross(edge.a, edge.b, focus);
        let direction = if across < 0.0 { edge.a - edge.b } else { edge.b - edge.a };
        let length = direction.norm();
        let d = across.abs() / length;
        if d.is_nan() || d == 0.0 {
            return None;
        }
        Some(Self { d, focus, tangent: direction * (1.0 / length) })
    }

    #[inline]
    pub fn position(&self, (centre, radius): (Point, f64)) -> f64 {
        let x = self.tangent.dot(centre - self.focus);
        // Far from the apex the radius gives the better value: x² = d (2r - d).
        let square = self.d * (2.0 * radius - self.d);
        if radius > self.d { square.sqrt().copysign(x) } else { x }
    }
}

/// `(b - a) × (p - a)` with a small relative error, however near `p` lies to the line.
fn accurate_cross(a: Point, b: Point, p: Point) -> f64 {
    let (bx, by) = (difference(b.x, a.x), difference(b.y, a.y));
    let (px, py) = (difference(p.x, a.x), difference(p.y, a.y));
    let (s, s_error) = product(bx.0, py.0);
    let (t, t_error) = product(by.0, px.0);
    let (high, high_error) = difference(s, t);
    let low = (s_error - t_error) + (bx.0 * py.1 + bx.1 * py.0) - (by.0 * px.1 + by.1 * px.0);
    high + (high_error + low)
}

/// `a - b` and its rounding error.
fn difference(a: f64, b: f64) -> (f64, f64) {
    let x = a - b;
    let b_virtual = a - x;
    let a_virtual = x + b_virtual;
    (x, (a - a_virtual) + (b_virtual - b))
}

/// `a · b` and its rounding error.
fn product(a: f64, b: f64) -> (f64, f64) {
    let x = a * b;
    (x, a.mul_add(b, -x))
}

#[cfg(test)]
#[path = "curve_tests.rs"]
mod tests;
