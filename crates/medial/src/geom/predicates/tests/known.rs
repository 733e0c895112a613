//! Disks whose answers can be derived by hand.

use std::cmp::Ordering::{Equal, Greater, Less};

use crate::geom::Point;
use crate::geom::predicates::{Element, ExactDisk, in_disk};

fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

fn corner(x: f64, y: f64) -> Element {
    Element::Corner(p(x, y))
}

fn edge(ax: f64, ay: f64, bx: f64, by: f64) -> Element {
    Element::Edge(p(ax, ay), p(bx, by))
}

fn disk(elements: [Element; 3]) -> ExactDisk {
    ExactDisk::new(elements).expect("a disk")
}

#[test]
fn opposite_orders_of_three_governors_are_two_disks() {
    // The contact lies at a distance √(|zp|·|zq|) = √10 on either side of z = (-3, 0), where the line
    // through the corners meets the edge.
    let floor = edge(-30.0, 0.0, 30.0, 0.0);
    let (a, b) = (corner(-1.0, 1.0), corner(1.0, 2.0));
    let root = 10f64.sqrt();
    let (right, left) = (disk([b, a, floor]), disk([a, b, floor]));
    // x = -3 ± √10 and y = r = ((x + 1)² + 1)/2 = (15 ∓ 4√10)/2
    for (disk, x, y) in [
        (&right, root - 3.0, (15.0 - 4.0 * root) / 2.0),
        (&left, -root - 3.0, (15.0 + 4.0 * root) / 2.0),
    ] {
        let (c, r) = disk.approximate();
        assert!((c.x - x).abs() < 1e-14 && (c.y - y).abs() < 1e-14 && (r - y).abs() < 1e-14);
    }
    assert_eq!(right.compare_along(&left, p(0.0, 0.0), p(1.0, 0.0)), Greater);
    assert_eq!(right.compare_across(&left, p(0.0, 0.0), p(1.0, 0.0)), Less);
}

#[test]
fn an_edge_seen_from_behind_or_beside_its_ends_is_told_from_a_cut() {
    // The unit circle around zero.
    let unit = disk([corner(1.0, 0.0), corner(0.0, 1.0), corner(-1.0, 0.0)]);
    // Its line runs through the centre, but the edge begins far to the right.
    let beside = (p(5.0, 0.5), p(6.0, 0.5));
    assert_eq!(unit.side(Element::Edge(beside.0, beside.1)), Less);
    assert_eq!(unit.along(beside.0, beside.1, beside.0), Less);
    // Above the disk and directed so that its front looks up.
    let behind = (p(-1.0, 3.0), p(1.0, 3.0));
    assert_eq!(unit.side(Element::Edge(behind.0, behind.1)), Less);
    assert_eq!(unit.front(behind.0, behind.1), Less);
    // The same edge the other way round is in front and clear.
    assert_eq!(unit.front(behind.1, behind.0), Greater);
    assert_eq!(unit.side(Element::Edge(behind.1, behind.0)), Greater);
    // And a tangent touches.
    assert_eq!(unit.side(edge(3.0, 1.0, -7.0, 1.0)), Equal);
}

#[test]
fn a_transition_lies_on_the_normal_at_the_reflex_corner() {
    // The L with arms 1 wide and 3 long: its wall ends at the reflex corner (1, 1), opposite the floor.
    let (wall, v, floor) = (edge(3.0, 1.0, 1.0, 1.0), corner(1.0, 1.0), edge(0.0, 0.0, 3.0, 0.0));
    let transition = disk([wall, v, floor]);
    assert_eq!(transition.approximate(), (p(1.0, 0.5), 0.5));
    assert_eq!(transition.along(p(3.0, 1.0), p(1.0, 1.0), p(1.0, 1.0)), Equal);
    assert_eq!(transition.orientation(p(1.0, 1.0), p(1.0, 0.0)), Equal);
    // The left wall is half a unit away from the disk.
    assert_eq!(transition.side(edge(0.0, 3.0, 0.0, 0.0)), Greater);
}

#[test]
fn a_corner_between_two_walls_gives_the_smaller_disk() {
    // r = 2 - √2 for the reflex corner (1, 1) in front of the corner at zero.
    let r = 2.0 - 2f64.sqrt();
    let elements = [corner(1.0, 1.0), edge(0.0, 3.0, 0.0, 0.0), edge(0.0, 0.0, 3.0, 0.0)];
    let (c, radius) = disk(elements).approximate();
    for value in [c.x, c.y, radius] {
        assert!((value - r).abs() < 1e-15, "{value}");
    }
    // The opposite order is the larger one, r = 2 + √2.
    let [v, left, floor] = elements;
    let (_, radius) = disk([v, floor, left]).approximate();
    assert!((radius - 2.0 - 2f64.sqrt()).abs() < 1e-15);
}

#[test]
fn two_level_corners_share_one_disk_with_the_wall_below() {
    // x = 0, (y - 1)² + 4 = y²
    let floor = edge(-9.0, 0.0, 9.0, 0.0);
    let level = disk([corner(2.0, 1.0), corner(-2.0, 1.0), floor]);
    assert_eq!(level.approximate(), (p(0.0, 2.5), 2.5));
    // In the other order the contact would have to lie above the corners.
    assert!(ExactDisk::new([corner(-2.0, 1.0), corner(2.0, 1.0), floor]).is_none());
}

#[test]
fn opposite_walls_and_a_corner_between_them() {
    let (floor, roof) = (edge(0.0, 0.0, 9.0, 0.0), edge(9.0, 2.0, 0.0, 2.0));
    let v = corner(4.0, 0.4);
    // (x - 4)² + 0.6² = 1: to the left of the corner, or to the right.
    let (c, r) = disk([floor, v, roof]).approximate();
    assert!((c.x - 3.2).abs() < 1e-15 && c.y == 1.0 && r == 1.0, "{c:?} {r}");
    let (c, r) = disk([roof, v, floor]).approximate();
    assert!((c.x - 4.8).abs() < 1e-15 && c.y == 1.0 && r == 1.0, "{c:?} {r}");
    let outside = corner(4.0, 2.5);
    assert!(ExactDisk::new([floor, outside, roof]).is_none());
}

#[test]
fn a_convex_corner_of_two_edges_is_where_all_disks_shrink_to() {
    // Two sides of the triangle 3-4-5 meet at a corner, through which a third line passes.
    let (a, b, c) = (p(0.0, 0.0), p(4.0, 0.0), p(0.0, 3.0));
    let through = disk([Element::Edge(c, a), Element::Edge(a, b), Element::Edge(p(1.0, 1.0), a)]);
    assert_eq!(through.approximate(), (a, 0.0));
    // The corner itself is no governor.
    assert!(
        ExactDisk::new([Element::Corner(a), Element::Edge(a, b), Element::Edge(c, a)]).is_none()
    );
}

#[test]
fn impossible_triples_have_no_disk() {
    let (a, b, c) = (p(0.0, 0.0), p(4.0, 0.0), p(0.0, 3.0));
    let sides = [Element::Edge(a, b), Element::Edge(b, c), Element::Edge(c, a)];
    let none = |elements: [Element; 3]| {
        for turn in 0..3 {
            let mut turned = elements;
            turned.rotate_left(turn);
            assert!(ExactDisk::new(turned).is_none(), "{turned:?}");
        }
    };
    // Clockwise.
    none([sides[2], sides[1], sides[0]]);
    none([corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0)]);
    // The same element twice, or in two pieces.
    none([sides[0], sides[0], sides[1]]);
    none([corner(1.0, 1.0), corner(1.0, 1.0), sides[0]]);
    none([sides[0], edge(4.0, 0.0, 9.0, 0.0), sides[1]]);
    none([corner(1.0, 1.0), sides[0], edge(4.0, 0.0, 9.0, 0.0)]);
    // Lines of one direction.
    none([corner(1.0, 2.0), sides[0], edge(0.0, 1.0, 4.0, 1.0)]);
    none([sides[0], edge(0.0, 1.0, 4.0, 1.0), sides[1]]);
    // Corners on one line, behind an edge, or on it.
    none([corner(0.0, 0.0), corner(1.0, 1.0), corner(2.0, 2.0)]);
    none([corner(1.0, -1.0), sides[0], sides[1]]);
    none([corner(1.0, 1.0), corner(2.0, -1.0), sides[0]]);
    none([corner(1.0, 0.0), corner(2.0, 0.0), sides[0]]);
    // An edge of no length.
    none([corner(1.0, 1.0), Element::Edge(a, a), sides[0]]);
    // Outside the triangle formed by the lines.
    none([Element::Edge(b, a), Element::Edge(a, c), Element::Edge(c, b)]);
}

#[test]
fn answers_do_not_depend_on_a_power_of_two() {
    for exponent in [-200, -97, -31, 31, 97, 190] {
        let s = 2f64.powi(exponent);
        let scaled = |element| match element {
            Element::Corner(a) => Element::Corner(a * s),
            Element::Edge(a, b) => Element::Edge(a * s, b * s),
        };
        let tests = [
            [corner(1.0, 1.0), edge(0.0, 3.0, 0.0, 0.0), edge(0.0, 0.0, 3.0, 0.0)],
            [corner(1.0, 2.0), corner(-1.0, 1.0), edge(-30.0, 0.0, 30.0, 0.0)],
            [edge(0.0, 0.0, 4.0, 0.0), edge(4.0, 0.0, 1.0, 3.0), edge(1.0, 3.0, 0.0, 0.0)],
            [corner(1.0, 0.0), corner(0.0, 1.0), corner(-1.0, 0.0)],
        ];
        let probes = [corner(0.0, -1.0), corner(2.0, 1.0), edge(9.0, 1.0, -9.0, 1.0)];
        for elements in tests {
            let (plain, large) = (disk(elements), disk(elements.map(scaled)));
            let ((c, r), (d, q)) = (plain.approximate(), large.approximate());
            assert_eq!((c * s, r * s), (d, q), "{exponent} {elements:?}");
            for t in probes {
                assert_eq!(plain.side(t), large.side(scaled(t)), "{exponent} {elements:?} {t:?}");
                assert_eq!(in_disk(elements, t), in_disk(elements.map(scaled), scaled(t)));
            }
        }
    }
}

#[test]
fn coordinates_of_very_different_size_are_exact() {
    // Three corners of a rectangle, and the fourth; one unit in the last place moves it off.
    let (long, short) = (2f64.powi(190), 2f64.powi(-190));
    let circle = [corner(0.0, 0.0), corner(long, 0.0), corner(long, short)];
    assert_eq!(in_disk(circle, corner(0.0, short)), Equal);
    assert_eq!(in_disk(circle, corner(0.0, short.next_up())), Greater);
    assert_eq!(in_disk(circle, corner(0.0, short.next_down())), Less);
    assert_eq!(disk(circle).approximate(), (p(long / 2.0, short / 2.0), long / 2.0));
}

#[test]
fn what_is_no_number_does_not_panic() {
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, f64::MIN_POSITIVE, 5e-324];
    for value in bad {
        let elements = [corner(value, 1.0), edge(0.0, 3.0, 0.0, value), edge(0.0, 0.0, 3.0, 0.0)];
        for k in 0..3 {
            let mut turned = elements;
            turned[k] = corner(1.0, 1.0);
            if let Some(disk) = ExactDisk::new(turned) {
                let _ = (disk.side(elements[k]), disk.approximate());
            }
        }
    }
}

#[test]
fn a_disk_that_no_doubles_can_tell_is_rounded_from_its_integers() {
    // Two edges of a side whose directions differ by 1e-26, and the side below.
    let (a, b) = (0.999_999_999_999_999_8, 0.999_999_999_999_999_9);
    let disk = disk([
        edge(0.0, 0.0, b, 0.0),
        edge(a, 0.4328, b, 0.433_599_999_999_999_9),
        edge(b, 0.433_599_999_999_999_9, 1.0, 0.434_399_999_999_999_9),
    ]);
    let (rounded, (centre, radius)) = (disk.rounded(), disk.approximate());
    assert!(rounded.bound < 1e-14 && (0.3..0.5).contains(&radius), "{rounded:?}");
    let off = (rounded.position() - centre).norm() + (rounded.radius - radius).abs();
    assert!(off <= 2.0 * rounded.bound, "{rounded:?} {centre:?} {radius}");
}

#[test]
fn ties_of_binary_fractions_are_ties() {
    // The centre (2.5, 2.5) of four corners, whose radius is no fraction; a touching edge; two equal
    // centres.
    let [a, b, c, d] = [(2.0, 2.0), (3.0, 2.0), (3.0, 3.0), (2.0, 3.0)].map(|(x, y)| corner(x, y));
    let first = disk([a, b, c]);
    assert_eq!(first.side(d), Equal);
    assert_eq!(first.side(corner(2.0, 3.0f64.next_up())), Greater);
    assert_eq!(first.side(edge(1.0, 2.0, 4.0, 5.0)), Less);
    assert_eq!(first.side(edge(1.0, 3.0, 3.0, 1.0)), Equal);
    assert_eq!(first.along(p(0.0, 0.0), p(0.0, 7.0), p(9.0, 2.5)), Equal);
    let second = disk([b, c, d]);
    assert_eq!(first.compare_along(&second, p(0.0, 0.0), p(3.0, 1.0)), Equal);
    assert_eq!(first.compare_across(&second, p(0.0, 0.0), p(3.0, 1.0)), Equal);
}
