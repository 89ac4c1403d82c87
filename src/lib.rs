//! barrier-check
pub mod dem;
pub mod problem;
pub mod units;
pub mod design;
pub mod scene;
