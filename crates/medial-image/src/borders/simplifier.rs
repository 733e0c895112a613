//! Which corners may leave a border, and in which order.

use super::arcs::{Arc, Cracks};
use super::{Borders, Corner};
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

/// Takes corners out of borders.
pub(super) struct Simplifier<'a> {
    pub cracks: &'a Cracks<'a>,
    pub borders: Borders,
    /// The ends of borders that are straight.
    pub straight: BTreeSet<[Corner; 2]>,
    /// Width and height of a pixel.
    pub cell: [f64; 2],
    /// The square of the tolerance.
    pub most: f64,
}

/// A corner that may leave: how far its way gets off the border, squared and as bits that sort alike, and how many
/// corners there are on it; then which one, and between which neighbours.
type Candidate = Reverse<(u64, usize, usize, usize, usize)>;

impl Simplifier<'_> {
    pub fn simplify(&mut self, arc: &Arc) {
        let n = arc.corners.len();
        // The end of a loop is its start.
        let corners = if arc.is_loop { &arc.corners[..n - 1] } else { &arc.corners[..] };
        let n = corners.len();
        if n < 3 {
            return;
        }
        let mut before: Vec<usize> = (0..n).map(|k| (k + n - 1) % n).collect();
        let mut after: Vec<usize> = (0..n).map(|k| (k + 1) % n).collect();
        let may_leave = |k: usize| arc.is_loop || (0 < k && k + 1 < n);
        let mut heap: BinaryHeap<Candidate> = BinaryHeap::new();
        for k in (0..n).filter(|&k| may_leave(k)) {
            heap.extend(self.candidate(corners, before[k], k, after[k]));
        }
        let mut is_gone = vec![false; n];
        while let Some(Reverse((_, _, k, a, b))) = heap.pop() {
            if is_gone[k] || before[k] != a || after[k] != b {
                continue;
            }
            // A second way between the same corners would lie on the first one.
            let is_taken = if arc.is_loop {
                after[b] == a
            } else {
                corners[a] == corners[b]
                    || (b + 1 < n && corners[after[b]] == corners[a])
                    || (a > 0 && corners[before[a]] == corners[b])
                    || (a == 0 && b + 1 == n && self.straight.contains(&arc.ends()))
            };
            // An object goes on through a corner only if it has less than half a turn there on both sides.
            let turns_away = !arc.is_loop
                && ((a == 0 && self.turns_away(corners[0], corners[1], corners[b]))
                    || (b + 1 == n && self.turns_away(corners[b], corners[b - 1], corners[a])));
            if is_taken || turns_away || !self.is_empty([corners[a], corners[k], corners[b]]) {
                continue;
            }
            self.borders.set(corners[k], false);
            is_gone[k] = true;
            (after[a], before[b]) = (b, a);
            if !arc.is_loop && a == 0 && b + 1 == n {
                self.straight.insert(arc.ends());
            }
            for k in [a, b].into_iter().filter(|&k| may_leave(k)) {
                heap.extend(self.candidate(corners, before[k], k, after[k]));
            }
        }
    }

    /// A corner that may leave, if its way stays within the tolerance.
    fn candidate(&self, corners: &[Corner], a: usize, k: usize, b: usize) -> Option<Candidate> {
        let n = corners.len();
        let n_between = (b + n - a) % n;
        let (from, to) = (self.place(corners[a]), self.place(corners[b]));
        let mut farthest = 0.0_f64;
        for step in 1..n_between {
            farthest =
                farthest.max(squared_distance(self.place(corners[(a + step) % n]), from, to));
            if farthest > self.most {
                return None;
            }
        }
        Some(Reverse((farthest.to_bits(), n_between, k, a, b)))
    }

    /// Whether a border out of a corner at which pixels of one object touch would turn by an eighth of a turn or more one
    /// way, or by more the other way, from where it led at first. If none of the four does, no two of them are half a turn
    /// apart.
    fn turns_away(&self, corner: Corner, at_first: Corner, to: Corner) -> bool {
        if !self.cracks.is_pinched(corner) {
            return false;
        }
        let way = |to: Corner| [0, 1].map(|axis| i64::from(to[axis]) - i64::from(corner[axis]));
        let (first, now) = (way(at_first), way(to));
        let along = first[0] * now[0] + first[1] * now[1];
        let across = first[0] * now[1] - first[1] * now[0];
        !(-along <= across && across < along)
    }

    fn place(&self, corner: Corner) -> [f64; 2] {
        [0, 1].map(|axis| f64::from(corner[axis]) * self.cell[axis])
    }

    /// Whether no corner lies in a triangle or on its sides, but for its own three.
    fn is_empty(&self, own: [Corner; 3]) -> bool {
        let triangle = own.map(|corner| corner.map(i64::from));
        let rows = triangle.map(|corner| corner[1]);
        let [low, high] = [rows.iter().min(), rows.iter().max()].map(|y| y.copied().unwrap_or(0));
        (low..=high).all(|y| {
            let (from, to) = span(triangle, y);
            (from..=to).all(|x| {
                let corner = [x as u32, y as u32];
                !self.borders.has(corner) || own.contains(&corner)
            })
        })
    }
}

/// The columns of a triangle in a row that it reaches, both with it.
fn span(triangle: [[i64; 2]; 3], y: i64) -> (i64, i64) {
    let (mut low, mut high) = (i64::MAX, i64::MIN);
    for k in 0..3 {
        let ([x0, y0], [x1, y1]) = (triangle[k], triangle[(k + 1) % 3]);
        if y0 == y1 {
            if y0 == y {
                (low, high) = (low.min(x0.min(x1)), high.max(x0.max(x1)));
            }
            continue;
        }
        let ([x0, y0], [x1, y1]) =
            if y0 < y1 { ([x0, y0], [x1, y1]) } else { ([x1, y1], [x0, y0]) };
        if (y0..=y1).contains(&y) {
            // x0 + (x1 - x0) (y - y0) / (y1 - y0), rounded to both sides.
            let (way, height) = ((x1 - x0) * (y - y0), y1 - y0);
            low = low.min(x0 + way.div_euclid(height) + i64::from(way.rem_euclid(height) > 0));
            high = high.max(x0 + way.div_euclid(height));
        }
    }
    (low, high)
}

/// The square of the distance of a point from what is straight between two others.
pub(super) fn squared_distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let off = [p[0] - a[0], p[1] - a[1]];
    let length = way[0] * way[0] + way[1] * way[1];
    let share = if length > 0.0 { (off[0] * way[0] + off[1] * way[1]) / length } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    let foot = [off[0] - share * way[0], off[1] - share * way[1]];
    foot[0] * foot[0] + foot[1] * foot[1]
}
