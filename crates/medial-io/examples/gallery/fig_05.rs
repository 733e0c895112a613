use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, INK, MUTED, PURPLE};
use medial::axis::{KeypointKind, MedialAxis, SiteKind};
use medial::geom::Point;

pub const LESSON: Lesson = Lesson {
    title: "The axis is a graph",
    text: "Keypoints are the nodes and paths the edges of a graph (b), and every path is labelled with the two \
           boundary elements that govern it.\n\
           The graph alone, with the labels, tells the shape of each path: two edges or two corners give \
           a line, an edge and a corner a parabola.",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = Shape::new(&[(0., 0.), (9., 0.), (9., 3.), (3.4, 3.), (3.4, 8.), (0., 8.)])?;
    let axis = &shape.axis;
    let mut sheet = Sheet::new(2, (430.0, 440.0));
    let mut panel = sheet.panel(shape.window(0.7), "(a) a domain and its axis");
    panel.domain(&shape.domain);
    panel.axis(axis);
    panel.keypoints(axis);
    for site in axis.sites() {
        let middle = (site.a + site.b) * 0.5;
        let out = (site.a - site.b).perp();
        let out = if out.norm2() > 0.0 { out * (1.0 / out.norm()) } else { Point::new(0.7, 0.7) };
        panel.label(middle, (out.x * 18.0, out.y * 18.0), INK, &name(axis, &site));
    }
    for (k, keypoint) in axis.keypoints().iter().enumerate() {
        let at = keypoint.position;
        // Beside the keypoints of the arms, above those of the bend.
        let aside = if at.x > 6.0 || at.y > 2.5 { (13.0, 0.0) } else { (11.0, 12.0) };
        if keypoint.kind != KeypointKind::End {
            panel.label(at, aside, PURPLE, &k.to_string());
        }
    }
    let layout = layout(axis);
    let depth = layout.iter().map(|p| p.x).fold(0.0, f64::max);
    let breadth = layout.iter().map(|p| p.y).fold(0.0, f64::max);
    let window = (Point::new(-0.4, -0.5), Point::new(depth + 0.4, breadth + 0.5));
    let mut panel = sheet.panel(window, "(b) its graph");
    for path in axis.paths() {
        let (a, b) = (layout[path.from as usize], layout[path.to as usize]);
        panel.line(a, b, AXIS);
        let [left, right] = axis.path_governors(&path).map(|s| name(axis, &s));
        panel.small(a * 0.42 + b * 0.58, (0.0, 9.0), MUTED, &format!("{left} {right}"));
    }
    for (k, (keypoint, &at)) in axis.keypoints().iter().zip(&layout).enumerate() {
        panel.dot(at, keypoint.kind);
        if keypoint.kind != KeypointKind::End {
            panel.label(at, (0.0, 18.0), PURPLE, &k.to_string());
        }
    }
    sheet.legend(&[
        (Sample::Line(AXIS), "path"),
        (Sample::Dot(KeypointKind::End), "end"),
        (Sample::Dot(KeypointKind::Transition), "transition"),
        (Sample::Dot(KeypointKind::Junction), "junction"),
    ]);
    Ok(sheet.finish(LESSON.title))
}

/// The name of a site: edges and corners counted along the boundary.
fn name(axis: &MedialAxis, site: &medial::axis::Site) -> String {
    let number =
        axis.sites().iter().filter(|s| s.kind == site.kind && s.index <= site.index).count();
    match site.kind {
        SiteKind::Edge => format!("e_{number}"),
        SiteKind::Vertex => format!("v_{number}"),
    }
}

/// Places for the keypoints of an axis that is a tree: leaves one below the other, every other
/// keypoint beside the middle of what hangs on it.
fn layout(axis: &MedialAxis) -> Vec<Point> {
    let n = axis.keypoints().len();
    let mut neighbours = vec![Vec::new(); n];
    for path in axis.paths() {
        neighbours[path.from as usize].push(path.to as usize);
        neighbours[path.to as usize].push(path.from as usize);
    }
    let mut places = vec![Point::default(); n];
    let mut leaves = 0.0;
    place(&neighbours, 0, None, 0.0, &mut leaves, &mut places);
    places
}

fn place(
    neighbours: &[Vec<usize>],
    node: usize,
    parent: Option<usize>,
    depth: f64,
    leaves: &mut f64,
    places: &mut [Point],
) {
    let children: Vec<usize> =
        neighbours[node].iter().copied().filter(|&k| Some(k) != parent).collect();
    for &child in &children {
        place(neighbours, child, Some(node), depth + 1.0, leaves, places);
    }
    let y = match (children.first(), children.last()) {
        (Some(&a), Some(&b)) => 0.5 * (places[a].y + places[b].y),
        _ => {
            *leaves += 1.0;
            *leaves - 1.0
        }
    };
    places[node] = Point::new(depth, y);
}
