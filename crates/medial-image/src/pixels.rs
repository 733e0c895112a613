//! Pixels by the number that each has, and their outlines in the plane of a grid.

use medial::geom::Point;
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

/// Some pixels in the box around them.
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
    /// The box around pixels of an image with so many columns; `None` without any.
    pub fn around(pixels: &[u64], columns: u32) -> Option<Self> {
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

    /// The outlines in the plane of the grid of the image.
    pub fn polygons(&self, grid: &Grid) -> Polygons {
        placed(grid, &self.corners())
    }
}

/// Corners of pixels in the plane of a grid.
pub(crate) fn placed(grid: &Grid, polygons: &[Vec<Vec<[u32; 2]>>]) -> Polygons {
    let ring = |ring: &Vec<[u32; 2]>| ring.iter().map(|&[x, y]| grid.corner(x, y)).collect();
    polygons.iter().map(|polygon| polygon.iter().map(ring).collect()).collect()
}
