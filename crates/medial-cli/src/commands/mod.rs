pub mod axis;
pub mod check;
pub mod compare;
mod features;
mod sink;
