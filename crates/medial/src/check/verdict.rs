use std::fmt;

use super::Defect;

/// What the judge found.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Verdict {
    /// Everything that is wrong; empty for a right axis.
    pub defects: Vec<Defect>,
    /// What was counted on the domain and on the axis.
    pub counts: Counts,
    /// Every identity that was looked at, whether it holds or not.
    pub identities: Vec<Identity>,
    /// Checks that do not apply to this axis, because it is incomplete or sampled.
    pub left_out: Vec<LeftOut>,
}

/// Numbers of things in a domain and its axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counts {
    /// Edges of the domain, after splitting where rings touch.
    pub edges: usize,
    /// Convex corners of the domain.
    pub convex: usize,
    /// Reflex corners of the domain.
    pub reflex: usize,
    /// Straight joints of the domain, which arise only where rings touch.
    pub straight: usize,
    /// Boundary walks of the domain.
    pub walks: usize,
    /// Connected components of the domain's open interior.
    pub components: usize,
    /// Sites the axis lists.
    pub sites: usize,
    /// Keypoints of kind `end`.
    pub ends: usize,
    /// Keypoints of kind `transition`.
    pub transitions: usize,
    /// Keypoints of kind `junction`.
    pub junctions: usize,
    /// Keypoints of kind `tip`.
    pub tips: usize,
    /// Keypoints of kind `clipped`.
    pub clipped: usize,
    /// Paths.
    pub paths: usize,
    /// Keypoints where one path ends.
    pub leaves: usize,
    /// Connected components of the axis; all paths that are cut outside count as joined.
    pub axis_components: usize,
    /// Independent cycles of the axis.
    pub cycles: usize,
}

/// A number over the whole axis that the domain fixes or bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Identity {
    /// What is counted or summed.
    pub name: &'static str,
    /// What the domain demands.
    pub expected: f64,
    /// What the axis has.
    pub found: f64,
    /// How the two must relate.
    pub relation: Relation,
}

/// How the number found must relate to the number expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relation {
    /// They are equal.
    Equal,
    /// It is no larger.
    AtMost,
    /// They differ by at most this much, the bound of all rounding.
    Within(f64),
}

impl Identity {
    /// Whether the axis has what the domain demands.
    #[must_use]
    #[expect(clippy::float_cmp, reason = "counts are whole numbers")]
    pub fn holds(&self) -> bool {
        match self.relation {
            Relation::Equal => self.found == self.expected,
            Relation::AtMost => self.found <= self.expected,
            Relation::Within(bound) => (self.found - self.expected).abs() <= bound,
        }
    }
}

impl fmt::Display for Identity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, expected, found, relation } = self;
        match relation {
            Relation::Equal => write!(f, "{name}: {found} instead of {expected}"),
            Relation::AtMost => write!(f, "{name}: {found}, more than {expected}"),
            Relation::Within(bound) => {
                write!(f, "{name}: {found} instead of {expected}, rounding at most {bound:e}")
            }
        }
    }
}

/// A check that was not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LeftOut {
    /// One end for each convex corner.
    Leaves,
    /// A path in each gap between governors, and cells that tile the boundary.
    Tiling,
    /// Sum of the areas of the cells.
    Area,
    /// Counts of keypoints, paths, cycles and components.
    Counts,
    /// Governors, order and exactness of keypoints and paths: a sampled axis has none.
    Governors,
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Leaves => "one end for each convex corner",
            Self::Tiling => "cells that tile the boundary",
            Self::Area => "areas of the cells",
            Self::Counts => "counts of keypoints, paths, cycles and components",
            Self::Governors => "governors and their order",
        })
    }
}
