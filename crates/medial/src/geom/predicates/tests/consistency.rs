//! What holds for every disk, whatever made it.

use std::cmp::Ordering;

use crate::geom::Point;
use crate::geom::predicates::{Element, ExactDisk};

use super::random::{Family, Random};

/// Every disk among random triples, with its elements, at most `n` for a family and a kind.
fn disks(n: usize, mut each: impl FnMut(Family, usize, [Element; 3], ExactDisk)) {
    for family in Family::ALL {
        for corners in 0..=3 {
            let mut random = Random::new(17 + corners as u64);
            let mut found = 0;
            for _ in 0..40 * n {
                let elements = [0, 1, 2].map(|i| family.element(&mut random, i < corners));
                if let Some(disk) = ExactDisk::new(elements) {
                    found += 1;
                    each(family, corners, elements, disk);
                    if found == n {
                        break;
                    }
                }
            }
            assert!(found > n / 4, "{family:?} with {corners} corners gave only {found} disks");
        }
    }
}

#[test]
fn a_disk_touches_its_own_elements() {
    disks(150, |family, _, elements, disk| {
        for element in elements {
            assert_eq!(disk.side(element), Ordering::Equal, "{family:?} {elements:?}");
        }
    });
}

#[test]
fn rotations_of_the_elements_give_one_disk() {
    disks(50, |_, _, [a, b, c], disk| {
        for turned in [[b, c, a], [c, a, b]] {
            let turned = ExactDisk::new(turned).expect("a rotation of a disk's elements");
            let (x, y) = (Point::new(1.0, 0.0), Point::new(0.0, 1.0));
            let o = Point::new(0.0, 0.0);
            assert_eq!(disk.compare_along(&turned, o, x), Ordering::Equal);
            assert_eq!(disk.compare_along(&turned, o, y), Ordering::Equal);
            assert_eq!(disk.approximate(), turned.approximate());
        }
    });
}

#[test]
fn contacts_follow_one_another_counterclockwise() {
    disks(150, |family, _, elements, disk| {
        let (c, r) = disk.approximate();
        let contacts = elements.map(|element| match element {
            Element::Corner(p) => p - c,
            Element::Edge(a, b) => -(b - a).perp() * (r / (b - a).norm()),
        });
        let [p, q, s] = contacts.map(|v| v * (1.0 / r));
        // Rounded contacts say nothing where they nearly coincide.
        let area = (q - p).cross(s - p);
        assert!(area > -1e-4 || r == 0.0, "{family:?} {elements:?} {area}");
    });
}
