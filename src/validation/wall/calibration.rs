//! C5: the calibration test L44-H15-α40 over five runs, with the flow on its way (B10) and the split of the force.

use std::sync::OnceLock;

use crate::quantities::{incoming, wall};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, side_by_side};
use crate::validation::wall::laboratory::{Run, Variant, run_variant, spread};

pub const CASE: Case = Case {
    id: "C5",
    suite: Suite::Wall,
    title: "Laboratory wall L44-H15-α40, mean of five runs",
    source: "Jiang & Towhata 2013, Albaba 2015 section 3.5; grain friction 53° (measured angle of repose) settled here: 30° to \
             53° give residuals of 518 to 570 N/m against 576",
    tier: Tier::SecondHand,
    weakness: "the grain friction was chosen on this very test; peaks depend on the smoothing window (50 ms here)",
    cost: Cost::Long,
    run,
};

pub const SLIDE: Case = Case {
    id: "B10",
    suite: Suite::Bulk,
    title: "The flow on its way down the flume",
    source: "centre of mass on 25° friction: a = g (sin α − tan 25° cos α), less what the side walls hold",
    tier: Tier::ClosedForm,
    weakness: "the side walls' share is bounded, not computed",
    cost: Cost::Long,
    run: slide,
};

pub const HEAP: Case = Case {
    id: "C7",
    suite: Suite::Wall,
    title: "Where the force acts, and the heap that the flow becomes (C10)",
    source: "Jiang 2020: point of action of the normal force within 20 %, here of 80/735 m; Pudasaini 2007: a thin fast flow \
             becomes a thick heap at the wall",
    tier: Tier::SecondHand,
    weakness: "qualitative: the heap is only told from the flow",
    cost: Cost::Long,
    run: heap,
};

const STARTS: usize = 5;

/// The five runs, made once.
pub fn runs() -> Result<&'static [Run], Broken> {
    static RUNS: OnceLock<Result<Vec<Run>, String>> = OnceLock::new();
    let made = RUNS.get_or_init(|| {
        let runs = side_by_side(STARTS, |index| run_variant(&Variant::calibration(index as u64 + 1)));
        runs.into_iter().collect::<Result<_, Broken>>().map_err(|error| error.to_string())
    });
    made.as_deref().map_err(|error| Broken::Scene(error.clone()))
}

fn run() -> Result<Vec<Finding>, Broken> {
    let runs = runs()?;
    let (peak, peak_spread) = spread(runs, Run::peak);
    let (residual, residual_spread) = spread(runs, Run::residual);
    let (moment, _) = spread(runs, |run| run.observed.one(&wall::MOMENT));
    let (thickness, _) = spread(runs, |run| run.observed.one(&incoming::THICKNESS_AT_PEAK));
    let (velocity, _) = spread(runs, |run| run.observed.one(&incoming::VELOCITY_AT_PEAK));
    let mut findings = vec![
        Finding::near("largest force (N/m)", peak, 735.0, 0.15),
        Finding::told("largest force: standard deviation over the runs (N/m)", peak_spread),
        Finding::near("force at rest (N/m)", residual, 576.0, 0.10),
        Finding::told("force at rest: standard deviation over the runs (N/m)", residual_spread),
        Finding::close("largest over rest", peak / residual, 1.28, 0.15),
        Finding::near("largest moment at the toe (N m/m)", moment, 80.0, 0.20),
        Finding::close("flow thickness 40 to 50 cm upstream (cm)", 100.0 * thickness, 3.9, 0.6),
        Finding::told("flow velocity there (m/s)", velocity),
    ];
    let published = [341.0, 232.0, 154.0, 120.0, 66.0, 15.0];
    for (segment, force) in published.into_iter().enumerate() {
        let (mean, _) = spread(runs, |run| run.observed.each(&wall::SEGMENT)[segment]);
        let share = if segment < 2 { 0.35 } else { 0.25 };
        let what = format!("largest force on segment {} (N/m)", segment + 1);
        // The topmost holds 2 % of the force, a grain or two.
        findings.push(if segment == 5 { Finding::told(what, mean) } else { Finding::near(what, mean, force, share) });
    }
    let (dead_at_peak, _) = spread(runs, |run| run.share_at_rest()[0]);
    let (dead_at_end, _) = spread(runs, |run| run.share_at_rest()[1]);
    findings.push(Finding::told("share of the grains at rest in the largest force (published 0.15)", dead_at_peak));
    findings.push(Finding::between("their share at the end (1 but for the side walls' part)", dead_at_end, 0.8, 1.5));
    let error = runs.iter().map(|run| run.energy_error.abs()).fold(0.0, f64::max);
    findings.push(Finding::close("largest energy imbalance", error, 0.0, 0.01));
    Ok(findings)
}

fn heap() -> Result<Vec<Finding>, Broken> {
    let runs = runs()?;
    let (arm, _) = spread(runs, |run| run.observed.one(&wall::MOMENT) / run.peak());
    let (rise, _) =
        spread(runs, |run| run.observed.one(&incoming::DEPOSIT) / run.observed.one(&incoming::THICKNESS_AT_PEAK));
    Ok(vec![
        Finding::near("height at which the largest force acts (m)", arm, 80.0 / 735.0, 0.2),
        Finding::between("depth at the wall over thickness of the flow", rise, 3.0, 15.0),
    ])
}

fn slide() -> Result<Vec<Finding>, Broken> {
    let runs = runs()?;
    let slope = 40_f64.to_radians();
    let expected = GRAVITY * (libm::sin(slope) - libm::tan(25_f64.to_radians()) * libm::cos(slope));
    let (acceleration, _) = spread(runs, |run| {
        // While the whole block slides and nothing has met the wall.
        let at = |time: f64| run.histories.time.partition_point(|t| *t < time);
        let (from, to) = (at(0.2), at(0.7));
        let gained = run.histories.velocity[to][0] - run.histories.velocity[from][0];
        gained / (run.histories.time[to] - run.histories.time[from])
    });
    let friction = (GRAVITY * libm::sin(slope) - acceleration) / (GRAVITY * libm::cos(slope));
    Ok(vec![
        Finding::between("acceleration of the mean velocity (m/s²)", acceleration, 0.90 * expected, 1.05 * expected),
        // B11: the bed's own 0.466, and a little for the side walls; never more than tan 40°.
        Finding::between("effective friction of bed and sides (B11)", friction, 0.44, 0.60),
    ])
}
