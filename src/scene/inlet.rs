//! Lets the flow of a hydrograph in: packed as it comes, carried to the inlet with the velocity of the table, free from there on.
//!
//! Laid end to end the flow is as long as what passes the inlet is fast, ∫ v dt, and as deep as it is when it passes. So it is packed, as a whole
//! under a ceiling that rises and falls with the depth, and let in from its front on: a few diameters of it always stand behind the inlet.

use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use crate::design::hydrograph::{Hydrograph, HydrographPoint};
use crate::design::{Arrival, Design};
use crate::scene::flow::packing::{Attempts, Growth, PackingError, PackingRoom, Parts, overlaps, pack_watched};
use crate::scene::flow::release::{Block, bodies, shape};
use crate::scene::ground::bed_at;
use crate::section::Section;
use dem::Vec3;
use dem::simulation::Simulation;
use dem::tables::grains::{Grain, GrainBody};
use dem::time::inlet::Inlet;

/// Length of a part of the flow over the largest grain, at the least, and number of parts, at the most.
const LEAST_LENGTH: f64 = 1.5;
const MOST_SUBSTEPS: f64 = 200.0;
/// Height of the room of a part over the largest grain, at the least: what is thinner is loose.
const LEAST_HEIGHT: f64 = 1.2;
/// Length of what stands behind the inlet over the largest grain, at the least and at the most.
const BEHIND: [f64; 2] = [3.0, 6.0];

/// What is still to come in.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Feed {
    /// Grains that wait, the last to come first: how far behind the front each is (m, as x), where across and how high over the bed.
    waiting: Vec<Grain>,
    /// How far behind the front the last is that is in (m).
    last: f64,
    /// Grains that are in, and their mass (kg).
    grains: u32,
    mass: f64,
    /// By which the room of the flow had to grow.
    growth: f64,
}

/// The flow laid end to end, from its tail on: where its parts end, and the mass of each (kg).
fn laid_out(design: &Design, hydrograph: &Hydrograph) -> (Vec<[f64; 2]>, Vec<f64>) {
    let (flow, section) = (&design.flow, design.channel.section());
    let largest = flow.sizes.quantile(1.0);
    let (last, way) = (hydrograph.duration(), hydrograph.way(hydrograph.duration()));
    let count = (way / (LEAST_LENGTH * largest).max(way / MOST_SUBSTEPS)).floor().max(1.0);
    let whole = hydrograph.volume(&section, last);
    // From the tail, which comes last.
    let times: Vec<f64> = (0..=count as usize)
        .map(|end| hydrograph.when(|time| hydrograph.way(time), way * (1.0 - end as f64 / count)))
        .collect();
    let height = |time: f64| hydrograph.at(time).depth.max(LEAST_HEIGHT * largest);
    let ends = times.iter().enumerate().map(|(end, time)| [way * end as f64 / count, height(*time)]).collect();
    let passes = |pair: &[f64]| hydrograph.volume(&section, pair[0]) - hydrograph.volume(&section, pair[1]);
    (ends, times.windows(2).map(|pair| flow.mass * passes(pair) / whole).collect())
}

/// How far upstream of the barrier's foot the inlet is, along the bed (m).
fn distance(design: &Design, reach: f64) -> f64 {
    let Arrival::Surge(surge) = design.flow.arrival else { return reach };
    reach + surge.run_in
}

/// The inlet of a hydrograph, for a barrier that reaches so far upstream (m).
///
/// # Errors
/// Where the bed breaks behind it.
pub fn inlet(design: &Design, hydrograph: &Hydrograph, reach: f64) -> Result<Inlet, PackingError> {
    let distance = distance(design, reach);
    let (place, [along, _]) = bed_at(&design.channel, -distance);
    let length = BEHIND[1] * design.flow.sizes.quantile(1.0);
    let (behind, _) = bed_at(&design.channel, -distance - length);
    if (place - along * length - behind).norm() > 1e-3 * length {
        return Err(PackingError::BedBreaksBehindTheInlet { distance, length });
    }
    let velocity = hydrograph.rows.iter().map(|row| [row.time, row.velocity]).collect();
    Ok(Inlet::new(place, along, velocity))
}

/// As a block, what stands behind the inlet at the most.
pub fn block_behind(design: &Design, hydrograph: &Hydrograph, reach: f64) -> Block {
    let most = |of: fn(&HydrographPoint) -> f64| hydrograph.rows.iter().map(of).fold(0.0, f64::max);
    let largest = design.flow.sizes.quantile(1.0);
    let height = most(|row| row.depth).max(LEAST_HEIGHT * largest);
    Block::behind_an_inlet(distance(design, reach), BEHIND[1] * largest, height, most(|row| row.velocity))
}

impl Feed {
    /// The flow packed, and its first grains let into a simulation that has its inlet and no grains.
    ///
    /// # Errors
    /// Where the grains cannot be packed.
    pub fn begin(
        design: &Design,
        hydrograph: &Hydrograph,
        seed: u64,
        simulation: &mut Simulation,
        stop: &AtomicBool,
    ) -> Result<Self, PackingError> {
        let (waiting, growth) = packed(design, hydrograph, seed, stop)?;
        let mut feed = Self { waiting, last: 0.0, grains: 0, mass: 0.0, growth };
        feed.go_on(design, simulation)?;
        Ok(feed)
    }

    /// Grains that are in.
    pub fn grains(&self) -> u32 {
        self.grains
    }

    /// Mass that is in (kg).
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Whether all are in.
    pub fn is_over(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Density of the packed flow over the one asked for.
    pub fn packed_share(&self) -> f64 {
        1.0 / self.growth
    }

    /// Lets in what is to stand behind the inlet now; returns its mass (kg).
    ///
    /// # Errors
    /// Where something stands in its way.
    pub fn go_on(&mut self, design: &Design, simulation: &mut Simulation) -> Result<f64, PackingError> {
        let Some((inlet, hydrograph)) = simulation.model.inlet.as_ref().zip(design.flow.hydrograph.as_ref()) else {
            return Ok(0.0);
        };
        let largest = design.flow.sizes.quantile(1.0);
        let passed = hydrograph.way(simulation.time);
        if self.is_over() || self.last - passed > BEHIND[0] * largest {
            return Ok(0.0);
        }
        self.last = passed + BEHIND[1] * largest;
        let stay = self.waiting.partition_point(|grain| grain.position.x > self.last);
        let up = inlet.along.cross(&Vec3::y());
        let placed = self.waiting.split_off(stay).into_iter().rev().map(|grain| Grain {
            position: inlet.place
                + inlet.along * (passed - grain.position.x)
                + Vec3::y() * grain.position.y
                + up * grain.position.z,
            axis: inlet.along * grain.axis.x + Vec3::y() * grain.axis.y + up * grain.axis.z,
            ..grain
        });
        let grains: Vec<Grain> = placed.zip(self.grains..).map(|(grain, id)| Grain { id, ..grain }).collect();
        let there = simulation.snapshot();
        let carried = |row: usize| simulation.grains.carried.get(row) == Some(&true);
        let free = there.iter().enumerate().filter(|(row, _)| !carried(*row)).map(|(_, grain)| grain);
        if overlaps(&grains, free) {
            return Err(PackingError::InletIsBlocked { time: simulation.time });
        }
        let mass = grains.iter().map(|grain| grain.body.mass).sum::<f64>();
        self.grains += grains.len() as u32;
        self.mass += mass;
        simulation.carry_in(&grains);
        Ok(mass)
    }
}

/// The grains of the whole flow, by how far behind its front they are, the last first; and by how much its room had to grow.
fn packed(
    design: &Design,
    hydrograph: &Hydrograph,
    seed: u64,
    stop: &AtomicBool,
) -> Result<(Vec<Grain>, f64), PackingError> {
    let (flow, channel) = (&design.flow, &design.channel);
    let (ends, masses) = laid_out(design, hydrograph);
    let mut bodies = bodies(flow);
    fastrand::Rng::with_seed(seed).shuffle(&mut bodies);
    let parts = Parts { counts: counts(&bodies, &masses), ends };
    let ground = channel.ground();
    let breadth = ground.as_ref().map_or(channel.width, |survey| Section::Surveyed(survey.clone()).breadth());
    let (length, height) =
        parts.ends.iter().fold((0.0, 0.0), |(_, most): (f64, f64), [x, height]| (*x, most.max(*height)));
    let room = PackingRoom {
        ground: ground.as_ref(),
        grows: Growth::Up,
        parts: Some(&parts),
        ..PackingRoom::level(Vec3::new(length, breadth, height), true)
    };
    let attempts = Attempts { stop, failed: 0, next: &mut |_| () };
    let (mut grains, growth) = pack_watched(&bodies, shape(flow), room, seed, attempts)?;
    grains.iter_mut().for_each(|grain| grain.position.x = length - grain.position.x);
    // Their axes stay: they look downstream.
    grains.sort_by(|a, b| b.position.x.total_cmp(&a.position.x));
    Ok((grains, growth))
}

/// How many of the bodies, in their order, each part holds: until the middle of one is beyond its mass.
fn counts(bodies: &[GrainBody], masses: &[f64]) -> Vec<usize> {
    let (mut sum, mut up_to, mut next) = (0.0, 0.0, 0);
    let mut counts: Vec<usize> = masses
        .iter()
        .map(|mass| {
            up_to += mass;
            let before = next;
            while next < bodies.len() && sum + 0.5 * bodies[next].mass < up_to {
                sum += bodies[next].mass;
                next += 1;
            }
            next - before
        })
        .collect();
    if let Some(last) = counts.last_mut() {
        *last += bodies.len() - next;
    }
    counts
}
