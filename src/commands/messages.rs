//! What a command prints for a person or, with `--format json`, for an editor or a script: one JSON document on standard output.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use crate::commands::printed;
use crate::design::read::stem;
use crate::exports::Exports;
use crate::pipeline::Run;
use crate::problem::{Problem, Problems};
use crate::report::folder::Refusal;
use crate::report::view::View;
use crate::report::{drawing, vtk, workbook};
use crate::scene::estimate::Estimate;
use crate::terminal;

/// Version of this contract: fields may be added; it is raised when one changes or goes.
const SCHEMA_VERSION: u32 = 1;

/// How a command prints what it has to say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// Lines for a person
    #[default]
    Text,
    /// One JSON document: the problems of the design with their places, or the verdict
    Json,
}

/// The document that `--format json` prints.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MessagesFile {
    schema_version: u32,
    /// Name of the design: of its file, without folder and extension; `stdin` for standard input.
    design: String,
    /// All that is wrong with it; nothing was run unless this is empty.
    problems: Vec<ProblemPart>,
    /// pass, fail or undecided; null where nothing was run.
    verdict: Option<String>,
    /// Folder of the report; null where none was written.
    report: Option<String>,
    /// What the run would take; only with --dry-run.
    estimate: Option<EstimatePart>,
}

/// One thing that is wrong with a design.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProblemPart {
    /// Key path such as `barrier.flexible_net.height`; empty for the file as a whole.
    path: String,
    /// Counted from 1; null where the problem has no place in the file.
    line: Option<usize>,
    column: Option<usize>,
    found: String,
    allowed: String,
    hint: Option<String>,
}

/// What a run would take, within a factor of two.
#[derive(Debug, Serialize, JsonSchema)]
struct EstimatePart {
    grains: f64,
    steps: f64,
    /// How many simulations the run makes.
    simulations: usize,
    /// Of the event that is simulated.
    event_s: f64,
    /// Of all simulations together, on one core.
    time_s: f64,
    /// Of each simulation.
    memory_mb: f64,
}

impl From<&Problem> for ProblemPart {
    fn from(problem: &Problem) -> Self {
        Self {
            path: problem.path.clone(),
            line: problem.position.map(|position| position.line),
            column: problem.position.map(|position| position.column),
            found: problem.found.clone(),
            allowed: problem.allowed.clone(),
            hint: problem.hint.as_deref().map(String::from),
        }
    }
}

impl MessagesFile {
    fn of(design: impl Into<String>) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            design: design.into(),
            problems: Vec::new(),
            verdict: None,
            report: None,
            estimate: None,
        }
    }

    fn say(&self) {
        if let Ok(text) = serde_json::to_string_pretty(self) {
            terminal::say(text);
        }
    }
}

impl Format {
    /// All that is wrong with a design.
    pub fn tell_problems(self, problems: &Problems) {
        match self {
            Self::Text => {
                terminal::warn(problems.to_string().trim_end());
            }
            Self::Json => {
                let list = problems.list.iter().map(ProblemPart::from).collect();
                MessagesFile { problems: list, ..MessagesFile::of(stem(&problems.file)) }.say();
            }
        }
    }

    /// Why the report of a design, by its name, may not be written where it should be.
    pub fn tell_refusal(self, design: &str, refusal: &Refusal) {
        terminal::warn(format_args!("error: {refusal}"));
        if self == Self::Json {
            let problem = Problem::new(
                "",
                refusal.to_string(),
                "a folder that is new, empty, or of an earlier run of this design",
            );
            MessagesFile { problems: vec![ProblemPart::from(&problem)], ..MessagesFile::of(design) }.say();
        }
    }

    /// How a run ended, whose report was written into `folder`.
    pub fn tell_verdict(self, run: &Run, view: &View, folder: &Path, exports: Exports) {
        match self {
            Self::Text => summarise(view, folder, exports),
            Self::Json => MessagesFile {
                verdict: Some(run.verdict.word().to_string()),
                report: Some(folder.display().to_string()),
                ..MessagesFile::of(run.file.name.as_str())
            }
            .say(),
        }
    }

    /// What a run of `simulations` simulations would take, each with this estimate and `seconds` on one core; for a program only, a person is
    /// told in lines.
    pub fn tell_estimate(design: &str, estimate: &Estimate, simulations: usize, seconds: f64) {
        let part = EstimatePart {
            grains: estimate.grains,
            steps: estimate.steps,
            simulations,
            event_s: estimate.simulated,
            time_s: seconds * simulations as f64,
            memory_mb: estimate.bytes / 1e6,
        };
        MessagesFile { estimate: Some(part), ..MessagesFile::of(design) }.say();
    }
}

/// Verdict and checks for the terminal.
fn summarise(view: &View, folder: &Path, exports: Exports) {
    let say = |line: String| {
        let _ = terminal::say(line);
    };
    for check in &view.checks {
        let limit =
            if check.capacity.starts_with("at least") { format!(" ({})", check.capacity) } else { String::new() };
        let scaled = if check.scaled.is_empty() { String::new() } else { format!(" ({})", check.scaled) };
        say(format!("{:<5} {:>7}  {}{limit}{scaled}", check.verdict.to_uppercase(), check.utilisation, check.title));
    }
    say(format!("{}: {}", view.verdict.to_uppercase(), view.verdict_line));
    for more in [&view.margin, &view.why_enough] {
        if !more.is_empty() {
            say(format!("  {more}"));
        }
    }
    for doubt in &view.doubts {
        say(format!("  {doubt}"));
    }
    if !view.warnings.is_empty() {
        let ids: Vec<&str> = view.warnings.iter().map(|warning| warning.id).collect();
        say(format!("  points for the reviewer, told at the top of the report: {}", ids.join(", ")));
    }
    for reason in &view.open {
        say(format!("  open, because {}: {}", reason.why, reason.checks));
    }
    for (asked, name, file) in [
        (exports.vtk, "paraview", vtk::FOLDER),
        (exports.xlsx, "tables", workbook::FILE),
        (exports.dxf, "drawing", drawing::FILE),
        (exports.pdf, "pdf", printed::FILE),
    ] {
        // A browser may have failed to print.
        if asked && folder.join(file).exists() {
            say(format!("{name}: {}", folder.join(file).display()));
        }
    }
    say(format!("report: {}", folder.join("report.html").display()));
}
