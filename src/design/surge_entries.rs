//! What the entries of a design say of its surges: the one of `arrival.surge`, or the list of `arrival.surges`, counted from 0.

use crate::design::channel_entries::section;
use crate::design::entries::Entries;
use crate::design::hydrograph_entries::{HYDROGRAPH, as_of_a_surge};

pub const SURGES: &str = "flow.arrival.surges";

/// Where the surges of the design stand, the first one first; nothing for a dam break.
pub fn surges(e: &Entries) -> Vec<String> {
    if e.has_section("flow.arrival.surge") {
        return vec!["flow.arrival.surge".to_string()];
    }
    (0..).map(surge).take_while(|path| e.has_section(path)).collect()
}

/// Where a surge of the list stands.
pub fn surge(number: usize) -> String {
    format!("{SURGES}.{number}")
}

/// A value of the first surge, or of a hydrograph as if it were one, and where it stands.
pub fn of_the_first(e: &Entries, key: &str) -> Option<(String, f64)> {
    if e.has_section(HYDROGRAPH) {
        return Some((HYDROGRAPH.to_string(), as_of_a_surge(e, key)?));
    }
    let path = format!("{}.{key}", surges(e).first()?);
    let value = e.number(&path)?;
    Some((path, value))
}

/// Volume of a surge of the list with pores, from whichever of volume and length was given (m³).
pub fn volume_of(e: &Entries, path: &str) -> Option<f64> {
    let value = |key: &str| e.number(&format!("{path}.{key}"));
    value("volume").or_else(|| Some(value("length")? * section(e)?.area(value("depth")?)))
}

/// Volume of all surges of the list (m³); nothing where there is no list, or one of them is not known.
pub fn volume_of_all(e: &Entries) -> Option<f64> {
    let listed = surges(e);
    e.has_list(SURGES).then(|| listed.iter().map(|path| volume_of(e, path)).sum()).flatten()
}
