//! Plots of the width along lines, each shape in a colour of its own, with the narrowest place marked.

use super::Options;
use super::canvas::{Anchor, Canvas, Data, number};
use super::frame::Frame;
use super::layers::INK;
use super::legend::{self, QUIET, rounded};
use super::palette::{STEPS, color};
use crate::text::escaped;
use medial::geom::Point;
use medial::ops::{Station, narrowest};

/// What a plot needs of the line of a shape.
#[derive(Clone, Debug)]
pub struct Profile {
    /// The number of the feature.
    pub feature: usize,
    /// The width along its line.
    pub stations: Vec<Station>,
}

/// The area between the axes, in pixels.
const EXTENT: Point = Point::new(940.0, 380.0);
/// Room for numbers left of the axes, and for numbers and words below them.
const ROOM: Point = Point::new(44.0, 34.0);
/// Room above, for words and the value of the narrowest place.
const ABOVE: f64 = 22.0;
/// Most ticks of an axis.
const TICKS: [f64; 2] = [12.0, 8.0];
/// Width of a line: less where there are many.
const WIDTHS: [f64; 2] = [0.6, 1.8];
/// Most shapes that are named; more share a bar.
const NAMED: usize = 8;
/// Size of the numbers and words.
const SIZE: f64 = 12.0;
/// The colour of the mark.
const MARK: &str = "#c62828";
/// The colour of the lines behind.
const GRID: &str = "#e3e8eb";

/// The plot of some profiles on common axes.
#[must_use]
pub fn write_profiles(profiles: &[Profile], options: &Options) -> String {
    let has_legend = options.legend && profiles.len() > 1;
    let shown = Options { legend: has_legend, ..options.clone() };
    let frame = Frame::plot(EXTENT, ROOM, ABOVE, &shown);
    let mut canvas = Canvas::new(frame, options.lettering);
    let stations = || profiles.iter().flat_map(|profile| &profile.stations);
    let longest = stations().map(|station| station.along).fold(0.0, f64::max);
    let widest = stations().map(|station| station.width).fold(0.0, f64::max);
    let axes = [Axis::new(longest, EXTENT.x, TICKS[0]), Axis::new(widest, EXTENT.y, TICKS[1])];
    grid(&mut canvas, &axes);
    let colors = Colors::new(profiles);
    lines(&mut canvas, profiles, &axes, &colors);
    mark(&mut canvas, profiles, &axes);
    legend::title(&mut canvas, options);
    if has_legend {
        key(&mut canvas, profiles, &colors);
    }
    canvas.finish(&escaped(&options.title))
}

/// An axis from 0 on, with round ticks.
struct Axis {
    /// Its length, in pixels.
    extent: f64,
    /// The value at its end.
    most: f64,
    step: f64,
    n_ticks: usize,
}

impl Axis {
    /// The axis up to a tick at or above a value; so much of it is drawn, with so many ticks at most.
    fn new(most: f64, extent: f64, ticks: f64) -> Self {
        let most = if most > 0.0 { most } else { 1.0 };
        let step = round_up(most / ticks);
        let n_ticks = (most / step).ceil().max(1.0);
        Self { extent, most: n_ticks * step, step, n_ticks: n_ticks as usize }
    }

    /// Where a value is, in pixels from the start.
    fn place(&self, value: f64) -> f64 {
        value / self.most * self.extent
    }

    fn ticks(&self) -> impl Iterator<Item = f64> {
        (0..=self.n_ticks).map(|k| k as f64 * self.step)
    }
}

/// The least of …, 0.5, 1, 2, 5, 10, … that is no less than a positive value.
fn round_up(value: f64) -> f64 {
    let power = value.log10().floor() as i32;
    let steps = [1, 2, 5, 10].map(|digit| format!("{digit}e{power}").parse().unwrap_or(value));
    steps.into_iter().find(|&step: &f64| step >= value).unwrap_or(value)
}

/// The place of a station, in pixels from the origin of the axes.
fn place(station: &Station, [along, width]: &[Axis; 2]) -> Point {
    Point::new(along.place(station.along), width.place(station.width))
}

/// The axes with their ticks and what they are.
fn grid(canvas: &mut Canvas, axes: &[Axis; 2]) {
    let frame = canvas.frame;
    let origin = Point::new(0.0, 0.0);
    let sides = [Point::new(EXTENT.x, 0.0), Point::new(0.0, EXTENT.y)];
    let mut data = Data::new(&frame);
    let mut labels = Vec::new();
    for (k, axis) in axes.iter().enumerate() {
        for tick in axis.ticks() {
            let at = sides[k] * (axis.place(tick) / axis.extent);
            data.move_to(at);
            data.line_to(at + sides[1 - k]);
            let (shift, anchor) = match k {
                0 => (Point::new(0.0, 17.0), Anchor::Middle),
                _ => (Point::new(-8.0, 0.35 * SIZE), Anchor::End),
            };
            labels.push((frame.map(at) + shift, anchor, rounded(tick)));
        }
    }
    let data = data.text;
    canvas.open("grid", &format!("fill=\"none\" stroke=\"{GRID}\" stroke-width=\"1\""));
    canvas.path(&data, "");
    canvas.close();
    let mut data = Data::new(&frame);
    data.move_to(sides[1]);
    data.line_to(origin);
    data.line_to(sides[0]);
    let data = data.text;
    canvas.open("axes", &format!("fill=\"none\" stroke=\"{QUIET}\" stroke-width=\"1\""));
    canvas.path(&data, "");
    canvas.close();
    canvas.open("ticks", "");
    for (at, anchor, label) in labels {
        canvas.text(at, SIZE, anchor, QUIET, &label);
    }
    let below = frame.map(sides[0] * 0.5) + Point::new(0.0, ROOM.y);
    canvas.text(below, SIZE, Anchor::Middle, INK, "station");
    let above = frame.map(sides[1]) + Point::new(-8.0, -10.0);
    canvas.text(above, SIZE, Anchor::End, INK, "width");
    canvas.close();
}

/// Each profile, in the colour of its feature.
fn lines(canvas: &mut Canvas, profiles: &[Profile], axes: &[Axis; 2], colors: &Colors) {
    let width = (WIDTHS[1] / (profiles.len().max(1) as f64).cbrt()).max(WIDTHS[0]);
    let style = format!(
        "fill=\"none\" stroke-width=\"{}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"",
        number(width)
    );
    canvas.open("profiles", &style);
    for profile in profiles {
        let mut data = Data::new(&canvas.frame);
        for (k, station) in profile.stations.iter().enumerate() {
            let p = place(station, axes);
            if k == 0 { data.move_to(p) } else { data.line_to(p) }
        }
        let data = data.text;
        canvas.path(&data, &format!("stroke=\"{}\"", colors.of(profile.feature)));
    }
    canvas.close();
}

/// The narrowest place of all, with its width and where it is written above.
fn mark(canvas: &mut Canvas, profiles: &[Profile], axes: &[Axis; 2]) {
    let narrow = profiles.iter().filter_map(|profile| {
        narrowest(&profile.stations).map(|k| (profile.feature, profile.stations[k]))
    });
    let Some((feature, station)) = narrow.min_by(|(_, a), (_, b)| a.width.total_cmp(&b.width))
    else {
        return;
    };
    let at = place(&station, axes);
    let top = Point::new(at.x, EXTENT.y);
    let mut data = Data::new(&canvas.frame);
    data.move_to(at);
    data.line_to(top);
    let data = data.text;
    canvas.open("narrowest", &format!("fill=\"#ffffff\" stroke=\"{MARK}\" stroke-width=\"1.4\""));
    canvas.path(&data, "stroke-width=\"1\" stroke-dasharray=\"4 3\"");
    canvas.circle(canvas.frame.map(at), 3.6);
    canvas.close();
    let mut label = format!("{} at {}", rounded(station.width), rounded(station.along));
    if profiles.len() > 1 {
        label = format!("{label}, feature {feature}");
    }
    // Within the plot also where the place is near an end.
    let half = 0.5 * canvas.text_width(&label, SIZE);
    let middle = Point::new(at.x.clamp(half, EXTENT.x - half), EXTENT.y);
    let above = canvas.frame.map(middle) - Point::new(0.0, 10.0);
    canvas.open("value", "");
    canvas.text(above, SIZE, Anchor::Middle, MARK, &label);
    canvas.close();
}

/// Which feature has which colour: one for each, or a bar.
fn key(canvas: &mut Canvas, profiles: &[Profile], colors: &Colors) {
    let mut at = Point::new(canvas.frame.margins().0, canvas.frame.legend_y);
    if profiles.len() > NAMED {
        legend::bar(canvas, at, colors.last as f64, "feature");
        return;
    }
    at = at + Point::new(0.0, 10.0);
    canvas.open("legend", "");
    for Profile { feature, .. } in profiles {
        let data = format!("M{} {}h26", number(at.x), number(at.y - 4.2));
        let style = format!("fill=\"none\" stroke=\"{}\" stroke-width=\"2\"", colors.of(*feature));
        canvas.path(&data, &style);
        let label = format!("feature {feature}");
        canvas.text(at + Point::new(34.0, 0.0), SIZE, Anchor::Start, INK, &label);
        at.x += 34.0 + canvas.text_width(&label, SIZE) + 28.0;
    }
    canvas.close();
}

/// The colours of features.
struct Colors {
    /// The number with the last colour: an even one, so that the middle of a bar is a number too.
    last: usize,
}

impl Colors {
    fn new(profiles: &[Profile]) -> Self {
        let last = profiles.iter().map(|profile| profile.feature).max().unwrap_or(0);
        Self { last: last + last % 2 }
    }

    fn of(&self, feature: usize) -> String {
        color(feature * (STEPS - 1) / self.last.max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn profile(feature: usize, widths: &[(f64, f64)]) -> Profile {
        let station =
            |&(along, width): &(f64, f64)| Station { along, width, point: Point::new(along, 0.0) };
        Profile { feature, stations: widths.iter().map(station).collect() }
    }

    fn group<'a>(picture: &'a str, class: &str) -> &'a str {
        let start = picture.find(&format!("<g class=\"{class}\"")).unwrap();
        &picture[start..start + picture[start..].find("</g>").unwrap()]
    }

    #[test]
    fn the_narrowest_place_is_marked_with_its_width() {
        let one = profile(0, &[(0.0, 0.0), (10.0, 4.0), (30.0, 1.25), (40.0, 4.0)]);
        let picture = write_profiles(&[one], &Options::default());
        assert!(group(&picture, "value").contains(">1.25 at 30<"), "{picture}");
        assert_eq!(group(&picture, "profiles").matches('L').count(), 3);
        assert!(!picture.contains("class=\"legend\""));
        // Both axes from 0 on: (30, 1.25) of (40, 4) lies at three and at five sixteenths.
        let [x, y] = [72.0 + 0.75 * 940.0, 50.0 + 380.0 * 11.0 / 16.0].map(number);
        assert!(group(&picture, "narrowest").contains(&format!("cx=\"{x}\" cy=\"{y}\"")));
    }

    #[test]
    fn ticks_are_round() {
        let values = [(0.9, 0.1), (1.0, 0.1), (7.0, 1.0), (4321.0, 500.0), (2e-7, 2e-8)];
        for (most, step) in values {
            assert_eq!(Axis::new(most, 1.0, 10.0).step, step, "{most}");
        }
        let all: Vec<String> = Axis::new(0.7, 1.0, 7.0).ticks().map(rounded).collect();
        assert_eq!(all, ["0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"]);
    }

    #[test]
    fn features_are_told_apart() {
        let widths = [(0.0, 1.0), (1.0, 2.0), (2.0, 1.5), (3.0, 2.0)];
        let few = [0, 5].map(|feature| profile(feature, &widths));
        let picture = write_profiles(&few, &Options::default());
        assert!(group(&picture, "legend").contains(">feature 5<"));
        assert!(picture.contains(">1.5 at 2, feature 0<"));
        let many: Vec<Profile> = (0..30).map(|feature| profile(feature, &widths)).collect();
        let picture = write_profiles(&many, &Options::default());
        let legend = group(&picture, "legend");
        assert!(legend.contains(">15<") && legend.contains(">30<"));
        assert_eq!(group(&picture, "profiles").matches("<path").count(), 30);
    }

    #[test]
    fn nothing_is_divided_by_nothing() {
        for profiles in [vec![], vec![profile(0, &[])], vec![profile(3, &[(0.0, 0.0)])]] {
            let picture = write_profiles(&profiles, &Options::default());
            assert!(!picture.contains("NaN") && !picture.contains("inf"), "{picture}");
        }
    }
}
