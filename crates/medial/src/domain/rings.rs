//! The rings of a feature, each cleaned by itself and directed with the interior on its left.

use std::cmp::Ordering;

use super::area;
use super::{Domain, DomainError, Options, Place, Repair, Report, Walk};
use crate::geom::{Point, orient2d};

/// Cleaned rings, one after another in one numbering of vertices and edges.
///
/// Edge k runs from vertex k to the next vertex of its ring; no three consecutive vertices of a
/// ring are on one line, and no two of them equal.
pub(super) struct Rings<'a> {
    pub(super) rings: Vec<Ring<'a>>,
    pub(super) points: Vec<Point>,
    /// Position of each vertex in its ring as given.
    pub(super) given: Vec<u32>,
    /// Ring of each vertex.
    pub(super) ring: Vec<u32>,
    /// Whether the feature has one polygon only.
    pub(super) lone: bool,
}

/// One ring.
pub(super) struct Ring<'a> {
    pub(super) polygon: u32,
    /// Position in the polygon.
    pub(super) index: u32,
    /// Whether it is directed clockwise, as a hole.
    pub(super) hole: bool,
    /// Whether it runs against the direction in which it was given.
    pub(super) reversed: bool,
    pub(super) first: u32,
    pub(super) len: u32,
    points: &'a [Point],
    /// Positions of the vertices merged away that still lie on the ring, in order.
    merged: Vec<u32>,
}

/// Largest number of vertices.
const MAX_VERTICES: usize = 1 << 30;

impl<'a> Rings<'a> {
    /// Checks coordinates, cleans and directs every ring.
    pub(super) fn clean(
        polygons: &'a [Vec<Vec<Point>>],
        options: &Options,
        report: &mut Report,
    ) -> Result<Self, DomainError> {
        let found: usize = polygons.iter().flatten().map(Vec::len).sum();
        if found > MAX_VERTICES || polygons.len() > MAX_VERTICES {
            return Err(DomainError::TooLarge { found });
        }
        let lone = polygons.len() == 1;
        check_coordinates(polygons, lone)?;
        let mut rings = Self {
            rings: Vec::new(),
            points: Vec::with_capacity(found),
            given: Vec::with_capacity(found),
            ring: Vec::with_capacity(found),
            lone,
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
        Ok(rings)
    }

    /// The walks of a domain as rings.
    pub(super) fn of_walks(domain: &Domain) -> Rings<'static> {
        let edges = domain.edges();
        let ring = |w: &Walk| Ring {
            polygon: w.polygon,
            index: 0,
            hole: w.hole,
            reversed: false,
            first: w.first,
            len: w.len,
            points: &[],
            merged: Vec::new(),
        };
        Rings {
            rings: domain.walks().iter().map(ring).collect(),
            points: edges.iter().map(|e| e.start).collect(),
            given: (0..edges.len() as u32).collect(),
            ring: edges.iter().map(|e| e.walk).collect(),
            lone: true,
        }
    }

    fn push(
        &mut self,
        points: &'a [Point],
        at: Place,
        options: &Options,
        report: &mut Report,
    ) -> Result<(), DomainError> {
        if points.is_empty() && at.ring == 0 {
            return Err(DomainError::Empty { at });
        }
        let reduced = reduce(points, at)?;
        if let (true, Some(&index)) = (options.strict, reduced.spikes.first()) {
            return Err(DomainError::Spike { at: Place { index, ..at } });
        }
        for (repair, indices) in [
            (Repair::RepeatedPoint, &reduced.repeated),
            (Repair::Spike, &reduced.spikes),
            (Repair::StraightCorner, &reduced.straight),
        ] {
            if !indices.is_empty() {
                report.push(repair, at.polygon, at.ring, indices.clone());
            }
        }
        let first = self.points.len();
        self.points.extend(reduced.kept.iter().map(|&k| points[k as usize]));
        self.given.extend_from_slice(&reduced.kept);
        self.ring.resize(self.points.len(), self.rings.len() as u32);
        // Which rings are holes is not known yet when they are regrouped.
        let hole = at.ring > 0 && !options.regroup;
        let wrong = if hole { Ordering::Greater } else { Ordering::Less };
        let reversed = area::orientation(&self.points[first..]) == wrong;
        self.rings.push(Ring {
            polygon: at.polygon,
            index: at.ring,
            hole,
            reversed: false,
            first: first as u32,
            len: reduced.kept.len() as u32,
            points,
            merged: reduced.passed(points),
        });
        if reversed {
            self.reverse(self.rings.len() - 1);
        }
        if reversed && !options.regroup {
            report.push(Repair::Reversed, at.polygon, at.ring, Vec::new());
        }
        Ok(())
    }

    /// Turns a ring round.
    pub(super) fn reverse(&mut self, ring: usize) {
        let ring = &mut self.rings[ring];
        let range = ring.first as usize..(ring.first + ring.len) as usize;
        self.points[range.clone()].reverse();
        self.given[range].reverse();
        ring.reversed = !ring.reversed;
    }

    /// The ring of an edge or a vertex.
    pub(super) fn ring_of(&self, vertex: u32) -> &Ring<'a> {
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
        let Ring { first, len, .. } = self.rings[ring as usize];
        &self.points[first as usize..(first + len) as usize]
    }

    /// Position in the ring as given of the first vertex of an edge in input direction.
    pub(super) fn edge_index(&self, edge: u32) -> u32 {
        let vertex = if self.ring_of(edge).reversed { self.next(edge) } else { edge };
        self.given[vertex as usize]
    }

    /// The place of an edge, for messages.
    pub(super) fn edge_place(&self, edge: u32) -> Place {
        let ring = self.ring_of(edge);
        let index = self.edge_index(edge);
        Place { polygon: ring.polygon, ring: ring.index, index, lone: self.lone }
    }

    /// Whether a vertex of the ring as given, merged away since, lies on the edge at `at`, which
    /// is a point inside the edge.
    pub(super) fn passes_vertex(&self, edge: u32, at: Point) -> bool {
        let ring = self.ring_of(edge);
        let (mut begin, mut end) = (edge, self.next(edge));
        if ring.reversed {
            (begin, end) = (end, begin);
        }
        let forwards = self.point(begin).lexicographic(self.point(end));
        let (begin, end) = (self.given[begin as usize], self.given[end as usize]);
        let split = |index: u32| ring.merged.partition_point(|&m| m < index);
        let search = |range: &[u32]| {
            let order = |&m: &u32| {
                let order = ring.points[m as usize].lexicographic(at);
                if forwards.is_lt() { order } else { order.reverse() }
            };
            range.binary_search_by(order).is_ok()
        };
        if begin < end {
            search(&ring.merged[split(begin)..split(end)])
        } else {
            search(&ring.merged[split(begin)..]) || search(&ring.merged[..split(end)])
        }
    }
}

/// Coordinates other than 0 must have an exponent from -200 to 199, or be 2^200.
fn check_coordinates(polygons: &[Vec<Vec<Point>>], lone: bool) -> Result<(), DomainError> {
    const LEAST: f64 = f64::from_bits((1023 - 200) << 52);
    const LARGEST: f64 = f64::from_bits((1023 + 200) << 52);
    let good = |v: f64| v == 0.0 || LEAST <= v.abs() && v.abs() <= LARGEST;
    for (polygon, rings) in polygons.iter().enumerate() {
        for (ring, points) in rings.iter().enumerate() {
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

/// What is left of a ring, and what was taken from it, as positions in the ring as given.
#[derive(Default)]
struct Reduced {
    kept: Vec<u32>,
    repeated: Vec<u32>,
    spikes: Vec<u32>,
    straight: Vec<u32>,
}

impl Reduced {
    /// The straight corners that still lie on the ring, in order along each edge.
    fn passed(&self, points: &[Point]) -> Vec<u32> {
        if self.spikes.is_empty() {
            return self.straight.clone();
        }
        // Removing a spike may leave corners of it in the list: keep those met in order between
        // the ends of their edge.
        let n = self.kept.len();
        let mut passed: Vec<u32> = Vec::new();
        for (k, &begin) in self.kept.iter().enumerate() {
            let end = self.kept[(k + 1) % n];
            let (from, to) = (points[begin as usize], points[end as usize]);
            let order = from.lexicographic(to);
            let split = |index: u32| self.straight.partition_point(|&m| m < index);
            let between = if begin < end {
                [&self.straight[split(begin)..split(end)], &[]]
            } else {
                [&self.straight[split(begin)..], &self.straight[..split(end)]]
            };
            let mut last = from;
            for &m in between.into_iter().flatten() {
                let p = points[m as usize];
                let inside = last.lexicographic(p) == order && p.lexicographic(to) == order;
                if inside && orient2d(from, to, p) == 0.0 {
                    passed.push(m);
                    last = p;
                }
            }
        }
        passed.sort_unstable();
        passed
    }
}

/// Drops repeated points, merges straight corners and removes spikes until none is left.
///
/// Linear: a removal can only concern its two neighbours, so the scan steps back by one.
fn reduce(points: &[Point], at: Place) -> Result<Reduced, DomainError> {
    let mut reduced = Reduced::default();
    let mut end = points.len();
    while end > 1 && points[end - 1] == points[0] {
        end -= 1;
        if end < points.len() - 1 {
            reduced.repeated.push(end as u32);
        }
    }
    let mut kept: Vec<u32> = Vec::with_capacity(end);
    for (k, point) in points[..end].iter().enumerate() {
        match kept.last() {
            Some(&last) if points[last as usize] == *point => reduced.repeated.push(k as u32),
            _ => kept.push(k as u32),
        }
    }
    reduced.repeated.sort_unstable();
    let n = kept.len();
    if n < 3 {
        return Err(DomainError::TooFewPoints { at, found: n as u32 });
    }
    let point = |k: usize| points[kept[k] as usize];
    let is_corner =
        |k: usize| orient2d(point((k + n - 1) % n), point(k), point((k + 1) % n)) != 0.0;
    let Some(first) = (0..n).find(|&k| !is_corner(k)) else {
        reduced.kept = kept;
        return Ok(reduced);
    };

    let mut next: Vec<u32> = (0..n).map(|k| ((k + 1) % n) as u32).collect();
    let mut prev: Vec<u32> = (0..n).map(|k| ((k + n - 1) % n) as u32).collect();
    let mut live = n;
    let mut removed = vec![false; n];
    let (mut k, mut dirty) = (first, n - first);
    while dirty > 0 {
        let (before, after) = (prev[k] as usize, next[k] as usize);
        let (a, b, c) = (point(before), point(k), point(after));
        let drop = if b == c {
            // Keep the one that comes first in the ring.
            let twin = if kept[after] > kept[k] { after } else { k };
            reduced.repeated.push(kept[twin]);
            twin
        } else if orient2d(a, b, c) == 0.0 {
            let straight = a.lexicographic(b) == b.lexicographic(c);
            if straight { &mut reduced.straight } else { &mut reduced.spikes }.push(kept[k]);
            k
        } else {
            dirty -= 1;
            k = after;
            continue;
        };
        live -= 1;
        if live < 3 {
            let mut all: Vec<Point> = kept.iter().map(|&k| points[k as usize]).collect();
            all.sort_unstable_by(|p, q| p.lexicographic(*q));
            all.dedup();
            return Err(match all.len() {
                found @ ..3 => DomainError::TooFewPoints { at, found: found as u32 },
                _ => DomainError::Collinear { at },
            });
        }
        removed[drop] = true;
        let (before, after) = (prev[drop], next[drop]);
        next[before as usize] = after;
        prev[after as usize] = before;
        // Check the neighbours again, and what was still to be checked.
        dirty = (dirty + 2).min(live);
        k = before as usize;
    }
    reduced.kept = (0..n).filter(|&k| !removed[k]).map(|k| kept[k]).collect();
    for list in [&mut reduced.repeated, &mut reduced.spikes, &mut reduced.straight] {
        list.sort_unstable();
    }
    Ok(reduced)
}
