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
use super::rest::Rest;
use crate::axis::crossing;

/// A path, or the part of one up to the root, in the direction in which it burns.
#[derive(Clone, Copy)]
struct Stretch {
    /// The relative excess where it starts, or at its neck, if that is less.
    start: f64,
    /// That where it ends.
    end: f64,
    /// The parameter where it would be cut, as far as it is cut at its own ends or neck; 0 where it is not.
    cut: f64,
    /// The excess there.
    excess_at_cut: f64,
    /// That where it ends.
    excess: f64,
    /// The least relative excess between its end and the root.
    beyond: f64,
}

impl Stretch {
    /// Where nothing burns.
    const NONE: Self = Self {
        start: f64::INFINITY,
        end: f64::INFINITY,
        cut: 0.0,
        excess_at_cut: 0.0,
        excess: 0.0,
        beyond: f64::INFINITY,
    };

    fn at_end(&self) -> f64 {
        self.end.min(self.beyond)
    }

    fn at_start(&self) -> f64 {
        self.start.min(self.at_end())
    }
}

/// The stretches of all paths.
struct Stretches {
    /// Of each path in the direction in which it burns; of one with a root from its start to there.
    first: Vec<Stretch>,
    /// Paths with a root, the parameter of that, and the stretch from the end.
    rooted: Vec<(u32, f64, Stretch)>,
}

impl Hierarchy<'_> {
    /// The stretches of all paths, with the places where a threshold would cut them.
    fn stretches(&self, threshold: f64) -> Stretches {
        let mut all =
            Stretches { first: vec![Stretch::NONE; self.fire.ways.len()], rooted: Vec::new() };
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
                at(crossing(|u| value(at(u)) - threshold)[1])
            });
            let excess_at_cut = if cut > 0.0 { limb.value(Measure::Excess, cut) } else { 0.0 };
            if cut > 0.0 {
                // What comes next starts from the farthest corner that was found last.
                value(part.end);
            }
            let stretch = Stretch {
                start: start.min(neck),
                end,
                cut,
                excess_at_cut,
                excess: end * limb.radius(part.end),
                beyond: f64::INFINITY,
            };
            match part.root {
                Some(root) if !part.forwards => all.rooted.push((part.path, root, stretch)),
                _ => all.first[part.path as usize] = stretch,
            }
            0.0
        });
        // From the roots outwards: each keypoint has one path that leads on.
        let mut least = vec![f64::INFINITY; self.fire.times.len()];
        for (path, _, second) in &all.rooted {
            let [from, to] = self.axis.paths().ends(*path);
            least[from as usize] = all.first[*path as usize].at_start();
            least[to as usize] = second.at_start();
        }
        for &path in self.fire.order.iter().rev() {
            let [from, to] = self.axis.paths().ends(path);
            let (from, to) = match self.fire.ways[path as usize] {
                Way::Forwards => (from, to),
                Way::Backwards => (to, from),
                Way::Both(_) | Way::Never => continue,
            };
            let stretch = &mut all.first[path as usize];
            stretch.beyond = least[to as usize];
            least[from as usize] = stretch.at_start();
        }
        all
    }

    /// The values along all paths.
    pub(super) fn prominences(&self, kept: impl Fn(u32) -> [f64; 2]) -> Vec<Span> {
        let Stretches { first, rooted } = self.stretches(0.0);
        // Where it was cut the rest is enough.
        let at_start = |stretch: &Stretch, is_cut: bool| {
            if is_cut { stretch.at_end() } else { stretch.at_start() }
        };
        let span = |(path, stretch): (u32, &Stretch)| {
            let [low, high] = kept(path);
            let end = stretch.at_end();
            match self.fire.ways[path as usize] {
                Way::Backwards => {
                    Span { start: end, end: at_start(stretch, high < 1.0), most: end }
                }
                // What lies beyond a root comes below.
                _ => Span { start: at_start(stretch, low > 0.0), end, most: end },
            }
        };
        let mut spans: Vec<Span> = (0..).zip(&first).map(span).collect();
        for (path, _, second) in &rooted {
            let [_, high] = kept(*path);
            let span = &mut spans[*path as usize];
            span.end = at_start(second, high < 1.0);
            span.most = span.most.max(second.at_end());
        }
        spans
    }

    /// What is left if all that is less prominent than a threshold is removed.
    pub(super) fn without_less_prominent(&self, threshold: f64) -> (Rest<'_>, Vec<(u32, f64)>) {
        let mut rest = Rest::of(self.axis);
        let mut lost: Vec<(u32, f64)> = Vec::new();
        let Stretches { first, rooted } = self.stretches(threshold);
        let mut remove = |path: u32, stretch: &Stretch, forwards: bool, root: Option<f64>| {
            let along = |u: f64| if forwards { u } else { 1.0 - u };
            if stretch.at_end() < threshold {
                match root {
                    Some(_) => rest.error = rest.error.max(stretch.excess),
                    None => {
                        let [from, to] = self.axis.paths().ends(path);
                        lost.push((if forwards { to } else { from }, stretch.excess));
                    }
                }
                // Up to one root from both sides.
                rest.cut(path, forwards, root.unwrap_or_else(|| along(1.0)));
            } else if stretch.at_start() < threshold {
                rest.error = rest.error.max(stretch.excess_at_cut);
                rest.cut(path, forwards, along(stretch.cut));
            }
        };
        for (path, stretch) in (0..).zip(&first) {
            match self.fire.ways[path as usize] {
                Way::Forwards => remove(path, stretch, true, None),
                Way::Backwards => remove(path, stretch, false, None),
                Way::Both(_) | Way::Never => {}
            }
        }
        for (path, root, second) in &rooted {
            remove(*path, &first[*path as usize], true, Some(*root));
            remove(*path, second, false, Some(*root));
        }
        (rest, lost)
    }
}
