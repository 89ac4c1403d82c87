//! What is written down while a model runs.

pub mod dead_zone;
pub mod film;
pub mod histories;
pub mod passage;
pub mod recorder;
pub mod snapshots;
