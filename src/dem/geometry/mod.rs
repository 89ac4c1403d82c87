//! Pure geometry: one function per pair of shapes.

pub mod point_segment;
