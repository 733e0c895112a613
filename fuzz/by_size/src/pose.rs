//! Where a shape lies: moved off its grid, turned, rounded, shifted, scaled.

use std::f64::consts::TAU;

use medial::geom::Point;
use medial_bench::shapes::Random;

use super::Polygons;
use super::families::Ground;

/// Poses polygons, and says how.
pub fn pose(random: &mut Random, polygons: &mut Polygons, ground: Ground) -> String {
    let mut told = Vec::new();
    match ground {
        Ground::Whole => told.extend(off_grid(random, polygons)),
        Ground::Touching => told.extend(exact_turn(random, polygons)),
        Ground::Doubles => told.extend(rough(random, polygons)),
        Ground::Exact => {}
    }
    let exact = matches!(ground, Ground::Exact | Ground::Touching);
    told.extend(place(random, polygons, exact));
    if told.is_empty() { "as drawn".into() } else { told.join(", ") }
}

fn each(polygons: &mut Polygons, mut by: impl FnMut(Point) -> Point) {
    polygons.iter_mut().flatten().flatten().for_each(|p| *p = by(*p));
}

/// Whole numbers between which there is room: exact, one unit off, jittered, turned.
fn off_grid(random: &mut Random, polygons: &mut Polygons) -> Vec<String> {
    let mut told = Vec::new();
    let unit = [1.0, 2.0, 4.0, 10.0, 1e3, 1e6][random.below(6)];
    let way = random.below(8);
    if way > 0 {
        each(polygons, |p| p * unit);
        told.push(format!("unit {unit}"));
    }
    if matches!(way, 2 | 3 | 6) {
        told.extend(exact_turn(random, polygons));
    }
    match way {
        1 | 2 => {
            let share = share(random, polygons);
            each(polygons, |p| {
                let mut off = || {
                    if random.between(0.0, 1.0) < share {
                        random.below(3) as f64 - 1.0
                    } else {
                        0.0
                    }
                };
                p + Point::new(off(), off())
            });
            told.push(format!("one unit off in {share}"));
        }
        4 => {
            let jitter = unit * random.between(0.0, 0.25);
            each(polygons, |p| {
                let mut off = || random.between(-jitter, jitter);
                p + Point::new(off(), off())
            });
            told.push(format!("jittered by {jitter}"));
        }
        5 => told.push(turn(random, polygons)),
        6 => told.push(hair(random, polygons)),
        7 => {
            let by = [0.1, 1.0 / 3.0, 0.7][random.below(3)];
            each(polygons, |p| p * by);
            told.push(format!("times {by}"));
        }
        _ => {}
    }
    told
}

/// A share of the corners: few, many or all.
fn share(random: &mut Random, polygons: &Polygons) -> f64 {
    let n = polygons.iter().flatten().map(Vec::len).sum::<usize>();
    [2.0 / n as f64, 0.02, 0.3, 1.0][random.below(4)]
}

/// Doubles: as they are, turned, a hair off, or rounded.
fn rough(random: &mut Random, polygons: &mut Polygons) -> Vec<String> {
    match random.below(5) {
        0 => vec![turn(random, polygons)],
        1 => vec![hair(random, polygons)],
        2 => {
            let (low, high) = extent(polygons);
            let size = (high - low).norm();
            let n = polygons.iter().flatten().map(Vec::len).sum::<usize>();
            // A step of the grid is this share of the mean distance of corners on a circle.
            let fine = 10f64.powf(random.between(0.5, 6.0));
            let unit = fine * n as f64 / size;
            each(polygons, |p| Point::new((p.x * unit).round(), (p.y * unit).round()));
            vec![format!("rounded to a grid {unit} times as fine")]
        }
        _ => Vec::new(),
    }
}

fn extent(polygons: &Polygons) -> (Point, Point) {
    let mut low = Point::new(f64::INFINITY, f64::INFINITY);
    let mut high = low * -1.0;
    for p in polygons.iter().flatten().flatten() {
        low = Point::new(low.x.min(p.x), low.y.min(p.y));
        high = Point::new(high.x.max(p.x), high.y.max(p.y));
    }
    (low, high)
}

/// A turn that keeps whole numbers whole.
fn exact_turn(random: &mut Random, polygons: &mut Polygons) -> Option<String> {
    let turns = [(1.0, 0.0), (2.0, 1.0), (3.0, 4.0), (1.0, 1.0), (1.0, -7.0), (12.0, 5.0)];
    let (a, b) = turns[random.below(turns.len())];
    each(polygons, |p| Point::new(a * p.x - b * p.y, b * p.x + a * p.y));
    (b != 0.0).then(|| format!("turned by ({a}, {b})"))
}

fn turn(random: &mut Random, polygons: &mut Polygons) -> String {
    let angle = [0.3, TAU / 8.0, TAU / 6.0, 1e-9, random.between(0.0, TAU)][random.below(5)];
    let (sin, cos) = angle.sin_cos();
    each(polygons, |p| Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y));
    format!("turned by {angle} in doubles")
}

/// Moves some corners to neighbouring doubles.
fn hair(random: &mut Random, polygons: &mut Polygons) -> String {
    let share = share(random, polygons);
    each(polygons, |p| {
        let mut off = |v: f64| match random.below(4) {
            0 if random.between(0.0, 1.0) < share => v.next_up(),
            1 if random.between(0.0, 1.0) < share => v.next_down(),
            _ => v,
        };
        Point::new(off(p.x), off(p.y))
    });
    format!("a hair off in {share}")
}

/// Shifts, scales, squeezes and mirrors.
fn place(random: &mut Random, polygons: &mut Polygons, exact: bool) -> Option<String> {
    let (low, high) = extent(polygons);
    let size = (high.x - low.x).max(high.y - low.y);
    let n = polygons.iter().flatten().map(Vec::len).sum::<usize>() as f64;
    let fine = 10f64.powf(random.between(0.0, 3.0));
    let way = random.below(if exact { 8 } else { 12 });
    Some(match way {
        4 => {
            let power = random.below(21) as i32;
            each(polygons, |p| Point::new(p.x * 2f64.powi(-power), p.y));
            format!("squeezed by 2^{power}")
        }
        5 => {
            each(polygons, |p| Point::new(p.y, p.x));
            "mirrored".into()
        }
        6 => {
            each(polygons, |p| Point::new(-p.y, p.x));
            "turned by a quarter".into()
        }
        7 => {
            let power = random.below(121) as i32 - 60;
            each(polygons, |p| p * 2f64.powi(power));
            format!("times 2^{power}")
        }
        8 => {
            let shift = [Point::new(1e7, 1e7), Point::new(-1e9 / 3.0, 7.0)][random.below(2)];
            each(polygons, |p| p + shift);
            format!("shifted by {shift:?}")
        }
        9 => {
            let by = n * fine * 1e-7 / size;
            let snap = |v: f64| (v * 1e7).round() / 1e7;
            each(polygons, |p| {
                Point::new(snap((p.x - low.x) * by - 122.4), snap((p.y - low.y) * by + 37.7))
            });
            format!("degrees, {fine} steps an edge")
        }
        10 => {
            let by = n * fine * 1e-3 / size;
            let snap = |v: f64| (v * 1e3).round() / 1e3;
            each(polygons, |p| {
                Point::new(
                    snap((p.x - low.x) * by + 1_488_000.0),
                    snap((p.y - low.y) * by + 6_891_000.0),
                )
            });
            format!("metres, {fine} steps an edge")
        }
        11 => {
            let by = n * fine * 1e-8 / size;
            each(polygons, |p| (p - low) * by + Point::new(1e7, -2e7));
            format!("small and far, {fine} steps an edge")
        }
        _ => return None,
    })
}
