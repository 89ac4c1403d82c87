//! What is written down while a model runs.

pub(crate) mod bolts;
pub(crate) mod dead_zone;
pub(crate) mod deposit;
pub mod film;
pub mod gauge;
pub mod histories;
pub mod passage;
pub mod recorder;
pub mod snapshots;
