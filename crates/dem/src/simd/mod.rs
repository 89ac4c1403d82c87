//! Eight contacts side by side, in the widest vectors the processor has; the same bits with any.

pub mod eight;
mod plain;
pub mod quad;
pub mod real;
pub mod widest;
#[cfg(target_arch = "x86_64")]
mod x86;
