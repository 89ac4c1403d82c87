//! The report of validation cases.

use serde::{Deserialize, Serialize};
use tera::{Context, Tera};

use crate::program::COMMIT;
use crate::report::folder::ReportFile;
use crate::validation::CASES;
use crate::validation::case::{Case, CaseRun, Finding, Wanted};

const HTML: &str = include_str!("../../templates/validation.html");
const DOCUMENT: &str = include_str!("../../templates/validation_document.md");
const MARKDOWN: &str = include_str!("../../templates/validation.md");

/// One case, ready to be shown.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub id: &'static str,
    pub suite: &'static str,
    pub title: &'static str,
    pub source: &'static str,
    pub tier: &'static str,
    pub weakness: &'static str,
    /// `pass` or `fail`.
    pub verdict: &'static str,
    pub time: String,
    pub findings: Vec<FindingRow>,
    /// Why there are no findings.
    pub broken: Option<String>,
}

#[derive(Clone, Debug, Serialize)]
pub struct FindingRow {
    pub what: String,
    pub measured: String,
    pub wanted: String,
    /// `ok`, `FAIL` or `told`.
    pub verdict: &'static str,
    /// The measured value over what is wanted, as a picture; empty where nothing is.
    pub overlay: String,
}

impl Row {
    pub fn passed(&self) -> bool {
        self.verdict == "pass"
    }

    pub fn of(ran: &CaseRun) -> Self {
        let case = ran.case;
        Self {
            id: case.id,
            suite: case.suite.word(),
            title: case.title,
            source: case.source,
            tier: case.tier.word(),
            weakness: case.weakness,
            verdict: if ran.passed() { "pass" } else { "fail" },
            time: format!("{:.1} s", ran.time.as_secs_f64()),
            findings: ran.outcome.iter().flatten().map(FindingRow::of).collect(),
            broken: ran.outcome.as_ref().err().map(ToString::to_string),
        }
    }
}

impl FindingRow {
    fn of(finding: &Finding) -> Self {
        let wanted = match finding.wanted {
            Wanted::Near { value, tolerance } => format!("{} ± {}", number(value), number(tolerance)),
            Wanted::Between { low, high } => format!("{} to {}", number(low), number(high)),
            Wanted::Nothing => "not judged".to_string(),
        };
        let verdict = match (finding.wanted, finding.holds()) {
            (Wanted::Nothing, true) => "told",
            (_, true) => "ok",
            (_, false) => "FAIL",
        };
        let overlay = match finding.wanted {
            Wanted::Near { value, tolerance } => overlay((finding.measured - value) / tolerance, true),
            Wanted::Between { low, high } => overlay((2.0 * finding.measured - low - high) / (high - low), false),
            Wanted::Nothing => String::new(),
        };
        Self { what: finding.what.clone(), measured: number(finding.measured), wanted, verdict, overlay }
    }
}

/// A strip with what is wanted as a band from −1 to 1, the expected value as a line where there is one, and ours as a dot; what
/// is further off than the strip is long sits at its end.
fn overlay(place: f64, expected: bool) -> String {
    const END: f64 = 2.0;
    const WIDTH: f64 = 120.0;
    let x = |place: f64| 0.5 * WIDTH * (1.0 + place.clamp(-END, END) / (END + 0.2));
    let line = if expected {
        format!(r#"<line class="expected" x1="{0:.1}" x2="{0:.1}" y1="1" y2="13"/>"#, x(0.0))
    } else {
        String::new()
    };
    let class = if (-1.0..=1.0).contains(&place) { "ok" } else { "FAIL" };
    format!(
        r#"<svg class="overlay" viewBox="0 0 {WIDTH} 14" role="img" aria-label="{place:.2} of the tolerance off"><rect class="band" x="{:.1}" y="2" width="{:.1}" height="10"/>{line}<circle class="{class}" cx="{:.1}" cy="7" r="3.4"/></svg>"#,
        x(-1.0),
        x(1.0) - x(-1.0),
        x(if place.is_nan() { END } else { place }),
    )
}

/// Four significant digits.
fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_string()
    } else if (1e-3..1e5).contains(&size) {
        let digits = (3 - libm::log10(size).floor() as i32).max(0) as usize;
        format!("{value:.digits$}")
    } else {
        format!("{value:.3e}")
    }
}

/// What is known of every case, as it is kept with the program.
#[derive(Debug, Serialize, Deserialize)]
pub struct Kept {
    pub cases: Vec<KeptCase>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct KeptCase {
    pub id: String,
    pub title: String,
    pub held: bool,
    /// Of the program with which it ran last.
    pub commit: String,
}

impl Kept {
    /// Of this version: a copy of the `outcome.json` that `barrier-check validate` writes.
    pub fn of_this_version() -> Option<Self> {
        serde_json::from_str(include_str!("../../templates/validation_outcome.json")).ok()
    }

    /// What has been kept, with the cases that have just run in place of what they came to before. A case that now has another title is another
    /// case.
    fn with(rows: &[Row]) -> Self {
        let before = Self::of_this_version().map_or_else(Vec::new, |kept| kept.cases);
        let known = |case: &&Case| {
            let ran = rows.iter().find(|row| row.id == case.id);
            let ran = ran.map(|row| KeptCase {
                id: row.id.to_string(),
                title: row.title.to_string(),
                held: row.passed(),
                commit: COMMIT.to_string(),
            });
            ran.or_else(|| before.iter().find(|kept| kept.id == case.id && kept.title == case.title).cloned())
        };
        Self { cases: CASES.iter().filter_map(known).collect() }
    }

    /// With which versions the cases ran last, and how many with each, the first of them first.
    pub fn commits(&self) -> Vec<(&str, usize)> {
        let mut commits: Vec<(&str, usize)> = Vec::new();
        for case in &self.cases {
            match commits.iter_mut().find(|(commit, _)| *commit == case.commit) {
                Some((_, count)) => *count += 1,
                None => commits.push((&case.commit, 1)),
            }
        }
        commits
    }

    /// Cases that this version has and that have not run.
    pub fn not_run(&self) -> usize {
        let ran = |case: &&&Case| self.cases.iter().any(|kept| kept.id == case.id && kept.title == case.title);
        CASES.len() - CASES.iter().filter(ran).count()
    }
}

/// The page of the documentation on validation: every case with its reference, and what it came to when all of them ran last.
pub fn document() -> Result<String, tera::Error> {
    let kept = Kept::of_this_version();
    let result = |case: &Case| {
        let found = kept.iter().flat_map(|kept| &kept.cases).find(|kept| kept.id == case.id);
        let found = found.filter(|kept| kept.title == case.title);
        let commit = found.map_or_else(String::new, |kept| kept.commit.clone());
        (found.map_or("not run yet", |kept| if kept.held { "passes" } else { "does not pass" }), commit)
    };
    let row = |case: &&Case| DocumentRow {
        id: case.id,
        suite: case.suite.word(),
        title: case.title,
        source: case.source,
        tier: case.tier.word(),
        weakness: case.weakness,
        result: result(case).0,
        commit: result(case).1,
    };
    let rows: Vec<DocumentRow> = CASES.iter().map(row).collect();
    let count = |result: &str| rows.iter().filter(|row| row.result == result).count();
    let mut context = Context::new();
    context.insert("passed", &count("passes"));
    context.insert("ran", &(rows.len() - count("not run yet")));
    context.insert("later", &count("not run yet"));
    context.insert("cases", &rows);
    Tera::one_off(DOCUMENT, &context, false)
}

#[derive(Debug, Serialize)]
struct DocumentRow {
    id: &'static str,
    suite: &'static str,
    title: &'static str,
    source: &'static str,
    tier: &'static str,
    weakness: &'static str,
    result: &'static str,
    /// With which it ran last; empty where it did not.
    commit: String,
}

/// How many cases hold; of all that were `asked` for some may not have run.
pub fn verdict_line(rows: &[Row], asked: usize) -> String {
    let passed = rows.iter().filter(|row| row.passed()).count();
    match asked.saturating_sub(rows.len()) {
        0 => format!("{passed} of {} cases hold", rows.len()),
        missing => format!("{passed} of {} cases hold; {missing} more have not run", rows.len()),
    }
}

/// The report as HTML and as Markdown.
pub fn render(rows: &[Row], asked: usize) -> Result<Vec<ReportFile>, tera::Error> {
    let mut tera = Tera::default();
    tera.add_raw_templates(vec![("validation.html", HTML), ("validation.md", MARKDOWN)])?;
    let mut context = Context::new();
    context.insert("cases", rows);
    context.insert("verdict_line", &verdict_line(rows, asked));
    context.insert("version", env!("CARGO_PKG_VERSION"));
    context.insert("commit", COMMIT);
    let file = |name| tera.render(name, &context).map(|text| ReportFile::new(name, text));
    let kept = serde_json::to_string_pretty(&Kept::with(rows)).unwrap_or_default() + "\n";
    Ok(vec![file("validation.html")?, file("validation.md")?, ReportFile::new("outcome.json", kept)])
}
