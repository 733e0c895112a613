//! Thin walls: where a shape is between two widths, as lines that are as wide as the shape.
//!
//! # Contract
//! Lines run along the axis where its width is at least the one and at most the other limit, which is decided
//! exactly; they end at its junctions, and where it gets wider or narrower. Drawn with a round pen as wide as
//! the shape they fill it there. What leads into a corner, or to where the shape gets too narrow, and reaches
//! out of the pen that is left by little, is left out. A thin part of which nothing else would be left is one
//! point. O(n).
//!
//! Slicers call this the medial axis of a shape, or its gap fill.
//!
//! # Method
//! Along a path the radius is convex: what is no wider than a limit is one piece of it, what is no narrower
//! two at most. Pieces that meet make a graph; of it loose ends are taken away, up to the next place where not
//! two pieces meet, and again what is loose then; and what meets in twos in the end is joined.

use super::centerline::Widths;
use super::groups::Groups;
use super::hierarchy::HierarchyError;
use super::radii::{Limit, Radii};
use crate::axis::{Curve, KeypointKind, MedialAxis};
use crate::domain::Domain;
use crate::geom::Point;

/// Which walls are thin; lengths are in units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallOptions {
    /// The least width.
    pub min: f64,
    /// The greatest width.
    pub max: f64,
    /// Loose ends are left out that reach less than this out of a pen that stays, measured along the axis.
    pub ends: f64,
}

impl WallOptions {
    /// Walls between two widths, without loose ends that reach out by less than a quarter of the greater one:
    /// right-angled corners do by a fifth of the width.
    #[must_use]
    pub const fn between(min: f64, max: f64) -> Self {
        Self { min, max, ends: 0.25 * max }
    }
}

/// A thin wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// The curves that it consists of, each starting where the one before ends; a single one from a point to
    /// itself for a wall that is one point.
    pub curves: Vec<Curve>,
}

impl Wall {
    /// Its length.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.curves.iter().map(Curve::length).sum()
    }

    /// Whether it ends where it starts.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let ends = self.curves.first().map(Curve::from).zip(self.curves.last().map(Curve::to));
        self.length() > 0.0 && ends.is_some_and(|(from, to)| from == to)
    }

    /// The widths along it.
    #[must_use]
    pub fn widths(&self) -> Widths {
        Widths::along(&self.curves)
    }

    /// Its points and the width at each, so that neither the line nor the width along it is farther than a
    /// tolerance from what is drawn between them.
    #[must_use]
    pub fn polyline(&self, tolerance: f64) -> Vec<(Point, f64)> {
        let mut points: Vec<(Point, f64)> = Vec::new();
        for (k, curve) in self.curves.iter().enumerate() {
            // The width is twice the radius.
            let drawn = curve.polyline_in_space(0.5 * tolerance).into_iter();
            points.extend(drawn.skip(usize::from(k > 0)).map(|(p, radius)| (p, 2.0 * radius)));
        }
        if self.length() == 0.0 {
            points.truncate(1);
        }
        points
    }
}

/// Why there are no walls.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WallError {
    /// Widths are not negative, and the least is no more than the greatest; so is the length of ends.
    #[error(
        "there is no wall from {min} to {max} wide without ends shorter than {ends}; give lengths from 0 on, the lesser width first"
    )]
    Range {
        /// What was given as the least width.
        min: f64,
        /// What was given as the greatest width.
        max: f64,
        /// What was given as the length of ends.
        ends: f64,
    },
    /// The axis is pruned, sampled or of another domain.
    #[error(transparent)]
    Axis(#[from] HierarchyError),
}

/// A piece of a path that is as wide as asked for, between two nodes.
struct Piece {
    curve: Curve,
    nodes: [u32; 2],
}

/// How the axis goes on at a node of pieces.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A keypoint.
    Keypoint,
    /// It gets narrower than asked for, or ends in a corner.
    Narrow,
    /// It gets wider.
    Wide,
}

/// The thin walls of an axis, each from its lesser end by x, then y, all in the order of these.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{WallOptions, thin_walls};
///
/// // A block of width 4, and a wall of width 1 that stands out from it by 5.
/// let ring = [(0., 0.), (4., 0.), (4., 1.), (9., 1.), (9., 2.), (4., 2.), (4., 4.), (0., 4.)];
/// let ring = ring.map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// let walls = thin_walls(&domain, &axis, &WallOptions::between(0.5, 1.0))?;
/// assert_eq!(walls.len(), 1);
/// let line = walls[0].polyline(0.01);
/// assert_eq!((line[0], line[1]), ((Point::new(4.0, 1.5), 1.0), (Point::new(8.5, 1.5), 1.0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the widths are negative or in the wrong order; if the axis is not exact, or pruned, or not of this
/// domain.
pub fn thin_walls(
    domain: &Domain,
    axis: &MedialAxis,
    options: &WallOptions,
) -> Result<Vec<Wall>, WallError> {
    let WallOptions { min, max, ends } = *options;
    if !(0.0 <= min && min <= max && max.is_finite() && 0.0 <= ends && !ends.is_nan()) {
        return Err(WallError::Range { min, max, ends });
    }
    let radii = Radii::new(domain, axis)?;
    let mut band = Band::new(&radii, axis, options);
    band.drop_ends(ends);
    let mut walls = band.walls();
    walls.sort_by(|one, other| {
        let start = |wall: &Wall| wall.curves.first().map(Curve::from).unwrap_or_default();
        start(one).lexicographic(start(other))
    });
    Ok(walls)
}

/// Pieces of an axis and how they meet.
struct Band {
    pieces: Vec<Piece>,
    kinds: Vec<Kind>,
    /// Pieces at each node; a piece from a node to itself is there twice.
    at: Groups,
    /// What is not left out.
    is_kept: Vec<bool>,
    /// Nodes that stand for a part of which all else was left out.
    points: Vec<(Point, f64)>,
}

/// Pieces one after another, and whether each runs backwards.
type Chain = Vec<(u32, bool)>;

impl Band {
    fn new(radii: &Radii<'_>, axis: &MedialAxis, options: &WallOptions) -> Self {
        // Halves of doubles are doubles, or so small that it makes no difference.
        let thin = Limit::more_than(radii, 0.5 * options.max);
        let thick = Limit::at_least(radii, 0.5 * options.min);
        let kind = |k: u32| match axis.keypoints().at(k).kind {
            KeypointKind::End => Kind::Narrow,
            _ => Kind::Keypoint,
        };
        let mut kinds: Vec<Kind> = (0..axis.keypoints().len() as u32).map(kind).collect();
        let mut pieces: Vec<Piece> = Vec::new();
        for (number, path) in (0..).zip(axis.paths()) {
            let Some([first, last]) = thin.within(number) else { continue };
            let curve = axis.curve(&path);
            let parts = match thick.within(number) {
                None => [Some([first, last]), None],
                Some([low, high]) => {
                    let before = thick.is_farther(path.from) && first < low;
                    let after = thick.is_farther(path.to) && high < last;
                    [before.then_some([first, low]), after.then_some([high, last])]
                }
            };
            let mut is_met = [false; 2];
            for [u, v] in parts.into_iter().flatten().filter(|[u, v]| u < v) {
                let mut end = |place: usize, at: f64, limit: f64, keypoint: u32| {
                    let is_keypoint = at == [0.0, 1.0][place];
                    if is_keypoint && !thin.is_farther(keypoint) && thick.is_farther(keypoint) {
                        is_met[place] = true;
                        return keypoint;
                    }
                    kinds.push(if at == limit { Kind::Wide } else { Kind::Narrow });
                    kinds.len() as u32 - 1
                };
                // The limit of the greater width, if that is where it ends.
                let from = end(0, u, first, path.from);
                let to = end(1, v, last, path.to);
                pieces.push(Piece { curve: curve.piece(u, v), nodes: [from, to] });
            }
            // Where nothing of a path goes on from a keypoint, it gets wider there or narrower.
            for (path, is_met) in [path, path.reversed()].iter().zip(is_met) {
                let is_within = !thin.is_farther(path.from) && thick.is_farther(path.from);
                let kind = &mut kinds[path.from as usize];
                if is_within && !is_met && thin.is_left_upwards(path) {
                    *kind = Kind::Wide;
                } else if is_within && !is_met && *kind == Kind::Keypoint {
                    *kind = Kind::Narrow;
                }
            }
        }
        let ends = || (0..).zip(&pieces).flat_map(|(k, piece)| piece.nodes.map(|node| (node, k)));
        let at = Groups::new(kinds.len(), ends);
        let is_kept = vec![true; pieces.len()];
        Self { pieces, kinds, at, is_kept, points: Vec::new() }
    }

    fn kept_at(&self, node: u32) -> impl Iterator<Item = u32> + '_ {
        self.at.of(node).iter().copied().filter(|&k| self.is_kept[k as usize])
    }

    /// The pieces from a node on, up to the next one at which not two meet.
    fn chain(&self, start: u32, first: u32) -> (Chain, u32) {
        let (mut chain, mut node, mut next) = (Chain::new(), start, first);
        loop {
            let nodes = self.pieces[next as usize].nodes;
            let back = nodes[0] != node;
            chain.push((next, back));
            node = nodes[usize::from(!back)];
            let mut here = self.kept_at(node);
            let others = [here.next(), here.next(), here.next()];
            match others {
                [Some(one), Some(other), None] if node != start && one != other => {
                    next = if one == next { other } else { one };
                }
                _ => return (chain, node),
            }
        }
    }

    fn length(&self, chain: &Chain) -> f64 {
        chain.iter().map(|&(k, _)| self.pieces[k as usize].curve.length()).sum()
    }

    /// Half of the width at a node, by a piece there.
    fn radius(&self, node: u32) -> f64 {
        let piece = self.at.of(node).first().map(|&k| &self.pieces[k as usize]);
        piece.map_or(0.0, |piece| match piece.nodes[0] == node {
            true => piece.curve.radius_from(),
            false => piece.curve.radius_to(),
        })
    }

    /// Leaves out chains with a loose end that reach out of the pen where they begin by less than `least`; of
    /// a part of which nothing would be left, and that does not go on anywhere wider, one point stays.
    fn drop_ends(&mut self, least: f64) {
        let n = self.kinds.len();
        // How far what was left out at each node reaches from it along the axis.
        let mut reach: Vec<f64> = (0..n as u32).map(|node| self.radius(node)).collect();
        let is_narrow = |node: &u32| self.kinds[*node as usize] == Kind::Narrow;
        let mut open: Vec<u32> = (0..n as u32).filter(is_narrow).collect();
        let mut is_point = vec![false; n];
        while !open.is_empty() {
            // All at once: else what is left at a junction would be one chain with what goes on there.
            let loose = open.iter().filter_map(|&node| self.loose(node));
            let is_short = |(start, end, chain): &(u32, u32, Chain)| {
                reach[*start as usize] + self.length(chain) - self.radius(*end) < least
            };
            let dropped: Vec<(u32, u32, Chain)> = loose.filter(is_short).collect();
            for (start, end, chain) in &dropped {
                chain.iter().for_each(|&(k, _)| self.is_kept[k as usize] = false);
                let whole = reach[*start as usize] + self.length(chain);
                reach[*end as usize] = reach[*end as usize].max(whole);
            }
            open.clear();
            for (start, end, chain) in dropped {
                if self.kept_at(end).next().is_some() {
                    open.push(end);
                    continue;
                }
                let is_first = !std::mem::replace(&mut is_point[end as usize], true)
                    && !std::mem::replace(&mut is_point[start as usize], true);
                if is_first && self.kinds[end as usize] != Kind::Wide {
                    self.points.extend(self.widest(&chain));
                }
            }
            open.sort_unstable();
            open.dedup();
        }
    }

    /// A node with a single piece, the end of the chain from there, and the chain.
    fn loose(&self, node: u32) -> Option<(u32, u32, Chain)> {
        let mut here = self.kept_at(node);
        let (Some(first), None) = (here.next(), here.next()) else { return None };
        let (chain, end) = self.chain(node, first);
        Some((node, end, chain))
    }

    /// The widest of the points between the pieces of a chain and at its ends.
    fn widest(&self, chain: &Chain) -> Option<(Point, f64)> {
        let curves = chain.iter().map(|&(k, _)| self.pieces[k as usize].curve);
        let ends = curves.flat_map(|c| [(c.from(), c.radius_from()), (c.to(), c.radius_to())]);
        ends.reduce(|best, next| if next.1 > best.1 { next } else { best })
    }

    fn walls(&self) -> Vec<Wall> {
        let mut is_taken = vec![false; self.pieces.len()];
        let mut walls: Vec<Wall> = Vec::new();
        let mut take = |chain: Chain, walls: &mut Vec<Wall>| {
            if std::mem::replace(&mut is_taken[chain[0].0 as usize], true) {
                return;
            }
            let turned = |&(k, back): &(u32, bool)| {
                is_taken[k as usize] = true;
                let curve = self.pieces[k as usize].curve;
                if back { curve.reversed() } else { curve }
            };
            let mut curves: Vec<Curve> = chain.iter().map(turned).collect();
            let ends = (curves[0].from(), curves[curves.len() - 1].to());
            if ends.1.lexicographic(ends.0).is_lt() {
                curves = curves.iter().rev().map(Curve::reversed).collect();
            }
            walls.push(Wall { curves });
        };
        let is_joint = |node: u32| self.kept_at(node).count() == 2;
        for node in (0..self.kinds.len() as u32).filter(|&node| !is_joint(node)) {
            for first in self.kept_at(node) {
                take(self.chain(node, first).0, &mut walls);
            }
        }
        // What is left are rings.
        for (k, piece) in (0_u32..).zip(&self.pieces) {
            if self.is_kept[k as usize] && is_joint(piece.nodes[0]) {
                take(self.chain(piece.nodes[0], k).0, &mut walls);
            }
        }
        for &(point, radius) in &self.points {
            let site = crate::axis::Site::vertex(point);
            let end = (point, radius);
            walls.push(Wall { curves: vec![Curve::new(&site, &site, end, end)] });
        }
        walls
    }
}
