//! One pass through the blocks in every step: a block is loaded, and moved while the cache still has it.
//!
//! The first block of a pair owns it. So once a block and all before it are loaded, nobody asks any more where its grains
//! were, all their loads are there, and they may be moved; later blocks are loaded at the same time.

#![allow(unsafe_code)]

use std::sync::{PoisonError, RwLock};

use crate::contact::grain_pairs::{PairContext, load_border, load_inner};
use crate::contact::grain_touch::PairConstants;
use crate::contact::law::LawConstants;
use crate::contact::ropes::{OnBarrier, RopeContext};
use crate::contact::surfaces::{SurfaceContext, load_surfaces};
use crate::elements::segment::Segment;
use crate::model::Model;
use crate::neighbours::blocks::{Block, OutgoingLoads};
use crate::neighbours::renew::Neighbours;
use crate::net::{NetForces, OnGround, slide_and_pull};
use crate::simd::eight::LANES;
use crate::tables::barrier::Barrier;
use crate::tables::grain_rows::{GrainRows, Prefetcher, RowsInMotion};
use crate::tables::grain_table::{GrainLoad, GrainTable};
use crate::tables::load_sheets::LoadSheets;
use crate::time::at_barrier::{Moving, Substepping};
use crate::time::integrate::{Pace, StepInterval};
use crate::workers;

/// The step that is made.
pub struct Stepping {
    pub law: LawConstants,
    /// Steps of the barrier in it.
    pub substeps: u32,
    pub time: StepInterval,
}

/// Loads all grains and moves them through one step; lets the ropes of the barrier slide and pulls at the barrier, which stays where it is, as at the
/// start of its own step. `segments` are those of the barrier, taken out of it. Where the step has several substeps, the ropes load the grains at
/// the barrier for the first of these alone. Returns the forces within the barrier, without those of the grains, and the pace of each block.
pub fn sweep(
    model: &Model,
    segments: &mut [Segment],
    grains: &mut GrainTable,
    sheets: &LoadSheets,
    neighbours: &mut Neighbours,
    stepping: &Stepping,
) -> (NetForces, Vec<Pace>) {
    let Stepping { law, substeps, ref time } = *stepping;
    let Neighbours { blocks, outgoing, drift, .. } = neighbours;
    let outgoing = &*outgoing;
    let barrier_law = law.of_substep(substeps);
    // No step changes it: it is read while rows are moved.
    let grip = std::mem::take(&mut grains.grip);
    let ahead = std::mem::take(&mut grains.ahead);
    let rows = RowsInMotion::of(grains, drift);
    let forces = BlockForces {
        model,
        grains: rows.seen(),
        law,
        barrier_law,
        substeps,
        moving: Moving { drift, ahead: &ahead },
        grip: &grip,
        workers: workers::count(),
    };
    let (mut net, mut on_ground) = (NetForces::default(), OnGround::default());
    let mut paces = vec![Pace::default(); blocks.len()];
    let barrier = model.barrier.as_ref();
    let elements = barrier.map(|barrier| Part::Elements(barrier, segments, &mut net));
    let ground = barrier.map(|barrier| Part::Ground(barrier, &mut on_ground));
    let turns = blocks.iter_mut().zip(&mut paces).enumerate();
    let turns = turns.map(|(number, (block, pace))| {
        let prefetcher = Prefetcher::none(rows.seen());
        Part::Block(Turn { number, block, loads: Vec::new(), prefetcher, pace })
    });
    workers::wave(
        elements.into_iter().chain(turns).chain(ground),
        |part| match part {
            Part::Elements(barrier, segments, net) => **net = slide_and_pull(barrier, segments, &barrier_law),
            Part::Ground(barrier, on_ground) => **on_ground = OnGround::of(barrier, &barrier_law),
            Part::Block(turn) => {
                let mut outgoing = outgoing[turn.number].write().unwrap_or_else(PoisonError::into_inner);
                turn.loads = sheets.take(turn.block.grains.len());
                turn.prefetcher = forces.prefetcher(turn.block);
                forces.load_block(turn.block, &mut turn.loads, &mut outgoing, &mut turn.prefetcher);
            }
        },
        |part| {
            if let Part::Block(turn) = part {
                turn.take_remote_loads(outgoing);
                // SAFETY: this block and all before it are loaded. Later blocks read no rows but their own and those of
                // blocks after them, and every block is moved once.
                let moving = unsafe { rows.take(&turn.block.grains, &mut turn.loads) };
                *turn.pace = moving.advance(time, &mut turn.prefetcher);
                sheets.give_back(std::mem::take(&mut turn.loads));
            }
        },
    );
    (grains.grip, grains.ahead) = (grip, ahead);
    net.rest(on_ground);
    (net, paces)
}

/// A part of the work of a step.
enum Part<'a> {
    Elements(&'a Barrier, &'a mut [Segment], &'a mut NetForces),
    Ground(&'a Barrier, &'a mut OnGround),
    Block(Turn<'a>),
}

/// A block's turn.
struct Turn<'a> {
    number: usize,
    block: &'a mut Block,
    loads: Vec<GrainLoad>,
    prefetcher: Prefetcher<'a>,
    pace: &'a mut Pace,
}

impl Turn<'_> {
    /// Adds the loads that earlier blocks have for the grains of this one, in the order of the blocks.
    fn take_remote_loads(&mut self, outgoing: &[RwLock<OutgoingLoads>]) {
        let start = self.block.grains.start;
        for sender in &outgoing[..self.number] {
            let sender = sender.read().unwrap_or_else(PoisonError::into_inner);
            for remote in sender.for_block(self.number) {
                let load = GrainLoad { force: remote.force, torque: remote.torque };
                self.loads[remote.row as usize - start].join(&load);
            }
        }
    }
}

/// What every block reads while it is loaded.
struct BlockForces<'a> {
    model: &'a Model,
    grains: GrainRows<'a>,
    law: LawConstants,
    barrier_law: LawConstants,
    substeps: u32,
    moving: Moving<'a>,
    /// Share of the friction that acts on each grain; empty in a dry flow.
    grip: &'a [f64],
    /// Threads that share the blocks.
    workers: usize,
}

impl<'a> BlockForces<'a> {
    /// The rows of the block that this thread is likely to take next, asked for over the time that one block takes.
    fn prefetcher(&self, block: &Block) -> Prefetcher<'a> {
        let ahead = self.workers * block.grains.len();
        let next = block.grains.start + ahead..block.grains.end + ahead;
        Prefetcher::of(self.grains, &next, (block.inner.touching.len() + block.grains.len()) / LANES)
    }

    fn load_block(
        &self,
        block: &mut Block,
        loads: &mut [GrainLoad],
        outgoing: &mut OutgoingLoads,
        prefetcher: &mut Prefetcher<'a>,
    ) {
        let Self { model, grains, law, .. } = *self;
        let clocks = block.clocks;
        let material = &model.material;
        outgoing.clear();
        let (modulus, friction) = (material.modulus, material.friction);
        let constants = PairConstants { law, modulus, friction, grip: self.grip };
        let pairs = |clock| PairContext { grains, constants, clock };
        let mut sums = load_inner(&mut block.inner, &pairs(clocks.inner), &block.grains, loads, prefetcher);
        sums.add(&load_border(&mut block.border, &pairs(clocks.border), &block.grains, loads, outgoing));
        let surfaces = SurfaceContext {
            grains,
            fixed: model.fixed(),
            law,
            modulus: material.modulus,
            grain_friction: material.friction,
            grip: self.grip,
            clock: clocks.fixed,
            wall: &model.wall,
        };
        block.surface_forces.reset(model.wall.segment_tops.len());
        sums.add(&load_surfaces(&mut block.surfaces, &surfaces, &block.grains, loads, &mut block.surface_forces));
        if let Some(barrier) = &model.barrier {
            let context = RopeContext {
                grains,
                barrier,
                constants: OnBarrier {
                    law: self.barrier_law,
                    grain_modulus: material.modulus,
                    grain_friction: material.friction,
                },
                clock: clocks.fixed,
            };
            sums.add(&match self.substeps {
                1 => block.ropes.load(&context, &block.grains, loads),
                substeps => {
                    let substepping = Substepping { step: law.time_step, substeps };
                    block.at_barrier.begin(&mut block.ropes, &context, &self.moving, &block.grains, &substepping)
                }
            });
        }
        block.sums = sums;
    }
}
