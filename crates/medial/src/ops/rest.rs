//! What is left of an axis when parts of paths are removed.

use crate::axis::{Curve, GONE, Keypoint, KeypointKind, MedialAxis, Path, PathTable, SiteTable};

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
    /// For each path its place among those of which a part may be gone, or [`WHOLE`].
    places: Vec<u32>,
    /// These paths, and from which parameter to which they are kept; nothing where the two are equal.
    cut: Vec<(u32, [f64; 2])>,
    pub error: f64,
}

/// No place: all of a path is kept.
const WHOLE: u32 = u32::MAX;

/// All parameters along a path.
const ALL: [f64; 2] = [0.0, 1.0];

/// How much is left.
struct Left {
    /// How many paths each keypoint has left; [`ALONE`] if that is none and it is kept.
    degrees: Vec<u32>,
    n_keypoints: usize,
    n_paths: usize,
    n_tips: usize,
}

/// No path is left at a keypoint that is kept.
const ALONE: u32 = u32::MAX;

impl<'a> Rest<'a> {
    /// All of an axis.
    pub fn of(axis: &'a MedialAxis) -> Self {
        Self { axis, places: vec![WHOLE; axis.paths().len()], cut: Vec::new(), error: 0.0 }
    }

    /// Removes a path from its start, or from its end, up to a parameter.
    #[inline]
    pub fn cut(&mut self, path: u32, from_start: bool, to: f64) {
        self.part(path)[usize::from(!from_start)] = to;
    }

    /// Removes all of a path.
    #[inline]
    pub fn remove(&mut self, path: u32) {
        *self.part(path) = [0.0, 0.0];
    }

    /// What is kept of a path, to be changed.
    #[inline]
    fn part(&mut self, path: u32) -> &mut [f64; 2] {
        let place = &mut self.places[path as usize];
        if *place == WHOLE {
            *place = self.cut.len() as u32;
            self.cut.push((path, ALL));
        }
        &mut self.cut[*place as usize].1
    }

    /// What was pruned, once more.
    pub fn again(axis: &'a MedialAxis, pruned: &Pruned) -> Self {
        let mut kept = vec![[0.0, 0.0]; axis.paths().len()];
        pruned.origins.iter().for_each(|origin| kept[origin.path as usize] = origin.part);
        let mut rest = Self { error: pruned.error, ..Self::of(axis) };
        for (path, part) in (0..).zip(kept).filter(|(_, part)| *part != ALL) {
            *rest.part(path) = part;
        }
        rest
    }

    /// Removes what is removed of another rest of the same axis, too.
    pub fn and(&mut self, other: Self) {
        for (path, [low, high]) in other.cut {
            let own = self.part(path);
            *own = [own[0].max(low), own[1].min(high)];
        }
        self.error = self.error.max(other.error);
    }

    /// The axis of which this is left.
    pub fn axis(&self) -> &'a MedialAxis {
        self.axis
    }

    /// How many paths a part of which may be gone.
    pub fn n_cut(&self) -> usize {
        self.cut.len()
    }

    /// The place of a path among those of which a part may be gone, and whether what is left of it starts, or
    /// ends, in a tip, if anything is left but a root.
    #[inline]
    pub fn tips(&self, path: u32) -> Option<(usize, Option<[bool; 2]>)> {
        let place = self.places[path as usize];
        (place != WHOLE).then(|| {
            let [low, high] = self.cut[place as usize].1;
            (place as usize, (low < high).then(|| is_tip(low, high)))
        })
    }

    /// The curve of what is left of a path, from its start or from its end.
    pub fn curve_of(&self, path: u32, forwards: bool) -> Curve {
        let place = self.places[path as usize];
        let path = self.axis.paths().at(path);
        let turned = if forwards { path } else { path.reversed() };
        if place == WHOLE {
            return self.axis.curve(&turned);
        }
        let curve = self.axis.curve(&path);
        let mut ends = self.cut[place as usize].1.map(|u| (curve.point_at(u), curve.radius_at(u)));
        if !forwards {
            ends.reverse();
        }
        let sites = [turned.left, turned.right].map(|site| self.axis.site_shape(site));
        self.axis.curve_between(&sites, ends)
    }

    /// Whether all is kept.
    fn is_all(&self) -> bool {
        self.cut.iter().all(|(_, part)| *part == ALL)
    }

    /// How much is left, roots included.
    fn left(&self, roots: &[u32]) -> Left {
        let Self { axis, cut, .. } = self;
        let (mut n_paths, mut n_tips) = (self.places.len(), 0);
        let mut degrees = axis.degrees();
        let mut n_keypoints = degrees.len();
        let mut lose = |keypoint: u32, is_less: bool| {
            let degree = &mut degrees[keypoint as usize];
            *degree -= u32::from(is_less);
            n_keypoints -= usize::from(is_less && *degree == 0);
        };
        for &(path, [low, high]) in cut {
            let [from, to] = axis.paths().ends(path);
            let is_left = is_left(low, high);
            lose(from, !is_left || low != 0.0);
            lose(to, !is_left || high != 1.0);
            n_paths -= usize::from(low >= high);
            if is_left {
                n_tips += is_tip(low, high).map(usize::from).iter().sum::<usize>();
            }
        }
        for &root in roots {
            let degree = &mut degrees[root as usize];
            if *degree == 0 {
                *degree = ALONE;
                n_keypoints += 1;
            }
        }
        Left { degrees, n_keypoints, n_paths, n_tips }
    }

    /// What is left; of a component that is removed altogether the root. `lost` tells the excess of what
    /// was removed up to a keypoint, which counts if that stays.
    pub fn finish(self, roots: &[u32], lost: &[(u32, f64)]) -> Pruned {
        let axis = self.axis;
        if self.is_all() {
            let origin = |path| Origin { path, part: ALL };
            let origins = (0..axis.paths().len() as u32).map(origin).collect();
            return Pruned { axis: axis.clone(), error: 0.0, origins };
        }
        let mut origins = Vec::with_capacity(axis.paths().len());
        let (axis, error) =
            self.listed(roots, lost, |path, part| origins.push(Origin { path, part }));
        Pruned { axis, error, origins }
    }

    /// The same without the origins.
    pub fn axis_and_error(self, roots: &[u32], lost: &[(u32, f64)]) -> (MedialAxis, f64) {
        if self.is_all() {
            return (self.axis.clone(), 0.0);
        }
        self.listed(roots, lost, |_, _| ())
    }

    /// The same, given something to do with each path that is left and what is left of it.
    fn listed(
        self,
        roots: &[u32],
        lost: &[(u32, f64)],
        mut of_path: impl FnMut(u32, [f64; 2]),
    ) -> (MedialAxis, f64) {
        let axis = self.axis;
        let Left { degrees: mut numbers, n_keypoints, n_paths, n_tips } = self.left(roots);
        let kind = |degree: u32, kind: KeypointKind| match (degree, kind) {
            (1, kind @ (KeypointKind::End | KeypointKind::Clipped)) => kind,
            (ALONE | 1, _) => KeypointKind::Tip,
            (2, _) => KeypointKind::Transition,
            _ => KeypointKind::Junction,
        };
        let mut sites = vec![GONE; axis.sites().len()];
        let mut points = axis.keypoints_left([n_keypoints, n_tips], &mut numbers, kind, |site| {
            sites[site as usize] = 0;
        });
        let mut error = self.error;
        for &(keypoint, excess) in lost {
            if numbers[keypoint as usize] != GONE {
                error = error.max(excess);
            }
        }
        let (table, sites) = self.sites(sites);
        if let Some(sites) = &sites {
            points.renumber(|site| sites[site as usize]);
        }
        let site = |site: u32| sites.as_ref().map_or(site, |sites| sites[site as usize]);
        let mut paths = PathTable::with_room(n_paths);
        let number = |keypoint: u32| numbers[keypoint as usize];
        for (origin, (ends, &place)) in (0..).zip(axis.paths().all_ends().zip(&self.places)) {
            if place == WHOLE {
                axis.copy_path(&mut paths, origin, ends.map(number), site);
                of_path(origin, ALL);
                continue;
            }
            let part @ [low, high] = self.cut[place as usize].1;
            if !is_left(low, high) {
                continue;
            }
            let [from, to] = ends.map(number);
            let [is_tip_at_start, is_tip_at_end] = is_tip(low, high);
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
            of_path(origin, part);
        }
        points.shrink();
        paths.shrink();
        let MedialAxis { engine, side, accuracy, .. } = *axis;
        let axis = MedialAxis::from_tables(engine, side, accuracy, false, table, points, paths);
        (axis, error)
    }

    /// The sites that govern something that is left, and the numbers that all have among them, unless that
    /// are all: sites that govern nothing any more are not listed. Given are those of the keypoints.
    fn sites(&self, mut sites: Vec<u32>) -> (SiteTable, Option<Vec<u32>>) {
        let axis = self.axis;
        // The governors of a path are those of the keypoint where it starts, or listed.
        let mut show = |path: u32| {
            let path = axis.paths().at(path);
            (sites[path.left as usize], sites[path.right as usize]) = (0, 0);
        };
        for &(path, [low, high]) in &self.cut {
            if is_left(low, high) && is_tip(low, high) != [false; 2] {
                show(path);
            }
        }
        for path in axis.paths().listed() {
            let place = self.places[path as usize];
            let is_kept = place == WHOLE || {
                let [low, high] = self.cut[place as usize].1;
                is_left(low, high)
            };
            if is_kept {
                show(path);
            }
        }
        if !sites.contains(&GONE) {
            return (axis.all_sites(), None);
        }
        let table = axis.sites_among(&mut sites);
        (table, Some(sites))
    }
}

/// Whether anything is left of a path, if only its root.
#[inline]
fn is_left(low: f64, high: f64) -> bool {
    low < high || is_root(low, high)
}

/// Whether a path that is left ends in a tip where it starts, and where it ends.
#[inline]
fn is_tip(low: f64, high: f64) -> [bool; 2] {
    [low > 0.0, high < 1.0 && low < high]
}

/// Whether a path is removed from both ends up to the root, or from one end altogether.
#[inline]
fn is_root(low: f64, high: f64) -> bool {
    low == high && 0.0 < low && low < 1.0
}
