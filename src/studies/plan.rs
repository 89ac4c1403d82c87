//! The file of a study: scenes, knobs and their values.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;

use crate::studies::knobs::Knob;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// What the study is called.
    pub name: String,
    /// Design files, relative to the study's own.
    pub scenes: Vec<PathBuf>,
    /// Packings of the scene as it is; their scatter is the floor below which no error can be told.
    pub starts: u32,
    /// Packings for each value of a knob.
    pub starts_of_knobs: u32,
    /// Values that each knob takes, alone.
    pub knobs: BTreeMap<Knob, Vec<f64>>,
    /// Values of the finest model that the scenes are run with, all at once; what the errors are taken from.
    pub reference: BTreeMap<Knob, f64>,
}

/// Most starts and values, so that a slip of the hand does not run for days.
const MOST_STARTS: u32 = 100;
const MOST_VALUES: usize = 20;

impl Plan {
    /// Reads the file's text; tells all that is wrong with it.
    pub fn read(text: &str) -> Result<Self, Vec<String>> {
        let plan: Self = serde_yaml::from_str(text).map_err(|error| vec![error.to_string()])?;
        let mut wrong = Vec::new();
        if plan.scenes.is_empty() {
            wrong.push("scenes: one at least".to_string());
        }
        for (key, starts) in [("starts", plan.starts), ("starts_of_knobs", plan.starts_of_knobs)] {
            if !(1..=MOST_STARTS).contains(&starts) {
                wrong.push(format!("{key}: found {starts}, allowed 1 to {MOST_STARTS}"));
            }
        }
        for (knob, values) in &plan.knobs {
            if values.is_empty() || values.len() > MOST_VALUES {
                wrong.push(format!("knobs.{knob:?}: {} values, allowed 1 to {MOST_VALUES}", values.len()));
            }
        }
        let values = plan.knobs.iter().flat_map(|(knob, values)| values.iter().map(move |value| (knob, value)));
        for (knob, value) in values.chain(&plan.reference) {
            if !(*value > 0.0 && value.is_finite()) {
                wrong.push(format!("{knob:?}: found {value}, allowed: above 0"));
            }
        }
        if wrong.is_empty() { Ok(plan) } else { Err(wrong) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_is_told() {
        let text = include_str!("../../designs/studies/speed_accuracy.yaml");
        assert!(Plan::read(text).is_ok());
        let wrong = Plan::read(&text.replace("starts: ", "starts: 1000 # ")).unwrap_err();
        assert!(wrong.iter().any(|wrong| wrong.contains("1 to 100")), "{wrong:?}");
        assert!(Plan::read(&text.replace("step:", "stepp:")).is_err());
    }
}
