//! Lets the surges after the first go, each upstream of what those before it have left.

use std::sync::atomic::AtomicBool;

use crate::design::{Channel, Design};
use crate::scene::flow::packing::{Attempts, PackingError};
use crate::scene::flow::release::{Block, packed_block};
use crate::scene::ground::bed_at;
use dem::simulation::Simulation;
use dem::tables::grains::Grain;

/// A surge that is to be let go.
pub struct Next<'a> {
    pub design: &'a Design,
    /// Which one, counted from 0.
    pub number: usize,
    /// Of the whole run.
    pub seed: u64,
    /// Number of its first grain.
    pub first: u32,
    /// How far upstream of its foot the barrier reaches, with room for the largest grain (m).
    pub reach: f64,
}

/// Bits of a seed that the attempts at packing leave alone.
const SEED_OF_A_SURGE: u32 = 40;

impl Next<'_> {
    /// Its grains, packed and moving, the foot of their front its run-in upstream of the barrier, or of the last grain that is there.
    pub fn grains(&self, simulation: &Simulation, stop: &AtomicBool) -> Result<Vec<Grain>, PackingError> {
        let (flow, channel) = (self.design.flow.alone(self.number), &self.design.channel);
        let last = simulation.grains.place.iter().map(|place| place.0[0] - place.fourth()).fold(0.0, f64::min);
        let behind = 0.5 * flow.sizes.quantile(1.0) + along_the_bed(channel, last);
        let block = Block::of(&flow, channel, self.reach.max(behind));
        let seed = self.seed.wrapping_add((self.number as u64) << SEED_OF_A_SURGE);
        let attempts = Attempts { stop, failed: 0, next: &mut |_| () };
        let (mut grains, block) = packed_block(&flow, channel, &block, seed, attempts)?;
        let start = block.length - block.front;
        let known = farthest_upstream(self.design, self.reach);
        if channel.ground().is_some() && start > known {
            return Err(PackingError::BeyondTheGround { start, known });
        }
        grains.iter_mut().zip(self.first..).for_each(|(grain, id)| grain.id = id);
        Ok(grains)
    }
}

/// How far up along its bed a place of the channel's frame is, given by its x (m).
fn along_the_bed(channel: &Channel, x: f64) -> f64 {
    if channel.profile.is_none() {
        return -x;
    }
    let (mut near, mut far) = (0.0, -2.0 * x + 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (near + far);
        if bed_at(channel, -middle).0.x > x { near = middle } else { far = middle }
    }
    far
}

/// Length that a surge may take more than its volume needs, for its nose and its packing, over its length.
const LONGER: f64 = 1.6;

/// How far upstream the surges of a design may start (m): each behind the others, had these come to rest as long as they were.
pub fn farthest_upstream(design: &Design, reach: f64) -> f64 {
    let later =
        design.flow.later.iter().map(|later| LONGER * later.surge.length + later.surge.run_in + later.surge.depth);
    let first = match design.flow.arrival {
        crate::design::Arrival::Surge(surge) => LONGER * surge.length + surge.run_in + surge.depth,
        crate::design::Arrival::DamBreak(block) => LONGER * block.length + block.distance,
    };
    reach + first + later.sum::<f64>()
}
