//! `reliability.json`: the contract that other programs script against. Fields may be added, never renamed.

use schemars::JsonSchema;
use serde::Serialize;

use crate::program::PROGRAM;
use crate::reliability::Probability;
use crate::report::assessment::{Told, distribution};
use crate::studies::reliability::{Answer, OfCheck};
use crate::studies::reliability_plan::{FactorsWish, Input};
use crate::studies::size_plan::By;

#[derive(Serialize, JsonSchema)]
pub struct ReliabilityFile {
    schema_version: u32,
    name: String,
    design: String,
    /// equations or simulation
    by: &'static str,
    /// Whether partial factors stay as in the design; else all are 1.
    partial_factors: bool,
    target: Option<f64>,
    /// not_asked, exceeds or undecided
    answer: String,
    probability: ProbabilityPart,
    /// Reliability index, -Phi^-1(probability); absent where no failure was found.
    reliability_index: Option<f64>,
    checks: Vec<CheckPart>,
    /// Titles of checks that are not in the probability.
    unjudged: Vec<String>,
    inputs: Vec<InputPart>,
    fragility: Vec<EventPart>,
    /// Samples of the equations, or simulations.
    samples: usize,
    /// Samples that are no valid design and count as failed.
    refused: usize,
    /// Samples in which a formula was used outside its range.
    outside_range: usize,
    /// Simulations that could not be relied on.
    unreliable: usize,
    seed: u64,
    /// The program that made this file, with version and commit.
    program: String,
}

/// With the interval that holds it with a confidence of 95 %.
#[derive(Serialize, JsonSchema)]
struct ProbabilityPart {
    value: f64,
    low: f64,
    high: f64,
}

#[derive(Serialize, JsonSchema)]
struct CheckPart {
    id: String,
    title: String,
    utilisation_at_medians: f64,
    probability: ProbabilityPart,
    /// By the first-order method; absent where it finds no design point.
    form_index: Option<f64>,
    /// Values of the inputs at the design point, in their units and in the order of `inputs`.
    design_point: Vec<f64>,
    /// Weights of the inputs there; positive where larger values fail.
    alpha: Vec<f64>,
}

#[derive(Serialize, JsonSchema)]
struct InputPart {
    key: String,
    unit: String,
    distribution: String,
    mean: f64,
    standard_deviation: f64,
    origin: String,
    /// Sobol indices of the largest utilisation; absent where inputs are correlated.
    sobol_first: Option<f64>,
    sobol_total: Option<f64>,
}

#[derive(Serialize, JsonSchema)]
struct EventPart {
    /// Of the first input, in its unit.
    value: f64,
    probability: ProbabilityPart,
}

/// What the file says.
pub fn json(told: &Told) -> ReliabilityFile {
    let Told { plan, assessed, .. } = told;
    let part = |p: &Probability| ProbabilityPart { value: p.value, low: p.low, high: p.high };
    let check = |check: &OfCheck| {
        let point = check.point.as_ref().ok();
        CheckPart {
            id: check.check.id.clone(),
            title: check.check.title.clone(),
            utilisation_at_medians: check.check.at_medians,
            probability: part(&check.probability),
            form_index: point.map(|point| point.index),
            design_point: point.map_or_else(Vec::new, |point| (told.values)(&point.u)),
            alpha: point.map_or_else(Vec::new, |point| (told.weights)(&point.alpha)),
        }
    };
    let input = |(number, input): (usize, &Input)| {
        let [mean, standard_deviation] = input.of.moments();
        let indices = assessed.importance.as_ref().map(|indices| indices[number]);
        InputPart {
            key: input.key.clone(),
            unit: input.unit.clone(),
            distribution: distribution(&input.of.of).into(),
            mean,
            standard_deviation,
            origin: input.origin.clone(),
            sobol_first: indices.map(|indices| indices.first[0]),
            sobol_total: indices.map(|indices| indices.total[0]),
        }
    };
    ReliabilityFile {
        schema_version: 1,
        name: plan.name.clone(),
        design: plan.design.display().to_string(),
        by: match plan.by {
            By::Equations => "equations",
            By::Simulation => "simulation",
        },
        partial_factors: plan.factors == FactorsWish::AsDesigned,
        target: plan.target(),
        answer: match told.answer {
            Answer::NotAsked => "not_asked",
            Answer::Exceeds => "exceeds",
            Answer::Undecided => "undecided",
        }
        .into(),
        probability: part(&assessed.probability),
        reliability_index: Some(assessed.probability.index()).filter(|index| index.is_finite()),
        checks: assessed.checks.iter().map(check).collect(),
        unjudged: told.asked.unjudged.iter().map(|[title, _]| title.clone()).collect(),
        inputs: told.inputs.iter().enumerate().map(input).collect(),
        fragility: plan
            .events()
            .into_iter()
            .zip(&assessed.fragility)
            .map(|(value, p)| EventPart { value, probability: part(p) })
            .collect(),
        samples: assessed.samples,
        refused: assessed.refused.values().sum(),
        outside_range: assessed.outside,
        unreliable: assessed.lost(),
        seed: plan.seed,
        program: PROGRAM.into(),
    }
}
