//! The page of a study that runs designs with other values of some keys, and its tables for programs.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::Serialize;

use crate::program::PROGRAM;
use crate::report::chart::Chart;
use crate::report::columns::{Column, csv, parquet};
use crate::report::folder::ReportFile;
use crate::report::numbers::{percent, with_unit};
use crate::report::plots::line_chart::{Level, LineChart, Series};
use crate::report::render::{Rendered, render_as};
use crate::studies::amount::Amount;
use crate::studies::choices::Choices;
use crate::studies::sweep::RunRecord;
use crate::studies::sweep_plan::SweepPlan;

const HTML: &str = include_str!("../../templates/sweep.html");
const MARKDOWN: &str = include_str!("../../templates/sweep.md");

/// Rows that the page shows; all are in the tables for programs.
const MOST_SHOWN: usize = 200;

/// What the page tells of.
pub struct Swept<'a> {
    pub plan: &'a SweepPlan,
    pub choices: &'a Choices,
    /// Runs of one design.
    pub ways: usize,
    /// Design by design; nothing where a run has not been made.
    pub runs: &'a [Option<RunRecord>],
    /// The name of a run.
    pub id: &'a dyn Fn(usize) -> String,
}

#[derive(Serialize)]
struct Page {
    name: String,
    designs: Vec<String>,
    result: String,
    keys: Vec<String>,
    rows: Vec<RowOfARun>,
    left_out: usize,
    charts: Vec<Chart>,
    work: String,
}

#[derive(Serialize)]
struct RowOfARun {
    design: String,
    options: Vec<String>,
    verdict: String,
    /// `pass`, `fail`, `open` or empty.
    class: &'static str,
    used: String,
    governing: String,
    force: String,
    why: String,
}

/// Page, charts, and tables.
pub fn files(swept: &Swept) -> Result<Vec<ReportFile>, Box<dyn std::error::Error>> {
    let keys = 0..swept.choices.0.len();
    let charts: Vec<Chart> =
        keys.flat_map(|key| SHOWN.iter().filter_map(move |shown| chart(swept, key, shown))).collect();
    let page = Page {
        name: swept.plan.name.clone(),
        designs: (0..swept.plan.designs.len()).map(|design| name_of(swept, design)).collect(),
        result: result(swept),
        keys: swept.choices.0.iter().map(|choice| choice.name.replace(['.', '_'], " ")).collect(),
        rows: (0..swept.runs.len().min(MOST_SHOWN)).map(|run| row(swept, run)).collect(),
        left_out: swept.runs.len().saturating_sub(MOST_SHOWN),
        charts,
        work: work(swept),
    };
    let Rendered { html, markdown } = render_as("sweep", &page, [HTML, MARKDOWN])?;
    let table = table(swept);
    let mut files = vec![
        ReportFile::new("sweep.html", html),
        ReportFile::new("sweep.md", markdown),
        ReportFile::new("sweep.csv", csv(&table)),
        ReportFile::new("sweep.parquet", parquet("sweep", &table)?),
        ReportFile::new("runs.csv", csv(&where_they_ran(swept))),
        ReportFile::new("sweep.json", serde_json::to_string_pretty(&json(swept))? + "\n"),
    ];
    files.extend(page.charts.iter().map(|chart| ReportFile::new(&chart.file, chart.alone())));
    Ok(files)
}

fn name_of(swept: &Swept, design: usize) -> String {
    swept.plan.designs[design].file_stem().map_or(String::new(), |name| name.to_string_lossy().into_owned())
}

fn labels(swept: &Swept, run: usize) -> Vec<String> {
    swept.plan.options(swept.choices, run % swept.ways).iter().map(|option| option.label.clone()).collect()
}

fn result(swept: &Swept) -> String {
    let count = |verdict: &str| swept.runs.iter().flatten().filter(|ran| ran.verdict == verdict).count();
    let made = swept.runs.iter().flatten().count();
    let mut told = format!(
        "{made} of {} runs have been made. Pass: {}; fail: {}; undecided: {}.",
        swept.runs.len(),
        count("pass"),
        count("fail"),
        count("undecided")
    );
    for (verdict, words) in [("invalid", "Not valid as designs"), ("not simulated", "Not simulated")] {
        if count(verdict) > 0 {
            told += &format!(" {words}: {}.", count(verdict));
        }
    }
    told
}

fn row(swept: &Swept, run: usize) -> RowOfARun {
    let nothing = RunRecord::nothing("not made", String::new());
    let ran = swept.runs[run].as_ref().unwrap_or(&nothing);
    let force = measured(ran, PEAK).or(ran.guideline_force);
    RowOfARun {
        design: name_of(swept, run / swept.ways),
        options: labels(swept, run),
        verdict: ran.verdict.clone(),
        class: match ran.verdict.as_str() {
            "pass" => "pass",
            "fail" => "fail",
            "undecided" => "open",
            _ => "",
        },
        used: ran.used.map_or("–".into(), |used| percent(Some(used))),
        governing: ran.governing.clone(),
        force: force.map_or("–".into(), |force| with_unit(force, "N")),
        why: if ran.verdict == "pass" || ran.verdict == "fail" { String::new() } else { ran.why.clone() },
    }
}

/// The largest force by the simulation, among what is measured.
const PEAK: &str = "force_total_peak_n";

fn measured(ran: &RunRecord, name: &str) -> Option<f64> {
    ran.measured.iter().find(|(known, _)| known == name).map(|(_, value)| *value)
}

/// Numbers of the options of a choice, where all have one unit.
fn numbers(swept: &Swept, key: usize) -> Option<(Vec<f64>, String)> {
    let amounts: Option<Vec<Amount>> =
        swept.choices.0[key].options.iter().map(|option| Amount::parse(&option.label)).collect();
    let amounts = amounts.filter(|amounts| amounts.len() > 1)?;
    let unit = amounts[0].unit.clone();
    let alike = amounts.iter().all(|amount| amount.unit == unit);
    let values: Vec<f64> = amounts.into_iter().map(|amount| amount.value).collect();
    let rising = values.windows(2).all(|pair| pair[0] < pair[1]);
    (alike && rising).then_some((values, unit))
}

/// What a chart shows of a run.
struct Shown {
    title: &'static str,
    /// Of the first keys; more charts are not drawn.
    titles: [&'static str; 4],
    unit: &'static str,
    factor: f64,
    limit: Option<f64>,
    of: fn(&RunRecord) -> Option<f64>,
    note: &'static str,
}

const SHOWN: [Shown; 2] = [
    Shown {
        title: "Largest utilisation",
        titles: ["Utilisation, key 1", "Utilisation, key 2", "Utilisation, key 3", "Utilisation, key 4"],
        unit: "%",
        factor: 100.0,
        limit: Some(1.0),
        of: |ran| ran.used_in_the_event,
        note: "Largest utilisation of the checks that hang on the event",
    },
    Shown {
        title: "Largest force",
        titles: ["Force, key 1", "Force, key 2", "Force, key 3", "Force, key 4"],
        unit: "kN",
        factor: 1e-3,
        limit: None,
        of: |ran| measured(ran, PEAK).or(ran.guideline_force),
        note: "Largest force on the barrier",
    },
];

/// What runs show along one key, a line for each design: the mean over all values of the other keys.
fn chart(swept: &Swept, key: usize, shown: &Shown) -> Option<Chart> {
    let (values, unit) = numbers(swept, key)?;
    let choice = &swept.choices.0[key];
    let of_design = |design: usize| -> Option<Vec<f64>> {
        let at = |option: usize| {
            let label = &choice.options[option].label;
            let runs =
                (design * swept.ways..(design + 1) * swept.ways).filter(|run| labels(swept, *run)[key] == *label);
            let known: Vec<f64> = runs.filter_map(|run| (shown.of)(swept.runs[run].as_ref()?)).collect();
            let known: Vec<f64> = known.into_iter().filter(|value| value.is_finite()).collect();
            (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
        };
        (0..values.len()).map(at).collect()
    };
    let designs = 0..swept.plan.designs.len().min(MOST_LINES);
    let lines: Vec<(usize, Vec<f64>)> = designs.filter_map(|design| Some((design, of_design(design)?))).collect();
    if lines.is_empty() {
        return None;
    }
    let series = lines
        .iter()
        .map(|(design, values)| Series { label: name_of(swept, *design), values, colour: design % MOST_LINES })
        .collect();
    let along = format!("{} ({unit})", choice.name.rsplit('.').next().unwrap_or("").replace('_', " "));
    let drawn = LineChart {
        title: shown.title,
        unit: shown.unit,
        factor: shown.factor,
        along: &along,
        time: &values,
        series,
        levels: shown.limit.map(|value| Level { label: "limit".into(), value }).into_iter().collect(),
        band: None,
    };
    let others = if swept.choices.0.len() > 1 { ", the mean over the values of the other keys" } else { "" };
    let note = format!("{} along {}{others}; one line for each design.", shown.note, choice.name);
    Some(Chart::of(shown.titles.get(key)?, drawn.svg(), note))
}

/// Designs that a chart can tell apart.
const MOST_LINES: usize = 6;

/// A name that CSV and Parquet take.
fn column_name(text: &str) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' };
    let name: String = text.chars().map(letter).collect();
    if name.starts_with(|first: char| first.is_ascii_digit()) { format!("_{name}") } else { name }
}

/// One row for each run: what was chosen and what came of it, the same wherever it ran.
fn table(swept: &Swept) -> Vec<(String, Column)> {
    let runs = 0..swept.runs.len();
    let texts = |of: &dyn Fn(usize) -> String| Column::Texts(runs.clone().map(of).collect());
    let known = |of: &dyn Fn(&RunRecord) -> Option<f64>| {
        Column::Known(swept.runs.iter().map(|ran| ran.as_ref().and_then(of)).collect())
    };
    let told = |of: fn(&RunRecord) -> &String| {
        texts(&|run| swept.runs[run].as_ref().map_or(String::new(), |ran| of(ran).clone()))
    };
    let mut table = vec![("design".to_string(), texts(&|run| name_of(swept, run / swept.ways)))];
    for (key, choice) in swept.choices.0.iter().enumerate() {
        table.push((column_name(&choice.name), texts(&|run| labels(swept, run)[key].clone())));
    }
    table.push((
        "verdict".into(),
        texts(&|run| swept.runs[run].as_ref().map_or("not made".into(), |ran| ran.verdict.clone())),
    ));
    table.push(("governing".into(), told(|ran| &ran.governing)));
    table.push(("largest_utilisation".into(), known(&|ran| ran.used)));
    table.push(("guideline_force_n".into(), known(&|ran| ran.guideline_force)));
    let mut add = |names: BTreeSet<&str>, prefix: &str, of: &dyn Fn(&RunRecord, &str) -> Option<f64>| {
        for name in names {
            table.push((column_name(&format!("{prefix}{name}")), known(&|ran| of(ran, name))));
        }
    };
    let all = || swept.runs.iter().flatten();
    let checks = all().flat_map(|ran| ran.checks.iter().map(|check| check.id.as_str())).collect();
    add(checks, "used_", &|ran, name| ran.checks.iter().find(|check| check.id == name)?.used);
    let quantities = all().flat_map(|ran| ran.measured.iter().map(|(name, _)| name.as_str())).collect();
    add(quantities, "", &measured);
    table.push(("why".into(), told(|ran| &ran.why)));
    table
}

/// Where runs were made and how long they took: what differs between engines and machines.
fn where_they_ran(swept: &Swept) -> Vec<(String, Column)> {
    let known = |of: &dyn Fn(&RunRecord) -> Option<f64>| {
        Column::Known(swept.runs.iter().map(|ran| ran.as_ref().and_then(of)).collect())
    };
    let instructions = swept.runs.iter().map(|ran| ran.as_ref().map_or(String::new(), |ran| ran.instructions.clone()));
    vec![
        ("run".into(), Column::Texts((0..swept.runs.len()).map(swept.id).collect())),
        ("wall_clock_s".into(), known(&|ran| Some(ran.took))),
        ("instructions".into(), Column::Texts(instructions.collect())),
    ]
}

fn work(swept: &Swept) -> String {
    let took: f64 = swept.runs.iter().flatten().map(|ran| ran.took).sum();
    let used: BTreeSet<&str> = swept.runs.iter().flatten().map(|ran| ran.instructions.as_str()).collect();
    let used: Vec<&str> = used.into_iter().filter(|name| !name.is_empty()).collect();
    format!(
        "The runs took {took:.1} s of one core each in all; vector instructions: {}. Each is kept by what it hangs on (program, design, values, files), and its result does not depend on where it was made; runs.csv tells of each.",
        if used.is_empty() { "none".into() } else { used.join(", ") }
    )
}

/// `sweep.json`: the contract that other programs script against. Fields may be added, never renamed.
#[derive(Serialize, JsonSchema)]
pub struct SweepFile {
    schema_version: u32,
    name: String,
    /// Names of what is varied, in the order of each run's `values`.
    keys: Vec<String>,
    runs: Vec<RunPart>,
    /// The program that made this file, with version and commit.
    program: String,
}

#[derive(Serialize, JsonSchema)]
struct RunPart {
    run: String,
    design: String,
    values: Vec<String>,
    /// pass, fail, undecided, invalid, not simulated or not made
    verdict: String,
    why: String,
    governing: String,
    largest_utilisation: Option<f64>,
    guideline_force_n: Option<f64>,
    checks: Vec<CheckPart>,
    /// Quantities of the run as a whole, by name with the unit; means over the packings.
    measured: std::collections::BTreeMap<String, f64>,
}

#[derive(Serialize, JsonSchema)]
struct CheckPart {
    id: String,
    utilisation: Option<f64>,
    verdict: String,
}

fn json(swept: &Swept) -> SweepFile {
    let nothing = RunRecord::nothing("not made", String::new());
    let part = |run: usize| {
        let ran = swept.runs[run].as_ref().unwrap_or(&nothing);
        let check = |check: &crate::studies::sweep::CheckRan| CheckPart {
            id: check.id.clone(),
            utilisation: check.used,
            verdict: check.verdict.clone(),
        };
        RunPart {
            run: (swept.id)(run),
            design: name_of(swept, run / swept.ways),
            values: labels(swept, run),
            verdict: ran.verdict.clone(),
            why: ran.why.clone(),
            governing: ran.governing.clone(),
            largest_utilisation: ran.used,
            guideline_force_n: ran.guideline_force,
            checks: ran.checks.iter().map(check).collect(),
            measured: ran.measured.iter().cloned().collect(),
        }
    };
    SweepFile {
        schema_version: 1,
        name: swept.plan.name.clone(),
        keys: swept.choices.0.iter().map(|choice| choice.name.clone()).collect(),
        runs: (0..swept.runs.len()).map(part).collect(),
        program: PROGRAM.into(),
    }
}
