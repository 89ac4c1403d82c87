//! The flexible barrier: mesh, main and lateral ropes, dissipators and anchors, as nodes and elements.

pub(crate) mod build;
pub(crate) mod cut;
mod extension;
pub(crate) mod grid;
pub(crate) mod outline;
pub(crate) mod posts;
pub(crate) mod ring_net;
mod ring_shape;
pub(crate) mod rings;
