use super::axis::{pruned, traced};
use super::features::Run;
use super::records::{LINES, Plan};
use crate::args::{BranchesArgs, Cut};
use crate::failure::{Failure, Status};
use crate::input::Documents;
use crate::output::Output;
use crate::parallel::kept;
use crate::report::Entry;
use crate::timings::{Stages, timed};
use medial::axis::{Curve, Engine, MedialAxis, Side};
use medial::domain::Domain;
use medial::engine::{self, both_sides};
use medial::geom::Point;
use medial::ops::{
    Branch, BranchPiece, Extent, Limb, LimbPair, Measure, branches, limb_pairs, limbs,
};
use medial_io::record::{Record, Shape, Value};
use medial_io::{Feature, domain_tolerance, limb_document};
use std::path::Path;
use std::time::Duration;

const COLUMNS: &[&str] = &[
    "side",
    "branch",
    "piece",
    "primitive",
    "trend",
    "bend",
    "length",
    "area",
    "radius_start",
    "radius_end",
    "radius_min",
    "radius_max",
    "radius_mean",
    "from",
    "to",
    "kind_start",
    "kind_end",
    "closed",
    "boundary_left",
    "boundary_right",
];

const LIMB_COLUMNS: &[&str] = &[
    "limb",
    "kind",
    "length",
    "straightness",
    "mouth_width",
    "direction_x",
    "direction_y",
    "tip_x",
    "tip_y",
];

/// What lies below this is no limb, unless another threshold is given.
const LIMB: (Measure, f64) = (Measure::RelativeExcess, 0.5);

/// `medial branches`.
pub fn run(args: &'static BranchesArgs) -> Result<Status, Failure> {
    args.region.check()?;
    args.engine.check()?;
    args.pruning.check(&args.engine)?;
    if let Some(other) = &args.matching {
        return pairs(args, other);
    }
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let plan = Plan {
        target: &args.target,
        thing: if args.limbs { "limbs" } else { "branches" },
        formats: LINES,
        columns: if args.limbs { LIMB_COLUMNS } else { COLUMNS },
        engine: args.engine.engine,
        layers: Vec::new(),
    };
    let input = run.open_with(&args.input, Documents::AsPolygons)?;
    args.engine.check_input(input.format)?;
    plan.run(run, input, move |feature, domain, stages, options| {
        let tolerance = args.tolerance.unwrap_or_else(|| domain_tolerance(domain));
        if args.limbs {
            let sides = timed(&mut stages.engine, || {
                traced(
                    &args.engine,
                    &args.region,
                    &args.pruning,
                    feature,
                    domain,
                    options,
                    &mut None,
                )
            })?;
            let limbs = timed(&mut stages.operations, || all_limbs(args, domain, &sides))?;
            return Ok((0_usize..)
                .zip(&limbs)
                .map(|(k, limb)| limb_record(k, limb, tolerance))
                .collect());
        }
        let axes = timed(&mut stages.engine, || {
            traced(&args.engine, &args.region, &args.pruning, feature, domain, options, &mut None)
        })?;
        timed(&mut stages.operations, || {
            let mut records = Vec::new();
            for axis in axes {
                let axis = pruned(&args.pruning, feature, domain, axis)?;
                for (number, branch) in branches(&axis).iter().enumerate() {
                    match args.by {
                        Cut::Branch => {
                            records.push(branch_record(&axis, number, &branch, tolerance))
                        }
                        Cut::Primitive => {
                            let piece = |(k, piece)| {
                                piece_record(&axis, (number, &branch), (k, &piece), tolerance)
                            };
                            records.extend(branch.pieces().enumerate().map(piece));
                        }
                    }
                }
            }
            Ok(records)
        })
    })
}

fn line(curves: impl Iterator<Item = Curve>, tolerance: f64) -> Shape {
    let mut points: Vec<Point> = Vec::new();
    for curve in curves {
        let skip = usize::from(!points.is_empty());
        points.extend(curve.polyline(tolerance).into_iter().skip(skip).map(|(p, _)| p));
    }
    Shape::Line(points)
}

fn extent(extent: &Extent) -> [Value; 7] {
    let Extent { length, area, radius_start, radius_end, radius_min, radius_max, radius_mean } =
        *extent;
    [length, area, radius_start, radius_end, radius_min, radius_max, radius_mean].map(Value::from)
}

/// What is said of a branch behind its own values.
fn ends(axis: &MedialAxis, branch: &Branch<'_>) -> Vec<Value> {
    let kind = |keypoint: u32| axis.keypoints().at(keypoint).kind.name();
    let (from, to) = (branch.from(), branch.to());
    let [left, right] = branch.boundary_lengths();
    vec![
        from.into(),
        to.into(),
        kind(from).into(),
        kind(to).into(),
        branch.is_closed().into(),
        left.into(),
        right.into(),
    ]
}

fn branch_record(axis: &MedialAxis, number: usize, branch: &Branch<'_>, tolerance: f64) -> Record {
    // All of its pieces, one after the other.
    let joined = |word: fn(&BranchPiece<'_>) -> &'static str| {
        Value::Text(branch.pieces().map(|piece| word(&piece)).collect::<Vec<_>>().join(" "))
    };
    let mut values =
        vec![Value::from(axis.side.name()), number.into(), branch.pieces().len().into()];
    values.push(joined(|piece| piece.primitive().name()));
    values.push(joined(|piece| piece.trend().map_or("-", |trend| trend.name())));
    values.push(joined(|piece| piece.bend().name()));
    values.extend(extent(&branch.extent()));
    values.extend(ends(axis, branch));
    Record { values, shape: line(branch.curves(), tolerance) }
}

fn piece_record(
    axis: &MedialAxis,
    (number, branch): (usize, &Branch<'_>),
    (k, piece): (usize, &BranchPiece<'_>),
    tolerance: f64,
) -> Record {
    let mut values = vec![Value::from(axis.side.name()), number.into(), k.into()];
    values.push(piece.primitive().name().into());
    values.push(piece.trend().map_or(Value::None, |trend| trend.name().into()));
    values.push(piece.bend().name().into());
    values.extend(extent(&piece.extent()));
    values.extend(ends(axis, branch));
    // The boundary is that of the branch.
    let n = values.len();
    values[n - 2..].fill(Value::None);
    Record { values, shape: line(piece.curves(), tolerance) }
}

/// The axes of both sides.
fn sides(
    engine: Engine,
    domain: &Domain,
    stages: &mut Stages,
    options: &engine::Options<'_>,
) -> Result<[MedialAxis; 2], Entry> {
    timed(&mut stages.engine, || both_sides(domain, engine, None, options))
        .map_err(|error| Entry::unfinished(&error))
}

/// Peninsulas, then bays.
fn all_limbs(
    args: &BranchesArgs,
    domain: &Domain,
    sides: &[MedialAxis],
) -> Result<Vec<Limb>, Entry> {
    let (measure, threshold) = args.pruning.threshold().unwrap_or(LIMB);
    let mut all = Vec::new();
    for axis in sides {
        let limbs = limbs(domain, axis, measure, threshold);
        all.extend(limbs.map_err(|error| Entry::internal(&error))?);
    }
    Ok(all)
}

fn limb_record(number: usize, limb: &Limb, tolerance: f64) -> Record {
    let kind = if limb.side == Side::Interior { "peninsula" } else { "bay" };
    let mut values = vec![Value::from(number), kind.into()];
    let (direction, tip) = (limb.direction, limb.tip);
    let numbers = [limb.length, limb.straightness, limb.mouth_width()];
    values.extend(
        numbers.into_iter().chain([direction.x, direction.y, tip.x, tip.y]).map(Value::from),
    );
    Record { values, shape: line(limb.curves.iter().copied(), tolerance) }
}

/// Limbs of a feature, by its number.
type Limbs = (usize, Vec<Limb>);

/// Pairs of the limbs of one file with those of another one.
fn pairs(args: &'static BranchesArgs, other: &Path) -> Result<Status, Failure> {
    if args.input.as_os_str() == "-" && other.as_os_str() == "-" {
        let why = "both shapes cannot come from standard input; name a file";
        return Err(Failure::Usage(why.to_owned()));
    }
    let mut others: Vec<Limbs> = Vec::new();
    let mut ignore = |_: &[u8]| Ok(());
    let status = each(args, other, |_, limbs, _| limbs, |limbs| others.push(limbs), &mut ignore)?;
    if status == Status::NoResult {
        return Ok(status);
    }
    let others: &'static [Limbs] = kept(others);
    let mut output = Output::create(args.target.output.as_deref())?;
    let told = each(
        args,
        &args.input,
        move |feature, limbs, bytes: &mut Vec<u8>| {
            for (number, theirs) in others {
                for (moves_first, found) in
                    [(true, of_kinds(&limbs.1, theirs)), (false, of_kinds(theirs, &limbs.1))]
                {
                    for pair in found {
                        limb_document::write(bytes, feature, *number, moves_first, &pair);
                    }
                }
            }
        },
        |()| {},
        &mut |bytes: &[u8]| output.write(bytes),
    )?;
    if told != Status::NoResult {
        output.finish()?;
    }
    Ok(if told == Status::Done { status } else { told })
}

/// Pairs of the peninsulas of one and the bays of another one, by their numbers among all limbs.
fn of_kinds(one: &[Limb], other: &[Limb]) -> Vec<LimbPair> {
    let of = |limbs: &[Limb], side: Side| -> (Vec<usize>, Vec<Limb>) {
        let kept = limbs.iter().enumerate().filter(|(_, limb)| limb.side == side);
        kept.map(|(k, limb)| (k, limb.clone())).unzip()
    };
    let (inside, peninsulas) = of(one, Side::Interior);
    let (outside, bays) = of(other, Side::Exterior);
    let renumbered = |pair: LimbPair| LimbPair {
        peninsula: inside[pair.peninsula],
        bay: outside[pair.bay],
        ..pair
    };
    limb_pairs(&peninsulas, &bays).into_iter().map(renumbered).collect()
}

/// Calls `work` with the limbs of each feature of a file.
fn each<R: Send + 'static>(
    args: &'static BranchesArgs,
    input: &Path,
    work: impl Fn(&Feature, Limbs, &mut Vec<u8>) -> R + Send + Sync + 'static,
    done: impl FnMut(R),
    write: &mut dyn FnMut(&[u8]) -> Result<(), Failure>,
) -> Result<Status, Failure> {
    let mut run = Run::new(&args.common)?;
    run.tolerance = args.tolerance;
    let input = run.open_with(input, Documents::AsPolygons)?;
    let layer = timed(&mut run.stages.read, || input.layer())?;
    let (at_once, threads) = run.threads(&layer);
    let mut time = Duration::ZERO;
    let status = run.each(
        &input.name,
        layer,
        at_once,
        move |feature, domain, stages, bytes| {
            let options = stages.options(threads);
            let engine = args.engine.engine.unwrap_or(Engine::PathTracing);
            let sides = sides(engine, domain, stages, &options)?;
            let limbs = timed(&mut stages.operations, || all_limbs(args, domain, &sides))?;
            Ok(work(feature, (feature.index, limbs), bytes))
        },
        done,
        |bytes| timed(&mut time, || write(bytes)),
    )?;
    run.stages.write += time;
    run.finish()?;
    Ok(status)
}
