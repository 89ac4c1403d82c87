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

/// What a metre takes that goes from the foot to the top, of a wall that is not equally wide all the way: the force normal to it, and its
/// moment about the toe.
pub const METRE_FORCE: Channel = Channel { name: "wall_metre_force", unit: "n_per_m", rows: Rows::One };
pub const METRE_MOMENT: Channel = Channel { name: "wall_metre_moment", unit: "n_m_per_m", rows: Rows::One };

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OfWall {
    moment: f64,
    segments: Vec<f64>,
    metre: [f64; 2],
}

impl BodyRecorder for OfWall {
    fn add_step(&mut self, simulation: &Simulation, _: &RecorderSetup) {
        let surfaces = &simulation.sums.surfaces;
        self.moment += surfaces.wall_moment;
        add_rows(&mut self.segments, &surfaces.wall_segments);
        self.metre[0] += surfaces.wall_metre[0];
        self.metre[1] += surfaces.wall_metre[1];
    }

    fn sample(&mut self, simulation: &Simulation, _: &RecorderSetup, steps: u32, channels: &mut Channels) {
        let done = std::mem::take(self);
        channels.push(&MOMENT, &means(&[done.moment], steps));
        channels.push(&SEGMENTS, &means(&done.segments, steps));
        if !simulation.model.wall.widths.is_empty() {
            let [force, moment] = done.metre;
            channels.push(&METRE_FORCE, &means(&[force], steps));
            channels.push(&METRE_MOMENT, &means(&[moment], steps));
        }
    }
}
