//! The file of a study that seeks the cheapest barrier that passes.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::design::entries::Purpose;
use crate::problem::Problem;
use crate::studies::bill::Prices;
use crate::studies::choices::{ChoiceText, Choices, MOST_COMBINATIONS};
use crate::studies::sizing::Wanted;

/// What decides whether a barrier passes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum By {
    /// The equations first, then simulations as coarse as decide it.
    #[default]
    Simulation,
    /// The equations alone, which never pass a net.
    Equations,
}

impl By {
    /// What a design has to be fit for.
    pub fn purpose(self) -> Purpose {
        match self {
            Self::Simulation => Purpose::Simulation,
            Self::Equations => Purpose::Equations,
        }
    }
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizePlan {
    #[serde(rename = "kind")]
    #[schemars(skip)]
    _kind: serde::de::IgnoredAny,
    /// What the study is called.
    pub name: String,
    /// Design file, relative to the study's own.
    pub design: PathBuf,
    #[serde(default)]
    pub by: By,
    /// Share of what every check may use that is to be left, as 0.1 or 10 %.
    #[serde(default)]
    margin: Option<String>,
    /// Further margins for each of which the cheapest is sought.
    #[serde(default)]
    front: Vec<String>,
    pub choices: Vec<ChoiceText>,
    #[serde(default)]
    pub prices: Option<Prices>,
    #[serde(default = "five")]
    packings: u32,
    #[serde(default = "many")]
    most_simulated: usize,
}

fn five() -> u32 {
    5
}

fn many() -> usize {
    100
}

/// A share as 0.1 or 10 %.
pub fn share(text: &str) -> Result<f64, Problem> {
    let (number, per) = text.trim().strip_suffix('%').map_or((text.trim(), 1.0), |number| (number.trim(), 100.0));
    let share = number.parse::<f64>().ok().map(|value| value / per);
    share.filter(|share| (0.0..1.0).contains(share)).ok_or_else(|| Problem::of(text.to_string(), "0 % to 99 %"))
}

impl SizePlan {
    pub fn prices(&self) -> Prices {
        self.prices.clone().unwrap_or_default()
    }

    pub fn wanted(&self) -> Wanted {
        Wanted {
            margin: self.margin().unwrap_or(0.0),
            by_equations: self.by == By::Equations,
            packings: self.packings,
            most_simulated: self.most_simulated,
        }
    }

    fn margin(&self) -> Result<f64, Problem> {
        self.margin.as_deref().map_or(Ok(0.0), share)
    }

    /// Margins for each of which the cheapest is sought besides.
    pub fn front(&self) -> Vec<f64> {
        self.front.iter().filter_map(|text| share(text).ok()).collect()
    }

    /// The choices; where one is wrong, nothing.
    pub fn choices(&self) -> Choices {
        Choices(self.choices.iter().filter_map(|choice| choice.choice().ok()).collect())
    }

    /// What is wrong, by the key where it stands.
    pub fn wrong(&self) -> Vec<Problem> {
        let mut wrong = Vec::new();
        wrong.extend(self.margin().err().map(|problem| problem.under("margin")));
        wrong.extend(self.front.iter().filter_map(|text| share(text).err()).map(|problem| problem.under("front")));
        if self.choices.is_empty() {
            wrong.push(Problem::new("choices", "none", "one at least"));
        }
        for (number, choice) in self.choices.iter().enumerate() {
            wrong.extend(choice.choice().err().map(|problem| problem.under(format!("choices.{number}"))));
        }
        if let Some(key) = self.choices().set_twice() {
            wrong.push(Problem::new("choices", format!("`{key}` set by two of them"), "each key in one"));
        }
        if self.choices().count().is_none_or(|count| count > MOST_COMBINATIONS) {
            wrong.push(Problem::new(
                "choices",
                "more ways to combine them",
                format!("{MOST_COMBINATIONS} at the most"),
            ));
        }
        if !(1..=100).contains(&self.packings) {
            wrong.push(Problem::new("packings", self.packings.to_string(), "1 to 100"));
        }
        if !(1..=10_000).contains(&self.most_simulated) {
            wrong.push(Problem::new("most_simulated", self.most_simulated.to_string(), "1 to 10000"));
        }
        let items = self.prices().items;
        if (1..items.len()).any(|number| items[..number].iter().any(|before| before.of == items[number].of)) {
            wrong.push(Problem::new("prices.items", "a quantity that is priced twice", "each once"));
        }
        for (number, item) in items.iter().enumerate() {
            // Asked so that what is not a number is refused.
            if !(0.0..=1e9).contains(&item.price) {
                wrong.push(
                    Problem::of(item.price.to_string(), "0 to 1e9").under(format!("prices.items.{number}.price")),
                );
            }
        }
        if self.prices().items.is_empty() {
            wrong.push(Problem::new("prices.items", "none", "one at least"));
        }
        wrong
    }
}
