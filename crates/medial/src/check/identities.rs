use super::context::Context;
use super::verdict::{Counts, Identity, Relation};
use crate::axis::{Accuracy, KeypointKind};
use crate::domain::Corner;
use crate::geom::{DisjointSets, Point, dot_directions, order_key, orient2d};

/// Counts what there is on the domain and on the axis.
pub(super) fn counts(context: &Context) -> Counts {
    let (domain, axis) = (context.domain, context.axis);
    let edges = &domain.edges()[context.n_walls as usize..];
    let corners = |kind: Corner| edges.iter().filter(|e| e.corner == kind).count();
    let keypoints = |kind| axis.keypoints().iter().filter(|k| k.kind == kind).count();
    let n = axis.keypoints().len();
    let mut degrees = vec![0u32; n];
    let mut groups = DisjointSets::new(n);
    for path in axis.paths() {
        degrees[path.from as usize] += 1;
        degrees[path.to as usize] += 1;
        groups.join(path.from, path.to);
    }
    // All paths that are cut meet at infinity.
    let cut = (0..n as u32).filter(|&k| axis.keypoints().at(k).kind == KeypointKind::Clipped);
    let cut: Vec<u32> = if context.horizon.is_some() { cut.collect() } else { Vec::new() };
    for pair in cut.windows(2) {
        groups.join(pair[0], pair[1]);
    }
    let n = n - cut.len().saturating_sub(1);
    let axis_components = groups.count();
    let paths = axis.paths().len();
    Counts {
        edges: edges.len(),
        convex: corners(Corner::Convex),
        reflex: corners(Corner::Reflex),
        straight: corners(Corner::Straight),
        walks: context.walks().len(),
        components: domain.n_components(),
        sites: axis.sites().len(),
        ends: keypoints(KeypointKind::End),
        transitions: keypoints(KeypointKind::Transition),
        junctions: keypoints(KeypointKind::Junction),
        tips: keypoints(KeypointKind::Tip),
        clipped: keypoints(KeypointKind::Clipped),
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
/// adds an edge and one to the sum at one keypoint, and nothing else. Inner keypoints are the points
/// of the Voronoi diagram of edges and reflex corners, and paths its edges, but for the normals at
/// both ends of the zone of a corner. So the bounds of [Lee82, lemma 3] follow: n + m - 2 points and
/// 2(n + m) - 3 edges for a simple polygon, 2 and 3 more for each hole. They are met where no keypoint
/// has more than three governors.
///
/// Outside, infinity counts as one more walk. The h paths that go there end in no keypoint, which
/// leaves h less of the sum, and so do the j joints at edges on the hull, whose normals go there too.
pub(super) fn identities(context: &Context, counts: &Counts) -> Vec<Identity> {
    let equal = |name, expected: i64, found: i64| Identity {
        name,
        expected: expected as f64,
        found: found as f64,
        relation: Relation::Equal,
    };
    let (w, c) = (counts.walks as i64, counts.components as i64);
    let (w, c) = match context.axis.accuracy {
        Accuracy::Exact => (w, c),
        Accuracy::Sampled(_) => through_corners(context, counts)
            .or_else(|| seen_by_samples(context, counts))
            .unwrap_or((w, c)),
    };
    let (outside, h) = (i64::from(context.horizon.is_some()), context.n_gaps() as i64);
    let without = n_without(context) as i64;
    let topology = [
        equal("cycles", w - c, counts.cycles as i64),
        equal("components of the axis", c - without, counts.axis_components as i64),
    ];
    let w = w + outside;
    if context.axis.accuracy != Accuracy::Exact {
        return topology.into();
    }
    let axis = context.axis;
    let (n, m) = (counts.edges as i64, counts.reflex as i64);
    let (paths, keypoints) = (counts.paths as i64, axis.keypoints().len() as i64);
    let is_last = |kind| matches!(kind, KeypointKind::End | KeypointKind::Clipped);
    let inner = |k: &u32| !is_last(axis.keypoints().at(*k).kind);
    let governors: i64 =
        (0..keypoints as u32).filter(inner).map(|k| axis.governors(k).len() as i64 - 2).sum();
    let last = (counts.ends + counts.clipped) as i64;
    let points = keypoints - last;
    let leaves = n - m - counts.straight as i64;
    let far = h + far_joints(context);
    let spare = n + m + 2 * w - 4 * c - far;
    // With the two normals of each corner, and one between the edges of a joint.
    let voronoi = paths + 2 * m + counts.straight as i64;
    let at_most = |name, expected: i64, found: i64| Identity {
        relation: Relation::AtMost,
        ..equal(name, expected, found)
    };
    let mut all: Vec<Identity> = topology.into();
    all.extend([
        equal("leaves", leaves + h, counts.leaves as i64),
        equal("sum of (governors - 2) over inner keypoints", spare, governors),
        equal(
            "sum of (degree - 2) over inner keypoints",
            leaves + 2 * (w - 2 * c) - h,
            2 * paths - last - 2 * points,
        ),
        equal("paths less keypoints", w - 2 * c - h, paths - keypoints),
        at_most("inner keypoints", spare, points),
        at_most("Voronoi edges", 2 * (n + m) + 3 * w - 6 * c - far, voronoi),
    ]);
    all
}

/// Walks and components if parts that touch in points are one, where the axis has as many components: samples may
/// go across such a point.
fn seen_by_samples(context: &Context, counts: &Counts) -> Option<(i64, i64)> {
    let domain = context.domain;
    let mut starts: Vec<(Point, u32)> = context
        .walks()
        .flat_map(|(_, walk)| walk.edges().map(|edge| (domain.edge(edge).start, walk.component)))
        .collect();
    starts.sort_by_key(|(p, _)| (order_key(p.x), order_key(p.y)));
    let mut groups = DisjointSets::new(domain.n_components());
    // How many points are the same as another one.
    let mut shared = 0;
    for pair in starts.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        shared += 1;
        groups.join(pair[0].1, pair[1].1);
    }
    let components = groups.count();
    // Each shared point takes one from the components less the holes.
    let holes = components as i64 - (2 * counts.components as i64 - counts.walks as i64 - shared);
    let differs = components != counts.components || shared > 0;
    let fits = counts.axis_components == components;
    // Or they may not, and then all is as it is for an exact axis.
    let is_as_told = counts.axis_components + n_without(context) == counts.components
        && counts.cycles + counts.components == counts.walks;
    (differs && fits && !is_as_told).then_some((components as i64 + holes, components as i64))
}

/// How many components have no axis: the outside of what is convex.
fn n_without(context: &Context) -> usize {
    usize::from(context.horizon.is_some() && context.n_gaps() == 0)
}

/// Walks and components if parts are one that touch in points with a corner of less than half a turn each, and share no
/// edge there, where the axis has as many components and cycles: it may go through such a point from one corner to the
/// other.
fn through_corners(context: &Context, counts: &Counts) -> Option<(i64, i64)> {
    let domain = context.domain;
    let all = context.walks().flat_map(|(_, walk)| walk.edges());
    let mut corners: Vec<u32> = all.collect();
    let at = |&edge: &u32| domain.edge(edge).start;
    corners.sort_by_key(|edge| (order_key(at(edge).x), order_key(at(edge).y)));
    let mut groups = DisjointSets::new(domain.n_components());
    let mut shared = 0;
    // Edges that go on through a corner of another polygon.
    let mut passing = domain.touched_edges().unwrap_or_default();
    let key = |p: Point| (order_key(p.x), order_key(p.y));
    passing.sort_by_key(|&(_, touched)| key(touched));
    for together in corners.chunk_by(|a, b| at(a) == at(b)).filter(|corners| corners.len() > 1) {
        let place = at(&together[0]);
        let before = |edge: u32| domain.edge(domain.edge(edge).prev).start;
        let first = passing.partition_point(|&(_, touched)| key(touched) < key(place));
        let through = passing[first..].iter().take_while(|(_, touched)| *touched == place);
        let through = through.map(|&(edge, _)| (domain.edge(edge).start, domain.end(edge)));
        let ways = together.iter().map(|&edge| (before(edge), domain.end(edge)));
        let ways: Vec<(Point, Point)> = ways.chain(through).collect();
        let share =
            |&(_, to): &(Point, Point)| ways.iter().any(|&(from, _)| lie_along(place, to, from));
        if ways.iter().any(share) {
            continue;
        }
        let convex = |edge: &&u32| domain.edge(**edge).corner == Corner::Convex;
        let component = |edge: &u32| domain.walks()[domain.edge(*edge).walk as usize].component;
        let convex: Vec<u32> = together.iter().filter(convex).map(component).collect();
        for pair in convex.windows(2) {
            shared += 1;
            groups.join(pair[0], pair[1]);
        }
    }
    // Each of these points joins components or closes a cycle.
    let components = groups.count() as i64;
    let cycles = (counts.walks as i64 - 2 * counts.components as i64) + shared + components;
    let found = (counts.axis_components + n_without(context)) as i64;
    let fits = found == components && counts.cycles as i64 == cycles;
    (shared > 0 && fits).then_some((components + cycles, components))
}

/// Whether two points are seen in one direction from a place.
fn lie_along(place: Point, a: Point, b: Point) -> bool {
    orient2d(place, a, b) == 0.0 && dot_directions(place, a, place, b) > 0.0
}

/// Joints of sites whose common normal goes to infinity, at the ends of edges on the hull.
fn far_joints(context: &Context) -> i64 {
    let domain = context.domain;
    let edges = context.horizon.iter().flat_map(|horizon| &horizon.edges);
    let at_corner = |corner: u32| domain.edge(corner).corner == Corner::Reflex;
    // A joint of two straight pieces is one of both of them.
    edges.map(|&edge| 1 + i64::from(at_corner(domain.edge(edge).next))).sum()
}
