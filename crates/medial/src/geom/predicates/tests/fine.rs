//! Pairs of doubles against the tower.

use super::random::Random;
use crate::geom::Point;
use crate::geom::predicates::construct::{construct, corners_first};
use crate::geom::predicates::fine::Fine;
use crate::geom::predicates::near::Near;
use crate::geom::predicates::{Element, ExactDisk};

/// A ring with corners on a lattice, one of them moved by an ulp.
const RING: [(f64, f64); 16] = [
    (3.0, 21.0),
    (0.0, 24.0),
    (-3.0, 21.0),
    (-6.0, 18.0),
    (-9.0, 15.0),
    (-6.0, 12.0),
    (-3.0, 9.0),
    (0.0, 12.0),
    (-3.0, 15.0),
    (0.0, 18.0),
    (2.9999999999999996, 15.0),
    (6.0, 12.0),
    (9.0, 9.0),
    (12.0, 12.0),
    (9.0, 15.0),
    (6.0, 18.0),
];

#[test]
fn disks_of_corners_moved_by_an_ulp_answer_as_the_tower_does() {
    let mut random = Random::new(47);
    let mut tried = 0;
    for _ in 0..120 {
        let mut coordinate = || {
            let value = random.below(9) as f64 - 3.0;
            let hair = [0, 0, 1, -1][random.below(4) as usize];
            if value == 0.0 {
                value
            } else {
                f64::from_bits(value.to_bits().wrapping_add_signed(hair))
            }
        };
        let corners: Vec<Point> = (0..8).map(|_| Point::new(coordinate(), coordinate())).collect();
        let all: Vec<Element> = (0..8)
            .filter(|&k| corners[k] != corners[(k + 1) % 8])
            .flat_map(|k| {
                [Element::Corner(corners[k]), Element::Edge(corners[k], corners[(k + 1) % 8])]
            })
            .collect();
        for _ in 0..200 {
            let mut pick = || all[random.below(all.len() as u64) as usize];
            let elements = corners_first([pick(), pick(), pick()]);
            let exists = construct(&elements);
            let disk = ExactDisk::new(elements);
            assert_eq!(disk.is_some(), exists.is_some(), "{elements:?}");
            let (Some(disk), Some(form)) = (disk, exists) else { continue };
            assert_eq!(disk.approximate(), form.nearest(), "{elements:?}");
            tried += 1;
            for &t in &all {
                assert_eq!(disk.side(t), disk.side_in_tower(t), "{elements:?} {t:?}");
                if let Element::Edge(p, q) = t {
                    assert_eq!(disk.front(p, q), disk.front_in_tower(p, q), "{elements:?} {t:?}");
                    let along = disk.along_in_tower(p, q, q);
                    assert_eq!(disk.along(p, q, q), along, "{elements:?} {t:?}");
                }
            }
        }
    }
    assert!(tried > 1000, "{tried}");
}

#[test]
fn pairs_of_doubles_answer_as_the_tower_does_within_an_ulp_of_ties() {
    let corner = |k: usize| Point::new(RING[k % 16].0, RING[k % 16].1);
    let all: Vec<Element> = (0..16)
        .flat_map(|k| [Element::Corner(corner(k)), Element::Edge(corner(k), corner(k + 1))])
        .collect();
    let mut answers = 0;
    for (i, &a) in all.iter().enumerate() {
        for (j, &b) in all.iter().enumerate() {
            for &c in &all[..i.min(j)] {
                if i == j {
                    continue;
                }
                let elements = corners_first([a, b, c]);
                let Some(form) = construct(&elements) else {
                    assert!(ExactDisk::new(elements).is_none(), "{elements:?}");
                    continue;
                };
                let Some(disk) = ExactDisk::new(elements) else { panic!("{elements:?}") };
                assert_eq!(disk.approximate(), form.nearest(), "{elements:?}");
                let fine = Near::found(&elements).and_then(|near| Fine::new(&elements, &near));
                for &t in &all {
                    let exact = disk.side_in_tower(t);
                    assert_eq!(disk.side(t), exact, "{elements:?} {t:?}");
                    if let Some(side) = fine.and_then(|fine| fine.side(t)) {
                        assert_eq!(side, exact, "{elements:?} {t:?}");
                        answers += 1;
                    }
                    if let Element::Edge(p, q) = t {
                        let front = disk.front_in_tower(p, q);
                        assert_eq!(disk.front(p, q), front, "{elements:?} {t:?}");
                        for end in [p, q] {
                            let along = disk.along_in_tower(p, q, end);
                            assert_eq!(disk.along(p, q, end), along, "{elements:?} {t:?}");
                        }
                    }
                }
            }
        }
    }
    assert!(answers > 10_000, "{answers}");
}
