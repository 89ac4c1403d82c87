//! What a study may change of a design: keys with their values, and all ways to put them together.

use std::collections::{BTreeMap, BTreeSet};

use schemars::JsonSchema;
use serde::Deserialize;
use serde_yaml::Value;

use crate::design::changes::Changes;
use crate::design::document::Node;
use crate::problem::Problem;
use crate::studies::amount::{Amount, node, shown};

/// One choice as a study file has it: a key with its values or with a range of them, or options that set several keys at once.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ChoiceText {
    key: Option<String>,
    #[schemars(with = "Option<Vec<serde_json::Value>>")]
    values: Option<Vec<Value>>,
    from: Option<String>,
    to: Option<String>,
    step: Option<String>,
    name: Option<String>,
    #[schemars(with = "Option<Vec<BTreeMap<String, serde_json::Value>>>")]
    options: Option<Vec<BTreeMap<String, Value>>>,
}

/// A choice: what it is of, and its options.
#[derive(Clone, Debug)]
pub struct Choice {
    pub name: String,
    pub options: Vec<ChosenOption>,
}

/// An option of a choice, as a table shows it and as it changes the design.
#[derive(Clone, Debug)]
pub struct ChosenOption {
    pub label: String,
    changes: Vec<(String, Node)>,
}

/// The key of an option that is its label.
const LABEL: &str = "label";
/// Values of a range at the most, and ways to put choices together.
const MOST_OF_A_RANGE: f64 = 1000.0;
pub const MOST_COMBINATIONS: usize = 200_000;

impl ChoiceText {
    /// The choice, or what is wrong with it.
    pub fn choice(&self) -> Result<Choice, Problem> {
        let range = [&self.from, &self.to, &self.step];
        let has_range = range.iter().any(|end| end.is_some());
        match (&self.key, &self.name, &self.values, &self.options) {
            (Some(key), None, Some(values), None) if !has_range => of_values(key, values),
            (Some(key), None, None, None) => match range {
                [Some(from), Some(to), Some(step)] => of_range(key, [from, to, step]),
                _ => Err(Problem::of("a key alone", "a key with values, or with from, to and step")),
            },
            (None, Some(name), None, Some(options)) if !has_range => of_options(name, options),
            _ => Err(Problem::of(
                "another mixture of keys",
                "key with values; key with from, to and step; or name with options",
            )),
        }
    }
}

fn of_values(key: &str, values: &[Value]) -> Result<Choice, Problem> {
    let option = |value: &Value| {
        let node = node(value);
        ChosenOption { label: shown(&node), changes: vec![(key.to_string(), node)] }
    };
    named(key, values.iter().map(option).collect())
}

/// From one end to the other, both included, in the unit that all three have.
fn of_range(key: &str, ends: [&str; 3]) -> Result<Choice, Problem> {
    let [Some(first), Some(last), Some(by)] = ends.map(Amount::parse) else {
        return Err(Problem::of(format!("{}, {} and {}", ends[0], ends[1], ends[2]), "numbers with one unit"));
    };
    let (from, to, step, unit) = (first.value, last.value, by.value, first.unit);
    if unit != last.unit || unit != by.unit {
        return Err(Problem::of(format!("{}, {} and {}", ends[0], ends[1], ends[2]), "the same unit in all three"));
    }
    let count = (to - from) / step;
    if !(step > 0.0 && (0.0..=MOST_OF_A_RANGE).contains(&count)) {
        return Err(Problem::of(format!("{} to {} by {}", ends[0], ends[1], ends[2]), "1 to 1000 rising values"));
    }
    if (count - count.round()).abs() > 1e-6 {
        let last = from + count.floor() * step;
        let found = format!("{} to {} by {}", ends[0], ends[1], ends[2]);
        let allowed = format!("a step that leads to the end: the last value would be {last:.9}");
        return Err(Problem::of(found, allowed.trim_end_matches('0').trim_end_matches('.')));
    }
    let option = |number: usize| {
        // Without the digits that a binary fraction adds.
        let value = format!("{:.9}", from + number as f64 * step);
        let value = value.trim_end_matches('0').trim_end_matches('.');
        let label = format!("{value} {unit}").trim().to_string();
        let node = match value.parse::<f64>() {
            Ok(number) if unit.is_empty() => Node::Number(number),
            _ => Node::Text(label.clone()),
        };
        ChosenOption { changes: vec![(key.to_string(), node)], label }
    };
    named(key, (0..=(count + 1e-9) as usize).map(option).collect())
}

fn of_options(name: &str, options: &[BTreeMap<String, Value>]) -> Result<Choice, Problem> {
    let option = |option: &BTreeMap<String, Value>| {
        let changes: Vec<(String, Node)> =
            option.iter().filter(|(key, _)| *key != LABEL).map(|(key, value)| (key.clone(), node(value))).collect();
        let told = || changes.iter().map(|(_, node)| shown(node)).collect::<Vec<_>>().join(", ");
        let label = option.get(LABEL).map_or_else(told, |label| shown(&node(label)));
        ChosenOption { label, changes }
    };
    named(name, options.iter().map(option).collect())
}

fn named(name: &str, options: Vec<ChosenOption>) -> Result<Choice, Problem> {
    if options.is_empty() {
        return Err(Problem::of("no option", "one at least"));
    }
    // One that only has a label is the design as it is.
    if options.iter().any(|option| option.changes.is_empty() && option.label.is_empty()) {
        return Err(Problem::of(
            "an option that changes nothing",
            "one with keys, or with a label for the design as it is",
        ));
    }
    let paths = options.iter().flat_map(|option| option.changes.iter().map(|(path, _)| path));
    if let Some(path) = paths.into_iter().find(|path| path.is_empty() || path.split('.').any(str::is_empty)) {
        return Err(Problem::of(format!("the key `{path}`"), "one such as barrier.flexible_net.anchors.resistance"));
    }
    Ok(Choice { name: name.to_string(), options })
}

impl ChosenOption {
    /// What it changes, by key.
    pub fn changes(&self) -> &[(String, Node)] {
        &self.changes
    }
}

impl Choice {
    /// Keys that its options set.
    pub fn keys(&self) -> BTreeSet<&str> {
        self.options.iter().flat_map(|option| option.changes.iter().map(|(path, _)| path.as_str())).collect()
    }
}

/// All ways to put choices together.
#[derive(Clone, Debug)]
pub struct Choices(pub Vec<Choice>);

impl Choices {
    /// How many ways there are; nothing where these are more than can be counted.
    pub fn count(&self) -> Option<usize> {
        self.0.iter().try_fold(1_usize, |count, choice| count.checked_mul(choice.options.len()))
    }

    /// A key that two choices set, or of which one sets a key below it: the later one would take the place of the other.
    pub fn set_twice(&self) -> Option<String> {
        let within =
            |key: &str, of: &str| key.strip_prefix(of).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
        self.0.iter().enumerate().find_map(|(number, choice)| {
            let others = self.0[..number].iter().flat_map(Choice::keys);
            others.into_iter().find_map(|other| {
                choice.keys().into_iter().find(|key| within(key, other) || within(other, key)).map(String::from)
            })
        })
    }

    /// The options of one of them, the last choice turning fastest.
    pub fn options(&self, number: usize) -> Vec<&ChosenOption> {
        let mut left = number;
        let mut options: Vec<&ChosenOption> = Vec::new();
        for choice in self.0.iter().rev() {
            options.push(&choice.options[left % choice.options.len()]);
            left /= choice.options.len();
        }
        options.reverse();
        options
    }

    /// What one of them changes.
    pub fn changes(&self, number: usize) -> Changes {
        Changes::new(self.options(number).into_iter().flat_map(|option| option.changes.clone()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Choice, Problem> {
        serde_yaml::from_str::<ChoiceText>(text).expect("a choice").choice()
    }

    fn labels(choice: &Choice) -> Vec<&str> {
        choice.options.iter().map(|option| option.label.as_str()).collect()
    }

    #[test]
    fn a_range_has_both_of_its_ends_and_no_digits_of_its_own() {
        let range = read("{key: a.b, from: 0.1 m, to: 0.4 m, step: 0.1 m}").unwrap();
        assert_eq!(labels(&range), ["0.1 m", "0.2 m", "0.3 m", "0.4 m"]);
        assert_eq!(labels(&read("{key: a, from: '1', to: '3', step: '1'}").unwrap()), ["1", "2", "3"]);
        for (wrong, told) in [
            ("{key: a, from: 1 m, to: 2 kN, step: 1 m}", "the same unit"),
            ("{key: a, from: 2 m, to: 1 m, step: 1 m}", "rising"),
            ("{key: a, from: 1 m, to: 2 m, step: 0 m}", "rising"),
            ("{key: a, from: few, to: 2 m, step: 1 m}", "numbers"),
            ("{key: a, from: 1 m}", "a key alone"),
            ("{key: a, values: []}", "no option"),
            ("{key: a..b, values: [1]}", "the key"),
            ("{name: a, values: [1]}", "another mixture"),
        ] {
            let found = read(wrong).unwrap_err();
            let found = format!("found {}, allowed {}", found.found, found.allowed);
            assert!(found.contains(told), "{wrong}: {found}");
        }
    }

    #[test]
    fn the_last_choice_turns_fastest() {
        let choices = Choices(vec![
            read("{key: a, values: [x, y]}").unwrap(),
            read("{name: b, options: [{label: one, p: 1 m, q: 2}, {p: 3 m, q: 4}]}").unwrap(),
        ]);
        assert_eq!(choices.count(), Some(4));
        let of = |number| choices.options(number).iter().map(|option| option.label.clone()).collect::<Vec<_>>();
        assert_eq!([of(0), of(1), of(2)], [["x", "one"], ["x", "3 m, 4"], ["y", "one"]]);
        let changes = choices.changes(1);
        assert_eq!(choices.set_twice(), None);
        let twice = Choices(vec![read("{key: a.b, values: [1]}").unwrap(), read("{key: a.b.c, values: [1]}").unwrap()]);
        assert_eq!(twice.set_twice().as_deref(), Some("a.b.c"));
        assert!(changes.has("a") && changes.has("p") && changes.has("q") && !changes.has("label"));
    }
}
