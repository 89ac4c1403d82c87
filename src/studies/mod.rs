//! Studies: many runs of a few scenes, each with one choice of the model changed, to see what it costs and what it changes.

pub(crate) mod amount;
pub(crate) mod bill;
pub(crate) mod choices;
pub(crate) mod knobs;
pub(crate) mod limit_states;
pub(crate) mod plan;
pub(crate) mod plan_schema;
pub(crate) mod reliability;
pub(crate) mod reliability_plan;
pub(crate) mod size_plan;
pub(crate) mod sizing;
pub(crate) mod speed_accuracy;
pub(crate) mod stability;
pub(crate) mod stability_scenes;
pub(crate) mod sweep;
pub(crate) mod sweep_plan;
