//! Moves of a tool's tip, exact: lines, quadratics, conics and arcs.

use crate::axis::Curve;
use crate::geom::Point;
use crate::ops::{Sense, Stroke};

/// A place of the tip of a tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip {
    /// Seen from above.
    pub point: Point,
    /// Height over the surface of the material: 0, or negative below.
    pub z: f64,
}

/// A move of the tip that cuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Move {
    /// Straight.
    Line {
        /// Where it starts.
        from: Tip,
        /// Where it ends.
        to: Tip,
    },
    /// Along a quadratic Bézier curve in space: over a parabola of the axis.
    Quadratic {
        /// Where it starts.
        from: Tip,
        /// The middle control point.
        control: Tip,
        /// Where it ends.
        to: Tip,
    },
    /// Along a rational quadratic Bézier curve in space, whose ends have weight 1: a hyperbola, straight as
    /// seen from above, between two corners.
    Conic {
        /// Where it starts.
        from: Tip,
        /// The middle control point.
        control: Tip,
        /// Its weight, at least 1.
        weight: f64,
        /// Where it ends.
        to: Tip,
    },
    /// Along an arc of a circle at one height.
    Arc {
        /// Where it starts.
        from: Tip,
        /// Where it ends.
        to: Tip,
        /// Centre of the circle.
        centre: Point,
        /// Radius of the circle.
        radius: f64,
        /// Which way it runs.
        sense: Sense,
        /// The angle that it runs through, in radians, not negative.
        angle: f64,
    },
}

/// Most halvings of a conic that is drawn.
const MOST_HALVINGS: u32 = 16;

/// Most pieces that a move is drawn with; only for drawing.
const MAX_PIECES: f64 = 65_536.0;

/// Roundings of the coordinates below which a conic is not drawn any finer: points would fall together.
const ROUNDINGS: f64 = 8.0;

impl Move {
    /// What a bit does along a curve of the axis, so much deeper than the boundary is away; `depth` gives the
    /// depth at a radius.
    pub(super) fn along(curve: &Curve, depth: impl Fn(f64) -> f64) -> Self {
        // Without the sign of a zero.
        let tip = |point, radius: f64| Tip { point, z: 0.0 - depth(radius) };
        let from = tip(curve.from(), curve.radius_from());
        let to = tip(curve.to(), curve.radius_to());
        match curve.control_in_space() {
            None => Self::Line { from, to },
            Some((point, radius, weight)) => {
                let control = tip(point, radius);
                if weight == 1.0 {
                    Self::Quadratic { from, control, to }
                } else {
                    Self::Conic { from, control, weight, to }
                }
            }
        }
    }

    /// A stroke of a contour, followed at some height.
    pub(super) fn level(stroke: &Stroke, z: f64) -> Self {
        let tip = |point| Tip { point, z };
        match *stroke {
            Stroke::Line { from, to } => Self::Line { from: tip(from), to: tip(to) },
            Stroke::Arc { from, to, centre, radius, sense, angle } => {
                Self::Arc { from: tip(from), to: tip(to), centre, radius, sense, angle }
            }
        }
    }

    /// Where it starts.
    #[must_use]
    pub const fn from(&self) -> Tip {
        let (Self::Line { from, .. }
        | Self::Quadratic { from, .. }
        | Self::Conic { from, .. }
        | Self::Arc { from, .. }) = *self;
        from
    }

    /// Where it ends.
    #[must_use]
    pub const fn to(&self) -> Tip {
        let (Self::Line { to, .. }
        | Self::Quadratic { to, .. }
        | Self::Conic { to, .. }
        | Self::Arc { to, .. }) = *self;
        to
    }

    /// `line`, `quadratic`, `conic` or `arc`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Line { .. } => "line",
            Self::Quadratic { .. } => "quadratic",
            Self::Conic { .. } => "conic",
            Self::Arc { .. } => "arc",
        }
    }

    /// The same move from its end to its start.
    #[must_use]
    pub const fn reversed(&self) -> Self {
        match *self {
            Self::Line { from, to } => Self::Line { from: to, to: from },
            Self::Quadratic { from, control, to } => {
                Self::Quadratic { from: to, control, to: from }
            }
            Self::Conic { from, control, weight, to } => {
                Self::Conic { from: to, control, weight, to: from }
            }
            Self::Arc { from, to, centre, radius, sense, angle } => {
                let sense = match sense {
                    Sense::Counterclockwise => Sense::Clockwise,
                    Sense::Clockwise => Sense::Counterclockwise,
                };
                Self::Arc { from: to, to: from, centre, radius, sense, angle }
            }
        }
    }

    /// The place at a parameter from 0 at the start to 1 at the end.
    #[must_use]
    pub fn at(&self, t: f64) -> Tip {
        if t <= 0.0 {
            return self.from();
        }
        if t >= 1.0 {
            return self.to();
        }
        match *self {
            Self::Line { from, to } => mixed(&[(from, 1.0 - t), (to, t)]),
            Self::Quadratic { from, control, to } => rational(from, control, 1.0, to, t),
            Self::Conic { from, control, weight, to } => rational(from, control, weight, to, t),
            Self::Arc { from, centre, sense, angle, .. } => {
                let (sin, cos) = (t * angle).sin_cos();
                let start = from.point - centre;
                let across = match sense {
                    Sense::Counterclockwise => start.perp(),
                    Sense::Clockwise => start.perp() * -1.0,
                };
                Tip { point: centre + start * cos + across * sin, z: from.z }
            }
        }
    }

    /// How fast the place moves with the parameter: as seen from above, and in height.
    fn velocity(&self, t: f64) -> (Point, f64) {
        match *self {
            Self::Line { from, to } => (to.point - from.point, to.z - from.z),
            Self::Quadratic { from, control, to } => derivative(from, control, 1.0, to, t),
            Self::Conic { from, control, weight, to } => derivative(from, control, weight, to, t),
            Self::Arc { radius, angle, .. } => (Point::new(radius * angle, 0.0), 0.0),
        }
    }

    /// The length in space.
    #[must_use]
    pub fn length(&self) -> f64 {
        match *self {
            Self::Arc { radius, angle, .. } => radius * angle,
            Self::Line { from, to } => distance(from, to),
            _ => integral(|t| {
                let (along, rise) = self.velocity(t);
                (along.norm2() + rise * rise).sqrt()
            }),
        }
    }

    /// The move as a polyline in space no farther than a tolerance from it, both ends included.
    #[must_use]
    pub fn polyline(&self, tolerance: f64) -> Vec<Tip> {
        let pieces = match *self {
            Self::Line { .. } => 1.0,
            Self::Quadratic { from, control, to } => {
                let bend = mixed(&[(from, 0.25), (control, -0.5), (to, 0.25)]);
                ((bend.point.norm2() + bend.z * bend.z).sqrt() / tolerance).sqrt()
            }
            Self::Conic { .. } => {
                let mut tips = vec![self.from()];
                let size = [self.from(), self.to()]
                    .map(|tip| tip.point.x.abs().max(tip.point.y.abs()).max(tip.z.abs()));
                let rounding = ROUNDINGS * f64::EPSILON * size[0].max(size[1]);
                self.halve(tolerance.max(rounding), MOST_HALVINGS, &mut tips);
                return tips;
            }
            Self::Arc { radius, angle, .. } => {
                // Half the angle of a chord whose sagitta is the tolerance.
                angle / (2.0 * (1.0 - tolerance / radius).clamp(-1.0, 1.0).acos())
            }
        };
        let pieces = if pieces.is_nan() { 1.0 } else { pieces.ceil().clamp(1.0, MAX_PIECES) };
        (0..=pieces as u32).map(|k| self.at(f64::from(k) / pieces)).collect()
    }

    /// Appends the points of a polyline after the start of a conic.
    fn halve(&self, tolerance: f64, left: u32, tips: &mut Vec<Tip>) {
        let Self::Conic { from, control, weight, to } = *self else { return };
        let bend = mixed(&[(from, -0.5), (control, 1.0), (to, -0.5)]);
        let sagitta = (bend.point.norm2() + bend.z * bend.z).sqrt() * weight / (1.0 + weight);
        if left == 0 || sagitta <= tolerance {
            tips.push(to);
            return;
        }
        let share = 1.0 / (1.0 + weight);
        let middle = self.at(0.5);
        let half = (0.5 * (1.0 + weight)).sqrt();
        let [first, second] =
            [from, to].map(|end| mixed(&[(end, share), (control, weight * share)]));
        let halves = [(from, first, middle), (middle, second, to)];
        for (from, control, to) in halves {
            Self::Conic { from, control, weight: half, to }.halve(tolerance, left - 1, tips);
        }
    }

    /// What a bit cuts away on both sides of its way, for a depth as large as the radius; and half of the
    /// angle ahead at its start, and behind at its end, between the points where it touches its rim there.
    ///
    /// At `s` along the way, seen from above, the bit touches the surface on a circle of radius `r`, and its
    /// rim in two points, at an angle `φ` from the way ahead, where `cos φ = -r'`. The lines from the tip to
    /// those sweep over the surface; over each the depth falls evenly to nothing. Both sides together:
    /// `∫ (sin φ r² - φ' r³/3) ds`.
    pub(super) fn swept(&self, slope: f64) -> (f64, [f64; 2]) {
        let radius = |tip: Tip| -tip.z / slope;
        let [from, to] = [self.from(), self.to()];
        if from == to {
            return (0.0, [0.0; 2]);
        }
        // How fast the radius grows: minus the cosine of the angle.
        let growth = |t: f64| {
            let (along, rise) = self.velocity(t);
            (-rise / slope / along.norm()).clamp(-1.0, 1.0)
        };
        let phi = |t: f64| (-growth(t)).acos();
        let swept = integral(|t| {
            let growth = growth(t);
            let sin = ((1.0 - growth) * (1.0 + growth)).sqrt();
            let r = radius(self.at(t));
            (sin + (-growth).acos() * growth) * r * r * self.velocity(t).0.norm()
        });
        let [start, end] = [phi(0.0), phi(1.0)];
        let third = |tip: Tip| radius(tip).powi(3) / 3.0;
        let volume = swept - (end * third(to) - start * third(from));
        (volume, [start, std::f64::consts::PI - end])
    }
}

fn mixed(tips: &[(Tip, f64)]) -> Tip {
    let zero = Tip { point: Point::new(0.0, 0.0), z: 0.0 };
    tips.iter().fold(zero, |sum, &(tip, share)| Tip {
        point: sum.point + tip.point * share,
        z: sum.z + tip.z * share,
    })
}

fn distance(a: Tip, b: Tip) -> f64 {
    ((b.point - a.point).norm2() + (b.z - a.z) * (b.z - a.z)).sqrt()
}

fn rational(from: Tip, control: Tip, weight: f64, to: Tip, t: f64) -> Tip {
    let shares = [(1.0 - t) * (1.0 - t), 2.0 * weight * t * (1.0 - t), t * t];
    let whole = 1.0 / (shares[0] + shares[1] + shares[2]);
    mixed(&[(from, shares[0] * whole), (control, shares[1] * whole), (to, shares[2] * whole)])
}

fn derivative(from: Tip, control: Tip, weight: f64, to: Tip, t: f64) -> (Point, f64) {
    let s = 1.0 - t;
    let weights = [s * s, 2.0 * weight * s * t, t * t];
    let slopes = [-2.0 * s, 2.0 * weight * (s - t), 2.0 * t];
    let (whole, slope) = (weights.iter().sum::<f64>(), slopes.iter().sum::<f64>());
    // The quotient rule; the shares of the three points add up to nothing.
    let share = |k: usize| (slopes[k] * whole - weights[k] * slope) / (whole * whole);
    let (first, last) = (share(0), share(2));
    let point = (from.point - control.point) * first + (to.point - control.point) * last;
    (point, (from.z - control.z) * first + (to.z - control.z) * last)
}

/// Abscissas and weights of Gauss and Legendre's rule with eight points, on one half of [-1, 1].
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// The integral of a smooth function from 0 to 1, halved until it is as good as doubles are.
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    /// Share of the whole by which the halves of a part may differ from it.
    const ENOUGH: f64 = 1e-15;
    /// Most parts.
    const MOST: u32 = 4096;
    let gauss = |a: f64, b: f64| {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let pair = |&(x, w): &(f64, f64)| w * (f(middle - half * x) + f(middle + half * x));
        half * GAUSS.iter().map(pair).sum::<f64>()
    };
    let whole = gauss(0.0, 1.0);
    let (mut sum, mut size, mut parts) = (0.0, whole.abs(), 1);
    let mut open = vec![(0.0, 1.0, whole)];
    while let Some((a, b, whole)) = open.pop() {
        let middle = 0.5 * (a + b);
        let halves = [gauss(a, middle), gauss(middle, b)];
        let both = halves[0] + halves[1];
        size = both.abs().max(size);
        let is_good = (both - whole).abs() <= ENOUGH * size;
        if is_good || both.is_nan() || parts >= MOST || middle <= a || b <= middle {
            sum += both;
        } else {
            parts += 1;
            open.extend([(middle, b, halves[1]), (a, middle, halves[0])]);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Site;

    fn tip(x: f64, y: f64, z: f64) -> Tip {
        Tip { point: Point::new(x, y), z }
    }

    fn curves() -> [Curve; 3] {
        let p = |x: f64, y: f64| Point::new(x, y);
        let edge = Site::edge(p(-9.0, 0.0), p(9.0, 0.0));
        let parabola =
            Curve::new(&Site::vertex(p(0.0, 2.0)), &edge, (p(-2.0, 2.0), 2.0), (p(4.0, 5.0), 5.0));
        let corners = [p(0.0, 3.0), p(0.0, -3.0)].map(Site::vertex);
        let hyperbola = Curve::new(
            &corners[0],
            &corners[1],
            (p(-4.0, 0.0), 5.0),
            (p(40.0, 0.0), 1609.0_f64.sqrt()),
        );
        let other = Site::edge(p(9.0, 9.0), p(0.0, 0.0));
        let line = Curve::new(&other, &edge, (p(0.0, 0.0), 0.0), (p(5.0, 2.0), 2.0));
        [parabola, hyperbola, line]
    }

    #[test]
    fn moves_lie_over_the_curves_as_deep_as_the_radius_says() {
        for curve in curves() {
            let cut = Move::along(&curve, |r| 2.0 * r);
            for k in 0..=64 {
                let tip = cut.at(f64::from(k) / 64.0);
                let u = curve.nearest_parameter(tip.point);
                assert!((curve.point_at(u) - tip.point).norm() < 1e-13, "{cut:?}");
                assert!((2.0 * curve.radius_at(u) + tip.z).abs() < 1e-12, "{cut:?}");
            }
        }
    }

    #[test]
    fn polylines_are_as_near_as_asked_for() {
        for curve in curves() {
            let cut = Move::along(&curve, |r| r);
            for tolerance in [0.3, 1e-2, 1e-5] {
                let points = cut.polyline(tolerance);
                assert!(points.len() < 5000);
                assert_eq!((points[0], *points.last().unwrap()), (cut.from(), cut.to()));
                let away = |tip: Tip| {
                    let to_chord = |pair: &[Tip]| {
                        let (a, b) = (pair[0], pair[1]);
                        let [d, q] =
                            [mixed(&[(b, 1.0), (a, -1.0)]), mixed(&[(tip, 1.0), (a, -1.0)])];
                        let dot = |u: Tip, v: Tip| u.point.dot(v.point) + u.z * v.z;
                        let t = (dot(d, q) / dot(d, d)).clamp(0.0, 1.0);
                        distance(tip, mixed(&[(a, 1.0 - t), (b, t)]))
                    };
                    points.windows(2).map(to_chord).fold(f64::INFINITY, f64::min)
                };
                for k in 0..500 {
                    assert!(away(cut.at(f64::from(k) / 500.0)) <= tolerance * 1.0001);
                }
            }
        }
    }

    #[test]
    fn no_tolerance_makes_endless_polylines() {
        // Far out, where a rounding is larger than the tolerance; and so deep that it is.
        let p = |x: f64, y: f64| Point::new(x, y);
        for (far, slope) in [(1e9, 1.0), (-3e15, 1.0), (0.0, 1e300), (5e5, 1e-300)] {
            let corners = [p(far, far + 3.0), p(far, far - 3.0)].map(Site::vertex);
            let ends = [(p(far - 4.0, far), 5.0), (p(far + 4.0, far), 5.0)];
            let curve = Curve::new(&corners[0], &corners[1], ends[0], ends[1]);
            let cut = Move::along(&curve, |r| slope * r);
            for tolerance in [1e-3, 1e-10, 1e-300] {
                assert!(cut.polyline(tolerance).len() <= 65_537, "{far} {slope} {tolerance}");
            }
            if slope == 1.0 {
                assert!((cut.length() - curve.length()).abs() < 0.3 * curve.length());
                assert!(cut.swept(slope).0 > 0.0);
            }
        }
    }

    #[test]
    fn lengths_are_those_of_fine_polylines() {
        for curve in curves() {
            let cut = Move::along(&curve, |r| 0.7 * r);
            let points = cut.polyline(1e-9);
            let sum: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
            assert!((cut.length() - sum).abs() < 1e-7 * sum);
            assert_eq!(cut.reversed().reversed(), cut);
        }
        let from = tip(1.0, 0.0, -1.0);
        let arc = Move::Arc {
            from,
            to: tip(0.0, 1.0, -1.0),
            centre: Point::new(0.0, 0.0),
            radius: 1.0,
            sense: Sense::Counterclockwise,
            angle: std::f64::consts::FRAC_PI_2,
        };
        assert_eq!(arc.length(), std::f64::consts::FRAC_PI_2);
        assert!((arc.at(0.5).point - Point::new(0.5, 0.5) * 2f64.sqrt()).norm() < 1e-15);
    }

    #[test]
    fn a_groove_of_even_width_has_the_volume_of_a_prism() {
        let groove = Move::Line { from: tip(0.0, 0.0, -2.0), to: tip(3.0, 0.0, -2.0) };
        // As wide as deep to either side.
        let (volume, angles) = groove.swept(1.0);
        assert!((volume - 12.0).abs() < 1e-14);
        assert_eq!(angles, [std::f64::consts::FRAC_PI_2; 2]);
        // Half as wide, and half as deep for its width.
        assert!((groove.swept(2.0).0 - 3.0).abs() < 1e-14);
    }
}
