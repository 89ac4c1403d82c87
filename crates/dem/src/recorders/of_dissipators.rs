//! What the dissipators of the main ropes bear, and how far they have been drawn out.

use serde::{Deserialize, Serialize};

use crate::elements::segment::SegmentKind;
use crate::larger_or_nan;
use crate::recorders::body::{BodyRecorder, add_shares, means};
use crate::recorders::channels::{Channel, Channels, Rows};
use crate::recorders::setup::RecorderSetup;
use crate::simulation::Simulation;

/// Stroke used by each rope's dissipators, the larger of the two.
pub const STROKE: Channel = Channel { name: "brake_stroke", unit: "m", rows: Rows::EachRope };
/// Stroke used by each rope's dissipators, the mean of the two.
pub const MEAN_STROKE: Channel = Channel { name: "brake_stroke_mean", unit: "m", rows: Rows::EachRope };
/// Larger tension of each rope's two dissipators, of one rope where several run side by side; zeros where there are none.
pub const TENSION: Channel = Channel { name: "brake", unit: "n", rows: Rows::EachRope };

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OfDissipators {
    tension: Vec<f64>,
}

impl BodyRecorder for OfDissipators {
    fn add_step(&mut self, simulation: &Simulation, setup: &RecorderSetup) {
        let Some(barrier) = &simulation.model.barrier else { return };
        let substeps = simulation.sums.net_in_substeps();
        for net in substeps {
            let mut tensions = vec![0.0_f64; setup.ropes];
            for (dissipator, &tension) in barrier.dissipators.iter().zip(&net.dissipators) {
                let SegmentKind::Main(rope) = dissipator.kind else { continue };
                let of_rope = &mut tensions[usize::from(rope)];
                *of_rope = larger_or_nan(*of_rope, tension / barrier.sharing(dissipator.kind));
            }
            add_shares(&mut self.tension, &tensions, substeps.len());
        }
    }

    fn sample(&mut self, simulation: &Simulation, setup: &RecorderSetup, steps: u32, channels: &mut Channels) {
        let Some(barrier) = &simulation.model.barrier else { return };
        let done = std::mem::take(self);
        channels.push(&TENSION, &means(&done.tension, steps));
        let mut larger = vec![0.0_f64; setup.ropes];
        let mut sums = larger.clone();
        for dissipator in &barrier.dissipators {
            let SegmentKind::Main(rope) = dissipator.kind else { continue };
            let rope = usize::from(rope);
            larger[rope] = larger_or_nan(larger[rope], dissipator.used);
            sums[rope] += dissipator.used;
        }
        channels.push(&STROKE, &larger);
        channels.push(&MEAN_STROKE, &sums.iter().map(|sum| 0.5 * sum).collect::<Vec<_>>());
    }
}
