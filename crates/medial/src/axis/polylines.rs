//! Paths that follow one another, taken together.

use super::{Accuracy, KeypointKind, MedialAxis, Path};

/// Where one line of an axis ends and the next begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joining {
    /// At every keypoint where a governor changes: on an exact axis each path is a line.
    Governors,
    /// At ends and junctions.
    Branches,
}

/// Paths that follow one another.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// From the first keypoint to the last, with the governors of the first path.
    pub path: Path,
    /// The paths, in their order, and whether each is passed from its start to its end.
    pub paths: Vec<(u32, bool)>,
    /// The keypoints between them.
    pub between: Vec<u32>,
    /// Whether all paths have the same governors.
    pub is_governed: bool,
}

impl MedialAxis {
    /// The lines of an axis: each path belongs to one. Lines are in the order of their first path; closed ones
    /// begin at their keypoint of the least number.
    ///
    /// ```
    /// use medial::axis::Joining;
    /// use medial::domain::{self, Domain};
    /// use medial::engine::{Options, path_tracing, raster_transform_of_domain};
    /// use medial::geom::Point;
    /// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
    /// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &domain::Options::default())?;
    /// let cells = Options { cell: Some(0.1), ..Options::default() };
    /// for axis in [path_tracing(&domain)?, raster_transform_of_domain(&domain, &cells)?] {
    ///     assert_eq!(axis.polylines(Joining::Branches).len(), 5);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn polylines(&self, joining: Joining) -> Vec<Polyline> {
        let n = self.keypoints().len();
        // The paths of each keypoint of degree two; others are where lines end.
        let mut incident = vec![[u32::MAX; 2]; n];
        let mut degrees = vec![0_u32; n];
        for (number, path) in (0..).zip(self.paths()) {
            for end in [path.from, path.to] {
                let degree = &mut degrees[end as usize];
                if let Some(place) = incident[end as usize].get_mut(*degree as usize) {
                    *place = number;
                }
                *degree += 1;
            }
        }
        let goes_on = |keypoint: u32| {
            let k = keypoint as usize;
            let [a, b] = incident[k];
            if degrees[k] != 2
                || a == b
                || self.keypoints().at(keypoint).kind != KeypointKind::Transition
            {
                return false;
            }
            match joining {
                Joining::Branches => true,
                Joining::Governors => {
                    let is_sampled = self.accuracy != Accuracy::Exact;
                    let [a, b] = [a, b].map(|path| self.leaving(path, keypoint));
                    is_sampled && (a.left, a.right) == (b.right, b.left)
                }
            }
        };
        let passes: Vec<bool> = (0..n as u32).map(goes_on).collect();
        let mut used = vec![false; self.paths().len()];
        let mut lines = Vec::new();
        // From keypoints where lines end; then closed lines, from any.
        for is_closed in [false, true] {
            for (number, path) in (0..).zip(self.paths()) {
                let [from, to] = [path.from, path.to].map(|end| passes[end as usize]);
                if used[number as usize] || (from && to && !is_closed) {
                    continue;
                }
                // From the end where nothing comes before.
                let start = if from && !is_closed { path.to } else { path.from };
                lines.push(self.follow(number, start, &incident, &passes, &mut used));
            }
        }
        lines.sort_by_key(|line| line.paths.iter().map(|&(path, _)| path).min());
        lines
    }

    /// A path as it leaves one of its keypoints.
    fn leaving(&self, path: u32, keypoint: u32) -> Path {
        let path = self.paths().at(path);
        if path.from == keypoint { path } else { path.reversed() }
    }

    fn follow(
        &self,
        first: u32,
        start: u32,
        incident: &[[u32; 2]],
        passes: &[bool],
        used: &mut [bool],
    ) -> Polyline {
        let path = self.leaving(first, start);
        let forwards = self.paths().at(first).from == start;
        let mut line = Polyline {
            path,
            paths: vec![(first, forwards)],
            between: Vec::new(),
            is_governed: true,
        };
        used[first as usize] = true;
        let mut last = first;
        while passes[line.path.to as usize] && line.path.to != start {
            let keypoint = line.path.to;
            let [a, b] = incident[keypoint as usize];
            last = if a == last { b } else { a };
            let next = self.leaving(last, keypoint);
            used[last as usize] = true;
            line.paths.push((last, self.paths().at(last).from == keypoint));
            line.between.push(keypoint);
            line.is_governed &= (next.left, next.right) == (path.left, path.right);
            line.path.to = next.to;
        }
        line
    }
}
