//! Takes the time of one thread, and the growth of the memory of the process.

use std::time::Duration;
use std::{fs, hint};

use cpu_time::ThreadTime;

/// How long one call repeats its work for.
const ENOUGH: Duration = Duration::from_millis(500);

/// How often at most.
const REPETITIONS: usize = 101;

/// How often at least, unless that takes too long: only the first round has to fetch its memory from
/// the system.
const LEAST: usize = 3;

/// Time after which nothing is repeated.
const LONG: Duration = Duration::from_secs(6);

/// Edges that are worked on between two looks at the clock, so that small features do not pay
/// for the looks.
const CHUNK: usize = 10_000;

/// Two stages of work, each one's result given to the next; only `first` and `second` are timed.
pub struct Work<P, F, S, C> {
    /// The input as the program wants it.
    pub prepare: P,
    /// The first stage.
    pub first: F,
    /// The second stage, on the result of the first.
    pub second: S,
    /// What was found: one number of the last result.
    pub count: C,
}

/// An error of the work or of the measurement.
pub type Error = Box<dyn std::error::Error>;

/// Works on all features, repeats that for a while, and prints the numbers of edges and of what
/// was found, the median nanoseconds of each stage, and by how many bytes the first round made
/// the peak of the resident memory grow.
pub fn report<'a, T, I, A, B>(
    features: &'a [T],
    edges: impl Fn(&T) -> usize,
    work: &Work<
        impl Fn(&'a T) -> I,
        impl Fn(I) -> Result<A, Error>,
        impl Fn(&mut A) -> Result<B, Error>,
        impl Fn(&A, &B) -> usize,
    >,
) -> Result<(), Error> {
    let mut chunks = Vec::new();
    let mut rest = features;
    while !rest.is_empty() {
        let mut sum = 0;
        let full = rest.iter().position(|feature| {
            sum += edges(feature);
            sum >= CHUNK
        });
        let (chunk, left) = rest.split_at(full.map_or(rest.len(), |k| k + 1));
        chunks.push(chunk);
        rest = left;
    }
    let (mut firsts, mut seconds) = (Vec::new(), Vec::new());
    let (mut found, mut growth, mut spent) = (0, 0, Duration::ZERO);
    let mut cold = Duration::ZERO;
    while firsts.is_empty()
        || (spent < ENOUGH && firsts.len() < REPETITIONS)
        || (spent < LONG && firsts.len() < LEAST)
    {
        let (mut first, mut second) = (Duration::ZERO, Duration::ZERO);
        found = 0;
        for chunk in &chunks {
            let inputs: Vec<I> = chunk.iter().map(&work.prepare).collect();
            let before = firsts.is_empty().then(reset_peak);
            let start = ThreadTime::now();
            let mut middle = inputs.into_iter().map(&work.first).collect::<Result<Vec<A>, _>>()?;
            first += start.elapsed();
            let start = ThreadTime::now();
            let last = middle.iter_mut().map(&work.second).collect::<Result<Vec<B>, _>>()?;
            second += start.elapsed();
            if let Some(before) = before {
                growth = growth.max(peak_bytes().saturating_sub(before));
            }
            found += middle.iter().zip(&last).map(|(a, b)| (work.count)(a, b)).sum::<usize>();
            hint::black_box(last);
        }
        if firsts.is_empty() {
            cold = first + second;
        }
        spent += first + second;
        firsts.push(first);
        seconds.push(second);
    }
    let edges: usize = features.iter().map(edges).sum();
    let (first, second) = (median(&mut firsts).as_nanos(), median(&mut seconds).as_nanos());
    println!("{edges} {found} {first} {second} {growth} {}", cold.as_nanos());
    Ok(())
}

fn median(times: &mut [Duration]) -> Duration {
    times.sort_unstable();
    times[times.len() / 2]
}

/// Lets the peak of the resident memory start anew, and gives it, in bytes.
fn reset_peak() -> u64 {
    // Where the system does not let us, the peak stays, and no growth is seen.
    let _ = fs::write("/proc/self/clear_refs", "5");
    peak_bytes()
}

/// The peak of the resident memory in bytes; 0 where the system does not tell.
pub fn peak_bytes() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|line| line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok());
    1024 * kib.unwrap_or(0)
}
