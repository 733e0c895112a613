use super::{Domain, DomainError, Origin, Place, Repair, Report};
use crate::domain::CornerOrigin;
use crate::geom::Point;

/// How to treat input that is not valid as it stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Refuse what would change the point set or its topology: OGC Simple Features 6.1.11.
    pub strict: bool,
    /// Find out which rings are holes by their depth (even-odd), whatever their place.
    pub regroup: bool,
}

impl Domain {
    /// Validates polygons, each a list of rings, the first of them the outer one.
    ///
    /// The rings need not be closed, and may run either way round.
    ///
    /// # Errors
    /// [`DomainError`] says where and why the polygons do not bound a domain.
    pub fn from_polygons(
        polygons: &[Vec<Vec<Point>>],
        _options: &Options,
    ) -> Result<Self, DomainError> {
        let lone = polygons.len() == 1;
        let mut report = Report::default();
        let mut walks = Vec::new();
        for (polygon, rings) in polygons.iter().enumerate() {
            for (ring, points) in rings.iter().enumerate() {
                let (polygon, ring) = (polygon as u32, ring as u32);
                let place = |index: usize| Place { polygon, ring, index: index as u32, lone };
                let mut kept: Vec<(u32, Point)> = Vec::with_capacity(points.len());
                for (k, &p) in points.iter().enumerate() {
                    if !(p.x.is_finite() && p.y.is_finite()) {
                        return Err(DomainError::NotFinite { at: place(k), x: p.x, y: p.y });
                    }
                    if kept.last().is_none_or(|l| l.1 != p) {
                        kept.push((k as u32, p));
                    }
                }
                while kept.len() > 1 && kept[0].1 == kept[kept.len() - 1].1 {
                    kept.pop();
                }
                let n = kept.len();
                if n < 3 {
                    return Err(DomainError::TooFewPoints { at: place(0), found: n as u32 });
                }
                let o = kept[0].1;
                let area: f64 =
                    (0..n).map(|k| (kept[k].1 - o).cross(kept[(k + 1) % n].1 - o)).sum();
                let reversed = (area < 0.0) == (ring == 0);
                if reversed {
                    kept.reverse();
                    report.push(Repair::Reversed, polygon, ring, Vec::new());
                }
                let walk = (0..n).map(|k| {
                    let (index, start) = kept[k];
                    let edge = if reversed { kept[(k + 1) % n].0 } else { index };
                    let corner = CornerOrigin { ring, index, part: 0 };
                    (start, Origin { polygon, ring, index: edge, part: 0, corner })
                });
                walks.push(walk.collect());
            }
        }
        Ok(Self::from_walks(&walks, report))
    }
}
