//! Corners on a rational circle and tangents of it, so that ties are exact by construction.

use crate::geom::Point;
use crate::geom::predicates::Element;

use super::random::Random;

/// The circle x² + y² = 1105², which has 108 integer points, multiplied by `turn` as a complex number,
/// moved by `shift` and scaled by a power of two.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    turn: (i64, i64),
    shift: (i64, i64),
    scale: i32,
}

impl Shape {
    pub fn all() -> Vec<Self> {
        let mut shapes = Vec::new();
        for turn in [(1, 0), (2, 1), (12345, 6789)] {
            for shift in [(0, 0), (20_000_000, 30_000_001)] {
                for scale in [0, -33, 90] {
                    shapes.push(Self { turn, shift, scale });
                }
            }
        }
        shapes
    }

    fn place(self, (x, y): (i64, i64)) -> Point {
        let (a, b) = self.turn;
        let scale = 2f64.powi(self.scale);
        let turned = (a * x - b * y + self.shift.0, a * y + b * x + self.shift.1);
        Point::new(turned.0 as f64 * scale, turned.1 as f64 * scale)
    }

    /// Three elements that touch the circle counterclockwise, and a fourth that touches it too.
    pub fn touching(self, random: &mut Random) -> ([Element; 3], Element) {
        let corners = random.below(4);
        let (first, second, third) = (corners > 0, corners > 1, corners > 2);
        self.touching_as(random, [first, second, third, corners.is_multiple_of(2)])
    }

    /// The same, four corners or four edges.
    pub fn touching_of_kind(self, random: &mut Random, corner: bool) -> ([Element; 3], Element) {
        self.touching_as(random, [corner; 4])
    }

    fn touching_as(self, random: &mut Random, corner: [bool; 4]) -> ([Element; 3], Element) {
        let points = integer_points();
        let mut chosen = Vec::new();
        while chosen.len() < 3 {
            let k = random.below(points.len() as u64) as usize;
            if !chosen.contains(&k) {
                chosen.push(k);
            }
        }
        chosen.sort_unstable();
        let mut element = |k: usize, corner: bool| {
            let (x, y) = points[k];
            if corner {
                return Element::Corner(self.place((x, y)));
            }
            // From the contact backwards and forwards along the tangent.
            let (back, ahead) = (random.below(5) as i64 - 1, random.below(5) as i64 + 2);
            Element::Edge(
                self.place((x + back * y, y - back * x)),
                self.place((x - ahead * y, y + ahead * x)),
            )
        };
        let elements = [0, 1, 2].map(|i| element(chosen[i], corner[i]));
        let fourth = element((chosen[0] + 1 + chosen[2]) % points.len(), corner[3]);
        (elements, fourth)
    }
}

/// The integer points of the circle, counterclockwise.
fn integer_points() -> Vec<(i64, i64)> {
    let mut points = Vec::new();
    for x in -1105i64..=1105 {
        let square = 1105 * 1105 - x * x;
        let y = square.isqrt();
        if y * y == square {
            points.push((x, y));
            if y != 0 {
                points.push((x, -y));
            }
        }
    }
    points
        .sort_by(|a, b| (a.1 as f64).atan2(a.0 as f64).total_cmp(&(b.1 as f64).atan2(b.0 as f64)));
    points
}
