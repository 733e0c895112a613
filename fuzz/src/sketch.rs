//! Shapes as text, so that a find can be kept.

use super::Polygons;

/// Polygons as WKT, coordinates in full.
pub fn to_wkt(polygons: &Polygons) -> String {
    let polygon = |rings: &Vec<super::Ring>| {
        let rings: Vec<String> = rings
            .iter()
            .map(|ring| {
                let closed = ring.iter().chain(ring.first());
                let points: Vec<String> = closed.map(|p| format!("{:?} {:?}", p.x, p.y)).collect();
                format!("({})", points.join(", "))
            })
            .collect();
        format!("({})", rings.join(", "))
    };
    let all: Vec<String> = polygons.iter().map(polygon).collect();
    if let [one] = all.as_slice() {
        format!("POLYGON {one}")
    } else {
        format!("MULTIPOLYGON ({})", all.join(", "))
    }
}
