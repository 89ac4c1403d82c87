//! Loads by equations: cases of the guideline, other models, ropes, retention. Knows nothing of the simulation.

pub(crate) mod cases;
pub(crate) mod estimates;
pub(crate) mod fill;
pub(crate) mod impact;
pub(crate) mod input;
pub(crate) mod other_models;
pub(crate) mod posts;
pub(crate) mod pressure;
pub(crate) mod ring_net;
pub(crate) mod rope;
pub(crate) mod run_up;
pub(crate) mod wall;
