//! What the pictures after [Lee82] share: their polygons, which the benchmark times too, numbers along the
//! boundary, and the arcs of a chain.

use crate::shape::{Fallible, Shape};
use crate::sheet::Panel;
use crate::style::{AXIS, BEHIND, NORMAL};
use medial::axis::Side;
use medial::domain::{Corner, Domain, Options};
use medial::engine::{ArcEnd, ChainArc};
use medial::geom::Point;
use medial_io::{Format, read};
use std::fs;

/// The polygon of a figure of the paper, or of the kind of it.
pub fn domain(figure: u32) -> Fallible<Domain> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/lee");
    let bytes = fs::read(format!("{folder}/figure_{figure}.wkt"))?;
    let feature = read(Format::Wkt, &bytes)?.next().ok_or("no feature in the fixture")??;
    Ok(Domain::from_polygons(&feature.polygons, &Options::default())?)
}

/// The same with its axis.
pub fn shape(figure: u32) -> Fallible<Shape> {
    Shape::of(domain(figure)?)
}

/// Writes the numbers of the elements of some edges beside them, outside, from a first one on: edges, and
/// the reflex corners between them.
pub fn numbers(panel: &mut Panel, domain: &Domain, edges: &[u32], first: u32, color: &str) {
    let mut number = first;
    let mut write = |at: Point, out: Point, far: f64| {
        panel.small(at, (far * out.x, far * out.y), color, &number.to_string());
        number += 1;
    };
    let normal = |edge: u32| domain.edge(edge).direction.perp();
    for (k, &edge) in edges.iter().enumerate() {
        let record = domain.edge(edge);
        let (a, b) = (record.start, domain.end(edge));
        if k > 0 && record.corner == Corner::Reflex {
            let way = -(normal(edge) + normal(record.prev));
            // Farther out where the two edges are near each other.
            write(a, way * (1.0 / way.norm()), (26.0 / way.norm()).min(28.0));
        }
        write((a + b) * 0.5, -normal(edge), 13.0);
    }
}

/// An arc of a chain, in a clipped panel.
pub fn arc(panel: &mut Panel, domain: &Domain, arc: &ChainArc, style: &str) {
    match (arc.curve(domain), arc.from, arc.to) {
        (Some(curve), ..) => panel.curve(&curve, style),
        (None, end, ArcEnd::Infinity(way)) | (None, ArcEnd::Infinity(way), end) => {
            if let Some((from, _)) = end.disk() {
                panel.onwards(from, way, style);
            }
        }
        _ => {}
    }
}

/// Whether an arc lies on the left of its chain: it bounds no cell of the other side.
pub fn is_inside(arc: &ChainArc) -> bool {
    [arc.left, arc.right].iter().all(|element| element.side != Some(Side::Exterior))
}

/// The diagram of a chain, in a clipped panel: what lies on the left of it as an axis with normals.
pub fn diagram(panel: &mut Panel, domain: &Domain, arcs: &[ChainArc]) {
    for one in arcs.iter().filter(|one| !is_inside(one)) {
        arc(panel, domain, one, BEHIND);
    }
    for one in arcs.iter().filter(|one| is_inside(one)) {
        arc(panel, domain, one, if one.is_normal { NORMAL } else { AXIS });
    }
}
