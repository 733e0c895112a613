use super::features::Run;
use super::sink::{Sink, draw, encode, head, title};
use crate::args::{AxisArgs, ChosenEngine, Height, Line, Pruning, Region, Sides};
use crate::failure::{Failure, Status};
use crate::input::Documents;
use crate::output::Output;
use crate::report::Entry;
use crate::timings::timed;
use medial::axis::{Engine, Joining, MedialAxis, Side};
use medial::domain::Domain;
use medial::engine::{
    self, DelaunayDual, EngineError, RidgeOptions, Sampling, both_sides, brushfire,
    brushfire_of_domain, exterior, interior, of_mask, ridge_following, ridge_following_of_mask,
};
use medial::ops::{Hierarchy, Measure, Significance};
use medial::raster::default_cell;
use medial_io::svg::Options;
use medial_io::{Drawing, Feature, Format, csv};
use std::io::IsTerminal as _;
use std::num::NonZeroU32;
use std::path::Path;

/// `medial prune`: `medial axis`, told what to remove.
pub fn prune(args: &'static AxisArgs) -> Result<Status, Failure> {
    match args.pruning.threshold() {
        Some(_) => run_on(args, Documents::AsPolygons),
        None => Err(Failure::Usage(
            "say what to remove: --max-error V, or --prune MEASURE=VALUE; see --help".to_owned(),
        )),
    }
}

/// `medial axis`.
pub fn run(args: &'static AxisArgs) -> Result<Status, Failure> {
    run_on(args, Documents::Refused)
}

fn run_on(args: &'static AxisArgs, documents: Documents) -> Result<Status, Failure> {
    args.region.check()?;
    args.engine.check()?;
    args.pruning.check(&args.engine)?;
    if let Some(nodes) = args.nodes.as_deref() {
        let others = [&args.output, &args.common.run.report, &args.common.run.timings];
        if nodes.as_os_str() == "-"
            || others.into_iter().any(|other| other.as_deref() == Some(nodes))
        {
            let why = "--nodes needs a file of its own";
            return Err(Failure::Usage(why.to_owned()));
        }
    }
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let format = output_format(args)?;
    let drawing = Drawing {
        tolerance: args.tolerance,
        radius_as_z: args.z == Some(Height::Radius),
        keypoints: args.keypoints,
        side: args.region.side != Sides::Interior,
        by: args.by.map(|by| match by {
            Line::Path => Joining::Governors,
            Line::Branch => Joining::Branches,
        }),
    };
    run.masks_alone = asks_for_masks_alone(args, format);
    let input = run.open_with(&args.input, documents)?;
    args.engine.check_input(input.format)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let picture = Options {
        title: title("Medial axis", &args.input),
        draw: args.draw.clone(),
        ..Options::default()
    };
    let crs = layer.crs.clone();
    let head = head(format, csv::header(&args.measures, drawing), layer.units);
    let mut sink = Sink::create(args.output.as_deref(), format, head, crs, args.common.run.quiet)?;
    let mut nodes = args.nodes.as_deref().map(Output::beside).transpose()?;
    if let Some(nodes) = &mut nodes {
        nodes.write(csv::node_header().as_bytes())?;
    }
    if let Some((measure, _)) = args.pruning.threshold()
        && !measure.is_monotone()
        && !args.common.run.quiet
    {
        crate::progress::line(&format!(
            "warning: {measure} does not grow towards the root of a tree; parts below the value are kept \
             where others above it need them"
        ));
    }
    let mut scenes = Vec::new();
    let mut told = Ok(());
    let mut write = std::time::Duration::ZERO;
    let (at_once, threads) = run.threads(&layer);
    let status = run.each(
        &input.name,
        layer,
        at_once,
        move |feature, domain, stages, bytes| {
            let options = stages.options(threads);
            // All that is asked of a feature, or nothing.
            let mut sampling = None;
            let axes = timed(&mut stages.engine, || {
                let AxisArgs { engine, region, pruning, .. } = args;
                traced(engine, region, pruning, feature, domain, &options, &mut sampling)
            })?;
            stages.sampling = sampling;
            let is_whole =
                args.measures.is_empty() && !args.pruning.removes(feature, args.engine.of(feature));
            let axes: Vec<_> = if is_whole {
                axes.into_iter().map(|axis| (axis, Vec::new())).collect()
            } else {
                timed(&mut stages.operations, || {
                    let measured =
                        |axis| measured(&args.pruning, &args.measures, feature, domain, axis);
                    axes.into_iter().map(measured).collect::<Result<_, _>>()
                })?
            };
            Ok(timed(&mut stages.write, || {
                let table = |(axis, _): &(MedialAxis, _)| csv::node_rows(feature, axis);
                let table: String = match args.nodes {
                    Some(_) => axes.iter().map(table).collect(),
                    None => String::new(),
                };
                (encode(format.encoding(), drawing, feature, domain, axes, bytes), table)
            }))
        },
        |(drawn, table)| {
            scenes.extend(drawn);
            if let (Some(nodes), Ok(())) = (&mut nodes, &told) {
                told = nodes.write(table.as_bytes());
            }
        },
        |bytes| timed(&mut write, || sink.write(bytes)),
    )?;
    told?;
    if status != Status::NoResult {
        if let Some(nodes) = nodes {
            timed(&mut write, || nodes.finish())?;
        }
        timed(&mut write, || sink.finish(&draw(format, &scenes, &picture)?))?;
    }
    run.stages.write += write;
    run.finish()?;
    Ok(status)
}

/// Whether the outline of an image is needed for nothing.
fn asks_for_masks_alone(args: &AxisArgs, format: Format) -> bool {
    let engine = args.engine.of_images();
    !engine.is_exact()
        && args.engine.cell.is_none()
        && args.region.side == Sides::Interior
        && !args.pruning.removes(&Feature::default(), engine)
        && args.measures.is_empty()
        && !matches!(format, Format::Svg | Format::Png)
}

/// What pruning leaves of an axis, if it was asked for, with what was asked to be measured.
pub fn measured(
    pruning: &Pruning,
    measures: &[Measure],
    feature: &Feature,
    domain: &Domain,
    axis: MedialAxis,
) -> Result<(MedialAxis, Vec<Significance>), Entry> {
    if measures.is_empty() && !pruning.removes(feature, axis.engine) {
        return Ok((axis, Vec::new()));
    }
    let hierarchy = Hierarchy::new(domain, &axis).map_err(|error| Entry::internal(&error))?;
    let measures = measures.iter();
    Ok(match pruning.rest(feature, axis.engine, &hierarchy) {
        Some(pruned) => {
            let measured = measures.map(|&m| hierarchy.significance_of(m, &pruned)).collect();
            (pruned.axis, measured)
        }
        None => (axis.clone(), measures.map(|&measure| hierarchy.significance(measure)).collect()),
    })
}

/// What pruning leaves of an axis, if it was asked for.
pub fn pruned(
    pruning: &Pruning,
    feature: &Feature,
    domain: &Domain,
    axis: MedialAxis,
) -> Result<MedialAxis, Entry> {
    measured(pruning, &[], feature, domain, axis).map(|(axis, _)| axis)
}

/// The axes of a feature by the engine that is chosen for it, which may be one on cells: those of the image it
/// was, or of a size. Tells how well samples stand for the boundary, if the engine takes some.
pub fn traced(
    chosen: &ChosenEngine,
    region: &Region,
    pruning: &Pruning,
    feature: &Feature,
    domain: &Domain,
    options: &engine::Options<'_>,
    sampling: &mut Option<Sampling>,
) -> Result<Vec<MedialAxis>, Entry> {
    let engine = chosen.of(feature);
    if engine.is_exact() {
        return trace(engine, region, domain, options);
    }
    let cell = match (&feature.mask, chosen.cell) {
        (Some(mask), None) => mask.grid().cell_size(),
        (_, cell) => cell.unwrap_or_else(|| default_cell(domain)),
    };
    let residual = pruning.residual(cell);
    let (spacing, band_rows) = (chosen.spacing, chosen.band_rows.map(NonZeroU32::get));
    let options = engine::Options { cell: Some(cell), spacing, residual, band_rows, ..*options };
    let sides = region.side.all().iter();
    if engine == Engine::DelaunayDual {
        let pruning = pruning.of_dual(feature, cell);
        let axis = |&side| {
            let dual = dual(chosen, region, side, feature, domain, &options)?;
            sampling.get_or_insert_with(|| dual.sampling());
            dual.axis(pruning)
        };
        return sides
            .map(axis)
            .collect::<Result<_, _>>()
            .map_err(|error| Entry::unfinished(&error));
    }
    let axis = |&side| sampled(chosen, region, side, feature, domain, engine, &options);
    sides.map(axis).collect::<Result<_, _>>().map_err(|error| Entry::unfinished(&error))
}

/// The dual graph of a feature on a side.
pub fn dual<'a>(
    chosen: &ChosenEngine,
    region: &Region,
    side: Side,
    feature: &'a Feature,
    domain: &'a Domain,
    options: &engine::Options<'_>,
) -> Result<DelaunayDual<'a>, EngineError> {
    let width = chosen.smooth_border.unwrap_or(0.0);
    let dual = match (&feature.mask, side) {
        (_, Side::Exterior) => DelaunayDual::outside(domain, region.frame, options),
        (Some(mask), _) => DelaunayDual::of_smoothed_mask(mask, width, options),
        (None, _) => DelaunayDual::new(domain, options),
    }?;
    match chosen.retract {
        Some(residual) => dual.retracted(residual, options),
        None => Ok(dual),
    }
}

/// The axis on a side by an engine on cells.
fn sampled(
    chosen: &ChosenEngine,
    region: &Region,
    side: Side,
    feature: &Feature,
    domain: &Domain,
    engine: Engine,
    options: &engine::Options<'_>,
) -> Result<MedialAxis, EngineError> {
    // Other cells than those of the image are put on its outline.
    let mask = feature.mask.as_deref();
    let mask = mask.filter(|_| chosen.cell.is_none() && side == Side::Interior);
    let burning = chosen.burning.unwrap_or_default();
    match (engine, mask) {
        (Engine::RidgeFollowing, mask) => {
            let ridge = RidgeOptions {
                search: chosen.search.unwrap_or_default(),
                thinning: chosen.thinning.unwrap_or_default(),
                side,
                margin: region.frame,
                curves: feature.curves.as_ref(),
                ..RidgeOptions::default()
            };
            let ridges = match mask {
                Some(mask) => ridge_following_of_mask(mask, &ridge, options),
                None => ridge_following(domain, &ridge, options),
            };
            ridges.map(|ridges| ridges.axis)
        }
        (Engine::Brushfire, Some(mask)) => brushfire(mask, burning, options),
        (Engine::Brushfire, None) if side == Side::Interior => {
            brushfire_of_domain(domain, burning, options)
        }
        (_, Some(mask)) => of_mask(mask, engine, options),
        _ => on_side(side, region, domain, engine, options),
    }
}

/// The axes of a feature by an engine, one for each side that is asked for, or why it is refused.
pub fn trace(
    engine: Engine,
    region: &Region,
    domain: &Domain,
    options: &engine::Options<'_>,
) -> Result<Vec<MedialAxis>, Entry> {
    let alone = |side| on_side(side, region, domain, engine, options).map(|axis| vec![axis]);
    let axes = match region.side {
        Sides::Interior => alone(Side::Interior),
        Sides::Exterior => alone(Side::Exterior),
        Sides::Both => both_sides(domain, engine, region.frame, options).map(Vec::from),
    };
    axes.map_err(|error| Entry::unfinished(&error))
}

/// The axis on a side.
pub fn on_side(
    side: Side,
    region: &Region,
    domain: &Domain,
    engine: Engine,
    options: &engine::Options<'_>,
) -> Result<MedialAxis, EngineError> {
    match side {
        Side::Exterior => exterior(domain, engine, region.frame, options),
        _ => interior(domain, engine, options),
    }
}

/// The format of an output, from `--to`, else the extension of the file, else GeoJSON.
pub fn format_of(to: Option<Format>, file: Option<&Path>) -> Result<Format, Failure> {
    match (to, file) {
        (Some(format), _) => Ok(format),
        (None, None) => Ok(Format::GeoJson),
        (None, Some(path)) => Format::from_path(path).map_err(|_| {
            let name = path.display();
            Failure::Usage(format!("{name}: the extension names no format; say it with --to"))
        }),
    }
}

/// The format of the output, if axes and the other options have it.
fn output_format(args: &AxisArgs) -> Result<Format, Failure> {
    let file = args.output.as_deref().filter(|path| path.as_os_str() != "-");
    let format = format_of(args.to, file)?;
    let usage = |why: String| Err(Failure::Usage(why));
    let picture = matches!(format, Format::Svg | Format::Png);
    let lines = matches!(
        format.encoding(),
        Format::GeoJson | Format::GeoJsonLines | Format::Wkt | Format::Wkb
    );
    if format == Format::Rings {
        return usage("rings hold polygons, no axes; see --to in --help".to_owned());
    }
    if matches!(format, Format::Ttf | Format::Tiff | Format::Jpeg) {
        return usage(format!("{format} is read only; see --to in --help"));
    }
    if format == Format::Maxis {
        return usage("maxis is written by `medial compress`; see its --help".to_owned());
    }
    if format == Format::GCode {
        return usage("gcode is written by `medial carve`; see its --help".to_owned());
    }
    if !args.draw.is_empty() && !picture {
        return usage(format!("--draw is for svg and png, not for {format}"));
    }
    if args.z.is_some() && !lines && !matches!(format, Format::Csv | Format::Dxf) {
        return usage(format!(
            "--z is for geojson, geojsonl, wkt, wkb, csv, dxf and tables, not for {format}"
        ));
    }
    if args.keypoints && format == Format::Csv {
        return usage("--keypoints is not for csv, which has a row for each path".to_owned());
    }
    if args.keypoints && format == Format::Shp {
        return usage("--keypoints is not for shp, which holds one kind of geometry".to_owned());
    }
    if !args.measures.is_empty()
        && !matches!(
            format.encoding(),
            Format::GeoJson | Format::GeoJsonLines | Format::Csv | Format::Json
        )
    {
        return usage(format!(
            "--measures is for geojson, geojsonl, csv, json and tables, not for {format}"
        ));
    }
    let mut known = args.measures.iter().enumerate();
    if let Some((_, twice)) = known.find(|&(k, measure)| args.measures[..k].contains(measure)) {
        return usage(format!("--measures has {twice} twice"));
    }
    let binary = matches!(format, Format::Png | Format::Wkb);
    if binary && file.is_none() && std::io::stdout().is_terminal() {
        return usage(format!("a terminal shows no {format}; name a file with -o"));
    }
    needs_file(format, file)?;
    Ok(format)
}

/// Fails if a table has no file to be.
pub fn needs_file(format: Format, file: Option<&Path>) -> Result<(), Failure> {
    if format.is_table() && file.is_none() {
        let why = format!("{format} is written to a file; name it with -o");
        return Err(Failure::Usage(why));
    }
    Ok(())
}
