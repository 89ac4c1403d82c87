//! Anchors of the main ropes, all alike or one by one, and what the entries of a design say of them.

use crate::design::entries::Entries;
use crate::design::show::at;

/// A bank of the channel, looking downstream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bank {
    Right,
    Left,
}

impl Bank {
    pub fn word(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Left => "left",
        }
    }
}

/// What an anchor holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnchorOf {
    /// A main rope, counted from 0 at the bottom, at one of its ends.
    Main { rope: usize, bank: Bank },
    /// The head of a post, counted from 0 at the left, with an anchor so far to the right of it (m).
    Retaining { post: usize, side: f64 },
}

/// An anchor at the end of a main rope; of a bundle, of each rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnchorDesign {
    pub resistance: AnchorResistance,
    /// Of the anchor from the edge of the net, along the line of its rope, beyond the gap beside the net (m).
    pub set_back: f64,
    /// Its axis: how steeply it dips into the ground (rad), and the angle of its plan view to the line of the rope, positive where it points
    /// upstream (rad). Nothing where it lies in the line of its rope.
    pub axis: Option<[f64; 2]>,
}

/// What an anchor withstands (N), and how that was told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnchorResistance {
    Characteristic(f64),
    /// What it was pulled with in a test, taken as its characteristic resistance.
    ProofLoad(f64),
    /// Over its partial factor already.
    Design(f64),
}

impl AnchorResistance {
    pub fn value(&self) -> f64 {
        match self {
            Self::Characteristic(value) | Self::ProofLoad(value) | Self::Design(value) => *value,
        }
    }

    /// The key that gives it.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Characteristic(_) => RESISTANCES[0],
            Self::ProofLoad(_) => RESISTANCES[1],
            Self::Design(_) => RESISTANCES[2],
        }
    }

    /// Partial factor on it, where that of anchors is given.
    pub fn factor(&self, anchor: f64) -> f64 {
        match self {
            Self::Characteristic(_) | Self::ProofLoad(_) => anchor,
            Self::Design(_) => 1.0,
        }
    }

    /// The same with so many times its value.
    pub fn times(&self, factor: f64) -> Self {
        match self {
            Self::Characteristic(value) => Self::Characteristic(factor * value),
            Self::ProofLoad(value) => Self::ProofLoad(factor * value),
            Self::Design(value) => Self::Design(factor * value),
        }
    }
}

/// Anchors of all main ropes: one design, and those that differ from it by level (from 0 at the bottom) and bank.
#[derive(Clone, Debug, PartialEq)]
pub struct AnchorDesigns {
    pub all: AnchorDesign,
    pub each: Vec<(usize, Bank, AnchorDesign)>,
}

impl AnchorDesigns {
    pub fn of(&self, rope: usize, bank: Bank) -> AnchorDesign {
        let own = self.each.iter().find(|(level, side, _)| *level == rope && *side == bank);
        own.map_or(self.all, |(_, _, anchor)| *anchor)
    }

    /// All of them with so many times their resistance.
    pub fn times(&self, factor: f64) -> Self {
        let with = |anchor: &AnchorDesign| AnchorDesign { resistance: anchor.resistance.times(factor), ..*anchor };
        let each = self.each.iter().map(|(level, bank, anchor)| (*level, *bank, with(anchor))).collect();
        Self { all: with(&self.all), each }
    }
}

/// Keys of which one tells the resistance.
pub const RESISTANCES: [&str; 3] = ["resistance", "proof_load", "design_resistance"];

/// Where a key of all anchors stands.
pub fn anchor_key(name: &str) -> String {
    at(&format!("anchors.{name}"))
}

/// Where the anchors that are told one by one stand.
pub fn each(e: &Entries) -> Vec<String> {
    let place = |number: usize| anchor_key(&format!("each.{number}"));
    (0..).map(place).take_while(|place| e.has_section(place)).collect()
}

fn resistance(e: &Entries, place: &str) -> Option<AnchorResistance> {
    let told = RESISTANCES.iter().find_map(|name| Some((*name, e.number(&format!("{place}.{name}"))?)))?;
    Some(match told {
        ("resistance", value) => AnchorResistance::Characteristic(value),
        ("proof_load", value) => AnchorResistance::ProofLoad(value),
        (_, value) => AnchorResistance::Design(value),
    })
}

/// The anchors; nothing where their resistance is not told.
pub fn anchors(e: &Entries) -> Option<AnchorDesigns> {
    let place = at("anchors");
    let of = |place: &str, or: Option<&AnchorDesign>| {
        let value = |name: &str| e.number(&format!("{place}.{name}"));
        let own = value("plunge").map(|plunge| [plunge, value("bearing").unwrap_or(0.0)]);
        Some(AnchorDesign {
            resistance: resistance(e, place).or(or.map(|all| all.resistance))?,
            set_back: value("set_back").or(or.map(|all| all.set_back))?,
            axis: own.or(or.and_then(|all| all.axis)),
        })
    };
    let all = of(&place, None)?;
    let one = |place: &String| {
        let level = e.number(&format!("{place}.level"))? as usize - 1;
        let bank = e.chosen(&format!("{place}.bank"), &[("left", Bank::Left), ("right", Bank::Right)])?;
        Some((level, bank, of(place, Some(&all))?))
    };
    let each: Option<Vec<_>> = each(e).iter().map(one).collect();
    Some(AnchorDesigns { all, each: each? })
}
