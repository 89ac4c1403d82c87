//! Contradictions between what a design says of its anchors.

use crate::design::anchors::{RESISTANCES, anchor_key, each};
use crate::design::entries::Entries;
use crate::design::net_rules::rope_heights;
use crate::design::show::at;
use crate::problem::Problem;

/// The resistance of anchors is told one way.
pub fn anchors_have_one_resistance(e: &Entries) -> Option<Problem> {
    let place = at("anchors");
    if !e.has_section(&place) {
        return None;
    }
    let told = |place: &str| RESISTANCES.iter().filter(|name| e.mentions(&format!("{place}.{name}"))).count();
    let allowed = format!("one of {}", RESISTANCES.join(", "));
    if told(&place) == 0 {
        return Some(Problem::new(place, "no resistance", allowed).hint(
            "a proof_load counts as a characteristic resistance; a design_resistance is one over its partial factor already",
        ));
    }
    let several = [place].into_iter().chain(each(e)).find(|place| told(place) > 1)?;
    Some(Problem::new(several, "more than one resistance", allowed))
}

pub fn an_axis_dips(e: &Entries) -> Option<Problem> {
    let places = [at("anchors")].into_iter().chain(each(e));
    let alone = |place: &String| {
        let told = |name: &str| e.mentions(&format!("{place}.{name}"));
        told("bearing") && !told("plunge")
    };
    let place = places.into_iter().find(alone)?;
    Some(
        Problem::new(format!("{place}.bearing"), "a bearing without a plunge", "both, or neither")
            .hint("without them an anchor lies in the line of its rope"),
    )
}

/// Each of those that are told one by one is there, and told once.
pub fn single_anchors_are_there(e: &Entries) -> Option<Problem> {
    let levels = rope_heights(e)?.len();
    let first = if e.mentions(&at("bottom.fixed")) { 2 } else { 1 };
    let mut known: Vec<(usize, String)> = Vec::new();
    for place in each(e) {
        let level = e.number(&format!("{place}.level"))? as usize;
        let bank = e.text(&format!("{place}.bank"))?.to_string();
        if !(first..=levels).contains(&level) {
            let allowed = format!("{first} to {levels}, from the lowest main rope that is free to the uppermost");
            return Some(
                Problem::new(format!("{place}.level"), level.to_string(), allowed)
                    .hint("levels count from the bottom, from 1; a rope that the bed holds has bolts"),
            );
        }
        if known.contains(&(level, bank.clone())) {
            let found = format!("a second anchor at level {level} in the {bank} bank");
            return Some(Problem::new(anchor_key("each"), found, "each anchor once"));
        }
        known.push((level, bank));
    }
    None
}
