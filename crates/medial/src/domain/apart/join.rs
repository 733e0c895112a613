//! The tree of boxes against itself.

use super::node::{ALL, Bounds, FAN};
use super::strip::{Lines, Strip, WidePowers};
use super::tree::{Item, Tree};
use crate::geom::{Point, orient2d};

/// Why a proof is not had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Doubt {
    Touch,
    Costly,
}

/// Work allowed for each leaf looked at so far, with boxes or with strips, and to begin with, in
/// comparisons of nodes or edges.
///
/// With boxes, coasts take 1, mazes 6, and runs of many edges side by side up to 16 to a leaf; with
/// strips, stars of needles take 12. Much more would take as long as the sweep.
const BOX_WORK: u64 = 48;
const STRIP_WORK: u64 = 24;
const FIRST_WORK: u64 = 4096;

/// Shows that no two edges share a point, but consecutive ones their corner; says which links share
/// a point with an edge, their own ends apart. With `strips` around the nodes they are used too.
pub(super) fn join(tree: &Tree, strips: &[Strip]) -> Result<Vec<bool>, Doubt> {
    let powers = std::array::from_fn(|k| 1 << k);
    let broken = vec![false; tree.links.len()];
    let allowed = if strips.is_empty() { BOX_WORK } else { STRIP_WORK };
    let mut join = Join { tree, strips, powers, broken, allowed, work: 0, done: 0 };
    join.within(tree.height() - 1, 0)?;
    Ok(join.broken)
}

struct Join<'a> {
    tree: &'a Tree<'a>,
    strips: &'a [Strip],
    powers: WidePowers,
    broken: Vec<bool>,
    /// Work for each leaf.
    allowed: u64,
    work: u64,
    /// Leaves compared with themselves so far.
    done: u64,
}

impl Join<'_> {
    /// All pairs of edges of one node.
    fn within(&mut self, level: usize, place: usize) -> Result<(), Doubt> {
        let (node, powers) = (self.tree.node(level, place), &self.tree.powers);
        if level == 0 {
            self.done += 1;
            if !self.strips.is_empty()
                && let Some(chain) = self.tree.chain(place)
            {
                return self.alone(place, &Lines::new(&chain));
            }
            let followers = self.tree.followers(place);
            let mut met = 0;
            for j in 0..FAN - 1 {
                let later = 0xfe << j & !(followers & 2 << j);
                met |= row(j, node.meets(&node.child(j), powers) & later);
            }
            for (j, k) in pairs(met) {
                self.pair((place, j), (place, k))?;
            }
            return Ok(());
        }
        let full = node.meets(&self.tree.bounds(), powers);
        for j in bits(full) {
            self.within(level - 1, place * FAN + j)?;
        }
        let mut met = 0;
        for j in bits(full) {
            met |= row(j, node.meets(&node.child(j), powers) & (0xfe << j));
        }
        for (j, k) in pairs(met) {
            let (one, other) = (place * FAN + j, place * FAN + k);
            self.between(level - 1, (one, &node.child(j)), (other, &node.child(k)))?;
        }
        Ok(())
    }

    /// All pairs of edges of two nodes whose boxes meet.
    fn between(
        &mut self,
        level: usize,
        (one, own): (usize, &Bounds),
        (other, bounds): (usize, &Bounds),
    ) -> Result<(), Doubt> {
        self.work += 1;
        if self.work > self.allowed * self.done + FIRST_WORK {
            return Err(Doubt::Costly);
        }
        if !self.strips.is_empty() && self.separated((level, one), (level, other)) {
            return Ok(());
        }
        if level == 0
            && !self.strips.is_empty()
            && let Some(chains) = self.tree.chain(one).zip(self.tree.chain(other))
        {
            return self.chains((one, &chains.0), (other, &chains.1));
        }
        let (a, b) = (self.tree.node(level, one), self.tree.node(level, other));
        let powers = &self.tree.powers;
        let mut near = a.meets(bounds, powers);
        if near == 0 {
            return Ok(());
        }
        let mut far = ALL;
        if level > 0 && !self.strips.is_empty() {
            near = self.reaching((level, one), near, (level, other));
            far = self.reaching((level, other), b.meets(own, powers), (level, one));
        }
        let mut met = 0;
        for j in bits(near) {
            met |= row(j, b.meets(&a.child(j), powers) & far);
        }
        if level == 0 {
            if other == one + 1 {
                met &= !row(FAN - 1, self.tree.followers(other) & 1);
            }
            for (j, k) in pairs(met) {
                self.pair((one, j), (other, k))?;
            }
            return Ok(());
        }
        for (j, k) in pairs(met) {
            let (one, other) = (one * FAN + j, other * FAN + k);
            self.between(level - 1, (one, &a.child(j)), (other, &b.child(k)))?;
        }
        Ok(())
    }

    /// Of the given children of a node, those whose strips meet that of another node.
    fn reaching(&self, (level, node): (usize, usize), set: u32, other: (usize, usize)) -> u32 {
        let meets = |&k: &usize| !self.separated((level - 1, node * FAN + k), other);
        bits(set).filter(meets).fold(0, |set, k| set | 1 << k)
    }

    /// Whether the strips of two nodes, each given by its level and number, are apart.
    fn separated(&self, one: (usize, usize), other: (usize, usize)) -> bool {
        let strip = |node: (usize, usize)| &self.strips[self.tree.place(node.0, node.1)];
        strip(one).misses(strip(other))
    }

    /// Two items, each given by its leaf and its number there.
    fn pair(&mut self, one: (usize, usize), other: (usize, usize)) -> Result<(), Doubt> {
        let (a, b) = (self.tree.item(one.0, one.1), self.tree.item(other.0, other.1));
        if a.end == b.start || b.end == a.start {
            return Ok(());
        }
        self.work += 1;
        match (a.is_link, b.is_link) {
            (false, false) if touch(self.tree.ends(a), self.tree.ends(b)) => Err(Doubt::Touch),
            (true, false) => self.check_link(a, b),
            (false, true) => self.check_link(b, a),
            _ => Ok(()),
        }
    }

    /// Breaks a link that shares a point with an edge, unless it starts or ends there.
    fn check_link(&mut self, own: Item, edge: Item) -> Result<(), Doubt> {
        let broken = &mut self.broken[own.rank as usize];
        if edge.start != own.start && edge.end != own.end && !*broken {
            *broken = touch(self.tree.ends(own), self.tree.ends(edge));
        }
        Ok(())
    }

    /// All pairs of edges of two leaves that hold eight edges of one ring each, with strips.
    fn chains(
        &mut self,
        (one, a): (usize, &[Point; FAN + 1]),
        (other, b): (usize, &[Point; FAN + 1]),
    ) -> Result<(), Doubt> {
        let (a, b) = (Lines::new(a), Lines::new(b));
        let near = a.within_reach(&self.strips[other], &self.powers);
        if near == 0 {
            return Ok(());
        }
        let far = b.within_reach(&self.strips[one], &self.powers);
        if far == 0 {
            return Ok(());
        }
        for j in bits(near) {
            for k in bits(far & b.across(a.edge(j), &self.powers)) {
                self.pair((one, j), (other, k))?;
            }
        }
        Ok(())
    }

    /// All pairs of edges of one leaf, all of one ring.
    fn alone(&mut self, leaf: usize, lines: &Lines) -> Result<(), Doubt> {
        for j in 0..FAN - 2 {
            let later = 0xfc << j;
            for k in bits(lines.across(lines.edge(j), &self.powers) & later) {
                self.pair((leaf, j), (leaf, k))?;
            }
        }
        Ok(())
    }
}

/// Whether any two edges of a ring share a point, but consecutive ones their corner; pair by pair.
pub(super) fn touches_itself(ring: &[Point]) -> bool {
    let n = ring.len();
    let edge = |k: usize| (ring[k], ring[if k + 1 < n { k + 1 } else { 0 }]);
    (0..n).any(|j| {
        // The last edge and the first one are consecutive.
        let end = if j == 0 { n - 1 } else { n };
        let own = edge(j);
        (j + 2..end).any(|k| touch(own, edge(k)))
    })
}

/// Whether two closed edges share a point.
#[inline]
fn touch((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    // All of one on one side of all of the other.
    let apart = |a: f64, b: f64, c: f64, d: f64| {
        a < c && a < d && b < c && b < d || a > c && a > d && b > c && b > d
    };
    !apart(a.x, b.x, c.x, d.x)
        && !apart(a.y, b.y, c.y, d.y)
        && !one_side((a, b), (c, d))
        && !one_side((c, d), (a, b))
}

/// Whether both ends of the second edge lie on one side of the line of the first one.
#[inline]
fn one_side((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let (from, to) = (orient2d(a, b, c), orient2d(a, b, d));
    from > 0.0 && to > 0.0 || from < 0.0 && to < 0.0
}

/// What item `j` meets, as a row of all pairs.
#[inline]
fn row(j: usize, set: u32) -> u64 {
    u64::from(set) << (FAN * j)
}

/// The pairs of a set of rows: they are collected first, as few tests for an end are foreseen.
#[inline]
fn pairs(mut met: u64) -> impl Iterator<Item = (usize, usize)> {
    std::iter::from_fn(move || {
        let first = met.trailing_zeros() as usize;
        (met != 0).then(|| {
            met &= met - 1;
            (first / FAN, first % FAN)
        })
    })
}

/// The numbers of the bits of a set.
pub(super) fn bits(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let first = set.trailing_zeros();
        (set != 0).then(|| {
            set &= set - 1;
            first as usize
        })
    })
}
