//! What the templates may see: texts and finished figures. All rounding and all units happen here.

use serde::Serialize;

use crate::checks::outcome::{CheckVerdict, Outcome};
use crate::dem::recorders::snapshots::{Moment, Snapshot};
use crate::dem::tables::barrier::SegmentKind;
use crate::design::entries::Origin;
use crate::design::{Arrival, BarrierDesign, BarrierModel, Design};
use crate::loads::pressure::Diagram;
use crate::pipeline::{Run, Simulated, Verdict};
use crate::report::loads::{self, CaseRow, LadderRow, RopeRow, RuleRow, SwingRow};
use crate::report::plots::elevation::{class_names, elevation};
use crate::report::plots::line_chart::{Level, LineChart, Series};
use crate::report::plots::profile::profile;
use crate::report::plots::side_view::{Setting, side_view};
use crate::sources::VOLKWEIN_2014;

#[derive(Debug, Serialize)]
pub struct View {
    pub title: String,
    pub project: Vec<Row>,
    pub verdict: &'static str,
    pub verdict_line: String,
    pub doubts: Vec<String>,
    pub checks: Vec<CheckRow>,
    pub simulated: bool,
    pub guideline: Vec<Row>,
    pub cases: Vec<CaseRow>,
    pub ropes: Vec<RopeRow>,
    pub ladder: Vec<LadderRow>,
    pub wall: Vec<Row>,
    pub holding: Vec<Row>,
    /// Which start the findings and charts are of.
    pub start: String,
    /// How demands follow from several starts.
    pub by_starts: String,
    pub rules: Vec<RuleRow>,
    pub tornado: Vec<SwingRow>,
    pub margin: String,
    pub varied: Vec<SwingRow>,
    pub starts: Vec<Row>,
    pub findings: Vec<Row>,
    pub charts: Vec<Chart>,
    /// Side views at a few moments, and the barrier from upstream at its largest load.
    pub views: Vec<Chart>,
    pub elevation: Option<Chart>,
    /// Pressure over height at the largest force and at the end.
    pub profiles: Vec<Chart>,
    pub classes: Vec<String>,
    /// Style of all pictures.
    pub picture_style: &'static str,
    pub inputs: Vec<InputRow>,
    pub assumptions: Vec<&'static str>,
    pub not_checked: Vec<&'static str>,
    pub numerics: Vec<Row>,
    pub version: &'static str,
    pub sha256: String,
}

/// A name with its value and, where it helps, a remark.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub name: String,
    pub value: String,
    pub remark: String,
}

#[derive(Debug, Serialize)]
pub struct CheckRow {
    pub title: String,
    pub guideline: String,
    pub simulation: String,
    pub capacity: String,
    /// The capacity with its numbers.
    pub working: String,
    pub utilisation: String,
    pub verdict: &'static str,
    pub source: &'static str,
}

#[derive(Debug, Serialize)]
pub struct Chart {
    pub title: &'static str,
    /// Name of the picture's file beside the Markdown report.
    pub file: String,
    pub svg: String,
    pub note: String,
}

#[derive(Debug, Serialize)]
pub struct InputRow {
    pub path: String,
    pub typed: String,
    pub origin: &'static str,
    pub meaning: &'static str,
}

/// What is assumed, as far as it bears on this design.
fn assumptions(run: &Run) -> Vec<&'static str> {
    let design = &run.file.design;
    let net = matches!(design.barrier, BarrierDesign::FlexibleNet(_));
    let default_arrival = match design.flow.arrival {
        Arrival::DamBreak(block) => block.depth_at_barrier.is_none() || block.velocity_at_barrier.is_none(),
        Arrival::Surge { .. } => false,
    };
    let simulated = run.simulated.is_some();
    let list = [
        (
            simulated,
            "Grains are two equal overlapping spheres (or spheres, for an aspect of 1), rigid but for a linear contact spring with a dashpot that never pulls, and Coulomb friction with the smaller of the two friction angles.",
        ),
        (simulated, "The flow is dry: no water pressure, no cohesion, no breakage of grains."),
        (
            true,
            "The channel is straight, plane and of rectangular section; its base continues downstream of the barrier.",
        ),
        (
            net,
            "Dissipators are elastic, then perfectly plastic at their plateau, unload elastically, and are rigid once their stroke is used up.",
        ),
        (net, "Ropes, net and anchors do not break; exceeding their resistance shows in the checks alone."),
        (
            net && simulated,
            "The mesh is stretched a little so that whole diagonals fit the width and each bay between main ropes.",
        ),
        (
            net && simulated,
            "Strokes and tensions of dissipators in the simulation carry no partial factor, because a dissipator does not scale with its load; to cover one, give a larger flow.",
        ),
        (
            default_arrival,
            "For a dam break the guideline's depth is 4/9 of the block's height (Ritter 1892) and its velocity that of a block sliding on the bed, where the design does not give them.",
        ),
        (
            net,
            "By the equations each main rope carries its strip as a uniform load across the channel, alone: neither net nor lateral ropes share it out.",
        ),
    ];
    let kept = list.into_iter().filter(|(applies, _)| *applies).map(|(_, text)| text);
    kept.chain(of_ropes(design).filter(|_| simulated)).collect()
}

/// What the model of the barrier assumes of its ropes.
fn of_ropes(design: &Design) -> Option<&'static str> {
    match (&design.barrier, design.simulation.barrier_model) {
        (BarrierDesign::RigidWall(_), _) => None,
        (_, BarrierModel::PinnedRopes) => Some(
            "Ropes pull and never push and do not bend; rings are fixed to the main ropes; half the mass of each rope segment sits at each of its ends; axial damping of 5 % of critical is added.",
        ),
        (_, BarrierModel::SlidingRopes) => Some(
            "Ropes pull and never push and do not bend; main ropes run through the rings of the net with friction; half the mass of each rope segment sits at each of its ends; axial damping of 5 % of critical is added.",
        ),
        (_, BarrierModel::Cylinders) => Some(
            "Ropes are elastic cylinders that bend and twist as solid rods of their modulus; rings are squares of four cylinders that slide on the main ropes with friction; axial damping of 5 % and bending damping of 20 % of critical is added.",
        ),
    }
}

/// What nobody has looked at.
fn not_checked(design: &Design) -> Vec<&'static str> {
    let net = matches!(design.barrier, BarrierDesign::FlexibleNet(_));
    let loads = &design.loads;
    let list = [
        (true, "scour, abutments and foundations"),
        (true, "corrosion, abrasion and maintenance"),
        (
            net,
            "the bolts or anchors that hold the lowest rope to the bed; the rings; punching of the mesh by a single stone",
        ),
        (loads.point_load.is_none(), "impact of single boulders larger than the design grains, and of wood"),
        (loads.drained.is_none(), "drainage of the deposit"),
        (loads.snow_pressure.is_none(), "snow"),
    ];
    list.into_iter().filter(|(applies, _)| *applies).map(|(_, text)| text).collect()
}

impl View {
    pub fn of(run: &Run) -> Self {
        let project = &run.file.design.project;
        let row = |name: &str, value: &str| Row { name: name.into(), value: value.into(), remark: String::new() };
        let mut outcomes: Vec<&Outcome> = run.outcomes.iter().collect();
        outcomes.sort_by(|a, b| {
            let used = |outcome: &Outcome| outcome.utilisation.unwrap_or(-1.0);
            rank(a.verdict).cmp(&rank(b.verdict)).then(used(b).total_cmp(&used(a)))
        });
        Self {
            title: format!("{}: {}", project.name, project.barrier),
            project: vec![
                row("Project", &project.name),
                row("Barrier", &project.barrier),
                row("Revision", &project.revision),
                row("Author", &project.author),
                row("Checker", &project.checker),
                row("Date", &project.date),
                row("Notes", &project.notes),
                row("Design file", &run.file.name),
            ],
            verdict: run.verdict.word(),
            verdict_line: verdict_line(run, &outcomes),
            doubts: run.doubts.clone(),
            checks: outcomes.iter().map(|outcome| check_row(outcome)).collect(),
            guideline: guideline_rows(run),
            simulated: run.simulated.is_some(),
            cases: loads::cases(run),
            ropes: loads::ropes(run),
            ladder: loads::ladder(run),
            wall: loads::wall(run),
            holding: loads::holding(run),
            start: run.simulated.as_ref().map_or(String::new(), start_named),
            by_starts: run.simulated.as_ref().map_or(String::new(), by_starts),
            rules: loads::rules(run),
            tornado: loads::tornado(run),
            margin: loads::margin(run),
            varied: loads::swing_rows(&run.varied),
            starts: run.simulated.as_ref().map_or_else(Vec::new, start_rows),
            findings: run.simulated.as_ref().map_or_else(Vec::new, |seen| super::findings::rows(run, seen)),
            views: run.simulated.as_ref().map_or_else(Vec::new, |seen| views(run, seen)),
            profiles: run.simulated.as_ref().map_or_else(Vec::new, |seen| profiles(run, seen)),
            elevation: run.simulated.as_ref().and_then(|seen| elevation_chart(run, seen)),
            classes: class_names(),
            picture_style: PICTURE_STYLE,
            charts: run.simulated.as_ref().map_or_else(Vec::new, |seen| charts(run, seen)),
            inputs: input_rows(run),
            assumptions: assumptions(run),
            not_checked: not_checked(&run.file.design),
            numerics: run.simulated.as_ref().map_or_else(Vec::new, super::findings::numerics_rows),
            version: env!("CARGO_PKG_VERSION"),
            sha256: run.file.sha256.clone(),
        }
    }
}

/// Worst first.
fn rank(verdict: CheckVerdict) -> u8 {
    match verdict {
        CheckVerdict::Fail => 0,
        CheckVerdict::Warn => 1,
        CheckVerdict::Pass => 2,
        CheckVerdict::Info => 3,
    }
}

fn verdict_line(run: &Run, sorted: &[&Outcome]) -> String {
    let held: Vec<_> = run.outcomes.iter().filter(|outcome| outcome.verdict != CheckVerdict::Info).collect();
    let failed = held.iter().filter(|outcome| outcome.verdict == CheckVerdict::Fail).count();
    let by_guideline = |outcome: &&&Outcome| match (outcome.demand.guideline, outcome.capacity) {
        (Some(demand), Some(capacity)) => demand > capacity,
        _ => false,
    };
    let governing = sorted.iter().find(|outcome| outcome.utilisation.is_some());
    let governing = governing.map_or(String::new(), |outcome| {
        format!(" Governing: {} ({}).", outcome.title.to_lowercase(), percent(outcome.utilisation))
    });
    let broken = loads::rules(run).iter().filter(|rule| rule.verdict == "warn").count();
    let broken = match broken {
        0 => String::new(),
        1 => " One rule of detailing or range is not kept.".to_string(),
        count => format!(" {count} rules of detailing or range are not kept."),
    };
    let governing = format!("{governing}{broken}");
    match run.verdict {
        Verdict::Undecided => {
            let alone = held.iter().filter(by_guideline).count();
            let hint = if alone > 0 { format!(" By the guideline alone {alone} checks fail.") } else { String::new() };
            let what =
                if run.simulated.is_some() { "The simulation cannot be relied on" } else { "Nothing is decided" };
            format!("{what}; see the reasons below.{hint}")
        }
        Verdict::Fail => {
            let alone = if run.simulated.is_some() { "" } else { ", by the equations alone" };
            format!("{failed} of {} checks fail{alone}.{governing}", held.len())
        }
        Verdict::Pass => {
            let unjudged = run.outcomes.iter().filter(|outcome| outcome.capacity.is_some()).count()
                - held.len().min(run.outcomes.len());
            let alone = match &run.simulated {
                None => format!(" by the equations alone; {unjudged} more need the simulation"),
                Some(simulated) if simulated.starts.len() == 1 => {
                    "; one start, so its scatter is not known (--seeds)".to_string()
                }
                Some(_) => String::new(),
            };
            let close = held.iter().filter(|outcome| outcome.verdict == CheckVerdict::Warn).count();
            let close = if close > 0 { format!(", {close} with less than 10 % to spare") } else { String::new() };
            format!("{0} of {0} checks hold{close}{alone}.{governing}", held.len())
        }
    }
}

fn check_row(outcome: &Outcome) -> CheckRow {
    let show = |value: Option<f64>| value.map_or("–".to_string(), |value| with_unit(value, outcome.unit));
    CheckRow {
        title: outcome.title.clone(),
        guideline: show(outcome.demand.guideline),
        simulation: show(outcome.demand.simulation),
        capacity: show(outcome.capacity),
        working: working(outcome),
        utilisation: percent(outcome.utilisation),
        verdict: outcome.verdict.word(),
        source: outcome.source,
    }
}

/// Characteristic resistance over its factor, times the share that may be used.
fn working(outcome: &Outcome) -> String {
    let Some((resistance, share)) = outcome.resistance else { return String::new() };
    if resistance.factor == 1.0 && share == 1.0 {
        return String::new();
    }
    let mut text = with_unit(resistance.characteristic, outcome.unit);
    if resistance.factor != 1.0 {
        text += &format!(" / {}", figures(resistance.factor));
    }
    if share != 1.0 {
        text += &format!(" × {:.0} %", 100.0 * share);
    }
    text
}

pub fn percent(share: Option<f64>) -> String {
    match share {
        None => "–".to_string(),
        Some(share) if share > 10.0 => "> 1000 %".to_string(),
        Some(share) => format!("{:.0} %", 100.0 * share),
    }
}

/// A value with the unit a person would use.
pub fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "N" if value.abs() < 2000.0 => format!("{value:.0} N"),
        "N" => format!("{} kN", figures(value / 1e3)),
        "N/m" if value.abs() < 2000.0 => format!("{value:.0} N/m"),
        "N/m" => format!("{} kN/m", figures(value / 1e3)),
        "Pa" if value.abs() < 2000.0 => format!("{value:.0} Pa"),
        "Pa" => format!("{} kPa", figures(value / 1e3)),
        "N m/m" if value.abs() < 2000.0 => format!("{value:.1} N m/m"),
        "N m/m" => format!("{} kN m/m", figures(value / 1e3)),
        "kg" if value.abs() < 2000.0 => format!("{} kg", figures(value)),
        "kg" => format!("{} t", figures(value / 1e3)),
        "" => figures(value),
        "-" => format!("{:.1} %", 100.0 * value),
        unit => format!("{} {unit}", figures(value)),
    }
}

/// A mean and its standard deviation, both in the unit that suits the mean.
fn with_scatter(mean: f64, deviation: f64, unit: &str) -> String {
    match unit {
        "-" => format!("{:.1} ± {:.1} %", 100.0 * mean, 100.0 * deviation),
        "N" | "N/m" | "Pa" | "N m/m" if mean.abs() >= 2000.0 => {
            format!("{} ± {} k{unit}", figures(mean / 1e3), figures(deviation / 1e3))
        }
        unit => format!("{} ± {} {unit}", figures(mean), figures(deviation)).trim_end().to_string(),
    }
}

/// Three significant figures, whole numbers from 100 on.
pub fn figures(value: f64) -> String {
    match value.abs() {
        size if size >= 100.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 0.1 || size == 0.0 => format!("{value:.2}"),
        _ => format!("{value:.4}"),
    }
}

fn guideline_rows(run: &Run) -> Vec<Row> {
    let input = &run.guideline.input;
    let row = |name: &str, value: String, remark: &str| Row { name: name.into(), value, remark: remark.into() };
    let design = &run.file.design;
    let filling = if input.fills() {
        "normal to the bed: surges come until the barrier is full (loads.filling)"
    } else {
        "normal to the bed: one event only, to a level surface of its volume; the barrier is emptied before the next (loads.filling)"
    };
    let values = &design.factors;
    let factors = format!("load {}, rope {}, anchor {}", values.load, values.rope, values.anchor);
    let set = run.file.entries.text("factors.set").unwrap_or("none");
    let typed =
        ["load", "rope", "anchor"].into_iter().filter(|name| run.file.entries.mentions(&format!("factors.{name}")));
    let typed = typed.collect::<Vec<_>>().join(", ");
    let factor_remark = match (set, typed.as_str()) {
        ("none", "") => "defaults".to_string(),
        ("none", typed) => format!("typed in the design: {typed}"),
        (set, "") => format!("of the set {set}"),
        (set, typed) => format!("of the set {set}, but for what is typed in the design: {typed}"),
    };
    vec![
        row("K", figures(input.earth_pressure), &format!("static pressure K ρ g H cos α; {VOLKWEIN_2014}")),
        row("λ", figures(input.dynamic_pressure), &format!("dynamic pressure λ ρ v²; {VOLKWEIN_2014}")),
        row("Density ρ", with_unit(input.density, "kg/m³"), "bulk density of the flow"),
        row("Depth h", with_unit(input.depth, "m"), "of the moving flow"),
        row("Velocity v", with_unit(input.velocity, "m/s"), "of the moving flow"),
        row("Froude number", figures(input.froude()), "v/√(g h cos α)"),
        row("Height of filling", with_unit(input.fill_height, "m"), filling),
        row("Partial factors", factors, &factor_remark),
    ]
}

fn start_named(run: &Simulated) -> String {
    match run.starts.len() {
        1 => String::new(),
        starts => format!(" (start 1 of {starts}, seed {})", run.starts[0].seed),
    }
}

fn by_starts(run: &Simulated) -> String {
    match run.starts.len() {
        1 => String::new(),
        starts => format!(
            "Demands of the simulation are the mean of {starts} starts plus {:.2} standard deviations (for what must be kept: minus), the value that the next start exceeds with a probability of 5 % (EN 1990, annex D); what a dissipator caps stays at its cap.",
            crate::starts::k_n(starts)
        ),
    }
}

fn start_rows(run: &Simulated) -> Vec<Row> {
    if run.starts.len() < 2 {
        return Vec::new();
    }
    let row = |(observable, spread): (super::findings::Observable, crate::starts::Spread)| Row {
        name: observable.title,
        value: with_scatter(spread.mean, spread.deviation, observable.unit),
        remark: format!("mean ± standard deviation of {} starts", spread.starts),
    };
    super::findings::over_starts(run).into_iter().map(row).collect()
}

fn input_rows(run: &Run) -> Vec<InputRow> {
    let entries = &run.file.entries;
    let row = |path: &String| {
        let entry = &entries.values[path];
        InputRow {
            path: path.clone(),
            typed: entry.typed.clone(),
            origin: match entry.origin {
                Origin::File => "file",
                Origin::Default => "default",
                Origin::Set(source) => source,
            },
            meaning: entry.meaning,
        }
    };
    entries.order.iter().map(row).collect()
}

const PICTURE_STYLE: &str = include_str!("../../templates/pictures.css");

fn file_name(title: &str) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' };
    format!("{}.svg", title.replace('λ', "lambda").chars().map(letter).collect::<String>())
}

impl View {
    /// Every picture as a file that stands alone: name and text.
    pub fn pictures(&self) -> Vec<(String, String)> {
        let alone = |svg: &str| {
            let styled = svg.replacen("<svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"", 1);
            styled.replacen('>', &format!("><style>{PICTURE_STYLE}</style>"), 1) + "\n"
        };
        let charts = self.charts.iter().chain(&self.views).chain(&self.profiles).chain(&self.elevation);
        charts.map(|chart| (chart.file.clone(), alone(&chart.svg))).collect()
    }
}

fn charts(run: &Run, seen: &Simulated) -> Vec<Chart> {
    let mut charts = vec![force_chart(run, seen), mass_chart(run, seen)];
    if seen.histories.strokes.iter().flatten().any(|stroke| *stroke > 0.0) {
        charts.push(stroke_chart(run, seen));
    }
    if !seen.histories.rope_mean.is_empty() {
        charts.push(rope_chart(seen));
    }
    charts.push(velocity_chart(seen));
    charts.push(split_chart(seen));
    charts.push(coefficient_chart(run, seen));
    charts
}

/// The slice along the middle at every moment kept.
fn views(run: &Run, seen: &Simulated) -> Vec<Chart> {
    let design = &run.file.design;
    let setting = Setting {
        slope: design.channel.slope,
        width: design.channel.width,
        height: run.guideline.input.barrier_height,
        wall: matches!(design.barrier, BarrierDesign::RigidWall(_)),
        fastest: seen.first().velocity_peak,
    };
    let chart = |snapshot: &Snapshot| Chart {
        title: match snapshot.moment {
            Moment::FirstContact => "First contact",
            Moment::LargestForce => "Largest force",
            Moment::HalfAtRest => "Half of the mass at rest",
            Moment::End => "End",
        },
        file: format!("flow_{:?}.svg", snapshot.moment).to_lowercase(),
        svg: side_view(snapshot, &setting),
        note: format!("at {:.2} s", snapshot.time),
    };
    seen.histories.snapshots.iter().map(chart).collect()
}

/// Pressure over height when the force is largest, and at the end, beside the guideline's for the depths seen then.
fn profiles(run: &Run, seen: &Simulated) -> Vec<Chart> {
    let input = &run.guideline.input;
    let told = &seen.first().coefficients;
    let chart = |snapshot: &Snapshot| {
        let (title, moving) = match snapshot.moment {
            Moment::LargestForce => ("Pressure at the largest force", true),
            Moment::End => ("Pressure at rest", false),
            Moment::FirstContact | Moment::HalfAtRest => return None,
        };
        let at = told.time.partition_point(|time| *time < snapshot.time).min(told.time.len().checked_sub(1)?);
        let (deposit, depth) = (told.deposit[at], told.moving[at]);
        let velocity = if moving { told.velocity_mean[at].max(0.0) } else { 0.0 };
        let diagram = Diagram {
            unit: input.unit_pressure(),
            surface: deposit + depth,
            top: input.barrier_height,
            block: input.dynamic_pressure * input.density * velocity * velocity,
            block_from: deposit,
            block_to: deposit + depth,
        };
        let note = format!(
            "at {:.2} s; strips: forces of grains at that instant; line: guideline with the design's K and λ for H_d = {}, h = {} and the mean velocity of {}",
            snapshot.time,
            with_unit(deposit, "m"),
            with_unit(depth, "m"),
            with_unit(velocity, "m/s")
        );
        let svg = profile(&snapshot.touches, run.guideline.width, input.barrier_height, &diagram);
        Some(Chart { title, file: file_name(title), svg, note })
    };
    seen.histories.snapshots.iter().filter_map(chart).collect()
}

/// The barrier when the force on it is largest.
fn elevation_chart(run: &Run, seen: &Simulated) -> Option<Chart> {
    let design = &run.file.design;
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let snapshot = seen.histories.snapshots.iter().find(|snapshot| snapshot.moment == Moment::LargestForce)?;
    let resistance = |kind: SegmentKind| {
        let rope = match kind {
            SegmentKind::Main(_) => &net.main_ropes.rope,
            SegmentKind::Lateral => &net.lateral_rope,
            SegmentKind::Net | SegmentKind::Ring => &net.net_rope,
        };
        rope.breaking_load * design.factors.rope_end / design.factors.rope / design.factors.load
    };
    Some(Chart {
        title: "Barrier from upstream, at its largest load",
        file: file_name("Barrier from upstream"),
        svg: elevation(snapshot, design.channel.width, resistance),
        note: format!(
            "At {:.2} s, as deformed then; colour by tension over design resistance at that instant.",
            snapshot.time
        ),
    })
}

fn split_chart(seen: &Simulated) -> Chart {
    let told = &seen.first().coefficients;
    let largest = [&told.force_dead, &told.force_moving, &told.guideline_dead, &told.guideline_moving];
    let largest = largest.iter().flat_map(|series| series.iter()).copied().fold(0.0, f64::max);
    let (unit, factor) = if largest < 2000.0 { ("N/m", 1.0) } else { ("kN/m", 1e-3) };
    let series = |label: &str, values, colour| Series { label: label.into(), values, colour };
    let chart = LineChart {
        title: "force per width",
        unit,
        factor,
        time: &seen.histories.time,
        series: vec![
            series("F₁ at rest", &told.force_dead, 0),
            series("F₂ moving", &told.force_moving, 1),
            series("F₁ guideline", &told.guideline_dead, 2),
            series("F₂ guideline", &told.guideline_moving, 3),
        ],
        levels: Vec::new(),
    };
    let note = "By grains at rest and by moving grains that touch the barrier; the guideline with the design's K and λ, the depths seen, and the mean velocity of all grains.";
    Chart {
        title: "Deposit and moving flow",
        file: file_name("Deposit and moving flow"),
        svg: chart.svg(),
        note: note.into(),
    }
}

/// K and λ beyond this are cut off in the chart.
const HIGHEST_COEFFICIENT: f64 = 10.0;

fn coefficient_chart(run: &Run, seen: &Simulated) -> Chart {
    let told = &seen.first().coefficients;
    let shown = |series: &[f64]| -> Vec<f64> {
        series.iter().map(|value| if *value <= HIGHEST_COEFFICIENT { value.max(0.0) } else { f64::NAN }).collect()
    };
    let (k, upstream) = (shown(&told.earth_pressure), shown(&told.dynamic_upstream));
    let factors = &run.file.design.factors;
    let chart = LineChart {
        title: "coefficient",
        unit: "–",
        factor: 1.0,
        time: &seen.histories.time,
        series: vec![
            Series { label: "K".into(), values: &k, colour: 0 },
            Series { label: "λ".into(), values: &upstream, colour: 1 },
        ],
        levels: vec![
            Level { label: "K design".into(), value: factors.earth_pressure },
            Level { label: "λ design".into(), value: factors.dynamic_pressure },
        ],
    };
    let note = format!(
        "λ with the velocity just upstream; left out where the depth is less than a grain, the flow has all but stopped, or the value is above {HIGHEST_COEFFICIENT:.0}."
    );
    Chart { title: "K and λ over time", file: file_name("K and λ over time"), svg: chart.svg(), note }
}

fn force_chart(run: &Run, seen: &Simulated) -> Chart {
    let histories = &seen.histories;
    let force: Vec<f64> = histories.force.iter().map(|force| force.norm()).collect();
    let force = crate::dem::recorders::histories::smoothed(&force, crate::scene::build::SAMPLES_PER_WINDOW as usize);
    let width = run.file.design.channel.width;
    let levels = run.guideline.cases.iter();
    let (unit, factor) = if seen.first().force_peak < 2000.0 { ("N", 1.0) } else { ("kN", 1e-3) };
    let chart = LineChart {
        title: "total force",
        unit,
        factor,
        time: &histories.time,
        series: vec![Series { label: "simulation".into(), values: &force, colour: 0 }],
        levels: levels
            .map(|case| Level { label: case.id.replace('_', " "), value: case.force_per_width() * width })
            .collect(),
    };
    let note = format!("Mean over {:.0} ms. Dashed: guideline.", 1e3 * seen.facts.smoothing);
    Chart { title: "Force on the barrier", file: file_name("Force on the barrier"), svg: chart.svg(), note }
}

fn mass_chart(run: &Run, seen: &Simulated) -> Chart {
    let histories = &seen.histories;
    let retained: Vec<f64> = histories.lost.iter().map(|lost| 1.0 - lost.iter().sum::<f64>()).collect();
    let chart = LineChart {
        title: "share of the mass",
        unit: "%",
        factor: 100.0,
        time: &histories.time,
        series: vec![
            Series { label: "not past the barrier".into(), values: &retained, colour: 0 },
            Series { label: "at rest".into(), values: &histories.dead, colour: 1 },
        ],
        levels: vec![Level { label: "limit".into(), value: run.file.design.limits.retained_mass }],
    };
    Chart {
        title: "Retained mass",
        file: file_name("Retained mass"),
        svg: chart.svg(),
        note: "At rest: slower than 5 % of the highest mean velocity.".into(),
    }
}

fn stroke_chart(run: &Run, seen: &Simulated) -> Chart {
    let limit = match &run.file.design.barrier {
        crate::design::BarrierDesign::FlexibleNet(net) => net.dissipators.map(|dissipator| dissipator.stroke),
        crate::design::BarrierDesign::RigidWall(_) => None,
    };
    let chart = LineChart {
        title: "stroke used",
        unit: "m",
        factor: 1.0,
        time: &seen.histories.time,
        series: rope_series(&seen.histories.strokes),
        levels: limit.map(|value| Level { label: "available".into(), value }).into_iter().collect(),
    };
    Chart {
        title: "Dissipators",
        file: file_name("Dissipators"),
        svg: chart.svg(),
        note: "The longer of the two strokes of each main rope.".into(),
    }
}

fn rope_chart(seen: &Simulated) -> Chart {
    let chart = LineChart {
        title: "mean tension",
        unit: "kN",
        factor: 1e-3,
        time: &seen.histories.time,
        series: rope_series(&seen.histories.rope_mean),
        levels: Vec::new(),
    };
    Chart {
        title: "Main ropes",
        file: file_name("Main ropes"),
        svg: chart.svg(),
        note: "Mean along each rope, numbered from the bottom.".into(),
    }
}

fn velocity_chart(seen: &Simulated) -> Chart {
    let velocity: Vec<f64> = seen.histories.velocity.iter().map(|velocity| velocity[0]).collect();
    let chart = LineChart {
        title: "mean velocity",
        unit: "m/s",
        factor: 1.0,
        time: &seen.histories.time,
        series: vec![Series { label: "along the channel".into(), values: &velocity, colour: 0 }],
        levels: Vec::new(),
    };
    Chart {
        title: "Velocity of the flow",
        file: file_name("Velocity of the flow"),
        svg: chart.svg(),
        note: "Mean over all grains that have not left the model.".into(),
    }
}

fn rope_series(rows: &[Vec<f64>]) -> Vec<Series<'_>> {
    let moving = rows.iter().enumerate().filter(|(_, row)| row.iter().any(|value| *value > 0.0));
    moving.map(|(index, row)| Series { label: format!("rope {}", index + 1), values: row, colour: index % 6 }).collect()
}
