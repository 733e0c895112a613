use super::*;
use crate::{Drawing, Feature, samples};
use medial::geom::Point;

fn features(text: &str) -> Vec<Feature> {
    read(text).map(Result::unwrap).collect()
}

fn error(text: &str) -> String {
    read(text).next().unwrap().unwrap_err().to_string()
}

#[test]
fn geometries_follow_one_another() {
    let read = features(
        "POLYGON ((0 0, 4 0, 4 2, 0 0), (1 .5, 2 0.5, 2 1, 1 .5))\n\
         SRID=2193;MULTIPOLYGON(((0 0,1 0,1 1)),((5 0,6 0,6 1)));\n\npolygon((0 0,1e1 0,1 1))",
    );
    assert_eq!(read.iter().map(|f| f.polygons.len()).collect::<Vec<_>>(), [1, 2, 1]);
    assert_eq!(read[0].polygons[0].len(), 2);
    assert_eq!(read[2].polygons[0][0][1], Point::new(10.0, 0.0));
    assert_eq!(read[2].index, 2);
}

#[test]
fn a_geometry_may_span_lines() {
    // As JTS formats it.
    let read = features(
        "POLYGON (\n  (0 0, 4 0,\n   4 2, 0 0),\n  (1 1, 2 1, 2 2, 1 1)\n)\nPOINT (1 1)\n",
    );
    assert_eq!(read.len(), 2);
    assert_eq!(read[0].polygons[0].len(), 2);
    assert!(!read[1].polygonal);
    assert_eq!(read[1].geometry, "a POINT");
}

#[test]
fn heights_and_measures_are_ignored() {
    for text in [
        "POLYGON Z ((0 0 9, 4 0 9, 4 2 9))",
        "POLYGONZ((0 0 9,4 0 9,4 2 9))",
        "POLYGON M ((0 0 9, 4 0 9, 4 2 9))",
        "POLYGON ZM ((0 0 9 8, 4 0 9 8, 4 2 9 8))",
        "POLYGON ((0 0 9, 4 0 9, 4 2 9))",
    ] {
        let ring = &features(text)[0].polygons[0][0];
        assert_eq!(*ring, [Point::new(0.0, 0.0), Point::new(4.0, 0.0), Point::new(4.0, 2.0)]);
    }
}

#[test]
fn collections_give_their_polygons() {
    let read = features(
        "GEOMETRYCOLLECTION (POINT (0 0), POLYGON ((0 0, 1 0, 1 1)), \
         GEOMETRYCOLLECTION (MULTIPOLYGON (((5 0, 6 0, 6 1)), EMPTY)), LINESTRING (0 0, 1 1))",
    );
    // The empty one keeps its number.
    assert_eq!(read[0].polygons.len(), 3);
    assert!(read[0].polygons[2].is_empty());
    let codes: Vec<_> = read[0].notes.iter().map(|n| n.code).collect();
    assert_eq!(codes, ["part_not_polygon", "part_not_polygon"]);
}

#[test]
fn empty_polygons_are_polygons_without_points() {
    for text in ["POLYGON EMPTY", "MULTIPOLYGON Z EMPTY", "MULTIPOLYGON (EMPTY)"] {
        let read = &features(text)[0];
        assert!(read.polygonal && read.polygons.concat().is_empty(), "{text}");
    }
    assert!(!features("GEOMETRYCOLLECTION EMPTY")[0].polygonal);
}

#[test]
fn a_closed_line_is_taken_for_a_ring() {
    let read = &features("LINESTRING (0 0, 4 0, 4 2, 0 0)")[0];
    assert_eq!(read.polygons.len(), 1);
    assert_eq!(read.notes[0].code, "line_as_ring");
    let open = &features("LINESTRING (0 0, 4 0, 4 2)")[0];
    assert!(!open.polygonal && open.notes.is_empty());
}

#[test]
fn errors_name_line_and_column() {
    assert_eq!(
        error("POLYGON ((0 0, 4 0,\n 4 x))"),
        "line 2, column 4: expected a number, found `x`"
    );
    assert_eq!(
        error("POLYGON ((0 0, 4"),
        "line 1, column 17: expected a number, found the end of the text"
    );
    assert_eq!(
        error("HEXAGON ((0 0))"),
        "line 1, column 1: expected a geometry such as POLYGON, found `HEXAGON`"
    );
    assert_eq!(error("POLYGON 0 0"), "line 1, column 9: expected `(`, found `0`");
}

#[test]
fn reading_goes_on_after_an_error() {
    let read: Vec<_> =
        read("POLYGON ((0 0, oops))\nPOLYGON ((0 0, 1 0, 1 1))\n)\nPOLYGON((0 0,1 0,1 1))")
            .collect();
    assert_eq!(read.iter().map(Result::is_ok).collect::<Vec<_>>(), [false, true, false, true]);
    assert_eq!(read[2].as_ref().unwrap_err().feature, 2);
}

#[test]
fn deep_nesting_is_refused_and_not_followed() {
    let text = "GEOMETRYCOLLECTION(".repeat(100_000);
    assert!(error(&text).contains("at most 32 nested collections"));
    let text = format!("TIN {}", "(".repeat(1_000_000));
    assert!(error(&text).contains("expected `)`"));
    let text = format!("MULTIPOINT {}", "(".repeat(1_000_000));
    assert!(error(&text).contains("expected a number, found `(`"));
}

#[test]
fn doubles_are_read_exactly() {
    let ring = &features("POLYGON((0.1 1830874.975,-0 1e-300,5453786.599999999627471 0,0 0))")[0]
        .polygons[0][0];
    assert_eq!(ring[0], Point::new(0.1, 1830874.975));
    assert!(ring[1].x.is_sign_negative());
    assert_eq!(ring[2].x.to_bits(), 5453786.6_f64.to_bits());
}

#[test]
fn an_axis_is_one_multi_line_string() {
    let text = write(&samples::rectangle(), Drawing::default());
    let expected = "MULTILINESTRING ((0 0, 1 1), (0 2, 1 1), (1 1, 3 1), (3 1, 4 0), (3 1, 4 2))\n";
    assert_eq!(text, expected);
}

#[test]
fn keypoints_and_radii_come_on_request() {
    let drawing = Drawing { radius_as_z: true, keypoints: true, ..Drawing::default() };
    let text = write(&samples::rectangle(), drawing);
    assert!(text.starts_with("GEOMETRYCOLLECTION Z (MULTILINESTRING Z ((0 0 0, 1 1 1),"), "{text}");
    assert!(
        text.ends_with("MULTIPOINT Z ((0 0 0), (4 0 0), (4 2 0), (0 2 0), (1 1 1), (3 1 1)))\n")
    );
}
