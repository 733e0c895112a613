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
    let mut x = cell(point.x - bounds.min.x, size.x);
    let mut y = cell(point.y - bounds.min.y, size.y);
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
