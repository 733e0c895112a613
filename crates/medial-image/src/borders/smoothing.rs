//! Borders without the steps of pixels, averaged along themselves.
//!
//! # Contract
//! What is to one side of a border before is so afterwards: no two borders cross, and none crosses itself.
//!
//! # Method
//! A border goes through the middles of the sides of pixels, and through corners that stay. Middles that do not follow
//! one another on a border have half a diagonal between them and all that is between other ones, and half a side beside
//! a corner that stays. Each is moved by less than half of that: then nothing meets that did not.
//!
//! An average reaches over the end of a border: what lies behind a corner that stays is what lies before it, turned by
//! half a turn. So the average of the corner itself is where it is, and a straight border stays straight.

use super::arcs::Arc;
use super::{Corner, steps};

/// How far a middle moves at most, in sides of a pixel.
const MOST: f64 = 0.35;

/// How far one beside a corner that stays does.
const MOST_BESIDE: f64 = 0.17;

/// Where the weights of a Gaussian end, in widths.
const REACH: f64 = 3.0;

/// How far the middles of the sides of pixels are moved, in columns and rows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moves {
    /// Corners of pixels in a row.
    stride: usize,
    /// For the sides to the right of corners, and for those below them.
    sides: [Vec<[f32; 2]>; 2],
}

impl Moves {
    pub fn none(stride: usize, rows: u32) -> Self {
        let none = vec![[0.0; 2]; stride * (rows as usize + 1)];
        Self { stride, sides: [none.clone(), none] }
    }

    /// The middle of a side, given by its ends, where it is moved to.
    pub fn middle(&self, ends: [Corner; 2]) -> [f64; 2] {
        let (side, number) = self.place(ends);
        let way = self.sides[side][number];
        let at = middle(ends);
        [0, 1].map(|axis| at[axis] + f64::from(way[axis]))
    }

    /// Moves the middles of a border to averages of those around them, weighted by a Gaussian of this width in pixels;
    /// distances are counted in steps of their mean length.
    pub fn smooth(&mut self, arc: &Arc, width: f64) {
        let pairs = arc.corners.windows(2);
        let sides: Vec<[Corner; 2]> = pairs.flat_map(|pair| steps(pair[0], pair[1])).collect();
        let line = Line::of(arc, &sides);
        let n = sides.len();
        let step = line.length() / n as f64;
        let reach = ((REACH * width / step).ceil() as usize).clamp(1, n);
        let weight = |k: usize| (-0.5 * (k as f64 * step / width).powi(2)).exp();
        let weights: Vec<f64> = (1..=reach).map(weight).collect();
        let sum = 1.0 + 2.0 * weights.iter().sum::<f64>();
        for (k, &ends) in (0..).zip(&sides) {
            let at = line.at(k);
            let mut way = [0.0; 2];
            for (j, weight) in (1..).zip(&weights) {
                let (before, after) = (line.at(k - j), line.at(k + j));
                // What is straight stays where it is to the last bit.
                way = [0, 1].map(|axis| {
                    let off = (before[axis] - at[axis]) + (after[axis] - at[axis]);
                    way[axis] + off * weight / sum
                });
            }
            let is_beside = !arc.is_loop && (k == 0 || k + 1 == n as i64);
            let most = if is_beside { MOST_BESIDE } else { MOST };
            let share = (most / way[0].hypot(way[1])).min(1.0);
            let (side, number) = self.place(ends);
            self.sides[side][number] = way.map(|way| (way * share) as f32);
        }
    }

    /// Which of the two lists a side is in, and where.
    fn place(&self, [a, b]: [Corner; 2]) -> (usize, usize) {
        let [column, row] = a.min(b);
        (usize::from(a[0] == b[0]), row as usize * self.stride + column as usize)
    }
}

/// The middle between two corners.
fn middle([a, b]: [Corner; 2]) -> [f64; 2] {
    [0, 1].map(|axis| 0.5 * (f64::from(a[axis]) + f64::from(b[axis])))
}

/// The middles along a border, which goes on beyond its ends.
struct Line {
    middles: Vec<[f64; 2]>,
    /// The corners at which it ends; none of a loop.
    ends: Option<[[f64; 2]; 2]>,
}

impl Line {
    fn of(arc: &Arc, sides: &[[Corner; 2]]) -> Self {
        let end = |k: usize| arc.corners[k].map(f64::from);
        let ends = (!arc.is_loop).then(|| [end(0), end(arc.corners.len() - 1)]);
        Self { middles: sides.iter().copied().map(middle).collect(), ends }
    }

    /// The middle with a number, also before the first one and behind the last one.
    fn at(&self, k: i64) -> [f64; 2] {
        let n = self.middles.len() as i64;
        let Some([first, last]) = self.ends else {
            return self.middles[k.rem_euclid(n) as usize];
        };
        // Twice around it has come forwards by twice the way between its ends.
        let (times, k) = (k.div_euclid(2 * n), k.rem_euclid(2 * n));
        let middle = self.middles[if k < n { k } else { 2 * n - 1 - k } as usize];
        [0, 1].map(|axis| {
            let here = if k < n { middle[axis] } else { 2.0 * last[axis] - middle[axis] };
            here + 2.0 * times as f64 * (last[axis] - first[axis])
        })
    }

    fn length(&self) -> f64 {
        let n = self.middles.len() as i64;
        let way = |k: i64| {
            let [a, b] = [self.at(k), self.at(k + 1)];
            (b[0] - a[0]).hypot(b[1] - a[1])
        };
        (0..n).map(way).sum()
    }
}
