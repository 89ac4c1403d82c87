//! A row of a table of the report, and how an outcome is told in one.

use crate::checks::outcome::{CheckVerdict, Kind, Outcome};
use crate::demand::{CAP_TOLERANCE, USED_UP};
use crate::pipeline::Run;
use crate::quantities::quantity::Unit;
use crate::report::numbers::{figures, percent, with_unit};
use serde::Serialize;

/// A name with its value and, where it helps, a remark.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub name: String,
    pub value: String,
    pub remark: String,
}

/// A row with its three texts.
pub fn row(name: impl Into<String>, value: impl Into<String>, remark: impl Into<String>) -> Row {
    Row { name: name.into(), value: value.into(), remark: remark.into() }
}

/// Outcomes by their verdict, then by how much is used.
pub fn worst_first(run: &Run) -> Vec<&Outcome> {
    let mut outcomes: Vec<&Outcome> = run.outcomes.iter().collect();
    outcomes.sort_by(|a, b| {
        let used = |outcome: &Outcome| outcome.used().unwrap_or(f64::NEG_INFINITY);
        rank(a.verdict).cmp(&rank(b.verdict)).then(used(b).total_cmp(&used(a)))
    });
    outcomes
}

/// Worst first.
fn rank(verdict: CheckVerdict) -> u8 {
    match verdict {
        CheckVerdict::Fail => 0,
        CheckVerdict::Open => 1,
        CheckVerdict::Warn => 2,
        CheckVerdict::Pass => 3,
        CheckVerdict::Info => 4,
    }
}

/// Whether a share must be kept, which reads as what is there, not as what is missing.
pub fn is_share(outcome: &Outcome) -> bool {
    outcome.unit == Unit::Share && outcome.resistance.is_none() && outcome.capacity.is_some()
}

/// How much of the capacity is used; of a share that must be kept, what is kept.
pub fn used(outcome: &Outcome) -> String {
    let stroke =
        outcome.resistance.filter(|_| outcome.kind == Kind::Stroke).map(|(resistance, _)| resistance.characteristic);
    let used_up = stroke.zip(outcome.demand.largest()).is_some_and(|(stroke, demand)| demand >= USED_UP * stroke);
    match (outcome.utilisation, outcome.verdict) {
        (None, CheckVerdict::Pass) if outcome.kind == Kind::DissipatorCurve => "within its curve".to_string(),
        (None, CheckVerdict::Pass) => at_the_plateau(outcome).to_string(),
        (Some(_), _) if is_share(outcome) => {
            outcome.demand.simulation.map_or("–".to_string(), |kept| with_unit(kept, outcome.unit.symbol()))
        }
        (used, _) if used_up && used.is_none_or(|used| used <= 10.0) => format!("≥ {}", percent(used)),
        (used, _) => percent(used),
    }
}

/// The utilisation, or the share that is kept, under the larger load that the guideline has, where that is worse.
pub fn scaled(outcome: &Outcome) -> String {
    let more = outcome.scaled.filter(|scaled| outcome.utilisation.is_none_or(|used| scaled.used > used));
    more.map_or(String::new(), |scaled| {
        // Of a share that must be kept, what would be kept.
        let told = match outcome.capacity.filter(|_| is_share(outcome)) {
            Some(least) => with_unit(1.0 - scaled.used * (1.0 - least), outcome.unit.symbol()),
            None => percent(Some(scaled.used)),
        };
        format!("{told} under {} times the load", figures(scaled.more))
    })
}

/// By which route a dissipator yields, where its stroke is not used up.
fn at_the_plateau(outcome: &Outcome) -> &'static str {
    let plateau = outcome.capacity.unwrap_or(f64::INFINITY) / CAP_TOLERANCE;
    let [guideline, simulation] = [outcome.demand.guideline, outcome.demand.simulation]
        .map(|demand| demand.is_some_and(|demand| demand >= plateau));
    match (guideline, simulation) {
        (false, false) => "stays elastic",
        (true, true) => "yields, as intended",
        (true, false) if outcome.demand.simulation.is_some() => {
            "yields in the guideline calculation, stays elastic in the simulation"
        }
        (true, false) => "yields in the guideline calculation",
        (false, true) => "yields in the simulation, stays elastic in the guideline calculation",
    }
}

/// Whether a check only says that a stroke is used up, which the check of the stroke says as well.
pub fn is_stop(outcome: &Outcome) -> bool {
    matches!(outcome.kind, Kind::DissipatorTension | Kind::DissipatorCurve)
}

/// The check in a line: "tension of main rope 3 (75 %)", "mass held by the barrier (99.9 %, at least 90.0 %)".
pub fn in_a_line(outcome: &Outcome) -> String {
    let title = lower_first(&outcome.title);
    match outcome.capacity.filter(|_| is_share(outcome)) {
        Some(least) => format!("{title} ({}, at least {})", used(outcome), with_unit(least, outcome.unit.symbol())),
        None if !scaled(outcome).is_empty() => format!("{title} ({}; {})", used(outcome), scaled(outcome)),
        None => format!("{title} ({})", used(outcome)),
    }
}

/// A title within a sentence.
pub fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().collect::<String>() + letters.as_str())
}
