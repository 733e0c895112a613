pub mod axis;
pub mod check;
mod features;
mod sink;
