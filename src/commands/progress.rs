//! How far a run has come: a bar where somebody watches a terminal, a line now and then where the output goes to a file, and lines of JSON
//! where another program watches.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use serde::{Deserialize, Serialize};

use crate::report::glimpse::Picture;
use crate::report::numbers::with_unit;
use crate::scene::event::ProgressReport;
use crate::terminal;

/// Time between two lines for a person, and for a program.
const BETWEEN_LINES: Duration = Duration::from_secs(10);
const BETWEEN_WATCHED: Duration = Duration::from_millis(200);

/// Parts of the bar.
const PARTS: f64 = 1000.0;

/// Whom progress is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Audience {
    Person,
    Program,
}

pub struct Progress {
    began: Instant,
    told: Mutex<Told>,
}

struct Told {
    shown: Shown,
    /// Share of each simulation that is done.
    shares: Vec<f64>,
    /// Share of all that was done at the first word of this run, which may go on with an earlier one, and when that was.
    first: Option<(f64, Instant)>,
    /// Frames of the first simulation that have been told.
    frame_until: f64,
    /// Time (s) and largest force (N) of the first simulation since a program was told.
    peak: Option<[f64; 2]>,
}

enum Shown {
    Bar(ProgressBar),
    Lines { last: Instant },
    Watched { last: Instant },
}

/// A line for another program.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Share of all simulations that are known of, 0 to 1.
    pub share: f64,
    /// Simulations known of, and which of them this tells of, counted from 1.
    pub simulations: usize,
    pub simulation: usize,
    /// Simulated time (s) of that one, and force on its barrier (N).
    pub time: f64,
    pub force: f64,
    /// When since the last line the force of the first simulation was largest (s), and that force (N), as single samples have it.
    pub peak: Option<[f64; 2]>,
    /// How long the run has taken (s), and what it may still take (s), where that can be told.
    pub taken: f64,
    pub left: Option<f64>,
    /// What the first simulation looks like, where that has changed.
    pub picture: Option<Picture>,
}

impl Progress {
    pub fn begin(audience: Audience) -> Self {
        let now = Instant::now();
        let shown = match audience {
            Audience::Program => Shown::Watched { last: now },
            Audience::Person if std::io::stderr().is_terminal() => Shown::Bar(bar()),
            Audience::Person => Shown::Lines { last: now },
        };
        Self {
            began: now,
            told: Mutex::new(Told {
                shown,
                shares: Vec::new(),
                first: None,
                frame_until: f64::NEG_INFINITY,
                peak: None,
            }),
        }
    }

    /// Of several simulations side by side the one that tells last is shown, and how far all have come.
    pub fn show(&self, report: &ProgressReport) {
        let Ok(mut told) = self.told.lock() else { return };
        let share = told.share(report);
        let taken = self.began.elapsed().as_secs_f64();
        let (first, since) = *told.first.get_or_insert((share, Instant::now()));
        let left = left(since.elapsed().as_secs_f64(), share - first)
            .map(|whole| whole * (1.0 - share) / (1.0 - (share - first)));
        if report.number == 0 && told.peak.is_none_or(|[_, force]| report.force > force) {
            told.peak = Some([report.time, report.force]);
        }
        let Told { shown, frame_until, peak, .. } = &mut *told;
        match shown {
            Shown::Bar(bar) => {
                bar.set_position((PARTS * share) as u64);
                bar.set_message(words(report));
            }
            Shown::Lines { last } if last.elapsed() >= BETWEEN_LINES => {
                *last = Instant::now();
                let left = left.map_or(String::new(), |left| format!(", about {} left", duration(left)));
                terminal::warn(format_args!(
                    "{taken:.0} s: {}, about {:.0} % done{left}",
                    words(report),
                    100.0 * share
                ));
            }
            Shown::Watched { last } if last.elapsed() >= BETWEEN_WATCHED => {
                *last = Instant::now();
                let new = report.film.frames.last().filter(|frame| report.number == 0 && frame.time > *frame_until);
                if let Some(frame) = new {
                    *frame_until = frame.time;
                }
                let line = Line {
                    share,
                    simulations: report.of,
                    simulation: report.number + 1,
                    time: report.time,
                    force: report.force,
                    peak: peak.take(),
                    taken,
                    left,
                    picture: new.map(|frame| Picture::of(report.film, frame)),
                };
                if let Ok(line) = serde_json::to_string(&line) {
                    terminal::warn(line);
                }
            }
            Shown::Lines { .. } | Shown::Watched { .. } => {}
        }
    }

    pub fn end(&self) {
        if let Ok(told) = self.told.lock()
            && let Shown::Bar(bar) = &told.shown
        {
            bar.finish_and_clear();
        }
    }
}

impl Told {
    /// Share of all simulations that is done, now that one tells how far it is.
    fn share(&mut self, report: &ProgressReport) -> f64 {
        if self.shares.len() != report.of {
            // The next step of a ladder, or another study: what was before is over.
            self.shares = vec![0.0; report.of];
            self.first = None;
        }
        if let Some(share) = self.shares.get_mut(report.number) {
            *share = report.share;
        }
        self.shares.iter().sum::<f64>() / self.shares.len().max(1) as f64
    }
}

fn words(report: &ProgressReport) -> String {
    let which =
        if report.of > 1 { format!("simulation {} of {}, ", report.number + 1, report.of) } else { String::new() };
    format!("{which}simulated {:.2} s, force {}", report.time, with_unit(report.force, "N"))
}

/// Time that a run of which a share is done may still take (s); nothing while too little of it is done.
pub fn left(taken: f64, share: f64) -> Option<f64> {
    (share >= 0.02).then(|| taken * (1.0 - share) / share)
}

/// A time as a person tells it.
pub fn duration(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 90.0 => format!("{seconds:.0} s"),
        seconds if seconds < 5400.0 => format!("{:.0} minutes", seconds / 60.0),
        seconds => format!("{:.1} hours", seconds / 3600.0),
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(PARTS as u64);
    let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}, {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message("packing the flow");
    bar
}
