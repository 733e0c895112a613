//! Draws polygons for the comparison with Boost.Polygon, and times medial on them.
//!
//! `medial-bench draw SHAPE EDGES` prints rings of whole numbers, one `x y` a line, an empty line
//! after each ring; `medial-bench time` reads them and prints the number of edges and paths, and
//! the median time, in nanoseconds of the thread's processor time, of validation and of the
//! engine.

mod shapes;

use std::io::Read as _;
use std::time::Duration;
use std::{env, io};

use cpu_time::ThreadTime;
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use medial::geom::Point;

/// Edges that one call goes through, if need be several times.
const WORK: usize = 200_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = env::args().skip(1).collect();
    match args.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["draw", shape, edges] => draw(shape, edges.parse()?),
        ["time"] => time(),
        _ => Err("medial-bench draw SHAPE EDGES, or medial-bench time".into()),
    }
}

fn draw(shape: &str, edges: usize) -> Result<(), Box<dyn std::error::Error>> {
    for ring in shapes::draw(shape, edges).ok_or("no such shape")? {
        for (x, y) in ring {
            println!("{x} {y}");
        }
        println!();
    }
    Ok(())
}

fn time() -> Result<(), Box<dyn std::error::Error>> {
    let mut text = String::new();
    io::stdin().read_to_string(&mut text)?;
    let point = |line: &str| -> Option<Point> {
        let (x, y) = line.split_once(' ')?;
        Some(Point::new(x.parse().ok()?, y.parse().ok()?))
    };
    let ring = |part: &str| part.lines().filter_map(point).collect::<Vec<Point>>();
    let polygons = [text.split("\n\n").map(ring).filter(|r| !r.is_empty()).collect::<Vec<_>>()];
    let edges: usize = polygons[0].iter().map(Vec::len).sum();
    let (mut validation, mut engine) = (Vec::new(), Vec::new());
    let mut paths = 0;
    for _ in 0..(WORK / edges.max(1)).clamp(1, 101) {
        let start = ThreadTime::now();
        let domain = Domain::from_polygons(&polygons, &Options::default())?;
        validation.push(start.elapsed());
        let start = ThreadTime::now();
        let axis = path_tracing(&domain)?;
        engine.push(start.elapsed());
        paths = axis.paths().len();
    }
    let (validation, engine) = (median(&mut validation), median(&mut engine));
    println!("{edges} {paths} {} {}", validation.as_nanos(), engine.as_nanos());
    Ok(())
}

fn median(times: &mut [Duration]) -> Duration {
    times.sort_unstable();
    times[times.len() / 2]
}
