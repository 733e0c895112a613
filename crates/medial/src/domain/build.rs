use super::assemble::assemble;
use super::lines::supporting_lines;
use super::nesting;
use super::rings::Rings;
use super::sweep::{Arrangement, Purpose, sweep};
use super::{Domain, DomainError, Place, Repair, Report};
use crate::geom::Point;

/// How to treat input that is not valid as it stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Refuse what would change the point set or its topology: OGC Simple Features 6.1.11.
    pub strict: bool,
    /// Find out which rings are holes by their depth (even-odd), whatever their place.
    pub regroup: bool,
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
        let mut report = Report::default();
        let mut rings = Rings::clean(polygons, options, &mut report)?;
        if options.regroup {
            nesting::regroup(&mut rings, &mut report)?;
        }
        let found = sweep(&rings, Purpose::Validate)?;
        let refusal = found.bridge.or(found.self_touch).or(found.shared_edge);
        if let (true, Some(error)) = (options.strict, refusal) {
            return Err(error);
        }
        note_touches(&rings, &found, &mut report);
        let walks = assemble(&rings, &found)?;
        let edges: Vec<_> = (0..rings.points.len() as u32)
            .map(|edge| (rings.point(edge), rings.point(rings.next(edge))))
            .collect();
        let mut domain =
            Self::from_walks(walks, &supporting_lines(&edges), report).with_holes_along_a_curve();
        let mut outer = vec![0; polygons.len()];
        for ring in rings.rings.iter().filter(|ring| !ring.hole) {
            outer[ring.polygon as usize] += 1;
        }
        for (polygon, parts) in (0..).zip(domain.parts(polygons.len())) {
            let at = Place { polygon, ring: 0, index: 0, lone: rings.lone };
            if parts == 0 && outer[polygon as usize] > 0 {
                return Err(DomainError::Empty { at });
            } else if parts > outer[polygon as usize] {
                if options.strict {
                    return Err(DomainError::CutInterior { at, parts });
                }
                domain.report.push(Repair::CutInterior, polygon, 0, Vec::new());
            }
        }
        domain.number_components()?;
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
