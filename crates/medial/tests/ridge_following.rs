//! Ridge following: what the report says it does, and what was wrong or wanting in it.

mod support;

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use medial::axis::{Accuracy, Engine, KeypointKind, MedialAxis, Side};
use medial::check;
use medial::domain::{Curves, Domain, Piece, PieceEnd};
use medial::engine::{
    EngineError, Options, RidgeAxis, RidgeOptions, RidgePairs, RidgePixel, RidgeSearch,
    RidgeThinning, both_sides, exterior, interior, of_mask, path_tracing, ridge_following,
    ridge_following_of_mask,
};
use medial::geom::Point;
use medial::raster::{Grid, Mask, topology};
use support::random::{Random, random_domains};
use support::shapes;

fn cells(cell: f64) -> Options<'static> {
    Options { cell: Some(cell), ..Options::default() }
}

fn ridges(domain: &Domain, cell: f64) -> RidgeAxis {
    ridge_following(domain, &RidgeOptions::default(), &cells(cell)).unwrap()
}

fn with(domain: &Domain, cell: f64, ridge: &RidgeOptions<'_>) -> RidgeAxis {
    ridge_following(domain, ridge, &cells(cell)).unwrap()
}

/// A cell with about so many of them along the longer side of a domain.
fn cell_of(domain: &Domain, n: f64) -> f64 {
    let bounds = domain.bounds();
    (bounds.max.x - bounds.min.x).max(bounds.max.y - bounds.min.y) / n
}

/// The distance of a point from the boundary.
fn boundary_distance(domain: &Domain, p: Point) -> f64 {
    let distance = |edge: u32| {
        let (a, b) = (domain.edge(edge).start, domain.end(edge));
        let share = ((p - a).dot(b - a) / (b - a).norm2()).clamp(0.0, 1.0);
        (a + (b - a) * share - p).norm()
    };
    (0..domain.edges().len() as u32).map(distance).fold(f64::INFINITY, f64::min)
}

/// The first defect of a radius.
fn wrong_radius(domain: &Domain, axis: &MedialAxis) -> Option<check::Defect> {
    let is_radius = |d: &check::Defect| matches!(d, check::Defect::SampledRadius { .. });
    check::defects(domain, axis).defects.into_iter().find(is_radius)
}

fn places(pixels: &[RidgePixel]) -> BTreeSet<(u32, u32)> {
    pixels.iter().map(|pixel| (pixel.row, pixel.column)).collect()
}

/// The largest distance of a pixel from the exact axis, in cells.
fn off_the_axis(domain: &Domain, found: &RidgeAxis) -> f64 {
    let axis = path_tracing(domain).unwrap();
    let samples: Vec<Point> = axis
        .paths()
        .iter()
        .flat_map(|path| {
            let (a, b) = (axis.keypoints().at(path.from), axis.keypoints().at(path.to));
            (0..=400).map(move |k| a.position + (b.position - a.position) * (f64::from(k) / 400.0))
        })
        .collect();
    let cell = found.grid.cell_size();
    let off = |pixel: &RidgePixel| {
        let all = samples.iter().map(|&p| (p - pixel.position).norm());
        all.fold(f64::INFINITY, f64::min) / cell
    };
    found.pixels.iter().map(off).fold(0.0, f64::max)
}

#[test]
fn axes_of_lines_are_found_within_a_cell() {
    // All paths are straight; one of the L is not, but short.
    for (name, n, most) in [
        ("rectangle_5_by_2", 100.0, 1.5),
        ("square_of_side_2", 81.0, 1.5),
        ("triangle_3_4_5", 90.0, 2.5),
        ("l_with_unit_arms", 80.0, 4.0),
        ("square_ring_6_around_2", 90.0, 4.0),
    ] {
        let domain = shapes::domain(name);
        let found = ridges(&domain, cell_of(&domain, n));
        let off = off_the_axis(&domain, &found);
        assert!(off <= most, "{name}: {off}");
        assert_eq!(found.n_components, 1, "{name}");
        let axis = &found.axis;
        assert!(!axis.complete, "{name}");
        assert_eq!((axis.engine, axis.side), (Engine::RidgeFollowing, Side::Interior));
        assert_eq!(axis.accuracy, Accuracy::Sampled(found.grid.cell_size()));
        let verdict = check::defects(&domain, axis);
        assert!(verdict.defects.is_empty(), "{name}: {:?}", &verdict.defects[..1]);
        assert_eq!(verdict.counts.cycles, usize::from(name.starts_with("square_ring")));
    }
}

#[test]
fn a_rectangle_has_a_spine_and_four_ends() {
    let domain = shapes::domain("rectangle_5_by_2");
    // Centres of cells lie in the middle.
    let found = ridges(&domain, 2.0 / 41.0);
    let spine = found.pixels.iter().filter(|p| 1.1 < p.position.x && p.position.x < 3.9);
    assert!(spine.clone().count() > 50);
    for pixel in spine {
        assert!((pixel.position.y - 1.0).abs() < 1e-12, "{pixel:?}");
        assert!((pixel.radius - 1.0).abs() < 1e-12 && pixel.quality < 1e-12, "{pixel:?}");
    }
    let count = |kind| found.axis.keypoints().iter().filter(|k| k.kind == kind).count();
    assert_eq!((count(KeypointKind::Tip), count(KeypointKind::Junction)), (4, 2));
    assert!(found.n_found > found.pixels.len());
}

#[test]
fn pixels_come_row_by_row_and_are_medial() {
    let domain = shapes::domain("t_of_unit_bars");
    let cell = cell_of(&domain, 70.0);
    let found = ridges(&domain, cell);
    let place = |p: &RidgePixel| (p.row, p.column);
    assert!(found.pixels.is_sorted_by_key(place));
    let by_height = |a: &RidgePixel, b: &RidgePixel| {
        (a.position.y, a.position.x) <= (b.position.y, b.position.x)
    };
    assert!(found.pixels.windows(2).all(|pair| by_height(&pair[0], &pair[1])));
    for pixel in &found.pixels {
        assert_eq!(found.grid.centre(pixel.column, pixel.row), pixel.position);
        let distance = boundary_distance(&domain, pixel.position);
        assert!((distance - pixel.radius).abs() <= 1e-9, "{pixel:?} {distance}");
        assert!(0.0 <= pixel.quality && pixel.quality <= cell * 1.000_001);
    }
}

#[test]
fn every_shape_gives_an_axis() {
    let mut judged = 0;
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        let cell = cell_of(&domain, 64.0);
        match ridge_following(&domain, &RidgeOptions::default(), &cells(cell)) {
            Ok(found) => {
                let verdict = check::defects(&domain, &found.axis);
                // Cells are too coarse for some, which fall apart or lose holes.
                judged += usize::from(verdict.defects.is_empty());
                eprintln!("{name}: {:?}", verdict.defects.first());
                assert_eq!(wrong_radius(&domain, &found.axis), None, "{name}");
                let axis = interior(&domain, Engine::RidgeFollowing, &cells(cell)).unwrap();
                assert_eq!(axis, found.axis, "{name}");
            }
            Err(EngineError::Cells(_)) => {}
            Err(error) => panic!("{name}: {error}"),
        }
    }
    assert!(judged >= 20, "{judged}");
}

#[test]
fn every_search_but_the_six_vertices_gives_the_same() {
    let mut compared = 0;
    for (seed, domain) in random_domains(60) {
        let cell = cell_of(&domain, 60.0);
        for pairs in [RidgePairs::Linked, RidgePairs::Adjacent] {
            let thinning = RidgeThinning::Full;
            let of = |search| {
                let ridge = RidgeOptions { search, pairs, thinning, ..RidgeOptions::default() };
                with(&domain, cell, &ridge)
            };
            let (tree, sorted) = (of(RidgeSearch::Tree), of(RidgeSearch::Sorted));
            assert_eq!(tree.pixels, sorted.pixels, "{seed}");
            assert_eq!(tree.axis, sorted.axis, "{seed}");
            assert_eq!((tree.n_components, tree.n_tested), (sorted.n_components, sorted.n_tested));
            compared += 1;
        }
    }
    assert!(compared > 60, "{compared}");
}

/// A shape as in Fig. 17: of nine corners those at both ends of the nearest edge, FG, are the farthest.
const FIG_17: &str =
    "POLYGON ((-10 0, 10 0, 2.5 0.8, 2.5 2, 2 3.5, 0 12, -2 3.5, -2.5 2, -2.5 0.8))";

#[test]
fn six_vertices_are_not_enough() {
    let domain = shapes::wkt(FIG_17);
    // P, the centre of a cell: one from FG, two and a half from HI and DE.
    let (p, cell) = (Point::new(0.0, 1.0), 0.4);
    let of = |search| {
        let thinning = RidgeThinning::Full;
        let ridge = RidgeOptions { search, thinning, ..RidgeOptions::default() };
        let grid_options = cells(cell);
        ridge_following(&domain, &ridge, &grid_options).unwrap()
    };
    let near = |found: &RidgeAxis| {
        found
            .pixels
            .iter()
            .filter(|pixel| (pixel.position - p).norm() < 0.3)
            .copied()
            .collect::<Vec<_>>()
    };
    let (tree, sorted) = (of(RidgeSearch::Tree), of(RidgeSearch::Sorted));
    let six = of(RidgeSearch::SixVertices);
    assert!(near(&tree).is_empty() && near(&sorted).is_empty());
    let wrong = near(&six);
    assert!(!wrong.is_empty());
    // It takes the distance of HI and DE for the radius.
    for pixel in wrong {
        let distance = boundary_distance(&domain, pixel.position);
        assert!(pixel.radius > 2.0 && distance < 1.3, "{pixel:?} {distance}");
    }
    let is_wrong = |found: &RidgeAxis| wrong_radius(&domain, &found.axis).is_some();
    assert!(!is_wrong(&tree) && !is_wrong(&sorted) && is_wrong(&six));
}

/// Blocks of two by two pixels, and how many of them have one that could go.
fn blocks(pixels: &[RidgePixel]) -> (usize, usize) {
    let all = places(pixels);
    let has = |row: u32, column: u32| all.contains(&(row, column));
    let is_simple = |row: u32, column: u32| {
        let around = [(0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1)];
        let mut ring = around.map(|(dy, dx): (i32, i32)| {
            has(row.wrapping_add_signed(dy), column.wrapping_add_signed(dx))
        });
        for k in (1..8).step_by(2) {
            ring[k] |= ring[k - 1] && ring[(k + 1) % 8];
        }
        let falls = (0..8).filter(|&k| ring[k] && !ring[(k + 1) % 8]).count();
        falls == 1 && ring.iter().filter(|set| **set).count() > 2
    };
    let mut counts = (0, 0);
    for &(row, column) in &all {
        let block = [(row, column), (row, column + 1), (row + 1, column), (row + 1, column + 1)];
        if block.iter().all(|&(row, column)| has(row, column)) {
            counts.0 += 1;
            counts.1 += usize::from(block.iter().any(|&(row, column)| is_simple(row, column)));
        }
    }
    counts
}

fn fixture(name: &str) -> Domain {
    let path = format!("{}/../../fixtures/{name}.wkt", env!("CARGO_MANIFEST_DIR"));
    shapes::wkt(&std::fs::read_to_string(path).unwrap())
}

#[test]
fn the_queue_leaves_no_block_that_could_be_thinner() {
    for name in ["glyph", "logo"] {
        let domain = fixture(name);
        let cell = cell_of(&domain, 250.0);
        let of = |thinning| with(&domain, cell, &RidgeOptions { thinning, ..Default::default() });
        let (full, report) = (of(RidgeThinning::Full), of(RidgeThinning::Report));
        let queue = of(RidgeThinning::Queue);
        assert_eq!(blocks(&queue.pixels).1, 0, "{name}");
        assert!(blocks(&report.pixels).1 > 20, "{name}: {:?}", blocks(&report.pixels));
        let verdict = check::defects(&domain, &queue.axis);
        assert!(verdict.defects.is_empty(), "{name}: {:?}", verdict.defects[0]);
        let sizes = [&queue, &report, &full].map(|found| found.pixels.len());
        assert!(sizes.is_sorted_by(|a, b| a < b), "{name}: {sizes:?}");
        assert_eq!(full.n_found, full.pixels.len());
        let all = places(&full.pixels);
        let verdict = check::defects(&domain, &queue.axis);
        assert!(verdict.defects.is_empty(), "{name}: {:?}", verdict.defects[0]);
        let before = topology_of(&full.pixels, &full.grid);
        assert!(places(&report.pixels).is_subset(&all));
        assert_eq!(topology_of(&report.pixels, &report.grid), before, "{name}");
        assert_eq!(topology_of(&queue.pixels, &queue.grid).components, before.components);
        assert_eq!(wrong_radius(&domain, &report.axis), None, "{name}");
    }
}

fn topology_of(pixels: &[RidgePixel], grid: &Grid) -> medial::raster::Topology {
    let mut mask = Mask::empty(*grid).unwrap();
    pixels.iter().for_each(|pixel| mask.put(pixel.column, pixel.row, true));
    topology(&mask)
}

#[test]
fn five_by_five_leaves_single_points_of_better_quality() {
    let domain = shapes::domain("comb_with_three_unit_teeth");
    let cell = cell_of(&domain, 120.0);
    let thinning = RidgeThinning::FiveByFive;
    let found = with(&domain, cell, &RidgeOptions { thinning, ..Default::default() });
    let full =
        with(&domain, cell, &RidgeOptions { thinning: RidgeThinning::Full, ..Default::default() });
    assert!(found.pixels.len() > 20);
    for (k, a) in found.pixels.iter().enumerate() {
        for b in &found.pixels[k + 1..] {
            let far = a.row.abs_diff(b.row).max(a.column.abs_diff(b.column));
            assert!(far > 2, "{a:?} {b:?}");
        }
        let place = |p: &&RidgePixel| (p.row, p.column) == (a.row, a.column);
        let before = full.pixels.iter().find(place).unwrap();
        assert!(a.quality <= before.quality);
        let off = a.position - before.position;
        assert!(off.x.abs().max(off.y.abs()) < 0.5 * cell);
        let distance = boundary_distance(&domain, a.position);
        assert!((distance - a.radius).abs() < 1e-9);
    }
    // Every pixel lost one within its square.
    let kept = places(&found.pixels);
    for pixel in &full.pixels {
        let near = |&(row, column): &(u32, u32)| {
            row.abs_diff(pixel.row).max(column.abs_diff(pixel.column)) <= 2
        };
        assert!(kept.iter().any(near), "{pixel:?}");
    }
    assert!(!found.axis.complete && found.axis.paths().is_empty());
    assert_eq!(wrong_radius(&domain, &found.axis), None);
}

#[test]
fn nothing_lies_between_edges_around_a_chain_of_concave_vertices() {
    // A square with a round hole of 240 edges.
    let hole: Vec<String> = (0..=240)
        .map(|k| f64::from(k % 240) * TAU / 240.0)
        .map(|t| format!("{} {}", 5.0 + 2.0 * t.cos(), 5.0 + 2.0 * t.sin()))
        .collect();
    let text = format!("POLYGON ((0 0, 10 0, 10 10, 0 10), ({}))", hole.join(", "));
    let domain = shapes::wkt(&text);
    let of = |pairs| {
        let thinning = RidgeThinning::Full;
        let angle = Some(0.0);
        with(&domain, 0.05, &RidgeOptions { pairs, thinning, angle, ..Default::default() })
    };
    let (linked, adjacent) = (of(RidgePairs::Linked), of(RidgePairs::Adjacent));
    // Next to the hole nothing is medial; in the report all of it is.
    let beside = |found: &RidgeAxis| {
        let middle = Point::new(5.0, 5.0);
        found.pixels.iter().filter(|p| (p.position - middle).norm() < 2.4).count()
    };
    assert_eq!(beside(&linked), 0);
    assert!(beside(&adjacent) > 1000, "{}", beside(&adjacent));
    let found = ridges(&domain, 0.05);
    let verdict = check::defects(&domain, &found.axis);
    assert!(verdict.defects.is_empty(), "{:?}", verdict.defects[0]);
    assert_eq!((found.n_components, verdict.counts.cycles), (1, 1));
}

#[test]
fn a_gap_thinner_than_a_cell_makes_no_ridge() {
    let domain = shapes::wkt(
        "MULTIPOLYGON (((0 0, 4 0, 4.2 2, 4 4, 0 4)), ((8 0, 8 4, 4.01 4, 4.21 2, 4.01 0)))",
    );
    let found = ridges(&domain, 0.05);
    assert_eq!(found.n_components, 2);
    let beside =
        |p: &&RidgePixel| (p.position.y - 1.0).abs() < 0.3 && (p.position.x - 4.1).abs() < 0.5;
    assert_eq!(found.pixels.iter().filter(beside).count(), 0);
    assert!(check::defects(&domain, &found.axis).defects.is_empty());
}

#[test]
fn necks_thinner_than_a_pixel_part_the_medial_pixels() {
    // Two squares and a neck of a fifth of a cell.
    let domain = shapes::wkt(
        "POLYGON ((0 0, 4 0, 4 1.99, 8 1.99, 8 0, 12 0, 12 4, 8 4, 8 2.01, 4 2.01, 4 4, 0 4))",
    );
    let found = ridges(&domain, 0.1);
    assert!(found.n_components >= 2, "{}", found.n_components);
    let [left, right] =
        [3.0, 9.0].map(|x| found.pixels.iter().any(|p| (p.position.x - x).abs() < 0.2));
    assert!(left && right);
    // The judge tells as well.
    assert!(!check::defects(&domain, &found.axis).defects.is_empty());
    assert_eq!(wrong_radius(&domain, &found.axis), None);
}

#[test]
fn outside_a_notch_sends_a_ridge_to_the_border_of_the_array() {
    let domain = shapes::domain("l_with_unit_arms");
    let bounds = domain.bounds();
    let axis = exterior(&domain, Engine::RidgeFollowing, Some(1.0), &cells(0.05)).unwrap();
    assert_eq!((axis.side, axis.engine), (Side::Exterior, Engine::RidgeFollowing));
    let clipped: Vec<_> =
        axis.keypoints().iter().filter(|k| k.kind == KeypointKind::Clipped).collect();
    assert_eq!(clipped.len(), 1);
    let both = both_sides(&domain, Engine::RidgeFollowing, Some(1.0), &cells(0.05)).unwrap();
    assert_eq!(both, [ridges(&domain, 0.05).axis, axis.clone()]);
    let last = clipped[0].position - bounds.max;
    assert!((last.x - 1.0).abs() < 0.06 && (last.y - 1.0).abs() < 0.06, "{last:?}");
    let verdict = check::defects(&domain, &axis);
    assert!(verdict.defects.is_empty(), "{:?}", verdict.defects[0]);
}

#[test]
fn outside_every_hole_has_ridges_and_a_convex_polygon_none() {
    let side = Side::Exterior;
    let ridge = RidgeOptions { side, margin: Some(0.5), ..RidgeOptions::default() };
    let square = shapes::domain("square_of_side_2");
    let found = with(&square, 0.05, &ridge);
    assert_eq!((found.pixels.len(), found.n_components, found.n_tested), (0, 0, 0));
    let lattice = shapes::domain("lattice_of_four_square_holes");
    let found = with(&lattice, cell_of(&lattice, 100.0), &ridge);
    assert_eq!(found.n_components, 4);
    let verdict = check::defects(&lattice, &found.axis);
    assert!(verdict.defects.is_empty(), "{:?}", verdict.defects[0]);
    assert_eq!(verdict.counts.axis_components, 4);
}

#[test]
fn all_shapes_have_an_outside() {
    let mut judged = 0;
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        let cell = cell_of(&domain, 60.0);
        match exterior(&domain, Engine::RidgeFollowing, None, &cells(cell)) {
            Ok(axis) => {
                assert_eq!(wrong_radius(&domain, &axis), None, "{name}");
                let verdict = check::defects(&domain, &axis);
                judged += usize::from(verdict.defects.is_empty());
                eprintln!("{name}: {:?}", verdict.defects.first());
            }
            Err(EngineError::Cells(_)) => {}
            Err(error) => panic!("{name}: {error}"),
        }
    }
    assert!(judged >= 20, "{judged}");
}

/// An ellipse as a polygon with its curves, four quarters, and its domain.
fn ellipse(a: f64, b: f64, n: u32) -> (Domain, Curves) {
    let end = |t: f64| {
        let way = Point::new(-a * t.sin(), b * t.cos());
        PieceEnd { tangent: way * way.norm().recip(), curvature: a * b / way.norm().powi(3) }
    };
    let quarter = |k: u32| f64::from(k) * 0.5 * PI;
    let pieces = (0..4).map(|k| Piece { start: end(quarter(k)), end: end(quarter(k + 1)) });
    let at = |k: u32| f64::from(k) * TAU / f64::from(4 * n);
    let points: Vec<Point> =
        (0..4 * n).map(|k| Point::new(a * at(k).cos(), b * at(k).sin())).collect();
    let edges = (0..4 * n).map(|k| k / n).collect();
    let curves = Curves { tolerance: 0.01, pieces: pieces.collect(), edges: vec![vec![edges]] };
    (shapes::of(&[vec![points]]).unwrap(), curves)
}

#[test]
fn curves_make_no_branches() {
    // A circle has its centre, and nothing else within a cell.
    let (domain, curves) = ellipse(5.0, 5.0, 40);
    let ridge = RidgeOptions { curves: Some(&curves), ..RidgeOptions::default() };
    let cell = 0.1;
    let found = with(&domain, cell, &ridge);
    assert!(!found.pixels.is_empty());
    assert!(found.pixels.iter().all(|p| p.position.norm() < 2.0 * cell), "{:?}", found.pixels);
    let without = ridges(&domain, cell);
    assert!(without.n_found > 50 * found.n_found, "{} {}", without.n_found, found.n_found);

    // An ellipse has the line between the centres of curvature of its ends.
    let (a, b) = (6.0, 3.0);
    let (domain, curves) = ellipse(a, b, 60);
    let ridge = RidgeOptions { curves: Some(&curves), ..RidgeOptions::default() };
    let found = with(&domain, 0.05, &ridge);
    let end = a - b * b / a;
    let ends = found
        .pixels
        .iter()
        .map(|p| p.position.x)
        .fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    assert!((ends.1 - end).abs() < 0.5 && (ends.0 + end).abs() < 0.5, "{ends:?} {end}");
    assert!(found.pixels.iter().all(|p| p.position.y.abs() < 0.3));
    assert_eq!(found.n_components, 1);
    assert!(check::defects(&domain, &found.axis).defects.is_empty());
}

#[test]
fn small_masks_are_no_trouble() {
    let of = |columns: u32, rows: u32, is_inside: &dyn Fn(u32, u32) -> bool| {
        let mask = Mask::new(Grid::of_image(columns, rows), is_inside).unwrap();
        for thinning in RidgeThinning::ALL.iter().copied() {
            for search in RidgeSearch::ALL.iter().copied() {
                let ridge = RidgeOptions { thinning, search, ..RidgeOptions::default() };
                let found = ridge_following_of_mask(&mask, &ridge, &Options::default()).unwrap();
                assert!(found.pixels.iter().all(|p| mask.get(p.column, p.row)));
            }
        }
        let found = ridge_following_of_mask(&mask, &RidgeOptions::default(), &Options::default());
        found.unwrap()
    };
    assert_eq!(of(0, 0, &|_, _| true).pixels.len(), 0);
    assert_eq!(of(5, 4, &|_, _| false).pixels.len(), 0);
    let one = of(1, 1, &|_, _| true);
    assert_eq!((one.pixels.len(), one.pixels[0].radius), (1, 0.5));
    let full = of(21, 11, &|_, _| true);
    assert!(full.pixels.iter().any(|p| (p.radius - 5.5).abs() < 1e-9));
    let board = of(8, 8, &|x, y| (x + y) % 2 == 0);
    assert!(board.n_components >= 1);
}

#[test]
fn masks_are_followed_like_domains() {
    // An L of cells, and the same with rows from the top and cells half as high as wide.
    let is_inside = |x: u32, y: u32| x < 20 || y < 20;
    let image = Mask::new(Grid::of_image(60, 60), is_inside).unwrap();
    let map = Grid { origin: Point::new(7.0, 3.0), cell: [1.0, -0.5], columns: 60, rows: 60 };
    let map = Mask::new(map, is_inside).unwrap();
    for mask in [image, map] {
        let found =
            ridge_following_of_mask(&mask, &RidgeOptions::default(), &Options::default()).unwrap();
        assert_eq!(found.n_edges, 6);
        let axis = of_mask(&mask, Engine::RidgeFollowing, &Options::default()).unwrap();
        assert_eq!(axis, found.axis);
        let outline = shapes::of(&medial::raster::outline(&mask)).unwrap();
        let verdict = check::defects(&outline, &found.axis);
        assert!(verdict.defects.is_empty(), "{:?}", verdict.defects[0]);
        let exterior = RidgeOptions { side: Side::Exterior, ..RidgeOptions::default() };
        let refused = ridge_following_of_mask(&mask, &exterior, &Options::default()).unwrap_err();
        assert_eq!(refused, EngineError::NoExterior { engine: Engine::RidgeFollowing });
    }
}

#[test]
fn stairs_of_a_mask_do_not_flood_it() {
    // A bar turned by 20 degrees.
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let mask = Mask::new(Grid::of_image(200, 200), |x, y| {
        let (x, y) = (f64::from(x) - 100.0, f64::from(y) - 100.0);
        (x * cos + y * sin).abs() < 80.0 && (y * cos - x * sin).abs() < 20.0
    })
    .unwrap();
    let found =
        ridge_following_of_mask(&mask, &RidgeOptions::default(), &Options::default()).unwrap();
    // The axis is 120 long, and four times 28.
    let share = found.n_found as f64 / mask.count() as f64;
    assert!(share < 0.12, "{share}");
    assert!(found.n_edges < 40, "{}", found.n_edges);
    let outline = shapes::of(&medial::raster::outline(&mask)).unwrap();
    let verdict = check::defects(&outline, &found.axis);
    assert!(verdict.defects.is_empty(), "{:?}", verdict.defects[0]);
}

#[test]
fn random_masks_have_true_radii() {
    for seed in 1..400 {
        let mut random = Random(seed);
        let (columns, rows) = (1 + random.below(24) as u32, 1 + random.below(24) as u32);
        let fill = random.below(101);
        // Noise, and some disks.
        let disks: Vec<[f64; 3]> = (0..seed % 2 * (1 + seed % 5))
            .map(|_| [random.unit() * 24.0, random.unit() * 24.0, 1.0 + random.unit() * 8.0])
            .collect();
        let mask = Mask::new(Grid::of_image(columns, rows), |x, y| {
            let is_in = |&[u, v, r]: &[f64; 3]| (f64::from(x) - u).hypot(f64::from(y) - v) < r;
            if seed.is_multiple_of(2) { random.below(100) < fill } else { disks.iter().any(is_in) }
        })
        .unwrap();
        let found =
            ridge_following_of_mask(&mask, &RidgeOptions::default(), &Options::default()).unwrap();
        assert!(found.pixels.iter().all(|p| mask.get(p.column, p.row)));
        let polygons = medial::raster::outline(&mask);
        let Ok(outline) = shapes::of(&polygons) else { continue };
        assert_eq!(wrong_radius(&outline, &found.axis), None, "{seed}");
    }
}

#[test]
fn limits_end_it() {
    let domain = shapes::domain("star_with_108_corners_on_one_circle");
    let late = Options { deadline: Some(Instant::now()), ..cells(cell_of(&domain, 100.0)) };
    let of = |options: &Options<'_>| ridge_following(&domain, &RidgeOptions::default(), options);
    assert_eq!(of(&late).unwrap_err(), EngineError::TimeLimit);
    let cancel = AtomicBool::new(true);
    let cancelled = Options { cancel: Some(&cancel), ..cells(cell_of(&domain, 100.0)) };
    assert_eq!(of(&cancelled).unwrap_err(), EngineError::Cancelled);
    // In the middle of a search that takes far longer.
    let start = Instant::now();
    let soon = start + Duration::from_millis(20);
    let options = Options { deadline: Some(soon), ..cells(cell_of(&domain, 4000.0)) };
    assert_eq!(of(&options).unwrap_err(), EngineError::TimeLimit);
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    assert!(matches!(of(&cells(0.0)), Err(EngineError::Cells(_))));
}

#[test]
fn phases_are_timed() {
    let domain = shapes::domain("plus_of_unit_squares");
    let start = Instant::now();
    let times = ridges(&domain, cell_of(&domain, 200.0)).times;
    let all = [times.initialise, times.first, times.follow, times.scan, times.thin, times.assemble];
    assert!(all.iter().all(|time| *time > Duration::ZERO), "{times:?}");
    assert!(all.iter().sum::<Duration>() <= start.elapsed());
}
