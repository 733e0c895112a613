//! What every command does with the features of its input.

use crate::args::{Common, OnError};
use crate::failure::{Failure, Status, plain};
use crate::guard::guarded;
use crate::input::{Documents, Opened, Polygons};
use crate::metric::Metric;
use crate::output::Output;
use crate::parallel::{Limit, kept, lock, ordered};
use crate::progress::Progress;
use crate::report::{self, Entry, FeatureReport, Report};
use crate::timings::{self, Stages, timed};
use medial::domain::{self, Domain};
use medial::engine::EngineError;
use medial::geom::Point;
use medial::raster::Grid;
use medial_io::{Error, Feature, FeatureError, Json, Layer, Part, ReadOptions, geojson};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// A run of a command over the features of an input.
pub struct Run {
    pub common: &'static Common,
    /// When the command began.
    pub start: Instant,
    /// Time spent so far.
    pub stages: Stages,
    /// Largest distance between a curve of the input and its edges.
    pub tolerance: Option<f64>,
    /// Whether the command asks nothing of images but their masks.
    pub masks_alone: bool,
    /// Whether the command can measure degrees in metres.
    pub knows_metric: bool,
    report: Option<Output>,
    timings: Option<Output>,
}

/// What became of one feature.
struct Outcome<R> {
    index: usize,
    id: Option<Json>,
    warnings: Vec<String>,
    entries: Vec<Entry>,
    /// `None` if it was refused; then the last entry says why.
    result: Option<R>,
    /// Where its bytes end among those of its batch; they begin where the feature before ends.
    end: usize,
    stages: Stages,
}

impl Run {
    /// A run that begins now; fails if the files beside its result cannot be written.
    pub fn new(common: &'static Common) -> Result<Self, Failure> {
        let create = |path: &Option<PathBuf>| path.as_deref().map(Output::beside).transpose();
        Ok(Self {
            common,
            start: Instant::now(),
            stages: Stages::default(),
            tolerance: None,
            masks_alone: false,
            knows_metric: true,
            report: create(&common.run.report)?,
            timings: create(&common.run.timings)?,
        })
    }

    /// Opens an input of polygons.
    pub fn open(&mut self, path: &Path) -> Result<&'static Polygons, Failure> {
        self.open_with(path, Documents::Refused)
    }

    /// The same where axis documents may stand for polygons.
    pub fn open_with(
        &mut self,
        path: &Path,
        documents: Documents,
    ) -> Result<&'static Polygons, Failure> {
        Ok(kept(self.opened(path)?.polygons(documents)?))
    }

    /// Opens an input of polygons or axes.
    pub fn opened(&mut self, path: &Path) -> Result<Opened, Failure> {
        let Common { from, layer, text, font, threshold, invert, .. } = self.common;
        let options = ReadOptions {
            tolerance: self.tolerance,
            layer: layer.clone(),
            text: text.clone(),
            threshold: *threshold,
            invert: *invert,
            // Vertices are counted in outlines.
            masks_alone: self.masks_alone && self.common.max_vertices.is_none(),
            ..ReadOptions::default()
        };
        timed(&mut self.stages.read, || Opened::new(path, *from, options, font))
    }

    /// Calls `work` for each valid feature, `at_once` at a time, then `done` with the results and
    /// `write` with the bytes that `work` appended, both in order; tells and reports what is left
    /// out.
    ///
    /// The result is whether all went well; a stop at a bad feature is [`Status::NoResult`].
    /// A feature that takes longer than it may, and does not notice itself, is given up.
    pub fn each<R: Send + 'static>(
        &mut self,
        input: &str,
        layer: Layer<'static>,
        at_once: NonZeroUsize,
        work: impl Fn(&Feature, &Domain, &mut Stages, &mut Vec<u8>) -> Result<R, Entry>
        + Send
        + Sync
        + 'static,
        mut done: impl FnMut(R),
        mut write: impl FnMut(&[u8]) -> Result<(), Failure>,
    ) -> Result<Status, Failure> {
        let common = self.common;
        let progress = Progress::new(common.run.progress, common.run.quiet, layer.len);
        let mut report = Report {
            input: input.to_owned(),
            is_wanted: common.run.report.is_some(),
            ..Report::default()
        };
        for warning in &layer.warnings {
            progress.warning(&format!("{input}: {warning}"));
        }
        if common.metric {
            Metric::check(layer.crs.as_ref(), input)?;
        }
        let find = Arc::new(Mutex::new(Duration::ZERO));
        // Bytes of earlier batches, for their memory: it grows once and stays warm.
        let spare = Arc::new(Mutex::new(Vec::new()));
        let taken = Arc::clone(&spare);
        let parts = timed(&mut lock(&find), || {
            told_of_degrees(layer, input, common.metric, self.knows_metric, &progress)
        });
        let limit = common.run.limit().map(|limit| Limit {
            after: limit.saturating_add(GRACE),
            instead: |number| (vec![Outcome::given_up(number)], Vec::new()),
        });
        // What is given up takes no others with it.
        let most = if limit.is_some() { 1 } else { BATCH };
        let broke = ordered(
            Batches { parts, find: Arc::clone(&find), most },
            at_once,
            move |batch: Vec<Part<'static>>| {
                let mut bytes: Vec<u8> = lock(&taken).pop().unwrap_or_default();
                let process = |part| process(part, common, &mut bytes, &work);
                (batch.into_iter().map(process).collect::<Vec<_>>(), bytes)
            },
            limit.as_ref(),
            |(outcomes, mut bytes)| {
                let mut end = 0;
                let mut stopped = false;
                for outcome in outcomes {
                    self.stages.add(outcome.stages);
                    progress.step();
                    let last = outcome.end;
                    match tell(outcome, input, &progress, &mut report) {
                        Some(result) => done(result),
                        None => stopped = common.run.on_error == OnError::Stop,
                    }
                    if stopped {
                        break;
                    }
                    end = last;
                }
                let written = write(&bytes[..end]);
                if bytes.capacity() <= SPARE_BYTES {
                    bytes.clear();
                    lock(&spare).push(bytes);
                }
                match written {
                    Err(failure) => ControlFlow::Break(Some(failure)),
                    Ok(()) if stopped => ControlFlow::Break(None),
                    Ok(()) => ControlFlow::Continue(()),
                }
            },
        );
        self.stages.read += *lock(&find);
        progress.finish();
        if let Some(output) = self.report.take() {
            output.whole(report.text().as_bytes())?;
        }
        match broke {
            Some(Some(failure)) => Err(failure),
            Some(None) => Ok(Status::NoResult),
            None => Ok(summary(&report, input, &progress)),
        }
    }

    /// All threads that may work at once.
    pub fn all_threads(&self) -> NonZeroUsize {
        self.common.run.threads.unwrap_or_else(all_processors)
    }

    /// How many features to work on at once, and with how many threads on each: where there are few
    /// features, the threads left over share the work on one.
    pub fn threads(&self, layer: &Layer<'_>) -> (NonZeroUsize, NonZeroUsize) {
        let threads = self.all_threads();
        let features = layer.len.and_then(NonZeroUsize::new).unwrap_or(threads);
        let at_once = threads.min(features);
        let each = NonZeroUsize::new(threads.get() / at_once).unwrap_or(NonZeroUsize::MIN);
        (at_once, each)
    }

    /// Ends a run whose result, of so many features, is written as a whole.
    pub fn done(mut self, input: &str, n_features: usize) -> Result<Status, Failure> {
        if let Some(output) = self.report.take() {
            let (input, done) = (input.to_owned(), n_features);
            let report = Report { input, n_features, done, ..Report::default() };
            output.whole(report.text().as_bytes())?;
        }
        self.finish()?;
        Ok(Status::Done)
    }

    /// Writes the timings, if they are asked for.
    pub fn finish(self) -> Result<(), Failure> {
        match self.timings {
            Some(output) => output.whole(timings::text(&self.stages, self.start).as_bytes()),
            None => Ok(()),
        }
    }
}

impl<R> Outcome<R> {
    /// Nothing yet, of a feature whose bytes begin here.
    fn empty(end: usize) -> Self {
        Self {
            index: 0,
            id: None,
            warnings: Vec::new(),
            entries: Vec::new(),
            result: None,
            end,
            stages: Stages::default(),
        }
    }

    /// That of a feature that has not come back in time.
    fn given_up(index: usize) -> Self {
        let entries = vec![Entry::unfinished(&EngineError::TimeLimit)];
        Self { index, entries, ..Self::empty(0) }
    }
}

pub fn all_processors() -> NonZeroUsize {
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

/// Most features of a batch.
const BATCH: usize = 32;

/// Bytes of text at which a batch is full: small features go together, so that threads do not
/// wait for one another at each of them, and large ones alone.
const BATCH_BYTES: usize = 16 << 10;

/// Most bytes kept for the next batch; what a large feature took is given back.
const SPARE_BYTES: usize = 1 << 20;

/// What a feature may take beyond its limit, for whatever looks at the clock to notice by itself.
const GRACE: Duration = Duration::from_millis(500);

/// The features of a layer in batches, with the time it took to find them.
struct Batches<I> {
    parts: I,
    find: Arc<Mutex<Duration>>,
    /// Most features of a batch.
    most: usize,
}

impl<'p, I: Iterator<Item = Part<'p>>> Iterator for Batches<I> {
    type Item = Vec<Part<'p>>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut batch = Vec::new();
        // Nobody waits for what a pipe may never give.
        let start = Instant::now();
        let mut bytes = 0;
        while batch.len() < self.most && bytes < BATCH_BYTES {
            let Some(part) = self.parts.next() else { break };
            bytes += part.size();
            batch.push(part);
        }
        *lock(&self.find) += start.elapsed();
        (!batch.is_empty()).then_some(batch)
    }
}

/// The features of a layer, once it is said that its coordinates are degrees. Where only the rules of the
/// format say so, the first feature has to agree.
fn told_of_degrees<'a>(
    layer: Layer<'a>,
    input: &str,
    is_metric: bool,
    knows_metric: bool,
    progress: &Progress,
) -> impl Iterator<Item = Part<'a>> + Send + use<'a> {
    let crs = layer.crs.clone().filter(|_| !is_metric);
    let angle = crs.and_then(|crs| crs.angular_unit().map(|(unit, _)| (crs, unit)));
    let mut parts = layer.parts();
    let mut first = None;
    if let Some((crs, unit)) = angle {
        let mut are_degrees = true;
        if crs.is_assumed() {
            let read = parts.next().map(Part::read);
            are_degrees = read.as_ref().is_some_and(|read| read.as_ref().is_ok_and(in_degrees));
            first = read.map(Part::from);
        }
        if are_degrees {
            let way = if knows_metric && unit == "degree" {
                "--metric measures in metres"
            } else {
                "for metres, bring it into a plane first"
            };
            progress.warning(&format!(
                "{input}: the coordinates are {unit}s ({crs}), and so are lengths, widths and radii; \
                 {unit}s of longitude are shorter than those of latitude: {way}"
            ));
        }
    }
    first.into_iter().chain(parts)
}

/// Whether the coordinates of a feature can be longitudes and latitudes.
fn in_degrees(feature: &Feature) -> bool {
    let mut points = feature.polygons.iter().flatten().flatten();
    points.all(|p| p.x.abs() <= 180.0 && p.y.abs() <= 90.0)
}

/// Whether what was written is features of GeoJSON.
fn is_features(bytes: &[u8]) -> bool {
    let start = bytes.iter().position(|&byte| byte == b'{').unwrap_or(bytes.len());
    start <= geojson::SEPARATOR.len() && bytes[start..].starts_with(b"{\"type\":\"Feature\"")
}

fn process<R>(
    part: Part,
    common: &Common,
    bytes: &mut Vec<u8>,
    work: impl Fn(&Feature, &Domain, &mut Stages, &mut Vec<u8>) -> Result<R, Entry>,
) -> Outcome<R> {
    let mut outcome = Outcome::empty(bytes.len());
    outcome.stages.deadline = common.deadline();
    let mut feature = match timed(&mut outcome.stages.read, || part.read()) {
        Ok(feature) => feature,
        Err(FeatureError { feature, id, error }) => {
            outcome.index = feature;
            outcome.id = id;
            if let Error::Interrupted { source } = error {
                let why = format!(
                    "cannot be read, nor what follows it: {}; what comes before is all that is used",
                    plain(&source)
                );
                outcome.entries.push(Entry::refused("broken_off", why));
                return outcome;
            }
            outcome.entries.push(Entry::refused(error.code(), error.to_string()));
            return outcome;
        }
    };
    outcome.index = feature.index;
    outcome.id = feature.id.clone();
    for note in &feature.notes {
        outcome.warnings.push(note.text.clone());
        outcome.entries.push(Entry::noted(note));
    }
    let metric = match common.metric.then(|| Metric::of(&mut feature)).transpose() {
        Ok(metric) => metric,
        Err(entry) => {
            outcome.entries.push(entry);
            return outcome;
        }
    };
    let result = guarded(|| {
        let mut stages = outcome.stages;
        let result = valid(&feature, common, &mut stages).and_then(|domain| {
            for (warn, entry) in report::repairs(domain.report(), feature.polygons.len() == 1) {
                if warn {
                    outcome.warnings.push(entry.message.clone());
                }
                outcome.entries.push(entry);
            }
            let result = work(&feature, &domain, &mut stages, bytes)?;
            if let Some(sampling) = stages.sampling.take() {
                outcome.entries.push(Entry::sampled(&sampling));
            }
            // What is no GeoJSON is in metres.
            if let Some(metric) = metric.filter(|_| is_features(&bytes[outcome.end..])) {
                timed(&mut stages.write, || metric.restore(bytes, outcome.end))?;
            }
            Ok(result)
        });
        outcome.stages = stages;
        result
    });
    match result.unwrap_or_else(|panic| Err(Entry::refused("internal", panic))) {
        Ok(result) => {
            outcome.result = Some(result);
            outcome.end = bytes.len();
        }
        Err(entry) => {
            outcome.entries.push(entry);
            bytes.truncate(outcome.end);
        }
    }
    outcome
}

/// The domain of a feature, or why it has none.
fn valid(feature: &Feature, common: &Common, stages: &mut Stages) -> Result<Domain, Entry> {
    if !feature.polygonal {
        let found = &feature.geometry;
        let why = format!("is {found}; only polygons have a medial axis, leave it out");
        return Err(Entry::refused("not_polygon", why));
    }
    // Where nobody asks for the outline of a mask, its box stands for it.
    let mask = feature.mask.as_ref().filter(|mask| mask.count() > 0);
    let mask_box = mask.filter(|_| feature.polygons.is_empty()).map(|mask| box_of(mask.grid()));
    let polygons = mask_box.as_deref().unwrap_or(&feature.polygons);
    if polygons.is_empty() && feature.mask.is_some() {
        let why =
            "is a mask without points; choose others by --threshold or --invert, or leave it out";
        return Err(Entry::refused("empty", why.to_owned()));
    }
    if polygons.is_empty() {
        let why = format!("is {} without points; leave it out", feature.geometry);
        return Err(Entry::refused("empty", why));
    }
    let n_vertices: usize = polygons.iter().flatten().map(Vec::len).sum();
    if let Some(most) = common.max_vertices.filter(|&most| n_vertices > most) {
        let why = format!("has {n_vertices} vertices; --max-vertices allows {most}");
        return Err(Entry::refused("max_vertices", why));
    }
    let deadline = stages.deadline;
    let options = domain::Options { deadline, ..common.domain_options(feature.fill) };
    timed(&mut stages.domain, || Domain::from_polygons(polygons, &options))
        .map_err(|error| Entry::invalid(&error))
}

/// The rectangle of all cells.
fn box_of(grid: &Grid) -> Vec<Vec<Vec<Point>>> {
    let corners = [(0, 0), (grid.columns, 0), (grid.columns, grid.rows), (0, grid.rows)];
    vec![vec![corners.map(|(column, row)| grid.corner(column, row)).to_vec()]]
}

/// Prints and reports what happened to a feature; gives its result.
fn tell<R>(
    outcome: Outcome<R>,
    input: &str,
    progress: &Progress,
    report: &mut Report,
) -> Option<R> {
    let Outcome { index, id, warnings, entries, result, .. } = outcome;
    let place = || format!("{input}: feature {index}");
    for warning in warnings {
        progress.warning(&format!("{}: {warning}", place()));
    }
    report.n_features += 1;
    match (&result, entries.last()) {
        (None, Some(refusal)) => {
            progress.error(&format!("{}: {}", place(), refusal.message));
            report.left_out += 1;
        }
        _ => report.done += 1,
    }
    if report.is_wanted && !entries.is_empty() {
        report.features.push(FeatureReport { feature: index, id, entries });
    }
    result
}

fn summary(report: &Report, input: &str, progress: &Progress) -> Status {
    let Report { n_features, left_out, .. } = *report;
    if n_features == 0 {
        progress.warning(&format!("{input}: there are no features"));
    }
    if left_out == 0 {
        return Status::Done;
    }
    progress.warning(&format!("{input}: {left_out} of {n_features} features left out"));
    if report.done == 0 { Status::NoResult } else { Status::LeftOut }
}
