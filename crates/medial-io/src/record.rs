//! Results that are a shape with named values, in every format that holds such things.
//!
//! GeoJSON has the values as properties, CSV as columns; WKT, WKB, DXF and rings have the shapes alone.

use crate::geojson::{COMMON, SEPARATOR, beginning, number, position};
use crate::json::push_quoted;
use crate::number::push_shortest;
use crate::{Feature, Format, csv, dxf, wkb, wkt};
use medial::axis::Engine;
use medial::geom::Point;
use std::fmt::Write as _;

/// A value of a record.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value {
    /// Nothing, or what is infinite.
    None,
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(usize),
    /// Yes or no.
    Flag(bool),
    /// A word or a text.
    Text(String),
}

/// The shape of a record.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A point.
    Point(Point),
    /// A point with a third coordinate.
    PointInSpace(Point, f64),
    /// A line through these points.
    Line(Vec<Point>),
    /// A line through these points, each with a third coordinate.
    LineInSpace(Vec<(Point, f64)>),
    /// Several lines.
    Lines(Vec<Vec<Point>>),
    /// Polygons, each of rings that are not closed, the outer one first.
    Polygons(Vec<Vec<Vec<Point>>>),
}

/// One result: a value for each column, and a shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// In the order of the columns.
    pub values: Vec<Value>,
    /// What is drawn.
    pub shape: Shape,
}

impl From<f64> for Value {
    fn from(value: f64) -> Self {
        if value.is_finite() { Self::Number(value) } else { Self::None }
    }
}

impl From<usize> for Value {
    fn from(value: usize) -> Self {
        Self::Whole(value)
    }
}

impl From<u32> for Value {
    fn from(value: u32) -> Self {
        Self::Whole(value as usize)
    }
}

impl From<bool> for Value {
    fn from(value: bool) -> Self {
        Self::Flag(value)
    }
}

impl From<&str> for Value {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

/// Formats of records: lines have all but `rings`.
pub const FORMATS: [Format; 7] = [
    Format::GeoJson,
    Format::GeoJsonLines,
    Format::Csv,
    Format::Wkt,
    Format::Wkb,
    Format::Rings,
    Format::Dxf,
];

/// The names of all columns in CSV, with a line end.
#[must_use]
pub fn header(columns: &[&str]) -> String {
    let mut table = csv::Table::new();
    for name in ["WKT", "feature", "id", "engine"].iter().chain(columns) {
        table.field(|out| out.push_str(name));
    }
    table.end_row();
    table.text()
}

/// Appends records of one feature in a format, or in its [encoding](Format::encoding); GeoJSON features each behind a
/// [`SEPARATOR`]. No engine is named for what comes from none.
pub fn write(
    out: &mut Vec<u8>,
    format: Format,
    source: &Feature,
    engine: Option<Engine>,
    columns: &[&str],
    records: &[Record],
) {
    match format.encoding() {
        Format::GeoJson => geojson(out, source, engine, columns, records, [SEPARATOR, b""]),
        Format::GeoJsonLines => geojson(out, source, engine, columns, records, [b"", b"\n"]),
        Format::Csv => {
            let mut table = csv::Table::new();
            for record in records {
                table.field(|text| wkt::shape(text, &record.shape));
                table.whole(source.index);
                table.field(|text| text.push_str(&csv::id_of(source)));
                table.field(|text| text.push_str(engine.map_or("", Engine::name)));
                for value in &record.values {
                    table.field(|text| plain(text, value));
                }
                table.end_row();
            }
            out.extend_from_slice(table.text().as_bytes());
        }
        Format::Wkb => records.iter().for_each(|record| wkb::shape(out, &record.shape)),
        Format::Dxf => {
            let mut entities = dxf::Entities::default();
            entities.records(records);
            out.extend_from_slice(entities.into_text().as_bytes());
        }
        Format::Rings => records.iter().for_each(|record| rings(out, &record.shape)),
        _ => {
            let mut text = String::new();
            for record in records {
                wkt::shape(&mut text, &record.shape);
                text.push('\n');
            }
            out.extend_from_slice(text.as_bytes());
        }
    }
}

fn plain(out: &mut String, value: &Value) {
    match value {
        Value::None => {}
        Value::Number(value) => push_shortest(out, *value),
        Value::Whole(value) => {
            let _ = write!(out, "{value}");
        }
        Value::Flag(value) => out.push_str(if *value { "true" } else { "false" }),
        Value::Text(value) => out.push_str(value),
    }
}

fn geojson(
    out: &mut Vec<u8>,
    source: &Feature,
    engine: Option<Engine>,
    columns: &[&str],
    records: &[Record],
    [before, after]: [&[u8]; 2],
) {
    let is_ours = |name: &str| COMMON.contains(&name) || columns.contains(&name);
    let common = beginning(source, engine, is_ours, before);
    for record in records {
        out.extend_from_slice(&common);
        for (k, (name, value)) in columns.iter().zip(&record.values).enumerate() {
            out.extend_from_slice(if k > 0 { b"," } else { b"" });
            push_quoted(out, name);
            out.push(b':');
            match value {
                Value::None => out.extend_from_slice(b"null"),
                Value::Number(value) => number(out, *value),
                Value::Text(value) => push_quoted(out, value),
                Value::Whole(_) | Value::Flag(_) => {
                    let mut text = String::new();
                    plain(&mut text, value);
                    out.extend_from_slice(text.as_bytes());
                }
            }
        }
        out.extend_from_slice(b"},\"geometry\":");
        match &record.shape {
            Shape::Point(p) => {
                out.extend_from_slice(b"{\"type\":\"Point\",\"coordinates\":");
                position(out, *p, None);
            }
            Shape::PointInSpace(p, z) => {
                out.extend_from_slice(b"{\"type\":\"Point\",\"coordinates\":");
                position(out, *p, Some(*z));
            }
            Shape::Line(points) => {
                out.extend_from_slice(b"{\"type\":\"LineString\",\"coordinates\":");
                list(out, points, |out, &p| position(out, p, None));
            }
            Shape::LineInSpace(points) => {
                out.extend_from_slice(b"{\"type\":\"LineString\",\"coordinates\":");
                list(out, points, |out, &(p, z)| position(out, p, Some(z)));
            }
            Shape::Lines(lines) => {
                out.extend_from_slice(b"{\"type\":\"MultiLineString\",\"coordinates\":");
                list(out, lines, |out, line| list(out, line, |out, &p| position(out, p, None)));
            }
            Shape::Polygons(polygons) => match &polygons[..] {
                [polygon] => {
                    out.extend_from_slice(b"{\"type\":\"Polygon\",\"coordinates\":");
                    rings_of(out, polygon);
                }
                polygons => {
                    out.extend_from_slice(b"{\"type\":\"MultiPolygon\",\"coordinates\":");
                    list(out, polygons, |out, polygon| rings_of(out, polygon));
                }
            },
        }
        out.extend_from_slice(b"}}");
        out.extend_from_slice(after);
    }
}

/// The rings of a polygon, closed.
fn rings_of(out: &mut Vec<u8>, polygon: &[Vec<Point>]) {
    list(out, polygon, |out, ring| {
        let closed = ring.iter().chain(ring.first());
        list(out, closed, |out, &p| position(out, p, None));
    });
}

fn list<T>(out: &mut Vec<u8>, items: impl IntoIterator<Item = T>, item: impl Fn(&mut Vec<u8>, T)) {
    out.push(b'[');
    for (k, each) in items.into_iter().enumerate() {
        out.extend_from_slice(if k > 0 { b"," } else { b"" });
        item(out, each);
    }
    out.push(b']');
}

/// Polygons as bare arrays; points and lines have none.
fn rings(out: &mut Vec<u8>, shape: &Shape) {
    let Shape::Polygons(polygons) = shape else { return };
    match &polygons[..] {
        [polygon] => rings_of(out, polygon),
        polygons => list(out, polygons, |out, polygon| rings_of(out, polygon)),
    }
    out.push(b'\n');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read;

    fn polygons() -> Vec<Vec<Vec<Point>>> {
        let ring = |side: f64, at: f64| {
            let p = |x, y| Point::new(at + x * side, at + y * side);
            vec![p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)]
        };
        vec![vec![ring(9.0, 0.0), ring(1.0, 2.0)], vec![ring(0.1, 20.0)]]
    }

    fn written(format: Format, polygons: Vec<Vec<Vec<Point>>>) -> Vec<u8> {
        let source = Feature { index: 3, ..Feature::default() };
        let values = vec![Value::from(0.5), Value::from(f64::INFINITY), Value::from("a \"b\"")];
        let record = Record { values, shape: Shape::Polygons(polygons) };
        let mut out = Vec::new();
        let columns = ["share", "most", "name"];
        write(&mut out, format, &source, Some(Engine::PathTracing), &columns, &[record]);
        out
    }

    #[test]
    fn polygons_read_back_from_every_format() {
        for polygons in [polygons(), polygons()[..1].to_vec()] {
            for format in [Format::GeoJsonLines, Format::Wkt, Format::Wkb, Format::Rings] {
                let bytes = written(format, polygons.clone());
                let features: Vec<_> = read(format, &bytes).unwrap().map(Result::unwrap).collect();
                assert_eq!(features.len(), 1, "{format}");
                let mut found = features[0].polygons.clone();
                for ring in found.iter_mut().flatten() {
                    assert_eq!(ring.pop(), ring.first().copied());
                }
                assert_eq!(found, polygons, "{format}");
            }
        }
    }

    #[test]
    fn several_lines_are_one_geometry_in_every_format() {
        let p = Point::new;
        let lines =
            vec![vec![p(0.0, 0.5), p(1.0, 0.5)], vec![p(2.0, 0.0), p(2.0, 3.0), p(4.0, 3.0)]];
        let record = Record { values: Vec::new(), shape: Shape::Lines(lines) };
        let text = |format: Format| {
            let mut out = Vec::new();
            write(&mut out, format, &Feature::default(), None, &[], std::slice::from_ref(&record));
            out
        };
        let wkt = "MULTILINESTRING ((0 0.5, 1 0.5), (2 0, 2 3, 4 3))";
        assert_eq!(text(Format::Wkt), format!("{wkt}\n").into_bytes());
        let geojson = String::from_utf8(text(Format::GeoJsonLines)).unwrap();
        let coordinates = "[[[0.0,0.5],[1.0,0.5]],[[2.0,0.0],[2.0,3.0],[4.0,3.0]]]";
        assert!(
            geojson.contains(&format!("\"MultiLineString\",\"coordinates\":{coordinates}")),
            "{geojson}"
        );
        let wkb = text(Format::Wkb);
        // A head and a count, and for each line the same and its points.
        assert_eq!((wkb[1], wkb[5], wkb.len()), (5, 2, 9 + 2 * 9 + 5 * 16));
        let dxf = String::from_utf8(text(Format::Dxf)).unwrap();
        assert_eq!(dxf.matches("LWPOLYLINE").count(), 2, "{dxf}");
    }

    #[test]
    fn values_are_properties_and_columns() {
        let bytes = written(Format::GeoJsonLines, polygons());
        let text = String::from_utf8(bytes).unwrap();
        let properties =
            "\"engine\":\"path_tracing\",\"share\":0.5,\"most\":null,\"name\":\"a \\\"b\\\"\"}";
        assert!(text.contains(properties), "{text}");
        let csv = header(&["share", "most", "name"]).into_bytes();
        let csv = [csv, written(Format::Csv, polygons())].concat();
        let mut reader = ::csv::Reader::from_reader(&csv[..]);
        let row = reader.records().next().unwrap().unwrap();
        assert!(row[0].starts_with("MULTIPOLYGON (((0 0, 9 0, "), "{}", &row[0]);
        assert_eq!((&row[1], &row[4], &row[5], &row[6]), ("3", "0.5", "", "a \"b\""));
    }
}
