//! Lets the surges after the first go, each upstream of what those before it have left.

use std::sync::atomic::AtomicBool;

use crate::design::{Arrival, Channel, Design};
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

/// A surge as it is let go.
pub struct Ready {
    pub grains: Vec<Grain>,
    /// Where the last grain lies that is there (m, downstream positive): before it comes to that the surge is gauged.
    pub last: f64,
    /// Density of its packing over the one asked for.
    pub packed_share: f64,
}

/// Share of the mass that lies there beyond what is called its tail: a few grains that stopped on the way are no deposit.
const STRAYED: f64 = 0.02;

impl Next<'_> {
    /// Its grains, packed and moving. They start the run-in upstream of the last grain that is there, with the velocity with which they come as
    /// fast to the tail of what lies there as the design says.
    pub fn ready(&self, simulation: &Simulation, stop: &AtomicBool) -> Result<Ready, PackingError> {
        let (mut flow, channel) = (self.design.flow.alone(self.number), &self.design.channel);
        let room = 0.5 * flow.sizes.quantile(1.0);
        let [last, tail] = ends_of(simulation);
        let [strays, meets] = [last, tail].map(|x| self.reach.max(room + along_the_bed(channel, x)));
        if let Arrival::Surge(surge) = &mut flow.arrival {
            surge.run_in += strays - meets;
        }
        let block = Block::of(&flow, channel, meets);
        let wanted = block.area();
        let seed = self.seed.wrapping_add((self.number as u64) << SEED_OF_A_SURGE);
        let attempts = Attempts { stop, failed: 0, next: &mut |_| () };
        let (mut grains, block) = packed_block(&flow, channel, &block, seed, attempts)?;
        let start = block.length - block.front;
        let known = farthest_upstream(self.design, self.reach);
        if channel.ground().is_some() && start > known {
            return Err(PackingError::BeyondTheGround { start, known });
        }
        grains.iter_mut().zip(self.first..).for_each(|(grain, id)| grain.id = id);
        Ok(Ready { grains, last, packed_share: wanted / block.area() })
    }
}

/// Along the channel (m): the upstream end of the last grain, and where the tail of all that is upstream of the barrier ends.
fn ends_of(simulation: &Simulation) -> [f64; 2] {
    let places = simulation.grains.place.iter().zip(&simulation.grains.bodies);
    let mut places: Vec<[f64; 2]> = places
        .map(|(place, body)| [place.0[0] - body.radius - body.offset, body.mass])
        .filter(|[x, _]| *x < 0.0)
        .collect();
    places.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let strayed = STRAYED * places.iter().map(|[_, mass]| mass).sum::<f64>();
    let mut beyond = 0.0;
    let tail = places.iter().find(|[_, mass]| {
        beyond += mass;
        beyond >= strayed
    });
    [places.first(), tail].map(|place| place.map_or(0.0, |[x, _]| *x))
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
        Arrival::Surge(surge) => LONGER * surge.length + surge.run_in + surge.depth,
        Arrival::DamBreak(block) => LONGER * block.length + block.distance,
    };
    reach + first + later.sum::<f64>()
}
