//! What a rigid wall bears.

use serde::{Deserialize, Serialize};

use crate::recorders::body::{BodyRecorder, add_rows, means};
use crate::recorders::channels::{Channel, Channels, Rows};
use crate::recorders::setup::RecorderSetup;
use crate::simulation::Simulation;

/// Moment of the force normal to the wall about its toe.
pub const MOMENT: Channel = Channel { name: "wall_moment", unit: "n_m", rows: Rows::One };
/// Force normal to the wall.
pub const SEGMENTS: Channel = Channel { name: "wall_segment", unit: "n", rows: Rows::EachSegment };

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OfWall {
    moment: f64,
    segments: Vec<f64>,
}

impl BodyRecorder for OfWall {
    fn add_step(&mut self, simulation: &Simulation, _: &RecorderSetup) {
        let surfaces = &simulation.sums.surfaces;
        self.moment += surfaces.wall_moment;
        add_rows(&mut self.segments, &surfaces.wall_segments);
    }

    fn sample(&mut self, _: &Simulation, _: &RecorderSetup, steps: u32, channels: &mut Channels) {
        let done = std::mem::take(self);
        channels.push(&MOMENT, &means(&[done.moment], steps));
        channels.push(&SEGMENTS, &means(&done.segments, steps));
    }
}
