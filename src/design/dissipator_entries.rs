//! What the entries of a design say of its dissipators.

use crate::yield_curve::YieldCurve;

use crate::design::dissipator::DissipatorDesign;
use crate::design::entries::Entries;

/// Where dissipators stand: those of the main ropes, and those of the ropes that retain posts.
pub const OF_MAIN_ROPES: &str = "barrier.flexible_net.dissipators";
pub const OF_RETAINING_ROPES: &str = "barrier.flexible_net.posts.retaining_ropes.dissipators";
pub const PLACES: [&str; 2] = [OF_MAIN_ROPES, OF_RETAINING_ROPES];

/// Keys of a curve: strokes as they are left after unloading, travel as it was measured under the force.
pub const CURVES: [&str; 2] = ["after_unloading", "under_load"];

/// Where a key of them stands.
pub fn key(place: &str, name: &str) -> String {
    format!("{place}.{name}")
}

/// Where a curve stands that was told one way or the other.
pub fn curve_key(place: &str, name: &str) -> String {
    format!("{place}.curve.{name}")
}

/// Share of the whole stroke below which two points of a curve are one.
pub const SAME: f64 = 1e-6;

/// Points of stroke after unloading (m) and force (N) of one dissipator; nothing where none are given. Under a force F the elastic travel F/k is
/// a part of what was measured.
pub fn points(e: &Entries, place: &str) -> Option<Vec<[f64; 2]>> {
    if let Some(points) = e.points(&curve_key(place, CURVES[0])) {
        return Some(points.to_vec());
    }
    let (travels, stiffness) = (e.points(&curve_key(place, CURVES[1]))?, e.number(&key(place, "stiffness"))?);
    let whole = travels.last()?[0];
    let mut points: Vec<[f64; 2]> = Vec::new();
    for [travel, force] in travels {
        let stroke = travel - force / stiffness;
        let last = points.last().map_or(f64::NEG_INFINITY, |last| last[0]);
        if (stroke - last).abs() >= SAME * whole {
            points.push([stroke, *force]);
        } else if points.len() == 1 {
            // As stiff as it is elastically: it has not yielded up to here.
            points[0][1] = *force;
        } else {
            // As stiff again further on, after it has yielded: up to the higher force on hardly any stroke.
            points.push([last + SAME * whole, *force]);
        }
    }
    Some(points)
}

/// Dissipators of one rope end, all that stand there together; nothing where they are not told soundly.
pub fn dissipators(e: &Entries, place: &str) -> Option<DissipatorDesign> {
    let number = |name: &str| e.number(&key(place, name));
    let (curve, [plateau, stroke]) = match points(e, place) {
        Some(points) => {
            let sound = points.len() > 1 && points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
            let (curve, scale) = sound.then(|| YieldCurve::of(&points))?;
            (curve, scale)
        }
        None => (YieldCurve::default(), [number("plateau_force")?, number("stroke")?]),
    };
    let [in_series, side_by_side] = [number("in_series")?, number("side_by_side")?];
    Some(DissipatorDesign {
        plateau: plateau * side_by_side,
        curve,
        stroke: stroke * in_series,
        stiffness: number("stiffness")? * side_by_side / in_series,
        lower_bound: number("lower_bound"),
        devices: in_series * side_by_side,
    })
}
