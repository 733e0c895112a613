//! Brushfire: layer after layer of a mask burns away, and what is left is its axis [VS87, II.B.1].
//!
//! # Contract
//! What is left depends on the way to burn. All but [`Burning::ZhangSuen`] keep components and holes of the mask,
//! cells of the shape being neighbours by sides and corners. Each cell is labelled with the pass in which
//! the fire stood at a side of it, a distance in steps along sides where passes have no parts and nothing that was
//! kept is in the way; and with its exact distance from the boundary. The axis carries the exact one.
//!
//! # Method
//! The report names four ways to keep the axis in one piece; each has a representative here.
//! 1. [`Burning::Sequential`]: each cell is checked when it is to go. Cells that were border when the pass
//!    began go in row order if they are simple and no end.
//! 2. [`Burning::Alternating`]: the sides take turns, and cells open to one go at once.
//! 3. [`Burning::Marking`]: the contour is marked, then burns; multiple cells stay.
//! 4. [`Burning::Isotropic`]: all sides at once, looking ahead two cells farther.
//!
//! And by name [`Burning::ZhangSuen`], [`Burning::GuoHall`] and [`Burning::Hilditch`]. The third and fourth way
//! leave strokes two cells wide, which the report calls their drawback; what is left then burns as in the first,
//! but for the two cells at the end of a stroke, of which one stays.
//!
//! A pass looks only at cells near those that burnt in the last one: time is linear in cells, not cells times
//! passes as the report has it.
//!
//! # Departures
//! - The first way, taken literally, would eat through the shape in one pass, as what is behind a cell becomes
//!   border when it goes; only cells that were border before are looked at.
//! - The first way knows an end by its one neighbour, as published; where rows lead along a stroke that has become
//!   two cells wide, it burns the stroke away from that end. The others do not.
//! - In the third way marked cells are checked once more when they go: two of them may hold on to the same kept
//!   cell, and one must stay. Arcelli and Sanniti di Baja [AS78] have rules for these cases that differ from paper to paper.
//! - The fourth way needs no four processors: it is computed as if there were.
//! - The report labels what remains with "the distance from the original shape boundary", counted in passes. That is
//!   the distance along sides of cells, up to 41 % too large, or less where the parts of one pass go farther along
//!   diagonals; so the exact one is given as well.
//! - Zhang and Suen's rule lets squares of two by two cells vanish, and lines two cells wide that run diagonally. It
//!   stays as published.

mod fire;
mod hilditch;
mod isotropic;
mod marking;
mod rules;
mod sequential;

use super::sampled::{Label, Remains, cells_of, features_of};
use super::watch::Watch;
use super::{EngineError, Options};
use crate::axis::{Engine, MedialAxis, Side, names};
use crate::domain::Domain;
use crate::raster::{Bits, Cracks, Mask, PixelGraph};
use fire::Fire;
use rules::{From, Half};

/// A way to burn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Burning {
    /// Each cell is checked when it is to go.
    Sequential,
    /// North, south, east and west take turns.
    Alternating,
    /// The contour is marked, and burns afterwards.
    Marking,
    /// All sides at once.
    #[default]
    Isotropic,
    /// The two half passes of Zhang and Suen. Small components may vanish.
    ZhangSuen,
    /// The two half passes of Guo and Hall.
    GuoHall,
    /// Hilditch's rule, of sides that take turns and all sides at once.
    Hilditch,
}

names!(
    Burning, "burning",
    Sequential => "sequential", Alternating => "alternating", Marking => "marking",
    Isotropic => "isotropic", ZhangSuen => "zhang_suen", GuoHall => "guo_hall",
    Hilditch => "hilditch",
);

impl Burning {
    /// Whether it keeps components and holes of every mask.
    #[must_use]
    pub const fn keeps_topology(self) -> bool {
        !matches!(self, Self::ZhangSuen)
    }
}

/// What a brushfire left of a mask.
#[derive(Debug)]
pub struct Burnt<'m> {
    remains: Remains<'m>,
    times: Vec<u16>,
    passes: u16,
}

impl<'m> Burnt<'m> {
    /// Burns a mask.
    ///
    /// ```
    /// use medial::engine::{Burning, Burnt, Options};
    /// use medial::raster::{Grid, Mask};
    /// let mask = Mask::new(Grid::of_image(9, 5), |_, _| true)?;
    /// let burnt = Burnt::new(&mask, Burning::Isotropic, &Options::default())?;
    /// assert!(burnt.cells().get(4, 2));
    /// // The fire comes in the third pass, and two and a half cells are left to the boundary.
    /// assert_eq!((burnt.pass(4, 2), burnt.radius(4, 2)), (Some(3), Some(2.5)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the options say to stop.
    pub fn new(
        mask: &'m Mask,
        burning: Burning,
        options: &Options<'_>,
    ) -> Result<Self, EngineError> {
        let watch = Watch::new(options);
        watch.check_now()?;
        let mut fire = Fire::new(mask.bits.clone(), &watch);
        burn(&mut fire, burning)?;
        let (cells, times, passes) = fire.finish();
        watch.check_now()?;
        let features = features_of(mask, options);
        let cracks = Cracks::new(&mask.bits);
        let cells = mask.with_bits(cells);
        Ok(Self { remains: Remains { mask, features, cracks, cells }, times, passes })
    }

    /// The cells that are left.
    #[must_use]
    pub fn cells(&self) -> &Mask {
        &self.remains.cells
    }

    /// How many passes took cells away.
    #[must_use]
    pub fn passes(&self) -> u32 {
        u32::from(self.passes)
    }

    /// The pass in which the fire reached a cell of the shape, from 1: the distance label of the report. `None`
    /// outside of the shape.
    #[must_use]
    pub fn pass(&self, column: u32, row: u32) -> Option<u32> {
        let mask = self.remains.mask;
        let place = fire::place(mask.grid().columns, [column as i32, row as i32]);
        mask.get(column, row).then(|| u32::from(self.times[place]))
    }

    /// The distance of a cell of the shape from the boundary, in units of the plane: that between the
    /// centres of the cell and the nearest one outside, less half a cell. `None` outside of the shape.
    #[must_use]
    pub fn radius(&self, column: u32, row: u32) -> Option<f64> {
        self.remains.radius(column, row)
    }

    /// The graph of what is left, with one node for each junction.
    #[must_use]
    pub fn graph(&self) -> PixelGraph {
        let mut graph = PixelGraph::new(self.cells());
        graph.join_junctions(|cell| self.remains.distance(cell));
        graph
    }

    /// The axis, with the edges of the mask's [outline](crate::raster::outline) as sites. It is not complete: fire
    /// eats the branches of corners.
    ///
    /// # Errors
    /// If there are more elements than 32-bit numbers tell apart.
    pub fn axis(&self) -> Result<MedialAxis, EngineError> {
        self.remains.axis(&self.graph(), self.label())
    }

    fn label(&self) -> Label {
        let (engine, side) = (Engine::Brushfire, Side::Interior);
        Label { engine, side, complete: false, cell: self.remains.mask.grid().cell_size() }
    }
}

/// Burns until nothing burns any more.
fn burn(fire: &mut Fire<'_>, burning: Burning) -> Result<(), EngineError> {
    match burning {
        Burning::Sequential => fire.burn(1, sequential::pass),
        Burning::Alternating => fire.burn(1, |fire| {
            From::ALL.iter().try_for_each(|side| {
                fire.take_where(|cells, [x, y]| {
                    let window = cells.window(x, y);
                    side.is_open(window) && rules::is_simple_inside(window)
                })
            })
        }),
        Burning::Marking => {
            fire.burn(marking::REACH, marking::pass)?;
            fire.burn(1, sequential::finish)
        }
        Burning::Isotropic => {
            fire.burn(isotropic::REACH, isotropic::pass)?;
            fire.burn(1, sequential::finish)
        }
        Burning::ZhangSuen => fire.burn(1, |fire| in_halves(fire, rules::zhang_suen)),
        Burning::GuoHall => fire.burn(1, |fire| in_halves(fire, rules::guo_hall)),
        Burning::Hilditch => {
            let mut marks = Bits::new(fire.cells.columns(), fire.cells.rows());
            fire.burn(1, |fire| hilditch::pass(fire, &mut marks))
        }
    }
}

/// A pass of two halves.
fn in_halves(fire: &mut Fire<'_>, rule: fn(u16, Half) -> bool) -> Result<(), EngineError> {
    Half::BOTH
        .iter()
        .try_for_each(|&half| fire.take_where(|cells, [x, y]| rule(cells.window(x, y), half)))
}

/// The sampled medial axis of a mask by brushfire; see [`Burnt`].
///
/// # Errors
/// Those of [`Burnt::new`] and [`Burnt::axis`].
pub fn brushfire(
    mask: &Mask,
    burning: Burning,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    Burnt::new(mask, burning, options)?.axis()
}

/// The sampled medial axis of a domain by brushfire, on cells of the size that the options say: those whose centres
/// lie in it. Distances are those of the centres from the domain, and its elements are the sites.
///
/// ```
/// use medial::domain::{self, Domain};
/// use medial::engine::{Burning, Options, brushfire_of_domain};
/// use medial::geom::Point;
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &domain::Options::default())?;
/// let options = Options { cell: Some(0.1), ..Options::default() };
/// let axis = brushfire_of_domain(&domain, Burning::default(), &options)?;
/// assert!(axis.keypoints().iter().any(|k| (k.radius - 0.95).abs() < 1e-9));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the cells are too many or have no size, and those of [`brushfire`].
pub fn brushfire_of_domain(
    domain: &Domain,
    burning: Burning,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    let mask = cells_of(domain, options)?;
    let burnt = Burnt::new(&mask, burning, options)?;
    burnt.remains.axis_of_domain(domain, &burnt.graph(), burnt.label())
}
