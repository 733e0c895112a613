//! The graph of a set of cells.
//!
//! # Contract
//! Components and cycles of the graph are the components and holes of the set, cells of the set being
//! neighbours by sides and corners. Each cell is a node until nodes are joined.
//!
//! # Method
//! Cells are joined by sides, and by corners where no cell lies at both their sides; of the four sides of a
//! full block of two by two cells the upper one is left out, as a block is no hole. Block after block from the
//! first row on, that takes away one side that belongs to no other block, so nothing else changes.

use super::topology::{find, join};
use super::{Bits, Mask};

/// Cells as nodes, and steps between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PixelGraph {
    /// Column and row of each node, row by row.
    pub cells: Vec<[u32; 2]>,
    /// Nodes at both ends of each step, the lower number first.
    pub steps: Vec<[u32; 2]>,
}

/// Columns, and rows, from the first to the last cell of junctions that are one.
const REACH: u32 = 2;

impl PixelGraph {
    /// The graph of the cells of a mask.
    ///
    /// ```
    /// use medial::raster::{Grid, Mask, PixelGraph};
    /// // A ring of eight cells around one.
    /// let mask = Mask::new(Grid::of_image(3, 3), |x, y| (x, y) != (1, 1))?;
    /// let graph = PixelGraph::new(&mask);
    /// assert_eq!((graph.cells.len(), graph.steps.len()), (8, 8));
    /// # Ok::<(), medial::raster::MaskError>(())
    /// ```
    #[must_use]
    pub fn new(mask: &Mask) -> Self {
        Self::of(&mask.bits)
    }

    pub(crate) fn of(bits: &Bits) -> Self {
        let mut graph = Self::default();
        let rows = bits.rows();
        // Nodes of a row, and those of the next one.
        let mut own = 0..0;
        for y in 0..=rows {
            let below = graph.cells.len() as u32;
            if y < rows {
                graph.cells.extend(bits.ones(y).map(|x| [x, y]));
            }
            let below = below..graph.cells.len() as u32;
            let mut next = below.start;
            for node in own.clone() {
                let [x, _] = graph.cells[node as usize];
                while next < below.end && graph.cells[next as usize][0] + 1 < x {
                    next += 1;
                }
                // The nodes below to the left, below, and below to the right.
                let mut at = [None; 3];
                for (place, found) in at.iter_mut().enumerate() {
                    let first = next + place as u32;
                    let mut candidates = next..below.end.min(first + 1);
                    let column = i64::from(x) + place as i64 - 1;
                    *found = candidates.find(|&k| i64::from(graph.cells[k as usize][0]) == column);
                }
                let is_at = |k: u32, column: i64| {
                    own.contains(&k) && i64::from(graph.cells[k as usize][0]) == column
                };
                let right = is_at(node + 1, i64::from(x) + 1);
                let left = node > 0 && is_at(node - 1, i64::from(x) - 1);
                let [below_left, straight, below_right] = at;
                let is_block = right && straight.is_some() && below_right.is_some();
                if right && !is_block {
                    graph.steps.push([node, node + 1]);
                }
                let steps = [
                    below_left.filter(|_| !left && straight.is_none()),
                    straight,
                    below_right.filter(|_| !right && straight.is_none()),
                ];
                graph.steps.extend(steps.into_iter().flatten().map(|to| [node, to]));
            }
            own = below;
        }
        graph
    }

    /// The steps at each node: places in the second list, from that of the node to that of the next.
    pub(crate) fn incidence(&self) -> (Vec<u32>, Vec<u32>) {
        let mut starts = vec![0_u32; self.cells.len() + 1];
        for &[a, b] in &self.steps {
            starts[a as usize + 1] += 1;
            starts[b as usize + 1] += 1;
        }
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut next = starts.clone();
        let mut steps = vec![0_u32; 2 * self.steps.len()];
        for (number, ends) in (0..).zip(&self.steps) {
            for &node in ends {
                steps[next[node as usize] as usize] = number;
                next[node as usize] += 1;
            }
        }
        (starts, steps)
    }

    /// Takes off ends whose disk lies in that of the junction right beside them, where a node has a disk of
    /// that radius in cells: what is left covers the same.
    pub(crate) fn drop_stubs(&mut self, aspect: f64, radius: impl Fn(u32) -> f64) {
        let (starts, steps) = self.incidence();
        let mut degree: Vec<u32> = starts.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut dropped = vec![false; self.cells.len()];
        for node in 0..self.cells.len() as u32 {
            if degree[node as usize] != 1 {
                continue;
            }
            let around = &steps[starts[node as usize] as usize..starts[node as usize + 1] as usize];
            let Some(&step) = around.iter().find(|&&s| {
                let [a, b] = self.steps[s as usize];
                !dropped[if a == node { b } else { a } as usize]
            }) else {
                continue;
            };
            let [a, b] = self.steps[step as usize];
            let other = if a == node { b } else { a };
            let distance = self.distance(node, other, aspect);
            if degree[other as usize] > 2 && distance + radius(node) <= radius(other) {
                dropped[node as usize] = true;
                degree[other as usize] -= 1;
            }
        }
        self.keep(&dropped, |node| node);
    }

    /// Joins junctions that are beside one another within three by three cells, each set at a node beside all
    /// others, if there is one: that of the largest radius, of several that which is nearest to the middle. Sets
    /// around a hole stay as they are, and so do those that would have two steps between them.
    pub(crate) fn join_junctions(&mut self, radius: impl Fn(u32) -> f64) {
        let n = self.cells.len();
        let (starts, _) = self.incidence();
        let is_junction = |node: u32| starts[node as usize + 1] - starts[node as usize] > 2;
        // Sets of junctions with their boxes, and whether one is around something.
        let mut parent: Vec<u32> = (0..n as u32).collect();
        let mut boxes: Vec<[[u32; 2]; 2]> = self.cells.iter().map(|&cell| [cell; 2]).collect();
        let mut stays = vec![false; n];
        for &[a, b] in &self.steps {
            if !is_junction(a) || !is_junction(b) {
                continue;
            }
            let (a, b) = (find(&mut parent, a), find(&mut parent, b));
            if a == b {
                stays[a as usize] = true;
                continue;
            }
            let [[low, high], [other_low, other_high]] = [boxes[a as usize], boxes[b as usize]];
            let low = [0, 1].map(|axis| low[axis].min(other_low[axis]));
            let high = [0, 1].map(|axis| high[axis].max(other_high[axis]));
            if (0..2).any(|axis| high[axis] - low[axis] > REACH) {
                continue;
            }
            let is_around = stays[a as usize] || stays[b as usize];
            join(&mut parent, a, b);
            stays[a.min(b) as usize] = is_around;
            boxes[a.min(b) as usize] = [low, high];
        }
        let set: Vec<u32> = (0..n as u32).map(|node| find(&mut parent, node)).collect();
        // Twice how far a node is from the middle of its set.
        let off = |node: u32| {
            let [low, high] = boxes[set[node as usize] as usize];
            let cell = self.cells[node as usize];
            (0..2).map(|axis| (2 * cell[axis]).abs_diff(low[axis] + high[axis])).sum::<u32>()
        };
        let is_far = |node: u32| {
            let [low, high] = boxes[set[node as usize] as usize];
            let cell = self.cells[node as usize];
            (0..2).any(|axis| cell[axis] - low[axis] > 1 || high[axis] - cell[axis] > 1)
        };
        let mut best: Vec<u32> = (0..n as u32).collect();
        for node in 0..n as u32 {
            let set = set[node as usize] as usize;
            let order = is_far(best[set]).cmp(&is_far(node));
            let order = order.then_with(|| radius(node).total_cmp(&radius(best[set])));
            if order.then_with(|| off(best[set]).cmp(&off(node))).is_gt() {
                best[set] = node;
            }
        }
        loop {
            let target = |node: u32| {
                let set = set[node as usize] as usize;
                if stays[set] { node } else { best[set] }
            };
            let mut steps: Vec<[u32; 2]> = self.steps.iter().map(|ends| ends.map(target)).collect();
            steps.retain_mut(|ends| {
                ends.sort_unstable();
                ends[0] != ends[1]
            });
            steps.sort_unstable();
            let twice: Vec<[u32; 2]> =
                steps.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
            if twice.is_empty() {
                let target: Vec<u32> = (0..n as u32).map(target).collect();
                let dropped: Vec<bool> =
                    (0..).zip(&target).map(|(node, &target)| target != node).collect();
                return self.keep(&dropped, |node| target[node as usize]);
            }
            twice.into_iter().flatten().for_each(|node| stays[set[node as usize] as usize] = true);
        }
    }

    fn distance(&self, a: u32, b: u32, aspect: f64) -> f64 {
        let ([x1, y1], [x2, y2]) = (self.cells[a as usize], self.cells[b as usize]);
        let (dx, dy) = (f64::from(x1) - f64::from(x2), f64::from(y1) - f64::from(y2));
        (dx * dx + aspect * dy * dy).sqrt()
    }

    /// Drops nodes, after the ends of steps went over to others. Steps within a node go.
    fn keep(&mut self, dropped: &[bool], target: impl Fn(u32) -> u32) {
        let mut number = vec![u32::MAX; self.cells.len()];
        let kept = number.iter_mut().zip(dropped).filter(|(_, dropped)| !**dropped);
        (0..).zip(kept).for_each(|(new, (number, _))| *number = new);
        let mut kept = dropped.iter().map(|dropped| !dropped);
        self.cells.retain(|_| kept.next().unwrap_or(true));
        self.steps.retain_mut(|ends| {
            *ends = ends.map(|node| number[target(node) as usize]);
            ends.sort_unstable();
            ends[0] != ends[1] && ends[1] != u32::MAX
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::dice::dice;
    use crate::raster::topology::of_bits;
    use crate::raster::{Grid, Topology};

    fn random(seed: u64) -> Bits {
        let mut dice = dice(seed);
        let (columns, rows, fill) = (dice() as u32 % 20, dice() as u32 % 20, dice() % 101);
        Mask::new(Grid::of_image(columns, rows), |_, _| dice() % 100 < fill).unwrap().bits
    }

    fn topology_of(graph: &PixelGraph) -> Topology {
        let mut sets: Vec<u32> = (0..graph.cells.len() as u32).collect();
        let mut components = graph.cells.len() as u32;
        for &[a, b] in &graph.steps {
            let (a, b) = (sets[a as usize], sets[b as usize]);
            if a != b {
                sets.iter_mut().filter(|set| **set == a).for_each(|set| *set = b);
                components -= 1;
            }
        }
        let holes = graph.steps.len() as u32 + components - graph.cells.len() as u32;
        Topology { components, holes }
    }

    #[test]
    fn a_graph_hangs_together_as_its_cells_do() {
        for seed in 1..2000 {
            let bits = random(seed);
            let mut graph = PixelGraph::of(&bits);
            assert_eq!(topology_of(&graph), of_bits(&bits), "{seed}");
            graph.join_junctions(|node| f64::from(node % 7));
            // From one side of three by three cells to beyond the other, between two such sets.
            for &[a, b] in &graph.steps {
                let ([x, y], [u, v]) = (graph.cells[a as usize], graph.cells[b as usize]);
                assert!(x.abs_diff(u).max(y.abs_diff(v)) <= 2 * REACH + 1, "{seed}");
            }
            assert_eq!(topology_of(&graph), of_bits(&bits), "{seed}: joined");
            graph.drop_stubs(1.0, |node| f64::from(node % 3));
            assert_eq!(topology_of(&graph), of_bits(&bits), "{seed}: without stubs");
        }
    }
}
