//! The flow before it meets the barrier: grains of the wanted sizes, packed, settled and released.

pub mod packing;
pub mod release;
