//! One thing that is explained.

use std::fmt::Write;

use crate::text::Text;

/// What an entry is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    Check,
    LoadCase,
    Warning,
    Key,
}

impl Of {
    fn word(self) -> &'static str {
        match self {
            Self::Check => "check",
            Self::LoadCase => "load case",
            Self::Warning => "warning",
            Self::Key => "key of the design file",
        }
    }

    pub fn heading(self) -> &'static str {
        match self {
            Self::Check => "Checks",
            Self::LoadCase => "Load cases",
            Self::Warning => "Warnings",
            Self::Key => "Keys of the design file",
        }
    }
}

/// One thing explained.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    pub of: Of,
    /// Of a key its path.
    pub id: String,
    pub meaning: String,
    /// Of a key what may be given.
    pub formula: String,
    /// Of a key whether it may be left out.
    pub source: String,
}

impl Entry {
    pub fn of(of: Of, text: &Text) -> Self {
        Self {
            of,
            id: text.id.into(),
            meaning: text.meaning.into(),
            formula: text.formula.into(),
            source: text.source.into(),
        }
    }

    /// For the terminal.
    pub fn text(&self) -> String {
        let mut text = format!("{} ({})\n  {}\n", self.id, self.of.word(), self.meaning);
        let [formula, source] = match self.of {
            Of::Key => ["allowed:", "given:"],
            _ => ["formula:", "source:"],
        };
        for (name, value) in [(formula, &self.formula), (source, &self.source)] {
            if !value.is_empty() {
                let _ = writeln!(text, "  {name:<9}{value}");
            }
        }
        text
    }
}
