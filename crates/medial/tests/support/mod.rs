//! What several test files share: shapes from files, a third engine, a comparison of axes.
//!
//! Not every test file uses everything.
#![allow(dead_code)]

pub mod brute_force;
pub mod compare;
pub mod parts;
pub mod plane;
pub mod random;
pub mod shapes;
