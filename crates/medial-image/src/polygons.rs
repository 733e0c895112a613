//! Regions as polygons whose borders are the same points on both sides.

use crate::labels::Labels;
use medial::geom::Point;
use medial::raster::{Grid, Mask, outline};

/// Polygons of a region: each a list of rings, the outer one first.
type Polygons = Vec<Vec<Vec<Point>>>;

impl Labels {
    /// The polygons of a region along the sides of its pixels, in the plane of the grid.
    ///
    /// # Panics
    /// If there is no such region.
    #[must_use]
    pub fn polygons(&self, region: u32) -> Vec<Vec<Vec<Point>>> {
        assert!(region < self.len(), "a region");
        let all = (0..).zip(self.labels());
        let own = all.filter(|&(_, &label)| label == region).map(|(k, _)| k).collect::<Vec<u64>>();
        self.polygons_of(&own)
    }

    /// The polygons of every region, in their order. Linear in pixels and boxes of regions.
    pub fn all_polygons(&self) -> impl Iterator<Item = Vec<Vec<Vec<Point>>>> + '_ {
        // Pixels by region.
        let mut starts = vec![0_u64; self.len() as usize + 1];
        let in_some = |label: &u32| *label != Self::NONE;
        for &label in self.labels().iter().filter(|label| in_some(label)) {
            starts[label as usize + 1] += 1;
        }
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut next = starts.clone();
        let mut pixels = vec![0_u64; starts.last().map_or(0, |&n| n as usize)];
        for (k, &label) in (0..).zip(self.labels()).filter(|(_, label)| in_some(label)) {
            pixels[next[label as usize] as usize] = k;
            next[label as usize] += 1;
        }
        (0..self.len() as usize)
            .map(move |k| self.polygons_of(&pixels[starts[k] as usize..starts[k + 1] as usize]))
    }

    /// The polygons of pixels, given by their numbers in order.
    fn polygons_of(&self, pixels: &[u64]) -> Polygons {
        let columns = u64::from(self.grid().columns);
        let place = |pixel: &u64| [(pixel % columns) as u32, (pixel / columns) as u32];
        let mut low = [u32::MAX; 2];
        let mut high = [0; 2];
        for at in pixels.iter().map(place) {
            for axis in 0..2 {
                low[axis] = low[axis].min(at[axis]);
                high[axis] = high[axis].max(at[axis] + 1);
            }
        }
        // Whole numbers in the box, so that corners are those of the grid, whatever box they are seen from.
        let window = Grid {
            cell: [1.0, 1.0],
            ..Grid::of_image(high[0].saturating_sub(low[0]), high[1].saturating_sub(low[1]))
        };
        let Ok(mut mask) = Mask::empty(window) else { return Vec::new() };
        pixels.iter().map(place).for_each(|[x, y]| mask.put(x - low[0], y - low[1], true));
        let corner = |p: &Point| self.grid().corner(low[0] + p.x as u32, low[1] + p.y as u32);
        let ring = |ring: &Vec<Point>| ring.iter().map(corner).collect();
        let polygon = |rings: &Vec<Vec<Point>>| rings.iter().map(ring).collect();
        outline(&mask).iter().map(polygon).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(ring: &[Point]) -> f64 {
        let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
        0.5 * pairs.map(|(a, b)| a.cross(*b)).sum::<f64>()
    }

    #[test]
    fn polygons_of_all_regions_fill_the_grid() {
        let class: Vec<u32> = (0..40 * 30).map(|k: u32| (k * k / 7 + k / 40) % 3).collect();
        let grid = Grid { origin: Point::new(0.1, 7.3), cell: [0.3, -0.7], columns: 40, rows: 30 };
        let labels = Labels::connected(grid, &class, |_, _| true);
        let mut total = 0.0;
        for (k, polygons) in (0..).zip(labels.all_polygons()) {
            assert_eq!(polygons, labels.polygons(k));
            assert_eq!(polygons.len(), 1, "connected by sides");
            total += polygons.iter().flatten().map(|ring| area(ring)).sum::<f64>();
        }
        assert!((total.abs() - 40.0 * 30.0 * 0.21).abs() < 1e-9, "{total}");
    }

    #[test]
    fn neighbours_share_their_corners_bit_for_bit() {
        let grid = Grid { origin: Point::new(0.1, 0.2), cell: [0.3, 0.7], columns: 9, rows: 4 };
        let class: Vec<u32> = (0..36).map(|k| u32::from(k % 9 > 4)).collect();
        let labels = Labels::connected(grid, &class, |_, _| true);
        let [left, right] = [0, 1].map(|k| labels.polygons(k)[0][0].clone());
        let shared: Vec<&Point> = left.iter().filter(|p| right.contains(p)).collect();
        assert_eq!(shared.len(), 2);
    }
}
