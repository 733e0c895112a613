//! Curves of computed axes: every point lies as far from both governors as its radius says.

use medial::axis::{CurveKind, MedialAxis, SiteKind};
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use medial::geom::Point;
use medial_io::{Drawing, Feature, Format, default_tolerance, geojson, read};
use std::path::{Path, PathBuf};

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures")
}

/// The axis of every feature of a fixture.
fn axes(file: &Path, format: Format) -> Vec<(Feature, MedialAxis)> {
    let bytes = std::fs::read(file).unwrap();
    let features = read(format, &bytes).unwrap().map(Result::unwrap);
    features
        .map(|feature| {
            let domain = Domain::from_polygons(&feature.polygons, &Options::default()).unwrap();
            (feature, path_tracing(&domain).unwrap())
        })
        .collect()
}

fn all() -> Vec<(Feature, MedialAxis)> {
    let mut all = axes(&fixtures().join("river.geojson"), Format::GeoJson);
    let mut files: Vec<PathBuf> = std::fs::read_dir(fixtures().join("shapes"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "wkt"))
        .collect();
    files.sort();
    all.extend(files.iter().flat_map(|file| axes(file, Format::Wkt)));
    all
}

/// The coordinates are rounded relative to the distance of the shape from the origin.
fn rounding(axis: &MedialAxis) -> f64 {
    let (low, high) = axis.bounds().unwrap();
    let size = [low.x, low.y, high.x, high.y].map(f64::abs).into_iter().fold(0.0, f64::max);
    16.0 * f64::EPSILON * size
}

#[test]
fn points_of_a_curve_are_as_far_from_both_governors_as_the_radius() {
    let (mut parabolas, mut lines) = (0, 0);
    for (feature, axis) in all() {
        let bound = rounding(&axis);
        for path in axis.paths() {
            let curve = axis.curve(&path);
            for u in [0.0, 0.1, 0.35, 0.5, 0.8, 1.0] {
                let (p, radius) = (curve.point_at(u), curve.radius_at(u));
                for site in axis.path_governors(&path) {
                    let distance = (site.footpoint(p) - p).norm();
                    // The corner far away turns an error of position into one of the radius.
                    assert!(
                        (distance - radius).abs() <= bound,
                        "{} {path:?} at {u}: {distance} {radius} {bound}",
                        feature.geometry
                    );
                }
            }
            assert_eq!(curve.kind(), axis.curve_kind(&path));
            match curve.kind() {
                CurveKind::Parabola => parabolas += 1,
                _ => lines += 1,
            }
        }
    }
    assert!(parabolas > 50 && lines > 1000, "{parabolas} parabolas, {lines} lines");
}

#[test]
fn the_control_point_agrees_with_the_curve() {
    for (_, axis) in all() {
        let bound = rounding(&axis);
        for path in axis.paths() {
            let curve = axis.curve(&path);
            let Some(control) = curve.control() else { continue };
            let middle = (curve.from() + curve.to()) * 0.25 + control * 0.5;
            assert!((middle - curve.point_at(0.5)).norm() <= bound, "{path:?}");
        }
    }
}

#[test]
fn lengths_and_radii_bound_what_is_drawn() {
    for (_, axis) in all() {
        let bound = rounding(&axis);
        let tolerance = default_tolerance(&axis);
        for path in axis.paths() {
            let curve = axis.curve(&path);
            let drawn = curve.polyline(tolerance);
            let polyline: f64 = drawn.windows(2).map(|w| (w[1].0 - w[0].0).norm()).sum();
            assert!(curve.length() >= polyline - bound, "{path:?}");
            // Chords within the tolerance are short of the curve by less than it for each piece.
            let slack = tolerance * drawn.len() as f64 + bound;
            assert!(curve.length() <= polyline + slack, "{path:?}");
            for (_, radius) in drawn {
                assert!(curve.radius_min() - bound <= radius);
                assert!(radius <= curve.radius_max() + bound);
            }
        }
    }
}

#[test]
fn drawn_points_of_parabolas_stay_within_the_tolerance() {
    for (_, axis) in all() {
        let bound = rounding(&axis);
        let tolerance = default_tolerance(&axis);
        for path in axis.paths() {
            let [left, right] = axis.path_governors(&path);
            if left.kind == right.kind {
                continue;
            }
            let (edge, corner) =
                if left.kind == SiteKind::Edge { (left, right.a) } else { (right, left.a) };
            for w in axis.curve(&path).polyline(tolerance).windows(2) {
                let middle = (w[0].0 + w[1].0) * 0.5;
                // Beyond a parabola by s, the two distances differ by at most 2 s.
                let differ = (middle - corner).norm() - height(edge.a, edge.b, middle);
                assert!(differ.abs() <= 2.0 * tolerance + bound, "{path:?}");
            }
        }
    }
}

fn height(a: Point, b: Point, p: Point) -> f64 {
    (b - a).cross(p - a) / (b - a).norm()
}

#[test]
fn an_axis_that_is_written_has_a_line_for_each_path() {
    let (feature, axis) = axes(&fixtures().join("river.geojson"), Format::GeoJson).remove(0);
    let drawing = Drawing { keypoints: true, ..Drawing::default() };
    let mut text = Vec::new();
    geojson::feature_lines(&mut text, &feature, &axis, &[], drawing);
    let text = String::from_utf8(text).unwrap();
    assert_eq!(text.matches("\"LineString\"").count(), axis.paths().len());
    assert_eq!(text.matches("\"Point\"").count(), axis.keypoints().len());
}
