//! What a folder holds a report of. A report of one kind does not take the place of one of another, which may have taken hours.

use serde::{Deserialize, Serialize};

/// A kind of report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Of a design, by the equations alone.
    Equations,
    /// Of a design that was simulated.
    Simulation,
    Comparison,
    Validation,
    Study,
}

/// The file that tells each kind; of several the first one tells.
const TOLD_BY: &[(&str, Kind)] = &[
    ("compare.html", Kind::Comparison),
    ("validation.html", Kind::Validation),
    ("study.html", Kind::Study),
    ("stability.html", Kind::Study),
    ("size.html", Kind::Study),
    ("reliability.html", Kind::Study),
    ("sweep.html", Kind::Study),
    ("histories.csv", Kind::Simulation),
    ("report.html", Kind::Equations),
];

impl Kind {
    /// The kind of report that files of these names are; nothing where they are none.
    pub fn of<'a>(names: impl Iterator<Item = &'a String> + Clone) -> Option<Self> {
        TOLD_BY.iter().find(|(file, _)| names.clone().any(|name| name == file)).map(|(_, kind)| *kind)
    }

    /// Whether it may take the place of a report of the kind that is there.
    pub fn may_replace(self, there: Self) -> bool {
        self == there || (self, there) == (Self::Simulation, Self::Equations)
    }

    /// As a sentence has it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Equations => "the report of a design by the guideline alone",
            Self::Simulation => "the report of a simulated design",
            Self::Comparison => "a comparison",
            Self::Validation => "a validation",
            Self::Study => "a study",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_takes_the_place_of_its_own_kind_or_of_one_that_cost_less() {
        use Kind::{Comparison, Equations, Simulation, Study, Validation};
        for kind in [Equations, Simulation, Comparison, Validation, Study] {
            for there in [Equations, Simulation, Comparison, Validation, Study] {
                let may = kind == there || (kind == Simulation && there == Equations);
                assert_eq!(kind.may_replace(there), may, "{kind:?} {there:?}");
            }
        }
        let of = |names: &[&str]| Kind::of(names.iter().map(|name| name.to_string()).collect::<Vec<_>>().iter());
        assert_eq!(of(&["report.html", "histories.csv", "result.json"]), Some(Simulation));
        assert_eq!(of(&["report.html", "result.json"]), Some(Equations));
        assert_eq!(of(&["stability.html"]), Some(Study));
        assert_eq!(of(&["recording.bin"]), None);
    }
}
