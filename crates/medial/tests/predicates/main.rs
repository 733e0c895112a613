//! The exact decisions, against independent arithmetic and against shapes with known answers.

mod consistency;
mod random;
