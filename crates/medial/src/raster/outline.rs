//! The outline of a mask: cracks between cells inside and outside, followed with the shape on the left.
//!
//! # Contract
//! Every crack belongs to one contour, every contour is a closed ring of axis-parallel edges that turns at
//! every vertex, and each component of the shape (by sides and corners) is one polygon: an outer ring, and one
//! for each of its holes. Where two cells of the shape touch at a corner only, their ring goes on across it, so
//! it comes there twice. Linear in cells and cracks.
//!
//! # Method
//! Contours start at cracks above a cell in row order, so the first one of a component is that of its outer
//! ring. Along the row from a hole to the left lies the contour that is next outwards, and so on to the outer
//! ring.
//!
//! For measuring, the outline is the polygon through the middles of its cracks: its length is the same along
//! rows, columns and diagonals as that of a straight boundary, and never more than 8% too much.

use super::margin::Margin;
use super::{Bits, Grid, Mask};
use crate::geom::Point;

/// The side of a cell outside at which a cell of the shape lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Right,
    Below,
    Left,
    Above,
}

impl Side {
    /// The side of a cell outside that faces a cell so many columns and rows away from it, if it is the
    /// nearest one of that.
    #[inline(always)]
    pub fn facing(dx: i32, dy: i32) -> Self {
        // Where both are as far, both sides have a crack. What it is is hard to foresee, so nothing branches.
        let is_across = dx.abs() >= dy.abs();
        let is_before = if is_across { dx } else { dy } > 0;
        SIDES[usize::from(!is_across) + 2 * usize::from(!is_before)]
    }
}

const SIDES: [Side; 4] = [Side::Right, Side::Below, Side::Left, Side::Above];

/// An edge of a contour: a run of cracks.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CrackEdge {
    /// How far along the contour the middle of its first crack is, from that of the contour's first.
    along: f64,
    pub contour: u32,
    /// The corner of cells where it starts, by column and row, which fit.
    corner: [u16; 2],
}

impl CrackEdge {
    /// The corner of cells where it starts, as columns and rows from the origin. It ends where the next one
    /// starts.
    #[inline(always)]
    pub fn from(&self) -> [u32; 2] {
        self.corner.map(u32::from)
    }
}

/// A contour: a ring of edges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contour {
    /// Number of the first edge; the others follow up to the first one of the next contour.
    pub first: u32,
    pub polygon: u32,
    pub ring: u32,
    /// Length of the polygon through the middles of its cracks.
    pub length: f64,
}

/// The cracks of a mask, in edges along contours.
#[derive(Debug, Default)]
pub(crate) struct Cracks {
    pub contours: Vec<Contour>,
    pub edges: Vec<CrackEdge>,
    /// How many cracks there are.
    pub n_cracks: usize,
    /// Positions along contours are rounded down to multiples of this, 2^-31 of the longest one.
    share: f64,
    /// The cells outside that have cracks, if cracks are to be found by them.
    margin: Option<Margin>,
    /// The edges at the four sides of each of these cells.
    sides: Vec<[u32; 4]>,
    pub n_polygons: u32,
}

/// No crack.
const NONE: u32 = u32::MAX;

/// From the middle of a crack to that of the next one around a corner.
const AROUND: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A direction along cracks: columns, rows, next ones to the left.
const STEPS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// Where the cell to the right of a crack lies from the corner where it starts, and the side of that cell that
/// the crack is.
const RIGHT: [[i32; 2]; 4] = [[0, -1], [0, 0], [-1, 0], [-1, -1]];
const SIDE: [Side; 4] = [Side::Below, Side::Left, Side::Above, Side::Right];

/// The direction after each direction, by the [block](Bits::block) of cells around the corner between them.
static NEXT: [[u8; 16]; 4] = next_table();

const fn next_table() -> [[u8; 16]; 4] {
    /// The bits of the cells ahead, to the left and to the right, by direction. The one behind to the left is
    /// of the shape; so is the one ahead to the right if it is set, which the contour takes along.
    const LEFT: [usize; 4] = [8, 4, 1, 2];
    const RIGHT: [usize; 4] = [2, 8, 4, 1];
    let mut table = [[0; 16]; 4];
    let mut k = 0;
    while k < 64 {
        let (direction, block) = (k / 16, k % 16);
        let turn = if block & RIGHT[direction] != 0 {
            3
        } else if block & LEFT[direction] == 0 {
            1
        } else {
            0
        };
        table[direction][block] = ((direction + turn) % 4) as u8;
        k += 1;
    }
    table
}

impl Cracks {
    /// Follows all contours, so that the cracks of a cell outside are known.
    pub fn new(bits: &Bits) -> Self {
        let margin = Margin::new(bits);
        let sides = vec![[NONE; 4]; margin.len()];
        Self { margin: Some(margin), sides, ..Self::default() }.of(bits)
    }

    /// Follows all contours, and no more.
    pub fn contours_of(bits: &Bits) -> Self {
        Self::default().of(bits)
    }

    fn of(mut self, bits: &Bits) -> Self {
        // Cracks above cells, once they are in a contour.
        let mut seen = Bits::new(bits.columns(), bits.rows());
        // An edge starts at each corner; one more is written before it is known that there is none.
        let n_edges = bits.n_corners();
        self.edges = vec![CrackEdge::default(); n_edges + 1];
        let mut holes = Vec::new();
        let mut next = 0;
        for y in 0..bits.rows() {
            for (column, word) in bits.words(y) {
                let above = if y > 0 { bits.word(column, y - 1) } else { 0 };
                let mut starts = word & !above & !seen.word(column, y);
                while starts != 0 {
                    let start = [(column + starts.trailing_zeros()) as i32, y as i32];
                    let contour = self.contours.len() as u32;
                    if self.follow(bits, &mut seen, start, &mut next) {
                        holes.push(contour);
                    }
                    starts &= !seen.word(column, y);
                }
            }
        }
        drop(seen);
        self.edges.truncate(n_edges);
        let longest = self.contours.iter().map(|contour| contour.length).fold(0.0, f64::max);
        self.share = longest * 0.5_f64.powi(31);
        self.nest(bits, &holes);
        self
    }

    /// Follows one contour from the crack above a cell, where it has a corner, with the next edges; whether it
    /// is around a hole.
    fn follow(&mut self, bits: &Bits, seen: &mut Bits, start: [i32; 2], next: &mut u32) -> bool {
        let contour = self.contours.len() as u32;
        let first = *next;
        let (mut at, mut direction) = (start, 0);
        let (mut length, mut turns, mut n_cracks) = (0.0, 0, 0);
        let edge = |at: [i32; 2], along| CrackEdge { along, contour, corner: at.map(|c| c as u16) };
        // The edge at hand, how far along the contour it starts, and how many of its cracks are behind.
        let (mut number, mut along, mut behind) = (first, 0.0, 0);
        self.edges[number as usize] = edge(start, along);
        loop {
            seen.set_if(at[0], at[1], direction == 0);
            if let Some(margin) = &self.margin {
                let [dx, dy] = RIGHT[direction];
                let record = margin.number(at[0] + dx, at[1] + dy);
                self.sides[record][SIDE[direction] as usize] = number;
            }
            n_cracks += 1;
            let [sx, sy] = STEPS[direction];
            at = [at[0] + sx, at[1] + sy];
            let turned = usize::from(NEXT[direction][bits.block(at[0], at[1])]);
            let is_corner = turned != direction;
            length += if is_corner { AROUND } else { 1.0 };
            // To the left by one, to the right by three.
            turns += [0, 1, 0, -1][(turned + 4 - direction) % 4];
            direction = turned;
            if at == start && direction == 0 {
                break;
            }
            // Whether there is a corner is hard to foresee, so nothing branches on it.
            let corner = along + f64::from(behind) + AROUND;
            self.edges[number as usize + 1] = edge(at, corner);
            number += u32::from(is_corner);
            along = if is_corner { corner } else { along };
            behind = if is_corner { 0 } else { behind + 1 };
        }
        *next = number + 1;
        self.n_cracks += n_cracks;
        self.contours.push(Contour { first, polygon: 0, ring: 0, length });
        turns < 0
    }

    /// Gives polygons and rings their numbers.
    fn nest(&mut self, bits: &Bits, holes: &[u32]) {
        let n = self.contours.len() as u32;
        let mut rings: Vec<u32> = Vec::new();
        let mut next_hole = holes.iter().copied().peekable();
        for contour in (0..n).filter(|&k| next_hole.next_if_eq(&k).is_none()) {
            self.contours[contour as usize].polygon = rings.len() as u32;
            rings.push(1);
        }
        self.n_polygons = rings.len() as u32;
        if holes.is_empty() {
            return;
        }
        // From the left to the right, so that the next contour outwards is known.
        let mut lefts: Vec<([u32; 2], u32)> =
            holes.iter().map(|&hole| (self.leftmost(hole), hole)).collect();
        lefts.sort_unstable();
        let rights = self.rights();
        for ([x, y], hole) in lefts {
            // The cell of the shape left of it, and where its run starts.
            let (mut from, y) = (x as i32 - 1, y as i32);
            while bits.get(from - 1, y) {
                from -= 1;
            }
            let outward = match &self.margin {
                Some(_) => self.edges[self.at(from - 1, y, Side::Right) as usize].contour,
                None => {
                    let key = [from as u32, y as u32 + 1];
                    let found = rights.partition_point(|(start, _)| *start < key);
                    rights.get(found).map_or(0, |&(_, contour)| contour)
                }
            };
            self.contours[hole as usize].polygon = self.contours[outward as usize].polygon;
        }
        for &hole in holes {
            let ring = &mut rings[self.contours[hole as usize].polygon as usize];
            self.contours[hole as usize].ring = *ring;
            *ring += 1;
        }
    }

    /// Where the crack of a contour starts that is farthest left, of those with a cell of the shape on that
    /// side.
    fn leftmost(&self, contour: u32) -> [u32; 2] {
        let edges = self.edges_of(contour);
        let ends = edges.iter().skip(1).chain(edges.first());
        let down = edges.iter().zip(ends).filter(|(edge, end)| edge.corner[1] < end.corner[1]);
        down.map(|(edge, _)| edge.from()).min_by_key(|&[x, _]| x).unwrap_or_default()
    }

    /// The edges with the shape to their right, by place, with their contours; none if cracks can be found by
    /// cells.
    fn rights(&self) -> Vec<([u32; 2], u32)> {
        if self.margin.is_some() {
            return Vec::new();
        }
        let mut rights = Vec::with_capacity(self.edges.len() / 2);
        for (number, edge) in (0..).zip(&self.edges) {
            let (from, to) = (edge.from(), self.end_of(number));
            if to[1] < from[1] {
                rights.push((from, edge.contour));
            }
        }
        rights.sort_unstable();
        rights
    }

    /// The edge with the crack at a side of a cell outside.
    #[inline(always)]
    pub fn at(&self, x: i32, y: i32, side: Side) -> u32 {
        let record = self.margin.as_ref().map_or(0, |margin| margin.number(x, y));
        self.sides[record][side as usize]
    }

    /// The contour of the crack at a side of a cell outside, and the length along it from its first crack,
    /// between middles, within 2^-31 of the longest contour.
    #[inline(always)]
    pub fn position(&self, x: i32, y: i32, side: Side) -> (u32, f64) {
        let edge = &self.edges[self.at(x, y, side) as usize];
        let [column, row] = edge.corner.map(i32::from);
        let is_along = matches!(side, Side::Below | Side::Above);
        let from_corner = if is_along { x - column } else { y - row };
        // Below and to the left the edge goes to the next cells; else it comes from the far side of this one.
        let is_forwards = matches!(side, Side::Below | Side::Left);
        let behind = if is_forwards { from_corner } else { -1 - from_corner };
        let shares = ((edge.along + f64::from(behind)) / self.share) as u32;
        (edge.contour, f64::from(shares) * self.share)
    }

    /// Where an edge ends.
    pub fn end_of(&self, edge: u32) -> [u32; 2] {
        let edges = &self.edges;
        let contour = edges[edge as usize].contour;
        match edges.get(edge as usize + 1) {
            Some(next) if next.contour == contour => next.from(),
            _ => edges[self.contours[contour as usize].first as usize].from(),
        }
    }

    /// The edges of a contour.
    pub fn edges_of(&self, contour: u32) -> &[CrackEdge] {
        let first = self.contours[contour as usize].first as usize;
        let end =
            self.contours.get(contour as usize + 1).map_or(self.edges.len(), |c| c.first as usize);
        &self.edges[first..end]
    }

    /// The polygons, each with its outer ring first, of a grid.
    pub fn polygons(&self, grid: &Grid) -> Vec<Vec<Vec<Point>>> {
        let mut polygons = vec![Vec::new(); self.n_polygons as usize];
        // Outer rings come before their holes.
        for (number, contour) in (0..).zip(&self.contours) {
            let edges = self.edges_of(number).iter();
            let corner = |[column, row]: [u32; 2]| grid.corner(column, row);
            let ring = edges.map(|edge| corner(edge.from())).collect();
            polygons[contour.polygon as usize].push(ring);
        }
        polygons
    }
}

/// The outline of a mask along the sides of its cells: one polygon for each component, each a list of rings, the
/// outer one first, without a closing point.
///
/// Rings run with the shape on the left, seen with rows going up. Cells that touch at a corner only are in
/// one ring, which comes there twice.
///
/// ```
/// use medial::geom::Point;
/// use medial::raster::{Grid, Mask, outline};
/// let mask = Mask::new(Grid::of_image(3, 3), |x, y| (x, y) != (1, 1))?;
/// let polygons = outline(&mask);
/// assert_eq!((polygons.len(), polygons[0].len()), (1, 2));
/// assert_eq!(polygons[0][0][0], Point::new(0.0, 0.0));
/// assert_eq!(polygons[0][1].len(), 4);
/// # Ok::<(), medial::raster::MaskError>(())
/// ```
#[must_use]
pub fn outline(mask: &Mask) -> Vec<Vec<Vec<Point>>> {
    Cracks::contours_of(&mask.bits).polygons(mask.grid())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::dice::dice;

    #[test]
    fn cracks_are_found_by_their_cells_along_their_contours() {
        for seed in 1..500 {
            let mut dice = dice(seed);
            let (columns, rows, fill) = (dice() as u32 % 20, dice() as u32 % 20, dice() % 101);
            let grid = Grid::of_image(columns, rows);
            let mask = Mask::new(grid, |_, _| dice() % 100 < fill).unwrap();
            let cracks = Cracks::new(&mask.bits);
            // The cracks of each contour by their corners, walked again.
            let mut places = std::collections::BTreeMap::new();
            for (contour, record) in (0..).zip(&cracks.contours) {
                let mut along = 0.0;
                for (number, edge) in (record.first..).zip(cracks.edges_of(contour)) {
                    let (from, to) = (edge.from(), cracks.end_of(number));
                    let n = from[0].abs_diff(to[0]) + from[1].abs_diff(to[1]);
                    assert!((from[0] == to[0]) != (from[1] == to[1]), "{seed}");
                    for k in 0..n {
                        let end =
                            |k: u32| [0, 1].map(|axis| (from[axis] * (n - k) + to[axis] * k) / n);
                        places.insert([end(k), end(k + 1)], (contour, number, along));
                        along += if k + 1 < n { 1.0 } else { AROUND };
                    }
                }
                assert!((along - record.length).abs() < 1e-9, "{seed}");
            }
            assert_eq!(places.len(), cracks.n_cracks, "{seed}");
            // All cells outside with one of the shape at a side, with the shape to the left of the crack.
            let ways = [
                (Side::Right, [1, 0], [[1, 1], [1, 0]]),
                (Side::Below, [0, 1], [[0, 1], [1, 1]]),
                (Side::Left, [-1, 0], [[0, 0], [0, 1]]),
                (Side::Above, [0, -1], [[1, 0], [0, 0]]),
            ];
            let mut n_cracks = 0;
            for y in -1..=rows as i32 {
                for x in -1..=columns as i32 {
                    for (side, [dx, dy], ends) in ways {
                        let (u, v) = (x + dx, y + dy);
                        let is_within =
                            (0..columns as i32).contains(&u) && (0..rows as i32).contains(&v);
                        if mask.bits.get(x, y) || !is_within || !mask.bits.get(u, v) {
                            continue;
                        }
                        n_cracks += 1;
                        let ends = ends.map(|[ex, ey]| [(x + ex) as u32, (y + ey) as u32]);
                        let (contour, edge, along) = places[&ends];
                        assert_eq!(cracks.at(x, y, side), edge, "{seed}");
                        let found = cracks.position(x, y, side);
                        assert_eq!(found.0, contour, "{seed}");
                        assert!((found.1 - along).abs() < 1e-6, "{seed}: {} {along}", found.1);
                    }
                }
            }
            assert_eq!(n_cracks, cracks.n_cracks, "{seed}");
        }
    }

    #[test]
    fn holes_belong_to_the_contour_around_them_with_and_without_a_margin() {
        for seed in 1..500 {
            let mut dice = dice(seed);
            let (columns, rows, fill) = (dice() as u32 % 20, dice() as u32 % 20, 40 + dice() % 60);
            let grid = Grid::of_image(columns, rows);
            let mask = Mask::new(grid, |_, _| dice() % 100 < fill).unwrap();
            let rings = |cracks: Cracks| -> Vec<[u32; 2]> {
                cracks.contours.iter().map(|contour| [contour.polygon, contour.ring]).collect()
            };
            let found = rings(Cracks::new(&mask.bits));
            assert_eq!(found, rings(Cracks::contours_of(&mask.bits)), "{seed}");
            let n_holes = found.iter().filter(|ring| ring[1] > 0).count();
            let expected = crate::raster::topology(&mask);
            assert_eq!(n_holes, expected.holes as usize, "{seed}");
            assert_eq!(found.len() - n_holes, expected.components as usize, "{seed}");
        }
    }
}
