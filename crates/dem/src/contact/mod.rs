//! Contact laws and the loops that apply them to each kind of pair.
//!
//! Geometry makes a [`law::ContactPoint`], the law answers with force and energies; grains, surfaces and ropes
//! share the one law.

pub mod grain_pairs;
pub mod grain_touch;
pub(crate) mod lane_sums;
pub mod law;
pub mod material;
pub mod pair_list;
pub mod restitution;
pub mod ropes;
pub mod surfaces;
