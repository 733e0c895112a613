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

use super::{Bits, Mask};
use crate::geom::DisjointSets;

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
        let n = bits.count() as usize;
        let mut cells = Vec::with_capacity(n);
        // Few cells have more than one step to later ones.
        let mut steps = Vec::with_capacity(n + n / 8);
        let mut end_of_row = 0;
        for y in 0..bits.rows() {
            end_of_row += bits.words(y).map(|(_, word)| word.count_ones()).sum::<u32>();
            // The first node of the row below whose column is in the word, or behind it.
            let mut below = end_of_row;
            for (column, mut word) in bits.words(y) {
                let next = bits.word(column, y + 1);
                while word != 0 {
                    let place = word.trailing_zeros();
                    word &= word - 1;
                    let node = cells.len() as u32;
                    let x = column + place;
                    cells.push([x, y]);
                    // The first node of the row below that is not to the left.
                    let straight = below + (next & ((1 << place) - 1)).count_ones();
                    let window = bits.window(x as i32, y as i32);
                    let is_below = u32::from(window >> 7 & 1);
                    let ends = [node + 1, straight.wrapping_sub(1), straight, straight + is_below];
                    let (order, n) = &STEPS[(window >> 3) as usize];
                    steps.extend(order[..*n].iter().map(|&k| [node, ends[usize::from(k)]]));
                }
                below += next.count_ones();
            }
        }
        Self { cells, steps }
    }

    /// The steps at each node: places in the second list, from that of the node to that of the next.
    pub(crate) fn incidence(&self) -> (Vec<u32>, Vec<u32>) {
        let mut starts = vec![0_u32; self.cells.len() + 1];
        for &[a, b] in &self.steps {
            starts[a as usize] += 1;
            starts[b as usize] += 1;
        }
        // Where the steps of each node end; they are put in from there backwards.
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        let mut steps = vec![0_u32; 2 * self.steps.len()];
        for (number, ends) in (0..self.steps.len() as u32).zip(&self.steps).rev() {
            for &node in ends {
                starts[node as usize] -= 1;
                steps[starts[node as usize] as usize] = number;
            }
        }
        (starts, steps)
    }

    /// For each node how many steps it has, and the numbers of the nodes at their other ends, as bits added
    /// without carries: of an end that is its neighbour.
    fn neighbours(&self) -> Vec<[u32; 2]> {
        let mut found = vec![[0, 0]; self.cells.len()];
        for &[a, b] in &self.steps {
            for (node, other) in [(a, b), (b, a)] {
                let [degree, others] = &mut found[node as usize];
                *degree += 1;
                *others ^= other;
            }
        }
        found
    }

    /// Takes off ends whose disk lies in that of the junction right beside them, where a cell has a disk of
    /// that radius in cells: what is left covers the same.
    pub(crate) fn drop_stubs(&mut self, aspect: f64, radius: impl Fn([u32; 2]) -> f64) {
        let mut neighbours = self.neighbours();
        let mut dropped = Vec::new();
        for node in 0..self.cells.len() {
            let [degree, other] = neighbours[node];
            if degree != 1 || neighbours[other as usize][0] <= 2 {
                continue;
            }
            let distance = self.distance(node as u32, other, aspect);
            let [own, next] = [node, other as usize].map(|node| radius(self.cells[node]));
            if distance + own <= next {
                dropped.push(node as u32);
                neighbours[other as usize][0] -= 1;
            }
        }
        if dropped.is_empty() {
            return;
        }
        let mut number: Vec<u32> = (0..self.cells.len() as u32).collect();
        dropped.iter().for_each(|&node| number[node as usize] = GONE);
        self.keep(number);
    }

    /// Joins junctions that are beside one another within three by three cells, each set at a node beside all
    /// others, if there is one: that of the largest radius, of several that which is nearest to the middle. Sets
    /// around a hole stay as they are, and so do those that would have two steps between them.
    pub(crate) fn join_junctions(&mut self, radius: impl Fn([u32; 2]) -> f64) {
        let neighbours = self.neighbours();
        let is_junction = |node: u32| neighbours[node as usize][0] > 2;
        let links: Vec<[u32; 2]> = self
            .steps
            .iter()
            .copied()
            .filter(|ends| ends.iter().all(|&k| is_junction(k)))
            .collect();
        if links.is_empty() {
            return;
        }
        // Only junctions beside another one matter; they have numbers of their own.
        let mut number = vec![GONE; self.cells.len()];
        links.iter().flatten().for_each(|&node| number[node as usize] = 0);
        let mut nodes: Vec<u32> = Vec::new();
        for (node, number) in (0..).zip(&mut number).filter(|(_, number)| **number == 0) {
            *number = nodes.len() as u32;
            nodes.push(node);
        }
        let cell = |k: u32| self.cells[nodes[k as usize] as usize];
        let n = nodes.len() as u32;
        // Sets of junctions with their boxes, and whether one is around something.
        let mut sets = DisjointSets::new(nodes.len());
        let mut boxes: Vec<[[u32; 2]; 2]> = (0..n).map(|k| [cell(k); 2]).collect();
        let mut stays = vec![false; nodes.len()];
        for &ends in &links {
            let [a, b] = ends.map(|node| sets.first(number[node as usize]));
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
            sets.join(a, b);
            stays[a.min(b) as usize] = is_around;
            boxes[a.min(b) as usize] = [low, high];
        }
        let set: Vec<u32> = (0..n).map(|k| sets.first(k)).collect();
        // Twice how far a node is from the middle of its set.
        let off = |k: u32| {
            let [low, high] = boxes[set[k as usize] as usize];
            (0..2).map(|axis| (2 * cell(k)[axis]).abs_diff(low[axis] + high[axis])).sum::<u32>()
        };
        let is_far = |k: u32| {
            let [low, high] = boxes[set[k as usize] as usize];
            (0..2).any(|axis| cell(k)[axis] - low[axis] > 1 || high[axis] - cell(k)[axis] > 1)
        };
        let radii: Vec<f64> = (0..n).map(|k| radius(cell(k))).collect();
        let mut best: Vec<u32> = (0..n).collect();
        for k in 0..n {
            let set = set[k as usize] as usize;
            let order = is_far(best[set]).cmp(&is_far(k));
            let order = order.then_with(|| radii[k as usize].total_cmp(&radii[best[set] as usize]));
            if order.then_with(|| off(best[set]).cmp(&off(k))).is_gt() {
                best[set] = k;
            }
        }
        let target = |stays: &[bool], node: u32| match number[node as usize] {
            GONE => node,
            k if stays[set[k as usize] as usize] => node,
            k => nodes[best[set[k as usize] as usize] as usize],
        };
        // Two steps can only become the same where both are at such junctions.
        let is_near = |ends: &&[u32; 2]| ends.iter().any(|&node| number[node as usize] != GONE);
        let near: Vec<[u32; 2]> = self.steps.iter().filter(is_near).copied().collect();
        loop {
            let mut steps: Vec<[u32; 2]> =
                near.iter().map(|ends| ends.map(|node| target(&stays, node))).collect();
            steps.retain_mut(|ends| {
                ends.sort_unstable();
                ends[0] != ends[1]
            });
            steps.sort_unstable();
            let twice = steps.windows(2).filter(|pair| pair[0] == pair[1]);
            let ends: Vec<u32> = twice.flat_map(|pair| pair[0]).collect();
            if ends.is_empty() {
                break;
            }
            for k in ends.into_iter().map(|node| number[node as usize]).filter(|&k| k != GONE) {
                stays[set[k as usize] as usize] = true;
            }
        }
        let targets = (0..self.cells.len() as u32).map(|node| target(&stays, node)).collect();
        self.keep(targets);
    }

    fn distance(&self, a: u32, b: u32, aspect: f64) -> f64 {
        let ([x1, y1], [x2, y2]) = (self.cells[a as usize], self.cells[b as usize]);
        let (dx, dy) = (f64::from(x1) - f64::from(x2), f64::from(y1) - f64::from(y2));
        (dx * dx + aspect * dy * dy).sqrt()
    }

    /// Lets the ends of steps go over to other nodes, each of which stays where it is; nodes that do not are
    /// dropped, and with them steps to [`GONE`] or within a node.
    fn keep(&mut self, mut targets: Vec<u32>) {
        // Nodes get their new numbers, which those that go over to them need.
        let mut kept = 0;
        let mut over = Vec::new();
        for (node, target) in (0..).zip(&mut targets) {
            if *target == node {
                *target = kept;
                self.cells[kept as usize] = self.cells[node as usize];
                kept += 1;
            } else if *target != GONE {
                over.push((node, *target));
            }
        }
        self.cells.truncate(kept as usize);
        for (node, target) in over {
            targets[node as usize] = targets[target as usize];
        }
        self.steps.retain_mut(|ends| {
            *ends = ends.map(|node| targets[node as usize]);
            ends.sort_unstable();
            ends[0] != ends[1] && ends[1] != GONE
        });
    }
}

/// No node.
const GONE: u32 = u32::MAX;

/// Which steps a cell has to later ones, by the neighbours in its row and the one below, from the left, itself
/// being the second: 0 to the right, 1 to the left below, 2 below, 3 to the right below; and how many.
static STEPS: [([u8; 4], usize); 64] = steps_table();

const fn steps_table() -> [([u8; 4], usize); 64] {
    let mut table = [([0; 4], 0); 64];
    let mut around = 0;
    while around < 64 {
        let [left, right] = [around & 1 != 0, around >> 2 & 1 != 0];
        let below = [around >> 3 & 1 != 0, around >> 4 & 1 != 0, around >> 5 & 1 != 0];
        let is_block = right && below[1] && below[2];
        let has = [
            right && !is_block,
            below[0] && !left && !below[1],
            below[1],
            below[2] && !right && !below[1],
        ];
        let mut k = 0;
        while k < 4 {
            if has[k] {
                table[around].0[table[around].1] = k as u8;
                table[around].1 += 1;
            }
            k += 1;
        }
        around += 1;
    }
    table
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
            graph.join_junctions(|[x, y]| f64::from((x + 3 * y) % 7));
            // From one side of three by three cells to beyond the other, between two such sets.
            for &[a, b] in &graph.steps {
                let ([x, y], [u, v]) = (graph.cells[a as usize], graph.cells[b as usize]);
                assert!(x.abs_diff(u).max(y.abs_diff(v)) <= 2 * REACH + 1, "{seed}");
            }
            assert_eq!(topology_of(&graph), of_bits(&bits), "{seed}: joined");
            graph.drop_stubs(1.0, |[x, y]| f64::from((x + 2 * y) % 3));
            assert_eq!(topology_of(&graph), of_bits(&bits), "{seed}: without stubs");
        }
    }
}
