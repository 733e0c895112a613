//! FlatGeobuf, version 3: a header, an index of boxes, and features one after the other, as flatbuffers.

mod read;
mod write;

pub use read::open;
pub use write::write;
