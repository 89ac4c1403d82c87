//! What is written down while a model runs.

pub mod bolts;
pub mod dead_zone;
pub mod deposit;
pub mod film;
pub mod gauge;
pub mod histories;
pub mod passage;
pub mod recorder;
pub mod snapshots;
