//! What became of the objects of one image in another.

use super::places::{geotiff, geotiff_of_numbers};
use super::*;

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
fn results_that_were_chosen_each_in_its_own_way_are_compared() {
    let folder = tempfile::tempdir().unwrap();
    let name = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let before = picture(folder.path(), "before.png", &["rr.g.", "rr...", "....w"]);
    let after = picture(folder.path(), "after.png", &["rrrg.", "rr...", "....."]);
    let [kept, other] = ["kept.tiff", "other.tiff"].map(name);
    // Red and white by points here, red alone by its colour there.
    let points = ["--at", "0.5,-0.5", "--at", "4.5,-2.5", "--labels", &kept, "--layers", "border"];
    let run = medial(&words(&before, &points));
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let colour = ["--select-color", "c81e1e", "--labels", &other, "--layers", "border"];
    assert_eq!(medial(&words(&after, &colour)).status, Some(0));
    let compared = ["--compare", &other, "--layers", "change", "--to", "csv"];
    let labels = [&["image", &kept, "--method", "labels"][..], &compared].concat();
    let run = medial(&labels);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let mut rows = csv::Reader::from_reader(run.text().as_bytes());
    let names = rows.headers().unwrap().clone();
    let place = |name: &str| names.iter().position(|other| other == name).unwrap();
    let places = ["change", "pixels", "pixels_after"].map(place);
    let told: Vec<_> =
        rows.records().map(|row| places.map(|k| row.as_ref().unwrap()[k].to_owned())).collect();
    assert_eq!(told, [["changed", "4", "5"], ["vanished", "1", "0"]]);
    // The other one by clicks of its own.
    let clicks = name("clicks.csv");
    fs::write(&clicks, "x,y\n3.5,-0.5\n").unwrap();
    let own = ["--at", "3.5,-0.5", "--compare-clicks", &clicks];
    assert_eq!(changes(&before, &after, &own), [["same", "1", "1"]]);
}
