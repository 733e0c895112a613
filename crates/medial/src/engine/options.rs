use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// How an engine works: never what it gives, but for the cells of engines that have some.
///
/// The default is one thread and no limit.
///
/// ```
/// use medial::domain::{self, Domain};
/// use medial::engine::{EngineError, Options, path_tracing_with};
/// use medial::geom::Point;
/// use std::time::Instant;
///
/// let triangle = [(0., 0.), (4., 0.), (0., 3.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![triangle.to_vec()]], &domain::Options::default())?;
/// // A deadline that has passed already.
/// let options = Options { deadline: Some(Instant::now()), ..Options::default() };
/// assert_eq!(path_tracing_with(&domain, &options), Err(EngineError::TimeLimit));
/// # Ok::<(), domain::DomainError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// Threads that share the work, the calling one among them; see `alone_below`.
    pub threads: NonZeroUsize,
    /// Set by another thread when the axis is wanted no more.
    pub cancel: Option<&'a AtomicBool>,
    /// When to give up.
    pub deadline: Option<Instant>,
    /// Domains and polygons of fewer edges are traced by one thread alone.
    pub alone_below: usize,
    /// The size of cells, in units of the input, for engines that put domains into cells; by default
    /// [`default_cell`](crate::raster::default_cell).
    pub cell: Option<f64>,
    /// Rows of cells that engines on cells hold distances of at a time, so that large masks take less memory; by
    /// default all, or of masks above 2^26 cells about 2^24. Which cells are above the residual, and how all
    /// hang together, does not depend on it; which others hold them together may.
    pub band_rows: Option<u32>,
    /// The largest distance between samples of the boundary, in units of the input, for engines that sample it; by
    /// default [`default_cell`](crate::raster::default_cell) for domains and half the side of a cell for masks.
    pub spacing: Option<f64>,
    /// The chord residual, in cells, above which [`raster_transform`](super::raster_transform) takes cells
    /// for medial; without one, as many are as it takes for their disks to be the mask again.
    pub residual: Option<f64>,
}

/// The chord residual in cells where nothing else is said: of all measures at all thresholds tried on
/// silhouettes, the least that keeps noise of the outline away and takes nothing apart.
const DEFAULT_RESIDUAL: f64 = 2.0;

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            threads: NonZeroUsize::MIN,
            cancel: None,
            deadline: None,
            alone_below: 10_000,
            cell: None,
            band_rows: None,
            spacing: None,
            residual: Some(DEFAULT_RESIDUAL),
        }
    }
}
