//! The tree of boxes against itself.

use super::strip::Strip;
use super::tree::{Chain, FAN, Tree};
use crate::geom::{Point, Rect, orient2d};

/// Why a proof is not had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Doubt {
    Touch,
    Costly,
}

/// Work allowed for each edge looked at so far, and to begin with, in comparisons of nodes or
/// edges; good input takes 2 to 5.
const WORK: u64 = 24;
const FIRST_WORK: u64 = 4096;

/// Shows that no two edges share a point, but consecutive ones their corner. With `strips` around
/// the nodes they are used too.
pub(super) fn join(tree: &Tree, strips: &[Strip]) -> Result<(), Doubt> {
    let mut join = Join { tree, strips, work: 0, done: 0 };
    join.within(tree.height() - 1, 0)
}

struct Join<'a> {
    tree: &'a Tree<'a>,
    strips: &'a [Strip],
    work: u64,
    /// Leaves compared with themselves so far.
    done: u64,
}

impl Join<'_> {
    /// All pairs of edges of one node.
    fn within(&mut self, level: usize, node: usize) -> Result<(), Doubt> {
        if level == 0 {
            self.done += 1;
            let chain = self.tree.chain(node);
            let ring = &self.tree.rings.rings[chain.ring as usize];
            return alone(&chain, chain.len == ring.len as usize);
        }
        let children = self.tree.children(level, node);
        for child in children.clone() {
            self.within(level - 1, child)?;
        }
        for one in children.clone() {
            for other in one + 1..children.end {
                if self.meet(level - 1, one, other) {
                    self.between(level - 1, one, other)?;
                }
            }
        }
        Ok(())
    }

    /// All pairs of edges of two nodes that meet.
    fn between(&mut self, level: usize, one: usize, other: usize) -> Result<(), Doubt> {
        self.work += 1;
        if self.work > WORK * FAN as u64 * self.done + FIRST_WORK {
            return Err(Doubt::Costly);
        }
        if level == 0 {
            return self.chains(one, other);
        }
        let (near, far) = (*self.tree.bounds(level, other), *self.tree.bounds(level, one));
        let mut list = [0; FAN];
        let mut len = 0;
        for child in self.tree.children(level, other) {
            if self.tree.bounds(level - 1, child).meets(&far) {
                list[len] = child;
                len += 1;
            }
        }
        for a in self.tree.children(level, one) {
            if !self.tree.bounds(level - 1, a).meets(&near) {
                continue;
            }
            for &b in &list[..len] {
                if self.meet(level - 1, a, b) {
                    self.between(level - 1, a, b)?;
                }
            }
        }
        Ok(())
    }

    #[inline]
    fn meet(&self, level: usize, one: usize, other: usize) -> bool {
        let (a, b) = (self.tree.place(level, one), self.tree.place(level, other));
        self.tree.boxes[a].meets(&self.tree.boxes[b])
            && (self.strips.is_empty() || !self.strips[a].misses(&self.strips[b]))
    }

    /// All pairs of edges of two leaves.
    fn chains(&mut self, one: usize, other: usize) -> Result<(), Doubt> {
        let (a, b) = (self.tree.chain(one), self.tree.chain(other));
        let mut near = within_reach(&a, |p| code(self.tree.bounds(0, other), p));
        let mut far = within_reach(&b, |p| code(self.tree.bounds(0, one), p));
        if near == 0 || far == 0 {
            return Ok(());
        }
        if let (Some(strip), Some(own)) = (self.strips.get(other), self.strips.get(one)) {
            near &= within_reach(&a, |p| strip.code(p));
            far &= within_reach(&b, |p| own.code(p));
        }
        self.work += u64::from(near.count_ones() * far.count_ones());
        let after = self.precedes(&a, &b);
        let before = self.precedes(&b, &a);
        for j in bits(near) {
            for k in bits(far) {
                let consecutive =
                    after && j + 1 == a.len && k == 0 || before && k + 1 == b.len && j == 0;
                if !consecutive && touch(a.edge(j), b.edge(k)) {
                    return Err(Doubt::Touch);
                }
            }
        }
        Ok(())
    }

    /// Whether the second run starts where the first one ends, on the same ring.
    fn precedes(&self, a: &Chain, b: &Chain) -> bool {
        let ring = &self.tree.rings.rings[a.ring as usize];
        let after = a.first + a.len as u32;
        let next = if after == ring.first + ring.len { ring.first } else { after };
        a.ring == b.ring && next == b.first
    }
}

/// All pairs of edges of one run, which may be a whole ring.
fn alone(chain: &Chain, closed: bool) -> Result<(), Doubt> {
    let points = chain.points();
    let steps = points.windows(2).map(|w| w[1] - w[0]);
    let range = steps.fold(Rect::EMPTY, Rect::with);
    // Monotone: the edges follow one another along an axis. At most every other one is upright,
    // or level, so those that are not consecutive have no place in common.
    if 0.0 <= range.min.x || range.max.x <= 0.0 || 0.0 <= range.min.y || range.max.y <= 0.0 {
        return Ok(());
    }
    for j in 0..chain.len.saturating_sub(2) {
        let last = if closed && j == 0 { chain.len - 1 } else { chain.len };
        for k in j + 2..last {
            if touch(chain.edge(j), chain.edge(k)) {
                return Err(Doubt::Touch);
            }
        }
    }
    Ok(())
}

/// Whether two closed edges share a point.
#[inline]
fn touch((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let apart = |a: f64, b: f64, c: f64, d: f64| a.max(b) < c.min(d) || c.max(d) < a.min(b);
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

/// The edges of a run that may reach into a box, one bit each.
#[inline]
fn within_reach(chain: &Chain, code: impl Fn(Point) -> u8) -> u32 {
    let mut edges = 0;
    let mut before = code(chain.points()[0]);
    for (k, &p) in chain.points()[1..].iter().enumerate() {
        let at = code(p);
        edges |= u32::from(before & at == 0) << k;
        before = at;
    }
    edges
}

/// Beyond which sides of a box a point lies, one bit each.
#[inline]
fn code(bounds: &Rect, p: Point) -> u8 {
    u8::from(p.x < bounds.min.x)
        | u8::from(p.x > bounds.max.x) << 1
        | u8::from(p.y < bounds.min.y) << 2
        | u8::from(p.y > bounds.max.y) << 3
}

fn bits(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let first = set.trailing_zeros();
        (set != 0).then(|| {
            set &= set - 1;
            first as usize
        })
    })
}
