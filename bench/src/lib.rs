//! What the programs of the comparison share: shapes, their text, and how time is taken.

pub mod bitmap;
pub mod dual;
pub mod inversion;
pub mod measure;
pub mod ridge;
pub mod shapes;
pub mod text;
