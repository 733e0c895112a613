use super::context::Context;
use super::verdict::{Counts, Identity, Relation};
use crate::axis::{Accuracy, KeypointKind};
use crate::domain::Corner;

/// Counts what there is on the domain and on the axis.
pub(super) fn counts(context: &Context) -> Counts {
    let (domain, axis) = (context.domain, context.axis);
    let corners = |kind: Corner| domain.edges().iter().filter(|e| e.corner == kind).count();
    let keypoints = |kind| axis.keypoints().iter().filter(|k| k.kind == kind).count();
    let n = axis.keypoints().len();
    let mut degrees = vec![0u32; n];
    let mut groups = Groups::new(n);
    for path in axis.paths() {
        degrees[path.from as usize] += 1;
        degrees[path.to as usize] += 1;
        groups.join(path.from, path.to);
    }
    let axis_components = groups.count();
    let paths = axis.paths().len();
    Counts {
        edges: domain.edges().len(),
        convex: corners(Corner::Convex),
        reflex: corners(Corner::Reflex),
        straight: corners(Corner::Straight),
        walks: domain.walks().len(),
        components: domain.n_components(),
        sites: axis.sites().len(),
        ends: keypoints(KeypointKind::End),
        transitions: keypoints(KeypointKind::Transition),
        junctions: keypoints(KeypointKind::Junction),
        paths,
        leaves: degrees.iter().filter(|&&d| d == 1).count(),
        axis_components,
        // A graph without cycles has as many components as keypoints are left over by its paths.
        cycles: paths + axis_components - n,
    }
}

/// The identities of a complete axis.
///
/// With n edges, m reflex corners, W walks, C components and k governors at a keypoint: the sum of
/// k - 2 over inner keypoints is n + m + 2W - 4C; a straight joint, whose two edges are one contact,
/// adds an edge and one to the sum at one keypoint, and nothing else.
pub(super) fn identities(context: &Context, counts: &Counts) -> Vec<Identity> {
    let equal = |name, expected: i64, found: i64| Identity {
        name,
        expected: expected as f64,
        found: found as f64,
        relation: Relation::Equal,
    };
    let (w, c) = (counts.walks as i64, counts.components as i64);
    let topology = [
        equal("cycles", w - c, counts.cycles as i64),
        equal("components of the axis", c, counts.axis_components as i64),
    ];
    if context.axis.accuracy != Accuracy::Exact {
        return topology.into();
    }
    let axis = context.axis;
    let (n, m) = (counts.edges as i64, counts.reflex as i64);
    let (paths, keypoints) = (counts.paths as i64, axis.keypoints().len() as i64);
    let inner = |k: &u32| axis.keypoints().at(*k).kind != KeypointKind::End;
    let governors: i64 =
        (0..keypoints as u32).filter(inner).map(|k| axis.governors(k).len() as i64 - 2).sum();
    let points = keypoints - counts.ends as i64;
    let leaves = n - m - counts.straight as i64;
    let spare = n + m + 2 * w - 4 * c;
    // Normals at the two ends of the zone of a corner, and one between the edges of a joint.
    let voronoi = paths + 2 * m + counts.straight as i64;
    let at_most = |name, expected: i64, found: i64| Identity {
        relation: Relation::AtMost,
        ..equal(name, expected, found)
    };
    let mut all: Vec<Identity> = topology.into();
    all.extend([
        equal("leaves", leaves, counts.leaves as i64),
        equal("sum of (governors - 2) over inner keypoints", spare, governors),
        equal(
            "sum of (degree - 2) over inner keypoints",
            leaves + 2 * (w - 2 * c),
            2 * paths - counts.ends as i64 - 2 * points,
        ),
        equal("paths less keypoints", w - 2 * c, paths - keypoints),
        at_most("inner keypoints", spare, points),
        at_most("Voronoi edges", 2 * (n + m) + 3 * w - 6 * c, voronoi),
    ]);
    all
}

/// Disjoint sets of keypoints.
struct Groups {
    parent: Vec<u32>,
}

impl Groups {
    fn new(n: usize) -> Self {
        Self { parent: (0..n as u32).collect() }
    }

    fn find(&mut self, mut k: u32) -> u32 {
        while self.parent[k as usize] != k {
            let grandparent = self.parent[self.parent[k as usize] as usize];
            self.parent[k as usize] = grandparent;
            k = grandparent;
        }
        k
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    fn count(&self) -> usize {
        self.parent.iter().enumerate().filter(|&(k, &parent)| k as u32 == parent).count()
    }
}
