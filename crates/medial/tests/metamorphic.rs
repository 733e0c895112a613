//! The same graph after every change of the input that changes nothing: exact translations,
//! powers of two, quarter turns, mirrors, turns by small integers, another start, another order,
//! reversed rings, an inserted straight corner.

mod support;

use std::collections::BTreeMap;

use medial::axis::{MedialAxis, SiteKind};
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use medial::geom::Point;
use support::random::{self, Family, Ground, Random};
use support::shapes::{self, Polygons};

/// A site by its geometry: bits of both ends.
type Place = (SiteKind, [u64; 4]);

/// Every keypoint by its cyclic governor list, every path by the lists of its ends and its
/// governors; with the number of their occurrences.
type Graph = BTreeMap<(Vec<Place>, Vec<Place>, Vec<Place>), usize>;

/// The graph of an axis whose sites are moved by `map`; a mirror swaps left and right.
fn graph(axis: &MedialAxis, map: impl Fn(Point) -> Point, mirror: bool) -> Graph {
    let bits = |p: Point| {
        // Either zero is the same place.
        [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()]
    };
    let place = |number: u32| {
        let site = axis.sites().at(number);
        let (a, b) = (map(site.a), map(site.b));
        let (a, b) = if mirror { (b, a) } else { (a, b) };
        let ([ax, ay], [bx, by]) = (bits(a), bits(b));
        (site.kind, [ax, ay, bx, by])
    };
    let list = |keypoint: u32| {
        let mut list: Vec<Place> = axis.governors(keypoint).iter().map(|&g| place(g)).collect();
        if mirror {
            list.reverse();
        }
        let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap();
        list.rotate_left(least);
        list
    };
    let mut graph = Graph::new();
    for k in 0..axis.keypoints().len() as u32 {
        *graph.entry((list(k), Vec::new(), Vec::new())).or_default() += 1;
    }
    for path in axis.paths() {
        let (left, right) = (place(path.left), place(path.right));
        let (left, right) = if mirror { (right, left) } else { (left, right) };
        let (from, to) = (list(path.from), list(path.to));
        let forward = (from.clone(), to.clone(), vec![left, right]);
        let backward = (to, from, vec![right, left]);
        *graph.entry(forward.min(backward)).or_default() += 1;
    }
    graph
}

fn domain(polygons: &Polygons) -> Option<Domain> {
    Domain::from_polygons(polygons, &Options { regroup: true, ..Options::default() }).ok()
}

fn trace(polygons: &Polygons) -> MedialAxis {
    path_tracing(&domain(polygons).unwrap()).unwrap()
}

fn moved(polygons: &Polygons, map: impl Fn(Point) -> Point) -> Polygons {
    polygons
        .iter()
        .map(|p| p.iter().map(|r| r.iter().map(|&q| map(q)).collect()).collect())
        .collect()
}

const FAMILIES: [Family; 4] = [Family::Tangle, Family::Holes, Family::Triangles, Family::Squares];

type Map = Box<dyn Fn(Point) -> Point>;

/// Named maps that are exact on coordinates with few bits, and whether they mirror.
fn maps() -> Vec<(String, Map, bool)> {
    let mut maps: Vec<(String, Map, bool)> = Vec::new();
    let mut add = |name: String, map: Map, mirror| maps.push((name, map, mirror));
    add("quarter turn".into(), Box::new(|p| Point::new(-p.y, p.x)), false);
    add("half turn".into(), Box::new(|p| Point::new(-p.x, -p.y)), false);
    add("three quarter turn".into(), Box::new(|p| Point::new(p.y, -p.x)), false);
    add("mirror in y".into(), Box::new(|p| Point::new(-p.x, p.y)), true);
    add("mirror in the diagonal".into(), Box::new(|p| Point::new(p.y, p.x)), true);
    for exponent in [-30, -7, 13, 30] {
        let scale = 2f64.powi(exponent);
        add(format!("scale 2^{exponent}"), Box::new(move |p| p * scale), false);
    }
    maps
}

/// Maps that are exact only where coordinates have few bits.
fn integer_maps() -> Vec<(String, Map, bool)> {
    let mut maps: Vec<(String, Map, bool)> = Vec::new();
    for (a, b) in [(2.0, 1.0), (3.0, 4.0), (5.0, -7.0), (12.0, 5.0)] {
        let map = move |p: Point| Point::new(a * p.x - b * p.y, b * p.x + a * p.y);
        maps.push((format!("turn by ({a}, {b})"), Box::new(map), false));
    }
    for (x, y) in [(1048576.0, -3.0), (17.0, 20_000_000.0)] {
        maps.push((format!("shift by ({x}, {y})"), Box::new(move |p| p + Point::new(x, y)), false));
    }
    maps
}

/// Whether coordinates have so few bits that the integer maps are exact on them.
fn few_bits(polygons: &Polygons) -> bool {
    polygons.iter().flatten().flatten().all(|p| {
        [p.x, p.y].iter().all(|v| {
            let scaled = v * 1024.0;
            scaled == scaled.trunc() && scaled.abs() < 2f64.powi(28)
        })
    })
}

fn check(name: &str, polygons: &Polygons) {
    let axis = trace(polygons);
    let same = graph(&axis, |p| p, false);
    let mut all = maps();
    if few_bits(polygons) {
        all.extend(integer_maps());
    }
    for (what, map, mirror) in &all {
        let after = trace(&moved(polygons, map));
        assert!(graph(&axis, map, *mirror) == graph(&after, |p| p, false), "{name}: {what}");
    }
    let mut reordered = polygons.clone();
    for polygon in &mut reordered {
        for ring in polygon.iter_mut() {
            if ring.len() > 3 && ring.first() == ring.last() {
                ring.pop();
            }
            let third = ring.len() / 3;
            ring.rotate_left(third);
        }
        polygon[1..].reverse();
    }
    assert!(same == graph(&trace(&reordered), |p| p, false), "{name}: other starts and orders");
    let mut reversed = polygons.clone();
    reversed.iter_mut().flatten().for_each(|ring| ring.reverse());
    assert!(same == graph(&trace(&reversed), |p| p, false), "{name}: reversed rings");
    let mut split = polygons.clone();
    for ring in split.iter_mut().flatten() {
        for k in (0..ring.len() - 1).rev() {
            let (a, b) = (ring[k], ring[k + 1]);
            let middle = Point::new((a.x + b.x) / 2.0, (a.y + b.y) / 2.0);
            // Only where the middle is exact does it leave the shape as it was.
            let on_edge = medial::geom::orient2d(a, b, middle) == 0.0;
            if on_edge && middle != a && middle != b {
                ring.insert(k + 1, middle);
            }
        }
    }
    assert!(same == graph(&trace(&split), |p| p, false), "{name}: inserted straight corners");
}

#[test]
fn shapes_keep_their_graph() {
    for name in shapes::names() {
        check(&name, &shapes::polygons(&name));
    }
}

fn random_shapes(ground: Ground, seed: u64) {
    let mut random = Random(seed);
    for family in FAMILIES {
        let mut tried = 0;
        while tried < 100 {
            let polygons = random::shape(&mut random, family, ground);
            if domain(&polygons).is_some() {
                tried += 1;
                check(&shapes::to_wkt(&polygons), &polygons);
            }
        }
    }
}

#[test]
fn random_shapes_on_a_grid_keep_their_graph() {
    random_shapes(Ground::Grid(8), 11);
}

#[test]
fn random_shapes_with_full_mantissas_keep_their_graph() {
    random_shapes(Ground::Square, 12);
}
