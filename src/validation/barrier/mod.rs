//! Ropes, cylinders, nets and dissipators alone, against closed forms and tests; whole barriers against the thesis.

pub mod beams;
pub mod brakes;
pub mod contacts;
pub mod full_scale;
pub mod pieces;
pub mod punching;
pub mod ropes;
pub mod stand;
pub mod variations;
