use std::ops::Range;

use super::Point;

/// An axis-parallel box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Rect {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self {
        min: Point::new(f64::INFINITY, f64::INFINITY),
        max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The smallest box that holds this one and `p`.
    #[inline]
    #[must_use]
    pub fn with(self, p: Point) -> Self {
        Self {
            min: Point::new(self.min.x.min(p.x), self.min.y.min(p.y)),
            max: Point::new(self.max.x.max(p.x), self.max.y.max(p.y)),
        }
    }

    /// The smallest box that holds both.
    #[inline]
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: Point::new(self.min.x.min(other.min.x), self.min.y.min(other.min.y)),
            max: Point::new(self.max.x.max(other.max.x), self.max.y.max(other.max.y)),
        }
    }

    /// The squared distance from `p`, rounded; 0 inside.
    #[inline]
    #[must_use]
    pub fn distance2(&self, p: Point) -> f64 {
        let dx = (self.min.x - p.x).max(p.x - self.max.x).max(0.0);
        let dy = (self.min.y - p.y).max(p.y - self.max.y).max(0.0);
        dx * dx + dy * dy
    }

    /// Whether the closed box holds a point.
    #[inline]
    #[must_use]
    pub fn holds(&self, p: Point) -> bool {
        self.min.x <= p.x && p.x <= self.max.x && self.min.y <= p.y && p.y <= self.max.y
    }

    /// Whether the closed boxes share a point.
    #[inline]
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }
}

/// Children of a node, and items of a leaf.
const FAN: usize = 1 << FAN_BITS;
const FAN_BITS: u32 = 3;

/// What a walk through a [`BoundsTree`] does with what it meets.
pub trait Visitor {
    /// Whether any of these items, all inside the box, is of interest.
    fn enters(&self, bounds: &Rect, items: Range<u32>) -> bool;
    /// Takes one item of a leaf that was entered.
    fn item(&mut self, item: u32);
}

/// A packed tree of boxes over items in their given order, eight to a node.
///
/// Edges come in boundary order, so neighbours share leaves without any sorting.
#[derive(Clone, Debug)]
pub struct BoundsTree {
    n_items: u32,
    /// First item of the tree in the caller's numbering.
    base: u32,
    /// Boxes level by level, leaves first; box k of a level covers boxes 8k to 8k + 7 below.
    boxes: Vec<Rect>,
    /// Where each level starts.
    levels: Vec<u32>,
}

impl BoundsTree {
    /// Builds the tree over items `base` to `base + n_items - 1` with the given bounds.
    #[must_use]
    pub fn new(base: u32, n_items: u32, bounds: impl Fn(u32) -> Rect) -> Self {
        let mut boxes: Vec<Rect> = Vec::with_capacity(n_items as usize / (FAN - 1) + 8);
        let mut levels = vec![0];
        let mut item = 0;
        while item < n_items {
            let last = (item + FAN as u32).min(n_items);
            boxes.push((item..last).fold(Rect::EMPTY, |b, k| b.union(bounds(base + k))));
            item = last;
        }
        let mut first = 0;
        while boxes.len() - first > 1 {
            let last = boxes.len();
            levels.push(last as u32);
            let mut k = first;
            while k < last {
                let end = (k + FAN).min(last);
                let cover = boxes[k..end].iter().fold(Rect::EMPTY, |b, r| b.union(*r));
                boxes.push(cover);
                k = end;
            }
            first = last;
        }
        Self { n_items, base, boxes, levels }
    }

    /// The numbers of the items.
    #[must_use]
    pub fn items(&self) -> Range<u32> {
        self.base..self.base + self.n_items
    }

    /// The box of all items.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.boxes.last().copied().unwrap_or(Rect::EMPTY)
    }

    /// Shows `visitor` every item whose boxes it enters, in a fixed order.
    #[inline]
    pub fn visit(&self, visitor: &mut impl Visitor) {
        // A node is (level, number in its level). Depth at most 11 levels of 7 waiting siblings.
        let mut stack = [(0_u8, 0_u32); 96];
        let mut top = 1;
        stack[0] = ((self.levels.len() - 1) as u8, 0);
        if self.n_items == 0 {
            return;
        }
        while top > 0 {
            top -= 1;
            let (level, number) = stack[top];
            let bounds = &self.boxes[(self.levels[level as usize] + number) as usize];
            let width = (FAN as u64).pow(u32::from(level) + 1);
            let start = self.base + (u64::from(number) * width) as u32;
            let end = (u64::from(start) + width).min(u64::from(self.base + self.n_items)) as u32;
            if !visitor.enters(bounds, start..end) {
                continue;
            }
            let first = number * FAN as u32;
            if level == 0 {
                for k in first..(first + FAN as u32).min(self.n_items) {
                    visitor.item(self.base + k);
                }
            } else {
                let below = level as usize - 1;
                let count = self.levels[below + 1] - self.levels[below];
                for k in (first..(first + FAN as u32).min(count)).rev() {
                    stack[top] = (below as u8, k);
                    top += 1;
                }
            }
        }
    }

    /// The same for the items of a range alone, without a way from the root to them.
    #[inline]
    pub fn visit_within(&self, items: Range<u32>, visitor: &mut impl Visitor) {
        let (mut low, mut high) = (items.start - self.base, items.end - self.base);
        let fan = FAN as u32;
        // What fills no node of the level above, at both ends, then that level.
        while low < high && !low.is_multiple_of(fan) {
            visitor.item(self.base + low);
            low += 1;
        }
        while low < high && !high.is_multiple_of(fan) {
            high -= 1;
            visitor.item(self.base + high);
        }
        for level in 0..self.levels.len() {
            (low, high) = (low / fan, high / fan);
            while low < high && !low.is_multiple_of(fan) {
                self.descend(level, low, visitor);
                low += 1;
            }
            while low < high && !high.is_multiple_of(fan) {
                high -= 1;
                self.descend(level, high, visitor);
            }
            if low == high {
                return;
            }
        }
    }

    /// Shows a node that is full, and what is below.
    fn descend(&self, level: usize, number: u32, visitor: &mut impl Visitor) {
        let items =
            [number, number + 1].map(|k| self.base + (k << (FAN_BITS * (level as u32 + 1))));
        let bounds = &self.boxes[(self.levels[level] + number) as usize];
        if !visitor.enters(bounds, items[0]..items[1]) {
            return;
        }
        let below = FAN as u32 * number..FAN as u32 * (number + 1);
        match level {
            0 => below.for_each(|item| visitor.item(self.base + item)),
            _ => below.for_each(|node| self.descend(level - 1, node, visitor)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Near {
        at: Point,
        found: Vec<u32>,
    }

    impl Visitor for Near {
        fn enters(&self, bounds: &Rect, items: Range<u32>) -> bool {
            assert!(!items.is_empty());
            bounds.distance2(self.at) <= 4.0
        }
        fn item(&mut self, item: u32) {
            self.found.push(item);
        }
    }

    #[test]
    fn a_visit_meets_every_item_within_reach() {
        for n in [1_u32, 7, 8, 9, 64, 65, 1000] {
            let tree = BoundsTree::new(10, n, |k| {
                Rect::EMPTY.with(Point::new(f64::from(k), f64::from(k % 3)))
            });
            for at in 0..n + 20 {
                let at = Point::new(f64::from(at), 1.0);
                let mut near = Near { at, found: Vec::new() };
                tree.visit(&mut near);
                for k in 10..10 + n {
                    let p = Point::new(f64::from(k), f64::from(k % 3));
                    if (p - at).norm2() <= 4.0 {
                        assert!(near.found.contains(&k));
                    }
                }
                assert!(near.found.is_sorted());
            }
        }
    }

    #[test]
    fn a_visit_within_a_range_meets_its_items_once() {
        struct All(Vec<u32>);

        impl Visitor for All {
            fn enters(&self, bounds: &Rect, items: Range<u32>) -> bool {
                let [first, last] = [items.start, items.end - 1].map(f64::from);
                assert_eq!((bounds.min.x, bounds.max.x), (first, last));
                true
            }
            fn item(&mut self, item: u32) {
                self.0.push(item);
            }
        }

        for n in [1_u32, 7, 8, 9, 64, 65, 512, 700] {
            let corner = |k: u32| Rect::EMPTY.with(Point::new(f64::from(k), 0.0));
            let tree = BoundsTree::new(10, n, corner);
            for first in 10..10 + n {
                for last in (first..10 + n).step_by(1 + n as usize / 50).chain([9 + n]) {
                    let mut all = All(Vec::new());
                    tree.visit_within(first..last + 1, &mut all);
                    all.0.sort_unstable();
                    assert!(all.0.into_iter().eq(first..last + 1), "{n} {first} {last}");
                }
            }
        }
    }
}
