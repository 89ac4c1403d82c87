//! A model in motion: one step after the other.

use rayon::prelude::*;

use crate::dem::Vec3;
use crate::dem::contact::grain_pairs::{PairConstants, PairContext, load_border, load_inner};
use crate::dem::contact::law::LawConstants;
use crate::dem::contact::restitution::damping_ratio_for;
use crate::dem::contact::ropes::RopeContext;
use crate::dem::contact::surfaces::{SurfaceContext, SurfaceForces, load_surfaces};
use crate::dem::ledger::{ContactSums, Ledger};
use crate::dem::neighbours::blocks::Block;
use crate::dem::neighbours::drift::strayed;
use crate::dem::neighbours::renew::{Bodies, Neighbours};
use crate::dem::net::{NetForces, pull_all, slide_all};
use crate::dem::tables::barrier::Barrier;
use crate::dem::tables::grains::{Grain, GrainShape, Member, MemberLoad, place_members};
use crate::dem::tables::surfaces::{Surface, SurfaceRole};
use crate::dem::time::integrate::{MotionSums, Stretch, move_grains, move_nodes};
use crate::dem::time::stable_step::{Audit, StepRatio};

/// Steps between two audits of the stable step.
const STEPS_PER_AUDIT: u64 = 250;

/// Step over critical step to which the time step is cut when an audit finds it beyond the critical step.
const STEP_AFTER_CUT: f64 = 0.95;

/// Share of the first time step below which a run is given up.
const SHORTEST_STEP: f64 = 0.05;

/// What the grains are made of, as contacts feel it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Contact modulus E (Pa): k = 2 E r₁ r₂/(r₁+r₂).
    pub modulus: f64,
    /// Normal restitution ε, 0 < ε ≤ 1.
    pub restitution: f64,
    /// k_t / k_n, 2/7 by Silbert 2001.
    pub tangential_ratio: f64,
    /// Friction coefficient between grains, tan φ.
    pub friction: f64,
}

/// Everything that is simulated, at rest or in motion.
#[derive(Clone, Debug)]
pub struct Model {
    pub shape: GrainShape,
    pub grains: Vec<Grain>,
    pub surfaces: Vec<Surface>,
    pub barrier: Option<Barrier>,
    pub material: Material,
    /// m/s², in the channel frame.
    pub gravity: Vec3,
    /// Tops of the rigid wall's segments from the bottom (m); empty without a rigid wall.
    pub wall_levels: Vec<f64>,
    /// Grains beyond this x are taken out of the model (m).
    pub outlet: f64,
}

/// Why a run cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unstable {
    #[error("grain {id} left all bounds at t = {time:.4} s (speed {speed:.3e} m/s)")]
    Grain { id: u32, time: f64, speed: f64 },
    #[error("no time step is stable at t = {time:.4} s: cut down to {step:.3e} s")]
    Step { time: f64, step: f64 },
    #[error("barrier node {node} left all bounds at t = {time:.4} s (speed {speed:.3e} m/s)")]
    Node { node: usize, time: f64, speed: f64 },
}

/// Extremes met so far that bear on credibility.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extremes {
    /// Largest overlap over the smaller radius.
    pub overlap_ratio: f64,
    /// Largest step over critical step.
    pub step_ratio: StepRatio,
}

/// Sums over all blocks for the step just made.
#[derive(Clone, Debug, Default)]
pub struct StepSums {
    pub contacts: ContactSums,
    pub surfaces: SurfaceForces,
    pub net: NetForces,
}

pub struct Simulation {
    pub model: Model,
    pub members: Vec<Member>,
    loads: Vec<MemberLoad>,
    pub neighbours: Neighbours,
    /// Time step (s).
    pub time_step: f64,
    /// Viscous slowing of all grains (1/s), for preparation only.
    pub drag: f64,
    /// Steps made.
    pub steps: u64,
    /// Time since the start (s).
    pub time: f64,
    pub sums: StepSums,
    pub ledger: Ledger,
    pub extremes: Extremes,
    /// How often an audit has shortened the time step.
    pub step_cuts: u32,
    first_time_step: f64,
    damping_ratio: f64,
    kinetic_before: MotionSums,
    /// Speed no grain or node can have by honest means (m/s).
    speed_limit: f64,
}

impl Simulation {
    pub fn new(model: Model, time_step: f64, skin: f64, speed_limit: f64) -> Self {
        let per_grain = model.shape.members();
        let mut members = vec![Member::default(); model.grains.len() * per_grain];
        for (grain, rows) in model.grains.iter().zip(members.chunks_exact_mut(per_grain)) {
            place_members(grain, rows);
        }
        let damping_ratio = damping_ratio_for(model.material.restitution);
        let mut simulation = Self {
            members,
            loads: Vec::new(),
            neighbours: Neighbours::new(skin),
            time_step,
            drag: 0.0,
            steps: 0,
            time: 0.0,
            sums: StepSums::default(),
            ledger: Ledger::default(),
            extremes: Extremes::default(),
            step_cuts: 0,
            first_time_step: time_step,
            damping_ratio,
            kinetic_before: MotionSums::default(),
            speed_limit,
            model,
        };
        simulation.kinetic_before = simulation.motion_now();
        simulation
    }

    /// Advances the model by one step.
    pub fn step(&mut self) -> Result<(), Unstable> {
        if self.neighbours.expired(self.model.barrier.as_ref()) {
            self.check_finite()?;
            self.renew();
        }
        self.steps += 1;
        self.load();
        self.gather_sums();
        if self.steps.is_multiple_of(STEPS_PER_AUDIT) && self.drag == 0.0 {
            self.audit()?;
        }
        self.advance();
        self.time += self.time_step;
        Ok(())
    }

    /// Takes away all surfaces of the given role (opens the gate).
    pub fn remove_surfaces(&mut self, role: SurfaceRole) {
        self.model.surfaces.retain(|surface| surface.role != role);
        self.neighbours.forget_surfaces();
    }

    /// Restarts clock, energy account and extremes: what follows is the event itself.
    pub fn start_account(&mut self) {
        self.time = 0.0;
        self.ledger = Ledger::default();
        self.extremes = Extremes::default();
        self.kinetic_before = self.motion_now();
    }

    fn law(&self) -> LawConstants {
        LawConstants {
            damping_ratio: self.damping_ratio,
            tangential_ratio: self.model.material.tangential_ratio,
            time_step: self.time_step,
        }
    }

    fn renew(&mut self) {
        let carried = self.remove_departed();
        self.ledger.carried_out += carried;
        let mut bodies = Bodies {
            shape: self.model.shape,
            grains: &mut self.model.grains,
            surfaces: &self.model.surfaces,
            barrier: self.model.barrier.as_ref(),
            step: self.steps as u32,
        };
        self.neighbours.renew(&mut bodies, &mut self.members);
        self.loads.resize(self.members.len(), MemberLoad::default());
    }

    /// Removes grains beyond the outlet; returns the energy they carry (J).
    fn remove_departed(&mut self) -> f64 {
        let (outlet, gravity) = (self.model.outlet, self.model.gravity);
        let mut carried = 0.0;
        let before = &mut self.kinetic_before;
        self.model.grains.retain(|grain| {
            let stays = grain.position.x <= outlet;
            if !stays {
                let spin_energy = 0.5 * grain.spin().dot(&grain.angular_momentum);
                let kinetic = 0.5 * grain.body.mass * grain.velocity.norm_squared() + spin_energy;
                before.kinetic -= kinetic;
                before.rotational -= spin_energy;
                carried += kinetic - grain.body.mass * gravity.dot(&grain.position);
            }
            stays
        });
        carried
    }

    /// Forces of all contacts and elements, at the present places.
    fn load(&mut self) {
        let law = self.law();
        let step = self.steps as u32;
        let Self { model, members, loads, neighbours, sums, .. } = self;
        let forces = BlockForces { model, members, law, step };
        let block_rows = neighbours.blocks.first().map_or(1, |block| block.members.len().max(1));
        let (net, ()) = rayon::join(
            || model.barrier.as_ref().map(|barrier| pull_all(barrier, law.time_step)),
            || {
                let rows = loads.par_chunks_mut(block_rows).zip(neighbours.blocks.par_iter_mut());
                rows.for_each(|(loads, block)| forces.load_block(block, loads));
            },
        );
        sums.net = net.unwrap_or_default();
    }

    /// Adds up the blocks in their fixed order.
    fn gather_sums(&mut self) {
        let mut contacts = ContactSums::default();
        let mut surfaces = std::mem::take(&mut self.sums.surfaces);
        surfaces.reset(self.model.wall_levels.len());
        for block in &self.neighbours.blocks {
            contacts.add(&block.sums);
            surfaces.add(&block.surface_forces);
            for push in &block.ropes.pushes {
                self.sums.net.push(push);
            }
        }
        self.ledger.lost_damping += contacts.lost_damping;
        self.ledger.lost_friction += contacts.lost_friction;
        self.ledger.stored_contacts = contacts.stored;
        self.ledger.stored_barrier = self.sums.net.stored;
        self.ledger.lost_ropes += self.sums.net.lost_ropes;
        self.extremes.overlap_ratio = self.extremes.overlap_ratio.max(contacts.overlap_ratio);
        self.sums.contacts = contacts;
        self.sums.surfaces = surfaces;
    }

    /// Holds the time step against what is connected now, and cuts it where it is too long.
    fn audit(&mut self) -> Result<(), Unstable> {
        let audit = Audit {
            grains: &self.model.grains,
            members: &self.members,
            per_grain: self.model.shape.members(),
            surfaces: &self.model.surfaces,
            barrier: self.model.barrier.as_ref(),
            blocks: &self.neighbours.blocks,
            law: self.law(),
            modulus: self.model.material.modulus,
            friction: self.model.material.friction,
            step: self.steps as u32,
        };
        let ratio = audit.ratio();
        let worst = &mut self.extremes.step_ratio;
        *worst = StepRatio { grains: worst.grains.max(ratio.grains), nodes: worst.nodes.max(ratio.nodes) };
        if ratio.largest() > 1.0 {
            self.time_step *= STEP_AFTER_CUT / ratio.largest();
            self.step_cuts += 1;
        }
        if self.time_step < SHORTEST_STEP * self.first_time_step || !ratio.largest().is_finite() {
            return Err(Unstable::Step { time: self.time, step: self.time_step });
        }
        Ok(())
    }

    /// Moves everything through the step and closes the account of the instant the forces belong to.
    fn advance(&mut self) {
        let time = Stretch { step: self.time_step, drag: self.drag };
        let gravity = self.model.gravity;
        let per_grain = self.model.shape.members();
        let mut motion = MotionSums::default();
        if let Some(barrier) = &mut self.model.barrier {
            self.ledger.lost_dissipators += self.sums.net.slip_dissipators(barrier);
            self.ledger.lost_friction += slide_all(barrier);
            motion.add(&move_nodes(&mut barrier.nodes, &self.sums.net.forces, &gravity, self.time_step));
        }
        self.neighbours.elapsed += self.time_step;
        let Neighbours { blocks, references, elapsed, .. } = &mut self.neighbours;
        let rows = blocks.first().map_or(1, |block| block.members.len().max(1));
        let elapsed = *elapsed;
        let moved: Vec<MotionSums> = self
            .model
            .grains
            .par_chunks_mut((rows / per_grain).max(1))
            .zip(self.members.par_chunks_mut(rows))
            .zip(self.loads.par_chunks(rows))
            .zip(references.par_chunks(rows))
            .zip(blocks.par_iter_mut())
            .map(|((((grains, members), loads), references), block)| {
                let sums = move_grains(grains, members, loads, &gravity, time);
                block.strayed = strayed(references, members, elapsed);
                sums
            })
            .collect();
        for sums in &moved {
            motion.add(sums);
        }
        self.ledger.kinetic = 0.5 * (self.kinetic_before.kinetic + motion.kinetic);
        self.ledger.rotational = 0.5 * (self.kinetic_before.rotational + motion.rotational);
        self.ledger.potential = motion.potential;
        self.kinetic_before = motion;
    }

    fn motion_now(&self) -> MotionSums {
        let mut sums = MotionSums::default();
        for grain in &self.model.grains {
            let rotational = 0.5 * grain.spin().dot(&grain.angular_momentum);
            sums.rotational += rotational;
            sums.kinetic += 0.5 * grain.body.mass * grain.velocity.norm_squared() + rotational;
            sums.potential -= grain.body.mass * self.model.gravity.dot(&grain.position);
        }
        for node in self.model.barrier.iter().flat_map(|barrier| &barrier.nodes).filter(|node| !node.fixed) {
            sums.kinetic += 0.5 * node.mass * node.velocity.norm_squared();
            sums.potential -= node.mass * self.model.gravity.dot(&node.position);
        }
        sums
    }

    /// Stops a run that has lost its footing before it can spoil the neighbour search.
    fn check_finite(&self) -> Result<(), Unstable> {
        let limit = self.speed_limit;
        let honest = |position: &Vec3, velocity: &Vec3| {
            position.iter().all(|value| value.is_finite()) && velocity.norm() <= limit
        };
        if let Some(grain) = self.model.grains.iter().find(|grain| !honest(&grain.position, &grain.velocity)) {
            return Err(Unstable::Grain { id: grain.id, time: self.time, speed: grain.velocity.norm() });
        }
        let nodes = self.model.barrier.iter().flat_map(|barrier| barrier.nodes.iter().enumerate());
        for (index, node) in nodes {
            if !honest(&node.position, &node.velocity) {
                return Err(Unstable::Node { node: index, time: self.time, speed: node.velocity.norm() });
            }
        }
        Ok(())
    }
}

/// What every block reads while it is loaded.
struct BlockForces<'a> {
    model: &'a Model,
    members: &'a [Member],
    law: LawConstants,
    step: u32,
}

impl BlockForces<'_> {
    fn load_block(&self, block: &mut Block, loads: &mut [MemberLoad]) {
        let Self { model, members, law, step } = *self;
        let material = &model.material;
        loads.fill(MemberLoad::default());
        let constants = PairConstants { law, modulus: material.modulus, friction: material.friction };
        let pairs = PairContext { members, constants, step };
        let mut sums = load_inner(&mut block.inner, &pairs, &block.members, loads);
        sums.add(&load_border(&mut block.border, &pairs, &block.members, loads));
        let surfaces = SurfaceContext {
            members,
            surfaces: &model.surfaces,
            law,
            modulus: material.modulus,
            grain_friction: material.friction,
            step,
            wall_levels: &model.wall_levels,
        };
        block.surface_forces.reset(model.wall_levels.len());
        sums.add(&load_surfaces(&mut block.surfaces, &surfaces, &block.members, loads, &mut block.surface_forces));
        if let Some(barrier) = &model.barrier {
            let context = RopeContext {
                members,
                barrier,
                law,
                grain_modulus: material.modulus,
                grain_friction: material.friction,
                step,
            };
            sums.add(&block.ropes.load(&context, &block.members, loads));
        }
        block.sums = sums;
    }
}
