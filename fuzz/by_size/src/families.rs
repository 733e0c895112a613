//! The families by name.

use medial::geom::Point;
use medial_bench::shapes::{Random, draw_from};

use super::{Polygons, Ring};
use super::{chains, grids, rounds, tangles};

/// A way to draw shapes of a wanted number of edges.
pub struct Family {
    pub name: &'static str,
    /// Most edges, where drawing or judging takes much longer than the axis.
    pub most: usize,
    pub ground: Ground,
    draw: Draw,
}

enum Draw {
    /// One of the shapes of the benchmarks.
    Bench(&'static str),
    Here(fn(&mut Random, usize) -> Polygons),
}

/// What the corners of a family are, before it is posed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// Small whole numbers.
    Whole,
    /// Small whole numbers with rings that touch, found by depth; no corner may move.
    Touching,
    /// Any doubles.
    Doubles,
    /// Doubles chosen with care: only poses without rounding.
    Exact,
}

const ANY: usize = 100_000;

/// Most edges of shapes whose disks nearly touch all of them: judging those is quadratic.
const ROUND: usize = 8_000;

const fn bench(name: &'static str, ground: Ground, most: usize) -> Family {
    Family { name, most, ground, draw: Draw::Bench(name) }
}

const fn here(
    name: &'static str,
    ground: Ground,
    most: usize,
    draw: fn(&mut Random, usize) -> Polygons,
) -> Family {
    Family { name, most, ground, draw: Draw::Here(draw) }
}

/// The family whose corners lie on a grid a few units wide, so that nearly everything ties.
pub const TINY_GRID: &str = "tiny_grid";

/// The families whose shapes have holes, most of them many.
pub const HOLED: [&str; 10] = [
    "holes", "holes3", "lattice", "rooms", "octagons", "circles", "crowd", "scales", "tangles",
    "hidden",
];

/// All families.
pub const FAMILIES: [Family; 38] = [
    bench("star", Ground::Doubles, ANY),
    bench("koch", Ground::Doubles, ANY),
    bench("maze", Ground::Doubles, ANY),
    bench("rmaze", Ground::Whole, ANY),
    bench("comb", Ground::Whole, ANY),
    bench("stair", Ground::Whole, ANY),
    bench("holes", Ground::Doubles, ANY),
    bench("holes3", Ground::Doubles, ANY),
    bench("lattice", Ground::Whole, ANY),
    bench("ngon", Ground::Doubles, ROUND),
    bench("rngon", Ground::Doubles, ROUND),
    bench("ellipse", Ground::Doubles, ANY),
    bench("slivers", Ground::Doubles, ANY),
    bench("spiral", Ground::Doubles, ANY),
    here("rooms", Ground::Whole, ANY, grids::rooms),
    here("octagons", Ground::Doubles, ANY, grids::octagons),
    here("circles", Ground::Whole, ANY, grids::circles),
    here("cells", Ground::Touching, ANY, grids::cells),
    here("checkers", Ground::Touching, ANY, grids::checkers),
    here("diamonds", Ground::Touching, ANY, grids::diamonds),
    here("crowd", Ground::Whole, ANY, grids::crowd),
    here("pixels", Ground::Whole, ANY, grids::pixels),
    here("fillets", Ground::Doubles, ANY, rounds::fillets),
    here("spikes", Ground::Doubles, ANY, rounds::spikes),
    here("mirrored", Ground::Exact, ANY, rounds::mirrored),
    here("turned", Ground::Doubles, ANY, rounds::turned),
    here("nearly_round", Ground::Doubles, 5_000, rounds::nearly_round),
    here("scales", Ground::Exact, ANY, chains::scales),
    here("thin_spiral", Ground::Doubles, ANY, chains::thin_spiral),
    here("square_spiral", Ground::Whole, ROUND, chains::square_spiral),
    here("hairs", Ground::Exact, ANY, chains::hairs),
    here("corridor", Ground::Doubles, ANY, chains::corridor),
    here("zigzag", Ground::Whole, ANY, chains::zigzag),
    here("tangle", Ground::Doubles, 1_000, tangles::tangle),
    here("grid_tangle", Ground::Whole, 200, tangles::grid_tangle),
    here(TINY_GRID, Ground::Exact, ANY, tangles::tiny_grid),
    here("tangles", Ground::Doubles, ANY, tangles::tangles),
    here("hidden", Ground::Exact, ANY, tangles::hidden),
];

impl Family {
    /// Polygons with about that many edges, before they are posed.
    pub fn draw(&self, random: &mut Random, edges: usize) -> Polygons {
        let draw = match self.draw {
            Draw::Here(draw) => draw,
            Draw::Bench(name) => {
                let rings = draw_from(random, name, edges).unwrap_or_default();
                let ring = |ring: Vec<(f64, f64)>| -> Ring {
                    ring.into_iter().map(|(x, y)| Point::new(x, y)).collect()
                };
                let mut polygons = vec![rings.into_iter().map(ring).collect()];
                if self.ground == Ground::Whole {
                    shrink(&mut polygons);
                }
                return polygons;
            }
        };
        draw(random, edges)
    }
}

/// Divides whole numbers by what they have in common.
fn shrink(polygons: &mut Polygons) {
    let least = |get: fn(&Point) -> f64| {
        polygons.iter().flatten().flatten().map(get).fold(f64::INFINITY, f64::min)
    };
    let corner = Point::new(least(|p| p.x), least(|p| p.y));
    let mut common = 0.0;
    for p in polygons.iter().flatten().flatten() {
        for mut v in [p.x - corner.x, p.y - corner.y] {
            while v != 0.0 {
                (common, v) = (v, common % v);
            }
        }
    }
    if common > 0.0 {
        polygons.iter_mut().flatten().flatten().for_each(|p| *p = (*p - corner) * (1.0 / common));
        polygons
            .iter_mut()
            .flatten()
            .flatten()
            .for_each(|p| *p = Point::new(p.x.round(), p.y.round()));
    }
}
