use super::write::{count, head, point};
use medial::geom::Point;

const POLYGON: u32 = 3;
const MULTI_POLYGON: u32 = 6;

/// Polygons as one POLYGON, or as a MULTIPOLYGON if they are not just one, little-endian. Rings are
/// closed where they are not; an empty ring stays empty.
#[must_use]
pub fn write_polygons(polygons: &[Vec<Vec<Point>>]) -> Vec<u8> {
    let mut out = Vec::new();
    if polygons.len() != 1 {
        head(&mut out, MULTI_POLYGON);
        count(&mut out, polygons.len());
    }
    for polygon in polygons {
        head(&mut out, POLYGON);
        count(&mut out, polygon.len());
        for ring in polygon {
            let closing =
                ring.first().filter(|first| ring.len() == 1 || ring.last() != Some(first));
            count(&mut out, ring.len() + usize::from(closing.is_some()));
            ring.iter().chain(closing).for_each(|&p| point(&mut out, p, None));
        }
    }
    out
}
