//! Values of a study file: numbers with a unit, and what a design has in their place.

use serde_yaml::Value;

use crate::design::document::Node;

/// A number and the unit it was typed with, which may be none.
#[derive(Clone, Debug, PartialEq)]
pub struct Amount {
    pub value: f64,
    pub unit: String,
}

impl Amount {
    /// Reads `4.6 m/s` or a plain number.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let end =
            text.find(|letter: char| !(letter.is_ascii_digit() || "+-.eE".contains(letter))).unwrap_or(text.len());
        // The e of a unit is none of the number.
        let number = text[..end].trim_end_matches(['e', 'E']);
        let value = number.parse::<f64>().ok().filter(|value| value.is_finite())?;
        Some(Self { value, unit: text[number.len()..].trim().to_string() })
    }

    /// The same of a value of the file.
    pub fn of(value: &Value) -> Option<Self> {
        match value {
            Value::String(text) => Self::parse(text),
            Value::Number(number) => {
                let value = number.as_f64().filter(|value| value.is_finite())?;
                Some(Self { value, unit: String::new() })
            }
            _ => None,
        }
    }

    /// As a design file has it.
    pub fn node(&self) -> Node {
        match self.unit.as_str() {
            "" => Node::Number(self.value),
            unit => Node::Text(format!("{} {unit}", self.value)),
        }
    }
}

/// A value of a study file as a design has it.
pub fn node(value: &Value) -> Node {
    match value {
        Value::Null => Node::Nothing,
        Value::Bool(flag) => Node::Flag(*flag),
        Value::Number(number) => Node::Number(number.as_f64().unwrap_or(f64::NAN)),
        Value::String(text) => Node::Text(text.clone()),
        Value::Sequence(items) => Node::List(items.iter().map(node).collect()),
        Value::Mapping(keys) => {
            let key = |key: &Value| match node(key) {
                Node::Text(text) => text,
                other => shown(&other),
            };
            Node::Map(keys.iter().map(|(name, value)| (key(name), node(value))).collect())
        }
        Value::Tagged(tagged) => node(&tagged.value),
    }
}

/// A value as a table shows it.
pub fn shown(node: &Node) -> String {
    match node {
        Node::Text(text) => text.clone(),
        Node::Number(number) => number.to_string(),
        Node::Flag(flag) => flag.to_string(),
        Node::Nothing => "left out".into(),
        Node::List(items) => items.iter().map(shown).collect::<Vec<_>>().join(", "),
        Node::Map(keys) => {
            keys.iter().map(|(name, value)| format!("{name} {}", shown(value))).collect::<Vec<_>>().join(", ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_keeps_its_unit() {
        let read = |text: &str| Amount::parse(text).map(|Amount { value, unit }| (value, unit));
        assert_eq!(read("4.6 m/s"), Some((4.6, "m/s".into())));
        assert_eq!(read("-1e3"), Some((-1000.0, String::new())));
        assert_eq!(read("15 %"), Some((15.0, "%".into())));
        assert_eq!(read("3 each"), Some((3.0, "each".into())));
        assert_eq!((read("much"), read(""), read("1e999")), (None, None, None));
        let node = Amount { value: 0.1 + 0.2, unit: "m".into() }.node();
        assert_eq!(node, Node::Text("0.30000000000000004 m".into()));
    }
}
