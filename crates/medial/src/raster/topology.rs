use super::{Bits, Mask};
use crate::geom::DisjointSets;

/// How a mask hangs together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Topology {
    /// Connected sets of cells of the shape, by sides and corners.
    pub components: u32,
    /// Connected sets of other cells, by sides, that do not reach the outside of the array.
    pub holes: u32,
}

/// The components and holes of a mask. Linear in its runs, nearly.
#[must_use]
pub fn topology(mask: &Mask) -> Topology {
    of_bits(&mask.bits)
}

pub(super) fn of_bits(bits: &Bits) -> Topology {
    let inside = |y: u32, runs: &mut Vec<(u32, u32)>| runs.extend(bits.runs(y));
    let outside = |y: u32, runs: &mut Vec<(u32, u32)>| {
        // A frame of one cell, shifted by one to keep numbers positive.
        let mut last = 0;
        if y > 0 && y <= bits.rows() {
            for (from, to) in bits.runs(y - 1) {
                // There is always a cell between two runs, and one before the first.
                runs.push((last, from + 1));
                last = to + 1;
            }
        }
        runs.push((last, bits.columns() + 2));
    };
    Topology {
        components: sets(bits.rows(), 1, inside),
        holes: sets(bits.rows() + 2, 0, outside) - 1,
    }
}

/// The connected sets of the runs of all rows; runs of neighbouring rows touch if they overlap after the
/// upper one grew by so many cells.
fn sets(rows: u32, reach: u32, runs_of: impl Fn(u32, &mut Vec<(u32, u32)>)) -> u32 {
    let mut sets = DisjointSets::default();
    let [mut above, mut runs] = [const { Vec::new() }; 2];
    for y in 0..rows {
        std::mem::swap(&mut above, &mut runs);
        runs.clear();
        runs_of(y, &mut runs);
        let first = sets.len() as u32;
        let first_above = first - above.len() as u32;
        runs.iter().for_each(|_| sets.push());
        let mut k = 0;
        for (own, &(from, to)) in (first..).zip(&runs) {
            while k < above.len() && above[k].1 + reach <= from {
                k += 1;
            }
            let mut other = k;
            while other < above.len() && above[other].0 < to + reach {
                sets.join(own, first_above + other as u32);
                other += 1;
            }
        }
    }
    sets.count() as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Grid;

    fn of(rows: &[&str]) -> (u32, u32) {
        let columns = rows.first().map_or(0, |row| row.len() as u32);
        let grid = Grid::of_image(columns, rows.len() as u32);
        let is_inside = |x: u32, y: u32| rows[y as usize].as_bytes()[x as usize] == b'#';
        let Topology { components, holes } = topology(&Mask::new(grid, is_inside).unwrap());
        (components, holes)
    }

    #[test]
    fn corners_join_the_shape_and_part_the_rest() {
        assert_eq!(of(&[]), (0, 0));
        assert_eq!(of(&["."]), (0, 0));
        assert_eq!(of(&["#"]), (1, 0));
        assert_eq!(of(&[".#.", "#.#", ".#."]), (1, 1));
        assert_eq!(of(&["#.#", ".#.", "#.#"]), (1, 0));
        assert_eq!(of(&["#####", "#.#.#", "##.##", "#####"]), (1, 3));
        assert_eq!(of(&["#####", "#...#", "#.#.#", "#...#", "#####"]), (2, 1));
        assert_eq!(of(&["#.#", "#.#", "###"]), (1, 0));
    }
}
