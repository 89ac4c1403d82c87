//! The event surge by surge: a row for each, a chart of forces, and what they say together.

use serde::Serialize;

use crate::checks::outcome::Kind;
use crate::pipeline::Run;
use crate::report::chart::Chart;
use crate::report::numbers::{figures, with_scatter, with_unit};
use crate::report::plots::surges::{Pair, surges};
use crate::stages::{SurgeResult, hardest, stages};
use crate::starts::Spread;

#[derive(Debug, Default, Serialize)]
pub struct Surges {
    /// A heading for each column, the surge first.
    pub columns: Vec<String>,
    /// For each quantity its name and a value for each surge.
    pub rows: Vec<Line>,
    pub chart: Option<Chart>,
    pub says: String,
}

#[derive(Debug, Serialize)]
pub struct Line {
    pub name: &'static str,
    pub values: Vec<String>,
}

/// Nothing where there is one surge only, or nothing was simulated.
pub fn of(run: &Run) -> Option<Surges> {
    let simulated = run.simulated.as_ref()?;
    let stages = stages(&run.file.design, simulated);
    if stages.is_empty() {
        return None;
    }
    let columns = (1..=stages.len()).map(|number| format!("surge {number}")).collect();
    Some(Surges { columns, rows: rows(&stages), chart: Some(chart(&stages)), says: says(run, &stages) })
}

fn rows(stages: &[SurgeResult]) -> Vec<Line> {
    let line = |name: &'static str, value: &dyn Fn(&SurgeResult) -> String| Line {
        name,
        values: stages.iter().map(value).collect(),
    };
    let spread = |spread: Spread, unit: &str| match spread.starts {
        0 | 1 => with_unit(spread.mean, unit),
        _ => with_scatter(spread.mean, spread.deviation, unit),
    };
    let known = |value: Option<Spread>, unit: &str| value.map_or("–".to_string(), |value| spread(value, unit));
    let mut rows = vec![
        line("Volume, depth and velocity as given", &|stage| {
            format!(
                "{}, {}, {}",
                with_unit(stage.volume, "m³"),
                with_unit(stage.depth, "m"),
                with_unit(stage.velocity, "m/s")
            )
        }),
        line("Depth of the deposit before", &|stage| spread(stage.before, "m")),
        line("Largest force along the bed", &|stage| spread(stage.force, "N")),
        line("Guideline, over the same deposit", &|stage| with_unit(stage.guideline, "N")),
        line("Simulation over guideline", &|stage| figures(stage.force.mean / stage.guideline)),
        line("λ with depth and velocity as given", &|stage| known(stage.lambda, "")),
        line("λ with depth and velocity as measured at the barrier", &|stage| known(stage.lambda_measured, "")),
        line("K of the deposit at rest after it", &|stage| known(stage.k_at_rest, "")),
        line("Depth of the deposit after", &|stage| spread(stage.after, "m")),
        line("Highest level at the barrier", &|stage| spread(stage.level, "m")),
        line("Mass past the barrier, of the surge's", &|stage| spread(stage.lost, "-")),
    ];
    let first = &stages[0];
    if first.rope.is_some() {
        rows.push(line("Largest tension of a main rope", &|stage| known(stage.rope, "N")));
        rows.push(line("Largest tension of the net's ropes", &|stage| known(stage.net, "N")));
        rows.push(line("Largest load of an anchor", &|stage| known(stage.anchor, "N")));
    }
    if first.stroke.is_some() {
        rows.push(line("Longest stroke of a dissipator, in all", &|stage| {
            known(stage.stroke.map(|[all, _]| all), "m")
        }));
        rows.push(line("of it by this surge", &|stage| known(stage.stroke.map(|[_, own]| own), "m")));
    }
    rows
}

fn chart(stages: &[SurgeResult]) -> Chart {
    let pair = |stage: &SurgeResult| Pair {
        guideline: stage.guideline * 1e-3,
        simulation: stage.force.mean * 1e-3,
        scatter: (stage.force.starts > 1)
            .then(|| [-1.0, 1.0].map(|side| (stage.force.mean + side * stage.force.deviation) * 1e-3)),
    };
    let pairs: Vec<Pair> = stages.iter().map(pair).collect();
    Chart::of(
        "Largest force along the bed, surge by surge",
        surges(&pairs, "kN"),
        "Without partial factors. The guideline's stage is that of the deposit that lay there, with the depth and velocity that the design gives the surge; a line: mean ± standard deviation of the packings.",
    )
}

fn says(run: &Run, stages: &[SurgeResult]) -> String {
    let hardest = hardest(stages).map_or(0, |number| number + 1);
    let [least, most] = stages
        .iter()
        .map(|stage| stage.force.mean / stage.guideline)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], ratio| [least.min(ratio), most.max(ratio)]);
    let missing = run.file.design.flow.surges() - stages.len();
    let missing = if missing > 0 { format!(" {missing} of the surges were not simulated.") } else { String::new() };
    format!(
        "The barrier is not emptied between the surges; dissipators keep their strokes, and ropes what they have drawn out. Surge {hardest} pushes hardest, and every check takes the worst moment of all surges. The simulation shows {} to {} times the guideline's force.{missing} {}",
        figures(least),
        figures(most),
        before_the_next(run, stages)
    )
}

/// Before which surge the barrier would have to be cleared, or its dissipators replaced.
fn before_the_next(run: &Run, stages: &[SurgeResult]) -> String {
    let strokes = run.outcomes.iter().filter(|outcome| outcome.kind == Kind::Stroke);
    let permitted = strokes.filter_map(|outcome| outcome.capacity).reduce(f64::min);
    // Asked as "within", so that what is not a number is not.
    let is_within =
        |stage: &SurgeResult| permitted.is_none_or(|most| stage.stroke.is_none_or(|[all, _]| all.mean <= most));
    let worn = stages.iter().position(|stage| !is_within(stage));
    let top = run.guideline.input.barrier_height;
    let is_below = |stage: &SurgeResult| stage.level.mean <= top;
    let over = stages.iter().position(|stage| !is_below(stage));
    let mut said = Vec::new();
    if let Some(number) = worn {
        said.push(format!(
            "With surge {} a dissipator uses more of its stroke than is permitted: it would have to be replaced before the next.",
            number + 1
        ));
    }
    match over {
        Some(0) => said.push("The first surge already rises above the barrier's top as built.".to_string()),
        Some(number) => said.push(format!(
            "Surge {} is the first to rise above the barrier's top as built: the barrier would have to be cleared before it.",
            number + 1
        )),
        None => {}
    }
    if said.is_empty() {
        said.push(
            "None of them uses up the permitted stroke of a dissipator or rises above the barrier's top as built."
                .to_string(),
        );
    }
    said.push("This is by the means of the runs; the checks decide.".to_string());
    said.join(" ")
}
