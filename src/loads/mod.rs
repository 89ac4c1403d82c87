//! Loads by equations: cases of the guideline, other models, ropes, retention. Knows nothing of the simulation.

pub mod cases;
pub mod estimates;
pub mod fill;
pub mod input;
pub mod ladder;
pub mod pressure;
pub mod rope;
pub mod run_up;
pub mod wall;
