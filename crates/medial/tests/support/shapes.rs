//! Shapes from `fixtures/shapes`, one geometry as WKT in each file.

use std::path::PathBuf;

use medial::domain::{Domain, Options};
use medial::geom::Point;

pub type Polygons = Vec<Vec<Vec<Point>>>;

/// Names of all shapes, sorted.
pub fn names() -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder())
        .expect("fixtures/shapes is part of the repository")
        .map(|entry| entry.expect("the folder can be listed").path())
        .filter(|path| path.extension().is_some_and(|e| e == "wkt"))
        .map(|path| path.file_stem().expect("it has a name").to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// The polygons of a shape.
pub fn polygons(name: &str) -> Polygons {
    let path = folder().join(format!("{name}.wkt"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
    parse(&text)
}

/// The domain of a shape.
pub fn domain(name: &str) -> Domain {
    of(&polygons(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The domain of polygons.
pub fn of(polygons: &[Vec<Vec<Point>>]) -> Result<Domain, medial::domain::DomainError> {
    Domain::from_polygons(polygons, &Options::default())
}

/// The domain of a WKT text.
pub fn wkt(text: &str) -> Domain {
    of(&parse(text)).unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// Writes polygons as WKT, so that a failure can be kept.
pub fn to_wkt(polygons: &Polygons) -> String {
    let rings = |rings: &Vec<Vec<Point>>| {
        let rings: Vec<String> = rings
            .iter()
            .map(|ring| {
                let closed = ring.iter().chain(ring.first());
                let points: Vec<String> = closed.map(|p| format!("{} {}", p.x, p.y)).collect();
                format!("({})", points.join(", "))
            })
            .collect();
        format!("({})", rings.join(", "))
    };
    let all: Vec<String> = polygons.iter().map(rings).collect();
    if let [one] = all.as_slice() {
        format!("POLYGON {one}")
    } else {
        format!("MULTIPOLYGON ({})", all.join(", "))
    }
}

/// Reads a POLYGON or a MULTIPOLYGON.
pub fn parse(text: &str) -> Polygons {
    let is_multi = text.trim_start().to_uppercase().starts_with("MULTI");
    let mut polygons: Polygons = Vec::new();
    let mut depth = 0;
    let mut number = String::new();
    let mut ring: Vec<f64> = Vec::new();
    let level = if is_multi { 2 } else { 1 };
    for c in text.chars() {
        let digit = depth > level && matches!(c, '0'..='9' | '.' | '-' | '+' | 'e' | 'E');
        if digit {
            number.push(c);
            continue;
        }
        if !number.is_empty() {
            ring.push(number.parse().unwrap_or_else(|e| panic!("{number}: {e}")));
            number.clear();
        }
        match c {
            '(' => {
                depth += 1;
                if depth == level {
                    polygons.push(Vec::new());
                }
            }
            ')' => {
                if depth == level + 1 {
                    let points = ring.chunks(2).map(|xy| Point::new(xy[0], xy[1])).collect();
                    polygons.last_mut().expect("inside a polygon").push(points);
                    ring.clear();
                }
                depth -= 1;
            }
            _ => {}
        }
    }
    polygons
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/shapes")
}
