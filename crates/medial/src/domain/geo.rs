//! Conversions from and to `geo-types`.

use geo_types::{Coord, LineString, MultiPolygon, Polygon};

use super::area::orientation;
use super::{Domain, DomainError, Options};
use crate::geom::{Point, parted};

impl From<Coord<f64>> for Point {
    fn from(c: Coord<f64>) -> Self {
        Self::new(c.x, c.y)
    }
}

impl From<Point> for Coord<f64> {
    fn from(p: Point) -> Self {
        Self { x: p.x, y: p.y }
    }
}

impl Domain {
    /// Validates the polygons of a feature; see [`Domain::from_polygons`].
    ///
    /// # Errors
    /// [`DomainError`] says where and why the polygons do not bound a domain.
    pub fn from_multi_polygon(
        polygons: &MultiPolygon<f64>,
        options: &Options,
    ) -> Result<Self, DomainError> {
        let polygons: Vec<_> = polygons.iter().map(rings).collect();
        Self::from_polygons(&polygons, options)
    }
}

impl TryFrom<&Polygon<f64>> for Domain {
    type Error = DomainError;

    fn try_from(polygon: &Polygon<f64>) -> Result<Self, DomainError> {
        Self::from_polygons(&[rings(polygon)], &Options::default())
    }
}

impl TryFrom<&MultiPolygon<f64>> for Domain {
    type Error = DomainError;

    fn try_from(polygons: &MultiPolygon<f64>) -> Result<Self, DomainError> {
        Self::from_multi_polygon(polygons, &Options::default())
    }
}

/// One polygon for each connected component of the interior, with rings that are simple: walks are
/// cut where they pass a point twice.
impl From<&Domain> for MultiPolygon<f64> {
    fn from(domain: &Domain) -> Self {
        let mut outers = vec![None; domain.n_components()];
        let mut inners = vec![Vec::new(); domain.n_components()];
        for walk in domain.walks() {
            let component = walk.component as usize;
            let edges = &domain.edges()[walk.first as usize..(walk.first + walk.len) as usize];
            for ring in parted(edges.iter().map(|e| e.start).collect()) {
                let line = LineString::from_iter(ring.iter().map(|&p| Coord::from(p)));
                // A component has one outer ring, and all others run clockwise.
                if outers[component].is_none() && orientation(&ring).is_gt() {
                    outers[component] = Some(line);
                } else {
                    inners[component].push(line);
                }
            }
        }
        let whole = outers.into_iter().zip(inners);
        whole.filter_map(|(outer, holes)| Some(Polygon::new(outer?, holes))).collect()
    }
}

fn rings(polygon: &Polygon<f64>) -> Vec<Vec<Point>> {
    let ring = |line: &LineString<f64>| line.coords().map(|&c| Point::from(c)).collect();
    std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(ring).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use geo_types::polygon;

    #[test]
    fn a_square_with_a_hole_comes_back_ring_by_ring() {
        let square = polygon!(
            exterior: [(x: 0., y: 0.), (x: 4., y: 0.), (x: 4., y: 4.), (x: 0., y: 4.)],
            interiors: [[(x: 1., y: 1.), (x: 1., y: 2.), (x: 2., y: 1.)]],
        );
        let domain = Domain::try_from(&square).expect("valid");
        assert_eq!(MultiPolygon::from(&domain), MultiPolygon::new(vec![square]));
    }

    #[test]
    fn a_hole_that_touches_comes_back_as_a_hole() {
        let touching = polygon!(
            exterior: [(x: 0., y: 0.), (x: 4., y: 0.), (x: 4., y: 4.), (x: 0., y: 4.)],
            interiors: [[(x: 0., y: 0.), (x: 1., y: 2.), (x: 2., y: 1.)]],
        );
        let domain = Domain::try_from(&touching).expect("valid");
        assert_eq!(domain.walks().len(), 1);
        let back = MultiPolygon::from(&domain);
        assert_eq!(back.0[0].interiors().len(), 1);
        assert_eq!(back.0[0].exterior().coords().count(), 5);
        let again = Domain::try_from(&back).expect("valid");
        assert_eq!(again.area(), domain.area());
    }

    #[test]
    fn each_component_gets_its_own_holes() {
        // Two squares that touch at (4, 4), each with a hole, as one ring.
        let both = polygon!(
            exterior: [
                (x: 0., y: 0.), (x: 4., y: 0.), (x: 4., y: 4.), (x: 8., y: 4.),
                (x: 8., y: 8.), (x: 4., y: 8.), (x: 4., y: 4.), (x: 0., y: 4.),
            ],
            interiors: [
                [(x: 5., y: 5.), (x: 5., y: 6.), (x: 6., y: 5.)],
                [(x: 1., y: 1.), (x: 1., y: 2.), (x: 2., y: 1.)],
            ],
        );
        let domain = Domain::try_from(&both).expect("valid");
        let back = MultiPolygon::from(&domain);
        assert_eq!(back.0.len(), 2);
        for (polygon, x) in back.iter().zip([1.0, 5.0]) {
            assert_eq!(polygon.interiors().len(), 1);
            assert_eq!(polygon.interiors()[0].0[0].x, x);
        }
    }

    #[test]
    fn an_empty_polygon_is_refused_as_empty() {
        let empty = Polygon::new(LineString::new(Vec::new()), Vec::new());
        assert_eq!(Domain::try_from(&empty).map_err(|e| e.code()).err(), Some("empty"));
    }
}
