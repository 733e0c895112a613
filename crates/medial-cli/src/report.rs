use medial::domain::{DomainError, Repair, Report as Repairs};
use medial::engine::{EngineError, Sampling};
use medial::ops::CenterlineError;
use medial_io::{Json, Note};
use serde::Serialize;

/// What became of all features: the content of a report file.
#[derive(Default, Serialize)]
pub struct Report {
    /// The input, as the user named it.
    pub input: String,
    /// Number of features in the input.
    pub n_features: usize,
    /// Number of features with a result.
    pub done: usize,
    /// Number of features left out.
    pub left_out: usize,
    /// Whether there will be a report: else features are only counted.
    #[serde(skip)]
    pub is_wanted: bool,
    /// The features there is something to say of.
    pub features: Vec<FeatureReport>,
}

/// What was done to one feature.
#[derive(Serialize)]
pub struct FeatureReport {
    pub feature: usize,
    pub id: Option<Json>,
    pub entries: Vec<Entry>,
}

/// One thing that was done, with a reason code from a closed list.
#[derive(Clone, Serialize)]
pub struct Entry {
    pub action: Action,
    pub code: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub polygon: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ring: Option<u32>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub indices: Vec<u32>,
    /// Where it shows in the plane.
    #[serde(skip_serializing_if = "are_none")]
    pub points: Box<[[f64; 2]]>,
    /// How far the edges of the feature were moved at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moved: Option<f64>,
    pub message: String,
}

#[expect(clippy::borrowed_box, reason = "the form of serde")]
fn are_none(points: &Box<[[f64; 2]]>) -> bool {
    points.is_empty()
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    Repaired,
    Dropped,
    Refused,
    Sampled,
}

impl Report {
    /// The content of the report file.
    pub fn text(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }
}

impl Entry {
    /// The feature was refused as a whole.
    pub fn refused(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            action: Action::Refused,
            code,
            polygon: None,
            ring: None,
            indices: Vec::new(),
            points: Box::default(),
            moved: None,
            message: message.into(),
        }
    }

    /// What came after the axis failed, which no input should cause.
    pub fn internal(error: &impl ToString) -> Self {
        Self::refused("internal", error.to_string())
    }

    /// The feature is no valid domain.
    pub fn invalid(error: &DomainError) -> Self {
        Self {
            polygon: error.polygon(),
            ring: error.ring(),
            indices: error.index().into_iter().collect(),
            points: error.point().map(|p| [p.x, p.y]).into_iter().collect(),
            ..Self::refused(error.code(), error.to_string())
        }
    }

    /// The engine gave no axis.
    pub fn unfinished(error: &EngineError) -> Self {
        let code = match error {
            EngineError::TooLarge { .. } => "too_large",
            EngineError::Frame { .. } => "frame",
            EngineError::Cancelled => "cancelled",
            EngineError::TimeLimit => "time_limit",
            EngineError::Cells(_) => "cells",
            EngineError::Spacing { .. } | EngineError::Samples { .. } => "spacing",
            EngineError::Crowded { .. } => "crowded",
            EngineError::NoExterior { .. } => "no_exterior",
            EngineError::NoMask { .. } => "no_mask",
            _ => "internal",
        };
        Self::refused(code, error.to_string())
    }

    /// How well samples stand for a boundary.
    pub fn sampled(sampling: &Sampling) -> Self {
        let Sampling { n_samples, spacing, n_missing, n_outside_crust, n_sparse, .. } = *sampling;
        let message = format!(
            "{n_samples} samples, at most {spacing} apart: of as many pairs of neighbours {n_missing} are joined only \
             because the boundary is known, {n_outside_crust} are not in the crust, {n_sparse} are too far apart for \
             the theorem about it"
        );
        let points = sampling.first_sparse.iter().map(|p| [p.x, p.y]).collect();
        Self { action: Action::Sampled, points, ..Self::refused("sampling", message) }
    }

    /// There is no line as asked for.
    pub fn no_line(error: &CenterlineError) -> Self {
        let code = match error {
            CenterlineError::Outside { .. } => "point_outside",
            CenterlineError::Apart { .. } => "points_apart",
            CenterlineError::OnePlace { .. } => "points_in_one_place",
            _ => "internal",
        };
        Self::refused(code, error.to_string())
    }

    /// Reading left something out or took it for something else.
    pub fn noted(note: &Note) -> Self {
        let action = match note.code {
            "part_not_polygon" | "point_left_out" | "values_missing" | "duplicate_line"
            | "duplicate_point" => Action::Dropped,
            _ => Action::Repaired,
        };
        Self { action, ..Self::refused(note.code, note.text.clone()) }
    }
}

/// The entries for all repairs of a domain; `lone` if the feature has one polygon only.
pub fn repairs(repairs: &Repairs, lone: bool) -> Vec<(bool, Entry)> {
    let entry = |e: &medial::domain::Entry| {
        let polygon = if lone { String::new() } else { format!("polygon {}, ", e.polygon) };
        let matters = matches!(e.repair, Repair::Crossing | Repair::Snapped);
        let entry = Entry {
            action: action(e.repair),
            code: e.repair.as_str(),
            polygon: Some(e.polygon),
            ring: Some(e.ring),
            indices: e.indices.clone(),
            points: e.points.iter().map(|p| [p.x, p.y]).collect(),
            moved: matters.then(|| repairs.moved()),
            message: format!("{polygon}ring {}{}: {}", e.ring, listed(&e.indices), told(e.repair)),
        };
        (e.repair.is_warning(), entry)
    };
    repairs.entries().iter().map(entry).collect()
}

fn action(repair: Repair) -> Action {
    match repair {
        Repair::DegenerateHole
        | Repair::EmptyPolygon
        | Repair::Spike
        | Repair::Bridge
        | Repair::DuplicateRing
        | Repair::RepeatedPoint => Action::Dropped,
        _ => Action::Repaired,
    }
}

/// What a repair did, in words.
fn told(repair: Repair) -> String {
    match repair {
        Repair::RepeatedPoint => "repeated vertices are dropped",
        Repair::StraightCorner => "straight corners are merged",
        Repair::Spike => "spikes are removed",
        Repair::DegenerateHole => "the ring encloses no area and is dropped",
        Repair::EmptyPolygon => "the polygon encloses nothing and is left out",
        Repair::Reversed => "the ring is turned round",
        Repair::Regrouped => "the ring is an outer ring or a hole by its depth",
        Repair::SplitEdge => "edges are split where corners lie on them",
        Repair::SelfTouch => "the ring passes a point twice",
        Repair::Bridge => "edges run through both ways are removed",
        Repair::CutInterior => "touching rings cut the interior",
        Repair::Crossing => "edges are cut where they cross",
        Repair::Overlap => "edges that lie on each other are taken together",
        Repair::DuplicateRing => "what is given once more is dropped",
        Repair::Dissolved => "the polygons of the feature are united",
        Repair::Snapped => "vertices are moved to a grid",
        _ => return repair.to_string(),
    }
    .to_owned()
}

/// Most positions a message lists; the report file lists all.
const LISTED: usize = 5;

fn listed(indices: &[u32]) -> String {
    if indices.is_empty() {
        return String::new();
    }
    let shown: Vec<String> = indices.iter().take(LISTED).map(u32::to_string).collect();
    let more = if indices.len() > LISTED { ", …" } else { "" };
    let noun = if indices.len() == 1 { "vertex" } else { "vertices" };
    format!(", {noun} {}{more}", shown.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_are_cut_in_messages() {
        assert_eq!(listed(&[]), "");
        assert_eq!(listed(&[4]), ", vertex 4");
        assert_eq!(listed(&[4, 7]), ", vertices 4, 7");
        assert_eq!(listed(&[1, 2, 3, 4, 5, 6]), ", vertices 1, 2, 3, 4, 5, …");
    }

    #[test]
    fn the_documentation_lists_every_repair() {
        let formats = include_str!("../../../docs/formats.md");
        for repair in Repair::ALL {
            assert!(formats.contains(&format!("`{repair}`")), "{repair}");
        }
    }

    /// Calls `visit` with the sources in a folder.
    fn each_source(folder: &std::path::Path, visit: &mut impl FnMut(&str)) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                each_source(&path, visit);
            } else {
                visit(&std::fs::read_to_string(path).unwrap());
            }
        }
    }

    #[test]
    fn the_documentation_lists_every_reason() {
        let formats = include_str!("../../../docs/formats.md");
        let reports = formats.split_once("## Reports").unwrap().1;
        let reports = reports.split_once("## Timings").unwrap().0;
        let mut n = 0;
        each_source(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut |source| {
            let refusals = source.split("refused(\"").skip(1);
            let codes = source.split("Error::").skip(1).filter_map(|rest| {
                let (_, rest) = rest.lines().next()?.split_once("=> \"")?;
                Some(rest)
            });
            for found in refusals.chain(codes) {
                let code = found.split('"').next().unwrap_or_default();
                let is_code = !code.is_empty()
                    && code.bytes().all(|byte| byte == b'_' || byte.is_ascii_lowercase());
                if is_code {
                    assert!(reports.contains(&format!("`{code}`")), "{code}");
                    n += 1;
                }
            }
        });
        assert!(n > 10, "{n}");
    }

    #[test]
    fn every_repair_has_words() {
        for repair in Repair::ALL {
            assert_ne!(told(repair), repair.to_string());
        }
    }
}
