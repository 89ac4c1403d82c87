//! The tables of bodies that a model consists of.

pub mod barrier;
pub mod grain_table;
pub mod grains;
pub mod prefetch;
pub mod surfaces;
