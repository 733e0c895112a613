use super::features::Run;
use super::records::{Found, Plan};
use super::sink::{boundary, title};
use crate::args::{CarveArgs, Units};
use crate::failure::{Failure, Status};
use crate::parallel::kept;
use crate::report::Entry;
use crate::timings::timed;
use medial::engine::interior;
use medial::geom::Point;
use medial::ops::{CarveOptions, Carving, Clearing, Move, Role, Sense, Tip, carve, carving_order};
use medial_io::gcode::{self, GCodeError, Machine, Unit};
use medial_io::record::{Record, Shape, Value};
use medial_io::svg::{Options, ToolPath, write_tool_paths};
use medial_io::{Format, domain_tolerance};

const COLUMNS: &[&str] = &[
    "pass",
    "step",
    "role",
    "kind",
    "length",
    "x_from",
    "y_from",
    "z_from",
    "x_control",
    "y_control",
    "z_control",
    "weight",
    "x_centre",
    "y_centre",
    "radius",
    "sense",
    "x_to",
    "y_to",
    "z_to",
];

const FORMATS: &[Format] = &[
    Format::GeoJson,
    Format::GeoJsonLines,
    Format::Csv,
    Format::Wkt,
    Format::Wkb,
    Format::Dxf,
    Format::Svg,
    Format::GCode,
];

/// What a picture or a program is made of.
struct Part {
    path: ToolPath,
    tolerance: f64,
}

/// `medial carve`.
pub fn run(args: &'static CarveArgs) -> Result<Status, Failure> {
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let plan = Plan {
        target: &args.target,
        thing: "tool paths",
        formats: FORMATS,
        columns: COLUMNS,
        engine: Some(args.engine),
        layers: Vec::new(),
    };
    let format = plan.format()?;
    let machine = machine(args, format)?;
    let asked = CarveOptions {
        angle: args.angle,
        depth: args.depth,
        clearing: args.clear.map(|(radius, step)| Clearing { radius, step }),
        leave: args.leave,
        lift: args.lift,
    };
    let input = run.open(&args.input)?;
    if args.tolerance.is_some() && format == Format::Svg && !input.format.has_curves() {
        let why = "--tolerance is for what draws curves as lines; in svg they are exact";
        return Err(Failure::Usage(why.to_owned()));
    }
    let name = title("Tool path", &args.input);
    let machine = kept(machine);
    plan.run_and_draw(
        run,
        input,
        move |_, domain, stages, options| {
            let axis = timed(&mut stages.engine, || interior(domain, args.engine, options))
                .map_err(|error| Entry::unfinished(&error))?;
            let carving = timed(&mut stages.operations, || carve(domain, &axis, &asked))
                .map_err(|error| Entry::refused("tool_path", error.to_string()))?;
            let tolerance = args.tolerance.unwrap_or_else(|| domain_tolerance(domain));
            if let Some(machine) = machine {
                machine
                    .check_path(&carving)
                    .map_err(|error| Entry::refused("tool_path", error.to_string()))?;
            }
            if matches!(format, Format::Svg | Format::GCode) {
                let path = ToolPath { boundary: boundary(domain), carving };
                return Ok(Found::Part(Part { path, tolerance }));
            }
            Ok(timed(&mut stages.write, || Found::Records(records(&carving, tolerance))))
        },
        |parts, stages| {
            timed(&mut stages.write, || match machine {
                Some(machine) => {
                    let path = |Part { path, tolerance }| (path.carving, tolerance);
                    let paths: Vec<(Carving, f64)> = parts.into_iter().map(path).collect();
                    let program = gcode::write(&paths, machine, &name).map_err(wrong)?;
                    Ok(program.into_bytes())
                }
                None => {
                    let mut paths: Vec<ToolPath> =
                        parts.into_iter().map(|part| part.path).collect();
                    in_order(&mut paths);
                    let options = Options { title: name, ..Options::default() };
                    Ok(write_tool_paths(&paths, &options).into_bytes())
                }
            })
        },
    )
}

/// Sorts tool paths as a machine takes them.
fn in_order(paths: &mut Vec<ToolPath>) {
    let order = carving_order(&paths.iter().map(|path| &path.carving).collect::<Vec<_>>());
    let mut taken: Vec<Option<ToolPath>> = paths.drain(..).map(Some).collect();
    paths.extend(order.into_iter().filter_map(|k| taken[k].take()));
}

fn wrong(error: GCodeError) -> Failure {
    Failure::Usage(error.to_string())
}

/// The machine of a program, if one is written.
fn machine(args: &CarveArgs, format: Format) -> Result<Option<Machine>, Failure> {
    let given = [
        ("--units", args.units.is_some()),
        ("--feed", args.feed.is_some()),
        ("--plunge", args.plunge.is_some()),
        ("--safe-height", args.safe_height.is_some()),
        ("--spindle", args.spindle.is_some()),
    ];
    if format != Format::GCode {
        return match given.iter().find(|(_, is_given)| *is_given) {
            Some((name, _)) => {
                Err(Failure::Usage(format!("{name} is for gcode; see --to in --help")))
            }
            None => Ok(None),
        };
    }
    let (Some(feed), Some(safe_height)) = (args.feed, args.safe_height) else {
        let why = "a program needs --feed and --safe-height";
        return Err(Failure::Usage(why.to_owned()));
    };
    let unit = match args.units {
        None | Some(Units::Mm) => Unit::Millimetre,
        Some(Units::Inch) => Unit::Inch,
    };
    let plunge = args.plunge.unwrap_or(0.5 * feed);
    let machine = Machine { unit, feed, plunge, safe_height, spindle: args.spindle };
    machine.check().map_err(wrong)?;
    Ok(Some(machine))
}

/// A record for each move of each pass.
fn records(carving: &Carving, tolerance: f64) -> Vec<Record> {
    let mut records = Vec::new();
    for (pass, steps) in (0_usize..).zip(&carving.passes) {
        for (step, (role, cut)) in (0_usize..).zip(carving.steps(steps)) {
            let (from, to) = (cut.from(), cut.to());
            let shape = if from == to {
                Shape::PointInSpace(from.point, from.z)
            } else {
                let points = cut.polyline(tolerance).into_iter().map(|tip| (tip.point, tip.z));
                Shape::LineInSpace(points.collect())
            };
            records.push(Record { values: values(pass, step, role, &cut), shape });
        }
    }
    records
}

fn values(pass: usize, step: usize, role: Role, cut: &Move) -> Vec<Value> {
    let place = |tip: Tip| [tip.point.x, tip.point.y, tip.z].map(Value::from);
    let nothing = |n: usize| vec![Value::None; n];
    let mut values =
        vec![pass.into(), step.into(), role.name().into(), cut.name().into(), cut.length().into()];
    values.extend(place(cut.from()));
    match *cut {
        Move::Quadratic { control, .. } => {
            values.extend(place(control));
            values.push(1.0.into());
            values.extend(nothing(4));
        }
        Move::Conic { control, weight, .. } => {
            values.extend(place(control));
            values.push(weight.into());
            values.extend(nothing(4));
        }
        Move::Arc { centre: Point { x, y }, radius, sense, .. } => {
            values.extend(nothing(4));
            values.extend([x, y, radius].map(Value::from));
            values.push(match sense {
                Sense::Counterclockwise => "counterclockwise".into(),
                Sense::Clockwise => "clockwise".into(),
            });
        }
        Move::Line { .. } => values.extend(nothing(8)),
    }
    values.extend(place(cut.to()));
    values
}
