//! Fuzzing by size: shapes of many families, with 10 to 100,000 edges, each judged in full.
//!
//! Every shape is known by its family, size and seed; `--replay` draws it again. With `--engine`
//! the axis of another engine is judged as well, and compared: inside, outside, and both at once.

mod chains;
mod families;
mod grids;
mod judge;
mod pose;
mod reduce;
mod rounds;
#[path = "../../src/sketch.rs"]
mod sketch;
mod tangles;
mod tell;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};
use std::{env, fs, process, thread};

use medial::axis::Engine;
use medial::geom::Point;
use medial_bench::shapes::Random;

use families::{FAMILIES, Family, Ground, HOLED, TINY_GRID};
use judge::{Comparison, Image, Outcome, Shape};
use tell::Summary;

/// Closed list of points, the last one joined to the first.
type Ring = Vec<Point>;

/// Polygons of a feature, each a list of rings, the outer one first.
type Polygons = Vec<Vec<Ring>>;

const USAGE: &str = "usage: fuzz-by-size [--minutes M] [--seed S] [--engine E] [--family F] \
[--least EDGES] [--most EDGES] [--finds DIR] [--replay \"FAMILY EDGES SEED\"]

Draws shapes until the time is up (10 minutes unless told) and prints what is found. With --engine
this engine must give the same axis as path_tracing, on 4 to 10,000 edges unless told: a third of the
shapes on a tiny grid, a third with holes. The exit status is 1 if a shape has a defect, an error, a
panic, no end or two axes; slow shapes are only told.";

/// Time of the engine beyond which a shape is told as slow: a part for each edge and a fixed part.
const SLOW: (Duration, Duration) = (Duration::from_micros(30), Duration::from_millis(200));

/// Time after which a shape counts as one without an end.
const HANGS: Duration = Duration::from_secs(120);

/// Time for making a find smaller.
const REDUCING: Duration = Duration::from_secs(60);

/// Most edges of shapes that are compared with an image.
const COMPARED: usize = 5_000;

struct Options {
    time: Duration,
    seed: u64,
    /// Compared with `path_tracing`.
    engine: Option<Engine>,
    family: Option<String>,
    sizes: (usize, usize),
    finds: PathBuf,
    replay: Option<Drawing>,
}

/// What a shape is known by.
#[derive(Clone)]
struct Drawing {
    family: String,
    edges: usize,
    seed: u64,
}

/// The shape at work and since when.
type Running = Arc<Mutex<Option<(Instant, String, Shape)>>>;

fn main() -> ExitCode {
    let options = match options() {
        Ok(options) => options,
        Err(text) => {
            eprintln!("{text}\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    if let Err(error) = fs::create_dir_all(&options.finds) {
        eprintln!("{}: {error}", options.finds.display());
        return ExitCode::from(2);
    }
    judge::catch_panics();
    let running = Running::default();
    watch(&running, &options.finds);
    let mut summary = Summary::default();
    if let Some(drawing) = &options.replay {
        one(drawing, &options, &running, &mut summary);
    } else {
        println!("seed {}", options.seed);
        let random = &mut Random::new(options.seed);
        let start = Instant::now();
        let mut told = start;
        while start.elapsed() < options.time {
            one(&next(random, &options), &options, &running, &mut summary);
            if told.elapsed() > Duration::from_secs(60) {
                told = Instant::now();
                println!("{} min: {}", start.elapsed().as_secs() / 60, summary.total());
            }
        }
    }
    println!("{summary}");
    if summary.finds() > 0 { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

fn options() -> Result<Options, String> {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos());
    let mut options = Options {
        time: Duration::from_secs(600),
        seed: now as u64 % 1_000_000_000_000,
        engine: None,
        family: None,
        sizes: (0, 0),
        finds: env::temp_dir().join("medial-finds"),
        replay: None,
    };
    let (mut least, mut most) = (None, None);
    let mut words = env::args().skip(1);
    while let Some(word) = words.next() {
        let value = words.next().ok_or(format!("{word}: no value"))?;
        let wrong = |_| format!("{word} {value}: no such number");
        match word.as_str() {
            "--minutes" => {
                let minutes: f64 =
                    value.parse().map_err(|_| format!("{word} {value}: no such number"))?;
                options.time =
                    Duration::try_from_secs_f64(60.0 * minutes).map_err(|e| e.to_string())?;
            }
            "--seed" => options.seed = value.parse().map_err(wrong)?,
            "--engine" => options.engine = Some(value.parse().map_err(|e| format!("{word}: {e}"))?),
            "--family" => options.family = Some(known(&value)?.name.into()),
            "--least" => least = Some(value.parse().map_err(wrong)?),
            "--most" => most = Some(value.parse().map_err(wrong)?),
            "--finds" => options.finds = value.into(),
            "--replay" => {
                let [family, edges, seed] = value.split_whitespace().collect::<Vec<_>>()[..] else {
                    return Err(format!("{word} {value}: not three words"));
                };
                options.replay = Some(Drawing {
                    family: known(family)?.name.into(),
                    edges: edges.parse().map_err(wrong)?,
                    seed: seed.parse().map_err(wrong)?,
                });
            }
            _ => return Err(format!("{word}: no such option")),
        }
    }
    let usual = if options.engine.is_some() { (4, 10_000) } else { (10, 100_000) };
    let (least, most) = (least.unwrap_or(usual.0), most.unwrap_or(usual.1));
    options.sizes = (least, most);
    if least < 3 || most < least {
        return Err(format!("sizes from {least} to {most}"));
    }
    Ok(options)
}

fn known(name: &str) -> Result<&'static Family, String> {
    let names = || FAMILIES.map(|family| family.name).join(", ");
    FAMILIES
        .iter()
        .find(|family| family.name == name)
        .ok_or_else(|| format!("{name}: not one of {}", names()))
}

/// Any family, and a size whose logarithm is anywhere.
fn next(random: &mut Random, options: &Options) -> Drawing {
    let name = match (&options.family, options.engine) {
        (Some(name), _) => Some(name.as_str()),
        (None, Some(_)) => {
            [Some(TINY_GRID), Some(HOLED[random.below(HOLED.len())]), None][random.below(3)]
        }
        (None, None) => None,
    };
    let family = name.and_then(|name| FAMILIES.iter().find(|family| family.name == name));
    let family = family.unwrap_or(&FAMILIES[random.below(FAMILIES.len())]);
    let (least, most) = options.sizes;
    let most = most.min(family.most).max(least);
    let power = random.between((least as f64).ln(), (most as f64).ln());
    let edges = (power.exp().round() as usize).clamp(least, most);
    Drawing { family: family.name.into(), edges, seed: random.next() }
}

/// Draws and judges a shape, and tells and keeps what is wrong with it.
fn one(drawing: &Drawing, options: &Options, running: &Running, summary: &mut Summary) {
    let Some(family) = FAMILIES.iter().find(|family| family.name == drawing.family) else { return };
    let random = &mut Random::new(drawing.seed);
    let mut polygons = family.draw(random, drawing.edges);
    let pose = pose::pose(random, &mut polygons, family.ground);
    let regroup = family.ground == Ground::Touching;
    let mut shape = Shape { polygons, regroup };
    judge::mend(&mut shape);
    let name = format!("{} {} {}", drawing.family, drawing.edges, drawing.seed);
    let file = |what: &str| options.finds.join(format!("{what}_{}.wkt", name.replace(' ', "_")));
    // What a crash without a panic leaves behind.
    keep(&options.finds.join("last.txt"), &format!("{name}: {pose}\n"));
    if let Ok(mut running) = running.lock() {
        *running = Some((Instant::now(), format!("{name}: {pose}"), shape.clone()));
    }
    let image = Image::ALL[random.below(4)];
    let with = Comparison {
        image: (drawing.edges <= COMPARED && random.below(2) == 0).then_some(image),
        threads: NonZeroUsize::new([0, 0, 2, 3, 4, 8][random.below(6)]),
        engine: None,
    };
    // What is compared with another engine is compared with nothing else.
    let with = match options.engine {
        Some(_) => Comparison { engine: options.engine, ..Comparison::default() },
        None => with,
    };
    let outcome = judge::judge(&shape, with);
    if let Ok(mut running) = running.lock() {
        *running = None;
    }
    summary.count(family.name, &outcome);
    match outcome {
        Outcome::Find(text) => {
            println!("FIND {name}: {pose}, regroup {regroup}\n{text}");
            keep(&file("find"), &sketch::to_wkt(&shape.polygons));
            if let Ok(mut running) = running.lock() {
                *running = Some((Instant::now(), format!("{name}, reducing"), shape.clone()));
            }
            let fails = |s: &Shape| matches!(judge::judge(s, with), Outcome::Find(_));
            let small = reduce::reduce(shape, Instant::now() + REDUCING, &fails);
            keep(&file("small"), &sketch::to_wkt(&small.polygons));
            let outcome = judge::judge(&small, with);
            if let Ok(mut running) = running.lock() {
                *running = None;
            }
            if let Outcome::Find(text) = outcome {
                let edges: usize = small.polygons.iter().flatten().map(Vec::len).sum();
                println!("reduced to {edges} edges in {}:\n{text}", file("small").display());
            }
        }
        Outcome::Fine(times) => {
            let limit = SLOW.0 * times.edges as u32 + SLOW.1;
            if times.engine <= limit {
                return;
            }
            // Another process may have been in the way.
            let again = (0..2).filter_map(|_| judge::engine_time(&shape)).min();
            let time = again.map_or(times.engine, |again| again.min(times.engine));
            if time > limit {
                summary.slow += 1;
                println!("SLOW {name}: {pose}: {time:?} for {} edges", times.edges);
                keep(&file("slow"), &sketch::to_wkt(&shape.polygons));
            }
        }
        Outcome::Refused(_, error) if options.replay.is_some() => {
            println!("refused {name}: {pose}: {error}")
        }
        Outcome::Refused(..) => {}
    }
}

fn keep(file: &Path, text: &str) {
    if let Err(error) = fs::write(file, text) {
        eprintln!("{}: {error}", file.display());
    }
}

/// Ends the program when a shape takes too long.
fn watch(running: &Running, finds: &Path) {
    let (running, finds) = (Arc::clone(running), finds.to_owned());
    thread::spawn(move || {
        loop {
            thread::sleep(Duration::from_secs(1));
            let Ok(running) = running.lock() else { return };
            let Some((since, name, shape)) = &*running else { continue };
            if since.elapsed() > HANGS {
                let stage = judge::stage();
                println!(
                    "FIND {name}, regroup {}: {stage} without end in {HANGS:?}",
                    shape.regroup
                );
                keep(&finds.join("hang.wkt"), &sketch::to_wkt(&shape.polygons));
                process::exit(1);
            }
        }
    });
}
