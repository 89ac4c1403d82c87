//! barrier-check
pub mod checks;
pub mod commands;
pub mod dem;
pub mod demand;
pub mod design;
pub mod fidelity;
pub mod loads;
pub mod pipeline;
pub mod problem;
pub mod report;
pub mod scene;
pub mod sources;
pub mod units;
