//! Studies: many runs of a few scenes, each with one choice of the model changed, to see what it costs and what it changes.

pub mod knobs;
pub mod plan;
pub mod speed_accuracy;
pub mod stability;
