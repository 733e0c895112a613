//! Carving with a V-bit: as deep everywhere as the boundary is away.
//!
//! # Contract
//! A bit with a point, moved along the axis so deep that it just reaches the boundary on both sides, cuts the
//! shape out, corners up to their tips, and nothing else: the depth is the radius times the cotangent of
//! half the bit's angle. Where that is deeper than a limit, the floor is flat: its wall is cut along the
//! parallel curve at the radius of the limit, which is exact as offsets are, and the rest of the floor is left
//! to a tool of its own. Moves are exact curves; they meet bit for bit.
//!
//! # Method
//! 1. Of an axis that may leave something the limbs below that excess are pruned (`hierarchy/mod.rs`).
//! 2. Each path of the axis is a move: a line between two edges, a quadratic over a parabola, a hyperbola
//!    between two corners; below the limit of depth it ends at the wall (`moves.rs`).
//! 3. Moves and walls that meet make a graph, and trails through it the passes of the bit (`order.rs`).

mod moves;
mod order;

pub use moves::{Move, Tip};

use super::hierarchy::{Hierarchy, HierarchyError};
use super::measure::Measure;
use super::offset::{OffsetError, offsets};
use super::outline::Outline;
use super::radii::{Limit, Radii};
use super::rest::{Origin, Pruned};
use crate::axis::{Curve, MedialAxis, Side};
use crate::domain::Domain;
use crate::geom::Point;
use order::{in_turn, places, trails};

/// How a shape is carved; lengths are in units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarveOptions {
    /// The full angle of the bit's point, in degrees, as bits are sold by it.
    pub angle: f64,
    /// The depth at which the floor is flat.
    pub depth: Option<f64>,
    /// The tool that clears the floor.
    pub clearing: Option<Clearing>,
    /// How much may be left: what reaches no farther than this out of all that is cut, as the corners of a
    /// curve that was drawn with segments. Nothing by default.
    pub leave: Option<f64>,
    /// The length of a way over what is cut already that is gone rather than to lift the bit; by default
    /// four times the greatest radius: twice down to a corner and back.
    pub lift: Option<f64>,
}

impl CarveOptions {
    /// All the way down with a bit of some angle in degrees.
    #[must_use]
    pub const fn with_angle(angle: f64) -> Self {
        Self { angle, depth: None, clearing: None, leave: None, lift: None }
    }
}

/// A tool that clears a flat floor, where it fits; lengths are in units of the input. Corners of the floor that
/// are narrower than the tool stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearing {
    /// Its radius; 0 for the bit itself.
    pub radius: f64,
    /// How far its rounds are apart: its radius at most, so that nothing stays between them.
    pub step: f64,
}

/// Why there is no tool path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CarveError {
    /// A bit's point has an angle between 0.01 and 179.99 degrees.
    #[error("{angle} is no angle of a bit; give one from 0.01 to 179.99 degrees")]
    Angle {
        /// What was given.
        angle: f64,
    },
    /// Lengths are positive; a clearing tool's radius and what a lift is worth may be 0.
    #[error("the {name} {value} is no such length; give a positive one")]
    Length {
        /// Which one.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A floor is cleared below a limit of depth only.
    #[error("there is no floor to clear without a limit of depth")]
    NoFloor,
    /// Rounds farther apart than the tool is wide on one side leave some of the floor.
    #[error(
        "rounds {step} apart leave gaps with a tool of radius {radius}; give its radius at most"
    )]
    Gaps {
        /// What was given.
        step: f64,
        /// The radius of the tool.
        radius: f64,
    },
    /// So many rounds would never end.
    #[error("the step {step} is too small for a floor {reach} wide; give at least {least}")]
    Step {
        /// What was given.
        step: f64,
        /// From the wall to the middle of the floor.
        reach: f64,
        /// The least that goes.
        least: f64,
    },
    /// What is carved is the interior.
    #[error("the axis is that of the exterior; carve along that of the interior")]
    Exterior,
    /// There is no offset for the floor.
    #[error(transparent)]
    Offset(#[from] OffsetError),
    /// The axis is pruned, sampled or of another domain.
    #[error(transparent)]
    Axis(#[from] HierarchyError),
}

/// What a move is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// Along the axis, both sides at once.
    Valley,
    /// Along the foot of the wall around a flat floor.
    Wall,
    /// Over a flat floor, with the tool that clears it.
    Floor,
}

impl Role {
    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Valley => "valley",
            Self::Wall => "wall",
            Self::Floor => "floor",
        }
    }
}

/// A tool path.
#[derive(Clone, Debug, PartialEq)]
pub struct Carving {
    /// Each move once.
    pub moves: Vec<(Role, Move)>,
    /// The passes in their order: the numbers of the moves that follow each other without a lift, and whether
    /// each is made from its end to its start. Some are made twice. The bit's passes come first, then those
    /// of the tool that clears the floor.
    pub passes: Vec<Vec<(u32, bool)>>,
    /// Where the floor is flat.
    pub floor: Outline,
    /// Depth for each unit of distance from the boundary: the cotangent of half the angle.
    pub slope: f64,
    /// The limit of depth.
    pub depth: Option<f64>,
    /// The tool that clears the floor.
    pub clearing: Option<Clearing>,
}

/// The least share of a floor's width that rounds may be apart.
///
/// A mistyped step would fill the memory.
const LEAST_STEP: f64 = 1e-3;

/// The order of some tool paths in which each starts near the end of the one before.
#[must_use]
pub fn carving_order(paths: &[&Carving]) -> Vec<usize> {
    let ends = |path: &&Carving| {
        let first = path.passes.first().and_then(|pass| path.steps(pass).next());
        let last = path.passes.last().and_then(|pass| path.steps(pass).last());
        let first = first.map(|(_, cut)| cut.from().point).unwrap_or_default();
        [first, last.map_or(first, |(_, cut)| cut.to().point)]
    };
    in_turn(&paths.iter().map(ends).collect::<Vec<_>>())
}

/// The tool path that carves a shape.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{CarveOptions, carve};
///
/// // A square of side 2 is carved to a pyramid.
/// let ring = [(0., 0.), (2., 0.), (2., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// let pyramid = carve(&domain, &axis, &CarveOptions::with_angle(90.0))?;
/// assert_eq!((pyramid.moves.len(), pyramid.passes.len()), (4, 1));
/// assert!((pyramid.volume() - 4.0 / 3.0).abs() < 1e-14);
///
/// // With a floor at half of the depth, a frustum.
/// let options = CarveOptions { depth: Some(0.5), ..CarveOptions::with_angle(90.0) };
/// let frustum = carve(&domain, &axis, &options)?;
/// assert_eq!(frustum.floor.area(), 1.0);
/// assert!((frustum.volume() - 7.0 / 6.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If an option is out of range; if the axis is not complete and exact, not that of the interior, or not of this
/// domain.
pub fn carve(
    domain: &Domain,
    axis: &MedialAxis,
    options: &CarveOptions,
) -> Result<Carving, CarveError> {
    let slope = slope(options.angle)?;
    if axis.side != Side::Interior {
        return Err(CarveError::Exterior);
    }
    let lift = options.lift.unwrap_or(4.0 * axis.radius_max());
    let clearing = options.clearing;
    let lengths = [
        ("length that may be left", options.leave.unwrap_or(1.0), false),
        ("depth", options.depth.unwrap_or(1.0), false),
        ("radius of the clearing tool", clearing.map_or(0.0, |tool| tool.radius), true),
        ("step", clearing.map_or(1.0, |tool| tool.step), false),
        ("worth of a lift", lift, true),
    ];
    for (name, value, or_zero) in lengths {
        if !(value.is_finite() && (value > 0.0 || or_zero && value == 0.0)) {
            return Err(CarveError::Length { name, value });
        }
    }
    if clearing.is_some() && options.depth.is_none() {
        return Err(CarveError::NoFloor);
    }
    let (valleys, points) = valleys(domain, axis, options.leave)?;
    let mut carving = Carving {
        moves: Vec::new(),
        passes: Vec::new(),
        floor: Outline { polygons: Vec::new() },
        slope,
        depth: options.depth,
        clearing,
    };
    // A limit far below the deepest place is none.
    let bounds = |depth: &f64| *depth <= 2.0 * slope * axis.radius_max();
    let limit = options.depth.filter(bounds).map(|depth| (depth, depth / slope));
    let at = |r: f64| match limit {
        // Where it meets the wall it is as deep to the last bit.
        Some((depth, radius)) if r == radius => depth,
        _ => slope * r,
    };
    let mut cut = |curve: Curve| carving.moves.push((Role::Valley, Move::along(&curve, at)));
    let Some((depth, radius)) = limit else {
        for Origin { path, part: [from, to] } in valleys {
            cut(axis.curve(&axis.paths().at(path)).piece(from, to));
        }
        carving.drill(&points, f64::INFINITY);
        carving.order(lift);
        return Ok(carving);
    };
    let radii = Radii::new(domain, axis)?;
    let bound = Limit::more_than(&radii, radius);
    for Origin { path, part } in valleys {
        // A path may only touch the limit.
        if let Some(curve) = bound.rest(path, part).filter(|curve| curve.from() != curve.to()) {
            cut(curve);
        }
    }
    carving.drill(&points, radius);
    let mut distances = vec![radius];
    if let Some(Clearing { radius: tool, step }) = clearing {
        if tool > 0.0 && step > tool {
            return Err(CarveError::Gaps { step, radius: tool });
        }
        let first = radius + if tool > 0.0 { tool } else { step };
        let reach = axis.radius_max() - radius;
        if step < LEAST_STEP * reach {
            return Err(CarveError::Step { step, reach, least: LEAST_STEP * reach });
        }
        let rounds = (0..).map(|k| first + f64::from(k) * step);
        distances.extend(rounds.take_while(|&distance| distance < axis.radius_max()));
    }
    let mut outlines = offsets(domain, axis, &distances).map_err(|error| match error {
        OffsetError::Distance { .. } => CarveError::Length { name: "depth", value: depth },
        error => error.into(),
    })?;
    let rounds = outlines.split_off(1);
    carving.floor = outlines.swap_remove(0);
    let contours = |outline: &Outline| -> Vec<Vec<Move>> {
        let contours = outline.polygons.iter().flat_map(|polygon| &polygon.0);
        let moves = contours.map(|c| c.strokes().iter().map(|s| Move::level(s, -depth)).collect());
        moves.filter(|moves: &Vec<Move>| !moves.is_empty()).collect()
    };
    let walls = contours(&carving.floor).into_iter().flatten();
    carving.moves.extend(walls.map(|cut| (Role::Wall, cut)));
    carving.order(lift);
    let mut rounds: Vec<Vec<Move>> = rounds.iter().flat_map(contours).collect();
    let starts: Vec<[Point; 2]> = rounds.iter().map(|round| [round[0].from().point; 2]).collect();
    for k in in_turn(&starts) {
        let contour = std::mem::take(&mut rounds[k]);
        let first = carving.moves.len() as u32;
        carving.moves.extend(contour.into_iter().map(|cut| (Role::Floor, cut)));
        carving.passes.push((first..carving.moves.len() as u32).map(|k| (k, false)).collect());
    }
    Ok(carving)
}

/// The parts of paths that are cut, and the points, with their radii, of which nothing else is.
type Valleys = (Vec<Origin>, Vec<(Point, f64)>);

fn valleys(
    domain: &Domain,
    axis: &MedialAxis,
    leave: Option<f64>,
) -> Result<Valleys, HierarchyError> {
    let Some(most) = leave else {
        let whole = |path| Origin { path, part: [0.0, 1.0] };
        return Ok(((0..axis.paths().len() as u32).map(whole).collect(), Vec::new()));
    };
    let Pruned { axis: left, origins, .. } =
        Hierarchy::new(domain, axis)?.pruned(Measure::Excess, most);
    let alone = left.keypoints().iter().zip(left.degrees()).filter(|(_, degree)| *degree == 0);
    Ok((origins, alone.map(|(keypoint, _)| (keypoint.position, keypoint.radius)).collect()))
}

/// The cotangent of half an angle in degrees; 1 at 90.
fn slope(angle: f64) -> Result<f64, CarveError> {
    /// A bit sharper, or blunter by as much, than this in degrees is none.
    const LEAST: f64 = 0.01;
    if !(LEAST..=180.0 - LEAST).contains(&angle) {
        return Err(CarveError::Angle { angle });
    }
    let half = 0.5 * angle;
    Ok(if half < 45.0 {
        1.0 / half.to_radians().tan()
    } else if half > 45.0 {
        (90.0 - half).to_radians().tan()
    } else {
        1.0
    })
}

impl Carving {
    /// Makes passes of all moves so far.
    fn order(&mut self, lift: f64) {
        let moves: Vec<Move> = self.moves.iter().map(|&(_, cut)| cut).collect();
        self.passes = trails(&moves, lift);
    }

    /// The moves of a pass, each from where the one before ends.
    pub fn steps(&self, pass: &[(u32, bool)]) -> impl Iterator<Item = (Role, Move)> {
        pass.iter().map(|&(number, is_reversed)| {
            let (role, cut) = self.moves[number as usize];
            (role, if is_reversed { cut.reversed() } else { cut })
        })
    }

    /// What a pass is for: that of its first move.
    #[must_use]
    pub fn role(&self, pass: &[(u32, bool)]) -> Option<Role> {
        pass.first().map(|&(number, _)| self.moves[number as usize].0)
    }

    /// Goes straight down at points, to the depth of their radii, but for those deeper than the limit.
    fn drill(&mut self, points: &[(Point, f64)], most: f64) {
        for &(point, radius) in points.iter().filter(|(_, radius)| *radius <= most) {
            let tip = Tip { point, z: -self.slope * radius };
            self.moves.push((Role::Valley, Move::Line { from: tip, to: tip }));
        }
    }

    /// What is cut away, all of the floor taken to be cleared, in cubes of the unit of the input. It is
    /// added up from the moves alone. If nothing is left it is the volume under the least of the distance from the boundary and the
    /// limit, times the slope.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let depth = self.depth.unwrap_or(0.0);
        let radius = depth / self.slope;
        let (ends, tips) = places(self.moves.iter().map(|(_, cut)| cut));
        // What of a half turn around each place is not between the rims of moves.
        let mut open = vec![std::f64::consts::PI; tips.len()];
        let mut sum = 0.0;
        for ((role, cut), ends) in self.moves.iter().zip(ends) {
            match (role, cut) {
                (Role::Valley, cut) => {
                    let (volume, angles) = cut.swept(self.slope);
                    sum += self.slope * volume;
                    ends.iter().zip(angles).for_each(|(&end, angle)| open[end as usize] -= angle);
                }
                // A prism with a triangle for its end, or the same turned around a corner.
                (Role::Wall, Move::Arc { angle, .. }) => {
                    sum += depth * radius * radius * angle / 3.0
                }
                (Role::Wall, cut) => sum += 0.5 * depth * radius * cut.length(),
                (Role::Floor, _) => {}
            }
            // The wall takes care of its own places, and the floor's tool cuts no slope.
            if *role != Role::Valley {
                ends.iter().for_each(|&end| open[end as usize] = f64::NEG_INFINITY);
            }
        }
        // The cone of the bit's point, where no move takes it on.
        let cone = |(tip, open): (&Tip, f64)| {
            let radius = -tip.z / self.slope;
            if open > 0.0 { self.slope * open * radius.powi(3) / 3.0 } else { 0.0 }
        };
        sum + tips.iter().zip(open).map(cone).sum::<f64>() + depth * self.floor.area()
    }

    /// The length of all passes in space.
    #[must_use]
    pub fn length(&self) -> f64 {
        let steps = self.passes.iter().flatten();
        steps.map(|&(number, _)| self.moves[number as usize].1.length()).sum()
    }
}
