//! The engine `delaunay_dual` as a user meets it: polygons, images, points.

mod common;

use common::{fixture, medial, medial_with};
use serde_json::Value;
use std::fs;
use std::path::Path;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";

const ENGINE: [&str; 2] = ["--engine", "delaunay-dual"];

#[test]
fn a_polygon_has_the_branches_of_its_axis_and_no_defect() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (domain, axis, report) = (path("a.wkt"), path("a.json"), path("report.json"));
    fs::write(&domain, RECTANGLE).unwrap();
    let args = ["axis", &domain, "--spacing", "0.25", "-o", &axis, "--report", &report];
    let run = medial(&[&args[..], &ENGINE].concat());
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let told: Value = serde_json::from_str(&fs::read_to_string(&axis).unwrap()).unwrap();
    assert_eq!(told["engine"], "delaunay_dual");
    assert_eq!(told["accuracy"]["sampled"], 0.25);
    let checked = medial(&["check", &domain, &axis]);
    assert_eq!(checked.status, Some(0), "{}", checked.text());
    let report: Value = serde_json::from_str(&fs::read_to_string(&report).unwrap()).unwrap();
    let entry = &report["features"][0]["entries"][0];
    assert_eq!((&entry["action"], &entry["code"]), (&"sampled".into(), &"sampling".into()));
    assert!(entry["message"].as_str().unwrap().starts_with("64 samples"), "{entry}");
    let lines = medial_with(
        &[&["axis", "-", "--spacing", "0.25", "--to", "geojsonl"][..], &ENGINE].concat(),
        RECTANGLE,
    );
    assert_eq!(lines.text().lines().count(), 5, "{}", lines.text());
}

#[test]
fn both_sides_are_found() {
    let notch = "POLYGON ((0 0, 4 0, 4 4, 2 1, 0 4, 0 0))";
    let args = ["axis", "-", "--side", "both", "--to", "json"];
    let run = medial_with(&[&args[..], &ENGINE].concat(), notch);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let sides: Vec<Value> =
        run.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((&sides[0]["side"], &sides[1]["side"]), (&"interior".into(), &"exterior".into()));
    let clipped = sides[1]["keypoints"].as_array().unwrap();
    assert_eq!(clipped.iter().filter(|keypoint| keypoint["kind"] == "clipped").count(), 1);
}

#[test]
fn hairs_of_images_go_in_several_ways() {
    let image = fixture("images/horse.png");
    let ends = |words: &[&str]| -> usize {
        let args = ["axis", image.to_str().unwrap(), "--invert", "--to", "json"];
        let run = medial(&[&args[..], &ENGINE, words].concat());
        assert_eq!(run.status, Some(0), "{}", run.errors);
        let axis: Value = serde_json::from_str(run.text()).unwrap();
        let keypoints = axis["keypoints"].as_array().unwrap();
        keypoints.iter().filter(|keypoint| keypoint["kind"] == "tip").count()
    };
    let (usual, all) = (ends(&[]), ends(&["--prune", "none"]));
    assert!((5..40).contains(&usual) && all > 10 * usual, "{usual} {all}");
    assert!(ends(&["--prune", "leaf"]) < all);
    assert!(ends(&["--prune", "chord=8"]) < usual);
    let fine = ends(&["--prune", "chord=0.1"]);
    assert!(2 * ends(&["--prune", "chord=0.1", "--smooth-border", "1.5"]) < fine);
    assert!(2 * ends(&["--prune", "chord=0.1", "--retract", "1"]) < fine);
}

#[test]
fn points_without_order_have_a_border_and_an_axis() {
    let points: String = (0..80)
        .map(|k| 7 * k % 80)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 80.0).sin_cos();
            format!("{},{}\n", 4.0 * cos, 2.0 * sin)
        })
        .collect();
    let args = ["axis", "-", "--from", "csv", "--to", "json"];
    let run = medial_with(&[&args[..], &ENGINE].concat(), &format!("x,y\n{points}50,50\n"));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(run.errors.contains("1 point lies on no closed border"), "{}", run.errors);
    let axis: Value = serde_json::from_str(run.text()).unwrap();
    // The ellipse has half axes of 4 and 2, so the middle disk has radius 2.
    let radii = axis["keypoints"].as_array().unwrap().iter();
    let largest = radii.map(|k| k["radius"].as_f64().unwrap()).fold(0.0, f64::max);
    assert!((largest - 2.0).abs() < 0.02, "{largest}");
    let line = medial_with(&["axis", "-", "--from", "csv"], "0,0\n1,1\n2,2\n");
    assert_eq!(line.status, Some(1));
    assert!(line.errors.contains("3 points without a closed border"), "{}", line.errors);
}

#[test]
fn points_are_read_as_geometries_too() {
    let places: Vec<[f64; 2]> = (0..80)
        .map(|k| (std::f64::consts::TAU * f64::from(7 * k % 80) / 80.0).sin_cos())
        .map(|(sin, cos)| [4.0 * cos, 2.0 * sin])
        .collect();
    let csv: String = places.iter().map(|[x, y]| format!("{x},{y}\n")).collect();
    let wkt: String = places.iter().map(|[x, y]| format!("POINT ({x} {y})\n")).collect();
    let multipoint = format!("{{\"type\":\"MultiPoint\",\"coordinates\":{places:?}}}");
    let axis = |format: &str, text: &str| {
        let args = ["axis", "-", "--from", format, "--to", "wkt", "-q"];
        let run = medial_with(&[&args[..], &ENGINE].concat(), text);
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{format}");
        run.text().to_owned()
    };
    let expected = axis("csv", &csv);
    for (format, text) in [("wkt", &wkt), ("geojson", &multipoint), ("geojsonl", &multipoint)] {
        assert_eq!(axis(format, text), expected, "{format}");
    }
    // What is wrong is told with its file, feature and line, once, and there is no border of the rest.
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("points.wkt");
    fs::write(&file, wkt.replacen("POINT (", "POINT [", 1)).unwrap();
    let run = medial(&["axis", file.to_str().unwrap()]);
    assert_eq!((run.status, run.text()), (Some(1), ""));
    let told = run.errors.lines().filter(|line| line.starts_with("error")).collect::<Vec<_>>();
    assert_eq!(told.len(), 1, "{}", run.errors);
    assert!(told[0].contains("points.wkt: feature 0: line 1, column 7: expected `(`"), "{told:?}");
}

#[test]
fn smoothing_the_outline_of_an_image_is_for_images() {
    let rectangle = "POLYGON((0 0,4 0,4 2,0 2,0 0))";
    for command in ["axis", "branches"] {
        let args = [command, "-", "--from", "wkt", "--smooth-border", "2"];
        let run = medial_with(&[&args[..], &ENGINE].concat(), rectangle);
        assert_eq!((run.status, run.text()), (Some(2), ""), "{}", run.errors);
        let why = "--smooth-border is for images, whose outlines have steps; the input is wkt";
        assert!(run.errors.contains(why), "{}", run.errors);
    }
}

/// The number of a set's root, by which sets are named.
fn root(parent: &mut [usize], mut of: usize) -> usize {
    while parent[of] != of {
        parent[of] = parent[parent[of]];
        of = parent[of];
    }
    of
}

/// Components and loops of a graph of so many nodes.
fn components_and_loops(n: usize, edges: impl Iterator<Item = [usize; 2]>) -> [usize; 2] {
    let mut parent: Vec<usize> = (0..n).collect();
    let (mut components, mut loops) = (n, 0);
    for edge in edges {
        let [a, b] = edge.map(|node| root(&mut parent, node));
        if a == b {
            loops += 1;
        } else {
            parent[a] = b;
            components -= 1;
        }
    }
    [components, loops]
}

/// Components of the cells of a picture that are inside, by sides and corners, and of those outside, by sides, but for
/// the outermost one: the holes.
fn components_and_holes(columns: usize, rows: usize, is_in: impl Fn(usize) -> bool) -> [usize; 2] {
    // With a frame outside.
    let (wide, high) = (columns + 2, rows + 2);
    let cells: Vec<bool> = (0..wide * high)
        .map(|k| (k % wide, k / wide))
        .map(|(x, y)| {
            (1..=columns).contains(&x)
                && (1..=rows).contains(&y)
                && is_in((y - 1) * columns + x - 1)
        })
        .collect();
    let count = |wanted: bool, steps: &[usize]| {
        let mut parent: Vec<usize> = (0..cells.len()).collect();
        let mut n = cells.iter().filter(|&&cell| cell == wanted).count();
        for k in 0..cells.len() {
            for other in steps.iter().map(|step| k + step).filter(|&k| k < cells.len()) {
                // The frame keeps the ends of rows apart, or joins what is outside.
                if cells[k] == wanted && cells[other] == wanted {
                    let [a, b] = [k, other].map(|k| root(&mut parent, k));
                    n -= usize::from(a != b);
                    parent[a] = b;
                }
            }
        }
        n
    };
    [count(true, &[1, wide - 1, wide, wide + 1]), count(false, &[1, wide]) - 1]
}

/// Columns and rows of a PNG image of colours or grey, and how bright its pixels are; not numbers where it is
/// transparent.
fn brightness(path: &Path) -> (usize, usize, Vec<f64>) {
    let mut decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap()));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut samples = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut samples).unwrap();
    let each = frame.color_type.samples();
    let value = |pixel: &[u8]| {
        let value = |k: usize| f64::from(pixel[k]);
        match pixel.len() {
            2 | 4 if pixel[each - 1] < 128 => f64::NAN,
            1 | 2 => value(0),
            _ => 0.2126 * value(0) + 0.7152 * value(1) + 0.0722 * value(2),
        }
    };
    let pixels = samples[..frame.buffer_size()].chunks_exact(each).map(value).collect();
    (frame.width as usize, frame.height as usize, pixels)
}

#[test]
fn no_component_and_no_hole_of_an_image_is_lost_at_the_default_pruning() {
    let mut all = [0; 2];
    for name in ["horse", "lake", "atlas", "coast"] {
        let path = fixture(&format!("images/{name}.png"));
        let (columns, rows, values) = brightness(&path);
        for limit in ["40.03", "90.03", "150.03", "200.03"] {
            let most: f64 = limit.parse().unwrap();
            for invert in [false, true] {
                let is_in = |k: usize| if invert { values[k] <= most } else { values[k] > most };
                let expected = components_and_holes(columns, rows, is_in);
                let mut args =
                    vec!["axis", path.to_str().unwrap(), "--threshold", limit, "--to", "json"];
                args.extend(ENGINE);
                args.extend(invert.then_some("--invert"));
                let run = medial(&args);
                if expected[0] == 0 {
                    assert_eq!(run.status, Some(1), "{name} {limit}: {}", run.errors);
                    continue;
                }
                assert_eq!(run.status, Some(0), "{name} {limit}: {}", run.errors);
                let axis: Value = serde_json::from_str(run.text()).unwrap();
                let n = axis["keypoints"].as_array().unwrap().len();
                let end = |path: &Value, end: &str| path[end].as_u64().unwrap() as usize;
                let paths = axis["paths"].as_array().unwrap().iter();
                let edges = paths.map(|path| [end(path, "from"), end(path, "to")]);
                let found = components_and_loops(n, edges);
                assert_eq!(found, expected, "{name} {limit} {invert}");
                all = [all[0] + found[0], all[1] + found[1]];
            }
        }
    }
    // It is not that there was nothing to lose.
    assert!(all[0] > 1000 && all[1] > 1000, "{all:?}");
}
