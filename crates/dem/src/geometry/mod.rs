//! Pure geometry: one function per pair of shapes.

pub mod point_segment;
pub mod segment_segment;
