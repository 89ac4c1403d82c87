//! `barrier-check study FILE` of the kind sweep: every run known beforehand, each made once, wherever that is.

use std::path::{Path, PathBuf};
use std::time::Instant;

use sha2::Digest;

use crate::commands::engines::{Engine, Mode, give, word};
use crate::commands::input::{self, LONGEST_TEXT};
use crate::commands::kept::KeptResults;
use crate::commands::output::put;
use crate::commands::signals::{listen, stop};
use crate::commands::steps::Steps;
use crate::commands::{ExitCode, Failure};
use crate::design::changes::Changes;
use crate::design::read::{Source, sha256};
use crate::design::{Design, FidelityWish};
use crate::fidelity::ladder::RungKind;
use crate::pipeline::{by_equations, climb_by, confirm_by, simulate_cases};
use crate::report::folder::Folder;
use crate::report::sweep::{Swept, files};
use crate::scene::event::RunControl;
use crate::simulated::{Detail, RunError};
use crate::starts::side_by_side;
use crate::studies::choices::Choices;
use crate::studies::size_plan::By;
use crate::studies::sweep::RunRecord;
use crate::studies::sweep_plan::SweepPlan;
use crate::terminal;

/// A design of the study.
struct Site {
    path: PathBuf,
    source: Source,
    /// Of all that its runs hang on but for what they change.
    digest: [u8; 32],
}

/// All runs of a study.
struct Sweep<'a> {
    plan: &'a SweepPlan,
    choices: Choices,
    sites: Vec<Site>,
    ways: usize,
    kept: KeptResults,
}

impl<'a> Sweep<'a> {
    fn read(plan: &'a SweepPlan, beside: &Path, folder: &Path) -> Result<Self, Failure> {
        let sites = plan.designs.iter().map(|design| Site::read(plan, &beside.join(design)));
        let choices = plan.choices();
        let ways = plan.ways(&choices).unwrap_or(0);
        let sites = sites.collect::<Result<_, String>>()?;
        Ok(Self { plan, choices, sites, ways, kept: KeptResults::within(folder)? })
    }

    fn count(&self) -> usize {
        self.sites.len() * self.ways
    }

    /// Runs that one task of an engine makes: a scheduler takes longer over a task than the equations over a design.
    fn at_once(&self) -> usize {
        match self.plan.by {
            By::Equations => 100,
            By::Simulation => 1,
        }
    }

    fn changes(&self, run: usize) -> Changes {
        self.plan.changes(&self.choices, run % self.ways)
    }

    /// What a run hangs on.
    fn of(&self, run: usize) -> ([u8; 32], String) {
        let site = &self.sites[run / self.ways];
        let changes = self.changes(run);
        // A file that a changed key names is a part of what the run hangs on.
        let named = changes.texts().filter_map(|name| input::beside(&site.path, name).ok());
        let files: String = named.map(|bytes| sha256(&bytes)).collect();
        (site.digest, format!("{changes:?}{files}"))
    }

    fn kept(&self, run: usize) -> Option<RunRecord> {
        let (digest, changes) = self.of(run);
        self.kept.get(&[&digest, changes.as_bytes()])
    }

    /// The name of a run, by what it hangs on.
    fn id(&self, run: usize) -> String {
        let (digest, changes) = self.of(run);
        self.kept.id(&[&digest, changes.as_bytes()])
    }

    /// Makes a run that is not kept, and keeps it.
    fn make(&self, run: usize) -> Result<(), String> {
        if self.kept(run).is_some() {
            return Ok(());
        }
        let started = Instant::now();
        let ran = self.ran(run)?.made_in(started.elapsed().as_secs_f64());
        let (digest, changes) = self.of(run);
        let kept = self.kept.put(&[&digest, changes.as_bytes()], &ran);
        kept.map_err(|error| format!("a result could not be kept: {error}"))
    }

    fn ran(&self, run: usize) -> Result<RunRecord, String> {
        let site = &self.sites[run / self.ways];
        let open = |name: &str| input::beside(&site.path, name);
        let file = match site.source.read(self.plan.by.purpose(), &open, &self.changes(run)) {
            Ok(file) => file,
            Err(problems) => {
                let first = problems.list.first();
                let why = first
                    .map(|problem| format!("{}: found {}, allowed {}", problem.path, problem.found, problem.allowed));
                return Ok(RunRecord::nothing("invalid", why.unwrap_or_default()));
            }
        };
        let watch = RunControl { progress: &|_| (), stop: stop(), store: None };
        let by = |design: &Design, starts: u32| simulate_cases(design, starts, Detail::Observed, &watch);
        let packings = self.plan.packings;
        let result = match (self.plan.by, file.design.simulation.fidelity) {
            (By::Equations, _) => Ok(by_equations(file)),
            (By::Simulation, FidelityWish::Auto) => climb_by(file, packings, RungKind::Fine, &by),
            (By::Simulation, _) => confirm_by(file, packings, &by),
        };
        match result {
            Ok(run) => Ok(RunRecord::of(&run)),
            Err(RunError::Interrupted) => {
                Err("the study was interrupted; what has been run is kept, and it goes on there when it runs again"
                    .into())
            }
            Err(error) => Ok(RunRecord::nothing("not simulated", error.to_string())),
        }
    }
}

impl Site {
    fn read(plan: &SweepPlan, path: &Path) -> Result<Self, String> {
        let text = input::read(path, LONGEST_TEXT, b"").map_err(|error| format!("{}: {error}", path.display()))?;
        let source = Source::parse(&path.display().to_string(), &text).map_err(|problems| problems.to_string())?;
        let open = |name: &str| input::beside(path, name);
        let as_it_is = source.read(plan.by.purpose(), &open, &Changes::default());
        let attached = as_it_is.map_err(|problems| format!("a design cannot be read\n{problems}"))?.attached;
        let mut digest = sha2::Sha256::new();
        digest.update(&text);
        for (name, bytes) in &attached {
            digest.update(name);
            digest.update(sha2::Sha256::digest(bytes));
        }
        digest.update(format!("{:?} {}", plan.by, plan.packings));
        Ok(Self { path: path.to_path_buf(), source, digest: digest.finalize().into() })
    }
}

/// What is done with a study, and where. Workers take no lock: each writes files of its own, whole or not at all.
pub fn sweep(
    plan: &SweepPlan,
    file: &Path,
    folder: &Path,
    mode: &Mode,
    claim: impl FnOnce() -> Result<Folder, Failure>,
) -> Result<(Option<PathBuf>, ExitCode), Failure> {
    listen();
    let beside = file.parent().unwrap_or(Path::new("."));
    if let Mode::Only(ids) = mode {
        return only(&Sweep::read(plan, beside, folder)?, ids).map(|code| (None, code));
    }
    if *mode == Mode::List {
        let sweep = Sweep::read(plan, beside, folder)?;
        let missing: Vec<usize> = (0..sweep.count()).filter(|run| sweep.kept(*run).is_none()).collect();
        for line in lines(&sweep, &missing, file, folder, 1)? {
            // Nobody reads on.
            if !terminal::say(line) {
                break;
            }
        }
        return Ok((None, ExitCode::Pass));
    }
    let mut claimed = claim()?;
    let sweep = Sweep::read(plan, beside, claimed.path())?;
    let missing: Vec<usize> = (0..sweep.count()).filter(|run| sweep.kept(*run).is_none()).collect();
    terminal::warn(format_args!("{} runs, {} of them kept from before", sweep.count(), sweep.count() - missing.len()));
    match mode {
        Mode::On(Engine::Local) => {
            let steps = Steps::begin(missing.len());
            let made = side_by_side(rayon::current_num_threads(), missing.len(), |number| {
                let made = sweep.make(missing[number]);
                steps.done(&sweep.id(missing[number]));
                made
            });
            steps.end();
            made.into_iter().collect::<Result<(), String>>()?;
        }
        Mode::On(engine) => {
            let lines = lines(&sweep, &missing, file, claimed.path(), sweep.at_once())?;
            if !lines.is_empty() {
                give(*engine, &lines, sweep.kept.folder())?;
            }
        }
        Mode::Collect | Mode::List | Mode::Only(_) => {}
    }
    gather(&sweep, &mut claimed)
}

/// Commands that make so many runs each, which a shell, a scheduler or a person may give, once or twice, here or on another machine that sees the
/// folder.
fn lines(sweep: &Sweep, runs: &[usize], file: &Path, folder: &Path, each: usize) -> Result<Vec<String>, Failure> {
    let program = std::env::current_exe()?;
    let (file, folder) = (std::path::absolute(file)?, std::path::absolute(folder)?);
    let [program, file, folder] = [&program, &file, &folder].map(|path| word(&path.to_string_lossy()));
    let line = |runs: &[usize]| {
        let ids: Vec<String> = runs.iter().map(|run| sweep.id(*run)).collect();
        format!("{program} study {file} --out {folder} --only {}", ids.join(" "))
    };
    Ok(runs.chunks(each).map(line).collect())
}

/// Makes runs by their names.
fn only(sweep: &Sweep, ids: &[String]) -> Result<ExitCode, Failure> {
    let mut wanted: Vec<&String> = ids.iter().collect();
    for run in 0..sweep.count() {
        let id = sweep.id(run);
        if let Some(place) = wanted.iter().position(|wanted| **wanted == id) {
            wanted.swap_remove(place);
            sweep.make(run)?;
        }
        if wanted.is_empty() {
            return Ok(ExitCode::Pass);
        }
    }
    let unknown: Vec<&str> = wanted.into_iter().map(String::as_str).collect();
    Err(format!(
        "this study has no run {}: it, a design or the program has changed since it was listed",
        unknown.join(", ")
    )
    .into())
}

/// Writes the page of what is kept; not passed where runs are missing.
fn gather(sweep: &Sweep, folder: &mut Folder) -> Result<(Option<PathBuf>, ExitCode), Failure> {
    let runs: Vec<Option<RunRecord>> = (0..sweep.count()).map(|run| sweep.kept(run)).collect();
    let missing = runs.iter().filter(|run| run.is_none()).count();
    let swept =
        Swept { plan: sweep.plan, choices: &sweep.choices, ways: sweep.ways, runs: &runs, id: &|run| sweep.id(run) };
    put(folder, &files(&swept).map_err(|error| error.to_string())?)?;
    if missing > 0 {
        terminal::warn(format_args!(
            "{missing} of {} runs are missing; what is there is on the page, and the study goes on with the rest when it runs again",
            sweep.count()
        ));
    }
    let not_made = runs.iter().flatten().filter(|run| run.is_not_made()).count();
    if not_made > 0 {
        terminal::warn(format_args!(
            "{not_made} of {} runs could not be made, because their values make no design or it could not be simulated; the page says why",
            sweep.count()
        ));
    }
    let code = if missing + not_made == 0 { ExitCode::Pass } else { ExitCode::Undecided };
    Ok((Some(folder.path().join("sweep.html")), code))
}
