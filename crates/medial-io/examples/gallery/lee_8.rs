use crate::lee;
use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Panel, Sheet};
use crate::style::{BEHIND, BLUE, INK, PURPLE, TEAL};
use medial::engine::{Chain, chain_merge};
use medial::geom::Point;

pub const LESSON: Lesson = Lesson {
    title: "The merge tree",
    text: "Figure 8 of [Lee82], as the engine merges the 15 edges of figure 3, numbered here without their corners.\n\
           The leaves of the paper are chains of reflex corners; ours are edges, and the diagram of two that \
           follow one another is written down.\n\
           All other diagrams are merged from two, mostly of one length; below each stands how many \
           pieces its merge curve has on both sides of the boundary.\n\
           The last merge closes the ring.",
    draw,
};

/// Edges of the first of the two chains that close the ring.
const FIRST: u32 = 8;

fn draw() -> Fallible<String> {
    let domain = lee::domain(3)?;
    let all = domain.edges().len() as u32;
    let mut sheet = Sheet::new(1, (900.0, 330.0));
    let mut panel = sheet.panel((Point::new(0.2, -0.45), Point::new(15.8, 5.1)), "");
    let parts = [(0, FIRST), (FIRST, all - FIRST)]
        .map(|(first, len)| Chain::new(&domain, first, len).ok_or("no chain"));
    let mut tops = Vec::new();
    for chain in parts {
        let chain = chain?;
        tops.push(lines(&mut panel, &chain));
        nodes(&mut panel, &chain)?;
    }
    let root = Point::new(tops.iter().map(|top| top.x).sum::<f64>() / 2.0, ROW * 4.0);
    for &top in &tops {
        panel.line(top, root, BEHIND);
    }
    panel.point(root, PURPLE);
    panel.label(root, (0.0, 15.0), INK, &format!("1–{all}: the ring closes"));
    // Over the lines to the root.
    for top in tops {
        panel.point(top, TEAL);
    }
    Ok(sheet.finish(LESSON.title))
}

/// Height of a row of the tree, in widths of a leaf.
const ROW: f64 = 1.15;

/// Where the node of a chain is drawn: over its edges, as high as the tree below it.
fn place(chain: &Chain<'_>) -> Point {
    let edges = chain.edges();
    let middle = f64::from(edges[0] + edges[edges.len() - 1]) / 2.0 + 1.0;
    Point::new(middle, ROW * f64::from(edges.len().next_power_of_two().ilog2()))
}

/// Draws the lines of a tree; gives the place of its top.
fn lines(panel: &mut Panel, chain: &Chain<'_>) -> Point {
    let top = place(chain);
    if let Some((first, second)) = chain.parts() {
        for part in [first, second] {
            let end = lines(panel, &part);
            panel.line(top, end, BEHIND);
        }
    }
    top
}

/// Draws the nodes of a tree, with the numbers of their edges and of the pieces of the curves.
fn nodes(panel: &mut Panel, chain: &Chain<'_>) -> Fallible<()> {
    let (at, edges) = (place(chain), chain.edges());
    let (low, high) = (edges[0] + 1, edges[edges.len() - 1] + 1);
    let Some((first, second)) = chain.parts() else {
        panel.point(at, BLUE);
        panel.small(at, (0.0, -14.0), INK, &low.to_string());
        return Ok(());
    };
    nodes(panel, &first)?;
    nodes(panel, &second)?;
    panel.point(at, TEAL);
    panel.label(at, (0.0, 14.0), INK, &format!("{low}–{high}"));
    if edges.len() > 2 {
        let pieces = chain_merge(chain, first.edges().len())?.curve.len();
        panel.note(at, (0.0, -15.0), &format!("{pieces} pieces"));
    }
    Ok(())
}
