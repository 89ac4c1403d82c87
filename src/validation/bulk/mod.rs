//! Many grains.

pub(crate) mod collapse;
pub(crate) mod mixture;
pub(crate) mod packing;
pub(crate) mod silo;
