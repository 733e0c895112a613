use cpu_time::ProcessTime;
use medial::engine::{Options, Sampling};
use serde::Serialize;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

/// Wall time spent in each stage, summed over features.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stages {
    pub read: Duration,
    pub domain: Duration,
    pub engine: Duration,
    pub operations: Duration,
    pub write: Duration,
    /// When the present feature must be done.
    pub deadline: Option<Instant>,
    /// How well samples stand for the boundary of the present feature, if there are some.
    pub sampling: Option<Sampling>,
}

impl Stages {
    /// How an engine works on the present feature.
    pub fn options(&self, threads: NonZeroUsize) -> Options<'static> {
        Options { threads, deadline: self.deadline, ..Options::default() }
    }

    pub fn add(&mut self, other: Self) {
        self.read += other.read;
        self.domain += other.domain;
        self.engine += other.engine;
        self.operations += other.operations;
        self.write += other.write;
    }
}

/// The result of `work`, its duration added to `stage`.
pub fn timed<T>(stage: &mut Duration, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *stage += start.elapsed();
    result
}

#[derive(Serialize)]
struct Timings {
    read: f64,
    domain: f64,
    engine: f64,
    operations: f64,
    write: f64,
    cpu: f64,
    wall: f64,
    peak_bytes: Option<u64>,
}

/// The content of the timings file of a run that began at `start`.
pub fn text(stages: &Stages, start: Instant) -> String {
    let timings = Timings {
        read: stages.read.as_secs_f64(),
        domain: stages.domain.as_secs_f64(),
        engine: stages.engine.as_secs_f64(),
        operations: stages.operations.as_secs_f64(),
        write: stages.write.as_secs_f64(),
        cpu: ProcessTime::try_now().map_or(0.0, |cpu| cpu.as_duration().as_secs_f64()),
        wall: start.elapsed().as_secs_f64(),
        peak_bytes: peak_bytes(),
    };
    let mut text = serde_json::to_string_pretty(&timings).unwrap_or_default();
    text.push('\n');
    text
}

/// The most memory the process has had, where the system tells (Linux).
fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kib)
}
