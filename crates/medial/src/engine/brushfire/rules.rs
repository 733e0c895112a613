//! Which cell may burn, by the cell and its eight neighbours.

use crate::raster::{SIMPLE, WINDOW_RING};

/// A side from which the fire comes.
#[derive(Clone, Copy, Debug)]
pub(super) enum From {
    North,
    South,
    East,
    West,
}

impl From {
    /// The order in which sides take turns [Ros75].
    pub const ALL: [Self; 4] = [Self::North, Self::South, Self::East, Self::West];

    /// Whether that side of the cell in the middle of a window is open.
    pub fn is_open(self, window: u16) -> bool {
        let bit = match self {
            Self::North => 1,
            Self::South => 7,
            Self::East => 5,
            Self::West => 3,
        };
        window >> bit & 1 == 0
    }
}

/// Whether a cell is simple, and no end: it has two neighbours or more.
pub(super) fn is_simple_inside(window: u16) -> bool {
    SIMPLE[window as usize] && (window & WINDOW_RING).count_ones() >= 2
}

/// The neighbours of a window, clockwise from the one above: p2 to p9 in the papers.
fn ring(window: u16) -> [bool; 8] {
    [1, 2, 5, 8, 7, 6, 3, 0].map(|bit| window >> bit & 1 != 0)
}

/// Half a pass of a way to burn that has two.
#[derive(Clone, Copy, Debug)]
pub(super) enum Half {
    First,
    Second,
}

impl Half {
    pub const BOTH: [Self; 2] = [Self::First, Self::Second];
}

/// The rule of Zhang and Suen [ZS84].
pub(super) fn zhang_suen(window: u16, half: Half) -> bool {
    let p = ring(window);
    let [north, _, east, _, south, _, west, _] = p;
    let neighbours = p.iter().filter(|set| **set).count();
    let rises = (0..8).filter(|&k| !p[k] && p[(k + 1) % 8]).count();
    let is_open = match half {
        Half::First => !east || !south || (!north && !west),
        Half::Second => !north || !west || (!east && !south),
    };
    (2..=6).contains(&neighbours) && rises == 1 && is_open
}

/// The rule of Guo and Hall [GH89].
pub(super) fn guo_hall(window: u16, half: Half) -> bool {
    let [p2, p3, p4, p5, p6, p7, p8, p9] = ring(window);
    let sets = [!p2 && (p3 || p4), !p4 && (p5 || p6), !p6 && (p7 || p8), !p8 && (p9 || p2)];
    let count = |all: [bool; 4]| all.iter().filter(|set| **set).count();
    let pairs = [p9 || p2, p3 || p4, p5 || p6, p7 || p8];
    let shifted = [p2 || p3, p4 || p5, p6 || p7, p8 || p9];
    let neighbours = count(pairs).min(count(shifted));
    let stays = match half {
        Half::First => (p6 || p7 || !p9) && p8,
        Half::Second => (p2 || p3 || !p5) && p4,
    };
    count(sets) == 1 && (2..=3).contains(&neighbours) && !stays
}
