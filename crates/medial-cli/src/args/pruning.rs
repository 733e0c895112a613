use super::{ChosenEngine, measure, not_negative};
use crate::failure::Failure;
use clap::Args;
use medial::axis::Engine;
use medial::engine::{self, DualPruning};
use medial::ops::{Hierarchy, Measure, Pruned};
use medial_io::Feature;

/// What is removed from axes.
#[derive(Debug, Args)]
pub struct Pruning {
    /// Remove what lies below this value of a measure, from the leaves inwards: excess,
    /// relative_excess, prominence, potential, chord, circularity, erosion, length, angle,
    /// half_chord, radius, scale
    ///
    /// raster_transform and delaunay_dual prune images by chord=2 cells, and measures other than chord what that has
    /// left; `none` keeps what their disks need to be the image again, and of delaunay_dual everything; `leaf`, for delaunay_dual, removes leaves of one triangle
    #[arg(long, value_name = "MEASURE=VALUE", value_parser = prune, conflicts_with = "max_error")]
    pub prune: Option<Prune>,
    /// Remove branches for as long as the boundary moves by less than this, in units of the input:
    /// short for --prune excess=V
    #[arg(long, value_name = "V", value_parser = not_negative, allow_negative_numbers = true)]
    pub max_error: Option<f64>,
    /// Keep what the axis of flattened curves has that the axis of the curves has not
    #[arg(long)]
    pub keep_artefacts: bool,
}

impl Pruning {
    /// Fails if leaves of triangles are to go from an engine that has none.
    pub fn check(&self, chosen: &ChosenEngine) -> Result<(), Failure> {
        if self.prune == Some(Prune::Leaves) && chosen.engine != Some(Engine::DelaunayDual) {
            let why = "--prune leaf is for --engine delaunay_dual";
            return Err(Failure::Usage(why.to_owned()));
        }
        Ok(())
    }

    /// Whether anything may go of what an engine found for a feature.
    pub fn removes(&self, feature: &Feature, engine: Engine) -> bool {
        let curves = feature.curves.is_some() && engine.is_exact() && !self.keep_artefacts;
        self.left_to(engine).is_some() || curves
    }

    /// What is left of the axis of an engine, if anything may go.
    pub fn rest(
        &self,
        feature: &Feature,
        engine: Engine,
        hierarchy: &Hierarchy<'_>,
    ) -> Option<Pruned> {
        match (&feature.curves, self.left_to(engine)) {
            (Some(curves), threshold) if engine.is_exact() && !self.keep_artefacts => {
                Some(hierarchy.without_artefacts(&feature.polygons, curves, threshold))
            }
            (_, threshold) => threshold.map(|(measure, value)| hierarchy.pruned(measure, value)),
        }
    }

    /// What leaves a dual graph of a feature by itself; the rest of pruning is done by [`rest`](Self::rest).
    pub fn of_dual(&self, feature: &Feature, cell: f64) -> DualPruning {
        match self.prune {
            Some(Prune::Nothing) => DualPruning::Nothing,
            Some(Prune::Leaves) => DualPruning::Leaves,
            Some(Prune::Below(Measure::Chord, value)) => DualPruning::Chord(value),
            _ if feature.mask.is_none() => DualPruning::Nothing,
            _ => match self.residual(cell) {
                Some(residual) => DualPruning::Chord(residual * cell),
                None => DualPruning::Nothing,
            },
        }
    }

    /// The measure and the value below which points are removed, if any are.
    pub fn threshold(&self) -> Option<(Measure, f64)> {
        match self.prune {
            Some(Prune::Below(measure, value)) => Some((measure, value)),
            Some(Prune::Nothing | Prune::Leaves) => None,
            None => self.max_error.map(|error| (Measure::Excess, error)),
        }
    }

    /// The same without what an engine sees to by itself.
    fn left_to(&self, engine: Engine) -> Option<(Measure, f64)> {
        let prunes = matches!(engine, Engine::RasterTransform | Engine::DelaunayDual);
        self.threshold().filter(|&(measure, _)| !prunes || measure != Measure::Chord)
    }

    /// The chord residual, in cells of that size, that an engine on cells prunes by; the rest of pruning is
    /// done by [`rest`](Self::rest).
    pub fn residual(&self, cell: f64) -> Option<f64> {
        match self.prune {
            Some(Prune::Nothing) => None,
            Some(Prune::Below(Measure::Chord, value)) => Some(value / cell),
            _ => engine::Options::default().residual,
        }
    }
}

/// What `--prune` says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prune {
    /// Remove nothing.
    Nothing,
    /// Remove leaves of one triangle.
    Leaves,
    /// Remove what lies below a value of a measure.
    Below(Measure, f64),
}

pub(super) fn prune(word: &str) -> Result<Prune, String> {
    if word == "none" {
        return Ok(Prune::Nothing);
    }
    if word == "leaf" {
        return Ok(Prune::Leaves);
    }
    threshold(word).map(|(measure, value)| Prune::Below(measure, value))
}

fn threshold(word: &str) -> Result<(Measure, f64), String> {
    let (name, value) = word.split_once('=').ok_or("MEASURE=VALUE is needed, as excess=2.5")?;
    Ok((measure(name)?, not_negative(value)?))
}
