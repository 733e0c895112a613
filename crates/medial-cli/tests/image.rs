//! From a colour picture to the axes of its features, as a user meets them.

mod common;

use common::{fixture, medial, medial_with, names};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A picture of letters, each a colour; blanks are transparent.
fn picture(folder: &Path, name: &str, rows: &[&str]) -> String {
    let path = folder.join(name);
    let (columns, n_rows) = (rows[0].len() as u32, rows.len() as u32);
    let mut encoder = png::Encoder::new(fs::File::create(&path).unwrap(), columns, n_rows);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let colour = |letter: u8| match letter {
        b' ' => [0; 4],
        b'.' => [30, 40, 180, 255],
        b'r' => [200, 30, 30, 255],
        b'g' => [30, 160, 40, 255],
        _ => [240, 240, 240, 255],
    };
    let samples: Vec<u8> = rows.iter().flat_map(|row| row.bytes()).flat_map(colour).collect();
    encoder.write_header().unwrap().write_image_data(&samples).unwrap();
    path.to_str().unwrap().to_owned()
}

/// A red bar of 12 by 4 pixels, a green square of 4 by 4, and a white one beside it, on blue.
const BARS: [&str; 12] = [
    "..................",
    ".rrrrrrrrrrrr.....",
    ".rrrrrrrrrrrr.....",
    ".rrrrrrrrrrrr.....",
    ".rrrrrrrrrrrr.....",
    "..................",
    ".ggggwwww.........",
    ".ggggwwww.........",
    ".ggggwwww.........",
    ".ggggwwww.........",
    "..................",
    "................. ",
];

/// How all pictures here are parted: by lightness, in regions of one colour.
const PARTED: [&str; 4] = ["--method", "threshold", "--limits", "35,45,60,80"];

fn words<'a>(picture: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["image", picture][..], &PARTED, more].concat()
}

fn features(text: &str) -> Vec<Value> {
    let read: Value = serde_json::from_str(text).unwrap();
    read["features"].as_array().unwrap().clone()
}

/// The features of each layer.
fn by_layer(text: &str) -> BTreeMap<String, Vec<Value>> {
    let mut layers: BTreeMap<String, Vec<Value>> = BTreeMap::new();
    for feature in features(text) {
        let layer = feature["properties"]["layer"].as_str().unwrap().to_owned();
        layers.entry(layer).or_default().push(feature);
    }
    layers
}

fn folder_with_bars() -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let bars = picture(folder.path(), "bars.png", &BARS);
    (folder, bars)
}

fn regions_of(text: &str) -> Vec<u64> {
    features(text).iter().map(|f| f["properties"]["region"].as_u64().unwrap()).collect()
}

#[test]
fn all_regions_have_a_border_and_an_axis() {
    let (_folder, bars) = folder_with_bars();
    let run = medial(&words(&bars, &[]));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let layers = by_layer(run.text());
    assert_eq!(layers.keys().collect::<Vec<_>>(), ["axis", "border"]);
    let told: Vec<_> = layers["border"]
        .iter()
        .map(|f| {
            let told = &f["properties"];
            (told["region"].as_u64(), told["pixels"].as_u64(), told["area"].as_f64())
        })
        .collect();
    let expected = [(0, 18 * 12 - 1 - 48 - 32), (1, 48), (2, 16), (3, 16)];
    assert_eq!(told, expected.map(|(r, n)| (Some(r), Some(n), Some(n as f64))));
    assert_eq!(layers["border"][1]["properties"]["color"], "#c81e1e");
    let ring = &layers["border"][2]["geometry"]["coordinates"][0];
    assert_eq!(ring.as_array().unwrap().len(), 5);
    // The middle of the bar: between its last circles, the radius is half its width, but for samples beside the feet.
    let bar: Vec<&Value> =
        layers["axis"].iter().filter(|f| f["properties"]["region"] == 1).collect();
    assert_eq!(bar.len(), 1);
    let told = &bar[0]["properties"];
    assert!((2.0..2.1).contains(&told["radius_max"].as_f64().unwrap()), "{told}");
    assert!((7.0..=9.0).contains(&told["length"].as_f64().unwrap()), "{told}");
    let points = bar[0]["geometry"]["coordinates"].as_array().unwrap();
    assert!(points.iter().all(|p| p[1] == -3.0), "{points:?}");
}

#[test]
fn points_choose_regions_and_combine_them() {
    let (folder, bars) = folder_with_bars();
    let border = |more: &[&str]| medial(&words(&bars, &[&["--layers", "border"], more].concat()));
    let one = border(&["--at", "3,-8"]);
    assert_eq!((one.status, regions_of(one.text())), (Some(0), vec![2]), "{}", one.errors);
    let two = border(&["--at", "3,-8", "--at", "2.5,-2.5"]);
    assert_eq!(regions_of(two.text()), [2, 1]);
    let both = border(&["--at", "3,-8", "--at", "7,-8", "--combine"]);
    let found = features(both.text());
    assert_eq!(found.len(), 1);
    let told = &found[0]["properties"];
    assert_eq!((&told["n_regions"], &told["pixels"]), (&2.into(), &32.into()));
    // One rectangle of 8 by 4.
    assert_eq!(found[0]["geometry"]["coordinates"][0].as_array().unwrap().len(), 5);
    let others = border(&["--remove", "0.5,-0.5"]);
    assert_eq!(regions_of(others.text()), [1, 2, 3]);
    // The same by files.
    let clicks = folder.path().join("clicks.csv");
    for (text, expected) in [
        ("action,x,y\nadd,3,-8\ncombine,7,-8\n", vec![2]),
        ("action,x,y\nadd,3,-8\nadd,7,-8\nremove,3,-8\n", vec![3]),
        ("{\"action\": \"remove\", \"x\": 3, \"y\": -8}\n", vec![0, 1, 3]),
    ] {
        fs::write(&clicks, text).unwrap();
        let run = border(&["--clicks", clicks.to_str().unwrap()]);
        assert_eq!((run.status, regions_of(run.text())), (Some(0), expected), "{}", run.errors);
    }
}

#[test]
fn objects_that_meet_at_a_corner_are_polygons_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let scene = picture(folder.path(), "corner.png", &["...w", ".r..", "..g.", "...."]);
    let both = ["--at", "1.5,-1.5", "--at", "2.5,-2.5", "--combine", "--layers", "border"];
    for more in [&[][..], &["--simplify", "0.1"], &["--engine", "path_tracing"]] {
        let run = medial(&words(&scene, &[&both, more].concat()));
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "nothing was repaired");
        let border = &features(run.text())[0]["geometry"];
        assert_eq!(border["type"], "MultiPolygon");
        let polygons = border["coordinates"].as_array().unwrap();
        // Two squares, of five points each with the last one.
        let n: Vec<usize> = polygons.iter().map(|p| p[0].as_array().unwrap().len()).collect();
        assert_eq!(n, [5, 5], "{border}");
    }
    // What hangs together by corners has one axis.
    let axis = ["--layers", "axis", "--prune", "chord=0.5", "--to", "wkt"];
    let run = medial(&words(&scene, &[&both[..5], &axis].concat()));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    assert_eq!(run.text().lines().count(), 1, "{}", run.text());
    // The same of what changes.
    let before = picture(folder.path(), "before.png", &["rrrr", "r.rr", "rr.r", "rrrr"]);
    let after = picture(folder.path(), "after.png", &["rrrr"; 4]);
    let red = ["--select-color", "c81e1e", "--compare", &after, "--layers", "gained"];
    let run = medial(&words(&before, &red));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let gained = &features(run.text())[0]["geometry"];
    assert_eq!(gained["coordinates"].as_array().unwrap().len(), 2, "{gained}");
}

/// Twice the area of a ring of GeoJSON that runs counterclockwise.
fn twice_area(ring: &Value) -> f64 {
    let points: Vec<[f64; 2]> = serde_json::from_value(ring.clone()).unwrap();
    points.windows(2).map(|p| p[0][0] * p[1][1] - p[0][1] * p[1][0]).sum()
}

/// The rings of a feature of polygons, each polygon's outer one first.
fn polygons_of(feature: &Value) -> Vec<Vec<Value>> {
    let rings = |polygon: &Value| polygon.as_array().unwrap().clone();
    let coordinates = &feature["geometry"]["coordinates"];
    match feature["geometry"]["type"].as_str().unwrap() {
        "Polygon" => vec![rings(coordinates)],
        _ => coordinates.as_array().unwrap().iter().map(rings).collect(),
    }
}

#[test]
fn outer_rings_run_counterclockwise_and_holes_clockwise() {
    // [RFC 7946, 3.1.6], of a red ring around a white spot.
    let folder = tempfile::tempdir().unwrap();
    let ring =
        picture(folder.path(), "ring.png", &["......", ".rrrr.", ".rwwr.", ".rrrr.", "......"]);
    let blank = picture(folder.path(), "blank.png", &["......"; 5]);
    let compared = ["--compare", &blank, "--layers", "change"];
    let segment = [&["segment", &ring][..], &PARTED].concat();
    let image = |more: &[&'static str]| -> Vec<&str> {
        [&["image", &ring][..], &PARTED, &["--layers", "border"], more].concat()
    };
    for args in [
        segment,
        image(&[]),
        image(&["--simplify", "0.1"]),
        image(&["--smooth-border", "0.5"]),
        image(&["--retract", "0.01"]),
        [&["image", &ring][..], &PARTED, &compared].concat(),
    ] {
        let run = medial(&args);
        assert_eq!(run.status, Some(0), "{args:?}: {}", run.errors);
        let mut n_holes = 0;
        for polygon in features(run.text()).iter().flat_map(polygons_of) {
            let areas: Vec<f64> = polygon.iter().map(twice_area).collect();
            assert!(
                areas[0] > 0.0 && areas[1..].iter().all(|&area| area < 0.0),
                "{args:?} {areas:?}"
            );
            n_holes += areas.len() - 1;
        }
        assert!(n_holes > 0, "{args:?}");
    }
}

#[test]
fn smoothed_regions_share_their_borders() {
    let scene = fixture("images/lake.png");
    let (columns, rows) = (120.0, 100.0);
    let run =
        medial(&["image", scene.to_str().unwrap(), "--smooth-border", "1.5", "--layers", "border"]);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let mut ways: BTreeSet<[[u64; 2]; 2]> = BTreeSet::new();
    let mut total = 0.0;
    for ring in features(run.text()).iter().flat_map(polygons_of).flatten() {
        total += 0.5 * twice_area(&ring);
        let points: Vec<[f64; 2]> = serde_json::from_value(ring).unwrap();
        for ends in points.windows(2) {
            let way = [ends[0], ends[1]].map(|p| p.map(f64::to_bits));
            assert!(ways.insert(way), "{ends:?} is run through twice");
        }
    }
    assert!((total - columns * rows).abs() < 1e-6, "{total}: no gap and no overlap");
    // Each side is that of a neighbour, too, or on the frame of the image.
    let is_frame = |[[a, c], [b, d]]: [[u64; 2]; 2]| {
        let [a, b, c, d] = [a, b, c, d].map(f64::from_bits);
        (a == b && (a == 0.0 || a == columns)) || (c == d && (c == 0.0 || c == -rows))
    };
    assert!(ways.iter().all(|&[a, b]| ways.contains(&[b, a]) || is_frame([a, b])));
    assert!(ways.len() > 10_000, "{}", ways.len());
}

#[test]
fn sizes_and_colours_choose_regions() {
    let (_folder, bars) = folder_with_bars();
    let chosen = |more: &[&str]| {
        let run = medial(&words(&bars, &[&["--layers", "border"], more].concat()));
        assert_eq!(run.status, Some(0), "{}", run.errors);
        regions_of(run.text())
    };
    assert_eq!(chosen(&["--max-pixels", "48"]), [1, 2, 3]);
    assert_eq!(chosen(&["--max-pixels", "48", "--min-pixels", "17"]), [1]);
    assert_eq!(chosen(&["--select-color", "c82020,ffffff"]), [1, 3]);
    assert_eq!(chosen(&["--select-color", "c82020", "--select-tolerance", "200"]), [0, 1, 2, 3]);
    assert_eq!(chosen(&["--max-pixels", "20", "--at", "3,-3"]), [2, 3, 1]);
}

#[test]
fn points_that_choose_nothing_are_told() {
    let (folder, bars) = folder_with_bars();
    let clicks = folder.path().join("clicks.csv");
    fs::write(&clicks, "action,x,y\nadd,3,-8\nadd,99,-8\n").unwrap();
    let file = clicks.to_str().unwrap();
    for (more, why) in [
        (
            &["--at", "20,-3"][..],
            "--at: the point 20,-3 is outside of the image, which reaches from 0,-12 to 18,0",
        ),
        (
            &["--at", "17.5,-11.5"],
            "--at: the point 17.5,-11.5 is on a pixel without data (column 17, row 11)",
        ),
        (&["--clicks", file], "clicks.csv: line 3: the point 99,-8 is outside"),
        (
            &["--at", "3,-8", "--remove", "3,-3"],
            "--remove: the point 3,-3 is in region 1, which is not chosen",
        ),
        (&["--min-pixels", "5000"], "none of its 4 regions is chosen"),
    ] {
        let run = medial(&words(&bars, more));
        assert_eq!((run.status, run.text()), (Some(1), ""), "{more:?}");
        assert!(run.errors.contains(why) && run.errors.lines().count() == 1, "{}", run.errors);
    }
    for (text, why) in [
        (
            "action,x,y\npaint,3,-8\n",
            "line 2: \"paint\" is no action; known are add, combine, remove",
        ),
        ("x;y\n1;2\n", "line 1, column 1: the first row has to name the columns x and y"),
    ] {
        fs::write(&clicks, text).unwrap();
        let run = medial(&words(&bars, &["--clicks", file]));
        assert_eq!(run.status, Some(1));
        assert!(run.errors.contains(why), "{}", run.errors);
    }
}

#[test]
fn graphs_come_in_layers() {
    let (_folder, bars) = folder_with_bars();
    let layers = ["--layers", "border,delaunay,crust,dual,axis"];
    let run = medial(&words(&bars, &[&["--at", "3,-3"], &layers[..]].concat()));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let layers = by_layer(run.text());
    assert_eq!(layers.len(), 5);
    let n = |layer: &str| layers[layer][0]["geometry"]["coordinates"].as_array().unwrap().len();
    // The bar has 32 sides of pixels, and a sample on each and between them. Of n samples on the border of a shape
    // without holes, n edges are the border, and a triangulation has 2n - 3.
    assert_eq!((n("crust"), n("delaunay")), (64, 2 * 64 - 3));
    assert_eq!(layers["dual"][0]["geometry"]["type"], "MultiLineString");
    // A tree: fewer edges than triangles, as many are one where samples lie on a circle.
    assert!(n("dual") < 64 - 2, "{}", n("dual"));
}

#[test]
fn simplified_regions_fit_and_are_for_exact_engines_too() {
    let folder = tempfile::tempdir().unwrap();
    // Two triangles of pixels that fill a square.
    let rows: Vec<String> =
        (0..20).map(|y| (0..20).map(|x| if x + y < 20 { 'r' } else { 'g' }).collect()).collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let picture = picture(folder.path(), "slope.png", &rows);
    let simple = ["--simplify", "0.8", "--layers", "border,axis", "--engine"];
    let run =
        medial(&words(&picture, &[&simple[..], &["path_tracing", "--prune", "none"]].concat()));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let layers = by_layer(run.text());
    let corners = |k: usize| layers["border"][k]["geometry"]["coordinates"][0].as_array().unwrap();
    assert!(corners(0).len() <= 6 && corners(1).len() <= 6, "{:?}", layers["border"]);
    // Their common border is the same points.
    let shared = corners(0).iter().filter(|p| corners(1).contains(p)).count();
    assert!(shared >= 2, "{shared}");
    assert_eq!(layers["axis"][0]["properties"]["engine"], "path_tracing");
    // The samples of the simplified border are half a pixel apart, and the axis has few branches.
    let run = medial(&words(&picture, &[&simple[..], &["delaunay_dual"]].concat()));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(by_layer(run.text())["axis"].len() <= 6);
}

#[test]
fn pictures_show_the_image_below_its_layers() {
    let (folder, bars) = folder_with_bars();
    let svg = medial(&words(&bars, &["--to", "svg", "--layers", "border,dual,axis"]));
    assert_eq!(svg.status, Some(0), "{}", svg.errors);
    let text = svg.text();
    let place = |part: &str| text.find(part).unwrap_or_else(|| panic!("{part}"));
    let order = ["data:image/png;base64,", "class=\"border\"", "class=\"dual\"", "class=\"axis\""];
    assert!(order.map(place).is_sorted());
    let png = folder.path().join("layers.png");
    let run = medial(&words(&bars, &["-o", png.to_str().unwrap(), "--window", "0,-5,10,0"]));
    assert_eq!((run.status, run.text()), (Some(0), ""), "{}", run.errors);
    let header = fs::read(&png).unwrap();
    // 10 by 5 pixels as 1000 by 500, 28 around, 34 above and 64 below, twice.
    let size = |at: usize| u32::from_be_bytes(header[at..at + 4].try_into().unwrap());
    assert_eq!((size(16), size(20)), (2112, 2 * (500 + 56 + 34 + 64)));
    let run = medial(&words(&bars, &["--to", "svg", "--window", "100,100,110,110"]));
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("no pixel in --window"), "{}", run.errors);
}

#[test]
fn tables_hold_one_layer_and_a_geopackage_all() {
    let (folder, bars) = folder_with_bars();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let run = medial(&words(&bars, &["-o", &path("axes.fgb")]));
    assert_eq!(run.status, Some(2));
    let why = "the format fgb holds one layer, and here are border, axis; name one with --layers, or write gpkg";
    assert!(run.errors.contains(why), "{}", run.errors);
    assert_eq!(names(folder.path()), ["bars.png"]);
    // One layer has the name of the file, and its polygons have axes.
    let file = path("one.gpkg");
    let run = medial(&words(&bars, &["-o", &file, "--layers", "border"]));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let run = medial(&["axis", &file, "--to", "wkt"]);
    assert_eq!((run.status, run.text().lines().count()), (Some(0), 4), "{}", run.errors);
    // Several have names of their own.
    let file = path("all.gpkg");
    let run = medial(&words(&bars, &["-o", &file, "--layers", "border,dual,axis"]));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let run = medial(&["axis", &file, "--layer", "border", "--to", "wkt"]);
    assert_eq!((run.status, run.text().lines().count()), (Some(0), 4), "{}", run.errors);
    let run = medial(&["axis", &file, "--layer", "dual", "--to", "wkt"]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("feature 3: is a MultiLineString"), "{}", run.errors);
    let run = medial(&["axis", &file]);
    assert!(run.errors.contains("`border`, `dual`, `axis`"), "{}", run.errors);
    assert_eq!(names(folder.path()), ["all.gpkg", "bars.png", "one.gpkg"]);
    // Layers without features are there, too: nothing has changed.
    let file = path("same.gpkg");
    let run = medial(&words(&bars, &["--compare", &bars, "-o", &file]));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let run = medial(&["axis", &file, "--layer", "change", "--to", "wkt"]);
    assert_eq!((run.status, run.text().lines().count()), (Some(0), 4), "{}", run.errors);
    let run = medial(&["axis", &file, "--layer", "gained"]);
    assert!(run.errors.contains("there are no features"), "{}", run.errors);
}

#[test]
fn what_became_of_regions_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let before =
        picture(folder.path(), "before.png", &["......", ".rr.g.", ".rr...", "......", "...w.."]);
    let after =
        picture(folder.path(), "after.png", &["......", ".rrr..", ".rrr..", "......", "g..w.."]);
    let run = medial(&words(&before, &["--max-pixels", "8", "--compare", &after]));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let layers = by_layer(run.text());
    let told = |layer: &str, name: &str| -> Vec<Value> {
        layers[layer].iter().map(|f| f["properties"][name].clone()).collect()
    };
    assert_eq!(told("change", "change"), ["changed", "vanished", "same", "appeared"]);
    let areas =
        |name: &str| told("change", name).iter().map(|v| v.as_f64().unwrap()).collect::<Vec<_>>();
    assert_eq!(areas("area"), [4.0, 1.0, 1.0, 0.0]);
    assert_eq!(areas("area_after"), [6.0, 0.0, 1.0, 1.0]);
    assert_eq!(areas("area_changed"), [2.0, 1.0, 0.0, 1.0]);
    assert!((areas("overlap")[0] - 4.0 / 6.0).abs() < 1e-12);
    assert_eq!(told("gained", "change"), ["changed", "appeared"]);
    assert_eq!(told("lost", "change"), ["vanished"]);
    let gained = &layers["gained"][0]["geometry"]["coordinates"][0];
    assert_eq!(gained[0], serde_json::json!([3.0, -1.0]));
    // One table row a change.
    let csv = medial(&words(
        &before,
        &["--max-pixels", "8", "--compare", &after, "--layers", "change", "--to", "csv"],
    ));
    assert_eq!((csv.status, csv.text().lines().count()), (Some(0), 5), "{}", csv.errors);
    let other = picture(folder.path(), "other.png", &["  ", "rr"]);
    let run = medial(&words(&before, &["--compare", &other]));
    assert_eq!(run.status, Some(0), "{}", run.errors);
}

/// The changes between two pictures, one row of CSV each, as `change` and the pixels before and after.
fn changes(before: &str, after: &str, more: &[&str]) -> Vec<[String; 3]> {
    let compared = ["--compare", after, "--layers", "change", "--to", "csv"];
    let run = medial(&words(before, &[&compared, more].concat()));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let mut rows = csv::Reader::from_reader(run.text().as_bytes());
    let names = rows.headers().unwrap().clone();
    let place = |name: &str| names.iter().position(|other| other == name).unwrap();
    let places = ["change", "pixels", "pixels_after"].map(place);
    rows.records().map(|row| places.map(|k| row.as_ref().unwrap()[k].to_owned())).collect()
}

#[test]
fn all_that_is_chosen_may_vanish_or_appear() {
    let folder = tempfile::tempdir().unwrap();
    let wet = picture(folder.path(), "wet.png", &["......", ".rr...", "......"]);
    let dry = picture(folder.path(), "dry.png", &["......", "......", "......"]);
    let red = ["--select-color", "c81e1e"];
    assert_eq!(changes(&wet, &dry, &red), [["vanished", "2", "0"]]);
    assert_eq!(changes(&dry, &wet, &red), [["appeared", "0", "2"]]);
    let run = medial(&words(&dry, &[&["--compare", &dry][..], &red].concat()));
    assert_eq!((run.status, run.text()), (Some(1), ""));
    let why = format!("none of its 1 regions is chosen, nor of the 1 of {dry}; see them");
    assert!(run.errors.contains(&why), "{}", run.errors);
}

#[test]
fn images_of_other_kinds_and_systems_are_not_compared() {
    let folder = tempfile::tempdir().unwrap();
    let name = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [east, west, bare, heights] = ["east.tif", "west.tif", "bare.tif", "heights.tif"].map(name);
    let rows = ["....", ".rr.", "...."];
    for (file, epsg) in [(&east, 32633), (&west, 32632), (&bare, 0)] {
        geotiff(Path::new(file), &rows, epsg);
    }
    geotiff_of_numbers(Path::new(&heights), &[&[1.0, 2.0, 2.0, 1.0][..]; 3], 32633);
    for (after, why) in [
        (&west, "the reference system is EPSG:32633, that of "),
        (&heights, "the image has colours, "),
    ] {
        let run = medial(&words(&east, &["-q", "--compare", after]));
        assert_eq!((run.status, run.text()), (Some(1), ""), "{}", run.errors);
        assert!(run.errors.contains(why) && run.errors.lines().count() == 1, "{}", run.errors);
    }
    // What has no system may be in any.
    assert_eq!(changes(&east, &bare, &["--max-pixels", "9"]), [["same", "2", "2"]]);
}

#[test]
fn limits_are_in_units_of_the_band() {
    let folder = tempfile::tempdir().unwrap();
    let [before, after] = ["before.tif", "after.tif"].map(|name| folder.path().join(name));
    let middle = [280.0, 300.0, 300.0, 280.0, 280.0];
    geotiff_of_numbers(&before, &[&[280.0; 5], &middle, &[280.0; 5]], 0);
    // The same but for one hot pixel.
    geotiff_of_numbers(&after, &[&[280.0; 5], &middle, &[280.0, 280.0, 280.0, 280.0, 900.0]], 0);
    let [before, after] = [before, after].map(|path| path.to_str().unwrap().to_owned());
    let cut = |limits| ["--method", "threshold", "--limits", limits, "--to", "csv"];
    let run = medial(&[&["segment", &before][..], &cut("290")].concat());
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    assert_eq!(run.text().lines().count(), 3, "{}", run.text());
    let compared = ["--max-pixels", "2", "--compare", &after, "--layers", "change"];
    let run = medial(&[&["image", &before][..], &cut("290,600"), &compared].concat());
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let told = run.text();
    assert_eq!(told.lines().count(), 3, "{told}");
    assert!(told.contains("same") && told.contains("appeared"), "{told}");
    // The mean of both is the same, as bands are stretched alike.
    let mut rows = csv::Reader::from_reader(told.as_bytes());
    let distance = rows.headers().unwrap().iter().position(|name| name == "color_distance");
    assert_eq!(&rows.records().next().unwrap().unwrap()[distance.unwrap()], "0");
    let why =
        "the limit 600 has all values, which go from 280 to 300, on one side, and parts nothing";
    assert!(run.errors.contains(why) && run.errors.lines().count() == 1, "{}", run.errors);
}

#[test]
fn what_only_one_image_shows_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let wide = picture(folder.path(), "wide.png", &["......", ".r..r.", "..w..."]);
    let narrow = picture(folder.path(), "narrow.png", &["...", ".r.", "..w"]);
    let more = ["--select-color", "c81e1e", "--layers", "change", "--to", "csv"];
    let run = medial(&words(&wide, &[&["--compare", &narrow][..], &more].concat()));
    assert_eq!((run.status, run.text().lines().count()), (Some(0), 2), "{}", run.errors);
    let why = "wide.png: 1 of the 2 pixels of its objects lie where only one image has data, 1 objects as a whole";
    assert!(run.errors.contains(why) && run.errors.lines().count() == 1, "{}", run.errors);
    let run = medial(&words(&narrow, &[&["--compare", &wide][..], &more].concat()));
    assert!(run.errors.contains("1 of the 2 pixels of the objects of "), "{}", run.errors);
    // No warning where nothing is left out.
    let run = medial(&words(&wide, &[&["--compare", &wide][..], &more].concat()));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
}

#[test]
fn options_that_contradict_one_another_are_told() {
    let (_folder, bars) = folder_with_bars();
    for (more, why) in [
        (
            &["--layers", "dual", "--engine", "path_tracing"][..],
            "--layers dual is for --engine delaunay_dual",
        ),
        (&["--layers", "gained"], "--layers gained is for --compare"),
        (&["--compare", &bars, "--layers", "axis"], "--layers axis is not for --compare"),
        (&["--compare", &bars, "--prune", "none"], "--prune is not for --compare"),
        (&["--simplify", "1", "--smooth-border", "1"], "leave one out"),
        (
            &["--spacing", "1", "--engine", "path_tracing"],
            "--spacing is for --engine delaunay_dual",
        ),
        (&["--min-pixels", "9", "--max-pixels", "3"], "at least 9 and at most 3 pixels"),
        (&["--window", "0,0,1,1"], "--window is for svg and png, not for geojson"),
        (&["--to", "rings"], "layers are written as geojson"),
        (&["--color", "ffffff"], "--color is for --method colours"),
        (&["--min-overlap", "0.5"], "--compare"),
        (&["--combine"], "--at"),
    ] {
        let run = medial(&words(&bars, more));
        assert_eq!((run.status, run.text()), (Some(2), ""), "{more:?}: {}", run.errors);
        assert!(run.errors.contains(why), "{more:?}: {}", run.errors);
    }
}

#[test]
fn reports_timings_and_progress_are_those_of_other_commands() {
    let (folder, bars) = folder_with_bars();
    let [report, timings] = ["report.json", "timings.json"].map(|name| folder.path().join(name));
    for command in ["image", "segment"] {
        let more = [
            "--report",
            report.to_str().unwrap(),
            "--timings",
            timings.to_str().unwrap(),
            "--progress",
            "always",
        ];
        let run = medial(&[&[command, &bars][..], &PARTED, &more].concat());
        assert_eq!(run.status, Some(0), "{}", run.errors);
        assert!(run.errors.contains("progress: parting the image"), "{}", run.errors);
        assert!(run.errors.contains("progress: 4 of 4 features"), "{}", run.errors);
        let told: Value = serde_json::from_slice(&fs::read(&report).unwrap()).unwrap();
        assert_eq!((&told["n_features"], &told["done"]), (&4.into(), &4.into()));
        let features = told["features"].as_array().unwrap();
        let entries = features.iter().flat_map(|f| f["entries"].as_array().unwrap());
        let n_sampled = entries.filter(|entry| entry["code"] == "sampling").count();
        assert_eq!(n_sampled, if command == "image" { 4 } else { 0 }, "{told}");
        let told: Value = serde_json::from_slice(&fs::read(&timings).unwrap()).unwrap();
        assert!(told["engine"].as_f64().unwrap() > 0.0);
    }
    // Nothing but errors where standard error is no terminal.
    assert_eq!(medial(&words(&bars, &[])).errors, "");
}

#[test]
fn rings_that_the_command_makes_are_not_reported_as_reversed() {
    let (folder, bars) = folder_with_bars();
    let report = folder.path().join("report.json");
    let report = ["--report", report.to_str().unwrap()];
    for (command, more) in [
        ("image", &[][..]),
        ("image", &["--simplify", "0.2"]),
        ("image", &["--compare", &bars]),
        ("segment", &[]),
    ] {
        let run = medial(&[&[command, &bars][..], &PARTED, &report, more].concat());
        assert_eq!(run.status, Some(0), "{}", run.errors);
        let told: Value = serde_json::from_slice(&fs::read(report[1]).unwrap()).unwrap();
        let features = told["features"].as_array().unwrap();
        let entries = features.iter().flat_map(|f| f["entries"].as_array().unwrap());
        let codes: Vec<&Value> = entries.map(|entry| &entry["code"]).collect();
        // Corners stay where regions meet, although the border of one of them is straight there.
        let is_true = |code: &&Value| *code == "sampling" || *code == "straight_corner";
        assert!(codes.iter().all(is_true), "{command} {more:?}: {codes:?}");
    }
}

#[test]
fn an_image_that_takes_too_long_to_part_is_given_up() {
    let folder = tempfile::tempdir().unwrap();
    let row = "r.g.w".repeat(60);
    let rows = vec![row.as_str(); 300];
    let picture = picture(folder.path(), "large.png", &rows);
    let words = ["image", &picture, "--method", "mean-shift", "--spatial", "60", "--range", "90"];
    let run = medial(&[&words[..], &["--max-seconds", "0.05"]].concat());
    assert_eq!((run.status, run.text()), (Some(1), ""), "{}", run.errors);
    assert!(run.errors.contains("takes longer to be parted"), "{}", run.errors);
}

/// A JPEG image of 16 by 8 pixels in four inks: red, and cyan beside it.
const CMYK: &[u8] = b"\
    \xff\xd8\xff\xee\x00\x0e\x41\x64\x6f\x62\x65\x00\x64\x00\x00\x00\x00\x00\xff\xdb\x00\x43\x00\x0d\x09\x0a\
    \x0b\x0a\x08\x0d\x0b\x0a\x0b\x0e\x0e\x0d\x0f\x13\x20\x15\x13\x12\x12\x13\x27\x1c\x1e\x17\x20\x2e\x29\x31\
    \x30\x2e\x29\x2d\x2c\x33\x3a\x4a\x3e\x33\x36\x46\x37\x2c\x2d\x40\x57\x41\x46\x4c\x4e\x52\x53\x52\x32\x3e\
    \x5a\x61\x5a\x50\x60\x4a\x51\x52\x4f\xff\xc0\x00\x14\x08\x00\x08\x00\x10\x04\x43\x11\x00\x4d\x11\x00\x59\
    \x11\x00\x4b\x11\x00\xff\xc4\x00\x16\x00\x01\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\
    \x07\x08\x00\xff\xc4\x00\x14\x10\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\xff\
    \xda\x00\x0e\x04\x43\x00\x4d\x00\x59\x00\x4b\x00\x00\x3f\x00\x4e\x18\x0c\x09\xc9\x89\x4e\xa9\xd6\x7f\xff\
    \xd9";

/// An image of every kind that readers meet, of 8 by 6 pixels: its name and its bytes.
fn kinds(folder: &Path) -> Vec<(&'static str, PathBuf, usize)> {
    let png_of = |name: &str,
                  color: png::ColorType,
                  depth: png::BitDepth,
                  palette: Option<Vec<u8>>,
                  data: Vec<u8>| {
        let path = folder.join(name);
        let mut encoder = png::Encoder::new(fs::File::create(&path).unwrap(), 8, 6);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if let Some(palette) = palette {
            encoder.set_palette(palette);
        }
        encoder.write_header().unwrap().write_image_data(&data).unwrap();
        path
    };
    let is_in = |k: usize| (2..5).contains(&(k % 8)) && (1..4).contains(&(k / 8));
    let words = |k: usize| if is_in(k) { [0xFF, 0xFF, 0, 0, 0, 0] } else { [0, 0, 0, 0, 0x80, 0] };
    let inks = folder.join("inks.jpg");
    fs::write(&inks, CMYK).unwrap();
    vec![
        ("four inks", inks, 2),
        (
            "16 bits",
            png_of(
                "wide.png",
                png::ColorType::Rgb,
                png::BitDepth::Sixteen,
                None,
                (0..48).flat_map(words).collect(),
            ),
            2,
        ),
        (
            "a palette",
            png_of(
                "palette.png",
                png::ColorType::Indexed,
                png::BitDepth::Eight,
                Some(vec![0, 0, 128, 255, 0, 0]),
                (0..48).map(|k| u8::from(is_in(k))).collect(),
            ),
            2,
        ),
        (
            "grey",
            png_of(
                "grey.png",
                png::ColorType::Grayscale,
                png::BitDepth::Eight,
                None,
                (0..48).map(|k| if is_in(k) { 200 } else { 20 }).collect(),
            ),
            2,
        ),
        (
            "transparency",
            png_of(
                "clear.png",
                png::ColorType::Rgba,
                png::BitDepth::Eight,
                None,
                (0..48)
                    .flat_map(|k| if is_in(k) { [255, 0, 0, 255] } else { [0, 0, 0, 0] })
                    .collect(),
            ),
            1,
        ),
        (
            "one colour only",
            png_of(
                "flat.png",
                png::ColorType::Rgb,
                png::BitDepth::Eight,
                None,
                [9, 99, 200].repeat(48),
            ),
            1,
        ),
    ]
}

#[test]
fn images_of_every_kind_give_their_regions() {
    let folder = tempfile::tempdir().unwrap();
    for (kind, path, n_regions) in kinds(folder.path()) {
        let words = ["--method", "mean_shift", "--spatial", "3", "--min-region", "1"];
        let run = medial(&[&["image", path.to_str().unwrap()][..], &words].concat());
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{kind}");
        assert_eq!(by_layer(run.text())["border"].len(), n_regions, "{kind}");
        assert!(by_layer(run.text()).contains_key("axis"), "{kind}");
    }
}

#[test]
fn images_without_data_or_cut_off_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let clear = picture(folder.path(), "clear.png", &["    ", "    "]);
    let run = medial(&["image", &clear]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("has no pixel with data"), "{}", run.errors);
    let whole = picture(folder.path(), "whole.png", &BARS);
    let bytes = fs::read(&whole).unwrap();
    let broken = folder.path().join("broken.png");
    for length in [0, 7, 20, 40, bytes.len() / 2, bytes.len() - 14] {
        fs::write(&broken, &bytes[..length]).unwrap();
        let run = medial(&["image", broken.to_str().unwrap()]);
        assert_eq!((run.status, run.text()), (Some(1), ""), "{length}: {}", run.errors);
        assert!(
            run.errors.starts_with("error: ") && run.errors.lines().count() == 1,
            "{}",
            run.errors
        );
    }
    let cut = folder.path().join("cut.jpg");
    for length in [3, 60, 120, CMYK.len() / 2] {
        fs::write(&cut, &CMYK[..length]).unwrap();
        let run = medial(&["image", cut.to_str().unwrap()]);
        assert_eq!((run.status, run.text()), (Some(1), ""), "{length}: {}", run.errors);
        assert!(run.errors.contains("save it again as JPEG or PNG"), "{}", run.errors);
    }
    let run = medial_with(&["image", "-", "--from", "geojson"], "{}");
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("is geojson, no image"), "{}", run.errors);
    let run = medial_with(&["image", "-"], "just text");
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("no image"), "{}", run.errors);
}

/// A GeoTIFF of letters, `r` red and others blue, with pixels of 2 by 2 from (100, 50) on downwards, in a reference
/// system of EPSG, or none for 0.
fn geotiff(path: &Path, rows: &[&str], epsg: u16) {
    let colour = |letter: u8| if letter == b'r' { [200, 30, 30] } else { [30, 40, 180] };
    let pixels: Vec<u8> = rows.iter().flat_map(|row| row.bytes()).flat_map(colour).collect();
    tiff(path, [rows[0].len() as u32, rows.len() as u32], 3, &pixels, epsg);
}

/// One of real numbers.
fn geotiff_of_numbers(path: &Path, rows: &[&[f32]], epsg: u16) {
    let pixels: Vec<u8> = rows.iter().copied().flatten().flat_map(|v| v.to_le_bytes()).collect();
    tiff(path, [rows[0].len() as u32, rows.len() as u32], 1, &pixels, epsg);
}

/// One of three bytes a pixel, or of one number.
fn tiff(path: &Path, [columns, n_rows]: [u32; 2], each: u32, pixels: &[u8], epsg: u16) {
    let doubles = [2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 100.0, 50.0, 0.0_f64];
    let keys = [1, 1, 0, 1, 3072, 0, 1, epsg];
    // A header of 8 bytes, the pixels, their depths, the doubles, the keys, then the directory.
    let [depths, numbers] = [8 + pixels.len() as u32, 14 + pixels.len() as u32];
    let keys_at = numbers + 72;
    let directory = keys_at + 16;
    let mut bytes = [b"II\x2a\0", &directory.to_le_bytes()[..], pixels].concat();
    bytes.extend([8_u16; 3].into_iter().flat_map(u16::to_le_bytes));
    bytes.extend(doubles.into_iter().flat_map(f64::to_le_bytes));
    bytes.extend(keys.into_iter().flat_map(u16::to_le_bytes));
    let is_real = each == 1;
    // Tag, kind (3 for 16 bits, 4 for 32, 12 for doubles), count, and a value or where it is.
    let entries: [(u16, u16, u32, u32); 13] = [
        (256, 4, 1, columns),
        (257, 4, 1, n_rows),
        (258, 3, each, if is_real { 32 } else { depths }),
        (259, 3, 1, 1),
        (262, 3, 1, if is_real { 1 } else { 2 }),
        (273, 4, 1, 8),
        (277, 3, 1, each),
        (278, 4, 1, n_rows),
        (279, 4, 1, pixels.len() as u32),
        (339, 3, 1, if is_real { 3 } else { 1 }),
        (33550, 12, 3, numbers),
        (33922, 12, 6, numbers + 24),
        (34735, 3, 8, keys_at),
    ];
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend([tag, kind].into_iter().flat_map(u16::to_le_bytes));
        bytes.extend([count, value].into_iter().flat_map(u32::to_le_bytes));
    }
    bytes.extend([0; 4]);
    fs::write(path, bytes).unwrap();
}

#[test]
fn points_and_layers_are_in_the_plane_of_a_georeferenced_image() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.tif");
    geotiff(&scene, &["......", ".rrrr.", ".rrrr.", "......"], 0);
    let run = medial(&words(scene.to_str().unwrap(), &["--at", "105,47", "--prune", "none"]));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let layers = by_layer(run.text());
    let border = &layers["border"][0];
    assert_eq!(border["properties"]["area"], 32.0);
    let ring = &border["geometry"]["coordinates"][0];
    assert_eq!(ring[0], serde_json::json!([102.0, 48.0]));
    let widest = |f: &Value| f["properties"]["radius_max"].as_f64().unwrap();
    let radius = layers["axis"].iter().map(widest).fold(0.0, f64::max);
    assert!((2.0..2.1).contains(&radius), "{radius}");
    let outside = medial(&words(scene.to_str().unwrap(), &["--at", "3,-2"]));
    assert_eq!(outside.status, Some(1));
    assert!(outside.errors.contains("which reaches from 100,42 to 112,50"), "{}", outside.errors);
}

#[test]
fn pictures_tell_where_they_lie() {
    let folder = tempfile::tempdir().unwrap();
    let name = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [scene, bare] = [name("scene.tif"), name("bare.tif")];
    geotiff(Path::new(&scene), &["......", ".rrrr.", "......"], 32633);
    geotiff(Path::new(&bare), &["......", ".rrrr.", "......"], 0);
    // The regions, a pixel for each: the centre of the first one is half of 2 by 2 from (100, 50).
    let run = medial(&["segment", &scene, "-o", &name("regions.png")]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert_eq!(fs::read_to_string(name("regions.pgw")).unwrap(), "2\n0\n0\n-2\n101\n49\n");
    assert!(fs::read_to_string(name("regions.prj")).unwrap().starts_with("PROJCS[\"WGS 84 / UTM"));
    // The layers: 12 units are 1000 pixels, twice, with 28 pixels to the left and 62 above.
    for more in [&[][..], &["--compare", &scene]] {
        let layers = name("layers.png");
        let run = medial(&words(&scene, &[&["-o", &layers], more].concat()));
        assert_eq!(run.status, Some(0), "{}", run.errors);
        let told = fs::read_to_string(name("layers.pgw")).unwrap();
        let told: Vec<f64> = told.lines().map(|line| line.parse().unwrap()).collect();
        let step = 12.0 / 2000.0;
        let expected =
            [step, 0.0, 0.0, -step, 100.0 - 55.5 * step, 50.0 + (2.0 * 62.0 - 0.5) * step];
        assert!(told.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{told:?}");
        fs::remove_file(name("layers.pgw")).unwrap();
    }
    assert!(Path::new(&name("layers.prj")).exists());
    let svg = medial(&words(&scene, &["--to", "svg"]));
    assert!(svg.text().contains("EPSG/0/32633\" svg:transform=\"matrix("), "{}", svg.errors);
    // Without a system there is no text for it, and what has no place tells none.
    let run = medial(&["segment", &bare, "-o", &name("bare.png")]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(Path::new(&name("bare.pgw")).exists() && !Path::new(&name("bare.prj")).exists());
    let plain = picture(folder.path(), "plain.png", &["....", ".rr.", "...."]);
    let run = medial(&words(&plain, &["-o", &name("drawn.png")]));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(!Path::new(&name("drawn.pgw")).exists());
}
