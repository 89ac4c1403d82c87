//! The page of a study that asks how probable a failure is, and its file for programs.

use serde::Serialize;

use crate::reliability::Probability;
use crate::reliability::form::{DesignPoint, NoPoint};
use crate::reliability::normal::quantile;
use crate::report::assessment::{Told, distribution};
use crate::report::chart::Chart;
use crate::report::folder::ReportFile;
use crate::report::numbers::{figures, percent};
use crate::report::plots::importance::{Importance, Row};
use crate::report::plots::line_chart::{Level, LineChart, Series};
use crate::report::probability_json::json;
use crate::report::render::{Rendered, render_as};
use crate::studies::amount::{Amount, shown as shown_value};
use crate::studies::reliability::{Answer, OfCheck, Way};
use crate::studies::reliability_plan::{FactorsWish, Input};
use crate::studies::size_plan::By;
use crate::units::ratio;

const HTML: &str = include_str!("../../templates/reliability.html");
const MARKDOWN: &str = include_str!("../../templates/reliability.md");

#[derive(Serialize)]
struct Page {
    name: String,
    design: String,
    project: String,
    result: String,
    answer: String,
    /// `pass`, `fail`, `open` or empty.
    class: &'static str,
    notes: Vec<String>,
    /// Check, utilisation at the medians, probability, interval, β by FORM, probability by FORM.
    checks: Vec<[String; 6]>,
    unjudged: Vec<[String; 2]>,
    /// Of the check that is most likely to fail.
    governing: String,
    point_note: String,
    /// Input, value in the design, median, value at the design point, α, implied factor.
    point: Vec<[String; 6]>,
    /// Input, first index, total index.
    indices: Vec<[String; 3]>,
    charts: Vec<Chart>,
    event: String,
    fragility: Vec<[String; 3]>,
    /// Key, distribution, mean, standard deviation, value in the design, origin.
    inputs: Vec<[String; 6]>,
    correlations: Vec<String>,
    /// What was done, and how much of it.
    work: Vec<[String; 2]>,
}

/// Page, charts and the file for programs.
pub fn files(told: &Told) -> Result<Vec<ReportFile>, Box<dyn std::error::Error>> {
    let Told { plan, assessed, asked, .. } = told;
    let governing = assessed.governing();
    let (answer, class) = answer(told);
    let page = Page {
        name: plan.name.clone(),
        design: plan.design.display().to_string(),
        project: told.design.design.project.name.clone(),
        result: result(told),
        answer,
        class,
        notes: notes(told),
        checks: assessed.checks.iter().map(row_of).collect(),
        unjudged: asked.unjudged.clone(),
        governing: governing.map_or(String::new(), |check| check.check.title.clone()),
        point_note: governing.map_or(String::new(), point_note),
        point: governing
            .and_then(|check| check.point.as_ref().ok())
            .map_or_else(Vec::new, |point| design_point(told, point)),
        indices: indices(told),
        charts: charts(told),
        event: told.inputs.first().map_or(String::new(), |input| words(&input.key)),
        fragility: fragility(told),
        inputs: told.inputs.iter().map(|input| input_row(told, input)).collect(),
        correlations: correlations(told),
        work: work(told),
    };
    let Rendered { html, markdown } = render_as("reliability", &page, [HTML, MARKDOWN])?;
    let mut files = vec![
        ReportFile::new("reliability.html", html),
        ReportFile::new("reliability.md", markdown),
        ReportFile::new("reliability.json", serde_json::to_string_pretty(&json(told))? + "\n"),
    ];
    files.extend(page.charts.iter().map(|chart| ReportFile::new(&chart.file, chart.alone())));
    Ok(files)
}

/// A probability with two figures.
pub fn shown(probability: f64) -> String {
    if probability.is_nan() {
        "not known".into()
    } else if probability == 0.0 || probability == 1.0 {
        format!("{probability:.0}")
    } else if probability > 0.99 {
        format!("{probability:.4}")
    } else if probability >= 0.1 {
        format!("{probability:.2}")
    } else if probability >= 0.01 {
        format!("{probability:.3}")
    } else if probability >= 0.001 {
        format!("{probability:.4}")
    } else {
        format!("{probability:.1e}")
    }
}

fn interval(probability: &Probability) -> String {
    format!("{} to {}", shown(probability.low), shown(probability.high))
}

fn index(probability: f64) -> String {
    let index = -quantile(probability);
    if index.is_finite() { format!("{index:.2}") } else { "–".into() }
}

/// A key in words, without the sections that say nothing to a reader.
fn words(key: &str) -> String {
    let heads = ["barrier.flexible_net.", "barrier.rigid_wall.", "barrier.", "flow.arrival.", "factors."];
    heads.iter().find_map(|head| key.strip_prefix(head)).unwrap_or(key).replace(['.', '_'], " ")
}

fn with_unit(value: f64, unit: &str) -> String {
    let shown = match value.abs() {
        size if size >= 1e5 => format!("{value:.3e}"),
        size if size >= 1.0 || size == 0.0 => figures(value),
        size if size >= 1e-3 => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    };
    format!("{shown} {unit}").trim().to_string()
}

fn result(told: &Told) -> String {
    let p = told.assessed.probability;
    let what = if told.plan.checks.is_empty() { "the barrier fails" } else { "one of the checks that are named fails" };
    if p.value == 0.0 {
        return format!(
            "No failure was found: the probability that {what} in this event is at most {} (95 % confidence), for the checks listed below.",
            shown(p.high)
        );
    }
    format!(
        "The probability that {what} in this event is {} (95 % interval {}; reliability index β = {}), for the checks listed below.",
        shown(p.value),
        interval(&p),
        index(p.value)
    )
}

fn answer(told: &Told) -> (String, &'static str) {
    let target = told.plan.target().map_or(String::new(), shown);
    match told.answer {
        Answer::NotAsked => (
            "No target is given, so the probability is not judged. A target (`target: 0.001`, say, from EN 1990 or the owner) makes it a verdict.".into(),
            "",
        ),
        Answer::Exceeds => (format!("FAIL: the whole interval is above the target of {target}."), "fail"),
        Answer::Undecided => (
            format!(
                "UNDECIDED: the target is {target}. {}",
                if told.assessed.probability.high > told.plan.target().unwrap_or(0.0) {
                    "It lies within the interval: more samples or runs narrow it."
                } else {
                    "The interval lies below it, but a probability alone does not pass a barrier: checks that are not judged here, loads and courses of the event that nothing covers, and formulas outside their range are not in it. The verdict of the design itself tells what is open."
                }
            ),
            "open",
        ),
    }
}

/// What the probability holds and what it does not.
fn notes(told: &Told) -> Vec<String> {
    let Told { plan, assessed, asked, .. } = told;
    let mut notes = Vec::new();
    notes.push(match plan.by {
        By::Equations => "The limit states are the guideline's equations. How far these are from the truth is not in the probability unless it is given as an input, for example a scatter of factors.load or factors.dynamic_lambda.".into(),
        By::Simulation => "The limit states are simulations; where the equations have more (surges over a deposit, the full barrier), they govern, as in the verdict of a design. The scatter of packings is in the probability; a bias of the model is not, unless it is given as an input.".into(),
    });
    notes.push(match plan.factors {
        FactorsWish::None => "All partial factors are 1 and every resistance may be used up to its full value: failure is meant, not the loss of a margin. Inputs that are not listed have the values of the design, characteristic ones where these are characteristic; a resistance that is given as a design value keeps the factor in it.".into(),
        FactorsWish::AsDesigned => "Partial factors stay as in the design: the probability is that a check fails as it is written, not that the barrier does.".into(),
    });
    notes.push(
        "The probability is that of one event. For a period, it is to be combined with how often the event comes."
            .into(),
    );
    let set = plan.set();
    if !set.is_empty() {
        let each: Vec<String> = set.iter().map(|(key, value)| format!("{key}: {}", shown_value(value))).collect();
        notes.push(format!("Other than in the design: {}.", each.join("; ")));
    }
    if !plan.checks.is_empty() {
        notes.push(format!(
            "Asked of these checks alone: {}. Others are not in the probability.",
            plan.checks.join(", ")
        ));
    }
    let partly: Vec<&str> =
        asked.checks.iter().filter(|check| check.partly.is_some()).map(|check| check.title.as_str()).collect();
    if !partly.is_empty() {
        notes.push(format!(
            "Judged only in part, because a run of the design leaves these checks open with the inputs at their medians: {}. What it leaves open is not in the probability.",
            partly.join(", ")
        ));
    }
    if !asked.unjudged.is_empty() {
        notes.push("Some checks are not judged this way and are not in the probability; they are listed below. The true probability is larger.".into());
    }
    if assessed.outside > 0 {
        notes.push(format!(
            "In {} of the samples a formula that governs is used outside the range that it is known for.",
            percent(Some(assessed.outside as f64 / assessed.samples as f64))
        ));
    }
    for (why, count) in assessed.refused.iter().take(5) {
        notes.push(format!("Samples that are no valid design and count as failed: {count} ({why}). Change what in the design refuses them, where it can be changed: bounds of the inputs (least, most) cut off a tail, and with it what fails there."));
    }
    if assessed.lost() > 0 {
        notes.push(format!(
            "Simulations that could not be relied on: {}. What happens in events like these is not known; the upper end of the interval takes all of them as failures. Why, for example: {}.",
            assessed.lost(),
            told.doubts.iter().take(3).map(String::as_str).collect::<Vec<_>>().join("; ")
        ));
    }
    if let Way::Simulations(learned) = &assessed.way
        && !learned.settled
    {
        notes.push(format!(
            "The runs allowed ({}) were used up before the interval became as narrow as asked; more runs narrow it.",
            plan.runs
        ));
    }
    if let Way::Equations { rare: Some(rare), .. } = &assessed.way
        && rare.stuck
    {
        notes.push("Subset simulation met a plateau of the utilisation, where a dissipator caps the load, and could not go on to what may fail beyond it: only the bound from plain samples is known.".into());
    }
    notes.extend(assessed.checks.iter().filter_map(form_disagrees));
    notes.extend(told.inputs.iter().filter_map(cut_off));
    notes.extend(far_from_the_design(told));
    notes
}

/// Share of a distribution that bounds may cut off without a word.
const CUT: f64 = 1e-3;

/// What the bounds of an input cut off.
fn cut_off(input: &Input) -> Option<String> {
    let cut = input.of.cut();
    (cut > CUT).then(|| {
        format!(
            "{}: its bounds cut off {} of the distribution, and what would fail there; its mean is {} with them.",
            words(&input.key),
            percent(Some(cut)),
            with_unit(input.of.moments()[0], &input.unit)
        )
    })
}

/// How many times as much as in the design the median of an input is, or the design's as much as the median, from where it is worth a word.
const FAR: f64 = 2.0;

/// Inputs whose median is far from the design's own value: mostly a slip in the unit.
fn far_from_the_design(told: &Told) -> Vec<String> {
    let medians = (told.values)(&vec![0.0; told.inputs.len()]);
    let far = |(input, median): (&Input, f64)| {
        let typed = &told.design.entries.values.get(&input.key)?.typed;
        let share = ratio(&format!("{median} {}", input.unit), typed)?;
        (!(1.0 / FAR..=FAR).contains(&share)).then(|| {
            format!(
                "{}: its median of {} is {} times what the design has ({typed}); check the number and its unit.",
                words(&input.key),
                with_unit(median, &input.unit),
                figures(share)
            )
        })
    };
    told.inputs.iter().zip(medians).filter_map(far).collect()
}

/// Where the first-order probability is outside the interval, by how much.
fn form_disagrees(check: &OfCheck) -> Option<String> {
    let by_form = check.point.as_ref().ok()?.probability();
    let found = check.probability;
    let known = found.value > 0.0 && (found.high - found.low) < found.value;
    let off = by_form / found.value;
    (known && !(found.low..=found.high).contains(&by_form) && !(0.9..=1.1).contains(&off)).then(|| {
        format!(
            "{}: the first-order method gives {} times the probability that was counted. The limit state is curved or has a kink; its β and design point are a hint alone.",
            check.check.title,
            figures(off)
        )
    })
}

fn row_of(check: &OfCheck) -> [String; 6] {
    let [beta, by_form] = match &check.point {
        Ok(point) => [format!("{:.2}", point.index), shown(point.probability())],
        // Beyond ten standard deviations.
        Err(NoPoint::TooFar) => ["> 10".into(), "–".into()],
        Err(_) => ["–".into(), "–".into()],
    };
    [
        check.check.title.clone(),
        percent(Some(check.check.at_medians)),
        shown(check.probability.value),
        interval(&check.probability),
        beta,
        by_form,
    ]
}

fn point_note(check: &OfCheck) -> String {
    match &check.point {
        Ok(_) => "Where the check that is most likely to fail would most likely fail. The factor is what the design's own value would have to be multiplied with (a load) or divided by (a resistance) to stand there: what partial factors would give this barrier the reliability that it has. Of an angle of friction it is the factor on its tangent.".into(),
        Err(why) => format!("No design point: {}.", why.words()),
    }
}

/// The value of an input in the design, where it is given with the same unit.
fn in_the_design(told: &Told, input: &Input) -> Option<f64> {
    let entry = told.design.entries.values.get(&input.key)?;
    Amount::parse(&entry.typed).filter(|amount| amount.unit == input.unit).map(|amount| amount.value)
}

/// A value as a partial factor stands on it: of an angle of friction its tangent (EN 1997-1, γ_φ), of all else itself.
fn as_factored(input: &Input, value: f64) -> f64 {
    match input.unit.as_str() {
        "deg" | "°" if input.key.contains("friction") => libm::tan(value.to_radians()),
        _ => value,
    }
}

fn design_point(told: &Told, point: &DesignPoint) -> Vec<[String; 6]> {
    let medians = (told.values)(&vec![0.0; told.inputs.len()]);
    let (there, alpha) = ((told.values)(&point.u), (told.weights)(&point.alpha));
    let row = |(number, input): (usize, &Input)| {
        let design = in_the_design(told, input);
        let factor = design.map(|design| {
            let [there, design] = [there[number], design].map(|value| as_factored(input, value));
            let (over, under) = if alpha[number] >= 0.0 { (there, design) } else { (design, there) };
            over / under
        });
        [
            words(&input.key),
            design.map_or("–".into(), |design| with_unit(design, &input.unit)),
            with_unit(medians[number], &input.unit),
            with_unit(there[number], &input.unit),
            format!("{:+.2}", alpha[number]),
            factor.filter(|factor| factor.is_finite()).map_or("–".into(), |factor| format!("{factor:.2}")),
        ]
    };
    told.inputs.iter().enumerate().map(row).collect()
}

fn indices(told: &Told) -> Vec<[String; 3]> {
    let Some(indices) = &told.assessed.importance else { return Vec::new() };
    let share = |[value, error]: [f64; 2]| format!("{:.2} ± {:.2}", value, error);
    let rows = told.inputs.iter().zip(indices);
    rows.map(|(input, indices)| [words(&input.key), share(indices.first), share(indices.total)]).collect()
}

fn charts(told: &Told) -> Vec<Chart> {
    let mut charts = Vec::new();
    let assessed = told.assessed;
    let point = assessed.governing().and_then(|check| check.point.as_ref().ok());
    let weights = point.map(|point| (told.weights)(&point.alpha));
    let mut of = Vec::new();
    if assessed.importance.is_some() {
        of.extend(["of the variance, alone", "with all others"]);
    }
    if weights.is_some() {
        of.push("α² at the design point");
    }
    if !of.is_empty() {
        let row = |(number, input): (usize, &Input)| {
            let indices = assessed.importance.as_ref().map(|indices| indices[number]);
            let shares = indices.iter().flat_map(|indices| [indices.first[0], indices.total[0]]);
            let weight = weights.as_ref().map(|weights| weights[number].powi(2));
            Row { label: words(&input.key), shares: shares.chain(weight).collect() }
        };
        let drawn = Importance { of, rows: told.inputs.iter().enumerate().map(row).collect() };
        charts.push(Chart::of(
            "Importance of the inputs",
            drawn.svg(),
            match assessed.importance {
                Some(_) => "Sobol indices tell which inputs move the largest utilisation as it scatters; α² tells which of them decide at the design point of the check that is most likely to fail.",
                None => "α² tells which inputs decide at the design point of the check that is most likely to fail. Sobol indices are told of independent inputs alone.",
            },
        ));
    }
    if assessed.fragility.len() > 1 {
        let input = &told.inputs[0];
        let values = told.plan.events();
        let of = |pick: fn(&Probability) -> f64| assessed.fragility.iter().map(pick).collect::<Vec<f64>>();
        let (middle, band) = (of(|p| p.value), [of(|p| p.low), of(|p| p.high)]);
        let along = format!("{} ({})", words(&input.key), input.unit);
        let chart = LineChart {
            title: "Probability of failure",
            unit: "–",
            factor: 1.0,
            along: &along,
            time: &values,
            series: vec![Series { label: "fails".into(), values: &middle, colour: 0 }],
            levels: told.plan.target().map(|value| Level { label: "target".into(), value }).into_iter().collect(),
            band: Some(band),
        };
        charts.push(Chart::of(
            "Fragility",
            chart.svg(),
            "The probability that the barrier fails in an event with the given value, all other inputs scattering; behind it the 95 % interval.",
        ));
    }
    charts
}

fn fragility(told: &Told) -> Vec<[String; 3]> {
    let unit = told.inputs.first().map_or("", |input| input.unit.as_str());
    let rows = told.plan.events().into_iter().zip(&told.assessed.fragility);
    rows.map(|(value, p)| [with_unit(value, unit), shown(p.value), interval(p)]).collect()
}

fn input_row(told: &Told, input: &Input) -> [String; 6] {
    let bound = |word: &str, value: Option<f64>| {
        value.map_or(String::new(), |value| format!(", {word} {}", with_unit(value, &input.unit)))
    };
    let shape =
        format!("{}{}{}", distribution(&input.of.of), bound("least", input.of.least), bound("most", input.of.most));
    let [mean, deviation] = input.of.moments();
    let design = in_the_design(told, input).map_or("–".into(), |value| with_unit(value, &input.unit));
    let origin = if input.origin.is_empty() { "not given".to_string() } else { input.origin.clone() };
    [input.key.clone(), shape, with_unit(mean, &input.unit), with_unit(deviation, &input.unit), design, origin]
}

fn correlations(told: &Told) -> Vec<String> {
    let pair = |([one, other], rank): ([String; 2], f64)| {
        format!("{} and {}: rank correlation {rank:.2}", words(&one), words(&other))
    };
    told.plan.pairs().into_iter().map(pair).collect()
}

/// What was done, and how much of it.
fn work(told: &Told) -> Vec<[String; 2]> {
    let row = |what: &str, much: String| [what.to_string(), much];
    let mut rows = match &told.assessed.way {
        Way::Equations { counted, rare } => {
            let mut rows = vec![row(
                "Monte Carlo, interval of Clopper and Pearson",
                format!("{} samples, {} of them failed", counted.samples, counted.failed),
            )];
            let share = |share: f64| percent(Some(counted.quantile(share)));
            rows.push(row(
                "Largest utilisation: median; exceeded by 5 % and by 1 % of the samples",
                format!("{}; {} and {}", share(0.5), share(0.95), share(0.99)),
            ));
            if let Some(rare) = rare {
                rows.push(row(
                    "Subset simulation of all checks and of each, because few samples failed; interval of its repeats",
                    format!("{} repeats, {} samples in all", rare.repeats, rare.evaluations),
                ));
            }
            rows
        }
        Way::Simulations(learned) => {
            let mut rows = vec![row(
                "Simulations, the later ones where the surrogate was least sure on which side of the limit they are",
                learned.runs.to_string(),
            )];
            let scatter = learned.scatter.iter().copied().fold(0.0, f64::max);
            rows.push(row(
                "Packings at the medians of the inputs; largest scatter of a utilisation between them",
                format!("{}; {}", told.plan.packings, percent(Some(scatter))),
            ));
            rows.extend(learned.history.iter().step_by((learned.history.len() / 6).max(1)).map(|(runs, p)| {
                row(&format!("Probability after {runs} simulations"), format!("{} ({})", shown(p.value), interval(p)))
            }));
            rows
        }
    };
    rows.push(row("Seed of the random numbers", told.plan.seed.to_string()));
    rows.push(row("Time taken", format!("{:.0} s", told.took)));
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_have_two_figures() {
        for (value, text) in [
            (0.0, "0"),
            (0.5234, "0.52"),
            (0.0523, "0.052"),
            (0.00123, "0.0012"),
            (3.42e-5, "3.4e-5"),
            (f64::NAN, "not known"),
        ] {
            assert_eq!(shown(value), text);
        }
        assert_eq!(words("flow.arrival.surge.velocity"), "surge velocity");
    }
}
