//! Several steps of the barrier within one step of the grains.
//!
//! The stiff, light parts of a barrier (ropes, rings, short cylinders), and the grains that press on them, need shorter steps than grains
//! among themselves do. So forces are split: what acts on grains but the barrier is found once in a step Δt and stays the same in its m substeps;
//! what holds the barrier together, and what grains and barrier do to each other, is found anew in each. The grains at the barrier take these
//! substeps with it ([`crate::time::at_barrier`]). For m = 1 this is the leapfrog itself.
//!
//! Found at the middle of the substeps, slow forces are right to the second order in Δt. They feed a mode that swings at ω under the fast ones by a
//! share of about (ω_s Δt)² (ω Δt)²/48 of its amplitude in a step, with ω_s that of the slow forces alone and both of the grain, not of the light
//! knots that swing with it: far less than what contacts and ropes damp, unless both steps are long for it. That is what the audit of the time step
//! looks for; the energy account would notice it as well. Slow forces that act at once as impulses F Δt (r-RESPA)
//! would keep energy better on the whole, but resonate where ω Δt comes near π, and shake a grain at rest between its neighbours and a rope.

use serde::{Deserialize, Serialize};

use crate::contact::ropes::OnBarrier;
use crate::elements::segment::Segment;
use crate::ledger::{ContactSums, MotionEnergy};
use crate::neighbours::blocks::Block;
use crate::net::{NetForces, OnGround, slide_and_pull};
use crate::tables::barrier::Barrier;
use crate::tables::grain_table::GrainTable;
use crate::tables::nodes::{Frame, Node};
use crate::time::at_barrier::Substepping;
use crate::time::integrate::{Pace, StepInterval, move_nodes, turn_frames};
use crate::workers;
use crate::{Vec3, larger_or_nan};

/// What a step of the grains made of the barrier.
#[derive(Clone, Debug, Default)]
pub struct BarrierStep {
    /// Forces and tensions, mean over the step, and in each substep if they are several.
    pub net: NetForces,
    pub in_substeps: Vec<NetForces>,
    pub at_account: Accounted,
    /// Largest mean speed of a node (m/s).
    pub fastest: f64,
}

/// Energies at the instant of a step that the account is kept at, the middle of its substeps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Accounted {
    /// Motion of the barrier, where it was asked for.
    pub motion: MotionEnergy,
    /// In the barrier, and in the contacts of grains with it if the step has several substeps (J).
    pub stored_barrier: f64,
    pub stored_contacts: f64,
    /// Lost since the first substep, and since the account; the first substep's contacts book their own.
    pub lost: Lost,
    pub lost_since: Lost,
    /// Largest overlap over the smaller radius in the substeps after the first.
    pub overlap_ratio: f64,
}

/// As many substeps of a step as keep each within a longest one, or hardly above it.
pub fn substeps(step: f64, longest: f64) -> u32 {
    ((step / longest - HARDLY).ceil() as u32).max(1)
}

/// Share of a step by which it may be too long before it is divided.
const HARDLY: f64 = 0.1;

/// Losses in some of the substeps of a step (J).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Lost {
    /// In ropes, by rings, in dissipators.
    pub barrier: [f64; 3],
    /// In dashpots and by slip between grains and barrier.
    pub contacts: [f64; 2],
}

impl Lost {
    fn add(&mut self, other: &Self, share: f64) {
        self.barrier.iter_mut().zip(other.barrier).for_each(|(sum, lost)| *sum += share * lost);
        self.contacts.iter_mut().zip(other.contacts).for_each(|(sum, lost)| *sum += share * lost);
    }

    fn in_barrier(&mut self, net: &NetForces) {
        self.barrier.iter_mut().zip(net.losses()).for_each(|(sum, lost)| *sum += lost);
    }

    fn in_contacts(&mut self, sums: &ContactSums) {
        self.contacts[0] += sums.lost_damping;
        self.contacts[1] += sums.lost_friction;
    }
}

/// The middle of the substeps of a step: one substep, or two that count half each.
#[derive(Clone, Copy)]
struct Middle {
    first: u32,
    last: u32,
}

impl Middle {
    fn of(substeps: u32) -> Self {
        Self { first: (substeps - 1) / 2, last: substeps / 2 }
    }

    /// Share of a substep in the middle.
    fn weight(self, substep: u32) -> f64 {
        if substep < self.first || substep > self.last { 0.0 } else { 1.0 / f64::from(self.last - self.first + 1) }
    }

    /// Share of what is lost up to a substep, since the one before, that is lost before the middle.
    fn before(self, substep: u32) -> f64 {
        if substep <= self.first { 1.0 } else { self.weight(substep) }
    }
}

/// The grains, and the blocks that load them.
pub struct Pressing<'a> {
    pub grains: &'a mut GrainTable,
    pub blocks: &'a mut [Block],
    /// Pace of each block.
    pub paces: &'a mut [Pace],
}

/// Moves the barrier through one step of the grains, in `substeps` steps of its own, and if they are several the grains at it. `net` holds the
/// forces at the start; `account` asks for the energy of the barrier's motion.
pub fn step_barrier(
    barrier: &mut Barrier,
    mut net: NetForces,
    pressing: Pressing,
    on_barrier: &OnBarrier,
    time: &StepInterval,
    substeps: u32,
    account: bool,
) -> BarrierStep {
    let Pressing { grains, blocks, paces } = pressing;
    let before: Vec<Vec3> = barrier.nodes.iter().map(|node| node.position).collect();
    for block in &*blocks {
        let pushes = if substeps > 1 { &block.at_barrier.pushes } else { &block.ropes.pushes };
        pushes.iter().for_each(|push| net.push(push));
    }
    let own = StepInterval { step: time.step / f64::from(substeps), ..*time };
    let mut course = Course { own, middle: Middle::of(substeps), account, accounted: Accounted::default() };
    course.move_barrier(0, Lost::default(), &net, barrier);
    let mut in_substeps = Vec::new();
    if substeps > 1 {
        let substepping = Substepping { step: time.step, substeps };
        course.see_blocks(0, blocks);
        workers::for_each(blocks.iter_mut(), |_, Block { at_barrier, .. }| {
            at_barrier.hold(grains, time.step);
            at_barrier.go(&own, course.noted(0));
        });
        in_substeps.push(net);
        for substep in 1..substeps {
            let mut lost = Lost::default();
            let net = pull_and_press(barrier, blocks, on_barrier, &course, substep);
            course.see_blocks(substep, blocks);
            blocks.iter().for_each(|block| lost.in_contacts(&block.at_barrier.sums));
            course.move_barrier(substep, lost, &net, barrier);
            in_substeps.push(net);
        }
        net = NetForces::mean(&in_substeps);
        for (block, pace) in blocks.iter_mut().zip(paces) {
            let own = block.at_barrier.finish(&mut block.ropes, grains, &substepping);
            pace.stray = pace.stray.max(own.stray);
        }
    }
    let fastest = fastest_on_the_way(barrier, &before, time.step);
    BarrierStep { net, in_substeps, at_account: course.accounted, fastest }
}

/// The substeps of a step, one after the other.
struct Course {
    own: StepInterval,
    middle: Middle,
    /// Whether the energy of motion is asked for.
    account: bool,
    accounted: Accounted,
}

impl Course {
    /// Weight of a substep in the account, where it has some and there is one.
    fn noted(&self, substep: u32) -> Option<f64> {
        let weight = self.middle.weight(substep);
        (self.account && weight > 0.0).then_some(weight)
    }

    /// Takes in what the contacts of grains with the barrier store in a substep.
    fn see_blocks(&mut self, substep: u32, blocks: &[Block]) {
        for sums in blocks.iter().map(|block| &block.at_barrier.sums) {
            self.accounted.stored_contacts += self.middle.weight(substep) * sums.stored;
            self.accounted.overlap_ratio = self.accounted.overlap_ratio.max(sums.overlap_ratio);
        }
    }

    /// Moves the barrier through a substep, and books it; `lost` is what has been lost since the substep before, besides what `net` tells.
    fn move_barrier(&mut self, substep: u32, mut lost: Lost, net: &NetForces, barrier: &mut Barrier) {
        let Self { middle, accounted, .. } = self;
        lost.in_barrier(net);
        accounted.lost.add(&lost, middle.before(substep));
        accounted.lost_since.add(&lost, 1.0 - middle.before(substep));
        accounted.stored_barrier += middle.weight(substep) * net.stored;
        net.take_over(barrier);
        let Some(weight) = self.noted(substep) else { return go(barrier, net, &self.own) };
        let (nodes, frames) = (barrier.nodes.clone(), barrier.frames.clone());
        go(barrier, net, &self.own);
        self.accounted.motion.add(&motion_since(&nodes, &frames, barrier, &self.own.gravity), weight);
    }
}

/// A share of the work of a substep.
enum Work<'a> {
    Elements(&'a mut [Segment], &'a mut NetForces),
    Ground(&'a mut OnGround),
    Block(&'a mut Block),
}

/// Forces within the barrier and those of the grains on it, at the present places; the grains are loaded with what the barrier does to them, and
/// moved.
fn pull_and_press(
    barrier: &mut Barrier,
    blocks: &mut [Block],
    on_barrier: &OnBarrier,
    course: &Course,
    substep: u32,
) -> NetForces {
    let (mut net, mut on_ground) = (NetForces::default(), OnGround::default());
    let mut segments = std::mem::take(&mut barrier.segments);
    let seen = &*barrier;
    // The longest work first.
    let mut busy: Vec<&mut Block> = blocks.iter_mut().filter(|block| !block.at_barrier.rows().is_empty()).collect();
    busy.sort_by_key(|block| std::cmp::Reverse(block.at_barrier.pairs()));
    let work = std::iter::once(Work::Elements(&mut segments, &mut net)).chain(busy.into_iter().map(Work::Block));
    workers::for_each(work.chain([Work::Ground(&mut on_ground)]), |_, work| match work {
        Work::Elements(segments, net) => *net = slide_and_pull(seen, segments, &on_barrier.law),
        Work::Ground(on_ground) => *on_ground = OnGround::of(seen, &on_barrier.law),
        Work::Block(Block { at_barrier, ropes, .. }) => {
            at_barrier.press(ropes, seen, on_barrier);
            at_barrier.go(&course.own, course.noted(substep));
        }
    });
    barrier.segments = segments;
    net.rest(on_ground);
    blocks.iter().flat_map(|block| &block.at_barrier.pushes).for_each(|push| net.push(push));
    net
}

/// Moves nodes and frames through one step.
fn go(barrier: &mut Barrier, net: &NetForces, own: &StepInterval) {
    move_nodes(&mut barrier.nodes, &net.forces, &own.gravity, own.step);
    turn_frames(&mut barrier.frames, &net.torques, own.step);
}

/// Energies of motion and place at the instant between `nodes` and `frames` as they moved before it and the barrier as it moves now.
fn motion_since(nodes: &[Node], frames: &[Frame], barrier: &Barrier, gravity: &Vec3) -> MotionEnergy {
    let mut sums = MotionEnergy::default();
    for (before, after) in nodes.iter().zip(&barrier.nodes).filter(|(node, _)| !node.fixed) {
        sums.kinetic += 0.5 * before.mass * before.velocity.dot(&after.velocity);
        sums.potential -= before.mass * gravity.dot(&before.position);
    }
    for (before, after) in frames.iter().zip(&barrier.frames).filter(|(frame, _)| !frame.held) {
        let turning = 0.5 * before.inertia * before.spin.dot(&after.spin);
        sums.kinetic += turning;
        sums.rotational += turning;
    }
    sums
}

/// Largest mean speed over the step (m/s).
fn fastest_on_the_way(barrier: &Barrier, before: &[Vec3], step: f64) -> f64 {
    let ways = barrier.nodes.iter().zip(before).map(|(node, before)| (node.position - before).norm_squared());
    ways.fold(0.0, larger_or_nan).sqrt() / step
}
