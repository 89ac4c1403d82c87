//! What the shared work of a run costs part by part, and how long more threads would need for it.
//!
//! One thread does all the work and notes the time of every part ([`record`]). [`time`] then deals these parts out to any number of workers as
//! [`crate::workers`] does, so that the efficiency on many cores can be told without having them. The model knows that work outside stretches
//! is done by one thread, that parts differ in size, that a front waits for the slowest, and that each word between threads takes a while; it does
//! not know that cores share caches and memory, so it tells the most that may be hoped for.

use std::cell::RefCell;
use std::panic::Location;
use std::time::Instant;

/// One stretch of shared work, as one thread did it.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// Where in the code it is shared out.
    pub place: &'static Location<'static>,
    /// Time that the thread worked alone before it (s).
    pub alone: f64,
    /// Time of each part (s); of a wave, of its first half and its second.
    pub first: Vec<f64>,
    pub second: Vec<f64>,
}

/// What is noted while a recording goes on.
struct Recording {
    stretches: Vec<Stretch>,
    /// End of the last stretch.
    since: Instant,
}

thread_local! {
    static RECORDING: RefCell<Option<Recording>> = const { RefCell::new(None) };
}

/// Calls `body` and notes all stretches of work that the calling thread does alone meanwhile.
///
/// ```
/// use dem::{schedule, workers};
///
/// let (_, stretches) = schedule::record(|| workers::for_each(0..100, |_, item: u64| { std::hint::black_box(item * item); }));
/// assert_eq!(stretches[0].first.len(), 100);
/// // Two workers need no more than one, where a word between them takes no time.
/// assert!(schedule::time(&stretches, 2, 0.0) <= schedule::time(&stretches, 1, 0.0));
/// ```
pub fn record<T>(body: impl FnOnce() -> T) -> (T, Vec<Stretch>) {
    RECORDING.set(Some(Recording { stretches: Vec::new(), since: Instant::now() }));
    let result = body();
    let stretches = RECORDING.take().map_or(Vec::new(), |recording| recording.stretches);
    (result, stretches)
}

/// Notes the parts of a stretch; stretches within a part are not noted on their own.
pub(crate) struct Noting {
    recording: Recording,
    stretch: Stretch,
    last: Instant,
}

impl Noting {
    /// Begins a stretch, if a recording goes on.
    pub fn begin(place: &'static Location<'static>) -> Option<Self> {
        let recording = RECORDING.take()?;
        let last = Instant::now();
        let alone = last.duration_since(recording.since).as_secs_f64();
        Some(Self { recording, stretch: Stretch { place, alone, first: Vec::new(), second: Vec::new() }, last })
    }

    /// Notes that the first half of the next part is done, or its second.
    pub fn first(&mut self) {
        let spent = self.lap();
        self.stretch.first.push(spent);
    }

    pub fn second(&mut self) {
        let spent = self.lap();
        self.stretch.second.push(spent);
    }

    fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let spent = now.duration_since(self.last).as_secs_f64();
        self.last = now;
        spent
    }

    /// Ends the stretch.
    pub fn end(self) {
        let Self { mut recording, stretch, .. } = self;
        recording.stretches.push(stretch);
        recording.since = Instant::now();
        RECORDING.set(Some(recording));
    }
}

/// Time that so many `workers` would need for the stretches and what lies between (s), where a word from one to the other takes `message` (s).
pub fn time(stretches: &[Stretch], workers: usize, message: f64) -> f64 {
    stretches.iter().map(|stretch| stretch.alone + stretch.shared(workers, message)).sum()
}

impl Stretch {
    /// Work of one thread on it (s).
    pub fn work(&self) -> f64 {
        self.first.iter().chain(&self.second).sum()
    }

    /// Time that so many workers need for it (s).
    pub fn shared(&self, workers: usize, message: f64) -> f64 {
        if workers < 2 || self.first.len() < 2 {
            return self.work();
        }
        let mut dealer = Dealer { through: vec![false; self.first.len()], ..Dealer::default() };
        // Helpers learn of the stretch by a message; every part is taken by one, as others have taken parts meanwhile.
        let mut hands: Vec<Hand> =
            (0..workers).map(|hand| Hand { free: if hand == 0 { 0.0 } else { message }, ..Hand::default() }).collect();
        let mut end = 0.0_f64;
        while let Some(next) =
            (0..workers).filter(|&hand| !hands[hand].left).min_by(|&a, &b| hands[a].free.total_cmp(&hands[b].free))
        {
            let now = hands[next].free;
            if let Some(done) = hands[next].doing.take() {
                dealer.through[done] = true;
            }
            if let Some(part) = dealer.behind_front(&self.second) {
                hands[next].free = now + message + self.second[part];
            } else if dealer.next < self.first.len() {
                hands[next].doing = Some(dealer.next);
                hands[next].free = now + message + self.first[dealer.next];
                dealer.next += 1;
            } else if !self.second.is_empty() && dealer.front < self.first.len() {
                // Waits for whoever is through with a part next.
                let others = hands.iter().filter(|hand| hand.doing.is_some()).map(|hand| hand.free);
                hands[next].free = others.fold(f64::INFINITY, f64::min).max(now) + message;
            } else {
                hands[next].left = true;
            }
            end = end.max(now);
        }
        // The leader goes on once it has heard from the last helper.
        end + message
    }
}

/// How far a stretch has been dealt out.
#[derive(Default)]
struct Dealer {
    /// Next part to be taken, and the next whose second half is due once all up to it are through.
    next: usize,
    front: usize,
    through: Vec<bool>,
}

impl Dealer {
    /// Takes the next part behind the front, if there is one.
    fn behind_front(&mut self, second: &[f64]) -> Option<usize> {
        let ready = !second.is_empty() && self.through.get(self.front) == Some(&true);
        ready.then(|| {
            self.front += 1;
            self.front - 1
        })
    }
}

/// A worker in the model.
#[derive(Clone, Copy, Default)]
struct Hand {
    /// When it is free again (s).
    free: f64,
    /// The part whose first half it is at.
    doing: Option<usize>,
    left: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stretch(first: &[f64], second: &[f64]) -> Stretch {
        Stretch { place: Location::caller(), alone: 0.5, first: first.to_vec(), second: second.to_vec() }
    }

    /// Four parts of 1 s: 4, 2 and 1 s by one, two and four workers; work of one thread is not shared.
    #[test]
    fn even_parts_are_shared_evenly() {
        let even = [stretch(&[1.0; 4], &[])];
        let times = [1, 2, 4, 8].map(|workers| time(&even, workers, 0.0));
        assert_eq!(times, [4.5, 2.5, 1.5, 1.5]);
        // Told of the stretch, two parts taken, and the end heard of: four words at most.
        assert!((time(&even, 2, 0.01) - 2.54).abs() < 1e-12);
    }

    /// A large part that comes last is waited for: parts of 1, 1 and 3 s need 4 s by two workers.
    #[test]
    fn the_largest_part_is_waited_for() {
        assert_eq!(stretch(&[1.0, 1.0, 3.0], &[]).shared(2, 0.0), 4.0);
        assert_eq!(stretch(&[3.0, 1.0, 1.0], &[]).shared(2, 0.0), 3.0);
    }

    /// Second halves wait for the first halves of all before: with a first part of 2 s, those of the second and third part are due after it.
    #[test]
    fn a_wave_waits_for_its_front() {
        // One works on the first part until 2 s; the other is through with two and three at 2 s. Then three second halves: 2 s more by two.
        assert_eq!(stretch(&[2.0, 1.0, 1.0], &[1.0; 3]).shared(2, 0.0), 4.0);
        assert_eq!(stretch(&[2.0, 1.0, 1.0], &[1.0; 3]).shared(1, 0.0), 7.0);
    }

    /// What the workers do alone is what is recorded: halves of waves, and nothing of stretches within a part.
    #[test]
    fn every_part_is_recorded() {
        let (_, stretches) = record(|| {
            crate::workers::wave(0..3, |_| (), |_| ());
            crate::workers::for_each(0..2, |_, _: i32| crate::workers::for_each(0..5, |_, _: i32| ()));
        });
        let counts: Vec<[usize; 2]> = stretches.iter().map(|s| [s.first.len(), s.second.len()]).collect();
        assert_eq!(counts, [[3, 3], [2, 0]]);
    }
}
