use super::{Point, Rect};

/// Cells of the curve along each side.
const SIDE: u64 = 1 << 16;

/// Position of a point along a Hilbert curve of 2^32 cells over a box.
///
/// Sorting by it brings near what is near. Points outside count as on the border.
///
/// ```
/// use medial::geom::{Point, Rect, hilbert};
/// let square = Rect { min: Point::new(0.0, 0.0), max: Point::new(1.0, 1.0) };
/// let at = |x: f64, y: f64| hilbert(&square, Point::new(x, y));
/// assert_eq!(at(0.0, 0.0), 0);
/// // The curve visits the quarters one after another.
/// assert!(at(0.2, 0.2) < at(0.2, 0.8) && at(0.2, 0.8) < at(0.8, 0.8));
/// assert!(at(0.8, 0.8) < at(0.8, 0.2));
/// ```
#[must_use]
pub fn hilbert(bounds: &Rect, point: Point) -> u64 {
    let size = bounds.max - bounds.min;
    // The cast saturates, so an empty or infinite size does no harm.
    let cell = |offset: f64, size: f64| ((offset / size * SIDE as f64) as u64).min(SIDE - 1);
    let (x, y) = (cell(point.x - bounds.min.x, size.x), cell(point.y - bounds.min.y, size.y));
    let (mut key, mut turn) = (0, 0);
    for shift in [12, 8, 4, 0] {
        let entry = QUARTERS[turn][(x >> shift & 15 | (y >> shift & 15) << 4) as usize];
        key = key << 8 | u64::from(entry >> 2);
        turn = usize::from(entry & 3);
    }
    key
}

/// Four steps down the curve at once: for each way in which a square can be passed through, and
/// each of its 16 × 16 cells, the cell's position, times four, plus the way through the cell. Bit 0
/// of a way stands for a mirror image on the diagonal, bit 1 for one on the other diagonal besides.
static QUARTERS: [[u16; 256]; 4] = {
    let mut table = [[0; 256]; 4];
    let mut k = 0;
    while k < 1024 {
        let (mut key, mut way) = (0, k >> 8);
        let mut shift = 4;
        while shift > 0 {
            shift -= 1;
            let (mut right, mut upper) = ((k >> shift & 1) as u16, (k >> (4 + shift) & 1) as u16);
            if way & 2 > 0 {
                (right, upper) = (1 - right, 1 - upper);
            }
            if way & 1 > 0 {
                (right, upper) = (upper, right);
            }
            key = key << 2 | (3 * right) ^ upper;
            if upper == 0 {
                way ^= 1;
                if right == 1 {
                    way ^= 2;
                }
            }
        }
        table[k >> 8][k & 255] = key << 2 | way as u16;
        k += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Position of a cell, one halving of the square at a time.
    fn step_by_step(mut x: u64, mut y: u64) -> u64 {
        let mut key = 0;
        let mut half = SIDE / 2;
        while half > 0 {
            let (right, upper) = (u64::from(x & half > 0), u64::from(y & half > 0));
            key += half * half * ((3 * right) ^ upper);
            if upper == 0 {
                if right == 1 {
                    x = (SIDE - 1) - x;
                    y = (SIDE - 1) - y;
                }
                std::mem::swap(&mut x, &mut y);
            }
            half /= 2;
        }
        key
    }

    #[test]
    fn four_steps_at_once_are_four_steps() {
        let side = SIDE as f64;
        let square = Rect { min: Point::new(0.0, 0.0), max: Point::new(side, side) };
        for k in 0..100_000_u64 {
            let (x, y) = (k * 40_503 % SIDE, k * k * 7 % SIDE);
            let point = Point::new(x as f64, y as f64);
            assert_eq!(hilbert(&square, point), step_by_step(x, y), "{x} {y}");
        }
    }
}
