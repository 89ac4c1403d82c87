//! The file of a study: scenes, knobs and their values.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

use crate::design::document::{Document, Node};
use crate::problem::{Position, Problem, harmless, nearest};
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
    /// Reads the file's text; tells all that is wrong with it. `exists` tells whether there is a design file of a name.
    pub fn read(text: &str, exists: &dyn Fn(&Path) -> bool) -> Result<Self, Vec<Problem>> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let document = Document::parse(text.as_bytes(), KEYS).map_err(|problem| vec![problem])?;
        let placed = |list: Vec<Problem>| -> Result<(), Vec<Problem>> {
            let place = |problem: Problem| {
                let position = document.position(&problem.path);
                problem.at(position)
            };
            if list.is_empty() { Ok(()) } else { Err(list.into_iter().map(place).collect()) }
        };
        placed(doubled("", &document.root))?;
        placed(steering("", &document.root))?;
        if let Node::Map(keys) = &document.root {
            let is_there = |name: &str| keys.iter().any(|(key, _)| key == name);
            if !is_there("kind") && is_there("barrier") && is_there("flow") {
                return Err(vec![Problem::of("a design", KEYS).hint("run a design with `barrier-check FILE`")]);
            }
        }
        // The kind first, which tells what else the file may hold.
        let head: Head = serde_yaml::from_str(text).map_err(misread)?;
        // All at once, and before it is read, which ends at the first.
        let mut misfits = misfits(&head.kind.schema(), &document.root);
        misfits.extend(Self::missing(&document.root, exists));
        placed(misfits)?;
        let study = match head.kind {
            Kind::SpeedAccuracy => serde_yaml::from_str(text).map(Self::SpeedAccuracy),
            Kind::Stability => serde_yaml::from_str(text).map(Self::Stability),
            Kind::Size => serde_yaml::from_str(text).map(|plan| Self::Size(Box::new(plan))),
            Kind::Reliability => serde_yaml::from_str(text).map(|plan| Self::Reliability(Box::new(plan))),
            Kind::Sweep => serde_yaml::from_str(text).map(|plan| Self::Sweep(Box::new(plan))),
        };
        let study = study.map_err(misread)?;
        placed(match &study {
            Self::SpeedAccuracy(plan) => plan.wrong(),
            Self::Stability(plan) => plan.wrong(),
            Self::Size(plan) => [wrong_name(&plan.name), plan.wrong()].concat(),
            Self::Reliability(plan) => [wrong_name(&plan.name), plan.wrong()].concat(),
            Self::Sweep(plan) => [wrong_name(&plan.name), plan.wrong()].concat(),
        })?;
        Ok(study)
    }

    /// Design files that the study names and that are not there.
    fn missing(file: &Node, exists: &dyn Fn(&Path) -> bool) -> Vec<Problem> {
        let Node::Map(keys) = file else { return Vec::new() };
        let mut list = Vec::new();
        let mut look = |path: String, node: &Node| {
            if let Node::Text(name) = node
                && !exists(Path::new(name))
            {
                list.push(Problem::new(
                    path,
                    format!("`{name}`, which is not there"),
                    "a design file, relative to that of the study",
                ));
            }
        };
        for (key, value) in keys.iter().filter(|(key, _)| DESIGNS.contains(&key.as_str())) {
            match value {
                Node::List(items) => {
                    items.iter().enumerate().for_each(|(place, item)| look(format!("{key}.{place}"), item));
                }
                one => look(key.clone(), one),
            }
        }
        list
    }
}

/// Keys of a study that name design files.
const DESIGNS: [&str; 3] = ["design", "designs", "scenes"];

/// What the reader finds wrong, in the words of a file.
#[allow(clippy::needless_pass_by_value)]
fn misread(error: serde_yaml::Error) -> Vec<Problem> {
    let words = [
        ("invalid type: ", ""),
        ("integer `", "the number `"),
        ("floating point `", "the number `"),
        ("string \"", "the text \""),
        ("sequence", "a list"),
        ("a a list", "a list"),
        ("map", "a group of keys"),
        ("a a group", "a group"),
        ("struct Head", "a group of keys"),
        ("unknown variant", "the unknown value"),
        ("missing field", "no key"),
    ];
    let text = words.iter().fold(error.to_string(), |text, (from, to)| text.replace(from, to));
    let text = text.split_once(" at line ").map_or(text.as_str(), |(text, _)| text);
    let (found, allowed) = text.split_once(", expected ").unwrap_or((text, KEYS));
    let position = error.location().map(|place| Position { line: place.line(), column: place.column() });
    let problem = Problem::of(found, allowed).at(position);
    vec![match meant(text) {
        Some(near) => problem.hint(format!("did you mean `{near}`?")),
        None => problem,
    }]
}

/// The name that an unknown one is nearest to, of those that the same line says are expected.
fn meant(text: &str) -> Option<String> {
    let (_, rest) = text.split_once("the unknown value `")?;
    let (unknown, rest) = rest.split_once('`')?;
    let expected = rest.split('`').skip(1).step_by(2);
    nearest(unknown, expected).map(String::from)
}

/// Names and texts that hold what a page or a terminal must not show.
fn steering(path: &str, node: &Node) -> Vec<Problem> {
    let here = |name: &str| if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
    let steers = |text: &str| harmless(text) != text;
    let told = |path: String| {
        vec![Problem::new(
            path,
            "a character that steers a terminal or turns text round",
            "letters, digits and signs that are seen",
        )]
    };
    match node {
        Node::Map(entries) => {
            let of = |(name, value): &(String, Node)| {
                if steers(name) { told(here(name)) } else { steering(&here(name), value) }
            };
            entries.iter().flat_map(of).collect()
        }
        Node::List(items) => {
            items.iter().enumerate().flat_map(|(place, item)| steering(&here(&place.to_string()), item)).collect()
        }
        Node::Text(text) if steers(text) => told(path.to_string()),
        Node::Text(_) | Node::Number(_) | Node::Flag(_) | Node::Nothing => Vec::new(),
    }
}

/// Keys that stand twice in their group.
fn doubled(path: &str, node: &Node) -> Vec<Problem> {
    let Node::Map(entries) = node else { return Vec::new() };
    let here = |name: &str| if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
    let mut list = Vec::new();
    for (place, (name, value)) in entries.iter().enumerate() {
        if entries[..place].iter().any(|(known, _)| known == name) {
            list.push(Problem::new(here(name), "a key given twice", "each key once").again());
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
    fn wrong(&self) -> Vec<Problem> {
        let mut wrong = wrong_name(&self.name);
        if !(100..=10_000_000).contains(&self.steps) {
            wrong.push(Problem::new("steps", self.steps.to_string(), "100 to 10000000"));
        }
        let rising = self.shares.windows(2).all(|pair| pair[0] < pair[1]);
        if self.shares.is_empty()
            || self.shares.len() > 50
            || !rising
            || self.shares.iter().any(|share| !(0.01..=10.0).contains(share))
        {
            wrong.push(Problem::new("shares", format!("{:?}", self.shares), "1 to 50 rising values of 0.01 to 10"));
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
fn wrong_name(name: &str) -> Vec<Problem> {
    let fits = |letter: char| letter.is_ascii_alphanumeric() || "_-".contains(letter);
    let good = !name.is_empty() && name.len() <= 60 && name.chars().all(fits);
    if good { Vec::new() } else { vec![Problem::new("name", format!("{name:?}"), "1 to 60 letters, digits, _ and -")] }
}

/// Most starts and values, so that a slip of the hand does not run for days.
const MOST_STARTS: u32 = 100;
const MOST_VALUES: usize = 20;

impl Plan {
    fn wrong(&self) -> Vec<Problem> {
        let plan = self;
        let mut wrong = wrong_name(&self.name);
        if plan.scenes.is_empty() {
            wrong.push(Problem::new("scenes", "none", "one at least"));
        }
        let names: Vec<_> = plan.scenes.iter().map(|scene| scene.file_stem()).collect();
        if (1..names.len()).any(|place| names[..place].contains(&names[place])) {
            wrong.push(Problem::new(
                "scenes",
                "two with the same file name",
                "files of different names, whose pictures can be told apart",
            ));
        }
        for (key, starts) in [("starts", plan.starts), ("starts_of_knobs", plan.starts_of_knobs)] {
            if !(1..=MOST_STARTS).contains(&starts) {
                wrong.push(Problem::new(key, starts.to_string(), format!("1 to {MOST_STARTS}")));
            }
        }
        for (knob, values) in &plan.knobs {
            if values.is_empty() || values.len() > MOST_VALUES {
                let path = format!("knobs.{}", knob.key());
                wrong.push(Problem::new(path, format!("{} values", values.len()), format!("1 to {MOST_VALUES}")));
            }
        }
        let values = |group: &'static str, knob: &Knob, values: &[f64]| {
            let bad = values.iter().copied().filter(|value| !knob.takes(*value));
            let [least, most] = knob.range();
            let told = |value| {
                let allowed = format!("{least} to {most} ({})", knob.title());
                Problem::new(format!("{group}.{}", knob.key()), f64::to_string(&value), allowed)
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

    fn read(text: &str) -> Result<Study, Vec<Problem>> {
        Study::read(text, &|_| true)
    }

    /// The first that is wrong with a text, in a line.
    fn first(text: &str) -> String {
        let wrong = read(text).unwrap_err();
        let line = wrong[0].position.map_or(0, |position| position.line);
        let Problem { path, found, allowed, hint, .. } = &wrong[0];
        format!("{line} {path}: {found}, allowed {allowed} ({})", hint.as_deref().unwrap_or_default())
    }

    #[test]
    fn a_slip_is_told() {
        let text = include_str!("../../designs/studies/speed_accuracy.yaml");
        assert!(read(text).is_ok());
        let design = read(include_str!("../../designs/small_net.yaml")).unwrap_err();
        assert!(
            design[0].found == "a design"
                && first(include_str!("../../designs/small_net.yaml")).contains("`barrier-check FILE`")
        );
        assert!(first(&text.replace("starts: ", "starts: 1000 # ")).ends_with("starts: 1000, allowed 1 to 100 ()"));
        assert!(read(&format!("\u{feff}{text}")).is_ok());
        assert!(read(&text.replace("step:", "stepp:")).is_err());
        for (from, to, wanted) in [
            ("starts: ", "starts: few # ", "starts: `few`, allowed a whole number ()"),
            ("name: ", "nam: ", "(did you mean `name`?)"),
            (
                "kind: speed_accuracy",
                "kind: speed",
                "the unknown value `speed`, allowed one of `speed_accuracy`, `stability`, `size`, `reliability`, `sweep` ()",
            ),
            ("step: [", "step: [0.1, fast, ", "knobs.step.1: `fast`, allowed a number ()"),
        ] {
            let told = first(&text.replacen(from, to, 1));
            assert!(told.contains(wanted), "{told}");
        }
        for (text, found) in [("", "an empty file"), ("- a", "a list")] {
            let told = first(text);
            assert!(told.contains(&format!(": {found}, allowed a study with the keys kind")), "{told}");
        }
        assert!(read(&"[".repeat(100_000)).is_err());
        let steered = first(&text.replacen("name: ", "name: \"a\\e[31m\" # ", 1));
        assert!(steered.contains("name: a character that steers a terminal"), "{steered}");
        let doubled = first(&text.replace("knobs:\n", "knobs:\n  step: [0.1]\n"));
        assert!(doubled.contains("knobs.step: a key given twice"), "{doubled}");
        let line = 1 + text.lines().position(|line| line.trim().starts_with("step: [")).expect("a line");
        let told = first(&text.replacen("step: [", "step: [99, ", 1));
        assert!(told.starts_with(&format!("{line} knobs.step: 99, allowed 0.005 to 2")), "{told}");
        for (knob, value) in [
            (Knob::Aspect, 1e9),
            (Knob::CoarseGraining, 0.001),
            (Knob::BarrierModel, 7.0),
            (Knob::BarrierModel, 1.5),
            (Knob::Step, -1.0),
            (Knob::Skin, f64::NAN),
        ] {
            let mut plan: Plan = match read(text) {
                Ok(Study::SpeedAccuracy(plan)) => plan,
                other => panic!("{other:?}"),
            };
            assert_eq!(plan.wrong(), Vec::<Problem>::new());
            plan.knobs.insert(knob, vec![value]);
            assert_eq!(plan.wrong().len(), 1, "{knob:?} {value}");
        }
        let map = include_str!("../../designs/studies/stability.yaml");
        assert!(read(map).is_ok());
        assert!(read(&map.replace("[0.1, ", "[5, ")).is_err());
        assert!(read(&map.replace("name: stability", "name: ../../outside")).is_err());
    }
}
