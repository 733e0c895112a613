use super::axis::trace;
use super::features::Run;
use super::records::{LINES, Plan};
use crate::args::ClearanceArgs;
use crate::failure::{Failure, Status};
use crate::input::Documents;
use crate::report::Entry;
use crate::timings::timed;
use medial::axis::MedialAxis;
use medial::domain::Domain;
use medial::geom::Point;
use medial::ops::{Neck, Plateau, largest_disks, necks};
use medial_io::record::{Record, Shape, Value};

const COLUMNS: &[&str] = &[
    "kind",
    "side",
    "width",
    "length",
    "x",
    "y",
    "left_kind",
    "left_polygon",
    "left_ring",
    "left_index",
    "left_part",
    "right_kind",
    "right_polygon",
    "right_ring",
    "right_index",
    "right_part",
];

/// `medial clearance`.
pub fn run(args: &ClearanceArgs) -> Result<Status, Failure> {
    args.region.check()?;
    let mut run = Run::new(&args.common)?;
    let plan = Plan {
        target: &args.target,
        thing: if args.largest { "disks" } else { "necks" },
        formats: LINES,
        columns: COLUMNS,
        engine: args.engine,
    };
    let input = run.open_with(&args.input, Documents::AsPolygons)?;
    plan.run(run, &input, |_, domain, stages, options| {
        let axes = timed(&mut stages.engine, || trace(args.engine, &args.region, domain, options))?;
        timed(&mut stages.operations, || {
            let mut records = Vec::new();
            for axis in &axes {
                records.extend(found(args, domain, axis)?);
            }
            Ok(records)
        })
    })
}

fn found(args: &ClearanceArgs, domain: &Domain, axis: &MedialAxis) -> Result<Vec<Record>, Entry> {
    let wrong = |error| Entry::internal(&error);
    if args.largest {
        let plateaus = largest_disks(domain, axis).map_err(wrong)?;
        return Ok(plateaus.iter().map(|plateau| plateau_record(axis, plateau)).collect());
    }
    let necks = necks(domain, axis, args.min).map_err(wrong)?;
    Ok(necks.iter().map(|neck| neck_record(axis, neck)).collect())
}

fn neck_record(axis: &MedialAxis, neck: &Neck) -> Record {
    let mut values = values(axis, "neck", neck.width, neck.length, neck.middle);
    for governor in neck.governors {
        let site = axis.sites().at(governor);
        values.push(site.kind.name().into());
        values.extend([site.polygon, site.ring, site.index, site.part].map(Value::from));
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

fn values(axis: &MedialAxis, kind: &str, width: f64, length: f64, at: Point) -> Vec<Value> {
    let mut values = vec![Value::from(kind), axis.side.name().into()];
    values.extend([width, length, at.x, at.y].map(Value::from));
    values
}
