use super::features::Run;
use crate::args::LocateArgs;
use crate::failure::{Failure, Status};
use crate::metric::Metric;
use crate::output::Output;
use crate::report::Entry;
use crate::timings::timed;
use medial::geom::Point;
use medial::ops::Voronoi;
use medial_io::location_document;
use std::time::Duration;

/// `medial locate`.
pub fn run(args: &'static LocateArgs) -> Result<Status, Failure> {
    let point = Point::new(args.x, args.y);
    Metric::refuse(&args.common, "locate")?;
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.flattening.tolerance;
    let input = run.open(&args.input)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let mut output = Output::create(args.output.as_deref())?;
    let mut write = Duration::ZERO;
    let (at_once, _) = run.threads(&layer);
    let status = run.each(
        &input.name,
        layer,
        at_once,
        move |feature, domain, stages, bytes| {
            // One point among the edges near it costs less than an axis, and is as exact.
            let located = timed(&mut stages.operations, || {
                Voronoi::new(domain, &[]).and_then(|voronoi| voronoi.locate(point))
            });
            let located = located.map_err(|error| Entry::internal(&error))?;
            let line = location_document::write(feature, point, &located);
            timed(&mut stages.write, || bytes.extend_from_slice(line.as_bytes()));
            Ok(())
        },
        |()| {},
        |bytes| timed(&mut write, || output.write(bytes)),
    )?;
    if status != Status::NoResult {
        timed(&mut write, || output.finish())?;
    }
    run.stages.write += write;
    run.finish()?;
    Ok(status)
}
