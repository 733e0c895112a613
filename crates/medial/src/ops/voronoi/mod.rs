//! The Voronoi diagram of the boundary elements [Lee82, §I].
//!
//! # Contract
//! Each edge, and each corner that is reflex as seen from a side, has a cell on that side: the points
//! nearer to it than to anything else of the boundary. Cells are bounded by the paths of the axis and
//! by the normals at reflex corners [Lee82, cor. 3]; which ones, and in which order, is exact as the
//! axis is. [`Voronoi::locate`] is the image function of the paper: the nearest element of any
//! point, decided exactly, with its footpoint and distance. Building takes O(n log n) for n edges.
//!
//! # Method
//! 1. A path lies between the cells of its two governors. A normal runs from a corner to each
//!    keypoint that the corner and its own edge touch in one contact.
//! 2. Around a cell each piece ends where the next begins, at a keypoint, so cells are linked by
//!    numbers only.
//! 3. Outside, normals end at the frame at which the axis is cut, and cells are closed along it: see
//!    [`frame`].
//! 4. A point is located among the edges near it, by a tree of boxes; where too many of them are
//!    about equally near, by the maximal disks that hold the point: see [`locate`] and [`descent`].
//!
//! # Departures
//! Where touching rings make a straight joint, the normal between the two pieces of the line is an
//! edge of the diagram too; the paper has no such joints.

mod cells;
mod chain;
mod descent;
mod error;
mod frame;
mod graph;
mod locate;
mod nearest;
mod sheet;

pub use error::VoronoiError;
pub use graph::{EdgeKind, PointKind, VoronoiEdge, VoronoiPoint};
pub use locate::{Contact, Located, Region};

use std::sync::OnceLock;

use crate::axis::{Accuracy, Curve, MedialAxis, Side, Site};
use crate::domain::Domain;
use crate::engine::exterior_frame;
use crate::geom::{Point, Rect};
use graph::Graph;
use locate::Seeker;
use sheet::Sheet;

/// The Voronoi diagram of the boundary elements of a domain, on the sides whose axes it is made of.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{EdgeKind, Region, Voronoi};
///
/// let ring = [(0., 0.), (3., 0.), (3., 1.), (1., 1.), (1., 3.), (0., 3.)];
/// let ring = ring.map(|(x, y)| Point::new(x, y)).to_vec();
/// let domain = Domain::from_polygons(&[vec![ring]], &Options::default())?;
/// let axes = [path_tracing(&domain)?];
/// let voronoi = Voronoi::new(&domain, &axes)?;
/// // Six edges and one reflex corner, with a normal to each side.
/// assert_eq!(voronoi.cells().len(), 7);
/// assert_eq!(voronoi.edges().iter().filter(|e| e.kind == EdgeKind::Normal).count(), 2);
/// // Under the upper wall of the right arm.
/// let located = voronoi.locate(Point::new(2.0, 0.75))?;
/// assert_eq!((located.region, located.distance), (Region::Interior, 0.25));
/// assert_eq!(located.contacts[0].footpoint, Point::new(2.0, 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Voronoi<'a> {
    domain: &'a Domain,
    sheets: Vec<Sheet<'a>>,
    /// Where cells outside are closed.
    frame: Rect,
    sites: Vec<Site>,
    graph: Graph,
    seeker: OnceLock<Seeker>,
}

/// The cell of a boundary element on one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<'v> {
    /// The side of the boundary it lies on.
    pub side: Side,
    /// Number of the element among the [`sites`](Voronoi::sites).
    pub site: u32,
    /// Numbers of the [`edges`](Voronoi::edges) around it, counterclockwise: for an edge from its end,
    /// as the side sees it with itself on the left, to its start; for a corner from the corner back to it.
    pub edges: &'v [u32],
}

impl<'a> Voronoi<'a> {
    /// The diagram that these axes of the domain bound: complete and exact ones, one for each side. Cells
    /// outside are closed at the usual frame, the box of the domain grown by its longer side, as the axis
    /// is cut there.
    ///
    /// Without any axis there are no cells, but points are located all the same.
    ///
    /// # Errors
    /// If an axis is incomplete or sampled, is not of this domain, is cut at another frame, or leaves a
    /// cell open; or if two axes are of one side.
    pub fn new(domain: &'a Domain, axes: &'a [MedialAxis]) -> Result<Self, VoronoiError> {
        let frame = match axes.iter().any(|axis| axis.side == Side::Exterior) {
            true => exterior_frame(domain, None).map_err(|_| VoronoiError::Frame)?,
            false => Rect::EMPTY,
        };
        Self::within(domain, axes, &frame)
    }

    /// The same, with cells outside closed at a frame that the exterior axis was cut at; see
    /// [`exterior_frame`].
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn within(
        domain: &'a Domain,
        axes: &'a [MedialAxis],
        frame: &Rect,
    ) -> Result<Self, VoronoiError> {
        for (k, axis) in axes.iter().enumerate() {
            // Outside the frame may have cut off more than what is unbounded.
            let whole = axis.complete || axis.side == Side::Exterior;
            if !whole || axis.accuracy != Accuracy::Exact {
                return Err(VoronoiError::Incomplete { side: axis.side });
            }
            if axes[..k].iter().any(|other| other.side == axis.side) {
                return Err(VoronoiError::Repeated { side: axis.side });
            }
        }
        let sheets = axes.iter().map(|axis| Sheet::new(domain, axis, frame));
        let mut sheets: Vec<Sheet> = sheets.collect::<Result<_, _>>()?;
        let sites = sheet::number(&mut sheets);
        let graph = Graph::new(&sheets, frame)?;
        Ok(Self { domain, sheets, frame: *frame, sites, graph, seeker: OnceLock::new() })
    }

    /// The domain.
    #[must_use]
    pub fn domain(&self) -> &'a Domain {
        self.domain
    }

    /// The axes, one for each side.
    pub fn axes(&self) -> impl Iterator<Item = &'a MedialAxis> {
        self.sheets.iter().map(|sheet| sheet.axis)
    }

    /// The elements that have a cell: those of the first axis along the boundary, then those that only
    /// the second one has. Inside these are the sites of the axis, in their order.
    #[must_use]
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// The points where edges end: for each axis its keypoints, in their order, then the corners where
    /// normals start, and points of the frame.
    #[must_use]
    pub fn points(&self) -> &[VoronoiPoint] {
        &self.graph.points
    }

    /// The edges between the cells: for each axis its paths, in their order, then the normals, then pieces
    /// of the frame.
    #[must_use]
    pub fn edges(&self) -> &[VoronoiEdge] {
        &self.graph.edges
    }

    /// The cells, for each side in the order of their sites.
    #[must_use]
    pub fn cells(&self) -> impl ExactSizeIterator<Item = Cell<'_>> {
        self.graph.cells()
    }

    /// The shape of an edge, with the distance from its governors as radius; along the frame that is so at
    /// the ends only.
    #[must_use]
    pub fn curve(&self, edge: &VoronoiEdge) -> Curve {
        let end = |point: u32| {
            let VoronoiPoint { position, radius, .. } = self.graph.points[point as usize];
            (position, radius)
        };
        let (from, to) = (end(edge.from), end(edge.to));
        let site = |number: u32| &self.sites[number as usize];
        match (edge.kind, edge.right) {
            (EdgeKind::Path, Some(right)) => Curve::new(site(edge.left), site(right), from, to),
            _ => cells::straight(from, to),
        }
    }

    /// The closed outline of a cell, counterclockwise: its element first if that is an edge, then the
    /// edges around it.
    #[must_use]
    pub fn outline(&self, cell: &Cell<'_>) -> Vec<Curve> {
        cells::outline(self, cell)
    }

    /// The outline of a cell as a ring that is no farther than `tolerance` from it; the first point is
    /// not repeated. Neighbours are drawn with the same points between them.
    #[must_use]
    pub fn ring(&self, cell: &Cell<'_>, tolerance: f64) -> Vec<Point> {
        cells::ring(self, cell, tolerance)
    }

    /// The element nearest to a point, or all of them, with the place of the point: see [`Located`].
    ///
    /// Any point of the plane is located, on whichever side it lies. What is nearest is decided
    /// exactly. Where the diagram has cells it takes O(log n) questions, also where many elements are
    /// about equally near, as in the centre of a polygon of many equal sides; and one more for each
    /// element if there are several nearest ones.
    ///
    /// # Errors
    /// If a coordinate is not finite, or is neither 0 nor between 2^-200 and 2^200 in magnitude.
    pub fn locate(&self, point: Point) -> Result<Located, VoronoiError> {
        let fits = |value: f64| value == 0.0 || (LEAST..=MOST).contains(&value.abs());
        if !(fits(point.x) && fits(point.y)) {
            return Err(VoronoiError::Coordinates { point });
        }
        let seeker = self.seeker.get_or_init(|| Seeker::new(self));
        Ok(seeker.locate(self, point))
    }
}

/// Least and greatest magnitude of coordinates, which predicates are proved for.
const LEAST: f64 = f64::from_bits((1023 - 200) << 52);
const MOST: f64 = f64::from_bits((1023 + 200) << 52);

#[cfg(test)]
mod tests;
