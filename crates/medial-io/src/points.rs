//! Points without any order, as comma-separated values, WKT or GeoJSON: one feature, the border that they lie on.
//!
//! # Contract
//! Of WKT and GeoJSON all points are taken together, if there is nothing else; among other geometries points are
//! features of their own, and no polygons. If one is malformed, that is told, and there is no border.
//!
//! Of comma-separated values a row is a point. Coordinates are in the columns `x` and `y`, `lon` and `lat`, or `longitude` and `latitude` of the
//! first row, in any letter case; without such names, the first two columns. Commas, semicolons, tabs and blanks
//! separate values, whichever the first row has.
//!
//! The polygons are the closed rings of the [crust](medial::engine::border), as one polygon, so that which are holes is
//! told by nesting; how many points lie on none of them, and how many are given once more, is noted.

use crate::feature::Note;
use crate::{Error, Feature, FeatureError, Layer, Part};
use medial::engine::{Border, border};
use medial::geom::Point;
use std::collections::{HashSet, VecDeque};

/// Reads the border of the points in a text of comma-separated values.
///
/// # Errors
/// If there are no rows, or a row has no two finite numbers where coordinates are.
pub fn read(text: &str) -> Result<Layer<'_>, Error> {
    let feature = on_border(Feature::numbered(0), points(text)?);
    Ok(Layer { len: Some(1), ..Layer::new(std::iter::once(Ok(feature))) })
}

/// The feature of the border that points lie on.
fn on_border(mut feature: Feature, mut points: Vec<Point>) -> Feature {
    let n_given = points.len();
    let mut seen = HashSet::with_capacity(n_given);
    // Both zeros are one number.
    points.retain(|p| seen.insert([p.x, p.y].map(|v| (v + 0.0).to_bits())));
    let n_repeats = n_given - points.len();
    let Border { rings, left_out } = border(&points);
    let are = |n: usize, one: &str, more: &str| match n {
        1 => format!("1 point {one}"),
        n => format!("{n} points {more}"),
    };
    let without = "without a closed border";
    feature.geometry = are(n_given, without, without);
    if n_repeats > 0 {
        let text = are(
            n_repeats,
            "is given once more and taken once",
            "are given once more and taken once",
        );
        feature.notes.push(Note { code: "duplicate_point", text });
    }
    if !rings.is_empty() {
        if !left_out.is_empty() {
            let text = are(
                left_out.len(),
                "lies on no closed border and is left out",
                "lie on no closed border and are left out",
            );
            feature.notes.push(Note { code: "point_left_out", text });
        }
        feature.add_polygon(rings);
    }
    feature
}

/// The layer, or the border that its points lie on if it has nothing else.
pub(crate) fn gathered(layer: Layer<'_>) -> Layer<'_> {
    let Layer { crs, units, len, warnings, parts } = layer;
    let parts = Box::new(Gathering { parts, read: VecDeque::new(), is_open: true });
    Layer { crs, units, len, warnings, parts }
}

/// Features that are read on until one is no point, or there are no more.
struct Gathering<'a> {
    parts: Box<dyn Iterator<Item = Part<'a>> + Send + 'a>,
    /// What was read and not given yet.
    read: VecDeque<Result<Feature, FeatureError>>,
    /// Whether all that was read is points or malformed.
    is_open: bool,
}

impl<'a> Iterator for Gathering<'a> {
    type Item = Part<'a>;

    fn next(&mut self) -> Option<Part<'a>> {
        while self.is_open {
            let read = self.parts.next().map(Part::read);
            self.is_open = match &read {
                Some(Ok(feature)) => feature.points.is_some(),
                Some(Err(_)) => true,
                None => false,
            };
            match read {
                Some(read) => self.read.push_back(read),
                None => self.read = border_of(std::mem::take(&mut self.read)),
            }
        }
        self.read.pop_front().map(Part::of_read).or_else(|| self.parts.next())
    }
}

/// The border of all points, or what is malformed among them.
fn border_of(
    read: VecDeque<Result<Feature, FeatureError>>,
) -> VecDeque<Result<Feature, FeatureError>> {
    if read.iter().any(Result::is_err) {
        return read.into_iter().filter(Result::is_err).collect();
    }
    let mut features = read.into_iter().flatten();
    let Some(mut first) = features.next() else { return VecDeque::new() };
    let mut all = first.points.take().unwrap_or_default();
    let mut is_alone = true;
    for feature in features {
        all.extend(feature.points.unwrap_or_default());
        is_alone = false;
    }
    // One feature of many points keeps what is known of it; of many features it is nothing that they share.
    let feature = if is_alone { first } else { Feature::numbered(0) };
    VecDeque::from([Ok(on_border(feature, all))])
}

fn points(text: &str) -> Result<Vec<Point>, Error> {
    let first = text.lines().find(|line| !line.trim().is_empty()).ok_or(Error::Empty)?;
    let separator = [',', ';', '\t'].into_iter().find(|&mark| first.contains(mark));
    let values = |line: &str| -> Vec<String> {
        let values: Vec<&str> = match separator {
            Some(mark) => line.split(mark).collect(),
            None => line.split_whitespace().collect(),
        };
        values.into_iter().map(|value| value.trim().trim_matches('"').to_owned()).collect()
    };
    let head = values(first);
    let named = |names: [&str; 3]| {
        head.iter().position(|value| names.contains(&value.to_lowercase().as_str()))
    };
    let columns = [named(["x", "lon", "longitude"]), named(["y", "lat", "latitude"])];
    let is_head = head.iter().any(|value| value.parse::<f64>().is_err());
    let [x, y] = match columns {
        [Some(x), Some(y)] => [x, y],
        _ => [0, 1],
    };
    let mut points = Vec::new();
    let lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
    for (line, row) in lines.skip(usize::from(is_head)) {
        let values = values(row);
        let number = |column: usize| {
            let value = values.get(column).and_then(|value| value.parse::<f64>().ok());
            value.filter(|value| value.is_finite()).ok_or_else(|| Error::Syntax {
                line,
                column: 1,
                why: format!(
                    "value {} is no finite number; a row has the coordinates x and y",
                    column + 1
                ),
            })
        };
        points.push(Point::new(number(x)?, number(y)?));
    }
    if points.is_empty() { Err(Error::Empty) } else { Ok(points) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Format;

    /// Points of a circle, every third one first.
    fn circle(head: &str, separator: char) -> String {
        let rows = (0..60).map(|k| 3 * k % 60 + k / 20).map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 60.0).sin_cos();
            format!("{k}{separator}{}{separator}{}\n", 2.0 * cos, 2.0 * sin)
        });
        std::iter::once(head.to_owned()).chain(rows).collect()
    }

    fn feature(text: &str) -> Feature {
        read(text).unwrap().next().unwrap().unwrap()
    }

    #[test]
    fn a_circle_is_found_in_any_order_and_with_any_separator() {
        for text in [
            circle("name,x,y\n", ','),
            circle("n;LON;LAT\n", ';'),
            circle("id\tlongitude\tlatitude\n", '\t'),
        ] {
            let read = feature(&text);
            assert_eq!((read.polygons.len(), read.polygons[0].len()), (1, 1));
            assert_eq!(read.polygons[0][0].len(), 60);
            assert!(read.polygons[0][0].iter().all(|p| (p.norm() - 2.0).abs() < 1e-12));
            assert!(read.notes.is_empty());
        }
    }

    #[test]
    fn points_that_lie_on_no_ring_are_noted() {
        let text = circle("name,x,y\n", ',') + "far,50,1\n\n";
        let read = feature(&text);
        assert_eq!(read.polygons[0][0].len(), 60);
        assert_eq!(read.notes[0].code, "point_left_out");
        // What is given once more is no other point.
        let rows = circle("name,x,y\n", ',');
        let twice = feature(&(rows.clone() + rows.split_once('\n').unwrap().1 + "far,50,1\n"));
        assert_eq!(twice.polygons, read.polygons);
        let notes: Vec<_> = twice.notes.iter().map(|n| (n.code, n.text.as_str())).collect();
        assert_eq!(
            notes,
            [
                ("duplicate_point", "60 points are given once more and taken once"),
                ("point_left_out", "1 point lies on no closed border and is left out"),
            ]
        );
        let line = feature("0 0\n1 1\n2 2\n");
        assert!(!line.polygonal && line.geometry == "3 points without a closed border");
    }

    #[test]
    fn a_row_without_numbers_is_told_with_its_line() {
        let error = read("x,y\n1,2\n3,four\n").err().unwrap();
        assert_eq!(
            error.to_string(),
            "line 3, column 1: value 2 is no finite number; a row has the coordinates x and y"
        );
        assert!(matches!(read(" \n"), Err(Error::Empty)));
        assert!(matches!(read("x,y\n"), Err(Error::Empty)));
    }

    /// The same points as geometries.
    fn as_wkt(points: &[Point]) -> String {
        points.iter().map(|p| format!("POINT ({} {})\n", p.x, p.y)).collect()
    }

    fn all(format: Format, text: &str) -> Vec<Result<Feature, FeatureError>> {
        let whole: Vec<_> = crate::read(format, text.as_bytes()).unwrap().collect();
        if format != Format::GeoJson {
            let streamed = crate::read_stream(format, text.as_bytes()).unwrap();
            let told = |read: &Result<Feature, FeatureError>| match read {
                Ok(feature) => format!("{:?}", feature.polygons),
                Err(error) => error.to_string(),
            };
            let streamed: Vec<_> = streamed.map(|read| told(&read)).collect();
            assert_eq!(streamed, whole.iter().map(told).collect::<Vec<_>>());
        }
        whole
    }

    #[test]
    fn geometries_that_are_points_alone_have_a_border() {
        let mut points = super::points(&circle("name,x,y\n", ',')).unwrap();
        points.push(Point::new(50.0, 1.0));
        let texts = |before: &str, between: &str, after: &str| {
            let point = |p: &Point| format!("{}{between}{}", p.x, p.y);
            let texts: Vec<String> =
                points.iter().map(|p| format!("{before}{}{after}", point(p))).collect();
            texts
        };
        let point = |inner: &str| format!("{{\"type\":\"Point\",\"coordinates\":{inner}}}");
        let feature = |inner: &str| {
            format!("{{\"type\":\"Feature\",\"properties\":{{}},\"geometry\":{}}}", point(inner))
        };
        let positions = texts("[", ",", "]");
        let lines: Vec<String> = positions.iter().map(|p| feature(p)).collect();
        let members = lines.join(",");
        for (format, text) in [
            (Format::Wkt, as_wkt(&points)),
            (
                Format::Wkt,
                format!("SRID=3857;MULTIPOINT Z ({})", texts("(", " ", " 7)").join(", ")),
            ),
            (
                Format::Wkt,
                format!("POINT EMPTY;MULTIPOINT({},EMPTY)", texts("", " ", "").join(",")),
            ),
            (Format::GeoJsonLines, lines.join("\n")),
            (
                Format::GeoJson,
                format!("{{\"type\":\"FeatureCollection\",\"features\":[{members}]}}"),
            ),
            (
                Format::GeoJson,
                format!("{{\"type\":\"MultiPoint\",\"coordinates\":[{}]}}", positions.join(",")),
            ),
        ] {
            let found = all(format, &text);
            assert_eq!(found.len(), 1, "{format}");
            let found = found[0].as_ref().unwrap();
            assert_eq!((found.polygons.len(), found.polygons[0][0].len()), (1, 60), "{format}");
            assert_eq!(found.notes[0].text, "1 point lies on no closed border and is left out");
        }
    }

    #[test]
    fn one_feature_of_points_keeps_its_properties() {
        let text = "{\"type\":\"Feature\",\"id\":7,\"properties\":{\"a\":1},\"geometry\":\
                    {\"type\":\"MultiPoint\",\"coordinates\":[[0,0],[1,0],[1,1],[0,1]]}}";
        let found = all(Format::GeoJsonLines, text).remove(0).unwrap();
        assert_eq!((found.id.unwrap().get(), found.properties.len()), ("7", 1));
        assert_eq!(found.polygons[0][0].len(), 4);
    }

    #[test]
    fn points_among_other_geometries_are_no_border() {
        let square = "POINT (0 0)\nPOINT (1 0)\nPOINT (1 1)\nPOINT (0 1)\n";
        let found = all(Format::Wkt, &format!("{square}LINESTRING (5 5, 6 6)\n{square}"));
        assert_eq!(found.len(), 9);
        let told: Vec<_> = found.iter().map(|read| read.as_ref().unwrap()).collect();
        assert!((0..).zip(&told).all(|(k, f)| f.index == k && !f.polygonal));
        assert_eq!(
            (told[3].geometry.as_str(), told[4].geometry.as_str()),
            ("a POINT", "a LINESTRING")
        );
    }

    #[test]
    fn a_malformed_point_is_told_with_its_feature_and_line() {
        for (format, text, said) in [
            (
                Format::Wkt,
                "POINT (0 0)\nPOINT (1 x)\nPOINT (1 1)\n",
                "1: line 2, column 10: expected a number, found `x`",
            ),
            (
                Format::Wkt,
                "MULTIPOINT ((0 0), (1 1))\nMULTIPOINT ((0 1), (nan 1))\n",
                "1: line 2, column 21: expected a finite number, found `nan`",
            ),
            (
                Format::GeoJsonLines,
                "{\"type\":\"Point\",\"coordinates\":[0,0]}\n{\"type\":\"Point\",\"coordinates\":[1]}\n",
                "1: line 2, column 33: a position needs two numbers",
            ),
            (
                Format::GeoJsonLines,
                "{\"type\":\"Point\"}",
                "0: line 1, column 1: the Point has no `coordinates`",
            ),
        ] {
            let found = all(format, text);
            assert_eq!(found.len(), 1, "{found:?}");
            let error = found[0].as_ref().unwrap_err();
            assert_eq!(format!("{}: {}", error.feature, error.error), said);
        }
    }
}
