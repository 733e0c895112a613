//! The command `medial`.
fn main() {}
