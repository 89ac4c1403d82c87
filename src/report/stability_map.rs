//! The page of the stability map: a row of cells for every scene, a table of limits, what was noticed.

use std::fmt::Write;

use serde::Serialize;

use crate::report::chart::Chart;
use crate::report::folder::ReportFile;
use crate::report::numbers::quoted;
use crate::report::plots::escape;
use crate::report::render::{Rendered, render_as};
use crate::studies::stability::{Mapped, StepOutcome};

const HTML: &str = include_str!("../../templates/stability.html");
const MARKDOWN: &str = include_str!("../../templates/stability.md");

#[derive(Serialize)]
struct Page {
    name: String,
    chart: Chart,
    rows: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    name: &'static str,
    what: &'static str,
    estimated: String,
    sharpness: String,
    verdict: &'static str,
    caught: &'static str,
    /// How the first run that goes wrong does so.
    how: String,
}

/// Page, table and picture.
pub fn files(name: &str, mapped: &[Mapped]) -> Result<Vec<ReportFile>, tera::Error> {
    let page = Page {
        name: name.into(),
        chart: Chart {
            title: "What becomes of a run",
            file: "stability.svg".into(),
            svg: cells(mapped),
            note: "By the step over the critical step that the program estimates; the line is the estimate.".into(),
        },
        rows: mapped.iter().map(row).collect(),
    };
    let Rendered { html, markdown } = render_as("map", &page, [HTML, MARKDOWN])?;
    Ok(vec![
        ReportFile::new("stability.html", html),
        ReportFile::new("stability.md", markdown),
        ReportFile::new("stability.csv", table(mapped)),
        ReportFile::new(page.chart.file.as_str(), page.chart.alone()),
    ])
}

fn row(mapped: &Mapped) -> Row {
    let wrong =
        mapped.limits.trials.iter().find(|trial| matches!(trial.fate, StepOutcome::Unstable | StepOutcome::Tunnelling));
    Row {
        name: mapped.name,
        what: mapped.what,
        estimated: format!("{:.3e} s", mapped.limits.estimated),
        sharpness: if mapped.linear && mapped.limits.true_share.is_finite() {
            format!("{:.2}", mapped.sharpness())
        } else {
            "–".into()
        },
        verdict: mapped.word(),
        caught: if mapped.all_caught() { "yes" } else { "NO" },
        how: wrong.map_or("nothing went wrong".to_string(), |trial| {
            format!("{} at {}: {}", trial.fate.word(), trial.share, trial.noticed.join("; "))
        }),
    }
}

const CELL: [f64; 2] = [46.0, 24.0];
const LABEL: f64 = 170.0;
const TOP: f64 = 22.0;

fn cells(mapped: &[Mapped]) -> String {
    let columns = mapped.iter().map(|scene| scene.limits.trials.len()).max().unwrap_or(0);
    let (width, height) = (LABEL + CELL[0] * columns as f64 + 8.0, TOP + CELL[1] * mapped.len() as f64 + 6.0);
    let mut out =
        format!(r#"<svg viewBox="0 0 {width} {height}" role="img" aria-label="What becomes of a run by its step">"#);
    for (column, trial) in mapped.first().map_or(&[][..], |scene| &scene.limits.trials).iter().enumerate() {
        let x = LABEL + CELL[0] * (column as f64 + 0.5);
        let _ = write!(out, r#"<text class="tick" text-anchor="middle" x="{x}" y="14">{}</text>"#, trial.share);
    }
    for (line, scene) in mapped.iter().enumerate() {
        let y = TOP + CELL[1] * line as f64;
        let up = y + 0.5 * CELL[1] + 4.0;
        let name = escape(scene.name);
        let _ = write!(out, r#"<text class="tick" text-anchor="end" x="{}" y="{up}">{name}</text>"#, LABEL - 8.0);
        for (column, trial) in scene.limits.trials.iter().enumerate() {
            let x = LABEL + CELL[0] * column as f64;
            let [wide, tall] = CELL.map(|side| side - 2.0);
            let fate = trial.fate.word();
            let _ = write!(out, r#"<rect class="cell {fate}" x="{x}" y="{y}" width="{wide}" height="{tall}"/>"#);
            let middle = x + 0.5 * wide;
            let letter = &fate[..1].to_uppercase();
            let _ =
                write!(out, r#"<text class="on {fate}" text-anchor="middle" x="{middle}" y="{up}">{letter}</text>"#);
        }
    }
    let within =
        mapped.first().map_or(0, |scene| scene.limits.trials.iter().filter(|trial| trial.share <= 1.0).count());
    let x = LABEL + CELL[0] * within as f64 - 1.0;
    let _ = write!(out, r#"<line class="limit" x1="{x}" x2="{x}" y1="{}" y2="{height}"/></svg>"#, TOP - 6.0);
    out
}

fn table(mapped: &[Mapped]) -> String {
    let mut text = String::from("scene,share,fate,imbalance,noticed\n");
    for scene in mapped {
        for trial in &scene.limits.trials {
            let noticed = trial.noticed.len();
            let _ = writeln!(
                text,
                "{},{},{},{:e},{noticed}",
                quoted(scene.name),
                trial.share,
                trial.fate.word(),
                trial.imbalance
            );
        }
    }
    text
}
