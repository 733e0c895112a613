use super::features::Run;
use super::sink::lost;
use crate::args::{CompressArgs, Rows};
use crate::failure::{Failure, Status};
use crate::input::Documents;
use crate::output::Output;
use crate::report::Entry;
use crate::sizes::{Row, Totals, csv_header};
use crate::timings::{Stages, timed};
use medial::axis::Engine;
use medial::domain::Domain;
use medial::engine::{self, interior};
use medial::ops::{CompressError, Compressed, Corners, compress, compress_mask};
use medial::raster::Mask;
use medial_io::maxis::{self, Record};
use medial_io::{Crs, Feature, Format, wkb};
use std::io::IsTerminal as _;
use std::time::Duration;

/// `medial compress`.
pub fn run(args: &'static CompressArgs) -> Result<Status, Failure> {
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.flattening.tolerance;
    let file = args.output.as_deref().filter(|path| path.as_os_str() != "-");
    check_output(file)?;
    let input = run.open_with(&args.input, Documents::AsPolygons)?;
    let as_cells = args.as_cells(matches!(input.format, Format::Png | Format::Tiff | Format::Jpeg));
    args.check(as_cells)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let crs = layer.crs.as_ref().and_then(Crs::member);
    let output = Output::create(file)?;
    if let Some(lost) = lost(Format::Maxis, layer.crs.as_ref()).filter(|_| !args.common.run.quiet) {
        crate::progress::line(&format!("warning: {}: {lost}", output.name()));
    }
    // The sizes go where the file does not.
    let mut rows = file.map(|_| Output::create(None)).transpose()?;
    let (at_once, threads) = run.threads(&layer);
    let mut totals = Totals::default();
    let mut begun = false;
    let status = run.each(
        &input.name,
        layer,
        at_once,
        move |feature, domain, stages, bytes| {
            let options = stages.options(threads);
            let shape = match feature.mask.as_deref().filter(|_| as_cells) {
                Some(mask) => cells(mask, args, stages)?,
                None => shape(feature, domain, args, &options, stages)?,
            };
            let record = Record { feature: feature.index, id: feature.id.clone(), shape };
            let wkb = wkb::write_polygons(&feature.polygons);
            timed(&mut stages.write, || {
                let sizes = maxis::sizes(None, std::slice::from_ref(&record), &wkb);
                let mask = feature.mask.as_deref();
                let row = Row::of(&record, &feature.polygons, mask, sizes);
                bytes.extend(row.written(args.sizes));
                Ok((record, row, wkb))
            })
        },
        |(record, row, wkb)| totals.add(record, &row, &wkb),
        |bytes| {
            let Some(rows) = &mut rows else { return Ok(()) };
            if args.sizes == Rows::Csv && !std::mem::replace(&mut begun, true) {
                rows.write(&csv_header())?;
            }
            rows.write(bytes)
        },
    )?;
    let mut write = Duration::ZERO;
    if status != Status::NoResult {
        timed(&mut write, || {
            output.whole(&maxis::write(crs.as_ref(), totals.records()))?;
            let Some(mut rows) = rows else { return Ok(()) };
            rows.write(&totals.row(crs.as_ref()).written(args.sizes))?;
            rows.finish()
        })?;
    }
    run.stages.write += write;
    run.finish()?;
    Ok(status)
}

/// What stands for the cells of an image.
fn cells(mask: &Mask, args: &CompressArgs, stages: &mut Stages) -> Result<Compressed, Entry> {
    let options = args.mask_options(mask.grid().cell_size());
    timed(&mut stages.operations, || compress_mask(mask, &options))
        .map(Compressed::Mask)
        .map_err(|error| Entry::refused("too_large", error.to_string()))
}

/// What stands for a feature: disks, if an error is allowed and they take less, else its corners.
fn shape(
    feature: &Feature,
    domain: &Domain,
    args: &CompressArgs,
    options: &engine::Options<'_>,
    stages: &mut Stages,
) -> Result<Compressed, Entry> {
    let max_error = args.max_error.unwrap_or(0.0);
    let engine = args.engine.unwrap_or(Engine::PathTracing);
    // Rings that cross or overlap bound nothing without being repaired.
    let is_rebuilt = domain.report().is_rebuilt();
    let corners = Corners {
        engine,
        regroup: args.common.regroup && !is_rebuilt,
        error: 0.0,
        polygons: if is_rebuilt { domain.polygons() } else { feature.polygons.clone() },
    };
    if max_error == 0.0 {
        return Ok(Compressed::Corners(corners));
    }
    let simplified = if args.simplify { corners.simplified(max_error) } else { None };
    let mut shape = Compressed::Corners(corners);
    if let Some(simplified) = simplified {
        shape = maxis::smaller(Compressed::Corners(simplified), shape);
    }
    let axis = timed(&mut stages.engine, || interior(domain, engine, options))
        .map_err(|error| Entry::unfinished(&error))?;
    match timed(&mut stages.operations, || compress(domain, &axis, max_error)) {
        Ok(graph) => Ok(maxis::smaller(Compressed::Disks(graph), shape)),
        Err(CompressError::TooFine { .. }) => Ok(shape),
        Err(error) => Err(Entry::internal(&error)),
    }
}

/// Fails if the file is to be of another format, or would go to a terminal.
fn check_output(file: Option<&std::path::Path>) -> Result<(), Failure> {
    match file.map(Format::from_path) {
        None if std::io::stdout().is_terminal() => {
            let why = "a terminal shows no maxis; name a file with -o";
            Err(Failure::Usage(why.to_owned()))
        }
        Some(Ok(format)) if format != Format::Maxis => {
            let why = format!("compressed axes are written as maxis, not as {format}");
            Err(Failure::Usage(why))
        }
        _ => Ok(()),
    }
}
