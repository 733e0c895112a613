use super::axis::format_of;
use super::features::Run;
use super::sink::Sink;
use crate::args::CenterlineArgs;
use crate::failure::{Failure, Status};
use crate::report::Entry;
use crate::timings::timed;
use medial::engine::{self, interior};
use medial::ops::{CenterlineOptions, centerlines};
use medial_io::{Drawing, Format, domain_tolerance, geojson, wkt};
use std::time::Duration;

/// `medial centerline`.
pub fn run(args: &CenterlineArgs) -> Result<Status, Failure> {
    let mut run = Run::new(&args.common)?;
    let format = output_format(args)?;
    let input = run.open(&args.input)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let mut sink =
        Sink::create(args.output.as_deref(), format, Drawing::default(), layer.crs.clone())?;
    let mut write = Duration::ZERO;
    let (at_once, threads) = run.threads(&layer);
    let options = engine::Options { threads, ..engine::Options::default() };
    let mut asked = CenterlineOptions {
        count: args.count.get(),
        to_boundary: args.extend == crate::args::Extend::Boundary,
        ..CenterlineOptions::default()
    };
    asked.ends = args.pruning.threshold().unwrap_or(asked.ends);
    let z = args.z.is_some();
    let status = run.each(
        &input,
        layer,
        at_once,
        |feature, domain, stages, bytes| {
            let axis = timed(&mut stages.engine, || interior(domain, args.engine, &options))
                .map_err(|error| Entry::unfinished(&error))?;
            let lines = timed(&mut stages.operations, || centerlines(domain, &axis, &asked))
                .map_err(|error| Entry::internal(&error))?;
            let tolerance = args.tolerance.unwrap_or_else(|| domain_tolerance(domain));
            let encode = || match format {
                Format::GeoJson => {
                    geojson::centerline_features(bytes, feature, args.engine, &lines, tolerance, z);
                }
                Format::GeoJsonLines => {
                    geojson::centerline_lines(bytes, feature, args.engine, &lines, tolerance, z);
                }
                _ => {
                    let lines: Vec<_> = lines.iter().map(|line| line.polyline(tolerance)).collect();
                    bytes.extend_from_slice(wkt::write_lines(&lines, z).as_bytes());
                }
            };
            timed(&mut stages.write, encode);
            Ok(())
        },
        |()| {},
        |bytes| timed(&mut write, || sink.write(bytes)),
    )?;
    if status != Status::NoResult {
        timed(&mut write, || sink.finish(&[]))?;
    }
    run.stages.write += write;
    run.finish()?;
    Ok(status)
}

/// The format of the output, if it has lines.
fn output_format(args: &CenterlineArgs) -> Result<Format, Failure> {
    let file = args.output.as_deref().filter(|path| path.as_os_str() != "-");
    let format = format_of(args.to, file)?;
    if [Format::GeoJson, Format::GeoJsonLines, Format::Wkt].contains(&format) {
        return Ok(format);
    }
    let why = format!("centerlines are written as geojson, geojsonl or wkt, not as {format}");
    Err(Failure::Usage(why))
}
