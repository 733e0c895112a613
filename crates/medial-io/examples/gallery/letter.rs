use crate::lesson::Lesson;
use crate::shape::{Fallible, judged};
use medial::domain::{Domain, Options};
use medial::geom::Point;
use medial_io::svg::{self, Extra, Scene};

pub const LESSON: Lesson = Lesson {
    title: "A letter",
    text: "The cell of each governor in a colour of its own, under the axis coloured by its radius, as \
           `medial axis letter.wkt -o letter.svg --draw cells` gives it.\n\
           The axis goes once around the hole.",
    draw,
};

fn draw() -> Fallible<String> {
    let outer = [
        (0., 0.),
        (2., 0.),
        (2., 3.6),
        (2.9, 3.6),
        (5., 0.),
        (7.4, 0.),
        (5., 3.9),
        (6.2, 4.8),
        (6.6, 6.4),
        (6.2, 8.),
        (5.1, 9.2),
        (3.4, 9.8),
        (0., 9.8),
    ];
    let hole = [(2., 5.4), (2., 8.), (3.4, 8.), (4.3, 7.5), (4.6, 6.7), (4.3, 5.9), (3.4, 5.4)];
    let ring = |ring: &[(f64, f64)]| ring.iter().map(|&(x, y)| Point::new(x, y)).collect();
    let rings: Vec<Vec<Point>> = vec![ring(&outer), ring(&hole)];
    let domain = Domain::from_polygons(std::slice::from_ref(&rings), &Options::default())?;
    let scene = Scene { boundary: rings, axis: judged(&domain)? };
    let options = svg::Options { draw: vec![Extra::Cells], ..svg::Options::default() };
    Ok(svg::write(&[scene], &options))
}
