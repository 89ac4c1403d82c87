//! Ropes, cylinders, nets and dissipators alone, against closed forms and tests; whole barriers against the thesis.

pub(crate) mod beams;
pub(crate) mod contacts;
pub(crate) mod dissipators;
pub(crate) mod full_scale;
pub(crate) mod pieces;
pub mod posts;
pub(crate) mod punching;
pub(crate) mod ring_chains;
pub mod ring_panel;
pub(crate) mod ropes;
pub(crate) mod section;
pub mod stand;
pub(crate) mod variations;
