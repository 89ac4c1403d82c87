//! Energy dissipator, also called a brake: elastic, then yielding at the force of a curve, which may be a plateau, then rigid.
//!
//! With e the elongation and p the plastic stroke so far, F = k (e − p) ≥ 0. While F would exceed the
//! yield force Y(p) and stroke is left, p grows so that F equals it; unloading is elastic with slope k; once
//! the stroke is used up, p stays and F grows with slope k: the load goes straight to the anchor.
//! Source: Albaba 2015, section 4.2.4; unloading and hard stop are our choices (stated in the report).

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::segment::SegmentKind;
use crate::elements::segment::{AxialMember, SpringLink};
use crate::elements::yield_curve::YieldCurve;
use crate::tables::nodes::Node;

/// A dissipator between an anchor (first node) and a rope end (second node).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dissipator {
    pub nodes: [u32; 2],
    /// The rope it holds.
    pub kind: SegmentKind,
    /// Length at which tension starts (m).
    pub rest_length: f64,
    /// Radius with which grains touch it and what it has paid out (m): that of its rope.
    pub radius: f64,
    /// Elastic stiffness k (N/m).
    pub stiffness: f64,
    /// Plateau force (N), or the largest of its curve.
    pub plateau: f64,
    /// How the yield force goes with the stroke.
    pub curve: YieldCurve,
    /// Stroke available (m).
    pub stroke: f64,
    /// Stroke used so far, p (m).
    pub used: f64,
}

/// State of a dissipator after one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pull {
    /// Tension (N), never negative.
    pub tension: f64,
    /// Unit vector from the first node to the second.
    pub direction: Vec3,
    /// Elastic energy (J).
    pub stored: f64,
    /// Energy dissipated in this step (J).
    pub lost: f64,
}

impl Dissipator {
    pub fn member(&self) -> AxialMember {
        AxialMember { nodes: self.nodes, kind: self.kind, rest_length: None }
    }

    pub fn taut(&self) -> SpringLink {
        SpringLink { nodes: self.nodes, stiffness: self.stiffness, damping: 0.0, slack: self.rest_length + self.used }
    }

    /// Stretches the dissipator to the present place of its nodes.
    pub fn stretch(&mut self, anchor: &Node, end: &Node) -> Pull {
        let line = end.position - anchor.position;
        let length = line.norm();
        let mut pull = self.elongate(length - self.rest_length);
        pull.direction = if length > 0.0 { line / length } else { Vec3::zeros() };
        pull
    }

    /// Sets the elongation (m), lets it yield, and returns the force.
    pub fn elongate(&mut self, elongation: f64) -> Pull {
        let [used, lost] = self.curve.pay_out([self.plateau, self.stroke], self.stiffness, self.used, elongation);
        self.used = used;
        let elastic = (elongation - self.used).max(0.0);
        Pull {
            tension: self.stiffness * elastic,
            stored: 0.5 * self.stiffness * elastic * elastic,
            lost,
            ..Pull::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn example() -> Dissipator {
        Dissipator {
            nodes: [0, 1],
            kind: SegmentKind::Main(0),
            rest_length: 0.0,
            radius: 0.016,
            stiffness: 45.957e6,
            plateau: 250e3,
            curve: YieldCurve::default(),
            stroke: 2.5,
            used: 0.0,
        }
    }

    #[test]
    fn holds_the_plateau_exactly_and_unloads_elastically() {
        // Case D18.
        let mut dissipator = example();
        assert_relative_eq!(dissipator.elongate(0.001).tension, 45.957e3, max_relative = 1e-12);
        assert_relative_eq!(dissipator.elongate(1.0).tension, 250e3, max_relative = 1e-12);
        let back = 1.0 - 100e3 / 45.957e6;
        assert_relative_eq!(dissipator.elongate(back).tension, 150e3, max_relative = 1e-9);
        assert_relative_eq!(dissipator.used, 1.0 - 250e3 / 45.957e6, max_relative = 1e-12);
        assert_eq!(dissipator.elongate(0.5).tension, 0.0);
    }

    #[test]
    fn passes_the_load_on_when_the_stroke_is_used_up() {
        let mut dissipator = example();
        let limit = 2.5 + 250e3 / 45.957e6;
        let result = dissipator.elongate(limit + 0.01);
        assert_relative_eq!(dissipator.used, dissipator.stroke);
        assert_relative_eq!(result.tension, 250e3 + 0.01 * 45.957e6, max_relative = 1e-9);
        assert_relative_eq!(result.lost, 250e3 * 2.5, max_relative = 1e-12);
    }
}
