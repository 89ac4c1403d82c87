//! Standing worker threads that share the work of every step.
//!
//! A step has a short stretch of parallel work, some hundred microseconds. Handing it to sleeping threads
//! costs as much as the work; so the workers stay awake for as long as a run lasts, and take the parts of a stretch one by one
//! until none is left. Which thread takes which part does not matter for the result. Outside [`gather`] every stretch is
//! worked off by the calling thread alone.

#![allow(unsafe_code)]

use std::cell::{Cell, UnsafeCell};
use std::panic::{AssertUnwindSafe, Location, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use crate::schedule::Noting;

/// Looks for work before an idle helper lets others have the core, and before it naps.
const LOOKS_BEFORE_YIELD: u32 = 2_000;
const LOOKS_BEFORE_NAP: u32 = 20_000;
const NAP: Duration = Duration::from_micros(50);

/// Bits of the state: whether a stretch is open, how many helpers are inside, and the number of the stretch.
const OPEN: u64 = 1;
const INSIDE: u64 = 2;
const INSIDE_MASK: u64 = 0xffff << 1;
const STRETCH: u64 = 1 << 17;

/// Works off the part of the given number.
type PartWork<'a> = dyn Fn(usize) + Sync + 'a;

/// What helpers and leader share.
struct Workers {
    /// Leader and helpers.
    count: usize,
    state: AtomicU64,
    /// Part to be taken next, and the number of parts.
    next: AtomicUsize,
    parts: AtomicUsize,
    /// The stretch at hand; written by the leader while it is closed and nobody is inside.
    work: UnsafeCell<Option<&'static PartWork<'static>>>,
    failed: AtomicBool,
    dismissed: AtomicBool,
}

// SAFETY: `work` is written only while no helper is inside a stretch and read only by helpers inside one; `state` orders
// the two.
unsafe impl Sync for Workers {}

thread_local! {
    /// The workers that this thread leads, for as long as [`gather`] lasts.
    static LED: Cell<Option<&'static Workers>> = const { Cell::new(None) };
}

/// Calls `body` with all threads of the present rayon pool standing by.
pub fn gather<T: Send>(body: impl FnOnce() -> T + Send) -> T {
    let count = rayon::current_num_threads();
    let workers = Workers {
        count,
        state: AtomicU64::new(0),
        next: AtomicUsize::new(0),
        parts: AtomicUsize::new(0),
        work: UnsafeCell::new(None),
        failed: AtomicBool::new(false),
        dismissed: AtomicBool::new(false),
    };
    rayon::in_place_scope(|scope| {
        for _ in 1..count {
            scope.spawn(|_| workers.help());
        }
        // SAFETY: the reference is taken away again before `workers` goes, by the guard, also when `body` panics.
        let leader = Leader::of(unsafe { std::mem::transmute::<&Workers, &'static Workers>(&workers) });
        let result = body();
        drop(leader);
        result
    })
}

/// How many threads share the work of the calling one.
pub fn count() -> usize {
    LED.get().map_or(1, |workers| workers.count)
}

/// The workers that the calling thread leads, if there are helpers among them.
fn led() -> Option<&'static Workers> {
    LED.get().filter(|workers| workers.count > 1)
}

/// Calls `work` for every item, by all of the workers; items go out in their order.
#[track_caller]
pub fn for_each<T: Send>(items: impl IntoIterator<Item = T>, work: impl Fn(usize, T) + Sync) {
    let Some(workers) = led() else {
        let mut noting = Noting::begin(Location::caller());
        for (number, item) in items.into_iter().enumerate() {
            work(number, item);
            noting.iter_mut().for_each(Noting::first);
        }
        noting.into_iter().for_each(Noting::end);
        return;
    };
    let items: Vec<Mutex<Option<T>>> = items.into_iter().map(|item| Mutex::new(Some(item))).collect();
    workers.share(items.len(), &|number| {
        let item = items[number].lock().ok().and_then(|mut item| item.take());
        if let Some(item) = item {
            work(number, item);
        }
    });
}

/// Calls `first` for every item, by all of the workers, and `second` for each once `first` is through with it and all items
/// before it.
#[track_caller]
pub fn wave<T: Send>(
    items: impl IntoIterator<Item = T>,
    first: impl Fn(&mut T) + Sync,
    second: impl Fn(&mut T) + Sync,
) {
    let Some(workers) = led() else {
        let mut noting = Noting::begin(Location::caller());
        for mut item in items {
            first(&mut item);
            noting.iter_mut().for_each(Noting::first);
            second(&mut item);
            noting.iter_mut().for_each(Noting::second);
        }
        noting.into_iter().for_each(Noting::end);
        return;
    };
    let items: Vec<Mutex<T>> = items.into_iter().map(Mutex::new).collect();
    // A lock is poisoned only when a part has failed, and then the stretch fails as a whole.
    let turn = |number: usize, work: &(dyn Fn(&mut T) + Sync)| {
        work(&mut items[number].lock().unwrap_or_else(PoisonError::into_inner));
    };
    let front = Front::over(items.len());
    // Whoever finds no item left helps to bring the front to the end.
    workers.share(items.len() + workers.count, &|number| {
        if number < items.len() {
            let breaking = Breaking(&front);
            turn(number, &first);
            std::mem::forget(breaking);
            front.note(number);
            front.advance(|ready| turn(ready, &second));
        } else {
            let mut looks = 0;
            while front.is_open() {
                front.advance(|ready| turn(ready, &second));
                wait(&mut looks);
            }
        }
    });
}

/// Calls `work` for every item, by all of the workers; results in the order of the items.
#[track_caller]
pub fn map<T: Send, R: Send>(items: impl IntoIterator<Item = T>, work: impl Fn(usize, T) -> R + Sync) -> Vec<R> {
    let items: Vec<T> = items.into_iter().collect();
    let mut results: Vec<Option<R>> = items.iter().map(|_| None).collect();
    for_each(items.into_iter().zip(&mut results), |number, (item, result)| *result = Some(work(number, item)));
    results.into_iter().flatten().collect()
}

/// How far a wave has come: every item up to the front is through its first half.
struct Front {
    through: Vec<AtomicBool>,
    next: AtomicUsize,
    /// An item has failed: the front will never come to the end.
    broken: AtomicBool,
}

impl Front {
    fn over(items: usize) -> Self {
        let through = (0..items).map(|_| AtomicBool::new(false)).collect();
        Self { through, next: AtomicUsize::new(0), broken: AtomicBool::new(false) }
    }

    /// Notes that item `number` is through. All orderings are sequential: of two threads that note neighbouring items at the
    /// same time, one must see both.
    fn note(&self, number: usize) {
        self.through[number].store(true, Ordering::SeqCst);
    }

    /// Calls `work` for every item that the front may pass now.
    fn advance(&self, work: impl Fn(usize)) {
        loop {
            let next = self.next.load(Ordering::SeqCst);
            if !self.through.get(next).is_some_and(|through| through.load(Ordering::SeqCst)) {
                return;
            }
            if self.next.compare_exchange(next, next + 1, Ordering::SeqCst, Ordering::SeqCst).is_ok() {
                work(next);
            }
        }
    }

    fn is_open(&self) -> bool {
        self.next.load(Ordering::SeqCst) < self.through.len() && !self.broken.load(Ordering::SeqCst)
    }
}

/// Breaks a front when dropped, which happens only when an item fails.
struct Breaking<'a>(&'a Front);

impl Drop for Breaking<'_> {
    fn drop(&mut self) {
        self.0.broken.store(true, Ordering::SeqCst);
    }
}

/// Leads the workers until dropped; then dismisses them.
struct Leader {
    workers: &'static Workers,
    /// The workers that the thread led before.
    before: Option<&'static Workers>,
}

impl Leader {
    fn of(workers: &'static Workers) -> Self {
        Self { workers, before: LED.replace(Some(workers)) }
    }
}

impl Drop for Leader {
    fn drop(&mut self) {
        LED.set(self.before);
        self.workers.dismissed.store(true, Ordering::Release);
    }
}

/// Takes the workers away from their leader while a stretch is open: what a part does in parallel of its own accord, the thread
/// that works on it does alone.
struct Busy(Option<&'static Workers>);

impl Busy {
    fn new() -> Self {
        Self(LED.take())
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        LED.set(self.0);
    }
}

/// Closes a stretch when dropped and waits until every helper has left it, so that what it borrows outlives its use.
struct Closing<'a>(&'a Workers);

impl Drop for Closing<'_> {
    fn drop(&mut self) {
        // No more parts, also if the leader left early by a panic.
        self.0.next.store(usize::MAX / 2, Ordering::Relaxed);
        self.0.state.fetch_and(!OPEN, Ordering::AcqRel);
        let mut looks = 0;
        while self.0.state.load(Ordering::Acquire) & INSIDE_MASK != 0 {
            wait(&mut looks);
        }
    }
}

impl Workers {
    /// Works off `parts` parts with whoever of the workers comes.
    fn share(&self, parts: usize, work: &PartWork) {
        if parts < 2 {
            (0..parts).for_each(work);
            return;
        }
        let _busy = Busy::new();
        // SAFETY: the stretch is closed and nobody is inside (`Closing` has waited for that), so nobody reads `work`;
        // it is not read any more when `Closing` is dropped, before the borrow ends.
        unsafe { *self.work.get() = Some(std::mem::transmute::<&PartWork, &'static PartWork<'static>>(work)) };
        self.parts.store(parts, Ordering::Relaxed);
        self.next.store(0, Ordering::Relaxed);
        let stretch = self.state.load(Ordering::Relaxed) & !(STRETCH - 1);
        self.state.store((stretch.wrapping_add(STRETCH)) | OPEN, Ordering::Release);
        let closing = Closing(self);
        self.take_parts(work);
        drop(closing);
        assert!(!self.failed.load(Ordering::Relaxed), "a helper of the workers has failed");
    }

    fn take_parts(&self, work: &PartWork) {
        loop {
            let part = self.next.fetch_add(1, Ordering::Relaxed);
            if part >= self.parts.load(Ordering::Relaxed) {
                return;
            }
            work(part);
        }
    }

    /// What a helper does until it is dismissed.
    fn help(&self) {
        let (mut seen, mut looks) = (0, 0);
        while !self.dismissed.load(Ordering::Acquire) {
            let state = self.state.load(Ordering::Acquire);
            let stretch = state & !(STRETCH - 1);
            if state & OPEN == 0 || stretch == seen {
                wait(&mut looks);
                continue;
            }
            if self.state.compare_exchange_weak(state, state + INSIDE, Ordering::AcqRel, Ordering::Relaxed).is_err() {
                continue;
            }
            (seen, looks) = (stretch, 0);
            // SAFETY: we are inside an open stretch: the leader has written `work` and does not touch it until we leave.
            let work = unsafe { *self.work.get() };
            if let Some(work) = work
                && catch_unwind(AssertUnwindSafe(|| self.take_parts(work))).is_err()
            {
                self.failed.store(true, Ordering::Relaxed);
            }
            self.state.fetch_sub(INSIDE, Ordering::AcqRel);
        }
    }
}

/// One look for work in vain: spins at first, then lets others have the core, then naps.
fn wait(looks: &mut u32) {
    *looks = looks.saturating_add(1);
    if *looks < LOOKS_BEFORE_YIELD {
        std::hint::spin_loop();
    } else if *looks < LOOKS_BEFORE_NAP {
        std::thread::yield_now();
    } else {
        std::thread::sleep(NAP);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pool(threads: usize) -> rayon::ThreadPool {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool")
    }

    #[test]
    fn every_part_is_worked_once_and_in_place() {
        for threads in [1, 2, 5] {
            let sums: Vec<Vec<u64>> = pool(threads).install(|| {
                gather(|| {
                    (0..300_u64)
                        .map(|round| {
                            let mut rows = vec![0; 17];
                            for_each(rows.iter_mut(), |number, row| *row += round * 100 + number as u64);
                            map(rows, |_, row| row + 1)
                        })
                        .collect()
                })
            });
            for (round, rows) in sums.iter().enumerate() {
                let expected: Vec<u64> = (0..17).map(|number| round as u64 * 100 + number + 1).collect();
                assert_eq!(rows, &expected);
            }
        }
    }

    #[test]
    fn a_wave_moves_on_only_behind_its_front() {
        for threads in [1, 2, 5] {
            pool(threads).install(|| {
                gather(|| {
                    for round in 0..300_usize {
                        let through = AtomicUsize::new(0);
                        let mut counts = vec![(0, 0); 1 + round % 17];
                        let all = counts.len();
                        wave(
                            counts.iter_mut().enumerate(),
                            |(number, count)| {
                                count.0 += 1;
                                through.fetch_or(1 << *number, Ordering::SeqCst);
                            },
                            |(number, count)| {
                                let needed = (2 << *number) - 1;
                                assert_eq!(through.load(Ordering::SeqCst) & needed, needed);
                                count.1 += 1;
                            },
                        );
                        assert_eq!(counts, vec![(1, 1); all]);
                    }
                });
            });
        }
    }

    #[test]
    fn a_panic_in_a_wave_ends_it() {
        let outcome = std::panic::catch_unwind(|| {
            pool(2).install(|| gather(|| wave(0..100, |item: &mut i32| assert!(*item != 57, "item 57"), |_| ())));
        });
        assert!(outcome.is_err());
    }

    #[test]
    fn work_within_a_part_is_done_by_its_own_thread() {
        pool(4).install(|| {
            gather(|| {
                for _ in 0..300 {
                    let worked = AtomicUsize::new(0);
                    for_each(0..20, |_, _: i32| {
                        for_each(0..10, |_, _: i32| {
                            worked.fetch_add(1, Ordering::Relaxed);
                        });
                    });
                    assert_eq!(worked.load(Ordering::Relaxed), 200);
                }
                gather(|| assert_eq!(count(), 4));
                assert_eq!(count(), 4);
            });
        });
    }

    #[test]
    fn without_a_crew_the_caller_works_alone() {
        assert_eq!(map([1, 2, 3], |number, item| item * 10 + number), [10, 21, 32]);
    }

    #[test]
    fn a_panic_in_a_part_reaches_the_leader() {
        let outcome = std::panic::catch_unwind(|| {
            pool(2).install(|| gather(|| for_each(0..100, |_, item: i32| assert!(item != 57, "part 57"))));
        });
        assert!(outcome.is_err());
        assert!(LED.get().is_none());
    }
}
