//! The page of a study of speed against accuracy, and its table for programs.

use std::collections::BTreeSet;
use std::fmt::Write;

use serde::Serialize;

use crate::report::chart::Chart;
use crate::report::folder::{ReportFile, free_name};
use crate::report::numbers::quoted;
use crate::report::plots::pareto::{Line, Pareto};
use crate::report::render::{Rendered, render_as};
use crate::studies::knobs::Knob;
use crate::studies::speed_accuracy::{OBSERVABLES, Point, Setting, Told, floor, tell};

const HTML: &str = include_str!("../../templates/study.html");
const MARKDOWN: &str = include_str!("../../templates/study.md");

/// One scene with all its runs, by setting.
pub struct Scene {
    pub name: String,
    /// The design's own value of every knob turned.
    pub defaults: Vec<(Knob, f64)>,
    pub runs: Vec<(Setting, Vec<Point>)>,
}

#[derive(Serialize)]
struct Page {
    name: String,
    observables: Vec<&'static str>,
    scenes: Vec<ScenePart>,
}

#[derive(Serialize)]
struct ScenePart {
    name: String,
    chart: Chart,
    rows: Vec<RowPart>,
    /// The knob that saves most for each share of error it adds, in words.
    bargain: String,
}

#[derive(Serialize)]
struct RowPart {
    setting: String,
    cost: String,
    wall_clock: String,
    errors: Vec<String>,
    /// Empty if all runs can be relied on.
    doubt: String,
}

/// Page, table and charts.
pub fn files(name: &str, scenes: &[Scene]) -> Result<Vec<ReportFile>, tera::Error> {
    let mut names = BTreeSet::new();
    let page = Page {
        name: name.into(),
        observables: OBSERVABLES.iter().map(|(name, _)| *name).collect(),
        scenes: scenes.iter().map(|scene| scene_part(scene, &free_name(&scene.name, &mut names))).collect(),
    };
    let Rendered { html, markdown } = render_as("study", &page, [HTML, MARKDOWN])?;
    let mut files = vec![
        ReportFile::new("study.html", html),
        ReportFile::new("study.md", markdown),
        ReportFile::new("study.csv", table(scenes)),
    ];
    files.extend(page.scenes.iter().map(|scene| ReportFile::new(&scene.chart.file, scene.chart.alone())));
    Ok(files)
}

fn scene_part(scene: &Scene, file_name: &str) -> ScenePart {
    let told = tell(&scene.runs);
    ScenePart {
        name: scene.name.clone(),
        chart: chart(scene, file_name, &told),
        rows: told.iter().map(row_part).collect(),
        bargain: bargain(scene, &told),
    }
}

fn row_part(told: &Told) -> RowPart {
    let error = |name: &&'static str| {
        let found = told.errors.iter().find(|(of, ..)| of == name);
        found.map_or("–".to_string(), |(_, error, doubt)| format!("{:+.1} ± {:.1} %", 100.0 * error, 100.0 * doubt))
    };
    let unreliable = told.starts - told.reliable;
    RowPart {
        setting: told.setting.word(),
        cost: number(told.cost, 2, ""),
        wall_clock: number(told.wall_clock, 1, " s"),
        errors: OBSERVABLES.iter().map(|(name, _)| name).map(error).collect(),
        doubt: if told.starts == 0 {
            "cannot be packed".into()
        } else if unreliable == 0 {
            String::new()
        } else {
            format!("{unreliable} of {} undecided", told.starts)
        },
    }
}

fn number(value: f64, digits: usize, unit: &str) -> String {
    if value.is_finite() { format!("{value:.digits$}{unit}") } else { "–".into() }
}

/// Scatter of a single start: of the observable that scatters most.
fn scatter(scene: &Scene) -> f64 {
    let base = scene.runs.iter().find(|(setting, _)| *setting == Setting::AsItIs);
    let of_each = base.map_or_else(Vec::new, |(_, points)| floor(points));
    of_each.into_iter().map(|(_, scatter)| scatter).fold(0.0, f64::max)
}

fn chart(scene: &Scene, file_name: &str, told: &[Told]) -> Chart {
    let base = told.iter().find(|told| told.setting == Setting::AsItIs);
    let default = base.map_or((1.0, 0.0), |told| (told.cost, told.error()));
    let line = |(knob, own): &(Knob, f64)| {
        let mut points: Vec<(f64, (f64, f64, String))> = told
            .iter()
            .filter_map(|told| match told.setting {
                Setting::Turned(of, value) if of == *knob && told.starts > 0 => {
                    Some((value, (told.cost, told.error(), knob.word(value))))
                }
                _ => None,
            })
            .collect();
        if points.is_empty() {
            return None;
        }
        points.push((*own, (default.0, default.1, String::new())));
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(Line { label: knob.title().into(), points: points.into_iter().map(|(_, point)| point).collect() })
    };
    let lines = scene.defaults.iter().filter_map(line).collect();
    let title = "Cost against error";
    let pareto = Pareto { title: format!("{title}, {}", scene.name), lines, default, floor: scatter(scene) };
    Chart {
        title,
        file: format!("pareto_{file_name}.svg"),
        svg: pareto.svg(),
        note: "Every line is one knob turned alone, through the model as it is. Error: the largest over all observables, against the finest model."
            .into(),
    }
}

/// Of the settings that are cheaper than the model as it is, the one that adds the least error for what it saves.
fn bargain(scene: &Scene, told: &[Told]) -> String {
    let Some(base) = told.iter().find(|told| told.setting == Setting::AsItIs) else { return String::new() };
    let floor = scatter(scene);
    let added = |told: &Told| (told.error() - base.error()).max(floor);
    let cheaper =
        told.iter().filter(|told| told.cost < 0.95 * base.cost && told.starts > 0 && told.reliable == told.starts);
    let best = cheaper.max_by(|a, b| ((1.0 - a.cost) / added(a)).total_cmp(&((1.0 - b.cost) / added(b))));
    match best {
        None => "Nothing tried is cheaper than the model as it is.".into(),
        Some(best) => format!(
            "The best bargain is \"{}\": {:.2} of the cost, largest error {:.1} % instead of {:.1} %; a single run scatters by {:.1} %.",
            best.setting.word(),
            best.cost,
            100.0 * best.error(),
            100.0 * base.error(),
            100.0 * floor
        ),
    }
}

fn table(scenes: &[Scene]) -> String {
    let mut text = String::from("scene,setting,starts,reliable,cost,wall_clock_s");
    for (name, _) in OBSERVABLES {
        let name = name.replace(' ', "_");
        let _ = write!(text, ",{name}_error,{name}_standard_error");
    }
    text.push('\n');
    for scene in scenes {
        for told in tell(&scene.runs) {
            let Told { starts, reliable, cost, wall_clock, .. } = told;
            let (name, setting) = (quoted(&scene.name), quoted(&told.setting.word()));
            let _ = write!(text, "{name},{setting},{starts},{reliable},{cost:.4},{wall_clock:.3}");
            for (name, _) in OBSERVABLES {
                match told.errors.iter().find(|(of, ..)| *of == name) {
                    Some((_, error, doubt)) => {
                        let _ = write!(text, ",{error:.5},{doubt:.5}");
                    }
                    None => text.push_str(",,"),
                }
            }
            text.push('\n');
        }
    }
    text
}
