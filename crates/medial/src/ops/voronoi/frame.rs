//! The frame outside, at which cells are closed.
//!
//! # Method
//! 1. A normal that meets no keypoint goes on to the frame: those of edges on the convex hull, which are
//!    unbounded, and those that meet one beyond the frame.
//! 2. A cell comes to the frame where a path is cut or such a normal ends, and leaves it where the next
//!    one does, counterclockwise: with each of its points a cell has the way to the footpoint, and so has
//!    the frame, so what the two share is in one piece.
//! 3. Which corners of the frame lie between is asked of the corners: whose cell they are in is decided
//!    exactly, as points are located. One on the border of two cells is such a point itself. Where a cell
//!    has several stretches of the frame, places along it tell them apart; only the drawing depends on
//!    their rounding.

use super::VoronoiError;
use super::graph::{Corners, EdgeKind, Graph, PointKind, VoronoiEdge, VoronoiPoint};
use super::locate::nearest_parts;
use super::nearest::footpoint;
use super::sheet::Sheet;
use crate::axis::KeypointKind;
use crate::domain::{Corner, EdgeTree, Site};
use crate::geom::{Point, Rect};

impl Graph {
    /// Adds the normals that meet no keypoint inside the frame, up to there; those that do are given by
    /// the elements to both sides, in order.
    pub(super) fn add_long_normals(
        &mut self,
        sheet: &Sheet,
        corners: &mut Corners,
        short: &[[Site; 2]],
        frame: &Rect,
    ) {
        let domain = sheet.domain();
        for edge in sheet.ground.walks().iter().flat_map(|walk| walk.edges()) {
            let (corner, before) = (Site::corner(edge), domain.edge(edge).prev);
            let normals = match domain.edge(edge).corner {
                Corner::Convex => continue,
                Corner::Reflex => {
                    &[(before, [Site::edge(before), corner]), (edge, [corner, Site::edge(edge)])][..]
                }
                Corner::Straight => &[(edge, [Site::edge(before), Site::edge(edge)])],
            };
            for &(along, sites) in normals {
                if short.binary_search(&sites).is_ok() {
                    continue;
                }
                let from = corners.point(self, sheet, corner);
                let normal = domain.edge(along).direction.perp();
                let (position, radius) = hit(frame, domain.edge(edge).start, normal);
                let to = self.points.len() as u32;
                self.points.push(VoronoiPoint { position, radius, kind: PointKind::Frame });
                self.add_normal(sheet, from, to, sites);
            }
        }
    }

    /// Closes the cells of a side along the frame; its edges are those from this one on.
    pub(super) fn add_frame(
        &mut self,
        sheet: &Sheet,
        first_edge: u32,
        frame: &Rect,
    ) -> Result<(), VoronoiError> {
        // Where cells come to the frame and leave it: site, place along the frame, point.
        let (mut comes, mut leaves) = (Vec::new(), Vec::new());
        for piece in self.pieces(first_edge) {
            let Some(site) = self.left(piece) else { continue };
            for (point, list) in [(self.end(piece), &mut comes), (self.start(piece), &mut leaves)] {
                if self.is_on_frame(point, frame)? {
                    list.push((site, along(frame, self.points[point as usize].position), point));
                }
            }
        }
        let by_site = |list: &mut Vec<(u32, f64, u32)>| {
            list.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        };
        by_site(&mut comes);
        by_site(&mut leaves);
        let corners = corners_of(frame);
        let tree = EdgeTree::new(sheet.domain(), sheet.ground.walks());
        let owners = corners.map(|corner| owner(sheet, &tree, corner));
        for stretches in comes.chunk_by(|a, b| a.0 == b.0) {
            let site = stretches[0].0;
            let first = leaves.partition_point(|leave| leave.0 < site);
            let ends: Vec<_> = leaves[first..].iter().take_while(|leave| leave.0 == site).collect();
            if ends.len() != stretches.len() {
                // The cell stays open, and is found so.
                continue;
            }
            let is_own =
                |k: usize| owners[k % 4].is_some_and(|(owner, _)| sheet.number(owner) == site);
            for &(_, place, point) in stretches {
                // The first end ahead, once around if need be.
                let ahead = |at: f64| if at < place { at + 4.0 } else { at };
                let Some(end) = ends.iter().min_by(|a, b| ahead(a.1).total_cmp(&ahead(b.1))) else {
                    continue;
                };
                let mut own: Vec<usize> = (0..4).filter(|&k| is_own(k)).collect();
                if stretches.len() == 1 {
                    // Never all four: the cell lies in the angle between two normals, less than half a
                    // turn.
                    let first = (0..4).find(|&k| is_own(k) && !is_own(k + 3)).unwrap_or(0);
                    own.sort_by_key(|k| (k + 4 - first) % 4);
                } else {
                    own.retain(|&k| ahead(k as f64) < ahead(end.1));
                    own.sort_by(|&a, &b| ahead(a as f64).total_cmp(&ahead(b as f64)));
                }
                let mut from = point;
                for k in own {
                    let radius = owners[k].map_or(0.0, |owner| owner.1);
                    let (to, position) = (self.points.len() as u32, corners[k]);
                    self.points.push(VoronoiPoint { position, radius, kind: PointKind::Frame });
                    self.add_piece(sheet, site, from, to);
                    from = to;
                }
                self.add_piece(sheet, site, from, end.2);
            }
        }
        Ok(())
    }

    fn add_piece(&mut self, sheet: &Sheet, site: u32, from: u32, to: u32) {
        let (side, kind) = (sheet.axis.side, EdgeKind::Frame);
        self.edges.push(VoronoiEdge { side, kind, from, to, left: site, right: None });
    }

    /// Whether a point is one of those on the frame; an error if a path is cut elsewhere.
    fn is_on_frame(&self, point: u32, frame: &Rect) -> Result<bool, VoronoiError> {
        let VoronoiPoint { position: p, kind, .. } = self.points[point as usize];
        let Rect { min, max } = *frame;
        match kind {
            PointKind::Frame => Ok(true),
            PointKind::Keypoint(KeypointKind::Clipped) => {
                let on = [min.x, max.x].contains(&p.x) || [min.y, max.y].contains(&p.y);
                if on { Ok(true) } else { Err(VoronoiError::Frame) }
            }
            _ => Ok(false),
        }
    }
}

/// The corners of a frame, counterclockwise.
fn corners_of(frame: &Rect) -> [Point; 4] {
    let Rect { min, max } = *frame;
    [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)]
}

/// The place of a point along a frame, counterclockwise, with the corners at 0 to 3.
fn along(frame: &Rect, p: Point) -> f64 {
    let Rect { min, max } = *frame;
    let share = Point::new((p.x - min.x) / (max.x - min.x), (p.y - min.y) / (max.y - min.y));
    if p.y == min.y {
        share.x
    } else if p.x == max.x {
        1.0 + share.y
    } else if p.y == max.y {
        3.0 - share.x
    } else {
        4.0 - share.y
    }
}

/// The element in whose cell a point lies, and the distance; `None` on the border of two cells.
fn owner(sheet: &Sheet, tree: &EdgeTree, point: Point) -> Option<(Site, f64)> {
    match *nearest_parts(sheet.domain(), tree, point) {
        [part] => Some((part, footpoint(point, sheet.element(part)).0)),
        _ => None,
    }
}

/// Where a ray from a point inside meets a frame, and how far from there.
fn hit(frame: &Rect, start: Point, way: Point) -> (Point, f64) {
    let Rect { min, max } = *frame;
    let to = |wall: f64, at: f64, way: f64| {
        let steps = (wall - at) / way;
        if way == 0.0 { f64::INFINITY } else { steps }
    };
    let x = if way.x < 0.0 { min.x } else { max.x };
    let y = if way.y < 0.0 { min.y } else { max.y };
    let (to_x, to_y) = (to(x, start.x, way.x), to(y, start.y, way.y));
    if to_x <= to_y {
        (Point::new(x, (start.y + way.y * to_x).clamp(min.y, max.y)), to_x)
    } else {
        (Point::new((start.x + way.x * to_y).clamp(min.x, max.x), y), to_y)
    }
}
