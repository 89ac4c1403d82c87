//! The flexible barrier: mesh, main and lateral ropes, dissipators and anchors, as nodes and elements.

pub mod build;
mod extension;
pub mod grid;
pub mod ring_shape;
pub mod rings;
