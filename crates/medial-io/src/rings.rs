//! Bare JSON arrays: a polygon is `[[ring], [hole], …]`, a ring `[[x, y], …]`.
//!
//! A text is one polygon after the other, each a feature: on lines of their own, or one that
//! spans several lines. An array of polygons is one feature of several polygons.

use crate::json::{Ring, parse, points};
use crate::text::{offset, syntax_at};
use crate::{Error, Feature, FeatureError, Layer};
use serde_json::value::RawValue;

/// Reads all polygons of a text.
///
/// # Errors
/// If the text is empty or no sequence of JSON arrays. An array that is no polygon is an item of
/// the layer.
pub fn read(text: &str) -> Result<Layer<'_>, Error> {
    let mut arrays = Vec::new();
    let mut stream = serde_json::Deserializer::from_str(text).into_iter::<&RawValue>();
    while let Some(raw) = stream.next() {
        match raw {
            Ok(raw) => arrays.push(raw.get()),
            Err(error) => {
                let whole: Result<&RawValue, Error> = parse(text, &text[stream.byte_offset()..]);
                let why = error.to_string();
                return Err(whole.err().unwrap_or_else(|| syntax_at(text, text.len(), why)));
            }
        }
    }
    if arrays.is_empty() {
        return Err(Error::Empty);
    }
    let len = Some(arrays.len());
    Ok(Layer { len, ..Layer::of_slices(text, arrays.into_iter(), feature) })
}

fn feature(text: &str, part: &str, index: usize) -> Result<Feature, FeatureError> {
    polygon(text, part, index).map_err(|error| FeatureError { feature: index, id: None, error })
}

fn polygon(text: &str, part: &str, index: usize) -> Result<Feature, Error> {
    let mut feature = Feature::numbered(index);
    feature.geometry = "an array without rings".to_owned();
    feature.polygonal = true;
    // Four brackets open an array of polygons, three a polygon.
    let depth = part.chars().filter(|c| !c.is_whitespace()).take_while(|&c| c == '[').count();
    if depth >= 4 {
        for rings in parse::<Vec<Vec<Ring>>>(text, part)? {
            feature.add_polygon(points(rings));
        }
    } else if depth == 2 && part.contains(|c: char| c.is_ascii_digit()) {
        let why = "a polygon is an array of rings [[[x, y], …], …]; this is an array of positions";
        return Err(syntax_at(text, offset(text, part), why));
    } else {
        feature.add_polygon(points(parse::<Vec<Ring>>(text, part)?));
    }
    Ok(feature)
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::geom::Point;

    fn features(text: &str) -> Vec<Feature> {
        read(text).unwrap().map(Result::unwrap).collect()
    }

    #[test]
    fn one_polygon_may_span_lines() {
        let read = features("[\n[[0,0],[4,0],[4,2]],\n[[1,0.5],[2,0.5],[2,1]]\n]\n");
        assert_eq!(read.len(), 1);
        assert_eq!(read[0].polygons[0].len(), 2);
        assert_eq!(read[0].polygons[0][1][1], Point::new(2.0, 0.5));
    }

    #[test]
    fn every_line_is_a_feature() {
        let read = features("[[[0,0],[4,0],[4,2]]]\n\n[[[0,0],[4,0],[4,3]]]\n");
        assert_eq!(read.iter().map(|f| f.index).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(read[1].polygons[0][0][2], Point::new(4.0, 3.0));
    }

    #[test]
    fn four_brackets_open_several_polygons() {
        let read = features("[[[[0,0],[4,0],[4,2]]], [[[9,0],[12,0],[12,2]]]]");
        assert_eq!(read.len(), 1);
        assert_eq!(read[0].polygons.len(), 2);
    }

    #[test]
    fn a_broken_array_names_its_line() {
        let error = read("[[[0,0],[4,0],[4,2]]]\n[[[0,0],[4,}").err().unwrap();
        assert_eq!(error.to_string(), "line 2, column 12: expected value");
    }

    #[test]
    fn a_wrong_position_spoils_only_its_own_polygon() {
        let read: Vec<_> = read("[[[0,0],[4]]]\n[[[0,0],[4,0],[4,3]]]").unwrap().collect();
        let error = read[0].as_ref().unwrap_err();
        assert_eq!(error.feature, 0);
        assert_eq!(error.to_string(), "line 1, column 11: a position needs two numbers");
        assert!(read[1].is_ok());
    }

    #[test]
    fn a_bare_ring_is_told_apart() {
        let error = read("[[0,0],[4,0],[4,2]]").unwrap().next().unwrap().unwrap_err();
        assert!(error.to_string().contains("array of positions"), "{error}");
    }

    #[test]
    fn empty_text_is_an_error() {
        assert!(matches!(read(" \n").err(), Some(Error::Empty)));
    }
}
