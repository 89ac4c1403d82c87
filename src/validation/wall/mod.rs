//! Grains on rigid walls.

pub(crate) mod calibration;
pub(crate) mod impulse;
pub(crate) mod laboratory;
pub(crate) mod slopes;
pub(crate) mod surge;
pub(crate) mod usgs_flume;
pub(crate) mod usgs_gate;
pub(crate) mod variants;
