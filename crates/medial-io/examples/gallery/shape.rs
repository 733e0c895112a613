//! What the lessons draw: a domain with its axis and the steps in which it was traced.

use crate::sheet::Window;
use medial::axis::{self, Curve, Keypoint, KeypointKind, MedialAxis};
use medial::check::defects;
use medial::domain::{Corner, Domain, Options, Site};
use medial::engine::{Step, path_tracing, path_tracing_steps};
use medial::geom::Point;
use medial::geom::predicates::ExactDisk;
use medial_io::{Format, read};
use std::error::Error;
use std::fs;

/// The result of something that may go wrong.
pub type Fallible<T> = Result<T, Box<dyn Error>>;

/// The axis of a domain; refused if the judge finds a defect.
pub fn judged(domain: &Domain) -> Fallible<MedialAxis> {
    let axis = path_tracing(domain)?;
    match defects(domain, &axis).defects.first() {
        None => Ok(axis),
        Some(defect) => Err(format!("a figure would show a defect: {defect}").into()),
    }
}

/// A domain, its axis, and how that was traced.
pub struct Shape {
    /// The validated polygon.
    pub domain: Domain,
    /// Its axis, without a defect.
    pub axis: MedialAxis,
    /// Its paths in the order of tracing.
    pub steps: Vec<Step>,
}

impl Shape {
    /// The shape with one ring; refused if the judge finds a defect of its axis.
    pub fn new(ring: &[(f64, f64)]) -> Fallible<Self> {
        let ring: Vec<Point> = ring.iter().map(|&(x, y)| Point::new(x, y)).collect();
        Self::of(Domain::from_polygons(&[vec![ring]], &Options::default())?)
    }

    /// The stretch of river among the fixtures.
    pub fn river() -> Fallible<Self> {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/river.geojson");
        let bytes = fs::read(file)?;
        let feature =
            read(Format::GeoJson, &bytes)?.next().ok_or("no feature in the fixture")??;
        Self::of(Domain::from_polygons(&feature.polygons, &Options::default())?)
    }

    /// The shape of the first geometry of a WKT fixture.
    pub fn fixture(name: &str) -> Fallible<Self> {
        let file = format!("{}/../../fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
        let bytes = fs::read(file)?;
        let feature = read(Format::Wkt, &bytes)?.next().ok_or("no geometry in the fixture")??;
        Self::of(Domain::from_polygons(&feature.polygons, &Options::default())?)
    }

    /// The shape of a domain; refused if the judge finds a defect of its axis.
    pub fn of(domain: Domain) -> Fallible<Self> {
        let axis = judged(&domain)?;
        let steps = path_tracing_steps(&domain)?.collect::<Result<_, _>>()?;
        Ok(Self { domain, axis, steps })
    }

    /// The box around the boundary, grown on all sides.
    pub fn window(&self, margin: f64) -> Window {
        let (mut low, mut high) = (Point::new(f64::MAX, f64::MAX), Point::new(f64::MIN, f64::MIN));
        for p in self.domain.edges().iter().map(|e| e.start) {
            low = Point::new(low.x.min(p.x), low.y.min(p.y));
            high = Point::new(high.x.max(p.x), high.y.max(p.y));
        }
        let margin = Point::new(margin, margin);
        (low - margin, high + margin)
    }

    /// A site as an axis lists it.
    pub fn site(&self, site: Site) -> axis::Site {
        let (a, b) = (self.domain.edge(site.index()).start, self.domain.end(site.index()));
        if site.is_edge() { axis::Site::edge(a, b) } else { axis::Site::vertex(a) }
    }

    /// The curve of a step, from where it starts to where it ends.
    pub fn curve(&self, step: &Step) -> Curve {
        Curve::new(&self.site(step.left), &self.site(step.right), step.from, step.to)
    }

    /// The curve of a step, if it ended at this disk.
    pub fn curve_to(&self, step: &Step, disk: (Point, f64)) -> Curve {
        Curve::new(&self.site(step.left), &self.site(step.right), step.from, disk)
    }

    /// The disk that touches the governors of a step and a third site between them.
    pub fn disk(&self, step: &Step, third: Site) -> Fallible<(Point, f64)> {
        let elements = [step.right, third, step.left].map(|s| self.domain.element(s));
        let disk = ExactDisk::new(elements).ok_or("no disk touches these three sites")?;
        Ok(disk.approximate())
    }

    /// The step whose governors are of these kinds, edge or not, right and left.
    pub fn step(
        &self,
        right_is_edge: bool,
        left_is_edge: bool,
        from: (f64, f64),
    ) -> Fallible<&Step> {
        let from = Point::new(from.0, from.1);
        self.steps
            .iter()
            .filter(|s| s.right.is_edge() == right_is_edge && s.left.is_edge() == left_is_edge)
            .min_by(|a, b| {
                let far = |s: &Step| (s.from.0 - from).norm2();
                far(a).total_cmp(&far(b))
            })
            .ok_or_else(|| "no such step".into())
    }

    /// The keypoint of a kind nearest to a place, with its number.
    pub fn keypoint(&self, kind: KeypointKind, near: (f64, f64)) -> Fallible<(u32, Keypoint)> {
        let near = Point::new(near.0, near.1);
        (0..)
            .zip(self.axis.keypoints())
            .filter(|(_, k)| k.kind == kind)
            .min_by(|a, b| {
                let far = |k: &Keypoint| (k.position - near).norm2();
                far(&a.1).total_cmp(&far(&b.1))
            })
            .ok_or_else(|| "no such keypoint".into())
    }

    /// Governors of a keypoint.
    pub fn governors(&self, keypoint: u32) -> Vec<axis::Site> {
        self.axis.governors(keypoint).iter().map(|&g| self.axis.sites().at(g)).collect()
    }

    /// The inward normal of an edge.
    pub fn normal(&self, edge: u32) -> Point {
        self.domain.edge(edge).direction.perp()
    }
}

/// The half-line into the domain from the corner where an edge starts, for a neighbour with this
/// normal: at a convex corner the first path of the axis runs along it.
pub fn half_line(shape: &Shape, corner: u32, normal: Point) -> Fallible<Point> {
    let edge = shape.domain.edge(corner);
    if edge.corner != Corner::Convex {
        return Ok(normal);
    }
    let curves = shape.axis.paths().iter().map(|p| shape.axis.curve(&p));
    let way = |from: Point, to: Point| (to - from) * (1.0 / (to - from).norm());
    curves
        .filter_map(|c| {
            if c.from() == edge.start {
                Some(way(c.from(), c.to()))
            } else if c.to() == edge.start {
                Some(way(c.to(), c.from()))
            } else {
                None
            }
        })
        .next()
        .ok_or_else(|| "a convex corner without a path".into())
}
