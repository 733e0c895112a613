//! What is left of an axis when parts of paths are removed.

use crate::axis::{Keypoint, KeypointKind, KeypointTable, MedialAxis, Path, PathTable};

/// What is left of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Pruned {
    /// The axis, which is not complete any more if anything was removed.
    pub axis: MedialAxis,
    /// The distance by which the boundary moves at most if disks take the place of what was removed: the
    /// largest excess at a cut. In units of the input.
    pub error: f64,
    /// Where each of its paths comes from.
    pub origins: Vec<Origin>,
}

/// A part of a path of another axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    /// The number of that path.
    pub path: u32,
    /// The parameters along its curve where the part starts and ends, in the same direction.
    pub part: [f64; 2],
}

/// The parts of paths that are kept.
pub(super) struct Rest<'a> {
    axis: &'a MedialAxis,
    /// For each path from which parameter to which; nothing where the two are equal.
    kept: Vec<[f64; 2]>,
    pub error: f64,
}

impl<'a> Rest<'a> {
    /// All of an axis.
    pub fn of(axis: &'a MedialAxis) -> Self {
        Self { axis, kept: vec![[0.0, 1.0]; axis.paths().len()], error: 0.0 }
    }

    /// Removes a path from its start, or from its end, up to a parameter.
    pub fn cut(&mut self, path: u32, from_start: bool, to: f64) {
        self.kept[path as usize][usize::from(!from_start)] = to;
    }

    /// What was pruned, once more.
    pub fn again(axis: &'a MedialAxis, pruned: &Pruned) -> Self {
        let mut kept = vec![[0.0, 0.0]; axis.paths().len()];
        pruned.origins.iter().for_each(|origin| kept[origin.path as usize] = origin.part);
        Self { axis, kept, error: pruned.error }
    }

    /// Removes what is removed of another rest of the same axis, too.
    pub fn and(&mut self, other: Self) {
        for (own, other) in self.kept.iter_mut().zip(other.kept) {
            *own = [own[0].max(other[0]), own[1].min(other[1])];
        }
        self.error = self.error.max(other.error);
    }

    /// What is left; of a component that is removed altogether the root. `lost` tells the excess of what
    /// was removed up to a keypoint, which counts if that stays.
    pub fn finish(self, roots: &[u32], lost: &[(u32, f64)]) -> Pruned {
        let Self { axis, kept, mut error } = self;
        let whole = [0.0, 1.0];
        if kept.iter().all(|part| *part == whole) {
            let origin = |path| Origin { path, part: whole };
            let origins = (0..axis.paths().len() as u32).map(origin).collect();
            return Pruned { axis: axis.clone(), error: 0.0, origins };
        }
        let is_left = |&[low, high]: &[f64; 2]| low < high || is_root(low, high);
        let is_tip = |&[low, high]: &[f64; 2]| [low > 0.0, high < 1.0 && low < high];
        let (mut n_paths, mut n_tips) = (0, 0);
        let mut degree = vec![0_u32; axis.keypoints().len()];
        // Sites that govern nothing any more are not listed.
        let mut sites = vec![u32::MAX; axis.sites().len()];
        for (path, part) in axis.paths().iter().zip(&kept).filter(|(_, part)| is_left(part)) {
            degree[path.from as usize] += u32::from(part[0] == 0.0);
            degree[path.to as usize] += u32::from(part[1] == 1.0);
            (sites[path.left as usize], sites[path.right as usize]) = (0, 0);
            n_paths += usize::from(part[0] < part[1]);
            n_tips += is_tip(part).map(usize::from).iter().sum::<usize>();
        }
        // The number of each keypoint that stays.
        let mut number: Vec<u32> =
            degree.iter().map(|&degree| if degree > 0 { 0 } else { u32::MAX }).collect();
        for &root in roots {
            number[root as usize] = 0;
        }
        for &(keypoint, excess) in lost {
            if number[keypoint as usize] == 0 {
                error = error.max(excess);
            }
        }
        let mut n = 0;
        for (k, number) in (0..).zip(&mut number).filter(|(_, number)| **number == 0) {
            axis.governors(k).iter().for_each(|&site| sites[site as usize] = 0);
            *number = n;
            n += 1;
        }
        let table = axis.sites_among(&mut sites);
        let site = |site: u32| sites[site as usize];
        let mut points = KeypointTable::with_room(n as usize + n_tips);
        for (k, _) in (0..).zip(&number).filter(|(_, number)| **number != u32::MAX) {
            let kind = match (degree[k as usize], axis.keypoints().at(k).kind) {
                (1, kind @ (KeypointKind::End | KeypointKind::Clipped)) => kind,
                (0 | 1, _) => KeypointKind::Tip,
                (2, _) => KeypointKind::Transition,
                _ => KeypointKind::Junction,
            };
            axis.copy_keypoint(&mut points, k, kind, site);
        }
        let (mut paths, mut origins) = (PathTable::with_room(n_paths), Vec::with_capacity(n_paths));
        for (origin, part) in (0..).zip(&kept).filter(|(_, part)| is_left(part)) {
            let [from, to] = axis.paths().ends(origin).map(|keypoint| number[keypoint as usize]);
            let [is_tip_at_start, is_tip_at_end] = is_tip(part);
            let &[low, high] = part;
            if is_tip_at_start || is_tip_at_end {
                let path = axis.paths().at(origin);
                let curve = axis.curve(&path);
                let (left, right) = (site(path.left), site(path.right));
                let mut tip = |u: f64| {
                    let (position, radius) = (curve.point_at(u), curve.radius_at(u));
                    let tip = Keypoint { position, radius, kind: KeypointKind::Tip };
                    points.push(&tip, [left.min(right), left.max(right)].into_iter());
                    points.len() - 1
                };
                let from = if is_tip_at_start { tip(low) } else { from };
                if low == high {
                    continue;
                }
                let to = if is_tip_at_end { tip(high) } else { to };
                paths.push(&Path { from, to, left, right }, &points);
            } else {
                axis.copy_path(&mut paths, origin, [from, to], site);
            }
            origins.push(Origin { path: origin, part: [low, high] });
        }
        points.shrink();
        paths.shrink();
        let MedialAxis { engine, side, accuracy, .. } = *axis;
        let axis = MedialAxis::from_tables(engine, side, accuracy, false, table, points, paths);
        Pruned { axis, error, origins }
    }
}

/// Whether a path is removed from both ends up to the root, or from one end altogether.
fn is_root(low: f64, high: f64) -> bool {
    low == high && 0.0 < low && low < 1.0
}
