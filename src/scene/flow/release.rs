//! The flow as it starts: packed upstream of the barrier, at rest behind a gate or already moving.

use serde::{Deserialize, Serialize};

use crate::design::{Arrival, Channel, DamBreak, Flow, Surge};
use crate::scene::flow::packing::{Attempts, PackingError, PackingRoom, pack_watched};
use crate::units::GRAVITY;
use dem::Vec3;
use dem::tables::grains::{Grain, GrainBody, GrainShape};

/// Where the block stands: x of the foot of its downstream face, and its sizes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    pub front: f64,
    /// Along the bed (m).
    pub length: f64,
    pub height: f64,
    /// Length along the bed over which its downstream face rises to the full height (m); 0 for a vertical face.
    pub nose: f64,
    /// Area of the tip of the nose that is too thin for grains (m²).
    pub tip: f64,
    pub velocity: f64,
}

/// Depth of the tip of a nose that holds no grains, over their mean diameter.
const TIP: f64 = 0.75;

/// Share of the length of an even flow that its nose may take at the most, on the middle of the height: so that a short surge still has
/// a surface.
const LONGEST_NOSE: f64 = 0.8;

impl Block {
    /// The velocity of a surge is that of its arrival: what slope and friction of the bed give or take on the run-in s is left out or
    /// added at the release, v₀² = v² − 2 g (sin α − tan φ cos α) s, but no less than half the velocity.
    pub fn of(flow: &Flow, channel: &Channel, upstream_reach: f64) -> Self {
        match flow.arrival {
            Arrival::DamBreak(DamBreak { length, height, distance, .. }) => {
                Self { front: -distance, length, height, nose: 0.0, tip: 0.0, velocity: 0.0 }
            }
            Arrival::Surge(Surge { length, depth, velocity, front_angle, run_in }) => {
                let nose = (depth / libm::tan(front_angle)).clamp(0.0, 2.0 * LONGEST_NOSE * length);
                let gain = 2.0
                    * GRAVITY
                    * (libm::sin(channel.slope) - channel.base_friction * libm::cos(channel.slope))
                    * run_in;
                let velocity = (velocity * velocity - gain).max(0.25 * velocity * velocity).sqrt();
                let thin = (TIP * flow.sizes.quantile(0.5)).min(depth);
                let tip = 0.5 * thin * thin * nose / depth;
                // The triangle that the nose lacks, and the tip that holds nothing, are made up for by length.
                let length = length + 0.5 * nose + tip / depth;
                Self { front: -upstream_reach - run_in, length, height: depth, nose, tip, velocity }
            }
        }
    }

    /// Of its section along the channel, as far as it holds grains (m²).
    pub fn area(&self) -> f64 {
        self.height * (self.length - 0.5 * self.nose) - self.tip
    }
}

/// The bodies of all grains, from the design's size curve.
pub fn bodies(flow: &Flow) -> Vec<GrainBody> {
    let diameters = flow.sizes.grains(flow.mass, flow.solid_density);
    diameters.iter().map(|&diameter| GrainBody::clump(diameter, flow.aspect, flow.solid_density)).collect()
}

/// One or two spheres to a grain.
pub fn shape(flow: &Flow) -> GrainShape {
    if flow.aspect > 1.0 { GrainShape::Clump } else { GrainShape::Sphere }
}

/// Packs the flow into its block and gives it its velocity. The block may come out longer than asked.
pub fn packed_block(
    flow: &Flow,
    channel: &Channel,
    block: &Block,
    seed: u64,
    attempts: Attempts,
) -> Result<(Vec<Grain>, Block), PackingError> {
    let room = PackingRoom {
        size: Vec3::new(block.length, channel.width, block.height),
        nose: block.nose,
        apart: block.moves(),
    };
    let (mut grains, length) = pack_watched(&bodies(flow), shape(flow), room, seed, attempts)?;
    let corner = Vec3::new(block.front - length, 0.0, 0.0);
    for grain in &mut grains {
        grain.position += corner;
        grain.velocity = Vec3::new(block.velocity, 0.0, 0.0);
    }
    Ok((grains, Block { length, ..*block }))
}

impl Block {
    /// Whether it moves when it is let go. Grains that move freely must not press on each other then: what their contacts store would be
    /// motion that nobody asked for.
    fn moves(&self) -> bool {
        self.velocity > 0.0
    }
}
