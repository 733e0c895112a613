//! Affine maps.

use super::Contour;
use medial::geom::Point;

/// The map `(a x + c y + e, b x + d y + f)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub d: f64,
    pub e: f64,
    pub f: f64,
}

impl Affine {
    pub const IDENTITY: Self = Self { a: 1.0, b: 0.0, c: 0.0, d: 1.0, e: 0.0, f: 0.0 };

    /// Turns y round: it points down in SVG, and up in everything else here.
    pub const FLIP: Self = Self { d: -1.0, ..Self::IDENTITY };

    pub fn translation(x: f64, y: f64) -> Self {
        Self { e: x, f: y, ..Self::IDENTITY }
    }

    pub fn scaling(x: f64, y: f64) -> Self {
        Self { a: x, d: y, ..Self::IDENTITY }
    }

    /// The map that does `first`, then this one.
    pub fn after(&self, first: &Self) -> Self {
        let x = self.linear(Point::new(first.a, first.b));
        let y = self.linear(Point::new(first.c, first.d));
        let origin = self.point(Point::new(first.e, first.f));
        Self { a: x.x, b: x.y, c: y.x, d: y.y, e: origin.x, f: origin.y }
    }

    pub fn point(&self, p: Point) -> Point {
        Point::new(self.a * p.x + self.c * p.y + self.e, self.b * p.x + self.d * p.y + self.f)
    }

    /// A difference of points.
    pub fn linear(&self, p: Point) -> Point {
        Point::new(self.a * p.x + self.c * p.y, self.b * p.x + self.d * p.y)
    }

    pub fn contour(&self, contour: &Contour) -> Contour {
        contour.map(|p| self.point(p), |p| self.linear(p))
    }

    /// By how much areas grow.
    pub fn determinant(&self) -> f64 {
        self.a * self.d - self.b * self.c
    }

    pub fn inverse(&self) -> Option<Self> {
        let d = self.determinant();
        let linear =
            Self { a: self.d / d, b: -self.b / d, c: -self.c / d, d: self.a / d, e: 0.0, f: 0.0 };
        let origin = linear.linear(Point::new(-self.e, -self.f));
        let inverse = Self { e: origin.x, f: origin.y, ..linear };
        inverse.is_finite().then_some(inverse)
    }

    pub fn is_finite(&self) -> bool {
        [self.a, self.b, self.c, self.d, self.e, self.f].iter().all(|v| v.is_finite())
    }
}
