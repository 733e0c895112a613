//! Which input makes a domain, what is changed on the way, and what is refused and why.

mod accepted;
mod agreement;
mod brute;
mod large;
mod masks;
mod refused;
mod shapes;
