//! The run on one page: design → fidelity → scene → histories → demands → outcomes → verdict.

use std::time::{Instant, SystemTime, UNIX_EPOCH};

use crate::checks::check_all;
use crate::checks::outcome::{CheckVerdict, Outcome};
use crate::checks::wall::unheld;
use crate::demand::Demands;
use crate::demand::from_histories::Observed;
use crate::demand::from_loads::{Guideline, guideline};
use crate::design::Design;
use crate::design::read::DesignFile;
use crate::fidelity::choose;
use crate::fidelity::ladder::{RUNGS, Rung, Step};
use crate::scene::estimate::estimate;
use crate::scene::event::Watch;
use crate::sensitivity::simulated::{swings, variants};
use crate::sensitivity::{Point, Swing};
use crate::simulated::{Detail, RunError, Simulated, simulate};
use crate::starts::side_by_side;

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
        vec![simulate(design, &fidelity, &guideline, seed(0), Detail::Full, watch)]
    } else {
        side_by_side(threads, starts as usize, |index| {
            // The first start is told in full; of the others what was observed.
            let detail = if index == 0 { Detail::Full } else { Detail::Observed };
            simulate(design, &fidelity, &guideline, seed(index), detail, watch)
        })
    };
    let mut runs = runs.into_iter().collect::<Result<Vec<_>, _>>()?;
    let doubts = runs.iter().flat_map(|run| doubts_of(run, runs.len())).collect();
    let mut simulated = runs.remove(0);
    simulated.doubts = doubts;
    simulated.facts.threads = threads;
    simulated.facts.began = began.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs() as i64);
    simulated.facts.wall_clock = started.elapsed().as_secs_f64().max(simulated.facts.wall_clock);
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
        let simulated = simulate(design, &choose(design), &guideline, design.simulation.seed, Detail::Observed, watch)?;
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
