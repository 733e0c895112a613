//! The Delaunay triangulation of points, inserted one after the other into a quad-edge structure [GS85].
//!
//! # Contract
//! No point lies in the circle around any triangle, decided exactly for the coordinates as given; where four or
//! more lie on one circle some triangles of them are chosen, and [`Delaunay::is_cocircular`] tells them. Equal points
//! are one vertex. The result depends on the points and their order alone. Expected O(n log n) for n points.
//!
//! # Method
//! 1. Points come in rounds of twice as many, chosen by a hash, each along a Hilbert curve: most are near the last
//!    one, and no order of the input is bad for all of them [ACR03].
//! 2. A walk finds the triangle of a point [GS85, §4]; the point is joined to its corners, and edges across which a
//!    circle holds the point are flipped until none is left.
//! 3. Circles are compared in doubles with a bound on their error; where that does not tell, in integers if all
//!    coordinates are small whole numbers of one unit, as in images, else by expansions, or in integers of any size
//!    if products of four might overflow or underflow (`sites.rs`).
//! 4. [`Delaunay::constrain`] flips edges until one of them joins two vertices, and then others until circles hold
//!    nothing that can be seen from inside their triangles.
//!
//! # Departures
//! [GS85] start from three points far away. Here one vertex at infinity makes triangles of the edges of the hull,
//! and its circle is the half-plane beyond such an edge; so the hull is exact, and all faces are triangles, which
//! makes the splices of [GS85] one operation.

mod constrain;
mod insert;
mod quad_edge;
mod sites;

pub use constrain::Blocked;
pub use quad_edge::EdgeId;
pub use sites::INFINITY;

use super::{Point, Rect, hilbert};
use insert::Inserted;
use quad_edge::{QuadEdges, inverse_rot, sym};
use sites::Sites;

/// A Delaunay triangulation.
///
/// Edges are directed and have a triangle to their left; those of the hull have one with the vertex at infinity to
/// their right.
///
/// ```
/// use medial::geom::{Delaunay, Point};
/// let points = [(0., 0.), (2., 0.), (2., 2.), (0., 2.), (1., 1.)].map(|(x, y)| Point::new(x, y));
/// let triangles = Delaunay::new(&points).ok_or("all on one line")?;
/// assert_eq!((triangles.n_vertices(), triangles.n_edges(), triangles.n_faces()), (5, 8, 4));
/// // All around the middle, at distance 1.
/// assert!((0..4).all(|face| triangles.circle(face).1 == 1.0));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Delaunay {
    sites: Sites,
    edges: QuadEdges,
    /// The vertex of each point that was given.
    vertex_of: Vec<u32>,
    /// The first point of each vertex.
    point_of: Vec<u32>,
    /// An edge out of each vertex.
    out: Vec<EdgeId>,
    /// An edge of each face, those with the vertex at infinity last.
    faces: Vec<EdgeId>,
    n_faces: u32,
    /// For each undirected edge whether it is kept, whatever circles say; empty without any.
    kept: Vec<bool>,
}

impl Delaunay {
    /// The Delaunay triangulation of points with finite coordinates; `None` if all of them lie on one line, or are
    /// too many for 32-bit numbers.
    #[must_use]
    pub fn new(points: &[Point]) -> Option<Self> {
        Self::new_unless(points, || false)
    }

    /// The same, unless it is to stop, which is asked before each point.
    pub(crate) fn new_unless(points: &[Point], mut is_over: impl FnMut() -> bool) -> Option<Self> {
        /// Each vertex has three edges with four quarters each.
        const MOST: usize = (u32::MAX / 16) as usize;
        if points.len() < 3 || points.len() > MOST {
            return None;
        }
        let order = insertion_order(points);
        let sites = Sites::new(points, &order);
        let Inserted { sites, edges, vertex_of, point_of } =
            insert::insert_all(sites, order, &mut is_over)?;
        let (out, faces, kept) = (Vec::new(), Vec::new(), Vec::new());
        let mut triangulation =
            Self { sites, edges, vertex_of, point_of, out, faces, n_faces: 0, kept };
        triangulation.number();
        Some(triangulation)
    }

    /// Numbers the faces, and notes an edge out of each vertex.
    fn number(&mut self) {
        let n = self.sites.len() as usize;
        self.out.clear();
        self.out.resize(n, EdgeId::MAX);
        self.faces.clear();
        self.faces.reserve(2 * n);
        let mut infinite = Vec::new();
        for undirected in 0..self.edges.len() {
            for edge in [4 * undirected, 4 * undirected + 2] {
                let next = self.edges.left_next(edge);
                let last = self.edges.left_next(next);
                let [a, b, c] = [edge, next, last].map(|edge| self.edges.origin(edge));
                if a != INFINITY && b != INFINITY {
                    self.out[a as usize] = edge;
                }
                // Once a face.
                if edge > next || edge > last {
                    continue;
                }
                if a.max(b).max(c) == INFINITY {
                    infinite.push(edge);
                } else {
                    self.faces.push(edge);
                }
            }
        }
        self.n_faces = self.faces.len() as u32;
        self.faces.append(&mut infinite);
        for (face, &edge) in (0..).zip(&self.faces) {
            let mut edge = edge;
            for _ in 0..3 {
                self.edges.set_origin(inverse_rot(edge), face);
                edge = self.edges.left_next(edge);
            }
        }
    }

    /// How many vertices there are, without that at infinity.
    #[must_use]
    pub fn n_vertices(&self) -> u32 {
        self.sites.len()
    }

    /// How many undirected edges there are, without those to infinity.
    #[must_use]
    pub fn n_edges(&self) -> u32 {
        self.edges.len() - self.n_hull()
    }

    /// How many vertices the hull has, those on its edges among them.
    #[must_use]
    pub fn n_hull(&self) -> u32 {
        self.faces.len() as u32 - self.n_faces
    }

    /// How many triangles there are, without those with the vertex at infinity, whose numbers follow.
    #[must_use]
    pub fn n_faces(&self) -> u32 {
        self.n_faces
    }

    /// The vertex of a point, by its place among those that were given.
    #[must_use]
    pub fn vertex_of(&self, point: u32) -> u32 {
        self.vertex_of[point as usize]
    }

    /// The first point given that is this vertex.
    #[must_use]
    pub fn point_of(&self, vertex: u32) -> u32 {
        self.point_of[vertex as usize]
    }

    /// Where a vertex is.
    #[inline]
    #[must_use]
    pub fn point(&self, vertex: u32) -> Point {
        self.sites.point(vertex)
    }

    /// All edges between vertices other than that at infinity, each in one direction.
    pub fn edges(&self) -> impl Iterator<Item = EdgeId> {
        (0..self.edges.len()).map(|undirected| 4 * undirected).filter(|&edge| self.is_finite(edge))
    }

    /// Whether an edge does not go to infinity.
    #[inline]
    #[must_use]
    pub fn is_finite(&self, edge: EdgeId) -> bool {
        self.edges.origin(edge) != INFINITY && self.edges.target(edge) != INFINITY
    }

    /// The vertex where an edge starts.
    #[inline]
    #[must_use]
    pub fn origin(&self, edge: EdgeId) -> u32 {
        self.edges.origin(edge)
    }

    /// The vertex where it ends.
    #[inline]
    #[must_use]
    pub fn target(&self, edge: EdgeId) -> u32 {
        self.edges.target(edge)
    }

    /// The corner opposite to an edge in the triangle to its left.
    #[inline]
    #[must_use]
    pub fn apex(&self, edge: EdgeId) -> u32 {
        self.edges.target(self.edges.left_next(edge))
    }

    /// The same edge the other way round.
    #[inline]
    #[must_use]
    pub fn reversed(&self, edge: EdgeId) -> EdgeId {
        sym(edge)
    }

    /// The next edge around the triangle to the left.
    #[inline]
    #[must_use]
    pub fn next_around_face(&self, edge: EdgeId) -> EdgeId {
        self.edges.left_next(edge)
    }

    /// The next edge counterclockwise around the origin.
    #[inline]
    #[must_use]
    pub fn next_around_origin(&self, edge: EdgeId) -> EdgeId {
        self.edges.next(edge)
    }

    /// The triangle to the left of an edge.
    #[inline]
    #[must_use]
    pub fn left(&self, edge: EdgeId) -> u32 {
        self.edges.left(edge)
    }

    /// An edge of a triangle, which lies to its left.
    #[inline]
    #[must_use]
    pub fn edge_of_face(&self, face: u32) -> EdgeId {
        self.faces[face as usize]
    }

    /// The edges of a triangle, counterclockwise.
    #[inline]
    #[must_use]
    pub fn edges_of_face(&self, face: u32) -> [EdgeId; 3] {
        let edge = self.faces[face as usize];
        let next = self.edges.left_next(edge);
        [edge, next, self.edges.left_next(next)]
    }

    /// The corners of a triangle, counterclockwise.
    #[inline]
    #[must_use]
    pub fn corners(&self, face: u32) -> [u32; 3] {
        self.edges_of_face(face).map(|edge| self.edges.origin(edge))
    }

    /// An edge out of a vertex.
    #[inline]
    #[must_use]
    pub fn edge_out_of(&self, vertex: u32) -> EdgeId {
        self.out[vertex as usize]
    }

    /// The edges out of a vertex, counterclockwise, that to infinity included.
    pub fn edges_out_of(&self, vertex: u32) -> impl Iterator<Item = EdgeId> {
        let first = self.out[vertex as usize];
        std::iter::successors(Some(first), move |&edge| {
            Some(self.edges.next(edge)).filter(|&next| next != first)
        })
    }

    /// The edge from a vertex to another one, if they are joined.
    #[must_use]
    pub fn edge_between(&self, from: u32, to: u32) -> Option<EdgeId> {
        self.edges_out_of(from).find(|&edge| self.edges.target(edge) == to)
    }

    /// The centre and the radius of the circle around a triangle without the vertex at infinity, rounded: the
    /// Voronoi vertex of its corners.
    #[must_use]
    pub fn circle(&self, face: u32) -> (Point, f64) {
        self.sites.circle(self.corners(face))
    }

    /// Whether the triangles on both sides of an edge have one circle, exactly.
    #[must_use]
    pub fn is_cocircular(&self, edge: EdgeId) -> bool {
        let corners = [self.origin(edge), self.target(edge), self.apex(edge), self.apex(sym(edge))];
        let [a, b, left, right] = corners;
        !corners.contains(&INFINITY) && self.sites.in_circle(a, b, left, right) == 0.0
    }

    /// Whether no circle around one of the triangles beside an edge holds the corner of the other one.
    #[must_use]
    pub fn is_delaunay(&self, edge: EdgeId) -> bool {
        let corners = [self.origin(edge), self.target(edge), self.apex(edge), self.apex(sym(edge))];
        let [a, b, left, right] = corners;
        corners.contains(&INFINITY) || self.sites.in_circle(a, b, left, right) <= 0.0
    }

    /// The sign of the cosine of the angle under which the triangle to the left sees an edge, exactly: negative if
    /// the centre of its circle is beyond the edge. Positive where that triangle is at infinity.
    #[must_use]
    pub fn opening(&self, edge: EdgeId) -> f64 {
        match self.apex(edge) {
            INFINITY => 1.0,
            apex => self.sites.opening(apex, self.origin(edge), self.target(edge)),
        }
    }

    /// Whether an edge belongs to the one-step crust \[GS01\]: some circle through its ends holds neither a vertex nor
    /// a Voronoi vertex at one of its sides, exactly. Otherwise the Voronoi edge across it is in the anti-crust.
    ///
    /// That is so if both triangles see it under no more than a right angle together: their centres then lie on
    /// different sides, at distances whose product is at least the square of half its length. Edges of the hull have
    /// one triangle, and half-planes for circles, which would make crust of all those across wide bays; so they are
    /// taken as if the other side were the mirror image.
    ///
    /// ```
    /// use medial::geom::{Delaunay, Point};
    /// // Of two rows of six points far apart, the edges along the rows.
    /// let points: Vec<Point> = (0..12).map(|k| Point::new(f64::from(k / 2), f64::from(3 * (k % 2)))).collect();
    /// let triangles = Delaunay::new(&points).ok_or("all on one line")?;
    /// let crust = triangles.edges().filter(|&edge| triangles.is_crust(edge));
    /// assert_eq!(crust.count(), 10);
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn is_crust(&self, edge: EdgeId) -> bool {
        if self.opening(edge) < 0.0 || self.opening(sym(edge)) < 0.0 {
            return false;
        }
        let [a, b] = [self.origin(edge), self.target(edge)];
        match (self.apex(edge), self.apex(sym(edge))) {
            (INFINITY, apex) | (apex, INFINITY) => self.sites.opening_twice(apex, a, b) >= 0.0,
            (left, right) => self.sites.opening_of_both([a, b], left, right) >= 0.0,
        }
    }
}

/// The points in the order in which they are inserted.
fn insertion_order(points: &[Point]) -> Vec<u32> {
    /// Points of the first round, at least.
    const FEW: usize = 64;
    let bounds = points.iter().fold(Rect::EMPTY, |all, &p| all.with(p));
    let rounds = (points.len() / FEW).checked_ilog2().unwrap_or(0);
    let mut keys: Vec<(u64, u32)> = (0..points.len() as u32)
        .map(|k| {
            // Half of all points are in the last round, half of the others in the one before.
            let halvings = scattered(k).trailing_zeros().min(rounds);
            let round = u64::from(rounds - halvings);
            (round << 32 | hilbert(&bounds, points[k as usize]), k)
        })
        .collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, k)| k).collect()
}

/// A number without any order in it, from one that has some.
fn scattered(k: u32) -> u64 {
    // The finaliser of a well-known generator, all of whose bits depend on all bits of the number.
    let mut z = u64::from(k).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

#[cfg(test)]
mod tests;
