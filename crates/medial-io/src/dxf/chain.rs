//! Open lines joined at their ends.

use crate::curves::Contour;
use medial::geom::{Point, Rect};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

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
    /// How many lines are left out that repeat one of them.
    pub n_repeats: usize,
    /// The widest gap between ends that were taken for one, 0 if it is only rounding.
    pub gap: f64,
}

/// The chains of lines, with as many closed ones as possible.
///
/// Where more than two lines meet, loops are closed at the first place that was there before; which
/// loops are found does not change what they enclose an odd number of times. A line that is given more than
/// once, either way round, is taken once, or twice where two outlines have it in common.
pub(super) fn chains(lines: &[Contour]) -> Vec<Chain> {
    let bounds = lines.iter().flat_map(Contour::extremes).fold(Rect::EMPTY, Rect::with);
    let size = bounds.max - bounds.min;
    let nodes = Nodes::new(lines, GAP * f64::max(size.x, size.y));
    let Once { same, n_repeats, is_kept } = Once::new(lines, &nodes);
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); nodes.places.len()];
    for (k, ends) in nodes.of_line.iter().enumerate().filter(|(k, _)| is_kept[*k]) {
        ends.iter().for_each(|node| around[*node].push(k));
    }
    let mut walk = Walk {
        lines,
        nodes: &nodes,
        rounding: ROUNDING * f64::max(size.x, size.y),
        seen: vec![0; around.len()],
        on_path: vec![None; around.len()],
        around,
        used: is_kept.iter().map(|is_kept| !is_kept).collect(),
        same,
        n_repeats,
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

/// Lines that are taken, and those that repeat one of them.
struct Once {
    /// The first line that is the same as each.
    same: Vec<usize>,
    /// How many repeats of each line are left out.
    n_repeats: Vec<usize>,
    is_kept: Vec<bool>,
}

impl Once {
    fn new(lines: &[Contour], nodes: &Nodes) -> Self {
        let mut first: HashMap<Vec<u64>, usize> = HashMap::new();
        let mut same: Vec<usize> = (0..lines.len()).collect();
        // Other lines that are the same as each; none of what is no first one.
        let mut others: Vec<Vec<usize>> = vec![Vec::new(); lines.len()];
        for (k, line) in lines.iter().enumerate() {
            match first.entry(key(line, nodes.of_line[k])) {
                Entry::Vacant(entry) => {
                    entry.insert(k);
                }
                Entry::Occupied(entry) => {
                    same[k] = *entry.get();
                    others[same[k]].push(k);
                }
            }
        }
        let mut once =
            Self { n_repeats: others.iter().map(Vec::len).collect(), is_kept: Vec::new(), same };
        once.is_kept = once.same.iter().enumerate().map(|(k, same)| k == *same).collect();
        if first.len() == lines.len() {
            return once;
        }
        let mut degree = vec![0_usize; nodes.places.len()];
        let mut islands = Islands((0..degree.len()).collect());
        for [a, b] in (0..lines.len()).filter(|k| once.is_kept[*k]).map(|k| nodes.of_line[k]) {
            degree[a] += 1;
            degree[b] += 1;
            islands.join(a, b);
        }
        // Taken once, lines leave something open here.
        let mut is_open = vec![false; degree.len()];
        for node in (0..degree.len()).filter(|node| degree[*node] % 2 == 1) {
            is_open[islands.of(node)] = true;
        }
        let twice: Vec<(usize, usize)> = (0..lines.len())
            .filter_map(|k| Some((k, *others[k].first()?)))
            .filter(|(k, _)| {
                let [a, b] = nodes.of_line[*k];
                a != b && degree[a] > 1 && degree[b] > 1 && is_open[islands.of(a)]
            })
            .collect();
        for (k, other) in &twice {
            nodes.of_line[*k].iter().for_each(|node| degree[*node] += 1);
            once.is_kept[*other] = true;
            once.n_repeats[*k] -= 1;
        }
        for (k, other) in twice {
            let [a, b] = nodes.of_line[k];
            if degree[a] % 2 == 1 && degree[b] % 2 == 1 {
                (degree[a], degree[b]) = (degree[a] - 1, degree[b] - 1);
                once.is_kept[other] = false;
                once.n_repeats[k] += 1;
            }
        }
        once
    }
}

/// A line as bits that are the same for another one with the same course, either way round.
fn key(line: &Contour, [start, end]: [usize; 2]) -> Vec<u64> {
    let bits = |line: &Contour, start: usize, end: usize| {
        let n = line.segments.len();
        let mut bits = vec![start as u64, end as u64];
        // Zero has two signs.
        let mut add = |value: f64| bits.push((value + 0.0).to_bits());
        for (k, segment) in line.segments.iter().enumerate() {
            segment.between().into_iter().for_each(&mut add);
            if k + 1 < n {
                [segment.end().x, segment.end().y].into_iter().for_each(&mut add);
            }
        }
        bits
    };
    bits(line, start, end).min(bits(&line.reversed(), end, start))
}

/// Nodes that lines join.
struct Islands(Vec<usize>);

impl Islands {
    /// The node that stands for all of its island.
    fn of(&mut self, mut node: usize) -> usize {
        while self.0[node] != node {
            self.0[node] = self.0[self.0[node]];
            node = self.0[node];
        }
        node
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b)] = a.min(b);
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
    same: Vec<usize>,
    n_repeats: Vec<usize>,
    chains: Vec<Chain>,
}

impl Walk<'_> {
    /// Walks from a node until there is no way on; loops are cut off.
    fn from(&mut self, start: usize) {
        let mut path: Vec<(usize, usize)> = Vec::new();
        let mut at = start;
        self.on_path[at] = Some(0);
        while let Some(line) = self.next(at, path.last().map(|(line, _)| *line)) {
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

    /// A way on from a node; back the same way only if there is no other.
    fn next(&mut self, node: usize, last: Option<usize>) -> Option<usize> {
        let around = &self.around[node];
        while around.get(self.seen[node]).is_some_and(|line| self.used[*line]) {
            self.seen[node] += 1;
        }
        let is_back = |line: usize| last.is_some_and(|last| self.same[last] == self.same[line]);
        let mut left = around[self.seen[node]..].iter().copied().filter(|line| !self.used[*line]);
        let first = left.next()?;
        // Of each line there are two at most.
        if is_back(first) { left.next().or(Some(first)) } else { Some(first) }
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
            let parts: Vec<usize> = path.iter().map(|(line, _)| *line).collect();
            let n_repeats = parts.iter().map(|line| self.n_repeats[*line]).sum();
            let gap = if gap > self.rounding { gap } else { 0.0 };
            self.chains.push(Chain { contour, closed, parts, n_repeats, gap });
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
    fn a_line_that_is_drawn_twice_is_taken_once() {
        let sides = [line((0., 0.), (5., 0.)), line((5., 0.), (5., 5.)), line((5., 5.), (0., 0.))];
        let again = [sides[0].clone(), sides[0].reversed()];
        for (again, place) in again.iter().flat_map(|again| (0..4).map(move |k| (again, k))) {
            let mut lines = sides.to_vec();
            lines.insert(place, again.clone());
            let found = chains(&lines);
            assert!(found.len() == 1 && found[0].closed, "{place}: {found:?}");
            assert_eq!((found[0].parts.len(), found[0].n_repeats), (3, 1));
        }
        // All of it drawn three times, each line next to its repeats.
        let lines: Vec<Contour> =
            sides.iter().flat_map(|side| [side.clone(), side.reversed(), side.clone()]).collect();
        let found = chains(&lines);
        assert!(found.len() == 1 && found[0].closed && found[0].n_repeats == 6, "{found:?}");
    }

    #[test]
    fn squares_with_a_side_in_common_close_both() {
        // The common side is of two lines, and stands first, twice.
        let common = [line((1., 0.), (1., 0.5)), line((1., 0.5), (1., 1.))];
        let left = [line((1., 1.), (0., 1.)), line((0., 1.), (0., 0.)), line((0., 0.), (1., 0.))];
        let right = [line((1., 0.), (2., 0.)), line((2., 0.), (2., 1.)), line((2., 1.), (1., 1.))];
        let again = common.iter().map(Contour::reversed);
        let twice: Vec<Contour> =
            common.iter().cloned().zip(again).flat_map(|(a, b)| [a, b]).collect();
        let lines = [&twice[..], &left, &right].concat();
        let found = chains(&lines);
        let sizes: Vec<usize> = found.iter().map(|chain| chain.parts.len()).collect();
        assert!(found.iter().all(|chain| chain.closed && chain.n_repeats == 0), "{found:?}");
        assert_eq!(sizes, [5, 5]);
    }

    #[test]
    fn curves_between_the_same_ends_are_not_the_same() {
        let half = |bulge: f64| {
            let mut contour = Contour::new(Point::new(0., 0.));
            contour.bulge_to(Point::new(2., 0.), bulge);
            contour
        };
        let found = chains(&[half(1.0), half(-1.0), half(1.0).reversed(), half(1.0)]);
        assert!(found.len() == 1 && found[0].closed, "{found:?}");
        assert_eq!((found[0].parts.len(), found[0].n_repeats), (2, 2));
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
