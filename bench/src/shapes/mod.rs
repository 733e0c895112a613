//! Polygons of about a wanted number of edges.
//!
//! Coordinates are whole numbers between ±10⁹, which fit 31 bits and a sign, but for the shapes
//! in `DOUBLES`.

mod grids;
mod mazes;
mod random;
mod round;
mod teeth;

pub use random::Random;

/// Half the width of a drawing.
const SIZE: f64 = 1e9;

/// A closed ring of points.
pub type Ring = Vec<(f64, f64)>;

/// The names of all shapes.
pub const NAMES: [&str; 14] = [
    "star", "koch", "maze", "rmaze", "comb", "stair", "holes", "holes3", "lattice", "ngon",
    "rngon", "ellipse", "slivers", "spiral",
];

/// The shapes whose coordinates are not whole.
pub const DOUBLES: [&str; 2] = ["ngon", "ellipse"];

/// The rings of a shape, the outer one first; always the same ones.
pub fn draw(shape: &str, edges: usize) -> Option<Vec<Ring>> {
    draw_from(&mut Random::new(edges.max(12) as u64), shape, edges)
}

/// The rings of a shape, the outer one first, with what is random in it taken from there.
pub fn draw_from(random: &mut Random, shape: &str, edges: usize) -> Option<Vec<Ring>> {
    let edges = edges.max(12);
    let mut rings = match shape {
        "star" => vec![round::star(random, edges)],
        "koch" => vec![round::koch(random, edges)],
        "maze" => vec![mazes::maze(random, edges, 0.2)],
        "rmaze" => vec![mazes::maze(random, edges, 0.0)],
        "comb" => vec![teeth::comb(edges)],
        "stair" => vec![teeth::stair(edges)],
        "holes" => grids::holes(random, edges, 12),
        "holes3" => grids::holes(random, edges, 3),
        "lattice" => grids::lattice(edges),
        "ngon" | "rngon" => vec![round::ellipse(edges, SIZE)],
        "ellipse" => vec![round::ellipse(edges, 0.4 * SIZE)],
        "slivers" => vec![round::slivers(random, edges)],
        "spiral" => vec![round::spiral(edges)],
        _ => return None,
    };
    if !DOUBLES.contains(&shape) {
        for (x, y) in rings.iter_mut().flatten() {
            (*x, *y) = (x.round(), y.round());
        }
    }
    Some(rings)
}
