//! How long a run that is asked to end goes on to the next place at which it can be kept.

use std::time::{Duration, Instant};

/// A person who asks waits this long.
const LONGEST: Duration = Duration::from_millis(1500);

/// Counts from when it is first asked.
#[derive(Clone, Copy, Debug, Default)]
pub struct Patience {
    since: Option<Instant>,
}

impl Patience {
    /// Whether the time is over; the first call begins it.
    pub fn is_over(&mut self) -> bool {
        self.since.get_or_insert_with(Instant::now).elapsed() > LONGEST
    }
}
