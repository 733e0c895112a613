//! A path as the fire runs through it, and the values of measures along it.

use std::cell::{Cell, OnceCell};
use std::ops::Range;

use super::{Hierarchy, Measure, Step};
use crate::axis::{Accuracy, Curve, bisected, crossing};
use crate::domain::{Domain, Site};
use crate::geom::{Point, Rect, Visitor};

/// A path, or the part of one up to the root, seen from the leaves.
pub(in crate::ops) struct Limb<'h> {
    hierarchy: &'h Hierarchy<'h>,
    step: Step,
    left: Site,
    right: Site,
    /// The first corner of the boundary behind.
    first: u32,
    /// Whether there is any boundary behind.
    has_behind: bool,
    /// The disks at the start and at the end.
    disks: [(Point, f64); 2],
    /// Made when something between the two is asked for.
    curve: OnceCell<Curve>,
    /// The longest way to a leaf at its start.
    reach: f64,
    /// The squared distance of the farthest corner behind that was found last, and which it was: mostly
    /// it stays the same along the way.
    pub(super) far: Cell<(f64, u32)>,
    /// From where it was looked for.
    far_from: Cell<Option<Point>>,
    /// The squared distance of the farthest corner behind from the start; 0 at a leaf.
    behind: f64,
}

/// Corners up to which each is asked how far it is.
const FEW: u32 = 16;

impl Hierarchy<'_> {
    /// The path as the fire runs through it from one end, with what is known there.
    pub(in crate::ops) fn limb(&self, step: &Step, reach: f64, far: (f64, u32)) -> Limb<'_> {
        let (sides, has_behind) = self.sides(step);
        let [(left, first), (right, _)] = sides;
        Limb {
            hierarchy: self,
            step: *step,
            left,
            right,
            first,
            has_behind,
            disks: [self.disk(step.from), self.disk(step.to)],
            curve: OnceCell::new(),
            reach,
            far: Cell::new(far),
            far_from: Cell::new(None),
            behind: far.0,
        }
    }

    /// The squared distance of the farthest of the corners behind a path that burns, and which it is; one
    /// that was far before saves most of a search.
    #[inline]
    pub(in crate::ops) fn farthest_behind(
        &self,
        step: &Step,
        from: Point,
        known: u32,
    ) -> (f64, u32) {
        let ([(_, first), (right, _)], has_behind) = self.sides(step);
        if !has_behind {
            return (0.0, known);
        }
        self.farthest((first, right.index()), from, known)
    }

    /// The elements on both sides of a path as it burns, each with the first corner behind it, so that the boundary behind
    /// the path runs from the first one on to the second one; and whether there is any.
    #[inline]
    fn sides(&self, step: &Step) -> ([(Site, u32); 2], bool) {
        let sides = [step.left, step.right].map(|site| self.governors[site as usize]);
        match self.axis.accuracy {
            Accuracy::Exact => (sides, true),
            Accuracy::Sampled(_) => self.sampled_sides(sides),
        }
    }

    /// The same on an axis from samples, on which the sides of a short path may be those of another direction: the boundary
    /// behind is the shorter way between both, and none if they are one element, or on two walks.
    fn sampled_sides(&self, sides: [(Site, u32); 2]) -> ([(Site, u32); 2], bool) {
        let edges = self.ground.domain().edges();
        let [left, right] = sides.map(|(site, _)| site.index());
        let walk = |edge: u32| edges[edge as usize].walk;
        if left == right || walk(left) != walk(right) {
            return (sides, false);
        }
        let [on, back] = [self.length_between(left, right), self.length_between(right, left)];
        let [left, right] = sides;
        (if on <= back { [left, right] } else { [right, left] }, true)
    }

    /// The same for the corners from one to another one, along their walk.
    #[inline]
    fn farthest(&self, (first, last): (u32, u32), from: Point, known: u32) -> (f64, u32) {
        if first <= last && last - first < FEW {
            let domain = self.ground.domain();
            let mut farthest = Farthest { domain, from, distance2: 0.0, corner: first };
            (first..=last).for_each(|corner| farthest.item(corner));
            return (farthest.distance2, farthest.corner);
        }
        self.search_far((first, last), from, known)
    }

    /// The same for any number of them, or around the start of their walk.
    fn search_far(&self, (first, last): (u32, u32), from: Point, known: u32) -> (f64, u32) {
        let domain = self.ground.domain();
        let mut farthest = Farthest { domain, from, distance2: 0.0, corner: first };
        let ranges = if first <= last {
            [first..last + 1, 0..0]
        } else {
            let walk = domain.walks()[domain.edge(first).walk as usize];
            [first..walk.edges().end, walk.first..last + 1]
        };
        if ranges.iter().map(ExactSizeIterator::len).sum::<usize>() <= FEW as usize {
            ranges.into_iter().flatten().for_each(|corner| farthest.item(corner));
            return (farthest.distance2, farthest.corner);
        }
        // One that is far saves most of the search.
        let is_behind = ranges.iter().any(|range| range.contains(&known));
        farthest.item(if is_behind { known } else { last });
        for range in ranges.into_iter().filter(|range| !range.is_empty()) {
            self.tree().visit_within(range, &mut farthest);
        }
        (farthest.distance2, farthest.corner)
    }

    /// The length of a walk from the start of one edge on to that of another one.
    fn length_between(&self, from: u32, to: u32) -> f64 {
        let before = self.before();
        let way = before[to as usize] - before[from as usize];
        if to >= from {
            return way;
        }
        let domain = self.ground.domain();
        let walk = domain.walks()[domain.edge(from).walk as usize];
        let last = walk.edges().end - 1;
        way + before[last as usize] + domain.edge(last).length
    }
}

impl Limb<'_> {
    fn curve(&self) -> &Curve {
        self.curve.get_or_init(|| {
            let axis = self.hierarchy.axis;
            let site = |site: u32| axis.site_shape(site);
            let [from, to] = self.disks;
            Curve::between(&site(self.step.left), &site(self.step.right), from, to)
        })
    }

    #[inline]
    pub fn radius(&self, u: f64) -> f64 {
        if u <= 0.0 {
            self.disks[0].1
        } else if u >= 1.0 {
            self.disks[1].1
        } else {
            self.curve().radius_at(u)
        }
    }

    #[inline]
    fn centre(&self, u: f64) -> Point {
        if u <= 0.0 {
            self.disks[0].0
        } else if u >= 1.0 {
            self.disks[1].0
        } else {
            self.curve().point_at(u)
        }
    }

    /// The first parameter at which the radius is that large, if it is before an end.
    pub fn reaches(&self, radius: f64, end: f64) -> Option<f64> {
        if self.radius(0.0) >= radius {
            return Some(0.0);
        }
        let found = self.curve().parameters_at_radius(radius).into_iter().flatten();
        found.filter(|&u| u < end).min_by(f64::total_cmp)
    }

    /// The parameter of the neck, if it lies before an end.
    pub fn neck(&self, end: f64) -> Option<f64> {
        if self.is_monotone() {
            return None;
        }
        self.curve().neck().filter(|&neck| neck < end)
    }

    /// Whether it can be told without the curve that there is no neck: the line through a corner that is
    /// square to the other governor, on which the neck would lie, has both ends on one side.
    fn is_monotone(&self) -> bool {
        /// Many times the rounding error of the products and of the direction of an edge.
        const SURE: f64 = 1e-12;
        let domain = self.hierarchy.ground.domain();
        let [left, right] = [self.left, self.right].map(|site| domain.edge(site.index()));
        let (on_line, along) = match (self.left.is_edge(), self.right.is_edge()) {
            (true, true) => return true,
            (true, false) => (right.start, left.direction),
            (false, true) => (left.start, right.direction),
            (false, false) => {
                let way = right.start - left.start;
                (left.start + way * 0.5, way.perp())
            }
        };
        let [from, to] = self.disks.map(|(centre, _)| {
            let way = centre - on_line;
            let (x, y) = (along.x * way.x, along.y * way.y);
            if (x + y).abs() > SURE * (x.abs() + y.abs()) { x + y } else { f64::NAN }
        });
        from > 0.0 && to > 0.0 || from < 0.0 && to < 0.0
    }

    /// The first parameter at which a measure reaches a threshold, if it does so before an end.
    pub fn reached(&self, measure: Measure, threshold: f64, end: f64) -> f64 {
        // Between these places nearly every measure grows, falls or stays.
        let neck = self.neck(end);
        let middle = neck.filter(|&neck| self.value(measure, neck) >= threshold);
        let (low, high) = match (middle, neck) {
            (Some(neck), _) => (0.0, neck),
            (None, Some(neck)) => (neck, end),
            (None, None) => (0.0, end),
        };
        if let Some([before, _]) = self.bracketed(measure, threshold, [low, high]) {
            return before;
        }
        let at = |u: f64| low + (high - low) * u;
        // No more than the threshold is lost, unless that is reached at the very end.
        let last_below = |[before, after]: [f64; 2]| at(if after == 1.0 { after } else { before });
        let missing = |u: f64| self.value(measure, at(u)) - threshold;
        // What swallows a disk may be another one a little farther on.
        if measure == Measure::Scale {
            return at(bisected(missing));
        }
        last_below(crossing(missing))
    }

    /// Two places between two others, a few ulp of 1 apart, of which the first one is below a threshold of the
    /// excess or the relative excess and the second is not: by the closed form for the corner that is farthest.
    ///
    /// With that corner at the origin and `c` and `r` polynomials of degree two, `|c| = a + b r` is an equation
    /// of degree two as well on lines, and for `b = 1` on parabolas, where higher terms cancel.
    pub fn bracketed(
        &self,
        measure: Measure,
        threshold: f64,
        [low, high]: [f64; 2],
    ) -> Option<[f64; 2]> {
        /// Corners that are tried.
        const TRIES: u32 = 3;
        /// How far the two places are from the solution, in turn, for each ulp of the coordinates there.
        const MARGINS: [f64; 2] = [1.0, 16.0];
        let [start, slope, bend] = self.curve().polynomial()?;
        let is_line = self.left.is_edge() && self.right.is_edge();
        let (more, times) = match measure {
            Measure::Excess => (threshold, 1.0),
            Measure::RelativeExcess if is_line => (0.0, 1.0 + threshold),
            _ => return None,
        };
        let is_below = |u: f64| self.value(measure, u) < threshold;
        let squared = times * times;
        let mut far = self.far_corner(high);
        for _ in 0..TRIES {
            let from = start.0 - far;
            let radius = more + times * start.1;
            let constant = (from.norm() - radius) * (from.norm() + radius);
            let linear = 2.0 * (from.dot(slope.0) - times * radius * slope.1);
            let quadratic = slope.0.norm2() - squared * slope.1 * slope.1
                + 2.0 * (from.dot(bend.0) - times * radius * bend.1);
            // The root where it grows.
            let root = (linear * linear - 4.0 * quadratic * constant).sqrt();
            let u = if linear > 0.0 {
                -2.0 * constant / (linear + root)
            } else {
                (root - linear) / (2.0 * quadratic)
            };
            if !(low < u && u < high) {
                return None;
            }
            // The parameter changes by so much where the distance changes by an ulp of the coordinates.
            let (size, distance) = (far.x.abs().max(far.y.abs()), more + times * self.radius(u));
            let ulp = f64::EPSILON * (1.0 + 2.0 * distance * (size + distance) / root);
            let around = MARGINS.map(|margin| [u - margin * ulp, u + margin * ulp]);
            let inside = around.into_iter().take_while(|[a, b]| low < *a && *b < high);
            for [before, after] in inside {
                if is_below(before) && !is_below(after) {
                    return Some([before, after]);
                }
            }
            let next = self.far_corner(u);
            if next == far {
                return None;
            }
            far = next;
        }
        None
    }

    /// The farthest corner behind.
    fn far_corner(&self, u: f64) -> Point {
        self.farthest(self.centre(u));
        self.hierarchy.ground.domain().edge(self.far.get().1).start
    }

    /// The excess at the start, from the corners behind all that ends there.
    pub fn excess_at_start(&self) -> f64 {
        (self.behind.sqrt() - self.radius(0.0)).max(0.0)
    }

    /// The value at the start, as far as it may be larger than those of what ends there.
    pub fn first(&self, measure: Measure) -> f64 {
        match measure {
            // All corners behind are behind one of those.
            Measure::Excess => 0.0,
            Measure::RelativeExcess if self.radius(0.0) > 0.0 => 0.0,
            _ => self.value(measure, 0.0),
        }
    }

    /// The largest value up to a parameter, of those there and at the neck.
    pub fn most(&self, measure: Measure, end: f64) -> f64 {
        let at_neck = self.neck(end).map_or(0.0, |neck| self.value(measure, neck));
        self.value(measure, end).max(at_neck)
    }

    /// The value of a measure at a parameter, by itself.
    pub fn value(&self, measure: Measure, u: f64) -> f64 {
        let (centre, radius) = (self.centre(u), self.radius(u));
        let length = || self.curve().piece(0.0, u).length();
        let behind = || 2.0 * self.curve().growth_at(u).clamp(-1.0, 1.0).acos();
        let value = match measure {
            Measure::Excess => self.excess(u),
            Measure::RelativeExcess | Measure::Prominence if radius > 0.0 => {
                (self.farthest(centre) - radius) / radius
            }
            // Out of a corner it is the same all along.
            Measure::RelativeExcess | Measure::Prominence => self.value(measure, 1.0),
            Measure::Potential => self.boundary(centre),
            Measure::Chord => self.boundary(centre) - self.chord(centre),
            Measure::Circularity => self.boundary(centre) - radius * behind(),
            Measure::Erosion => {
                self.hierarchy.fire.times[self.step.from as usize] + length() - radius
            }
            Measure::Length => self.reach + length(),
            Measure::Angle => behind().min(std::f64::consts::TAU - behind()),
            Measure::HalfChord => radius * (0.5 * behind()).sin(),
            Measure::Radius => radius,
            Measure::Scale => self.hierarchy.swallowing().value(centre, radius),
        };
        value.max(0.0)
    }

    /// How far along its edge a governor is touched, or where it is, if a corner.
    fn foot(&self, site: Site, centre: Point) -> (f64, Point) {
        let edge = self.hierarchy.ground.domain().edge(site.index());
        if !site.is_edge() {
            return (0.0, edge.start);
        }
        let along = edge.direction.dot(centre - edge.start).clamp(0.0, edge.length);
        (along, edge.start + edge.direction * along)
    }

    fn chord(&self, centre: Point) -> f64 {
        (self.foot(self.left, centre).1 - self.foot(self.right, centre).1).norm()
    }

    /// The first and the last corner of the boundary behind, between the footpoints.
    pub fn corners(&self) -> (u32, u32) {
        (self.first, self.right.index())
    }

    /// The length of the boundary behind, between the footpoints.
    fn boundary(&self, centre: Point) -> f64 {
        if !self.has_behind {
            return self.chord(centre);
        }
        let (first, last) = self.corners();
        let domain = self.hierarchy.ground.domain();
        let rest = |site: Site| {
            let along = self.foot(site, centre).0;
            if site.is_edge() { domain.edge(site.index()).length - along } else { 0.0 }
        };
        rest(self.left)
            + self.hierarchy.length_between(first, last)
            + self.foot(self.right, centre).0
    }

    /// The distance of the farthest corner behind less the radius.
    #[inline]
    fn excess(&self, u: f64) -> f64 {
        (self.farthest(self.centre(u)) - self.radius(u)).max(0.0)
    }

    /// The distance of the farthest corner behind.
    #[inline]
    fn farthest(&self, centre: Point) -> f64 {
        if !self.has_behind {
            return 0.0;
        }
        if self.far_from.get() != Some(centre) {
            let known = self.far.get().1;
            self.far.set(self.hierarchy.farthest(self.corners(), centre, known));
            self.far_from.set(Some(centre));
        }
        self.far.get().0.sqrt()
    }
}

/// Looks for the farthest corner.
struct Farthest<'a> {
    domain: &'a Domain,
    from: Point,
    distance2: f64,
    corner: u32,
}

impl Visitor for Farthest<'_> {
    #[inline]
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        let (low, high) = (self.from - bounds.min, bounds.max - self.from);
        let far = Point::new(low.x.abs().max(high.x.abs()), low.y.abs().max(high.y.abs()));
        far.norm2() > self.distance2
    }

    #[inline]
    fn item(&mut self, corner: u32) {
        let distance2 = (self.domain.edge(corner).start - self.from).norm2();
        if distance2 > self.distance2 {
            (self.distance2, self.corner) = (distance2, corner);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Options;
    use crate::engine::path_tracing;

    /// A ring with corners at random distances, far from the origin.
    fn ring(n: u32) -> Vec<Point> {
        let mut state = 7_u64;
        let corner = |k: u32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let distance = 1.0 + (state >> 40) as f64 / f64::from(1 << 24);
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
            Point::new(500.0 + distance * cos, -20.0 + distance * sin)
        };
        (0..n).map(corner).collect()
    }

    #[test]
    fn closed_forms_find_the_place_where_a_threshold_is_reached() {
        let domain = Domain::from_polygons(&[vec![ring(300)]], &Options::default()).unwrap();
        let axis = path_tracing(&domain).unwrap();
        let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
        for measure in [Measure::Excess, Measure::RelativeExcess] {
            let (mut found, mut asked) = (0, 0);
            hierarchy.each_part(|part, limb| {
                if limb.neck(part.end).is_some() {
                    return;
                }
                let [low, high] = [0.0, part.end].map(|u| limb.value(measure, u));
                let threshold = 0.5 * (low + high);
                // Where it hardly grows rounding decides.
                if high - low < 1e-5 {
                    return;
                }
                asked += 1;
                let span = [0.0, part.end];
                let Some([before, after]) = limb.bracketed(measure, threshold, span) else {
                    return;
                };
                found += 1;
                let value = |u: f64| limb.value(measure, u);
                assert!(value(before) < threshold && threshold <= value(after));
                let exact = part.end * crossing(|u| value(part.end * u) - threshold)[0];
                assert!((before - exact).abs() < 1e-7, "{measure}: {before} {exact}");
            });
            assert!(asked > 100 && found * 5 > asked * 4, "{measure}: {found} of {asked}");
        }
    }
}
