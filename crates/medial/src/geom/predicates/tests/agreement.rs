//! The exact disk against the independent reference, on generic and on degenerate input.

use std::cmp::Ordering;

use crate::geom::Point;
use crate::geom::predicates::{Element, ExactDisk};

use super::circle::Shape;
use super::random::{Family, Random};
use super::reference::{Disk, Vector, nearest, sign};

/// How often each answer came.
#[derive(Default, Debug)]
struct Seen {
    disks: usize,
    none: usize,
    less: usize,
    equal: usize,
    greater: usize,
}

impl Seen {
    fn note(&mut self, answer: Ordering) {
        match answer {
            Ordering::Less => self.less += 1,
            Ordering::Equal => self.equal += 1,
            Ordering::Greater => self.greater += 1,
        }
    }
}

/// Doubles from `a` to `b`.
fn ulps(a: f64, b: f64) -> u64 {
    let key = |v: f64| {
        let bits = v.to_bits() as i64;
        if bits < 0 { i64::MIN.wrapping_sub(bits) } else { bits }
    };
    key(a).abs_diff(key(b))
}

/// Asks both the same questions about one disk and one more element.
fn compare(elements: [Element; 3], t: Element, seen: &mut Seen) {
    let (disk, reference) = (ExactDisk::new(elements), Disk::new(elements));
    assert_eq!(disk.is_some(), reference.is_some(), "existence of {elements:?}");
    let (Some(disk), Some(reference)) = (disk, reference) else {
        seen.none += 1;
        return;
    };
    seen.disks += 1;
    let degenerate = matches!(t, Element::Edge(a, b) if a == b);
    if !degenerate {
        let answer = disk.side(t);
        assert_eq!(answer, reference.side(t), "side of {t:?} for {elements:?}");
        seen.note(answer);
    }
    let (a, b) = match t {
        Element::Corner(p) => (p, p + Point::new(1.0, 0.0)),
        Element::Edge(a, b) => (a, b),
    };
    for p in [a, b] {
        let answer = disk.along(a, b, p);
        assert_eq!(answer, reference.along(a, b, p), "along {a:?} {b:?} for {elements:?}");
        seen.note(answer);
    }
    let answer = disk.front(a, b);
    assert_eq!(answer, reference.front(a, b), "front of {a:?} {b:?} for {elements:?}");
    seen.note(answer);
    let answer = disk.orientation(a, b);
    assert_eq!(answer, reference.orientation(a, b), "turn {a:?} {b:?} for {elements:?}");
    let (c, r) = disk.approximate();
    for length in [r, r.next_up(), r.next_down(), 0.75 * r, 1.0] {
        if length >= 1e-60 {
            let answer = disk.compare_radius(length);
            assert_eq!(answer, reference.compare_radius(length), "{length} for {elements:?}");
        }
    }
    let exact = [nearest(&reference.c.x), nearest(&reference.c.y), nearest(&reference.r)];
    for (rounded, exact) in [c.x, c.y, r].into_iter().zip(exact) {
        assert!(ulps(rounded, exact) <= 1, "{rounded} is not {exact} for {elements:?}");
    }
}

#[test]
fn random_disks_agree_with_the_reference() {
    for family in Family::ALL {
        let mut seen = Seen::default();
        for corners in 0..=3 {
            let mut random = Random::new(5 + corners as u64);
            for k in 0..250 {
                let elements = [0, 1, 2].map(|i| family.element(&mut random, i < corners));
                let t = family.element(&mut random, k % 2 == 0);
                compare(elements, t, &mut seen);
            }
        }
        assert!(seen.disks > 200 && seen.none > 50, "{family:?}: {seen:?}");
        assert!(seen.less > 50 && seen.greater > 50, "{family:?}: {seen:?}");
    }
}

#[test]
fn small_grids_agree_with_the_reference_on_every_tie() {
    let mut seen = Seen::default();
    for corners in 0..=3 {
        let mut random = Random::new(91 + corners as u64);
        for k in 0..2500 {
            let elements = [0, 1, 2].map(|i| Family::Small.element(&mut random, i < corners));
            let t = Family::Small.element(&mut random, k % 2 == 0);
            compare(elements, t, &mut seen);
        }
    }
    assert!(seen.equal > 300, "{seen:?}");
}

#[test]
fn edges_that_meet_at_a_governing_corner_agree_with_the_reference() {
    let mut seen = Seen::default();
    for family in Family::ALL {
        let mut random = Random::new(3);
        for k in 0..200 {
            let [p, a, b, c] = [0; 4].map(|_| family.point(&mut random));
            // A corner with its incoming edge, and something else; sometimes both of its edges.
            let other = match k % 4 {
                0 => Element::Corner(b),
                1 => Element::Edge(b, c),
                2 => Element::Edge(p, b),
                _ => Element::Edge(a, b),
            };
            let t = if k % 3 == 0 { Element::Corner(a) } else { Element::Edge(p, c) };
            compare([Element::Edge(a, p), Element::Corner(p), other], t, &mut seen);
            compare([Element::Corner(p), Element::Edge(p, a), other], t, &mut seen);
        }
    }
    assert!(seen.disks > 400, "{seen:?}");
}

#[test]
fn elements_of_one_circle_all_touch_its_disk() {
    for shape in Shape::all() {
        let mut random = Random::new(7);
        for _ in 0..60 {
            let (elements, t) = shape.touching(&mut random);
            let disk =
                ExactDisk::new(elements).expect("three contacts of one circle in their order");
            assert_eq!(disk.side(t), Ordering::Equal, "{shape:?} {elements:?} {t:?}");
            // The other order is no disk, or another one.
            let [a, b, c] = elements;
            if let Some(other) = ExactDisk::new([c, b, a]) {
                assert_ne!(disk.approximate(), other.approximate());
            }
        }
    }
}

#[test]
fn one_ulp_off_a_circle_agrees_with_the_reference() {
    let mut seen = Seen::default();
    for shape in Shape::all() {
        let mut random = Random::new(11);
        for _ in 0..60 {
            let (elements, t) = shape.touching(&mut random);
            compare(elements, t, &mut seen);
            let mut all = [elements[0], elements[1], elements[2], t];
            let at = random.below(4) as usize;
            all[at] = nudged(all[at], &mut random);
            compare([all[0], all[1], all[2]], all[3], &mut seen);
        }
    }
    assert!(seen.less > 100 && seen.equal > 500 && seen.greater > 100, "{seen:?}");
}

/// The element with one coordinate moved by one ulp.
fn nudged(element: Element, random: &mut Random) -> Element {
    // Beside zero the reference cannot tell the next double from it.
    let up = random.below(2) == 0;
    let up = |v: f64| match (v == 0.0, up) {
        (true, true) => f64::EPSILON,
        (true, false) => -f64::EPSILON,
        (false, true) => v.next_up(),
        (false, false) => v.next_down(),
    };
    match element {
        Element::Corner(p) => Element::Corner(Point::new(up(p.x), p.y)),
        Element::Edge(a, b) => Element::Edge(a, Point::new(b.x, up(b.y))),
    }
}

#[test]
fn centres_are_ordered_as_by_the_reference() {
    let mut seen = Seen::default();
    let (mut random, o) = (Random::new(23), Point::new(0.0, 0.0));
    for k in 0..1500 {
        let family = if k % 2 == 0 { Family::Small } else { Family::ALL[k % 6] };
        let corners = [random.below(4), random.below(4)];
        let triples = corners.map(|n| [0, 1, 2].map(|i| family.element(&mut random, i < n)));
        // Sometimes two of the governors are the same, as on one path.
        let [first, mut second] = triples;
        if k % 3 == 0 {
            (second[0], second[1]) = (first[0], first[1]);
        }
        let direction = family.point(&mut random);
        let ([Some(a), Some(b)], [Some(c), Some(d)]) =
            ([first, second].map(ExactDisk::new), [first, second].map(Disk::new))
        else {
            continue;
        };
        let between = c.c.sub(&d.c);
        let along = a.compare_along(&b, o, direction);
        assert_eq!(along, sign(&Vector::new(direction).dot(&between)), "{first:?} {second:?}");
        assert_eq!(b.compare_along(&a, o, direction), along.reverse());
        let larger = sign(&(c.r.clone() - d.r.clone()));
        assert_eq!(a.compare_radii(&b), larger, "{first:?} {second:?}");
        assert_eq!(b.compare_radii(&a), larger.reverse());
        let across = a.compare_across(&b, o, direction);
        assert_eq!(across, sign(&Vector::new(direction).cross(&between)), "{first:?} {second:?}");
        seen.note(along);
    }
    assert!(seen.less > 30 && seen.equal > 5 && seen.greater > 30, "{seen:?}");
}

#[test]
fn disks_of_one_circle_have_one_centre() {
    for shape in Shape::all() {
        let mut random = Random::new(29);
        for _ in 0..15 {
            let [first, second] = [0; 2].map(|_| shape.touching(&mut random).0);
            let (Some(a), Some(b)) = (ExactDisk::new(first), ExactDisk::new(second)) else {
                panic!("three contacts of one circle in their order");
            };
            let (p, q) = (Point::new(0.0, 0.0), Point::new(0.3, 0.7));
            assert_eq!(a.compare_along(&b, p, q), Ordering::Equal);
            assert_eq!(a.compare_across(&b, p, q), Ordering::Equal);
            assert_eq!(a.approximate(), b.approximate());
        }
    }
}
