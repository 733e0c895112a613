//! Drawings and fonts, as a user meets them.

mod common;

use common::{fixture, medial, medial_with};
use serde_json::Value;

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn report(words: &[&str], file: &str) -> (Option<i32>, Value, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.json");
    let file = fixture(file);
    let mut all = vec![words[0], file.to_str().unwrap()];
    all.extend(&words[1..]);
    all.extend(["--report", path.to_str().unwrap()]);
    let run = medial(&all);
    let report = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    (run.status, report, run.text().to_owned())
}

#[test]
fn shapes_of_svg_are_features_with_their_properties() {
    let words = ["reconstruct", "--to", "geojsonl", "--tolerance", "0.01"];
    let (status, _, text) = report(&words, "drawings/plate.svg");
    assert_eq!(status, Some(0));
    let read = lines(&text);
    let told = |name: &str| -> Vec<String> {
        read.iter().map(|f| f["properties"][name].as_str().unwrap_or_default().to_owned()).collect()
    };
    assert_eq!(told("id"), ["rounded", "disk", "leaf", "cut"]);
    assert_eq!(told("part"), ["fill", "fill", "fill", "stroke"]);
    assert_eq!(told("group"), ["parts"; 4]);
    let area = |k: usize| read[k]["properties"]["area"].as_f64().unwrap();
    let pi = std::f64::consts::PI;
    assert!((area(0) - (800.0 - (4.0 - pi) * 36.0)).abs() < 0.5, "{}", area(0));
    assert!((area(1) - 144.0 * pi).abs() < 0.6, "{}", area(1));
    assert!((area(3) - 4.0 * 1000_f64.sqrt()).abs() < 1e-9, "{}", area(3));
    let y = |k: usize| read[k]["geometry"]["coordinates"][0][0][1].as_f64().unwrap();
    assert!((0..4).all(|k| y(k) < 0.0), "y points up");
}

#[test]
fn the_tolerance_holds_for_what_is_read() {
    let n = |tolerance: &str| {
        let file = fixture("drawings/plate.svg");
        let words =
            ["compress", file.to_str().unwrap(), "--max-error", "0", "--tolerance", tolerance];
        medial(&words).out.len()
    };
    assert!(n("0.5") < n("0.001"));
    let file = fixture("drawings/plate.svg");
    let run = medial(&["axis", file.to_str().unwrap(), "--tolerance", "1e-16", "--to", "wkt"]);
    assert!(run.errors.contains("take a larger one with --tolerance"), "{}", run.errors);
    assert_eq!(run.status, Some(3));
}

#[test]
fn outlines_of_dxf_close_and_the_rest_is_told() {
    let (status, report, text) = report(&["reconstruct", "--to", "geojsonl"], "drawings/slot.dxf");
    assert_eq!(status, Some(3));
    let read = lines(&text);
    assert_eq!(read.len(), 1);
    let properties = &read[0]["properties"];
    assert_eq!((&properties["layer"], &properties["units"]), (&"cut".into(), &"mm".into()));
    assert_eq!(properties["source_id"], "A1");
    assert_eq!(read[0]["geometry"]["coordinates"].as_array().unwrap().len(), 2);
    let area = properties["area"].as_f64().unwrap();
    let expected = 360.0 + std::f64::consts::PI * (36.0 - 6.25);
    assert!((area - expected).abs() < 0.5, "{area}");
    let codes: Vec<&str> = report["features"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|feature| feature["entries"].as_array().unwrap())
        .filter(|entry| entry["action"] == "refused")
        .map(|entry| entry["code"].as_str().unwrap())
        .collect();
    assert_eq!(codes, ["open_chain", "not_polygon"]);
}

#[test]
fn dxf_that_is_written_reads_back() {
    let l = "POLYGON ((0 0, 4.1 0, 4.1 0.3, 1 0.3, 1 3, 0 3, 0 0))";
    let dxf = medial_with(&["reconstruct", "-", "--to", "dxf"], l);
    assert_eq!((dxf.status, dxf.errors.as_str()), (Some(0), ""));
    let back = medial_with(&["reconstruct", "-", "--to", "wkt"], dxf.text());
    let straight = medial_with(&["reconstruct", "-", "--to", "wkt"], l);
    assert_eq!(back.text(), straight.text());
    // Arcs are arcs: their area does not depend on a tolerance.
    let words = ["offset", "-", "--distance=-1", "--to"];
    let grown = medial_with(&[&words[..], &["dxf"]].concat(), l);
    let json = medial_with(&[&words[..], &["json"]].concat(), l);
    let words = ["reconstruct", "-", "--to", "geojsonl", "--tolerance", "1e-7"];
    let read = medial_with(&words, grown.text());
    let area = lines(read.text())[0]["properties"]["area"].as_f64().unwrap();
    let exact = lines(json.text())[0]["area"].as_f64().unwrap();
    assert!((area - exact).abs() < 1e-5, "{area} is not {exact}");
    // Handles are numbers of their own.
    let axis = medial_with(&["axis", "-", "--to", "dxf", "--keypoints"], &format!("{l}\n{l}"));
    let pairs: Vec<&str> = axis.text().lines().collect();
    let handle = |pair: &[&'_ str]| matches!(pair[0], "5" | "105").then(|| pair[1].to_owned());
    let mut handles: Vec<String> = pairs.chunks(2).filter_map(handle).collect();
    let n = handles.len();
    handles.sort_unstable();
    handles.dedup();
    assert_eq!(handles.len(), n);
    assert!(axis.text().contains("\nSPLINE\n") && axis.text().contains("\naxis_parabola\n"));
}

#[test]
fn texts_are_set_in_the_glyphs_of_a_font() {
    let words = ["reconstruct", "--to", "geojsonl", "--text", "LV L"];
    let (status, _, text) = report(&words, "drawings/two_letters.ttf");
    assert_eq!(status, Some(0));
    let told: Vec<(String, f64)> = lines(&text)
        .iter()
        .map(|f| {
            let p = &f["properties"];
            (p["char"].as_str().unwrap().to_owned(), p["x"].as_f64().unwrap())
        })
        .collect();
    let expected = [("L", 0.0), ("V", 430.0), ("L", 1330.0)].map(|(c, x)| (c.to_owned(), x));
    assert_eq!(told, expected, "kerned by 90");
    let (status, _, text) = report(&["reconstruct", "--to", "wkt"], "drawings/two_letters.ttf");
    assert_eq!((status, text.lines().count()), (Some(0), 2));
}

#[test]
fn texts_of_drawings_take_the_font_that_is_named() {
    let text = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 99 99'>\
                <text x='10' y='20' font-size='10' font-family='Nowhere'>L</text></svg>";
    let font = fixture("drawings/two_letters.ttf");
    let words = ["reconstruct", "-", "--to", "geojsonl", "--font", font.to_str().unwrap()];
    let run = medial_with(&words, text);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let read = lines(run.text());
    assert_eq!(read[0]["properties"]["text"], "L");
    let low = read[0]["geometry"]["coordinates"][0].as_array().unwrap().iter();
    let low = low.map(|p| p[0].as_f64().unwrap()).fold(f64::INFINITY, f64::min);
    // Its left edge is at 80 of 1000 units.
    assert!((low - 10.8).abs() < 1e-4, "{low}");
}

#[test]
fn contents_are_told_apart() {
    for file in ["drawings/plate.svg", "drawings/slot.dxf", "drawings/two_letters.ttf"] {
        let folder = tempfile::tempdir().unwrap();
        let copy = folder.path().join("unnamed");
        std::fs::copy(fixture(file), &copy).unwrap();
        let [named, told] = [fixture(file), copy].map(|path| {
            medial(&["reconstruct", path.to_str().unwrap(), "--to", "wkt", "-q"]).text().to_owned()
        });
        assert!(!named.is_empty() && named == told, "{file}");
    }
}

#[test]
fn text_is_for_fonts_only() {
    let run = medial_with(
        &["axis", "-", "--from", "wkt", "--text", "A"],
        "POLYGON ((0 0, 4 0, 4 2, 0 0))",
    );
    let told = "error: --text is for fonts; the input is wkt\n";
    assert_eq!((run.status, run.errors.as_str()), (Some(2), told));
}
