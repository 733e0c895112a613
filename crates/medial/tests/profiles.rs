//! Widths along lines: by hand, and against dense samples of the curves.

mod support;

use medial::domain::Domain;
use medial::engine::path_tracing;
use medial::geom::Point;
use medial::ops::{
    Centerline, CenterlineOptions, Extension, Station, centerlines, narrowest, profile,
};
use support::random::{self, Family, Ground, Random};
use support::{plane, shapes};

fn line(domain: &Domain, extension: Extension) -> Option<Centerline> {
    let axis = path_tracing(domain).unwrap();
    let options = CenterlineOptions { extension, ..CenterlineOptions::default() };
    centerlines(domain, &axis, &options).ok()?.into_iter().next()
}

fn of(wkt: &str) -> Vec<Station> {
    profile(&line(&shapes::wkt(wkt), Extension::None).unwrap(), 1e-3)
}

#[test]
fn the_neck_between_two_corners_is_a_station() {
    let stations = of("POLYGON ((0 0, 4 0, 5 1, 6 0, 10 0, 10 4, 6 4, 5 3, 4 4, 0 4, 0 0))");
    let neck = stations[narrowest(&stations).unwrap()];
    assert_eq!((neck.point, neck.width), (Point::new(5.0, 2.0), 2.0));
    // It lies halfway.
    let last = stations.last().unwrap().along;
    assert!((neck.along - 0.5 * last).abs() < 1e-14 * last, "{neck:?} {last}");
    assert_eq!(stations[0].width, stations[stations.len() - 1].width);
}

#[test]
fn the_apex_of_a_parabola_is_a_station() {
    // A corner 1 over an edge.
    let stations = of("POLYGON ((0 0, 8 0, 8 4, 5 4, 4 1, 3 4, 0 4, 0 0))");
    let neck = stations[narrowest(&stations).unwrap()];
    assert_eq!((neck.point, neck.width), (Point::new(4.0, 0.5), 1.0));
}

#[test]
fn extensions_belong_to_the_line() {
    let domain = shapes::wkt("POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))");
    let stations = profile(&line(&domain, Extension::Boundary).unwrap(), 1e-3);
    let told: Vec<(f64, f64)> = stations.iter().map(|s| (s.along, s.width)).collect();
    assert_eq!((told.len(), told[0], told[3]), (4, (0.0, 0.0), (6.0, 0.0)));
    let [before, after] = [stations[1], stations[2]];
    assert_eq!((before.width, after.width), (2.0, 2.0));
    // The line of a rectangle is a part of its spine.
    assert_eq!(before.along, (before.point - stations[0].point).norm());
    assert!((6.0 - after.along - (after.point - stations[3].point).norm()).abs() < 1e-14);
}

#[test]
fn a_closed_line_comes_back_to_its_width() {
    let stations = of("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))");
    let (first, last) = (stations[0], stations[stations.len() - 1]);
    assert_eq!((first.point, first.width), (last.point, last.width));
    assert_eq!(stations[narrowest(&stations).unwrap()].width, 3.0);
}

#[test]
fn a_closed_line_may_begin_where_it_is_narrowest() {
    let ring = |widths: [f64; 5]| -> Vec<Station> {
        let corners = [(0., 0.), (2., 0.), (2., 2.), (0., 2.), (0., 0.)];
        let all = (0..).map(|k| 2.0 * f64::from(k)).zip(corners.into_iter().zip(widths));
        all.map(|(along, ((x, y), width))| Station { along, point: Point::new(x, y), width })
            .collect()
    };
    assert_eq!(narrowest(&ring([1.0, 2.0, 3.0, 2.0, 1.0])), Some(0));
    assert_eq!(narrowest(&ring([3.0, 2.0, 1.0, 2.0, 3.0])), Some(2));
    // Both ends in one corner.
    assert_eq!(narrowest(&ring([0.0, 2.0, 1.0, 2.0, 0.0])), Some(2));
}

/// The width of the chord over a length, and the distance of a point from the polyline there.
fn chord(pair: &[Station], along: f64, p: Point) -> (f64, f64) {
    let [a, b] = [pair[0], pair[1]];
    let share = ((along - a.along) / (b.along - a.along)).clamp(0.0, 1.0);
    let way = b.point - a.point;
    let foot = (way.dot(p - a.point) / way.norm2()).clamp(0.0, 1.0);
    let off = (a.point + way * foot - p).norm();
    (a.width + (b.width - a.width) * share, off)
}

#[test]
fn random_profiles_are_within_their_tolerance_everywhere() {
    let mut random = Random(77);
    let (mut judged, mut worst) = (0, [0.0_f64; 2]);
    for round in 0..4000 {
        let family = [Family::Tangle, Family::Holes, Family::Hung][round % 3];
        let polygons = random::shape(&mut random, family, Ground::Square);
        let Ok(domain) = shapes::of(&polygons) else { continue };
        let Some(line) = line(&domain, Extension::None) else { continue };
        let tolerance = [1e-1, 1e-2, 1e-3, 1e-5][round % 4];
        let stations = profile(&line, tolerance);
        assert!(stations.is_sorted_by(|a, b| a.along <= b.along));
        assert!((stations[stations.len() - 1].along - line.length()).abs() < 1e-12);
        let wall = |s: &Station| (2.0 * plane::distance(&domain, s.point) - s.width).abs();
        assert!(stations.iter().all(|s| wall(s) < 1e-9));
        // Each curve at many places, with its own length and radius.
        let mut before = 0.0;
        let mut k = 0;
        for curve in &line.curves {
            for j in 0..=200 {
                let u = f64::from(j) / 200.0;
                let (p, width) = (curve.point_at(u), 2.0 * curve.radius_at(u));
                let along = before + curve.piece(0.0, u).length();
                while k + 2 < stations.len() && stations[k + 1].along < along {
                    k += 1;
                }
                let (there, off) = chord(&stations[k..k + 2], along, p);
                // A chord of the width lies above it, but for rounding.
                assert!(there - width > -1e-9, "{there} {width}");
                let share = [(there - width) / tolerance, off / tolerance];
                assert!(share[0] < 1.0 + 1e-6 && share[1] < 1.0, "{share:?}");
                worst = [worst[0].max(share[0]), worst[1].max(share[1])];
            }
            before += curve.length();
        }
        judged += 1;
    }
    assert!(judged > 1000 && worst[0] > 0.9, "{judged} {worst:?}");
}
