//! Points, edges and cells, linked by numbers.

use std::ops::Range;

use super::sheet::{NONE, Sheet};
use super::{Cell, VoronoiError};
use crate::axis::{KeypointKind, Side};
use crate::check::Name;
use crate::domain::Site;
use crate::geom::{Point, Rect};
use crate::ops::groups::Groups;

/// A point where edges of the diagram end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoronoiPoint {
    /// Where it is.
    pub position: Point,
    /// Distance from the boundary.
    pub radius: f64,
    /// What it is.
    pub kind: PointKind,
}

/// What a point of the diagram is; [`name`](Self::name) gives its name in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PointKind {
    /// A corner of the boundary where normals start.
    Corner,
    /// A keypoint of an axis.
    Keypoint(KeypointKind),
    /// Where an unbounded normal meets the frame outside, or a corner of the frame.
    Frame,
}

impl PointKind {
    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Corner => "corner",
            Self::Keypoint(kind) => kind.name(),
            Self::Frame => "frame",
        }
    }
}

/// What an edge of the diagram is; [`name`](Self::name) gives its name in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum EdgeKind {
    /// A path of the medial axis.
    Path,
    /// The normal of an edge at a reflex corner, or at a straight joint: no part of the axis.
    Normal,
    /// A piece of the frame at which unbounded cells are closed.
    Frame,
}

impl EdgeKind {
    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Path => "path",
            Self::Normal => "normal",
            Self::Frame => "frame",
        }
    }
}

/// An edge of the diagram, between two cells; or on the frame, to the right of which there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VoronoiEdge {
    /// The side of the boundary it lies on.
    pub side: Side,
    /// Path, normal, or piece of the frame.
    pub kind: EdgeKind,
    /// Point where it starts; a normal starts at its corner.
    pub from: u32,
    /// Point where it ends.
    pub to: u32,
    /// The element whose cell lies to its left.
    pub left: u32,
    /// The element whose cell lies to its right; none for a piece of the frame.
    pub right: Option<u32>,
}

impl VoronoiEdge {
    /// The site across from one of the two, if there is one.
    #[must_use]
    pub fn across(&self, site: u32) -> Option<u32> {
        if self.left == site { self.right } else { Some(self.left) }
    }
}

/// The whole diagram.
#[derive(Debug, Default)]
pub(super) struct Graph {
    pub points: Vec<VoronoiPoint>,
    pub edges: Vec<VoronoiEdge>,
    cells: Vec<Record>,
    /// Edges around all cells.
    around: Vec<u32>,
    sides: Vec<Numbers>,
}

/// Numbers of one side.
#[derive(Debug)]
struct Numbers {
    first_point: u32,
    /// For each site its cell, or [`NONE`].
    cells: Vec<u32>,
}

#[derive(Debug)]
struct Record {
    side: Side,
    site: u32,
    around: Range<u32>,
}

impl Graph {
    /// The diagram of these sides, closed at a frame outside.
    pub fn new(sheets: &[Sheet], frame: &Rect) -> Result<Self, VoronoiError> {
        let mut graph = Self::default();
        for sheet in sheets {
            graph.add_side(sheet, frame)?;
        }
        Ok(graph)
    }

    fn add_side(&mut self, sheet: &Sheet, frame: &Rect) -> Result<(), VoronoiError> {
        let first_point = self.points.len() as u32;
        let first_edge = self.edges.len() as u32;
        self.points.extend(sheet.axis.keypoints().iter().map(|k| VoronoiPoint {
            position: k.position,
            radius: k.radius,
            kind: PointKind::Keypoint(k.kind),
        }));
        let number = |site| sheet.number(sheet.governor(site));
        self.edges.extend(sheet.axis.paths().iter().map(|path| VoronoiEdge {
            side: sheet.axis.side,
            kind: EdgeKind::Path,
            from: first_point + path.from,
            to: first_point + path.to,
            left: number(path.left),
            right: Some(number(path.right)),
        }));
        let mut corners = Corners(vec![NONE; sheet.domain().edges().len()]);
        let mut contacts = Vec::new();
        for keypoint in 0..sheet.axis.keypoints().len() as u32 {
            let list = sheet.governors(keypoint);
            let after = list.clone().cycle().skip(1);
            for (before, after) in list.zip(after) {
                if let Some(corner) = sheet.one_contact(before, after) {
                    let from = corners.point(self, sheet, corner);
                    self.add_normal(sheet, from, first_point + keypoint, [before, after]);
                    contacts.push([before, after]);
                }
            }
        }
        if sheet.axis.side == Side::Exterior {
            contacts.sort_unstable();
            self.add_long_normals(sheet, &mut corners, &contacts, frame);
            self.add_frame(sheet, first_edge, frame)?;
        }
        let cells = self.add_cells(sheet, first_edge)?;
        self.sides.push(Numbers { first_point, cells });
        Ok(())
    }

    /// Adds the normal between the cells of two elements that follow one another along the boundary.
    ///
    /// Seen from the corner, the first is on the left.
    pub(super) fn add_normal(
        &mut self,
        sheet: &Sheet,
        from: u32,
        to: u32,
        [before, after]: [Site; 2],
    ) {
        self.edges.push(VoronoiEdge {
            side: sheet.axis.side,
            kind: EdgeKind::Normal,
            from,
            to,
            left: sheet.number(before),
            right: Some(sheet.number(after)),
        });
    }

    /// Links the edges from this one on to cells; gives the number of the cell of each site.
    fn add_cells(&mut self, sheet: &Sheet, first_edge: u32) -> Result<Vec<u32>, VoronoiError> {
        let sites = sheet.n_sites();
        // The pieces around each site, from those of the edges from `first_edge` on.
        let by_site = Groups::new(sites, || {
            self.pieces(first_edge).filter_map(|piece| Some((self.left(piece)?, piece)))
        });
        let mut cell_of = vec![NONE; sites];
        let mut links = Links::new(self.points.len());
        for &element in &sheet.elements {
            let site = sheet.number(element);
            let first = self.around.len() as u32;
            if !self.link(sheet, element, by_site.of(site), &mut links) {
                return Err(VoronoiError::Open { name: Name::of(sheet.domain(), element) });
            }
            cell_of[site as usize] = self.cells.len() as u32;
            let around = first..self.around.len() as u32;
            self.cells.push(Record { side: sheet.axis.side, site, around });
        }
        Ok(cell_of)
    }

    /// Adds the pieces around one cell in their order; whether they close it.
    fn link(&mut self, sheet: &Sheet, element: Site, pieces: &[u32], links: &mut Links) -> bool {
        let site = sheet.number(element);
        for &piece in pieces {
            links.leaving[self.start(piece) as usize] = piece;
            links.arrived[self.end(piece) as usize] = site;
        }
        // The chain beside an edge is open, that around a corner begins and ends there.
        let begins = |&piece: &u32| {
            let start = self.start(piece) as usize;
            if element.is_edge() {
                links.arrived[start] != site
            } else {
                self.points[start].kind == PointKind::Corner
            }
        };
        let Some(first) = pieces.iter().copied().find(begins) else { return false };
        let mut piece = first;
        for left in (0..pieces.len()).rev() {
            self.around.push(piece >> 1);
            if left > 0 {
                piece = links.leaving[self.end(piece) as usize];
                if piece == NONE || self.left(piece) != Some(site) {
                    return false;
                }
            }
        }
        let ends = [self.start(first), self.end(piece)].map(|k| self.points[k as usize].position);
        ends == sheet.ends_around(element)
    }

    /// All cells, for each side in the order of their sites.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = Cell<'_>> {
        self.cells.iter().map(|record| self.cell(record))
    }

    /// The cell of a site on the side with that number.
    pub fn cell_of(&self, side: usize, site: u32) -> Option<Cell<'_>> {
        let number = *self.sides[side].cells.get(site as usize)?;
        self.cells.get(number as usize).map(|record| self.cell(record))
    }

    /// The keypoint of the axis of a side that a point is.
    pub fn keypoint(&self, side: usize, point: u32) -> Option<u32> {
        let is_keypoint = matches!(self.points[point as usize].kind, PointKind::Keypoint(_));
        is_keypoint.then(|| point - self.sides[side].first_point)
    }

    fn cell(&self, record: &Record) -> Cell<'_> {
        let around = record.around.start as usize..record.around.end as usize;
        Cell { side: record.side, site: record.site, edges: &self.around[around] }
    }

    /// The pieces from an edge on: an edge, twice its number, and where there is a cell to its right,
    /// the edge backwards, one more.
    pub(super) fn pieces(&self, first_edge: u32) -> impl Iterator<Item = u32> + use<'_> {
        let all = 2 * first_edge..2 * self.edges.len() as u32;
        all.filter(|&piece| self.left(piece).is_some())
    }

    /// Where a piece starts.
    pub(super) fn start(&self, piece: u32) -> u32 {
        let edge = &self.edges[(piece >> 1) as usize];
        if piece & 1 == 0 { edge.from } else { edge.to }
    }

    pub(super) fn end(&self, piece: u32) -> u32 {
        self.start(piece ^ 1)
    }

    /// The site to the left of a piece.
    pub(super) fn left(&self, piece: u32) -> Option<u32> {
        let edge = &self.edges[(piece >> 1) as usize];
        if piece & 1 == 0 { Some(edge.left) } else { edge.right }
    }
}

/// What links the pieces around the cell at hand, by the points where they end; entries of earlier
/// cells remain.
struct Links {
    /// The piece that leaves each point.
    leaving: Vec<u32>,
    /// The site around which a piece arrives at each point.
    arrived: Vec<u32>,
}

impl Links {
    fn new(points: usize) -> Self {
        Self { leaving: vec![NONE; points], arrived: vec![NONE; points] }
    }
}

/// The point of each corner where normals start, once there is one.
pub(super) struct Corners(Vec<u32>);

impl Corners {
    /// The point of a corner.
    pub fn point(&mut self, graph: &mut Graph, sheet: &Sheet, corner: Site) -> u32 {
        let point = &mut self.0[corner.index() as usize];
        if *point == NONE {
            *point = graph.points.len() as u32;
            let position = sheet.domain().edge(corner.index()).start;
            graph.points.push(VoronoiPoint { position, radius: 0.0, kind: PointKind::Corner });
        }
        *point
    }
}
