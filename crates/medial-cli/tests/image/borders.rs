//! Borders between regions: along pixels, simplified, smoothed, drawn back.

use super::*;
use medial::geom::DisjointSets;

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

/// Components and cycles of the lines of a layer, which meet where their ends are the same.
fn graph_of(lines: &[Value]) -> (usize, usize) {
    let mut nodes: BTreeMap<[u64; 2], u32> = BTreeMap::new();
    let mut ends: Vec<[u32; 2]> = Vec::new();
    for feature in lines {
        let geometry = &feature["geometry"];
        let points: Vec<[f64; 2]> = match geometry["type"].as_str().unwrap() {
            "Point" => vec![serde_json::from_value(geometry["coordinates"].clone()).unwrap()],
            _ => serde_json::from_value(geometry["coordinates"].clone()).unwrap(),
        };
        let mut node = |p: &[f64; 2]| {
            let n = nodes.len() as u32;
            *nodes.entry(p.map(f64::to_bits)).or_insert(n)
        };
        let pair = [node(&points[0]), node(points.last().unwrap())];
        if points.len() > 1 {
            ends.push(pair);
        }
    }
    let mut sets = DisjointSets::new(nodes.len());
    for &[a, b] in &ends {
        sets.join(a, b);
    }
    let components = sets.count();
    (components, ends.len() + components - nodes.len())
}

#[test]
fn combined_objects_hang_together_whatever_is_done_with_their_borders() {
    let folder = tempfile::tempdir().unwrap();
    let rows = [
        "rr..r.rr", ".rr.r.r.", "...r.r..", "rr.rrr.r", ".r.r.r.r", "rr.rrr..", "r.r...rr",
        ".r..rr.r",
    ];
    let scene = picture(folder.path(), "scene.png", &rows);
    let clicks = folder.path().join("clicks.csv");
    let mut text = "action,x,y\n".to_owned();
    for (y, row) in rows.iter().enumerate() {
        for (x, _) in row.bytes().enumerate().filter(|&(_, letter)| letter == b'r') {
            text += &format!("combine,{}.5,-{}.5\n", x, y);
        }
    }
    fs::write(&clicks, text).unwrap();
    let clicks = clicks.to_str().unwrap();
    let graph = |more: &[&str]| {
        let args = [&["-q", "--clicks", clicks, "--layers", "border,axis"], more].concat();
        let run = medial(&words(&scene, &args));
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{more:?}");
        let layers = by_layer(run.text());
        for polygon in layers["border"].iter().flat_map(polygons_of) {
            let areas: Vec<f64> = polygon.iter().map(twice_area).collect();
            assert!(areas[0] > 0.0 && areas[1..].iter().all(|&a| a < 0.0), "{more:?} {areas:?}");
            for ring in &polygon {
                let mut points: Vec<[f64; 2]> = serde_json::from_value(ring.clone()).unwrap();
                points.pop();
                let n = points.len();
                points.sort_by(|a, b| a.partial_cmp(b).unwrap());
                points.dedup();
                assert_eq!(points.len(), n, "{more:?}: a ring passes a point twice");
            }
        }
        graph_of(&layers["axis"])
    };
    let whole = graph(&[]);
    assert_eq!(whole, (2, 3));
    for more in [
        &["--smooth-border", "1"][..],
        &["--retract", "2"],
        &["--smooth-border", "1", "--retract", "2"],
        &["--simplify", "1"],
        &["--simplify", "3"],
    ] {
        assert_eq!(graph(more), whole, "{more:?}");
    }
}

#[test]
fn a_corner_that_touches_a_simplified_border_crowds_nothing() {
    let folder = tempfile::tempdir().unwrap();
    // The border of the lower part becomes a straight line through the corner of the upper one.
    let rows = [".....r..", "....rr..", "...rrw..", "..rrrr..", "........"];
    let scene = picture(folder.path(), "scene.png", &rows);
    let chosen = ["--at", "5.5,-0.5", "--at", "5.5,-2.5", "--combine", "--simplify", "1"];
    let run = medial(&words(&scene, &[&chosen[..], &["--layers", "border,axis"]].concat()));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
}
