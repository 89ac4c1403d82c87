//! What a quantity is: one item tells how it is read, what it is called, where it is told and what is asked of it.

use crate::design::Factors;
use crate::guideline::{Guideline, PostLoad};
use crate::quantities::reading::Reading;

/// SI unit of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    Newton,
    NewtonMetre,
    /// Force per metre of width.
    NewtonPerMetre,
    /// Moment per metre of width.
    NewtonMetrePerMetre,
    Pascal,
    Metre,
    MetrePerSecond,
    Second,
    /// A share of a whole.
    Share,
    /// A number of things.
    Count,
    /// A plain number.
    Number,
}

impl Unit {
    /// As `result.json` names it and as [`crate::report::numbers`] takes it.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Newton => "N",
            Self::NewtonMetre => "N m",
            Self::NewtonPerMetre => "N/m",
            Self::NewtonMetrePerMetre => "N m/m",
            Self::Pascal => "Pa",
            Self::Metre => "m",
            Self::MetrePerSecond => "m/s",
            Self::Second => "s",
            Self::Share => "-",
            Self::Count => "count",
            Self::Number => "",
        }
    }
}

/// What a quantity is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// The run as a whole.
    Run,
    /// The same, where the run tells it at all.
    RunIfKnown,
    /// Each main rope, from the lowest to the highest.
    EachRope,
    /// Each post of a net, from the left to the right looking downstream.
    EachPost,
    /// Each anchor of a net, in the order of [`crate::design::FlexibleNet::anchors`].
    EachAnchor,
    /// Each segment of a rigid wall, from the lowest to the highest.
    EachSegment,
}

/// Where `result.json` has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Json {
    Nowhere,
    Key(&'static str),
    /// In a group of its own.
    In(&'static str, &'static str),
}

/// When its mean and scatter over the packings are told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Told {
    Never,
    Always,
    /// Where the first packing loads or uses the part.
    WhereLoaded,
    /// For rigid walls.
    OfWalls,
    /// Where every packing tells it.
    WhereKnown,
}

/// What by the equations stands beside it, with the partial factor on loads; nothing where they tell nothing.
pub type ByEquations = fn(&Guideline, &Factors) -> Option<f64>;

/// How the value that is checked is made of the packings.
#[derive(Clone, Copy, Debug)]
pub enum Demanded {
    /// A load: the value that the next packing exceeds with a probability of 5 %, with the partial factor on loads.
    Load(ByEquations),
    /// The same of each main rope, by the equations from its parabola; what a dissipator at work caps stays at its plateau.
    RopeLoad { capped: bool },
    /// The same of each anchor of a main rope; of those of posts there is none.
    LoadOfAnchor,
    /// Of each main rope, ends at the stop of its dissipators.
    Stroke,
    /// A load of each post, by the equations as told, and what a dissipator that pulls with more than its plateau makes of it.
    LoadOfPost(fn(&PostLoad) -> f64, OverPlateau),
    /// Of the ropes of each post, ends at the stop of their dissipators.
    StrokeOfPost,
    /// What stays at a plateau: the largest of all ropes and packings.
    Plateau,
    /// What must not happen in any packing: the worst of them.
    Worst,
    /// A level that is reached, with no factor: the value that the next packing of either case exceeds with a probability of 5 %.
    Level(fn(&Guideline) -> f64),
    /// A share that must be kept: the value that the next packing falls below with a probability of 5 %.
    Kept,
}

/// What the load of a part does where a retaining rope's dissipator yields at more than its plateau.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverPlateau {
    /// Nothing: it does not come from there.
    Stays,
    /// It grows by what the dissipator pulls more.
    Adds,
    /// It grows in proportion, as what the ropes of a post hold does.
    Grows,
}

/// A quantity that is measured of a run.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    /// By which recordings and the spreads of `result.json` know it.
    pub id: &'static str,
    /// As a table names it; of ropes, segments, posts and anchors a number follows.
    pub title: &'static str,
    pub unit: Unit,
    pub of: Of,
    pub read: fn(&Reading) -> Vec<f64>,
    pub json: Json,
    /// What the schema of `result.json` says of it; empty where its name tells.
    pub meaning: &'static str,
    pub told: Told,
    pub demanded: Option<Demanded>,
}

impl Quantity {
    /// A quantity that is read, and as yet told nowhere.
    pub const fn new(
        id: &'static str,
        title: &'static str,
        unit: Unit,
        of: Of,
        read: fn(&Reading) -> Vec<f64>,
    ) -> Self {
        Self { id, title, unit, of, read, json: Json::Nowhere, meaning: "", told: Told::Never, demanded: None }
    }

    /// The same as a field of `result.json`.
    pub const fn json(self, key: &'static str) -> Self {
        Self { json: Json::Key(key), ..self }
    }

    /// The same as a field of a group of `result.json`.
    pub const fn json_in(self, group: &'static str, key: &'static str) -> Self {
        Self { json: Json::In(group, key), ..self }
    }

    /// The same with what the schema of `result.json` says of it.
    pub const fn meaning(self, meaning: &'static str) -> Self {
        Self { meaning, ..self }
    }

    /// The same with mean and scatter over the packings.
    pub const fn told(self, told: Told) -> Self {
        Self { told, ..self }
    }

    /// The same as something that checks are made of.
    pub const fn demanded(self, demanded: Demanded) -> Self {
        Self { demanded: Some(demanded), ..self }
    }

    /// Its title, of a rope or segment with its number.
    pub fn title_of(&self, index: usize) -> String {
        match self.of {
            Of::Run | Of::RunIfKnown => self.title.to_string(),
            Of::EachRope | Of::EachSegment | Of::EachPost | Of::EachAnchor => format!("{} {}", self.title, index + 1),
        }
    }
}
