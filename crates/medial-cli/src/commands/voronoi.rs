use super::axis::{format_of, needs_file, trace};
use super::features::Run;
use super::sink::{Sink, title};
use crate::args::VoronoiArgs;
use crate::failure::{Failure, Status};
use crate::report::Entry;
use crate::timings::timed;
use medial::axis::MedialAxis;
use medial::domain::Domain;
use medial::engine::exterior_frame;
use medial::ops::{Voronoi, VoronoiError};
use medial_io::svg::{Diagram, Options, write_diagrams};
use medial_io::{Feature, Format, geojson, voronoi_document};
use std::time::Duration;

/// `medial voronoi`.
pub fn run(args: &'static VoronoiArgs) -> Result<Status, Failure> {
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let format = output_format(args)?;
    let input = run.open(&args.input)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let mut sink = Sink::create(
        args.output.as_deref(),
        format,
        String::new(),
        layer.crs.clone(),
        args.common.run.quiet,
    )?;
    let mut diagrams = Vec::new();
    let mut write = Duration::ZERO;
    let (at_once, threads) = run.threads(&layer);
    let status = run.each(
        &input.name,
        layer,
        at_once,
        move |feature, domain, stages, bytes| {
            let options = stages.options(threads);
            let axes =
                timed(&mut stages.engine, || trace(args.engine, &args.region, domain, &options))?;
            let voronoi =
                timed(&mut stages.operations, || diagram(domain, &axes, args.region.frame))
                    .map_err(|error| Entry::internal(&error))?;
            let encode = || encode(format.encoding(), args.tolerance, feature, &voronoi, bytes);
            Ok(timed(&mut stages.write, encode))
        },
        |diagram| diagrams.extend(diagram),
        |bytes| timed(&mut write, || sink.write(bytes)),
    )?;
    if status != Status::NoResult {
        timed(&mut write, || {
            let picture = match format {
                Format::Svg => {
                    let options = Options {
                        title: title("Voronoi diagram", &args.input),
                        ..Options::default()
                    };
                    write_diagrams(&diagrams, &options)
                }
                _ => String::new(),
            };
            sink.finish(picture.as_bytes())
        })?;
    }
    run.stages.write += write;
    run.finish()?;
    Ok(status)
}

/// The diagram of axes that were cut so far from the box.
fn diagram<'a>(
    domain: &'a Domain,
    axes: &'a [MedialAxis],
    margin: Option<f64>,
) -> Result<Voronoi<'a>, VoronoiError> {
    match margin {
        None => Voronoi::new(domain, axes),
        Some(_) => {
            let frame = exterior_frame(domain, margin).map_err(|_| VoronoiError::Frame)?;
            Voronoi::within(domain, axes, &frame)
        }
    }
}

/// Appends the diagram of a feature in a format, or gives what to draw of it.
fn encode(
    format: Format,
    tolerance: Option<f64>,
    feature: &Feature,
    voronoi: &Voronoi,
    bytes: &mut Vec<u8>,
) -> Option<Diagram> {
    match format {
        Format::Svg => return Some(Diagram::new(voronoi)),
        Format::GeoJson => geojson::voronoi_features(bytes, feature, voronoi, tolerance),
        Format::GeoJsonLines => geojson::voronoi_lines(bytes, feature, voronoi, tolerance),
        _ => bytes.extend_from_slice(voronoi_document::write(feature, voronoi).as_bytes()),
    }
    None
}

/// The format of the output, if diagrams and the other options have it.
fn output_format(args: &VoronoiArgs) -> Result<Format, Failure> {
    let file = args.output.as_deref().filter(|path| path.as_os_str() != "-");
    let format = format_of(args.to, file)?;
    let known = [Format::GeoJson, Format::GeoJsonLines, Format::Json, Format::Svg];
    if !known.contains(&format.encoding()) {
        let why = format!(
            "diagrams are written as geojson, geojsonl, json, svg, gpkg, shp, fgb or parquet, not as {format}"
        );
        return Err(Failure::Usage(why));
    }
    args.region.check()?;
    if args.tolerance.is_some()
        && !matches!(format.encoding(), Format::GeoJson | Format::GeoJsonLines)
    {
        let why = format!("--tolerance is for geojson and geojsonl; curves are exact in {format}");
        return Err(Failure::Usage(why));
    }
    needs_file(format, file)?;
    Ok(format)
}
