//! Rings along the borders of cells of a grid against the cells themselves.

use medial::domain::{Domain, Repair};
use medial::geom::Point;

use crate::agreement::{Random, random_walk, turns_once};
use crate::shapes::{REGROUP, Rings};

/// Unit squares of a grid; everything outside is false.
struct Mask {
    size: i64,
    cells: Vec<bool>,
}

impl Mask {
    fn at(&self, x: i64, y: i64) -> bool {
        let within = 0..self.size;
        within.contains(&x) && within.contains(&y) && self.cells[(y * self.size + x) as usize]
    }

    /// Rings along its border, with the mask on the left, turning at random where they touch.
    fn rings(&self, random: &mut Random) -> Rings {
        const STEPS: [(i64, i64); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];
        let border = |x: i64, y: i64, d: usize| {
            // Cells to the left and right of the unit step from (x, y).
            let (left, right) = match d {
                0 => ((x, y), (x, y - 1)),
                1 => ((x - 1, y), (x, y)),
                2 => ((x - 1, y - 1), (x - 1, y)),
                _ => ((x, y - 1), (x - 1, y - 1)),
            };
            self.at(left.0, left.1) && !self.at(right.0, right.1)
        };
        let mut left: Vec<(i64, i64, usize)> = Vec::new();
        for x in 0..=self.size {
            for y in 0..=self.size {
                left.extend((0..4).filter(|&d| border(x, y, d)).map(|d| (x, y, d)));
            }
        }
        let mut rings = Rings::new();
        while let Some(&start) = left.first() {
            let mut ring = Vec::new();
            let (mut x, mut y, mut d) = start;
            loop {
                left.retain(|&s| s != (x, y, d));
                ring.push(Point::new(x as f64, y as f64));
                (x, y) = (x + STEPS[d].0, y + STEPS[d].1);
                let open: Vec<_> = left.iter().filter(|s| (s.0, s.1) == (x, y)).collect();
                match open.len() {
                    0 => break,
                    n => d = open[random.below(n)].2,
                }
            }
            rings.push(ring);
        }
        rings
    }

    /// Number of regions of cells equal to `value`, joined by sides or also by corners, that
    /// `within` holds; the outside counts as a margin of false cells.
    fn regions(&self, value: bool, corners: bool, within: impl Fn(i64, i64) -> bool) -> usize {
        let mut seen = std::collections::BTreeSet::new();
        let mut count = 0;
        let range = -1..=self.size;
        for x in range.clone() {
            for y in range.clone() {
                let good = |x: i64, y: i64| {
                    range.contains(&x) && range.contains(&y) && within(x, y) == value
                };
                if !good(x, y) || !seen.insert((x, y)) {
                    continue;
                }
                count += 1;
                let mut stack = vec![(x, y)];
                while let Some((x, y)) = stack.pop() {
                    for (dx, dy) in
                        [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)]
                    {
                        let next = (x + dx, y + dy);
                        let side = dx == 0 || dy == 0;
                        if (side || corners) && good(next.0, next.1) && seen.insert(next) {
                            stack.push(next);
                        }
                    }
                }
            }
        }
        count
    }
}

#[test]
fn components_and_walks_of_masks_are_those_of_their_cells() {
    let mut random = Random(5);
    let mut accepted = 0;
    for _ in 0..3_000 {
        let size = 2 + random.below(7) as i64;
        let density = 1 + random.below(4);
        let cells = (0..size * size).map(|_| random.below(5) < density).collect();
        let mask = Mask { size, cells };
        let rings = mask.rings(&mut random);
        let full = mask.cells.iter().filter(|&&c| c).count();
        if full == 0 {
            continue;
        }
        let polygons = [rings];
        let Ok(domain) = Domain::from_polygons(&polygons, &REGROUP) else {
            // Random turns can make rings that cross themselves or each other at corners.
            continue;
        };
        accepted += 1;
        assert_eq!(domain.area(), full as f64);
        let components = mask.regions(true, false, |x, y| mask.at(x, y));
        assert_eq!(domain.n_components(), components, "{polygons:?}");
        turns_once(&domain);
        // Walks of a component: regions of its complement, which corners join.
        let mut walks = 0;
        let mut sizes = Vec::new();
        for start in component_starts(&mask) {
            let cells = component(&mask, start);
            sizes.push(cells.len());
            walks += mask.regions(false, true, |x, y| cells.contains(&(x, y)));
        }
        assert_eq!(domain.walks().len(), walks, "{polygons:?}");
        let mut areas = vec![0.0; components];
        for (k, walk) in (0..).zip(domain.walks()) {
            areas[walk.component as usize] += domain.signed_area(k);
        }
        let mut areas: Vec<usize> = areas.into_iter().map(|a| a as usize).collect();
        areas.sort_unstable();
        sizes.sort_unstable();
        assert_eq!(areas, sizes, "{polygons:?}");
    }
    assert!(accepted > 1_500, "{accepted}");
}

#[test]
fn regrouped_rings_enclose_the_cells_of_odd_parity() {
    let mut random = Random(7);
    let (mut accepted, mut nested) = (0, 0);
    for _ in 0..60_000 {
        let size = 2 + random.below(4) as i64;
        let rings: Rings = (0..2 + random.below(3))
            .map(|_| {
                let len = 4 + random.below(12);
                if random.below(2) == 0 {
                    random_walk(&mut random, size, len)
                } else {
                    random_box(&mut random, size as usize)
                }
            })
            .collect();
        let Ok(domain) = Domain::from_polygons(std::slice::from_ref(&rings), &REGROUP) else {
            continue;
        };
        accepted += 1;
        nested += usize::from(domain.report().count(Repair::Regrouped) > 0);
        let cells = (0..size * size).map(|k| odd(&rings, k % size, k / size)).collect();
        let mask = Mask { size, cells };
        let full = mask.cells.iter().filter(|&&c| c).count();
        assert_eq!(domain.area(), full as f64, "{rings:?}");
        let components = mask.regions(true, false, |x, y| mask.at(x, y));
        assert_eq!(domain.n_components(), components, "{rings:?}");
    }
    assert!(accepted > 2_000 && nested > 500, "{accepted} {nested}");
}

fn random_box(random: &mut Random, size: usize) -> Vec<Point> {
    let mut side = || {
        let low = random.below(size);
        (low as f64, (low + 1 + random.below(size - low)) as f64)
    };
    let ((left, right), (low, high)) = (side(), side());
    [(left, low), (right, low), (right, high), (left, high)].map(|(x, y)| Point::new(x, y)).to_vec()
}

/// Whether an odd number of upright unit steps of the rings lie to the left of a cell.
fn odd(rings: &Rings, x: i64, y: i64) -> bool {
    let middle = y as f64 + 0.5;
    let steps = rings
        .iter()
        .flat_map(|ring| (0..ring.len()).map(move |k| (ring[k], ring[(k + 1) % ring.len()])));
    let left = |&(a, b): &(Point, Point)| a.x <= x as f64 && (a.y < middle) != (b.y < middle);
    steps.filter(left).count() % 2 == 1
}

fn component(mask: &Mask, start: (i64, i64)) -> std::collections::BTreeSet<(i64, i64)> {
    let mut cells = std::collections::BTreeSet::from([start]);
    let mut stack = vec![start];
    while let Some((x, y)) = stack.pop() {
        for (dx, dy) in [(1, 0), (0, 1), (-1, 0), (0, -1)] {
            let next = (x + dx, y + dy);
            if mask.at(next.0, next.1) && cells.insert(next) {
                stack.push(next);
            }
        }
    }
    cells
}

fn component_starts(mask: &Mask) -> Vec<(i64, i64)> {
    let mut seen = std::collections::BTreeSet::new();
    let mut starts = Vec::new();
    for x in 0..mask.size {
        for y in 0..mask.size {
            if mask.at(x, y) && !seen.contains(&(x, y)) {
                starts.push((x, y));
                seen.extend(component(mask, (x, y)));
            }
        }
    }
    starts
}
