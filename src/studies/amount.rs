//! Numbers with a unit, as a study file has them.

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

/// A value of a study file as a message shows it.
pub fn as_typed(value: &Value) -> String {
    match Amount::of(value) {
        Some(Amount { value, unit }) => format!("{value} {unit}").trim().to_string(),
        None => serde_yaml::to_string(value).map_or_else(|_| "something else".into(), |text| text.trim().to_string()),
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
