//! Places where functions turn, as good as doubles are.

/// Where a function that is negative at 0 and not at 1 turns, to the last bit: the first double at which it
/// is not negative, if there is one such place. Only its sign counts.
pub(crate) fn bisected(sign: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if sign(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// The same for a continuous function, whose values save most of the steps: the last place before, where it
/// is negative, and the first one that is not, no more than 2 ulp of 1 apart.
///
/// The ITP method (Oliveira and Takahashi 2020): regula falsi, moved towards the middle by little, and no
/// farther from it than bisection can afford. No more steps than bisection takes, and two.
pub(crate) fn crossing(value: impl Fn(f64) -> f64) -> [f64; 2] {
    const ENOUGH: f64 = 2.0 * f64::EPSILON;
    /// Steps of bisection down to that, and two to spare.
    const MOST: i32 = 53;
    let (mut low, mut high) = ((0.0, value(0.0)), (1.0, value(1.0)));
    // What the width may still be, so that bisection ends in time.
    let mut allowed = ENOUGH * 2.0_f64.powi(MOST);
    let is_finite = low.1.is_finite() && high.1.is_finite();
    if !is_finite || low.1 >= 0.0 || high.1 <= 0.0 {
        let place = if low.1 >= 0.0 {
            0.0
        } else if high.1 <= 0.0 {
            1.0
        } else {
            bisected(value)
        };
        return [place; 2];
    }
    for _ in 0..=MOST {
        let width = high.0 - low.0;
        if width <= ENOUGH {
            break;
        }
        let middle = 0.5 * (low.0 + high.0);
        let falsi = low.0 - low.1 * width / (high.1 - low.1);
        let towards = (middle - falsi).signum();
        let moved = (0.2 * width * width).max(0.5 * ENOUGH).min((middle - falsi).abs());
        let near = falsi + towards * moved;
        let affordable = (allowed - 0.5 * width).max(0.0);
        allowed *= 0.5;
        let u =
            if (near - middle).abs() <= affordable { near } else { middle - towards * affordable };
        let u = if low.0 < u && u < high.0 { u } else { middle };
        let there = value(u);
        if there < 0.0 {
            low = (u, there);
        } else {
            high = (u, there);
            if there == 0.0 {
                return [u; 2];
            }
        }
    }
    [low.0, high.0]
}

/// The real roots of `x³ + px + q`, rounded; one that stands for several comes more than once.
pub(super) fn cubic_roots(p: f64, q: f64) -> [f64; 3] {
    let (third, half) = (p / 3.0, q / 2.0);
    let discriminant = half * half + third * third * third;
    let roots = if discriminant > 0.0 {
        // Cardano's, without cancellation.
        let cube = (half.abs() + discriminant.sqrt()).cbrt().copysign(-half);
        [cube - third / cube; 3]
    } else {
        let radius = (-third).max(0.0).sqrt();
        let angle = (-half / (radius * radius * radius)).clamp(-1.0, 1.0).acos() / 3.0;
        let turn = std::f64::consts::TAU / 3.0;
        [0.0, 1.0, 2.0].map(|k| 2.0 * radius * (angle - k * turn).cos())
    };
    // One step of Newton's takes off what rounding has added.
    roots.map(|x| {
        let better = x - ((x * x + p) * x + q) / (3.0 * x * x + p);
        if better.is_finite() { better } else { x }
    })
}
