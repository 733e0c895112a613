//! Pixels by the number that each has, and their outlines in the plane of a grid.

use medial::geom::{DisjointSets, Point};
use medial::raster::{Grid, Mask, outline};

/// Polygons: each a list of rings, the outer one first.
pub(crate) type Polygons = Vec<Vec<Vec<Point>>>;

/// The pixels of each number, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Pixels {
    /// Where those of a number start, and at last where all end.
    starts: Vec<u64>,
    pixels: Vec<u64>,
}

/// Some pixels that hang together by sides, in the box around them.
pub(crate) struct Window {
    /// On a grid of whole numbers, rows upwards, so that corners are those of the image whatever box they are seen from.
    pub mask: Mask,
    /// Column and row of the first cell.
    pub first: [u32; 2],
}

impl Pixels {
    /// Those of the numbers below `n`; others are left out.
    pub fn by_number(numbers: &[u32], n: u32) -> Self {
        let mut starts = vec![0_u64; n as usize + 1];
        for &number in numbers.iter().filter(|&&number| number < n) {
            starts[number as usize + 1] += 1;
        }
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut next = starts.clone();
        let mut pixels = vec![0_u64; starts[n as usize] as usize];
        for (k, &number) in (0..).zip(numbers).filter(|&(_, &number)| number < n) {
            pixels[next[number as usize] as usize] = k;
            next[number as usize] += 1;
        }
        Self { starts, pixels }
    }

    /// Those of a number.
    pub fn of(&self, number: u32) -> &[u64] {
        let [start, end] = [number, number + 1].map(|k| self.starts[k as usize] as usize);
        &self.pixels[start..end]
    }
}

impl Window {
    /// Windows of pixels of an image with so many columns, given by their numbers in order: one for each part that
    /// hangs together by sides, in the order of their first pixels.
    ///
    /// Parts that meet at a corner only are polygons of their own: one ring around both would touch itself.
    pub fn parts(pixels: &[u64], columns: u32) -> Vec<Self> {
        let parts = parts(pixels, u64::from(columns));
        parts.iter().filter_map(|part| Self::around(part, columns)).collect()
    }

    /// The box around pixels; `None` without any.
    fn around(pixels: &[u64], columns: u32) -> Option<Self> {
        let columns = u64::from(columns);
        let place = |pixel: &u64| [(pixel % columns) as u32, (pixel / columns) as u32];
        let mut low = [u32::MAX; 2];
        let mut high = [0; 2];
        for at in pixels.iter().map(place) {
            for axis in 0..2 {
                low[axis] = low[axis].min(at[axis]);
                high[axis] = high[axis].max(at[axis] + 1);
            }
        }
        let size = [0, 1].map(|axis| high[axis].checked_sub(low[axis]));
        let [Some(width), Some(height)] = size else { return None };
        let grid = Grid { cell: [1.0, 1.0], ..Grid::of_image(width, height) };
        // Smaller than the image, which is one.
        let mut mask = Mask::empty(grid).ok()?;
        pixels.iter().map(place).for_each(|[x, y]| mask.put(x - low[0], y - low[1], true));
        Some(Self { mask, first: low })
    }

    /// The outlines as corners of the pixels of the image.
    pub fn corners(&self) -> Vec<Vec<Vec<[u32; 2]>>> {
        let [left, top] = self.first;
        let corner = |p: &Point| [left + p.x as u32, top + p.y as u32];
        let ring = |ring: &Vec<Point>| ring.iter().map(corner).collect();
        let polygon = |rings: &Vec<Vec<Point>>| rings.iter().map(ring).collect();
        outline(&self.mask).iter().map(polygon).collect()
    }
}

/// The polygons of pixels, given by their numbers in order, in the plane of the grid of their image; outer rings run
/// counterclockwise, holes clockwise.
pub(crate) fn polygons(pixels: &[u64], grid: &Grid) -> Polygons {
    let windows = Window::parts(pixels, grid.columns);
    windows.iter().flat_map(|window| placed(grid, &window.corners())).collect()
}

/// The parts of pixels, given in order, that hang together by sides, each in order.
fn parts(pixels: &[u64], columns: u64) -> Vec<Vec<u64>> {
    let mut sets = DisjointSets::new(pixels.len());
    // The first pixel that is not before the one above.
    let mut above = 0;
    for (k, &pixel) in pixels.iter().enumerate() {
        if k > 0 && pixels[k - 1] + 1 == pixel && !pixel.is_multiple_of(columns) {
            sets.join(k as u32 - 1, k as u32);
        }
        while pixels[above] + columns < pixel {
            above += 1;
        }
        if pixels[above] + columns == pixel {
            sets.join(above as u32, k as u32);
        }
    }
    let mut parts: Vec<Vec<u64>> = Vec::new();
    let mut part_of = vec![0; pixels.len()];
    for (k, &pixel) in pixels.iter().enumerate() {
        // The first one of a part comes before the others.
        let first = sets.first(k as u32) as usize;
        if first == k {
            part_of[k] = parts.len();
            parts.push(Vec::new());
        }
        parts[part_of[first]].push(pixel);
    }
    parts
}

/// Corners of pixels in the plane of a grid.
fn placed(grid: &Grid, polygons: &[Vec<Vec<[u32; 2]>>]) -> Polygons {
    let corner = |&[column, row]: &[u32; 2]| grid.corner(column, row);
    let ring = |ring: &Vec<[u32; 2]>| turned(grid, ring.iter().map(corner).collect());
    polygons.iter().map(|polygon| polygon.iter().map(ring).collect()).collect()
}

/// A ring in the plane of a grid with the shape on its left, of one that has it there in columns and rows.
pub(crate) fn turned(grid: &Grid, mut ring: Vec<Point>) -> Vec<Point> {
    if grid.is_mirrored() && !ring.is_empty() {
        ring[1..].reverse();
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_hang_together_by_sides() {
        // Three columns: one and two pixels that meet at a corner, and one in the next row that is no neighbour.
        //   # . #
        //   . # .
        //   . # #
        assert_eq!(parts(&[0, 2, 4, 7, 8], 3), [vec![0], vec![2], vec![4, 7, 8]]);
        // The end of a row is not beside the start of the next one, and a part may begin twice.
        assert_eq!(parts(&[2, 3, 5], 3), [vec![2, 5], vec![3]]);
        assert_eq!(parts(&[0, 2, 3, 4, 5], 3), [vec![0, 2, 3, 4, 5]]);
        assert_eq!(parts(&[], 3), Vec::<Vec<u64>>::new());
    }

    #[test]
    fn pixels_that_meet_at_a_corner_are_polygons_of_their_own() {
        let found = polygons(&[0, 3], &Grid::of_image(2, 2));
        let square = |x: f64, y: f64| {
            let corners = [[x, y], [x, y - 1.0], [x + 1.0, y - 1.0], [x + 1.0, y]];
            vec![corners.map(|[x, y]| Point::new(x, y)).to_vec()]
        };
        assert_eq!(found, [square(0.0, 0.0), square(1.0, -1.0)]);
    }

    #[test]
    fn outer_rings_run_counterclockwise_wherever_rows_go() {
        let area = |ring: &Vec<Point>| {
            let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
            0.5 * pairs.map(|(a, b)| a.cross(*b)).sum::<f64>()
        };
        // A ring of pixels around one, three by three.
        for cell in [[2.0, 1.0], [2.0, -1.0], [-2.0, 1.0], [-2.0, -1.0]] {
            let grid = Grid { cell, ..Grid::of_image(3, 3) };
            let found = polygons(&[0, 1, 2, 3, 5, 6, 7, 8], &grid);
            assert_eq!(found[0].iter().map(area).collect::<Vec<_>>(), [18.0, -2.0], "{cell:?}");
        }
    }
}
