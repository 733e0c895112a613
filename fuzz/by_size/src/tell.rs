//! Sums by family.

use std::collections::BTreeMap;
use std::fmt;
use std::time::Duration;

use super::judge::Outcome;

/// Edges from which the time for each tells something.
const ENOUGH: usize = 1000;

/// What was judged so far.
#[derive(Default)]
pub struct Summary {
    families: BTreeMap<&'static str, Row>,
    /// Shapes that were refused, by reason code.
    refused: BTreeMap<&'static str, usize>,
    pub slow: usize,
}

#[derive(Clone, Copy, Default)]
struct Row {
    shapes: usize,
    refused: usize,
    edges: usize,
    finds: usize,
    domain: Duration,
    engine: Duration,
    other: Duration,
    judge: Duration,
    /// Most nanoseconds the engine took for an edge of a shape with enough of them.
    worst: f64,
}

impl Summary {
    pub fn count(&mut self, family: &'static str, outcome: &Outcome) {
        let row = self.families.entry(family).or_default();
        match outcome {
            Outcome::Refused(code, _) => {
                row.refused += 1;
                *self.refused.entry(code).or_default() += 1;
            }
            Outcome::Find(_) => {
                row.shapes += 1;
                row.finds += 1;
            }
            Outcome::Fine(times) => {
                row.shapes += 1;
                row.edges += times.edges;
                row.domain += times.domain;
                row.engine += times.engine;
                row.other += times.other;
                row.judge += times.judge;
                if times.edges >= ENOUGH {
                    row.worst = row.worst.max(each(times.engine, times.edges));
                }
            }
        }
    }

    pub fn finds(&self) -> usize {
        self.families.values().map(|row| row.finds).sum()
    }

    /// Why shapes were refused, in brackets.
    fn reasons(&self) -> String {
        let words: Vec<String> =
            self.refused.iter().map(|(code, n)| format!("{code} {n}")).collect();
        if words.is_empty() { String::new() } else { format!(" ({})", words.join(", ")) }
    }

    /// One line about all.
    pub fn total(&self) -> String {
        let sum = |get: fn(&Row) -> usize| self.families.values().map(get).sum::<usize>();
        format!(
            "{} shapes, {} edges, {} refused{}, {} finds, {} slow",
            sum(|row| row.shapes),
            sum(|row| row.edges),
            sum(|row| row.refused),
            self.reasons(),
            self.finds(),
            self.slow
        )
    }
}

/// Nanoseconds for each edge.
fn each(time: Duration, edges: usize) -> f64 {
    time.as_nanos() as f64 / edges.max(1) as f64
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:14} {:>7} {:>7} {:>10} {:>5}  ns an edge: {:>6} {:>6} {:>6} {:>6} {:>6}",
            "family",
            "shapes",
            "refused",
            "edges",
            "finds",
            "domain",
            "engine",
            "other",
            "judge",
            "worst"
        )?;
        for (name, row) in &self.families {
            let each = |time| each(time, row.edges);
            writeln!(
                f,
                "{name:14} {:>7} {:>7} {:>10} {:>5} {:>18.0} {:>6.0} {:>6.0} {:>6.0} {:>6.0}",
                row.shapes,
                row.refused,
                row.edges,
                row.finds,
                each(row.domain),
                each(row.engine),
                each(row.other),
                each(row.judge),
                row.worst
            )?;
        }
        write!(f, "{}", self.total())
    }
}
