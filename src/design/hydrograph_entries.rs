//! What the entries of a design say of a hydrograph.

use crate::design::channel_entries::section;
use crate::design::entries::Entries;
use crate::design::flow::RUN_IN;
use crate::design::hydrograph::{Hydrograph, HydrographPoint};

pub const HYDROGRAPH: &str = "flow.arrival.hydrograph";

/// Keys of its columns.
pub const LISTS: [&str; 4] = ["times", "depths", "discharges", "velocities"];

/// Where a key of it stands.
pub fn key(name: &str) -> String {
    format!("{HYDROGRAPH}.{name}")
}

/// Parts of an interval in which a discharge is told as depth and velocity: what is straight between the rows is the discharge.
const PARTS: usize = 16;
/// Rows beyond which a table is taken to be fine enough as it is.
const FINE: usize = 1000;

/// Its rows, counted from the first time; nothing where they are not sound.
pub fn hydrograph(e: &Entries) -> Option<Hydrograph> {
    let list = |name: &str| e.numbers(&key(name));
    let times = list("times")?;
    let one = e.number(&key("velocity")).map(|velocity| vec![velocity; times.len()]);
    let (depths, discharges) = (list("depths"), list("discharges"));
    let velocities = list("velocities").or(one.as_deref());
    let told: Vec<&[f64]> = [depths, discharges, velocities].into_iter().flatten().collect();
    let sound =
        |values: &&[f64]| values.len() == times.len() && values.iter().all(|value| value.is_finite() && *value >= 0.0);
    if times.len() < 2 || told.len() != 2 || !told.iter().all(sound) || !times.windows(2).all(|pair| pair[0] < pair[1])
    {
        return None;
    }
    let section = section(e)?;
    let parts = if discharges.is_none() || times.len() > FINE { 1 } else { PARTS };
    let place = |index: usize| {
        let (row, share) = (index / parts, (index % parts) as f64 / parts as f64);
        let at = |values: &[f64]| values[row] + share * (values.get(row + 1).map_or(0.0, |next| next - values[row]));
        let (depth, discharge, velocity) = (depths.map(at), discharges.map(at), velocities.map(at));
        let (depth, velocity) = match (depth, discharge, velocity) {
            (Some(depth), None, Some(velocity)) => (depth, velocity),
            (None, Some(discharge), Some(velocity)) if discharge > 0.0 => {
                (section.height_of_area(discharge / velocity), velocity)
            }
            (None, Some(_), Some(velocity)) => (0.0, velocity),
            (Some(depth), Some(discharge), None) if depth > 0.0 => (depth, discharge / section.area(depth)),
            (Some(_), Some(0.0), None) => (0.0, 0.0),
            _ => return None,
        };
        let sound = depth.is_finite() && velocity.is_finite();
        sound.then_some(HydrographPoint { time: at(times) - times[0], depth, velocity })
    };
    let rows: Option<Vec<HydrographPoint>> = (0..=(times.len() - 1) * parts).map(place).collect();
    let hydrograph = Hydrograph::new(rows?, &section);
    (hydrograph.volume(&section, hydrograph.duration()) > 0.0).then_some(hydrograph)
}

/// Volume that it brings, with pores (m³).
pub fn hydrograph_volume(e: &Entries) -> Option<f64> {
    let hydrograph = hydrograph(e)?;
    Some(hydrograph.volume(&section(e)?, hydrograph.duration()))
}

/// Way from the inlet to the barrier where the design gives none (m): as far as the flow reaches back when it lies there with a level surface,
/// and two depths more, and no less than a surge has.
fn clear_of_the_deposit(e: &Entries, hydrograph: &Hydrograph) -> Option<f64> {
    let (section, slope) = (section(e)?, e.number("channel.slope")?);
    let volume = hydrograph.volume(&section, hydrograph.duration());
    let depth = hydrograph.governing.first()?.moment.depth;
    let least = RUN_IN * depth;
    if slope <= 0.0 {
        return Some(least);
    }
    // V = S(H) cot α, as long as H cot α.
    let back = section.height_of_moment(volume * libm::tan(slope)) / libm::tan(slope);
    Some(least.max(back + 2.0 * depth))
}

/// Depth and velocity of its hardest row, and the way from the inlet, where it is given, as those of a surge.
pub fn as_of_a_surge(e: &Entries, name: &str) -> Option<f64> {
    let hydrograph = hydrograph(e)?;
    let hardest = hydrograph.governing.first()?.moment;
    match name {
        "depth" => Some(hardest.depth),
        "velocity" => Some(hardest.velocity),
        "run_in" => e.number(&key(name)).or_else(|| clear_of_the_deposit(e, &hydrograph)),
        _ => e.number(&key(name)),
    }
}
