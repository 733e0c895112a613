use crate::lee;
use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Sample, Sheet};
use crate::style::{
    BLUE, FIRST, FIRST_LIST, FIRST_LOST, ORANGE, PATH, PURPLE, REST, SECOND, SECOND_LIST,
    SECOND_LOST,
};
use medial::engine::{Chain, ChainArc, chain_merge};
use medial::geom::Point;

pub const LESSON: Lesson = Lesson {
    title: "Merge of two Voronoi diagrams",
    text: "Figure 7 of [Lee82], for a polygon made so that the engine walks as the paper tells.\n\
           The list S_1 has the elements 1 to 12, and its diagram is dotted; S_2 those from 13 to 21, and its \
           diagram is dashed; what each loses to the other is fainter, all as `chain_merge` gives it.\n\
           The curve starts in the corner between 12 and 13 as their bisector and meets the arc between 10 \
           and 12 before that between 13 and 17, so it goes on between 10 and 13; there it meets the arc \
           between 9 and 10 before that between 13 and 14, and goes on between 9 and 13.\n\
           So it runs from cell to cell until it lies between 6 and 20, where no arc ahead meets it: all \
           other elements lie on one side of the line through those two.",
    draw,
};

/// The edges of both lists, and how many of them are in the first one.
const EDGES: u32 = 15;
const AT: usize = 8;

fn draw() -> Fallible<String> {
    let shape = lee::shape(7)?;
    let domain = &shape.domain;
    let chain = Chain::new(domain, 0, EDGES).ok_or("no chain")?;
    let merge = chain_merge(&chain, AT)?;
    let mut sheet = Sheet::new(1, (940.0, 680.0));
    let mut panel = sheet.panel((Point::new(-0.5, -1.3), Point::new(12.9, 8.7)), "");
    let (first, second) = chain.edges().split_at(AT);
    // The walk on the left of both lists; on the right there is another one.
    let right = merge.curve.iter().position(|piece| !lee::is_inside(piece));
    let curve = &merge.curve[..right.unwrap_or(merge.curve.len())];
    panel.clipped(|panel| {
        panel.walks(domain, REST, |_| true);
        let mut draw = |arcs: &[ChainArc], style: &str| {
            for arc in arcs.iter().filter(|arc| lee::is_inside(arc)) {
                lee::arc(panel, domain, arc, style);
            }
        };
        draw(&merge.discarded[0], FIRST_LOST);
        draw(&merge.discarded[1], SECOND_LOST);
        draw(&merge.kept[0], FIRST);
        draw(&merge.kept[1], SECOND);
        draw(curve, PATH);
        for (edges, style) in [(first, FIRST_LIST), (second, SECOND_LIST)] {
            for &edge in edges {
                panel.line(domain.edge(edge).start, domain.end(edge), style);
            }
        }
    });
    for (centre, _) in curve.iter().filter_map(|piece| piece.from.disk()) {
        panel.point(centre, PURPLE);
    }
    lee::numbers(&mut panel, domain, first, 1, BLUE);
    lee::numbers(&mut panel, domain, second, 13, ORANGE);
    panel.label(Point::new(0.9, 3.1), (0.0, 14.0), PURPLE, "B(S_1, S_2)");
    sheet.legend(&[
        (Sample::Line(FIRST), "diagram of S_1"),
        (Sample::Line(FIRST_LOST), "discarded"),
        (Sample::Line(SECOND), "diagram of S_2"),
        (Sample::Line(SECOND_LOST), "discarded"),
        (Sample::Line(PATH), "merge curve"),
        (Sample::Line(REST), "boundary in neither list"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
