//! The shape of the rings that tie a net to its main ropes.

use std::f64::consts::FRAC_1_SQRT_2;

use crate::design::{MainRopes, Rope};

/// Poisson's ratio of all cylinders, for twisting only.
pub const POISSON: f64 = 0.3;

/// Play between ring and rope, over the sum of their radii: 1 mm with the ropes of the thesis.
const PLAY: f64 = 1.0 / 24.0;

/// Length of a ring's sides (m), and of what ties it to the net.
pub fn ring_side(ropes: &MainRopes, rope: &Rope) -> f64 {
    (rope.diameter + ropes.ring_diameter) * (1.0 + PLAY)
}

/// How far a knot stands off the rope it hangs on (m).
pub fn ring_stand_off(ropes: &MainRopes, rope: &Rope) -> f64 {
    ring_side(ropes, rope) * (1.0 + FRAC_1_SQRT_2)
}
