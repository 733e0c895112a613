//! The order in which holes are merged.
//!
//! A hole comes after all whose boxes hold its own. Those that hold none come in rounds, each with about
//! twice as many as the one before, so that the first ones lie everywhere; within a round neighbours
//! follow one another, so that what is looked at was looked at a moment ago.

use std::cmp::Reverse;
use std::ops::Range;

use crate::domain::Domain;
use crate::geom::{BoundsTree, Rect, Visitor, hilbert, order_key};

/// When a walk comes within its component.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Outer,
    /// A hole whose box holds others, by its width; of one rounded width the one that spans the other
    /// starts further left.
    Around(Reverse<u64>, i64),
    /// Any other hole, by round and place.
    Alone(Reverse<u32>, u64),
}

/// Looks for a hole in the box of another one.
struct Inside<'b> {
    boxes: &'b [Rect],
    holes: &'b [u32],
    of: u32,
    found: bool,
}

impl Visitor for Inside<'_> {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        !self.found && bounds.meets(&self.boxes[self.of as usize])
    }

    fn item(&mut self, item: u32) {
        let hole = self.holes[item as usize];
        let (outer, inner) = (&self.boxes[self.of as usize], &self.boxes[hole as usize]);
        self.found |= hole != self.of && outer.holds(inner.min) && outer.holds(inner.max);
    }
}

/// The boxes of all walks.
fn boxes(domain: &Domain) -> Vec<Rect> {
    let start = |edge| domain.edge(edge).start;
    let walks = domain.walks().iter();
    walks.map(|walk| walk.edges().map(start).fold(Rect::EMPTY, Rect::with)).collect()
}

/// Where the middles of the boxes of walks lie along a curve over all holes, which brings near what is
/// near.
fn places(domain: &Domain, boxes: &[Rect]) -> Vec<u64> {
    let walks = domain.walks().iter().zip(boxes);
    let holes = walks.filter(|(walk, _)| walk.hole);
    let all = holes.fold(Rect::EMPTY, |all, (_, own)| all.union(*own));
    let middle = |own: &Rect| own.min + (own.max - own.min) * 0.5;
    boxes.iter().map(|own| hilbert(&all, middle(own))).collect()
}

/// All walks, near ones close to each other, in whichever order holes are given: so boxes of some that
/// follow one another are small.
pub(super) fn along_curve(domain: &Domain) -> Vec<u32> {
    let mut walks: Vec<(u64, u32)> = places(domain, &boxes(domain)).into_iter().zip(0..).collect();
    walks.sort_unstable();
    walks.into_iter().map(|(_, walk)| walk).collect()
}

/// The walks in the order in which they are merged: component by component, the outer ring of each first.
pub(super) fn of_walks(domain: &Domain) -> Vec<u32> {
    let walks = domain.walks();
    let boxes = boxes(domain);
    let places = places(domain, &boxes);
    let mut holes: Vec<u32> = (0..walks.len() as u32).filter(|&k| walks[k as usize].hole).collect();
    holes.sort_unstable_by_key(|&k| (places[k as usize], k));
    let tree = BoundsTree::new(0, holes.len() as u32, |k| boxes[holes[k as usize] as usize]);
    let mut order: Vec<(u32, Place, u32)> = Vec::with_capacity(walks.len());
    for (k, (walk, own)) in (0..).zip(walks.iter().zip(&boxes)) {
        let place = if walk.hole {
            let mut inside = Inside { boxes: &boxes, holes: &holes, of: k, found: false };
            tree.visit(&mut inside);
            if inside.found {
                // Positive numbers are in the order of their bits.
                Place::Around(Reverse((own.max.x - own.min.x).to_bits()), order_key(own.min.x))
            } else {
                Place::Alone(Reverse(round(k)), places[k as usize])
            }
        } else {
            Place::Outer
        };
        order.push((walk.component, place, k));
    }
    order.sort_unstable();
    order.into_iter().map(|(.., k)| k).collect()
}

/// The round of a number, counted from the last one: each holds about half of all that are not in later
/// ones.
pub(super) fn round(number: u32) -> u32 {
    // Every bit of the number tells in the bits that are counted.
    let mixed = number.wrapping_add(1).wrapping_mul(0x9e37_79b1);
    (mixed ^ mixed >> 15).wrapping_mul(0x85eb_ca77).leading_zeros()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Options;
    use crate::geom::Point;

    #[test]
    fn a_hole_comes_after_the_one_in_whose_hollow_it_lies() {
        let ring = |corners: &[(f64, f64)]| -> Vec<Point> {
            corners.iter().map(|&(x, y)| Point::new(x, y)).collect()
        };
        let square = |x: f64, y: f64, size: f64| {
            ring(&[(x, y), (x + size, y), (x + size, y + size), (x, y + size)])
        };
        let cup =
            ring(&[(2., 2.), (8., 2.), (8., 7.), (7., 7.), (7., 3.), (3., 3.), (3., 7.), (2., 7.)]);
        let rings = vec![square(0., 0., 10.), square(4., 4., 1.), cup, square(5.5, 4., 1.)];
        let domain = Domain::from_polygons(&[rings], &Options::default()).unwrap();
        let lengths: Vec<u32> =
            of_walks(&domain).iter().map(|&k| domain.walks()[k as usize].len).collect();
        assert_eq!(lengths, [4, 8, 4, 4]);
    }
}
