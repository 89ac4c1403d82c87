//! Many grains.

pub mod collapse;
pub mod packing;
pub mod silo;
