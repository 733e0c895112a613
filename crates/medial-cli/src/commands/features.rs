//! What every command does with the features of its input.

use crate::args::{Common, OnError};
use crate::failure::{Failure, Status};
use crate::guard::guarded;
use crate::input::Input;
use crate::parallel::ordered;
use crate::progress::Progress;
use crate::report::{self, Entry, FeatureReport, Report};
use crate::timings::{self, Stages, timed};
use medial::domain::{Domain, Options};
use medial_io::{Feature, FeatureError, Json, Layer};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

/// A run of a command over the features of an input.
pub struct Run<'a> {
    pub common: &'a Common,
    /// When the command began.
    pub start: Instant,
    /// Time spent so far.
    pub stages: Stages,
}

/// What became of one feature.
struct Outcome<R> {
    index: usize,
    id: Option<Json>,
    warnings: Vec<String>,
    entries: Vec<Entry>,
    /// `None` if it was refused; then the last entry says why.
    result: Option<R>,
    stages: Stages,
}

impl Run<'_> {
    /// Calls `work` for each valid feature, several at once, and `done` with the results in
    /// order; tells and reports what is left out.
    ///
    /// The result is whether all went well; a stop at a bad feature is [`Status::NoResult`].
    pub fn each<R: Send>(
        &mut self,
        input: &Input,
        layer: Layer<'_>,
        work: impl Fn(&Feature, &Domain, &mut Stages) -> Result<R, Entry> + Sync,
        mut done: impl FnMut(R) -> Result<(), Failure>,
    ) -> Result<Status, Failure> {
        let common = self.common;
        let progress = Progress::new(common.progress, common.quiet, layer.len);
        let (at_once, _) = self.threads(&layer);
        let mut report = Report { input: input.name.clone(), ..Report::default() };
        let broke = ordered(
            Timed(layer),
            at_once,
            |(feature, read)| process(feature, read, common, &work),
            |outcome| {
                self.stages.add(outcome.stages);
                progress.step();
                match tell(outcome, input, &progress, &mut report) {
                    Some(result) => match done(result) {
                        Ok(()) => ControlFlow::Continue(()),
                        Err(failure) => ControlFlow::Break(Some(failure)),
                    },
                    None if common.on_error == OnError::Stop => ControlFlow::Break(None),
                    None => ControlFlow::Continue(()),
                }
            },
        );
        progress.finish();
        if let Some(path) = &common.report {
            report.write(path)?;
        }
        match broke {
            Some(Some(failure)) => Err(failure),
            Some(None) => Ok(Status::NoResult),
            None => Ok(summary(&report, input, &progress)),
        }
    }

    /// How many features to work on at once, and with how many threads on each: where there are few
    /// features, the threads left over share the work on one.
    pub fn threads(&self, layer: &Layer<'_>) -> (NonZeroUsize, NonZeroUsize) {
        let threads = self.common.threads.unwrap_or_else(all_processors);
        let features = layer.len.and_then(NonZeroUsize::new).unwrap_or(threads);
        let at_once = threads.min(features);
        let each = NonZeroUsize::new(threads.get() / at_once).unwrap_or(NonZeroUsize::MIN);
        (at_once, each)
    }

    /// Writes the timings, if they are asked for.
    pub fn finish(&self) -> Result<(), Failure> {
        match &self.common.timings {
            Some(path) => timings::write(path, &self.stages, self.start),
            None => Ok(()),
        }
    }
}

fn all_processors() -> NonZeroUsize {
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

/// The layer, each item with the time it took to read.
struct Timed<'a>(Layer<'a>);

impl Iterator for Timed<'_> {
    type Item = (Result<Feature, FeatureError>, Duration);

    fn next(&mut self) -> Option<Self::Item> {
        let mut read = Duration::ZERO;
        timed(&mut read, || self.0.next()).map(|item| (item, read))
    }
}

fn process<R>(
    item: Result<Feature, FeatureError>,
    read: Duration,
    common: &Common,
    work: impl Fn(&Feature, &Domain, &mut Stages) -> Result<R, Entry>,
) -> Outcome<R> {
    let mut outcome = Outcome {
        index: 0,
        id: None,
        warnings: Vec::new(),
        entries: Vec::new(),
        result: None,
        stages: Stages { read, ..Stages::default() },
    };
    let feature = match item {
        Ok(feature) => feature,
        Err(FeatureError { feature, id, error }) => {
            outcome.index = feature;
            outcome.id = id;
            outcome.entries.push(Entry::refused("malformed", error.to_string()));
            return outcome;
        }
    };
    outcome.index = feature.index;
    outcome.id = feature.id.clone();
    for note in &feature.notes {
        outcome.warnings.push(note.text.clone());
        outcome.entries.push(Entry::noted(note));
    }
    let result = guarded(|| {
        let mut stages = outcome.stages;
        let result = valid(&feature, common, &mut stages.domain).and_then(|domain| {
            for (warn, entry) in report::repairs(domain.report(), feature.polygons.len() == 1) {
                if warn {
                    outcome.warnings.push(entry.message.clone());
                }
                outcome.entries.push(entry);
            }
            work(&feature, &domain, &mut stages)
        });
        outcome.stages = stages;
        result
    });
    match result.unwrap_or_else(|panic| Err(Entry::refused("internal", panic))) {
        Ok(result) => outcome.result = Some(result),
        Err(entry) => outcome.entries.push(entry),
    }
    outcome
}

/// The domain of a feature, or why it has none.
fn valid(feature: &Feature, common: &Common, time: &mut Duration) -> Result<Domain, Entry> {
    if !feature.polygonal {
        let found = &feature.geometry;
        let why = format!("is {found}; only polygons have a medial axis, leave it out");
        return Err(Entry::refused("not_polygon", why));
    }
    if feature.polygons.is_empty() {
        let why = format!("is {} without points; leave it out", feature.geometry);
        return Err(Entry::refused("empty", why));
    }
    let options = Options { strict: common.strict, regroup: common.regroup };
    timed(time, || Domain::from_polygons(&feature.polygons, &options))
        .map_err(|error| Entry::invalid(&error))
}

/// Prints and reports what happened to a feature; gives its result.
fn tell<R>(
    outcome: Outcome<R>,
    input: &Input,
    progress: &Progress,
    report: &mut Report,
) -> Option<R> {
    let Outcome { index, id, warnings, entries, result, .. } = outcome;
    let place = format!("{}: feature {index}", input.name);
    for warning in warnings {
        progress.warning(&format!("{place}: {warning}"));
    }
    report.n_features += 1;
    match (&result, entries.last()) {
        (None, Some(refusal)) => {
            progress.error(&format!("{place}: {}", refusal.message));
            report.left_out += 1;
        }
        _ => report.done += 1,
    }
    if !entries.is_empty() {
        report.features.push(FeatureReport { feature: index, id, entries });
    }
    result
}

fn summary(report: &Report, input: &Input, progress: &Progress) -> Status {
    let Report { n_features, left_out, .. } = *report;
    if n_features == 0 {
        progress.warning(&format!("{}: there are no features", input.name));
    }
    if left_out == 0 {
        return Status::Done;
    }
    progress.warning(&format!("{}: {left_out} of {n_features} features left out", input.name));
    if report.done == 0 { Status::NoResult } else { Status::LeftOut }
}

/// Reads the layer of polygons of an input.
pub fn layer<'a>(input: &'a Input, path: &Path, common: &Common) -> Result<Layer<'a>, Failure> {
    let format = crate::input::polygon_format(input, path, common.from)?;
    medial_io::read(format, input.bytes()).map_err(|error| input.wrong(error))
}
