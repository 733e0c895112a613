//! Regions as polygons whose borders are the same points on both sides.

use crate::labels::Labels;
use crate::pixels::{Pixels, polygons};
use medial::geom::Point;

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
        polygons(&own, self.grid())
    }

    /// The polygons of every region, in their order. Linear in pixels and boxes of regions.
    pub fn all_polygons(&self) -> impl Iterator<Item = Vec<Vec<Vec<Point>>>> + '_ {
        let pixels = Pixels::by_number(self.labels(), self.len());
        (0..self.len()).map(move |region| polygons(pixels.of(region), self.grid()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::raster::Grid;

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
