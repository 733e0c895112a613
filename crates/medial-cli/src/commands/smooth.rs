use super::features::Run;
use super::records::{POLYGONS, Plan};
use crate::args::SmoothArgs;
use crate::failure::{Failure, Status};
use crate::input::Documents;
use crate::report::Entry;
use crate::timings::timed;
use medial::engine::interior;
use medial::ops::{Measure, smoothed};
use medial_io::domain_tolerance;
use medial_io::record::{Record, Shape, Value};

/// The prominence below which limbs are removed unless another threshold is given.
const PROMINENCE: (Measure, f64) = (Measure::Prominence, 0.1);

const COLUMNS: &[&str] = &["measure", "threshold", "distance", "area"];

/// `medial smooth`.
pub fn run(args: &'static SmoothArgs) -> Result<Status, Failure> {
    let (measure, threshold) = args.pruning.threshold().unwrap_or(PROMINENCE);
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
    let input = run.open_with(&args.input, Documents::AsPolygons)?;
    plan.run(run, input, move |_, domain, stages, options| {
        let axis = timed(&mut stages.engine, || interior(domain, args.engine, options))
            .map_err(|error| Entry::unfinished(&error))?;
        timed(&mut stages.operations, || {
            let smooth = smoothed(domain, &axis, measure, threshold)
                .map_err(|error| Entry::internal(&error))?;
            let tolerance = args.tolerance.unwrap_or_else(|| domain_tolerance(domain));
            let values = vec![
                Value::from(measure.name()),
                threshold.into(),
                smooth.distance.into(),
                smooth.outline.area().into(),
            ];
            Ok(vec![Record { values, shape: Shape::Polygons(smooth.outline.polygons(tolerance)) }])
        })
    })
}
