//! One contact, or one grain.

pub(crate) mod bounces;
pub(crate) mod chain;
pub(crate) mod clump_body;
pub(crate) mod coarse_steps;
pub(crate) mod cooling;
pub(crate) mod energy;
pub(crate) mod gears;
pub(crate) mod ground;
pub(crate) mod neck;
pub(crate) mod oblique;
pub(crate) mod restitution;
pub(crate) mod rolling;
pub(crate) mod transient;
pub(crate) mod wall_restitution;
pub(crate) mod weight;
