//! The tables of bodies that a model consists of.

pub mod barrier;
pub mod fixed;
pub mod grain_rows;
pub(crate) mod grain_table;
pub mod grains;
pub(crate) mod load_sheets;
pub(crate) mod moving_rows;
pub mod nodes;
pub mod pores;
pub mod prefetch;
pub mod surfaces;
pub mod terrain;
pub mod wall;
