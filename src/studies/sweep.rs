//! Designs run with other values of some keys: one run, and what is kept of it.

use serde::{Deserialize, Serialize};

use crate::checks::outcome::{CheckVerdict, Outcome, most_used};
use crate::pipeline::Run;
use crate::quantities::QUANTITIES;
use crate::quantities::quantity::Of;
use dem::simd::widest::instructions;

/// What is kept of a run. The same wherever it ran, but for the time that it took and the instructions it used.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunRecord {
    /// pass, fail, undecided; `invalid` where the values make no design, `not simulated` where it could not be.
    pub verdict: String,
    /// Why it is undecided, or no design.
    pub why: String,
    /// The check that uses most of what it has, and how much.
    pub governing: String,
    pub used: Option<f64>,
    /// The same without checks that hold parts against each other, whatever the event.
    pub used_in_the_event: Option<f64>,
    pub checks: Vec<CheckRan>,
    /// Largest force of the guideline (N).
    pub guideline_force: Option<f64>,
    /// Quantities of the run as a whole, by id with the unit; means over the packings.
    pub measured: Vec<(String, f64)>,
    /// Wall-clock time (s).
    pub took: f64,
    pub instructions: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckRan {
    pub id: String,
    pub used: Option<f64>,
    /// pass, warn, fail, open or info
    pub verdict: String,
}

impl RunRecord {
    /// Whether there is nothing but why there is nothing.
    pub fn is_not_made(&self) -> bool {
        ["invalid", "not simulated"].contains(&self.verdict.as_str())
    }

    /// One that came to nothing.
    pub fn nothing(verdict: &str, why: String) -> Self {
        Self { verdict: verdict.into(), why, ..Self::default() }
    }

    /// The same with how long it took (s), and with what instructions.
    pub fn made_in(self, took: f64) -> Self {
        Self { took, instructions: instructions().into(), ..self }
    }

    /// What a run came to.
    pub fn of(run: &Run) -> Self {
        let governing = most_used(&run.outcomes);
        let of_the_event = most_used(run.outcomes.iter().filter(|outcome| !outcome.of_parts));
        let why = run.doubts.first().cloned().or_else(|| first_open(&run.outcomes));
        let check = |outcome: &Outcome| CheckRan {
            id: outcome.id.clone(),
            used: outcome.utilisation,
            verdict: outcome.verdict.word().into(),
        };
        let measured = run.simulated.iter().flat_map(|simulated| {
            let whole = QUANTITIES.iter().filter(|quantity| matches!(quantity.of, Of::Run));
            whole.map(|quantity| {
                let unit = quantity.unit.symbol().replace([' ', '/'], "_").to_lowercase();
                let name =
                    if unit.is_empty() || unit == "-" { quantity.id.into() } else { format!("{}_{unit}", quantity.id) };
                (name, simulated.spread(|seen| seen.one(quantity)).mean)
            })
        });
        Self {
            verdict: run.verdict.word().into(),
            why: why.unwrap_or_default(),
            governing: governing.map_or(String::new(), |outcome| outcome.title.clone()),
            used: governing.and_then(Outcome::used),
            used_in_the_event: of_the_event.and_then(Outcome::used),
            checks: run.outcomes.iter().map(check).collect(),
            guideline_force: Some(run.guideline.face_force),
            measured: measured.collect(),
            took: 0.0,
            instructions: String::new(),
        }
    }
}

fn first_open(outcomes: &[Outcome]) -> Option<String> {
    let open = outcomes.iter().find(|outcome| outcome.verdict == CheckVerdict::Open)?;
    Some(format!("{}: {}", open.title, open.open.as_ref().map_or("", |open| open.words())))
}
