//! The short cuts against the tower.

use std::cmp::Ordering;

use crate::geom::Point;
use crate::geom::predicates::{
    Element, ExactDisk, First, Leaving, counts, in_disk, reset_counts, two_ends,
};

use super::circle::Shape;
use super::random::{Family, Random};
use crate::geom::predicates::transition;

#[test]
fn short_cuts_answer_as_the_tower_does() {
    let mut answers = [0; 3];
    for family in Family::ALL {
        for corners in [0, 3] {
            let mut random = Random::new(41 + corners as u64);
            for k in 0..1500 {
                let mut elements = [0, 1, 2].map(|i| family.element(&mut random, i < corners));
                let t = if k % 10 == 0 {
                    elements[1]
                } else {
                    family.element(&mut random, corners == 3)
                };
                // Chained edges share their ends, as in a ring.
                if let [Element::Edge(_, b), Element::Edge(_, d), Element::Edge(_, f)] = elements
                    && k % 2 == 0
                {
                    elements[1] = Element::Edge(b, d);
                    elements[2] = Element::Edge(d, f);
                }
                let Some(disk) = ExactDisk::new(elements) else { continue };
                if matches!(t, Element::Edge(a, b) if a == b) {
                    continue;
                }
                let answer = disk.side_in_tower(t);
                assert_eq!(in_disk(elements, t), answer, "{elements:?} {t:?}");
                assert_eq!(disk.side(t), answer, "{elements:?} {t:?}");
                answers[(answer as i8 + 1) as usize] += 1;
            }
        }
    }
    assert!(answers.iter().all(|&n| n > 100), "{answers:?}");
}

#[test]
fn ties_of_one_kind_never_reach_the_tower() {
    for shape in Shape::all() {
        for corner in [true, false] {
            let mut random = Random::new(43);
            let mut built = 0;
            for k in 0..60 {
                let (elements, t) = shape.touching_of_kind(&mut random, corner);
                reset_counts();
                assert_eq!(in_disk(elements, t), Ordering::Equal);
                assert_eq!(counts().disks, 0, "{elements:?} {t:?}");
                let near = nudged(t, k % 2 == 0);
                let answer = in_disk(elements, near);
                built += counts().disks;
                let disk = ExactDisk::new(elements).expect("a disk by construction");
                assert_eq!(answer, disk.side_in_tower(near), "{elements:?} {near:?}");
            }
            // Close to a tie a pair of doubles may be too short, but seldom.
            assert!(built <= 6, "{shape:?} {corner} {built}");
        }
    }
}

#[test]
fn doubles_answer_nearly_everything_generic() {
    for family in [Family::Full, Family::Offset, Family::Degrees, Family::Grid, Family::Scales] {
        let mut random = Random::new(47);
        reset_counts();
        for k in 0..2000 {
            let elements = [0, 1, 2].map(|i| family.element(&mut random, i < k % 4));
            let t = family.element(&mut random, k % 3 == 0);
            let Some(disk) = ExactDisk::new(elements) else { continue };
            let answer = disk.side(t);
            assert_eq!(answer, disk.side_in_tower(t), "{elements:?} {t:?}");
        }
        // Each question was asked of the tower once more, as a check.
        let counts = counts();
        let first = counts.tower - counts.disks;
        assert!(counts.disks > 500 && 20 * first < counts.disks, "{family:?} {counts:?}");
    }
}

/// The element with one coordinate moved by one ulp.
fn nudged(element: Element, up: bool) -> Element {
    let step = |v: f64| if up { v.next_up() } else { v.next_down() };
    match element {
        Element::Corner(p) => Element::Corner(Point::new(p.x, step(p.y))),
        Element::Edge(a, b) => Element::Edge(Point::new(step(a.x), a.y), b),
    }
}

#[test]
fn axis_parallel_edges_tie_without_roots() {
    // A square and its four sides; then one side moved by one ulp.
    let p = Point::new;
    let [a, b, c, d] = [p(0.1, 0.1), p(0.4, 0.1), p(0.4, 0.4), p(0.1, 0.4)];
    let sides = [Element::Edge(a, b), Element::Edge(b, c), Element::Edge(c, d)];
    reset_counts();
    assert_eq!(in_disk(sides, Element::Edge(d, a)), Ordering::Equal);
    let closer = 0.1f64.next_up();
    assert_eq!(in_disk(sides, Element::Edge(p(closer, 0.4), p(closer, 0.1))), Ordering::Less);
    let farther = 0.1f64.next_down();
    assert_eq!(in_disk(sides, Element::Edge(p(farther, 0.4), p(farther, 0.1))), Ordering::Greater);
    assert_eq!((counts().edges, counts().disks), (3, 0));
}

/// The disk on the normal where a governor leaves, which touches the other governor.
fn transition(right: Leaving, left: Leaving, at_right: bool) -> Option<ExactDisk> {
    let governor = |leaving: Leaving, on_right: bool| match leaving {
        Leaving::Edge(a, b) => Element::Edge(a, b),
        Leaving::Corner(a, b) => Element::Corner(if on_right { a } else { b }),
    };
    let leaves = match (if at_right { right } else { left }, at_right) {
        // The end of the edge, or the edge the corner leaves to.
        (Leaving::Edge(_, b), true) => Element::Corner(b),
        (Leaving::Edge(a, _), false) => Element::Corner(a),
        (Leaving::Corner(a, b), _) => Element::Edge(a, b),
    };
    ExactDisk::new([governor(right, true), leaves, governor(left, false)])
}

fn first(order: Ordering) -> First {
    match order {
        Ordering::Less => First::Right,
        Ordering::Equal => First::Both,
        Ordering::Greater => First::Left,
    }
}

/// What two exact disks say, where both are on the path.
fn by_disks(right: Leaving, left: Leaving) -> Option<First> {
    let (at_right, at_left) = (transition(right, left, true)?, transition(right, left, false)?);
    let zero = Point::new(0.0, 0.0);
    match (right, left) {
        // Along the right edge, or backwards along the left one, the path only goes forward.
        (Leaving::Edge(a, b), Leaving::Edge(..)) => {
            Some(first(at_right.compare_along(&at_left, a, b)))
        }
        (Leaving::Edge(..), Leaving::Corner(f, g)) => {
            // Forward is where the wall of the corner has been passed.
            Some(first(at_right.along(f, g, g).reverse()))
        }
        (Leaving::Corner(a, b), Leaving::Edge(..)) => Some(first(at_left.along(a, b, a).reverse())),
        (Leaving::Corner(v, b), Leaving::Corner(f, w)) => {
            // Both walls are crossed in the direction of the path.
            let path = (w - v).perp() * -1.0;
            let crossed = (b - v).dot(path) > 0.0 && (w - f).dot(path) < 0.0;
            crossed.then(|| first(at_right.compare_along(&at_left, zero, path)))
        }
    }
}

#[test]
fn two_ends_are_ordered_as_their_exact_disks() {
    for kinds in 0..4 {
        let mut random = Random::new(61 + kinds);
        let mut answers = [0; 3];
        for k in 0..20_000 {
            // Coordinates whose differences are exact, so that the path's direction is too.
            let family = if k % 2 == 0 { Family::Small } else { Family::Grid };
            let [a, mut b, c, mut d] = [0; 4].map(|_| family.point(&mut random));
            // Some are parallel to one axis.
            match k % 8 {
                0 | 1 => (b.y, d.y) = (a.y, c.y),
                2 | 3 => (b.x, d.x) = (a.x, c.x),
                _ => {}
            }
            if a == b || c == d {
                continue;
            }
            let right = if kinds & 1 == 0 { Leaving::Edge(a, b) } else { Leaving::Corner(a, b) };
            let left = if kinds & 2 == 0 { Leaving::Edge(c, d) } else { Leaving::Corner(c, d) };
            let Some(expected) = by_disks(right, left) else { continue };
            assert_eq!(two_ends(right, left), expected, "{right:?} {left:?}");
            answers[expected as usize] += 1;
        }
        assert!(answers.iter().all(|&n| n > 20), "{kinds}: {answers:?}");
    }
}

#[test]
fn two_ends_of_any_size_agree() {
    // Full mantissas far from the origin and over many scales need more than fixed integers.
    for family in [Family::Full, Family::Offset, Family::Degrees, Family::Scales] {
        let mut random = Random::new(67);
        let mut compared = 0;
        for k in 0..3000 {
            let [a, b, c, d] = [0; 4].map(|_| family.point(&mut random));
            let right = if k & 1 == 0 { Leaving::Edge(a, b) } else { Leaving::Corner(a, b) };
            let left = if k & 2 == 0 { Leaving::Edge(c, d) } else { Leaving::Corner(c, d) };
            if matches!((right, left), (Leaving::Corner(..), Leaving::Corner(..))) {
                continue;
            }
            let Some(expected) = by_disks(right, left) else { continue };
            assert_eq!(two_ends(right, left), expected, "{right:?} {left:?}");
            compared += 1;
        }
        assert!(compared > 100, "{family:?}: {compared}");
    }
}

#[test]
fn transitions_answer_as_the_tower_does() {
    for family in Family::ALL {
        let mut random = Random::new(71);
        reset_counts();
        let mut seen = [0; 3];
        for k in 0..3000 {
            let [a, b, c, d, p] = [0; 5].map(|_| family.point(&mut random));
            // An edge, its end or its start, and a corner or an edge.
            let v = Element::Corner(if k & 1 == 0 { a } else { b });
            let other = if k & 2 == 0 { Element::Corner(c) } else { Element::Edge(c, d) };
            let elements = [Element::Edge(a, b), v, other];
            let Some(disk) = ExactDisk::new(elements) else { continue };
            let answers = [
                (transition::side_of_corner(&elements, p), disk.side_in_tower(Element::Corner(p))),
                (transition::product_along(&elements, [c, d], d), disk.along_in_tower(c, d, d)),
                (transition::product_along(&elements, [a, p], c), disk.along_in_tower(a, p, c)),
                (transition::product_across(&elements, [p, c]), disk.front_in_tower(p, c)),
            ];
            for (answer, expected) in answers {
                let Some(answer) = answer else {
                    assert!(matches!(family, Family::Scales), "{elements:?}");
                    continue;
                };
                assert_eq!(answer, expected, "{elements:?} {p:?}");
                seen[(answer as i8 + 1) as usize] += 1;
            }
        }
        // Over many scales the forms seldom apply.
        let scales = matches!(family, Family::Scales);
        assert!(scales || (seen[0] > 100 && seen[2] > 100), "{family:?} {seen:?}");
        assert!(seen[1] > 100 || !matches!(family, Family::Small), "{family:?} {seen:?}");
    }
}

#[test]
fn facing_corners_of_a_corridor_tie_without_the_tower() {
    // Two square holes of a lattice: the disk on the normals of both facing corners.
    let p = Point::new;
    let (right, left) = ((p(3.0, 3.0), p(3.0, 7.0)), (p(-3.0, 7.0), p(-3.0, 3.0)));
    for turn in [(1.0, 0.0), (3.0, 4.0), (0.3, 0.7)] {
        let at = |q: Point| p(q.x * turn.0 - q.y * turn.1, q.x * turn.1 + q.y * turn.0);
        let [a, b, c, d] = [right.0, right.1, left.0, left.1].map(at);
        let disk = ExactDisk::new([Element::Edge(a, b), Element::Corner(b), Element::Edge(c, d)])
            .expect("walls that face each other");
        reset_counts();
        assert_eq!(disk.along(c, d, c), disk.along_in_tower(c, d, c));
        assert_eq!(disk.side(Element::Corner(c)), disk.side_in_tower(Element::Corner(c)));
        assert_eq!(counts().tower, 2, "{turn:?}");
        // Tenths are rounded, so only whole numbers are sure to tie.
        if turn.0 >= 1.0 {
            assert_eq!(disk.along(c, d, c), Ordering::Equal);
        }
    }
}
