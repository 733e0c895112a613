//! The borders between objects, simplified once for both sides.
//!
//! # Contract
//! What is left of the borders divides the plane as they did: the same objects with the same neighbours, components
//! and holes, and no two borders meet where they did not. Corners of pixels where three or four borders meet stay, and so
//! do the corners of the image. Every point of the borders before is within the tolerance of those after, and the other
//! way round.
//!
//! # Method
//! Corners where a border turns leave it one by one, the one first whose way gets off the border least; of the same, the
//! one with the shorter way. A corner may leave if all corners that have left between its neighbours are within the
//! tolerance of the straight way between these, and if no other corner, of whatever border, lies in the triangle of
//! the three: then nothing is between the old way and the new one. That is decided in whole numbers.

use crate::labels::Labels;
use crate::objects::Objects;
use crate::pixels::{Polygons, placed};
use medial::raster::Grid;
use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeSet, BinaryHeap};

/// A corner between pixels: columns and rows from the origin.
type Corner = [u32; 2];

/// The corners that borders turn at, or some of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Borders {
    /// Corners of pixels in a row.
    stride: usize,
    /// One bit for each corner of pixels.
    bits: Vec<u64>,
}

impl Objects {
    /// The borders of all objects, simplified within a tolerance, in units of the plane; with 0 only corners in whose
    /// place there is a straight line leave.
    #[must_use]
    pub fn borders(&self, tolerance: f64) -> Borders {
        let cracks = Cracks { objects: self };
        let Grid { columns, rows, cell, .. } = *self.grid();
        let stride = columns as usize + 1;
        let n_corners = stride * (rows as usize + 1);
        let mut borders = Borders { stride, bits: vec![0; n_corners.div_ceil(64)] };
        let frame = [[0, 0], [columns, 0], [0, rows], [columns, rows]];
        let is_fixed = |corner: Corner| cracks.is_node(corner) || frame.contains(&corner);
        for row in 0..=rows {
            for column in 0..=columns {
                let corner = [column, row];
                if cracks.is_node(corner) || cracks.is_turn(corner) {
                    borders.set(corner, true);
                }
            }
        }
        let mut walk = Walk { cracks: &cracks, seen: vec![0; n_corners], stride };
        let mut arcs: Vec<Arc> = Vec::new();
        let is_start = |at: &Corner| is_fixed(*at);
        for start in borders.corners(rows).filter(is_start) {
            arcs.extend((0..4).filter_map(|way| walk.follow(start, way, &is_fixed)));
        }
        // What is left are loops without a corner that stays.
        for start in borders.corners(rows).filter(|at| !is_fixed(*at)) {
            arcs.extend((0..4).filter_map(|way| walk.follow(start, way, &is_fixed)));
        }
        let mut simplifier = Simplifier {
            borders,
            straight: arcs.iter().filter(|arc| arc.corners.len() == 2).map(Arc::ends).collect(),
            cell: cell.map(f64::abs),
            most: tolerance * tolerance,
        };
        arcs.iter().for_each(|arc| simplifier.simplify(arc));
        simplifier.borders
    }

    /// The polygons of an object between these borders.
    ///
    /// # Panics
    /// If there is no such object.
    #[must_use]
    pub fn polygons_between(&self, object: u32, borders: &Borders) -> Polygons {
        let Some(window) = self.window(object) else { return Vec::new() };
        let along = |ring: &Vec<Corner>| {
            let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
            pairs.flat_map(|(&from, &to)| borders.between(from, to)).collect()
        };
        let corners = window.corners();
        let polygons: Vec<Vec<Vec<Corner>>> =
            corners.iter().map(|rings| rings.iter().map(along).collect()).collect();
        placed(self.grid(), &polygons)
    }
}

impl Borders {
    fn number(&self, [column, row]: Corner) -> usize {
        row as usize * self.stride + column as usize
    }

    fn has(&self, corner: Corner) -> bool {
        let number = self.number(corner);
        self.bits[number / 64] >> (number % 64) & 1 == 1
    }

    fn set(&mut self, corner: Corner, is_there: bool) {
        let number = self.number(corner);
        let bit = 1 << (number % 64);
        if is_there {
            self.bits[number / 64] |= bit;
        } else {
            self.bits[number / 64] &= !bit;
        }
    }

    /// All corners, row by row.
    fn corners(&self, rows: u32) -> impl Iterator<Item = Corner> + use<> {
        let (bits, stride) = (self.bits.clone(), self.stride);
        (0..stride * (rows as usize + 1))
            .filter(move |k| bits[k / 64] >> (k % 64) & 1 == 1)
            .map(move |k| [(k % stride) as u32, (k / stride) as u32])
    }

    /// Those on a way along a row or a column, without the one it leads to.
    fn between(&self, from: Corner, to: Corner) -> impl Iterator<Item = Corner> + '_ {
        let n = from[0].abs_diff(to[0]).max(from[1].abs_diff(to[1]));
        let at = move |k: u32| {
            [0, 1].map(|axis| match from[axis].cmp(&to[axis]) {
                Ordering::Less => from[axis] + k,
                Ordering::Equal => from[axis],
                Ordering::Greater => from[axis] - k,
            })
        };
        (0..n).map(at).filter(|&corner| self.has(corner))
    }
}

/// The sides of pixels between one object and another, or none.
struct Cracks<'a> {
    objects: &'a Objects,
}

/// Ways along the sides of pixels: columns and rows; each next one is a turn, the one after it the way back.
const WAYS: [[i64; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

impl Cracks<'_> {
    /// The object of a pixel, by the corner at its lower right.
    fn object(&self, column: i64, row: i64) -> u32 {
        let Grid { columns, rows, .. } = *self.objects.grid();
        if column < 0 || row < 0 || column >= i64::from(columns) || row >= i64::from(rows) {
            return Labels::NONE;
        }
        let pixel = row as usize * columns as usize + column as usize;
        match self.objects.numbers()[pixel] {
            Objects::REST => Labels::NONE,
            number => number,
        }
    }

    /// The objects around a corner: to the right below it, to the left below, to the left above, to the right above.
    fn around(&self, [column, row]: Corner) -> [u32; 4] {
        let (x, y) = (i64::from(column), i64::from(row));
        [(x, y), (x - 1, y), (x - 1, y - 1), (x, y - 1)].map(|(x, y)| self.object(x, y))
    }

    /// Whether there is a border out of a corner along each way.
    fn ways(&self, corner: Corner) -> [bool; 4] {
        let [a, b, c, d] = self.around(corner);
        [d != a, a != b, b != c, c != d]
    }

    fn is_node(&self, corner: Corner) -> bool {
        self.ways(corner).iter().filter(|&&way| way).count() > 2
    }

    fn is_turn(&self, corner: Corner) -> bool {
        let ways = self.ways(corner);
        ways.iter().filter(|&&way| way).count() == 2 && ways[0] != ways[2]
    }
}

/// A border from one corner that stays to the next, or around to where it began.
struct Arc {
    /// Where it turns, with both ends; a loop ends where it began.
    corners: Vec<Corner>,
    /// Whether it is a loop of which any corner may leave.
    is_loop: bool,
}

impl Arc {
    /// Its two ends, the lesser one first.
    fn ends(&self) -> [Corner; 2] {
        let mut ends = [self.corners[0], self.corners[self.corners.len() - 1]];
        ends.sort_unstable();
        ends
    }
}

/// Follows borders, each once.
struct Walk<'a> {
    cracks: &'a Cracks<'a>,
    /// For each corner the ways out of it that were taken.
    seen: Vec<u8>,
    stride: usize,
}

impl Walk<'_> {
    /// The border out of a corner along a way, if there is one that was not followed yet.
    fn follow(
        &mut self,
        start: Corner,
        mut way: usize,
        is_fixed: &impl Fn(Corner) -> bool,
    ) -> Option<Arc> {
        let number = |[column, row]: Corner| row as usize * self.stride + column as usize;
        if !self.cracks.ways(start)[way] || self.seen[number(start)] >> way & 1 == 1 {
            return None;
        }
        let mut corners = vec![start];
        let mut at = start;
        loop {
            self.seen[number(at)] |= 1 << way;
            at = [0, 1].map(|axis| (i64::from(at[axis]) + WAYS[way][axis]) as u32);
            let back = (way + 2) % 4;
            self.seen[number(at)] |= 1 << back;
            if at == start || is_fixed(at) {
                corners.push(at);
                return Some(Arc { corners, is_loop: !is_fixed(start) });
            }
            let ways = self.cracks.ways(at);
            let on = (0..4).find(|&on| ways[on] && on != back)?;
            if on != way {
                corners.push(at);
            }
            way = on;
        }
    }
}

/// Takes corners out of borders.
struct Simplifier {
    borders: Borders,
    /// The ends of borders that are straight.
    straight: BTreeSet<[Corner; 2]>,
    /// Width and height of a pixel.
    cell: [f64; 2],
    /// The square of the tolerance.
    most: f64,
}

/// A corner that may leave: how far its way gets off the border, squared and as bits that sort alike, and how many
/// corners there are on it; then which one, and between which neighbours.
type Candidate = Reverse<(u64, usize, usize, usize, usize)>;

impl Simplifier {
    fn simplify(&mut self, arc: &Arc) {
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
            if is_taken || !self.is_empty([corners[a], corners[k], corners[b]]) {
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
fn squared_distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let off = [p[0] - a[0], p[1] - a[1]];
    let length = way[0] * way[0] + way[1] * way[1];
    let share = if length > 0.0 { (off[0] * way[0] + off[1] * way[1]) / length } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    let foot = [off[0] - share * way[0], off[1] - share * way[1]];
    foot[0] * foot[0] + foot[1] * foot[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Field;
    use crate::selection::Selection;
    use medial::geom::Point;
    use medial::raster::outline;

    /// All regions of an image of numbers.
    fn objects(columns: u32, class: &[u32]) -> Objects {
        let grid = Grid::of_image(columns, class.len() as u32 / columns);
        let labels = Labels::connected(grid, class, |_, _| true);
        let field = Field::new(grid, class.iter().map(|_| [0.0; 3])).unwrap();
        let chosen = Selection::of(0..labels.len());
        Objects::new(&labels, &labels.regions(&field), &chosen)
    }

    /// The area of a ring that runs with the shape on its left, seen with rows going up.
    fn area(ring: &[Point]) -> f64 {
        let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
        -0.5 * pairs.map(|(a, b)| a.cross(*b)).sum::<f64>()
    }

    fn sides(ring: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
        ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
    }

    fn distance(p: Point, rings: &[Vec<Point>]) -> f64 {
        let squares = rings.iter().flat_map(|ring| sides(ring));
        let squares = squares.map(|(a, b)| squared_distance([p.x, p.y], [a.x, a.y], [b.x, b.y]));
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Spots of noise in all sizes.
    fn noise(columns: u32, rows: u32) -> Vec<u32> {
        let wave = |x: f64, y: f64| (0.9 * x).sin() + (0.7 * y + 0.3 * x).sin() + (0.21 * y).cos();
        let at = |k: u32| (f64::from(k % columns), f64::from(k / columns));
        let value = |(x, y): (f64, f64)| wave(x, y) + 1.5 * wave(0.13 * x + 1.0, 0.17 * y);
        (0..columns * rows).map(|k| (value(at(k)) + 9.0).floor() as u32).collect()
    }

    #[test]
    fn steps_become_a_slope() {
        // A triangle of pixels in the corner of the image.
        let class: Vec<u32> = (0..64).map(|k| u32::from(k % 8 + k / 8 < 7)).collect();
        let objects = objects(8, &class);
        let [exact, simple] = [0.0, 0.8].map(|d| objects.polygons_between(0, &objects.borders(d)));
        assert_eq!(exact[0][0].len(), 2 * 7 + 2 - 1 + 1);
        // The corner of the image, both ends of the slope on its frame, and at most one between.
        assert!((3..=4).contains(&simple[0][0].len()), "{simple:?}");
        let other = objects.polygons_between(1, &objects.borders(0.8));
        let both: f64 = [&simple, &other].iter().map(|p| area(&p[0][0])).sum();
        assert_eq!(both.abs(), 64.0);
    }

    #[test]
    fn a_pixel_stays_a_polygon_whatever_the_tolerance() {
        let mut class = vec![0; 25];
        class[12] = 1;
        let objects = objects(5, &class);
        let borders = objects.borders(100.0);
        let [ground, spot] = [0, 1].map(|k| objects.polygons_between(k, &borders));
        assert_eq!((ground[0].len(), ground[0][0].len()), (2, 4));
        assert_eq!((ground[0][1].len(), spot[0][0].len()), (3, 3));
    }

    #[test]
    fn an_island_in_a_bay_stays_outside() {
        // A bay two pixels deep with an island in it, which a straight border would take in.
        let rows = ["#########", "#.......#", "#..###..#", "#.......#", "#########", "#########"];
        let class: Vec<u32> = rows.iter().flat_map(|row| row.bytes()).map(u32::from).collect();
        let objects = objects(9, &class);
        let borders = objects.borders(50.0);
        let polygons: Vec<_> = (0..3).map(|k| objects.polygons_between(k, &borders)).collect();
        let areas: Vec<f64> =
            polygons.iter().map(|p| p.iter().flatten().map(|ring| area(ring)).sum()).collect();
        assert!(areas.iter().all(|&area| area > 0.0), "{areas:?}");
        assert_eq!(areas.iter().sum::<f64>(), 54.0);
    }

    #[test]
    fn simplified_borders_fit_one_another_and_keep_their_distance() {
        let (columns, rows) = (70, 50);
        let class = noise(columns, rows);
        let objects = objects(columns, &class);
        assert!(objects.all().len() > 60);
        let n_corners =
            |polygons: &Polygons| polygons.iter().flatten().map(Vec::len).sum::<usize>();
        let mut before = usize::MAX;
        for tolerance in [0.0, 0.75, 1.5, 4.0] {
            let borders = objects.borders(tolerance);
            let mut total = 0.0;
            let mut n = 0;
            let mut ways: BTreeSet<[[u64; 2]; 2]> = BTreeSet::new();
            for object in 0..objects.all().len() as u32 {
                let polygons = objects.polygons_between(object, &borders);
                let exact = objects.polygons(object);
                n += n_corners(&polygons);
                let shape = |polygons: &Polygons| polygons.iter().map(Vec::len).collect::<Vec<_>>();
                assert_eq!(shape(&polygons), shape(&exact), "the same rings");
                for (rings, exact) in polygons.iter().zip(&exact) {
                    for (ring, exact) in rings.iter().zip(exact) {
                        assert_eq!(area(ring) > 0.0, area(exact) > 0.0);
                        total += area(ring);
                    }
                    let is_near = |p: &Point, rings| distance(*p, rings) <= tolerance + 1e-9;
                    assert!(exact.iter().flatten().all(|p| is_near(p, rings)));
                    let middles = rings.iter().flat_map(|ring| sides(ring));
                    let middles = middles.map(|(a, b)| (a + b) * 0.5);
                    assert!(middles.into_iter().all(|p| is_near(&p, exact)));
                    for (a, b) in rings.iter().flat_map(|ring| sides(ring)) {
                        // Each side is run through once each way, or lies on the frame.
                        let way = [a, b].map(|p| [p.x.to_bits(), p.y.to_bits()]);
                        assert!(ways.insert(way), "{a:?} {b:?}");
                    }
                }
            }
            assert_eq!(total, f64::from(columns * rows), "they fill the image");
            let is_frame = |[[a, c], [b, d]]: [[u64; 2]; 2]| {
                let [a, b, c, d] = [a, b, c, d].map(f64::from_bits);
                (a == b && (a == 0.0 || a == f64::from(columns)))
                    || (c == d && (c == 0.0 || c == -f64::from(rows)))
            };
            assert!(ways.iter().all(|&[a, b]| ways.contains(&[b, a]) || is_frame([a, b])));
            assert!(n < before, "{n} corners at {tolerance}");
            before = n;
        }
    }

    #[test]
    fn without_tolerance_the_outline_gains_only_corners_of_others() {
        let objects = objects(3, &[0, 0, 0, 1, 1, 2]);
        let exact = objects.polygons_between(0, &objects.borders(0.0));
        let mask = objects.mask(0).unwrap();
        let corners = &outline(&mask)[0][0];
        assert_eq!(exact[0][0].len(), corners.len() + 1);
        assert!(exact[0][0].contains(&Point::new(2.0, -1.0)));
    }
}
