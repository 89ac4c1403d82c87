//! What a key of the design file may be. The tables in [`super::schema`] are made of these; reading, the JSON
//! Schema and the list of inputs in the report all come from the same tables.

use crate::units::Dimension;

/// One key of the file.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    pub name: &'static str,
    pub kind: Kind,
    pub need: Need,
    /// Meaning, for documentation and messages.
    pub meaning: &'static str,
    /// What it was called before; designs that call it so are read, with a note.
    pub former: Option<&'static str>,
}

/// A quantity within SI bounds.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    pub dimension: Dimension,
    pub low: f64,
    pub high: f64,
}

impl Bounded {
    pub const fn kind(self) -> Kind {
        Kind::Quantity { dimension: self.dimension, low: self.low, high: self.high }
    }
}

/// What stands behind a key.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Number and unit, within SI bounds.
    Quantity {
        dimension: Dimension,
        low: f64,
        high: f64,
    },
    /// A length within bounds (m), or a multiple of a grain size: `0.8 D90`.
    LengthOrGrains {
        low: f64,
        high: f64,
    },
    /// A list of quantities.
    Quantities {
        dimension: Dimension,
        low: f64,
        high: f64,
    },
    /// A list of pairs of quantities, each with its bounds.
    Pairs {
        first: Bounded,
        second: Bounded,
        /// How such a list is written.
        example: &'static str,
    },
    /// One such pair.
    Pair {
        first: Bounded,
        second: Bounded,
        example: &'static str,
    },
    /// An angle, or a ratio of rise to run: `1:1.5`.
    Steepness {
        low: f64,
        high: f64,
    },
    /// A bare number.
    Number {
        low: f64,
        high: f64,
    },
    /// A whole number.
    Count {
        low: u64,
        high: u64,
    },
    Text,
    /// The name of a file, from the folder of the design.
    File,
    Choice(&'static [&'static str]),
    Section(&'static [Key]),
    /// The same, or the word `none`.
    SectionOrNone(&'static [Key]),
    /// A list of sections, one or more.
    Sections(&'static [Key]),
    /// A section that holds exactly one of several sections.
    OneOf(&'static [Key]),
}

/// Whether a key may be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    Required,
    /// Required for a simulation; the equations do without it.
    ForGrains,
    /// May be left out; then it is not there.
    Optional,
    /// May be left out; then it is as if this were typed.
    Default(&'static str),
}

impl Key {
    pub const fn required(name: &'static str, kind: Kind, meaning: &'static str) -> Self {
        Self { name, kind, need: Need::Required, meaning, former: None }
    }

    pub const fn for_grains(name: &'static str, kind: Kind, meaning: &'static str) -> Self {
        Self { name, kind, need: Need::ForGrains, meaning, former: None }
    }

    pub const fn optional(name: &'static str, kind: Kind, meaning: &'static str) -> Self {
        Self { name, kind, need: Need::Optional, meaning, former: None }
    }

    /// The same, read under the name that it had before as well.
    pub const fn formerly(self, name: &'static str) -> Self {
        Self { former: Some(name), ..self }
    }

    pub const fn default(name: &'static str, kind: Kind, typed: &'static str, meaning: &'static str) -> Self {
        Self { name, kind, need: Need::Default(typed), meaning, former: None }
    }
}

/// A quantity within bounds given in SI.
pub const fn quantity(dimension: Dimension, low: f64, high: f64) -> Kind {
    Kind::Quantity { dimension, low, high }
}

impl Kind {
    /// What is allowed, in words.
    pub fn allowed(&self) -> String {
        match *self {
            Self::Quantity { dimension, low, high } => {
                let units = dimension.symbols().join(", ");
                format!("{} with unit ({units}), {} to {}", dimension.name(), dimension.show(low), dimension.show(high))
            }
            Self::LengthOrGrains { low, high } => {
                let length = Self::Quantity { dimension: Dimension::Length, low, high }.allowed();
                format!("{length}, or a grain size or a multiple of one (D90, 0.8 D90)")
            }
            Self::Quantities { dimension, low, high } => {
                format!("a list of values, each {}", Self::Quantity { dimension, low, high }.allowed())
            }
            Self::Pairs { first, second, example } => {
                let [one, other] = [first, second].map(|value| value.kind().allowed());
                format!("a list of pairs, {example}: {one}, and {other}")
            }
            Self::Pair { first, second, example } => {
                let [one, other] = [first, second].map(|value| value.kind().allowed());
                format!("a pair, {example}: {one}, and {other}")
            }
            Self::Steepness { low, high } => {
                let angle = Self::Quantity { dimension: Dimension::Angle, low, high }.allowed();
                format!("{angle}, or a ratio of rise to run (1:1.5)")
            }
            Self::Number { low, high } => format!("a number from {low} to {high}"),
            Self::Count { low, high } => format!("a whole number from {low} to {high}"),
            Self::Text => "a text".into(),
            Self::File => "the name of a file, taken from the folder of the design".into(),
            Self::Choice(words) => format!("one of {}", words.join(", ")),
            Self::Section(keys) => format!("a group of keys: {}", names(keys)),
            Self::SectionOrNone(keys) => format!("none, or a group of keys: {}", names(keys)),
            Self::Sections(keys) => format!("a list of groups of keys, each with {}", names(keys)),
            Self::OneOf(keys) => format!("exactly one of {}", names(keys)),
        }
    }
}

/// The keys' names, for messages.
pub fn names(keys: &[Key]) -> String {
    keys.iter().map(|key| key.name).collect::<Vec<_>>().join(", ")
}
