//! The tables of bodies that a model consists of.

pub mod barrier;
pub mod grain_rows;
pub mod grain_table;
pub mod grains;
pub mod load_sheets;
pub mod moving_rows;
pub mod nodes;
pub mod prefetch;
pub mod surfaces;
