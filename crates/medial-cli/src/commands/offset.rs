use super::features::Run;
use super::records::{Found, Plan};
use super::sink::{boundary, title};
use crate::args::OffsetArgs;
use crate::failure::{Failure, Status};
use crate::report::Entry;
use crate::timings::{Stages, timed};
use medial::domain::Domain;
use medial::engine::{self, exterior, interior};
use medial::ops::{Outline, offset_margin, offsets};
use medial_io::record::{Record, Shape};
use medial_io::svg::{Options, Parallels, write_offsets};
use medial_io::{Format, domain_tolerance, dxf, offset_document};

const COLUMNS: &[&str] = &["distance", "area", "length", "n_polygons", "n_holes"];

/// Formats that keep arcs.
const EXACT: &[Format] = &[Format::Json, Format::Svg, Format::Dxf];

/// Formats of polygons, and those.
const FORMATS: &[Format] = &[
    Format::GeoJson,
    Format::GeoJsonLines,
    Format::Csv,
    Format::Wkt,
    Format::Wkb,
    Format::Rings,
    Format::Json,
    Format::Svg,
    Format::Dxf,
];

/// `medial offset`.
pub fn run(args: &'static OffsetArgs) -> Result<Status, Failure> {
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let plan = Plan {
        target: &args.target,
        thing: "offsets",
        formats: FORMATS,
        columns: COLUMNS,
        engine: Some(args.engine),
        layers: Vec::new(),
    };
    let format = plan.format()?;
    let input = run.open(&args.input)?;
    if args.tolerance.is_some() && EXACT.contains(&format) && !input.format.has_curves() {
        let why = format!("--tolerance is for polylines; arcs are exact in {format}");
        return Err(Failure::Usage(why));
    }
    let options = Options { title: title("Offsets", &args.input), ..Options::default() };
    plan.run_and_draw(
        run,
        input,
        move |feature, domain, stages, options| {
            let outlines = parallels(args, domain, stages, options)?;
            if format == Format::Svg {
                return Ok(Found::Part(Parallels { boundary: boundary(domain), outlines }));
            }
            Ok(timed(&mut stages.write, || {
                if format == Format::Dxf {
                    let mut entities = dxf::Entities::default();
                    outlines.iter().for_each(|(_, outline)| entities.outline(outline));
                    return Found::Text(entities.into_text());
                }
                if format == Format::Json {
                    let line = |(distance, outline): &(f64, Outline)| {
                        offset_document::write(feature, args.engine, *distance, outline)
                    };
                    return Found::Text(outlines.iter().map(line).collect());
                }
                let tolerance = args.tolerance.unwrap_or_else(|| domain_tolerance(domain));
                let of = |(d, outline): &(f64, Outline)| record(*d, outline, tolerance);
                Found::Records(outlines.iter().map(of).collect())
            }))
        },
        |pictures, stages| {
            let draw = || write_offsets(&pictures, &options).into_bytes();
            Ok(timed(&mut stages.write, draw))
        },
    )
}

/// The parallel curves of a shape in the order of the distances, without those at which nothing is left.
fn parallels(
    args: &OffsetArgs,
    domain: &Domain,
    stages: &mut Stages,
    options: &engine::Options<'_>,
) -> Result<Vec<(f64, Outline)>, Entry> {
    let mut outlines: Vec<Option<Outline>> = vec![None; args.distance.len()];
    for outward in [false, true] {
        let asked = || (0..).zip(&args.distance).filter(|(_, d)| (**d < 0.0) == outward);
        let distances: Vec<f64> = asked().map(|(_, distance)| distance.abs()).collect();
        let Some(most) = distances.iter().copied().reduce(f64::max) else { continue };
        let axis = timed(&mut stages.engine, || {
            if outward {
                exterior(domain, args.engine, Some(offset_margin(domain, most)), options)
            } else {
                interior(domain, args.engine, options)
            }
        });
        let axis = axis.map_err(|error| Entry::unfinished(&error))?;
        let found = timed(&mut stages.operations, || offsets(domain, &axis, &distances))
            .map_err(|error| Entry::internal(&error))?;
        asked()
            .zip(found)
            .for_each(|((k, _), outline): ((usize, _), _)| outlines[k] = Some(outline));
    }
    let outlines = args.distance.iter().copied().zip(outlines.into_iter().flatten());
    Ok(outlines.filter(|(_, outline)| !outline.polygons.is_empty()).collect())
}

fn record(distance: f64, outline: &Outline, tolerance: f64) -> Record {
    let polygons = outline.polygons(tolerance);
    let n_holes: usize = outline.polygons.iter().map(|polygon| polygon.0.len() - 1).sum();
    let values = vec![
        distance.into(),
        outline.area().into(),
        outline.length().into(),
        outline.polygons.len().into(),
        n_holes.into(),
    ];
    Record { values, shape: Shape::Polygons(polygons) }
}
