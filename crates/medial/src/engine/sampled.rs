//! The axis made of cells: keypoints at their centres, a path for each step from one to the next.
//!
//! Paths carry the elements at both sides: the one whose nearest point is the foot of the cell, and the one
//! that is nearest to the cell at the other side. They are as true as cells are small, and prove nothing.

use std::ops::ControlFlow;

use smallvec::SmallVec;

use super::draft::site_record;
use super::{EngineError, Options};
use crate::axis::{
    self, Accuracy, Engine, Keypoint, KeypointKind, KeypointTable, MedialAxis, Path, PathTable,
    Side, SiteTable,
};
use crate::domain::{Complement, Corner, Domain, EdgeTree, Site};
use crate::geom::Point;
use crate::raster::{
    Cracks, DigitiseError, Features, Grid, Mask, PixelGraph, Side as CellSide, default_cell,
    digitise, grid_around,
};

/// The boundary as cells see it.
pub(super) trait Boundary {
    /// The element nearest to a cell of the shape, and the point of it that is, from the centre of the cell.
    fn foot(&self, x: i32, y: i32) -> Foot;

    /// The element nearest to a cell beside one of the shape, which may lie outside.
    fn beside(&self, x: i32, y: i32, from: [i32; 2]) -> u32;

    /// Elements, in boundary order.
    fn len(&self) -> u32;

    /// What an axis says of an element.
    fn record(&self, element: u32) -> axis::Site;
}

/// What is nearest to a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    pub element: u32,
    /// Distance of the centre from the boundary, in units of the plane.
    pub radius: f64,
    /// From the centre to the nearest point, in the plane.
    pub way: Point,
}

/// The outline of a mask.
pub(super) struct OutlineBoundary<'a> {
    pub mask: &'a Mask,
    pub features: &'a Features<'a>,
    pub cracks: &'a Cracks,
}

impl OutlineBoundary<'_> {
    /// The edge with the crack of a cell outside that faces another cell.
    fn edge(&self, [x, y]: [i32; 2], to: [i32; 2]) -> u32 {
        let side = CellSide::facing(to[0] - x, to[1] - y);
        self.cracks.at(x, y, side)
    }

    fn edge_nearest(&self, x: i32, y: i32) -> u32 {
        let (dx, dy) = self.features.offset(x, y);
        self.edge([x + dx, y + dy], [x, y])
    }
}

impl Boundary for OutlineBoundary<'_> {
    fn foot(&self, x: i32, y: i32) -> Foot {
        let (dx, dy) = self.features.offset(x, y);
        let [width, height] = self.mask.grid().cell;
        let way = Point::new(f64::from(dx) * width, f64::from(dy) * height);
        Foot {
            element: self.edge_nearest(x, y),
            radius: cell_radius(self.mask.grid(), dx, dy),
            way,
        }
    }

    fn beside(&self, x: i32, y: i32, from: [i32; 2]) -> u32 {
        if self.mask.bits.get(x, y) { self.edge_nearest(x, y) } else { self.edge([x, y], from) }
    }

    fn len(&self) -> u32 {
        self.cracks.edges.len() as u32
    }

    fn record(&self, element: u32) -> axis::Site {
        outline_record(self.cracks, self.mask.grid(), element)
    }
}

/// An element of the outside of a domain as an axis lists it.
pub(super) fn outside_record(outside: &Domain, site: Site) -> axis::Site {
    let mut record = site_record(outside, site);
    // Edges have the interior of the polygons to their left, whatever the side.
    std::mem::swap(&mut record.a, &mut record.b);
    record
}

/// An edge of an outline as an axis lists it.
pub(super) fn outline_record(cracks: &Cracks, grid: &Grid, element: u32) -> axis::Site {
    let edge = &cracks.edges[element as usize];
    let contour = &cracks.contours[edge.contour as usize];
    let ends = [edge.from(), cracks.end_of(element)];
    let [from, to] = ends.map(|[column, row]| grid.corner(column, row));
    // The shape is to the left as long as rows go up when columns go to the right.
    let (a, b) = if grid.is_mirrored() { (to, from) } else { (from, to) };
    let index = element - contour.first;
    let site = axis::Site::edge(a, b);
    axis::Site { polygon: contour.polygon, ring: contour.ring, index, ..site }
}

/// What an engine has left of the cells of a mask, with their distances.
#[derive(Debug)]
pub(super) struct Remains<'m> {
    pub mask: &'m Mask,
    pub features: Features<'m>,
    pub cracks: Cracks,
    pub cells: Mask,
}

impl Remains<'_> {
    /// Columns and rows from a cell of the shape to the nearest one outside; `None` outside of the shape.
    pub fn foot(&self, column: u32, row: u32) -> Option<(i32, i32)> {
        let inside = self.mask.get(column, row);
        inside.then(|| self.features.offset(column as i32, row as i32))
    }

    /// The radius at a cell of the shape; `None` outside of it.
    pub fn radius(&self, column: u32, row: u32) -> Option<f64> {
        self.foot(column, row).map(|(dx, dy)| cell_radius(self.mask.grid(), dx, dy))
    }

    /// How far a cell of the shape is from the nearest one outside, between centres, in widths of a cell.
    pub fn distance(&self, [x, y]: [u32; 2]) -> f64 {
        self.features.squared(x as i32, y as i32).sqrt()
    }

    /// The axis of a graph of cells, with the edges of the mask's outline as sites.
    pub fn axis(&self, graph: &PixelGraph, label: Label) -> Result<MedialAxis, EngineError> {
        let Self { mask, features, cracks, .. } = self;
        let boundary = OutlineBoundary { mask, features, cracks };
        axis_of_cells(graph, mask.grid(), &boundary, label)
    }

    /// The same with the elements of the domain as sites that the mask was made of, and distances from them.
    pub fn axis_of_domain(
        &self,
        domain: &Domain,
        graph: &PixelGraph,
        label: Label,
    ) -> Result<MedialAxis, EngineError> {
        let boundary = DomainBoundary::new(domain, self.mask.grid());
        axis_of_cells(graph, self.mask.grid(), &boundary, label)
    }
}

/// The nearest cells outside of those of a mask, in bands as high as the options say.
pub(super) fn features_of<'m>(mask: &'m Mask, options: &Options<'_>) -> Features<'m> {
    let grid = mask.grid();
    let height = options.band_rows.unwrap_or_else(|| Features::usual_height(&mask.bits));
    Features::new(&mask.bits, grid.aspect(), options.threads, height)
}

/// The cells of a domain, of the size that the options say: those whose centres lie in it.
pub(super) fn cells_of(domain: &Domain, options: &Options<'_>) -> Result<Mask, EngineError> {
    let cell = options.cell.unwrap_or_else(|| default_cell(domain));
    let grid = grid_around(domain, cell, 1)?;
    Ok(digitise(domain, &grid).map_err(DigitiseError::from)?)
}

/// The radius at a cell, so many columns and rows from the nearest cell outside: the distance between both
/// centres less half a cell.
fn cell_radius(grid: &Grid, dx: i32, dy: i32) -> f64 {
    let [width, height] = grid.cell.map(f64::abs);
    if width == height {
        return (f64::from(dx * dx + dy * dy).sqrt() - 0.5) * width;
    }
    let (x, y) = (f64::from(dx) * width, f64::from(dy) * height);
    let distance = (x * x + y * y).sqrt();
    // Half a cell in that direction.
    let half = 0.5 * ((x * width).powi(2) + (y * height).powi(2)).sqrt() / distance;
    distance - half
}

/// The boundary of a domain.
pub(super) struct DomainBoundary<'a> {
    domain: &'a Domain,
    grid: &'a Grid,
    tree: EdgeTree,
    /// The side of the polygons that the domain is.
    side: Side,
}

impl<'a> DomainBoundary<'a> {
    pub fn new(domain: &'a Domain, grid: &'a Grid) -> Self {
        Self { domain, grid, tree: EdgeTree::new(domain, domain.walks()), side: Side::Interior }
    }

    /// The same boundary seen from outside. The frame is none.
    pub fn outside(complement: &'a Complement, grid: &'a Grid) -> Self {
        let domain = complement.domain();
        let walks = domain.walks().iter().filter(|walk| !complement.is_frame(walk.first));
        let tree = EdgeTree::new(domain, &walks.copied().collect::<Vec<_>>());
        Self { domain, grid, tree, side: Side::Exterior }
    }

    /// The element nearest to a point, its distance, and the way to it.
    fn nearest(&self, point: Point) -> (Site, f64, Point) {
        let mut best = (Site(0), f64::INFINITY, Point::default());
        let _ = self.tree.nearest_first(point, |edge| {
            let (start, end) = (self.domain.edge(edge).start, self.domain.end(edge));
            let side = axis::Site::edge(start, end);
            let foot = side.footpoint(point);
            let distance = (foot - point).norm();
            if distance < best.1 {
                let is_reflex = |edge: u32| self.domain.edge(edge).corner == Corner::Reflex;
                let next = self.domain.edge(edge).next;
                let site = if foot == start && is_reflex(edge) {
                    Site::corner(edge)
                } else if foot == end && is_reflex(next) {
                    Site::corner(next)
                } else {
                    Site::edge(edge)
                };
                best = (site, distance, foot - point);
            }
            ControlFlow::Continue(best.1)
        });
        best
    }
}

impl Boundary for DomainBoundary<'_> {
    fn foot(&self, x: i32, y: i32) -> Foot {
        let (site, radius, way) = self.nearest(self.grid.centre(x as u32, y as u32));
        Foot { element: site.0, radius, way }
    }

    fn beside(&self, x: i32, y: i32, _: [i32; 2]) -> u32 {
        let centre = self.grid.place(f64::from(x) + 0.5, f64::from(y) + 0.5);
        self.nearest(centre).0.0
    }

    fn len(&self) -> u32 {
        2 * self.domain.edges().len() as u32
    }

    fn record(&self, element: u32) -> axis::Site {
        match self.side {
            Side::Interior => site_record(self.domain, Site(element)),
            Side::Exterior => outside_record(self.domain, Site(element)),
        }
    }
}

/// What an axis of cells says of itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct Label {
    pub engine: Engine,
    pub side: Side,
    pub complete: bool,
    /// The size of a cell.
    pub cell: f64,
}

/// The axis of a graph of cells.
///
/// # Errors
/// If there are too many elements or nodes for 32-bit numbers.
pub(super) fn axis_of_cells(
    graph: &PixelGraph,
    grid: &Grid,
    boundary: &impl Boundary,
    label: Label,
) -> Result<MedialAxis, EngineError> {
    let (starts, incident) = graph.incidence();
    // Elements to the left and right of each step.
    let mut sides = vec![[0; 2]; graph.steps.len()];
    // Which elements are governors, and their numbers once all are known.
    let mut number = vec![u32::MAX; boundary.len() as usize];
    let mut keypoints = KeypointTable::with_room(graph.cells.len());
    let mut list = Vec::new();
    for (node, &[x, y]) in (0..).zip(&graph.cells) {
        let ends = &starts[node as usize..];
        let around = &incident[ends[0] as usize..ends[1] as usize];
        let foot = boundary.foot(x as i32, y as i32);
        // Steps from earlier nodes are there already.
        for &step in around.iter().filter(|&&step| graph.steps[step as usize][0] == node) {
            sides[step as usize] = sides_of(graph, grid, boundary, &foot, step);
        }
        governors(&mut list, graph, grid, boundary, &sides, &foot, node, around);
        list.iter().for_each(|&element| number[element as usize] = 0);
        // Numbers are in the order of the elements.
        let smallest = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
        list.rotate_left(smallest);
        // The axis outside goes on where the array ends.
        let is_last = x == 0 || y == 0 || x + 1 == grid.columns || y + 1 == grid.rows;
        let kind = match around.len() {
            0 | 1 if is_last && label.side == Side::Exterior => KeypointKind::Clipped,
            0 | 1 => KeypointKind::Tip,
            2 => KeypointKind::Transition,
            _ => KeypointKind::Junction,
        };
        let keypoint = Keypoint { position: grid.centre(x, y), radius: foot.radius, kind };
        keypoints.push(&keypoint, list.iter().copied());
    }
    drop(incident);
    let too_large = || EngineError::TooLarge { n_edges: boundary.len() as usize };
    let n_sites = number.iter().filter(|number| **number == 0).count();
    let mut sites = SiteTable::with_room(n_sites, n_sites, 0);
    for (element, number) in (0..).zip(&mut number).filter(|(_, number)| **number == 0) {
        *number = sites.len();
        sites.push(&boundary.record(element)).ok_or_else(too_large)?;
    }
    sites.shrink();
    keypoints.renumber(|element| number[element as usize]);
    let mut paths = PathTable::with_room(graph.steps.len());
    for (&[from, to], sides) in graph.steps.iter().zip(&sides) {
        let [left, right] = sides.map(|element| number[element as usize]);
        paths.push(&Path { from, to, left, right }, &keypoints);
    }
    paths.shrink();
    let Label { engine, side, complete, cell } = label;
    let accuracy = Accuracy::Sampled(cell);
    Ok(MedialAxis::from_tables(engine, side, accuracy, complete, sites, keypoints, paths))
}

/// The direction of a step, in columns and rows.
fn direction(graph: &PixelGraph, from: u32, to: u32) -> [i32; 2] {
    let ([x1, y1], [x2, y2]) = (graph.cells[from as usize], graph.cells[to as usize]);
    [x2 as i32 - x1 as i32, y2 as i32 - y1 as i32]
}

/// The elements to the left and to the right of a step, whose first node has that foot.
fn sides_of(
    graph: &PixelGraph,
    grid: &Grid,
    boundary: &impl Boundary,
    foot: &Foot,
    step: u32,
) -> [u32; 2] {
    let [from, to] = graph.steps[step as usize];
    let [dx, dy] = direction(graph, from, to);
    let [x, y] = graph.cells[from as usize].map(|at| at as i32);
    let [width, height] = grid.cell;
    let along = Point::new(f64::from(dx) * width, f64::from(dy) * height);
    let turn = along.cross(foot.way);
    // The neighbour to the left, counted in columns and rows.
    let [ux, uy] = [dx.signum(), dy.signum()];
    let left = |sign: i32| {
        let sign = if grid.is_mirrored() { -sign } else { sign };
        let [lx, ly] = [-uy * sign, ux * sign];
        // Between two cells that touch at a corner, the one at both their sides.
        if ux != 0 && uy != 0 { [(ux + lx) / 2, (uy + ly) / 2] } else { [lx, ly] }
    };
    [(1, turn > 0.0), (-1, turn < 0.0)].map(|(sign, is_own)| {
        if is_own {
            return foot.element;
        }
        let [lx, ly] = left(sign);
        boundary.beside(x + lx, y + ly, [x, y])
    })
}

/// Lists the elements around a node with that foot, counterclockwise.
#[expect(clippy::too_many_arguments, reason = "one call, and what it needs is made on the way")]
fn governors(
    list: &mut Vec<u32>,
    graph: &PixelGraph,
    grid: &Grid,
    boundary: &impl Boundary,
    sides: &[[u32; 2]],
    foot: &Foot,
    node: u32,
    around: &[u32],
) {
    // The elements to the right and left of a step, seen from here.
    let seen = |step: u32| {
        let [left, right] = sides[step as usize];
        if graph.steps[step as usize][0] == node { [right, left] } else { [left, right] }
    };
    list.clear();
    match *around {
        [] => {
            let [x, y] = graph.cells[node as usize].map(|at| at as i32);
            list.push(foot.element);
            let turn = if grid.is_mirrored() { -1 } else { 1 };
            let sides = [[1, 0], [0, turn], [-1, 0], [0, -turn]];
            list.extend(sides.map(|[dx, dy]| boundary.beside(x + dx, y + dy, [x, y])));
        }
        // Two ways have the same order as one.
        [step] => list.extend(seen(step)),
        [a, b] => list.extend([seen(a), seen(b)].as_flattened()),
        _ => {
            let angle = |&step: &u32| {
                let [from, to] = graph.steps[step as usize];
                let [dx, dy] = direction(graph, node, if from == node { to } else { from });
                let [width, height] = grid.cell;
                ((f64::from(dy) * height).atan2(f64::from(dx) * width), step)
            };
            let mut ways: SmallVec<[(f64, u32); 4]> = around.iter().map(angle).collect();
            ways.sort_by(|a, b| a.0.total_cmp(&b.0));
            ways.into_iter().for_each(|(_, step)| list.extend(seen(step)));
        }
    }
    list.dedup();
    while list.len() > 1 && list.first() == list.last() {
        list.pop();
    }
}
