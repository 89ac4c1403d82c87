//! Pairs of one kind in one block: those in contact are evaluated in every step, those near are looked at, the others
//! sleep until they could touch.

use crate::contact::law::Memory;
use crate::neighbours::alarms::Alarms;
use crate::neighbours::clocks::Clock;
use crate::neighbours::memory_rows::{MemoryRows, Remembered};
use crate::simd::eight::{Eight, LANES, Row, each_lane, joined, parted};
use crate::simd::quad::Quad;

/// Pairs (member, other party); the other party is a member, a surface or a line of the barrier.
#[derive(Clone, Debug, Default)]
pub struct PairList {
    /// Pairs in contact.
    pub touching: Vec<[u32; 2]>,
    /// Memory of each pair in contact.
    pub memory: Vec<Quad>,
    /// Scratch: places in `touching` of the pairs whose contact has ended in the step at hand, in rising order.
    pub ended: Vec<u32>,
    /// Pairs that could touch in any step.
    near: Vec<[u32; 2]>,
    alarms: Alarms,
}

/// Eight pairs in contact, to be handled side by side. Where there are fewer, the other lanes repeat the first pair.
#[derive(Clone, Copy)]
pub struct EightPairs {
    pub pairs: [[u32; 2]; LANES],
    /// Lanes in use.
    pub count: usize,
    /// Place of the first in the list.
    first: usize,
}

/// How far apart the two parties of a pair are.
pub trait Separation {
    /// Square of their distance (m²), and the distance at which they touch (m). Marked to be inlined where it is wanted in
    /// the loop's own vector instructions.
    fn of(&self, pair: [u32; 2]) -> (f64, f64);

    /// Gap between them (m); negative where they overlap.
    fn gap(&self, pair: [u32; 2]) -> f64 {
        let (square, reach) = self.of(pair);
        square.sqrt() - reach
    }
}

/// Gives back room that a list has grown beyond what it is likely to need.
fn trim<T>(list: &mut Vec<T>) {
    list.shrink_to(list.len() + list.len() / 4);
}

impl PairList {
    /// Forgets all pairs; gaps up to `reach` will be told apart (m).
    pub fn reset(&mut self, reach: f64) {
        self.touching.clear();
        self.memory.clear();
        self.near.clear();
        self.alarms.reset(reach);
    }

    /// Takes in a pair with the given gap, as the clock starts. Call [`Self::settle`] when all are in.
    pub fn add(&mut self, pair: [u32; 2], gap: f64) {
        // Asked so that a NaN is seen.
        if gap >= self.alarms.shortest(&Clock::default()) {
            self.alarms.set(pair, &Clock::default(), gap);
        } else if gap >= 0.0 {
            self.near.push(pair);
        } else {
            self.touching.push(pair);
        }
    }

    /// Takes the near pairs that were in contact for pairs in contact still, whatever their gap seems to be.
    pub fn keep_contacts(&mut self, memories: &MemoryRows) {
        let Self { touching, near, .. } = self;
        near.retain(|&pair| {
            let remembered = memories.recall(pair) != Memory::default();
            if remembered {
                touching.push(pair);
            }
            !remembered
        });
    }

    /// Puts the pairs in contact in order and gives them back their memory.
    pub fn settle(&mut self, memories: &MemoryRows) {
        self.touching.sort_unstable();
        self.memory.extend(self.touching.iter().map(|&pair| memories.recall(pair).quad()));
        trim(&mut self.touching);
        trim(&mut self.memory);
        trim(&mut self.near);
    }

    /// Wakes the pairs that could soon touch, finds among the near ones those that touch now, and lets those sleep that
    /// have gone away.
    #[inline(always)]
    pub fn sort_near(&mut self, clock: &Clock, separation: &impl Separation) {
        self.wake(clock);
        // Twice the shortest sleep, so that pairs do not go to and fro.
        let far = 2.0 * self.alarms.shortest(clock);
        let mut place = 0;
        while let Some(&pair) = self.near.get(place) {
            let (square, reach) = separation.of(pair);
            // Asked so that a NaN is evaluated, and seen.
            let apart = square >= reach * reach;
            if apart && square <= (reach + far) * (reach + far) {
                place += 1;
                continue;
            }
            self.near.swap_remove(place);
            if apart {
                self.alarms.set(pair, clock, square.sqrt() - reach);
            } else {
                self.touching.push(pair);
                self.memory.push(Quad::default());
            }
        }
    }

    /// Wakes the pairs that could touch by the time of the clock.
    #[inline(always)]
    pub fn wake(&mut self, clock: &Clock) {
        while let Some(pairs) = self.alarms.open(clock) {
            self.near.extend_from_slice(&pairs);
            self.alarms.take_back(pairs);
        }
    }

    /// Takes those of the near pairs that are wanted for pairs in contact, with nothing to remember, until [`Self::end_contacts`] parts them
    /// again.
    pub fn take_near(&mut self, wanted: impl Fn([u32; 2]) -> bool) {
        let Self { touching, near, .. } = self;
        near.retain(|&pair| {
            let taken = wanted(pair);
            if taken {
                touching.push(pair);
            }
            !taken
        });
        self.memory.resize(self.touching.len(), Quad::default());
    }

    /// The eight pairs in contact after `last`, or what is left of them.
    #[inline(always)]
    pub fn eight_after(&self, last: Option<EightPairs>) -> Option<EightPairs> {
        let first = last.map_or(0, |last| last.first + last.count);
        let pairs = &self.touching[first..];
        if let Some(pairs) = pairs.first_chunk() {
            return Some(EightPairs { pairs: *pairs, count: LANES, first });
        }
        let (&spare, count) = (pairs.first()?, pairs.len());
        let mut filled = [spare; LANES];
        filled[..count].copy_from_slice(pairs);
        Some(EightPairs { pairs: filled, count, first })
    }

    /// What eight pairs remember; nothing in lanes that are not in use.
    #[inline(always)]
    pub fn memory_of<E: Eight>(&self, eight: &EightPairs) -> Memory<E> {
        let rows = &self.memory[eight.first..eight.first + eight.count];
        let rows = each_lane!(|lane| rows.get(lane).map_or(E::Row::all(0.0), E::Row::load));
        let (tangential, dashpot) = parted(E::columns(rows));
        Memory { tangential, dashpot }
    }

    /// Stores what eight pairs remember now, and notes those whose contact has ended.
    #[inline(always)]
    pub fn remember<E: Eight>(&mut self, eight: &EightPairs, memory: &Memory<E>, overlap: E) {
        let &EightPairs { first, count, .. } = eight;
        let rows = E::rows(joined(memory.tangential, memory.dashpot));
        let places = &mut self.memory[first..first + count];
        each_lane!(|lane| {
            if lane < count {
                rows[lane].store(&mut places[lane]);
            }
        });
        let mut open = !overlap.above_zero() & (0xff >> (LANES - count));
        while open != 0 {
            self.ended.push((first as u32) + open.trailing_zeros());
            open &= open - 1;
        }
    }

    /// Moves the pairs noted in `ended` back to the near ones.
    pub fn end_contacts(&mut self) {
        while let Some(place) = self.ended.pop() {
            self.near.push(self.touching.swap_remove(place as usize));
            self.memory.swap_remove(place as usize);
        }
    }

    /// Contacts with what they remember, with the members' rows renamed by `new_rows`; those of members that are
    /// gone (`u32::MAX`) are left out. `rename` names the other party.
    pub fn remembered<'a>(
        &'a self,
        new_rows: &'a [u32],
        rename: impl Fn(u32) -> u32 + 'a,
    ) -> impl Iterator<Item = Remembered> + 'a {
        self.touching.iter().zip(&self.memory).filter_map(move |(&[member, other], &memory)| {
            let contact = Remembered {
                member: new_rows[member as usize],
                other: rename(other),
                memory: Memory::from_quad(memory),
            };
            (contact.member != u32::MAX && contact.other != u32::MAX).then_some(contact)
        })
    }
}
