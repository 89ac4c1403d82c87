//! Many grains.

pub(crate) mod collapse;
pub(crate) mod packing;
pub(crate) mod silo;
