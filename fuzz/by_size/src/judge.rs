//! What must hold for every shape.

use std::panic::{self, AssertUnwindSafe};
use std::sync::Mutex;
use std::time::Duration;

use cpu_time::ThreadTime;
use medial::axis::{Accuracy, MedialAxis};
use medial::check;
use medial::domain::{Domain, DomainError, Options};
use medial::engine::path_tracing;
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
    /// It is no valid domain.
    Refused(DomainError),
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
    pub judge: Duration,
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

/// Judges the axis of a shape, and compares it with that of an image if one is wanted.
pub fn judge(shape: &Shape, image: Option<Image>) -> Outcome {
    guarded(|| {
        let (axis, times) = match judged(shape) {
            Ok(judged) => judged,
            Err(outcome) => return outcome,
        };
        let Some(image) = image else { return Outcome::Fine(times) };
        let moved = Shape { polygons: image.of(&shape.polygons), regroup: shape.regroup };
        match judged(&moved) {
            Err(Outcome::Refused(error)) => Outcome::Find(format!("{image:?}: refused: {error}")),
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

fn build(shape: &Shape) -> Result<Domain, DomainError> {
    Domain::from_polygons(&shape.polygons, &Options { strict: false, regroup: shape.regroup })
}

fn guarded(work: impl FnOnce() -> Outcome) -> Outcome {
    panic::catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        Outcome::Find(PANIC.lock().map_or_else(|_| "panic".into(), |last| last.clone()))
    })
}

fn judged(shape: &Shape) -> Result<(MedialAxis, Times), Outcome> {
    let start = ThreadTime::now();
    let domain = match build(shape) {
        Ok(domain) => domain,
        Err(error @ DomainError::Internal { .. }) => return Err(Outcome::Find(error.to_string())),
        Err(error) => return Err(Outcome::Refused(error)),
    };
    let mut times = Times { edges: domain.edges().len(), ..Times::default() };
    times.domain = start.elapsed();
    let start = ThreadTime::now();
    let axis = path_tracing(&domain).map_err(|error| Outcome::Find(error.to_string()))?;
    times.engine = start.elapsed();
    if axis.accuracy != Accuracy::Exact || !axis.complete {
        return Err(Outcome::Find("the axis is not exact and complete".into()));
    }
    let start = ThreadTime::now();
    let verdict = check::defects(&domain, &axis);
    times.judge = start.elapsed();
    let told: Vec<String> = verdict.defects.iter().take(5).map(ToString::to_string).collect();
    if !told.is_empty() {
        return Err(Outcome::Find(told.join("\n")));
    }
    if !verdict.left_out.is_empty() || verdict.identities.is_empty() {
        return Err(Outcome::Find(format!("the judge left out {:?}", verdict.left_out)));
    }
    Ok((axis, times))
}

/// Numbers that any labelling of a graph has in common: governors of all keypoints by degree.
fn graph(axis: &MedialAxis) -> (usize, usize, Vec<usize>) {
    let count = axis.keypoints().len() as u32;
    let mut degrees: Vec<usize> = (0..count).map(|k| axis.governors(k).len()).collect();
    degrees.sort_unstable();
    (axis.sites().len(), axis.paths().len(), degrees)
}
