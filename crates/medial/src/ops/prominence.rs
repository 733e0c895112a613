//! Relative prominence after Ho and Dyer [HD86]: how far what is behind a disk stands out of it, as a share
//! of its radius.
//!
//! # Contract
//! A limb is judged where it grows out of the shape: a bump on a thick part is less prominent than the same
//! bump on a thin one, however sharp its tip. So the value of a point is the least one on the way from there
//! to the root of its tree, and what is removed always includes all behind it.
//!
//! # Method
//! The relative excess is taken at both ends of each path and at its neck, from the leaves inwards; then the
//! least ones are handed on from the roots outwards.

use super::fire::Way;
use super::hierarchy::{Hierarchy, Span};
use super::measure::Measure;
use super::rest::{Pruned, Rest};
use crate::axis::crossing;

/// A path, or the part of one up to the root, in the direction in which it burns.
#[derive(Clone, Copy)]
struct Stretch {
    /// The relative excess where it starts, at its neck, if it has one, and where it ends.
    start: f64,
    neck: f64,
    end: f64,
    /// The parameters where it would be cut, and of its end.
    cut: f64,
    last: f64,
    /// The excess at both.
    excess_at_cut: f64,
    excess: f64,
    /// The least relative excess between its end and the root.
    beyond: f64,
}

impl Stretch {
    fn at_end(&self) -> f64 {
        self.end.min(self.beyond)
    }

    fn at_start(&self) -> f64 {
        self.start.min(self.neck).min(self.at_end())
    }
}

impl Hierarchy<'_> {
    /// The stretches of each path, from its start and from its end, with the places where a threshold would
    /// cut them.
    fn stretches(&self, threshold: f64) -> Vec<[Option<Stretch>; 2]> {
        let mut all = vec![[None; 2]; self.fire.ways.len()];
        self.burn(f64::INFINITY, |part, limb, _| {
            let value = |u: f64| limb.value(Measure::RelativeExcess, u);
            let at_neck = limb.neck(part.end);
            let neck = at_neck.map_or(f64::INFINITY, value);
            let end = value(part.end);
            let radius = limb.radius(0.0);
            // Out of a corner it is the same all along.
            let start = if radius > 0.0 { limb.excess_at_start() / radius } else { end };
            // The last place where it is too little, if it is enough at the end.
            let between = match at_neck {
                Some(place) if neck < threshold => Some((place, part.end)),
                Some(place) if start < threshold => Some((0.0, place)),
                None if start < threshold => Some((0.0, part.end)),
                _ => None,
            };
            let cut = between.filter(|_| end >= threshold).map_or(0.0, |(low, high)| {
                let at = |u: f64| low + (high - low) * u;
                at(crossing(|u| value(at(u)) - threshold))
            });
            let excess_at_cut = if cut > 0.0 { limb.value(Measure::Excess, cut) } else { 0.0 };
            if cut > 0.0 {
                // What comes next starts from the farthest corner that was found last.
                value(part.end);
            }
            all[part.path as usize][usize::from(!part.forwards)] = Some(Stretch {
                start,
                neck,
                end,
                cut,
                last: part.end,
                excess_at_cut,
                excess: end * limb.radius(part.end),
                beyond: f64::INFINITY,
            });
            0.0
        });
        // From the roots outwards: each keypoint has one path that leads on.
        let mut least = vec![f64::INFINITY; self.fire.times.len()];
        let is_both = |path: u32| matches!(self.fire.ways[path as usize], Way::Both(_));
        let (both, others): (Vec<u32>, Vec<u32>) =
            self.fire.order.iter().partition(|&&path| is_both(path));
        for path in both.into_iter().chain(others.into_iter().rev()) {
            let ends = self.axis.paths().at(path);
            for (part, (from, to)) in
                [(ends.from, ends.to), (ends.to, ends.from)].into_iter().enumerate()
            {
                let Some(stretch) = &mut all[path as usize][part] else { continue };
                stretch.beyond = if is_both(path) { f64::INFINITY } else { least[to as usize] };
                least[from as usize] = stretch.at_start();
            }
        }
        all
    }

    /// The values along all paths.
    pub(super) fn prominences(&self, kept: impl Fn(u32) -> [f64; 2]) -> Vec<Span> {
        let nothing = Span { start: f64::INFINITY, end: f64::INFINITY, most: f64::INFINITY };
        let span = |(path, parts): (u32, [Option<Stretch>; 2])| {
            let [low, high] = kept(path);
            // Where it was cut the rest is enough.
            let at_start = |stretch: Stretch, is_cut: bool| {
                if is_cut { stretch.at_end() } else { stretch.at_start() }
            };
            match parts {
                [None, None] => nothing,
                [Some(one), None] => {
                    let end = one.at_end();
                    Span { start: at_start(one, low > 0.0), end, most: end }
                }
                [None, Some(one)] => {
                    let start = one.at_end();
                    Span { start, end: at_start(one, high < 1.0), most: start }
                }
                [Some(one), Some(other)] => Span {
                    start: at_start(one, low > 0.0),
                    end: at_start(other, high < 1.0),
                    most: one.at_end().max(other.at_end()),
                },
            }
        };
        (0..).zip(self.stretches(0.0)).map(span).collect()
    }

    /// What is left if all that is less prominent than a threshold is removed.
    pub(super) fn without_less_prominent(&self, threshold: f64) -> Pruned {
        let mut rest = Rest::of(self.axis);
        let mut lost: Vec<(u32, f64)> = Vec::new();
        for (path, parts) in (0..).zip(self.stretches(threshold)) {
            let ends = self.axis.paths().at(path);
            let has_root = parts.iter().all(Option::is_some);
            for (part, stretch) in parts.into_iter().enumerate() {
                let Some(stretch) = stretch else { continue };
                let forwards = part == 0;
                let along = |u: f64| if forwards { u } else { 1.0 - u };
                if stretch.at_end() < threshold {
                    if has_root {
                        rest.error = rest.error.max(stretch.excess);
                    } else {
                        lost.push((if forwards { ends.to } else { ends.from }, stretch.excess));
                    }
                    // Up to one root from both sides.
                    let root = parts[0].filter(|_| has_root).map(|first| first.last);
                    rest.cut(path, forwards, root.unwrap_or_else(|| along(stretch.last)));
                } else if stretch.at_start() < threshold {
                    rest.error = rest.error.max(stretch.excess_at_cut);
                    rest.cut(path, forwards, along(stretch.cut));
                }
            }
        }
        rest.finish(&self.fire.roots, &lost)
    }
}
