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
//! 1. Each path of the axis is a move: a line between two edges, a quadratic over a parabola, a hyperbola
//!    between two corners; below the limit of depth it ends at the wall (`moves.rs`).
//! 2. Moves and walls that meet make a graph, and trails through it the passes of the bit (`order.rs`).

mod moves;
mod order;

pub use moves::{Move, Tip};

use super::hierarchy::HierarchyError;
use super::offset::{OffsetError, offsets};
use super::outline::Outline;
use super::radii::{Limit, Radii};
use crate::axis::{MedialAxis, Side};
use crate::domain::Domain;
use order::trails;

/// How a shape is carved; lengths are in units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarveOptions {
    /// The full angle of the bit's point, in degrees, as bits are sold by it.
    pub angle: f64,
    /// The depth at which the floor is flat.
    pub depth: Option<f64>,
    /// The tool that clears the floor.
    pub clearing: Option<Clearing>,
    /// The length of a way over what is cut already that is gone rather than to lift the bit; by default
    /// four times the greatest radius: twice down to a corner and back.
    pub lift: Option<f64>,
}

impl CarveOptions {
    /// All the way down with a bit of some angle in degrees.
    #[must_use]
    pub const fn with_angle(angle: f64) -> Self {
        Self { angle, depth: None, clearing: None, lift: None }
    }
}

/// A tool that clears a flat floor; lengths are in units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearing {
    /// Its radius; 0 for the bit itself.
    pub radius: f64,
    /// How far its rounds are apart.
    pub step: f64,
}

/// Why there is no tool path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CarveError {
    /// A bit's point has an angle between 0 and 180 degrees.
    #[error("{angle} is no angle of a bit; give one between 0 and 180 degrees")]
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
}

/// The least share of a floor's width that rounds may be apart.
///
/// A mistyped step would fill the memory.
const LEAST_STEP: f64 = 1e-4;

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
    let radii = Radii::new(domain, axis)?;
    let mut carving = Carving {
        moves: Vec::new(),
        passes: Vec::new(),
        floor: Outline { polygons: Vec::new() },
        slope,
        depth: options.depth,
    };
    let Some(depth) = options.depth else {
        let moves = axis.paths().iter().map(|path| Move::along(&axis.curve(&path), |r| slope * r));
        carving.moves.extend(moves.map(|cut| (Role::Valley, cut)));
        carving.order(lift);
        return Ok(carving);
    };
    let radius = depth / slope;
    let limit = Limit::more_than(&radii, radius);
    for number in 0..axis.paths().len() as u32 {
        let Some(curve) = limit.rest(number) else { continue };
        // A path may only touch the limit.
        if curve.from() != curve.to() {
            // Where it meets the wall it is as deep to the last bit.
            let at = |r: f64| if r == radius { depth } else { slope * r };
            carving.moves.push((Role::Valley, Move::along(&curve, at)));
        }
    }
    let mut distances = vec![radius];
    if let Some(Clearing { radius: tool, step }) = clearing {
        let first = radius + if tool > 0.0 { tool } else { step };
        let reach = axis.radius_max() - radius;
        if step < LEAST_STEP * reach {
            return Err(CarveError::Step { step, reach, least: LEAST_STEP * reach });
        }
        let rounds = (0..).map(|k| first + f64::from(k) * step);
        distances.extend(rounds.take_while(|&distance| distance < axis.radius_max()));
    }
    let mut outlines = offsets(domain, axis, &distances)?;
    let rounds = outlines.split_off(1);
    carving.floor = outlines.swap_remove(0);
    let contours = |outline: &Outline| -> Vec<Vec<Move>> {
        let contours = outline.polygons.iter().flat_map(|polygon| &polygon.0);
        contours.map(|c| c.strokes().iter().map(|s| Move::level(s, -depth)).collect()).collect()
    };
    let walls = contours(&carving.floor).into_iter().flatten();
    carving.moves.extend(walls.map(|cut| (Role::Wall, cut)));
    carving.order(lift);
    for contour in rounds.iter().flat_map(contours) {
        let first = carving.moves.len() as u32;
        carving.moves.extend(contour.into_iter().map(|cut| (Role::Floor, cut)));
        carving.passes.push((first..carving.moves.len() as u32).map(|k| (k, false)).collect());
    }
    Ok(carving)
}

/// The cotangent of half an angle in degrees; 1 at 90.
fn slope(angle: f64) -> Result<f64, CarveError> {
    if !(angle > 0.0 && angle < 180.0) {
        return Err(CarveError::Angle { angle });
    }
    let tan = (45.0 - 0.5 * angle).to_radians().tan();
    let slope = (1.0 + tan) / (1.0 - tan);
    if slope.is_finite() && slope > 0.0 { Ok(slope) } else { Err(CarveError::Angle { angle }) }
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

    /// What is cut away, the floor cleared: the volume under the least of the distance from the boundary and
    /// the limit, times the slope. It is added up from the moves alone, in cubes of the unit of the input.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let depth = self.depth.unwrap_or(0.0);
        let radius = depth / self.slope;
        let cut = |(role, cut): &(Role, Move)| match (role, cut) {
            (Role::Valley, cut) => cut.volume(self.slope),
            // A prism with a triangle for its end, or the same turned around a corner of the boundary.
            (Role::Wall, Move::Arc { angle, .. }) => depth * radius * radius * angle / 3.0,
            (Role::Wall, cut) => 0.5 * depth * radius * cut.length(),
            (Role::Floor, _) => 0.0,
        };
        self.moves.iter().map(cut).sum::<f64>() + depth * self.floor.area()
    }

    /// The length of all passes in space.
    #[must_use]
    pub fn length(&self) -> f64 {
        let steps = self.passes.iter().flatten();
        steps.map(|&(number, _)| self.moves[number as usize].1.length()).sum()
    }
}
