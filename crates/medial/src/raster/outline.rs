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
        // Where both are as far, both sides have a crack.
        if dx.abs() >= dy.abs() {
            if dx > 0 { Self::Right } else { Self::Left }
        } else if dy > 0 {
            Self::Below
        } else {
            Self::Above
        }
    }
}

/// An edge of a contour: a run of cracks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CrackEdge {
    pub contour: u32,
    /// Number of its first crack.
    pub first: u32,
    /// The corner of cells where it starts, as columns and rows from the origin. It ends where the next one
    /// starts.
    pub from: [u32; 2],
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

/// The cracks of a mask, numbered along contours.
#[derive(Debug, Default)]
pub(crate) struct Cracks {
    pub contours: Vec<Contour>,
    pub edges: Vec<CrackEdge>,
    /// The edge of each crack.
    pub edge_of: Vec<u32>,
    /// The contour of each crack, and where along it the middle is, as a share of the longest contour in
    /// 2^-31: what is asked for most, in one place.
    places: Vec<[u32; 2]>,
    /// The length of one of these shares.
    share: f64,
    /// The cells outside that have cracks, if cracks are to be found by them.
    margin: Option<Margin>,
    /// Numbers of the cracks at the four sides of each of these cells.
    sides: Vec<[u32; 4]>,
    pub n_polygons: u32,
}

/// No crack.
const NONE: u32 = u32::MAX;

/// From the middle of a crack to that of the next one around a corner.
const AROUND: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A direction along cracks: columns, rows, next ones to the left.
const STEPS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// Where the cells to the left and right of a crack lie from the corner where it starts, and the side of the
/// right one that it is.
const LEFT: [[i32; 2]; 4] = [[0, 0], [-1, 0], [-1, -1], [0, -1]];
const RIGHT: [[i32; 2]; 4] = [[0, -1], [0, 0], [-1, 0], [-1, -1]];
const SIDE: [Side; 4] = [Side::Below, Side::Left, Side::Above, Side::Right];

impl Cracks {
    /// Follows all contours, so that the cracks of a cell outside are known.
    pub fn new(bits: &Bits) -> Self {
        let margin = Margin::new(bits);
        let sides = vec![[NONE; 4]; margin.len()];
        let edge_of = Vec::with_capacity(margin.n_cracks());
        Self { margin: Some(margin), sides, edge_of, ..Self::default() }.of(bits)
    }

    /// Follows all contours, and no more.
    pub fn contours_of(bits: &Bits) -> Self {
        Self::default().of(bits)
    }

    fn of(mut self, bits: &Bits) -> Self {
        // Cracks above cells, once they are in a contour.
        let mut seen = Bits::new(bits.columns(), bits.rows());
        // For each contour, twice the area to its left, and its crack farthest left with a cell of the shape
        // on that side.
        let mut areas: Vec<i64> = Vec::new();
        let mut lefts: Vec<[i32; 2]> = Vec::new();
        for y in 0..bits.rows() as i32 {
            for (from, to) in bits.runs(y as u32) {
                for x in from as i32..to as i32 {
                    if !bits.get(x, y - 1) && !seen.get(x, y) {
                        let (area, left) = self.follow(bits, &mut seen, [x, y]);
                        areas.push(area);
                        lefts.push(left);
                    }
                }
            }
        }
        self.edges.shrink_to_fit();
        drop(seen);
        self.nest(bits, &areas, &lefts);
        self.locate();
        self
    }

    /// Follows one contour from the crack above a cell.
    fn follow(&mut self, bits: &Bits, seen: &mut Bits, start: [i32; 2]) -> (i64, [i32; 2]) {
        let contour = self.contours.len() as u32;
        let first = self.edges.len() as u32;
        let corner = |[x, y]: [i32; 2]| [x as u32, y as u32];
        let (mut at, mut direction) = (start, 0);
        let (mut area, mut left) = (0_i64, [i32::MAX; 2]);
        let (mut along, mut turned) = (0.0, true);
        loop {
            let number = self.edge_of.len() as u32;
            if turned {
                self.edges.push(CrackEdge { contour, first: number, from: corner(at) });
            }
            self.edge_of.push(self.edges.len() as u32 - 1);
            let [dx, dy] = RIGHT[direction];
            let outside = [at[0] + dx, at[1] + dy];
            match direction {
                0 => seen.set(at[0], at[1]),
                1 if at[0] < left[0] => left = at,
                _ => {}
            }
            if let Some(margin) = &self.margin {
                let record = margin.number(outside[0], outside[1]);
                self.sides[record][SIDE[direction] as usize] = number;
            }
            let [sx, sy] = STEPS[direction];
            area += i64::from(at[0]) * i64::from(sy) - i64::from(at[1]) * i64::from(sx);
            at = [at[0] + sx, at[1] + sy];
            // Cells ahead, to the right and to the left: the one behind to the left is of the shape, and so
            // is the diagonal one, which the contour takes along.
            let is_set = |[dx, dy]: [i32; 2]| bits.get(at[0] + dx, at[1] + dy);
            let before = direction;
            if is_set(RIGHT[direction]) {
                direction = (direction + 3) % 4;
            } else if !is_set(LEFT[direction]) {
                direction = (direction + 1) % 4;
            }
            turned = direction != before;
            along += if turned { AROUND } else { 1.0 };
            if at == start && direction == 0 {
                break;
            }
        }
        self.contours.push(Contour { first, polygon: 0, ring: 0, length: along });
        (area, left)
    }

    /// Gives polygons and rings their numbers.
    fn nest(&mut self, bits: &Bits, areas: &[i64], lefts: &[[i32; 2]]) {
        let is_hole = |contour: u32| areas[contour as usize] < 0;
        let n = self.contours.len() as u32;
        let mut rings: Vec<u32> = Vec::new();
        for contour in (0..n).filter(|&k| !is_hole(k)) {
            self.contours[contour as usize].polygon = rings.len() as u32;
            rings.push(1);
        }
        self.n_polygons = rings.len() as u32;
        let mut holes: Vec<u32> = (0..n).filter(|&k| is_hole(k)).collect();
        if holes.is_empty() {
            return;
        }
        // Cracks with a cell of the shape to their right, by place; only those left of some hole matter, but
        // all are few.
        let mut starts: Vec<([u32; 2], u32)> = Vec::with_capacity(self.edges.len() / 2);
        for (number, edge) in (0..).zip(&self.edges) {
            // Upwards: the shape lies to the right.
            let to = self.end_of(number);
            if edge.from[0] == to[0] && to[1] < edge.from[1] {
                starts.push(([edge.from[0], edge.from[1]], edge.contour));
            }
        }
        starts.sort_unstable();
        // From the left to the right, so that the next contour outwards is known.
        holes.sort_by_key(|&hole| lefts[hole as usize]);
        for &hole in &holes {
            let [x, y] = lefts[hole as usize];
            // The cell of the shape left of it, and where its run starts.
            let mut from = x - 1;
            while bits.get(from - 1, y) {
                from -= 1;
            }
            let key = [from as u32, y as u32 + 1];
            let found = starts.partition_point(|(start, _)| *start < key);
            let outward = starts.get(found).map_or(0, |&(_, contour)| contour);
            self.contours[hole as usize].polygon = self.contours[outward as usize].polygon;
        }
        holes.sort_unstable();
        for hole in holes {
            let ring = &mut rings[self.contours[hole as usize].polygon as usize];
            self.contours[hole as usize].ring = *ring;
            *ring += 1;
        }
    }

    /// The crack at a side of a cell outside.
    #[inline(always)]
    pub fn at(&self, x: i32, y: i32, side: Side) -> u32 {
        let record = self.margin.as_ref().map_or(0, |margin| margin.number(x, y));
        self.sides[record][side as usize]
    }

    /// Notes where along its contour each crack is.
    fn locate(&mut self) {
        let longest = self.contours.iter().map(|contour| contour.length).fold(0.0, f64::max);
        self.share = longest * 0.5_f64.powi(31);
        self.places.reserve_exact(self.edge_of.len());
        let n_cracks = self.edge_of.len() as u32;
        let ends = self.edges.iter().skip(1).map(|edge| edge.first).chain([n_cracks]);
        // From the middle of the first crack of a contour.
        let (mut contour, mut along) = (NONE, 0.0);
        for (edge, end) in self.edges.iter().zip(ends) {
            along = if edge.contour == contour { along + AROUND } else { 0.0 };
            contour = edge.contour;
            let n = end - edge.first;
            let place = |k: u32| [contour, ((along + f64::from(k)) / self.share) as u32];
            self.places.extend((0..n).map(place));
            along += f64::from(n - 1);
        }
    }

    /// The contour of a crack, and the length along it from its first crack, between middles, within 2^-31 of
    /// the longest contour.
    #[inline(always)]
    pub fn position(&self, crack: u32) -> (u32, f64) {
        let [contour, along] = self.places[crack as usize];
        (contour, f64::from(along) * self.share)
    }

    /// Where an edge ends.
    pub fn end_of(&self, edge: u32) -> [u32; 2] {
        let edges = &self.edges;
        let contour = edges[edge as usize].contour;
        match edges.get(edge as usize + 1) {
            Some(next) if next.contour == contour => next.from,
            _ => edges[self.contours[contour as usize].first as usize].from,
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
            let ring = edges.map(|edge| grid.corner(edge.from[0], edge.from[1])).collect();
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
