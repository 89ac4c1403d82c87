//! What a simulation looks like while it goes on, small enough to be told again and again.

use serde::{Deserialize, Serialize};

use dem::recorders::film::{Film, Frame};

/// Grains that are shown at the most.
const MOST_GRAINS: usize = 1500;

/// The flow and the barrier at one moment, in cm.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// s
    pub time: f64,
    /// Along the channel, across it and normal to the bed, and the radius, of each grain that is shown.
    pub grains: Vec<[i32; 4]>,
    /// The same of the ends of each rope of the barrier.
    pub ropes: Vec<[i32; 6]>,
    /// One grain of so many is shown.
    pub one_of: usize,
}

impl Picture {
    /// What a frame of a film shows.
    pub fn of(film: &Film, frame: &Frame) -> Self {
        let cm = |place: [f32; 3]| place.map(|value| (100.0 * value).round() as i32);
        let one_of = frame.grains.len().div_ceil(MOST_GRAINS).max(1);
        let looks = frame.grains.iter().zip(&film.looks).step_by(one_of);
        let grains = looks.filter_map(|(pose, [radius, _])| {
            let [x, y, z] = cm(pose.as_ref()?.place);
            Some([x, y, z, ((100.0 * radius).round() as i32).max(1)])
        });
        let rope = |ends: [u32; 2]| {
            let [a, b] = ends.map(|end| frame.nodes.get(end as usize).copied().map(cm));
            let ([a, b, c], [d, e, f]) = (a?, b?);
            Some([a, b, c, d, e, f])
        };
        Self {
            time: frame.time,
            grains: grains.collect(),
            ropes: film.ropes.iter().filter_map(|(ends, _)| rope(*ends)).collect(),
            one_of,
        }
    }
}
