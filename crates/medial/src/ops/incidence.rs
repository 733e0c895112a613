//! Which paths meet in each keypoint.

use crate::axis::MedialAxis;

/// The paths at each keypoint.
#[derive(Debug)]
pub(super) struct Incidence {
    first: Vec<u32>,
    paths: Vec<u32>,
}

impl Incidence {
    pub fn new(axis: &MedialAxis) -> Self {
        let n = axis.keypoints().len();
        let mut first = vec![0; n + 1];
        let ends = || axis.paths().iter().flat_map(|path| [path.from, path.to]);
        ends().for_each(|k| first[k as usize + 1] += 1);
        for k in 0..n {
            first[k + 1] += first[k];
        }
        let mut next = first.clone();
        let mut paths = vec![0; first[n] as usize];
        for (k, path) in ends().zip((0..).flat_map(|path| [path, path])) {
            paths[next[k as usize] as usize] = path;
            next[k as usize] += 1;
        }
        Self { first, paths }
    }

    pub fn of(&self, keypoint: u32) -> &[u32] {
        let k = keypoint as usize;
        &self.paths[self.first[k] as usize..self.first[k + 1] as usize]
    }
}
