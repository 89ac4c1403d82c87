//! What is written down while a model runs.

pub mod histories;
pub mod passage;
pub mod recorder;
