//! A model in motion: one step after the other.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::contact::law::{LawConstants, Memory, Spring};
use crate::contact::ropes::OnBarrier;
use crate::contact::surfaces::SurfaceForces;
use crate::ledger::{ContactSums, Ledger, MotionEnergy};
use crate::model::Model;
use crate::neighbours::renew::{Bodies, Neighbours};
use crate::net::NetForces;
use crate::sweep::{Stepping, sweep};
use crate::tables::barrier::Barrier;
use crate::tables::fixed::FixedTouch;
use crate::tables::grain_table::GrainTable;
use crate::tables::grains::Grain;
use crate::tables::load_sheets::LoadSheets;
use crate::tables::pores::STEPS_BETWEEN;
use crate::tables::surfaces::SurfaceRole;
use crate::time::inlet::{During, burden};
use crate::time::integrate::{Pace, StepInterval};
use crate::time::links::Linked;
use crate::time::multi_rate::{Accounted, BarrierStep, Lost, Pressing, step_barrier, substeps};
use crate::time::stable_step::{StepRatio, step_ratio};

/// Steps between two audits of the stable step.
const STEPS_PER_AUDIT: u64 = 500;

/// Step over critical step to which the time step is cut when an audit finds it beyond the critical step.
const STEP_AFTER_CUT: f64 = 0.95;

/// Steps between two stops at which all lists are made anew, whatever they are still good for: what is kept there goes on bit for
/// bit like a run that was never interrupted. Where spheres are many they are fewer, so that stops stay some seconds apart.
const STEPS_PER_STOP: [u64; 2] = [200, 2000];
/// Steps of a sphere between two stops, where neither bound holds: about a second of one core.
const WORK_PER_STOP: u64 = 40_000_000;

/// Steps between two stops of so many spheres.
fn steps_per_stop(spheres: usize) -> u64 {
    let [fewest, most] = STEPS_PER_STOP;
    (WORK_PER_STOP / spheres.max(1) as u64).clamp(fewest, most)
}

/// Step of the barrier over its critical step that is aimed at where it takes several in one of the grains', and their largest
/// number.
const BARRIER_STEP_SHARE: f64 = 0.7;
const MOST_SUBSTEPS: u32 = 200;
const ROUNDS_OF_CHOICE: usize = 3;

/// Share of the first time step below which a run is given up.
const SHORTEST_STEP: f64 = 0.05;

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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// Largest overlap over the smaller radius.
    pub overlap_ratio: f64,
    /// Largest step over critical step.
    pub step_ratio: StepRatio,
    /// How often a sphere's centre has gone through a line of the barrier.
    pub crossings: u32,
}

/// Sums over all blocks for the step just made.
#[derive(Clone, Debug, Default)]
pub struct StepSums {
    pub contacts: ContactSums,
    pub surfaces: SurfaceForces,
    /// Mean over the step.
    pub net: NetForces,
    /// In each of the barrier's own steps, where those are several.
    in_substeps: Vec<NetForces>,
}

impl StepSums {
    /// What the barrier bore in each of its own steps: the largest of some tensions is to be taken here, since tensions swing faster than the
    /// grains step.
    pub fn net_in_substeps(&self) -> &[NetForces] {
        if self.in_substeps.is_empty() { std::slice::from_ref(&self.net) } else { &self.in_substeps }
    }
}

/// A contact of a grain with a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceContact {
    /// Row of the grain.
    pub row: usize,
    pub role: SurfaceRole,
    /// Force on the grain (N).
    pub force: Vec3,
    /// m
    pub place: Vec3,
}

#[derive(Serialize, Deserialize)]
pub struct Simulation {
    /// All but the grains; those are in `grains`.
    pub model: Model,
    pub grains: GrainTable,
    #[serde(skip)]
    sheets: LoadSheets,
    pub neighbours: Neighbours,
    /// Time step (s).
    pub time_step: f64,
    /// Whether the step is held against what is connected, and cut; only a study of what happens else leaves it be.
    pub audited: bool,
    /// Viscous slowing of all grains (1/s), for preparation only.
    pub drag: f64,
    /// Steps made.
    pub steps: u64,
    /// Time since the start (s).
    pub time: f64,
    #[serde(skip)]
    pub sums: StepSums,
    /// Losses are booked in every step; energies in place only by [`Self::step_and_account`].
    pub ledger: Ledger,
    pub extremes: Extremes,
    /// How often an audit has shortened the time step.
    pub step_cuts: u32,
    /// Steps of the barrier in one of the grains'.
    pub barrier_substeps: u32,
    /// Longest step of the barrier that was chosen for what may come to press on it (s).
    pub barrier_step: f64,
    /// Motion of the barrier when the last step began, and what it has lost since, which is booked with the next step.
    barrier_motion: MotionEnergy,
    lost_since: Lost,
    first_time_step: f64,
    law: LawConstants,
    /// Speed no grain or node can have by honest means (m/s).
    speed_limit: f64,
    /// Steps between two stops.
    stop_every: u64,
}

impl Simulation {
    /// A model at rest in time, to be stepped by `time_step` (s). `skin` is the reach of the neighbour lists beyond contact (m), `speed_limit` the
    /// speed beyond which a body has been shot out by an error (m/s).
    ///
    /// ```
    /// use dem::Vec3;
    /// use dem::model::Model;
    /// use dem::simulation::Simulation;
    /// use dem::tables::grains::{Grain, GrainBody, GrainShape};
    ///
    /// // One ball falls freely: after n steps of Δt it has the velocity −g n Δt.
    /// let ball = Grain::at(0, Vec3::new(0.0, 0.0, 5.0), Vec3::x(), GrainBody::sphere(0.1, 2600.0));
    /// let model = Model { grains: vec![ball], gravity: Vec3::new(0.0, 0.0, -9.81), ..Model::empty(GrainShape::Sphere) };
    /// let mut simulation = Simulation::new(model, 1e-3, 0.05, 100.0);
    /// for _ in 0..100 {
    ///     simulation.step().unwrap();
    /// }
    /// assert!((simulation.snapshot()[0].velocity.z + 0.981).abs() < 1e-9);
    /// ```
    pub fn new(mut model: Model, time_step: f64, skin: f64, speed_limit: f64) -> Self {
        let mut grains = GrainTable::of(model.shape, &std::mem::take(&mut model.grains));
        if let Some(pores) = &model.pores {
            grains.grip.resize(grains.len(), pores.grip());
        }
        Self {
            stop_every: steps_per_stop(grains.members()),
            grains,
            sheets: LoadSheets::default(),
            neighbours: Neighbours::new(skin),
            time_step,
            drag: 0.0,
            audited: true,
            steps: 0,
            time: 0.0,
            sums: StepSums::default(),
            ledger: Ledger::default(),
            extremes: Extremes::default(),
            step_cuts: 0,
            barrier_substeps: 1,
            barrier_step: f64::MAX,
            barrier_motion: MotionEnergy::default(),
            lost_since: Lost::default(),
            first_time_step: time_step,
            law: LawConstants::of(&model.material, time_step),
            speed_limit,
            model,
        }
    }

    /// Advances the model by one step.
    pub fn step(&mut self) -> Result<(), Unstable> {
        self.prepare()?;
        self.advance(false);
        Ok(())
    }

    /// Advances the model by one step and closes the energy account of the instant its forces belong to. The energy of motion at
    /// that instant is ½ m v₋·v₊, of the velocities half a step before and after: with it the leapfrog's work, force by force by the
    /// trapezoidal rule, adds up exactly (½ m v₋² and ½ m v₊² would each be off by what the force does in half a step).
    pub fn step_and_account(&mut self) -> Result<(), Unstable> {
        self.prepare()?;
        let before = self.snapshot();
        self.advance(true);
        let MotionEnergy { kinetic, rotational, potential } = self.motion_since(&before);
        let barrier = &self.barrier_motion;
        self.ledger.kinetic = kinetic + barrier.kinetic;
        self.ledger.rotational = rotational + barrier.rotational;
        self.ledger.potential = potential + barrier.potential;
        Ok(())
    }

    /// All grains as they are now.
    pub fn snapshot(&self) -> Vec<Grain> {
        self.grains.grains()
    }

    /// All contacts of grains with surfaces at the present places: the springs as they are now, dashpots and friction as in the
    /// step just made.
    pub fn surface_contacts(&self) -> impl Iterator<Item = SurfaceContact> {
        let lists = self.neighbours.blocks.iter().map(|block| &block.surfaces);
        lists.flat_map(|list| list.touching.iter().zip(&list.memory)).map(|(pair, memory)| {
            let memory = Memory::from_quad(*memory);
            let row = pair[0] as usize / self.grains.shape.members();
            let (centre, radius) = self.grains.rows().sphere(pair[0] as usize);
            let FixedTouch { towards, share, role, .. } = self.model.fixed().touch(pair[1], &centre, radius);
            let overlap = (radius - towards.norm()).max(0.0);
            let inverse_mass = self.grains.rows().member(pair[0] as usize).inverse_mass;
            let spring = Spring::on_fixed(self.model.material.modulus * radius, inverse_mass).part(share);
            let normal_force = spring.pushes(overlap, memory.dashpot);
            let force = Vec3::from(memory.tangential) - towards.normalize() * normal_force;
            SurfaceContact { row, role, force, place: centre + towards }
        })
    }

    /// Puts a barrier up, and chooses how many steps it takes in one of the grains'.
    pub fn put_up(&mut self, barrier: Barrier) {
        self.grains.catch_up();
        self.model.barrier = Some(barrier);
        self.neighbours.lose();
        self.choose_substeps();
    }

    /// Puts the grain in `row` somewhere else, without velocity; it spins on.
    pub fn put(&mut self, row: usize, position: &Vec3) {
        self.grains.place[row].set_vector(position);
        self.grains.motion[row].set_vector(&Vec3::zeros());
        self.grains.ahead.iter_mut().skip(row).take(1).for_each(|ahead| *ahead = [Vec3::zeros(); 2]);
        self.neighbours.lose();
    }

    /// Lets grains in, whose numbers must be new to the run, with the energy that they bring.
    pub fn let_in(&mut self, grains: &[Grain]) {
        for grain in grains {
            let [kinetic, _] = grain.kinetic_energy();
            self.ledger.carried_in += kinetic - grain.body.mass * self.model.gravity.dot(&grain.position);
        }
        self.grains.extend(grains);
        if let Some(pores) = &self.model.pores {
            self.grains.grip.resize(self.grains.len(), pores.grip());
        }
        if !self.grains.ahead.is_empty() {
            self.grains.ahead.resize(self.grains.len(), [Vec3::zeros(); 2]);
        }
        if !self.grains.carried.is_empty() {
            self.grains.carried.resize(self.grains.len(), false);
        }
        self.stop_every = steps_per_stop(self.grains.members());
        self.neighbours.lose();
    }

    /// Lets grains in that the inlet carries, at its velocity, until they have passed it.
    pub fn carry_in(&mut self, grains: &[Grain]) {
        let first = self.grains.len();
        let velocity =
            self.model.inlet.as_ref().map_or(Vec3::zeros(), |inlet| inlet.along * inlet.velocity_at(self.time));
        let moving: Vec<Grain> = grains.iter().map(|grain| Grain { velocity, ..grain.clone() }).collect();
        self.let_in(&moving);
        self.grains.carried.resize(self.grains.len(), false);
        (first..self.grains.len()).for_each(|row| burden(&mut self.grains, row));
    }

    /// Takes away all surfaces of the given role (opens the gate).
    pub fn remove_surfaces(&mut self, role: SurfaceRole) {
        self.model.surfaces.retain(|surface| surface.role != role);
        self.neighbours.forget_surfaces();
    }

    /// Restarts clock, energy account and extremes: what follows is the event itself. What has drained in preparation has not.
    pub fn start_account(&mut self) {
        if let Some(pores) = &self.model.pores {
            self.grains.grip.fill(pores.grip());
        }
        self.time = 0.0;
        self.ledger = Ledger::default();
        self.lost_since = Lost::default();
        self.extremes = Extremes::default();
    }

    /// Whether the simulation may be kept here and taken up again later.
    pub fn at_stop(&self) -> bool {
        self.steps.is_multiple_of(self.stop_every)
    }

    fn law(&self) -> LawConstants {
        LawConstants { time_step: self.time_step, ..self.law }
    }

    /// The law within the barrier, whose steps are shorter.
    fn barrier_law(&self) -> LawConstants {
        self.law().of_substep(self.barrier_substeps)
    }

    /// Steps that the barrier takes in one of the grains'; one where there is none.
    fn substeps(&self) -> u32 {
        if self.model.barrier.is_some() { self.barrier_substeps } else { 1 }
    }

    /// Sees to it that lists and time step are good for the step to come.
    fn prepare(&mut self) -> Result<(), Unstable> {
        if self.at_stop() {
            self.neighbours.rest();
        }
        if self.neighbours.expired(&self.grains, self.model.barrier.as_ref(), self.substeps() > 1) {
            self.check_finite()?;
            self.renew();
        }
        if self.audited && (self.steps + 1).is_multiple_of(STEPS_PER_AUDIT) {
            self.audit()?;
        }
        Ok(())
    }

    fn renew(&mut self) {
        self.remove_departed();
        let mut bodies =
            Bodies { grains: &mut self.grains, fixed: self.model.fixed(), barrier: self.model.barrier.as_ref() };
        self.neighbours.renew(&mut bodies);
    }

    /// Removes grains beyond the outlet and books the energy they carry.
    fn remove_departed(&mut self) {
        let outlet = self.model.outlet;
        if self.grains.place.iter().all(|place| place.0[0] <= outlet) {
            return;
        }
        let (stay, leave): (Vec<u32>, Vec<u32>) =
            (0..self.grains.len() as u32).partition(|&row| self.grains.place[row as usize].0[0] <= outlet);
        for row in leave {
            let grain = self.grains.grain(row as usize);
            let [kinetic, _] = grain.kinetic_energy();
            self.ledger.carried_out += kinetic - grain.body.mass * self.model.gravity.dot(&grain.position);
        }
        self.grains.arrange(&stay);
    }

    /// Adds up the blocks in their fixed order.
    fn gather_sums(&mut self) {
        let mut contacts = ContactSums::default();
        let surfaces = &mut self.sums.surfaces;
        surfaces.reset(self.model.wall.segment_tops.len());
        for block in &self.neighbours.blocks {
            contacts.add(&block.sums);
            surfaces.add(&block.surface_forces);
        }
        self.ledger.lost_damping += contacts.lost_damping;
        self.ledger.lost_friction += contacts.lost_friction;
        self.ledger.stored_contacts = contacts.stored;
        self.extremes.overlap_ratio = self.extremes.overlap_ratio.max(contacts.overlap_ratio);
        self.sums.contacts = contacts;
    }

    /// Holds the time step against what is connected now, and cuts it where it is too long.
    fn audit(&mut self) -> Result<(), Unstable> {
        let barrier = self.model.barrier.as_ref();
        let ratio = if self.barrier_substeps == 1 {
            self.whole_ratio()
        } else {
            let links = self.linked(self.law()).contacts();
            let within = self.linked(self.barrier_law()).within_barrier();
            let mut own = step_ratio(&within, &self.grains, barrier, self.barrier_law().time_step);
            let grains = step_ratio(&links, &self.grains, barrier, self.time_step);
            if own.value > 1.0 && own.value.is_finite() {
                self.note_ratio(own);
                let before = self.barrier_law().time_step;
                self.choose_substeps();
                own.value *= self.barrier_law().time_step / before;
            }
            // Asked so that what is not finite is kept.
            if grains.value > own.value || !grains.value.is_finite() { grains } else { own }
        };
        self.note_ratio(ratio);
        if ratio.value > 1.0 {
            self.time_step *= STEP_AFTER_CUT / ratio.value;
            self.step_cuts += 1;
            // The shorter step may need fewer substeps.
            if self.barrier_substeps > 1 && ratio.value.is_finite() {
                self.choose_substeps();
            }
        }
        if self.time_step < SHORTEST_STEP * self.first_time_step || !ratio.value.is_finite() {
            return Err(Unstable::Step { time: self.time, step: self.time_step });
        }
        Ok(())
    }

    /// Step over critical step of all that is connected now, grains and barrier in one.
    pub fn step_over_critical(&mut self) -> f64 {
        if self.neighbours.expired(&self.grains, self.model.barrier.as_ref(), self.substeps() > 1) {
            self.renew();
        }
        self.whole_ratio().value
    }

    /// Step over critical step of grains and barrier in one.
    fn whole_ratio(&self) -> StepRatio {
        let mut links = self.linked(self.law()).contacts();
        links.extend(self.linked(self.barrier_law()).within_barrier());
        step_ratio(&links, &self.grains, self.model.barrier.as_ref(), self.time_step)
    }

    fn note_ratio(&mut self, ratio: StepRatio) {
        if ratio.value > self.extremes.step_ratio.value || !ratio.value.is_finite() {
            self.extremes.step_ratio = ratio;
        }
    }

    fn linked(&self, law: LawConstants) -> Linked<'_> {
        Linked {
            grains: self.grains.rows(),
            fixed: self.model.fixed(),
            barrier: self.model.barrier.as_ref(),
            blocks: &self.neighbours.blocks,
            law,
            modulus: self.model.material.modulus,
            friction: self.model.material.friction,
            finer: self.barrier_substeps > 1,
        }
    }

    /// As many steps of the barrier in one of the grains' as what holds it together needs, and what may press on it. What is too stiff is
    /// looked for at the step that is chosen: at a longer one dashpots seem to be it.
    fn choose_substeps(&mut self) {
        let least = substeps(self.time_step, self.barrier_step);
        let mut chosen = least;
        for _ in 0..ROUNDS_OF_CHOICE {
            let law = self.law().of_substep(chosen);
            let within = self.linked(law).within_barrier();
            let ratio = step_ratio(&within, &self.grains, self.model.barrier.as_ref(), law.time_step).value;
            let wanted = (f64::from(chosen) * ratio / BARRIER_STEP_SHARE).ceil();
            // What is not finite ends the run at the next audit.
            if !wanted.is_finite() {
                return;
            }
            chosen = (wanted as u32).max(least).min(MOST_SUBSTEPS);
        }
        self.barrier_substeps = chosen;
    }

    /// Moves everything through the step; `account` asks for the energy of the barrier's motion.
    fn advance(&mut self, account: bool) {
        let time = StepInterval { step: self.time_step, drag: self.drag, gravity: self.model.gravity };
        let (law, own) = (self.law(), self.barrier_law());
        let during = During { time: self.time, step: self.time_step, gravity: self.model.gravity };
        if let Some(inlet) = &mut self.model.inlet {
            inlet.carry(&mut self.grains, &mut self.ledger, &during);
        }
        let substeps = self.substeps();
        if substeps > 1 {
            self.grains.ahead.resize(self.grains.len(), [Vec3::zeros(); 2]);
        }
        let mut segments =
            self.model.barrier.as_mut().map_or(Vec::new(), |barrier| std::mem::take(&mut barrier.segments));
        let stepping = Stepping { law, substeps, time };
        let (net, mut paces) =
            sweep(&self.model, &mut segments, &mut self.grains, &self.sheets, &mut self.neighbours, &stepping);
        let time = stepping.time;
        self.model.barrier.iter_mut().for_each(|barrier| barrier.segments = std::mem::take(&mut segments));
        self.gather_sums();
        let fastest_node = self.advance_barrier(net, &mut paces, &own, &time, account);
        if let Some(inlet) = &mut self.model.inlet {
            inlet.let_go(&mut self.grains, &mut self.ledger, &during);
        }
        self.neighbours.tick(&paces, time.step, fastest_node);
        self.steps += 1;
        self.time += self.time_step;
        if let Some(pores) = self.model.pores.filter(|_| self.steps.is_multiple_of(STEPS_BETWEEN)) {
            pores.drain(&mut self.grains, STEPS_BETWEEN as f64 * self.time_step);
        }
    }

    /// Moves the barrier under its own forces at the start of the step, `net`, and those of the grains; returns the largest speed of
    /// a node (m/s).
    fn advance_barrier(
        &mut self,
        net: NetForces,
        paces: &mut [Pace],
        own: &LawConstants,
        time: &StepInterval,
        account: bool,
    ) -> f64 {
        let Some(barrier) = &mut self.model.barrier else { return 0.0 };
        let pressing = Pressing { grains: &mut self.grains, blocks: &mut self.neighbours.blocks, paces };
        let material = &self.model.material;
        let on_barrier = OnBarrier { law: *own, grain_modulus: material.modulus, grain_friction: material.friction };
        let BarrierStep { net, in_substeps, at_account, fastest } =
            step_barrier(barrier, net, pressing, &on_barrier, time, self.barrier_substeps, account);
        self.extremes.crossings += self.neighbours.blocks.iter().map(|block| block.ropes.crossings).sum::<u32>();
        self.extremes.overlap_ratio = self.extremes.overlap_ratio.max(at_account.overlap_ratio);
        let Accounted { motion, stored_barrier, stored_contacts, lost, lost_since, .. } = at_account;
        self.ledger.stored_barrier = stored_barrier;
        self.ledger.stored_contacts += stored_contacts;
        for Lost { barrier: [ropes, rings, dissipators], contacts: [in_dashpots, by_slip] } in [self.lost_since, lost] {
            self.ledger.lost_damping += in_dashpots;
            self.ledger.lost_friction += by_slip + rings;
            self.ledger.lost_ropes += ropes;
            self.ledger.lost_dissipators += dissipators;
        }
        self.lost_since = lost_since;
        self.barrier_motion = motion;
        (self.sums.net, self.sums.in_substeps) = (net, in_substeps);
        fastest
    }

    /// Energies of the grains at the instant between their motion `before` and now, half a step from either; those at the barrier have
    /// theirs.
    fn motion_since(&self, before: &[Grain]) -> MotionEnergy {
        let after = self.snapshot();
        let mut sums = MotionEnergy::default();
        let mut on_its_own = vec![true; after.len()];
        for at_barrier in self.neighbours.blocks.iter().map(|block| &block.at_barrier).filter(|_| self.substeps() > 1) {
            sums.add(&at_barrier.motion, 1.0);
            at_barrier.rows().iter().for_each(|&row| on_its_own[row as usize] = false);
        }
        let others = before.iter().zip(&after).zip(on_its_own).filter(|(_, on_its_own)| *on_its_own);
        sums.add(&MotionEnergy::between(others.map(|(grains, _)| grains), &self.model.gravity), 1.0);
        sums
    }

    /// Stops a run that has lost its footing before it can spoil the neighbour search.
    fn check_finite(&self) -> Result<(), Unstable> {
        let limit = self.speed_limit;
        let honest = |position: &Vec3, velocity: &Vec3| {
            position.iter().all(|value| value.is_finite()) && velocity.norm() <= limit
        };
        for row in 0..self.grains.len() {
            let velocity = self.grains.motion[row].vector();
            if !honest(&self.grains.place[row].vector(), &velocity) {
                return Err(Unstable::Grain { id: self.grains.ids[row], time: self.time, speed: velocity.norm() });
            }
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
