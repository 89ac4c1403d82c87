//! The page of a study that seeks the cheapest barrier that passes, and its tables for programs.

use std::fmt::Write;
use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use crate::design::Design;
use crate::report::chart::Chart;
use crate::report::folder::ReportFile;
use crate::report::numbers::{figures, quoted};
use crate::report::plots::cost_margin::{CostMargin, Dot, Mark};
use crate::report::render::{Rendered, render_as};
use crate::studies::bill::Prices;
use crate::studies::choices::Choices;
use crate::studies::sizing::{BY_EQUATIONS, Candidate, CandidateResult, Found, Wanted};

const HTML: &str = include_str!("../../templates/size.html");
const MARKDOWN: &str = include_str!("../../templates/size.md");

/// Ways that the page shows; all are in the table for programs.
const MOST_SHOWN: usize = 60;

/// A search with what it was asked.
pub struct Sized<'a> {
    pub name: &'a str,
    pub design: &'a Path,
    pub choices: &'a Choices,
    pub prices: &'a Prices,
    pub wanted: Wanted,
    pub found: &'a Found,
    pub front: &'a [Front],
}

/// The cheapest that keeps a margin.
pub struct Front {
    pub margin: f64,
    pub cheapest: Option<Candidate>,
    /// Whether the search ended before because enough had been simulated.
    pub out_of_budget: bool,
}

#[derive(Serialize)]
struct Page {
    name: String,
    design: String,
    result: String,
    why: Vec<String>,
    /// Of the cheapest: each choice with the option taken.
    taken: Vec<[String; 2]>,
    /// Quantity, how much, price of one, price, origin.
    bill: Vec<[String; 5]>,
    total: String,
    choices: Vec<String>,
    rows: Vec<WayRow>,
    left_out: usize,
    /// Margin, price, options.
    front: Vec<[String; 3]>,
    chart: Option<Chart>,
}

#[derive(Serialize)]
struct WayRow {
    options: Vec<String>,
    price: String,
    /// `pass`, `fail`, `open` or empty.
    verdict: &'static str,
    by: String,
    why: String,
    used: String,
}

/// Page, tables and chart; `design` reads a way again.
pub fn files(
    sized: &Sized,
    design: impl Fn(usize) -> Result<Design, String>,
) -> Result<Vec<ReportFile>, Box<dyn std::error::Error>> {
    let Sized { found, prices, .. } = sized;
    let cheapest = found.cheapest.map(|place| &found.ways[place]);
    let money = |price: f64| format!("{} {}", figures(price), prices.currency).trim().to_string();
    let options = |way: &Candidate| -> Vec<String> {
        sized.choices.options(way.number).iter().map(|option| option.label.clone()).collect()
    };
    let bill = match cheapest {
        Some(way) => {
            let design = design(way.number)?;
            let row = |item: &crate::studies::bill::Price| {
                let ([title, unit], amount) = (item.of.words(), item.of.of(&design));
                let amounts = format!("{} {unit}", figures(amount)).trim().to_string();
                [title.to_string(), amounts, money(item.price), money(item.price * amount), item.origin.clone()]
            };
            prices.items.iter().map(row).collect()
        }
        None => Vec::new(),
    };
    let shown: Vec<&Candidate> = shown(found);
    let page = Page {
        name: sized.name.to_string(),
        design: sized.design.display().to_string(),
        result: result(sized, cheapest, &money),
        why: reasons(sized),
        taken: cheapest.map_or_else(Vec::new, |way| {
            let names = sized.choices.0.iter().map(|choice| shortly(&choice.name));
            names.zip(options(way)).map(|(name, option)| [name, option]).collect()
        }),
        bill,
        total: cheapest.and_then(|way| way.price).map_or(String::new(), money),
        choices: sized.choices.0.iter().map(|choice| shortly(&choice.name)).collect(),
        rows: shown.iter().map(|way| row_of(way, options(way), &money)).collect(),
        left_out: found.ways.len() - shown.len(),
        front: sized
            .front
            .iter()
            .map(|Front { margin, cheapest, out_of_budget }| {
                let none = if *out_of_budget { "not found within most_simulated" } else { "none passes" };
                let price = cheapest.as_ref().and_then(|way| way.price).map_or(none.into(), money);
                let options = cheapest.as_ref().map_or(String::new(), |way| options(way).join(", "));
                [format!("{:.0} %", 100.0 * margin), price, options]
            })
            .collect(),
        chart: chart(sized),
    };
    let Rendered { html, markdown } = render_as("size", &page, [HTML, MARKDOWN])?;
    let mut files = vec![
        ReportFile::new("size.html", html),
        ReportFile::new("size.md", markdown),
        ReportFile::new("size.csv", table(sized)),
        ReportFile::new("size.json", json(sized)? + "\n"),
    ];
    files.extend(page.chart.as_ref().map(|chart| ReportFile::new(&chart.file, chart.alone())));
    Ok(files)
}

/// A key without the sections that all keys of a barrier are in, in words.
fn shortly(name: &str) -> String {
    let own =
        ["barrier.flexible_net.", "barrier.rigid_wall.", "barrier."].iter().find_map(|head| name.strip_prefix(head));
    own.unwrap_or(name).replace(['.', '_'], " ")
}

/// The cheapest, what is undecided or was simulated, and of the others the dearest ones that cost less than the cheapest.
fn shown(found: &Found) -> Vec<&Candidate> {
    let told = |way: &Candidate| match &way.fate {
        CandidateResult::Passes { .. } | CandidateResult::Undecided { .. } => true,
        CandidateResult::Fails { by, .. } => by != BY_EQUATIONS,
        CandidateResult::NotAsked | CandidateResult::Impossible { .. } => false,
    };
    let refuted: Vec<usize> = (0..found.ways.len()).filter(|place| !told(&found.ways[*place])).collect();
    let asked: Vec<usize> =
        refuted.into_iter().filter(|place| matches!(found.ways[*place].fate, CandidateResult::Fails { .. })).collect();
    let told: Vec<usize> = (0..found.ways.len()).filter(|place| told(&found.ways[*place])).collect();
    let room = MOST_SHOWN.saturating_sub(told.len());
    let mut places: Vec<usize> = told.into_iter().chain(asked.into_iter().rev().take(room)).collect();
    places.sort_unstable();
    places.truncate(MOST_SHOWN);
    places.into_iter().map(|place| &found.ways[place]).collect()
}

fn result(sized: &Sized, cheapest: Option<&Candidate>, money: &impl Fn(f64) -> String) -> String {
    let Some(way) = cheapest else {
        return match sized.found.out_of_budget {
            true => format!(
                "None found: {} combinations were simulated, the most that the study allows (most_simulated), and none of them passes.",
                sized.wanted.most_simulated
            ),
            false => match sized.found.ways.iter().any(|way| matches!(way.fate, CandidateResult::Undecided { .. })) {
                true => "No combination of the choices passes; some are undecided.".into(),
                false => "No combination of the choices passes: all of them fail, or lack the margin.".into(),
            },
        };
    };
    let price = way.price.map_or(String::new(), money);
    let margin = match sized.wanted.margin {
        0.0 => String::new(),
        margin => format!(" with a margin of {:.0} %", 100.0 * margin),
    };
    match &way.fate {
        CandidateResult::Passes { by, check, used } => format!(
            "The cheapest barrier that passes{margin} costs {price}. It passes by {by}; the check that uses most is {check}, {:.0} %.",
            100.0 * used
        ),
        _ => format!(
            "The cheapest barrier that the equations do not refute{margin} costs {price}. They need not pass it: what they leave open a simulation must decide."
        ),
    }
}

/// What was ruled out by what, and what could still be cheaper.
fn reasons(sized: &Sized) -> Vec<String> {
    let ways = &sized.found.ways;
    let count = |of: &dyn Fn(&CandidateResult) -> bool| ways.iter().filter(|way| of(&way.fate)).count();
    let impossible = count(&|fate| matches!(fate, CandidateResult::Impossible { .. }));
    let refuted = count(&|fate| matches!(fate, CandidateResult::Fails { by, .. } if by == BY_EQUATIONS));
    let failed = count(&|fate| matches!(fate, CandidateResult::Fails { by, .. } if by != BY_EQUATIONS));
    let undecided = count(&|fate| matches!(fate, CandidateResult::Undecided { .. }));
    let not_asked = count(&|fate| matches!(fate, CandidateResult::NotAsked));
    let mut told = vec![format!(
        "Combinations of the choices: {}. Not valid as designs: {impossible}; ruled out by the equations: {refuted}; by simulation: {failed}; undecided: {undecided}; not evaluated: {not_asked}. What lacks the margin counts as ruled out.",
        ways.len()
    )];
    if let Some(place) = sized.found.cheapest {
        told.push("They were evaluated in the order of their price: every cheaper one has been ruled out, is not a valid design, or is listed as undecided.".into());
        let price = ways[place].price;
        let as_dear =
            ways.iter().filter(|way| way.price == price && matches!(way.fate, CandidateResult::NotAsked)).count();
        if as_dear > 0 {
            told.push(format!(
                "{as_dear} that were not evaluated cost the same: the prices do not distinguish them, and one of them may have more margin."
            ));
        }
    }
    if undecided > 0 {
        told.push("What is undecided may pass: see why in the table. A limit that is not given, or a formula outside its range, leaves a check open whatever is simulated.".into());
    }
    let outside: Vec<&str> =
        sized.choices.0.iter().flat_map(|choice| choice.keys()).filter(|key| !key.starts_with("barrier.")).collect();
    if !outside.is_empty() {
        told.push(format!(
            "These choices change the demand and not the barrier: {}. A lower price may come from a milder demand.",
            outside.join(", ")
        ));
    }
    let first = ways.iter().find_map(|way| match &way.fate {
        CandidateResult::Impossible { why } => Some(why),
        _ => None,
    });
    told.extend(first.map(|why| format!("The first that is not a valid design: {why}.")));
    told
}

fn row_of(way: &Candidate, options: Vec<String>, money: &impl Fn(f64) -> String) -> WayRow {
    let (verdict, by, why, used) = match &way.fate {
        CandidateResult::Passes { by, check, used } => ("pass", by.as_str(), check.as_str(), Some(*used)),
        CandidateResult::Fails { by, check, used } => ("fail", by.as_str(), check.as_str(), Some(*used)),
        CandidateResult::Undecided { by, why, used } => ("open", by.as_str(), why.as_str(), Some(*used)),
        CandidateResult::Impossible { why } => ("", "", why.as_str(), None),
        CandidateResult::NotAsked => ("", "", "", None),
    };
    let used = used.filter(|used| used.is_finite()).map_or("–".into(), |used| format!("{:.0} %", 100.0 * used));
    let price = way.price.map_or("–".into(), money);
    WayRow { options, price, verdict, by: by.into(), why: why.into(), used }
}

fn chart(sized: &Sized) -> Option<Chart> {
    let dot = |way: &Candidate| {
        let (mark, used) = match &way.fate {
            CandidateResult::Passes { used, .. } => (Mark::Pass, *used),
            CandidateResult::Fails { by, used, .. } if by == BY_EQUATIONS => (Mark::Refuted, *used),
            CandidateResult::Fails { used, .. } => (Mark::Fail, *used),
            CandidateResult::Undecided { used, .. } => (Mark::Open, *used),
            CandidateResult::Impossible { .. } | CandidateResult::NotAsked => return None,
        };
        let price = way.price.filter(|_| used.is_finite())?;
        Some(Dot { price, used, mark })
    };
    let mut dots: Vec<Dot> = sized.found.ways.iter().filter_map(dot).collect();
    dots.extend(sized.front.iter().filter_map(|front| dot(front.cheapest.as_ref()?)));
    let front =
        sized.front.iter().filter_map(|front| Some([front.cheapest.as_ref()?.price?, 1.0 - front.margin])).collect();
    (!dots.is_empty()).then(|| {
        let drawn = CostMargin { dots, front, limit: 1.0 - sized.wanted.margin, currency: sized.prices.currency.clone() };
        Chart::of(
            "Price against what the checks use",
            drawn.svg(),
            "Each dot is a combination that was evaluated, at the largest utilisation of its checks, by the equations or by its last simulation. What is above 200 % is drawn at the top.",
        )
    })
}

/// Every way, one to a line.
fn table(sized: &Sized) -> String {
    let mut text = String::from("number");
    for choice in &sized.choices.0 {
        let _ = write!(text, ",{}", quoted(&choice.name));
    }
    text.push_str(",price,fate,by,largest_utilisation,why\n");
    for way in &sized.found.ways {
        let _ = write!(text, "{}", way.number);
        for option in sized.choices.options(way.number) {
            let _ = write!(text, ",{}", quoted(&option.label));
        }
        let (fate, by, used, why) = match &way.fate {
            CandidateResult::Passes { by, check, used } => ("passes", by.as_str(), Some(*used), check.as_str()),
            CandidateResult::Fails { by, check, used } => ("fails", by.as_str(), Some(*used), check.as_str()),
            CandidateResult::Undecided { by, why, used } => ("undecided", by.as_str(), Some(*used), why.as_str()),
            CandidateResult::Impossible { why } => ("impossible", "", None, why.as_str()),
            CandidateResult::NotAsked => ("not asked", "", None, ""),
        };
        let price = way.price.map_or(String::new(), |price| format!("{price:.6}"));
        let used = used.filter(|used| used.is_finite()).map_or(String::new(), |used| format!("{used:.6}"));
        let _ = writeln!(text, ",{price},{fate},{},{used},{}", quoted(by), quoted(why));
    }
    text
}

/// `size.json`: the contract that other programs script against. Fields may be added, never renamed.
#[derive(Serialize, JsonSchema)]
pub struct SizeFile<'a> {
    schema_version: u32,
    name: &'a str,
    design: String,
    /// Names of the choices, in the order of each combination's `options`.
    choices: Vec<&'a str>,
    currency: &'a str,
    margin: f64,
    cheapest: Option<&'a Candidate>,
    /// In the order of their price, those that are no designs last.
    ways: Vec<JsonWay<'a>>,
    front: Vec<JsonFront<'a>>,
}

#[derive(Serialize, JsonSchema)]
struct JsonWay<'a> {
    options: Vec<&'a str>,
    #[serde(flatten)]
    way: &'a Candidate,
}

#[derive(Serialize, JsonSchema)]
struct JsonFront<'a> {
    margin: f64,
    cheapest: Option<&'a Candidate>,
}

fn json(sized: &Sized) -> serde_json::Result<String> {
    let options =
        |way: &Candidate| sized.choices.options(way.number).into_iter().map(|option| option.label.as_str()).collect();
    serde_json::to_string_pretty(&SizeFile {
        schema_version: 1,
        name: sized.name,
        design: sized.design.display().to_string(),
        choices: sized.choices.0.iter().map(|choice| choice.name.as_str()).collect(),
        currency: &sized.prices.currency,
        margin: sized.wanted.margin,
        cheapest: sized.found.cheapest.map(|place| &sized.found.ways[place]),
        ways: sized.found.ways.iter().map(|way| JsonWay { options: options(way), way }).collect(),
        front: sized
            .front
            .iter()
            .map(|front| JsonFront { margin: front.margin, cheapest: front.cheapest.as_ref() })
            .collect(),
    })
}
