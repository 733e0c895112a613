use super::axis::trace;
use super::features::Run;
use super::records::{DRAWN_LINES, Found, LINES, Plan};
use super::sink::title;
use crate::args::ClearanceArgs;
use crate::failure::{Failure, Status};
use crate::input::Documents;
use crate::metric::Metric;
use crate::report::Entry;
use crate::timings::{Stages, timed};
use medial::axis::MedialAxis;
use medial::domain::{Domain, FillRule};
use medial::engine::{self, interior};
use medial::geom::Point;
use medial::ops::{
    CenterlineError, CenterlineOptions, Neck, Plateau, Station, centerlines, largest_disks, necks,
    profile,
};
use medial_io::record::{self, Record, Shape, Value};
use medial_io::svg::{Options, Profile, write_profiles};
use medial_io::{Feature, Format, domain_tolerance};

const COLUMNS: &[&str] = &[
    "kind",
    "side",
    "width",
    "length",
    "x",
    "y",
    "left_kind",
    "left_feature",
    "left_polygon",
    "left_ring",
    "left_index",
    "left_part",
    "right_kind",
    "right_feature",
    "right_polygon",
    "right_ring",
    "right_index",
    "right_part",
];

/// Those of a station of a profile.
const STATION_COLUMNS: &[&str] = &["station", "x", "y", "width"];

/// `medial clearance`.
pub fn run(args: &'static ClearanceArgs) -> Result<Status, Failure> {
    args.region.check()?;
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    match (args.profile, args.together) {
        (true, _) => profiles(args, run),
        (false, true) => together(args, run),
        (false, false) => places(args, run),
    }
}

/// Writes necks, or the largest disks.
fn places(args: &'static ClearanceArgs, mut run: Run) -> Result<Status, Failure> {
    let plan = plan_of_places(args)?;
    let input = run.open_with(&args.input, Documents::AsPolygons)?;
    plan.run(run, input, move |feature, domain, stages, options| {
        let place = |polygon: u32| (feature.index, polygon);
        all_places(args, domain, options, stages, &place)
    })
}

/// How places are written; fails if a picture of them is asked for.
fn plan_of_places(args: &'static ClearanceArgs) -> Result<Plan, Failure> {
    let plan = Plan {
        target: &args.target,
        thing: if args.largest { "disks" } else { "necks" },
        formats: LINES,
        columns: COLUMNS,
        engine: Some(args.engine),
        layers: Vec::new(),
    };
    if plan.asked()? == Format::Svg {
        return Err(Failure::Usage("svg is the plot of --profile; see --to in --help".to_owned()));
    }
    Ok(plan)
}

/// The feature of a polygon of a domain, and the number of the polygon in it.
type Place<'p> = &'p dyn Fn(u32) -> (usize, u32);

/// The records of a domain.
fn all_places(
    args: &ClearanceArgs,
    domain: &Domain,
    options: &engine::Options<'_>,
    stages: &mut Stages,
    place: Place<'_>,
) -> Result<Vec<Record>, Entry> {
    let axes = timed(&mut stages.engine, || trace(args.engine, &args.region, domain, options))?;
    timed(&mut stages.operations, || {
        let mut records = Vec::new();
        for axis in &axes {
            records.extend(found(args, domain, axis, place)?);
        }
        Ok(records)
    })
}

/// Writes necks, or the largest disks, of all features as one shape.
fn together(args: &'static ClearanceArgs, mut run: Run) -> Result<Status, Failure> {
    Metric::refuse(run.common, "--together")?;
    let plan = plan_of_places(args)?;
    let format = plan.format()?;
    let input = run.open_with(&args.input, Documents::AsPolygons)?;
    let threads = run.all_threads();
    let common = run.common;
    plan.run_and_draw(
        run,
        input,
        // Each is a valid shape by itself, or left out and reported.
        |feature, _, _, _| Ok(Found::Part((feature.index, feature.polygons.clone()))),
        |members, stages| {
            if members.is_empty() {
                return Ok(Vec::new());
            }
            let mut places: Vec<(usize, u32)> = Vec::new();
            let mut polygons = Vec::new();
            for (index, members) in members {
                places.extend((0..members.len() as u32).map(|polygon| (index, polygon)));
                polygons.extend(members);
            }
            let place = |polygon: u32| places.get(polygon as usize).copied().unwrap_or_default();
            let fails = |why: String| Failure::file(&input.name, why);
            let asked = common.domain_options(FillRule::default());
            let domain =
                timed(&mut stages.domain, || Domain::from_polygons(&polygons, &asked)).map_err(
                    |error| {
                        let which = error.polygon().map_or_else(String::new, |polygon| {
                            let (feature, own) = place(polygon);
                            format!("; polygon {polygon} is polygon {own} of feature {feature}")
                        });
                        fails(format!(
                            "the features are no shape together, with polygons counted over all of them: \
                             {error}{which}"
                        ))
                    },
                )?;
            stages.deadline = common.deadline();
            let records = all_places(args, &domain, &stages.options(threads), stages, &place)
                .map_err(|entry| fails(format!("the features together: {}", entry.message)))?;
            Ok(timed(&mut stages.write, || {
                let mut bytes = Vec::new();
                let whole = Feature::default();
                record::write(&mut bytes, format, &whole, Some(args.engine), COLUMNS, &records);
                bytes
            }))
        },
    )
}

/// Writes the width along main lines.
fn profiles(args: &'static ClearanceArgs, mut run: Run) -> Result<Status, Failure> {
    let plan = Plan {
        target: &args.target,
        thing: "profiles",
        formats: DRAWN_LINES,
        columns: STATION_COLUMNS,
        engine: Some(args.engine),
        layers: Vec::new(),
    };
    let input = run.open_with(&args.input, Documents::AsPolygons)?;
    let format = plan.format()?;
    plan.run_and_draw(
        run,
        input,
        move |feature, domain, stages, options| {
            let axis = timed(&mut stages.engine, || interior(domain, args.engine, options))
                .map_err(|error| Entry::unfinished(&error))?;
            let tolerance = args.tolerance.unwrap_or_else(|| domain_tolerance(domain));
            let stations = timed(&mut stages.operations, || {
                let lines = centerlines(domain, &axis, &CenterlineOptions::default())
                    .map_err(|error| Entry::no_line(&error))?;
                let line = lines.first().ok_or_else(|| Entry::no_line(&CenterlineError::NoAxis))?;
                Ok(profile(line, tolerance))
            })?;
            Ok(if format == Format::Svg {
                Found::Part(Profile { feature: feature.index, stations })
            } else {
                Found::Records(stations.iter().map(station_record).collect())
            })
        },
        |profiles, stages| {
            let what = if profiles.len() > 1 { "Width profiles" } else { "Width profile" };
            let options = Options { title: title(what, &args.input), ..Options::default() };
            Ok(timed(&mut stages.write, || write_profiles(&profiles, &options).into_bytes()))
        },
    )
}

fn found(
    args: &ClearanceArgs,
    domain: &Domain,
    axis: &MedialAxis,
    place: Place<'_>,
) -> Result<Vec<Record>, Entry> {
    let wrong = |error| Entry::internal(&error);
    if args.largest {
        let plateaus = largest_disks(domain, axis).map_err(wrong)?;
        return Ok(plateaus.iter().map(|plateau| plateau_record(axis, plateau)).collect());
    }
    let necks = necks(domain, axis, args.min).map_err(wrong)?;
    Ok(necks.iter().map(|neck| neck_record(axis, neck, place)).collect())
}

fn neck_record(axis: &MedialAxis, neck: &Neck, place: Place<'_>) -> Record {
    let mut values = values(axis, "neck", neck.width, neck.length, neck.middle);
    for governor in neck.governors {
        let site = axis.sites().at(governor);
        values.push(site.kind.name().into());
        let (feature, polygon) = place(site.polygon);
        values.push(feature.into());
        values.extend([polygon, site.ring, site.index, site.part].map(Value::from));
    }
    Record { values, shape: Shape::Line(neck.footpoints.to_vec()) }
}

fn plateau_record(axis: &MedialAxis, plateau: &Plateau) -> Record {
    let Plateau { radius, length, middle, .. } = *plateau;
    let mut values = values(axis, "largest", 2.0 * radius, length, middle);
    values.resize(COLUMNS.len(), Value::None);
    let position = |k: u32| axis.keypoints().at(k).position;
    let shape = match &plateau.keypoints_along(axis)[..] {
        [_] => Shape::Point(middle),
        along => Shape::Line(along.iter().copied().map(position).collect()),
    };
    Record { values, shape }
}

fn station_record(station: &Station) -> Record {
    let Station { along, point, width } = *station;
    let values = [along, point.x, point.y, width].map(Value::from).to_vec();
    Record { values, shape: Shape::Point(point) }
}

fn values(axis: &MedialAxis, kind: &str, width: f64, length: f64, at: Point) -> Vec<Value> {
    let mut values = vec![Value::from(kind), axis.side.name().into()];
    values.extend([width, length, at.x, at.y].map(Value::from));
    values
}
