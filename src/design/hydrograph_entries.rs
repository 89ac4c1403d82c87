//! What the entries of a design say of a hydrograph.

use crate::design::channel_entries::section;
use crate::design::entries::Entries;
use crate::design::hydrograph::{Hydrograph, Moment};

pub const HYDROGRAPH: &str = "flow.arrival.hydrograph";

/// Keys of its columns.
pub const LISTS: [&str; 4] = ["times", "depths", "discharges", "velocities"];

/// Where a key of it stands.
pub fn key(name: &str) -> String {
    format!("{HYDROGRAPH}.{name}")
}

/// Its rows, counted from the first time; nothing where they are not sound.
pub fn hydrograph(e: &Entries) -> Option<Hydrograph> {
    let list = |name: &str| e.numbers(&key(name));
    let times = list("times")?;
    let fits = |values: &[f64]| values.len() == times.len();
    let velocity = |index: usize| match list("velocities") {
        Some(values) => values.get(index).copied(),
        None => e.number(&key("velocity")),
    };
    let section = section(e)?;
    let row = |index: usize| {
        let (depth, velocity) = match (list("depths"), list("discharges")) {
            (Some(depths), None) => (*depths.get(index)?, velocity(index)?),
            (None, Some(discharges)) => {
                let (discharge, velocity) = (*discharges.get(index)?, velocity(index)?);
                let depth = if discharge > 0.0 { section.height_of_area(discharge / velocity) } else { 0.0 };
                (depth, velocity)
            }
            (Some(depths), Some(discharges)) => {
                let (depth, discharge) = (*depths.get(index)?, *discharges.get(index)?);
                (depth, if depth > 0.0 { discharge / section.area(depth) } else { 0.0 })
            }
            (None, None) => return None,
        };
        let sound = [depth, velocity].into_iter().all(|value| value.is_finite() && value >= 0.0);
        sound.then_some(Moment { time: times[index] - times[0], depth, velocity })
    };
    let rows: Option<Vec<Moment>> = (0..times.len()).map(row).collect();
    let rises = times.windows(2).all(|pair| pair[0] < pair[1]);
    let whole = ["depths", "discharges", "velocities"].into_iter().filter_map(list).all(fits);
    let hydrograph = rows.filter(|rows| rises && whole && rows.len() >= 2).map(Hydrograph)?;
    (hydrograph.volume(&section, hydrograph.duration()) > 0.0).then_some(hydrograph)
}

/// Volume that it brings, with pores (m³).
pub fn hydrograph_volume(e: &Entries) -> Option<f64> {
    let hydrograph = hydrograph(e)?;
    Some(hydrograph.volume(&section(e)?, hydrograph.duration()))
}

/// Depth and velocity of its hardest row, and the way from the inlet, where it is given, as those of a surge.
pub fn as_of_a_surge(e: &Entries, name: &str) -> Option<f64> {
    let hardest = *hydrograph(e)?.hardest().first()?;
    match name {
        "depth" => Some(hardest.depth),
        "velocity" => Some(hardest.velocity),
        _ => e.number(&key(name)),
    }
}
