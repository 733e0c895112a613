use super::canvas::{Anchor, Canvas, Data};
use super::layers::{INK, dots};
use super::palette::{STEPS, color};
use super::{Options, Scene};
use medial::axis::{Joining, KeypointKind};
use medial::geom::Point;

pub(super) const QUIET: &str = "#607d8b";
/// Width of the colour bar.
const BAR: f64 = 220.0;

/// The title above and the legend below the shapes.
pub(super) fn draw(canvas: &mut Canvas, scenes: &[Scene], options: &Options, radius_max: f64) {
    let (left, right) = canvas.frame.margins();
    title(canvas, options);
    if options.legend {
        let y = canvas.frame.legend_y;
        bar(canvas, Point::new(left, y), radius_max, "radius");
        counts(canvas, Point::new(right, y), scenes, options.keypoints);
    }
}

/// The title above the shapes.
pub(super) fn title(canvas: &mut Canvas, options: &Options) {
    if !options.title.is_empty() {
        let at = Point::new(canvas.frame.margins().0, canvas.frame.title_y);
        canvas.text(at, 20.0, Anchor::Start, INK, &options.title);
    }
}

/// The colours of what goes from 0 to a largest value.
pub(super) fn bar(canvas: &mut Canvas, at: Point, most: f64, what: &str) {
    canvas.open("legend", "");
    let step = BAR / STEPS as f64;
    for k in 0..STEPS {
        let corner = at + Point::new(step * k as f64, 0.0);
        // A little wider, so that no seam shows.
        let fill = format!("fill=\"{}\"", color(k));
        canvas.rectangle(corner, Point::new(step + 0.5, 8.0), &fill);
    }
    for (share, anchor) in [(0.0, Anchor::Start), (0.5, Anchor::Middle), (1.0, Anchor::End)] {
        let place = at + Point::new(BAR * share, 22.0);
        canvas.text(place, 12.0, anchor, QUIET, &rounded(most * share));
    }
    canvas.text(at + Point::new(0.0, 38.0), 12.0, Anchor::Start, QUIET, what);
    canvas.close();
}

/// How many of each kind, right-aligned, each with its mark.
fn counts(canvas: &mut Canvas, at: Point, scenes: &[Scene], keypoints: bool) {
    // Steps from sample to sample are no paths that anybody would count.
    let is_sampled = scenes.iter().any(Scene::is_sampled);
    let lines = |s: &Scene| match is_sampled {
        true => s.axis.polylines(Joining::Branches).len(),
        false => s.axis.paths().len(),
    };
    let n_lines: usize = scenes.iter().map(lines).sum();
    let mut x = at.x;
    if keypoints {
        use KeypointKind::{Clipped, End, Junction, Tip, Transition};
        for kind in [Junction, Transition, End, Tip, Clipped] {
            let all = scenes.iter().flat_map(|s| s.axis.keypoints());
            let n = all.filter(|k| k.kind == kind).count();
            // Only outside, or in axes that are not complete, are there any.
            let label = match (kind, n) {
                (Clipped | Tip, 0) => continue,
                (Transition | End, _) if is_sampled => continue,
                (Clipped, n) => format!("{n} clipped"),
                _ => plural(n, kind.name()),
            };
            let place = Point::new(x, at.y + 10.0);
            canvas.text(place, 12.0, Anchor::End, INK, &label);
            x -= canvas.text_width(&label, 12.0) + 10.0;
            let dot = Data::dot_at(Point::new(x, at.y + 5.8));
            dots(canvas, kind, &dot, 2.4);
            x -= 22.0;
        }
    }
    let place = at + Point::new(0.0, 28.0);
    canvas.text(
        place,
        12.0,
        Anchor::End,
        QUIET,
        &plural(n_lines, if is_sampled { "branch" } else { "path" }),
    );
}

pub(super) fn plural(n: usize, word: &str) -> String {
    let ending = if word.ends_with("ch") { "es" } else { "s" };
    if n == 1 { format!("1 {word}") } else { format!("{n} {word}{ending}") }
}

/// Three significant digits, as in `0`, `1.25`, `1250`, `2.5e-7`.
pub(super) fn rounded(value: f64) -> String {
    let rough: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    crate::number::shortest(rough)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_three_digits() {
        assert_eq!(rounded(1.0 / 3.0), "0.333");
        assert_eq!(rounded(12345.0), "12300");
        assert_eq!(rounded(0.0), "0");
    }

    #[test]
    fn one_is_singular() {
        assert_eq!(plural(1, "end"), "1 end");
        assert_eq!(plural(0, "end"), "0 ends");
    }
}
