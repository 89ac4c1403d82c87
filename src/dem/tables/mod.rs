//! The tables of bodies that a model consists of.

pub mod barrier;
pub mod grains;
pub mod surfaces;
