//! Loads by guideline equations, one file per model. Knows nothing of the simulation.

pub mod rope;
pub mod volkwein;
