//! The exact decisions against independent arithmetic and against shapes with known answers.

mod agreement;
mod circle;
mod consistency;
mod fine;
mod known;
mod random;
mod reference;
mod stages;
