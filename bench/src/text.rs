//! The text all programs read: a line `feature`, `polygon` or `ring` opens one, and every other
//! line is a point `x y`.

use std::fmt::Write as _;
use std::io::{self, Read as _};

use medial::geom::Point;

/// Polygons, each its rings, the outer one first.
pub type Polygons = Vec<Vec<Vec<Point>>>;

/// Reads standard input.
pub fn read() -> Result<Vec<Polygons>, Box<dyn std::error::Error>> {
    let mut text = String::new();
    io::stdin().read_to_string(&mut text)?;
    let mut features: Vec<Polygons> = Vec::new();
    for line in text.lines() {
        let polygons = match line {
            "feature" => {
                features.push(Vec::new());
                continue;
            }
            _ => features.last_mut().ok_or("no feature")?,
        };
        match line {
            "polygon" => polygons.push(Vec::new()),
            "ring" => polygons.last_mut().ok_or("no polygon")?.push(Vec::new()),
            _ => {
                let (x, y) = line.split_once(' ').ok_or("no point")?;
                let ring = polygons.last_mut().and_then(|p| p.last_mut()).ok_or("no ring")?;
                ring.push(Point::new(x.parse()?, y.parse()?));
            }
        }
    }
    Ok(features)
}

/// Appends one feature.
pub fn write(text: &mut String, polygons: &Polygons) {
    text.push_str("feature\n");
    for polygon in polygons {
        text.push_str("polygon\n");
        for ring in polygon {
            text.push_str("ring\n");
            for point in ring {
                // Writing to a string cannot fail.
                let _ = writeln!(text, "{} {}", point.x, point.y);
            }
        }
    }
}

/// The number of edges of a feature.
pub fn edges(polygons: &Polygons) -> usize {
    polygons.iter().flatten().map(Vec::len).sum()
}
