//! Candidate pairs of one kind in one block, with the memory of those that touch.

use crate::dem::contact::law::Memory;
use crate::dem::neighbours::memory_rows::{MemoryRows, Remembered};

/// Pairs (member, other party); the other party is a member, a surface or a rope segment.
#[derive(Clone, Debug, Default)]
pub struct CandidateList {
    pub pairs: Vec<[u32; 2]>,
    pub memory: Vec<Memory>,
    /// Step at which the pair last touched; memory older than one step is void.
    pub touched: Vec<u32>,
    /// Scratch: slots of the pairs that touch in the step at hand.
    pub active: Vec<u32>,
}

impl CandidateList {
    pub fn push(&mut self, pair: [u32; 2]) {
        self.pairs.push(pair);
    }

    /// Memory of a slot as it stands at the beginning of `step`.
    #[inline(always)]
    pub fn memory_at(&self, slot: usize, step: u32) -> Memory {
        if self.touched[slot] + 1 == step { self.memory[slot] } else { Memory::default() }
    }

    #[inline(always)]
    pub fn remember_at(&mut self, slot: usize, step: u32, memory: Memory) {
        self.touched[slot] = step;
        self.memory[slot] = memory;
    }

    /// Contacts in force after `step`, with the members' rows renamed by `new_rows`; contacts of members that
    /// are gone (`u32::MAX`) are left out. `rename` names the other party.
    pub fn in_force<'a>(
        &'a self,
        new_rows: &'a [u32],
        step: u32,
        rename: impl Fn(u32) -> u32 + 'a,
    ) -> impl Iterator<Item = Remembered> + 'a {
        (0..self.pairs.len()).filter(move |&slot| self.touched[slot] == step).filter_map(move |slot| {
            let [member, other] = self.pairs[slot];
            let contact =
                Remembered { member: new_rows[member as usize], other: rename(other), memory: self.memory[slot] };
            (contact.member != u32::MAX && contact.other != u32::MAX).then_some(contact)
        })
    }

    /// Puts freshly found pairs in order and gives back the memory of those in force after `step`.
    pub fn settle(&mut self, memories: &MemoryRows, step: u32) {
        self.pairs.sort_unstable();
        self.memory.resize(self.pairs.len(), Memory::default());
        // A pair that never touched must not look like one that touched in step 0 before step 1.
        self.touched.resize(self.pairs.len(), u32::MAX - 1);
        for slot in 0..self.pairs.len() {
            if let Some(memory) = memories.recall(self.pairs[slot]) {
                self.remember_at(slot, step, memory);
            }
        }
    }
}
