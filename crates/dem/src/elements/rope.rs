//! Rope segment: pulls when stretched, hangs slack when not.
//!
//! T = max(0, k (L − L0) + c L̇) for L > L0, else 0, with k = EA/L0 (N/m) and c a small axial damping (N s/m). At its elastic limit
//! a segment draws out at constant tension, at its breaking load it breaks, if it may do either.

use crate::Vec3;
use crate::elements::segment::Segment;
use crate::tables::nodes::Node;

/// Tension of a segment and what it stores and loses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pull {
    /// Tension (N), never negative.
    pub tension: f64,
    /// Unit vector from the first node to the second.
    pub direction: Vec3,
    /// Elastic energy (J).
    pub stored: f64,
    /// Dissipated in the step just made (J).
    pub lost: f64,
    /// What became of a segment that was overloaded.
    pub fate: Option<Overload>,
}

/// What becomes of an overloaded piece of rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Overload {
    /// Drawn out to this rest length (m).
    Drawn(f64),
    Broken,
}

/// Tension of `segment` between its nodes `a` and `b`, after a step of length `step` (s).
#[inline]
pub fn pull(segment: &Segment, a: &Node, b: &Node, step: f64) -> Pull {
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
    if spring > segment.strength.least() {
        return overloaded(segment, length, direction, rate * step);
    }
    let tension = (spring + segment.damping * rate).max(0.0);
    let lost = (tension - spring) * rate * step;
    Pull { tension, direction, stored: 0.5 * spring * stretch, lost, fate: None }
}

/// A segment beyond its strength, now `length` long (m) and longer by `stretched` than a step ago.
///
/// Had it stayed elastic it would have stored E' and pulled with T', and the step would have put ½ (T_n + T') ΔL into it; it pulls with T
/// and stores E. So lost = E' − E − ½ (T' − T) ΔL.
#[cold]
fn overloaded(segment: &Segment, length: f64, direction: Vec3, stretched: f64) -> Pull {
    let strength = &segment.strength;
    let stretch = length - segment.rest_length;
    let (would_pull, would_store) = (segment.stiffness * stretch, 0.5 * segment.stiffness * stretch * stretch);
    let (tension, stored, fate) = if would_pull > strength.breaking {
        (0.0, 0.0, Overload::Broken)
    } else {
        let axial = segment.stiffness * segment.rest_length;
        let rest_length = strength.rest_length_at_limit(axial, length);
        (strength.elastic, 0.5 * strength.elastic * (length - rest_length), Overload::Drawn(rest_length))
    };
    let lost = would_store - stored - 0.5 * (would_pull - tension) * stretched;
    Pull { tension, direction, stored, lost, fate: Some(fate) }
}
