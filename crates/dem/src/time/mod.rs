//! Time: how long a step may be, and how bodies move through it.

pub mod at_barrier;
pub mod inlet;
pub mod integrate;
pub mod links;
pub mod multi_rate;
pub mod stable_step;
