//! Comma-separated values: a row a path, the drawn line as WKT in the first column as GDAL
//! writes and reads it.

use crate::number::shortest;
use crate::path::{PathRecord, records};
use crate::wkt::line_string;
use crate::{Drawing, Feature};
use medial::axis::MedialAxis;

const PLACE: [&str; 10] =
    ["WKT", "feature", "id", "path", "from", "to", "x_start", "y_start", "x_end", "y_end"];

/// The row of column names.
#[must_use]
pub fn header() -> String {
    let names = PLACE.into_iter().chain(["engine"]).chain(PathRecord::COLUMNS);
    table([names.map(str::to_owned).collect()])
}

/// The rows of one axis.
#[must_use]
pub fn rows(source: &Feature, axis: &MedialAxis, drawing: Drawing) -> String {
    let tolerance = drawing.tolerance(axis);
    let id = source.id.as_ref().map_or("", |id| id.get());
    // A text is written without the quotes JSON puts around it.
    let id = serde_json::from_str::<String>(id).unwrap_or_else(|_| id.to_owned());
    table(records(axis).enumerate().map(|(k, record)| {
        let PathRecord { path, curve, ends } = record;
        let mut row = vec![
            line_string(&curve, drawing, tolerance),
            source.index.to_string(),
            id.clone(),
            k.to_string(),
            path.from.to_string(),
            path.to.to_string(),
        ];
        let (from, to) = (curve.from(), curve.to());
        row.extend([from.x, from.y, to.x, to.y].map(shortest));
        row.extend([axis.engine.to_string(), curve.kind().to_string()]);
        row.extend(
            [
                curve.length(),
                curve.radius_min(),
                curve.radius_max(),
                curve.radius_from(),
                curve.radius_to(),
            ]
            .map(shortest),
        );
        row.extend(ends.map(|k| k.kind.to_string()));
        row.extend([path.left, path.right].map(|g| g.to_string()));
        row
    }))
}

fn table(rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    for row in rows {
        // Writing to memory fails on rows of unequal length only, and all have as many columns.
        if writer.write_record(&row).is_err() {
            break;
        }
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn rows_have_as_many_fields_as_the_header() {
        let id = serde_json::value::RawValue::from_string("\"a, \\\"b\\\"\"".to_owned()).ok();
        let source = Feature { index: 7, id, ..Feature::default() };
        let text = header() + &rows(&source, &samples::rectangle(), Drawing::default());
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
