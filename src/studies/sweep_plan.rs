//! The file of a study that runs designs with other values of some keys.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_yaml::Value;

use crate::design::changes::Changes;
use crate::design::document::Node;
use crate::problem::Problem;
use crate::studies::amount::node;
use crate::studies::choices::{ChoiceText, Choices, ChosenOption};
use crate::studies::size_plan::By;

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepPlan {
    #[serde(rename = "kind")]
    #[schemars(skip)]
    _kind: serde::de::IgnoredAny,
    /// What the study is called.
    pub name: String,
    /// Design files, relative to the study's own.
    pub designs: Vec<PathBuf>,
    #[serde(default)]
    pub by: By,
    /// Packings of each run.
    #[serde(default = "one")]
    pub packings: u32,
    /// Values of the designs that are others here.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, serde_json::Value>")]
    set: BTreeMap<String, Value>,
    vary: Vec<ChoiceText>,
    #[serde(default)]
    combine: Combine,
}

fn one() -> u32 {
    1
}

/// How the values of several keys go together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Combine {
    /// Each with each.
    #[default]
    Grid,
    /// The first of each, the second of each, and so on.
    List,
}

/// Runs of one study at the most.
const MOST_RUNS: usize = 200_000;

impl SweepPlan {
    /// What is varied; where something is wrong, nothing.
    pub fn choices(&self) -> Choices {
        Choices(self.vary.iter().filter_map(|choice| choice.choice().ok()).collect())
    }

    /// How many ways there are to take one option of each.
    pub fn ways(&self, choices: &Choices) -> Option<usize> {
        match self.combine {
            Combine::Grid => choices.count(),
            Combine::List => choices.0.first().map(|choice| choice.options.len()),
        }
    }

    /// The options of one of them.
    pub fn options<'a>(&self, choices: &'a Choices, way: usize) -> Vec<&'a ChosenOption> {
        match self.combine {
            Combine::Grid => choices.options(way),
            Combine::List => choices.0.iter().filter_map(|choice| choice.options.get(way)).collect(),
        }
    }

    /// What one of them changes.
    pub fn changes(&self, choices: &Choices, way: usize) -> Changes {
        let set = self.set.iter().map(|(key, value)| (key.clone(), node(value)));
        let chosen = self.options(choices, way).into_iter().flat_map(|option| option.changes().iter().cloned());
        Changes::new(set.chain(chosen).collect::<Vec<(String, Node)>>())
    }

    /// What is wrong, by the key where it stands.
    pub fn wrong(&self) -> Vec<Problem> {
        let mut wrong = Vec::new();
        if self.designs.is_empty() {
            wrong.push(Problem::new("designs", "none", "one at least"));
        }
        let names: Vec<_> = self.designs.iter().map(|design| design.file_stem()).collect();
        if (1..names.len()).any(|place| names[..place].contains(&names[place])) {
            wrong.push(Problem::new(
                "designs",
                "two with the same file name",
                "files of different names, which can be told apart",
            ));
        }
        if self.vary.is_empty() {
            wrong.push(Problem::new("vary", "nothing", "one key at least"));
        }
        for (number, choice) in self.vary.iter().enumerate() {
            wrong.extend(choice.choice().err().map(|problem| problem.under(format!("vary.{number}"))));
        }
        let choices = self.choices();
        if let Some(key) = choices.set_twice() {
            wrong.push(Problem::new("vary", format!("`{key}` set by two of them"), "each key in one"));
        }
        let lengths: Vec<usize> = choices.0.iter().map(|choice| choice.options.len()).collect();
        if self.combine == Combine::List && lengths.windows(2).any(|pair| pair[0] != pair[1]) {
            wrong.push(Problem::new("combine", format!("lists of {lengths:?} values"), "as many in each"));
        }
        let runs = self.ways(&choices).and_then(|ways| ways.checked_mul(self.designs.len()));
        if runs.is_none_or(|runs| runs > MOST_RUNS) {
            wrong.push(Problem::new("vary", "more runs", format!("{MOST_RUNS} at the most")));
        }
        if !(1..=100).contains(&self.packings) {
            wrong.push(Problem::new("packings", self.packings.to_string(), "1 to 100"));
        }
        wrong
    }
}
