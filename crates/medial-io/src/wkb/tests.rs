use super::*;
use crate::{Drawing, Feature, samples};
use medial::geom::Point;

/// A geometry in either byte order.
struct Bytes(Vec<u8>, bool);

impl Bytes {
    fn head(little: bool, kind: u32) -> Self {
        Self(vec![u8::from(little)], little).word(kind)
    }

    fn word(mut self, word: u32) -> Self {
        self.0.extend(if self.1 { word.to_le_bytes() } else { word.to_be_bytes() });
        self
    }

    fn numbers(mut self, numbers: &[f64]) -> Self {
        for n in numbers {
            self.0.extend(if self.1 { n.to_le_bytes() } else { n.to_be_bytes() });
        }
        self
    }

    fn with(mut self, other: &[u8]) -> Self {
        self.0.extend(other);
        self
    }
}

const TRIANGLE: [f64; 6] = [0.0, 0.0, 4.0, 0.0, 4.0, 2.0];

fn triangle(little: bool) -> Vec<u8> {
    Bytes::head(little, 3).word(1).word(3).numbers(&TRIANGLE).0
}

fn features(bytes: &[u8]) -> Vec<Feature> {
    read(bytes).unwrap().map(Result::unwrap).collect()
}

fn error(bytes: &[u8]) -> String {
    read(bytes).unwrap().next().unwrap().unwrap_err().to_string()
}

#[test]
fn geometries_follow_one_another_in_either_byte_order() {
    let read = features(&[triangle(true), triangle(false)].concat());
    assert_eq!(read.len(), 2);
    for feature in read {
        let ring = &feature.polygons[0][0];
        assert_eq!(*ring, [Point::new(0.0, 0.0), Point::new(4.0, 0.0), Point::new(4.0, 2.0)]);
    }
}

#[test]
fn hexadecimal_lines_are_geometries() {
    let hex = |bytes: &[u8]| bytes.iter().map(|b| format!("{b:02X}")).collect::<String>();
    let text =
        format!("{}\n\nzz\n0\n{}\n", hex(&triangle(true)), hex(&triangle(false)).to_lowercase());
    let read: Vec<_> = read(text.as_bytes()).unwrap().collect();
    assert_eq!(read.iter().map(Result::is_ok).collect::<Vec<_>>(), [true, false, false, true]);
    let said = read[1].as_ref().unwrap_err().to_string();
    assert_eq!(said, "line 3, column 1: a line of pairs of hexadecimal digits is expected");
}

#[test]
fn heights_measures_and_reference_systems_are_ignored() {
    let three = [0.0, 0.0, 9.0, 4.0, 0.0, 9.0, 4.0, 2.0, 9.0];
    let four = [0.0, 0.0, 9.0, 8.0, 4.0, 0.0, 9.0, 8.0, 4.0, 2.0, 9.0, 8.0];
    for (kind, numbers) in [
        (1003, &three[..]),
        (2003, &three),
        (3003, &four),
        (0x8000_0003, &three),
        (0x4000_0003, &three),
        (0xc000_0003, &four),
    ] {
        let bytes = Bytes::head(true, kind).word(1).word(3).numbers(numbers).0;
        assert_eq!(features(&bytes)[0].polygons[0][0][2], Point::new(4.0, 2.0), "{kind:x}");
    }
    let bytes = Bytes::head(true, 0x2000_0003).word(2193).word(1).word(3).numbers(&TRIANGLE).0;
    assert_eq!(features(&bytes)[0].polygons.len(), 1);
}

#[test]
fn collections_give_their_polygons() {
    let point = Bytes::head(true, 1).numbers(&[0.0, 0.0]).0;
    let multi = Bytes::head(true, 6).word(2).with(&triangle(true)).with(&triangle(false)).0;
    let bytes = Bytes::head(true, 7).word(2).with(&point).with(&multi).0;
    let read = &features(&bytes)[0];
    assert_eq!((read.polygons.len(), read.notes.len()), (2, 1));
    let lone = &features(&point)[0];
    assert!(!lone.polygonal && lone.geometry == "a Point");
}

#[test]
fn what_is_wrong_is_named() {
    let whole = triangle(true);
    assert_eq!(error(&whole[..50]), "byte 9: a count of 3 is more than there is");
    assert_eq!(error(&[7, 0]), "byte 1: 7 is no byte order");
    assert_eq!(error(&[1, 3]), "byte 1: the geometry ends too early");
    let surface = Bytes::head(true, 14).word(0).0;
    assert_eq!(error(&surface), "byte 5: geometries of type 14 are not known");
    let many = Bytes::head(true, 3).word(u32::MAX).0;
    assert_eq!(error(&many), "byte 5: a count of 4294967295 is more than there is");
    let deep = Bytes::head(true, 7).word(1).0.repeat(100_000);
    assert!(error(&deep).contains("nested deeper than 32"));
    assert!(read(b" \n").is_err());
}

#[test]
fn an_axis_is_one_multi_line_string() {
    let bytes = write(&samples::rectangle(), Drawing::default());
    // Five lines of two points: 9 + 5·(9 + 32) bytes.
    assert_eq!(bytes.len(), 214);
    assert_eq!(bytes[..9], [1, 5, 0, 0, 0, 5, 0, 0, 0]);
    let drawing = Drawing { radius_as_z: true, keypoints: true, ..Drawing::default() };
    let bytes = write(&samples::rectangle(), drawing);
    // 9 for the collection, 9 + 5·(9 + 48) for the lines, 9 + 6·(5 + 24) for the points.
    assert_eq!(bytes.len(), 9 + 294 + 183);
    let read = features(&bytes);
    assert!(!read[0].polygonal);
    assert_eq!(read[0].geometry, "a GeometryCollection");
}

#[test]
fn curved_shapes_are_no_polygons_but_surfaces_of_polygons_are() {
    let triangle = triangle(true);
    let curve = [Bytes::head(true, 10).word(1).0, Bytes::head(true, 8).word(0).0].concat();
    let of = |parts: &[&[u8]]| {
        let head = Bytes::head(true, 12).word(parts.len() as u32).0;
        features(&[&head[..], &parts.concat()].concat()).remove(0)
    };
    let surface = of(&[&triangle, &triangle]);
    assert!(surface.polygonal && surface.polygons.len() == 2 && surface.notes.is_empty());
    let mixed = of(&[&triangle, &curve]);
    assert!(!mixed.polygonal && mixed.polygons.is_empty() && mixed.geometry == "a MultiSurface");
    let alone = &features(&curve)[0];
    assert!(!alone.polygonal && alone.geometry == "a CurvePolygon");
}
