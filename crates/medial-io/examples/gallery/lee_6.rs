use crate::lee;
use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, BEHIND, INK, LIST, NORMAL, REST};
use medial::engine::{Chain, chain_diagram};

pub const LESSON: Lesson = Lesson {
    title: "Voronoi diagrams of two lists of elements",
    text: "Figure 6 of [Lee82]: the polygon of figure 3 is divided into two lists of elements, 1 to 11 (a) \
           and 12 to 21 (b), and each has a diagram of its own, as `chain_diagram` gives it.\n\
           The paper keeps what lies to the left of a list; the engine keeps both sides, and the other one \
           is shown thin.\n\
           Where a list ends a normal bounds the cell of its last edge.",
    draw,
};

/// How many edges the first list has.
const FIRST: u32 = 7;

fn draw() -> Fallible<String> {
    let shape = lee::shape(3)?;
    let domain = &shape.domain;
    let all = domain.edges().len() as u32;
    let mut sheet = Sheet::new(2, (560.0, 420.0));
    for (caption, first, len, number) in [("a", 0, FIRST, 1), ("b", FIRST, all - FIRST, 12)] {
        let chain = Chain::new(domain, first, len).ok_or("no chain")?;
        let arcs = chain_diagram(&chain)?;
        let mut panel = sheet.panel(shape.window(1.3), caption);
        panel.clipped(|panel| {
            panel.walks(domain, REST, |_| true);
            lee::diagram(panel, domain, &arcs);
            for &edge in chain.edges() {
                panel.line(domain.edge(edge).start, domain.end(edge), LIST);
            }
        });
        lee::numbers(&mut panel, domain, chain.edges(), number, INK);
    }
    sheet.legend(&[
        (Sample::Line(LIST), "list of elements"),
        (Sample::Line(AXIS), "its diagram"),
        (Sample::Line(NORMAL), "normals"),
        (Sample::Line(BEHIND), "its diagram on the other side"),
        (Sample::Line(REST), "the other list"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
