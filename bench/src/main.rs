//! Draws shapes for the comparison, and times medial on them.
//!
//! `medial-bench draw SHAPE EDGES` prints a shape, as `text` describes; `medial-bench time [ENGINE]`
//! reads shapes and prints one line, as `measure` describes, with the number of paths as what was
//! found; `medial-bench both ENGINE` does so for the interior and the exterior together;
//! `medial-bench operation NAME` times the default engine and an operation on its axis;
//! `medial-bench offsets D,D` reads shapes and prints, as JSON, the areas of their parallel curves with the
//! areas of the sectors of their arcs, their lengths, and the seconds that took without reading;
//! `medial-bench axis SHAPE EDGES` computes the axis of a shape once, for counting
//! instructions in `medial_bench_domain` and `medial_bench_engine`; `medial-bench work SHAPE EDGES`
//! prints the numbers of edges and rings, and what the merges of `divide_and_conquer` did: pieces,
//! arcs, starts; `medial-bench raster FILE.pbm [BAND_ROWS]` times the raster transform of a bitmap,
//! and `medial-bench skeleton FILE.pbm TARGET.pbm [none]` writes its medial cells;
//! `medial-bench ridge` runs the experiments of the report on ridge following, as `ridge` describes,
//! `medial-bench dual FILE.pbm` times `delaunay_dual` on a bitmap, `medial-bench spacing FILE.pbm` and
//! `medial-bench spacing SHAPE EDGES` tell how far it is from the exact axis, as `dual` describes,
//! and `medial-bench inverse FILE.pbm...` tells how well disks give bitmaps back.

use std::{env, hint};

use cpu_time::ThreadTime;
use medial::axis::{Engine, MedialAxis};
use medial::domain::{Domain, DomainError, Options};
use medial::engine::{
    self, EngineError, RidgeSearch, Skeleton, both_sides, divide_and_conquer_counted, exterior,
    interior,
};
use medial::geom::Point;
use medial::ops::{
    CenterlineOptions, Hierarchy, Measure, Outline, OutlinePiece, branches, centerlines,
    offset_margin, offsets, polygons_of, smoothed,
};
use medial::raster::Grid;
use medial_bench::measure::{Error, Work, peak_bytes, report};
use medial_bench::{bitmap, dual, inversion, ridge, shapes, text};

fn main() -> Result<(), Error> {
    let args: Vec<String> = env::args().skip(1).collect();
    match args.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["draw", shape, edges] => draw(shape, edges.parse()?),
        ["time"] => time(Engine::PathTracing),
        ["time", engine] => time(engine.parse()?),
        ["both", engine] => both(engine.parse()?),
        ["operation", name] => operation(name),
        ["offsets", distances] => parallel_curves(distances),
        ["axis", shape, edges] => axis(shape, edges.parse()?),
        ["work", shape, edges] => work(shape, edges.parse()?),
        ["raster", file] => raster(file, None),
        ["raster", file, rows] => raster(file, Some(rows.parse()?)),
        ["ridge"] => ridges(),
        ["dual", file] => dual::bitmap(file),
        ["spacing", file] => dual::spacing_of_bitmap(file),
        ["spacing", shape, edges] => dual::spacing(shape, edges.parse()?),
        ["inverse", files @ ..] => inverses(files),
        ["skeleton", file, target] => skeleton(file, target, engine::Options::default().residual),
        ["skeleton", file, target, "none"] => skeleton(file, target, None),
        _ => {
            Err("medial-bench draw, axis or work SHAPE EDGES, time [ENGINE], both ENGINE, operation NAME or offsets D,D, ridge, inverse FILE.pbm..., dual FILE.pbm, spacing FILE.pbm, spacing SHAPE EDGES, raster FILE.pbm [BAND_ROWS] or skeleton FILE.pbm TARGET.pbm [none]".into())
        }
    }
}

fn draw(shape: &str, edges: usize) -> Result<(), Error> {
    let mut drawn = String::new();
    text::write(&mut drawn, &polygons(shape, edges)?);
    print!("{drawn}");
    Ok(())
}

fn polygons(shape: &str, edges: usize) -> Result<text::Polygons, Error> {
    let ring = |ring: shapes::Ring| ring.into_iter().map(|(x, y)| Point::new(x, y)).collect();
    let rings = shapes::draw(shape, edges).ok_or("no such shape")?;
    Ok(vec![rings.into_iter().map(ring).collect()])
}

fn time(engine: Engine) -> Result<(), Error> {
    let work = Work {
        prepare: |polygons| polygons,
        first: |polygons: &text::Polygons| Ok(medial_bench_domain(polygons)?),
        second: |domain: &mut Domain| Ok(medial_bench_engine(engine, domain)?),
        count: |_: &Domain, axis: &MedialAxis| axis.paths().len(),
    };
    report(&text::read()?, text::edges, &work)
}

fn both(engine: Engine) -> Result<(), Error> {
    let options = engine::Options::default();
    let work = Work {
        prepare: |polygons| polygons,
        first: |polygons: &text::Polygons| Ok(medial_bench_domain(polygons)?),
        second: |domain: &mut Domain| Ok(both_sides(domain, engine, None, &options)?),
        count: |_: &Domain, axes: &[MedialAxis; 2]| {
            axes.iter().map(|axis| axis.paths().len()).sum()
        },
    };
    report(&text::read()?, text::edges, &work)
}

/// Times an operation on an axis, without the domain.
fn operation(name: &str) -> Result<(), Error> {
    let work = Work {
        prepare: |polygons: &text::Polygons| medial_bench_domain(polygons),
        first: |domain: Result<Domain, DomainError>| {
            let domain = domain?;
            let axis = medial_bench_engine(Engine::PathTracing, &domain)?;
            Ok((domain, axis))
        },
        second: |(domain, axis): &mut (Domain, MedialAxis)| {
            medial_bench_operation(name, domain, axis)
        },
        count: |_: &(Domain, MedialAxis), count: &usize| *count,
    };
    report(&text::read()?, text::edges, &work)
}

/// Does an operation as a user would; gives a number of what came of it.
#[inline(never)]
fn medial_bench_operation(name: &str, domain: &Domain, axis: &MedialAxis) -> Result<usize, Error> {
    let bounds = || axis.bounds().map_or(0.0, |(low, high)| (high - low).norm());
    Ok(match name {
        "hierarchy" => Hierarchy::new(domain, axis)?.significance(Measure::Potential).paths.len(),
        "significance" => Hierarchy::new(domain, axis)?.significance(Measure::Excess).paths.len(),
        "prune" => {
            let hierarchy = Hierarchy::new(domain, axis)?;
            hierarchy.pruned(Measure::Excess, 1e-3 * bounds()).axis.paths().len()
        }
        "smooth" => smoothed(domain, axis, Measure::Prominence, 0.1)?.outline.polygons.len(),
        "branches" => branches(axis).len(),
        "reconstruct" => polygons_of(axis)?.len(),
        "outline" => Outline::new(axis)?.polygons.len(),
        "centerline" => centerlines(domain, axis, &CenterlineOptions::default())?.len(),
        "together" => {
            let hierarchy = Hierarchy::new(domain, axis)?;
            let pruned = hierarchy.pruned(Measure::Excess, 1e-3 * bounds());
            let smooth = hierarchy.smoothed(Measure::Prominence, 0.1)?;
            let lines = hierarchy.centerlines(&CenterlineOptions::default())?;
            let (branches, outline) = (branches(axis), Outline::new(axis)?);
            let polygons = polygons_of(axis)?;
            pruned.axis.paths().len()
                + smooth.outline.polygons.len()
                + lines.len()
                + branches.len()
                + outline.polygons.len()
                + polygons.len()
        }
        _ => return Err(format!("no operation {name}").into()),
    })
}

/// Times the raster transform of a bitmap, and prints, as JSON, nanoseconds a pixel of the cells and of their
/// axis, how many there are, and by how many bytes a pixel the memory grew; in bands of so many rows.
fn raster(file: &str, band_rows: Option<u32>) -> Result<(), Error> {
    let mask = bitmap::read(file)?;
    let pixels = mask.grid().n_cells() as f64;
    let options = engine::Options { band_rows, ..engine::Options::default() };
    let before = peak_bytes();
    let (mut cells, mut axes, mut found) = (Vec::new(), Vec::new(), (0, 0));
    let start = ThreadTime::now();
    let mut grown = 0.0;
    while cells.is_empty() || (start.elapsed().as_secs_f64() < 0.5 && cells.len() < 101) {
        let start = ThreadTime::now();
        let skeleton = hint::black_box(Skeleton::new(&mask, &options)?);
        cells.push(start.elapsed().as_nanos() as f64 / pixels);
        let start = ThreadTime::now();
        let axis = hint::black_box(skeleton.axis()?);
        axes.push(start.elapsed().as_nanos() as f64 / pixels);
        found = (skeleton.cells().count(), axis.keypoints().len());
        if cells.len() == 1 {
            grown = peak_bytes().saturating_sub(before) as f64 / pixels;
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let [cells, axes] = [median(&mut cells), median(&mut axes)];
    let (n_cells, n_keypoints) = found;
    println!(
        "{{\"cells_ns\": {cells:.2}, \"axis_ns\": {axes:.2}, \"cells\": {n_cells}, \
         \"keypoints\": {n_keypoints}, \"bytes\": {grown:.1}}}"
    );
    Ok(())
}

/// Prints, for each bitmap a line and for each way to its medial cells, the share of the cells that the disks have
/// in common with the mask, and that of medial cells in the mask: what is lost on the way back.
fn inverses(files: &[&str]) -> Result<(), Error> {
    for file in files {
        for found in inversion::all(&bitmap::read(file)?)? {
            let again = found.again.map_or_else(String::new, |again| again.to_string());
            let inversion::Inverse { name, common, distance, points, .. } = found;
            println!("{name}\t{common}\t{distance}\t{points}\t{again}");
        }
    }
    Ok(())
}

/// Runs the experiments of [VS87, IV] with both searches.
fn ridges() -> Result<(), Error> {
    for (experiment, first, last) in ridge::EXPERIMENTS {
        for value in first..=last {
            for search in [RidgeSearch::Sorted, RidgeSearch::Tree] {
                ridge::run(experiment, value, search)?;
            }
        }
    }
    Ok(())
}

/// Writes the medial cells of a bitmap as another one.
fn skeleton(file: &str, target: &str, residual: Option<f64>) -> Result<(), Error> {
    let mask = bitmap::read(file)?;
    let options = engine::Options { residual, ..engine::Options::default() };
    let skeleton = Skeleton::new(&mask, &options)?;
    let Grid { columns, rows, .. } = *mask.grid();
    let mut bytes = format!("P4\n{columns} {rows}\n").into_bytes();
    for y in 0..rows {
        bytes.extend(skeleton.cells().row(y).iter().map(|byte| byte.reverse_bits()));
    }
    Ok(std::fs::write(target, bytes)?)
}

/// Prints the areas of parallel curves.
fn parallel_curves(distances: &str) -> Result<(), Error> {
    let distances: Vec<f64> = distances.split(',').map(str::parse).collect::<Result<_, _>>()?;
    let features = text::read()?;
    let start = ThreadTime::now();
    let [mut areas, mut sectors, mut lengths] = [const { Vec::new() }; 3];
    for polygons in &features {
        let domain = medial_bench_domain(polygons)?;
        let mut found = vec![[0.0; 3]; distances.len()];
        for outward in [false, true] {
            let asked = || (0..).zip(&distances).filter(|(_, d)| (**d < 0.0) == outward);
            let sizes: Vec<f64> = asked().map(|(_, d)| d.abs()).collect();
            let Some(most) = sizes.iter().copied().reduce(f64::max) else { continue };
            let axis = if outward {
                let margin = Some(offset_margin(&domain, most));
                exterior(&domain, Engine::PathTracing, margin, &engine::Options::default())?
            } else {
                medial_bench_engine(Engine::PathTracing, &domain)?
            };
            for ((k, _), outline) in asked().zip(offsets(&domain, &axis, &sizes)?) {
                let k: usize = k;
                found[k] = [outline.area(), sector_area(&outline), outline.length()];
            }
        }
        for (k, list) in [&mut areas, &mut sectors, &mut lengths].into_iter().enumerate() {
            list.push(found.iter().map(|f| f[k]).collect::<Vec<f64>>());
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{{\"areas\":{areas:?},\"sectors\":{sectors:?},\"lengths\":{lengths:?},\"seconds\":{seconds}}}"
    );
    Ok(())
}

/// The area of the sectors of all arcs.
fn sector_area(outline: &Outline) -> f64 {
    let pieces = outline.polygons.iter().flat_map(|polygon| &polygon.0).flat_map(|c| &c.0);
    let area = |piece: &OutlinePiece| match piece {
        OutlinePiece::Arc { radius, .. } => 0.5 * radius * radius * piece.sweep().abs(),
        OutlinePiece::Corner(_) => 0.0,
    };
    pieces.map(area).sum()
}

fn work(shape: &str, edges: usize) -> Result<(), Error> {
    let domain = medial_bench_domain(&polygons(shape, edges)?)?;
    let (_, work) = divide_and_conquer_counted(&domain)?;
    let (edges, rings) = (domain.edges().len(), domain.walks().len());
    println!("{edges} {rings} {} {} {}", work.pieces, work.arcs, work.starts);
    Ok(())
}

/// Does once what `time` repeats.
fn axis(shape: &str, edges: usize) -> Result<(), Error> {
    let polygons = polygons(shape, edges)?;
    let domain = medial_bench_domain(&polygons)?;
    let axis = medial_bench_engine(Engine::PathTracing, &domain)?;
    println!("{} {}", text::edges(&polygons), axis.paths().len());
    hint::black_box(axis);
    Ok(())
}

// Names that a profiler can be told.

#[unsafe(no_mangle)]
#[inline(never)]
fn medial_bench_domain(polygons: &text::Polygons) -> Result<Domain, DomainError> {
    Domain::from_polygons(polygons, &Options::default())
}

#[unsafe(no_mangle)]
#[inline(never)]
fn medial_bench_engine(engine: Engine, domain: &Domain) -> Result<MedialAxis, EngineError> {
    interior(domain, engine, &engine::Options::default())
}
