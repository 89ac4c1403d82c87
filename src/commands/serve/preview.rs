//! What is told of a design while it is typed: all that is wrong with it, or what the equations say of it and what it looks like.

use std::sync::LazyLock;

use serde::Serialize;

use super::answer::Refused;
use super::design_folder::Chosen;
use crate::commands::messages::ProblemPart;
use crate::fidelity::choose;
use crate::pipeline::by_equations;
use crate::report::chart::Chart;
use crate::report::loads::CaseRow;
use crate::report::view::{CheckRow, OpenRow, View};
use crate::scene::estimate::{estimate, slowness};

#[derive(Debug, Default, Serialize)]
pub struct Look {
    pub problems: Vec<ProblemPart>,
    /// Nothing where the design has problems.
    pub seen: Option<Seen>,
}

/// What the equations say, and what a run would take.
#[derive(Debug, Serialize)]
pub struct Seen {
    title: String,
    verdict: &'static str,
    verdict_line: String,
    checks: Vec<CheckRow>,
    open: Vec<OpenRow>,
    warnings: Vec<String>,
    cases: Vec<CaseRow>,
    utilisation: Option<Chart>,
    /// The site and the barrier, to scale.
    drawings: Vec<Chart>,
    grains: f64,
    /// On one core (s).
    seconds: f64,
    /// Why it would not be run; empty where it would.
    too_much: String,
}

/// How slow this machine is, measured once, so that the estimate does not follow whatever else it does.
static SLOWNESS: LazyLock<f64> = LazyLock::new(slowness);

/// Looks at a text as the design with a path.
pub fn look(chosen: &Chosen, path: &str, text: &str) -> Result<Look, Refused> {
    let file = match chosen.design(path, text)? {
        Ok(file) => file,
        Err(problems) => {
            return Ok(Look { problems: problems.list.iter().map(ProblemPart::from).collect(), seen: None });
        }
    };
    let estimate = estimate(&file.design, &choose(&file.design));
    let view = View::of(&by_equations(file));
    let seen = Seen {
        title: view.title,
        verdict: view.verdict,
        verdict_line: view.verdict_line,
        checks: view.checks,
        open: view.open,
        warnings: view.warnings.into_iter().map(|warning| warning.text).collect(),
        cases: view.cases,
        utilisation: view.utilisation,
        drawings: view.site,
        grains: estimate.grains,
        seconds: estimate.seconds * *SLOWNESS,
        too_much: estimate.too_much().unwrap_or_default(),
    };
    Ok(Look { problems: Vec::new(), seen: Some(seen) })
}
