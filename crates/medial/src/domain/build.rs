use std::mem;
use std::time::Instant;

use super::apart::{Nesting, apart};
use super::assemble::assemble;
use super::nesting::regroup;
use super::outlines::Draft;
use super::repair::repaired;
use super::rings::{Rings, count_vertices};
use super::status::NONE;
use super::sweep::{Arrangement, Purpose, sweep};
use super::{Domain, DomainError, FillRule, Place, Repair, Report};
use crate::geom::Point;

/// How to treat input that is not valid as it stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Refuse what would change the point set or its topology: OGC Simple Features 6.1.11.
    pub strict: bool,
    /// Find out which rings are holes by their depth (even-odd), whatever their place.
    pub regroup: bool,
    /// Repair what is not valid: cut edges where they meet, and take what the rings of each polygon
    /// enclose by the fill rule. What is valid stays as it is.
    pub repair: bool,
    /// Which points the rings of a polygon enclose; for other rules than even-odd holes are not told
    /// by their place.
    pub fill: FillRule,
    /// Unite the polygons of a feature.
    pub dissolve: bool,
    /// When to give up a repair, which may find a crossing for every two edges.
    pub deadline: Option<Instant>,
}

impl Domain {
    /// Validates polygons, each a list of rings, the first of them the outer one.
    ///
    /// The rings need not be closed, and may run either way round. O(n log n) for n vertices;
    /// every decision is exact.
    ///
    /// ```
    /// use medial::domain::{Domain, Options};
    /// use medial::geom::Point;
    ///
    /// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
    /// let domain = Domain::from_polygons(&[vec![square.to_vec()]], &Options::default())?;
    /// assert_eq!((domain.edges().len(), domain.area()), (4, 4.0));
    ///
    /// let bow_tie = [square[0], square[2], square[1], square[3]].to_vec();
    /// let error = Domain::from_polygons(&[vec![bow_tie]], &Options::default()).unwrap_err();
    /// assert_eq!(error.code(), "crossing");
    /// # Ok::<(), medial::domain::DomainError>(())
    /// ```
    ///
    /// # Errors
    /// [`DomainError`] says where and why the polygons do not bound a domain.
    pub fn from_polygons(
        polygons: &[Vec<Vec<Point>>],
        options: &Options,
    ) -> Result<Self, DomainError> {
        let is_united = options.dissolve && polygons.len() > 1;
        if options.fill == FillRule::EvenOdd && !is_united {
            return match Self::validated(polygons, options) {
                Err(error) if options.repair && !options.strict && error.is_reparable() => {
                    Self::repaired(polygons, options, error)
                }
                result => result,
            };
        }
        let regroup = options.regroup || options.fill != FillRule::EvenOdd;
        let plain = Options { regroup, ..*options };
        match Self::validated(polygons, &plain) {
            Err(error) if !error.is_reparable() => Err(error),
            // What crosses is refused, what is only united or nested otherwise is not.
            Err(error) if options.strict || !options.repair => match error {
                DomainError::PolygonsOverlap { .. } | DomainError::SharedEdge { .. }
                    if is_united =>
                {
                    Self::repaired(polygons, options, error)
                }
                error => Err(error),
            },
            Err(error) => Self::repaired(polygons, options, error),
            Ok(domain) if polygons.iter().map(Vec::len).sum::<usize>() < 2 => Ok(domain),
            Ok(_) => repaired(polygons, options),
        }
    }

    /// The domain of polygons that are not valid because of an error.
    fn repaired(
        polygons: &[Vec<Vec<Point>>],
        options: &Options,
        error: DomainError,
    ) -> Result<Self, DomainError> {
        match (repaired(polygons, options), error) {
            // What was wrong with the rings says why nothing is left.
            (
                Err(DomainError::Empty { .. }),
                DomainError::TooFewPoints { .. } | DomainError::Collinear { .. },
            ) => Err(error),
            (result, _) => result,
        }
    }

    /// The domain of polygons that are valid, or become so without new vertices.
    pub(super) fn validated(
        polygons: &[Vec<Vec<Point>>],
        options: &Options,
    ) -> Result<Self, DomainError> {
        let mut report = Report::default();
        let n_vertices = count_vertices(polygons)?;
        let draft = Draft::with_room(n_vertices, polygons.iter().map(Vec::len).sum());
        let mut rings = Rings::clean(polygons, options, &mut report)?;
        let nesting = apart(&rings);
        if options.regroup {
            let parents = match &nesting {
                Some(nesting) => nesting.parents(),
                None => {
                    rings.number();
                    sweep(&rings, Purpose::Nest)?.parents
                }
            };
            regroup(&mut rings, &parents, &mut report);
        }
        match nesting {
            Some(nesting) if nesting.sides_agree(&rings) => {
                let order = (rings.lone && !options.regroup).then(|| mem::take(&mut rings.order));
                Self::of_rings(draft, &rings, &nesting, order, report)
            }
            _ => Self::of_touching_rings(draft, rings, polygons.len(), options, report),
        }
    }

    /// The domain bounded by rings that are simple, apart from one another, and well nested; the
    /// order of its walks may be known.
    pub(super) fn of_rings(
        draft: Draft,
        rings: &Rings,
        nesting: &Nesting,
        order: Option<Vec<u32>>,
        report: Report,
    ) -> Result<Self, DomainError> {
        let order = order.unwrap_or_else(|| rings.walk_order());
        let mut domain = draft.rings(rings, &order, report);
        domain.number_components(|_| {
            let mut places = vec![NONE; order.len()];
            for (new, &old) in (0..).zip(&order) {
                places[old as usize] = new;
            }
            let parents = nesting.parents();
            let place =
                |&ring: &u32| places.get(parents[ring as usize] as usize).copied().unwrap_or(NONE);
            Ok(order.iter().map(place).collect())
        })?;
        Ok(domain)
    }

    /// The domain bounded by any rings, if there is one.
    pub(super) fn of_touching_rings(
        draft: Draft,
        mut rings: Rings,
        polygons: usize,
        options: &Options,
        mut report: Report,
    ) -> Result<Self, DomainError> {
        rings.number();
        let found = sweep(&rings, Purpose::Validate)?;
        let refusal = found.bridge.or(found.self_touch).or(found.shared_edge);
        if let (true, Some(error)) = (options.strict, refusal) {
            return Err(error);
        }
        note_touches(&rings, &found, &mut report);
        let outlines = assemble(&rings, &found)?;
        let mut outer = vec![0; polygons];
        for ring in rings.rings.iter().filter(|ring| !ring.hole) {
            outer[ring.polygon as usize] += 1;
        }
        let lone = rings.lone;
        drop((rings, found));
        let order = outlines.order();
        let mut domain = draft.outlines(outlines, &order, report);
        for (polygon, parts) in (0..).zip(domain.parts(polygons)) {
            let at = Place { polygon, ring: 0, index: 0, lone };
            if parts == 0 && outer[polygon as usize] > 0 {
                return Err(DomainError::Empty { at });
            } else if parts > outer[polygon as usize] {
                if options.strict {
                    return Err(DomainError::CutInterior { at, parts });
                }
                domain.report.push(Repair::CutInterior, polygon, 0, Vec::new());
            }
        }
        domain.number_components(|domain| {
            Ok(sweep(&Rings::of_walks(domain), Purpose::Validate)?.parents)
        })?;
        Ok(domain)
    }
}

/// Reports what touching rings led to.
fn note_touches(rings: &Rings, found: &Arrangement, report: &mut Report) {
    let cut = found.cuts.iter().map(|c| c.0);
    let removed = found.removed.iter().map(|p| p.edge);
    let lists: [(Repair, Vec<u32>); 3] = [
        (Repair::SplitEdge, cut.collect()),
        (Repair::SelfTouch, found.self_touches.clone()),
        (Repair::Bridge, removed.collect()),
    ];
    for (repair, mut edges) in lists {
        edges.sort_unstable();
        edges.dedup();
        for same in edges.chunk_by(|&a, &b| rings.ring[a as usize] == rings.ring[b as usize]) {
            let ring = rings.ring_of(same[0]);
            let mut indices: Vec<u32> = same.iter().map(|&e| rings.edge_index(e)).collect();
            indices.sort_unstable();
            report.push(repair, ring.polygon, ring.index, indices);
        }
    }
}
