//! Makes a find smaller.

use std::time::Instant;

use medial::geom::Point;

use super::Ring;
use super::judge::Shape;

/// Drops polygons, rings and runs of corners, then shortens coordinates, as long as the shape
/// fails and there is time.
pub fn reduce(mut shape: Shape, until: Instant, fails: &dyn Fn(&Shape) -> bool) -> Shape {
    let fails = |next: &Shape| Instant::now() < until && fails(next);
    let count = |shape: &Shape| shape.polygons.iter().flatten().map(Vec::len).sum::<usize>();
    loop {
        let before = count(&shape);
        thin(&mut shape, &fails, |s| s.polygons.len(), |s, k, n| drop(s.polygons.drain(k..k + n)));
        for i in (0..shape.polygons.len()).rev() {
            let holes = |s: &Shape| s.polygons[i].len().saturating_sub(1);
            thin(&mut shape, &fails, holes, |s, k, n| drop(s.polygons[i].drain(k + 1..k + 1 + n)));
            for j in (0..shape.polygons[i].len()).rev() {
                let corners = |s: &Shape| s.polygons[i][j].len();
                let cut = |s: &mut Shape, k, n| drop(s.polygons[i][j].drain(k..k + n));
                thin(&mut shape, &fails, corners, cut);
            }
        }
        if Instant::now() > until || count(&shape) == before {
            break;
        }
    }
    if count(&shape) < 100 {
        shorten(&mut shape, &fails);
    }
    shape
}

/// Cuts runs of a list, long ones first.
fn thin(
    shape: &mut Shape,
    fails: &dyn Fn(&Shape) -> bool,
    len: impl Fn(&Shape) -> usize,
    cut: impl Fn(&mut Shape, usize, usize),
) {
    let mut run = len(shape) / 2;
    while run > 0 {
        let mut k = 0;
        while k + run <= len(shape) {
            let mut next = shape.clone();
            cut(&mut next, k, run);
            if fails(&next) {
                *shape = next;
            } else {
                k += run;
            }
        }
        run /= 2;
    }
}

/// Rounds coordinates to fewer digits.
fn shorten(shape: &mut Shape, fails: &dyn Fn(&Shape) -> bool) {
    for i in 0..shape.polygons.len() {
        for j in 0..shape.polygons[i].len() {
            for k in 0..shape.polygons[i][j].len() {
                for digits in [1e0, 1e1, 1e2, 1e3, 1e4, 1e6, 1e8, 1e10, 1e12] {
                    let round = |x: f64| (x * digits).round() / digits;
                    let ring: &Ring = &shape.polygons[i][j];
                    let old = ring[k];
                    let new = Point::new(round(old.x), round(old.y));
                    let mut next = shape.clone();
                    next.polygons[i][j][k] = new;
                    if new == old || fails(&next) {
                        *shape = next;
                        break;
                    }
                }
            }
        }
    }
}
