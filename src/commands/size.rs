//! `barrier-check study FILE` of the kind size: prices, equations and simulations of all ways to put choices together.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;

use crate::commands::input::{self, LONGEST_TEXT};
use crate::commands::kept::KeptResults;
use crate::commands::kept_simulations::simulated;
use crate::commands::output::put;
use crate::commands::signals::listen;
use crate::commands::{ExitCode, Failure};
use crate::design::document::Document;
use crate::design::entries::Purpose;
use crate::design::read::{DesignFile, read_design_changed};
use crate::fidelity::ladder::RungKind;
use crate::pipeline::{Run, by_equations, climb_by, confirm_by};
use crate::report::folder::{Folder, ReportFile};
use crate::report::size::{Front, Sized, files};
use crate::simulated::RunError;
use crate::starts::side_by_side;
use crate::studies::bill::Prices;
use crate::studies::choices::Choices;
use crate::studies::size_plan::SizePlan;
use crate::studies::sizing::{Candidate, CandidateResult, Candidates, Fault, Wanted, search};
use crate::terminal;

/// Of the design that is sized: its text, and files that it and its changes name.
struct Site {
    name: String,
    path: PathBuf,
    text: Vec<u8>,
}

/// All ways to size one design.
struct Sizes<'a> {
    site: &'a Site,
    choices: &'a Choices,
    prices: &'a Prices,
    kept: &'a KeptResults,
    purpose: Purpose,
    /// Files that designs name, read once.
    attached: Mutex<BTreeMap<String, Result<Vec<u8>, String>>>,
}

/// Searches, writes the page, and returns it with whether the cheapest passes.
pub fn size(plan: &SizePlan, beside: &Path, mut folder: Folder) -> Result<(PathBuf, ExitCode), Failure> {
    listen();
    let path = beside.join(&plan.design);
    let text = input::read(&path, LONGEST_TEXT, b"").map_err(|error| format!("{}: {error}", path.display()))?;
    let site = Site { name: path.display().to_string(), path: path.clone(), text };
    let (choices, prices) = (plan.choices(), plan.prices());
    let kept = KeptResults::within(folder.path())?;
    let ways = Sizes {
        site: &site,
        choices: &choices,
        prices: &prices,
        kept: &kept,
        purpose: plan.by.purpose(),
        attached: Mutex::new(BTreeMap::new()),
    };
    let wanted = plan.wanted();
    let found = search(&ways, &wanted)?;
    if let Some(CandidateResult::Impossible { why }) =
        found.ways.first().map(|way| &way.fate).filter(|_| found.ways.iter().all(|way| way.price.is_none()))
    {
        return Err(format!("no combination of the choices is a valid design; the first is refused: {why}").into());
    }
    let front = plan.front().into_iter().map(|margin| {
        let _ = terminal::say(format_args!("with a margin of {:.0} %:", 100.0 * margin));
        let found = search(&ways, &Wanted { margin, ..wanted })?;
        Ok(Front {
            margin,
            cheapest: found.cheapest.map(|place| found.ways[place].clone()),
            out_of_budget: found.out_of_budget,
        })
    });
    let front = front.collect::<Result<Vec<Front>, String>>()?;
    let cheapest = found.cheapest.map(|place| &found.ways[place]);
    let mut extra = Vec::new();
    if let Some(way) = cheapest {
        let document = Document::parse(&site.text, "").map_err(|problem| problem.found)?;
        let head = format!(
            "# The cheapest of the study {}: {} with its choices put in. Files that it names are taken from its own folder.\n",
            plan.name,
            plan.design.display()
        );
        extra.push(ReportFile::new("cheapest.yaml", head + &choices.changes(way.number).text_of(&document)));
        // Beside it, where their names lead to a place below.
        let below = |name: &str| Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        let named = ways.read(way.number)?.attached.into_iter().filter(|(name, _)| below(name));
        extra.extend(named.map(|(name, bytes)| ReportFile::new(name, bytes)));
    }
    let passes = cheapest.is_some_and(|way| matches!(way.fate, CandidateResult::Passes { .. }));
    let sized = Sized {
        name: &plan.name,
        design: &plan.design,
        choices: &choices,
        prices: &prices,
        wanted,
        found: &found,
        front: &front,
    };
    let mut all =
        files(&sized, |number| ways.read(number).map(|file| file.design)).map_err(|error| error.to_string())?;
    all.extend(extra);
    put(&mut folder, &all)?;
    let code = if passes { ExitCode::Pass } else { ExitCode::Undecided };
    Ok((folder.path().join("size.html"), code))
}

impl Sizes<'_> {
    fn read(&self, number: usize) -> Result<DesignFile, String> {
        let open = |name: &str| {
            let mut attached = self.attached.lock().map_err(|_| "a file could not be read".to_string())?;
            attached.entry(name.to_string()).or_insert_with(|| input::beside(&self.site.path, name)).clone()
        };
        let changes = self.choices.changes(number);
        read_design_changed(self.purpose, &self.site.name, &self.site.text, &open, &changes).map_err(|problems| {
            let first = problems.list.first();
            let told =
                first.map(|problem| format!("{}: found {}, allowed {}", problem.path, problem.found, problem.allowed));
            told.unwrap_or_else(|| "it cannot be read".into())
        })
    }
}

fn fault(error: RunError) -> Fault {
    match error {
        RunError::Interrupted => Fault::OfAll(
            "the search was interrupted; what has been simulated is kept, and the study goes on there when it runs again".into(),
        ),
        error => Fault::OfTheWay(error.to_string()),
    }
}

impl Candidates for Sizes<'_> {
    fn count(&self) -> usize {
        self.choices.count().unwrap_or(0)
    }

    fn price(&self, number: usize) -> Result<f64, String> {
        self.read(number).map(|file| self.prices.of(&file.design))
    }

    fn by_equations(&self, number: usize) -> Result<Run, String> {
        self.read(number).map(by_equations)
    }

    fn simulated_once(&self, number: usize) -> Result<Run, Fault> {
        let file = self.read(number).map_err(Fault::OfTheWay)?;
        climb_by(file, 1, RungKind::Grains, &|design, starts| simulated(self.kept, design, starts)).map_err(fault)
    }

    fn confirmed(&self, number: usize, packings: u32) -> Result<Run, Fault> {
        let file = self.read(number).map_err(Fault::OfTheWay)?;
        confirm_by(file, packings, &|design, starts| simulated(self.kept, design, starts)).map_err(fault)
    }

    fn side_by_side<T: Send>(&self, numbers: &[usize], job: impl Fn(usize) -> T + Sync) -> Vec<T> {
        side_by_side(self.at_once(), numbers.len(), |index| job(numbers[index]))
    }

    fn at_once(&self) -> usize {
        rayon::current_num_threads()
    }

    fn tell(&self, way: &Candidate) {
        let options: Vec<&str> = self.choices.options(way.number).iter().map(|option| option.label.as_str()).collect();
        let price = way.price.map_or(String::new(), |price| format!("{price:.0} {}", self.prices.currency));
        let said = match &way.fate {
            CandidateResult::Passes { by, check, used } => format!("passes by {by}, {check} {:.0} %", 100.0 * used),
            CandidateResult::Fails { by, check, used } => format!("fails by {by}, {check} {:.0} %", 100.0 * used),
            CandidateResult::Undecided { by, why, .. } => format!("undecided by {by}, {why}"),
            CandidateResult::Impossible { .. } | CandidateResult::NotAsked => return,
        };
        let _ = terminal::say(format_args!("{:<40} {price:>14}  {said}", options.join(", ")));
    }
}
