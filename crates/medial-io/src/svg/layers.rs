use super::Scene;
use super::canvas::{Anchor, Canvas, Data, number};
use super::palette::{STEPS, color, pale};
use medial::axis::{Curve, KeypointKind, MedialAxis, Path, Site, SiteKind};
use medial::geom::Point;

/// Most governors that are numbered; more numbers would cover the picture.
const NUMBERED: usize = 80;

pub(super) const INK: &str = "#263238";
const GROUND: &str = "#eef2f5";
const EDGE_ZONE: &str = "#dbe9f6";
const VERTEX_ZONE: &str = "#fde3cf";
const EDGE_GOVERNOR: &str = "#1976d2";
const VERTEX_GOVERNOR: &str = "#d84315";

pub(super) fn domain<'s>(canvas: &mut Canvas, shapes: impl Iterator<Item = &'s Vec<Vec<Point>>>) {
    canvas.open("domain", &format!("fill=\"{GROUND}\" fill-rule=\"evenodd\""));
    for shape in shapes {
        let data = rings(canvas, shape);
        canvas.path(&data, "");
    }
    canvas.close();
}

pub(super) fn boundary<'s>(canvas: &mut Canvas, shapes: impl Iterator<Item = &'s Vec<Vec<Point>>>) {
    let width = number(0.6 * canvas.frame.stroke);
    let style = format!(
        "fill=\"none\" stroke=\"{INK}\" stroke-width=\"{width}\" stroke-linejoin=\"round\""
    );
    canvas.open("boundary", &style);
    for shape in shapes {
        let data = rings(canvas, shape);
        canvas.path(&data, "");
    }
    canvas.close();
}

fn rings(canvas: &Canvas, boundary: &[Vec<Point>]) -> String {
    let mut data = Data::new(&canvas.frame);
    for ring in boundary {
        data.ring(ring.iter().copied());
    }
    data.text
}

/// The axis, each curve cut where its radius passes from one colour to the next.
pub(super) fn axis(canvas: &mut Canvas, scenes: &[Scene], radius_max: f64) {
    let frame = canvas.frame;
    let mut steps: Vec<Data> = (0..STEPS).map(|_| Data::new(&frame)).collect();
    for axis in scenes.iter().map(|s| &s.axis) {
        for path in axis.paths() {
            for (step, piece) in colored(&axis.curve(&path), radius_max) {
                let data = &mut steps[step];
                data.move_to(piece.from());
                data.curve_to(&piece);
            }
        }
    }
    let style =
        format!("fill=\"none\" stroke-width=\"{}\" stroke-linecap=\"round\"", number(frame.stroke));
    let data: Vec<String> = steps.into_iter().map(|d| d.text).collect();
    canvas.open("axis", &style);
    for (step, data) in data.iter().enumerate() {
        canvas.path(data, &format!("stroke=\"{}\"", color(step)));
    }
    canvas.close();
}

/// The pieces of a curve between changes of colour, each with its step.
fn colored(curve: &Curve, radius_max: f64) -> Vec<(usize, Curve)> {
    let step_of = |radius: f64| ((radius / radius_max * STEPS as f64) as usize).min(STEPS - 1);
    let (low, high) = (step_of(curve.radius_min()), step_of(curve.radius_max()));
    let mut cuts = vec![0.0, 1.0];
    for step in low + 1..=high {
        let radius = step as f64 / STEPS as f64 * radius_max;
        cuts.extend(curve.parameters_at_radius(radius).into_iter().flatten());
    }
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2)
        .filter(|w| w[0] < w[1])
        .map(|w| (step_of(curve.radius_at(0.5 * (w[0] + w[1]))), curve.piece(w[0], w[1])))
        .collect()
}

/// Keypoints as dots: ends small, transitions hollow, junctions full; all smaller where paths
/// are short.
pub(super) fn keypoints(canvas: &mut Canvas, scenes: &[Scene]) {
    let frame = canvas.frame;
    let room: Vec<Vec<f64>> = scenes.iter().map(|s| room(&s.axis)).collect();
    for &kind in KeypointKind::ALL {
        let mut sizes: Vec<Data> = (0..DOT_SIZES).map(|_| Data::new(&frame)).collect();
        for (scene, room) in scenes.iter().zip(&room) {
            for (keypoint, &room) in scene.axis.keypoints().iter().zip(room) {
                // Samples are no events.
                let is_sample = kind == KeypointKind::Transition && scene.is_sampled();
                if keypoint.kind == kind && !is_sample {
                    let steps = (frame.stroke * DOT_ROOM / frame.length(room)).log2().ceil();
                    sizes[(steps.max(0.0) as usize).min(DOT_SIZES - 1)].dot(keypoint.position);
                }
            }
        }
        let sizes: Vec<String> = sizes.into_iter().map(|d| d.text).collect();
        for (step, data) in sizes.iter().enumerate().filter(|(_, data)| !data.is_empty()) {
            dots(canvas, kind, data, frame.stroke * 0.5_f64.powi(step as i32));
        }
    }
}

/// Sizes of dots, each half of the one before.
const DOT_SIZES: usize = 5;
/// Length of path that a dot of full size needs, in strokes.
const DOT_ROOM: f64 = 2.0;

/// For each keypoint the distance to the nearest one along a path; at an end no more than where
/// its path comes from, since ends of cramped junctions are neighbours.
fn room(axis: &MedialAxis) -> Vec<f64> {
    let keypoints = axis.keypoints();
    let mut room = vec![f64::INFINITY; keypoints.len()];
    for path in axis.paths() {
        let [start, end] = [path.from, path.to].map(|k| keypoints.at(k).position);
        let length = (end - start).norm();
        let (from, to) = (path.from as usize, path.to as usize);
        room[from] = room[from].min(length);
        room[to] = room[to].min(length);
    }
    for path in axis.paths() {
        for (end, other) in [(path.from, path.to), (path.to, path.from)] {
            if keypoints.at(end).kind == KeypointKind::End {
                let (end, other) = (end as usize, other as usize);
                room[end] = room[end].min(room[other]);
            }
        }
    }
    room
}

/// The mark of a kind of keypoint at each dot of these data.
pub(super) fn dots(canvas: &mut Canvas, kind: KeypointKind, data: &str, unit: f64) {
    let circles: &[(&str, f64)] = match kind {
        KeypointKind::End => &[("#78909c", 2.0)],
        KeypointKind::Transition => &[(INK, 2.6), ("#ffffff", 1.5)],
        KeypointKind::Tip => &[("#78909c", 3.4)],
        KeypointKind::Clipped => &[("#78909c", 2.6), ("#ffffff", 1.5)],
        _ => &[(INK, 3.4)],
    };
    canvas.open(kind.name(), "fill=\"none\" stroke-linecap=\"round\"");
    for (color, size) in circles {
        let width = number(size * unit);
        canvas.path(data, &format!("stroke=\"{color}\" stroke-width=\"{width}\""));
    }
    canvas.close();
}

pub(super) fn disks(canvas: &mut Canvas, scenes: &[Scene]) {
    let width = number(0.4 * canvas.frame.stroke);
    let style = format!(
        "fill=\"#26a69a\" fill-opacity=\"0.06\" stroke=\"#00897b\" stroke-opacity=\"0.6\" \
         stroke-width=\"{width}\""
    );
    canvas.open("disks", &style);
    let frame = canvas.frame;
    for keypoint in scenes.iter().flat_map(|s| s.axis.keypoints()) {
        if keypoint.radius > 0.0 {
            canvas.circle(frame.map(keypoint.position), frame.length(keypoint.radius));
        }
    }
    canvas.close();
}

pub(super) fn footpoints(canvas: &mut Canvas, scenes: &[Scene]) {
    let frame = canvas.frame;
    let (mut lines, mut feet) = (Data::new(&frame), Data::new(&frame));
    for axis in scenes.iter().map(|s| &s.axis) {
        for (k, keypoint) in (0..).zip(axis.keypoints()) {
            if keypoint.radius > 0.0 {
                for foot in axis.footpoints(k) {
                    lines.move_to(keypoint.position);
                    lines.line_to(foot);
                    feet.dot(foot);
                }
            }
        }
    }
    let unit = frame.stroke;
    canvas.open("footpoints", "fill=\"none\" stroke=\"#00897b\" stroke-linecap=\"round\"");
    canvas.path(&lines.text, &format!("stroke-width=\"{}\"", number(0.4 * unit)));
    canvas.path(&feet.text, &format!("stroke-width=\"{}\"", number(1.6 * unit)));
    canvas.close();
}

/// The zone of each governor along each path.
pub(super) fn zones(canvas: &mut Canvas, scenes: &[Scene]) {
    let width = number(0.4 * canvas.frame.stroke);
    let style = format!("stroke=\"#ffffff\" stroke-width=\"{width}\" stroke-linejoin=\"round\"");
    canvas.open("zones", &style);
    for (kind, fill) in [(SiteKind::Edge, EDGE_ZONE), (SiteKind::Vertex, VERTEX_ZONE)] {
        let frame = canvas.frame;
        let mut data = Data::new(&frame);
        for axis in scenes.iter().map(|s| &s.axis) {
            for path in axis.paths() {
                for site in axis.path_governors(&path) {
                    if site.kind == kind {
                        zone(&mut data, axis, &path, &site);
                    }
                }
            }
        }
        let data = data.text;
        canvas.path(&data, &format!("fill=\"{fill}\""));
    }
    canvas.close();
}

/// The cell of each governor: all its zones in one colour.
pub(super) fn cells(canvas: &mut Canvas, scenes: &[Scene]) {
    canvas.open("cells", "stroke=\"none\"");
    let mut number = 0;
    for axis in scenes.iter().map(|s| &s.axis) {
        let frame = canvas.frame;
        let mut cells: Vec<Data> = axis.sites().iter().map(|_| Data::new(&frame)).collect();
        for path in axis.paths() {
            for governor in [path.left, path.right] {
                let site = axis.sites().at(governor);
                zone(&mut cells[governor as usize], axis, &path, &site);
            }
        }
        let cells: Vec<String> = cells.into_iter().map(|d| d.text).collect();
        for data in cells {
            canvas.path(&data, &format!("fill=\"{}\"", pale(number)));
            number += 1;
        }
    }
    canvas.close();
}

/// The part of the plane between a path and its footpoints on one governor.
fn zone(data: &mut Data, axis: &MedialAxis, path: &Path, site: &Site) {
    let curve = axis.curve(path);
    data.move_to(curve.from());
    data.curve_to(&curve);
    data.line_to(site.footpoint(curve.to()));
    if site.kind == SiteKind::Edge {
        data.line_to(site.footpoint(curve.from()));
    }
    data.text.push('Z');
}

/// The governors: edges and reflex corners in two colours, with their numbers while they are few.
pub(super) fn governors(canvas: &mut Canvas, scenes: &[Scene]) {
    let frame = canvas.frame;
    let unit = frame.stroke;
    let (mut edges, mut corners) = (Data::new(&frame), Data::new(&frame));
    for site in scenes.iter().flat_map(|s| s.axis.sites()) {
        match site.kind {
            SiteKind::Edge => {
                edges.move_to(site.a);
                edges.line_to(site.b);
            }
            SiteKind::Vertex => corners.dot(site.a),
        }
    }
    let numbered: Vec<&Scene> =
        scenes.iter().filter(|s| s.axis.sites().len() <= NUMBERED).collect();
    // A numbered corner is a disk with room for its number.
    let corner = if numbered.is_empty() { 4.0 * unit } else { 20.0 };
    canvas.open("governors", "fill=\"none\" stroke-linecap=\"round\"");
    let width = number(1.2 * unit);
    canvas.path(&edges.text, &format!("stroke=\"{EDGE_GOVERNOR}\" stroke-width=\"{width}\""));
    let width = number(corner);
    canvas.path(&corners.text, &format!("stroke=\"{VERTEX_GOVERNOR}\" stroke-width=\"{width}\""));
    canvas.close();
    for scene in numbered {
        for (k, site) in scene.axis.sites().iter().enumerate() {
            let (at, color) = label_place(&frame, &site);
            canvas.text(at, 13.0, Anchor::Middle, color, &k.to_string());
        }
    }
}

/// Where the number of a governor stands, in picture coordinates: outside an edge, in a corner.
fn label_place(frame: &super::frame::Frame, site: &Site) -> (Point, &'static str) {
    let (a, b) = (frame.map(site.a), frame.map(site.b));
    let middle = (a + b) * 0.5 + Point::new(0.0, 4.5);
    match site.kind {
        SiteKind::Edge => {
            let d = b - a;
            // y points down here, so the outside lies to the left of the drawn edge.
            let outward = d.perp() * (13.0 / d.norm().max(1e-9));
            (middle + outward, EDGE_GOVERNOR)
        }
        SiteKind::Vertex => (middle, "#ffffff"),
    }
}
