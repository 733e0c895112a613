//! Shapes with equal teeth parallel to the axes.

use super::{Ring, SIZE};

/// Equal teeth on a bar.
pub fn comb(edges: usize) -> Ring {
    let teeth = (edges / 4).max(1);
    let unit = (SIZE / teeth as f64).floor();
    let left = -(teeth as f64) * unit;
    let (foot, tip) = (unit, 40.0 * unit.min(1e7));
    let mut ring = vec![(left, 0.0), (left + (2 * teeth - 1) as f64 * unit, 0.0)];
    for tooth in (0..teeth).rev() {
        let x = left + 2.0 * tooth as f64 * unit;
        ring.extend([(x + unit, tip), (x, tip)]);
        if tooth > 0 {
            ring.extend([(x, foot), (x - unit, foot)]);
        }
    }
    ring
}

/// A wedge whose slanted side is a staircase of equal steps.
pub fn stair(edges: usize) -> Ring {
    let steps = edges / 2 - 1;
    let unit = (2.0 * SIZE / (steps + 1) as f64).floor();
    let low = -SIZE.floor();
    let at = |k: usize| low + k as f64 * unit;
    let mut ring = vec![(low, low), (at(steps + 1), low)];
    for k in 1..=steps {
        ring.extend([(at(steps + 2 - k), at(k)), (at(steps + 1 - k), at(k))]);
    }
    ring.extend([(at(1), at(steps + 1)), (low, at(steps + 1))]);
    ring
}
