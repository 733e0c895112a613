//! Times other libraries written in Rust, on the shapes that `medial-bench draw` prints.
//!
//! `rivals NAME` reads shapes and prints one line, as `medial_bench::measure` describes. The names:
//!
//! - `boostvoronoi`: the Voronoi diagram of the edges, then the walk that drops what lies outside;
//!   coordinates are rounded to whole numbers. Found: Voronoi edges inside.
//! - `delaunator`: the Delaunay triangulation of the corners. Found: triangles.
//! - `spade`: the same. Found: triangles.
//! - `spade-cdt`: the Delaunay triangulation constrained to the edges. Found: triangles.
//!
//! `rivals i_overlay D,D` prints, as JSON, the areas of the outlines of `i_overlay` at these distances, inward
//! if positive, and the seconds that took without reading. `rivals raster FILE.pbm` thins a bitmap with
//! `skeletonize`, and `rivals delaunay FILE.pbm` triangulates the samples of its outline, as `delaunay_dual` takes
//! them, by turns with `medial`, `spade` and `delaunator`.

use std::{env, hint};

use boostvoronoi::prelude::{Builder, Diagram, Line};
use cpu_time::ThreadTime;
use i_overlay::mesh::outline::offset::OutlineOffset as _;
use i_overlay::mesh::style::{LineJoin, OutlineStyle};
use image::{DynamicImage, GrayImage};
use medial::geom::{Delaunay, Point, Rect, hilbert};
use medial::raster::{Grid, outline};
use medial_bench::bitmap;
use medial_bench::measure::{Error, Work, report};
use medial_bench::text::{self, Polygons};
use skeletonize::foreground::White;
use skeletonize::{MarkingMethod, thin_image_edges};
use spade::{ConstrainedDelaunayTriangulation, DelaunayTriangulation, Point2, Triangulation as _};

/// The colour of Voronoi edges outside.
const OUTSIDE: u32 = 1;

fn main() -> Result<(), Error> {
    if let (Some("raster"), Some(file)) = (env::args().nth(1).as_deref(), env::args().nth(2)) {
        return skeletonize(&file);
    }
    if let (Some("delaunay"), Some(file)) = (env::args().nth(1).as_deref(), env::args().nth(2)) {
        return delaunay(&file);
    }
    let features = text::read()?;
    match env::args().nth(1).as_deref() {
        Some("boostvoronoi") => boostvoronoi(&features),
        Some("delaunator") => delaunator(&features),
        Some("spade") => spade(&features),
        Some("spade-cdt") => spade_cdt(&features),
        Some("i_overlay") => {
            let distances = env::args().nth(2).unwrap_or_default();
            let distances =
                distances.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>()?;
            i_overlay(&features, &distances);
            Ok(())
        }
        _ => Err("rivals boostvoronoi, delaunator, spade, spade-cdt, i_overlay D,D, raster FILE.pbm or delaunay FILE.pbm".into()),
    }
}

/// Thins a bitmap after Zhang and Suen, and prints the nanoseconds a pixel as JSON.
fn skeletonize(file: &str) -> Result<(), Error> {
    let mask = bitmap::read(file)?;
    let Grid { columns, rows, .. } = *mask.grid();
    let pixel = |x, y| image::Luma([if mask.get(x, y) { 255_u8 } else { 0 }]);
    let image = DynamicImage::ImageLuma8(GrayImage::from_fn(columns, rows, pixel));
    let mut times = Vec::new();
    let begun = ThreadTime::now();
    while times.is_empty() || begun.elapsed().as_secs_f64() < 0.5 {
        let mut image = image.clone();
        let start = ThreadTime::now();
        thin_image_edges::<White>(&mut image, MarkingMethod::Standard, None)
            .map_err(|error| format!("{error:?}"))?;
        times.push(start.elapsed().as_nanos() as f64 / mask.grid().n_cells() as f64);
    }
    times.sort_by(f64::total_cmp);
    println!("{{\"ns\": {}}}", times[times.len() / 2]);
    Ok(())
}

/// The middles of the sides of cells along the outline of a bitmap, and the middles between these.
fn samples(file: &str) -> Result<Vec<Point>, Error> {
    let mut samples = Vec::new();
    for ring in outline(&bitmap::read(file)?).iter().flatten() {
        let mut middles = Vec::new();
        for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let length = (b - a).norm();
            let step = (b - a) * (1.0 / length);
            middles.extend((0..length as u32).map(|k| a + step * (f64::from(k) + 0.5)));
        }
        for (&a, &b) in middles.iter().zip(middles.iter().cycle().skip(1)) {
            samples.extend([a, (a + b) * 0.5]);
        }
    }
    Ok(samples)
}

/// Triangulates the samples of a bitmap by turns, and prints as JSON how many there are and the median
/// nanoseconds a sample.
fn delaunay(file: &str) -> Result<(), Error> {
    let samples = samples(file)?;
    let points: Vec<Point2<f64>> = samples.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let plain: Vec<delaunator::Point> =
        samples.iter().map(|p| delaunator::Point { x: p.x, y: p.y }).collect();
    let medial = || Delaunay::new(&samples).map_or(0, |triangles| triangles.n_faces() as usize);
    let incremental = || {
        let mut triangulation = DelaunayTriangulation::<Point2<f64>>::new();
        points.iter().filter(|&&point| triangulation.insert(point).is_err()).count();
        triangulation.num_inner_faces()
    };
    let bounds = samples.iter().fold(Rect::EMPTY, |all, &p| all.with(p));
    let mut sorted = samples.clone();
    sorted.sort_by_cached_key(|&p| hilbert(&bounds, p));
    let sorted: Vec<Point2<f64>> = sorted.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let along_curve = || {
        let mut triangulation = DelaunayTriangulation::<Point2<f64>>::new();
        sorted.iter().filter(|&&point| triangulation.insert(point).is_err()).count();
        triangulation.num_inner_faces()
    };
    let bulk = || {
        let triangulation = DelaunayTriangulation::<Point2<f64>>::bulk_load(points.clone());
        triangulation.map_or(0, |triangulation| triangulation.num_inner_faces())
    };
    let sweep = || delaunator::triangulate(&plain).len();
    let runs: [(&str, &dyn Fn() -> usize); 5] = [
        ("medial", &medial),
        ("spade", &incremental),
        ("spade_hilbert", &along_curve),
        ("spade_bulk", &bulk),
        ("delaunator", &sweep),
    ];
    let mut times = [const { Vec::new() }; 5];
    let begun = ThreadTime::now();
    while times[0].len() < 3 || begun.elapsed().as_secs_f64() < 3.0 {
        for ((_, run), times) in runs.iter().zip(&mut times) {
            let start = ThreadTime::now();
            hint::black_box(run());
            times.push(start.elapsed().as_nanos() as f64 / samples.len() as f64);
        }
    }
    let medians = runs.iter().zip(&mut times).map(|((name, _), times)| {
        times.sort_by(f64::total_cmp);
        format!("\"{name}\": {:.0}", times[times.len() / 2])
    });
    println!("{{\"samples\": {}, {}}}", samples.len(), medians.collect::<Vec<_>>().join(", "));
    Ok(())
}

/// The least angle of a piece of an arc that it takes, as a share of the radius.
const ANGLE: f64 = 0.01 * std::f64::consts::PI;

fn i_overlay(features: &[Polygons], distances: &[f64]) {
    let start = ThreadTime::now();
    let area = |polygons: &Polygons, distance: f64| -> f64 {
        let shapes: Vec<Vec<Vec<[f64; 2]>>> = polygons
            .iter()
            .map(|rings| {
                let ring = |(k, ring): (usize, &Vec<Point>)| {
                    let mut ring: Vec<[f64; 2]> = ring.iter().map(|p| [p.x, p.y]).collect();
                    // Outer rings counterclockwise, holes the other way.
                    if (twice_area(&ring) < 0.0) == (k == 0) {
                        ring.reverse();
                    }
                    ring
                };
                rings.iter().enumerate().map(ring).collect()
            })
            .collect();
        let style = OutlineStyle::new(-distance).line_join(LineJoin::Round(ANGLE));
        let outlines = shapes.outline_as::<i64>(&style);
        outlines.iter().flatten().map(|contour| 0.5 * twice_area(contour)).sum()
    };
    let areas: Vec<Vec<f64>> = features
        .iter()
        .map(|polygons| distances.iter().map(|&distance| area(polygons, distance)).collect())
        .collect();
    let seconds = start.elapsed().as_secs_f64();
    println!("{{\"areas\":{areas:?},\"angle\":{ANGLE},\"seconds\":{seconds}}}");
}

fn twice_area(ring: &[[f64; 2]]) -> f64 {
    let Some(&[x, y]) = ring.first() else { return 0.0 };
    let next = ring.iter().cycle().skip(1);
    let cross = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
    ring.iter().zip(next).map(cross).sum()
}

fn boostvoronoi(features: &[Polygons]) -> Result<(), Error> {
    let work = Work {
        prepare: |polygons: &Polygons| {
            let mut lines = Vec::new();
            for ring in polygons.iter().flatten() {
                for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                    let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(|v| v.round() as i32);
                    lines.push(Line::from([ax, ay, bx, by]));
                }
            }
            lines
        },
        first: |lines: Vec<Line<i32>>| Ok(Builder::default().with_segments(lines)?.build()?),
        second: |diagram: &mut Diagram| {
            diagram.color_exterior_edges(OUTSIDE);
            let inside =
                |e: &&boostvoronoi::prelude::Edge| e.is_primary() && e.get_color() & OUTSIDE == 0;
            Ok(diagram.edges().iter().filter(inside).count() / 2)
        },
        count: |_: &Diagram, found: &usize| *found,
    };
    report(features, text::edges, &work)
}

fn delaunator(features: &[Polygons]) -> Result<(), Error> {
    let work = Work {
        prepare: |polygons: &Polygons| {
            let points = polygons.iter().flatten().flatten();
            points.map(|p| delaunator::Point { x: p.x, y: p.y }).collect()
        },
        first: |points: Vec<delaunator::Point>| Ok(delaunator::triangulate(&points)),
        second: |_: &mut delaunator::Triangulation| Ok(()),
        count: |triangulation: &delaunator::Triangulation, _: &()| triangulation.len(),
    };
    report(features, text::edges, &work)
}

fn spade(features: &[Polygons]) -> Result<(), Error> {
    let work = Work {
        prepare: corners,
        first: |points| Ok(DelaunayTriangulation::bulk_load(points)?),
        second: |_: &mut DelaunayTriangulation<Point2<f64>>| Ok(()),
        count: |t: &DelaunayTriangulation<Point2<f64>>, _: &()| t.num_inner_faces(),
    };
    report(features, text::edges, &work)
}

fn spade_cdt(features: &[Polygons]) -> Result<(), Error> {
    let work = Work {
        prepare: |polygons: &Polygons| {
            let mut edges = Vec::new();
            for ring in polygons.iter().flatten() {
                let first = edges.len();
                edges.extend((first..first + ring.len() - 1).map(|k| [k, k + 1]));
                edges.push([first + ring.len() - 1, first]);
            }
            (corners(polygons), edges)
        },
        first: |(points, edges)| {
            Ok(ConstrainedDelaunayTriangulation::bulk_load_cdt(points, edges)?)
        },
        second: |_: &mut ConstrainedDelaunayTriangulation<Point2<f64>>| Ok(()),
        count: |t: &ConstrainedDelaunayTriangulation<Point2<f64>>, _: &()| t.num_inner_faces(),
    };
    report(features, text::edges, &work)
}

fn corners(polygons: &Polygons) -> Vec<Point2<f64>> {
    polygons.iter().flatten().flatten().map(|p| Point2::new(p.x, p.y)).collect()
}
