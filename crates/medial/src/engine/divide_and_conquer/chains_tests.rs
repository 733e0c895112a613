use super::*;
use crate::domain::Options as DomainOptions;

/// One polygon with these rings.
fn domain(rings: &[&[(f64, f64)]]) -> Domain {
    let ring = |ring: &&[(f64, f64)]| ring.iter().map(|&(x, y)| Point::new(x, y)).collect();
    let polygon: Vec<Vec<Point>> = rings.iter().map(ring).collect();
    Domain::from_polygons(&[polygon], &DomainOptions::default()).unwrap()
}

fn square() -> Domain {
    domain(&[&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)]])
}

/// Shapes with chains that wind, that tie, and that are in general position.
fn shapes() -> Vec<Domain> {
    let spiral: [(f64, f64); 16] = [
        (0., 0.),
        (9., 0.),
        (9., 9.),
        (0., 9.),
        (0., 3.),
        (6., 3.),
        (6., 6.),
        (3., 6.),
        (3., 5.),
        (5., 5.),
        (5., 4.),
        (1., 4.),
        (1., 8.),
        (8., 8.),
        (8., 1.),
        (0., 1.),
    ];
    let lobes = [
        (0.5, 6.),
        (0., 0.8),
        (2.2, 0.),
        (3.2, 2.2),
        (4.6, 3.2),
        (6.4, 3.3),
        (7.9, 2.3),
        (8.6, 0.2),
        (10.6, 0.4),
        (11.2, 3.),
        (10.2, 5.2),
        (8.4, 6.2),
        (7.2, 5.2),
        (5.2, 6.4),
        (3.2, 5.),
    ];
    // A number that looks random, between 1 and 4, as the distance of each corner.
    let star: Vec<(f64, f64)> = (0..17u32)
        .map(|k| {
            let (angle, far) = (f64::from(k) * 0.3695, 1.0 + f64::from(k * k * 7 % 31) / 10.0);
            (far * angle.cos(), far * angle.sin())
        })
        .collect();
    // Two holes that touch; the boundary goes straight on above the place.
    let straight: [&[(f64, f64)]; 3] = [
        &[(0., 0.), (8., 0.), (8., 8.), (0., 8.)],
        &[(4., 4.), (2., 4.), (3., 3.)],
        &[(4., 4.), (5., 3.), (6., 4.)],
    ];
    let straight = domain(&straight);
    assert!(straight.edges().iter().any(|edge| edge.corner == Corner::Straight));
    vec![square(), domain(&[&spiral]), domain(&[&lobes]), domain(&[&star]), straight]
}

/// All open chains of a domain.
fn chains(domain: &Domain) -> impl Iterator<Item = Chain<'_>> {
    let n = domain.edges().len() as u32;
    (0..n).flat_map(move |first| (1..n).filter_map(move |len| Chain::new(domain, first, len)))
}

/// The distance of a point from an edge with its ends.
fn distance(domain: &Domain, edge: u32, p: Point) -> f64 {
    (p - axis::Site::edge(domain.edge(edge).start, domain.end(edge)).footpoint(p)).norm()
}

/// Points on an arc with their distances from the chain, as the arc has them.
fn samples(domain: &Domain, arc: &ChainArc) -> Vec<(Point, Option<f64>)> {
    let shares = [0.0, 0.2, 0.5, 0.9, 1.0];
    match (arc.curve(domain), arc.from.disk(), arc.to.disk()) {
        (Some(curve), ..) => {
            assert_eq!(curve.kind(), arc.kind, "{arc:?}");
            shares.iter().map(|&u| (curve.point_at(u), Some(curve.radius_at(u)))).collect()
        }
        (None, Some((place, _)), _) | (None, None, Some((place, _))) => {
            let ((ArcEnd::Infinity(way), _) | (_, ArcEnd::Infinity(way))) = (arc.to, arc.from)
            else {
                panic!("neither end of {arc:?} is at infinity");
            };
            assert!((way.norm() - 1.0).abs() < 1e-15);
            assert_eq!(arc.kind, CurveKind::Line);
            [0.0, 1.0, 50.0].iter().map(|&t| (place + way * t, None)).collect()
        }
        (None, None, None) => panic!("{arc:?} has no end"),
    }
}

/// Asserts that both elements of each arc, and nothing nearer, are as far away as it says.
fn assert_nearest(chain: &Chain<'_>, arcs: &[ChainArc]) {
    let domain = chain.domain();
    for arc in arcs {
        for (p, radius) in samples(domain, arc) {
            let far = |edge: u32| distance(domain, edge, p);
            let least = chain.edges().iter().map(|&edge| far(edge)).fold(f64::INFINITY, f64::min);
            for element in [arc.left, arc.right] {
                let edge = element.site.index();
                let own = if element.site.is_edge() {
                    far(edge)
                } else {
                    (p - domain.edge(edge).start).norm()
                };
                assert!((own - least).abs() < 1e-12 * (1.0 + least), "{arc:?} at {p:?}");
            }
            assert!(radius.is_none_or(|r| (r - least).abs() < 1e-12 * (1.0 + least)), "{arc:?}");
        }
    }
}

/// An end up to the last digits, in which places of one disk may differ by how it was found.
fn rounded(end: ArcEnd) -> [i64; 3] {
    let (p, r) = match end {
        ArcEnd::Corner(p) => (p, 0.0),
        ArcEnd::Disk(p, r) => (p, r),
        ArcEnd::Infinity(way) => (way, -1.0),
    };
    [p.x, p.y, r].map(|x| (x * 1e9).round() as i64)
}

/// What an arc is, without the way in which it is followed.
type Key = [(Named, [i64; 3]); 2];

/// An element by its number, and whether it is of the interior.
type Named = (Site, Option<bool>);

fn named(element: ChainElement) -> Named {
    (element.site, element.side.map(|side| side == Side::Interior))
}

fn key(arc: &ChainArc) -> Key {
    let mut key = [(named(arc.left), rounded(arc.from)), (named(arc.right), rounded(arc.to))];
    // Followed the other way both change.
    key.sort_unstable_by_key(|(element, _)| *element);
    key
}

fn keys<'c>(arcs: impl IntoIterator<Item = &'c ChainArc>) -> Vec<Key> {
    let mut keys: Vec<_> = arcs.into_iter().map(key).collect();
    keys.sort_unstable();
    keys
}

#[test]
fn a_closed_walk_and_no_edge_are_no_chains() {
    let square = square();
    assert!(Chain::new(&square, 0, 3).is_some());
    assert!(Chain::new(&square, 0, 4).is_none());
    assert!(Chain::new(&square, 0, 0).is_none());
    assert!(Chain::new(&square, 4, 1).is_none());
    assert_eq!(Chain::new(&square, 3, 2).unwrap().edges(), [3, 0]);
}

#[test]
fn chains_are_merged_from_the_longest_power_of_two_and_the_rest() {
    let lobes = &shapes()[2];
    let chain = Chain::new(lobes, 0, 14).unwrap();
    let (first, second) = chain.parts().unwrap();
    assert_eq!((first.edges().len(), second.edges().len()), (8, 6));
    let (first, second) = second.parts().unwrap();
    assert_eq!((first.edges(), second.edges()), (&[8, 9, 10, 11][..], &[12, 13][..]));
    assert!(Chain::new(lobes, 0, 1).unwrap().parts().is_none());
}

#[test]
fn a_walk_that_touches_itself_has_no_chain_through_the_place_twice() {
    // A hole that touches the outer ring in a corner.
    let domain =
        domain(&[&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)], &[(0., 0.), (1., 2.), (2., 1.)]]);
    let walk = domain.walks()[0];
    assert_eq!(walk.len, 7);
    // Three edges round the hole, or four round the square, close a ring.
    let longest =
        |first| (1..7).take_while(|&len| Chain::new(&domain, first, len).is_some()).count();
    assert!(walk.edges().all(|first| longest(first) <= 5));
    assert!(chains(&domain).count() > 0);
    for chain in chains(&domain) {
        assert_nearest(&chain, &chain_diagram(&chain).unwrap());
    }
}

#[test]
fn an_edge_alone_has_its_four_normals() {
    let square = square();
    let arcs = chain_diagram(&Chain::new(&square, 0, 1).unwrap()).unwrap();
    let outwards = |arc: &ChainArc| match (arc.from, arc.to) {
        (ArcEnd::Corner(p), ArcEnd::Infinity(d)) | (ArcEnd::Infinity(d), ArcEnd::Corner(p)) => {
            (p.x, p.y, d.x, d.y)
        }
        ends => panic!("{ends:?}"),
    };
    let mut found: Vec<_> = arcs.iter().map(outwards).collect();
    found.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(found, [(0., 0., 0., -1.), (0., 0., 0., 1.), (2., 0., 0., -1.), (2., 0., 0., 1.)]);
    assert!(arcs.iter().all(|arc| arc.is_normal && arc.kind == CurveKind::Line));
}

#[test]
fn three_edges_of_a_square_meet_in_its_centre() {
    let square = square();
    let arcs = chain_diagram(&Chain::new(&square, 0, 3).unwrap()).unwrap();
    let centre = ArcEnd::Disk(Point::new(1.0, 1.0), 1.0);
    let there = arcs.iter().filter(|arc| arc.from == centre || arc.to == centre).count();
    // Two diagonals, and the line between the edges that face one another, which ends in front of both
    // corners at the open side and goes on between them.
    assert_eq!(there, 3);
    let middle = arcs.iter().find(|arc| {
        arc.left.side.is_none() && arc.right.side.is_none() && arc.curve(&square).is_none()
    });
    assert!(middle.is_some_and(|arc| {
        let start = ArcEnd::Disk(Point::new(0.0, 1.0), 1.0);
        let far = ArcEnd::Infinity(Point::new(-1.0, 0.0));
        [(start, far), (far, start)].contains(&(arc.from, arc.to))
    }));
}

#[test]
fn each_arc_is_as_near_to_both_its_elements_as_to_the_chain() {
    for domain in shapes() {
        for chain in chains(&domain) {
            assert_nearest(&chain, &chain_diagram(&chain).unwrap());
        }
    }
}

#[test]
fn a_chain_has_a_cell_for_each_side_and_each_corner() {
    for domain in shapes() {
        for chain in chains(&domain) {
            let arcs = chain_diagram(&chain).unwrap();
            let edges = chain.edges();
            let straight = |edge: &&u32| domain.edge(**edge).corner == Corner::Straight;
            let cells = 3 * edges.len() + 1 - edges[1..].iter().filter(straight).count();
            let mut met: Vec<_> =
                arcs.iter().flat_map(|arc| [arc.left, arc.right].map(named)).collect();
            met.sort_unstable();
            met.dedup();
            assert_eq!(met.len(), cells, "{edges:?}");
            // Euler: the chain is one node and infinity another one, and each cell is a face.
            let ends = arcs.iter().flat_map(|arc| [arc.from, arc.to]);
            let mut places: Vec<_> = ends
                .filter_map(|end| match end {
                    ArcEnd::Disk(p, _) => Some((p.x.to_bits(), p.y.to_bits())),
                    _ => None,
                })
                .collect();
            places.sort_unstable();
            places.dedup();
            assert_eq!(arcs.len() - places.len(), cells, "{edges:?}");
        }
    }
}

#[test]
fn corners_have_their_cells_on_the_side_where_the_boundary_is_reflex() {
    let l = domain(&[&[(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)]]);
    let arcs = chain_diagram(&Chain::new(&l, 1, 4).unwrap()).unwrap();
    let side = |corner: u32| {
        let elements = arcs.iter().flat_map(|arc| [arc.left, arc.right]);
        let own: Vec<_> =
            elements.filter(|e| e.site == Site::corner(corner)).map(|e| e.side).collect();
        assert!(own.windows(2).all(|pair| pair[0] == pair[1]));
        own[0]
    };
    assert_eq!((side(1), side(5)), (None, None));
    assert_eq!((side(2), side(4)), (Some(Side::Exterior), Some(Side::Exterior)));
    assert_eq!(side(3), Some(Side::Interior));
}

#[test]
fn the_curve_and_what_is_kept_are_the_diagram_of_both_chains() {
    for domain in shapes() {
        for chain in chains(&domain) {
            let whole = keys(&chain_diagram(&chain).unwrap());
            for at in 1..chain.edges().len() {
                let merge = chain_merge(&chain, at).unwrap();
                let parts = merge.kept.iter().flatten().chain(&merge.curve);
                assert_eq!(keys(parts), whole, "{:?} at {at}", chain.edges());
            }
        }
    }
}

#[test]
fn what_a_diagram_keeps_and_loses_are_the_parts_of_its_arcs() {
    for domain in shapes() {
        for chain in chains(&domain) {
            for at in 1..chain.edges().len() {
                let merge = chain_merge(&chain, at).unwrap();
                for k in 0..2 {
                    let mut parts: Vec<&ChainArc> =
                        merge.kept[k].iter().chain(&merge.discarded[k]).collect();
                    for old in &merge.before[k] {
                        let mut reached = old.from;
                        loop {
                            let next = parts.iter().position(|part| {
                                (part.left.site, part.right.site) == (old.left.site, old.right.site)
                                    && rounded(part.from) == rounded(reached)
                            });
                            reached = parts.remove(next.expect("a part that goes on")).to;
                            if rounded(reached) == rounded(old.to) {
                                break;
                            }
                        }
                    }
                    assert!(parts.is_empty(), "{parts:?}");
                }
            }
        }
    }
}

#[test]
fn what_is_kept_is_nearer_to_its_own_chain_and_what_is_discarded_to_the_other() {
    for domain in shapes() {
        for chain in chains(&domain) {
            for at in 1..chain.edges().len() {
                let merge = chain_merge(&chain, at).unwrap();
                let (first, second) = chain.edges().split_at(at);
                for (k, (own, other)) in [(first, second), (second, first)].into_iter().enumerate()
                {
                    let far = |edges: &[u32], p: Point| {
                        edges.iter().map(|&e| distance(&domain, e, p)).fold(f64::INFINITY, f64::min)
                    };
                    let [kept, lost] = [&merge.kept[k], &merge.discarded[k]].map(|arcs| {
                        let points = arcs.iter().flat_map(|arc| samples(&domain, arc));
                        points.map(|(p, _)| far(own, p) - far(other, p)).collect::<Vec<_>>()
                    });
                    assert!(kept.iter().all(|&d| d < 1e-12), "{kept:?}");
                    assert!(lost.iter().all(|&d| d > -1e-12), "{lost:?}");
                }
            }
        }
    }
}

#[test]
fn the_curve_goes_from_piece_to_piece_and_has_one_chain_on_each_hand() {
    for domain in shapes() {
        for chain in chains(&domain) {
            for at in 1..chain.edges().len() {
                let merge = chain_merge(&chain, at).unwrap();
                let joint = domain.edge(chain.edges()[at]).start;
                let starts: Vec<usize> = (0..merge.curve.len())
                    .filter(|&k| merge.curve[k].from == ArcEnd::Corner(joint))
                    .collect();
                assert!(starts == [0] || starts.len() == 2 && starts[0] == 0, "{starts:?}");
                for k in 1..merge.curve.len() {
                    let [before, piece] = [merge.curve[k - 1], merge.curve[k]];
                    if starts.contains(&k) {
                        assert!(before.curve(&domain).is_none());
                    } else {
                        assert_eq!(before.to, piece.from);
                    }
                }
                let end = merge.curve[merge.curve.len() - 1];
                if starts.len() == 1 {
                    assert_eq!(end.to, ArcEnd::Corner(joint));
                } else {
                    assert!(matches!(end.to, ArcEnd::Infinity(_)));
                }
                // Edges of the first chain lie left of the first walk.
                let (first, second) = chain.edges().split_at(at);
                let walk = &merge.curve[..*starts.get(1).unwrap_or(&merge.curve.len())];
                for piece in walk {
                    let [left, right] = [piece.left.site, piece.right.site];
                    assert!(!left.is_edge() || first.contains(&left.index()), "{piece:?}");
                    assert!(!right.is_edge() || second.contains(&right.index()), "{piece:?}");
                }
            }
        }
    }
}
