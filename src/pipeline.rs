//! The run on one page: design → load cases → fidelity → scene → histories → demands → outcomes → verdict.

use std::time::{Instant, SystemTime, UNIX_EPOCH};

use crate::arriving;
use crate::checks::check_all;
use crate::checks::not_covered::context::{AtOnce, CheckContext, FirstSurge};
use crate::checks::not_covered::leave_open_not_covered;
use crate::checks::outcome::{CheckVerdict, Outcome, most_used};
use crate::checks::range::leave_open_outside_range;
use crate::checks::ropes::leave_open_what_sockets_alone_hold;
use crate::demand::Demands;
use crate::design::read::DesignFile;
use crate::design::{BarrierDesign, Design, FidelityWish};
use crate::fidelity::choose;
use crate::fidelity::ladder::{RUNGS, Rung, RungKind, Step, rung_of};
use crate::flow_cases::{self, FlowCase, cases};
use crate::guideline::{Guideline, earth_pressure_by_weight, guideline};
use crate::larger::larger_or_nan;
use crate::quantities::observed::Observed;
use crate::quantities::quantity::Quantity;
use crate::quantities::{
    anchor_load, bed, boulder, earth_pressure, other_ropes, posts, rope_tension, total_force, wall,
};
use crate::scene::estimate::estimate;
use crate::scene::event::{ProgressReport, RunControl};
use crate::sensitivity::simulated::{swings, variants};
use crate::sensitivity::{Point, Swing};
use crate::simulated::{Detail, RunError, Simulated, Start, simulate};
use crate::stages::push_on_empty;
use crate::starts::{Spread, side_by_side};

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

/// By how much the next run may push harder than a single one: on the nets of the examples the push scatters with standard deviations of 3
/// to 5 %, on rigid walls of up to 16 %, and there the single one may be the mildest of several (381 to 580 kN in six).
const ONE_RUN: [f64; 2] = [1.08, 1.6];

/// What the simulation shows of one surge, counted from 0, as of one that comes first; `design` is led by it.
fn shown_by(rung: &Rung, design: &Design, number: usize, guideline: &Guideline, simulated: &Simulated) -> FirstSurge {
    // What fills later presses with its weight as well, whatever the first deposit shows.
    let by_weight = design.loads.to_the_top.then(|| earth_pressure_by_weight(design, guideline)).flatten();
    let band = rung.band;
    let short_peaks = |of: fn(&Observed) -> [f64; 2]| {
        let ratios =
            simulated.starts.iter().map(|start| of(&start.observed)).map(|[sampled, smoothed]| sampled / smoothed);
        ratios.fold(1.0, larger_or_nan)
    };
    // Of the deposit at the end, and of what each surge has left.
    let of_deposits = |seen: &dyn Fn(&Start) -> Option<f64>| {
        let at_rest: Vec<f64> = simulated.starts.iter().filter_map(seen).collect();
        (!at_rest.is_empty()).then(|| Spread::of(&at_rest).mean)
    };
    let of_the_whole = |k: f64| design.flow.pore_fluid.map_or(k, |fluid| fluid.of_the_whole(k).max(k));
    let k_of = |seen: &Observed| seen.known(&earth_pressure::OF_ANY_DEPTH).map(of_the_whole);
    let at_the_end = of_deposits(&|start| k_of(&start.observed));
    let of_surges = (0..design.flow.surges()).filter_map(|surge| of_deposits(&|start| k_of(start.surges.get(surge)?)));
    let seen = at_the_end.into_iter().chain(of_surges).reduce(larger_or_nan);
    let over = |value: &dyn Fn(&Start) -> f64| Spread::of(&simulated.starts.iter().map(value).collect::<Vec<_>>());
    // One that shows no λ, because the barrier is full when it comes, tells nothing more than is given.
    let push = over(&|start| push_on_empty(design, start, number).unwrap_or_else(|| guideline.first_surge()));
    let arrives = arriving::of_surge(design, simulated, number);
    let on_a_wall = matches!(design.barrier, BarrierDesign::RigidWall(_));
    let one_run = ONE_RUN[usize::from(on_a_wall)];
    let hardest = |spread: &Spread| if spread.starts > 1 { spread.upper() } else { one_run * spread.mean };
    let hit = over(&|start| start.observed.one(&boulder::FORCE));
    FirstSurge {
        push: push.mean,
        boulder: if design.flow.boulders.is_empty() { 0.0 } else { hardest(&hit) },
        one_run: if push.starts > 1 { 0.0 } else { one_run - 1.0 },
        largest_push: simulated.spread(|seen| seen.one(&total_force::PUSH)).mean,
        hardest_push: hardest(&push),
        moment: simulated.spread(|seen| seen.one(&wall::MOMENT)).mean,
        sampled_over_smoothed: short_peaks(|seen| [seen.one(&total_force::PEAK_SAMPLED), seen.one(&total_force::PEAK)]),
        moment_sampled_over_smoothed: short_peaks(|seen| [seen.one(&wall::MOMENT_SAMPLED), seen.one(&wall::MOMENT)]),
        at_once: at_once(simulated),
        depth: arrives.depth,
        velocity: arrives.velocity,
        flux_share: arrives.flux_share,
        earth_pressure: seen.into_iter().chain(by_weight).reduce(larger_or_nan),
        force_band: if on_a_wall { rung.on_a_wall } else { band.force },
        net_band: rung.of_the_net,
        stroke_band: band.stroke,
        share_band: band.share,
    }
}

/// A largest load at an instant over the largest mean, at least 1. Where no mean presses, an instant that does is more by any ratio; what is not a
/// number stays so, or is infinite.
fn above(instant: f64, mean: f64) -> f64 {
    if instant <= mean {
        1.0
    } else if mean > 0.0 {
        instant / mean
    } else {
        f64::INFINITY
    }
}

/// By how much what bears a net is loaded more at an instant than in the mean over a sample, as the next packing may exceed both with a
/// probability of 5 %.
pub fn at_once(simulated: &Simulated) -> AtOnce {
    let ratio = |instant: &Quantity, sample: &Quantity| {
        let rows = simulated.first().each(sample).len();
        let ratios = (0..rows).map(|row| {
            let largest = |of: &Quantity| {
                let seen = simulated.starts.iter().map(|start| start.observed.each(of).get(row).copied());
                let spread = Spread::of(&seen.map(|value| value.unwrap_or(f64::NAN)).collect::<Vec<_>>());
                if spread.starts > 1 { spread.upper() } else { spread.mean }
            };
            let [instant, mean] = [instant, sample].map(largest);
            above(instant, mean)
        });
        ratios.fold(1.0, larger_or_nan)
    };
    AtOnce {
        main_ropes: ratio(&rope_tension::AT_ONCE, &rope_tension::PEAK),
        net: ratio(&other_ropes::NET_AT_ONCE, &other_ropes::NET),
        lateral_ropes: ratio(&other_ropes::LATERAL_AT_ONCE, &other_ropes::LATERAL),
        anchors: ratio(&anchor_load::AT_ONCE, &anchor_load::PEAK),
        bolts: ratio(&bed::BOLT_AT_ONCE, &bed::BOLT),
        posts: larger_or_nan(
            ratio(&posts::COMPRESSION_AT_ONCE, &posts::COMPRESSION),
            ratio(&posts::RETAINING_AT_ONCE, &posts::RETAINING),
        ),
    }
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
    use crate::checks::outcome::{CheckName, OpenReason, Resistance};
    use crate::demand::Demand;
    use crate::quantities::counts::Counts;
    use crate::quantities::quantity::Unit;
    use crate::quantities::{earth_pressure, total_force, wall};

    fn check(guideline: f64, simulation: f64) -> Outcome {
        let demand = Demand { guideline: Some(guideline), simulation: Some(simulation), ..Demand::default() };
        let resistance = Resistance { characteristic: 1.0, factor: 1.0 };
        Outcome::at_most(CheckName::new("x", "x", Unit::Newton, "x"), demand, resistance, 1.0)
    }

    #[test]
    fn an_instant_is_never_less_than_the_mean() {
        assert_eq!([(3.0, 2.0), (0.0, 0.0), (1.0, 2.0)].map(|(instant, mean)| above(instant, mean)), [1.5, 1.0, 1.0]);
        assert_eq!(
            [(1.0, 0.0), (1.0, -2.0), (1.0, f64::NAN)].map(|(instant, mean)| above(instant, mean)),
            [f64::INFINITY; 3]
        );
        assert!(above(f64::NAN, 1.0).is_nan());
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
    use crate::fidelity::ladder::RUNGS;
    use crate::guideline::guideline as guideline_of;

    fn small_net() -> Design {
        read_design("x", include_bytes!("../designs/small_net.yaml")).unwrap().design
    }

    /// Starts from seed 7 on, each with what it showed.
    fn simulated(observed: Vec<Observed>) -> Simulated {
        let starts = observed.into_iter().zip(7..).map(|(observed, seed)| Start { seed, observed, surges: Vec::new() });
        Simulated { starts: starts.collect(), ..Simulated::default() }
    }

    /// What was seen of a flow that arrives with a velocity (m/s) and a momentum flux (m³/s²).
    fn arriving(velocity: f64, flux: f64) -> Observed {
        let mut seen = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() });
        (seen.incoming.velocity, seen.incoming.flux, seen.incoming.depth) = (velocity, flux, 0.4);
        seen
    }

    #[test]
    fn what_the_first_surge_shows_is_the_mean_of_its_packings_with_the_band_of_the_rung() {
        let design = small_net();
        let guideline = guideline_of(&design);
        let seen = |push_peak: f64, k_effective: Option<f64>, sampled: f64| {
            arriving(push_peak * 1e-4, 10.0)
                .with(&total_force::PUSH, &[push_peak])
                .with(&earth_pressure::OF_ANY_DEPTH, k_effective.as_slice())
                .with(&total_force::PEAK, &[100e3])
                .with(&total_force::PEAK_SAMPLED, &[sampled])
                .with(&wall::MOMENT, &[50e3])
                .with(&wall::MOMENT_SAMPLED, &[125e3])
        };
        let starts = simulated(vec![seen(40e3, Some(0.8), 150e3), seen(60e3, None, 120e3)]);
        let first = shown_by(&RUNGS[2], &design, 0, &guideline, &starts);
        assert_eq!((first.push, first.velocity, first.earth_pressure), (50e3, 5.0, Some(0.8)));
        assert_eq!((first.sampled_over_smoothed, first.moment_sampled_over_smoothed), (1.5, 2.5));
        // 10 m³/s² of the 0.6 · 4.6² that the design gives.
        assert!((first.flux_share - 0.78765).abs() < 1e-5, "{}", first.flux_share);
        let band = RUNGS[2].band;
        assert_eq!((first.force_band, first.stroke_band, first.share_band), (band.force, band.stroke, band.share));
        // What fills the barrier later presses with its weight as well: the larger of that K and the one that is seen.
        let by_weight = crate::guideline::earth_pressure_by_weight(&design, &guideline);
        let k = |seen_k: Option<f64>| {
            shown_by(&RUNGS[2], &design, 0, &guideline, &simulated(vec![seen(40e3, seen_k, 1.0)])).earth_pressure
        };
        assert!(by_weight.is_some_and(|k| k > 0.1 && k < 0.8));
        assert_eq!((k(None), k(Some(0.1)), k(Some(0.8))), (by_weight, by_weight, Some(0.8)));
        // Mean and k₂ = 7.733 standard deviations of two, a fixed margin on one.
        assert!((first.hardest_push / (50e3 + 7.733 * 14.142e3) - 1.0).abs() < 1e-3, "{}", first.hardest_push);
        let alone = shown_by(&RUNGS[2], &design, 0, &guideline, &simulated(vec![seen(40e3, None, 1.0)]));
        assert_eq!(alone.hardest_push, 1.08 * 40e3);
        let hidden = simulated(vec![seen(40e3, None, 1.0)]);
        let mut one_event = design.clone();
        one_event.loads.to_the_top = false;
        assert_eq!(shown_by(&RUNGS[2], &one_event, 0, &guideline, &hidden).earth_pressure, None);
    }

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
