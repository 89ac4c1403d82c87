//! A main rope that runs through rings: rope passes from one side of a ring to the other when the tensions
//! differ by more than friction can hold.
//!
//! At a ring with wrap angle θ the tensions of the two sides obey T_1 ≤ T_2 e^(μθ) and the other way round
//! (capstan). Where they do not, rest length moves from the slack to the taut side until they do. A segment
//! never gets shorter than a given share of its first length: there the rings touch.

use crate::dem::tables::barrier::{Node, Segment};

/// Segments of one rope in order from end to end; rings sit between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    pub segments: Vec<u32>,
    /// Friction coefficient between ring and rope.
    pub friction: f64,
    /// Shortest rest length of a segment (m).
    pub shortest: f64,
}

/// Sweeps over the rings of a chain in each step: enough for a slip to run along the rope within a few steps.
const SWEEPS: usize = 2;

/// Newton steps to the slip that just meets the limit; the slip of one time step is small.
const NEWTON_STEPS: usize = 2;

impl Chain {
    /// Lets the rope slide through its rings, at the places reached by a step of length `step` (s); returns the energy lost in
    /// friction (J).
    ///
    /// Stretched at the old rest lengths the rope has stored ½ (T_n + T') ΔL in that step, but the integrator works with the
    /// tension T_n+1 after the slide. The difference belongs to the slide:
    /// lost = Σ E' − E_n+1 − ½ (T' − T_n+1) ΔL over all segments, primed before the slide.
    pub fn slide(&self, segments: &mut [Segment], nodes: &[Node], step: f64) -> f64 {
        let before: Vec<Side> = self.segments.iter().map(|&index| Side::of(&segments[index as usize], nodes)).collect();
        for sweep in 0..SWEEPS {
            let joints = 1..self.segments.len();
            if sweep % 2 == 0 {
                joints.for_each(|joint| self.slide_at(joint, segments, nodes));
            } else {
                joints.rev().for_each(|joint| self.slide_at(joint, segments, nodes));
            }
        }
        let lost = self.segments.iter().zip(&before).map(|(&index, before)| {
            let segment = &segments[index as usize];
            let after = Side::of(segment, nodes);
            let [a, b] = segment.nodes.map(|node| nodes[node as usize].pace);
            let stretched = (b - a).dot(&after.direction) * step;
            before.energy - after.energy - 0.5 * (before.tension - after.tension) * stretched
        });
        lost.sum()
    }

    /// Slides the rope through the ring between segments `joint − 1` and `joint`.
    fn slide_at(&self, joint: usize, segments: &mut [Segment], nodes: &[Node]) {
        let [first, second] = [self.segments[joint - 1] as usize, self.segments[joint] as usize];
        let [a, b] = [first, second].map(|index| Side::of(&segments[index], nodes));
        let cosine = a.direction.dot(&b.direction).clamp(-1.0, 1.0);
        let hold = (self.friction * cosine.acos()).exp();
        let (taut, slack, taut_index, slack_index) =
            if a.tension > b.tension { (a, b, first, second) } else { (b, a, second, first) };
        if taut.tension <= slack.tension * hold {
            return;
        }
        for _ in 0..NEWTON_STEPS {
            let [taut, slack] = [taut_index, slack_index].map(|index| Side::of(&segments[index], nodes));
            // Tension falls by EA L/l² per rest length given to the taut side, and rises likewise on the other.
            let wanted = (taut.tension - hold * slack.tension) / (taut.slope + hold * slack.slope);
            let moved = wanted.min(segments[slack_index].rest_length - self.shortest);
            if moved == 0.0 || segments[taut_index].rest_length + moved < self.shortest {
                break;
            }
            segments[taut_index].set_rest_length(segments[taut_index].rest_length + moved);
            segments[slack_index].set_rest_length(segments[slack_index].rest_length - moved);
        }
    }
}

/// One side of a ring.
struct Side {
    tension: f64,
    /// −dT/dl, with l the rest length (N/m).
    slope: f64,
    direction: crate::dem::Vec3,
    energy: f64,
}

impl Side {
    fn of(segment: &Segment, nodes: &[Node]) -> Self {
        let [a, b] = segment.nodes.map(|node| &nodes[node as usize].position);
        let line = b - a;
        let length = line.norm();
        let stretch = (length - segment.rest_length).max(0.0);
        let tension = segment.stiffness * stretch;
        Self {
            tension,
            slope: segment.stiffness * length / segment.rest_length,
            direction: line / length,
            energy: 0.5 * tension * stretch,
        }
    }
}
