//! One contact, or one grain.

pub mod bounces;
pub mod chain;
pub mod clump_body;
pub mod coarse_steps;
pub mod cooling;
pub mod energy;
pub mod gears;
pub mod oblique;
pub mod restitution;
pub mod rolling;
pub mod transient;
pub mod wall_restitution;
pub mod weight;
