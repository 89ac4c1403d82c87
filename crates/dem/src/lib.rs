//! The engine: rigid grains, fixed surfaces and a barrier of ropes, stepped in time. SI numbers only; knows
//! nothing of designs, guidelines or reports.

#![allow(rustdoc::private_intra_doc_links)]

pub mod contact;
pub mod elements;
pub mod geometry;
pub mod ledger;
pub mod model;
pub mod neighbours;
pub mod net;
pub mod recorders;
pub mod schedule;
pub mod simd;
pub mod simulation;
pub mod sweep;
pub mod tables;
pub mod time;
pub mod workers;

/// A vector in the channel frame: x down the slope, y across, z normal to the bed (m, m/s, N, as used).
pub type Vec3 = nalgebra::Vector3<f64>;

/// The larger of two numbers; NaN if either is, so that a run that has lost its footing is noticed.
#[inline(always)]
pub fn larger_or_nan(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}
