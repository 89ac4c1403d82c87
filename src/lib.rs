//! barrier-check
pub mod dem;
pub mod design;
pub mod scene;
