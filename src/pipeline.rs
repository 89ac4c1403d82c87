//! The run on one page: design → fidelity → scene → histories → demands → outcomes → verdict.

use std::time::Instant;

use crate::checks::check_all;
use crate::checks::credibility::{Numerics, doubts};
use crate::checks::outcome::{CheckVerdict, Outcome};
use crate::dem::crew;
use crate::dem::recorders::histories::Histories;
use crate::dem::time::stable_step::StepRatio;
use crate::demand::Demands;
use crate::demand::from_histories::{Observed, Reading};
use crate::demand::from_loads::{Guideline, guideline};
use crate::design::read::DesignFile;
use crate::fidelity::{Fidelity, choose};
use crate::scene::build::{SAMPLES_PER_WINDOW, build};
use crate::scene::event::{Ending, Event, Watch, run as run_event};
use crate::scene::flow::packing::PackingError;

/// What the whole run says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Pass,
    Fail,
    /// The run cannot be relied on.
    Undecided,
}

impl Verdict {
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Undecided => "undecided",
        }
    }
}

/// Everything a report may tell of one run.
#[derive(Clone, Debug)]
pub struct Run {
    pub file: DesignFile,
    pub fidelity: Fidelity,
    pub guideline: Guideline,
    pub observed: Observed,
    pub outcomes: Vec<Outcome>,
    pub doubts: Vec<String>,
    pub verdict: Verdict,
    pub histories: Histories,
    pub facts: Facts,
    pub numerics: Numerics,
}

/// Counts and times of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    pub grains: usize,
    pub spheres: usize,
    pub barrier_nodes: usize,
    pub barrier_elements: usize,
    /// Simulated time since the release (s).
    pub simulated: f64,
    /// Whether the answer no longer changed at the end.
    pub steady: bool,
    /// Steps made, those of the settling included.
    pub steps: u64,
    /// Time step at the end (s).
    pub time_step: f64,
    /// How often an audit has cut the time step.
    pub step_cuts: u32,
    /// Steps of the barrier in one of the grains'.
    pub barrier_parts: u32,
    /// Largest step over critical step that an audit found.
    pub step_ratio: StepRatio,
    /// How often the neighbour lists were made anew.
    pub renewals: u64,
    pub threads: usize,
    /// From design to end of simulation (s).
    pub wall_clock: f64,
    /// Window over which total and wall forces are averaged (s).
    pub smoothing: f64,
    /// Interval of the time series (s).
    pub sampling: f64,
    /// Bulk density of the packed flow over the one asked for.
    pub packed_share: f64,
}

/// Why there is no result at all.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    #[error("the run was interrupted; nothing was written")]
    Interrupted,
    #[error("the flow could not be prepared: {0}")]
    Preparation(#[from] PackingError),
}

/// Runs one design from words to verdict. Call inside the thread pool that shall do the work.
pub fn run(file: DesignFile, watch: &Watch) -> Result<Run, RunError> {
    crew::gather(|| run_with_crew(file, watch))
}

fn run_with_crew(file: DesignFile, watch: &Watch) -> Result<Run, RunError> {
    let started = Instant::now();
    let design = &file.design;
    let fidelity = choose(design);
    let guideline = guideline(design);
    let scene = build(design, &fidelity, design.simulation.seed)?;
    let mut facts = Facts {
        grains: scene.simulation.grains.len(),
        spheres: scene.simulation.grains.members(),
        smoothing: scene.smoothing,
        sampling: scene.recorder.interval,
        packed_share: scene.packed_share,
        threads: rayon::current_num_threads(),
        ..Facts::default()
    };
    let reading = Reading { window: SAMPLES_PER_WINDOW as usize, tail: scene.samples_of_rest() };
    let event = run_event(scene, design.simulation.longest, watch);
    if event.ending == Ending::Interrupted {
        return Err(RunError::Interrupted);
    }
    facts.take(&event, started);
    let numerics = numerics(&event);
    let observed = Observed::read(&event.histories, design, &guideline, reading);
    let demands = Demands::meet(&guideline, &observed, design.factors.load);
    let outcomes = check_all(design, &demands);
    let doubts = doubts(&numerics);
    let verdict = verdict(&outcomes, &doubts);
    Ok(Run {
        fidelity,
        guideline,
        observed,
        outcomes,
        doubts,
        verdict,
        histories: event.histories,
        facts,
        numerics,
        file,
    })
}

/// Doubt comes before everything; then a single failed check fails the design.
fn verdict(outcomes: &[Outcome], doubts: &[String]) -> Verdict {
    if !doubts.is_empty() {
        Verdict::Undecided
    } else if outcomes.iter().any(|outcome| outcome.verdict == CheckVerdict::Fail) {
        Verdict::Fail
    } else {
        Verdict::Pass
    }
}

fn numerics(event: &Event) -> Numerics {
    Numerics {
        energy_error: event.energy_error,
        overlap: event.simulation.extremes.overlap_ratio,
        step_ratio: event.simulation.extremes.step_ratio.value,
        crossings: event.simulation.extremes.crossings,
        broke_down: match &event.ending {
            Ending::BrokeDown(unstable) => Some(unstable.to_string()),
            _ => None,
        },
        missed: event.ending == Ending::Steady && event.histories.force.iter().all(|force| force.norm() == 0.0),
        unfinished: event.ending == Ending::OutOfTime,
    }
}

impl Facts {
    fn take(&mut self, event: &Event, started: Instant) {
        let simulation = &event.simulation;
        if let Some(barrier) = &simulation.model.barrier {
            self.barrier_nodes = barrier.nodes.len();
            self.barrier_elements = barrier.segments.len() + barrier.cylinders.len() + barrier.dissipators.len();
        }
        self.simulated = simulation.time;
        self.steady = event.ending == Ending::Steady;
        self.steps = simulation.steps;
        self.time_step = simulation.time_step;
        self.step_cuts = simulation.step_cuts;
        self.barrier_parts = simulation.barrier_parts;
        self.step_ratio = simulation.extremes.step_ratio;
        self.renewals = simulation.neighbours.renewals;
        self.wall_clock = started.elapsed().as_secs_f64();
    }
}
