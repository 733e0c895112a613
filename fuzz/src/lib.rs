//! From bytes to shapes, and what must hold for them: shared by the fuzz targets and by the test
//! that replays the corpus.

mod bytes;
mod polygons;
mod properties;
mod shapes;
mod sketch;
mod tally;

pub use polygons::any_polygons;
pub use properties::{check_axis, check_domain};
pub use shapes::{FAMILIES, Shape, shape};
pub use sketch::to_wkt;
pub use tally::Tally;

use medial::geom::Point;

/// Closed list of points, the last one joined to the first.
pub type Ring = Vec<Point>;

/// Polygons of a feature, each a list of rings, the outer one first.
pub type Polygons = Vec<Vec<Ring>>;
