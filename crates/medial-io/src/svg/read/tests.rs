use super::*;
use crate::{Polygons, svg};
use medial::domain::Curves;
use std::f64::consts::PI;

fn features(body: &str) -> Vec<Result<Feature, FeatureError>> {
    let text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" viewBox=\"0 0 100 50\">{body}</svg>"
    );
    let options = ReadOptions { tolerance: Some(1e-4), ..ReadOptions::default() };
    read(&text, &options).unwrap().collect()
}

fn one(body: &str) -> Feature {
    let mut features = features(body);
    assert_eq!(features.len(), 1, "{features:?}");
    features.remove(0).unwrap()
}

fn area(polygons: &Polygons) -> f64 {
    let ring = |ring: &Vec<Point>| -> f64 {
        let next = ring.iter().cycle().skip(1);
        0.5 * ring.iter().zip(next).map(|(a, b)| a.cross(*b)).sum::<f64>()
    };
    polygons.iter().flatten().map(ring).sum()
}

fn property(feature: &Feature, name: &str) -> String {
    let found = feature.properties.iter().find(|(key, _)| key == name);
    found.map(|(_, value)| value.get().trim_matches('"').to_owned()).unwrap_or_default()
}

#[test]
fn doubles_of_points_pass_through_with_y_up() {
    let read = one("<polygon points='0.1,0.2 3.3,0.7 1e-7,5.55' id='a'/>");
    let p = Point::new;
    assert_eq!(read.polygons, [[[p(0.1, -0.2), p(3.3, -0.7), p(1e-7, -5.55)]]]);
    assert_eq!(read.id.unwrap().get(), "\"a\"");
    assert_eq!(read.fill, FillRule::NonZero);
    assert!(read.curves.is_none());
}

#[test]
fn all_shapes_have_their_area() {
    let of = |body: &str| area(&one(body).polygons).abs();
    let near = |a: f64, b: f64| assert!((a - b).abs() < 5e-3, "{a} is not {b}");
    near(of("<rect x='1' y='2' width='30' height='10'/>"), 300.0);
    near(of("<rect width='30' height='10' rx='2'/>"), 300.0 - (4.0 - PI) * 4.0);
    near(of("<rect width='30' height='10' rx='99' ry='1'/>"), 300.0 - (4.0 - PI) * 15.0);
    near(of("<circle cx='3' cy='4' r='2'/>"), 4.0 * PI);
    near(of("<ellipse cx='3' cy='4' rx='2' ry='5'/>"), 10.0 * PI);
    near(of("<path d='M0 0h10v5H0z'/>"), 50.0);
    near(of("<path d='M0 0 A5 5 0 0 1 10 0'/>"), 12.5 * PI);
    near(of("<path d='M0 0a5 5 0 1010 0z'/>"), 12.5 * PI);
    near(of("<path d='M0 0A1 1 0 0 1 10 0'/>"), 12.5 * PI);
    near(of("<path d='M0 0q5 10 10 0t10 0'/>"), 0.0);
    near(of("<path d='M0 0c0 10 10 10 10 0'/>"), 60.0);
    near(of("<polyline points='0 0 4 0 4 4'/>"), 8.0);
}

#[test]
fn circles_are_arcs_and_their_pieces_are_known() {
    let read = one("<g transform='rotate(30) scale(2)'><circle cx='9' r='2'/></g>");
    let curves = read.curves.unwrap();
    assert_eq!(curves.pieces.len(), 2);
    assert!(curves.pieces.iter().all(|p| (p.start.curvature.abs() - 0.25).abs() < 1e-12));
    assert_eq!(curves.edges[0][0].len(), read.polygons[0][0].len());
    assert!(curves.edges[0][0].iter().all(|e| *e != Curves::STRAIGHT));
}

#[test]
fn transforms_uses_and_views_nest() {
    let body = "<defs><rect id='r' width='2' height='1'/><symbol id='s' viewBox='0 0 4 4'>\
                <use xlink:href='#r'/></symbol></defs>\
                <g transform='translate(10 5) scale(2)'><use href='#r' x='1' y='1'/></g>\
                <use href='#s' width='8' height='8'/>\
                <svg x='50' y='10' width='20' height='10' viewBox='0 0 2 2'><use href='#r'/></svg>";
    let read: Vec<Feature> = features(body).into_iter().map(Result::unwrap).collect();
    let starts: Vec<Point> = read.iter().map(|f| f.polygons[0][0][0]).collect();
    let p = Point::new;
    assert_eq!(starts, [p(12.0, -7.0), p(0.0, 0.0), p(55.0, -10.0)]);
    let areas: Vec<f64> = read.iter().map(|f| area(&f.polygons).abs()).collect();
    assert_eq!(areas, [8.0, 8.0, 50.0]);
}

#[test]
fn styles_say_what_is_drawn() {
    let body = "<style>.no{fill:none} rect.yes{fill:#ff0000 !important; fill-rule:evenodd}</style>\
                <rect class='no' width='1' height='1'/><rect class='yes' fill='none' width='1' height='1'/>\
                <g display='none'><rect width='1' height='1'/></g>\
                <g visibility='hidden'><rect width='1' height='1'/>\
                <rect id='seen' visibility='visible' width='1' height='1'/></g>\
                <g style='fill:none'><rect width='1' height='1'/><rect style='fill:lime' width='1' height='1'/></g>\
                <rect width='0' height='1'/><line x2='5'/>";
    let read: Vec<Feature> = features(body).into_iter().map(Result::unwrap).collect();
    let fills: Vec<String> = read.iter().map(|f| property(f, "fill")).collect();
    assert_eq!(fills, ["#ff0000", "black", "lime"]);
    assert_eq!(read[0].fill, FillRule::EvenOdd);
    assert_eq!(property(&read[1], "id"), "seen");
}

#[test]
fn sizes_and_places_may_stand_in_style_sheets() {
    let style = "<style>rect { width: 30px; height: 10px; x: 5; } circle { r: 2 }</style>";
    let read = one(&format!("{style}<rect y='1' width='7'/>"));
    let p = Point::new;
    assert_eq!(read.polygons, [[[p(5.0, -1.0), p(35.0, -1.0), p(35.0, -11.0), p(5.0, -11.0)]]]);
    assert!((area(&one(&format!("{style}<circle/>")).polygons).abs() - 4.0 * PI).abs() < 5e-3);
}

#[test]
fn transforms_have_an_origin() {
    let p = Point::new;
    let turned = [[[p(6.0, 4.0), p(6.0, 2.0), p(5.0, 2.0), p(5.0, 4.0)]]];
    for origin in ["6 -4", "6px -4px", "6% -8%"] {
        let read = one(&format!(
            "<rect x='6' y='-4' width='2' height='1' transform='matrix(0 1 -1 0 0 0)' \
             transform-origin='{origin}'/>"
        ));
        assert_eq!(read.polygons, turned, "{origin}");
    }
    let style = "transform: scale(2px); transform-box: fill-box";
    let read = features(&format!("<rect width='2' height='1' style='{style}'/>"));
    let told = read[0].as_ref().unwrap_err().to_string();
    assert!(told.contains("the transform-box `fill-box` is not known"), "{told}");
}

#[test]
fn text_stands_where_its_view_says() {
    let font = include_bytes!("../../../../../fixtures/drawings/two_letters.ttf");
    let options =
        ReadOptions { fonts: Fonts::default().with(font.to_vec()), ..ReadOptions::default() };
    let left = |place: &str| {
        let text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 50'><text {place}>L</text></svg>"
        );
        let read: Vec<_> = read(&text, &options).unwrap().map(Result::unwrap).collect();
        read[0].polygons[0][0].iter().map(|p| p.x).fold(f64::INFINITY, f64::min)
    };
    let at = left("x='50'");
    assert!((left("x='50%'") - at).abs() < 1e-3, "{at}");
    let moved = left("x='50' transform='scale(2)' transform-origin='50 0'");
    assert!((moved - 50.0 - 2.0 * (at - 50.0)).abs() < 1e-3, "{moved}");
}

#[test]
fn what_has_no_length_is_a_dot_by_its_caps() {
    let of = |cap: &str, d: &str| {
        features(&format!(
            "<path d='{d}' stroke='red' stroke-width='2' stroke-linecap='{cap}' fill='none'/>"
        ))
    };
    for d in ["M12 7h0", "M12 7z", "M12 7L12 7z"] {
        let round = of("round", d).remove(0).unwrap();
        assert!((area(&round.polygons).abs() - PI).abs() < 1e-3, "{d}");
        assert!(round.polygons[0][0].iter().all(|p| (p.x - 12.0).hypot(p.y + 7.0) < 1.0 + 1e-9));
        let square = of("square", d).remove(0).unwrap();
        assert_eq!(area(&square.polygons).abs(), 4.0);
        assert!(of("butt", d).is_empty(), "{d}");
    }
}

#[test]
fn a_fill_without_area_paints_nothing() {
    let of = |d: &str| -> Vec<String> {
        let read = features(&format!("<path d='{d}' stroke='red' stroke-width='2'/>"));
        read.into_iter().map(|read| property(&read.unwrap(), "part")).collect()
    };
    assert_eq!(of("M2 2H20"), ["stroke"]);
    assert_eq!(of("M2 2L2 2L4 3L6 4M9 9C9 10 9 8 9 12"), ["stroke"]);
    assert_eq!(of("M2 2H20V3"), ["fill", "stroke"]);
    assert_eq!(of("M2 2a1 1 0 0 1 2 0"), ["fill", "stroke"]);
    assert!(features("<polyline points='1,1 5,1'/>").is_empty());
}

#[test]
fn dashes_that_are_ignored_are_noted() {
    let of = |dash: &str| one(&format!("<line x2='10' stroke='red' stroke-dasharray='{dash}'/>"));
    assert!(of("1 3").notes.is_empty());
    let solid = of("1e-5");
    assert!((area(&solid.polygons).abs() - 10.0).abs() < 1e-9);
    assert_eq!(solid.notes[0].code, "dashes_ignored");
}

#[test]
fn round_caps_and_joins_are_single_arcs() {
    let read = one("<path d='M12 17h.01' stroke='red' stroke-width='2' stroke-linecap='round'/>");
    let curves = read.curves.as_ref().unwrap();
    let curvatures: Vec<f64> =
        curves.pieces.iter().map(|piece| piece.start.curvature.abs()).collect();
    assert_eq!(curvatures.len(), 2, "{curvatures:?}");
    assert!(curvatures.iter().all(|c| (c - 1.0).abs() < 1e-9), "{curvatures:?}");
    let read = one(
        "<path d='M0 0H30V20' stroke='red' stroke-width='2' stroke-linejoin='round' fill='none'/>",
    );
    assert_eq!(read.curves.unwrap().pieces.len(), 1, "the outside of the corner");
}

#[test]
fn dots_of_dashes_without_length_are_drawn() {
    let read = one(
        "<line x1='1' x2='11' stroke='red' stroke-width='2' stroke-dasharray='0 3' stroke-linecap='round'/>",
    );
    assert_eq!(read.polygons[0].len(), 4, "at 1, 4, 7 and 10");
}

#[test]
fn strokes_are_outlines() {
    let of = |body: &str| {
        let read = one(body);
        assert_eq!((property(&read, "part"), read.fill), ("stroke".to_owned(), FillRule::NonZero));
        area(&read.polygons).abs()
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-2, "{a} is not {b}");
    near(of("<line x2='10' stroke='red' stroke-width='2'/>"), 20.0);
    near(of("<line x2='10' stroke='red' stroke-width='2' stroke-linecap='square'/>"), 24.0);
    near(of("<line x2='10' stroke='red' stroke-width='2' stroke-linecap='round'/>"), 20.0 + PI);
    near(of("<line x2='10' stroke='red' stroke-width='2' stroke-dasharray='1 3'/>"), 6.0);
    near(of("<circle r='5' stroke='red' stroke-width='2' fill='none'/>"), 20.0 * PI);
    let scaled = "<g transform='scale(3)'><line x2='10' stroke='red' stroke-width='2' \
                  vector-effect='non-scaling-stroke'/></g>";
    near(of(scaled), 60.0);
    let both = features("<rect width='9' height='9' stroke='red'/>");
    assert_eq!(both.len(), 2);
    let ring = one("<circle r='5' stroke='red' stroke-width='2' fill='none'/>");
    assert_eq!(ring.curves.unwrap().pieces.len(), 4);
}

#[test]
fn layers_and_groups_are_properties() {
    let body = "<g inkscape:groupmode='layer' inkscape:label='Cut' id='l1'><g id='part'>\
                <rect width='1' height='1' id='r'/></g></g>";
    let read = one(body);
    assert_eq!(property(&read, "layer"), "Cut");
    assert_eq!(property(&read, "group"), "part");
    assert_eq!(property(&read, "element"), "rect");
}

#[test]
fn broken_shapes_leave_the_others() {
    let read = features(
        "<path d='M0 0 L1 nan'/>\n<use href='#gone'/><polygon points='1 2 x'/>\
         <g transform='turn(3)'/><rect width='1' height='1' clip-path='url(#c)'/>",
    );
    let told: Vec<String> = read
        .iter()
        .map(|f| f.as_ref().map_or_else(ToString::to_string, |f| f.notes[0].text.clone()))
        .collect();
    assert!(told[0].starts_with("line 1, column "), "{told:?}");
    assert!(told[0].contains("the data of the path cannot be read"), "{told:?}");
    assert!(told[1].contains("`use` names gone, which is not there"), "{told:?}");
    assert!(told[2].contains("the points of the polygon cannot be read"), "{told:?}");
    assert!(told[3].contains("the transform of `g` cannot be read"), "{told:?}");
    assert_eq!(told[4], "the clip-path url(#c) of the rect is ignored");
}

#[test]
fn absurd_drawings_end() {
    // Uses of uses, deep nesting, and one that uses itself.
    let mut body = String::from("<g id='a0'><rect width='1' height='1'/></g>");
    for k in 0..30 {
        body += &format!("<g id='a{}'><use href='#a{k}'/><use href='#a{k}'/></g>", k + 1);
    }
    assert!(read(&format!("<svg>{body}</svg>"), &ReadOptions::default()).unwrap().count() > 1000);
    let read = features("<g id='me'><use href='#me'/></g>");
    assert!(read[0].as_ref().unwrap_err().to_string().contains("simplify the drawing"));
    let deep = "<g>".repeat(400) + "<rect width='1' height='1'/>" + &"</g>".repeat(400);
    assert!(features(&deep)[0].is_err());
    for numbers in ["1e999", "NaN", "-1e308", "1e300"] {
        let body = format!(
            "<circle r='{numbers}' cx='{numbers}' stroke='red' stroke-width='{numbers}'/>\
             <path d='M0 0C{numbers} 1 2 {numbers} 4 5' stroke='red' stroke-width='1e-300'/>\
             <rect transform='scale({numbers})' width='1' height='{numbers}' rx='{numbers}'/>\
             <path d='M0 0A{numbers} 1 {numbers} 0 1 4 {numbers}' stroke='red' stroke-dasharray='1e-9'/>"
        );
        features(&body);
    }
}

#[test]
fn what_is_no_drawing_is_refused() {
    let error = |text: &str| read(text, &ReadOptions::default()).err().unwrap().to_string();
    assert_eq!(error(" "), "the input is empty");
    assert!(
        error("<svg>\n<g></svg>").starts_with("line 2, column "),
        "{}",
        error("<svg>\n<g></svg>")
    );
    assert!(error("<html/>").contains("the outermost element is `html`, not `svg`"));
}

#[test]
fn text_without_fonts_is_told() {
    let read = features("<text y='10'>Hello</text><text> </text>");
    assert_eq!(read.len(), 1);
    let error = read[0].as_ref().unwrap_err();
    assert_eq!(error.error.code(), "no_font");
    let told = "the text `Hello` has no font; name one with --font, or turn it into paths";
    assert_eq!(error.to_string(), told);
}

#[test]
fn a_picture_of_ours_reads_back() {
    let scene = svg::Scene {
        boundary: crate::samples::rectangle_rings(),
        axis: crate::samples::rectangle(),
    };
    let picture = svg::write(&[scene], &svg::Options::default());
    let read: Vec<Feature> =
        read(&picture, &ReadOptions::default()).unwrap().filter_map(Result::ok).collect();
    // The rectangle is 1000 by 500 pixels, y up.
    let shape = read
        .iter()
        .find(|f| property(f, "group").is_empty() && (area(&f.polygons).abs() - 5e5).abs() < 1.0);
    let ring = &shape.expect("the domain is drawn").polygons[0][0];
    assert!(area(&vec![vec![ring.clone()]]) > 0.0, "counterclockwise as written: {ring:?}");
}

#[test]
fn markers_are_told_once_for_each_line() {
    let body = "<g marker-end='url(#arrow)'><path d='M0 0H9' stroke='red'/><rect width='1' height='1'/>\
                <path d='M0 0V9' stroke='red' style='marker:none;marker-end:none'/></g>";
    let told: Vec<usize> = features(body)
        .into_iter()
        .map(Result::unwrap)
        .map(|f| f.notes.iter().filter(|note| note.code == "marker_ignored").count())
        .collect();
    // The stroke of the one path, the rectangle, the stroke of the other.
    assert_eq!(told, [1, 0, 0]);
}
