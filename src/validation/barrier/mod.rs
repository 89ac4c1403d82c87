//! Ropes, cylinders and dissipators alone, against closed forms.

pub mod beams;
pub mod brakes;
pub mod contacts;
pub mod ropes;
pub mod stand;
