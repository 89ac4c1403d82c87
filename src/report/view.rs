//! What the templates may see: texts and finished figures.

use crate::report::row::{Row, in_a_line, is_share, is_stop, lower_first, row, scaled, used, worst_first};
use serde::Serialize;

use crate::checks::detailing;
use crate::checks::outcome::{CheckVerdict, Kind, Outcome, WARN_FROM, most_used};
use crate::demand::USED_UP;
use crate::design::entries::Origin;
use crate::design::hydrograph::{GoverningPoint, HydrographPoint};
use crate::design::read::sha256;
use crate::design::{Arrival, BarrierDesign, NetRings, Rope};
use crate::flow_cases::{Combination, combinations};
use crate::pipeline::{Run, Verdict};
use crate::program::PROGRAM;
use crate::report::anchors;
use crate::report::chart::{self, Chart};
use crate::report::holding;
use crate::report::loads::{self, CaseRow, ModelRow, RopeRow, RuleRow, SwingRow};
use crate::report::numbers::{figures, rope_numbers, with_scatter, with_unit};
use crate::report::pictures::{self, REPLAY_SCRIPT};
use crate::report::plots::elevation::class_names;
use crate::report::posts;
use crate::report::reliability::{ClimbRow, climb_rows, why_enough};
use crate::report::replay::Replay;
use crate::report::site;
use crate::report::statements::{Assumption, assumptions, not_checked, references};
use crate::report::surges::{self, Surges};
use crate::report::table::Table;
use crate::report::warnings::{self, left_by_simulation};
use crate::simulated::Simulated;
use crate::sources::VOLKWEIN_2014;

#[derive(Debug, Serialize)]
pub struct View {
    pub title: String,
    pub project: Vec<Row>,
    pub verdict: &'static str,
    pub verdict_line: String,
    pub doubts: Vec<String>,
    /// What a reviewer should know before the numbers.
    pub warnings: Vec<warnings::Told>,
    pub utilisation: Option<Chart>,
    pub checks: Vec<CheckRow>,
    /// Whether any tells the demand of the flow without partial factors.
    pub has_characteristic: bool,
    /// Why checks are open.
    pub open: Vec<OpenRow>,
    /// Where each partial factor stands.
    pub combinations: Vec<CombinationRow>,
    pub simulated: bool,
    pub guideline: Vec<Row>,
    pub cases: Vec<CaseRow>,
    /// How the demand of the total force follows from them; empty where it is the largest of them.
    pub face_remark: String,
    /// How the demand of a lowest rope between its bolts follows; empty where there is none.
    pub bolted_rope: String,
    pub ring_net: String,
    pub ropes: Vec<RopeRow>,
    pub posts: Option<Table>,
    /// How their loads by the equations follow.
    pub posts_working: String,
    pub anchors: Option<Table>,
    pub other_models: Vec<ModelRow>,
    pub wall: Vec<Row>,
    pub holding: Vec<Row>,
    /// Which start the findings and charts are of.
    pub start: String,
    /// How demands follow from several starts.
    pub by_starts: String,
    pub rules: Vec<RuleRow>,
    pub tornado: Vec<SwingRow>,
    pub margin: String,
    /// The site, to scale.
    pub site: Vec<Chart>,
    /// Where its ropes are anchored, and where the flow starts.
    pub site_rows: Vec<Row>,
    /// What "per width" means where the section is no rectangle.
    pub per_width: String,
    pub varied: Vec<SwingRow>,
    pub starts: Vec<Row>,
    pub findings: Vec<Row>,
    pub charts: Vec<Chart>,
    /// The event surge by surge, where it comes in several.
    pub surges: Option<Surges>,
    /// Side views at a few moments.
    pub views: Vec<Chart>,
    /// The barrier from upstream at its largest load.
    pub elevation: Option<Chart>,
    /// Pressure over height at the largest force and at the end.
    pub profiles: Vec<Chart>,
    pub classes: Vec<String>,
    pub replay: Option<Replay>,
    /// Program of the page that shows it.
    pub replay_script: &'static str,
    pub inputs: Vec<InputRow>,
    /// What follows from the inputs alone.
    pub derived: Vec<Row>,
    pub assumptions: Vec<Assumption>,
    pub references: Vec<&'static str>,
    pub not_checked: Vec<&'static str>,
    pub numerics: Vec<Row>,
    /// The rungs that ran, where the program chose how fine to model, and why it stopped.
    pub climb: Vec<ClimbRow>,
    pub why_enough: String,
}

#[derive(Debug, Serialize)]
pub struct CheckRow {
    pub title: String,
    pub guideline: String,
    pub simulation: String,
    /// Of the characteristic flow, without partial factors, where loads carry one.
    pub characteristic: String,
    pub capacity: String,
    /// The capacity with its numbers.
    pub working: String,
    pub utilisation: String,
    /// Under the larger load that the guideline has, where that uses more.
    pub scaled: String,
    pub verdict: &'static str,
    pub source: &'static str,
}

/// A reason that holds checks open, with the checks.
#[derive(Debug, Serialize)]
pub struct OpenRow {
    pub why: String,
    pub checks: String,
}

/// A row of the load combination table.
#[derive(Debug, Serialize)]
pub struct CombinationRow {
    pub what: &'static str,
    pub factor: String,
    pub by_equations: &'static str,
    pub by_simulation: &'static str,
}

#[derive(Debug, Serialize)]
pub struct InputRow {
    pub path: String,
    pub typed: String,
    pub origin: &'static str,
    pub meaning: &'static str,
    /// What the designer has written beside the value.
    pub remark: String,
}

impl View {
    pub fn of(run: &Run) -> Self {
        let project = &run.file.design.project;
        let outcomes = worst_first(run);
        Self {
            title: format!("{}: {}", project.name, project.barrier),
            project: title_block(run),
            verdict: run.verdict.word(),
            verdict_line: summary(run),
            doubts: run.doubts.clone(),
            warnings: warnings::warnings(run),
            utilisation: pictures::utilisation_chart(run),
            has_characteristic: outcomes.iter().any(|outcome| outcome.demand.characteristic.is_some()),
            checks: outcomes.iter().map(|outcome| check_row(outcome)).collect(),
            open: open_rows(&outcomes),
            combinations: combination_rows(run),
            guideline: guideline_rows(run),
            simulated: run.simulated.is_some(),
            cases: loads::cases(run),
            face_remark: loads::face_remark(run),
            bolted_rope: loads::bolted_rope(run),
            ring_net: loads::ring_net(run),
            ropes: loads::ropes(run),
            posts: posts::table(run),
            posts_working: posts::working(run),
            anchors: anchors::table(run),
            other_models: loads::other_models(run),
            wall: loads::wall(run),
            holding: holding::rows(run),
            start: run.simulated.as_ref().map_or(String::new(), start_named),
            by_starts: run.simulated.as_ref().map_or(String::new(), by_starts),
            rules: loads::rules(run),
            tornado: loads::tornado(run),
            margin: [left_by_simulation(run), Some(loads::margin(run))]
                .into_iter()
                .flatten()
                .collect::<Vec<_>>()
                .join(" "),
            site: site::charts(run),
            site_rows: site::rows(run),
            per_width: loads::per_width(run),
            varied: loads::swing_rows(&run.varied),
            starts: run.simulated.as_ref().map_or_else(Vec::new, start_rows),
            surges: surges::of(run),
            findings: run.simulated.as_ref().map_or_else(Vec::new, |seen| super::findings::rows(run, seen)),
            views: run.simulated.as_ref().map_or_else(Vec::new, |seen| pictures::views(run, seen)),
            profiles: run.simulated.as_ref().map_or_else(Vec::new, |seen| pictures::profiles(run, seen)),
            elevation: run.simulated.as_ref().and_then(|seen| pictures::elevation_chart(run, seen)),
            classes: class_names(),
            replay: run.simulated.as_ref().and_then(|seen| pictures::replay(run, seen)),
            replay_script: REPLAY_SCRIPT,
            charts: run.simulated.as_ref().map_or_else(Vec::new, |seen| pictures::charts(run, seen)),
            inputs: input_rows(run),
            derived: derived_rows(run),
            assumptions: assumptions(run),
            climb: climb_rows(run),
            why_enough: why_enough(run),
            references: references(run),
            not_checked: not_checked(&run.file.design),
            numerics: run.simulated.as_ref().map_or_else(Vec::new, |seen| super::reliability::numerics_rows(run, seen)),
        }
    }

    /// Every picture as a file that stands alone: name and text.
    pub fn pictures(&self) -> Vec<(String, String)> {
        let pictures = self
            .site
            .iter()
            .chain(self.surges.iter().filter_map(|surges| surges.chart.as_ref()))
            .chain(&self.charts)
            .chain(&self.views)
            .chain(&self.profiles)
            .chain(&self.elevation)
            .chain(&self.utilisation);
        let cases = self.cases.iter().map(|case| (case.file.clone(), chart::alone(&case.svg)));
        pictures.map(|chart| (chart.file.clone(), chart.alone())).chain(cases).collect()
    }
}

/// What the report is of, and what made it.
fn title_block(run: &Run) -> Vec<Row> {
    let project = &run.file.design.project;
    let row = |name: &str, value: &str| Row { name: name.into(), value: value.into(), remark: String::new() };
    let seen = run.simulated.as_ref();
    let seeds = seen.map_or(String::new(), |seen| {
        let seeds: Vec<String> = seen.starts.iter().map(|start| start.seed.to_string()).collect();
        let of = if seeds.len() == 1 { "seed" } else { "seeds" };
        format!("{} ({of} of the random packing: {})", seeds.len(), seeds.join(", "))
    });
    let hashes = run.file.attached.iter().map(|(name, bytes)| format!("{name}: {}", sha256(bytes)));
    let attached = hashes.collect::<Vec<_>>().join("; ");
    let simulated = seen.and_then(|seen| moment(seen.facts.began)).unwrap_or_default();
    // A report made again tells of both programs.
    let other = seen.map_or("", |seen| seen.facts.program.as_str());
    let other = if other == PROGRAM { "" } else { other };
    let rows = [
        row("Project", &project.name),
        row("Barrier", &project.barrier),
        row("Revision", &project.revision),
        row("Author", &project.author),
        row("Checker", blank(&project.checker)),
        row("Date", blank(&project.date)),
        row("Notes", &project.notes),
        row("Design file", &run.file.name),
        row("SHA-256 of the design file", &run.file.sha256),
        row("SHA-256 of attached files", &attached),
        row("Simulated", &simulated),
        row("Runs", &seeds),
        row(if other.is_empty() { "Program" } else { "Program of this report" }, PROGRAM),
        row("Program that simulated", other),
    ];
    rows.into_iter().filter(|row| !matches!(row.value.as_str(), "" | "-")).collect()
}

/// What a hand may fill in.
fn blank(text: &str) -> &str {
    if matches!(text, "" | "-") { "to be filled in" } else { text }
}

/// A moment in seconds since 1970, as date and time.
fn moment(seconds: i64) -> Option<String> {
    let moment = time::OffsetDateTime::from_unix_timestamp(seconds).ok()?;
    moment.format(time::macros::format_description!("[year]-[month]-[day] [hour]:[minute] UTC")).ok()
}

/// The verdict in a sentence.
pub fn summary(run: &Run) -> String {
    let sorted = worst_first(run);
    let held: Vec<_> = run.outcomes.iter().filter(|outcome| outcome.verdict != CheckVerdict::Info).collect();
    let count = |verdict: CheckVerdict| held.iter().filter(|outcome| outcome.verdict == verdict).count();
    let governing = most_used(sorted.iter().copied().filter(|outcome| !is_stop(outcome)));
    let governing = governing.map_or(String::new(), |outcome| format!(" Governing: {}.", in_a_line(outcome)));
    let rules = detailing::rules(&run.file.design, &run.guideline);
    let broken = match rules.iter().filter(|rule| !rule.holds()).count() {
        0 => String::new(),
        1 => " One detailing rule or formula range is not met.".to_string(),
        count => format!(" {count} detailing rules or formula ranges are not met."),
    };
    let open = match count(CheckVerdict::Open) {
        0 => String::new(),
        1 => "one check is open".to_string(),
        count => format!("{count} checks are open"),
    };
    match run.verdict {
        Verdict::Undecided if !run.doubts.is_empty() => {
            let open = if open.is_empty() { open } else { format!(", and {open}") };
            format!("The simulation cannot be relied on{open}; see the reasons below.{governing}{broken}")
        }
        Verdict::Undecided => {
            let failed = if run.simulated.is_some() { "" } else { " by the guideline alone" };
            format!(
                "{} of {} checks pass{failed}; {open}, see the reasons below.{governing}{broken}",
                held.len() - count(CheckVerdict::Open),
                held.len()
            )
        }
        Verdict::Fail => {
            let alone = if run.simulated.is_some() { "" } else { " by the guideline alone" };
            let open = if open.is_empty() { open } else { format!("; {open}") };
            let doubt = if run.doubts.is_empty() {
                ""
            } else {
                " The simulation cannot be relied on, but a check that fails by the guideline fails regardless of it."
            };
            format!(
                "{} of {} checks fail{alone}{open}.{doubt}{governing}{broken}",
                count(CheckVerdict::Fail),
                held.len()
            )
        }
        Verdict::Pass => {
            let one = match &run.simulated {
                Some(simulated) if simulated.starts.len() == 1 && run.climb.is_empty() => {
                    "; based on a single run, with an assumed allowance for the scatter between runs and the error of the model"
                }
                _ => "",
            };
            let let_stand = held.iter().filter(|outcome| !outcome.stands_despite.is_empty()).count();
            let close = held
                .iter()
                .filter(|outcome| outcome.holds() && outcome.used().is_some_and(|used| used > WARN_FROM))
                .count();
            let mut spare = if close > 0 { format!(", {close} with less than 10 % to spare") } else { String::new() };
            if let_stand > 0 {
                spare +=
                    &format!(", {let_stand} outside the range of a formula, which limits.outside_range lets stand");
            }
            let left = loads::least_margin(run).map_or(String::new(), |left| format!(" By the guideline {left}."));
            format!("{0} of {0} checks pass{spare}{one}.{governing}{broken}{left}", held.len())
        }
    }
}

fn check_row(outcome: &Outcome) -> CheckRow {
    let show = |value: Option<f64>| value.map_or("–".to_string(), |value| with_unit(value, outcome.unit.symbol()));
    // A stroke ends where there is no more of it: the demand is at least that.
    let stroke =
        outcome.resistance.filter(|_| outcome.kind == Kind::Stroke).map(|(resistance, _)| resistance.characteristic);
    let used_up = |demand: Option<f64>| stroke.zip(demand).is_some_and(|(stroke, demand)| demand >= USED_UP * stroke);
    let demand =
        |demand: Option<f64>| if used_up(demand) { format!("≥ {}, used up", show(demand)) } else { show(demand) };
    CheckRow {
        title: outcome.title.clone(),
        guideline: demand(outcome.demand.guideline),
        simulation: demand(outcome.demand.simulation),
        characteristic: outcome.demand.characteristic.map_or(String::new(), |value| demand(Some(value))),
        capacity: match (is_share(outcome), outcome.capacity) {
            (true, Some(least)) => format!("at least {}", with_unit(least, outcome.unit.symbol())),
            _ => show(outcome.capacity),
        },
        working: working(outcome),
        utilisation: used(outcome),
        scaled: scaled(outcome),
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
    let mut text = with_unit(resistance.characteristic, outcome.unit.symbol());
    if resistance.factor != 1.0 {
        text += &format!(" / {}", figures(resistance.factor));
    }
    if share != 1.0 {
        text += &format!(" × {:.0} %", 100.0 * share);
    }
    text
}

/// Each reason once, in the order of the checks.
fn open_rows(outcomes: &[&Outcome]) -> Vec<OpenRow> {
    let mut rows: Vec<OpenRow> = Vec::new();
    for outcome in outcomes {
        let Some(open) = &outcome.open else { continue };
        let title = lower_first(&outcome.title);
        match rows.iter_mut().find(|row| row.why == open.words()) {
            Some(row) => row.checks += &format!("; {title}"),
            None => rows.push(OpenRow { why: open.words().to_string(), checks: title }),
        }
    }
    rows
}

fn combination_rows(run: &Run) -> Vec<CombinationRow> {
    let row = |row: Combination| CombinationRow {
        what: row.what,
        factor: figures(row.factor),
        by_equations: row.by_equations,
        by_simulation: row.by_simulation,
    };
    combinations(&run.file.design).into_iter().map(row).collect()
}

fn guideline_rows(run: &Run) -> Vec<Row> {
    let input = &run.guideline.input;
    let row = |name: &str, value: String, remark: &str| Row { name: name.into(), value, remark: remark.into() };
    let design = &run.file.design;
    let filling = if !design.loads.to_the_top && input.fills() {
        "normal to the bed: one event fills the barrier to its top (loads.filling)"
    } else if input.fills() {
        "normal to the bed: repeated surges until the barrier is full (loads.filling)"
    } else {
        "normal to the bed: one event only, heaped up against the barrier at the angle of repose, no higher than it runs up; the barrier is emptied before the next (loads.filling)"
    };
    let values = &design.factors;
    let factors = match &design.barrier {
        BarrierDesign::FlexibleNet(net) => {
            let of_posts = match net.posts {
                Some(_) => format!(", post {}", values.post),
                None => String::new(),
            };
            format!("load {}, rope {}, anchor {}{of_posts}", values.load, values.rope, values.anchor)
        }
        BarrierDesign::RigidWall(_) => {
            format!("load {}; those of the wall's resistance stand in the load combination", values.load)
        }
    };
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
    let wood = (input.wood != 1.0).then(|| {
        row("Wood factor f_w", figures(input.wood), "on the dynamic pressure, f_w λ ρ v²; the simulation holds no wood")
    });
    let mut rows = vec![
        row(
            "K",
            figures(input.earth_pressure),
            &format!("static pressure K ρ g H cos α, after {VOLKWEIN_2014} (K = 1); the value is that of the design"),
        ),
        row(
            "λ",
            figures(input.dynamic_pressure),
            &format!("dynamic pressure λ ρ v², after {VOLKWEIN_2014} (λ = 0.7 to 2); the value is that of the design"),
        ),
        row("Density ρ", with_unit(input.density, "kg/m³"), "bulk density of the flow"),
        row("Depth h", with_unit(input.depth, "m"), "of the moving flow"),
        row("Velocity v", with_unit(input.velocity, "m/s"), "of the moving flow"),
        row("Froude number", figures(input.froude()), "v/√(g h cos α)"),
        row("g'", with_unit(input.gravity_normal, "m/s²"), "g cos α, α being the slope of the bed"),
        row("Height of filling", with_unit(input.fill_height, "m"), filling),
        row("Partial factors", factors, &factor_remark),
    ];
    if let Some(wood) = wood {
        rows.insert(2, wood);
    }
    rows
}

fn start_named(run: &Simulated) -> String {
    match run.starts.len() {
        1 => String::new(),
        starts => format!(" (run 1 of {starts}, seed {})", run.starts[0].seed),
    }
}

fn by_starts(run: &Simulated) -> String {
    match run.starts.len() {
        1 => String::new(),
        starts => format!(
            "Simulated demands are the mean of {starts} runs plus {:.2} standard deviations (for what must be kept: minus), the value that the next run exceeds with a probability of 5 % (EN 1990, annex D); what a dissipator caps stays at its cap.",
            crate::starts::k_n(starts)
        ),
    }
}

fn start_rows(run: &Simulated) -> Vec<Row> {
    if run.starts.len() < 2 {
        return Vec::new();
    }
    let row = |(observable, spread): (super::spreads::Observable, crate::starts::Spread)| Row {
        name: observable.title,
        value: with_scatter(spread.mean, spread.deviation, observable.unit.symbol()),
        remark: format!("mean ± standard deviation of {} runs", spread.starts),
    };
    super::spreads::over_packings(run).into_iter().map(row).collect()
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
            remark: entry.remark.clone(),
        }
    };
    entries.order.iter().map(row).collect()
}

/// What follows from the inputs alone.
fn derived_rows(run: &Run) -> Vec<Row> {
    let design = &run.file.design;
    let flow = &design.flow;
    let row = |name: &str, value: String, remark: String| Row { name: name.into(), value, remark };
    let solid = flow.volume() * flow.bulk_density / flow.grain_density();
    // The equations alone need not be told of the grains.
    let told = |known: bool, text: String| if known { text } else { "not given".into() };
    let sizes = [0.3, 0.5, 0.9].map(|share| flow.sizes.named(share));
    let grains = flow.sizes.count(solid);
    let mut rows = vec![
        row("Volume of the flow", with_unit(flow.volume(), "m³"), "with pores".into()),
        row(
            "Grain sizes D30, D50, D90",
            told(sizes.iter().all(|size| size.is_finite()), sizes.map(|size| with_unit(size, "m")).join(", ")),
            format!("{}, as the sizes are given", flow.sizes.measure()),
        ),
        row("Number of grains", told(grains.is_finite(), format!("{grains:.0}")), "of the whole flow, about".into()),
        row(
            "Unit weight normal to the bed ρ g'",
            format!("{} kN/m³", figures(run.guideline.input.density * run.guideline.input.gravity_normal * 1e-3)),
            "g' = g cos α".into(),
        ),
    ];
    if let Arrival::DamBreak(block) = design.flow.arrival {
        rows.push(row(
            "Depth of the block",
            with_unit(block.height, "m"),
            "volume over its length and the width".into(),
        ));
    }
    rows.extend(hydrograph_rows(run));
    if let BarrierDesign::FlexibleNet(net) = &design.barrier {
        let axial = Rope::axial_stiffness;
        let of_net = net.rings.is_none().then_some(("net", &net.net_rope));
        let kinds = net.main_ropes.kinds();
        let name = |levels: &[usize]| if kinds.len() > 1 { rope_numbers(levels) } else { "the main ropes".into() };
        let main = kinds.iter().map(|(levels, rope)| (name(levels), *rope));
        let of_net = of_net.map(|(_, rope)| ("the net ropes".to_string(), rope));
        for (name, rope) in main.chain(of_net).chain([("the lateral ropes".to_string(), &net.lateral_rope)]) {
            let how = "modulus times the full circle of the diameter".to_string();
            rows.push(row(&format!("EA of {name}"), with_unit(axial(rope), "N"), how));
        }
        rows.extend(net.rings.iter().flat_map(ring_rows));
    }
    rows
}

/// What the rings of a net come to.
fn ring_rows(rings: &NetRings) -> [Row; 3] {
    let [[bent, knee], [broken, force]] = rings.chain;
    let source = match (rings.tested, rings.is_known()) {
        (true, _) => "a test of such a chain",
        (false, true) => "follows from the wires (Guo 2022)",
        (false, false) => {
            "follows from the wires, for rings as nobody has tested them (Guo 2022 has 300 mm, 5 to 19 windings of 3 mm, and four contacts)"
        }
    };
    [
        row(
            "Steel of a leg of a ring",
            format!("{} mm²", figures(rings.wires.area() * 1e6)),
            format!("all wires pulled straight would hold {}", with_unit(rings.wires.breaking_load(), "N")),
        ),
        row(
            "Chain of rings, bending ends",
            format!("{} at {:.1} %", with_unit(knee, "N"), 100.0 * bent),
            format!("of its length; {source}"),
        ),
        row(
            "Chain of rings, break",
            format!("{} at {:.1} %", with_unit(force, "N"), 100.0 * broken),
            format!("a leg is held against {}", with_unit(rings.characteristic_leg(), "N")),
        ),
    ]
}

/// What the table of a hydrograph comes to, where its inlet is, and what of it the equations take.
fn hydrograph_rows(run: &Run) -> Vec<Row> {
    let design = &run.file.design;
    let (Some(hydrograph), Arrival::Surge(surge)) = (&design.flow.hydrograph, design.flow.arrival) else {
        return Vec::new();
    };
    let section = design.channel.section();
    let most = |of: &dyn Fn(&HydrographPoint) -> f64| hydrograph.rows.iter().map(of).fold(0.0, f64::max);
    let moment = |point: &GoverningPoint| {
        let HydrographPoint { time, depth, velocity } = point.moment;
        format!("{} with {} at {}", with_unit(depth, "m"), with_unit(velocity, "m/s"), with_unit(time, "s"))
    };
    vec![
        row(
            "Hydrograph",
            format!("{} in {}", with_unit(design.flow.volume(), "m³"), with_unit(hydrograph.duration(), "s")),
            format!(
                "at the most {} deep, {} and {}; what the table gives runs straight between its rows",
                with_unit(most(&|row| row.depth), "m"),
                with_unit(most(&|row| row.velocity), "m/s"),
                with_unit(most(&|row| section.area(row.depth) * row.velocity), "m³/s")
            ),
        ),
        row(
            "Inlet",
            with_unit(surge.run_in, "m"),
            "along the bed, upstream of the most upstream point of the barrier; by default clear of the deposit",
        ),
        row(
            "Moments of the hydrograph in the equations",
            hydrograph.governing.iter().map(moment).collect::<Vec<_>>().join("; "),
            "none is both deeper and faster; that of the largest momentum first",
        ),
    ]
}
