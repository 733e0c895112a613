//! How half-lines bound a path: shared by the lessons on the three pairs of governors.

use crate::shape::{Fallible, Shape};
use crate::sheet::{Panel, Window};
use crate::style::{
    AXIS, BACK, BACK_INK, BLUE, DISK, FAINT, FRONT, FRONT_INK, GHOST, ORANGE, PATH, PURPLE,
};
use medial::domain::Site;
use medial::engine::Step;
use medial::geom::Point;

/// A room of which a path runs from a corridor into the open: one edge pair, then one corner
/// each, then both.
pub fn room() -> Fallible<Shape> {
    Shape::new(&[
        (0., 0.),
        (6., 0.5),
        (7., -2.),
        (11., -2.),
        (11., 5.6),
        (5.4, 5.6),
        (4.4, 3.2),
        (0., 2.8),
    ])
}

/// The piece of the room that the figures show.
pub const VIEW: Window = (Point::new(-0.4, -2.4), Point::new(11.4, 6.0));

/// Where a half-line of a governor meets the path's bisector.
pub struct Bound {
    from: Point,
    way: Point,
    /// The disk there, if they meet ahead of the start.
    pub disk: Option<(Point, f64)>,
}

/// The front half-line of the right governor and the back one of the left governor.
pub fn bounds(shape: &Shape, step: &Step) -> [Bound; 2] {
    let domain = &shape.domain;
    let (right, left) = (step.right.index(), step.left.index());
    let front = if step.right.is_edge() { domain.end(right) } else { domain.edge(right).start };
    let back = domain.edge(left).start;
    let normal = if step.left.is_edge() { left } else { domain.edge(left).prev };
    let bound = |from, way, third: Site| {
        let disk = shape.disk(step, third).ok();
        Bound { from, way, disk }
    };
    [
        bound(front, shape.normal(right), domain.ahead(step.right)),
        bound(back, shape.normal(normal), domain.behind(step.left)),
    ]
}

/// Draws one step of the tracing: what bounds it, how far it came before, and where it ends.
pub fn draw(shape: &Shape, panel: &mut Panel, step: &Step, names: [&str; 2]) {
    panel.domain(&shape.domain);
    for earlier in shape.steps.iter().take_while(|s| s.from != step.from || s.right != step.right) {
        panel.curve(&shape.curve(earlier), AXIS);
    }
    let [front, back] = bounds(shape, step);
    for (bound, point) in [(&front, "m_j"), (&back, "m_i")] {
        let Some(disk) = bound.disk else { continue };
        let holds = (disk.0 - step.to.0).norm() <= 1e-6 * disk.1;
        if !holds {
            panel.curve(&shape.curve_to(step, disk), FAINT);
            panel.disk(disk.0, disk.1, GHOST);
        }
        panel.label(
            disk.0,
            if point == "m_j" { (-8.0, -15.0) } else { (8.0, 14.0) },
            PURPLE,
            point,
        );
    }
    panel.disk(step.to.0, step.to.1, DISK);
    let governors = [step.right, step.left].map(|s| shape.site(s));
    let touched: Vec<_> = step.governors.iter().map(|&s| shape.site(s)).collect();
    panel.spokes(step.to.0, &touched);
    panel.ray(front.from, front.way, FRONT);
    panel.head(front.from + front.way * 0.9, front.way, FRONT_INK);
    panel.ray(back.from, back.way, BACK);
    panel.head(back.from + back.way * 0.9, back.way, BACK_INK);
    panel.curve(&shape.curve(step), PATH);
    for (governor, color) in governors.iter().zip([BLUE, ORANGE]) {
        panel.site(governor, color);
    }
    let aside = |is_edge: bool| if is_edge { 0.0 } else { -9.0 };
    let middle = |k: usize| (governors[k].a + governors[k].b) * 0.5;
    panel.label(middle(0), (aside(step.right.is_edge()), -16.0), BLUE, names[0]);
    panel.label(middle(1), (aside(step.left.is_edge()), 16.0), ORANGE, names[1]);
    for bound in [&front, &back] {
        if let Some((centre, _)) = bound.disk {
            panel.point(centre, PURPLE);
        }
    }
}
