//! The chain of a run: design → load cases → fidelity → scene → histories → demands → outcomes → verdict.

use std::time::{Instant, SystemTime, UNIX_EPOCH};

use crate::arriving;
use crate::checks::check_all;
use crate::checks::not_covered::context::CheckContext;
use crate::checks::not_covered::leave_open_not_covered;
use crate::checks::outcome::{CheckVerdict, Outcome, most_used};
use crate::checks::range::leave_open_outside_range;
use crate::checks::ropes::leave_open_what_sockets_alone_hold;
use crate::demand::Demands;
use crate::design::read::DesignFile;
use crate::design::{Design, FidelityWish};
use crate::fidelity::choose;
use crate::fidelity::ladder::{RUNGS, Rung, RungKind, Step, rung_of};
use crate::first_surge::shown_by;
use crate::flow_cases::{self, FlowCase, cases};
use crate::guideline::{Guideline, guideline};
use crate::quantities::total_force;
use crate::scene::estimate::estimate;
use crate::scene::event::{ProgressReport, RunControl};
use crate::sensitivity::simulated::{swings, variants};
use crate::sensitivity::{Point, Swing};
use crate::simulated::{Detail, RunError, Simulated, simulate};
use crate::starts::side_by_side;

/// What the whole run says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Pass,
    Fail,
    /// A check is open, or the run cannot be relied on.
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
///
/// ```
/// use barrier_check::design::read::read_design;
/// use barrier_check::pipeline::{Verdict, by_equations};
///
/// let text = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/designs/small_net.yaml"));
/// let run = by_equations(read_design("small_net.yaml", text).unwrap());
/// // The equations alone never pass a net: some of its checks only a simulation can make.
/// assert_eq!(run.verdict, Verdict::Undecided);
/// ```
pub fn by_equations(file: DesignFile) -> Run {
    let guideline = guideline(&file.design);
    finish(file, guideline, None, None)
}

/// Runs one design from words to verdict, with as many packings as `starts` asks for, from the design's seed on, under each of its
/// load cases. Call inside the thread pool that shall do the work: one simulation uses all its threads, several run side by side.
///
/// ```
/// use std::sync::atomic::AtomicBool;
///
/// use barrier_check::design::read::read_design;
/// use barrier_check::pipeline::run;
/// use barrier_check::quantities::mass;
/// use barrier_check::scene::event::RunControl;
///
/// let text = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/tiny_wall.yaml"));
/// let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
/// let run = run(read_design("tiny_wall.yaml", text).unwrap(), 1, &watch).unwrap();
/// let simulated = run.simulated.unwrap();
/// assert!(simulated.first().one(&mass::RETAINED) > 0.9);
/// ```
pub fn run(file: DesignFile, starts: u32, watch: &RunControl) -> Result<Run, RunError> {
    run_by(None, file, starts, &|design, starts| simulate_cases(design, starts, Detail::Full, watch))
}

/// Simulates a design with as many packings as it is told.
pub type Simulate<'a> = dyn Fn(&Design, u32) -> Result<Simulated, RunError> + 'a;

/// The same on a rung of the ladder, whose accuracy is then known; else it is that of the rung that the run is like.
fn run_by(rung: Option<&'static Rung>, file: DesignFile, starts: u32, by: &Simulate) -> Result<Run, RunError> {
    let simulated = by(&file.design, starts)?;
    let guideline = guideline(&file.design);
    Ok(finish(file, guideline, Some(simulated), rung))
}

/// Simulates a design under each of its load cases, with as many packings as `starts` asks for; `first` is how much is kept of the first.
pub fn simulate_cases(design: &Design, starts: u32, first: Detail, watch: &RunControl) -> Result<Simulated, RunError> {
    let threads = rayon::current_num_threads();
    let (started, began) = (Instant::now(), SystemTime::now());
    let cases = cases(design);
    let jobs: Vec<(u32, &(FlowCase, Design))> =
        (0..starts.max(1)).flat_map(|start| cases.iter().map(move |case| (start, case))).collect();
    let one = |index: usize| {
        let (start, (_, design)) = jobs[index];
        // The first is told in full; of the others what was observed.
        let detail = if index == 0 { first } else { Detail::Observed };
        let seed = design.simulation.seed.wrapping_add(u64::from(start));
        let progress = |report: ProgressReport| {
            (watch.progress)(ProgressReport { number: index, of: jobs.len(), ..report });
        };
        let watch = RunControl { progress: &progress, ..*watch };
        simulate(design, &choose(design), &crate::guideline::guideline(design), seed, detail, &watch)
    };
    let runs = if jobs.len() == 1 { vec![one(0)] } else { side_by_side(threads, jobs.len(), one) };
    let runs = runs.into_iter().collect::<Result<Vec<_>, _>>()?;
    let mut runs: Vec<(FlowCase, Simulated)> = jobs.iter().map(|(_, (case, _))| *case).zip(runs).collect();
    let doubts = runs.iter().flat_map(|(case, run)| doubts_of(*case, run, starts)).collect();
    let (_, mut simulated) = runs.remove(0);
    simulated.doubts = doubts;
    simulated.facts.threads = threads;
    simulated.facts.began = began.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs() as i64);
    simulated.facts.wall_clock = started.elapsed().as_secs_f64().max(simulated.facts.wall_clock);
    for (case, other) in runs {
        simulated.numerics = simulated.numerics.worst(&other.numerics);
        match case {
            FlowCase::Characteristic => simulated.starts.extend(other.starts),
            FlowCase::Factored => simulated.factored.extend(other.starts),
            FlowCase::WeakDissipators => simulated.weak.extend(other.starts),
        }
    }
    Ok(simulated)
}

/// What a recorded simulation says, as at first.
pub fn restore(mut file: DesignFile, simulated: Option<Simulated>, varied: Vec<Swing>, climb: Vec<Step>) -> Run {
    let rung = climb.last().map(|step| &RUNGS[step.rung]);
    if let Some(rung) = rung {
        file.design = rung.of(&file.design);
    }
    let guideline = guideline(&file.design);
    Run { varied, climb, ..finish(file, guideline, simulated, rung) }
}

/// Runs one design on one rung of the ladder after the other, until no verdict can flip. `starts` is the least number of packings
/// of those rungs that have several. The file's design becomes that of the last rung.
pub fn climb(file: DesignFile, starts: u32, watch: &RunControl) -> Result<Run, RunError> {
    climb_by(file, starts, RungKind::Fine, &|design, starts| simulate_cases(design, starts, Detail::Full, watch))
}

/// The same with simulations from elsewhere, up to a rung.
pub fn climb_by(file: DesignFile, starts: u32, last: RungKind, by: &Simulate) -> Result<Run, RunError> {
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
            several => run_by(Some(rung), file, if several > 1 { several.max(starts) } else { 1 }, by)?,
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
        if decided || rung.kind == last {
            break;
        }
    }
    Ok(now)
}

/// Runs a design with so many packings, modelled as it asks, or where it leaves that to the program as the rung of several packings does: how
/// accurate that is hangs on their number.
pub fn confirm_by(mut file: DesignFile, starts: u32, by: &Simulate) -> Result<Run, RunError> {
    let rung = RUNGS.iter().find(|rung| rung.kind == RungKind::Starts);
    if let Some(rung) = rung.filter(|_| file.design.simulation.fidelity == FidelityWish::Auto) {
        file.design = rung.of(&file.design);
    }
    run_by(None, file, starts, by)
}

/// The check that uses most of what it has, in words.
fn governing(outcomes: &[Outcome]) -> String {
    let words = |outcome: &Outcome| Some(format!("{} ({:.0} %)", outcome.title, 100.0 * outcome.used()?));
    most_used(outcomes).and_then(words).unwrap_or_default()
}

/// Runs the design again with every input changed alone, side by side, one start each; the answers go into `run`.
pub fn vary(run: &mut Run, watch: &RunControl) -> Result<(), RunError> {
    let variants = variants(&run.file.design);
    let answer = |number: usize, design: &Design| -> Result<Point, RunError> {
        // Forces and strokes are designed for the factored flow alone.
        let design = flow_cases::governing(design);
        let guideline = guideline(&design);
        let seed = design.simulation.seed;
        let progress = |report: ProgressReport| {
            (watch.progress)(ProgressReport { number, of: 2 * variants.len(), ..report });
        };
        let watch = RunControl { progress: &progress, ..*watch };
        let simulated = simulate(&design, &choose(&design), &guideline, seed, Detail::Observed, &watch)?;
        let mut demands = Demands::meet(&guideline, &simulated.seen(), &design.factors);
        demands.leave_out_guideline();
        let point = Point::of(simulated.first().one(&total_force::PEAK), &check_all(&design, &demands));
        Ok(if simulated.doubts.is_empty() { point } else { point.unreliable() })
    };
    let points = side_by_side(rayon::current_num_threads(), variants.len(), |index| {
        let [down, up] = &variants[index].designs;
        Ok([answer(2 * index, down)?, answer(2 * index + 1, up)?])
    });
    run.varied = swings(variants, points.into_iter().collect::<Result<_, RunError>>()?);
    Ok(())
}

fn doubts_of(case: FlowCase, run: &Simulated, starts: u32) -> Vec<String> {
    let named = |doubt: &String| {
        let seed = if starts > 1 { format!("seed {}: ", run.starts[0].seed) } else { String::new() };
        let flow = match case {
            FlowCase::Characteristic => "",
            FlowCase::Factored => "factored flow: ",
            FlowCase::WeakDissipators => "weakest dissipators: ",
        };
        format!("{seed}{flow}{doubt}")
    };
    run.doubts.iter().map(named).collect()
}

fn finish(file: DesignFile, guideline: Guideline, simulated: Option<Simulated>, rung: Option<&'static Rung>) -> Run {
    let design = &file.design;
    let packings = simulated.as_ref().map_or(0, |simulated| simulated.starts.len());
    let rung = rung.unwrap_or_else(|| rung_of(design, packings));
    // What a run shows that broke down is no event: the checks are left to the equations.
    let whole = simulated.as_ref().filter(|simulated| simulated.numerics.broke_down.is_none());
    let seen = whole.map(Simulated::seen).unwrap_or_default();
    let demands = Demands::meet(&guideline, &seen, &design.factors);
    let judge = |design: &Design| {
        let mut outcomes = check_all(design, &demands);
        // Whatever is asked of the first surge is asked of each, as if it came first.
        for number in design.flow.distinct() {
            let led = design.led_by(number);
            let guideline = crate::guideline::guideline(&led);
            let seen = whole.map(|simulated| shown_by(rung, &led, number, &guideline, simulated));
            leave_open_not_covered(CheckContext { design: &led, guideline: &guideline, seen }, &mut outcomes);
        }
        leave_open_outside_range(design, &guideline, &mut outcomes);
        if whole.is_some() {
            rung.leave_open_what_is_too_close(packings, &mut outcomes);
        }
        outcomes
    };
    let mut outcomes = judge(design);
    leave_open_what_sockets_alone_hold(design, &mut outcomes, judge);
    let mut doubts = simulated.as_ref().map_or_else(Vec::new, |simulated| simulated.doubts.clone());
    doubts.extend(whole.into_iter().flat_map(|simulated| arriving::doubts(design, simulated)));
    let verdict = verdict(&outcomes, &doubts);
    Run { file, guideline, simulated, varied: Vec::new(), outcomes, doubts, verdict, climb: Vec::new() }
}

/// What the guideline fails, no simulation can make hold, however doubtful it is. Then doubt comes before everything; then a single
/// failed check fails the design, and a single open one leaves it undecided.
fn verdict(outcomes: &[Outcome], doubts: &[String]) -> Verdict {
    let any = |verdict: CheckVerdict| outcomes.iter().any(|outcome| outcome.verdict == verdict);
    if outcomes.iter().any(Outcome::fails_by_equations) {
        Verdict::Fail
    } else if !doubts.is_empty() {
        Verdict::Undecided
    } else if any(CheckVerdict::Fail) {
        Verdict::Fail
    } else if any(CheckVerdict::Open) {
        Verdict::Undecided
    } else {
        Verdict::Pass
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arriving::tests::{arriving, simulated};
    use crate::checks::outcome::{CheckName, OpenReason, Resistance};
    use crate::demand::Demand;
    use crate::quantities::counts::Counts;
    use crate::quantities::observed::Observed;
    use crate::quantities::quantity::Unit;

    fn check(guideline: f64, simulation: f64) -> Outcome {
        let demand = Demand { guideline: Some(guideline), simulation: Some(simulation), ..Demand::default() };
        let resistance = Resistance { characteristic: 1.0, factor: 1.0 };
        Outcome::at_most(CheckName::new("x", "x", Unit::Newton, "x"), demand, resistance, 1.0)
    }

    #[test]
    fn doubt_holds_back_a_pass_and_a_fail_of_the_simulation_but_not_one_of_the_equations() {
        let doubt = ["why".to_string()];
        let mut open = check(0.1, 0.1);
        open.leave_open(OpenReason::NotGiven("x".into()));
        for (outcomes, doubts, expected) in [
            (vec![check(0.5, 0.5)], &[][..], Verdict::Pass),
            (vec![check(0.5, 0.5)], &doubt[..], Verdict::Undecided),
            (vec![check(0.5, 0.5), open.clone()], &[][..], Verdict::Undecided),
            (vec![check(0.5, 1.5), open.clone()], &[][..], Verdict::Fail),
            (vec![check(0.5, 1.5)], &doubt[..], Verdict::Undecided),
            (vec![check(1.5, 0.5), open], &doubt[..], Verdict::Fail),
        ] {
            assert_eq!(verdict(&outcomes, doubts), expected, "{outcomes:?} {doubts:?}");
        }
    }

    use crate::design::read::read_design;

    #[test]
    fn a_doubt_says_of_which_packing_and_flow_it_is() {
        let run = Simulated {
            doubts: vec!["it broke".into()],
            ..simulated(vec![Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })])
        };
        assert_eq!(doubts_of(FlowCase::Characteristic, &run, 1), ["it broke"]);
        assert_eq!(doubts_of(FlowCase::Characteristic, &run, 2), ["seed 7: it broke"]);
        assert_eq!(doubts_of(FlowCase::Factored, &run, 1), ["factored flow: it broke"]);
        assert_eq!(doubts_of(FlowCase::Factored, &run, 5), ["seed 7: factored flow: it broke"]);
    }

    #[test]
    fn the_check_that_uses_most_governs() {
        let named = |title: &str, demand: f64| Outcome { title: title.into(), ..check(demand, demand) };
        assert_eq!(governing(&[named("rope", 0.2), named("net", 0.75), named("bolt", 0.3)]), "net (75 %)");
        assert_eq!(governing(&[]), "");
    }

    #[test]
    fn verdicts_have_their_words() {
        let words = [Verdict::Pass, Verdict::Fail, Verdict::Undecided].map(Verdict::word);
        assert_eq!(words, ["pass", "fail", "undecided"]);
    }

    /// A recorded run is judged by what was recorded: here a flow that pushes the net with next to nothing, and one that is doubtful.
    #[test]
    fn a_run_ends_with_what_its_checks_and_doubts_say() {
        let file = || read_design("x", include_bytes!("../designs/small_net.yaml")).unwrap();
        let seen = |doubts: Vec<String>| {
            let observed = arriving(4.6, 10.6).with(&total_force::PUSH, &[40e3]);
            Simulated { doubts, ..simulated(vec![observed; 5]) }
        };
        let run = restore(file(), Some(seen(Vec::new())), Vec::new(), Vec::new());
        assert!(run.doubts.is_empty() && run.outcomes.iter().any(|outcome| outcome.id == "net_tension"));
        let doubtful = restore(file(), Some(seen(vec!["it broke".into()])), Vec::new(), Vec::new());
        assert_eq!((doubtful.verdict, doubtful.doubts.len()), (Verdict::Undecided, 1));
        let slow = Simulated { starts: simulated(vec![arriving(1.0, 0.1); 5]).starts, ..seen(Vec::new()) };
        assert_eq!(restore(file(), Some(slow), Vec::new(), Vec::new()).verdict, Verdict::Undecided);
    }
}
