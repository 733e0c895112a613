//! Regions that are too small, given to their neighbours.

use crate::field::{Field, squared};
use crate::labels::Labels;
use medial::geom::DisjointSets;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Joins each region of fewer pixels to that of its neighbours whose mean is nearest, the smallest first, until all
/// have as many or no neighbours.
pub(crate) fn merge_small(labels: Labels, field: &Field, least: u64) -> Labels {
    if least <= 1 || labels.is_empty() {
        return labels;
    }
    let regions = labels.regions(field);
    let mut cells: Vec<u64> = regions.iter().map(|region| region.cells).collect();
    let mut means: Vec<[f32; 3]> = regions.into_iter().map(|region| region.mean).collect();
    let mut around = neighbours(&labels);
    let mut sets = DisjointSets::new(labels.len() as usize);
    let small = (0..).zip(&cells).filter(|&(_, &n)| n < least);
    let mut waiting: BinaryHeap<Reverse<(u64, u32)>> =
        small.map(|(k, &n)| Reverse((n, k))).collect();
    while let Some(Reverse((n, region))) = waiting.pop() {
        if sets.first(region) != region || cells[region as usize] != n {
            // It grew meanwhile.
            continue;
        }
        let mut beside = std::mem::take(&mut around[region as usize]);
        beside.iter_mut().for_each(|other| *other = sets.first(*other));
        beside.sort_unstable();
        beside.dedup();
        beside.retain(|&other| other != region);
        let mean = means[region as usize];
        let distance = |other: &u32| squared(means[*other as usize], mean);
        let nearest = beside
            .iter()
            .copied()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.cmp(b)));
        let Some(other) = nearest else { continue };
        let (root, gone) = (region.min(other), region.max(other));
        let total = cells[root as usize] + cells[gone as usize];
        let share = cells[gone as usize] as f64 / total as f64;
        let [a, b] = [root, gone].map(|k| means[k as usize]);
        means[root as usize] = [0, 1, 2].map(|axis| {
            let (a, b) = (f64::from(a[axis]), f64::from(b[axis]));
            (a + (b - a) * share) as f32
        });
        cells[root as usize] = total;
        sets.join(root, gone);
        // Those of the other one stay where they are if it goes on.
        let mut more = std::mem::take(&mut around[other as usize]);
        if more.len() < beside.len() {
            std::mem::swap(&mut more, &mut beside);
        }
        more.extend(beside);
        around[root as usize] = more;
        if total < least {
            waiting.push(Reverse((total, root)));
        }
    }
    labels.numbered(|label| sets.first(label))
}

/// The regions that share sides of pixels with each.
fn neighbours(labels: &Labels) -> Vec<Vec<u32>> {
    let columns = labels.grid().columns as usize;
    let of = labels.labels();
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut add = |a: u32, b: u32| {
        if a != b && a != Labels::NONE && b != Labels::NONE {
            pairs.push([a.min(b), a.max(b)]);
        }
    };
    for (k, &label) in of.iter().enumerate() {
        if !(k + 1).is_multiple_of(columns) {
            add(label, of[k + 1]);
        }
        if let Some(&below) = of.get(k + columns) {
            add(label, below);
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    let mut around = vec![Vec::new(); labels.len() as usize];
    for [a, b] in pairs {
        around[a as usize].push(b);
        around[b as usize].push(a);
    }
    around
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::raster::Grid;

    #[test]
    fn small_regions_go_to_the_neighbour_that_is_most_alike() {
        let grid = Grid::of_image(7, 1);
        let class = [0, 0, 0, 1, 2, 2, 2];
        let values = [0.0, 0.0, 0.0, 6.0, 10.0, 10.0, 10.0].map(|v| [v, 0.0, 0.0]);
        let field = Field::new(grid, values).unwrap();
        let labels = Labels::connected(grid, &class, |_, _| true);
        let merged = merge_small(labels.clone(), &field, 2);
        assert_eq!(merged.labels(), [0, 0, 0, 1, 1, 1, 1]);
        assert_eq!(merge_small(labels.clone(), &field, 5).labels(), [0; 7]);
        assert_eq!(merge_small(labels.clone(), &field, 1), labels);
    }

    #[test]
    fn a_region_without_neighbours_stays() {
        let grid = Grid::of_image(3, 1);
        let class = [0, Labels::NONE, 1];
        let field = Field::new(grid, [[0.0; 3]; 3]).unwrap();
        let labels = Labels::connected(grid, &class, |_, _| true);
        assert_eq!(merge_small(labels.clone(), &field, 100), labels);
    }
}
