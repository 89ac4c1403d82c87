//! The tables of bodies that a model consists of.

pub mod barrier;
pub mod grain_rows;
pub mod grain_table;
pub mod grains;
pub mod load_sheets;
pub mod prefetch;
pub mod surfaces;
