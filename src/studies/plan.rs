//! The file of a study: scenes, knobs and their values.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

use crate::design::document::{Document, Node};
use crate::problem::{Problem, nearest};
use crate::studies::knobs::Knob;
use crate::studies::plan_schema::{misfits, of_kind, one_of};
use crate::studies::reliability_plan::ReliabilityPlan;
use crate::studies::size_plan::SizePlan;
use crate::studies::sweep_plan::SweepPlan;

/// What a study is of.
#[derive(Clone, Debug)]
pub enum Study {
    SpeedAccuracy(Plan),
    Stability(StabilityPlan),
    Size(Box<SizePlan>),
    Reliability(Box<ReliabilityPlan>),
    Sweep(Box<SweepPlan>),
}

/// The same as the file names it.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    SpeedAccuracy,
    Stability,
    Size,
    Reliability,
    Sweep,
}

/// The key that tells what the others are; these are not looked at.
#[derive(Deserialize)]
struct Head {
    kind: Kind,
}

impl Kind {
    const ALL: [Self; 5] = [Self::SpeedAccuracy, Self::Stability, Self::Size, Self::Reliability, Self::Sweep];

    /// Schema of the file of such a study.
    fn schema(self) -> Value {
        match self {
            Self::SpeedAccuracy => of_kind::<Plan>("speed_accuracy"),
            Self::Stability => of_kind::<StabilityPlan>("stability"),
            Self::Size => of_kind::<SizePlan>("size"),
            Self::Reliability => of_kind::<ReliabilityPlan>("reliability"),
            Self::Sweep => of_kind::<SweepPlan>("sweep"),
        }
    }
}

/// Schema of the file of a study of any kind.
pub fn schema() -> Value {
    one_of(Kind::ALL.map(Kind::schema))
}

/// What the file of a study has to be, as an error tells it.
const KEYS: &str = "a study with the keys kind, name and those of its kind, as in designs/studies";

impl Study {
    /// Reads the file's text; tells all that is wrong with it.
    pub fn read(text: &str) -> Result<Self, Vec<String>> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let document = Document::parse(text.as_bytes(), KEYS).map_err(|problem| vec![told(&problem)])?;
        let at = |path: &str| document.position(path).map_or(String::new(), |place| format!("line {}, ", place.line));
        let doubled = doubled("", &document.root);
        if !doubled.is_empty() {
            return Err(doubled.iter().map(|path| format!("{}{path}: given twice", at(path))).collect());
        }
        if let Node::Map(keys) = &document.root {
            let is_there = |name: &str| keys.iter().any(|(key, _)| key == name);
            if !is_there("kind") && is_there("barrier") && is_there("flow") {
                return Err(vec![format!("found a design, allowed {KEYS}; run a design with `barrier-check FILE`")]);
            }
        }
        let misread = |error: serde_yaml::Error| vec![plainly(&error.to_string())];
        // The kind first: the place of a fault is lost where serde has to look ahead for it.
        let head: Head = serde_yaml::from_str(text).map_err(misread)?;
        // All at once, and before it is read, which ends at the first.
        let misfits = misfits(&head.kind.schema(), &document.root);
        if !misfits.is_empty() {
            return Err(misfits.into_iter().map(|[path, wrong]| format!("{}{path}: {wrong}", at(&path))).collect());
        }
        let study = match head.kind {
            Kind::SpeedAccuracy => serde_yaml::from_str(text).map(Self::SpeedAccuracy),
            Kind::Stability => serde_yaml::from_str(text).map(Self::Stability),
            Kind::Size => serde_yaml::from_str(text).map(|plan| Self::Size(Box::new(plan))),
            Kind::Reliability => serde_yaml::from_str(text).map(|plan| Self::Reliability(Box::new(plan))),
            Kind::Sweep => serde_yaml::from_str(text).map(|plan| Self::Sweep(Box::new(plan))),
        };
        let study = study.map_err(misread)?;
        let wrong = match &study {
            Self::SpeedAccuracy(plan) => plan.wrong(),
            Self::Stability(plan) => plan.wrong(),
            Self::Size(plan) => [wrong_name(&plan.name), plan.wrong()].concat(),
            Self::Reliability(plan) => [wrong_name(&plan.name), plan.wrong()].concat(),
            Self::Sweep(plan) => [wrong_name(&plan.name), plan.wrong()].concat(),
        };
        if wrong.is_empty() {
            return Ok(study);
        }
        Err(wrong.into_iter().map(|[path, wrong]| format!("{}{path}: {wrong}", at(&path))).collect())
    }
}

/// The words of the reader in those of a file.
fn plainly(error: &str) -> String {
    let words = [
        ("invalid type: ", "found "),
        ("integer `", "the number `"),
        ("floating point `", "the number `"),
        ("string \"", "the text \""),
        ("sequence", "a list"),
        ("a a list", "a list"),
        ("found map", "found a group of keys"),
        ("expected a map", "expected a group of keys"),
        ("expected f64", "expected a number"),
        ("expected u32", "expected a whole number"),
        ("expected usize", "expected a whole number"),
        ("expected struct Head", "expected a group of keys"),
        ("unknown field", "unknown key"),
        ("missing field", "missing key"),
        ("unknown variant", "unknown value"),
        ("path string", "the name of a file"),
    ];
    let text = words.iter().fold(error.to_string(), |text, (from, to)| text.replace(from, to));
    let near = meant(&text).map_or(String::new(), |near| format!(" (did you mean `{near}`?)"));
    text + &near
}

/// The name that an unknown one is nearest to, of those that the same line says are expected.
fn meant(text: &str) -> Option<String> {
    let (_, rest) = text.split_once("unknown key `").or_else(|| text.split_once("unknown value `"))?;
    let (unknown, rest) = rest.split_once('`')?;
    let expected = rest.split('`').skip(1).step_by(2);
    nearest(unknown, expected).map(String::from)
}

/// A problem of the whole text in one line.
fn told(problem: &Problem) -> String {
    let place = problem.position.map_or(String::new(), |place| format!("line {}: ", place.line));
    let hint = problem.hint.as_ref().map_or(String::new(), |hint| format!("; {hint}"));
    format!("{place}found {}, allowed {}{hint}", problem.found, problem.allowed)
}

/// Paths of keys that stand twice in their group.
fn doubled(path: &str, node: &Node) -> Vec<String> {
    let Node::Map(entries) = node else { return Vec::new() };
    let here = |name: &str| if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
    let mut list = Vec::new();
    for (place, (name, value)) in entries.iter().enumerate() {
        if entries[..place].iter().any(|(known, _)| known == name) {
            list.push(here(name));
        }
        list.extend(doubled(&here(name), value));
    }
    list
}

/// The map of where steps break.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StabilityPlan {
    #[serde(rename = "kind")]
    #[schemars(skip)]
    _kind: Kind,
    /// What the study is called.
    pub name: String,
    /// Shares of the estimated limit, rising.
    pub shares: Vec<f64>,
    /// Steps of each run.
    pub steps: usize,
}

impl StabilityPlan {
    fn wrong(&self) -> Vec<[String; 2]> {
        let mut wrong = wrong_name(&self.name);
        if !(100..=10_000_000).contains(&self.steps) {
            wrong.push(["steps".into(), format!("found {}, allowed 100 to 10000000", self.steps)]);
        }
        let rising = self.shares.windows(2).all(|pair| pair[0] < pair[1]);
        if self.shares.is_empty()
            || self.shares.len() > 50
            || !rising
            || self.shares.iter().any(|share| !(0.01..=10.0).contains(share))
        {
            wrong.push([
                "shares".into(),
                format!("found {:?}, allowed 1 to 50 rising values of 0.01 to 10", self.shares),
            ]);
        }
        wrong
    }
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    #[serde(rename = "kind")]
    #[schemars(skip)]
    _kind: Kind,
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

/// The name becomes that of a folder.
fn wrong_name(name: &str) -> Vec<[String; 2]> {
    let fits = |letter: char| letter.is_ascii_alphanumeric() || "_-".contains(letter);
    let good = !name.is_empty() && name.len() <= 60 && name.chars().all(fits);
    if good {
        Vec::new()
    } else {
        vec![["name".into(), format!("found {name:?}, allowed 1 to 60 letters, digits, _ and -")]]
    }
}

/// Most starts and values, so that a slip of the hand does not run for days.
const MOST_STARTS: u32 = 100;
const MOST_VALUES: usize = 20;

impl Plan {
    fn wrong(&self) -> Vec<[String; 2]> {
        let plan = self;
        let mut wrong = wrong_name(&self.name);
        if plan.scenes.is_empty() {
            wrong.push(["scenes".into(), "found none, allowed one at least".into()]);
        }
        let names: Vec<_> = plan.scenes.iter().map(|scene| scene.file_stem()).collect();
        if (1..names.len()).any(|place| names[..place].contains(&names[place])) {
            wrong.push(["scenes".into(), "two have the same file name; their pictures could not be told apart".into()]);
        }
        for (key, starts) in [("starts", plan.starts), ("starts_of_knobs", plan.starts_of_knobs)] {
            if !(1..=MOST_STARTS).contains(&starts) {
                wrong.push([key.into(), format!("found {starts}, allowed 1 to {MOST_STARTS}")]);
            }
        }
        for (knob, values) in &plan.knobs {
            if values.is_empty() || values.len() > MOST_VALUES {
                let found = format!("found {} values, allowed 1 to {MOST_VALUES}", values.len());
                wrong.push([format!("knobs.{}", knob.key()), found]);
            }
        }
        let values = |group: &'static str, knob: &Knob, values: &[f64]| {
            let bad = values.iter().copied().filter(|value| !knob.takes(*value));
            let [least, most] = knob.range();
            let told = |value| {
                let found = format!("found {value}, allowed {least} to {most} ({})", knob.title());
                [format!("{group}.{}", knob.key()), found]
            };
            bad.map(told).collect::<Vec<_>>()
        };
        wrong.extend(plan.knobs.iter().flat_map(|(knob, list)| values("knobs", knob, list)));
        wrong.extend(plan.reference.iter().flat_map(|(knob, value)| values("reference", knob, &[*value])));
        wrong
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_is_told() {
        let text = include_str!("../../designs/studies/speed_accuracy.yaml");
        assert!(Study::read(text).is_ok());
        let design = Study::read(include_str!("../../designs/small_net.yaml")).unwrap_err();
        assert!(design[0].starts_with("found a design") && design[0].contains("`barrier-check FILE`"), "{design:?}");
        let wrong = Study::read(&text.replace("starts: ", "starts: 1000 # ")).unwrap_err();
        assert!(wrong.iter().any(|wrong| wrong.contains("1 to 100")), "{wrong:?}");
        assert!(Study::read(&format!("\u{feff}{text}")).is_ok());
        assert!(Study::read(&text.replace("step:", "stepp:")).is_err());
        for (from, to, wanted) in [
            ("starts: ", "starts: few # ", "starts: found the text \"few\", expected a whole number at line "),
            ("name: ", "nam: ", "(did you mean `name`?)"),
            (
                "kind: speed_accuracy",
                "kind: speed",
                "kind: unknown value `speed`, expected one of `speed_accuracy`, `stability`, `size`, `reliability`, `sweep` at line ",
            ),
            ("step: [", "step: [0.1, fast, ", "knobs.step[1]: found the text \"fast\", expected a number at line "),
        ] {
            let wrong = Study::read(&text.replacen(from, to, 1)).unwrap_err();
            assert!(wrong[0].contains(wanted), "{wrong:?}");
        }
        for (text, found) in [("", "an empty file"), ("- a", "a list")] {
            let wrong = Study::read(text).unwrap_err();
            assert!(wrong[0].starts_with(&format!("found {found}, allowed a study with the keys kind")), "{wrong:?}");
        }
        assert!(Study::read(&"[".repeat(100_000)).is_err());
        let wrong = Study::read(&text.replace("knobs:\n", "knobs:\n  step: [0.1]\n")).unwrap_err();
        assert!(wrong[0].contains("knobs.step: given twice"), "{wrong:?}");
        let line = 1 + text.lines().position(|line| line.trim().starts_with("step: [")).expect("a line");
        let wrong = Study::read(&text.replacen("step: [", "step: [99, ", 1)).unwrap_err();
        assert!(wrong[0].starts_with(&format!("line {line}, knobs.step: found 99, allowed 0.005 to 2")), "{wrong:?}");
        for (knob, value) in [
            (Knob::Aspect, 1e9),
            (Knob::CoarseGraining, 0.001),
            (Knob::BarrierModel, 7.0),
            (Knob::BarrierModel, 1.5),
            (Knob::Step, -1.0),
            (Knob::Skin, f64::NAN),
        ] {
            let mut plan: Plan = match Study::read(text) {
                Ok(Study::SpeedAccuracy(plan)) => plan,
                other => panic!("{other:?}"),
            };
            assert_eq!(plan.wrong(), Vec::<[String; 2]>::new());
            plan.knobs.insert(knob, vec![value]);
            assert_eq!(plan.wrong().len(), 1, "{knob:?} {value}");
        }
        let map = include_str!("../../designs/studies/stability.yaml");
        assert!(Study::read(map).is_ok());
        assert!(Study::read(&map.replace("[0.1, ", "[5, ")).is_err());
        assert!(Study::read(&map.replace("name: stability", "name: ../../outside")).is_err());
    }
}
