//! Eight contacts side by side, in the widest vectors the processor has; the same bits with any.

pub(crate) mod eight;
mod plain;
pub mod quad;
pub(crate) mod real;
pub mod widest;
#[cfg(target_arch = "x86_64")]
mod x86;
