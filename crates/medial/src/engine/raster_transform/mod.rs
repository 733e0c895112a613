//! The medial axis of a mask: exact distances, one number of significance a cell, the topology of the shape.
//!
//! # Contract
//! Components and holes of the axis are exactly those of the mask, cells of the shape being neighbours by
//! sides and corners. No block of two by two cells is left from which one could be taken without changing
//! that. Where no residual is given, the disks of all cells together are the mask again, cell for cell;
//! otherwise cells whose chord residual is above it stay, but for what is needed to make the axis thin.
//! Results do not depend on the number of threads. Time is linear in the cells of the shape, nearly, but for
//! what it takes to draw the disks where no residual is given.
//!
//! # Method
//! 1. [Features](crate::raster) [MRH00]: for each cell the nearest one outside.
//! 2. Outlines along cracks, with a position for each crack.
//! 3. The integer medial axis [HR08]: of two neighbours whose feet are apart the one nearer to their bisector
//!    is medial. Its residual [OK95] is how much longer the outline between both feet is than their
//!    distance: it grows from the ends to the middle, tells bumps from limbs by one number, and is without
//!    bound where the feet are on two outlines, so rings around holes stay.
//! 4. Thinning in the order of the distance, without the cells of step 3 above the threshold, and then
//!    of these, worst first.
//!
//! # Departures
//! [HR08] prune by the distance of the feet, which takes thin strokes away altogether and does not keep the
//! topology; the residual and step 4 mend both. Residuals are measured along the polygon through the middles
//! of cracks, which is right along rows, columns and diagonals; cracks themselves would count diagonals 1.4
//! times too long.

mod medial_cells;
mod thinning;

use super::sampled::{Label, Remains, cells_of, features_of};
use super::watch::Watch;
use super::{EngineError, Options};
use crate::axis::{Engine, MedialAxis, Side};
use crate::domain::Domain;
use crate::raster::{Bits, Cracks, Features, Mask, PixelGraph, disk_cells};
use medial_cells::Search;
use thinning::{Thinning, thin_further};

/// The medial cells of a mask, with their distances.
#[derive(Debug)]
pub struct Skeleton<'m> {
    remains: Remains<'m>,
    complete: bool,
}

impl<'m> Skeleton<'m> {
    /// Finds the medial cells of a mask: those with a chord residual above that of the options, or, without
    /// one, so many that their disks are the mask.
    ///
    /// ```
    /// use medial::engine::{Options, Skeleton};
    /// use medial::raster::{Grid, Mask};
    /// let mask = Mask::new(Grid::of_image(9, 3), |_, _| true)?;
    /// let skeleton = Skeleton::new(&mask, &Options::default())?;
    /// // The middle row, about as far as disks of radius 1.5 go.
    /// assert!((2..7).all(|x| skeleton.cells().get(x, 1)) && skeleton.cells().count() < 8);
    /// assert_eq!(skeleton.radius(4, 1), Some(1.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the options say to stop.
    pub fn new(mask: &'m Mask, options: &Options<'_>) -> Result<Self, EngineError> {
        let watch = Watch::new(options);
        let residual = options.residual;
        let aspect = mask.grid().aspect();
        let bits = &mask.bits;
        let features = features_of(mask, options);
        watch.check_now()?;
        let cracks = Cracks::new(bits);
        watch.check_now()?;
        // Without a threshold, whatever lies between two feet.
        let threshold = residual.map_or(-0.5, |residual| residual as f32);
        let mut search = Search::new(bits, threshold);
        let mut kept = Bits::new(bits.columns(), bits.rows());
        let mut thinning = Thinning::new(bits);
        for rows in features.bands() {
            features.with_band(rows.start, |band| {
                search.rows(bits, band, &cracks, aspect, rows.clone(), &mut kept);
                thinning.band(&kept, band, rows);
            });
            watch.check_now()?;
        }
        let cells = if residual.is_some() {
            thin_further(thinning, &search.found())
        } else {
            let cells = thinning.finish();
            let lost = uncovered(mask, &features, &cells, &watch)?;
            if lost.count() > 0 {
                for y in 0..bits.rows() {
                    lost.ones(y).for_each(|x| kept.set(x as i32, y as i32));
                }
                let mut thinning = Thinning::new(bits);
                for rows in features.bands() {
                    features.with_band(rows.start, |band| thinning.band(&kept, band, rows));
                    watch.check_now()?;
                }
                thinning.finish()
            } else {
                cells
            }
        };
        watch.check_now()?;
        let cells = mask.with_bits(cells);
        let remains = Remains { mask, features, cracks, cells };
        Ok(Self { remains, complete: residual.is_none() })
    }

    /// The same where the medial cells are known already: those given by column and row that belong to the
    /// mask.
    #[must_use]
    pub fn of_cells(mask: &'m Mask, cells: impl IntoIterator<Item = [u32; 2]>) -> Self {
        let features = features_of(mask, &Options::default());
        let cracks = Cracks::new(&mask.bits);
        let mut known = Bits::new(mask.grid().columns, mask.grid().rows);
        for [x, y] in cells {
            if mask.get(x, y) {
                known.set(x as i32, y as i32);
            }
        }
        let remains = Remains { mask, features, cracks, cells: mask.with_bits(known) };
        Self { remains, complete: false }
    }

    /// The medial cells.
    #[must_use]
    pub fn cells(&self) -> &Mask {
        &self.remains.cells
    }

    /// The distance of a cell of the shape from the boundary, in units of the plane: that between the
    /// centres of the cell and the nearest one outside, less half a cell. `None` outside of the shape.
    #[must_use]
    pub fn radius(&self, column: u32, row: u32) -> Option<f64> {
        self.remains.radius(column, row)
    }

    /// Columns and rows from a cell of the shape to the nearest one outside. `None` outside of the shape.
    #[must_use]
    pub fn foot(&self, column: u32, row: u32) -> Option<(i32, i32)> {
        self.remains.foot(column, row)
    }

    /// The graph of the medial cells: one node for each junction, and, unless the disks are to be the mask
    /// again, without ends whose disk lies in that of the next cell.
    #[must_use]
    pub fn graph(&self) -> PixelGraph {
        let mut graph = PixelGraph::new(self.cells());
        if self.complete {
            return graph;
        }
        let distance = |cell| self.remains.distance(cell);
        graph.drop_stubs(self.remains.mask.grid().aspect(), distance);
        graph.join_junctions(distance);
        graph
    }

    /// The axis, with the edges of the mask's [outline](crate::raster::outline) as sites.
    ///
    /// # Errors
    /// If there are more elements than 32-bit numbers tell apart.
    pub fn axis(&self) -> Result<MedialAxis, EngineError> {
        self.remains.axis(&self.graph(), self.label())
    }

    fn label(&self) -> Label {
        let cell = self.remains.mask.grid().cell_size();
        let (engine, side) = (Engine::RasterTransform, Side::Interior);
        Label { engine, side, complete: self.complete, cell }
    }
}

/// Cells of the shape that no disk of some cells covers.
fn uncovered(
    mask: &Mask,
    features: &Features<'_>,
    cells: &Bits,
    watch: &Watch<'_>,
) -> Result<Bits, EngineError> {
    let mut left = mask.bits.clone();
    for y in 0..cells.rows() {
        for x in cells.ones(y) {
            watch.check()?;
            let squared = features.squared(x as i32, y as i32);
            disk_cells(mask.grid(), x, y, squared, |row, from, to| left.clear_run(row, from, to));
        }
    }
    Ok(left)
}

/// The sampled medial axis of a mask; see [`Skeleton`].
///
/// # Errors
/// Those of [`Skeleton::new`] and [`Skeleton::axis`].
pub fn raster_transform(mask: &Mask, options: &Options<'_>) -> Result<MedialAxis, EngineError> {
    Skeleton::new(mask, options)?.axis()
}

/// The sampled medial axis of a domain, on cells of the size that the options say: those whose centres lie in
/// it. Distances are those of the centres from the domain, and its elements are the sites.
///
/// ```
/// use medial::axis::KeypointKind;
/// use medial::domain::{self, Domain};
/// use medial::engine::{Options, raster_transform_of_domain};
/// use medial::geom::Point;
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &domain::Options::default())?;
/// let options = Options { cell: Some(0.1), ..Options::default() };
/// let axis = raster_transform_of_domain(&domain, &options)?;
/// let count = |kind| axis.keypoints().iter().filter(|k| k.kind == kind).count();
/// assert_eq!((count(KeypointKind::Tip), count(KeypointKind::Junction)), (4, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the cells are too many or have no size, and those of [`raster_transform`].
pub fn raster_transform_of_domain(
    domain: &Domain,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    let mask = cells_of(domain, options)?;
    let skeleton = Skeleton::new(&mask, options)?;
    skeleton.remains.axis_of_domain(domain, &skeleton.graph(), skeleton.label())
}
