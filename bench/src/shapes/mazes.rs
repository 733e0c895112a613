//! Mazes.

use super::random::Random;
use super::{Ring, SIZE};

/// The outline of the corridors of a random maze without loops, each corner moved by up to a share
/// of a cell.
pub fn maze(random: &mut Random, edges: usize, jitter: f64) -> Ring {
    // A room has about 1.39 corners.
    let side = ((edges as f64 * 0.72).sqrt().round() as usize).max(2);
    let mut seen = vec![false; side * side];
    // Passages to the right of each room, and above it.
    let mut open = vec![[false; 2]; side * side];
    let mut stack = vec![0];
    seen[0] = true;
    while let Some(&room) = stack.last() {
        let (x, y) = (room % side, room / side);
        let neighbours: Vec<(usize, usize, usize)> = [
            (x + 1 < side).then(|| (room + 1, room, 0)),
            (y + 1 < side).then(|| (room + side, room, 1)),
            (x > 0).then(|| (room - 1, room.wrapping_sub(1), 0)),
            (y > 0).then(|| (room - side, room.wrapping_sub(side), 1)),
        ]
        .into_iter()
        .flatten()
        .filter(|n| !seen[n.0])
        .collect();
        if neighbours.is_empty() {
            stack.pop();
            continue;
        }
        let (next, owner, way) = neighbours[random.below(neighbours.len())];
        seen[next] = true;
        open[owner][way] = true;
        stack.push(next);
    }
    // Rooms and passages are full cells of a grid twice as fine, with walls between.
    let cells = 2 * side + 1;
    let full = |x: i64, y: i64| {
        if x < 1 || y < 1 || x >= cells as i64 || y >= cells as i64 {
            return false;
        }
        let (x, y) = (x as usize, y as usize);
        match (x % 2, y % 2) {
            (1, 1) => true,
            (0, 1) => open[(y / 2) * side + x / 2 - 1][0],
            (1, 0) => open[(y / 2 - 1) * side + x / 2][1],
            _ => false,
        }
    };
    // Walk around with the full cells to the left.
    let steps = [(1, 0), (0, 1), (-1, 0), (0, -1)];
    let ahead = |(x, y): (i64, i64), way: usize| match way {
        0 => [full(x, y), full(x, y - 1)],
        1 => [full(x - 1, y), full(x, y)],
        2 => [full(x - 1, y - 1), full(x - 1, y)],
        _ => [full(x, y - 1), full(x - 1, y - 1)],
    };
    let unit = (2.0 * SIZE / cells as f64).floor();
    let mut place = |(x, y): (i64, i64)| {
        let mut jittered = |v: i64| (v as f64 + random.between(-jitter, jitter)) * unit - SIZE;
        let x = jittered(x);
        (x, jittered(y))
    };
    let mut ring = Vec::new();
    let (mut at, mut way) = ((1i64, 1i64), 0);
    loop {
        at = (at.0 + steps[way].0, at.1 + steps[way].1);
        let turned = match ahead(at, way) {
            [_, true] => (way + 3) % 4,
            [false, false] => (way + 1) % 4,
            [true, false] => way,
        };
        if turned != way {
            ring.push(place(at));
            way = turned;
        }
        if at == (1, 1) {
            return ring;
        }
    }
}
