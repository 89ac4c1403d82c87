//! The file of a study that asks how probable a failure is.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_yaml::Value;

use crate::design::document::Node;
use crate::problem::Problem;
use crate::reliability::distribution::{Bounded, Distribution};
use crate::reliability::inputs::{Correlation, Inputs};
use crate::studies::amount::{Amount, node, shown};
use crate::studies::size_plan::{By, share};

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReliabilityPlan {
    #[serde(rename = "kind")]
    #[schemars(skip)]
    _kind: serde::de::IgnoredAny,
    /// What the study is called.
    pub name: String,
    /// Design file, relative to the study's own.
    pub design: PathBuf,
    #[serde(default)]
    pub by: By,
    /// Values of the design that are others here.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, serde_json::Value>")]
    set: BTreeMap<String, Value>,
    #[serde(default)]
    pub factors: FactorsWish,
    pub inputs: Vec<InputText>,
    #[serde(default)]
    correlations: Vec<CorrelationText>,
    /// Checks, by their id in result.json, that are asked of; all where none is named.
    #[serde(default)]
    pub checks: Vec<String>,
    #[serde(default)]
    target: Option<f64>,
    #[serde(default)]
    fragility: Option<FragilityText>,
    #[serde(default = "samples")]
    pub samples: usize,
    #[serde(default)]
    accuracy: Option<String>,
    #[serde(default = "runs")]
    pub runs: usize,
    #[serde(default = "packings")]
    pub packings: usize,
    #[serde(default = "seed")]
    pub seed: u64,
}

fn samples() -> usize {
    20_000
}

fn runs() -> usize {
    60
}

fn packings() -> usize {
    5
}

fn seed() -> u64 {
    1
}

/// What becomes of the partial factors of the design.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FactorsWish {
    /// All are 1, and every resistance may be used up: what they allow for is in the distributions.
    #[default]
    None,
    /// They stay, and the probability is that of a check that fails as it is written.
    AsDesigned,
}

/// An input with its distribution, as the file has it.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InputText {
    pub key: String,
    normal: Option<MomentsText>,
    lognormal: Option<MomentsText>,
    gumbel: Option<MomentsText>,
    uniform: Option<EndsText>,
    triangular: Option<TriangleText>,
    table: Option<TableText>,
    #[schemars(with = "Option<serde_json::Value>")]
    least: Option<Value>,
    #[schemars(with = "Option<serde_json::Value>")]
    most: Option<Value>,
    #[serde(default)]
    pub origin: String,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MomentsText {
    #[schemars(with = "serde_json::Value")]
    mean: Value,
    #[schemars(with = "Option<serde_json::Value>")]
    deviation: Option<Value>,
    /// Standard deviation over mean.
    #[schemars(with = "Option<serde_json::Value>")]
    variation: Option<Value>,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct EndsText {
    #[schemars(with = "serde_json::Value")]
    from: Value,
    #[schemars(with = "serde_json::Value")]
    to: Value,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct TriangleText {
    #[schemars(with = "serde_json::Value")]
    from: Value,
    #[schemars(with = "serde_json::Value")]
    mode: Value,
    #[schemars(with = "serde_json::Value")]
    to: Value,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct TableText {
    #[schemars(with = "Vec<serde_json::Value>")]
    values: Vec<Value>,
    cumulative: Vec<f64>,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CorrelationText {
    between: [String; 2],
    rank: f64,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct FragilityText {
    key: String,
    #[schemars(with = "Vec<serde_json::Value>")]
    values: Vec<Value>,
}

/// An input as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    pub key: String,
    pub of: Bounded,
    pub unit: String,
    pub origin: String,
}

/// Turns values of one input into numbers of its one unit.
#[derive(Default)]
struct Units(Option<String>);

impl Units {
    fn take(&mut self, value: &Value) -> Result<f64, Problem> {
        let allowed = || Problem::of(shown(&node(value)).to_string(), "a number with its unit, as in the design");
        let amount = Amount::of(value).ok_or_else(allowed)?;
        match self.0.get_or_insert_with(|| amount.unit.clone()) {
            unit if *unit == amount.unit => Ok(amount.value),
            unit if unit.is_empty() => {
                Err(Problem::of(shown(&node(value)).to_string(), "a plain number like the values before it"))
            }
            unit => {
                Err(Problem::of(shown(&node(value)).to_string(), format!("the unit of the values before it, {unit}")))
            }
        }
    }
}

impl InputText {
    /// The input, or what is wrong with it.
    pub fn input(&self) -> Result<Input, Problem> {
        if self.key.split('.').any(str::is_empty) {
            return Err(Problem::of(format!("the key `{}`", self.key), "one such as flow.arrival.surge.velocity"));
        }
        let mut units = Units::default();
        let mut found = Vec::new();
        if let Some(text) = &self.normal {
            let [mean, deviation] = text.moments(&mut units)?;
            found.push(Distribution::Normal { mean, deviation });
        }
        if let Some(text) = &self.lognormal {
            let [mean, deviation] = text.moments(&mut units)?;
            found.push(Distribution::Lognormal { mean, deviation });
        }
        if let Some(text) = &self.gumbel {
            let [mean, deviation] = text.moments(&mut units)?;
            found.push(Distribution::Gumbel { mean, deviation });
        }
        if let Some(text) = &self.uniform {
            found.push(Distribution::Uniform { from: units.take(&text.from)?, to: units.take(&text.to)? });
        }
        if let Some(text) = &self.triangular {
            let [from, mode, to] = [units.take(&text.from)?, units.take(&text.mode)?, units.take(&text.to)?];
            found.push(Distribution::Triangular { from, mode, to });
        }
        if let Some(text) = &self.table {
            if text.values.len() != text.cumulative.len() {
                let [values, shares] = [text.values.len(), text.cumulative.len()];
                return Err(Problem::of(
                    format!("{values} values and {shares} cumulative probabilities"),
                    "as many of both",
                ));
            }
            let values = text.values.iter().map(|value| units.take(value)).collect::<Result<Vec<_>, _>>()?;
            let rows = values.into_iter().zip(&text.cumulative).map(|(value, share)| [value, *share]);
            found.push(Distribution::Table(rows.collect()));
        }
        let [of] = <[Distribution; 1]>::try_from(found).map_err(|found| {
            Problem::of(
                format!("{} distributions", found.len()),
                "one of normal, lognormal, gumbel, uniform, triangular, table",
            )
        })?;
        let mut bound = |value: &Option<Value>| value.as_ref().map(|value| units.take(value)).transpose();
        let of = Bounded { of, least: bound(&self.least)?, most: bound(&self.most)? };
        if let Some(allowed) = of.wrong() {
            return Err(Problem::of("numbers that make no such distribution", allowed.to_string()));
        }
        let unit = units.0.unwrap_or_default();
        Ok(Input { key: self.key.clone(), of, unit, origin: self.origin.clone() })
    }
}

impl MomentsText {
    /// Mean and standard deviation.
    fn moments(&self, units: &mut Units) -> Result<[f64; 2], Problem> {
        let mean = units.take(&self.mean)?;
        match (&self.deviation, &self.variation) {
            (Some(deviation), None) => Ok([mean, units.take(deviation)?]),
            (None, Some(variation)) => Ok([mean, share(&shown(&node(variation)))? * mean.abs()]),
            _ => Err(Problem::of("a mean without its scatter, or with two", "one of deviation and variation")),
        }
    }
}

impl ReliabilityPlan {
    /// The inputs, that of the fragility first, so that what hangs on it follows it; where one is wrong, nothing.
    pub fn list(&self) -> Vec<Input> {
        let first = |input: &Input| self.fragility.as_ref().is_none_or(|fragility| fragility.key != input.key);
        let mut list: Vec<Input> = self.inputs.iter().filter_map(|input| input.input().ok()).collect();
        list.sort_by_key(first);
        list
    }

    /// Values of the design that are others here.
    pub fn set(&self) -> Vec<(String, Node)> {
        self.set.iter().map(|(key, value)| (key.clone(), node(value))).collect()
    }

    /// Their distributions together; nothing where their correlations cannot be.
    pub fn together(&self) -> Option<Inputs> {
        let list = self.list();
        let place = |key: &String| list.iter().position(|input| input.key == *key);
        let pair = |text: &CorrelationText| Some((place(&text.between[0])?, place(&text.between[1])?, text.rank));
        let pairs: Vec<Correlation> = self.correlations.iter().filter_map(pair).collect();
        Inputs::new(list.into_iter().map(|input| input.of).collect(), &pairs)
    }

    /// Correlations as the report lists them.
    pub fn pairs(&self) -> Vec<([String; 2], f64)> {
        self.correlations.iter().map(|text| (text.between.clone(), text.rank)).collect()
    }

    /// Probability that must not be exceeded.
    pub fn target(&self) -> Option<f64> {
        self.target
    }

    /// Coefficient of variation, or half the width of the interval, that is enough.
    pub fn accuracy(&self) -> f64 {
        self.accuracy.as_deref().and_then(|text| share(text).ok()).unwrap_or(0.1)
    }

    /// Values of the first input for which the probability is told; none where no fragility is asked for.
    pub fn events(&self) -> Vec<f64> {
        let values = self.fragility.iter().flat_map(|fragility| &fragility.values);
        values.filter_map(|value| Amount::of(value).map(|amount| amount.value)).collect()
    }

    /// What is wrong, by the key where it stands.
    pub fn wrong(&self) -> Vec<Problem> {
        let mut wrong = Vec::new();
        if self.inputs.is_empty() || self.inputs.len() > MOST_INPUTS {
            wrong.push(Problem::new("inputs", self.inputs.len().to_string(), format!("1 to {MOST_INPUTS}")));
        }
        for (number, input) in self.inputs.iter().enumerate() {
            wrong.extend(input.input().err().map(|problem| problem.under(format!("inputs.{number}"))));
            let within =
                |key: &str, of: &str| key.strip_prefix(of).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
            let before = self.inputs[..number].iter().map(|before| &before.key);
            if before.into_iter().any(|before| within(before, &input.key) || within(&input.key, before)) {
                wrong.push(Problem::new(format!("inputs.{number}"), format!("`{}` twice", input.key), "each key once"));
            }
        }
        if let Some(key) = self.set.keys().find(|key| self.inputs.iter().any(|input| input.key == **key)) {
            wrong.push(Problem::new(format!("set.{key}"), "an input", "a key that does not scatter"));
        }
        self.wrong_correlations(&mut wrong);
        self.wrong_fragility(&mut wrong);
        if let Some(target) = self.target.filter(|target| !(*target > 0.0 && *target < 1.0)) {
            wrong.push(Problem::new("target", format!("{target}"), "a probability above 0 and below 1"));
        }
        let accuracy = self.accuracy.as_deref().map(share);
        if accuracy.as_ref().is_some_and(|share| !share.as_ref().is_ok_and(|share| *share >= 0.01)) {
            wrong.push(Problem::new("accuracy", "no share", "1 % to 99 %"));
        }
        // A surrogate with a plane beneath needs more points than the plane has slopes.
        let least = self.packings + 2 * self.inputs.len() + 5;
        let ranges = [
            ("samples", self.samples, 100, 100_000_000),
            ("runs", self.runs, least.max(15), 10_000),
            ("packings", self.packings, 2, 50),
        ];
        for (key, found, least, most) in ranges {
            if !(least..=most).contains(&found) {
                wrong.push(Problem::new(key, found.to_string(), format!("{least} to {most}")));
            }
        }
        wrong
    }

    fn wrong_correlations(&self, wrong: &mut Vec<Problem>) {
        for (number, text) in self.correlations.iter().enumerate() {
            let [one, other_key] = &text.between;
            let known = |key: &String| self.inputs.iter().any(|input| input.key == *key);
            if one == other_key || !known(one) || !known(other_key) {
                wrong.push(Problem::new(
                    format!("correlations.{number}"),
                    format!("{one} and {other_key}"),
                    "two of the inputs",
                ));
            }
            let same = |other: &CorrelationText| other.between.contains(one) && other.between.contains(other_key);
            if self.correlations[..number].iter().any(same) {
                wrong.push(Problem::new(format!("correlations.{number}"), "a pair again", "each once"));
            }
            // Asked so that what is not a number is refused.
            if !(-1.0..=1.0).contains(&text.rank) {
                wrong.push(Problem::new(format!("correlations.{number}.rank"), text.rank.to_string(), "-1 to 1"));
            }
        }
        if wrong.is_empty() && self.together().is_none() {
            wrong.push(Problem::new(
                "correlations",
                "correlations that no inputs can have at once, or of two inputs that are one",
                "a positive definite matrix",
            ));
        }
    }

    fn wrong_fragility(&self, wrong: &mut Vec<Problem>) {
        let Some(fragility) = &self.fragility else { return };
        let Some(Ok(input)) = self.inputs.iter().find(|input| input.key == fragility.key).map(InputText::input) else {
            wrong.push(Problem::new("fragility.key", fragility.key.to_string(), "one of the inputs"));
            return;
        };
        if fragility.values.is_empty() || fragility.values.len() > MOST_EVENTS {
            let found = fragility.values.len();
            wrong.push(Problem::new("fragility.values", format!("{found}"), format!("1 to {MOST_EVENTS}")));
        }
        for (number, value) in fragility.values.iter().enumerate() {
            let amount = Amount::of(value).filter(|amount| amount.unit == input.unit);
            if amount.is_none_or(|amount| !input.of.score(amount.value).is_finite()) {
                let found = shown(&node(value));
                wrong.push(
                    Problem::of(found.to_string(), format!("a value of its distribution with the unit {}", input.unit))
                        .under(format!("fragility.values.{number}")),
                );
            }
        }
    }
}

const MOST_INPUTS: usize = 30;
const MOST_EVENTS: usize = 50;
