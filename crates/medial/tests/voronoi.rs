//! The Voronoi diagram against everything it can be compared with: areas, counts, and the nearest
//! element among all.

mod support;

use std::cmp::Ordering;

use medial::axis::{Curve, Engine, MedialAxis, Side, SiteKind};
use medial::domain::{Corner, Domain, Options, Site};
use medial::engine::{self, exterior, exterior_frame, path_tracing};
use medial::geom::predicates::{Element, compare_distances, counts, reset_counts};
use medial::geom::{Point, Rect, dot_directions, orient2d};
use medial::ops::{EdgeKind, Located, Region, Voronoi};
use support::brute_force::axis_site;
use support::random::{self, Family, Ground, Random};
use support::shapes;

/// The area of a closed outline of lines and parabolas, exactly but for rounding.
fn area(outline: &[Curve]) -> f64 {
    let origin = outline[0].from();
    let twice: f64 = outline
        .iter()
        .map(|curve| {
            let (a, b) = (curve.from() - origin, curve.to() - origin);
            // The bulge over its chord is two thirds of the triangle of its Bézier form.
            let bulge = curve.control().map_or(0.0, |c| (c - origin - a).cross(b - a) * 2.0 / 3.0);
            a.cross(b) + bulge
        })
        .sum();
    0.5 * twice
}

/// The closed edges nearest to a point, each asked, with the place on it: before its end, inside, at its
/// end.
fn nearest(domain: &Domain, p: Point) -> Vec<(u32, Ordering)> {
    let mut least: Vec<(u32, Ordering, Element)> = Vec::new();
    for edge in 0..domain.edges().len() as u32 {
        let (a, b) = (domain.edge(edge).start, domain.end(edge));
        let (place, element) = if dot_directions(a, b, a, p) <= 0.0 {
            (Ordering::Less, Element::Corner(a))
        } else if dot_directions(a, b, b, p) >= 0.0 {
            (Ordering::Greater, Element::Corner(b))
        } else {
            (Ordering::Equal, Element::Edge(a, b))
        };
        let order = least.first().map_or(Ordering::Less, |l| compare_distances(p, element, l.2));
        if order.is_lt() {
            least.clear();
        }
        if order.is_le() {
            least.push((edge, place, element));
        }
    }
    least.into_iter().map(|(edge, place, _)| (edge, place)).collect()
}

/// Whether a point lies inside, by the edges above it; `None` on the boundary.
fn inside(domain: &Domain, p: Point) -> Option<bool> {
    let mut inside = false;
    for edge in 0..domain.edges().len() as u32 {
        let (a, b) = (domain.edge(edge).start, domain.end(edge));
        let side = orient2d(a, b, p);
        let within = |low: f64, x: f64, high: f64| low.min(high) <= x && x <= low.max(high);
        if side == 0.0 && within(a.x, p.x, b.x) && within(a.y, p.y, b.y) {
            return None;
        }
        let below = (side > 0.0) == (a.x > b.x);
        if (a.x <= p.x) != (b.x <= p.x) && below {
            inside = !inside;
        }
    }
    Some(inside)
}

/// Compares an answer with what all edges say.
fn check(domain: &Domain, p: Point, located: &Located) {
    let expected = match inside(domain, p) {
        None => Region::Boundary,
        Some(true) => Region::Interior,
        Some(false) => Region::Exterior,
    };
    assert_eq!(located.region, expected, "{p:?}");
    let nearest = nearest(domain, p);
    let mut places: Vec<[u64; 2]> = Vec::new();
    for contact in &located.contacts {
        let bits = [contact.site.a.x.to_bits(), contact.site.a.y.to_bits()];
        let site = &contact.site;
        let is_nearest = nearest.iter().any(|&(edge, place)| match place {
            // Where boundaries touch, the outside may see a piece of the edge only.
            Ordering::Equal => {
                let known = axis_site(domain, Site::edge(edge));
                (known.kind, known.polygon, known.ring, known.index)
                    == (site.kind, site.polygon, site.ring, site.index)
                    && orient2d(known.a, known.b, site.a) == 0.0
            }
            // At a straight joint it is one of the two edges.
            Ordering::Less => [site.a, site.b].contains(&domain.edge(edge).start),
            Ordering::Greater => [site.a, site.b].contains(&domain.end(edge)),
        });
        assert!(is_nearest, "{p:?}: {:?} of {nearest:?}", contact.site);
        if contact.site.kind == SiteKind::Vertex {
            places.push(bits);
        }
        let off = ((contact.footpoint - p).norm() - located.distance).abs();
        let size = p.x.abs() + p.y.abs() + located.distance;
        assert!(off <= 8.0 * f64::EPSILON * size, "{p:?}: {contact:?}, {}", located.distance);
    }
    let mut distinct: Vec<[u64; 4]> = nearest
        .iter()
        .map(|&(edge, place)| {
            let (a, b) = (domain.edge(edge).start, domain.end(edge));
            let (a, b) = match place {
                Ordering::Less => (a, a),
                Ordering::Equal => (a, b),
                Ordering::Greater => (b, b),
            };
            [a.x, a.y, b.x, b.y].map(|v| (v + 0.0).to_bits())
        })
        .collect();
    distinct.sort_unstable();
    distinct.dedup();
    assert_eq!(located.contacts.len(), distinct.len(), "{p:?}: {nearest:?}");
}

/// The axes inside and outside.
fn both(domain: &Domain) -> Option<[MedialAxis; 2]> {
    let outside = exterior(domain, Engine::PathTracing, None, &engine::Options::default()).ok()?;
    Some([path_tracing(domain).ok()?, outside])
}

/// Checks the diagram of a shape: counts, areas, outlines, and points everywhere.
fn check_all(random: &mut Random, domain: &Domain, axes: &[MedialAxis]) {
    let voronoi = Voronoi::new(domain, axes).unwrap();
    let reflex = domain.edges().iter().filter(|edge| edge.corner == Corner::Reflex).count();
    let holes = domain.walks().iter().filter(|walk| walk.hole).count();
    let n = domain.edges().len() + reflex;
    let cells = |side| voronoi.cells().filter(move |cell| cell.side == side);
    let edges = voronoi.edges().iter().filter(|edge| edge.side == Side::Interior).count();
    assert_eq!(cells(Side::Interior).count(), n);
    if domain.n_components() == 1 && domain.walks().len() == 1 + holes {
        // [Lee82, lemma 3], with holes.
        assert!(edges + 3 <= 2 * n + 3 * holes, "{edges} edges");
    }
    let Rect { min, max } = exterior_frame(domain, None).unwrap();
    let framed = (max.x - min.x) * (max.y - min.y);
    for axis in axes {
        let expected = match axis.side {
            Side::Interior => domain.area(),
            _ => framed - domain.area(),
        };
        let mut whole = 0.0;
        for cell in cells(axis.side) {
            let outline = voronoi.outline(&cell);
            for (k, curve) in outline.iter().enumerate() {
                assert_eq!(curve.to(), outline[(k + 1) % outline.len()].from());
            }
            let area = area(&outline);
            // Rounding may turn a cell over that is hardly wider.
            assert!(area > -1e-12 * framed, "{cell:?}");
            whole += area;
        }
        assert!((whole - expected).abs() <= 1e-9 * framed, "{whole} of {expected}");
    }
    let mut ask = |p: Point| {
        let located = voronoi.locate(p).unwrap();
        check(domain, p, &located);
    };
    let points = voronoi.points().iter().map(|point| point.position);
    let middles = voronoi.edges().iter().map(|edge| voronoi.curve(edge).point_at(0.5));
    let edges = domain.edges().iter().zip(0..);
    let walls = edges.map(|(edge, k)| (edge.start + domain.end(k)) * 0.5);
    points.chain(middles).chain(walls).for_each(&mut ask);
    let box_of = |pick: fn(f64, f64) -> f64, x: fn(Point) -> f64| {
        domain.edges().iter().map(|edge| x(edge.start)).reduce(pick).unwrap()
    };
    let low = Point::new(box_of(f64::min, |p| p.x), box_of(f64::min, |p| p.y));
    let high = Point::new(box_of(f64::max, |p| p.x), box_of(f64::max, |p| p.y));
    for _ in 0..20 {
        let share = Point::new(1.4 * random.unit() - 0.2, 1.4 * random.unit() - 0.2);
        let size = high - low;
        let p = low + Point::new(share.x * size.x, share.y * size.y);
        ask(p);
        // Halves of whole numbers, where grids have their ties.
        ask(Point::new((2.0 * p.x).round() / 2.0, (2.0 * p.y).round() / 2.0));
    }
}

#[test]
fn all_fixtures_have_their_diagram() {
    let mut random = Random(1);
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        check_all(&mut random, &domain, &both(&domain).unwrap());
    }
}

#[test]
fn random_shapes_have_their_diagram() {
    let families = [Family::Tangle, Family::Holes, Family::Triangles, Family::Squares];
    let mut seen = 0;
    for seed in 0..400 {
        let mut random = Random(seed);
        let family = families[random.below(4) as usize];
        let ground = if random.below(2) == 0 { Ground::Square } else { Ground::Grid(6) };
        let polygons = random::large_shape(&mut random, family, ground, 30);
        let options = Options { regroup: true, ..Options::default() };
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        let Some(axes) = both(&domain) else { continue };
        check_all(&mut random, &domain, &axes);
        seen += 1;
    }
    assert!(seen > 150, "{seen}");
}

/// A regular polygon around (0.1, 0.2), its corners rounded to doubles.
fn regular(n: u32) -> Vec<Point> {
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        Point::new(0.1 + angle.cos(), 0.2 + angle.sin())
    };
    (0..n).map(corner).collect()
}

/// The most questions that points near (0.1, 0.2) take.
fn questions(voronoi: &Voronoi) -> u64 {
    let mut most = 0;
    for k in -3..=3 {
        let off = f64::from(k) * 1e-16;
        let p = Point::new(0.1 + off, 0.2 - 2.0 * off);
        reset_counts();
        let located = voronoi.locate(p).unwrap();
        let c = counts();
        let all = [c.structure, c.rounded, c.corners, c.edges, c.transitions, c.fine, c.tower];
        most = most.max(all.iter().sum());
        if voronoi.domain().edges().len() < 500 {
            check(voronoi.domain(), p, &located);
        }
    }
    most
}

#[test]
fn in_the_centre_of_a_regular_polygon_few_questions_find_the_nearest_edge() {
    let wall = [(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)];
    let wall: Vec<Point> = wall.iter().map(|&(x, y)| Point::new(x, y)).collect();
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    for n in [400, 1600, 6400] {
        let domain = shapes::of(&[vec![regular(n)]]).unwrap();
        let axes = [path_tracing(&domain).unwrap()];
        inside.push(questions(&Voronoi::new(&domain, &axes).unwrap()));
        // The same polygon as a hole.
        let domain = shapes::of(&[vec![wall.clone(), regular(n)]]).unwrap();
        let axes = both(&domain).unwrap();
        outside.push(questions(&Voronoi::new(&domain, &axes).unwrap()));
    }
    // Sixteen times as many edges are four more levels.
    for most in [inside, outside] {
        assert!(0 < most[0] && most[2] <= most[0] + 40, "{most:?}");
    }
}

#[test]
fn normals_are_counted_with_the_edges() {
    // An L has 9 paths, and a normal to each side of its corner.
    let domain = shapes::domain("l_with_unit_arms");
    let axes = [path_tracing(&domain).unwrap()];
    let voronoi = Voronoi::new(&domain, &axes).unwrap();
    let normals = voronoi.edges().iter().filter(|edge| edge.kind == EdgeKind::Normal).count();
    assert_eq!((voronoi.edges().len(), normals), (11, 2));
}

#[test]
fn where_polygons_touch_the_one_that_holds_the_point_answers() {
    let side = "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((1 0, 2 0, 2 1, 1 1, 1 0)))";
    let corner = "MULTIPOLYGON (((2 4, 3 6, 1 6, 2 4)), ((0 0, 4 0, 4 4, 0 4, 0 0)))";
    for (wkt, p, polygon) in [(side, (1.2, 0.5), 1), (side, (0.8, 0.5), 0), (corner, (2.0, 3.5), 1)]
    {
        let domain = shapes::wkt(wkt);
        let axes = [path_tracing(&domain).unwrap()];
        for axes in [&axes[..], &[]] {
            let voronoi = Voronoi::new(&domain, axes).unwrap();
            let located = voronoi.locate(Point::new(p.0, p.1)).unwrap();
            assert_eq!(located.region, Region::Interior, "{wkt} {p:?}");
            let polygons: Vec<u32> = located.contacts.iter().map(|c| c.site.polygon).collect();
            assert_eq!(polygons, [polygon], "{wkt} {p:?}");
        }
    }
}
