//! What must hold for every shape.

use std::num::NonZeroUsize;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use cpu_time::ThreadTime;
use medial::axis::{Accuracy, Engine, MedialAxis};
use medial::check;
use medial::domain::{Domain, DomainError, Options};
use medial::engine::{self, EngineError, path_tracing, path_tracing_with};
use medial::geom::Point;

use super::{Polygons, Ring};

/// Polygons and how they are understood.
#[derive(Clone)]
pub struct Shape {
    pub polygons: Polygons,
    pub regroup: bool,
}

/// What came of a shape.
pub enum Outcome {
    /// It is no valid domain: a reason code and what was said.
    Refused(&'static str, String),
    Fine(Times),
    /// Domain, engine or judge say or show that something is wrong.
    Find(String),
}

/// Processor time of this thread.
#[derive(Clone, Copy, Default)]
pub struct Times {
    pub edges: usize,
    pub domain: Duration,
    pub engine: Duration,
    /// The engine that it is compared with.
    pub other: Duration,
    pub judge: Duration,
}

/// Time that the engine is given.
const LIMIT: Duration = Duration::from_secs(60);

/// What is being done, for a shape without an end.
static STAGE: Mutex<&str> = Mutex::new("");

/// What is being done at the moment.
pub fn stage() -> &'static str {
    STAGE.lock().map_or("", |stage| *stage)
}

fn enter(stage: &'static str) {
    if let Ok(mut now) = STAGE.lock() {
        *now = stage;
    }
}

/// What the last panic said.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// Keeps what panics say instead of printing it.
pub fn catch_panics() {
    panic::set_hook(Box::new(|info| {
        if let Ok(mut last) = PANIC.lock() {
            *last = info.to_string();
        }
    }));
}

/// Changes of a shape that leave the graph of its axis as it is.
#[derive(Clone, Copy, Debug)]
pub enum Image {
    Mirrored,
    TurnedByAQuarter,
    HalfAsLarge,
    StartedElsewhere,
}

impl Image {
    pub const ALL: [Self; 4] =
        [Self::Mirrored, Self::TurnedByAQuarter, Self::HalfAsLarge, Self::StartedElsewhere];

    fn of(self, polygons: &Polygons) -> Polygons {
        let point = |p: &Point| match self {
            Self::Mirrored => Point::new(p.y, p.x),
            Self::TurnedByAQuarter => Point::new(-p.y, p.x),
            Self::HalfAsLarge => *p * 0.5,
            Self::StartedElsewhere => *p,
        };
        let ring = |ring: &Ring| -> Ring {
            let mut moved: Ring = ring.iter().map(point).collect();
            if matches!(self, Self::StartedElsewhere) {
                moved.rotate_left(ring.len() / 3);
                moved.reverse();
            }
            moved
        };
        polygons.iter().map(|rings| rings.iter().map(ring).collect()).collect()
    }
}

/// What a shape is compared with.
#[derive(Clone, Copy, Debug, Default)]
pub struct Comparison {
    /// Its axis from several threads.
    pub threads: Option<NonZeroUsize>,
    /// The axis of an image of it.
    pub image: Option<Image>,
    /// The axis that another engine gives, which is judged too.
    pub engine: Option<Engine>,
}

/// Judges the axis of a shape, and compares it.
pub fn judge(shape: &Shape, with: Comparison) -> Outcome {
    guarded(|| {
        let (axis, mut times) = match judged(shape) {
            Ok(judged) => judged,
            Err(outcome) => return outcome,
        };
        if let Some(engine) = with.engine {
            match compared(shape, &axis, engine) {
                Ok(time) => times.other = time,
                Err(outcome) => return outcome,
            }
        }
        if let Some(threads) = with.threads
            && let Some(fault) = shared_fault(shape, &axis, threads)
        {
            return Outcome::Find(format!("{threads} threads: {fault}"));
        }
        let Some(image) = with.image else { return Outcome::Fine(times) };
        let moved = Shape { polygons: image.of(&shape.polygons), regroup: shape.regroup };
        match judged(&moved) {
            Err(Outcome::Refused(_, error)) => {
                Outcome::Find(format!("{image:?}: refused: {error}"))
            }
            Err(Outcome::Find(text)) => Outcome::Find(format!("{image:?}: {text}")),
            Err(fine) => fine,
            Ok((other, _)) if graph(&axis) == graph(&other) => Outcome::Fine(times),
            Ok((other, _)) => Outcome::Find(format!(
                "{image:?}: another graph, {} keypoints and {} paths instead of {} and {}",
                other.keypoints().len(),
                other.paths().len(),
                axis.keypoints().len(),
                axis.paths().len()
            )),
        }
    })
}

/// The time of the engine alone, once more.
pub fn engine_time(shape: &Shape) -> Option<Duration> {
    let domain = build(shape).ok()?;
    let start = ThreadTime::now();
    drop(std::hint::black_box(path_tracing(&domain)));
    Some(start.elapsed())
}

/// Drops the holes that make a polygon invalid, if they are few.
pub fn mend(shape: &mut Shape) {
    for _ in 0..20 {
        let told = panic::catch_unwind(AssertUnwindSafe(|| build(shape).err()));
        let Ok(Some(error)) = told else { return };
        let places = [error.other_place(), error.place()].into_iter().flatten();
        let Some(place) = places.filter(|place| place.ring > 0).max_by_key(|place| place.ring)
        else {
            return;
        };
        match shape.polygons.get_mut(place.polygon as usize) {
            Some(rings) if rings.len() > place.ring as usize => {
                rings.remove(place.ring as usize);
            }
            _ => return,
        }
    }
}

/// What is wrong with the axis from several threads.
fn shared_fault(shape: &Shape, axis: &MedialAxis, threads: NonZeroUsize) -> Option<String> {
    let domain = build(shape).ok()?;
    enter("several threads");
    let deadline = Some(Instant::now() + LIMIT);
    let options = engine::Options { threads, alone_below: 0, deadline, ..Default::default() };
    match path_tracing_with(&domain, &options) {
        Ok(other) if other == *axis => None,
        Ok(_) => Some("another axis".into()),
        Err(error) => Some(error.to_string()),
    }
}

fn build(shape: &Shape) -> Result<Domain, DomainError> {
    Domain::from_polygons(
        &shape.polygons,
        &Options { regroup: shape.regroup, ..Options::default() },
    )
}

fn guarded(work: impl FnOnce() -> Outcome) -> Outcome {
    panic::catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        Outcome::Find(PANIC.lock().map_or_else(|_| "panic".into(), |last| last.clone()))
    })
}

fn judged(shape: &Shape) -> Result<(MedialAxis, Times), Outcome> {
    enter("domain");
    let start = ThreadTime::now();
    let domain = match build(shape) {
        Ok(domain) => domain,
        Err(error @ DomainError::Internal { .. }) => return Err(Outcome::Find(error.to_string())),
        Err(error) => return Err(Outcome::Refused(error.code(), error.to_string())),
    };
    let mut times = Times { edges: domain.edges().len(), ..Times::default() };
    times.domain = start.elapsed();
    enter("engine");
    let start = ThreadTime::now();
    let deadline = Some(Instant::now() + LIMIT);
    let options = engine::Options { deadline, ..Default::default() };
    let axis =
        path_tracing_with(&domain, &options).map_err(|error| Outcome::Find(error.to_string()))?;
    times.engine = start.elapsed();
    if axis.accuracy != Accuracy::Exact || !axis.complete {
        return Err(Outcome::Find("the axis is not exact and complete".into()));
    }
    enter("judge");
    let start = ThreadTime::now();
    let defects = defects(&domain, &axis);
    times.judge = start.elapsed();
    if let Some(told) = defects { Err(Outcome::Find(told)) } else { Ok((axis, times)) }
}

/// What the judge says of an axis, if anything.
fn defects(domain: &Domain, axis: &MedialAxis) -> Option<String> {
    let verdict = check::defects(domain, axis);
    let told: Vec<String> = verdict.defects.iter().take(5).map(ToString::to_string).collect();
    if !told.is_empty() {
        return Some(told.join("\n"));
    }
    let all = verdict.left_out.is_empty() && !verdict.identities.is_empty();
    (!all).then(|| format!("the judge left out {:?}", verdict.left_out))
}

/// The time of another engine, if it gives the same axis and the judge finds nothing in that.
fn compared(shape: &Shape, axis: &MedialAxis, engine: Engine) -> Result<Duration, Outcome> {
    let find = |text: String| Outcome::Find(format!("{engine}: {text}"));
    let domain = build(shape).map_err(|error| find(error.to_string()))?;
    enter("the other engine");
    let start = ThreadTime::now();
    let deadline = Some(Instant::now() + LIMIT);
    let options = engine::Options { deadline, ..Default::default() };
    let other = match engine::interior(&domain, engine, &options) {
        Ok(other) => other,
        Err(why) => return Err(find(why.to_string())),
    };
    let time = start.elapsed();
    enter("the judge of the other engine");
    if let Some(told) = defects(&domain, &other) {
        return Err(find(told));
    }
    enter("comparing");
    let difference = check::difference(axis, &other);
    let size = axis.bounds().map_or(0.0, |(low, high)| (high - low).norm() + low.norm());
    if !difference.is_same_graph() {
        return Err(find(format!("another graph: {difference:?}")));
    }
    // Either is within 4 units in the last place of the exact one, so they are within 8.
    if difference.position > 8.0 * f64::EPSILON * size {
        return Err(find(format!("other places: {difference:?}")));
    }
    match other_side_fault(&domain, &other, engine) {
        Some(fault) => Err(find(fault)),
        None => Ok(time),
    }
}

/// What is wrong with the two sides of an engine at once, by two threads: with the interior, which is
/// known, or the exterior, which the default engine gives too.
fn other_side_fault(domain: &Domain, inside: &MedialAxis, engine: Engine) -> Option<String> {
    let deadline = Some(Instant::now() + LIMIT);
    let options = engine::Options { deadline, ..Default::default() };
    enter("the exterior");
    let outside = match engine::exterior(domain, Engine::PathTracing, None, &options) {
        Ok(outside) => outside,
        // Coordinates too large for a frame, or too far from the origin.
        Err(EngineError::Frame { .. }) => return None,
        Err(why) => return Some(format!("exterior: {why}")),
    };
    enter("both sides");
    let threads = NonZeroUsize::MIN.saturating_add(1);
    let options = engine::Options { threads, alone_below: 0, ..options };
    let [first, second] = match engine::both_sides(domain, engine, None, &options) {
        Ok(both) => both,
        Err(why) => return Some(format!("both sides: {why}")),
    };
    if first != *inside {
        return Some("another interior axis by two threads".into());
    }
    enter("the judge of the exterior");
    let told = check::defects(domain, &second).defects;
    if let Some(defect) = told.first() {
        return Some(format!("exterior: {defect}"));
    }
    let difference = check::difference(&outside, &second);
    (!difference.is_same_graph()).then(|| format!("another exterior: {difference:?}"))
}

/// Numbers that any labelling of a graph has in common: governors of all keypoints by degree.
fn graph(axis: &MedialAxis) -> (usize, usize, Vec<usize>) {
    let count = axis.keypoints().len() as u32;
    let mut degrees: Vec<usize> = (0..count).map(|k| axis.governors(k).len()).collect();
    degrees.sort_unstable();
    (axis.sites().len(), axis.paths().len(), degrees)
}
