//! The raster transform on random and on known masks: topology, thinness, disks, distances, the same for any
//! number of threads.

mod support;

use medial::axis::{KeypointKind, MedialAxis};
use medial::check;
use medial::domain::{self, Domain};
use medial::engine::{Options, Skeleton, raster_transform, raster_transform_of_domain};
use medial::geom::Point;
use medial::raster::{Grid, Mask, mask_of_disks, outline, topology};
use std::num::NonZeroUsize;
use support::random::Random;

/// A mask of blobs, bars, holes or noise.
fn random(seed: u64) -> Mask {
    let mut random = Random(seed);
    let (columns, rows) = (random.below(70) as u32, random.below(50) as u32);
    let mut grid = Grid::of_image(columns, rows);
    match seed % 4 {
        1 => grid.cell = [0.5, 0.5],
        2 if seed % 8 == 2 => grid.cell = [1.0, -2.0],
        _ => {}
    }
    let mut mask = Mask::empty(grid).unwrap();
    if seed.is_multiple_of(3) {
        let fill = random.below(101);
        return Mask::new(grid, |_, _| random.below(100) < fill).unwrap();
    }
    for _ in 0..random.below(12) {
        let inside = random.below(4) > 0;
        let (x, y) = (random.below(70) as i64, random.below(50) as i64);
        let (a, b) = (1 + random.below(16) as i64, 1 + random.below(16) as i64);
        let is_round = random.below(2) == 0;
        for row in 0..rows {
            for column in 0..columns {
                let (dx, dy) = (i64::from(column) - x, i64::from(row) - y);
                let hit = if is_round {
                    dx * dx * b * b + dy * dy * a * a <= a * a * b * b
                } else {
                    dx.abs() <= a / 2 && dy.abs() <= b / 2
                };
                if hit {
                    mask.put(column, row, inside);
                }
            }
        }
    }
    mask
}

/// Some overlapping disks of 8 to 30 cells across and a few holes.
fn blobs(seed: u64) -> Mask {
    let mut random = Random(seed);
    let mut mask = Mask::empty(Grid::of_image(150, 120)).unwrap();
    for k in 0..24 {
        let radius = 4 + random.below(12) as i64;
        let (x, y) = (random.below(150) as i64, random.below(120) as i64);
        let radius = if k % 6 == 5 { radius / 2 } else { radius };
        for row in 0..120 {
            for column in 0..150 {
                let (dx, dy) = (i64::from(column) - x, i64::from(row) - y);
                if dx * dx + dy * dy <= radius * radius {
                    mask.put(column, row, k % 6 < 5);
                }
            }
        }
    }
    mask
}

/// How many cells of one mask are more than one cell from all of the other.
fn cells_apart(a: &Mask, b: &Mask) -> u64 {
    let near = |x: u32, y: u32| {
        let around = [-1_i32, 0, 1];
        around.iter().any(|dy| {
            around.iter().any(|dx| b.get(x.wrapping_add_signed(*dx), y.wrapping_add_signed(*dy)))
        })
    };
    (0..a.grid().rows).map(|y| a.cells(y).filter(|&x| !near(x, y)).count() as u64).sum()
}

/// Components and cycles of an axis.
fn graph_topology(axis: &MedialAxis) -> (u32, u32) {
    let n = axis.keypoints().len();
    let mut sets: Vec<u32> = (0..n as u32).collect();
    fn find(sets: &mut [u32], mut k: u32) -> u32 {
        while sets[k as usize] != k {
            sets[k as usize] = sets[sets[k as usize] as usize];
            k = sets[k as usize];
        }
        k
    }
    let mut components = n as u32;
    for path in axis.paths() {
        let (a, b) = (find(&mut sets, path.from), find(&mut sets, path.to));
        if a != b {
            sets[a as usize] = b;
            components -= 1;
        }
    }
    (components, axis.paths().len() as u32 + components - n as u32)
}

/// Blocks of two by two cells from which one can be taken without changing components and holes.
fn removable_blocks(cells: &Mask) -> usize {
    let grid = cells.grid();
    let mut found = 0;
    let whole = topology(cells);
    for y in 1..grid.rows {
        for x in cells.cells(y).filter(|&x| x > 0) {
            let block = [(x, y), (x - 1, y), (x, y - 1), (x - 1, y - 1)];
            if block.iter().all(|&(x, y)| cells.get(x, y)) {
                found += usize::from(block.iter().any(|&(x, y)| {
                    let mut without = cells.clone();
                    without.put(x, y, false);
                    topology(&without) == whole
                }));
            }
        }
    }
    found
}

#[test]
fn the_topology_is_that_of_the_mask_and_blocks_are_thin() {
    for seed in 0..1500 {
        let mask = random(seed);
        let skeleton = Skeleton::new(&mask, &Options::default()).unwrap();
        assert_eq!(topology(skeleton.cells()), topology(&mask), "{seed}");
        assert_eq!(removable_blocks(skeleton.cells()), 0, "{seed}");
        let axis = skeleton.axis().unwrap();
        let whole = topology(&mask);
        assert_eq!(graph_topology(&axis), (whole.components, whole.holes), "{seed}");
    }
}

#[test]
fn without_pruning_the_disks_are_the_mask() {
    for seed in 0..1500 {
        let mask = random(seed);
        if mask.grid().cell[0].abs() != mask.grid().cell[1].abs() {
            continue;
        }
        let unpruned = Options { residual: None, ..Options::default() };
        let axis = raster_transform(&mask, &unpruned).unwrap();
        assert_eq!(mask_of_disks(&axis, mask.grid()).unwrap(), mask, "{seed}");
        let whole = topology(&mask);
        assert_eq!(graph_topology(&axis), (whole.components, whole.holes), "{seed}");
    }
}

#[test]
fn threads_change_nothing() {
    for seed in 0..200 {
        let mask = random(seed);
        let options = Options { threads: NonZeroUsize::new(3).unwrap(), ..Options::default() };
        let alone = raster_transform(&mask, &Options::default()).unwrap();
        assert_eq!(raster_transform(&mask, &options).unwrap(), alone, "{seed}");
    }
}

#[test]
fn rows_may_be_as_long_as_there_can_be() {
    // Wide cells, so that what is nearest lies above and below; then high ones, and it lies at both ends.
    for (height, middle) in [(1.0, 32_767), (1e6, 32_767)] {
        let grid = Grid { cell: [1.0, height], ..Grid::of_image(Mask::MOST, 1) };
        let mask = Mask::new(grid, |_, _| true).unwrap();
        let skeleton = Skeleton::new(&mask, &Options::default()).unwrap();
        assert!(skeleton.cells().get(middle, 0), "{height}");
        let distance = if height == 1.0 { 0.5 } else { 32_766.5 };
        assert_eq!(skeleton.radius(middle, 0), Some(distance));
        assert_eq!(topology(skeleton.cells()), topology(&mask));
    }
}

#[test]
fn bands_of_rows_change_neither_topology_nor_distances_nor_what_disks_cover() {
    for seed in 0..600 {
        let mask = random(seed);
        let band_rows = Some(1 + seed as u32 % 7);
        let options = Options { band_rows, ..Options::default() };
        let skeleton = Skeleton::new(&mask, &options).unwrap();
        let whole = topology(&mask);
        assert_eq!(topology(skeleton.cells()), whole, "{seed}");
        assert_eq!(removable_blocks(skeleton.cells()), 0, "{seed}");
        let at_once = Skeleton::new(&mask, &Options::default()).unwrap();
        for y in 0..mask.grid().rows {
            for x in mask.cells(y) {
                assert_eq!(skeleton.foot(x, y), at_once.foot(x, y), "{seed}: ({x}, {y})");
            }
        }
        let axis = skeleton.axis().unwrap();
        assert_eq!(graph_topology(&axis), (whole.components, whole.holes), "{seed}");
        if mask.grid().cell[0].abs() == mask.grid().cell[1].abs() {
            let all = Options { residual: None, ..options };
            let axis = raster_transform(&mask, &all).unwrap();
            assert_eq!(mask_of_disks(&axis, mask.grid()).unwrap(), mask, "{seed}");
        }
    }
}

#[test]
fn bands_give_what_one_band_gives_of_a_shape_that_is_thick_enough() {
    // Everything that holds these together is above the residual.
    for seed in 0..40 {
        let mask = blobs(seed);
        let at_once = Skeleton::new(&mask, &Options::default()).unwrap();
        for band_rows in [5, 16, 37] {
            let options = Options { band_rows: Some(band_rows), ..Options::default() };
            let in_bands = Skeleton::new(&mask, &options).unwrap();
            let apart = cells_apart(at_once.cells(), in_bands.cells());
            assert!(apart * 50 <= at_once.cells().count(), "{seed}, {band_rows}: {apart}");
        }
    }
}

#[test]
fn sites_are_edges_of_the_outline_and_radii_their_distances() {
    for seed in 0..400 {
        let mask = random(seed);
        let polygons = outline(&mask);
        if polygons.is_empty() {
            continue;
        }
        let domain = Domain::from_polygons(&polygons, &domain::Options::default()).unwrap();
        let axis = raster_transform(&mask, &Options::default()).unwrap();
        let verdict = check::defects(&domain, &axis);
        // Where cells touch at corners the mask holds together, and the inside of its outline does not.
        let whole = topology(&mask);
        let cut = domain.n_components() as u32 != whole.components
            || domain.walks().len() as u32 - domain.n_components() as u32 != whole.holes;
        let defects: Vec<_> = verdict
            .defects
            .iter()
            .filter(|defect| !(cut && matches!(defect, check::Defect::Identity(_))))
            .collect();
        assert!(defects.is_empty(), "{seed}: {defects:?}");
    }
}

#[test]
fn known_masks() {
    let axis = |columns: u32, rows: u32, is_inside: &dyn Fn(u32, u32) -> bool| {
        let mask = Mask::new(Grid::of_image(columns, rows), is_inside).unwrap();
        raster_transform(&mask, &Options::default()).unwrap()
    };
    // Nothing at all, nothing in it, one cell, a checkerboard that holds together at corners.
    assert_eq!(axis(0, 0, &|_, _| true).keypoints().len(), 0);
    assert_eq!(axis(5, 5, &|_, _| false).keypoints().len(), 0);
    let one = axis(1, 1, &|_, _| true);
    assert_eq!((one.keypoints().len(), one.paths().len()), (1, 0));
    assert_eq!(one.keypoints().at(0).radius, 0.5);
    let board = axis(9, 9, &|x, y| (x + y) % 2 == 0);
    assert_eq!(graph_topology(&board), (1, 24));
    // A disk has a point in the middle, or a few around it.
    let disk = axis(41, 41, &|x, y| (x as i32 - 20).pow(2) + (y as i32 - 20).pow(2) <= 400);
    let middle = Point::new(20.5, -20.5);
    assert!(disk.keypoints().iter().all(|k| (k.position - middle).norm() < 2.5), "{disk:?}");
    // A ring is a closed loop without ends.
    let ring = axis(60, 60, &|x, y| {
        let squared = (x as i32 - 30).pow(2) + (y as i32 - 30).pow(2);
        (200..=700).contains(&squared)
    });
    assert_eq!(graph_topology(&ring), (1, 1));
    assert!(ring.keypoints().iter().all(|k| k.kind == KeypointKind::Transition));
    // A bar of odd height: its middle row with the radius of half its height, and the way to its corners.
    let bar = axis(60, 11, &|_, _| true);
    let count = |kind| bar.keypoints().iter().filter(|k| k.kind == kind).count();
    assert_eq!((count(KeypointKind::Tip), count(KeypointKind::Junction)), (4, 2));
    assert!(
        bar.keypoints().iter().any(|k| k.radius == 5.5 && k.position == Point::new(30.5, -5.5))
    );
}

#[test]
fn a_domain_keeps_its_elements() {
    let corners = [(0., 0.), (8., 0.), (8., 3.), (3., 3.), (3., 8.), (0., 8.)];
    let ring = corners.map(|(x, y)| Point::new(x, y)).to_vec();
    let domain = Domain::from_polygons(&[vec![ring]], &domain::Options::default()).unwrap();
    let options = Options { cell: Some(0.05), ..Options::default() };
    let axis = raster_transform_of_domain(&domain, &options).unwrap();
    let verdict = check::defects(&domain, &axis);
    assert!(verdict.defects.is_empty(), "{:?}", verdict.defects);
    // The reflex corner governs the middle of the way round it.
    let corner = Point::new(3.0, 3.0);
    assert!(axis.sites().iter().any(|site| site.a == corner && site.b == corner));
}
