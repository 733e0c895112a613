use std::fmt;

use crate::geom::Point;

/// What was changed to make a feature valid, in the order in which it was done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    entries: Vec<Entry>,
    moved: f64,
    is_rebuilt: bool,
}

/// One kind of change to one ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// What was done.
    pub repair: Repair,
    /// Polygon of the feature, from 0.
    pub polygon: u32,
    /// Ring of the polygon, from 0; 0 is the outer ring.
    pub ring: u32,
    /// Positions in the ring as given of all vertices, or first vertices of edges, concerned;
    /// empty where the whole ring is.
    pub indices: Vec<u32>,
    /// Where it shows in the plane, if that is not in these vertices: where edges cross, or where
    /// pieces of them lie on each other.
    pub points: Vec<Point>,
}

/// A kind of change. `Display` gives its name in report files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Repair {
    /// `repeated_point`: a vertex equal to the one before it was dropped; closing points do not
    /// count.
    RepeatedPoint,
    /// `straight_corner`: a vertex in the middle of a straight run was merged away.
    StraightCorner,
    /// `spike`: the tip of a run there and back on one line was removed.
    Spike,
    /// `degenerate_hole`: a hole, or a ring of a polygon that was repaired, with fewer than three distinct
    /// points, or all on one line, was dropped.
    DegenerateHole,
    /// `empty_polygon`: a polygon that encloses nothing was left out; its number stays free.
    EmptyPolygon,
    /// `reversed`: the ring was turned round, so that the interior lies to its left.
    Reversed,
    /// `regrouped`: the ring was found an outer ring or a hole by its depth, against its place in
    /// the polygon.
    Regrouped,
    /// `split_edge`: an edge was split where a corner lies on it.
    SplitEdge,
    /// `self_touch`: the ring passes a point twice.
    SelfTouch,
    /// `bridge`: an edge run through both ways was removed.
    Bridge,
    /// `cut_interior`: touching rings cut the interior of the polygon into several parts.
    CutInterior,
    /// `crossing`: edges were cut where they cross.
    Crossing,
    /// `overlap`: pieces of edges that lie on each other were taken together.
    Overlap,
    /// `duplicate_ring`: a ring, or a polygon, given once more was dropped.
    DuplicateRing,
    /// `dissolved`: polygons of the feature were united.
    Dissolved,
    /// `snapped`: vertices were moved to a grid, as nothing finer gave a valid domain.
    Snapped,
}

impl Repair {
    /// All kinds, in order.
    pub const ALL: [Self; 16] = [
        Self::RepeatedPoint,
        Self::StraightCorner,
        Self::Spike,
        Self::DegenerateHole,
        Self::EmptyPolygon,
        Self::Reversed,
        Self::Regrouped,
        Self::SplitEdge,
        Self::SelfTouch,
        Self::Bridge,
        Self::CutInterior,
        Self::Crossing,
        Self::Overlap,
        Self::DuplicateRing,
        Self::Dissolved,
        Self::Snapped,
    ];

    /// The name in report files.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::RepeatedPoint => "repeated_point",
            Self::StraightCorner => "straight_corner",
            Self::Spike => "spike",
            Self::DegenerateHole => "degenerate_hole",
            Self::EmptyPolygon => "empty_polygon",
            Self::Reversed => "reversed",
            Self::Regrouped => "regrouped",
            Self::SplitEdge => "split_edge",
            Self::SelfTouch => "self_touch",
            Self::Bridge => "bridge",
            Self::CutInterior => "cut_interior",
            Self::Crossing => "crossing",
            Self::Overlap => "overlap",
            Self::DuplicateRing => "duplicate_ring",
            Self::Dissolved => "dissolved",
            Self::Snapped => "snapped",
        }
    }

    /// Whether a user should hear of it: the point set changed, or is not what it seems.
    #[must_use]
    pub const fn is_warning(self) -> bool {
        !matches!(
            self,
            Self::RepeatedPoint | Self::StraightCorner | Self::Reversed | Self::SplitEdge
        )
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl Report {
    /// All changes.
    #[must_use]
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// How many vertices, edges or rings a kind of change concerned.
    #[must_use]
    pub fn count(&self, repair: Repair) -> usize {
        let of_kind = self.entries.iter().filter(|e| e.repair == repair);
        of_kind.map(|e| e.indices.len().max(1)).sum()
    }

    /// How far edges were moved at most, in units of the input: by rounding where they cross, mostly.
    #[must_use]
    pub const fn moved(&self) -> f64 {
        self.moved
    }

    pub(super) fn push(&mut self, repair: Repair, polygon: u32, ring: u32, indices: Vec<u32>) {
        self.entries.push(Entry { indices, ..Entry::of(repair, polygon, ring) });
    }

    /// Whether the boundary is made of other rings than those given, which were cut and joined anew.
    #[must_use]
    pub const fn is_rebuilt(&self) -> bool {
        self.is_rebuilt
    }

    pub(super) fn rebuilt(entries: Vec<Entry>, moved: f64) -> Self {
        Self { entries, moved, is_rebuilt: true }
    }
}

impl Entry {
    pub(super) fn of(repair: Repair, polygon: u32, ring: u32) -> Self {
        Self { repair, polygon, ring, indices: Vec::new(), points: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_repairs_are_distinct() {
        let mut names: Vec<_> = Repair::ALL.iter().map(|r| r.to_string()).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), Repair::ALL.len());
    }

    #[test]
    fn a_whole_ring_counts_once_and_vertices_count_each() {
        let mut report = Report::default();
        report.push(Repair::Reversed, 0, 1, Vec::new());
        report.push(Repair::Spike, 0, 0, vec![3, 8]);
        report.push(Repair::Spike, 0, 1, vec![2]);
        assert_eq!(report.count(Repair::Reversed), 1);
        assert_eq!(report.count(Repair::Spike), 3);
        assert_eq!(report.count(Repair::Bridge), 0);
    }
}
