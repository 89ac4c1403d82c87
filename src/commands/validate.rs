//! `barrier-check validate`: runs validation cases, prints them as a table and writes a report.

use std::path::Path;

use crate::commands::ExitCode;
use crate::commands::output::{put, tell_of_replaced};
use crate::report::folder::Folder;
use crate::report::kind::Kind;
use crate::report::validation::{Row, render, verdict_line};
use crate::terminal;
use crate::validation::CASES;
use crate::validation::case::{Case, CaseRun, Cost, Suite};

/// Which cases to run.
pub struct Selection<'a> {
    /// Suites and ids; empty for all.
    pub names: &'a [String],
    pub quick_only: bool,
}

impl Selection<'_> {
    /// The cases selected, or the names that select nothing.
    pub fn cases(&self) -> Result<Vec<&'static Case>, Vec<String>> {
        let named = |case: &Case, name: &str| {
            name.eq_ignore_ascii_case(case.id) || name.eq_ignore_ascii_case(case.suite.word())
        };
        let unknown: Vec<String> =
            self.names.iter().filter(|name| !CASES.iter().any(|case| named(case, name))).cloned().collect();
        if !unknown.is_empty() {
            return Err(unknown);
        }
        let wanted = |case: &Case| self.names.is_empty() || self.names.iter().any(|name| named(case, name));
        Ok(CASES
            .iter()
            .copied()
            .filter(|case| wanted(case) && (!self.quick_only || case.cost == Cost::Quick))
            .collect())
    }
}

/// Runs the selected cases and writes their report to `folder`.
pub fn validate(selection: &Selection, folder: &Path) -> ExitCode {
    let cases = match selection.cases() {
        Ok(cases) => cases,
        Err(unknown) => {
            let suites = Suite::ALL.map(Suite::word).join(", ");
            let ids: Vec<&str> = CASES.iter().map(|case| case.id).collect();
            terminal::warn(format_args!("error: no such suite or case: {}", unknown.join(", ")));
            terminal::warn(format_args!("suites: {suites}; cases: {}", ids.join(", ")));
            return ExitCode::Undecided;
        }
    };
    if cases.is_empty() {
        terminal::warn(format_args!("error: --quick leaves nothing of {}; run without it", selection.names.join(", ")));
        return ExitCode::Undecided;
    }
    let mut folder = match Folder::claim_for(folder, Kind::Validation) {
        Ok(folder) => folder,
        Err(refusal) => {
            terminal::warn(format_args!("error: {refusal}"));
            return ExitCode::Undecided;
        }
    };
    tell_of_replaced(&folder, Kind::Validation);
    let asked = cases.len();
    let mut rows = Vec::new();
    let mut written = Ok(());
    for case in cases {
        let row = Row::of(&CaseRun::of(case));
        tell(&row);
        rows.push(row);
        // After each, so that one that is cut short keeps those that have run.
        written = render(&rows, asked)
            .map_err(|error| error.to_string())
            .and_then(|files| put(&mut folder, &files).map_err(|error| error.to_string()));
    }
    terminal::say(verdict_line(&rows, asked));
    let folder = folder.path();
    if let Err(error) = written {
        terminal::warn(format_args!("error: the report could not be written to {}: {error}", folder.display()));
        return ExitCode::Undecided;
    }
    terminal::say(format_args!("report: {}", folder.join("validation.html").display()));
    if rows.iter().all(Row::passed) { ExitCode::Pass } else { ExitCode::Fail }
}

/// One line for the case, and one for each finding.
fn tell(row: &Row) {
    let head = format!("{:<4} {:<4} {} ({}, {})", row.verdict.to_uppercase(), row.id, row.title, row.tier, row.time);
    let findings = row.findings.iter().map(|finding| {
        format!("     {:<4} {:<52} {:>12}   {}", finding.verdict, finding.what, finding.measured, finding.wanted)
    });
    let broken = row.broken.iter().map(|broken| format!("     {broken}"));
    for line in std::iter::once(head).chain(findings).chain(broken) {
        terminal::say(line);
    }
}
