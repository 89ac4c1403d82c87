//! Rows of the report that tell how its numbers were obtained, and how far they can be relied on.

use serde::Serialize;

use crate::checks::credibility::{ENERGY_LIMIT, ESCAPED_LIMIT, OVERLAP_LIMIT, PACKING_LIMIT, STEP_LIMIT, STORED_LIMIT};
use crate::checks::not_covered::context::AtOnce;
use crate::design::{BarrierDesign, BarrierModel};
use crate::fidelity::ladder::{RUNGS, Step};
use crate::first_surge::at_once;
use crate::pipeline::{Run, Verdict};
use crate::program::COMMIT;
use crate::report::numbers::with_unit;
use crate::report::row::{Row, row};
use crate::report::validation::Kept;
use crate::report::warnings::pinned_fidelity;
use crate::simulated::Simulated;
use crate::starts::k_n;

/// How the numbers were obtained, and the limits of credibility.
pub fn numerics_rows(whole: &Run, run: &Simulated) -> Vec<Row> {
    let fidelity = pinned_fidelity(whole).map(|why| row("Fidelity", fidelity_in_a_word(whole, run), why));
    fidelity.into_iter().chain(limit_rows(run)).chain(peaks_row(run)).chain(model_rows(run)).collect()
}

/// What the audits found, beside the limits of credibility.
fn limit_rows(run: &Simulated) -> Vec<Row> {
    let (facts, numerics) = (&run.facts, &run.numerics);
    vec![
        row(
            "Energy imbalance",
            format!("{:.3} %", 100.0 * numerics.energy_error),
            format!("of the energy put in; limit {} %", 100.0 * ENERGY_LIMIT),
        ),
        row(
            "Largest overlap",
            format!("{:.1} %", 100.0 * numerics.overlap),
            format!(
                "of a grain's radius; limit {} %. Grains are modelled softer than stone (flow.contact_modulus), which lengthens impacts a little",
                100.0 * OVERLAP_LIMIT
            ),
        ),
        row(
            "Time step / critical step",
            format!("{:.2}", numerics.step_ratio),
            format!(
                "largest found during the run, over all that is connected; below 1 is stable. Above 1 the step is shortened at once, and the energy balance shows whether it did harm; above {STEP_LIMIT} the run is rejected. The mode that limits it has {:.0} % of its energy in the barrier, the rest in the grains",
                100.0 * facts.step_ratio.in_barrier
            ),
        ),
        row("Time step", format!("{:.2e} s", facts.time_step), step_remark(run)),
        row(
            "Grains that passed through a rope",
            numerics.crossings.to_string(),
            match facts.barrier_substeps {
                0 | 1 => "a numerical error, none is allowed; what passes the mesh is under mass lost".to_string(),
                parts => format!(
                    "a numerical error, none is allowed; what passes the mesh is under mass lost. The barrier takes {parts} steps in one of the grains'"
                ),
            },
        ),
        row(
            "Grains outside the channel",
            numerics.escaped.to_string(),
            format!(
                "through the bed or a side of the channel, {:.3} % of the mass, counted as lost; at most {} %",
                100.0 * numerics.escaped_share,
                100.0 * ESCAPED_LIMIT
            ),
        ),
        row(
            "Energy stored at the release",
            format!("{:.3} %", 100.0 * numerics.stored_at_release),
            format!(
                "elastic energy in the contacts of a surge, as a share of its kinetic energy; limit {} %",
                100.0 * STORED_LIMIT
            ),
        ),
    ]
}

/// What was simulated, and what it took.
fn model_rows(run: &Simulated) -> Vec<Row> {
    let facts = &run.facts;
    let ending = if facts.steady { "force and masses no longer changed" } else { "stopped before it was steady" };
    vec![
        row("Simulated time", with_unit(facts.simulated, "s"), ending),
        row(
            "Model",
            format!("{} grains of {} spheres", facts.grains, facts.spheres),
            format!("{} nodes and {} elements of the barrier", facts.barrier_nodes, facts.barrier_elements),
        ),
        row(
            "Packing",
            format!("{:.0} %", 100.0 * facts.packed_share),
            format!(
                "of the specified bulk density at release; large grains pack less densely; minimum {} %",
                100.0 * (1.0 - PACKING_LIMIT)
            ),
        ),
        seed_row(run),
        validation_row(),
        row(
            "Smoothing",
            format!("{:.0} ms", 1e3 * facts.smoothing),
            format!("of total and wall forces; ropes and anchors are means over {:.1} ms", 1e3 * facts.sampling),
        ),
        row(
            "Cost",
            format!("{:.1} s", facts.wall_clock),
            format!("{} steps on {}, {} neighbour lists", facts.steps, threads(facts.threads), facts.renewals),
        ),
    ]
}

/// How the step was chosen, and what became of it.
fn step_remark(run: &Simulated) -> String {
    let (wished, now) = (run.fidelity.time_step, run.facts.time_step);
    let cuts = match run.facts.step_cuts {
        0 => "never shortened".to_string(),
        cuts => format!(
            "{:.2e} s initially, shortened {cuts} times by stability checks, to {:.2} of that",
            wished,
            now / wished
        ),
    };
    format!("chosen beforehand as {}; {cuts}", run.fidelity.reason)
}

fn threads(count: usize) -> String {
    if count == 1 { "one thread".to_string() } else { format!("{count} threads") }
}

/// The model in a few words.
fn fidelity_in_a_word(whole: &Run, run: &Simulated) -> String {
    let design = &whole.file.design;
    let model = match (&design.barrier, design.simulation.barrier_model) {
        (BarrierDesign::RigidWall(_), _) => "rigid wall",
        (_, BarrierModel::PinnedRopes) => "ropes, rings pinned",
        (_, BarrierModel::SlidingRopes) => "ropes that slide",
        (_, BarrierModel::Cylinders) => "cylinders",
    };
    let starts = match run.starts.len() {
        1 => "one run".to_string(),
        starts => format!("{starts} runs"),
    };
    format!("{}, {model}, {starts}", run.fidelity.name)
}

/// The rungs of the ladder that ran.
pub fn climb_rows(run: &Run) -> Vec<ClimbRow> {
    let row = |step: &Step| {
        let rung = &RUNGS[step.rung];
        ClimbRow {
            name: rung.name,
            what: rung.what,
            wall_clock: format!("{:.1} s", step.wall_clock),
            said: step.said.clone(),
            governing: step.governing.clone(),
            open: match step.open.as_slice() {
                [] => "nothing: no verdict can flip".to_string(),
                open => open.join("; "),
            },
        }
    };
    run.climb.iter().map(row).collect()
}

/// Why no finer rung ran.
pub fn why_enough(run: &Run) -> String {
    let Some(last) = run.climb.last() else { return String::new() };
    let rung = &RUNGS[last.rung];
    match last.open.is_empty() {
        true if run.verdict == Verdict::Undecided => format!(
            "A model finer than \"{}\" would not close what is open: see the open checks and the doubts.",
            rung.name
        ),
        false => format!(
            "\"{}\" is the finest rung there is for this design; what is open on it is too close to its limit for this program to tell.",
            rung.name
        ),
        true => format!(
            "The level \"{}\" was sufficient: a finer model may differ by {:.0} % in forces, {:.0} % in strokes and {:.0} percentage points in retained mass and height, and the verdict stands even so.",
            rung.name,
            100.0 * rung.band.force,
            100.0 * rung.band.stroke,
            100.0 * rung.band.share
        ),
    }
}

/// A rung in the report.
#[derive(Clone, Debug, Serialize)]
pub struct ClimbRow {
    pub name: &'static str,
    pub what: &'static str,
    pub wall_clock: String,
    pub said: String,
    pub governing: String,
    pub open: String,
}

/// What the validation of the program came to.
fn validation_row() -> Row {
    let Some(kept) = Kept::of_this_version() else {
        return row("Validation of this program", "unknown", "no outcome is kept with it");
    };
    let failed: Vec<String> =
        kept.cases.iter().filter(|case| !case.held).map(|case| format!("{} ({})", case.id, case.title)).collect();
    let this = COMMIT;
    let commit = match kept.commits().as_slice() {
        [(commit, _)] if *commit == this => format!("at this commit, {this}"),
        commits => {
            let of = |(commit, count): &(&str, usize)| format!("{count} at commit {commit}");
            let commits: Vec<String> = commits.iter().map(of).collect();
            format!(
                "the cases were last run with earlier versions ({}); this version (commit {this}) has passed the tests only",
                commits.join(", ")
            )
        }
    };
    let commit = match kept.not_run() {
        0 => commit,
        1 => format!("{commit}; one further case has not been run yet"),
        count => format!("{commit}; {count} further cases have not been run yet"),
    };
    let remark = match failed.as_slice() {
        [] => commit,
        failed => format!("{commit}; not passed: {}", failed.join("; ")),
    };
    row(
        "Validation of this program",
        format!("{} of {} cases pass", kept.cases.len() - failed.len(), kept.cases.len()),
        remark,
    )
}

/// What bears a net is judged by means over a sample; how much more it bears at an instant.
fn peaks_row(run: &Simulated) -> Option<Row> {
    let AtOnce { main_ropes, net, lateral_ropes, anchors, bolts, posts } = at_once(run);
    let parts = [
        ("main ropes", main_ropes),
        ("net", net),
        ("lateral ropes", lateral_ropes),
        ("anchors", anchors),
        ("bolts", bolts),
        ("posts", posts),
    ];
    // What is not a number comes last in this order, and is told.
    let most = parts.iter().map(|(_, over)| *over).max_by(f64::total_cmp).unwrap_or(1.0);
    // What the design does not have, or nothing loads, is at 1 exactly.
    let loaded = parts.iter().filter(|(_, over)| *over != 1.0);
    let told: Vec<String> = loaded.map(|(name, over)| format!("{name} {over:.2}")).collect();
    let told = if told.is_empty() { String::new() } else { format!(" ({})", told.join(", ")) };
    let of_a_net = run.facts.barrier_nodes > 0;
    of_a_net.then(|| {
        row(
            "Loads at an instant",
            format!("up to {most:.2} times"),
            format!(
                "the largest mean over {:.1} ms, by which checks are judged{told}; a check that would not hold the load at an instant is open",
                1e3 * run.facts.sampling
            ),
        )
    })
}

fn seed_row(run: &Simulated) -> Row {
    let seeds: Vec<String> = run.starts.iter().map(|start| start.seed.to_string()).collect();
    let remark = match run.starts.len() {
        1 => "number of the random initial packing. A single run: its scatter is not measured but allowed for, see Fidelity; --seeds 5 measures it".to_string(),
        starts => {
            format!(
                "numbers of the random initial packings, one for each run; demands are mean + {:.2} standard deviations (EN 1990, annex D)",
                k_n(starts)
            )
        }
    };
    row(if seeds.len() > 1 { "Seeds" } else { "Seed" }, seeds.join(", "), remark)
}
