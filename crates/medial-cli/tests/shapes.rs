//! `medial branches`, `smooth` and `reconstruct`, as a user meets them.

mod common;

use common::{fixture, medial, medial_with};
use serde_json::Value;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";
const HOLED: &str = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))";

fn features(words: &[&str], text: &str) -> Vec<Value> {
    let run = medial_with(words, text);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let collection: Value = serde_json::from_str(run.text()).unwrap();
    collection["features"].as_array().unwrap().clone()
}

#[test]
fn branches_tell_their_primitives() {
    let found = features(&["branches", "-"], RECTANGLE);
    assert_eq!(found.len(), 5);
    let spine = found.iter().find(|f| f["properties"]["primitive"] == "worm").unwrap();
    let properties = &spine["properties"];
    assert_eq!((&properties["length"], &properties["area"]), (&4.0.into(), &8.0.into()));
    assert_eq!((&properties["trend"], &properties["bend"]), (&"-".into(), &"straight".into()));
    assert_eq!(properties["kind_start"], "junction");
    // One line for each primitive of a waist.
    let waist = "POLYGON ((0 0, 4 1, 8 0, 8 4, 4 3, 0 4, 0 0))";
    let whole = features(&["branches", "-"], waist);
    let cut = features(&["branches", "-", "--by", "primitive"], waist);
    assert!(cut.len() > whole.len());
    assert!(cut.iter().any(|f| f["properties"]["trend"] == "closing"));
    let csv = medial_with(&["branches", "-", "--to", "csv"], RECTANGLE);
    assert_eq!(csv.text().lines().count(), 6);
    assert!(csv.text().starts_with("WKT,feature,id,engine,side,branch,piece,primitive,"));
}

#[test]
fn limbs_fit_where_there_is_room() {
    let notched = "POLYGON ((0 0, 9 0, 9 6, 6 6, 6 2, 4 2, 4 6, 0 6, 0 0))";
    let limbs = features(&["branches", "-", "--limbs", "--side", "exterior"], notched);
    assert_eq!((limbs.len(), &limbs[0]["properties"]["kind"]), (1, &"bay".into()));
    let folder = tempfile::tempdir().unwrap();
    let lock = folder.path().join("lock.wkt");
    std::fs::write(&lock, notched).unwrap();
    let lock = lock.display().to_string();
    let run = medial_with(
        &["branches", "-", "--match", &lock],
        "POLYGON ((0 0, 9 0, 9 1.9, 0 1.9, 0 0))",
    );
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let pairs: Vec<Value> =
        run.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(pairs.len(), 2, "both ends fit");
    assert_eq!((&pairs[0]["type"], &pairs[0]["moves"]), (&"LimbPair".into(), &"feature".into()));
    assert!(pairs[0]["fill"].as_f64().unwrap() > 0.8);
}

#[test]
fn smoothing_gives_polygons_and_their_distance() {
    let found = features(&["smooth", "-", "--max-error", "0.25"], RECTANGLE);
    let properties = &found[0]["properties"];
    assert!(properties["distance"].as_f64().unwrap() <= 0.25);
    let ring = found[0]["geometry"]["coordinates"][0].as_array().unwrap();
    assert!(ring.len() > 12 && ring.first() == ring.last());
    // Nothing stands out of a rectangle by less than that.
    let wkt = medial_with(&["smooth", "-", "--to", "wkt"], RECTANGLE);
    assert!(wkt.text().starts_with("POLYGON (("), "{}", wkt.text());
}

#[test]
fn axis_documents_are_rebuilt_bit_for_bit() {
    let river = fixture("river.geojson").display().to_string();
    let axis = medial(&["axis", &river, "--to", "json"]);
    let rebuilt = medial_with(&["reconstruct", "-", "--to", "wkt"], axis.text());
    assert_eq!((rebuilt.status, rebuilt.errors.as_str()), (Some(0), ""));
    let again = medial_with(&["axis", "-", "--from", "wkt", "--to", "json"], rebuilt.text());
    let both = [axis.text(), again.text()].map(|t| serde_json::from_str::<Value>(t).unwrap());
    assert_eq!(both[0]["keypoints"], both[1]["keypoints"]);
    assert_eq!(both[0]["paths"], both[1]["paths"]);
    // Other commands take the polygons of an axis, too.
    let smooth = [axis.text(), rebuilt.text()]
        .map(|text| medial_with(&["smooth", "-", "--to", "wkt"], text).text().to_owned());
    assert_eq!(smooth[0], smooth[1]);
}

#[test]
fn rebuilding_tells_how_near_it_comes() {
    let error = |words: &[&str]| {
        let found = features(&[&["reconstruct", "-"], words].concat(), HOLED);
        assert_eq!(found[0]["geometry"]["coordinates"].as_array().unwrap().len(), 2, "a hole");
        found[0]["properties"]["error"].as_f64().unwrap()
    };
    assert_eq!(error(&[]), 0.0);
    let pruned = error(&["--max-error", "0.5"]);
    assert!(pruned > 0.4 && pruned < 0.502, "{pruned}");
    for method in ["tangents", "disks"] {
        let [coarse, fine] =
            ["0.5", "0.05"].map(|step| error(&["--method", method, "--step", step]));
        assert!(fine < coarse && fine < 0.05, "{method}: {coarse} {fine}");
    }
}

#[test]
fn what_cannot_be_done_is_told() {
    let pruned = medial_with(&["prune", "-", "--max-error", "0.5", "--to", "json"], RECTANGLE);
    let smooth = medial_with(&["smooth", "-"], pruned.text());
    assert_eq!(smooth.status, Some(1));
    assert!(smooth.errors.contains("feature 0: axis: the axis is pruned"), "{}", smooth.errors);
    let outside = medial_with(&["axis", "-", "--side", "exterior", "--to", "json"], HOLED);
    let rebuilt = medial_with(&["reconstruct", "-"], outside.text());
    assert_eq!(rebuilt.status, Some(1));
    assert!(rebuilt.errors.contains("exterior"), "{}", rebuilt.errors);
    let svg = medial_with(&["smooth", "-", "--to", "svg"], RECTANGLE);
    assert_eq!(svg.status, Some(2));
    let rebuilt = medial_with(&["reconstruct", "-", "--max-error", "1"], pruned.text());
    assert_eq!(rebuilt.status, Some(2), "{}", rebuilt.errors);
}

#[test]
fn measures_are_written_for_every_path() {
    let found = features(&["axis", "-", "--measures", "excess,erosion"], RECTANGLE);
    let spine = found.iter().find(|f| f["properties"]["length"] == 4.0).unwrap();
    let value = |name: &str| spine["properties"][name].as_f64().unwrap();
    assert!((value("excess") - (10_f64.sqrt() - 1.0)).abs() < 1e-12);
    assert!((value("excess_start") - (2_f64.sqrt() - 1.0)).abs() < 1e-12);
    assert!((value("erosion") - (2_f64.sqrt() + 1.0)).abs() < 1e-12);
    // Cycles never burn.
    let found = features(&["axis", "-", "--measures", "potential"], HOLED);
    assert!(found.iter().any(|f| f["properties"]["potential"].is_null()));
    // Where a path is cut the value is the threshold.
    let words = ["prune", "-", "--prune", "potential=6", "--measures", "potential", "--to", "json"];
    let pruned: Value = serde_json::from_str(medial_with(&words, RECTANGLE).text()).unwrap();
    let values = &pruned["paths"][0]["measures"]["potential"];
    assert!((values[1].as_f64().unwrap() - 6.0).abs() < 1e-12, "{values}");
    assert!((values[0].as_f64().unwrap() - 8.0).abs() < 1e-12, "{values}");
    let csv = medial_with(&["axis", "-", "--measures", "length", "--to", "csv"], RECTANGLE);
    assert!(
        csv.text()
            .lines()
            .next()
            .unwrap()
            .ends_with(",branch_length,branch_length_start,branch_length_end")
    );
}

#[test]
fn options_without_effect_are_wrong_usage() {
    for words in [
        &["reconstruct", "-", "--step", "1"][..],
        &["branches", "-", "--limbs", "--by", "primitive"][..],
    ] {
        let run = medial_with(words, "POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))");
        assert_eq!((run.status, run.out.len()), (Some(2), 0), "{words:?}");
        assert!(run.errors.contains("--"), "{}", run.errors);
    }
}
