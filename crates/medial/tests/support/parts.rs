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
            complete: axis.complete,
            accuracy: axis.accuracy,
            sites: axis.sites().to_vec(),
            keypoints: keypoints.collect(),
            paths: axis.paths().to_vec(),
        }
    }

    pub fn axis(&self) -> MedialAxis {
        let keypoints =
            self.keypoints.iter().map(|k| (k.position, k.radius, k.kind, k.governors.as_slice()));
        MedialAxis::from_parts(
            Engine::PathTracing,
            Side::Interior,
            self.accuracy,
            self.complete,
            self.sites.clone(),
            keypoints,
            self.paths.clone(),
        )
        .expect("faults keep numbers inside their tables")
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
