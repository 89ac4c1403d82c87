//! One simulation of one design: from a scene, or from where an earlier run was interrupted, to what it showed.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::checkpoint::Slot;
use crate::checks::credibility::{Numerics, doubts};
use crate::demand::SimulatedRuns;
use crate::design::{Arrival, Design};
use crate::fidelity::Fidelity;
use crate::guideline::Guideline;
use crate::larger::larger_or_nan;
use crate::program::PROGRAM;
use crate::quantities::earth_pressure;
use crate::quantities::observed::Observed;
use crate::quantities::reading::Samples;
use crate::scene::build::{Prepared, Preparing, SAMPLES_PER_WINDOW, build_watched};
use crate::scene::estimate::estimate;
use crate::scene::event::{Ending, Event, Ongoing, RunControl};
use crate::scene::flow::packing::PackingError;
use crate::starts::Spread;
use dem::ledger::Ledger;
use dem::recorders::histories::Histories;
use dem::simulation::Simulation;
use dem::tables::grains::Grain;
use dem::time::stable_step::StepRatio;
use dem::workers;

/// What the simulation shows: the first start in full, of every start what was observed.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Simulated {
    /// Chosen by the design, so it need not be recorded.
    #[serde(skip)]
    pub fidelity: Fidelity,
    pub histories: Histories,
    pub facts: Facts,
    /// Worst over the starts.
    pub numerics: Numerics,
    pub starts: Vec<Start>,
    /// What the factored flow showed, packing by packing, where it was simulated ([`crate::flow_cases`]).
    pub factored: Vec<Start>,
    /// The same of the factored flow against dissipators with their least force, where that is known.
    pub weak: Vec<Start>,
    /// Why runs cannot be relied on.
    pub doubts: Vec<String>,
}

/// One start: its packing, and what came of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Start {
    pub seed: u64,
    /// Of the whole event.
    pub observed: Observed,
    /// Of each surge, where there are several.
    pub surges: Vec<Observed>,
}

impl Start {
    /// What was observed of the first surge, which is all where it is alone.
    pub fn first_surge(&self) -> &Observed {
        self.surges.first().unwrap_or(&self.observed)
    }
}

impl Simulated {
    /// What the first start showed.
    pub fn first(&self) -> &Observed {
        &self.starts[0].observed
    }

    /// What checks are made of.
    pub fn seen(&self) -> SimulatedRuns<'_> {
        fn observed(starts: &[Start]) -> Vec<&Observed> {
            starts.iter().map(|start| &start.observed).collect()
        }
        SimulatedRuns {
            characteristic: observed(&self.starts),
            factored: observed(&self.factored),
            weak: observed(&self.weak),
        }
    }

    /// All runs, of whatever case.
    pub fn all(&self) -> impl Iterator<Item = &Start> {
        self.starts.iter().chain(&self.factored).chain(&self.weak)
    }

    /// Whether it is a simulation of the design, with all that reports rely on.
    pub fn fits(&self, design: &Design) -> bool {
        let mut all = self.all();
        let fits = |start: &Start| {
            start.observed.fits(design)
                && start.surges.len() <= design.flow.surges()
                && start.surges.iter().all(|seen| seen.fits(design))
        };
        !self.starts.is_empty() && all.all(fits) && self.histories.is_whole()
    }

    /// A quantity of the first surge over the starts.
    pub fn spread_of_first(&self, quantity: impl Fn(&Observed) -> f64) -> Spread {
        Spread::of(&self.starts.iter().map(|start| quantity(start.first_surge())).collect::<Vec<_>>())
    }

    /// A quantity over the starts.
    pub fn spread(&self, quantity: impl Fn(&Observed) -> f64) -> Spread {
        Spread::of(&self.starts.iter().map(|start| quantity(&start.observed)).collect::<Vec<_>>())
    }
}

/// Counts and times of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Facts {
    /// The program that simulated.
    pub program: String,
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
    pub barrier_substeps: u32,
    /// Largest step over critical step that an audit found.
    pub step_ratio: StepRatio,
    /// How often the neighbour lists were made anew.
    pub renewals: u64,
    pub threads: usize,
    /// When the run began, in seconds since 1970.
    pub began: i64,
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
    #[error("the run was interrupted; no report was written")]
    Interrupted,
    #[error("the flow could not be prepared: {0}")]
    Preparation(#[from] PackingError),
    #[error("this design is not run: {0}")]
    TooMuch(String),
}

/// How much of a simulation is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// With its time series and its film.
    Full,
    /// What was observed.
    Observed,
}

/// A simulation that was interrupted, as it is kept; `T` owns or borrows the run.
#[derive(Serialize, Deserialize)]
struct Halfway<T> {
    facts: Facts,
    /// Samples in the smoothing window and in the stretch of rest.
    samples: [usize; 2],
    ongoing: T,
}

/// What is kept of a simulation.
#[derive(Serialize, Deserialize)]
enum Kept<Begun, Unfinished, Done> {
    Preparing(Begun),
    Halfway(Unfinished),
    Done(Done),
}

/// What was prepared before the run was interrupted.
type Ready = Prepared<Vec<Grain>, Simulation>;

impl Halfway<Ongoing> {
    fn begin(
        design: &Design,
        fidelity: &Fidelity,
        seed: u64,
        stop: &AtomicBool,
        from: Option<Ready>,
        slot: Option<&Slot>,
    ) -> Result<Self, RunError> {
        let mut keep = |prepared: Prepared<&[Grain], &Simulation>, last: bool| {
            if let Some(slot) = slot {
                slot.keep(&Kept::<_, Halfway<Ongoing>, Simulated>::Preparing(prepared), last);
            }
        };
        let watched = Preparing { stop, from, keep: &mut keep };
        let scene = build_watched(design, fidelity, seed, watched).map_err(|error| match error {
            PackingError::Interrupted => RunError::Interrupted,
            other => other.into(),
        })?;
        let facts = Facts {
            program: PROGRAM.to_string(),
            grains: scene.simulation.grains.len(),
            spheres: scene.simulation.grains.members(),
            smoothing: scene.smoothing,
            sampling: scene.recorder.interval,
            packed_share: scene.packed_share,
            threads: rayon::current_num_threads(),
            ..Facts::default()
        };
        let samples = [SAMPLES_PER_WINDOW as usize, scene.samples_of_rest()];
        Ok(Self { facts, samples, ongoing: Ongoing::begin(scene) })
    }
}

/// One start of one design, modelled as finely as `fidelity` says. Call inside the thread pool that shall do the work.
pub fn simulate(
    design: &Design,
    fidelity: &Fidelity,
    guideline: &Guideline,
    seed: u64,
    detail: Detail,
    watch: &RunControl,
) -> Result<Simulated, RunError> {
    if let Some(reason) = estimate(design, fidelity).too_much() {
        return Err(RunError::TooMuch(reason));
    }
    let slot = watch.store.map(|store| store.slot(&format!("{design:?} {fidelity:?} {seed} {detail:?}")));
    let (ready, halfway) = match slot.as_ref().and_then(|slot| slot.take()) {
        Some(Kept::<Ready, _, Simulated>::Done(done)) => return Ok(Simulated { fidelity: fidelity.clone(), ..done }),
        Some(Kept::Halfway(halfway)) => (None, Some(halfway)),
        Some(Kept::Preparing(ready)) => (Some(ready), None),
        None => (None, None),
    };
    if watch.stop.load(std::sync::atomic::Ordering::Relaxed) {
        return Err(RunError::Interrupted);
    }
    workers::gather(|| {
        let started = Instant::now();
        let Halfway { mut facts, samples, ongoing } = match halfway {
            Some(halfway) => halfway,
            None => Halfway::begin(design, fidelity, seed, watch.stop, ready, slot.as_ref())?,
        };
        let before = facts.wall_clock;
        let spent = || before + started.elapsed().as_secs_f64();
        let event = ongoing.go_on(design, seed, watch, |ongoing, last| {
            if let Some(slot) = &slot {
                let facts = Facts { wall_clock: spent(), ..facts.clone() };
                slot.keep(&Kept::<Ready, _, Simulated>::Halfway(Halfway { facts, samples, ongoing }), last);
            }
        });
        if event.ending == Ending::Interrupted {
            return Err(RunError::Interrupted);
        }
        facts.take(&event);
        facts.wall_clock = spent();
        facts.packed_share = event.packed_share;
        let numerics = Numerics {
            packing_shortfall: 1.0 - facts.packed_share,
            pushed_in: pushed_in(design, &event),
            stored_at_release: match design.flow.arrival {
                Arrival::Surge(_) => stored_at_release(&event.histories.at_release),
                // One at rest leans on its gate and is to store what it does.
                Arrival::DamBreak(_) => 0.0,
            },
            ..numerics(&event)
        };
        let [window, tail] = samples;
        let samples = Samples { window, tail };
        let surges = surges_of(&event.histories, design, samples);
        let observed = Observed::read(&event.histories, design, guideline, samples);
        // What comes, and the λ that it means, are told of the first surge on the empty barrier.
        let observed = surges.iter().take(1).fold(observed, |all, first| all.arriving_as(first));
        let histories = match detail {
            Detail::Full => event.histories,
            Detail::Observed => Histories::default(),
        };
        let (starts, doubts) = (vec![Start { seed, observed, surges }], doubts(&numerics));
        let (factored, weak) = (Vec::new(), Vec::new());
        let fidelity = fidelity.clone();
        let simulated = Simulated { fidelity, histories, facts, numerics, starts, factored, weak, doubts };
        if let Some(slot) = &slot {
            slot.finish(&Kept::<Ready, Halfway<Ongoing>, _>::Done(&simulated));
        }
        Ok(simulated)
    })
}

/// What was observed of each surge alone that was let go, where there are several; K and λ with its own depth and velocity.
fn surges_of(histories: &Histories, design: &Design, samples: Samples) -> Vec<Observed> {
    if design.flow.later.is_empty() {
        return Vec::new();
    }
    let one = |number: usize| {
        let alone = Design { flow: design.flow.alone(number), ..design.clone() };
        let seen = Observed::read(&histories.of_surge(number), &alone, &crate::guideline::guideline(&alone), samples);
        // What is followed before it has come to rest shows no K at rest.
        let followed = design.flow.later.get(number).is_some_and(|next| next.after.is_some());
        if followed { seen.without(&[&earth_pressure::AT_REST, &earth_pressure::OF_ANY_DEPTH]) } else { seen }
    };
    (0..=histories.surges.len()).map(one).collect()
}

/// What a finished run shows of its own numerics.
pub fn numerics(event: &Event) -> Numerics {
    Numerics {
        energy_error: event.energy_error,
        overlap: event.simulation.extremes.overlap_ratio,
        step_ratio: event.simulation.extremes.step_ratio.value,
        crossings: event.simulation.extremes.crossings,
        escaped: event.escaped,
        escaped_share: event.escaped_share,
        packing_shortfall: 0.0,
        stored_at_release: 0.0,
        stopped_upstream: event
            .histories
            .stopped_of
            .iter()
            .copied()
            .fold(event.histories.stopped_upstream, larger_or_nan),
        pushed_in: 0.0,
        broke_down: match &event.ending {
            Ending::BrokeDown(unstable) => Some(unstable.to_string()),
            Ending::NotLetGo(0, error) => Some(format!("the flow could not come in: {error}")),
            Ending::NotLetGo(surge, error) => Some(format!("surge {} could not be let go: {error}", surge + 1)),
            _ => None,
        },
        missed: event.ending == Ending::Steady && event.histories.force.iter().all(|force| force.norm() == 0.0),
        unfinished: event.ending == Ending::OutOfTime,
    }
}

/// Work with which what stands behind an inlet pushes on, over that of the static pressure of the flow as it passes, ∫ ρ g cos α S(h) v dt.
fn pushed_in(design: &Design, event: &Event) -> f64 {
    let Some((inlet, hydrograph)) = event.simulation.model.inlet.as_ref().zip(design.flow.hydrograph.as_ref()) else {
        return 0.0;
    };
    let normal = -event.simulation.model.gravity.z;
    inlet.pushed
        / (design.flow.bulk_density * normal * hydrograph.moment(&design.channel.section(), event.simulation.time))
}

/// Energy stored in the contacts of a moving flow, over its energy of motion.
fn stored_at_release(ledger: &Ledger) -> f64 {
    if ledger.kinetic > 0.0 { ledger.stored_contacts / ledger.kinetic } else { 0.0 }
}

impl Facts {
    fn take(&mut self, event: &Event) {
        let simulation = &event.simulation;
        self.grains = event.grains as usize;
        self.spheres = self.grains * simulation.grains.shape.members();
        if let Some(barrier) = &simulation.model.barrier {
            self.barrier_nodes = barrier.nodes.len();
            self.barrier_elements = barrier.axial_members().count();
        }
        self.simulated = simulation.time;
        self.steady = event.ending == Ending::Steady;
        self.steps = simulation.steps;
        self.time_step = simulation.time_step;
        self.step_cuts = simulation.step_cuts;
        self.barrier_substeps = simulation.barrier_substeps;
        self.step_ratio = simulation.extremes.step_ratio;
        self.renewals = simulation.neighbours.renewals;
    }
}
