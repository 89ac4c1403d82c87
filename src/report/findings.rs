//! Rows of the report that tell what the simulation showed and how far it can be relied on.

use crate::checks::credibility::{ENERGY_LIMIT, OVERLAP_LIMIT, STEP_LIMIT};
use crate::pipeline::Run;
use crate::report::view::{Row, with_unit};
use crate::units::GRAVITY;

fn row(name: impl Into<String>, value: impl Into<String>, remark: impl Into<String>) -> Row {
    Row { name: name.into(), value: value.into(), remark: remark.into() }
}

/// What the simulation showed.
pub fn rows(run: &Run) -> Vec<Row> {
    [flow_rows(run), force_rows(run), coefficient_rows(run), loss_rows(run), wall_rows(run)].concat()
}

fn per_width(force: f64, run: &Run) -> String {
    format!("{} of width", with_unit(force / run.file.design.channel.width, "N/m"))
}

fn flow_rows(run: &Run) -> Vec<Row> {
    let (design, seen) = (&run.file.design, &run.observed);
    let weight = design.flow.mass * GRAVITY;
    let downhill = with_unit(weight * design.channel.slope.sin(), "N");
    let incoming =
        format!("{} deep, {}", with_unit(seen.incoming.depth, "m"), with_unit(seen.incoming.velocity, "m/s"));
    let fastest = format!("at {:.2} s", seen.velocity_peak_time);
    vec![
        row(
            "Mass of the flow",
            with_unit(design.flow.mass, "kg"),
            format!("weight {}, of it along the bed {downhill}", with_unit(weight, "N")),
        ),
        row("Highest mean velocity", with_unit(seen.velocity_peak, "m/s"), fastest),
        row(
            "Incoming flow",
            incoming,
            "at the gauge upstream, when its momentum flux was largest; depth at bulk density",
        ),
        row("Depth of the deposit at the barrier", with_unit(seen.deposit_depth, "m"), "at the end, at bulk density"),
    ]
}

fn force_rows(run: &Run) -> Vec<Row> {
    let seen = &run.observed;
    let mut rows = vec![
        row(
            "Largest total force",
            with_unit(seen.force_peak, "N"),
            format!("at {:.2} s; {}", seen.force_peak_time, per_width(seen.force_peak, run)),
        ),
        row("Total force at rest", with_unit(seen.force_residual, "N"), per_width(seen.force_residual, run)),
    ];
    if seen.bed_force_peak > 0.0 {
        let remark = format!("{}; not held against a resistance", per_width(seen.bed_force_peak, run));
        rows.push(row("Load on the bolts of the lowest rope, largest", with_unit(seen.bed_force_peak, "N"), remark));
    }
    rows
}

fn coefficient_rows(run: &Run) -> Vec<Row> {
    let input = &run.guideline.input;
    let k = run.observed.k_effective.map(|k| {
        let remark = format!("from the force at rest along the channel; the design takes {}", input.earth_pressure);
        row("K that the simulation shows", format!("{k:.2}"), remark)
    });
    let lambda = run.observed.lambda_effective.map(|lambda| {
        let remark = format!(
            "from the largest force along the channel less the static part with the design's K; the design takes {}",
            input.dynamic_pressure
        );
        row("λ that the simulation shows", format!("{lambda:.2}"), remark)
    });
    k.into_iter().chain(lambda).collect()
}

fn loss_rows(run: &Run) -> Vec<Row> {
    let [through, under, beside, over] = run.observed.lost.map(|share| with_unit(share, "-"));
    let ways = format!("through {through}, under {under}, beside {beside}, over {over}");
    vec![row("Mass lost", with_unit(1.0 - run.observed.retained, "-"), ways)]
}

fn wall_rows(run: &Run) -> Vec<Row> {
    let seen = &run.observed;
    if seen.segment_peak.is_empty() {
        return Vec::new();
    }
    let list = |values: &[f64]| values.iter().map(|value| with_unit(*value, "N/m")).collect::<Vec<_>>().join(", ");
    vec![
        row("Wall segments, largest", list(&seen.segment_peak), "from the bottom up"),
        row("Wall segments, at rest", list(&seen.segment_residual), "from the bottom up"),
        row("Moment about the toe, largest", with_unit(seen.moment_peak, "N m/m"), ""),
    ]
}

/// How the numbers were obtained, and the limits of credibility.
pub fn numerics_rows(run: &Run) -> Vec<Row> {
    let (facts, numerics) = (&run.facts, &run.numerics);
    let ending = if facts.steady { "force and masses no longer changed" } else { "stopped before it was steady" };
    vec![
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
                "largest met, of a mode with {:.0} % of its energy in the barrier; limit {STEP_LIMIT}",
                100.0 * facts.step_ratio.in_barrier
            ),
        ),
        row(
            "Time step",
            format!("{:.2e} s", facts.time_step),
            format!("{}; cut {} times", run.fidelity.reason, facts.step_cuts),
        ),
        row(
            "Grains through ropes",
            numerics.crossings.to_string(),
            format!("none is allowed; the barrier takes {} steps in one of the grains'", facts.barrier_parts),
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
            "of the bulk density asked for at the start; less where the grains are large against the block",
        ),
        row("Seed", run.file.design.simulation.seed.to_string(), "of the packing; one run, so no scatter is known"),
        row(
            "Smoothing",
            format!("{:.0} ms", 1e3 * facts.smoothing),
            format!("of total and wall forces; ropes and anchors are means over {:.1} ms", 1e3 * facts.sampling),
        ),
        row(
            "Cost",
            format!("{:.1} s", facts.wall_clock),
            format!("{} steps on {} threads, {} neighbour lists", facts.steps, facts.threads, facts.renewals),
        ),
    ]
}
