//! `barrier-check study FILE` of the kind reliability: how probable it is that a barrier fails.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use crate::commands::input::{self, LONGEST_TEXT};
use crate::commands::kept::KeptResults;
use crate::commands::kept_simulations::simulated;
use crate::commands::output::put;
use crate::commands::signals::listen;
use crate::commands::steps::Steps;
use crate::commands::{ExitCode, Failure};
use crate::design::Design;
use crate::design::changes::Changes;
use crate::design::read::{DesignFile, Source};
use crate::problem::Problems;
use crate::report::assessment::Told;
use crate::report::folder::Folder;
use crate::report::probability::files;
use crate::simulated::{RunError, Simulated};
use crate::starts::side_by_side;
use crate::studies::limit_states::{Asked, Judged, LimitStates, Tally, coarse};
use crate::studies::reliability::{Answer, Assessed, Wanted, by_equations, by_simulations};
use crate::studies::reliability_plan::ReliabilityPlan;
use crate::studies::size_plan::By;
use crate::terminal;

/// Works the probability out, writes the page, and returns it with what the probability is to the target.
pub fn reliability(plan: &ReliabilityPlan, beside: &Path, mut folder: Folder) -> Result<(PathBuf, ExitCode), Failure> {
    listen();
    let started = Instant::now();
    let path = beside.join(&plan.design);
    let text = input::read(&path, LONGEST_TEXT, b"").map_err(|error| format!("{}: {error}", path.display()))?;
    let source = Source::parse(&path.display().to_string(), &text).map_err(|problems| problems.to_string())?;
    let attached: Mutex<BTreeMap<String, Result<Vec<u8>, String>>> = Mutex::new(BTreeMap::new());
    let open = |name: &str| {
        let mut attached = attached.lock().map_err(|_| "a file could not be read".to_string())?;
        attached.entry(name.to_string()).or_insert_with(|| input::beside(&path, name)).clone()
    };
    let as_it_is = source
        .read(plan.by.purpose(), &open, &Changes::new(plan.set()))
        .map_err(|problems| format!("the design is not valid\n{problems}"))?;
    let (inputs, set) = (plan.list(), plan.set());
    let together = plan.together().ok_or("correlations that no inputs can have at once")?;
    let states = LimitStates {
        source: &source,
        open: &open,
        inputs: &inputs,
        together: &together,
        set: &set,
        factors: plan.factors,
        only: &plan.checks,
        purpose: plan.by.purpose(),
        tally: Tally::default(),
    };
    let events: Vec<f64> = plan.events().iter().map(|value| inputs[0].of.score(*value)).collect();
    let wanted = Wanted {
        samples: plan.samples,
        accuracy: plan.accuracy(),
        runs: plan.runs,
        packings: plan.packings,
        seed: plan.seed,
        events: &events,
        independent: together.independent(),
        workers: rayon::current_num_threads(),
    };
    let (asked, assessed) = match plan.by {
        By::Equations => of_equations(&states, &wanted)?,
        By::Simulation => of_simulations(&states, &wanted, &KeptResults::within(folder.path())?)?,
    };
    let answer = assessed.answer(plan.target());
    let told = Told {
        plan,
        inputs: &inputs,
        design: &as_it_is,
        values: &|u| together.at(u),
        weights: &|alpha| together.weights(alpha),
        asked: &asked,
        assessed: &assessed,
        answer,
        doubts: &states.tally.doubts(),
        took: started.elapsed().as_secs_f64(),
    };
    put(&mut folder, &files(&told).map_err(|error| error.to_string())?)?;
    let code = match answer {
        Answer::NotAsked => ExitCode::Pass,
        Answer::Exceeds => ExitCode::Fail,
        Answer::Undecided => ExitCode::Undecided,
    };
    Ok((folder.path().join("reliability.html"), code))
}

/// That every check that is named is judged, and one at least.
fn judged(states: &LimitStates, asked: &Asked) -> Result<(), String> {
    let known = |id: &String| asked.checks.iter().any(|check| check.id == *id);
    if let Some(unknown) = states.only.iter().find(|id| !known(id)) {
        return Err(format!(
            "checks: found {unknown}, which is no check of this design that is judged by this route; `barrier-check loads` with the design writes the ids of its checks into result.json, and `barrier-check explain` lists all"
        ));
    }
    if asked.checks.is_empty() {
        return Err("no check of this design is judged this way, so there is no probability to tell".into());
    }
    Ok(())
}

fn refused(problems: Problems) -> String {
    format!("with every input at its median the design is not valid\n{problems}")
}

fn of_equations(states: &LimitStates, wanted: &Wanted) -> Result<(Asked, Assessed), String> {
    let medians = states.design(&vec![0.0; states.inputs.len()]).map_err(refused)?;
    let asked = states.asked(&medians, None);
    judged(states, &asked)?;
    let used = |u: &[f64]| states.by_equations(u, &asked.checks);
    let assessed = by_equations(states.inputs.len(), &used, &asked.checks, &states.tally, wanted);
    Ok((asked, assessed))
}

fn of_simulations(states: &LimitStates, wanted: &Wanted, kept: &KeptResults) -> Result<(Asked, Assessed), String> {
    let run = |u: &[f64], packing: u32| -> Result<Option<(Design, Simulated)>, String> {
        let Ok(file) = states.design(u) else { return Ok(None) };
        let mut design = coarse(&file.design);
        design.simulation.seed = design.simulation.seed.wrapping_add(u64::from(packing));
        match simulated(kept, &design, 1) {
            Ok(simulated) => Ok(Some((design, simulated))),
            Err(RunError::Interrupted) => Err(
                "the study was interrupted; what has been simulated is kept, and it goes on there when it runs again"
                    .into(),
            ),
            Err(error) => {
                states.tally.doubt(error.to_string());
                Ok(None)
            }
        }
    };
    let medians = vec![0.0; states.inputs.len()];
    let file = states.design(&medians).map_err(refused)?;
    let Some((design, first)) = run(&medians, 0)? else {
        return Err("with every input at its median the design cannot be simulated".into());
    };
    let asked = states.asked(&DesignFile { design, ..file }, Some(&first));
    judged(states, &asked)?;
    let (checks, done, steps) = (&asked.checks, Mutex::new(0), Steps::begin(wanted.runs));
    let runs = |batch: &[(Vec<f64>, u32)]| {
        let ran = side_by_side(wanted.workers, batch.len(), |number| {
            let (u, packing) = &batch[number];
            let found = run(u, *packing)?;
            Ok(found.and_then(|(design, simulated)| states.by_simulation(&design, &simulated, checks)))
        });
        let ran = ran.into_iter().collect::<Result<Vec<_>, String>>()?;
        tell(&done, batch.len(), &steps, &ran, checks);
        Ok(ran)
    };
    let assessed = by_simulations(states.inputs.len(), &runs, &asked.checks, &states.tally, wanted)?;
    Ok((asked, assessed))
}

/// How far the simulations have come.
fn tell(done: &Mutex<usize>, more: usize, steps: &Steps, ran: &[Option<Vec<f64>>], checks: &[Judged]) {
    let Ok(mut done) = done.lock() else { return };
    *done += more;
    let largest = |used: &Vec<f64>| {
        let of_each = used.iter().zip(checks).max_by(|a, b| a.0.total_cmp(b.0));
        of_each.map_or(String::new(), |(used, check)| format!("{} {:.0} %", check.title, 100.0 * used))
    };
    let last: Vec<String> =
        ran.iter().map(|used| used.as_ref().map_or("not judged".into(), largest)).rev().take(2).rev().collect();
    let _ = terminal::say(format_args!("{}, at the most; the last: {}", steps.line(*done), last.join(", ")));
}
