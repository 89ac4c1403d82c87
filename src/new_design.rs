//! The text of a new design, from the answers to ten questions.

use serde::Serialize;
use tera::{Context, Tera};

use crate::units::{Dimension, parse};

const TEMPLATE: &str = include_str!("../templates/new_design.yaml");

/// What the flow is held with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    Net,
    Rings,
    Wall,
}

impl What {
    /// By its word: net, rings or wall.
    pub fn of(word: &str) -> Option<Self> {
        match word.trim() {
            "net" => Some(Self::Net),
            "rings" => Some(Self::Rings),
            "wall" => Some(Self::Wall),
            _ => None,
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Net => "Rope net",
            Self::Rings => "Ring net",
            Self::Wall => "Gravity wall",
        }
    }
}

/// What may be answered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    Text,
    Barrier,
    /// The word `vertical`, an angle, or a ratio of rise to run.
    Banks,
    Quantity(Dimension),
}

/// One question.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Of its flag and of its place in the text.
    pub name: &'static str,
    pub ask: &'static str,
    /// What it is without an answer.
    pub usual: &'static str,
    pub wanted: Wanted,
}

const fn question(name: &'static str, ask: &'static str, usual: &'static str, wanted: Wanted) -> Question {
    Question { name, ask, usual, wanted }
}

/// In the order in which they are asked.
pub const QUESTIONS: [Question; 10] = [
    question("project", "Name of the project", "New barrier", Wanted::Text),
    question("barrier", "Barrier: net (of ropes), rings (a ring net) or wall (a gravity wall)", "net", Wanted::Barrier),
    question("width", "Width of the bed", "6 m", Wanted::Quantity(Dimension::Length)),
    question("banks", "Banks: vertical, an angle (45 deg) or a ratio of rise to run (1:1)", "vertical", Wanted::Banks),
    question("slope", "Slope of the bed", "20 deg", Wanted::Quantity(Dimension::Angle)),
    question("height", "Height of the barrier", "3 m", Wanted::Quantity(Dimension::Length)),
    question("volume", "Volume of the event, with pores", "50 m3", Wanted::Quantity(Dimension::Volume)),
    question("depth", "Depth of the flow at the barrier", "0.8 m", Wanted::Quantity(Dimension::Length)),
    question("velocity", "Velocity of the flow at the barrier", "4 m/s", Wanted::Quantity(Dimension::Velocity)),
    question(
        "d90",
        "Grain size d90, which 90 % of the mass is finer than",
        "0.4 m",
        Wanted::Quantity(Dimension::Length),
    ),
];

impl Question {
    /// What is wrong with an answer: what was found and what is allowed, with a hint where there is one.
    pub fn wrong(&self, answer: &str) -> Option<[String; 2]> {
        let answer = answer.trim();
        let wrong = |allowed: String| Some([format!("`{answer}`"), allowed]);
        match self.wanted {
            Wanted::Text => answer.is_empty().then(|| ["nothing".to_string(), "a text".to_string()]),
            Wanted::Barrier if What::of(answer).is_none() => wrong("net, rings or wall".into()),
            Wanted::Barrier => None,
            Wanted::Banks if answer == "vertical" || ratio(answer).is_some() => None,
            Wanted::Banks => match parse(answer, Dimension::Angle) {
                Ok(angle) if angle > 0.0 => None,
                _ => wrong("vertical, an angle with unit (45 deg) or a ratio of rise to run (1:1.5)".into()),
            },
            Wanted::Quantity(dimension) => match parse(answer, dimension) {
                Ok(value) if value > 0.0 || dimension == Dimension::Angle => None,
                Ok(_) => wrong(format!("{} above 0", dimension.name())),
                Err(error) => {
                    let units = dimension.symbols().join(", ");
                    let hint = error.hint.map_or(String::new(), |hint| format!("; {hint}"));
                    Some([error.found, format!("{} with unit ({units}){hint}", dimension.name())])
                }
            },
        }
    }
}

/// Rise over run, `1:1.5`.
fn ratio(text: &str) -> Option<f64> {
    let (rise, run) = text.split_once(':')?;
    let (rise, run): (f64, f64) = (rise.trim().parse().ok()?, run.trim().parse().ok()?);
    (rise > 0.0 && run > 0.0).then(|| rise / run)
}

/// What the template is filled with.
#[derive(Serialize)]
struct Filled<'a> {
    file: &'a str,
    project: String,
    project_quoted: String,
    title: &'static str,
    kit: Option<&'a str>,
    factors: &'a str,
    wall: bool,
    rings: bool,
    vertical: bool,
    banks: String,
    bank_height: String,
    width: &'a str,
    slope: &'a str,
    height: &'a str,
    middle: String,
    thickness: String,
    founding: String,
    volume: &'a str,
    density: &'a str,
    wet: bool,
    depth: &'a str,
    velocity: &'a str,
    d90: &'a str,
    d50: String,
    d10: String,
}

/// What is given beside the answers.
#[derive(Clone, Copy, Debug)]
pub struct Beside<'a> {
    /// The design file, as it is named on the command line.
    pub file: &'a str,
    pub density: &'a str,
    /// A set of partial factors.
    pub factors: &'a str,
    /// A kit, from the folder of the design.
    pub kit: Option<&'a str>,
}

/// Density (kg/m³) up to which grains alone can pack, with those of the template.
const DRY: f64 = 0.6 * 2650.0;

/// The text of the design with the answers in the order of [`QUESTIONS`], each of them sound.
///
/// # Errors
/// Where the template cannot be filled, which is a fault of the program.
pub fn text(answers: &[String; 10], beside: Beside) -> Result<String, tera::Error> {
    let answer = |name: &str| {
        let place = QUESTIONS.iter().position(|question| question.name == name);
        place.map_or("", |place| answers[place].trim())
    };
    let metres = |name: &str| parse(answer(name), Dimension::Length).unwrap_or(f64::NAN);
    let what = What::of(answer("barrier")).unwrap_or(What::Net);
    let (height, d90) = (metres("height"), metres("d90"));
    let slope = parse(answer("slope"), Dimension::Angle).unwrap_or(f64::NAN);
    // A block of eight tenths of its height, founded so deep that a level base stays in the ground.
    let thickness = 0.8 * height;
    let founding = (thickness * libm::tan(slope) * 10.0).ceil() / 10.0;
    let project = answer("project").replace(['\n', '\r'], " ");
    let filled = Filled {
        file: beside.file,
        project_quoted: format!("\"{}\"", project.replace('\\', "\\\\").replace('"', "\\\"")),
        project,
        title: what.title(),
        kit: beside.kit,
        factors: beside.factors,
        wall: what == What::Wall,
        rings: what == What::Rings,
        vertical: answer("banks") == "vertical",
        // A colon with a space behind it would be a key of YAML.
        banks: answer("banks").split_whitespace().collect::<Vec<_>>().join(if ratio(answer("banks")).is_some() {
            ""
        } else {
            " "
        }),
        // So that the banks reach over what runs up at the barrier.
        bank_height: length(height + 2.0),
        width: answer("width"),
        slope: answer("slope"),
        height: answer("height"),
        middle: length(0.5 * height),
        thickness: length(thickness),
        founding: length(founding),
        volume: answer("volume"),
        density: beside.density,
        wet: parse(beside.density, Dimension::Density).is_ok_and(|density| density > DRY),
        depth: answer("depth"),
        velocity: answer("velocity"),
        d90: answer("d90"),
        d50: length(0.6 * d90),
        d10: length(0.25 * d90),
    };
    let mut context = Context::new();
    context.insert("new", &filled);
    Tera::one_off(TEMPLATE, &context, false)
}

/// A length as it is written in a design, to the millimetre.
fn length(metres: f64) -> String {
    let text = format!("{metres:.3}");
    format!("{} m", text.trim_end_matches('0').trim_end_matches('.'))
}
