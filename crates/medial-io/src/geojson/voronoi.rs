//! Voronoi diagrams: a Polygon for each cell, a LineString for each edge.

use super::write::{COMMON, SEPARATOR, beginning, number, position};
use crate::Feature;
use crate::path::domain_tolerance;
use medial::geom::Point;
use medial::ops::{Cell, Voronoi, VoronoiEdge};
use std::io::Write as _;

/// The properties of cells and edges besides.
const OURS: [&str; 15] = [
    "kind",
    "side",
    "site",
    "site_kind",
    "polygon",
    "ring",
    "index",
    "part",
    "edge",
    "curve",
    "length",
    "radius_start",
    "radius_end",
    "governor_left",
    "governor_right",
];

/// Appends the features of one diagram, each behind a [`SEPARATOR`]: cells, then edges. Curves are drawn
/// within `tolerance`, by default 1e-4 of the longer side of the feature's box.
pub fn voronoi_features(
    out: &mut Vec<u8>,
    source: &Feature,
    voronoi: &Voronoi,
    tolerance: Option<f64>,
) {
    write(out, source, voronoi, tolerance, [SEPARATOR, b""]);
}

/// Appends the same features, each on a line of its own.
pub fn voronoi_lines(
    out: &mut Vec<u8>,
    source: &Feature,
    voronoi: &Voronoi,
    tolerance: Option<f64>,
) {
    write(out, source, voronoi, tolerance, [b"", b"\n"]);
}

/// Writes each feature between two texts.
fn write(
    out: &mut Vec<u8>,
    source: &Feature,
    voronoi: &Voronoi,
    tolerance: Option<f64>,
    [before, after]: [&[u8]; 2],
) {
    let Some(engine) = voronoi.axes().next().map(|axis| axis.engine) else { return };
    let ours = |name: &str| COMMON.contains(&name) || OURS.contains(&name);
    let common = beginning(source, Some(engine), ours, before);
    let tolerance = tolerance.unwrap_or_else(|| domain_tolerance(voronoi.domain()));
    for cell in voronoi.cells() {
        out.extend_from_slice(&common);
        cell_properties(out, voronoi, &cell);
        out.extend_from_slice(b"},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[");
        let ring = voronoi.ring(&cell, tolerance);
        positions(out, ring.iter().chain(ring.first()).copied());
        out.extend_from_slice(b"]]}}");
        out.extend_from_slice(after);
    }
    for (k, edge) in voronoi.edges().iter().enumerate() {
        out.extend_from_slice(&common);
        edge_properties(out, voronoi, k, edge);
        out.extend_from_slice(b"},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[");
        let drawn = voronoi.curve(edge).polyline(tolerance);
        positions(out, drawn.into_iter().map(|(point, _)| point));
        out.extend_from_slice(b"]}}");
        out.extend_from_slice(after);
    }
}

fn cell_properties(out: &mut Vec<u8>, voronoi: &Voronoi, cell: &Cell) {
    let site = &voronoi.sites()[cell.site as usize];
    // Memory takes all that is written.
    let _ = write!(
        out,
        "\"kind\":\"cell\",\"side\":\"{}\",\"site\":{},\"site_kind\":\"{}\",\"polygon\":{},\
         \"ring\":{},\"index\":{},\"part\":{}",
        cell.side, cell.site, site.kind, site.polygon, site.ring, site.index, site.part
    );
}

fn edge_properties(out: &mut Vec<u8>, voronoi: &Voronoi, k: usize, edge: &VoronoiEdge) {
    let curve = voronoi.curve(edge);
    let _ = write!(
        out,
        "\"kind\":\"{}\",\"side\":\"{}\",\"edge\":{k},\"curve\":\"{}\",\"length\":",
        edge.kind.name(),
        edge.side,
        curve.kind()
    );
    number(out, curve.length());
    out.extend_from_slice(b",\"radius_start\":");
    number(out, curve.radius_from());
    out.extend_from_slice(b",\"radius_end\":");
    number(out, curve.radius_to());
    let _ = write!(out, ",\"governor_left\":{},\"governor_right\":", edge.left);
    match edge.right {
        Some(right) => drop(write!(out, "{right}")),
        None => out.extend_from_slice(b"null"),
    }
}

fn positions(out: &mut Vec<u8>, points: impl Iterator<Item = Point>) {
    for (k, point) in points.enumerate() {
        if k > 0 {
            out.push(b',');
        }
        position(out, point, None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;
    use serde_json::{Value, json};

    fn written(rings: &[Vec<Point>], tolerance: f64) -> Vec<Value> {
        let text = samples::with_voronoi(rings, |voronoi| {
            let mut out = Vec::new();
            voronoi_lines(&mut out, &Feature::default(), voronoi, Some(tolerance));
            String::from_utf8(out).unwrap()
        });
        text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }

    #[test]
    fn cells_come_before_edges() {
        let found = written(&samples::square_rings(), 1.0);
        let kinds: Vec<&str> =
            found.iter().map(|f| f["properties"]["kind"].as_str().unwrap()).collect();
        assert_eq!(kinds, ["cell", "cell", "cell", "cell", "path", "path", "path", "path"]);
        let floor = json!([[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [0.0, 0.0]]]);
        assert_eq!(found[0]["geometry"], json!({"type": "Polygon", "coordinates": floor}));
        assert_eq!(
            found[0]["properties"],
            json!({"feature": 0, "source_id": null, "engine": "path_tracing", "kind": "cell",
                   "side": "interior", "site": 0, "site_kind": "edge", "polygon": 0, "ring": 0,
                   "index": 0, "part": 0})
        );
    }

    #[test]
    fn normals_have_their_own_kind() {
        let found = written(&samples::l_rings(), 0.01);
        let normals = found.iter().filter(|f| f["properties"]["kind"] == "normal");
        let mut lines: Vec<Value> = normals.map(|f| f["geometry"]["coordinates"].clone()).collect();
        lines.sort_by_key(Value::to_string);
        assert_eq!(lines, [json!([[1.0, 1.0], [0.5, 1.0]]), json!([[1.0, 1.0], [1.0, 0.5]])]);
    }

    #[test]
    fn both_cells_of_a_curve_have_its_points() {
        let found = written(&samples::l_rings(), 1e-3);
        let mut n_inner = 0;
        for edge in found.iter().filter(|f| f["properties"]["curve"] == "parabola") {
            let line = edge["geometry"]["coordinates"].as_array().unwrap();
            for point in &line[1..line.len() - 1] {
                let holds = |f: &&Value| {
                    let rings = &f["geometry"]["coordinates"][0];
                    f["properties"]["kind"] == "cell" && rings.as_array().unwrap().contains(point)
                };
                assert_eq!(found.iter().filter(holds).count(), 2);
                n_inner += 1;
            }
        }
        assert!(n_inner > 4);
    }

    #[test]
    fn properties_of_the_source_are_kept() {
        let value = serde_json::value::RawValue::from_string("7".to_owned()).unwrap();
        let properties = vec![("site".to_owned(), value.clone()), ("name".to_owned(), value)];
        let source = Feature { properties, ..Feature::default() };
        let text = samples::with_voronoi(&samples::square_rings(), |voronoi| {
            let mut out = Vec::new();
            voronoi_features(&mut out, &source, voronoi, None);
            String::from_utf8(out).unwrap()
        });
        assert!(
            text.starts_with(
                ",\n{\"type\":\"Feature\",\"properties\":{\"source_site\":7,\"name\":7,"
            )
        );
    }
}
