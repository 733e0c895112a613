//! What `medial compare` tells: a row for each feature and engine.

use crate::args::CompareArgs;
use crate::commands::axis::on_side;
use crate::guard::guarded;
use crate::report::Entry;
use crate::timings::{Stages, timed};
use allocation_counter::measure;
use medial::axis::{Accuracy, Engine, MedialAxis, Side};
use medial::check::{Difference, difference};
use medial::domain::Domain;
use medial::engine::Options;
use medial_io::{Feature, Json};
use serde::Serialize;
use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::time::Duration;

/// The engines on one side of a feature.
pub struct Comparison {
    feature: usize,
    id: Option<Json>,
    edges: usize,
    side: Side,
    /// The exact engine that the others are compared with.
    reference: Option<Engine>,
    /// In the order in which the engines were named.
    runs: Vec<(Engine, Result<Found, Entry>)>,
}

/// What an engine gave, and what it took.
#[derive(Clone, Copy)]
struct Found {
    keypoints: usize,
    paths: usize,
    time: Duration,
    /// By how much what the thread had allocated grew at most; unknown of several threads.
    memory: Option<u64>,
    /// From the reference, if there is one.
    difference: Option<Difference>,
}

impl Comparison {
    /// Runs the engines one after another; fails as the first one did if none gives an axis.
    pub fn new(
        feature: &Feature,
        domain: &Domain,
        side: Side,
        args: &CompareArgs,
        options: &Options<'_>,
        stages: &mut Stages,
    ) -> Result<Self, Entry> {
        let mut axes = Vec::new();
        let all: Vec<Engine> = match &args.engine[..] {
            [] => Engine::ALL
                .iter()
                .copied()
                .filter(|e| side == Side::Interior || e.is_exact() || *e == Engine::DelaunayDual)
                .collect(),
            named => named.to_vec(),
        };
        let options = &Options { cell: args.cell, spacing: args.spacing, ..*options };
        for (k, &engine) in all.iter().enumerate() {
            // One that is named twice runs once.
            if all[..k].contains(&engine) {
                continue;
            }
            let mut time = Duration::ZERO;
            let run = || timed(&mut time, || on_side(side, &args.region, domain, engine, options));
            let mut result = Err(String::new());
            let memory = measure(|| result = guarded(run)).bytes_max;
            stages.engine += time;
            let axis = match result {
                Ok(Ok(axis)) => Ok((axis, time, memory)),
                Ok(Err(error)) => Err(Entry::unfinished(&error)),
                Err(panic) => Err(Entry::refused("internal", panic)),
            };
            axes.push((engine, axis));
        }
        if axes.iter().all(|(_, axis)| axis.is_err())
            && let Some((_, Err(refusal))) = axes.drain(..).next()
        {
            return Err(refusal);
        }
        let done = axes.iter().filter_map(|(_, axis)| axis.as_ref().ok());
        let reference = done.map(|(axis, ..)| axis).find(|axis| axis.accuracy == Accuracy::Exact);
        let alone = options.threads == NonZeroUsize::MIN;
        let found = |(axis, time, memory): &(MedialAxis, Duration, u64)| Found {
            keypoints: axis.keypoints().len(),
            paths: axis.paths().len(),
            time: *time,
            memory: alone.then_some(*memory),
            difference: reference.map(|reference| {
                if std::ptr::eq(reference, axis) {
                    Difference::default()
                } else {
                    difference(reference, axis)
                }
            }),
        };
        let runs = timed(&mut stages.operations, || {
            axes.iter()
                .map(|(engine, axis)| (*engine, axis.as_ref().map(found).map_err(Entry::clone)))
                .collect()
        });
        Ok(Self {
            feature: feature.index,
            id: feature.id.clone(),
            edges: domain.edges().len(),
            side,
            reference: reference.map(|axis| axis.engine),
            runs,
        })
    }

    /// A line of JSON for each engine.
    pub fn json(&self) -> String {
        self.rows().fold(String::new(), |mut text, row| {
            text += &serde_json::to_string(&row).unwrap_or_default();
            text.push('\n');
            text
        })
    }

    /// A row for each engine.
    pub fn csv(&self) -> Vec<u8> {
        records(self.rows().map(|row| row.fields().map(|(_, value)| value)))
    }

    /// A table for people.
    pub fn text(&self) -> String {
        let mut out = format!("feature {}", self.feature);
        if let Some(id) = &self.id {
            let _ = write!(out, " (id {id})");
        }
        let _ = match self.side {
            Side::Interior => writeln!(out, ": {} edges", self.edges),
            side => writeln!(out, ", {side}: {} edges", self.edges),
        };
        out += &heads();
        for (engine, run) in &self.runs {
            match run {
                Ok(found) => {
                    out += &line(*engine, found, self.graph(*engine, found));
                    let graph = found.difference.filter(|_| engine.is_exact());
                    if let Some(difference) = graph.filter(|d| !d.is_same_graph()) {
                        out += &told(&difference);
                    }
                }
                Err(entry) => {
                    let _ = writeln!(out, "  {engine:18}  {}", entry.message);
                }
            }
        }
        out
    }

    fn graph(&self, engine: Engine, found: &Found) -> &'static str {
        match found.difference {
            _ if self.reference == Some(engine) => "reference",
            None => "",
            Some(_) if !engine.is_exact() => "sampled",
            Some(difference) if difference.is_same_graph() => "same",
            Some(_) => "other",
        }
    }

    fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.runs.iter().map(|(engine, run)| {
            let found = run.as_ref().ok();
            let refusal = run.as_ref().err();
            let difference = found.and_then(|found| found.difference);
            // Samples are no keypoints of the exact graph.
            let graph = difference.filter(|_| engine.is_exact());
            Row {
                feature: self.feature,
                id: self.id.as_ref(),
                edges: self.edges,
                side: self.side.name(),
                engine: engine.name(),
                keypoints: found.map(|found| found.keypoints),
                paths: found.map(|found| found.paths),
                seconds: found.map(|found| found.time.as_secs_f64()),
                memory_bytes: found.and_then(|found| found.memory),
                reference: self.reference.map(Engine::name),
                same_graph: graph.map(|d| d.is_same_graph()),
                missing_keypoints: graph.map(|d| d.missing_keypoints),
                extra_keypoints: graph.map(|d| d.extra_keypoints),
                missing_paths: graph.map(|d| d.missing_paths),
                extra_paths: graph.map(|d| d.extra_paths),
                position: graph.map(|d| d.position),
                radius: graph.map(|d| d.radius),
                distance: difference.map(|d| d.distance),
                missed: difference.map(|d| d.missed),
                code: refusal.map(|entry| entry.code),
                message: refusal.map(|entry| entry.message.as_str()),
            }
        })
    }
}

/// What one engine did with one feature, in the order of its columns.
#[derive(Default, Serialize)]
struct Row<'a> {
    feature: usize,
    id: Option<&'a Json>,
    edges: usize,
    side: &'static str,
    engine: &'static str,
    keypoints: Option<usize>,
    paths: Option<usize>,
    seconds: Option<f64>,
    memory_bytes: Option<u64>,
    reference: Option<&'static str>,
    same_graph: Option<bool>,
    missing_keypoints: Option<usize>,
    extra_keypoints: Option<usize>,
    missing_paths: Option<usize>,
    extra_paths: Option<usize>,
    position: Option<f64>,
    radius: Option<f64>,
    distance: Option<f64>,
    missed: Option<f64>,
    code: Option<&'static str>,
    message: Option<&'a str>,
}

impl Row<'_> {
    /// Names and values of all columns.
    fn fields(&self) -> [(&'static str, String); 21] {
        let number = |value: Option<f64>| {
            value.and_then(serde_json::Number::from_f64).map_or_else(String::new, |n| n.to_string())
        };
        // A text is written without the quotes JSON puts around it.
        let id = self.id.map_or("", |id| id.get());
        let id = serde_json::from_str::<String>(id).unwrap_or_else(|_| id.to_owned());
        [
            ("feature", self.feature.to_string()),
            ("id", id),
            ("edges", self.edges.to_string()),
            ("side", self.side.to_owned()),
            ("engine", self.engine.to_owned()),
            ("keypoints", optional(self.keypoints)),
            ("paths", optional(self.paths)),
            ("seconds", number(self.seconds)),
            ("memory_bytes", optional(self.memory_bytes)),
            ("reference", optional(self.reference)),
            ("same_graph", optional(self.same_graph)),
            ("missing_keypoints", optional(self.missing_keypoints)),
            ("extra_keypoints", optional(self.extra_keypoints)),
            ("missing_paths", optional(self.missing_paths)),
            ("extra_paths", optional(self.extra_paths)),
            ("position", number(self.position)),
            ("radius", number(self.radius)),
            ("distance", number(self.distance)),
            ("missed", number(self.missed)),
            ("code", optional(self.code)),
            ("message", optional(self.message)),
        ]
    }
}

fn optional(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// The row of column names.
pub fn csv_header() -> Vec<u8> {
    records([Row::default().fields().map(|(name, _)| name.to_owned())])
}

fn records<const N: usize>(rows: impl IntoIterator<Item = [String; N]>) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        // Writing to memory does not fail.
        let _ = writer.write_record(row);
    }
    writer.into_inner().unwrap_or_default()
}

/// What the engines did with all features.
#[derive(Default)]
pub struct Totals {
    features: usize,
    edges: usize,
    engines: Vec<(Engine, Total)>,
}

#[derive(Clone, Copy)]
struct Total {
    sum: Found,
    refused: usize,
    /// Features with another graph than that of the reference.
    other: usize,
}

impl Totals {
    /// Takes in the sides of one more feature.
    pub fn add(&mut self, of_sides: &[Comparison]) {
        self.features += 1;
        self.edges += of_sides.first().map_or(0, |compared| compared.edges);
        let runs = of_sides.iter().flat_map(|compared| compared.runs.iter().enumerate());
        for (k, (engine, run)) in runs {
            if k == self.engines.len() {
                self.engines.push((*engine, Total::EMPTY));
            }
            let total = &mut self.engines[k].1;
            match run {
                Ok(found) => total.add(found),
                Err(_) => total.refused += 1,
            }
        }
    }

    /// A table for people; nothing where one feature has told all.
    pub fn text(&self) -> String {
        if self.features < 2 {
            return String::new();
        }
        let mut out = format!("all {} features: {} edges\n", self.features, self.edges);
        out += &heads();
        for (engine, total) in &self.engines {
            let graph = match total.other {
                _ if !engine.is_exact() => "sampled".to_owned(),
                0 => "same".to_owned(),
                n => format!("{n} other"),
            };
            out += &line(*engine, &total.sum, &graph);
            if total.refused > 0 {
                let _ = writeln!(out, "  {:18}  {} refused", "", total.refused);
            }
        }
        out
    }
}

impl Total {
    const EMPTY: Self = Self {
        sum: Found { keypoints: 0, paths: 0, time: Duration::ZERO, memory: None, difference: None },
        refused: 0,
        other: 0,
    };

    /// Adds counts and times, and keeps the greatest of the rest.
    fn add(&mut self, found: &Found) {
        let sum = &mut self.sum;
        sum.keypoints += found.keypoints;
        sum.paths += found.paths;
        sum.time += found.time;
        sum.memory = sum.memory.max(found.memory);
        if let Some(difference) = found.difference {
            let worst = sum.difference.get_or_insert_default();
            worst.position = worst.position.max(difference.position);
            worst.radius = worst.radius.max(difference.radius);
            worst.distance = worst.distance.max(difference.distance);
            worst.missed = worst.missed.max(difference.missed);
            self.other += usize::from(!difference.is_same_graph());
        }
    }
}

const SECONDS: [(f64, &str); 3] = [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs")];
const BYTES: [(f64, &str); 4] = [(1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (1.0, "B")];

fn heads() -> String {
    format!(
        "  {:18} {:>9} {:>9} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
        "engine",
        "keypoints",
        "paths",
        "time",
        "memory",
        "graph",
        "position",
        "radius",
        "distance",
        "missed"
    )
}

fn line(engine: Engine, found: &Found, graph: &str) -> String {
    let apart = found.difference.map(|d| [d.position, d.radius, d.distance, d.missed]);
    let apart = apart.map_or_else(Default::default, |apart| apart.map(tiny));
    let [mut position, mut radius, distance, missed] = apart;
    if !engine.is_exact() {
        position.clear();
        radius.clear();
    }
    format!(
        "  {:18} {:>9} {:>9} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
        engine,
        found.keypoints,
        found.paths,
        scaled(found.time.as_secs_f64(), &SECONDS),
        found.memory.map_or_else(String::new, |memory| scaled(memory as f64, &BYTES)),
        graph,
        position,
        radius,
        distance,
        missed,
    )
}

/// Three digits of a quantity in the largest unit that it fills, or in the last one.
fn scaled(quantity: f64, units: &[(f64, &str)]) -> String {
    let fits = units.iter().find(|(unit, _)| quantity >= *unit).or(units.last());
    let Some((unit, name)) = fits else { return String::new() };
    let number = quantity / unit;
    let digits = if number >= 99.95 || *name == "B" {
        0
    } else if number >= 9.995 {
        1
    } else {
        2
    };
    format!("{number:.digits$} {name}")
}

fn tiny(distance: f64) -> String {
    if distance == 0.0 { "0".to_owned() } else { format!("{distance:.1e}") }
}

fn told(difference: &Difference) -> String {
    let Difference { missing_keypoints, missing_paths, extra_keypoints, extra_paths, .. } =
        difference;
    format!(
        "  {:18}  {missing_keypoints} keypoints and {missing_paths} paths missing, \
         {extra_keypoints} and {extra_paths} more\n",
        ""
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_named_as_in_json() {
        let row = Row::default();
        let json = serde_json::to_string(&row).unwrap();
        let mut rest = json.as_str();
        for (name, _) in row.fields() {
            let key = format!("\"{name}\":");
            let at = rest.find(&key).unwrap_or_else(|| panic!("{name} in its place: {json}"));
            rest = &rest[at + key.len()..];
        }
        assert_eq!(json.matches(':').count(), row.fields().len());
    }

    /// One engine that gave nothing, and one that lost a path.
    fn compared() -> Comparison {
        let mut difference = Difference::default();
        difference.missing_paths = 1;
        difference.missed = f64::INFINITY;
        let found = |keypoints, difference| Found {
            keypoints,
            paths: 5,
            time: Duration::from_millis(2),
            memory: Some(4096),
            difference: Some(difference),
        };
        Comparison {
            feature: 7,
            id: None,
            edges: 4,
            side: Side::Interior,
            reference: Some(Engine::PathTracing),
            runs: vec![
                (Engine::PathTracing, Ok(found(6, Difference::default()))),
                (Engine::DivideAndConquer, Ok(found(5, difference))),
                (Engine::DivideAndConquer, Err(Entry::refused("internal", "a, b"))),
            ],
        }
    }

    #[test]
    fn an_engine_that_gave_no_axis_says_why() {
        let compared = compared();
        let json = compared.json();
        assert!(json.lines().nth(2).unwrap().ends_with(r#""code":"internal","message":"a, b"}"#));
        let csv = String::from_utf8(compared.csv()).unwrap();
        let expected = format!(
            "7,,4,interior,divide_and_conquer,{}path_tracing,{}",
            ",".repeat(4),
            ",".repeat(9)
        );
        assert_eq!(csv.lines().nth(2).unwrap(), format!("{expected}internal,\"a, b\""));
        assert!(compared.text().ends_with("  divide_and_conquer  a, b\n"), "{}", compared.text());
    }

    #[test]
    fn another_graph_is_told() {
        let text = compared().text();
        let lines: Vec<&str> = text.lines().collect();
        let words: Vec<&str> = lines[3].split_whitespace().collect();
        assert_eq!(words[7..], ["other", "0", "0", "0", "inf"]);
        assert!(lines[4].ends_with("0 keypoints and 1 paths missing, 0 and 0 more"), "{text}");
        // What is not finite is no number of JSON.
        assert!(compared().json().contains("\"missed\":null"));
    }

    #[test]
    fn totals_add_up_what_was_done_and_count_the_rest() {
        let mut totals = Totals::default();
        totals.add(&[compared()]);
        assert_eq!(totals.text(), "");
        totals.add(&[compared()]);
        let text = totals.text();
        assert!(text.starts_with("all 2 features: 8 edges\n"), "{text}");
        let lines: Vec<&str> = text.lines().collect();
        let words = |k: usize| -> Vec<&str> { lines[k].split_whitespace().collect() };
        assert_eq!(words(2)[..8], ["path_tracing", "12", "10", "4.00", "ms", "4.10", "kB", "same"]);
        assert_eq!(words(3)[7..9], ["2", "other"]);
        assert!(lines[5].ends_with("  2 refused"), "{text}");
    }

    #[test]
    fn quantities_have_three_digits() {
        let time = |s: f64| scaled(s, &SECONDS);
        assert_eq!(time(1.5), "1.50 s");
        assert_eq!(time(0.0123), "12.3 ms");
        assert_eq!(time(0.000_456), "456 µs");
        assert_eq!(time(0.0), "0.00 µs");
        assert_eq!(scaled(512.0, &BYTES), "512 B");
    }
}
