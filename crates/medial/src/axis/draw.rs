use super::{Accuracy, MedialAxis, Path, Site, SiteKind};
use crate::geom::Point;

/// Shape of the curve of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum CurveKind {
    /// A straight line: between two edges, or between two corners.
    Line,
    /// A piece of a parabola: between an edge and a corner.
    Parabola,
    /// A line through samples.
    Polyline,
}

impl Site {
    /// The edge from `a` to `b`, interior on its left, with all place numbers 0.
    #[must_use]
    pub const fn edge(a: Point, b: Point) -> Self {
        Self { kind: SiteKind::Edge, polygon: 0, ring: 0, index: 0, part: 0, a, b }
    }

    /// The corner `p` with all place numbers 0.
    #[must_use]
    pub const fn vertex(p: Point) -> Self {
        Self { kind: SiteKind::Vertex, polygon: 0, ring: 0, index: 0, part: 0, a: p, b: p }
    }

    /// The point of the closed site nearest to `p`, rounded.
    ///
    /// ```
    /// use medial::axis::Site;
    /// use medial::geom::Point;
    /// let edge = Site::edge(Point::new(0.0, 0.0), Point::new(4.0, 0.0));
    /// assert_eq!(edge.footpoint(Point::new(1.0, 1.0)), Point::new(1.0, 0.0));
    /// assert_eq!(edge.footpoint(Point::new(9.0, 1.0)), Point::new(4.0, 0.0));
    /// ```
    #[must_use]
    pub fn footpoint(&self, p: Point) -> Point {
        let d = self.b - self.a;
        let share = d.dot(p - self.a) / d.norm2();
        // A corner has no direction: its share is NaN.
        if share.is_nan() || share <= 0.0 {
            self.a
        } else if share >= 1.0 {
            self.b
        } else {
            self.a + d * share
        }
    }
}

impl MedialAxis {
    /// The lower left and upper right corner of the box around everything the axis names:
    /// sites and keypoints. `None` for an empty axis.
    #[must_use]
    pub fn bounds(&self) -> Option<(Point, Point)> {
        let sites = self.sites().0.points().iter().copied();
        sites.chain(self.keypoints().iter().map(|k| k.position)).fold(None, |bounds, p| {
            let (low, high) = bounds.unwrap_or((p, p));
            Some((
                Point::new(low.x.min(p.x), low.y.min(p.y)),
                Point::new(high.x.max(p.x), high.y.max(p.y)),
            ))
        })
    }

    /// The number of path ends at each keypoint.
    #[must_use]
    pub fn degrees(&self) -> Vec<u32> {
        let mut degrees = vec![0; self.keypoints().len()];
        for end in self.paths().all_ends().flatten() {
            degrees[end as usize] += 1;
        }
        degrees
    }

    /// Where the maximal disk of keypoint number `keypoint` touches the boundary: one point a
    /// governor, in the order of [`governors`](Self::governors).
    ///
    /// # Panics
    /// If the axis has no such keypoint.
    pub fn footpoints(&self, keypoint: u32) -> impl Iterator<Item = Point> {
        let centre = self.keypoints().at(keypoint).position;
        self.governors(keypoint).iter().map(move |&g| self.sites().at(g).footpoint(centre))
    }

    /// The shape of a path's curve, told by its governors alone where they are exact.
    ///
    /// # Panics
    /// If `path` names a site the axis does not have.
    #[must_use]
    pub fn curve_kind(&self, path: &Path) -> CurveKind {
        if self.accuracy != Accuracy::Exact {
            return CurveKind::Polyline;
        }
        let [left, right] = self.path_governors(path);
        if left.kind == right.kind { CurveKind::Line } else { CurveKind::Parabola }
    }

    /// The two governors of a path: left and right of its direction.
    ///
    /// # Panics
    /// If `path` names a site the axis does not have.
    #[must_use]
    pub fn path_governors(&self, path: &Path) -> [Site; 2] {
        [path.left, path.right].map(|g| self.sites().at(g))
    }

    /// The greatest radius of a keypoint, and so of the whole axis; 0 for an empty axis.
    ///
    /// The radius is convex along every path, so no inner point has a greater one.
    #[must_use]
    pub fn radius_max(&self) -> f64 {
        self.keypoints().iter().map(|k| k.radius).fold(0.0, f64::max)
    }
}
