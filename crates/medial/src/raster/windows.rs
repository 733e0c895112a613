//! What can be said of a cell from its eight neighbours: a window of three by three cells is nine bits, three a
//! row from the one above, each from the left.

/// The bit of the cell itself in a window.
const WINDOW_CENTRE: u16 = 1 << 4;

/// The bits of its eight neighbours.
pub(crate) const WINDOW_RING: u16 = 0x1ff & !WINDOW_CENTRE;

/// Whether the cell in the middle of a window can go without changing components and holes.
///
/// Its neighbours that are set hold together without it, and of those that are not just one connected set
/// touches it by a side.
pub(crate) static SIMPLE: [bool; 512] = simple_table();

/// The eight neighbours in a window, counterclockwise from the right.
const RING: [u16; 8] = [5, 8, 7, 6, 3, 0, 1, 2];

const fn simple_table() -> [bool; 512] {
    let mut table = [false; 512];
    let mut window = 0;
    while window < 512 {
        table[window] = is_simple(window as u16);
        window += 1;
    }
    table
}

const fn is_simple(window: u16) -> bool {
    let ring = filled_ring(window);
    let sides = ring[0] as u32 + ring[2] as u32 + ring[4] as u32 + ring[6] as u32;
    n_runs(&ring) == 1 && sides < 4
}

/// The eight neighbours in a window, counterclockwise from the right, sides at even places. A corner whose two
/// sides are set adds nothing to how they hang together, and is set with them.
pub(crate) const fn filled_ring(window: u16) -> [bool; 8] {
    let mut ring = [false; 8];
    let mut k = 0;
    while k < 8 {
        ring[k] = window >> RING[k] & 1 != 0;
        k += 1;
    }
    let mut k = 1;
    while k < 8 {
        ring[k] = ring[k] || (ring[k - 1] && ring[(k + 1) % 8]);
        k += 2;
    }
    ring
}

/// How many runs of set neighbours a ring has: connected sets, unless all are set.
pub(crate) const fn n_runs(ring: &[bool; 8]) -> u32 {
    let (mut runs, mut k) = (0, 0);
    while k < 8 {
        runs += (ring[k] && !ring[(k + 1) % 8]) as u32;
        k += 1;
    }
    runs
}

/// Whether the cell in the middle of a window is neither an end nor needed.
///
/// An end has one neighbour, or two that are beside each other.
#[inline(always)]
pub(crate) fn can_go(window: u16) -> bool {
    CAN_GO[window as usize]
}

static CAN_GO: [bool; 512] = can_go_table();

const fn can_go_table() -> [bool; 512] {
    let mut table = [false; 512];
    let mut window = 0;
    while window < 512 {
        let ring = window as u16 & WINDOW_RING;
        let mut is_end = ring.count_ones() < 2;
        let mut k = 0;
        while k < 8 {
            is_end = is_end || ring == ENDS[k];
            k += 1;
        }
        table[window] = is_simple(window as u16) && !is_end;
        window += 1;
    }
    table
}

/// Pairs of neighbours beside each other.
const ENDS: [u16; 8] = [
    1 << 0 | 1 << 1,
    1 << 1 | 1 << 2,
    1 << 2 | 1 << 5,
    1 << 5 | 1 << 8,
    1 << 8 | 1 << 7,
    1 << 7 | 1 << 6,
    1 << 6 | 1 << 3,
    1 << 3 | 1 << 0,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the set bits of a window, without the centre, are one set of neighbours by that rule.
    fn sets(cells: u16, near: impl Fn(i32, i32) -> bool, counts: impl Fn(i32) -> bool) -> usize {
        let mut left: Vec<i32> = (0..9).filter(|&k| k != 4 && cells >> k & 1 != 0).collect();
        let mut n = 0;
        while let Some(first) = left.pop() {
            let mut set = vec![first];
            let mut k = 0;
            while k < set.len() {
                let (at, rest): (Vec<i32>, Vec<i32>) =
                    left.iter().partition(|&&other| near(set[k], other));
                set.extend(at);
                left = rest;
                k += 1;
            }
            n += usize::from(set.into_iter().any(&counts));
        }
        n
    }

    #[test]
    fn simple_cells_are_those_by_definition() {
        let apart = |a: i32, b: i32| ((a % 3 - b % 3).abs(), (a / 3 - b / 3).abs());
        let by_corner = |a, b| apart(a, b).0 <= 1 && apart(a, b).1 <= 1;
        let by_side = |a, b| apart(a, b).0 + apart(a, b).1 == 1;
        for window in 0..512_u16 {
            let inside = sets(window, by_corner, |_| true);
            let outside = sets(!window & 0x1ff, by_side, |k| by_side(k, 4));
            assert_eq!(SIMPLE[window as usize], inside == 1 && outside == 1, "{window:09b}");
        }
    }
}
