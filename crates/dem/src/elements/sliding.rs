//! A main rope that runs through rings and over the heads of posts: rope passes from one side of a ring to the other when the tensions
//! differ by more than friction can hold.
//!
//! At a ring with wrap angle θ the tensions of the two sides obey T_1 ≤ T_2 e^(μθ) and the other way round
//! (capstan). Where they do not, rest length moves from the slack to the taut side until they do. A segment
//! never gets shorter than a given share of its first length: there the rings touch. The tensions compared are the elastic ones; what
//! the segments' small dashpots add while they stretch or shorten is left out.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::segment::Segment;
use crate::tables::nodes::Node;

/// Segments of one rope in order from end to end; rings sit between them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chain {
    pub segments: Vec<u32>,
    /// Friction coefficient between the rope and each ring, or the head of a post, from the first to the last.
    pub frictions: Vec<f64>,
    /// Shortest rest length of a segment (m).
    pub shortest: f64,
}

/// Sweeps over the rings of a chain in each step: enough for a slip to run along the rope within a few steps.
const SWEEPS: usize = 2;

/// Newton steps to the slip that just meets the limit; the slip of one time step is small.
const NEWTON_STEPS: usize = 2;

impl Chain {
    /// Lets the rope slide through its rings, at the places reached by a step of the barrier of length `step` (s); returns the
    /// energy lost in friction (J).
    ///
    /// Stretched at the old rest lengths the rope has stored ½ (T_n + T') ΔL in that step, but the integrator works with the
    /// tension T_n+1 after the slide. The difference belongs to the slide:
    /// lost = Σ E' − E_n+1 − ½ (T' − T_n+1) ΔL over all segments, primed before the slide.
    pub fn slide(&self, segments: &mut [Segment], nodes: &[Node], step: f64) -> f64 {
        let mut pieces: Vec<Piece> =
            self.segments.iter().map(|&index| Piece::of(&segments[index as usize], nodes)).collect();
        let before: Vec<[f64; 2]> = pieces.iter().map(|piece| [piece.tension, piece.energy()]).collect();
        let mut holds = vec![None; pieces.len()];
        for sweep in 0..SWEEPS {
            let joints = 1..pieces.len();
            if sweep % 2 == 0 {
                joints.for_each(|joint| self.slide_at(joint, &mut pieces, &mut holds));
            } else {
                joints.rev().for_each(|joint| self.slide_at(joint, &mut pieces, &mut holds));
            }
        }
        let mut lost = 0.0;
        for ((&index, piece), [tension, energy]) in self.segments.iter().zip(&pieces).zip(before) {
            let segment = &mut segments[index as usize];
            if piece.rest_length == segment.rest_length {
                continue;
            }
            segment.set_rest_length(piece.rest_length);
            let [a, b] = segment.nodes.map(|node| nodes[node as usize].velocity);
            let stretched = (b - a).dot(&piece.direction) * step;
            lost += energy - piece.energy() - 0.5 * (tension - piece.tension) * stretched;
        }
        lost
    }

    /// Slides the rope through the ring between pieces `joint − 1` and `joint`; `holds` keeps e^(μθ) of rings looked at before.
    fn slide_at(&self, joint: usize, pieces: &mut [Piece], holds: &mut [Option<f64>]) {
        let [first, second] = [pieces[joint - 1].tension, pieces[joint].tension];
        let (taut, slack) = if first > second { (joint - 1, joint) } else { (joint, joint - 1) };
        let (high, low) = (first.max(second), first.min(second));
        let friction = self.frictions[joint - 1];
        let hold = match holds[joint] {
            Some(hold) => hold,
            None => {
                let cosine = pieces[joint - 1].direction.dot(&pieces[joint].direction).clamp(-1.0, 1.0);
                // A chord is no longer than its arc: e^(μθ) ≥ 1 + μ √(2 − 2 cos θ), which most rings need no more than.
                let chord = friction * low;
                if (high - low) * (high - low) <= chord * chord * (2.0 - 2.0 * cosine) {
                    return;
                }
                *holds[joint].insert(libm::exp(friction * libm::acos(cosine)))
            }
        };
        if high <= low * hold {
            return;
        }
        for _ in 0..NEWTON_STEPS {
            let [giver, taker] = [&pieces[slack], &pieces[taut]];
            // Tension falls by EA L/l² per rest length given to the taut side, and rises likewise on the other.
            let wanted = (taker.tension - hold * giver.tension) / (taker.slope() + hold * giver.slope());
            if giver.axial == 0.0 {
                // The rope has broken there: it runs out through the ring.
                pieces[taut].lengthen(wanted);
                continue;
            }
            let moved = wanted.min(giver.rest_length - self.shortest);
            if moved == 0.0 || taker.rest_length + moved < self.shortest {
                break;
            }
            pieces[taut].lengthen(moved);
            pieces[slack].lengthen(-moved);
        }
    }
}

/// One side of a ring: a segment as it lies, with a rest length that may change.
struct Piece {
    /// EA (N); nothing where the rope has broken.
    axial: f64,
    rest_length: f64,
    length: f64,
    direction: Vec3,
    /// N
    tension: f64,
}

impl Piece {
    fn of(segment: &Segment, nodes: &[Node]) -> Self {
        let [a, b] = segment.nodes.map(|node| &nodes[node as usize].position);
        let line = b - a;
        let length = line.norm();
        let axial = segment.stiffness * segment.rest_length;
        let piece = Self { axial, rest_length: segment.rest_length, length, direction: line / length, tension: 0.0 };
        Self { tension: piece.pulls(), ..piece }
    }

    /// Lets more rope into it, or out where that is negative (m).
    fn lengthen(&mut self, by: f64) {
        self.rest_length += by;
        self.tension = self.pulls();
    }

    fn stretch(&self) -> f64 {
        (self.length - self.rest_length).max(0.0)
    }

    fn pulls(&self) -> f64 {
        self.axial * self.stretch() / self.rest_length
    }

    fn energy(&self) -> f64 {
        0.5 * self.tension * self.stretch()
    }

    /// −dT/dl, with l the rest length (N/m).
    fn slope(&self) -> f64 {
        self.axial * self.length / self.rest_length.powi(2)
    }
}
