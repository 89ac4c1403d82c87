//! Pure geometry: one function per pair of shapes.

pub(crate) mod point_segment;
pub mod segment_segment;
