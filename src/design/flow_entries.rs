//! What the entries of a design say of its flow: volume, grain sizes, how many grains that makes, and how it is cut.

use crate::design::entries::Entries;
use crate::design::flow::Boulders;
use crate::design::hydrograph_entries::hydrograph_volume;
use crate::design::schema::QUANTILES;
use crate::design::sizes::SizeCurve;
use crate::design::surge_entries::{surge, volume_of, volume_of_all};

/// Where the grain sizes of the flow stand.
pub const SIZES: &str = "flow.grain_sizes";

/// Volume of the flow with pores, from whichever of mass and volume was given; of a list of surges that of the first, of a hydrograph what
/// it brings.
pub fn flow_volume(entries: &Entries) -> Option<f64> {
    entries
        .number("flow.volume")
        .or_else(|| Some(entries.number("flow.mass")? / entries.number("flow.bulk_density")?))
        .or_else(|| volume_of(entries, &surge(0)))
        .or_else(|| hydrograph_volume(entries))
}

/// (share of the mass, diameter) of the quantiles that were typed, of the grain sizes at a path.
pub fn quantiles(e: &Entries, sizes: &str) -> Vec<(f64, f64)> {
    let typed = |(key, share): &(&str, f64)| Some((*share, e.number(&format!("{sizes}.curve.{key}"))?));
    QUANTILES.iter().filter_map(typed).collect()
}

/// The size curve of the flow, ends included, if it is sound.
pub fn size_curve(e: &Entries) -> Option<SizeCurve> {
    size_curve_at(e, SIZES)
}

/// The same of the grain sizes at a path.
pub fn size_curve_at(e: &Entries, sizes: &str) -> Option<SizeCurve> {
    let uniform = |key: &str| e.number(&format!("{sizes}.uniform.{key}"));
    if let (Some(smallest), Some(largest)) = (uniform("min"), uniform("max")) {
        return (smallest <= largest).then_some(SizeCurve::ByNumber { smallest, largest });
    }
    let points = quantiles(e, sizes);
    let rises = points.windows(2).all(|pair| pair[0].1 < pair[1].1);
    (points.len() >= 2 && rises).then(|| SizeCurve::through(&points))
}

/// The lowest share of the mass of which the grain sizes at a path give a size.
pub fn curve_known_from(e: &Entries, sizes: &str) -> f64 {
    quantiles(e, sizes).first().map_or(0.0, |(share, _)| *share)
}

/// The boulders that are listed; none where there is no list.
pub fn boulders(e: &Entries) -> Option<Vec<Boulders>> {
    let one = |number: usize| {
        let value = |key: &str| e.number(&format!("flow.boulders.{number}.{key}"));
        Some(Boulders {
            diameter: value("diameter")?,
            number: value("number")? as u32,
            at_front: e.chosen(&format!("flow.boulders.{number}.where"), &[("front", true), ("spread", false)])?,
            density: value("density").or_else(|| e.number("flow.solid_density")).unwrap_or(f64::NAN),
        })
    };
    (0..).take_while(|number| e.has_section(&format!("flow.boulders.{number}"))).map(one).collect()
}

/// Grains of all surges, as if all were of one curve.
pub fn grain_count(e: &Entries, curve: &SizeCurve) -> Option<f64> {
    let volume = volume_of_all(e).or_else(|| flow_volume(e))?;
    Some(curve.count(volume * solid_share(e)?))
}

/// Share of the flow's volume that is grains, as [`crate::design::Flow::solid_share`] has it.
pub fn solid_share(e: &Entries) -> Option<f64> {
    let (bulk, solid) = (e.number("flow.bulk_density")?, e.number("flow.solid_density")?);
    let fluid = e.number("flow.pore_fluid.density").unwrap_or(0.0);
    Some((bulk - fluid) / (solid - fluid))
}

/// Grains to which `coarsen: auto` cuts a curve down: what runs in minutes.
const COARSENED: f64 = 20_000.0;

/// Largest share of the mass that it cuts.
pub const MOST_CUT: f64 = 0.9;

/// Below which share of the mass the curve is cut, where the design asks for that and has more grains than run in minutes; nothing
/// where it does not, or where no cut is enough.
pub fn coarsened(e: &Entries, curve: &SizeCurve) -> Option<f64> {
    if e.text("simulation.coarsen") != Some("auto") || grain_count(e, curve)? <= COARSENED {
        return None;
    }
    let enough = |share: f64| grain_count(e, &curve.cut_below(share)).is_some_and(|count| count <= COARSENED);
    let (mut low, mut high) = (0.0, MOST_CUT);
    if !enough(high) {
        return None;
    }
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if enough(middle) { high = middle } else { low = middle }
    }
    Some(high)
}
