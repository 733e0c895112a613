//! The rings of a feature, each cleaned by itself and directed with the interior on its left.

use std::cmp::Ordering;
use std::ops::Range;

use super::area;
use super::reduce::{Reduced, append_corners, open_len, reduce};
use super::status::NONE;
use super::{Corner, Domain, DomainError, Options, Place, Repair, Report, Walk};
use crate::geom::Point;

/// Cleaned rings, one after another, in any order, in one numbering of vertices and edges.
///
/// Edge k runs from vertex k to the next vertex of its ring; no three consecutive vertices of a
/// ring are on one line, and no two of them equal.
pub(super) struct Rings<'a> {
    pub(super) rings: Vec<Ring>,
    pub(super) points: Vec<Point>,
    /// How each ring by itself turns at each vertex, seen from its left.
    pub(super) corners: Vec<Corner>,
    /// The rings in the order in which their vertices are laid out.
    pub(super) order: Vec<u32>,
    /// What became of the rings that were cleaned.
    pub(super) cleaned: Vec<Cleaned>,
    /// Ring of each vertex, once [`number`](Self::number) was called.
    pub(super) ring: Vec<u32>,
    /// Whether the feature has one polygon only.
    pub(super) lone: bool,
    polygons: &'a [Vec<Vec<Point>>],
}

/// One ring.
pub(super) struct Ring {
    pub(super) polygon: u32,
    /// Position in the polygon.
    pub(super) index: u32,
    pub(super) first: u32,
    pub(super) len: u32,
    /// Its number among the rings that were cleaned, or `NONE`.
    pub(super) cleaned: u32,
    /// Whether it is directed clockwise, as a hole.
    pub(super) hole: bool,
    /// Whether it runs against the direction in which it was given.
    pub(super) reversed: bool,
}

impl Ring {
    /// Its vertices.
    pub(super) fn range(&self) -> Range<usize> {
        self.first as usize..(self.first + self.len) as usize
    }

    /// Where, from its first vertex, the edge with the smallest index starts.
    pub(super) fn start(&self) -> u32 {
        // Backwards, that is the last edge but one.
        if self.reversed { self.len - 2 } else { 0 }
    }
}

/// A ring that lost vertices.
pub(super) struct Cleaned {
    /// Positions in the ring as given of the vertices that are left, in order.
    pub(super) given: Vec<u32>,
    /// Positions of the vertices merged away, in order; they lie on the ring unless it was folded.
    merged: Vec<u32>,
    /// Whether it ran back on itself: which vertices the way back leaves on an edge depends on
    /// where the ring starts.
    folded: bool,
}

/// Largest number of vertices.
const MAX_VERTICES: usize = 1 << 30;

impl<'a> Rings<'a> {
    /// Checks coordinates, cleans and directs every ring; near rings follow one another.
    pub(super) fn clean(
        polygons: &'a [Vec<Vec<Point>>],
        options: &Options,
        report: &mut Report,
    ) -> Result<Self, DomainError> {
        let found = count_vertices(polygons)?;
        let lone = polygons.len() == 1;
        check_coordinates(polygons, lone)?;
        let mut rings = Self {
            rings: Vec::with_capacity(polygons.iter().map(Vec::len).sum()),
            points: Vec::new(),
            corners: Vec::with_capacity(found),
            order: Vec::new(),
            cleaned: Vec::new(),
            ring: Vec::new(),
            lone,
            polygons,
        };
        for (polygon, list) in polygons.iter().enumerate() {
            if !options.strict && !lone && list.iter().all(Vec::is_empty) {
                report.push(Repair::EmptyPolygon, polygon as u32, 0, Vec::new());
                continue;
            }
            let before = rings.rings.len();
            let mut degenerate = None;
            for (index, points) in list.iter().enumerate() {
                let at = Place { polygon: polygon as u32, ring: index as u32, index: 0, lone };
                match rings.push(points, at, options, report) {
                    Err(
                        error @ (DomainError::TooFewPoints { .. } | DomainError::Collinear { .. }),
                    ) if !options.strict && (index > 0 || options.regroup) => {
                        let _ = degenerate.get_or_insert(error);
                        report.push(Repair::DegenerateHole, at.polygon, at.ring, Vec::new());
                    }
                    result => result?,
                }
            }
            if rings.rings.len() == before {
                let at = Place { polygon: polygon as u32, ring: 0, index: 0, lone };
                return Err(degenerate.unwrap_or(DomainError::Empty { at }));
            }
        }
        if rings.rings.is_empty() {
            let at = Place { polygon: 0, ring: 0, index: 0, lone };
            return Err(DomainError::Empty { at });
        }
        let order = rings.curve_order();
        rings.lay_out(order);
        Ok(rings)
    }

    /// The walks of a domain as rings.
    pub(super) fn of_walks(domain: &Domain) -> Rings<'static> {
        let edges = domain.edges();
        let ring = |w: &Walk| Ring {
            polygon: w.polygon,
            index: 0,
            first: w.first,
            len: w.len,
            cleaned: NONE,
            hole: w.hole,
            reversed: false,
        };
        let mut rings = Self::of_parts(
            domain.walks().iter().map(ring).collect(),
            edges.iter().map(|e| e.start).collect(),
            edges.iter().map(|e| e.corner).collect(),
        );
        rings.number();
        rings
    }

    /// Rings that are clean and directed already, with their vertices one after another.
    pub(super) fn of_parts(
        rings: Vec<Ring>,
        points: Vec<Point>,
        corners: Vec<Corner>,
    ) -> Rings<'static> {
        let order = (0..rings.len() as u32).collect();
        let (cleaned, ring) = (Vec::new(), Vec::new());
        Rings { rings, points, corners, order, cleaned, ring, lone: true, polygons: &[] }
    }

    fn push(
        &mut self,
        points: &[Point],
        at: Place,
        options: &Options,
        report: &mut Report,
    ) -> Result<(), DomainError> {
        if points.is_empty() && at.ring == 0 {
            return Err(DomainError::Empty { at });
        }
        let first = self.corners.len();
        let open = &points[..open_len(points)];
        let (mut cleaned, mut copied) = (NONE, Vec::new());
        let points = if open.len() + 1 >= points.len() && append_corners(open, &mut self.corners) {
            open
        } else {
            self.corners.truncate(first);
            cleaned = self.clean_ring(points, at, options, report)?;
            let given = self.cleaned[cleaned as usize].given.iter();
            copied.extend(given.map(|&k| points[k as usize]));
            if !append_corners(&copied, &mut self.corners) {
                return Err(DomainError::Internal { stage: "cleaning" });
            }
            &copied
        };
        // Which rings are holes is not known yet when they are regrouped.
        let hole = at.ring > 0 && !options.regroup;
        let wrong = if hole { Ordering::Greater } else { Ordering::Less };
        let reversed = area::orientation(points) == wrong;
        self.rings.push(Ring {
            polygon: at.polygon,
            index: at.ring,
            first: first as u32,
            len: points.len() as u32,
            cleaned,
            hole,
            reversed,
        });
        if reversed {
            turn(&mut self.corners[first..]);
        }
        if reversed && !options.regroup {
            report.push(Repair::Reversed, at.polygon, at.ring, Vec::new());
        }
        Ok(())
    }

    /// Notes what is left of a ring; the result is its number among the cleaned ones.
    fn clean_ring(
        &mut self,
        points: &[Point],
        at: Place,
        options: &Options,
        report: &mut Report,
    ) -> Result<u32, DomainError> {
        let reduced = reduce(points, at)?;
        if let (true, Some(&index)) = (options.strict, reduced.spikes.first()) {
            return Err(DomainError::Spike { at: Place { index, ..at } });
        }
        let Reduced { kept, repeated, spikes, straight } = reduced;
        let folded = !spikes.is_empty();
        self.cleaned.push(Cleaned { given: kept, merged: straight.clone(), folded });
        for (repair, indices) in [
            (Repair::RepeatedPoint, repeated),
            (Repair::Spike, spikes),
            (Repair::StraightCorner, straight),
        ] {
            if !indices.is_empty() {
                report.push(repair, at.polygon, at.ring, indices);
            }
        }
        Ok(self.cleaned.len() as u32 - 1)
    }

    /// A vertex of a ring, counted along it as directed, from the input.
    pub(super) fn given_point(&self, ring: &Ring, along: u32) -> Point {
        let position = self.position(ring, along) as usize;
        self.polygons[ring.polygon as usize][ring.index as usize][position]
    }

    /// Turns a ring round.
    pub(super) fn reverse(&mut self, ring: usize) {
        let ring = &mut self.rings[ring];
        let range = ring.range();
        self.points[range.clone()].reverse();
        turn(&mut self.corners[range]);
        ring.reversed = !ring.reversed;
    }

    /// Takes the vertices from the input, the rings in the given order.
    fn lay_out(&mut self, order: Vec<u32>) {
        let mut corners = Vec::with_capacity(self.corners.len());
        self.points.clear();
        self.points.reserve_exact(self.corners.len());
        for &number in &order {
            let ring = &mut self.rings[number as usize];
            corners.extend_from_slice(&self.corners[ring.range()]);
            ring.first = self.points.len() as u32;
            let given = &self.polygons[ring.polygon as usize][ring.index as usize];
            match self.cleaned.get(ring.cleaned as usize) {
                Some(Cleaned { given: kept, .. }) => {
                    self.points.extend(kept.iter().map(|&k| given[k as usize]));
                }
                None => self.points.extend_from_slice(&given[..ring.len as usize]),
            }
            if ring.reversed {
                self.points[ring.first as usize..].reverse();
            }
        }
        (self.corners, self.order) = (corners, order);
    }

    /// Lays the vertices out ring by ring, and notes the ring of each.
    pub(super) fn number(&mut self) {
        if !self.order.is_sorted() {
            self.lay_out((0..self.rings.len() as u32).collect());
        }
        self.ring.clear();
        self.ring.reserve(self.points.len());
        for (number, ring) in (0..).zip(&self.rings) {
            self.ring.extend(std::iter::repeat_n(number, ring.len as usize));
        }
    }

    /// Position in its ring as given of a vertex.
    pub(super) fn given(&self, vertex: u32) -> u32 {
        let ring = self.ring_of(vertex);
        self.position(ring, vertex - ring.first)
    }

    /// Position in a ring as given of a vertex counted along it as directed.
    fn position(&self, ring: &Ring, along: u32) -> u32 {
        let along = if ring.reversed { ring.len - 1 - along } else { along };
        match self.cleaned.get(ring.cleaned as usize) {
            Some(cleaned) => cleaned.given[along as usize],
            None => along,
        }
    }

    /// The ring of an edge or a vertex.
    pub(super) fn ring_of(&self, vertex: u32) -> &Ring {
        &self.rings[self.ring[vertex as usize] as usize]
    }

    pub(super) fn next(&self, vertex: u32) -> u32 {
        let ring = self.ring_of(vertex);
        if vertex + 1 == ring.first + ring.len { ring.first } else { vertex + 1 }
    }

    pub(super) fn point(&self, vertex: u32) -> Point {
        self.points[vertex as usize]
    }

    /// Vertices of a ring in boundary order.
    pub(super) fn ring_points(&self, ring: u32) -> &[Point] {
        &self.points[self.rings[ring as usize].range()]
    }

    /// Position in the ring as given of the first vertex of an edge in input direction.
    pub(super) fn edge_index(&self, edge: u32) -> u32 {
        let vertex = if self.ring_of(edge).reversed { self.next(edge) } else { edge };
        self.given(vertex)
    }

    /// The place of an edge, for messages.
    pub(super) fn edge_place(&self, edge: u32) -> Place {
        let ring = self.ring_of(edge);
        let index = self.edge_index(edge);
        Place { polygon: ring.polygon, ring: ring.index, index, lone: self.lone }
    }

    /// Whether a vertex of the ring as given, merged away since, lies on the edge at `at`, which
    /// is a point inside the edge; for a ring that ran back on itself, whether one may.
    pub(super) fn passes_vertex(&self, edge: u32, at: Point) -> bool {
        let ring = self.ring_of(edge);
        let Some(Cleaned { merged, folded, .. }) = self.cleaned.get(ring.cleaned as usize) else {
            return false;
        };
        if *folded {
            return true;
        }
        let points = &self.polygons[ring.polygon as usize][ring.index as usize];
        let (mut begin, mut end) = (edge, self.next(edge));
        if ring.reversed {
            (begin, end) = (end, begin);
        }
        let forwards = self.point(begin).lexicographic(self.point(end));
        let (begin, end) = (self.given(begin), self.given(end));
        let split = |index: u32| merged.partition_point(|&m| m < index);
        let search = |range: &[u32]| {
            let order = |&m: &u32| {
                let order = points[m as usize].lexicographic(at);
                if forwards.is_lt() { order } else { order.reverse() }
            };
            range.binary_search_by(order).is_ok()
        };
        if begin < end {
            search(&merged[split(begin)..split(end)])
        } else {
            search(&merged[split(begin)..]) || search(&merged[..split(end)])
        }
    }
}

/// Corners of a ring that is turned round.
fn turn(corners: &mut [Corner]) {
    corners.reverse();
    for corner in corners {
        *corner = match *corner {
            Corner::Convex => Corner::Reflex,
            Corner::Reflex => Corner::Convex,
            Corner::Straight => Corner::Straight,
        };
    }
}

/// Number of vertices as given, if there are not too many of them.
pub(super) fn count_vertices(polygons: &[Vec<Vec<Point>>]) -> Result<usize, DomainError> {
    let found: usize = polygons.iter().flatten().map(Vec::len).sum();
    if found > MAX_VERTICES || polygons.len() > MAX_VERTICES {
        return Err(DomainError::TooLarge { found });
    }
    Ok(found)
}

/// Coordinates other than 0 must have an exponent from -200 to 199, or be 2^200.
fn check_coordinates(polygons: &[Vec<Vec<Point>>], lone: bool) -> Result<(), DomainError> {
    const LEAST: f64 = f64::from_bits((1023 - 200) << 52);
    const LARGEST: f64 = f64::from_bits((1023 + 200) << 52);
    // Without branches: nearly always all are good.
    let good = |v: f64| (v == 0.0) | ((LEAST <= v.abs()) & (v.abs() <= LARGEST));
    for (polygon, rings) in polygons.iter().enumerate() {
        for (ring, points) in rings.iter().enumerate() {
            if points.iter().fold(true, |all, p| all & good(p.x) & good(p.y)) {
                continue;
            }
            if let Some(k) = points.iter().position(|p| !good(p.x) || !good(p.y)) {
                let Point { x, y } = points[k];
                let (polygon, ring, index) = (polygon as u32, ring as u32, k as u32);
                let at = Place { polygon, ring, index, lone };
                return Err(if x.is_finite() && y.is_finite() {
                    DomainError::ExponentOutOfRange { at, x, y }
                } else {
                    DomainError::NotFinite { at, x, y }
                });
            }
        }
    }
    Ok(())
}
