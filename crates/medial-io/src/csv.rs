//! Comma-separated values: a row a path or a centerline, the drawn line as WKT in the first column as
//! GDAL writes and reads it.

use crate::number::push_shortest;
use crate::path::{PathRecord, measure_columns, records};
use crate::wkt::drawn_line;
use crate::{Drawing, Feature};
use medial::axis::{Engine, MedialAxis};
use medial::geom::Point;
use medial::ops::{Centerline, Measure, Significance, Widths};
use std::fmt::{Display, Write as _};

const PLACE: [&str; 10] =
    ["WKT", "feature", "id", "path", "from", "to", "x_start", "y_start", "x_end", "y_end"];

/// The row of column names, with those of measures.
#[must_use]
pub fn header(measures: &[Measure], drawing: Drawing) -> String {
    let mut table = Table::new();
    let side = drawing.side.then_some("side");
    for name in PLACE.into_iter().chain(["engine"]).chain(side).chain(PathRecord::COLUMNS) {
        table.field(|out| out.push_str(name));
    }
    for &measure in measures {
        let measured = Significance { measure, paths: Vec::new() };
        measure_columns(&measured).iter().for_each(|name| table.field(|out| out.push_str(name)));
    }
    table.end_row();
    table.text()
}

/// The rows of one axis, with the values that were measured.
#[must_use]
pub fn rows(
    source: &Feature,
    axis: &MedialAxis,
    measured: &[Significance],
    drawing: Drawing,
) -> String {
    let tolerance = drawing.tolerance(axis);
    let id = id_of(source);
    let mut table = Table::new();
    for (k, record) in records(axis, drawing).enumerate() {
        let (path, [first, last]) = (record.path, record.ends);
        let line = record.points(drawing, tolerance);
        table.field(|out| drawn_line(out, &line, drawing.radius_as_z));
        table.whole(source.index);
        table.field(|out| out.push_str(&id));
        table.whole(k);
        table.whole(path.from);
        table.whole(path.to);
        let (from, to) = (first.position, last.position);
        [from.x, from.y, to.x, to.y].into_iter().for_each(|value| table.number(value));
        table.field(|out| out.push_str(axis.engine.name()));
        if drawing.side {
            table.field(|out| out.push_str(axis.side.name()));
        }
        table.field(|out| out.push_str(record.kind.name()));
        table.number(record.length());
        table.number(record.radius_min());
        table.number(record.radius_max());
        table.number(first.radius);
        table.number(last.radius);
        [first, last].into_iter().for_each(|end| table.field(|out| out.push_str(end.kind.name())));
        for site in record.governors() {
            match site {
                Some(site) => table.whole(site),
                None => table.field(|_| ()),
            }
        }
        for value in measured.iter().flat_map(|measured| record.values(measured)) {
            table.field(|out| value.into_iter().for_each(|value| push_shortest(out, value)));
        }
        table.end_row();
    }
    table.text()
}

const NODE: [&str; 10] =
    ["WKT", "feature", "id", "keypoint", "x", "y", "radius", "kind", "degree", "side"];

/// The row of column names of keypoints, the nodes of the graph whose edges are the paths.
#[must_use]
pub fn node_header() -> String {
    let mut table = Table::new();
    NODE.into_iter().for_each(|name| table.field(|out| out.push_str(name)));
    table.end_row();
    table.text()
}

/// The rows of the keypoints of one axis, with the numbers that rows of paths have in `from` and `to`.
#[must_use]
pub fn node_rows(source: &Feature, axis: &MedialAxis) -> String {
    let id = id_of(source);
    let mut table = Table::new();
    for ((k, keypoint), degree) in axis.keypoints().iter().enumerate().zip(axis.degrees()) {
        let Point { x, y } = keypoint.position;
        table.field(|out| {
            out.push_str("POINT (");
            push_shortest(out, x);
            out.push(' ');
            push_shortest(out, y);
            out.push(')');
        });
        table.whole(source.index);
        table.field(|out| out.push_str(&id));
        table.whole(k);
        [x, y, keypoint.radius].into_iter().for_each(|value| table.number(value));
        table.field(|out| out.push_str(keypoint.kind.name()));
        table.whole(degree);
        table.field(|out| out.push_str(axis.side.name()));
        table.end_row();
    }
    table.text()
}

const CENTERLINE: [&str; 11] = [
    "WKT",
    "feature",
    "id",
    "engine",
    "rank",
    "length",
    "width_min",
    "width_max",
    "width_mean",
    "closed",
    "is_best",
];

/// The row of column names of centerlines.
#[must_use]
pub fn centerline_header() -> String {
    let mut table = Table::new();
    CENTERLINE.into_iter().for_each(|name| table.field(|out| out.push_str(name)));
    table.end_row();
    table.text()
}

/// The rows of the centerlines of one feature, as [`polylines`](medial::ops::polylines) has drawn them; with
/// the distance of the boundary as third coordinate if asked for.
#[must_use]
pub fn centerline_rows(
    source: &Feature,
    engine: Engine,
    lines: &[Centerline],
    drawn: &[Vec<(Point, f64)>],
    radius_as_z: bool,
) -> String {
    let id = id_of(source);
    let mut table = Table::new();
    for ((rank, line), points) in (1_usize..).zip(lines).zip(drawn) {
        table.field(|out| drawn_line(out, points, radius_as_z));
        table.whole(source.index);
        table.field(|out| out.push_str(&id));
        table.field(|out| out.push_str(engine.name()));
        table.whole(rank);
        let Widths { least, greatest, mean } = line.widths();
        [line.length(), least, greatest, mean].into_iter().for_each(|value| table.number(value));
        table.whole(line.is_closed());
        table.whole(line.is_best);
        table.end_row();
    }
    table.text()
}

/// The name of a feature. A text is written without the quotes JSON puts around it.
pub(crate) fn id_of(source: &Feature) -> String {
    let id = source.id.as_ref().map_or("", |id| id.get());
    serde_json::from_str::<String>(id).unwrap_or_else(|_| id.to_owned())
}

/// A table that is being written.
pub(crate) struct Table {
    writer: ::csv::Writer<Vec<u8>>,
    /// The field being written.
    field: String,
}

impl Table {
    pub fn new() -> Self {
        Self { writer: ::csv::Writer::from_writer(Vec::new()), field: String::new() }
    }

    pub fn field(&mut self, write: impl FnOnce(&mut String)) {
        self.field.clear();
        write(&mut self.field);
        // Writing to memory does not fail.
        let _ = self.writer.write_field(&self.field);
    }

    fn number(&mut self, value: f64) {
        self.field(|out| push_shortest(out, value));
    }

    pub fn whole(&mut self, value: impl Display) {
        self.field(|out| {
            let _ = write!(out, "{value}");
        });
    }

    pub fn end_row(&mut self) {
        // Rows of unequal length fail; all have as many fields.
        let _ = self.writer.write_record(None::<&[u8]>);
    }

    pub fn text(self) -> String {
        let bytes = self.writer.into_inner().ok();
        bytes.and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn rows_have_as_many_fields_as_the_header() {
        let id = serde_json::value::RawValue::from_string("\"a, \\\"b\\\"\"".to_owned()).ok();
        let source = Feature { index: 7, id, ..Feature::default() };
        let text = header(&[], Drawing::default())
            + &rows(&source, &samples::rectangle(), &[], Drawing::default());
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        let names = reader.headers().unwrap().clone();
        let records: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(records.len(), 5);
        let field = |row: usize, name: &str| {
            records[row][names.iter().position(|n| n == name).unwrap()].to_owned()
        };
        assert_eq!(field(2, "WKT"), "LINESTRING (1 1, 3 1)");
        assert_eq!(field(2, "feature"), "7");
        assert_eq!(field(2, "id"), "a, \"b\"");
        assert_eq!(field(2, "path"), "2");
        assert_eq!((field(2, "from"), field(2, "to")), ("4".to_owned(), "5".to_owned()));
        assert_eq!(field(2, "length"), "2");
        assert_eq!(field(0, "kind_start"), "end");
        assert_eq!(field(0, "governor_left"), "3");
    }
}
