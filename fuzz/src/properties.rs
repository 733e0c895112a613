//! What must hold for every input.

use medial::axis::MedialAxis;
use medial::check;
use medial::domain::{Corner, Domain, DomainError, FillRule, Options};
use medial::engine::path_tracing;
use medial::geom::{Point, orient2d};

use super::{Polygons, Ring, Shape, to_wkt};

/// What is wrong with the domain, in strict, default and regrouping mode; says whether the
/// default mode accepts the polygons.
///
/// # Errors
/// What is wrong, with the polygons as WKT.
pub fn check_domain(polygons: &Polygons) -> Result<bool, String> {
    let fault = |text: String| Err(format!("{text}\n{}", to_wkt(polygons)));
    let build = |strict, regroup| {
        Domain::from_polygons(polygons, &Options { strict, regroup, ..Options::default() })
    };
    let [default, strict, regrouped, both] =
        [build(false, false), build(true, false), build(false, true), build(true, true)];
    for (name, result) in
        [("default", &default), ("strict", &strict), ("regroup", &regrouped), ("both", &both)]
    {
        let told = match result {
            Ok(domain) => domain_faults(domain, polygons),
            Err(error) => error_faults(error, polygons),
        };
        if let Some(text) = told {
            return fault(format!("{name}: {text}"));
        }
    }
    // What is strictly valid stays as it is, and what nests as given is regrouped to itself. (Where
    // rings cross themselves at a corner and share edges, the two modes may read them differently.)
    let pairs = [
        ("strict and default", &strict, &default),
        ("strict and regroup", &strict, &regrouped),
        ("both and regroup", &both, &regrouped),
    ];
    for (name, narrow, wide) in pairs {
        match (narrow, wide) {
            (Ok(one), Ok(other)) if cycles(one) == cycles(other) => {}
            (Ok(_), Ok(_)) => return fault(format!("{name}: different walks")),
            (Ok(_), Err(error)) => return fault(format!("{name}: {error}")),
            (Err(_), _) => {}
        }
    }
    Ok(default.is_ok())
}

/// What is wrong with the domains that repair makes of polygons, by either fill rule and dissolved; says
/// whether it makes one by the even-odd rule.
///
/// # Errors
/// What is wrong, with the polygons as WKT.
pub fn check_repair(polygons: &Polygons) -> Result<bool, String> {
    let mut is_any = false;
    for (fill, dissolve) in
        [(FillRule::EvenOdd, false), (FillRule::EvenOdd, true), (FillRule::NonZero, false)]
    {
        let options = Options { repair: true, fill, dissolve, ..Options::default() };
        let told = match Domain::from_polygons(polygons, &options) {
            Ok(domain) => {
                is_any |= !dissolve && fill == FillRule::EvenOdd;
                repair_faults(&domain)
            }
            Err(error) => match error.code() {
                "crossing" | "overlap" | "bad_nesting" | "internal" => Some(error.to_string()),
                "polygons_overlap" if dissolve => Some(error.to_string()),
                _ => None,
            },
        };
        if let Some(text) = told {
            return Err(format!("{fill:?}, dissolve {dissolve}: {text}\n{}", to_wkt(polygons)));
        }
    }
    Ok(is_any)
}

fn repair_faults(domain: &Domain) -> Option<String> {
    let again = match Domain::from_polygons(&domain.polygons(), &Options::default()) {
        Ok(again) => again,
        Err(error) => return Some(format!("once more: {error}")),
    };
    let corners = |domain: &Domain| {
        let turns = domain.edges().iter().filter(|edge| edge.corner != Corner::Straight);
        let mut corners: Vec<Point> = turns.map(|edge| edge.start).collect();
        corners.sort_by(|a, b| a.lexicographic(*b));
        corners
    };
    if corners(domain) != corners(&again) {
        return Some("repair is not idempotent".to_owned());
    }
    // What identities add up has its limits; the engine's own target goes beyond these numbers.
    let is_moderate = |v: f64| v == 0.0 || (1e-12..1e12).contains(&v.abs());
    if !domain.edges().iter().all(|e| is_moderate(e.start.x) && is_moderate(e.start.y)) {
        return None;
    }
    let axis = match path_tracing(domain) {
        Ok(axis) => axis,
        Err(error) => return Some(error.to_string()),
    };
    check::defects(domain, &axis).defects.first().map(ToString::to_string)
}

/// What is wrong with the axis of a shape and with that of its mirror image.
///
/// # Errors
/// What the engine or the judge says, with the polygons as WKT.
pub fn check_axis(shape: &Shape) -> Result<(), String> {
    axis_faults(shape).map_err(|text| format!("{text}\n{}", to_wkt(&shape.polygons)))
}

fn axis_faults(shape: &Shape) -> Result<(), String> {
    let axis = judged(&shape.domain)?;
    let mirror = |ring: &Ring| ring.iter().map(|p| Point::new(p.y, p.x)).collect();
    let mirrored: Polygons =
        shape.polygons.iter().map(|rings| rings.iter().map(mirror).collect()).collect();
    let image = Domain::from_polygons(&mirrored, &shape.options)
        .map_err(|e| format!("mirror image: {e}"))?;
    let other = judged(&image).map_err(|e| format!("mirror image: {e}"))?;
    let (one, two) = (graph(&axis), graph(&other));
    if one == two { Ok(()) } else { Err(format!("mirror image: {two:?} instead of {one:?}")) }
}

fn judged(domain: &Domain) -> Result<MedialAxis, String> {
    let axis = path_tracing(domain).map_err(|e| e.to_string())?;
    let defects = check::defects(domain, &axis).defects;
    let told: Vec<String> = defects.iter().take(5).map(ToString::to_string).collect();
    if told.is_empty() { Ok(axis) } else { Err(told.join("\n")) }
}

/// Numbers that any labelling of a graph has in common: governors of all keypoints by degree.
fn graph(axis: &MedialAxis) -> (usize, usize, Vec<usize>) {
    let count = axis.keypoints().len() as u32;
    let mut degrees: Vec<usize> = (0..count).map(|k| axis.governors(k).len()).collect();
    degrees.sort_unstable();
    (axis.sites().len(), axis.paths().len(), degrees)
}

fn domain_faults(domain: &Domain, polygons: &Polygons) -> Option<String> {
    let edges = domain.edges();
    let mut counted = 0;
    for (number, walk) in (0u32..).zip(domain.walks()) {
        if walk.first != counted || walk.len < 2 {
            return Some(format!("walk {number} starts at {} with {}", walk.first, walk.len));
        }
        counted += walk.len;
        let corners = &edges[walk.first as usize..counted as usize];
        let (far_x, far_y) = corners.iter().fold((0.0, 0.0), |(x, y): (f64, f64), e| {
            (x.max(e.start.x.abs()), y.max(e.start.y.abs()))
        });
        // What summing in twice the precision of a double may lose.
        let doubt = f64::from(walk.len) * far_x * far_y * 2f64.powi(-98);
        let area = domain.signed_area(number);
        if area.abs() > doubt && (area < 0.0) != walk.hole {
            return Some(format!("walk {number} has area {}", domain.signed_area(number)));
        }
    }
    if counted as usize != edges.len() {
        return Some(format!("walks have {counted} of {} edges", edges.len()));
    }
    let filled = polygons.iter().filter(|rings| rings.iter().any(|ring| !ring.is_empty())).count();
    if domain.n_components() < filled {
        return Some(format!("{} components", domain.n_components()));
    }
    for (k, edge) in (0u32..).zip(edges) {
        let (before, after) = (domain.edge(edge.prev), domain.end(k));
        if domain.edge(edge.next).prev != k || domain.edge(edge.next).walk != edge.walk {
            return Some(format!("edge {k} is not linked"));
        }
        let turn = orient2d(before.start, edge.start, after);
        let corner = match edge.corner {
            Corner::Convex => turn > 0.0,
            Corner::Reflex => turn < 0.0,
            Corner::Straight => turn == 0.0,
        };
        let length = edge.direction.norm2();
        if !corner || edge.start == after || edge.length <= 0.0 || (length - 1.0).abs() > 1e-15 {
            return Some(format!("edge {k} from {:?} to {after:?}: {edge:?}", edge.start));
        }
        if orient2d(edge.start, after, domain.edge(domain.line(k)).start) != 0.0 {
            return Some(format!("edge {k} is not on the line of {}", domain.line(k)));
        }
        let origin = domain.origin(k);
        let given = |ring: u32, index: u32| {
            let ring = polygons.get(origin.polygon as usize)?.get(ring as usize)?;
            Some((*ring.get(index as usize)?, ring.len()))
        };
        if given(origin.ring, origin.index).is_none() {
            return Some(format!("edge {k}: no such origin {origin:?}"));
        }
        // A corner that is a vertex of its ring lies there.
        let corner = given(origin.corner.ring, origin.corner.index).map(|c| c.0);
        if corner.is_none() || (origin.corner.part == 0 && corner != Some(edge.start)) {
            return Some(format!("edge {k} starts at {:?}: {origin:?}", edge.start));
        }
    }
    again(domain)
}

/// Validates the walks of a domain as polygons.
fn again(domain: &Domain) -> Option<String> {
    let options = Options { regroup: true, ..Options::default() };
    match Domain::from_polygons(&per_polygon(domain), &options) {
        Err(error) => Some(format!("its walks are refused: {error}")),
        Ok(other) if cycles(domain) != cycles(&other) => {
            let (one, two) = (cycles(domain), cycles(&other));
            Some(format!("its walks become others: {one:?} and then {two:?}"))
        }
        Ok(_) => None,
    }
}

/// All walks, polygon by polygon.
fn per_polygon(domain: &Domain) -> Polygons {
    let mut polygons: Polygons = Vec::new();
    for walk in domain.walks() {
        let edges = &domain.edges()[walk.first as usize..(walk.first + walk.len) as usize];
        let polygon = walk.polygon as usize;
        if polygons.len() <= polygon {
            polygons.resize(polygon + 1, Vec::new());
        }
        // Straight joints of touching rings are corners of no ring.
        let corners = edges.iter().filter(|e| e.corner != Corner::Straight);
        polygons[polygon].push(corners.map(|e| e.start).collect());
    }
    polygons
}

/// Walks as cyclic lists of points, in an order that does not depend on where they start.
fn cycles(domain: &Domain) -> Vec<Vec<(f64, f64)>> {
    let mut all: Vec<Vec<(f64, f64)>> = Vec::new();
    for ring in per_polygon(domain).into_iter().flatten() {
        let points: Vec<(f64, f64)> = ring.iter().map(|p| (p.x + 0.0, p.y + 0.0)).collect();
        let turned = (0..points.len()).map(|k| [&points[k..], &points[..k]].concat());
        all.extend(turned.min_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal)));
    }
    all.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    all
}

fn error_faults(error: &DomainError, polygons: &Polygons) -> Option<String> {
    if let DomainError::Internal { .. } = error {
        return Some(error.to_string());
    }
    if error.to_string().is_empty() || polygons.is_empty() {
        return None;
    }
    for place in [error.place(), error.other_place()].into_iter().flatten() {
        let Some(polygon) = polygons.get(place.polygon as usize) else {
            return Some(format!("no such polygon: {error}"));
        };
        let ring = error.ring().map(|_| polygon.get(place.ring as usize).map_or(0, Vec::len));
        let there = match (ring, error.index()) {
            (Some(len), Some(_)) => (place.index as usize) < len,
            (Some(_), None) => (place.ring as usize) < polygon.len(),
            _ => true,
        };
        if !there {
            return Some(format!("no such place: {error}"));
        }
    }
    None
}
