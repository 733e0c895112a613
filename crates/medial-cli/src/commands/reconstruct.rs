use super::axis::pruned;
use super::features::{Run, all_processors};
use super::records::{POLYGONS, Plan};
use super::sink::boundary;
use crate::args::{Method, ReconstructArgs};
use crate::failure::{Failure, Status};
use crate::input::{Input, Opened};
use crate::output::Output;
use crate::parallel::{Limit, kept, ordered};
use crate::progress::Progress;
use crate::report::Entry;
use crate::timings::timed;
use medial::axis::{Accuracy, Engine, MedialAxis, Side};
use medial::engine::{EngineError, interior};
use medial::geom::{Point, signed_area};
use medial::ops::{
    Compressed, CompressedMask, Outline, boundary_distance, disks, polygons_of, tangent_polygons,
    union_of_disks, union_of_linked_disks, without_crossings,
};
use medial::raster::outline;
use medial_io::axis_document::AxisDocument;
use medial_io::record::{self, Record, Shape, Value};
use medial_io::{Crs, Error, Feature, Format, Json, default_tolerance, image, maxis};
use std::io::IsTerminal as _;
use std::ops::ControlFlow;

/// Points along the axis of a feature, at most.
const MOST_POINTS: f64 = 1e6;

/// What drawing may add to the error of a compressed shape, as a share of it.
const ARCS: f64 = 0.125;

const COLUMNS: &[&str] = &["method", "error", "area"];

/// `medial reconstruct`.
pub fn run(args: &'static ReconstructArgs) -> Result<Status, Failure> {
    if args.step.is_some() && args.method == Method::Exact {
        let why = "--step is for --method tangents and disks, not for exact";
        return Err(Failure::Usage(why.to_owned()));
    }
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let plan = Plan {
        target: &args.target,
        thing: "polygons",
        formats: POLYGONS,
        columns: COLUMNS,
        engine: Some(args.engine),
        layers: Vec::new(),
    };
    let input = match run.opened(&args.input)? {
        Opened::Axes(input) => {
            let (crs, records) = input.compressed()?.unwrap_or_default();
            let masks = masks_of(records);
            let is_png = plan.asked()? == Format::Png;
            return match &masks[..] {
                [] if is_png => {
                    let why =
                        "polygons are no PNG: that is for compressed images; name another --to";
                    Err(Failure::Usage(why.to_owned()))
                }
                [] => of_documents(args, &plan, kept(input)),
                [(_, _, mask)] if is_png => as_image(args, &input, mask),
                masks => of_masks(args, &plan, &input, crs, masks),
            };
        }
        Opened::Polygons(polygons) => kept(polygons),
    };
    plan.run(run, input, move |feature, domain, stages, options| {
        let axis = timed(&mut stages.engine, || interior(domain, args.engine, options))
            .map_err(|error| Entry::unfinished(&error))?;
        timed(&mut stages.operations, || {
            // Without a threshold polygons come back as they are, curves or not.
            let axis = match args.pruning.threshold() {
                Some(_) => pruned(&args.pruning, feature, domain, axis)?,
                None => axis,
            };
            let original = boundary(domain);
            Ok(vec![rebuilt(args, &axis, Some(&original), 0.0)?])
        })
    })
}

/// A mask with the number and the identifier of its feature.
type Numbered = (usize, Option<Json>, CompressedMask);

/// The masks among what a compressed file stores.
fn masks_of(records: Vec<maxis::Record>) -> Vec<Numbered> {
    let mask = |record: maxis::Record| match record.shape {
        Compressed::Mask(mask) => Some((record.feature, record.id, mask)),
        _ => None,
    };
    records.into_iter().filter_map(mask).collect()
}

/// Writes the cells of a compressed image as an image.
fn as_image(
    args: &ReconstructArgs,
    input: &Input,
    mask: &CompressedMask,
) -> Result<Status, Failure> {
    let file = args.target.output.as_deref().filter(|path| path.as_os_str() != "-");
    if file.is_none() && std::io::stdout().is_terminal() {
        return Err(Failure::Usage("a terminal shows no png; name a file with -o".to_owned()));
    }
    let mask = mask.mask().map_err(|error| input.wrong(error))?;
    Output::create(file)?.whole(&image::write_png(&mask))?;
    Ok(Status::Done)
}

/// Writes the outlines of compressed images.
fn of_masks(
    args: &ReconstructArgs,
    plan: &Plan,
    input: &Input,
    crs: Option<Crs>,
    masks: &[Numbered],
) -> Result<Status, Failure> {
    let format = plan.format()?;
    let mut sink = plan.sink(format, crs, None, args.common.run.quiet)?;
    for (feature, id, code) in masks {
        let mask = code.mask().map_err(|error| input.wrong(error))?;
        let [width, height] = mask.grid().cell;
        let area = mask.count() as f64 * (width * height).abs();
        let values = vec![Value::from(code.method().name()), code.error.into(), area.into()];
        let record = Record { values, shape: Shape::Polygons(outline(&mask)) };
        let source = Feature { index: *feature, id: id.clone(), ..Feature::default() };
        let mut bytes = Vec::new();
        let engine = Engine::RasterTransform;
        record::write(&mut bytes, format, &source, Some(engine), COLUMNS, &[record]);
        sink.write(&bytes)?;
    }
    sink.finish(&[])?;
    Ok(Status::Done)
}

/// What became of a document.
enum Document {
    Done(Vec<u8>),
    LeftOut(usize, Entry),
    /// It has not come back in time, by its number among all.
    GivenUp(usize),
    Wrong(Error),
}

/// Axes that were computed before.
fn of_documents(
    args: &'static ReconstructArgs,
    plan: &Plan,
    input: &'static Input,
) -> Result<Status, Failure> {
    if args.pruning.threshold().is_some() {
        let why = "axis documents are rebuilt as they are; prune them first, or give polygons";
        return Err(Failure::Usage(why.to_owned()));
    }
    let format = plan.format()?;
    let mut sink = plan.sink(format, None, None, args.common.run.quiet)?;
    let progress = Progress::new(args.common.run.progress, args.common.run.quiet, None);
    let (mut done, mut left_out) = (0, 0);
    let name = &input.name;
    let limit = args.common.run.limit().map(|after| Limit { after, instead: Document::GivenUp });
    let work = move |document: Result<AxisDocument, Error>| match document {
        Ok(document) => of_document(args, format, document),
        Err(error) => Document::Wrong(error),
    };
    let threads = args.common.run.threads.unwrap_or_else(all_processors);
    let broke = ordered(input.axes()?, threads, work, limit.as_ref(), |document| {
        match document {
            Document::Done(bytes) => {
                if let Err(failure) = sink.write(&bytes) {
                    return ControlFlow::Break(failure);
                }
                done += 1;
                return ControlFlow::Continue(());
            }
            Document::Wrong(error) => return ControlFlow::Break(input.wrong(error)),
            Document::LeftOut(feature, entry) => {
                progress.error(&format!("{name}: feature {feature}: {}", entry.message));
            }
            Document::GivenUp(number) => {
                let entry = Entry::unfinished(&EngineError::TimeLimit);
                progress.error(&format!("{name}: document {number}: {}", entry.message));
            }
        }
        left_out += 1;
        ControlFlow::Continue(())
    });
    if let Some(failure) = broke {
        return Err(failure);
    }
    progress.finish();
    if done == 0 {
        return Ok(Status::NoResult);
    }
    sink.finish(&[])?;
    Ok(if left_out > 0 { Status::LeftOut } else { Status::Done })
}

fn of_document(args: &ReconstructArgs, format: Format, document: AxisDocument) -> Document {
    let original = polygons_of(&document.axis).ok().map(|polygons| polygons.concat());
    // What corners or disks stand for is as far from the shape as they are told to be.
    let error = document.error.or(original.is_some().then_some(0.0)).unwrap_or(f64::INFINITY);
    match rebuilt(args, &document.axis, original.as_ref(), error) {
        Ok(record) => {
            let source = Feature { index: document.feature, id: document.id, ..Feature::default() };
            let mut bytes = Vec::new();
            let engine = document.axis.engine;
            record::write(&mut bytes, format, &source, Some(engine), COLUMNS, &[record]);
            Document::Done(bytes)
        }
        Err(entry) => Document::LeftOut(document.feature, entry),
    }
}

/// The polygons of an axis, with their distance from the shape it was made of: that from the rings it is complete
/// for, if they are known, or from all of its disks, and how far these are from the shape.
fn rebuilt(
    args: &ReconstructArgs,
    axis: &MedialAxis,
    original: Option<&Vec<Vec<Point>>>,
    error: f64,
) -> Result<Record, Entry> {
    if axis.side != Side::Interior {
        let why = "the axis is that of the exterior; give that of the interior";
        return Err(Entry::refused("exterior", why));
    }
    let wrong = |error: &dyn std::fmt::Display| Entry::refused("internal", error.to_string());
    // Arcs are drawn finer than the disks are right.
    let finest = if error > 0.0 { ARCS * error } else { f64::INFINITY };
    let usual = args.tolerance.unwrap_or_else(|| default_tolerance(axis));
    let tolerance = args.tolerance.unwrap_or(usual.min(finest));
    let step = args.step.unwrap_or(100.0 * usual);
    let length: f64 = axis.paths().iter().map(|path| axis.curve(&path).length()).sum();
    if args.method != Method::Exact && length / step > MOST_POINTS {
        let why = format!("more than {MOST_POINTS} points along the axis; take a larger --step");
        return Err(Entry::refused("too_large", why));
    }
    // What is between samples has no outline of its own.
    let is_sampled = axis.accuracy != Accuracy::Exact;
    let method =
        if is_sampled && args.method == Method::Exact { Method::Disks } else { args.method };
    let distance = |polygons: &Vec<Vec<Vec<Point>>>| {
        original.map_or(f64::INFINITY, |original| {
            boundary_distance(original, &polygons.concat(), 1e-2 * tolerance)
        })
    };
    let (polygons, distance) = match (method, polygons_of(axis)) {
        // Bit for bit.
        (Method::Exact, Ok(polygons)) => (polygons, 0.0),
        (Method::Disks, _) if is_sampled && args.step.is_none() => {
            (union_of_linked_disks(axis, tolerance), tolerance)
        }
        (method, _) => {
            let polygons = match method {
                Method::Exact => {
                    Outline::new(axis).map_err(|error| wrong(&error))?.polygons(tolerance)
                }
                Method::Tangents => {
                    let rings = tangent_polygons(axis, step).map_err(|error| wrong(&error))?;
                    without_crossings(&rings, tolerance)
                }
                Method::Disks => union_of_disks(&disks(axis, step), tolerance),
            };
            let distance = distance(&polygons);
            (polygons, distance)
        }
    };
    let error = error + distance;
    // Whichever way the rings run.
    let area = |rings: &Vec<Vec<Point>>| {
        let [outer, holes @ ..] = &rings[..] else { return 0.0 };
        signed_area(outer).abs() - holes.iter().map(|hole| signed_area(hole).abs()).sum::<f64>()
    };
    let area: f64 = polygons.iter().map(area).sum();
    let values = vec![Value::from(method.name()), error.into(), area.into()];
    Ok(Record { values, shape: Shape::Polygons(polygons) })
}
