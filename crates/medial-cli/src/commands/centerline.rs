use super::axis::{format_of, needs_file};
use super::features::Run;
use super::sink::{Sink, boundary, head, title};
use crate::args::{CenterlineArgs, Extend, Purpose};
use crate::failure::{Failure, Status};
use crate::metric::Metric;
use crate::report::Entry;
use crate::timings::timed;
use medial::axis::Engine;
use medial::engine::interior;
use medial::geom::Point;
use medial::ops::{
    Centerline, CenterlineOptions, Extension, LineOptions, Route, centerlines, polylines,
};
use medial_io::svg::{MainLines, Options, write_lines};
use medial_io::{Feature, Format, csv, domain_tolerance, dxf, geojson, wkt};
use std::time::Duration;

/// `medial centerline`.
pub fn run(args: &'static CenterlineArgs) -> Result<Status, Failure> {
    let asked = asked(args)?;
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let format = output_format(args)?;
    let input = run.open(&args.input)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let head = head(format, csv::centerline_header(), layer.units);
    let (crs, quiet) = (layer.crs.clone(), args.common.run.quiet);
    let mut sink = Sink::create(args.output.as_deref(), format, head, crs, quiet)?;
    let mut pictures = Vec::new();
    let mut write = Duration::ZERO;
    let (at_once, threads) = run.threads(&layer);
    let z = args.z.is_some();
    let status = run.each(
        &input.name,
        layer,
        at_once,
        move |feature, domain, stages, bytes| {
            let options = stages.options(threads);
            let axis = timed(&mut stages.engine, || interior(domain, args.engine, &options))
                .map_err(|error| Entry::unfinished(&error))?;
            let tolerance = args.tolerance.unwrap_or_else(|| domain_tolerance(domain));
            let drawing = LineOptions { tolerance, smooth: args.smooth, simplify: args.simplify };
            let (lines, drawn) = timed(&mut stages.operations, || {
                let lines = centerlines(domain, &axis, &asked)?;
                let drawn = polylines(domain, &lines, &drawing);
                Ok((lines, drawn))
            })
            .map_err(|error| Entry::no_line(&error))?;
            if lines.is_empty() {
                let why = match asked.route {
                    Route::Label { .. } => {
                        "no line is wide enough for the text; take a smaller --height"
                    }
                    _ => "what is left of the axis has no line; take a smaller --prune",
                };
                return Err(Entry::refused("no_line", why));
            }
            if format == Format::Svg {
                let points = |line: &Vec<(Point, f64)>| line.iter().map(|(p, _)| *p).collect();
                let lines = drawn.iter().map(points).collect();
                return Ok(Some(MainLines { boundary: boundary(domain), lines }));
            }
            timed(&mut stages.write, || {
                encode(format.encoding(), feature, args.engine, &lines, &drawn, z, bytes);
            });
            Ok(None)
        },
        |picture| pictures.extend(picture),
        |bytes| timed(&mut write, || sink.write(bytes)),
    )?;
    if status != Status::NoResult {
        timed(&mut write, || {
            let options = Options { title: title("Centerline", &args.input), ..Options::default() };
            let is_picture = format == Format::Svg;
            let picture = if is_picture { write_lines(&pictures, &options) } else { String::new() };
            sink.finish(picture.as_bytes())
        })?;
    }
    run.stages.write += write;
    run.finish()?;
    Ok(status)
}

/// Appends the lines of a feature in a format.
fn encode(
    format: Format,
    feature: &Feature,
    engine: Engine,
    lines: &[Centerline],
    drawn: &[Vec<(Point, f64)>],
    z: bool,
    bytes: &mut Vec<u8>,
) {
    let text = match format {
        Format::GeoJson => {
            return geojson::centerline_features(bytes, feature, engine, lines, drawn, z);
        }
        Format::GeoJsonLines => {
            return geojson::centerline_lines(bytes, feature, engine, lines, drawn, z);
        }
        Format::Dxf => {
            let mut entities = dxf::Entities::default();
            entities.lines(drawn, z);
            entities.into_text()
        }
        Format::Csv => csv::centerline_rows(feature, engine, lines, drawn, z),
        _ => wkt::write_lines(drawn, z),
    };
    bytes.extend_from_slice(text.as_bytes());
}

/// What lines the arguments ask for, if they go together.
fn asked(args: &CenterlineArgs) -> Result<CenterlineOptions, Failure> {
    let usage = |why: &str| Err(Failure::Usage(why.to_owned()));
    let points = args.between.map_or_else(|| args.anchor.clone(), Vec::from);
    if !points.is_empty() {
        Metric::refuse(&args.common, "points")?;
    }
    if points.len() == 1 {
        return usage("a line runs between two points at least: give --anchor once more");
    }
    let extension = match args.extend {
        Extend::None => Extension::None,
        Extend::Boundary => Extension::Boundary,
        Extend::Anchors if points.is_empty() => {
            return usage(
                "--extend anchors needs the points: give them with --between or --anchor",
            );
        }
        Extend::Anchors => Extension::Anchors,
    };
    let route = match args.purpose {
        _ if !points.is_empty() => Route::Between(points),
        Purpose::Longest => Route::Longest,
        Purpose::Label => Route::Label { height: args.height },
    };
    if args.height.is_some() && !matches!(route, Route::Label { .. }) {
        return usage("--height is that of a label: say --for label too");
    }
    let ends = args.pruning.threshold().unwrap_or(CenterlineOptions::default().ends);
    Ok(CenterlineOptions { route, count: args.count.get(), ends, extension })
}

/// The format of the output, if it has lines.
fn output_format(args: &CenterlineArgs) -> Result<Format, Failure> {
    let file = args.output.as_deref().filter(|path| path.as_os_str() != "-");
    let format = format_of(args.to, file)?;
    let known =
        [Format::GeoJson, Format::GeoJsonLines, Format::Wkt, Format::Csv, Format::Svg, Format::Dxf];
    if !known.contains(&format.encoding()) {
        let why = format!(
            "centerlines are written as geojson, geojsonl, wkt, csv, svg, dxf, gpkg, shp, fgb or parquet, \
             not as {format}"
        );
        return Err(Failure::Usage(why));
    }
    if args.z.is_some() && format == Format::Svg {
        return Err(Failure::Usage("--z is for geojson, geojsonl, wkt, csv and dxf".to_owned()));
    }
    needs_file(format, file)?;
    Ok(format)
}
