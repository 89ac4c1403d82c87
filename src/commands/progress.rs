//! How far a run has come: a bar where somebody watches a terminal, a line now and then where the output goes to a file.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::scene::event::ProgressReport;
use crate::terminal;

/// Time between two lines.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// Parts of the bar.
const PARTS: f64 = 1000.0;

pub struct Progress {
    shown: Mutex<Shown>,
}

enum Shown {
    Bar(ProgressBar),
    Lines { began: Instant, last: Instant },
}

impl Progress {
    pub fn begin() -> Self {
        let shown = if std::io::stderr().is_terminal() {
            Shown::Bar(bar())
        } else {
            Shown::Lines { began: Instant::now(), last: Instant::now() }
        };
        Self { shown: Mutex::new(shown) }
    }

    /// Of several simulations side by side the one that tells last is shown.
    pub fn show(&self, report: &ProgressReport) {
        let Ok(mut shown) = self.shown.lock() else { return };
        let told = format!("simulated {:.2} s, force {:.4} kN", report.time, report.force / 1e3);
        match &mut *shown {
            Shown::Bar(bar) => {
                bar.set_position((PARTS * report.share) as u64);
                bar.set_message(told);
            }
            Shown::Lines { began, last } if last.elapsed() >= BETWEEN_LINES => {
                *last = Instant::now();
                terminal::warn(format_args!(
                    "{:.0} s: {told}, about {:.0} % of this simulation",
                    began.elapsed().as_secs_f64(),
                    100.0 * report.share
                ));
            }
            Shown::Lines { .. } => {}
        }
    }

    pub fn end(&self) {
        if let Ok(shown) = self.shown.lock()
            && let Shown::Bar(bar) = &*shown
        {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(PARTS as u64);
    let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}, {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message("packing the flow");
    bar
}
