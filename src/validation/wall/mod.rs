//! Grains on rigid walls.

pub mod calibration;
pub mod impulse;
pub mod laboratory;
pub mod slopes;
pub mod surge;
pub mod variants;
