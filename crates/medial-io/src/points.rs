//! Points without any order, as comma-separated values: one feature, the border that they lie on.
//!
//! # Contract
//! A row is a point. Coordinates are in the columns `x` and `y`, `lon` and `lat`, or `longitude` and `latitude` of the
//! first row, in any letter case; without such names, the first two columns. Commas, semicolons, tabs and blanks
//! separate values, whichever the first row has.
//!
//! The polygons are the closed rings of the [crust](medial::engine::border), as one polygon, so that which are holes is
//! told by nesting; how many points lie on none of them, and how many are given once more, is noted.

use crate::feature::Note;
use crate::{Error, Feature, Layer};
use medial::engine::{Border, border};
use medial::geom::Point;
use std::collections::HashSet;

/// Reads the border of the points in a text.
///
/// # Errors
/// If there are no rows, or a row has no two finite numbers where coordinates are.
pub fn read(text: &str) -> Result<Layer<'_>, Error> {
    let mut points = points(text)?;
    let n_given = points.len();
    let mut seen = HashSet::with_capacity(n_given);
    // Both zeros are one number.
    points.retain(|p| seen.insert([p.x, p.y].map(|v| (v + 0.0).to_bits())));
    let n_repeats = n_given - points.len();
    let Border { rings, left_out } = border(&points);
    let mut feature = Feature::numbered(0);
    feature.geometry = format!("{n_given} points without a closed border");
    if n_repeats > 0 {
        let text = format!("{n_repeats} points are given once more and taken once");
        feature.notes.push(Note { code: "duplicate_point", text });
    }
    if !rings.is_empty() {
        if !left_out.is_empty() {
            let text =
                format!("{} points lie on no closed border and are left out", left_out.len());
            feature.notes.push(Note { code: "point_left_out", text });
        }
        feature.add_polygon(rings);
    }
    Ok(Layer { len: Some(1), ..Layer::new(std::iter::once(Ok(feature))) })
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
                ("point_left_out", "1 points lie on no closed border and are left out"),
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
}
