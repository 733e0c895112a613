use super::features::Run;
use super::records::{DRAWN_LINES, Found, Plan};
use super::sink::{boundary, title};
use crate::args::WallsArgs;
use crate::failure::{Failure, Status};
use crate::report::Entry;
use crate::timings::timed;
use medial::engine::interior;
use medial::ops::{Wall, WallOptions, Widths, thin_walls};
use medial_io::record::{Record, Shape};
use medial_io::svg::{Options, ThinWalls, write_walls};
use medial_io::{Format, domain_tolerance};

const COLUMNS: &[&str] = &["length", "width_min", "width_max", "width_mean", "closed"];

/// `medial walls`.
pub fn run(args: &'static WallsArgs) -> Result<Status, Failure> {
    if args.min > args.max {
        let why = format!("--min {} is more than --max {}", args.min, args.max);
        return Err(Failure::Usage(why));
    }
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let plan = Plan {
        target: &args.target,
        thing: "walls",
        formats: DRAWN_LINES,
        columns: COLUMNS,
        engine: Some(args.engine),
        layers: Vec::new(),
    };
    let format = plan.format()?;
    let usual = WallOptions::between(args.min, args.max);
    let asked = WallOptions { ends: args.ends.unwrap_or(usual.ends), ..usual };
    let input = run.open(&args.input)?;
    let picture = Options { title: title("Thin walls", &args.input), ..Options::default() };
    plan.run_and_draw(
        run,
        input,
        move |_, domain, stages, options| {
            let axis = timed(&mut stages.engine, || interior(domain, args.engine, options))
                .map_err(|error| Entry::unfinished(&error))?;
            let walls = timed(&mut stages.operations, || thin_walls(domain, &axis, &asked))
                .map_err(|error| Entry::internal(&error))?;
            let tolerance = args.tolerance.unwrap_or_else(|| domain_tolerance(domain));
            if format == Format::Svg {
                let walls = walls.iter().map(|wall| wall.polyline(tolerance)).collect();
                return Ok(Found::Part(ThinWalls { boundary: boundary(domain), walls }));
            }
            Ok(Found::Records(walls.iter().map(|wall| record(wall, tolerance)).collect()))
        },
        |shapes, stages| {
            Ok(timed(&mut stages.write, || write_walls(&shapes, &picture).into_bytes()))
        },
    )
}

fn record(wall: &Wall, tolerance: f64) -> Record {
    let Widths { least, greatest, mean } = wall.widths();
    let mut values = vec![wall.length().into()];
    values.extend([least, greatest, mean].map(Into::into));
    values.push(wall.is_closed().into());
    let shape = match wall.polyline(tolerance)[..] {
        [(point, width)] => Shape::PointInSpace(point, width),
        ref points => Shape::LineInSpace(points.to_vec()),
    };
    Record { values, shape }
}
