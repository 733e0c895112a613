//! Open lines joined at their ends.

use crate::curves::Contour;
use medial::geom::{Point, Rect};
use std::collections::HashMap;

/// Ends that are nearer than this are one, as a share of the longer side of the box of all lines.
///
/// It makes up for angles and coordinates with few digits: a micrometre in a drawing of a metre.
const GAP: f64 = 1e-6;

/// Gaps of this share of the box are not worth telling: ends of arcs follow from angles.
const ROUNDING: f64 = 1e-12;

/// Lines that were joined.
#[derive(Debug)]
pub(super) struct Chain {
    pub contour: Contour,
    pub closed: bool,
    /// Which lines it is made of.
    pub parts: Vec<usize>,
    /// The widest gap between ends that were taken for one, 0 if it is only rounding.
    pub gap: f64,
}

/// The chains of lines, with as many closed ones as possible.
///
/// Where more than two lines meet, loops are closed at the first place that was there before; which
/// loops are found does not change what they enclose an odd number of times.
pub(super) fn chains(lines: &[Contour]) -> Vec<Chain> {
    let bounds = lines.iter().flat_map(Contour::extremes).fold(Rect::EMPTY, Rect::with);
    let size = bounds.max - bounds.min;
    let nodes = Nodes::new(lines, GAP * f64::max(size.x, size.y));
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); nodes.places.len()];
    for (k, ends) in nodes.of_line.iter().enumerate() {
        ends.iter().for_each(|node| around[*node].push(k));
    }
    let mut walk = Walk {
        lines,
        nodes: &nodes,
        rounding: ROUNDING * f64::max(size.x, size.y),
        seen: vec![0; around.len()],
        on_path: vec![None; around.len()],
        around,
        used: vec![false; lines.len()],
        chains: Vec::new(),
    };
    // Where an odd number of lines meet something stays open.
    let odd: Vec<usize> =
        (0..walk.around.len()).filter(|node| walk.around[*node].len() % 2 == 1).collect();
    odd.into_iter().for_each(|node| walk.from(node));
    for line in 0..lines.len() {
        if !walk.used[line] {
            walk.from(nodes.of_line[line][0]);
        }
    }
    walk.chains
}

/// Ends of lines that are one.
struct Nodes {
    places: Vec<Point>,
    /// The nodes at the start and the end of each line.
    of_line: Vec<[usize; 2]>,
}

impl Nodes {
    fn new(lines: &[Contour], gap: f64) -> Self {
        let mut places: Vec<Point> = Vec::new();
        let mut cells: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
        // Cells may be empty where all lines are one point.
        let cell = |p: Point| match gap > 0.0 {
            true => ((p.x / gap).floor() as i64, (p.y / gap).floor() as i64),
            false => (p.x.to_bits() as i64, p.y.to_bits() as i64),
        };
        let mut node = |p: Point| {
            let (x, y) = cell(p);
            let mut nearest: Option<(f64, usize)> = None;
            for dx in -1..=1 {
                for dy in -1..=1 {
                    let key = (x.saturating_add(dx), y.saturating_add(dy));
                    for k in cells.get(&key).into_iter().flatten() {
                        let distance = (places[*k] - p).norm();
                        if distance <= gap && nearest.is_none_or(|(least, _)| distance < least) {
                            nearest = Some((distance, *k));
                        }
                    }
                }
            }
            nearest.map_or_else(
                || {
                    places.push(p);
                    cells.entry((x, y)).or_default().push(places.len() - 1);
                    places.len() - 1
                },
                |(_, k)| k,
            )
        };
        let of_line = lines.iter().map(|line| [node(line.start), node(line.end())]).collect();
        Self { places, of_line }
    }
}

struct Walk<'a> {
    lines: &'a [Contour],
    nodes: &'a Nodes,
    rounding: f64,
    around: Vec<Vec<usize>>,
    /// How many lines around each node were looked at.
    seen: Vec<usize>,
    /// The place of a node on the path.
    on_path: Vec<Option<usize>>,
    used: Vec<bool>,
    chains: Vec<Chain>,
}

impl Walk<'_> {
    /// Walks from a node until there is no way on; loops are cut off.
    fn from(&mut self, start: usize) {
        let mut path: Vec<(usize, usize)> = Vec::new();
        let mut at = start;
        self.on_path[at] = Some(0);
        while let Some(line) = self.next(at) {
            self.used[line] = true;
            let [a, b] = self.nodes.of_line[line];
            path.push((line, at));
            at = if a == at { b } else { a };
            if let Some(first) = self.on_path[at] {
                let ring = path.split_off(first);
                for (_, node) in &ring[1..] {
                    self.on_path[*node] = None;
                }
                self.emit(&ring, true);
            } else {
                self.on_path[at] = Some(path.len());
            }
        }
        self.on_path[at] = None;
        for (_, node) in &path {
            self.on_path[*node] = None;
        }
        if !path.is_empty() {
            self.emit(&path, false);
        }
    }

    fn next(&mut self, node: usize) -> Option<usize> {
        while let Some(line) = self.around[node].get(self.seen[node]) {
            if !self.used[*line] {
                return Some(*line);
            }
            self.seen[node] += 1;
        }
        None
    }

    fn emit(&mut self, path: &[(usize, usize)], closed: bool) {
        let mut contour: Option<Contour> = None;
        let mut gap: f64 = 0.0;
        for (line, from) in path {
            let ends = self.nodes.of_line[*line];
            let line = &self.lines[*line];
            let (mut part, [from, to]) = match ends[0] == *from {
                true => (line.clone(), ends),
                false => (line.reversed(), [ends[1], ends[0]]),
            };
            let (from, to) = (self.nodes.places[from], self.nodes.places[to]);
            gap = gap.max((part.start - from).norm()).max((part.end() - to).norm());
            part.set_start(from);
            part.set_end(to);
            match &mut contour {
                Some(contour) => contour.segments.extend(part.segments),
                None => contour = Some(part),
            }
        }
        if let Some(contour) = contour {
            let parts = path.iter().map(|(line, _)| *line).collect();
            let gap = if gap > self.rounding { gap } else { 0.0 };
            self.chains.push(Chain { contour, closed, parts, gap });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(a: (f64, f64), b: (f64, f64)) -> Contour {
        let mut contour = Contour::new(Point::new(a.0, a.1));
        contour.line_to(Point::new(b.0, b.1));
        contour
    }

    #[test]
    fn lines_in_any_order_and_direction_close() {
        let lines = [
            line((0., 0.), (1., 0.)),
            line((1., 1.), (1., 0.)),
            line((0., 0.), (0., 1.)),
            line((1., 1.), (0., 1.)),
        ];
        let found = chains(&lines);
        assert_eq!(found.len(), 1);
        assert!(found[0].closed && found[0].contour.segments.len() == 4);
        assert_eq!(found[0].contour.start, found[0].contour.end());
        assert_eq!(found[0].gap, 0.0);
    }

    #[test]
    fn small_gaps_are_told_and_large_ones_stay() {
        let triangle = |gap: f64| {
            [line((0., 0.), (9., 0.)), line((9., gap), (0., 9.)), line((0., 9.), (0., 0.))]
        };
        let found = chains(&triangle(1e-7));
        assert!(found.len() == 1 && found[0].closed && found[0].gap == 1e-7);
        let found = chains(&triangle(1e-4));
        assert!(found.len() == 1 && !found[0].closed && found[0].parts.len() == 3);
    }

    #[test]
    fn touching_squares_and_a_tail_are_told_apart() {
        let square = |x: f64| {
            [
                line((x, x), (x + 1., x)),
                line((x + 1., x), (x + 1., x + 1.)),
                line((x + 1., x + 1.), (x, x + 1.)),
                line((x, x + 1.), (x, x)),
            ]
        };
        let tail = line((2., 2.), (5., 2.));
        let lines: Vec<Contour> = square(0.).into_iter().chain([tail]).chain(square(1.)).collect();
        let found = chains(&lines);
        let closed: Vec<usize> = found.iter().filter(|c| c.closed).map(|c| c.parts.len()).collect();
        assert_eq!(closed, [4, 4], "{found:?}");
        let open: Vec<&Chain> = found.iter().filter(|c| !c.closed).collect();
        assert!(open.len() == 1 && open[0].parts == [4]);
    }
}
