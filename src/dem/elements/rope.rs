//! Rope segment: pulls when stretched, hangs slack when not.
//!
//! T = max(0, k (L − L0) + c L̇) for L > L0, else 0, with k = EA/L0 (N/m) and c a small axial damping (N s/m).

use crate::dem::Vec3;
use crate::dem::tables::barrier::{Node, Segment};

/// Tension of a segment and what it stores and loses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pull {
    /// Tension (N), never negative.
    pub tension: f64,
    /// Unit vector from the first node to the second.
    pub direction: Vec3,
    /// Elastic energy (J).
    pub stored: f64,
    /// Dissipated power (W).
    pub power_lost: f64,
}

/// Tension of `segment` between its nodes `a` and `b`.
#[inline]
pub fn pull(segment: &Segment, a: &Node, b: &Node) -> Pull {
    let line = b.position - a.position;
    let square = line.norm_squared();
    if square <= segment.rest_length * segment.rest_length {
        return Pull::default();
    }
    let length = square.sqrt();
    let stretch = (length - segment.rest_length).max(0.0);
    let direction = line / length;
    let rate = (b.velocity - a.velocity).dot(&direction);
    let spring = segment.stiffness * stretch;
    let tension = (spring + segment.damping * rate).max(0.0);
    Pull { tension, direction, stored: 0.5 * spring * stretch, power_lost: (tension - spring) * rate }
}
