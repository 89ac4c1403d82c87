//! Blocks: fixed slices of the grain table, each with its own candidate lists and scratch space.
//!
//! How many blocks there are depends on the number of grains alone, never on the number of threads: this is
//! what makes a run repeat bit for bit.

use std::ops::Range;
use std::sync::RwLock;

use crate::contact::pair_list::PairList;
use crate::contact::ropes::RopeContacts;
use crate::contact::surfaces::SurfaceForces;
use crate::ledger::ContactSums;
use crate::neighbours::clocks::BlockClocks;
use crate::simd::quad::Quad;
use crate::tables::grains::GrainShape;
use crate::time::at_barrier::AtBarrier;

/// Grains below which one block is enough: parallel work would cost more than it saves.
const GRAINS_FOR_TWO_BLOCKS: usize = 600;
/// Spheres per block aimed at, and clumps of two.
const SPHERES_PER_BLOCK: usize = 1000;
const CLUMPS_PER_BLOCK: usize = 700;
const MOST_BLOCKS: usize = 64;

/// One slice of the grains with all that is needed to load it.
#[derive(Debug, Default)]
pub struct Block {
    /// Rows of the grain table that this block owns.
    pub grains: Range<usize>,
    /// Pairs with both members in this block.
    pub inner: PairList,
    /// Pairs with the second member in a later block.
    pub border: PairList,
    pub surfaces: PairList,
    pub ropes: RopeContacts,
    pub at_barrier: AtBarrier,
    pub clocks: BlockClocks,
    pub sums: ContactSums,
    /// Forces on the surfaces in the step just made.
    pub surface_forces: SurfaceForces,
}

/// A load for a grain of another block.
#[derive(Clone, Copy, Debug, Default)]
pub struct RemoteLoad {
    /// Row of the grain.
    pub row: u32,
    /// N
    pub force: Quad,
    /// N m
    pub torque: Quad,
}

/// Loads that one block has for grains of others, by block.
#[derive(Debug, Default)]
pub struct OutgoingLoads {
    block_size: usize,
    by_block: Vec<Vec<RemoteLoad>>,
}

impl Block {
    /// Forgets all pairs; gaps of pairs of grains will be told apart up to `skin`, of the others up to `fixed_skin` (m).
    pub fn reset(&mut self, skin: f64, fixed_skin: f64) {
        self.inner.reset(skin);
        self.border.reset(skin);
        self.surfaces.reset(fixed_skin);
        self.ropes.list.reset(fixed_skin);
        self.clocks = BlockClocks::default();
    }
}

impl OutgoingLoads {
    #[inline(always)]
    pub fn push(&mut self, load: RemoteLoad) {
        self.by_block[load.row as usize / self.block_size].push(load);
    }

    pub fn clear(&mut self) {
        self.by_block.iter_mut().for_each(Vec::clear);
    }

    /// What is there for the block of the given number.
    pub fn for_block(&self, number: usize) -> &[RemoteLoad] {
        &self.by_block[number]
    }
}

/// Number of grains in each block (the last may hold fewer).
fn grains_per_block(grains: usize, shape: GrainShape) -> usize {
    if grains < GRAINS_FOR_TWO_BLOCKS {
        return grains.max(1);
    }
    let wanted = match shape {
        GrainShape::Sphere => SPHERES_PER_BLOCK,
        GrainShape::Clump => CLUMPS_PER_BLOCK,
    };
    let pairs_of_blocks = (grains / (2 * wanted)).clamp(1, MOST_BLOCKS / 2);
    grains.div_ceil(2 * pairs_of_blocks)
}

/// Room for the loads that the given blocks have for each other.
pub fn make_outgoing(blocks: &[Block]) -> Vec<RwLock<OutgoingLoads>> {
    let block_size = blocks.first().map_or(1, |block| block.grains.len().max(1));
    blocks.iter().map(|_| RwLock::new(OutgoingLoads { block_size, by_block: vec![Vec::new(); blocks.len()] })).collect()
}

/// Empty blocks over `grains` grains.
pub fn make_blocks(grains: usize, shape: GrainShape) -> Vec<Block> {
    let size = grains_per_block(grains, shape);
    let count = grains.div_ceil(size);
    let block = |number: usize| Block { grains: number * size..((number + 1) * size).min(grains), ..Block::default() };
    (0..count).map(block).collect()
}
