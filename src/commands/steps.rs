//! How far a command has come that makes many runs: a bar where somebody watches a terminal, a line now and then where not.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::commands::progress::{duration, left};
use crate::terminal;

/// Time between two lines.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

pub struct Steps {
    of: usize,
    began: Instant,
    bar: Option<ProgressBar>,
    told: Mutex<Told>,
}

struct Told {
    done: usize,
    last: Instant,
}

impl Steps {
    /// Of so many runs.
    pub fn begin(of: usize) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(of as u64);
            let style = ProgressStyle::with_template("{bar:30} {pos}/{len}  {msg}  {eta} left");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        let now = Instant::now();
        Self { of, began: now, bar, told: Mutex::new(Told { done: 0, last: now }) }
    }

    /// What comes now.
    pub fn next(&self, what: impl Into<String>) {
        if let Some(bar) = &self.bar {
            bar.set_message(what.into());
        }
    }

    /// One more is done; `what` it was.
    pub fn done(&self, what: &str) {
        if let Some(bar) = &self.bar {
            bar.inc(1);
            return;
        }
        let Ok(mut told) = self.told.lock() else { return };
        told.done += 1;
        if told.last.elapsed() >= BETWEEN_LINES {
            told.last = Instant::now();
            terminal::warn(format_args!("{}; the last: {what}", self.line(told.done)));
        }
    }

    /// How far it is with so many done.
    pub fn line(&self, done: usize) -> String {
        let taken = self.began.elapsed().as_secs_f64();
        let left = left(taken, done as f64 / self.of.max(1) as f64);
        let left = left.map_or(String::new(), |left| format!(", about {} left", duration(left)));
        format!("{}: {done} of {} runs{left}", duration(taken), self.of)
    }

    pub fn end(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_follows_from_what_is_done() {
        let steps =
            Steps { began: Instant::now().checked_sub(Duration::from_secs(30)).expect("a time"), ..Steps::begin(4) };
        assert_eq!(steps.line(0), "30 s: 0 of 4 runs");
        assert_eq!(steps.line(1), "30 s: 1 of 4 runs, about 90 s left".replace("90 s", &duration(90.0)));
    }
}
