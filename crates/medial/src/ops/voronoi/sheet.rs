//! One side of the boundary with the axis there.

use std::collections::HashMap;

use smallvec::SmallVec;

use super::VoronoiError;
use crate::axis::{self, MedialAxis};
use crate::check::Name;
use crate::domain::{Corner, Domain, Site};
use crate::geom::predicates::{Element, ExactDisk};
use crate::geom::{Point, Rect};
use crate::ops::ground::Ground;

/// A side with its axis.
#[derive(Debug)]
pub(super) struct Sheet<'a> {
    pub ground: Ground<'a>,
    pub axis: &'a MedialAxis,
    /// The element behind each site of the axis.
    governors: Vec<Site>,
    /// The elements with a cell, along the boundary of the polygons.
    pub elements: Vec<Site>,
    /// The number of the site behind each element, [`NONE`] without a cell.
    numbers: Vec<u32>,
    /// The element behind each site of the diagram, [`NONE`] without a cell here.
    of_sites: Vec<u32>,
}

/// No number.
pub(super) const NONE: u32 = u32::MAX;

impl<'a> Sheet<'a> {
    /// Matches the sites of the axis with the domain by their names.
    pub fn new(
        domain: &'a Domain,
        axis: &'a MedialAxis,
        frame: &Rect,
    ) -> Result<Self, VoronoiError> {
        let ground = Ground::new(domain, axis.side, frame).ok_or(VoronoiError::Frame)?;
        let unknown = |name| VoronoiError::UnknownSite { side: axis.side, name };
        let governors = ground.governors(axis).map_err(unknown)?;
        let elements =
            ground.elements().into_iter().filter(|&site| ground.has_cell(site)).collect();
        Ok(Self { ground, axis, governors, elements, numbers: Vec::new(), of_sites: Vec::new() })
    }

    pub fn domain(&self) -> &Domain {
        self.ground.domain()
    }

    /// The number of the site of an element with a cell.
    pub fn number(&self, element: Site) -> u32 {
        self.numbers[element.0 as usize]
    }

    /// The number of sites of the whole diagram.
    pub fn n_sites(&self) -> usize {
        self.of_sites.len()
    }

    /// The element behind a site that has a cell here.
    pub fn element_of(&self, site: u32) -> Site {
        Site(self.of_sites[site as usize])
    }

    /// The element behind a site of the axis.
    pub fn governor(&self, site: u32) -> Site {
        self.governors[site as usize]
    }

    /// The governors of a keypoint as elements.
    pub fn governors(&self, keypoint: u32) -> impl ExactSizeIterator<Item = Site> + Clone {
        self.axis.governors(keypoint).iter().map(|&site| self.governor(site))
    }

    /// Where the chain around the cell of an element begins and ends, counterclockwise.
    pub fn ends_around(&self, element: Site) -> [Point; 2] {
        let start = self.domain().edge(element.index()).start;
        if element.is_edge() { [self.domain().end(element.index()), start] } else { [start; 2] }
    }

    /// Whether the contacts of two governors of one keypoint, one after the other counterclockwise,
    /// are one; then gives the corner where they are.
    pub fn one_contact(&self, first: Site, second: Site) -> Option<Site> {
        let follows = || self.domain().edge(first.index()).next == second.index();
        match (first.is_edge(), second.is_edge()) {
            (false, true) => (first.index() == second.index()).then_some(first),
            (true, false) => follows().then_some(second),
            (true, true) => {
                let straight = self.domain().edge(second.index()).corner == Corner::Straight;
                (straight && follows()).then(|| Site::corner(second.index()))
            }
            (false, false) => None,
        }
    }

    /// The element as predicates see it from this side.
    pub fn element(&self, site: Site) -> Element {
        self.domain().element(site)
    }

    /// The maximal disk of a keypoint; `None` at an end, and where a path is cut.
    pub fn disk(&self, keypoint: u32) -> Option<ExactDisk> {
        let three = match self.axis.governors(keypoint).len() {
            0..=2 => return None,
            3..=FEW => self.three_of_few(keypoint)?,
            n => [0, n / 3, 2 * n / 3].map(|k| self.start_of_contact(keypoint, k)),
        };
        ExactDisk::new(three.map(|site| self.element(site)))
    }

    /// Governor number `k` of a keypoint, counted around.
    fn governor_at(&self, keypoint: u32, k: usize) -> Site {
        let list = self.axis.governors(keypoint);
        self.governor(list[k % list.len()])
    }

    /// The first governor of the contact that governor number `k` has.
    fn start_of_contact(&self, keypoint: u32, k: usize) -> Site {
        let before = self.governor_at(keypoint, k + self.axis.governors(keypoint).len() - 1);
        let here = self.governor_at(keypoint, k);
        if self.one_contact(before, here).is_some() { before } else { here }
    }

    /// Three sites that define the disk of a keypoint, counterclockwise; a corner may stand for a
    /// straight joint.
    fn three_of_few(&self, keypoint: u32) -> Option<[Site; 3]> {
        let mut starts: SmallVec<[Site; FEW]> = SmallVec::new();
        let mut pair = None;
        for k in 0..self.axis.governors(keypoint).len() {
            let (here, next) = (self.governor_at(keypoint, k), self.governor_at(keypoint, k + 1));
            match self.one_contact(here, next) {
                Some(corner) if corner == here => pair = Some((here, next)),
                Some(corner) => pair = Some((here, corner)),
                None => {}
            }
            if self.start_of_contact(keypoint, k) == here {
                starts.push(here);
            }
        }
        match *starts {
            [a, b] => {
                let (first, second) = pair?;
                Some([first, second, if a == first { b } else { a }])
            }
            [a, _, _, ..] => Some([a, starts[starts.len() / 3], starts[2 * starts.len() / 3]]),
            _ => None,
        }
    }
}

/// Governors up to which all contacts of a keypoint are looked at for its disk.
const FEW: usize = 6;

/// Numbers the elements with a cell: those of the first sheet in their order, then those that only the
/// next one has.
pub(super) fn number(sheets: &mut [Sheet]) -> Vec<axis::Site> {
    let mut sites: Vec<axis::Site> = Vec::new();
    let mut known: HashMap<(Name, [u64; 4]), u32> = HashMap::new();
    for sheet in &mut *sheets {
        sheet.numbers = vec![NONE; 2 * sheet.domain().edges().len()];
        for &element in &sheet.elements {
            let site = sheet.ground.named(element);
            // Where boundaries touch, the sides may cut one edge into other pieces.
            let place = [site.a.x, site.a.y, site.b.x, site.b.y].map(f64::to_bits);
            let key = (Name::of(sheet.ground.domain(), element), place);
            let number = *known.entry(key).or_insert(sites.len() as u32);
            if number as usize == sites.len() {
                sites.push(site);
            }
            sheet.numbers[element.0 as usize] = number;
        }
    }
    for sheet in sheets {
        sheet.of_sites = vec![NONE; sites.len()];
        for &element in &sheet.elements {
            sheet.of_sites[sheet.numbers[element.0 as usize] as usize] = element.0;
        }
    }
    sites
}
