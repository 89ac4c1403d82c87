//! Pairs that sleep until they could touch.
//!
//! A clock runs at the rate at which any two bodies could at most come closer (m). A pair with a gap g cannot touch
//! before the clock has gone on by g, so it need not be looked at until then. Alarms stand in slots of equal width, like
//! the slots of a timer wheel; a slot is opened when the clock enters it, which is at most one width too early. Who looks ahead may open
//! slots that the clock has not reached: a pair that would belong into one of them may not sleep.

use crate::neighbours::clocks::Clock;

/// Slots over the whole reach of a list.
const SLOTS_IN_REACH: f64 = 128.0;
/// Slots kept: those of the reach, and room for rounding.
const SLOTS: u64 = 130;

/// Steps that a pair must be able to sleep.
const STEPS_WORTH_SLEEPING: f64 = 1.0;

#[derive(Clone, Debug, Default)]
pub struct Alarms {
    slots: Vec<Vec<[u32; 2]>>,
    /// Of one slot (m).
    width: f64,
    slots_per_metre: f64,
    /// Number of the next slot to open.
    next: u64,
}

impl Alarms {
    /// Forgets all pairs and starts a new clock; `reach` is the largest gap that is told apart (m).
    pub fn reset(&mut self, reach: f64) {
        self.slots.resize(SLOTS as usize, Vec::new());
        self.slots.iter_mut().for_each(Vec::clear);
        self.width = reach / SLOTS_IN_REACH;
        self.slots_per_metre = 1.0 / self.width;
        self.next = 1;
    }

    /// Gap below which a pair may not sleep (m): it could wake up too late, or would hardly have slept.
    #[inline(always)]
    pub fn shortest(&self, clock: &Clock) -> f64 {
        let to_the_next_slot = self.next as f64 * self.width - clock.now;
        self.width.max(STEPS_WORTH_SLEEPING * clock.tick).max(to_the_next_slot)
    }

    /// Lets a pair sleep that has the given gap now; the gap must be at least [`Self::shortest`].
    pub fn set(&mut self, pair: [u32; 2], clock: &Clock, gap: f64) {
        let reach = self.width * SLOTS_IN_REACH;
        // Rounding may name the slot before.
        let slot = (((clock.now + gap.min(reach)) * self.slots_per_metre) as u64).max(self.next);
        self.slots[(slot % SLOTS) as usize].push(pair);
    }

    /// Takes out the pairs of the next slot that the clock has reached, if there is one.
    pub fn open(&mut self, clock: &Clock) -> Option<Vec<[u32; 2]>> {
        let reached = self.next as f64 * self.width <= clock.now;
        reached.then(|| {
            let slot = std::mem::take(&mut self.slots[(self.next % SLOTS) as usize]);
            self.next += 1;
            slot
        })
    }

    /// Takes back the list that [`Self::open`] gave last, emptied, so that its room is used again.
    pub fn take_back(&mut self, mut pairs: Vec<[u32; 2]>) {
        pairs.clear();
        let slot = &mut self.slots[((self.next - 1) % SLOTS) as usize];
        if slot.is_empty() {
            *slot = pairs;
        }
    }

    /// All sleeping pairs.
    #[cfg(test)]
    fn pairs(&self) -> impl Iterator<Item = &[u32; 2]> {
        self.slots.iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the gaps, the pace of the clock and how far one looks ahead, a pair is handed out before its gap is used up.
    #[test]
    fn no_pair_oversleeps() {
        let mut random = fastrand::Rng::with_seed(5);
        for round in 0..400 {
            let steps_ahead = if round % 2 == 0 { 0.0 } else { 1.5 };
            let reach = 0.1 + random.f64();
            let mut alarms = Alarms::default();
            alarms.reset(reach);
            let pace = reach * 0.05 * random.f64();
            let mut due = std::collections::BTreeMap::new();
            let mut clock = Clock::default();
            for number in 0..400_u32 {
                let gap = alarms.shortest(&clock) + 1.5 * reach * random.f64() * random.f64();
                alarms.set([number, 0], &clock, gap);
                due.insert(number, clock.now + gap);
                clock.tick = pace * random.f64() * random.f64();
                clock.now += clock.tick;
                let ahead = Clock { now: clock.now + steps_ahead * clock.tick, ..clock };
                while let Some(pairs) = alarms.open(&ahead) {
                    for [number, _] in pairs {
                        due.remove(&number);
                    }
                }
                assert!(due.values().all(|&alarm| alarm > clock.now));
            }
            assert_eq!(alarms.pairs().count(), due.len());
        }
    }
}
