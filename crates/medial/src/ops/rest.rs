//! What is left of an axis when parts of paths are removed.

use crate::axis::{KeypointKind, MedialAxis, Path};
use crate::geom::Point;

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

/// A keypoint of what is left.
struct Spot {
    position: Point,
    radius: f64,
    kind: KeypointKind,
    governors: Vec<u32>,
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

    /// What is left; of a component that is removed altogether the root. `lost` tells the excess of what
    /// was removed up to a keypoint, which counts if that stays.
    pub fn finish(self, roots: &[u32], lost: &[(u32, f64)]) -> Pruned {
        let Self { axis, kept, mut error } = self;
        let whole = [0.0, 1.0];
        if kept.iter().all(|part| *part == whole) {
            let origin = |path| Origin { path, part: whole };
            let origins = (0..kept.len() as u32).map(origin).collect();
            return Pruned { axis: axis.clone(), error, origins };
        }
        let n = axis.keypoints().len();
        let mut degree = vec![0_u32; n];
        for (path, part) in axis.paths().iter().zip(&kept) {
            if part[0] < part[1] {
                degree[path.from as usize] += u32::from(part[0] == 0.0);
                degree[path.to as usize] += u32::from(part[1] == 1.0);
            }
        }
        let mut stays: Vec<bool> = degree.iter().map(|&degree| degree > 0).collect();
        for &root in roots {
            stays[root as usize] = true;
        }
        for &(keypoint, excess) in lost {
            if stays[keypoint as usize] {
                error = error.max(excess);
            }
        }
        let mut points: Vec<Spot> = Vec::new();
        let mut number = vec![u32::MAX; n];
        for (k, keypoint) in (0..).zip(axis.keypoints().iter()) {
            if !stays[k as usize] {
                continue;
            }
            number[k as usize] = points.len() as u32;
            let kind = match (degree[k as usize], keypoint.kind) {
                (1, kind @ (KeypointKind::End | KeypointKind::Clipped)) => kind,
                (0 | 1, _) => KeypointKind::Tip,
                (2, _) => KeypointKind::Transition,
                _ => KeypointKind::Junction,
            };
            let (position, radius) = (keypoint.position, keypoint.radius);
            points.push(Spot { position, radius, kind, governors: axis.governors(k).to_vec() });
        }
        let (mut paths, mut origins) = (Vec::new(), Vec::new());
        for (origin, (path, &[low, high])) in (0..).zip(axis.paths().iter().zip(&kept)) {
            // Removed from both ends up to the root, or from one end altogether.
            let is_root = low == high && 0.0 < low && low < 1.0;
            if low >= high && !is_root {
                continue;
            }
            let curve = axis.curve(&path);
            let mut tip = |u: f64| {
                let (position, radius) = (curve.point_at(u), curve.radius_at(u));
                let governors = vec![path.left.min(path.right), path.left.max(path.right)];
                points.push(Spot { position, radius, kind: KeypointKind::Tip, governors });
                points.len() as u32 - 1
            };
            if is_root {
                tip(low);
                continue;
            }
            let from = if low == 0.0 { number[path.from as usize] } else { tip(low) };
            let to = if high == 1.0 { number[path.to as usize] } else { tip(high) };
            paths.push(Path { from, to, ..path });
            origins.push(Origin { path: origin, part: [low, high] });
        }
        Pruned { axis: without_idle_sites(axis, points, paths), error, origins }
    }
}

/// An incomplete axis of these parts, with the sites that govern something.
fn without_idle_sites(
    axis: &MedialAxis,
    mut points: Vec<Spot>,
    mut paths: Vec<Path>,
) -> MedialAxis {
    let mut number = vec![u32::MAX; axis.sites().len()];
    for &site in points.iter().flat_map(|point| &point.governors) {
        number[site as usize] = 0;
    }
    let mut sites = Vec::new();
    for (number, site) in number.iter_mut().zip(axis.sites().iter()) {
        if *number == 0 {
            *number = sites.len() as u32;
            sites.push(site);
        }
    }
    let renumber = |site: &mut u32| *site = number[*site as usize];
    points.iter_mut().flat_map(|point| &mut point.governors).for_each(renumber);
    paths.iter_mut().flat_map(|path| [&mut path.left, &mut path.right]).for_each(renumber);
    let keypoints = points.iter().map(|p| (p.position, p.radius, p.kind, &p.governors[..]));
    let MedialAxis { engine, side, accuracy, .. } = *axis;
    MedialAxis::from_parts(engine, side, accuracy, false, sites, keypoints, paths)
        .unwrap_or_else(|| axis.clone())
}
