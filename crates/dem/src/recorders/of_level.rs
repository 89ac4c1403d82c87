//! How high the flow stands at the barrier.

use serde::{Deserialize, Serialize};

use crate::recorders::body::BodyRecorder;
use crate::recorders::channels::{Channel, Channels, Rows};
use crate::recorders::setup::RecorderSetup;
use crate::simulation::Simulation;

/// Level of the flow in front of the barrier, over the lowest ground and normal to the bed.
pub const LEVEL: Channel = Channel { name: "level", unit: "m", rows: Rows::One };

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OfLevel;

impl BodyRecorder for OfLevel {
    fn add_step(&mut self, _: &Simulation, _: &RecorderSetup) {}

    fn sample(&mut self, simulation: &Simulation, setup: &RecorderSetup, _: u32, channels: &mut Channels) {
        channels.push(&LEVEL, &[setup.at_the_barrier.level(&simulation.snapshot())]);
    }
}
