//! An axis taken apart, so that faults can be planted.

use medial::axis::{Accuracy, Engine, KeypointKind, MedialAxis, Path, Side, Site};
use medial::geom::Point;

#[derive(Clone, Debug)]
pub struct Keypoint {
    pub position: Point,
    pub radius: f64,
    pub kind: KeypointKind,
    pub governors: Vec<u32>,
}

#[derive(Clone, Debug)]
pub struct Parts {
    pub side: Side,
    pub complete: bool,
    pub accuracy: Accuracy,
    pub sites: Vec<Site>,
    pub keypoints: Vec<Keypoint>,
    pub paths: Vec<Path>,
}

impl Parts {
    pub fn of(axis: &MedialAxis) -> Self {
        let keypoints = axis.keypoints().iter().zip(0..).map(|(k, number)| Keypoint {
            position: k.position,
            radius: k.radius,
            kind: k.kind,
            governors: axis.governors(number).to_vec(),
        });
        Self {
            side: axis.side,
            complete: axis.complete,
            accuracy: axis.accuracy,
            sites: axis.sites().iter().collect(),
            keypoints: keypoints.collect(),
            paths: axis.paths().iter().collect(),
        }
    }

    pub fn axis(&self) -> MedialAxis {
        let keypoints =
            self.keypoints.iter().map(|k| (k.position, k.radius, k.kind, k.governors.as_slice()));
        MedialAxis::from_parts(
            Engine::PathTracing,
            self.side,
            self.accuracy,
            self.complete,
            self.sites.clone(),
            keypoints,
            self.paths.clone(),
        )
        .expect("faults keep numbers inside their tables")
    }

    /// Takes away the sites that govern nothing any more.
    pub fn drop_idle_sites(&mut self) {
        let governs = |site: u32| {
            self.keypoints.iter().any(|k| k.governors.contains(&site))
                || self.paths.iter().any(|p| p.left == site || p.right == site)
        };
        let kept: Vec<u32> = (0..self.sites.len() as u32).filter(|&s| governs(s)).collect();
        let number =
            |old: u32| kept.iter().position(|&k| k == old).expect("it governs something") as u32;
        for path in &mut self.paths {
            (path.left, path.right) = (number(path.left), number(path.right));
        }
        for governor in self.keypoints.iter_mut().flat_map(|k| &mut k.governors) {
            *governor = number(*governor);
        }
        self.sites = kept.iter().map(|&k| self.sites[k as usize]).collect();
    }

    /// Number of the keypoint at a place.
    pub fn at(&self, x: f64, y: f64) -> usize {
        self.keypoints
            .iter()
            .position(|k| k.position == Point::new(x, y))
            .unwrap_or_else(|| panic!("no keypoint at ({x}, {y})"))
    }

    /// Number of the path between two keypoints.
    pub fn between(&self, a: usize, b: usize) -> usize {
        let (a, b) = (a as u32, b as u32);
        self.paths
            .iter()
            .position(|p| (p.from, p.to) == (a, b) || (p.from, p.to) == (b, a))
            .unwrap_or_else(|| panic!("no path between {a} and {b}"))
    }
}
