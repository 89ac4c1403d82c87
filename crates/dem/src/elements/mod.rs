//! Structural elements of a flexible barrier.

pub mod cylinder;
pub mod dissipator;
pub mod ground;
pub mod net_ring;
pub mod post;
pub mod ring;
pub mod rope;
pub mod segment;
pub mod sliding;
pub mod strength;
pub mod yield_curve;
