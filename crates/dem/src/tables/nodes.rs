//! The point masses of a flexible barrier, and how they are turned where cylinders meet in them.

use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};

use crate::Vec3;

/// A point mass of the net or of a rope. Every step of the barrier changes it and other threads read it then: what does not change is kept apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Node {
    pub position: Vec3,
    /// At half steps, like the grains'; where the barrier takes several steps in one of the grains', at those.
    pub velocity: Vec3,
    /// kg
    pub mass: f64,
    /// A fixed node never moves: an anchor, or a rope bolted to the bed.
    pub fixed: bool,
    /// Radius with which grains touch the node (m): the thickest line that ends there; made by [`crate::tables::barrier::Barrier::connect`].
    pub radius: f64,
}

/// How a node is turned, where cylinders meet in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    pub orientation: UnitQuaternion<f64>,
    /// Angular velocity (rad/s), at half steps.
    pub spin: Vec3,
    /// Moment of inertia, the same about all axes (kg m²).
    pub inertia: f64,
    /// A clamped node never turns.
    pub held: bool,
}
