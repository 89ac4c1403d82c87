//! Blocks: fixed slices of the grain table, each with its own candidate lists and scratch space.
//!
//! How many blocks there are depends on the number of grains alone, never on the number of threads: this is
//! what makes a run repeat bit for bit.

use std::ops::Range;

use crate::dem::contact::candidates::CandidateList;
use crate::dem::contact::ropes::RopeContacts;
use crate::dem::contact::surfaces::SurfaceForces;
use crate::dem::ledger::ContactSums;
use crate::dem::neighbours::drift::Strayed;

/// Grains below which one block is enough: parallel work would cost more than it saves.
const GRAINS_FOR_TWO_BLOCKS: usize = 600;
/// Grains per block aimed at.
const GRAINS_PER_BLOCK: usize = 1000;
const MOST_BLOCKS: usize = 64;

/// One slice of the members with all that is needed to load it.
#[derive(Debug)]
pub struct Block {
    /// Rows of the member table that this block owns.
    pub members: Range<usize>,
    /// Pairs with both members in this block.
    pub inner: CandidateList,
    /// Pairs with the other member elsewhere.
    pub border: CandidateList,
    pub surfaces: CandidateList,
    pub ropes: RopeContacts,
    pub sums: ContactSums,
    /// Forces on the surfaces in the step just made.
    pub surface_forces: SurfaceForces,
    /// How far its members have gone since the lists were made.
    pub strayed: Strayed,
}

impl Block {
    fn empty(members: Range<usize>) -> Self {
        Self {
            members,
            inner: CandidateList::default(),
            border: CandidateList::default(),
            surfaces: CandidateList::default(),
            ropes: RopeContacts::default(),
            sums: ContactSums::default(),
            surface_forces: SurfaceForces::default(),
            strayed: Strayed::NOWHERE,
        }
    }
}

/// Number of grains in each block (the last may hold fewer).
pub fn grains_per_block(grains: usize) -> usize {
    if grains < GRAINS_FOR_TWO_BLOCKS {
        return grains.max(1);
    }
    let pairs_of_blocks = (grains / (2 * GRAINS_PER_BLOCK)).clamp(1, MOST_BLOCKS / 2);
    grains.div_ceil(2 * pairs_of_blocks)
}

/// Empty blocks over `grains` grains of `members_per_grain` members.
pub fn make_blocks(grains: usize, members_per_grain: usize) -> Vec<Block> {
    let size = grains_per_block(grains);
    (0..grains)
        .step_by(size)
        .map(|first| {
            let last = (first + size).min(grains);
            Block::empty(first * members_per_grain..last * members_per_grain)
        })
        .collect()
}
