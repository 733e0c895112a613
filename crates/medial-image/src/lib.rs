//! Regions of images: what is cut out of a picture before its axes are computed.
//!
//! A [`Field`] gives each pixel three numbers between which distances mean something, as L\*u\*v\* of a colour.
//! [`feature_space`], [`mean_shift`], [`thresholds`] and [`near_colours`] turn it into [`Labels`], one number for
//! each pixel, that of the connected region that it is in, and a palette of [`Class`]es; regions are [`Mask`](medial::raster::Mask)s and
//! polygons. A [`Selection`] of them, by points or as a whole, makes [`Objects`], whose [`Borders`] can be
//! simplified or smoothed, and which can be compared with those of another image ([`Changes`]).
//!
//! ```
//! use medial::raster::Grid;
//! use medial_image::{Analysis, Field, feature_space};
//!
//! // A red square on a blue ground.
//! let is_red = |k: usize| (10..20).contains(&(k % 30)) && (10..20).contains(&(k / 30));
//! let colours = (0..30 * 30).map(|k| if is_red(k) { [255, 0, 0] } else { [0, 0, 255] });
//! let field = Field::of_bytes(Grid::of_image(30, 30), colours)?;
//! let labels = feature_space(&field, &Analysis::default());
//! let regions = labels.regions(&field);
//! assert_eq!(regions.iter().map(|region| region.cells).collect::<Vec<_>>(), [800, 100]);
//! // The ground has a hole.
//! assert_eq!(labels.polygons(0)[0].len(), 2);
//! # Ok::<(), medial_image::FieldError>(())
//! ```

mod borders;
mod changes;
mod classes;
mod colour;
mod feature_space;
mod field;
mod histogram;
mod labels;
mod mean_shift;
mod merging;
mod objects;
mod pixels;
mod polygons;
mod random;
mod selection;
mod simple;

pub use borders::Borders;
pub use changes::{Change, ChangeError, Changes, Part, Uncompared};
pub use classes::Class;
pub use colour::{luv, srgb};
pub use feature_space::{Analysis, Resolution, feature_space};
pub use field::{Field, FieldError};
pub use labels::{Labels, Region};
pub use mean_shift::{Filter, filtered, mean_shift, mean_shift_with};
pub use objects::{Object, Objects};
pub use selection::{Action, Click, Selection, SelectionError};
pub use simple::{near_colours, thresholds, thresholds_of};
