use super::*;
use crate::axis::{Engine, KeypointKind, SiteKind};
use crate::domain::Options;
use crate::engine::{self, exterior, path_tracing};

fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

fn domain(rings: &[&[(f64, f64)]]) -> Domain {
    let ring = |ring: &&[(f64, f64)]| ring.iter().map(|&(x, y)| p(x, y)).collect();
    Domain::from_polygons(&[rings.iter().map(ring).collect()], &Options::default()).unwrap()
}

const SQUARE: &[(f64, f64)] = &[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
const L: &[(f64, f64)] = &[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)];

/// Calls `ask` with the diagram of the interior.
fn with<R>(domain: &Domain, ask: impl FnOnce(&Voronoi) -> R) -> R {
    let axes = [path_tracing(domain).unwrap()];
    ask(&Voronoi::new(domain, &axes).unwrap())
}

/// The axis outside, cut so far from the box.
fn outside(domain: &Domain, margin: f64) -> MedialAxis {
    exterior(domain, Engine::PathTracing, Some(margin), &engine::Options::default()).unwrap()
}

/// Where a point lies, its distance, and the kinds and positions in their rings of what is nearest.
fn told(voronoi: &Voronoi, x: f64, y: f64) -> (Region, f64, Vec<(SiteKind, u32)>) {
    let Located { region, distance, contacts } = voronoi.locate(p(x, y)).unwrap();
    (region, distance, contacts.iter().map(|c| (c.site.kind, c.site.index)).collect())
}

#[test]
fn a_square_has_four_triangles() {
    let square = domain(&[SQUARE]);
    with(&square, |voronoi| {
        assert_eq!((voronoi.points().len(), voronoi.edges().len()), (5, 4));
        assert!(voronoi.edges().iter().all(|edge| edge.kind == EdgeKind::Path));
        let rings: Vec<_> = voronoi.cells().map(|cell| voronoi.ring(&cell, 0.1)).collect();
        assert_eq!(rings[0], [p(-1.0, -1.0), p(1.0, -1.0), p(0.0, 0.0)]);
        assert_eq!(rings[1], [p(1.0, -1.0), p(1.0, 1.0), p(0.0, 0.0)]);
        assert_eq!(rings.len(), 4);
    });
}

#[test]
fn a_reflex_corner_has_a_wedge_between_its_normals() {
    let shape = domain(&[L]);
    with(&shape, |voronoi| {
        // n + m cells, and 2(n + m) - 3 edges at most: 9 paths and 2 normals of 11.
        assert_eq!((voronoi.cells().len(), voronoi.edges().len()), (7, 11));
        let corner = voronoi.sites().iter().position(|site| site.kind == SiteKind::Vertex);
        let cell = voronoi.cells().find(|cell| Some(cell.site as usize) == corner).unwrap();
        let outline = voronoi.outline(&cell);
        // Two normals of length 1/2 and two parabolas that meet on the diagonal.
        let q = 2.0 - 2.0_f64.sqrt();
        let ends: Vec<Point> = outline.iter().map(Curve::from).collect();
        assert_eq!(ends[0], p(1.0, 1.0));
        assert_eq!([ends[1], ends[3]], [p(0.5, 1.0), p(1.0, 0.5)]);
        assert!((ends[2] - p(q, q)).norm() < 1e-15);
        assert_eq!(outline.iter().filter(|curve| curve.control().is_some()).count(), 2);
        assert_eq!(outline.last().unwrap().to(), p(1.0, 1.0));
    });
}

#[test]
fn normals_run_from_their_corner_with_the_cells_on_their_sides() {
    let shape = domain(&[L]);
    with(&shape, |voronoi| {
        for edge in voronoi.edges().iter().filter(|edge| edge.kind == EdgeKind::Normal) {
            let [from, to] = [edge.from, edge.to].map(|k| voronoi.points()[k as usize]);
            assert_eq!((from.position, from.kind), (p(1.0, 1.0), PointKind::Corner));
            assert_eq!(to.kind, PointKind::Keypoint(KeypointKind::Transition));
            let [left, right] =
                [edge.left, edge.right.unwrap()].map(|site| voronoi.sites()[site as usize]);
            // The walls of the arms: the one before the corner on the left, the one after it on the right.
            match to.position {
                at if at == p(1.0, 0.5) => {
                    assert_eq!((left.a, right.kind), (p(3.0, 1.0), SiteKind::Vertex))
                }
                at => assert_eq!(
                    (at, left.kind, right.b),
                    (p(0.5, 1.0), SiteKind::Vertex, p(1.0, 3.0))
                ),
            }
        }
    });
}

#[test]
fn the_cells_of_a_ring_of_a_hole_are_closed() {
    let hole = &[(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    let shape = domain(&[SQUARE, hole]);
    with(&shape, |voronoi| {
        // 8 edges, 4 corners of the hole.
        assert_eq!(voronoi.cells().len(), 12);
        for cell in voronoi.cells() {
            let outline = voronoi.outline(&cell);
            for (k, curve) in outline.iter().enumerate() {
                assert_eq!(curve.to(), outline[(k + 1) % outline.len()].from());
            }
        }
        assert_eq!(told(voronoi, 0.0, 0.0).0, Region::Exterior);
        assert_eq!(told(voronoi, 0.0, 0.75).2.len(), 2);
    });
}

#[test]
fn points_of_a_square_have_their_wall() {
    let square = domain(&[SQUARE]);
    with(&square, |voronoi| {
        use SiteKind::{Edge, Vertex};
        assert_eq!(told(voronoi, 0.1, -0.5), (Region::Interior, 0.5, vec![(Edge, 0)]));
        // On a diagonal, in the centre, on an edge, in a corner, outside an edge and a corner.
        assert_eq!(told(voronoi, 0.5, 0.5), (Region::Interior, 0.5, vec![(Edge, 1), (Edge, 2)]));
        assert_eq!(told(voronoi, 0.0, 0.0).2, [0, 1, 2, 3].map(|k| (Edge, k)));
        assert_eq!(told(voronoi, 0.3, -1.0), (Region::Boundary, 0.0, vec![(Edge, 0)]));
        assert_eq!(told(voronoi, 1.0, -1.0), (Region::Boundary, 0.0, vec![(Vertex, 1)]));
        assert_eq!(told(voronoi, 0.0, -3.0), (Region::Exterior, 2.0, vec![(Edge, 0)]));
        assert_eq!(told(voronoi, 4.0, 5.0), (Region::Exterior, 5.0, vec![(Vertex, 2)]));
        assert_eq!(told(voronoi, 1.0, 5.0), (Region::Exterior, 4.0, vec![(Vertex, 2)]));
    });
}

#[test]
fn the_reflex_corner_of_an_l_is_nearest_between_its_normals() {
    let shape = domain(&[L]);
    with(&shape, |voronoi| {
        use SiteKind::{Edge, Vertex};
        assert_eq!(told(voronoi, 0.75, 0.75).2, [(Vertex, 3)]);
        // On a normal the corner is the footpoint, whichever cell one counts it to.
        assert_eq!(told(voronoi, 1.0, 0.75), (Region::Interior, 0.25, vec![(Vertex, 3)]));
        // At its end a transition: the corner and the floor.
        assert_eq!(told(voronoi, 1.0, 0.5).2, [(Edge, 0), (Vertex, 3)]);
        // In the notch outside, the two walls.
        assert_eq!(told(voronoi, 2.0, 2.0), (Region::Exterior, 1.0, vec![(Edge, 2), (Edge, 3)]));
    });
}

#[test]
fn a_footpoint_is_the_nearest_point_of_its_element() {
    // The hypotenuse of the triangle 3-4-5: from the centre of the incircle.
    let triangle = domain(&[&[(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)]]);
    with(&triangle, |voronoi| {
        let located = voronoi.locate(p(1.0, 1.0)).unwrap();
        let feet: Vec<Point> = located.contacts.iter().map(|c| c.footpoint).collect();
        assert_eq!(feet, [p(1.0, 0.0), p(1.6, 1.8), p(0.0, 1.0)]);
        assert_eq!(located.distance, 1.0);
    });
}

#[test]
fn coordinates_that_no_polygon_may_have_are_refused() {
    let square = domain(&[SQUARE]);
    with(&square, |voronoi| {
        for bad in [f64::NAN, f64::INFINITY, 1e300, 1e-300] {
            let error = voronoi.locate(p(0.0, bad)).unwrap_err();
            assert!(matches!(error, VoronoiError::Coordinates { .. }));
        }
        assert_eq!(told(voronoi, 0.0, -2.0_f64.powi(200)).0, Region::Exterior);
    });
}

#[test]
fn an_axis_of_another_domain_is_refused() {
    let (square, shape) = (domain(&[SQUARE]), domain(&[L]));
    let axes = [path_tracing(&square).unwrap()];
    assert!(matches!(Voronoi::new(&shape, &axes), Err(VoronoiError::UnknownSite { .. })));
    let twice = [axes[0].clone(), axes[0].clone()];
    let error = Voronoi::new(&square, &twice).unwrap_err();
    assert_eq!(error.to_string(), "there are two axes of the interior");
    let mut pruned = axes;
    pruned[0].complete = false;
    assert!(matches!(Voronoi::new(&square, &pruned), Err(VoronoiError::Incomplete { .. })));
}

#[test]
fn an_axis_without_a_path_leaves_a_cell_open() {
    let square = domain(&[SQUARE]);
    let axis = path_tracing(&square).unwrap();
    let (sites, mut paths) =
        (axis.sites().iter().collect(), axis.paths().iter().collect::<Vec<_>>());
    paths.pop();
    let keypoints = axis.keypoints().iter().zip(0..);
    let keypoints =
        keypoints.map(|(k, number)| (k.position, k.radius, k.kind, axis.governors(number)));
    let axes = [MedialAxis::from_parts(
        axis.engine,
        axis.side,
        axis.accuracy,
        true,
        sites,
        keypoints,
        paths,
    )
    .unwrap()];
    let error = Voronoi::new(&square, &axes).unwrap_err();
    assert!(error.to_string().starts_with("the paths around edge "), "{error}");
}

#[test]
fn outside_a_square_there_are_strips_and_wedges() {
    let square = domain(&[SQUARE]);
    let axes = [outside(&square, 2.0)];
    let voronoi = Voronoi::new(&square, &axes).unwrap();
    // The frame is usual: the box of side 2 grown by 2. An axis without paths, two normals a corner.
    assert_eq!((voronoi.cells().len(), voronoi.points().len()), (8, 4 + 8 + 4));
    let count = |kind| voronoi.edges().iter().filter(|edge| edge.kind == kind).count();
    assert_eq!([EdgeKind::Path, EdgeKind::Normal, EdgeKind::Frame].map(count), [0, 8, 4 + 8]);
    let ring = |kind: SiteKind, index: u32| {
        let site = voronoi.sites().iter().position(|s| (s.kind, s.index) == (kind, index));
        let cell = voronoi.cells().find(|cell| Some(cell.site as usize) == site).unwrap();
        voronoi.ring(&cell, 0.1)
    };
    // Below the floor, and beyond the corner at its right end.
    assert_eq!(ring(SiteKind::Edge, 0), [p(1.0, -1.0), p(-1.0, -1.0), p(-1.0, -3.0), p(1.0, -3.0)]);
    assert_eq!(ring(SiteKind::Vertex, 1), [p(1.0, -1.0), p(1.0, -3.0), p(3.0, -3.0), p(3.0, -1.0)]);
}

#[test]
fn the_notch_of_an_l_is_closed_at_a_corner_of_the_frame() {
    // The path from the notch meets the frame in its corner (4, 4).
    let shape = domain(&[L]);
    let axes = [path_tracing(&shape).unwrap(), outside(&shape, 1.0)];
    let frame = exterior_frame(&shape, Some(1.0)).unwrap();
    let voronoi = Voronoi::within(&shape, &axes, &frame).unwrap();
    // Seven cells inside; outside six edges and five corners.
    assert_eq!(voronoi.cells().len(), 7 + 11);
    // The same edges on both sides.
    assert_eq!(voronoi.sites().len(), 12);
    let cells = voronoi.cells().filter(|cell| cell.side == Side::Exterior);
    let rings: Vec<Vec<Point>> = cells.map(|cell| voronoi.ring(&cell, 0.01)).collect();
    assert_eq!(rings.iter().filter(|ring| ring.contains(&p(4.0, 4.0))).count(), 2);
    assert_eq!(rings.iter().filter(|ring| ring.contains(&p(-1.0, -1.0))).count(), 1);
    assert_eq!(told(&voronoi, 2.0, 2.0).2, [(SiteKind::Edge, 2), (SiteKind::Edge, 3)]);
    assert_eq!(told(&voronoi, 9.0, 9.0).2, [(SiteKind::Vertex, 2), (SiteKind::Vertex, 4)]);
    let elsewhere = Voronoi::new(&shape, &axes).unwrap_err();
    assert_eq!(elsewhere, VoronoiError::Frame);
}
