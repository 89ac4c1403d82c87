//! Rows of the report that tell what the simulation showed and how far it can be relied on.

use serde::Serialize;

use crate::checks::credibility::{ENERGY_LIMIT, ESCAPED_LIMIT, OVERLAP_LIMIT, PACKING_LIMIT, STEP_LIMIT, STORED_LIMIT};
use crate::design::{BarrierDesign, BarrierModel, Design};
use crate::fidelity::ladder::{RUNGS, Step};
use crate::pipeline::{Run, Verdict};
use crate::program::COMMIT;
use crate::quantities::coefficients::Coefficients;
use crate::quantities::observed::Observed;
use crate::quantities::{earth_pressure, incoming, mass, rope_tension, total_force, wall};
use crate::report::numbers::with_unit;
use crate::report::row::Row;
use crate::report::validation::Kept;
use crate::report::warnings::pinned_fidelity;
use crate::simulated::Simulated;
use crate::starts::k_n;
use crate::units::GRAVITY;

fn row(name: impl Into<String>, value: impl Into<String>, remark: impl Into<String>) -> Row {
    Row { name: name.into(), value: value.into(), remark: remark.into() }
}

/// What the first start showed.
pub fn rows(run: &Run, simulated: &Simulated) -> Vec<Row> {
    let (design, seen) = (&run.file.design, simulated.first());
    [flow_rows(design, seen), force_rows(design, seen), coefficient_rows(run, seen), loss_rows(seen), wall_rows(seen)]
        .concat()
}

fn per_width(force: f64, design: &Design) -> String {
    format!("{} of width", with_unit(force / design.channel.width, "N/m"))
}

fn flow_rows(design: &Design, seen: &Observed) -> Vec<Row> {
    let weight = design.flow.mass * GRAVITY;
    let downhill = with_unit(weight * libm::sin(design.channel.slope), "N");
    let incoming =
        format!("{} deep, {}", with_unit(seen.incoming.depth, "m"), with_unit(seen.incoming.velocity, "m/s"));
    let fastest = format!("at {:.2} s", seen.one(&mass::VELOCITY_TIME));
    vec![
        row(
            "Mass of the flow",
            with_unit(design.flow.mass, "kg"),
            format!("weight {}, its component along the bed {downhill}", with_unit(weight, "N")),
        ),
        row("Highest mean velocity", with_unit(seen.one(&mass::VELOCITY), "m/s"), fastest),
        row(
            "Incoming flow",
            incoming,
            "0.1 to 0.3 barrier heights upstream, when its momentum flux was largest and before grains came to rest there; depth at bulk density",
        ),
        row(
            "Velocity of the front",
            seen.known(&incoming::FRONT).map_or("not seen".to_string(), |front| with_unit(front, "m/s")),
            "over the last 0.4 barrier heights before the gauge; of the position that 2 % of the mass has passed",
        ),
        row(
            "Depth of the deposit at the barrier",
            with_unit(seen.one(&incoming::DEPOSIT), "m"),
            "at the end, at bulk density",
        ),
    ]
}

fn force_rows(design: &Design, seen: &Observed) -> Vec<Row> {
    vec![
        row(
            "Largest force within a sampling interval",
            with_unit(seen.one(&total_force::PEAK_SAMPLED), "N"),
            "mean over one sampling interval only; what responds faster than the smoothing window, such as a stiff wall, feels this",
        ),
        row(
            "Largest total force",
            with_unit(seen.one(&total_force::PEAK), "N"),
            format!(
                "at {:.2} s; {}; length of the vector, mean over the smoothing window",
                seen.one(&total_force::PEAK_TIME),
                per_width(seen.one(&total_force::PEAK), design)
            ),
        ),
        row("Total force at rest", with_unit(seen.one(&total_force::RESIDUAL), "N"), at_rest_remark(design, seen)),
    ]
    .into_iter()
    .chain(extension_row(seen))
    .collect()
}

/// How far the net bulges: the room it needs downstream.
fn extension_row(seen: &Observed) -> Option<Row> {
    let most = seen.each(&rope_tension::BULGE).iter().copied().fold(0.0, f64::max);
    let ropes: Vec<String> =
        seen.each(&rope_tension::BULGE).iter().map(|extension| with_unit(*extension, "m")).collect();
    (most > 0.0).then(|| {
        let remark = format!(
            "downstream, in the simulated surge; of main ropes from the bottom: {}. Keep free the larger of this and the sag by the equations",
            ropes.join(", ")
        );
        row("Largest extension of the net", with_unit(most, "m"), remark)
    })
}

/// The force at rest beside the weight of what is held.
fn at_rest_remark(design: &Design, seen: &Observed) -> String {
    let downhill = seen.one(&mass::RETAINED) * design.flow.mass * GRAVITY * libm::sin(design.channel.slope);
    let springs = matches!(design.barrier, BarrierDesign::FlexibleNet(_));
    let along = seen.one(&total_force::PUSH_RESIDUAL);
    let why = if along > downhill && springs {
        "; more, because the barrier has sprung back and presses the deposit up the slope, against the friction of the bed"
    } else if along > downhill {
        "; more, because the flow that was stopped last has pressed the deposit against the wall, and friction on the bed holds it there"
    } else {
        "; the rest is borne by the bed"
    };
    format!(
        "{}; of it {} along the bed, where the component of the held mass's weight is {}{why}",
        per_width(seen.one(&total_force::RESIDUAL), design),
        with_unit(along, "N"),
        with_unit(downhill, "N")
    )
}

fn coefficient_rows(run: &Run, seen: &Observed) -> Vec<Row> {
    let input = &run.guideline.input;
    let told = &seen.coefficients;
    let of = |value: Option<f64>| value.map_or("–".to_string(), |value| format!("{value:.2}"));
    let k = seen.known(&earth_pressure::AT_REST).map(|k| {
        let remark = format!("from the force at rest along the channel; the design takes {}", input.earth_pressure);
        row("K at rest", format!("{k:.2}"), remark)
    });
    let lambda = seen.known(&earth_pressure::DYNAMIC).map(|lambda| {
        let remark = format!(
            "from the largest force along the channel less the static part with the design's K, over ρ v² h of the incoming flow; the design takes {}",
            input.dynamic_pressure
        );
        row("λ from the largest force", format!("{lambda:.2}"), remark)
    });
    let at_peak = row(
        "K by the split, when F₁ is largest",
        of(Coefficients::at_peak_of(&told.earth_pressure, &told.force_dead)),
        format!("F₁ over ρ g' H_d (H_d/2 + h); {}", words_at(told, Coefficients::peak_of(&told.force_dead))),
    );
    let moving = row(
        "λ by the split, when F₂ is largest",
        format!(
            "{} / {}",
            of(Coefficients::at_peak_of(&told.dynamic_upstream, &told.force_moving)),
            of(Coefficients::at_peak_of(&told.dynamic_mean, &told.force_moving))
        ),
        format!(
            "(F₂ − ½ K ρ g' h²)/(ρ v² h) with the design's K, with the velocity just upstream / with the mean velocity of all grains; {}",
            words_at(told, Coefficients::peak_of(&told.force_moving))
        ),
    );
    k.into_iter().chain(lambda).chain([at_peak, moving, side_row(told)]).collect()
}

/// What the split is made of at one sample.
fn words_at(told: &Coefficients, sample: usize) -> String {
    let of = |series: &[f64], unit| with_unit(series.get(sample).copied().unwrap_or(0.0), unit);
    format!(
        "at {:.2} s F₁ = {}, F₂ = {}, H_d = {}, h = {}, v = {} / {}",
        told.time.get(sample).copied().unwrap_or(0.0),
        of(&told.force_dead, "N/m"),
        of(&told.force_moving, "N/m"),
        of(&told.deposit, "m"),
        of(&told.moving, "m"),
        of(&told.velocity_upstream, "m/s"),
        of(&told.velocity_mean, "m/s"),
    )
}

/// On which side the guideline errs.
fn side_row(told: &Coefficients) -> Row {
    let highest = |series: &[f64]| series.iter().copied().fold(0.0, f64::max);
    let side = |simulated: f64, guideline: f64| {
        let ratio = guideline / simulated;
        if !ratio.is_finite() {
            "cannot be told".to_string()
        } else if ratio < 1.0 {
            format!("too little by {:.0} %", 100.0 * (1.0 - ratio))
        } else {
            format!("too much by {:.0} %", 100.0 * (ratio - 1.0))
        }
    };
    let dead = side(highest(&told.force_dead), highest(&told.guideline_dead));
    let moving = side(highest(&told.force_moving), highest(&told.guideline_moving));
    row(
        "The guideline against this simulation",
        format!("F₁ {dead}; F₂ {moving}"),
        "largest values, from the same depths and the mean velocity, with the design's K and λ",
    )
}

fn loss_rows(seen: &Observed) -> Vec<Row> {
    let [through, under, beside, over] = seen.lost().map(|share| with_unit(share, "-"));
    let ways = format!("through {through}, under {under}, beside {beside}, over {over}");
    let stopped = with_unit(seen.one(&mass::STOPPED_UPSTREAM), "-");
    vec![
        row("Mass lost", with_unit(seen.lost().iter().sum(), "-"), ways),
        row("Mass that stopped upstream", stopped, "came to rest without leaning on the barrier; not counted as held"),
    ]
}

fn wall_rows(seen: &Observed) -> Vec<Row> {
    if seen.each(&wall::SEGMENT).is_empty() {
        return Vec::new();
    }
    let list = |values: &[f64]| values.iter().map(|value| with_unit(*value, "N/m")).collect::<Vec<_>>().join(", ");
    vec![
        row("Wall segments, largest", list(seen.each(&wall::SEGMENT)), "from the bottom up"),
        row("Wall segments, at rest", list(seen.each(&wall::SEGMENT_RESIDUAL)), "from the bottom up"),
        row("Moment about the toe, largest", with_unit(seen.one(&wall::MOMENT), "N m/m"), ""),
    ]
}

/// How the numbers were obtained, and the limits of credibility.
pub fn numerics_rows(whole: &Run, run: &Simulated) -> Vec<Row> {
    let (facts, numerics) = (&run.facts, &run.numerics);
    let fidelity = pinned_fidelity(whole).map(|why| row("Fidelity", fidelity_in_a_word(whole, run), why));
    let ending = if facts.steady { "force and masses no longer changed" } else { "stopped before it was steady" };
    let rows = vec![
        row(
            "Energy imbalance",
            format!("{:.3} %", 100.0 * numerics.energy_error),
            format!("of the energy put in; limit {} %", 100.0 * ENERGY_LIMIT),
        ),
        row(
            "Largest overlap",
            format!("{:.1} %", 100.0 * numerics.overlap),
            format!("of a grain's radius; limit {} %", 100.0 * OVERLAP_LIMIT),
        ),
        row(
            "Time step over critical step",
            format!("{:.2}", numerics.step_ratio),
            format!(
                "largest an audit met, of a mode with {:.0} % of its energy in the barrier; a step that is found too long is cut at once, and the energy account tells whether it did harm; limit {STEP_LIMIT}",
                100.0 * facts.step_ratio.in_barrier
            ),
        ),
        row("Time step", format!("{:.2e} s", facts.time_step), step_remark(run)),
        row(
            "Grains through ropes",
            numerics.crossings.to_string(),
            match facts.barrier_parts {
                0 | 1 => "none is allowed".to_string(),
                parts => format!("none is allowed; the barrier takes {parts} steps in one of the grains'"),
            },
        ),
        row(
            "Grains outside the channel",
            numerics.escaped.to_string(),
            format!(
                "through the bed or a side wall, {:.3} % of the mass, counted as lost; at most {} %",
                100.0 * numerics.escaped_share,
                100.0 * ESCAPED_LIMIT
            ),
        ),
        row(
            "Energy stored at the release",
            format!("{:.3} %", 100.0 * numerics.stored_at_release),
            format!("in the contacts of a surge, of its energy of motion; limit {} %", 100.0 * STORED_LIMIT),
        ),
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
                "of the bulk density asked for at the start; less where the grains are large against the block; at least {} %",
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
    ];
    fidelity.into_iter().chain(rows).collect()
}

/// How the step was chosen, and what became of it.
fn step_remark(run: &Simulated) -> String {
    let (wished, now) = (run.fidelity.time_step, run.facts.time_step);
    let cuts = match run.facts.step_cuts {
        0 => "never cut".to_string(),
        cuts => format!("{:.2e} s at first, cut {cuts} times by audits, to {:.2} of that", wished, now / wished),
    };
    format!("at first {}; {cuts}", run.fidelity.reason)
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
        1 => "one start".to_string(),
        starts => format!("{starts} starts"),
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
            "The level \"{}\" was sufficient: a finer model may differ from it by {:.0} % in forces, {:.0} % in strokes and {:.0} points in shares, and even so the verdict stands.",
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
    let commit = if kept.commit == this {
        format!("at this commit, {this}")
    } else {
        format!("at commit {}; this program is of commit {this}, which was not validated in full", kept.commit)
    };
    let remark = match failed.as_slice() {
        [] => commit,
        failed => format!("{commit}; not held: {}", failed.join("; ")),
    };
    row(
        "Validation of this program",
        format!("{} of {} cases hold", kept.cases.len() - failed.len(), kept.cases.len()),
        remark,
    )
}

fn seed_row(run: &Simulated) -> Row {
    let seeds: Vec<String> = run.starts.iter().map(|start| start.seed.to_string()).collect();
    let remark = match run.starts.len() {
        1 => "of the packing; one run, so no scatter is known: ask for more with --seeds".to_string(),
        starts => {
            format!("of the packings; demands are mean + {:.2} standard deviations (EN 1990, annex D)", k_n(starts))
        }
    };
    row(if seeds.len() > 1 { "Seeds" } else { "Seed" }, seeds.join(", "), remark)
}
