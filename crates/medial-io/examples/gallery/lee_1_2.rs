use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Panel, Sample, Sheet, Window};
use crate::style::{AXIS, BLUE, INK, LIST, NORMAL, ORANGE, PURPLE};
use medial::axis::{Curve, Site, SiteKind};
use medial::geom::Point;
use medial::geom::predicates::{Element, ExactDisk};

pub const LESSON: Lesson = Lesson {
    title: "Bisectors of closed segments",
    text: "Figures 1 and 2 of [Lee82].\n\
           A closed segment is three elements, its two ends and what lies between, so a bisector changes \
           where it crosses the normal in one of the ends.\n\
           Between a point q and a segment it has three components, a piece of a parabola and two \
           half-lines (Fig. 1); between two segments it has five here, the middle one on the bisector of \
           the angle between their lines (Fig. 2).",
    draw,
};

/// The piece of the plane that both figures show.
const VIEW: Window = (Point::new(-0.5, 0.0), Point::new(7.6, 6.1));

/// Two elements that a bisector has between them: below it and above.
type Pair = (Site, Site);

/// Where a component starts or ends: centre and radius.
type Disk = (Point, f64);

fn draw() -> Fallible<String> {
    let mut sheet = Sheet::new(2, (470.0, 374.0));
    let at = Point::new;
    let (a, b, q) = (at(1.4, 1.1), at(5.6, 1.6), at(3.7, 3.7));
    let mut panel = sheet.panel(VIEW, "Fig. 1");
    let [left, right, point] = [a, b, q].map(Site::vertex);
    let pairs = [(left, point), (Site::edge(a, b), point), (right, point)];
    let names = [("B(q, a)", (6.0, 12.0)), ("B(q, ab)", (0.0, -15.0)), ("B(q, b)", (-6.0, 14.0))];
    bisector(&mut panel, &pairs, &names)?;
    panel.line(a, b, LIST);
    panel.point(q, ORANGE);
    panel.label(q, (0.0, 15.0), INK, "q");
    ends(&mut panel, &[(a, (-9.0, -10.0), "a"), (b, (9.0, -10.0), "b")]);

    let (a, b, c, d) = (at(0.9, 1.2), at(4.7, 0.5), at(2.3, 3.8), at(5.0, 5.2));
    let mut panel = sheet.panel(VIEW, "Fig. 2");
    let [left, right, first, last] = [a, b, c, d].map(Site::vertex);
    // The upper one as it is seen from below.
    let (lower, upper) = (Site::edge(a, b), Site::edge(d, c));
    let pairs = [(left, first), (lower, first), (lower, upper), (right, upper), (right, last)];
    let names = [
        ("B(a, c)", (4.0, 12.0)),
        ("B(ab, c)", (1.0, -17.0)),
        ("B(ab, cd)", (0.0, 14.0)),
        ("B(b, cd)", (0.0, 15.0)),
        ("B(b, d)", (0.0, -16.0)),
    ];
    bisector(&mut panel, &pairs, &names)?;
    panel.line(a, b, LIST);
    panel.line(c, d, LIST);
    ends(
        &mut panel,
        &[
            (a, (-9.0, -10.0), "a"),
            (b, (9.0, -10.0), "b"),
            (c, (-9.0, 10.0), "c"),
            (d, (9.0, 10.0), "d"),
        ],
    );
    sheet.legend(&[
        (Sample::Line(LIST), "closed segment"),
        (Sample::Line(AXIS), "bisector"),
        (Sample::Line(NORMAL), "normal in an end"),
    ]);
    Ok(sheet.finish(LESSON.title))
}

/// Draws a bisector, given between which elements its components lie, from the left to the right.
fn bisector(panel: &mut Panel, pairs: &[Pair], names: &[(&str, (f64, f64))]) -> Fallible<()> {
    let change = |two: &[Pair]| change(two[0], two[1], pairs);
    let disks: Vec<Disk> = pairs.windows(2).map(change).collect::<Fallible<_>>()?;
    let (Some(&start), Some(&end)) = (disks.first(), disks.last()) else { return Ok(()) };
    // Between two points the bisector runs across the way from one to the other.
    let across = |(lower, upper): Pair| {
        let across = (upper.a - lower.a).perp();
        across * (1.0 / across.norm())
    };
    let rays = [(start.0, across(pairs[0])), (end.0, -across(pairs[pairs.len() - 1]))];
    let between = disks.windows(2).zip(&pairs[1..]);
    let curves: Vec<Curve> =
        between.map(|(ends, (lower, upper))| Curve::new(upper, lower, ends[0], ends[1])).collect();
    panel.clipped(|panel| {
        for (disk, two) in disks.iter().zip(pairs.windows(2)) {
            // The element that changes is an edge on one hand and its end on the other.
            let changed =
                if two[0].0 == two[1].0 { [two[0].1, two[1].1] } else { [two[0].0, two[1].0] };
            let end = if changed[0].kind == SiteKind::Vertex { changed[0].a } else { changed[1].a };
            panel.line(end, disk.0, NORMAL);
        }
        panel.curves(&curves, AXIS);
        for (from, way) in rays {
            panel.onwards(from, way, AXIS);
        }
    });
    for &(centre, _) in &disks {
        panel.point(centre, PURPLE);
    }
    let middles = curves.iter().map(|curve| curve.point_at(0.5));
    let [first, last] = rays.map(|(from, way)| from + way * 0.9);
    let places = std::iter::once(first).chain(middles).chain([last]);
    for (place, &(name, shift)) in places.zip(names) {
        panel.label(place, shift, PURPLE, name);
    }
    Ok(())
}

/// The disk in which one component ends and the next one starts.
fn change(now: Pair, next: Pair, all: &[Pair]) -> Fallible<Disk> {
    let third = if now.0 == next.0 { next.1 } else { next.0 };
    let [lower, third, upper] = [now.0, third, now.1].map(|site| match site.kind {
        SiteKind::Edge => Element::Edge(site.a, site.b),
        SiteKind::Vertex => Element::Corner(site.a),
    });
    let orders = [[lower, third, upper], [lower, upper, third]];
    let disk = orders.into_iter().find_map(ExactDisk::new).ok_or("no disk touches all three")?;
    let (centre, radius) = disk.approximate();
    let far = |site: &Site| (site.footpoint(centre) - centre).norm();
    if all.iter().any(|(lower, upper)| far(lower).min(far(upper)) < 0.999 * radius) {
        return Err("something is nearer to a bisector than its elements".into());
    }
    Ok((centre, radius))
}

fn ends(panel: &mut Panel, ends: &[(Point, (f64, f64), &str)]) {
    for &(place, shift, name) in ends {
        panel.point(place, BLUE);
        panel.label(place, shift, INK, name);
    }
}
