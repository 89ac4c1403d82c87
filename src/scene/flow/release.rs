//! The flow as it starts: packed upstream of the barrier, at rest behind a gate or already moving.

use crate::dem::Vec3;
use crate::dem::tables::grains::{Grain, GrainBody, GrainShape};
use crate::design::{Arrival, Channel, DamBreak, Flow};
use crate::scene::flow::packing::{PackingBox, PackingError, pack};

/// Where the block stands: x of its downstream face, and its sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    pub front: f64,
    pub length: f64,
    pub height: f64,
    pub velocity: f64,
}

impl Block {
    pub fn of(flow: &Flow, upstream_reach: f64) -> Self {
        match flow.arrival {
            Arrival::DamBreak(DamBreak { length, height, distance, .. }) => {
                Self { front: -distance, length, height, velocity: 0.0 }
            }
            Arrival::Surge { length, depth, velocity } => {
                Self { front: -upstream_reach, length, height: depth, velocity }
            }
        }
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
) -> Result<(Vec<Grain>, Block), PackingError> {
    let room = PackingBox { size: Vec3::new(block.length, channel.width, block.height) };
    let (mut grains, length) = pack(&bodies(flow), shape(flow), room, seed)?;
    let corner = Vec3::new(block.front - length, 0.0, 0.0);
    for grain in &mut grains {
        grain.position += corner;
        grain.velocity = Vec3::new(block.velocity, 0.0, 0.0);
    }
    Ok((grains, Block { length, ..*block }))
}
