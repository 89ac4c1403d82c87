//! Rules of ropes, one by one and side by side.

use crate::design::entries::Entries;
use crate::design::rope_entries::{OF_A_ROPE, levels, parts};
use crate::design::show::at;
use crate::problem::Problem;

/// Breaking load over the full circle of the diameter beyond which no wire rope is (Pa): the strongest wires, of 2160 MPa, fill less than
/// nine tenths of it.
const STRONGEST: f64 = 2e9;

pub fn net_rope_is_described(e: &Entries) -> Option<Problem> {
    is_described(e, "net_rope")
}

pub fn main_ropes_are_described(e: &Entries) -> Option<Problem> {
    is_described(e, "main_ropes")
}

pub fn lateral_ropes_are_described(e: &Entries) -> Option<Problem> {
    is_described(e, "lateral_ropes")
}

/// All that a rope must be told to have, by itself or, of main ropes, at every level.
pub(super) fn is_described(e: &Entries, part: &str) -> Option<Problem> {
    let levels = if part == "main_ropes" { levels(e) } else { Vec::new() };
    let mentions = |part: &str, key: &str| e.mentions(&at(&format!("{part}.{key}")));
    let told =
        |key: &&str| mentions(part, key) || (!levels.is_empty() && levels.iter().all(|level| mentions(level, key)));
    let missing: Vec<String> = OF_A_ROPE.iter().filter(|key| !told(key)).map(|key| format!("`{key}`")).collect();
    // A name that no table has is told by itself.
    if missing.is_empty() || mentions(part, "rope") || !e.has_section(&at(part)) {
        return None;
    }
    let found = format!("no {} {}", if missing.len() > 1 { "keys" } else { "key" }, missing.join(", "));
    Some(
        Problem::new(at(part), found, "diameter, modulus and breaking_load, each with its unit")
            .hint("instead of all three a rope of the table may be named, as `rope: 6x36-IWRC 22 mm 1770`"),
    )
}

/// A level with a rope of its own tells all of it that goes with the diameter.
pub fn a_level_tells_its_rope(e: &Entries) -> Option<Problem> {
    levels(e).iter().find_map(|level| {
        let [diameter, load] = ["diameter", "breaking_load"].map(|key| e.mentions(&at(&format!("{level}.{key}"))));
        let (given, missing) = match (diameter, load) {
            (true, false) => ("diameter", "breaking_load"),
            (false, true) => ("breaking_load", "diameter"),
            _ => return None,
        };
        Some(Problem::new(
            at(&format!("{level}.{given}")),
            format!("a {given} without a {missing}"),
            "both, or neither where the rope is that of main_ropes",
        ))
    })
}

/// Whether ropes run side by side anywhere.
fn bundled(e: &Entries) -> Option<String> {
    let key = |level: &String| at(&format!("{level}.ropes"));
    levels(e).iter().map(key).find(|path| e.number(path).is_some_and(|ropes| ropes > 1.0))
}

pub fn ropes_side_by_side_are_modelled(e: &Entries) -> Option<Problem> {
    let path = bundled(e)?;
    if e.text("simulation.barrier_model") == Some("cylinders") {
        return Some(
            Problem::new(path, "ropes side by side with barrier_model cylinders", "1")
                .hint("sliding_ropes and pinned_ropes know bundles of ropes"),
        );
    }
    if !e.has_section(&at("dissipators")) {
        return Some(Problem::new(path, "ropes side by side without dissipators", "dissipators at their ends").hint(
            "without them the lateral ropes pull at the anchors, and which of a bundle bears that is not known",
        ));
    }
    (e.text(&at("lateral_ropes.tied_to")) == Some("anchors")).then(|| {
        Problem::new(
            path,
            "ropes side by side, whose anchors hold the lateral ropes as well",
            "lateral ropes that are tied to the rope ends",
        )
        .hint("which of the anchors of a bundle bears a lateral rope is not known: set lateral_ropes.tied_to to rope_ends")
    })
}

/// No rope is stronger than wire is.
pub fn every_rope_is_one(e: &Entries) -> Option<Problem> {
    parts(e).iter().find_map(|part| is_one(e, part))
}

/// No rope of this diameter has this breaking load.
fn is_one(e: &Entries, rope: &str) -> Option<Problem> {
    let [diameter, load] = ["diameter", "breaking_load"].map(|key| e.number(&at(&format!("{rope}.{key}"))));
    let most = STRONGEST * std::f64::consts::FRAC_PI_4 * diameter?.powi(2);
    (load? > most).then(|| {
        let [load_key, diameter_key] = ["breaking_load", "diameter"].map(|key| at(&format!("{rope}.{key}")));
        let found = format!("`{}` for a rope of `{}`", e.typed(&load_key), e.typed(&diameter_key));
        Problem::new(
            load_key,
            found,
            format!("at most {:.0} kN, which is 2 GPa on the full circle of the diameter", most * 1e-3),
        )
        .hint("look at the units of the breaking load and of the diameter")
    })
}
