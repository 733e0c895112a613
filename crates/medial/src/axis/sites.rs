//! The sites of an axis: a corner once, however many sites meet there, that where a ring starts twice, and a few
//! numbers a site.

use std::fmt;

use super::views::view;
use super::{Site, SiteKind};
use crate::geom::Point;

/// Where a site is, without its place in the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SiteShape {
    pub kind: SiteKind,
    /// As of [`Site`].
    pub a: Point,
    pub b: Point,
}

impl From<&Site> for SiteShape {
    #[inline]
    fn from(&Site { kind, a, b, .. }: &Site) -> Self {
        Self { kind, a, b }
    }
}

/// What keeps the sites: eight bytes each, and their points.
///
/// A site along a walk starts where the one before it ends, so points are numbered as they come,
/// and an edge ends at the point after the one where it starts.
#[derive(Clone, Default)]
pub(crate) struct SiteTable {
    points: Vec<Point>,
    records: Vec<Record>,
    /// Runs of sites in one ring.
    runs: Vec<Run>,
    /// The few sites that need more to be said, in their order.
    listed: Vec<Listed>,
}

#[derive(Clone, Copy)]
struct Record {
    /// Number of the start, with `VERTEX` for corners and `LISTED`.
    start: u32,
    index: u32,
}

const VERTEX: u32 = 1 << 31;
const LISTED: u32 = 1 << 30;
const POINT: u32 = LISTED - 1;

/// The greatest numbers mean something else where governors are listed.
const MOST_SITES: usize = (u32::MAX - 8) as usize;

/// Sites from `first` on, up to the next run.
#[derive(Clone, Copy)]
struct Run {
    first: u32,
    polygon: u32,
    ring: u32,
}

/// A site that is a piece of an edge, a corner with two ends, or an edge with one.
#[derive(Clone, Copy)]
struct Listed {
    site: u32,
    part: u32,
    end: u32,
}

impl SiteTable {
    /// An empty table with room for some sites, with so many corners, of so many walks.
    pub fn with_room(sites: usize, corners: usize, walks: usize) -> Self {
        Self {
            points: Vec::with_capacity(corners + walks),
            records: Vec::with_capacity(sites),
            runs: Vec::with_capacity(walks),
            listed: Vec::new(),
        }
    }

    /// The table of all these; `None` if they are too many to be numbered.
    pub fn of(sites: impl ExactSizeIterator<Item = Site>) -> Option<Self> {
        let mut table = Self::with_room(sites.len(), 0, 0);
        for site in sites {
            table.push(&site)?;
        }
        table.shrink();
        Some(table)
    }

    /// Adds a site; `None` if there are too many points. Takes least room for sites in boundary
    /// order.
    pub fn push(&mut self, site: &Site) -> Option<()> {
        self.put(site)
    }

    /// The same, compiled for the site at hand.
    #[inline(always)]
    pub fn put(&mut self, site: &Site) -> Option<()> {
        let number = self.records.len();
        if self.points.len() + 2 > POINT as usize || number >= MOST_SITES {
            return None;
        }
        let number = number as u32;
        let start = match self.points.last() {
            Some(&last) if same(last, site.a) => self.points.len() as u32 - 1,
            _ => self.add(site.a),
        };
        let end = if same(site.b, site.a) { start } else { self.add(site.b) };
        let (flag, usual) = match site.kind {
            SiteKind::Vertex => (VERTEX, start),
            SiteKind::Edge => (0, start + 1),
        };
        let mut record = Record { start: start | flag, index: site.index };
        if end != usual || site.part != 0 {
            record.start |= LISTED;
            self.listed.push(Listed { site: number, part: site.part, end });
        }
        self.records.push(record);
        let Site { polygon, ring, .. } = *site;
        if self.runs.last().is_none_or(|run| (run.polygon, run.ring) != (polygon, ring)) {
            self.runs.push(Run { first: number, polygon, ring });
        }
        Some(())
    }

    #[inline]
    fn add(&mut self, point: Point) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    /// The sites that have a number other than the largest, which is set to that in the new table.
    pub fn among(&self, numbers: &mut [u32]) -> Self {
        // Points keep their order, so whatever ends at the next point still does.
        let mut points = vec![0_u32; self.points.len()];
        let mut kept = 0;
        for (number, _) in (0..).zip(&*numbers).filter(|(_, new)| **new != u32::MAX) {
            let [start, end] = self.ends(number);
            (points[start as usize], points[end as usize]) = (1, 1);
            kept += 1;
        }
        let n_points = points.iter().sum::<u32>() as usize;
        let mut table = Self::with_room(kept, n_points, 0);
        for (point, place) in self.points.iter().zip(&mut points).filter(|(_, place)| **place == 1)
        {
            *place = table.points.len() as u32;
            table.points.push(*point);
        }
        let mut runs = self.runs.iter().peekable();
        let mut run = None;
        for (number, new) in (0..).zip(numbers) {
            run = runs.next_if(|run| run.first == number).or(run);
            if *new == u32::MAX {
                continue;
            }
            *new = table.len();
            if let Some(&whole) = run.take() {
                table.runs.push(Run { first: *new, ..whole });
            }
            let Record { start, index } = self.records[number as usize];
            let place = points[(start & POINT) as usize];
            if start & LISTED != 0 {
                let (part, end) = self.listed_at(number);
                table.listed.push(Listed { site: *new, part, end: points[end as usize] });
            }
            table.records.push(Record { start: start & !POINT | place, index });
        }
        table.shrink();
        table
    }

    /// All sites, without a search for the ring of each.
    pub fn in_order(&self) -> impl Iterator<Item = Site> {
        let mut runs = self.runs.iter().peekable();
        let mut listed = self.listed.iter();
        let (mut polygon, mut ring) = (0, 0);
        (0..).zip(&self.records).map(move |(number, &Record { start, index })| {
            if let Some(run) = runs.next_if(|run| run.first == number) {
                (polygon, ring) = (run.polygon, run.ring);
            }
            let point = start & POINT;
            let (kind, usual) = match start & VERTEX {
                0 => (SiteKind::Edge, point + 1),
                _ => (SiteKind::Vertex, point),
            };
            let (part, end) = match start & LISTED {
                0 => (0, usual),
                _ => listed.next().map_or((0, usual), |listed| (listed.part, listed.end)),
            };
            let (a, b) = (self.points[point as usize], self.points[end as usize]);
            Site { kind, polygon, ring, index, part, a, b }
        })
    }

    /// Gives back the room that was not needed.
    pub fn shrink(&mut self) {
        self.points.shrink_to_fit();
        self.records.shrink_to_fit();
        self.runs.shrink_to_fit();
        self.listed.shrink_to_fit();
    }

    /// The points of all sites.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    pub fn len(&self) -> u32 {
        // No more were added than can be numbered.
        self.records.len() as u32
    }

    fn at(&self, number: u32) -> Site {
        let index = self.records[number as usize].index;
        let (SiteShape { kind, a, b }, part) = self.shape_and_part(number);
        // The first run starts with the first site.
        let run = self.runs.partition_point(|run| run.first <= number) - 1;
        let Run { polygon, ring, .. } = self.runs[run];
        Site { kind, polygon, ring, index, part, a, b }
    }

    /// A site without its place in the input, which takes a search.
    #[inline]
    pub fn shape(&self, number: u32) -> SiteShape {
        self.shape_and_part(number).0
    }

    /// The numbers of the points where a site starts and ends.
    #[inline]
    fn ends(&self, number: u32) -> [u32; 2] {
        let start = self.records[number as usize].start;
        let end = match start & (VERTEX | LISTED) {
            0 => (start & POINT) + 1,
            VERTEX => start & POINT,
            _ => self.listed_at(number).1,
        };
        [start & POINT, end]
    }

    #[inline(always)]
    fn shape_and_part(&self, number: u32) -> (SiteShape, u32) {
        let start = self.records[number as usize].start;
        let (kind, usual) = match start & VERTEX {
            0 => (SiteKind::Edge, (start & POINT) + 1),
            _ => (SiteKind::Vertex, start & POINT),
        };
        let (part, end) = match start & LISTED {
            0 => (0, usual),
            _ => self.listed_at(number),
        };
        let (a, b) = (self.points[(start & POINT) as usize], self.points[end as usize]);
        (SiteShape { kind, a, b }, part)
    }

    #[cold]
    fn listed_at(&self, number: u32) -> (u32, u32) {
        let found = self.listed.partition_point(|l| l.site < number);
        let Listed { part, end, .. } = self.listed[found];
        (part, end)
    }
}

/// The same point, with the same signs of zeros.
fn same(p: Point, q: Point) -> bool {
    (p.x.to_bits(), p.y.to_bits()) == (q.x.to_bits(), q.y.to_bits())
}

impl PartialEq for SiteTable {
    fn eq(&self, other: &Self) -> bool {
        Sites(self) == Sites(other)
    }
}

impl fmt::Debug for SiteTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Sites(self).fmt(f)
    }
}

/// The sites of an axis, numbered from 0; a [`Site`] is put together when it is asked for.
///
/// Coordinates are in units of the input. An axis keeps 8 bytes for each site, 16 for each
/// corner and 28 for each ring. Asking for one site takes logarithmic time in the number of
/// rings.
#[derive(Clone, Copy)]
pub struct Sites<'a>(pub(super) &'a SiteTable);

impl<'a> Sites<'a> {
    /// How many there are.
    #[must_use]
    pub fn len(self) -> usize {
        self.0.records.len()
    }

    /// All of them in their order, without a search for the ring of each.
    pub(crate) fn in_order(self) -> impl Iterator<Item = Site> + use<'a> {
        self.0.in_order()
    }

    /// Site number `number`, counted as [`Path`](super::Path) and
    /// [`MedialAxis::governors`](super::MedialAxis::governors) count.
    ///
    /// # Panics
    /// If the axis has no such site.
    #[must_use]
    pub fn at(self, number: u32) -> Site {
        self.0.at(number)
    }
}

view! {
    Sites of Site;
    /// The sites of an axis, one after the other, by value.
    SitesIter
}

#[cfg(test)]
mod tests {
    use super::*;

    fn site(kind: SiteKind, ring: u32, index: u32, a: (f64, f64), b: (f64, f64)) -> Site {
        let (a, b) = (Point::new(a.0, a.1), Point::new(b.0, b.1));
        Site { kind, polygon: 7, ring, index, part: 0, a, b }
    }

    /// A triangle around a triangle, whose corners are sites.
    fn rings() -> Vec<Site> {
        let outer = [(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)];
        let inner = [(1.0, 1.0), (1.0, 2.0), (2.0, 1.0)];
        let mut sites = Vec::new();
        for k in 0..3 {
            sites.push(site(SiteKind::Edge, 0, k as u32, outer[k], outer[(k + 1) % 3]));
        }
        for k in 0..3 {
            sites.push(site(SiteKind::Vertex, 1, k as u32, inner[k], inner[k]));
            sites.push(site(SiteKind::Edge, 1, k as u32, inner[k], inner[(k + 1) % 3]));
        }
        sites
    }

    fn kept(sites: &[Site]) -> SiteTable {
        SiteTable::of(sites.iter().copied()).expect("few")
    }

    #[test]
    fn sites_in_boundary_order_share_their_points() {
        let sites = rings();
        let table = kept(&sites);
        assert!(Sites(&table).iter().eq(sites.iter().copied()));
        assert!(Sites(&table).iter().rev().eq(sites.iter().rev().copied()));
        // Where each ring starts it ends, too.
        assert_eq!((Sites(&table).len(), table.points.len(), table.runs.len()), (9, 8, 2));
        assert_eq!(table.listed.len(), 0);
    }

    #[test]
    fn sites_in_any_order_with_any_ends_are_kept() {
        let mut sites = rings();
        sites.reverse();
        sites.swap(1, 6);
        sites[0].part = 3;
        sites[2].kind = SiteKind::Vertex;
        sites[3].b = sites[3].a;
        sites[5].a = Point::new(-0.0, 0.0);
        sites[7].index = u32::MAX;
        sites.push(sites[4]);
        let table = kept(&sites);
        for (number, site) in (0..).zip(&sites) {
            assert_eq!(Sites(&table).at(number), *site);
            assert!(same(Sites(&table).at(number).a, site.a));
        }
        let mut other = sites.clone();
        other[0].part = 2;
        assert_ne!(kept(&other), table);
        assert_eq!(kept(&sites), table);
    }

    #[test]
    fn a_walk_that_meets_its_first_point_on_the_way_is_kept() {
        // Two triangles that touch in the point where the walk starts.
        let ring = [(0.0, 0.0), (2.0, -1.0), (2.0, 1.0), (0.0, 0.0), (-2.0, 1.0), (-2.0, -1.0)];
        let sites: Vec<Site> =
            (0..6).map(|k| site(SiteKind::Edge, 0, k as u32, ring[k], ring[(k + 1) % 6])).collect();
        let table = kept(&sites);
        assert!(Sites(&table).iter().eq(sites.iter().copied()));
    }

    #[test]
    fn some_sites_are_a_table_of_their_own() {
        let sites = rings();
        for mask in 0..1_u32 << sites.len() {
            let is_kept = |k: u32| mask >> k & 1 == 1;
            let some: Vec<Site> =
                (0..).zip(&sites).filter(|s| is_kept(s.0)).map(|s| *s.1).collect();
            let number = |k: u32| if is_kept(k) { 0 } else { u32::MAX };
            let mut numbers: Vec<u32> = (0..sites.len() as u32).map(number).collect();
            let table = kept(&sites).among(&mut numbers);
            assert_eq!(table, kept(&some));
            assert!(table.points.len() <= kept(&some).points.len());
            numbers.retain(|&number| number != u32::MAX);
            assert!(numbers.into_iter().eq(0..some.len() as u32));
        }
    }
}
