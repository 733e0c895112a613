use super::*;
use crate::{Error, Feature, FeatureError, ReadOptions};
use medial::domain::Curves;
use medial::geom::Point;
use std::f64::consts::PI;

/// A file of entities, from pairs on lines that are joined by `|`.
fn file(entities: &str) -> String {
    let pairs = entities.split_whitespace().map(|pair| pair.replacen('=', "\n", 1) + "\n");
    format!(
        "999\nmade by hand\n0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}\
         0\nENDSEC\n0\nEOF\n",
        pairs.collect::<String>()
    )
}

fn features(entities: &str) -> Vec<Result<Feature, FeatureError>> {
    let options = ReadOptions { tolerance: Some(1e-5), ..ReadOptions::default() };
    read(file(entities).as_bytes(), &options).unwrap().collect()
}

fn area(feature: &Feature) -> f64 {
    let ring = |ring: &Vec<Point>| -> f64 {
        let next = ring.iter().cycle().skip(1);
        (0.5 * ring.iter().zip(next).map(|(a, b)| a.cross(*b)).sum::<f64>()).abs()
    };
    let polygon = |rings: &Vec<Vec<Point>>| {
        rings.iter().skip(1).fold(ring(&rings[0]), |area, hole| area - ring(hole))
    };
    feature.polygons.iter().map(polygon).sum()
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-3, "{a} is not {b}");
}

#[test]
fn polylines_with_bulges_and_circles_have_their_area() {
    let read = features(
        "0=LWPOLYLINE 5=2F 8=cut 90=2 70=1 10=0 20=0 42=1 10=2 20=0 42=1 \
         0=CIRCLE 8=other 10=0.1 20=0.2 40=3 \
         0=LWPOLYLINE 8=square 70=1 10=0.1 20=0.2 10=4 20=0 10=4 20=4 10=0 20=4",
    );
    let read: Vec<Feature> = read.into_iter().map(Result::unwrap).collect();
    near(area(&read[0]), PI);
    near(area(&read[1]), 9.0 * PI);
    assert_eq!(read[0].id.as_ref().unwrap().get(), "\"2F\"");
    let told: Vec<String> = read[0].properties.iter().map(|(n, v)| format!("{n}={v}")).collect();
    assert_eq!(told, ["layer=\"cut\"", "entity=\"LWPOLYLINE\"", "handle=\"2F\"", "units=\"mm\""]);
    let curves = read[1].curves.as_ref().unwrap();
    assert!(curves.pieces.len() == 2 && curves.pieces[0].start.curvature == 1.0 / 3.0);
    assert!(curves.edges[0][0].iter().all(|edge| *edge != Curves::STRAIGHT));
    assert_eq!(read[2].polygons[0][0][0], Point::new(0.1, 0.2));
    assert!(read[2].curves.is_none());
}

#[test]
fn lines_and_arcs_close_and_lie_in_one_another() {
    // A slot of two lines and two arcs, in which lie a circle and in that another one.
    let read = features(
        "0=LINE 8=0 10=0 20=0 11=10 21=0 0=ARC 8=0 10=10 20=2 40=2 50=270 51=90 \
         0=LINE 8=0 10=0 20=4 11=10 21=4 0=ARC 8=0 10=0 20=2 40=2 50=90 51=270 \
         0=CIRCLE 8=0 10=5 20=2 40=1.5 0=CIRCLE 8=0 10=5 20=2 40=0.5 0=CIRCLE 8=a 10=5 20=2 40=1",
    );
    let read: Vec<Feature> = read.into_iter().map(Result::unwrap).collect();
    let areas: Vec<f64> = read.iter().map(area).collect();
    assert_eq!(areas.len(), 3, "{areas:?}");
    near(areas[0], 40.0 + 4.0 * PI - 2.25 * PI);
    near(areas[1], 0.25 * PI);
    near(areas[2], PI);
    assert!(read[0].notes.is_empty(), "{:?}", read[0].notes);
    let edges = &read[0].curves.as_ref().unwrap().edges[0];
    assert_eq!((edges.len(), edges[0].iter().filter(|e| **e == Curves::STRAIGHT).count()), (2, 2));
}

#[test]
fn an_outline_with_a_line_drawn_twice_is_one() {
    let read = features(
        "0=LINE 8=0 10=0 20=0 11=5 21=0 0=LINE 8=0 10=0 20=0 11=5 21=0 \
         0=LINE 8=0 10=5 20=0 11=5 21=5 0=LINE 8=0 10=5 20=5 11=0 21=0",
    );
    let [Ok(triangle)] = &read[..] else { panic!("{read:?}") };
    near(area(triangle), 12.5);
    assert_eq!(triangle.notes[0].code, "duplicate_line");
    assert!(triangle.notes[0].text.ends_with(": 1 left out"));
    let read = features("0=LINE 8=0 10=0 20=0 11=5 21=0 0=LINE 8=0 10=5 20=0 11=0 21=0");
    let [Err(error)] = &read[..] else { panic!("{read:?}") };
    assert!(error.to_string().starts_with("a chain of 1 LINE, 1 repeat left out, on layer `0`"));
}

#[test]
fn what_is_open_or_no_outline_is_told() {
    let read = features(
        "0=LINE 8=a 10=0 20=0 11=1 21=0 0=LINE 8=a 10=1 20=0 11=1 21=1 0=TEXT 8=t 1=Hi \
         0=CIRCLE 8=b 10=0 20=0 40=x 0=INSERT 8=0 2=GONE 10=0 20=0 0=LINE 67=1 8=p 10=0 20=0",
    );
    assert_eq!(read.len(), 5, "{read:?}");
    let error = read[0].as_ref().unwrap_err();
    assert_eq!(error.error.code(), "open_chain");
    let told = "a chain of 2 LINE on layer `a` from (0, 0) to (1, 1) is open; close it in the drawing, or leave \
                it out";
    assert_eq!(error.to_string(), told);
    let text = read[1].as_ref().unwrap();
    assert!(!text.polygonal && text.geometry == "a DXF TEXT");
    assert!(read[2].as_ref().unwrap_err().to_string().ends_with("group 40: `x` is no number"));
    assert!(read[3].as_ref().unwrap_err().to_string().contains("there is no block `GONE`"));
    assert_eq!(read[4].as_ref().unwrap().geometry, "a DXF LINE in paper space");
}

#[test]
fn ellipses_splines_solids_and_mirrored_planes_are_read() {
    let root = 0.5_f64.sqrt();
    let read = features(&format!(
        "0=ELLIPSE 8=a 10=0 20=0 11=3 21=0 40=0.5 41=0 42=6.283185307179586 \
         0=SPLINE 8=b 70=4 71=2 40=0 40=0 40=0 40=1 40=1 40=1 41=1 41={root} 41=1 10=1 20=0 10=1 20=1 10=0 20=1 \
         0=LINE 8=b 10=0 20=1 11=0 21=0 0=LINE 8=b 10=0 20=0 11=1 21=0 \
         0=SOLID 8=c 10=0 20=0 11=1 21=0 12=0 22=1 13=1 23=1 \
         0=CIRCLE 8=d 10=5 20=1 40=1 210=0 220=0 230=-1"
    ));
    let read: Vec<Feature> = read.into_iter().map(Result::unwrap).collect();
    near(area(&read[0]), 4.5 * PI);
    near(area(&read[1]), 0.25 * PI);
    near(area(&read[2]), 1.0);
    assert!(read[3].polygons[0][0].iter().all(|p| p.x < -3.9), "mirrored");
}

#[test]
fn blocks_are_inserted_scaled_and_turned() {
    let pairs = "0=SECTION 2=BLOCKS 0=BLOCK 2=B 10=1 20=0 0=LWPOLYLINE 8=0 70=1 10=1 20=0 10=2 20=0 10=2 20=1 \
                 0=CIRCLE 8=own 10=9 20=9 40=1 0=ENDBLK 0=ENDSEC 0=SECTION 2=ENTITIES \
                 0=INSERT 8=L 2=b 10=100 20=0 41=2 42=3 50=90 70=2 44=10 0=ENDSEC 0=EOF";
    let text: String =
        pairs.split_whitespace().map(|pair| pair.replacen('=', "\n", 1) + "\n").collect();
    let read: Vec<Feature> =
        read(text.as_bytes(), &ReadOptions::default()).unwrap().map(Result::unwrap).collect();
    let p = Point::new;
    assert_eq!(read[0].polygons[0][0], [p(100., 0.), p(100., 2.), p(97., 2.)]);
    let layers: Vec<&str> = read.iter().map(|f| f.properties[0].1.get()).collect();
    assert_eq!(layers, ["\"L\"", "\"own\"", "\"L\"", "\"own\""]);
    assert_eq!(read[2].polygons[0][0][0], p(100., 10.));
    assert!((area(&read[1]) - 6.0 * PI).abs() < 0.01);
}

#[test]
fn hatches_are_features_of_their_own() {
    let read = features(
        "0=HATCH 8=h 10=0 20=0 30=0 2=SOLID 70=1 91=2 \
         92=3 72=1 73=1 93=4 10=0 20=0 42=0 10=9 20=0 42=0 10=9 20=9 42=0 10=0 20=9 42=0 97=0 \
         92=1 93=3 72=2 10=5 20=5 40=1 50=0 51=180 73=1 72=1 10=4 20=5 11=4.5 21=5 72=1 10=4.5 20=5 11=6 21=5 97=0 \
         75=0 76=1 98=0",
    );
    let read: Vec<Feature> = read.into_iter().map(Result::unwrap).collect();
    assert_eq!(read.len(), 1);
    near(area(&read[0]), 81.0 - 0.5 * PI);
}

#[test]
fn styles_of_hatches_tell_which_paths_are_filled() {
    let square = |a: u32| {
        let b = 10 - a;
        format!("92=2 72=0 73=1 93=4 10={a} 20={a} 10={b} 20={a} 10={b} 20={b} 10={a} 20={b} 97=0 ")
    };
    let paths = [0, 1, 2].map(square).concat();
    for (style, expected) in [(0, 100.0 - 64.0 + 36.0), (1, 100.0 - 64.0), (2, 100.0)] {
        let read = features(&format!("0=HATCH 8=h 70=1 91=3 {paths} 75={style} 76=1 98=0"));
        near(area(read[0].as_ref().unwrap()), expected);
    }
}

#[test]
fn all_units_have_names() {
    let of = |number: &str| {
        let text = file("0=CIRCLE 8=a 10=0 20=0 40=1");
        let text = text.replace("$INSUNITS\n70\n4\n", &format!("$INSUNITS\n70\n{number}\n"));
        let layer = read(text.as_bytes(), &ReadOptions::default()).unwrap();
        (layer.units, layer.warnings)
    };
    assert_eq!(of("21"), (Some("us-ft"), vec![]));
    assert_eq!(of("0"), (None, vec![]));
    let (units, warnings) = of("25");
    assert!(units.is_none() && warnings[0].contains("$INSUNITS is 25"), "{warnings:?}");
    assert!(header(Some("us-ft")).contains("$INSUNITS\n70\n21\n9\n$MEASUREMENT\n70\n0\n"));
}

#[test]
fn a_bulge_that_is_none_is_refused() {
    for value in ["inf", "nan", "1e300"] {
        let read = features(&format!(
            "0=LWPOLYLINE 8=0 70=1 10=0 20=0 42={value} 10=2 20=0 42=1 \
             0=POLYLINE 8=1 70=1 0=VERTEX 8=1 10=0 20=0 42={value} 0=VERTEX 8=1 10=1 20=1 0=SEQEND \
             0=HATCH 8=2 91=1 92=2 72=1 73=1 93=2 10=0 20=0 42={value} 10=1 20=0 42=1 97=0"
        ));
        assert_eq!(read.len(), 3, "{value}");
        for read in read {
            let error = read.unwrap_err().to_string();
            assert!(error.contains("group 42: ") && error.contains("is no bulge"), "{error}");
        }
    }
}

#[test]
fn what_is_no_drawing_is_refused() {
    let error = |bytes: &[u8]| read(bytes, &ReadOptions::default()).err().unwrap().to_string();
    assert_eq!(error(b" \n"), "the input is empty");
    assert!(error(b"POLYGON ((0 0))").starts_with("line 1, column 1: a group code is needed"));
    assert!(error(b"0\nSECTION\n2").starts_with("line 3, column 1: the value of the group"));
    assert!(error(b"AutoCAD Binary DXF\r\n\x1a\0\0\0SECTION").contains("cut off"));
    assert!(matches!(
        read(b"0\nLINE\n", &ReadOptions::default()).err(),
        Some(Error::Syntax { .. })
    ));
    assert!(begins(b"999\nhi\r\n  0\r\nSECTION\r\n") && !begins(b"0103") && !begins(b""));
}

#[test]
fn absurd_drawings_end() {
    let pairs = "0=SECTION 2=BLOCKS 0=BLOCK 2=B 0=INSERT 8=0 2=B 10=0 20=0 70=30000 71=30000 0=ENDBLK 0=ENDSEC \
                 0=SECTION 2=ENTITIES 0=INSERT 8=L 2=b 10=1 20=0 70=30000 71=30000 0=ENDSEC 0=EOF";
    let text: String =
        pairs.split_whitespace().map(|pair| pair.replacen('=', "\n", 1) + "\n").collect();
    assert!(read(text.as_bytes(), &ReadOptions::default()).unwrap().count() > 0);
    for value in ["1e300", "nan", "inf", "-1e-300", "0"] {
        features(&format!(
            "0=CIRCLE 8=0 10={value} 20=0 40={value} 0=ARC 8=0 10=0 20={value} 40=1e9 50={value} 51={value} \
             0=ELLIPSE 8=0 10=0 20=0 11={value} 21=1 40={value} 41={value} 42=1 \
             0=LWPOLYLINE 8=0 70=1 10=0 20=0 42={value} 10={value} 20=1 42=-1 10=4 20=5 \
             0=SPLINE 8=0 71=2 40=0 40=0 40=0 40={value} 40={value} 40={value} 10=0 20=0 10={value} 20=1 10=2 20=2 \
             0=HATCH 8=0 91=99999999 92=2 93=99999999 10=0 20={value}"
        ));
    }
}

#[test]
fn what_is_written_reads_back() {
    let mut entities = Entities::default();
    let p = Point::new;
    let ring = vec![p(0.1, 0.2), p(4.0, 0.0), p(4.0, 1.0 / 3.0)];
    let record = crate::record::Record {
        values: Vec::new(),
        shape: crate::record::Shape::Polygons(vec![vec![ring.clone()]]),
    };
    entities.records(&[record]);
    let mut n = 0;
    let body = number(entities.into_text().as_bytes(), &mut n);
    let text = [header(Some("in")).into_bytes(), body, FOOTER.as_bytes().to_vec()].concat();
    let layer = read(&text, &ReadOptions::default()).unwrap();
    assert_eq!((n, layer.units), (1, Some("in")));
    let read: Vec<Feature> = layer.map(Result::unwrap).collect();
    assert_eq!(read[0].polygons, [[ring]]);
    assert_eq!(read[0].id.as_ref().unwrap().get(), "\"100\"");
}

#[test]
fn a_file_that_is_cut_off_is_refused_wherever_that_is() {
    let whole = file("0=CIRCLE 8=a 10=0 20=0 40=1 0=CIRCLE 8=b 10=9 20=0 40=1");
    let options = ReadOptions::default();
    // Between two groups, as elsewhere a value is missing.
    let lines: Vec<&str> = whole.split_inclusive('\n').collect();
    let n = lines.len();
    for end in (4..n - 2).step_by(2) {
        let text = lines[..end].concat();
        let error = read(text.as_bytes(), &options).err().unwrap().to_string();
        assert!(error.contains("cut off"), "{end}: {error}");
    }
    let without_end = lines[..n - 2].concat();
    assert_eq!(read(without_end.as_bytes(), &options).unwrap().count(), 2);
}

#[test]
fn a_layer_that_is_not_there_is_refused() {
    let text = file("0=CIRCLE 8=a 10=0 20=0 40=1 0=TEXT 8=b 1=Hi");
    let of = |layer: &str| {
        let options = ReadOptions { layer: Some(layer.to_owned()), ..ReadOptions::default() };
        read(text.as_bytes(), &options).map(Iterator::count).map_err(|error| error.to_string())
    };
    assert_eq!((of("a"), of("b")), (Ok(1), Ok(1)));
    let told = "there is nothing on a layer `c`; of layers there are `a`, `b`";
    assert_eq!(of("c"), Err(told.to_owned()));
}

#[test]
fn splines_of_fit_points_are_read() {
    // The closed one through the corners of a square of side 1: control points lie a quarter outside.
    let square = "0=SPLINE 8=a 70=1 71=3 74=4 11=0 21=0 11=1 21=0 11=1 21=1 11=0 21=1";
    // A half wave, up at the start and down at the end, closed by a line.
    let wave = "0=SPLINE 8=b 70=0 71=3 74=2 12=0 22=5 13=0 23=-3 11=0 21=0 11=3 21=0 \
                0=LINE 8=b 10=3 20=0 11=0 21=0";
    let read = features(&format!("{square} {wave}"));
    let read: Vec<Feature> = read.into_iter().map(Result::unwrap).collect();
    // Below (0, 0), (1/4, 1/4), (3/4, 1/4), (1, 0) lies the integral of 3/4 t (1 - t) (3/4 + 3/2 t (1 - t)).
    near(area(&read[0]), 1.0 + 4.0 * (9.0 / 96.0 + 9.0 / 240.0));
    // Below (0, 0), (0, 1), (3, 1), (3, 0) that of 3 t (1 - t) 18 t (1 - t).
    near(area(&read[1]), 54.0 / 30.0);
}

#[test]
fn what_nobody_sees_is_passed_over_and_told() {
    let square = |layer: &str, more: &str| {
        format!("0=LWPOLYLINE 8={layer} 70=1 10=0 20=0 10=1 20=0 10=1 20=1 {more}")
    };
    let entities = [
        square("ON", ""),
        square("off", ""),
        square("FROZEN", ""),
        square("ON", "60=1"),
        "0=INSERT 8=OFF 2=B 10=0 20=0 0=INSERT 8=FROZEN 2=B 10=0 20=0".to_owned(),
    ];
    let block = format!("0=BLOCK 2=B 10=0 20=0 {} {} 0=ENDBLK", square("0", ""), square("ON", ""));
    let pairs = format!(
        "0=SECTION 2=TABLES 0=TABLE 2=LAYER 70=3 0=LAYER 2=ON 70=0 62=7 0=LAYER 2=OFF 70=0 62=-7 \
         0=LAYER 2=FROZEN 70=1 62=7 0=ENDTAB 0=ENDSEC 0=SECTION 2=BLOCKS {block} 0=ENDSEC \
         0=SECTION 2=ENTITIES {} 0=ENDSEC 0=EOF",
        entities.join(" ")
    );
    let text: String =
        pairs.split_whitespace().map(|pair| pair.replacen('=', "\n", 1) + "\n").collect();
    let of = |layer: Option<&str>| {
        let layer = layer.map(ToOwned::to_owned);
        let options = ReadOptions { layer, ..ReadOptions::default() };
        let layer = read(text.as_bytes(), &options).unwrap();
        (layer.warnings.clone(), layer.map(Result::unwrap).count())
    };
    let (warnings, n) = of(None);
    // The one that is on, and that of the block whose insertion is off.
    assert_eq!(n, 2);
    assert!(warnings[0].contains("passed over: 5 on `FROZEN`, `OFF`, `ON`, `off`"), "{warnings:?}");
    assert_eq!(of(Some("off")).1, 1);
    assert_eq!(of(Some("FROZEN")).1, 2);
}
