//! Insertion, point by point [GS85, §4].

use super::quad_edge::{EdgeId, QuadEdges, sym};
use super::sites::{INFINITY, Sites};

/// What insertion gives: vertices in the order in which they came, equal points being one.
pub(super) struct Inserted {
    pub sites: Sites,
    pub edges: QuadEdges,
    pub vertex_of: Vec<u32>,
    pub point_of: Vec<u32>,
}

/// Inserts points in their order, which becomes that of the vertices; `order` tells which points they are. `None` if
/// all of them lie on one line.
pub(super) fn insert_all(
    mut sites: Sites,
    mut order: Vec<u32>,
    is_over: &mut dyn FnMut() -> bool,
) -> Option<Inserted> {
    let n = sites.len();
    // The first point that is another one, and the first one off the line of both.
    let second = (1..n).find(|&k| !sites.is_same(0, k))?;
    sites.swap(1, second);
    order.swap(1, second as usize);
    let third = (2..n).find(|&k| sites.orient(0, 1, k) != 0.0)?;
    sites.swap(2, third);
    order.swap(2, third as usize);
    let mut insertion = Insertion::new(sites);
    let mut vertex_of = vec![0; order.len()];
    let mut point_of: Vec<u32> = Vec::with_capacity(order.len());
    for (k, &point) in (0..).zip(&order) {
        if is_over() {
            return None;
        }
        let vertex = if k < 3 { k } else { insertion.insert(k) };
        vertex_of[point as usize] = vertex;
        match point_of.get_mut(vertex as usize) {
            Some(first) => *first = point.min(*first),
            None => point_of.push(point),
        }
    }
    let Insertion { mut sites, edges, n_vertices, .. } = insertion;
    sites.truncate(n_vertices);
    Some(Inserted { sites, edges, vertex_of, point_of })
}

struct Insertion {
    sites: Sites,
    edges: QuadEdges,
    n_vertices: u32,
    /// An edge at the last point, between vertices other than that at infinity.
    last: EdgeId,
    /// Edges opposite to the new vertex, which lies to their left.
    doubtful: Vec<EdgeId>,
}

/// The triangle in which a point lies, or the half-plane beyond an edge of the hull.
enum Place {
    Face(EdgeId),
    Vertex(u32),
}

impl Insertion {
    /// A triangle of the first three points, which are not on one line.
    fn new(sites: Sites) -> Self {
        let corners = if sites.orient(0, 1, 2) > 0.0 { [0, 1, 2] } else { [1, 0, 2] };
        let mut edges = QuadEdges::with_room(3 * sites.len() as usize);
        let sides = [0, 1, 2].map(|k| edges.push(corners[k], corners[(k + 1) % 3]));
        let out = corners.map(|corner| edges.push(corner, INFINITY));
        edges.make_triangle(sides[0], sides[1], sides[2]);
        for k in 0..3 {
            edges.make_triangle(sym(sides[k]), out[k], sym(out[(k + 1) % 3]));
        }
        let last = sides[0];
        Self { sites, edges, n_vertices: 3, last, doubtful: Vec::with_capacity(16) }
    }

    /// Inserts the point at this place of the order as the next vertex; gives that, or the one that is as good.
    fn insert(&mut self, point: u32) -> u32 {
        let vertex = self.n_vertices;
        self.sites.copy(point, vertex);
        let first = match self.locate(vertex) {
            Place::Vertex(known) => return known,
            Place::Face(edge) => edge,
        };
        self.n_vertices += 1;
        let second = self.edges.left_next(first);
        let third = self.edges.left_next(second);
        let sides = [first, second, third];
        let spokes = sides.map(|side| {
            let from = self.edges.origin(side);
            (from, self.edges.push(from, vertex))
        });
        for k in 0..3 {
            let (_, to) = spokes[(k + 1) % 3];
            self.edges.make_triangle(sides[k], to, sym(spokes[k].1));
        }
        // At most one of them comes from infinity.
        self.last = if spokes[0].0 == INFINITY { spokes[1].1 } else { spokes[0].1 };
        self.doubtful.extend(sides);
        while let Some(edge) = self.doubtful.pop() {
            let beyond = self.edges.left_next(sym(edge));
            if self.is_in_circle(edge, self.edges.target(beyond), vertex) {
                let last = self.edges.left_next(beyond);
                self.edges.flip(edge);
                self.doubtful.extend([beyond, last]);
            }
        }
        vertex
    }

    /// Whether the circle around the triangle to the right of an edge, with that apex, holds a vertex that lies to
    /// the left of the edge or on it.
    #[inline]
    fn is_in_circle(&self, edge: EdgeId, apex: u32, vertex: u32) -> bool {
        let (a, b) = (self.edges.target(edge), self.edges.origin(edge));
        if apex == INFINITY {
            return self.is_beyond(a, b, vertex);
        }
        if a == INFINITY {
            return self.is_beyond(b, apex, vertex);
        }
        if b == INFINITY {
            return self.is_beyond(apex, a, vertex);
        }
        self.sites.in_circle(a, b, apex, vertex) > 0.0
    }

    /// Whether a vertex lies to the left of an edge from infinity's triangle, or on it.
    fn is_beyond(&self, from: u32, to: u32, vertex: u32) -> bool {
        let side = self.sites.orient(from, to, vertex);
        side > 0.0 || side == 0.0 && self.is_between(from, to, vertex)
    }

    /// Whether a vertex on the line of two others lies between them.
    fn is_between(&self, from: u32, to: u32, vertex: u32) -> bool {
        let order = self.sites.compare(from, vertex);
        order.is_ne() && order == self.sites.compare(vertex, to)
    }

    /// Where the point lies that is to become a vertex.
    fn locate(&self, vertex: u32) -> Place {
        let mut edge = self.last;
        let corner = |edge: EdgeId| self.edges.origin(edge);
        let first = self.sites.orient(corner(edge), corner(sym(edge)), vertex);
        // On the line of an edge of the hull, it is inside that a walk can start.
        let is_hull = |edge: EdgeId| self.edges.target(self.edges.left_next(edge)) == INFINITY;
        if first < 0.0 || first == 0.0 && is_hull(edge) {
            edge = sym(edge);
        }
        let mut is_on = first == 0.0;
        loop {
            let next = self.edges.left_next(edge);
            let apex = self.edges.target(next);
            if apex == INFINITY {
                return Place::Face(edge);
            }
            let side = self.sites.orient(corner(next), apex, vertex);
            if side < 0.0 {
                (edge, is_on) = (sym(next), false);
                continue;
            }
            let last = self.edges.left_next(next);
            let other = self.sites.orient(apex, corner(edge), vertex);
            if other < 0.0 {
                (edge, is_on) = (sym(last), false);
                continue;
            }
            if is_on || side == 0.0 || other == 0.0 {
                let corners = [edge, next, last].map(corner);
                let same = corners.into_iter().find(|&known| self.sites.is_same(known, vertex));
                if let Some(known) = same {
                    return Place::Vertex(known);
                }
            }
            return Place::Face(edge);
        }
    }
}
