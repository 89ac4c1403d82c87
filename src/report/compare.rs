//! Several designs on one page: what they differ in, and what comes of it.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::checks::outcome::Outcome;
use crate::pipeline::Run;
use crate::quantities::quantity::Unit;
use crate::quantities::total_force;
use crate::report::chart::Chart;
use crate::report::folder::ReportFile;
use crate::report::numbers::{with_scatter, with_unit};
use crate::report::plots::line_chart::{LineChart, Series, TIME, resampled};
use crate::report::render::{Rendered, render_as};
use crate::report::row::{is_share, used};
use crate::report::spreads::{Observable, over_packings};
use crate::report::view::summary;
use crate::scene::build::SAMPLES_PER_WINDOW;
use crate::simulated::Simulated;
use crate::starts::Spread;
use dem::recorders::histories::smoothed;

const HTML: &str = include_str!("../../templates/compare.html");
const MARKDOWN: &str = include_str!("../../templates/compare.md");

/// Change of a single start, over the first design's value, below which it is not marked: two packings of one design differ by
/// as much.
const UNTOLD: f64 = 0.1;
/// Standard deviations of the difference beyond which it is marked, where every design has several starts.
const CLEAR: f64 = 2.0;
/// Moments in a chart.
const MOMENTS: usize = 800;

/// One design of the comparison.
pub struct Variant {
    /// Name of the folder of its own report.
    pub folder: String,
    pub run: Run,
}

#[derive(Debug, Serialize)]
struct Page {
    variants: Vec<Head>,
    checks: Vec<Line>,
    observed: Vec<Line>,
    inputs: Vec<Line>,
    charts: Vec<Chart>,
    /// When a difference is marked.
    marking: String,
}

#[derive(Debug, Serialize)]
struct Head {
    letter: String,
    name: String,
    title: String,
    /// Its folder as a link writes it.
    link: String,
    verdict: &'static str,
    verdict_line: String,
    sha256: String,
}

/// A row: what it is of, and a cell for each design.
#[derive(Debug, Serialize)]
struct Line {
    title: String,
    cells: Vec<Cell>,
}

#[derive(Clone, Debug, Default, Serialize)]
struct Cell {
    text: String,
    /// Class of the style sheet; empty for plain.
    class: &'static str,
    /// How it differs from the first design, where that is worth a mark.
    change: String,
    /// Whether a verdict differs from that of the first design.
    marked: bool,
}

/// The page as files. `variants` holds two at least.
pub fn files(variants: &[Variant]) -> Result<Vec<ReportFile>, tera::Error> {
    let page = Page {
        variants: variants.iter().zip(letters()).map(|(variant, letter)| head(variant, letter)).collect(),
        checks: check_lines(variants),
        observed: observed_lines(variants),
        inputs: input_lines(variants),
        charts: charts(variants),
        marking: marking(variants),
    };
    let Rendered { html, markdown } = render_as("page", &page, [HTML, MARKDOWN])?;
    let mut files = vec![ReportFile::new("compare.html", html), ReportFile::new("compare.md", markdown)];
    files.extend(page.charts.iter().map(|chart| ReportFile::new(&chart.file, chart.alone())));
    Ok(files)
}

fn head(variant: &Variant, letter: String) -> Head {
    let project = &variant.run.file.design.project;
    Head {
        letter,
        name: variant.run.file.name.clone(),
        title: match &variant.run.simulated {
            Some(_) => format!("{}: {}", project.name, project.barrier),
            None => format!("{}: {} (equations alone)", project.name, project.barrier),
        },
        link: in_a_link(&variant.folder),
        verdict: variant.run.verdict.word(),
        verdict_line: summary(&variant.run),
        sha256: variant.run.file.sha256.clone(),
    }
}

/// Files of the page whatever is compared.
pub const PAGE_FILES: [&str; 4] = ["compare.html", "compare.md", FORCE_CHART, MASS_CHART];
const FORCE_CHART: &str = "force.svg";
const MASS_CHART: &str = "retained_mass.svg";

/// What the variants are called: A to Z, then AA and so on, as the columns of a table of numbers are.
fn letters() -> impl Iterator<Item = String> {
    let word = |mut number: usize| {
        let mut word = Vec::new();
        while number > 0 {
            number -= 1;
            word.push((b'A' + (number % 26) as u8) as char);
            number /= 26;
        }
        word.iter().rev().collect()
    };
    (1..).map(word)
}

/// A name within a relative link (RFC 3986): all but letters, digits and four marks as bytes in hexadecimal digits.
fn in_a_link(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~".contains(&byte);
    name.bytes().map(|byte| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") }).collect()
}

/// Ids of all variants in the order in which they first come up.
fn all_ids(ids: impl Iterator<Item = String>) -> Vec<String> {
    let mut seen = BTreeSet::new();
    ids.filter(|id| seen.insert(id.clone())).collect()
}

fn check_lines(variants: &[Variant]) -> Vec<Line> {
    let ids =
        all_ids(variants.iter().flat_map(|variant| variant.run.outcomes.iter().map(|outcome| outcome.id.clone())));
    let line = |id: String| {
        let found = |variant: &Variant| variant.run.outcomes.iter().find(|outcome| outcome.id == id).cloned();
        let outcomes: Vec<Option<Outcome>> = variants.iter().map(found).collect();
        let title = outcomes.iter().flatten().next().map_or(String::new(), |outcome| outcome.title.clone());
        let mut cells: Vec<Cell> = outcomes.iter().map(check_cell).collect();
        let first = cells[0].class;
        cells
            .iter_mut()
            .for_each(|cell| cell.marked = !first.is_empty() && !cell.class.is_empty() && cell.class != first);
        Line { title, cells }
    };
    ids.into_iter().map(line).collect()
}

fn check_cell(outcome: &Option<Outcome>) -> Cell {
    let Some(outcome) = outcome else { return Cell { text: "–".into(), ..Cell::default() } };
    // A least share is judged by the simulation alone, all else by the larger of both.
    let (demand, by) = match outcome.resistance {
        Some(_) if outcome.governed_by_equations() => (outcome.demand.largest(), ", guideline"),
        Some(_) => (outcome.demand.largest(), ", simulation"),
        None => (outcome.demand.simulation.or(outcome.demand.guideline), ""),
    };
    let text = demand.map_or(String::new(), |demand| with_unit(demand, outcome.unit.symbol()) + by);
    let change = if is_share(outcome) { String::new() } else { used(outcome) };
    Cell { text, class: outcome.verdict.word(), change, marked: false }
}

fn observed_lines(variants: &[Variant]) -> Vec<Line> {
    type Told = Vec<(Observable, Spread)>;
    let told = |variant: &Variant| variant.run.simulated.as_ref().map_or_else(Vec::new, over_packings);
    let told: Vec<Told> = variants.iter().map(told).collect();
    let ids = all_ids(told.iter().flatten().map(|(observable, _)| observable.id.clone()));
    let line = |id: String| {
        let found: Vec<_> = told.iter().map(|told| told.iter().find(|(observable, _)| observable.id == id)).collect();
        let (title, unit) = found
            .iter()
            .flatten()
            .next()
            .map_or((String::new(), Unit::Number), |(observable, _)| (observable.title.clone(), observable.unit));
        let first = found[0].map(|(_, spread)| *spread);
        let cell = |found: &Option<&(_, Spread)>| match found {
            None => Cell { text: "–".into(), ..Cell::default() },
            Some((_, spread)) => observed_cell(*spread, first, unit),
        };
        Line { title, cells: found.iter().map(cell).collect() }
    };
    ids.into_iter().map(line).collect()
}

fn observed_cell(spread: Spread, first: Option<Spread>, unit: Unit) -> Cell {
    let text = match spread.starts {
        1 => with_unit(spread.mean, unit.symbol()),
        _ => with_scatter(spread.mean, spread.deviation, unit.symbol()),
    };
    let change = first.filter(|first| differs(&spread, first)).map_or(String::new(), |first| match unit {
        Unit::Share => format!("{:+.1} points", 100.0 * (spread.mean - first.mean)),
        _ => format!("{:+.0} %", 100.0 * (spread.mean / first.mean - 1.0)),
    });
    Cell { text, class: if change.is_empty() { "" } else { "differs" }, change, marked: false }
}

/// Whether a difference is more than scatter may make.
fn differs(one: &Spread, other: &Spread) -> bool {
    let difference = (one.mean - other.mean).abs();
    if one.starts > 1 && other.starts > 1 {
        return difference > CLEAR * libm::hypot(one.deviation, other.deviation);
    }
    difference > UNTOLD * other.mean.abs()
}

fn marking(variants: &[Variant]) -> String {
    let several = variants
        .iter()
        .all(|variant| variant.run.simulated.as_ref().is_some_and(|simulated| simulated.starts.len() > 1));
    match several {
        true => format!(
            "Marked: differs from the first design by more than {CLEAR:.0} standard deviations of the difference."
        ),
        false => format!(
            "Marked: differs from the first design by more than {:.0} %. These are single runs; --seeds shows how far runs of one design differ.",
            100.0 * UNTOLD
        ),
    }
}

/// Inputs that are not the same in all designs.
fn input_lines(variants: &[Variant]) -> Vec<Line> {
    let entries = |variant: &Variant| variant.run.file.entries.order.clone();
    let paths = all_ids(variants.iter().flat_map(entries));
    let typed = |variant: &Variant, path: &String| {
        variant.run.file.entries.values.get(path).map_or("–".to_string(), |entry| entry.typed.clone())
    };
    let line = |path: String| {
        let values: Vec<String> = variants.iter().map(|variant| typed(variant, &path)).collect();
        let same = values.iter().all(|value| *value == values[0]);
        let cell = |value: String| Cell {
            class: if value == values[0] { "" } else { "differs" },
            text: value,
            ..Cell::default()
        };
        let cells = values.iter().cloned().map(cell).collect();
        (!same && !path.starts_with("project.")).then_some(Line { title: path, cells })
    };
    paths.into_iter().filter_map(line).collect()
}

fn charts(variants: &[Variant]) -> Vec<Chart> {
    let seen: Vec<(String, &Simulated)> = letters()
        .zip(variants)
        .filter_map(|(letter, variant)| Some((letter, variant.run.simulated.as_ref()?)))
        .collect();
    let last = seen.iter().filter_map(|(_, seen)| seen.histories.time.last()).copied().fold(0.0, f64::max);
    if last == 0.0 {
        return Vec::new();
    }
    let time: Vec<f64> = (0..=MOMENTS).map(|moment| last * moment as f64 / MOMENTS as f64).collect();
    let force = |seen: &Simulated| {
        let force: Vec<f64> = seen.histories.force.iter().map(|force| force.norm()).collect();
        smoothed(&force, SAMPLES_PER_WINDOW as usize)
    };
    let held = |seen: &Simulated| seen.histories.lost.iter().map(|lost| 1.0 - lost.iter().sum::<f64>()).collect();
    let largest = seen.iter().map(|(_, seen)| seen.first().one(&total_force::PEAK)).fold(0.0, f64::max);
    let (unit, factor) = if largest < 2000.0 { ("N", 1.0) } else { ("kN", 1e-3) };
    vec![
        chart("Force on the barrier", FORCE_CHART, ("total force", unit, factor), &time, &seen, &force),
        chart("Retained mass", MASS_CHART, ("share of the mass", "%", 100.0), &time, &seen, &held),
    ]
}

fn chart(
    title: &'static str,
    file: &str,
    (label, unit, factor): (&str, &str, f64),
    time: &[f64],
    seen: &[(String, &Simulated)],
    values: &dyn Fn(&Simulated) -> Vec<f64>,
) -> Chart {
    let curves: Vec<Vec<f64>> =
        seen.iter().map(|(_, seen)| resampled(&seen.histories.time, &values(seen), time)).collect();
    let series = |(index, ((letter, _), values)): (usize, (&(String, &Simulated), _))| Series {
        label: letter.clone(),
        values,
        colour: index % 6,
    };
    let series = seen.iter().zip(curves.iter().map(Vec::as_slice)).enumerate().map(series).collect();
    let svg = LineChart { title: label, unit, factor, along: TIME, time, series, levels: Vec::new(), band: None }.svg();
    Chart { title, file: file.into(), svg, note: "First run of each design; time since release.".into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_is_marked_only_beyond_scatter() {
        let spread = |mean, deviation, starts| Spread { mean, deviation, starts };
        assert!(differs(&spread(120.0, 0.0, 1), &spread(100.0, 0.0, 1)));
        assert!(!differs(&spread(109.0, 0.0, 1), &spread(100.0, 0.0, 1)));
        assert!(!differs(&spread(120.0, 10.0, 5), &spread(100.0, 10.0, 5)));
        assert!(differs(&spread(120.0, 1.0, 5), &spread(100.0, 1.0, 5)));
    }
}
