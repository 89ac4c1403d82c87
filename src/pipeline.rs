//! The run on one page: design → fidelity → scene → histories → demands → outcomes → verdict.

use serde::{Deserialize, Serialize};

use std::time::{Instant, SystemTime, UNIX_EPOCH};

use crate::checks::check_all;
use crate::checks::credibility::{Numerics, doubts};
use crate::checks::outcome::{CheckVerdict, Outcome};
use crate::checks::wall::unheld;
use crate::dem::crew;
use crate::dem::recorders::histories::Histories;
use crate::dem::time::stable_step::StepRatio;
use crate::demand::Demands;
use crate::demand::from_histories::{Observed, Reading};
use crate::demand::from_loads::{Guideline, guideline};
use crate::design::Design;
use crate::design::read::DesignFile;
use crate::fidelity::ladder::{RUNGS, Rung, Step};
use crate::fidelity::{Fidelity, choose};
use crate::scene::build::{SAMPLES_PER_WINDOW, build};
use crate::scene::estimate::estimate;
use crate::scene::event::{Ending, Event, Watch, run as run_event};
use crate::scene::flow::packing::PackingError;
use crate::sensitivity::simulated::{swings, variants};
use crate::sensitivity::{Point, Swing};
use crate::starts::{Spread, side_by_side};

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

/// Everything a report may tell of one design.
#[derive(Clone, Debug)]
pub struct Run {
    pub file: DesignFile,
    pub guideline: Guideline,
    /// Nothing where the equations alone were asked for.
    pub simulated: Option<Simulated>,
    /// The simulation's answer to changed inputs, where asked for.
    pub varied: Vec<Swing>,
    pub outcomes: Vec<Outcome>,
    pub doubts: Vec<String>,
    pub verdict: Verdict,
    /// The rungs of the ladder that ran, where the design left the choice to the program; the last is what is reported.
    pub climb: Vec<Step>,
}

/// What the simulation shows: the first start in full, of every start what was observed.
#[derive(Clone, Debug)]
pub struct Simulated {
    pub fidelity: Fidelity,
    pub histories: Histories,
    pub facts: Facts,
    /// Worst over the starts.
    pub numerics: Numerics,
    pub starts: Vec<Start>,
    /// Why runs cannot be relied on.
    pub doubts: Vec<String>,
}

/// One start: its packing, and what came of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Start {
    pub seed: u64,
    pub observed: Observed,
}

impl Simulated {
    /// What the first start showed.
    pub fn first(&self) -> &Observed {
        &self.starts[0].observed
    }

    /// A quantity over the starts.
    pub fn spread(&self, quantity: impl Fn(&Observed) -> f64) -> Spread {
        Spread::of(&self.starts.iter().map(|start| quantity(&start.observed)).collect::<Vec<_>>())
    }
}

/// Counts and times of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
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
    #[error("the run was interrupted; nothing was written")]
    Interrupted,
    #[error("the flow could not be prepared: {0}")]
    Preparation(#[from] PackingError),
    #[error("this design is not run: {0}")]
    TooMuch(String),
}

/// By equations alone: loads, ropes, checks.
pub fn by_equations(file: DesignFile) -> Run {
    let guideline = guideline(&file.design);
    finish(file, guideline, None)
}

/// Runs one design from words to verdict, with as many packings as `starts` asks for, from the design's seed on. Call inside
/// the thread pool that shall do the work: one start uses all its threads, several run side by side.
pub fn run(file: DesignFile, starts: u32, watch: &Watch) -> Result<Run, RunError> {
    let design = &file.design;
    let fidelity = choose(design);
    let guideline = guideline(design);
    let seed = |index: usize| design.simulation.seed.wrapping_add(index as u64);
    let threads = rayon::current_num_threads();
    let (started, began) = (Instant::now(), SystemTime::now());
    let runs = if starts < 2 {
        vec![simulate(design, &fidelity, &guideline, seed(0), watch)]
    } else {
        side_by_side(threads, starts as usize, |index| {
            let mut simulated = simulate(design, &fidelity, &guideline, seed(index), watch)?;
            // The first start is told in full; of the others what was observed.
            if index > 0 {
                simulated.histories = Histories::default();
            }
            Ok(simulated)
        })
    };
    let mut runs = runs.into_iter().collect::<Result<Vec<_>, _>>()?;
    let doubts = runs.iter().flat_map(|run| doubts_of(run, runs.len())).collect();
    let mut simulated = runs.remove(0);
    simulated.doubts = doubts;
    simulated.facts.threads = threads;
    simulated.facts.began = began.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs() as i64);
    simulated.facts.wall_clock = started.elapsed().as_secs_f64();
    for other in runs {
        simulated.numerics = simulated.numerics.worst(&other.numerics);
        simulated.starts.extend(other.starts);
    }
    Ok(finish(file, guideline, Some(simulated)))
}

/// What a recorded simulation says, as at first.
pub fn restore(mut file: DesignFile, simulated: Option<Simulated>, varied: Vec<Swing>, climb: Vec<Step>) -> Run {
    if let Some(step) = climb.last() {
        file.design = RUNGS[step.rung].of(&file.design);
    }
    let guideline = guideline(&file.design);
    Run { varied, climb, ..finish(file, guideline, simulated) }
}

/// Runs one design on one rung of the ladder after the other, until no verdict can flip. `starts` is the least number of packings
/// of those rungs that have several. The file's design becomes that of the last rung.
pub fn climb(file: DesignFile, starts: u32, watch: &Watch) -> Result<Run, RunError> {
    let asked = file.design.clone();
    let fits = |rung: &Rung| {
        let design = rung.of(&asked);
        rung.suits(&asked) && (!rung.may_be_left_out || estimate(&design, &choose(&design)).too_much().is_none())
    };
    let fitting: Vec<usize> = (0..RUNGS.len()).filter(|number| fits(&RUNGS[*number])).collect();
    let mut now = by_equations(file.clone());
    for number in fitting {
        let rung = &RUNGS[number];
        let started = Instant::now();
        let file = DesignFile { design: rung.of(&asked), ..file.clone() };
        let climbed = std::mem::take(&mut now.climb);
        now = match rung.starts {
            0 => by_equations(file),
            1 => run(file, 1, watch)?,
            several => run(file, several.max(starts), watch)?,
        };
        now.climb = climbed;
        let mut open = rung.open(&now.outcomes);
        if !now.doubts.is_empty() {
            open.insert(0, "the run itself, which cannot be relied on".to_string());
        }
        let decided = open.is_empty();
        now.climb.push(Step {
            rung: number,
            wall_clock: started.elapsed().as_secs_f64(),
            said: now.verdict.word().to_string(),
            governing: governing(&now.outcomes),
            open,
        });
        if decided {
            break;
        }
    }
    Ok(now)
}

/// The check that uses most of what it has, with how much.
fn governing(outcomes: &[Outcome]) -> String {
    let used = outcomes.iter().filter_map(|outcome| Some((outcome.utilisation?, outcome)));
    let most = used.max_by(|a, b| a.0.total_cmp(&b.0));
    most.map_or(String::new(), |(used, outcome)| format!("{} ({:.0} %)", outcome.title, 100.0 * used))
}

/// Runs the design again with every input changed alone, side by side, one start each; the answers go into `run`.
pub fn vary(run: &mut Run, watch: &Watch) -> Result<(), RunError> {
    let variants = variants(&run.file.design);
    let answer = |design: &Design| -> Result<Point, RunError> {
        let guideline = guideline(design);
        let simulated = simulate(design, &choose(design), &guideline, design.simulation.seed, watch)?;
        let mut demands = Demands::meet(&guideline, &[simulated.first()], design.factors.load);
        demands.leave_out_guideline();
        let point = Point::of(simulated.first().force_peak, &check_all(design, &demands));
        Ok(if simulated.doubts.is_empty() { point } else { point.unreliable() })
    };
    let points = side_by_side(rayon::current_num_threads(), variants.len(), |index| {
        let [down, up] = &variants[index].designs;
        Ok([answer(down)?, answer(up)?])
    });
    run.varied = swings(variants, points.into_iter().collect::<Result<_, RunError>>()?);
    Ok(())
}

fn doubts_of(run: &Simulated, starts: usize) -> Vec<String> {
    let named =
        |doubt: &String| if starts > 1 { format!("seed {}: {doubt}", run.starts[0].seed) } else { doubt.clone() };
    run.doubts.iter().map(named).collect()
}

fn finish(file: DesignFile, guideline: Guideline, simulated: Option<Simulated>) -> Run {
    let observed: Vec<&Observed> =
        simulated.iter().flat_map(|simulated| &simulated.starts).map(|start| &start.observed).collect();
    let demands = Demands::meet(&guideline, &observed, file.design.factors.load);
    let outcomes = check_all(&file.design, &demands);
    let mut doubts = simulated.as_ref().map_or_else(Vec::new, |simulated| simulated.doubts.clone());
    doubts.extend(unheld(&file.design));
    let verdict = verdict(&outcomes, &doubts);
    Run { file, guideline, simulated, varied: Vec::new(), outcomes, doubts, verdict, climb: Vec::new() }
}

/// One start of one design, modelled as finely as `fidelity` says. Call inside the thread pool that shall do the work.
pub fn simulate(
    design: &Design,
    fidelity: &Fidelity,
    guideline: &Guideline,
    seed: u64,
    watch: &Watch,
) -> Result<Simulated, RunError> {
    if let Some(reason) = estimate(design, fidelity).too_much() {
        return Err(RunError::TooMuch(reason));
    }
    crew::gather(|| {
        let started = Instant::now();
        let scene = build(design, fidelity, seed)?;
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
        let observed = Observed::read(&event.histories, design, guideline, reading);
        let starts = vec![Start { seed, observed }];
        let doubts = doubts(&numerics);
        Ok(Simulated { fidelity: fidelity.clone(), histories: event.histories, facts, numerics, starts, doubts })
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
