//! Brushfire: what each way to burn keeps, and what it does not.

mod support;

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use medial::axis::{Accuracy, Engine};
use medial::check;
use medial::engine::{
    Burning, Burnt, EngineError, Options, brushfire, brushfire_of_domain, exterior, interior,
    of_mask,
};
use medial::raster::{Grid, Mask, Topology, mask_of_disks, topology};
use support::random::Random;
use support::shapes;

fn drawn(rows: &[&str]) -> Mask {
    let columns = rows.first().map_or(0, |row| row.len() as u32);
    let grid = Grid::of_image(columns, rows.len() as u32);
    Mask::new(grid, |x, y| rows[y as usize].as_bytes()[x as usize] == b'#').unwrap()
}

fn burnt(mask: &Mask, burning: Burning) -> Burnt<'_> {
    Burnt::new(mask, burning, &Options::default()).unwrap()
}

fn rows_of(mask: &Mask) -> Vec<String> {
    let Grid { columns, rows, .. } = *mask.grid();
    let letter = |inside: bool| if inside { '#' } else { '.' };
    (0..rows).map(|y| (0..columns).map(|x| letter(mask.get(x, y))).collect()).collect()
}

fn random_mask(seed: u64) -> Mask {
    let mut random = Random(seed);
    let (columns, rows) = (random.below(30) as u32, random.below(30) as u32);
    let grid = Grid::of_image(columns, rows);
    if seed.is_multiple_of(2) {
        let fill = random.below(101);
        return Mask::new(grid, |_, _| random.below(100) < fill).unwrap();
    }
    // Blobs, so that there is something to burn.
    let disks: Vec<[f64; 3]> = (0..1 + random.below(6))
        .map(|_| [random.unit() * 30.0, random.unit() * 30.0, random.unit() * 9.0])
        .collect();
    Mask::new(grid, |x, y| {
        let within = |&[u, v, r]: &[f64; 3]| (f64::from(x) - u).hypot(f64::from(y) - v) < r;
        disks.iter().filter(|disk| within(disk)).count() % 3 > 0
    })
    .unwrap()
}

/// Whether one of the cells of some full block of two by two could go.
fn has_thick_block(mask: &Mask) -> bool {
    let Grid { columns, rows, .. } = *mask.grid();
    let before = topology(mask);
    let mut cells = (0..rows.saturating_sub(1))
        .flat_map(|y| (0..columns.saturating_sub(1)).map(move |x| (x, y)));
    cells.any(|(x, y)| {
        let block = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
        block.iter().all(|&(x, y)| mask.get(x, y))
            && block.iter().any(|&(x, y)| {
                let mut without = mask.clone();
                without.put(x, y, false);
                topology(&without) == before
            })
    })
}

#[test]
fn components_and_holes_stay() {
    for seed in 1..1500 {
        let mask = random_mask(seed);
        for &burning in Burning::ALL {
            let left = burnt(&mask, burning);
            let cells = left.cells();
            for y in 0..mask.grid().rows {
                assert!(cells.cells(y).all(|x| mask.get(x, y)), "{seed} {burning}");
            }
            if burning.keeps_topology() {
                assert_eq!(
                    topology(cells),
                    topology(&mask),
                    "{seed} {burning}: {:#?}",
                    rows_of(&mask)
                );
                let axis = left.axis().unwrap();
                let Topology { components, holes } = topology(&mask);
                let spare = axis.keypoints().len() as i64 - axis.paths().len() as i64;
                assert_eq!(spare, i64::from(components) - i64::from(holes), "{seed} {burning}");
            }
        }
    }
}

#[test]
fn the_four_ways_leave_nothing_thick() {
    for seed in 1..300 {
        let mask = random_mask(seed);
        for burning in
            [Burning::Sequential, Burning::Alternating, Burning::Marking, Burning::Isotropic]
        {
            let left = burnt(&mask, burning);
            assert!(
                !has_thick_block(left.cells()),
                "{seed} {burning}: {:#?}",
                rows_of(left.cells())
            );
        }
    }
}

#[test]
fn zhang_and_suen_lose_squares_of_four() {
    let square = drawn(&["....", ".##.", ".##.", "...."]);
    for &burning in Burning::ALL {
        let count = burnt(&square, burning).cells().count();
        assert_eq!(count == 0, burning == Burning::ZhangSuen, "{burning}: {count}");
        assert!(count < 4);
    }
    // They lose nothing of larger ones.
    let larger = drawn(&[".....", ".###.", ".###.", ".###.", "....."]);
    assert_eq!(rows_of(burnt(&larger, Burning::ZhangSuen).cells())[2], "..#..");
}

#[test]
fn small_masks_are_no_trouble() {
    for &burning in Burning::ALL {
        let left = |mask: &Mask| burnt(mask, burning).cells().clone();
        assert_eq!(left(&drawn(&[])).count(), 0);
        assert_eq!(left(&drawn(&["...", "..."])).count(), 0);
        assert_eq!(left(&drawn(&["#"])).count(), 1, "{burning}");
        let board = Mask::new(Grid::of_image(9, 9), |x, y| (x + y) % 2 == 0).unwrap();
        if burning.keeps_topology() {
            assert_eq!(topology(&left(&board)), topology(&board), "{burning}");
        }
        let full = Mask::new(Grid::of_image(40, 13), |_, _| true).unwrap();
        let axis = left(&full);
        assert_eq!(topology(&axis), Topology { components: 1, holes: 0 }, "{burning}");
        // The middle row, far from both ends.
        assert_eq!((0..13).filter(|&y| axis.get(20, y)).collect::<Vec<_>>(), [6], "{burning}");
        let line = drawn(&["#######"]);
        assert_eq!(left(&line).count(), 7, "{burning}");
    }
}

#[test]
fn fire_comes_in_steps_along_sides() {
    let full = Mask::new(Grid::of_image(21, 9), |_, _| true).unwrap();
    for &burning in Burning::ALL {
        let left = burnt(&full, burning);
        for (x, y) in [(0, 4), (10, 0), (10, 1), (10, 2), (10, 3), (10, 4), (3, 3)] {
            let steps = 1 + x.min(20 - x).min(y).min(8 - y);
            let label = left.pass(x, y).unwrap();
            // Where fire eats corners first it may come sooner, and a kept cell holds it up.
            assert!(label.abs_diff(steps) <= 1, "{burning} ({x}, {y}): {label} {steps}");
            let exact = f64::from(steps) - 0.5;
            assert!((left.radius(x, y).unwrap() - exact).abs() < 1e-12);
        }
        assert_eq!(left.pass(21, 0), None);
        assert!((3..=6).contains(&left.passes()), "{burning}: {}", left.passes());
    }
    // Along diagonals there are more steps than cells: a diamond.
    let diamond =
        Mask::new(Grid::of_image(21, 21), |x, y| x.abs_diff(10) + y.abs_diff(10) <= 9).unwrap();
    let left = burnt(&diamond, Burning::Isotropic);
    let (label, exact) = (left.pass(10, 10).unwrap(), left.radius(10, 10).unwrap());
    assert_eq!(label, 10);
    assert!(f64::from(label) > 1.3 * exact, "{label} {exact}");
    // A pass of four sides goes farther there.
    assert_eq!(burnt(&diamond, Burning::Alternating).pass(10, 10), Some(6));
}

#[test]
fn fig_14_inversion_loses_cells_and_has_another_axis() {
    // The figure itself is not in the text: any shape with slanted sides shows what it says.
    let shape = drawn(&[
        "....................",
        "....####............",
        "...########.........",
        "..############......",
        "..################..",
        "..################..",
        "...##############...",
        "....###########.....",
        "......#######.......",
        "........###.........",
        "....................",
    ]);
    let options = Options::default();
    for &burning in Burning::ALL {
        let axis = brushfire(&shape, burning, &options).unwrap();
        if burning == Burning::default() {
            assert_eq!(of_mask(&shape, Engine::Brushfire, &options).unwrap(), axis);
        }
        let inverted = mask_of_disks(&axis, shape.grid()).unwrap();
        assert!(inverted.count() < shape.count(), "{burning}");
        for y in 0..11 {
            assert!(inverted.cells(y).all(|x| shape.get(x, y)), "{burning}");
        }
        // Distances that the fire counted are no radii of disks: they reach out of the shape.
        let left = burnt(&shape, burning);
        let reach =
            (0..11).flat_map(|y| left.cells().cells(y).map(move |x| (x, y))).any(|(x, y)| {
                f64::from(left.pass(x, y).unwrap()) - 0.5 > left.radius(x, y).unwrap() + 1e-9
            });
        assert!(reach, "{burning}");
    }
    // "The difference between the two MATs."
    let differ = Burning::ALL.iter().filter(|&&burning| {
        let axis = brushfire(&shape, burning, &options).unwrap();
        let inverted = mask_of_disks(&axis, shape.grid()).unwrap();
        burnt(&inverted, burning).cells() != burnt(&shape, burning).cells()
    });
    assert!(differ.count() > 0);
}

#[test]
fn domains_burn() {
    for name in [
        "rectangle_5_by_2",
        "l_with_unit_arms",
        "square_ring_6_around_2",
        "comb_with_three_unit_teeth",
    ] {
        let domain = shapes::domain(name);
        let bounds = domain.bounds();
        let cell = (bounds.max.x - bounds.min.x) / 90.0;
        let options = Options { cell: Some(cell), ..Options::default() };
        for &burning in Burning::ALL {
            let axis = brushfire_of_domain(&domain, burning, &options).unwrap();
            assert_eq!((axis.engine, axis.accuracy), (Engine::Brushfire, Accuracy::Sampled(cell)));
            assert!(!axis.complete);
            let verdict = check::defects(&domain, &axis);
            assert!(verdict.defects.is_empty(), "{name} {burning}: {:?}", verdict.defects[0]);
            assert_eq!(verdict.counts.cycles, usize::from(name.starts_with("square_ring")));
        }
        let axis = interior(&domain, Engine::Brushfire, &options).unwrap();
        assert_eq!(axis, brushfire_of_domain(&domain, Burning::default(), &options).unwrap());
        let outside = exterior(&domain, Engine::Brushfire, None, &options).unwrap_err();
        assert_eq!(outside, EngineError::NoExterior { engine: Engine::Brushfire });
    }
}

#[test]
fn limits_end_it() {
    let mask = Mask::new(Grid::of_image(300, 300), |_, _| true).unwrap();
    let cancel = AtomicBool::new(true);
    for &burning in Burning::ALL {
        let late = Options { deadline: Some(Instant::now()), ..Options::default() };
        assert_eq!(brushfire(&mask, burning, &late).unwrap_err(), EngineError::TimeLimit);
        let cancelled = Options { cancel: Some(&cancel), ..Options::default() };
        assert_eq!(brushfire(&mask, burning, &cancelled).unwrap_err(), EngineError::Cancelled);
    }
}

#[test]
fn bars_of_any_height_keep_their_middle() {
    for rows in [9, 10] {
        for turned in [false, true] {
            let (columns, rows) = if turned { (rows, 60) } else { (60, rows) };
            let mask = Mask::new(Grid::of_image(columns, rows), |_, _| true).unwrap();
            // In row order, a stroke two cells wide burns away from the end that comes first.
            let others = Burning::ALL.iter().filter(|burning| **burning != Burning::Sequential);
            for &burning in others {
                let axis = brushfire(&mask, burning, &Options::default()).unwrap();
                let length: f64 = axis.paths().iter().map(|path| axis.curve(&path).length()).sum();
                assert!(length > 45.0, "{burning}, {columns} by {rows}: {length}");
            }
        }
    }
}
