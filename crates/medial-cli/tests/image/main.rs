//! From a colour picture to the axes of its features, as a user meets them.

mod borders;
mod changes;
#[path = "../common/mod.rs"]
mod common;
mod kinds;
mod places;

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
        ("x y\n1 2\n", "line 1, column 1: the first row has to name the columns x and y"),
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
        (
            &["--measures", "chord", "--to", "wkt"],
            "--measures is for geojson, geojsonl, csv and tables",
        ),
        (&["--measures", "chord", "--layers", "border"], "name it in --layers"),
        (&["--compare", &bars, "--measures", "chord"], "--measures is not for --compare"),
        (&["--labels", "-"], "--labels needs a file of its own"),
        (&["-o", "x.png", "--report", "x.pgw"], "--report needs a file of its own"),
        (&["--compare", "-", "--clicks", "-"], "standard input is named twice"),
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

#[test]
fn nodes_of_the_dual_graph_are_told_by_their_kind() {
    let (_folder, bars) = folder_with_bars();
    let run =
        medial(&words(&bars, &["--at", "3,-3", "--layers", "dual,nodes", "--retract", "0.3"]));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let layers = by_layer(run.text());
    let edges = layers["dual"][0]["geometry"]["coordinates"].as_array().unwrap().len();
    let nodes = &layers["nodes"];
    // A tree.
    assert_eq!(nodes.len(), edges + 1);
    let count = |kind: &str| nodes.iter().filter(|n| n["properties"]["kind_start"] == kind).count();
    let kinds = ["dangling", "internal", "ramification_1", "ramification_2"].map(count);
    assert_eq!(kinds.iter().sum::<usize>(), nodes.len());
    assert!(kinds[0] >= 2 && kinds[1] > 4 && kinds[2] >= 2 && kinds[3] == 0, "{kinds:?}");
    assert!(nodes.iter().all(|n| n["properties"]["radius_min"].as_f64().unwrap() <= 2.1));
    let run = medial(&words(&bars, &["--layers", "nodes", "--engine", "path_tracing"]));
    assert!(run.errors.contains("--layers nodes is for --engine delaunay_dual"), "{}", run.errors);
}

#[test]
fn measures_tell_every_level_of_an_axis() {
    let (_folder, bars) = folder_with_bars();
    let all = ["--at", "3,-3", "--layers", "axis", "--by", "path", "--prune", "none"];
    let run = medial(&words(&bars, &[&all[..], &["--measures", "chord,erosion"]].concat()));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let lines = features(run.text());
    let chord = |f: &Value| f["properties"]["chord"].as_f64();
    let length = |f: &Value| f["properties"]["length"].as_f64().unwrap();
    let above = |value: f64| -> f64 {
        lines.iter().filter(|f| chord(f).unwrap() > value).map(length).sum()
    };
    // Half of the outline less the height of the bar.
    let most = lines.iter().filter_map(chord).fold(0.0, f64::max);
    assert!((11.0..13.0).contains(&most), "{most}");
    assert!(above(0.0) > above(1.0) && above(1.0) > above(4.0) && above(4.0) > 0.0);
    for pruned in [2.0, 4.0] {
        let prune = format!("chord={pruned}");
        let level = ["--at", "3,-3", "--layers", "axis", "--by", "path", "--prune", &prune];
        let run = medial(&words(&bars, &level));
        let kept: f64 = features(run.text()).iter().map(length).sum();
        // Lines that cross the level are counted whole.
        assert!((kept - above(pruned)).abs() < 2.0, "{kept} above {pruned}, {}", above(pruned));
    }
    // By what is not the engine's own, too.
    let run = medial(&words(&bars, &["--layers", "axis", "--prune", "excess=1"]));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
}
