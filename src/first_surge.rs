//! What the simulation shows of a surge, as of one that comes first to the empty barrier: what the checks of loads that nothing covers are asked with.

use crate::arriving;
use crate::checks::not_covered::context::{AtOnce, FirstSurge};
use crate::design::{BarrierDesign, Design};
use crate::fidelity::ladder::Rung;
use crate::guideline::{Guideline, earth_pressure_by_weight};
use crate::larger::larger_or_nan;
use crate::quantities::observed::Observed;
use crate::quantities::quantity::Quantity;
use crate::quantities::{
    anchor_load, bed, boulder, earth_pressure, other_ropes, posts, rope_tension, total_force, wall,
};
use crate::simulated::{Simulated, Start};
use crate::stages::push_on_empty;
use crate::starts::Spread;

/// By how much the next run may push harder than a single one: on the nets of the examples the push scatters with standard deviations of 3
/// to 5 %, on rigid walls of up to 16 %, and there the single one may be the mildest of several (381 to 580 kN in six).
const ONE_RUN: [f64; 2] = [1.08, 1.6];

/// What the simulation shows of one surge, counted from 0, as of one that comes first; `design` is led by it.
pub fn shown_by(
    rung: &Rung,
    design: &Design,
    number: usize,
    guideline: &Guideline,
    simulated: &Simulated,
) -> FirstSurge {
    // What fills later presses with its weight as well, whatever the first deposit shows.
    let by_weight = design.loads.to_the_top.then(|| earth_pressure_by_weight(design, guideline)).flatten();
    let band = rung.band;
    let short_peaks = |of: fn(&Observed) -> [f64; 2]| {
        let ratios = simulated
            .starts
            .iter()
            .map(|start| of(&start.observed))
            .map(|[sampled, smoothed]| above(sampled, smoothed));
        ratios.fold(1.0, larger_or_nan)
    };
    // Of the deposit at the end, and of what each surge has left.
    let of_deposits = |seen: &dyn Fn(&Start) -> Option<f64>| {
        let at_rest: Vec<f64> = simulated.starts.iter().filter_map(seen).collect();
        (!at_rest.is_empty()).then(|| Spread::of(&at_rest).mean)
    };
    let of_the_whole = |k: f64| design.flow.pore_fluid.map_or(k, |fluid| fluid.of_the_whole(k).max(k));
    let k_of = |seen: &Observed| seen.known(&earth_pressure::OF_ANY_DEPTH).map(of_the_whole);
    let at_the_end = of_deposits(&|start| k_of(&start.observed));
    let of_surges = (0..design.flow.surges()).filter_map(|surge| of_deposits(&|start| k_of(start.surges.get(surge)?)));
    let seen = at_the_end.into_iter().chain(of_surges).reduce(larger_or_nan);
    let over = |value: &dyn Fn(&Start) -> f64| Spread::of(&simulated.starts.iter().map(value).collect::<Vec<_>>());
    // One that shows no λ, because the barrier is full when it comes, tells nothing more than is given.
    let push = over(&|start| push_on_empty(design, start, number).unwrap_or_else(|| guideline.first_surge()));
    let arrives = arriving::of_surge(design, simulated, number);
    let on_a_wall = matches!(design.barrier, BarrierDesign::RigidWall(_));
    let one_run = ONE_RUN[usize::from(on_a_wall)];
    let hardest = |spread: &Spread| if spread.starts > 1 { spread.upper() } else { one_run * spread.mean };
    let hit = over(&|start| start.observed.one(&boulder::FORCE));
    FirstSurge {
        push: push.mean,
        boulder: if design.flow.boulders.is_empty() { 0.0 } else { hardest(&hit) },
        gentlest_boulder: (!design.flow.boulders.is_empty()).then(|| {
            let hits = simulated.all().map(|start| start.observed.one(&boulder::FORCE));
            hits.fold(f64::INFINITY, |least, hit| -larger_or_nan(-least, -hit))
        }),
        one_run: if push.starts > 1 { 0.0 } else { one_run - 1.0 },
        largest_push: simulated.spread(|seen| seen.one(&total_force::PUSH)).mean,
        hardest_push: hardest(&push),
        moment: simulated.spread(|seen| seen.one(&wall::MOMENT)).mean,
        sampled_over_smoothed: short_peaks(|seen| [seen.one(&total_force::PEAK_SAMPLED), seen.one(&total_force::PEAK)]),
        moment_sampled_over_smoothed: short_peaks(|seen| [seen.one(&wall::MOMENT_SAMPLED), seen.one(&wall::MOMENT)]),
        at_once: at_once(simulated),
        depth: arrives.depth,
        velocity: arrives.velocity,
        flux_share: arrives.flux_share,
        earth_pressure: seen.into_iter().chain(by_weight).reduce(larger_or_nan),
        force_band: if on_a_wall { rung.on_a_wall } else { band.force },
        net_band: rung.of_the_net,
        stroke_band: band.stroke,
        share_band: band.share,
    }
}

/// A largest load at an instant over the largest mean, at least 1. Where no mean presses, an instant that does is more by any ratio; what is not a
/// number stays so, or is infinite.
fn above(instant: f64, mean: f64) -> f64 {
    if instant <= mean {
        1.0
    } else if mean > 0.0 {
        instant / mean
    } else {
        f64::INFINITY
    }
}

/// By how much what bears a net is loaded more at an instant than in the mean over a sample, as the next packing may exceed both with a
/// probability of 5 %.
pub fn at_once(simulated: &Simulated) -> AtOnce {
    let ratio = |instant: &Quantity, sample: &Quantity| {
        let rows = simulated.first().each(sample).len();
        let ratios = (0..rows).map(|row| {
            let largest = |of: &Quantity| {
                let seen = simulated.starts.iter().map(|start| start.observed.each(of).get(row).copied());
                let spread = Spread::of(&seen.map(|value| value.unwrap_or(f64::NAN)).collect::<Vec<_>>());
                if spread.starts > 1 { spread.upper() } else { spread.mean }
            };
            let [instant, mean] = [instant, sample].map(largest);
            above(instant, mean)
        });
        ratios.fold(1.0, larger_or_nan)
    };
    AtOnce {
        main_ropes: ratio(&rope_tension::AT_ONCE, &rope_tension::PEAK),
        net: ratio(&other_ropes::NET_AT_ONCE, &other_ropes::NET),
        lateral_ropes: ratio(&other_ropes::LATERAL_AT_ONCE, &other_ropes::LATERAL),
        anchors: ratio(&anchor_load::AT_ONCE, &anchor_load::PEAK),
        bolts: larger_or_nan(ratio(&bed::BOLT_AT_ONCE, &bed::BOLT), ratio(&bed::SPACE_AT_ONCE, &bed::SPACE)),
        posts: larger_or_nan(
            ratio(&posts::COMPRESSION_AT_ONCE, &posts::COMPRESSION),
            ratio(&posts::RETAINING_AT_ONCE, &posts::RETAINING),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arriving::tests::{arriving, simulated, small_net};
    use crate::fidelity::ladder::RUNGS;
    use crate::guideline::guideline as guideline_of;

    #[test]
    fn an_instant_is_never_less_than_the_mean() {
        assert_eq!([(3.0, 2.0), (0.0, 0.0), (1.0, 2.0)].map(|(instant, mean)| above(instant, mean)), [1.5, 1.0, 1.0]);
        assert_eq!(
            [(1.0, 0.0), (1.0, -2.0), (1.0, f64::NAN)].map(|(instant, mean)| above(instant, mean)),
            [f64::INFINITY; 3]
        );
        assert!(above(f64::NAN, 1.0).is_nan());
    }

    #[test]
    fn what_the_first_surge_shows_is_the_mean_of_its_packings_with_the_band_of_the_rung() {
        let design = small_net();
        let guideline = guideline_of(&design);
        let seen = |push_peak: f64, k_effective: Option<f64>, sampled: f64| {
            arriving(push_peak * 1e-4, 10.0)
                .with(&total_force::PUSH, &[push_peak])
                .with(&earth_pressure::OF_ANY_DEPTH, k_effective.as_slice())
                .with(&total_force::PEAK, &[100e3])
                .with(&total_force::PEAK_SAMPLED, &[sampled])
                .with(&wall::MOMENT, &[50e3])
                .with(&wall::MOMENT_SAMPLED, &[125e3])
        };
        let starts = simulated(vec![seen(40e3, Some(0.8), 150e3), seen(60e3, None, 120e3)]);
        let first = shown_by(&RUNGS[2], &design, 0, &guideline, &starts);
        assert_eq!((first.push, first.velocity, first.earth_pressure), (50e3, 5.0, Some(0.8)));
        assert_eq!((first.sampled_over_smoothed, first.moment_sampled_over_smoothed), (1.5, 2.5));
        // 10 m³/s² of the 0.6 · 4.6² that the design gives.
        assert!((first.flux_share - 0.78765).abs() < 1e-5, "{}", first.flux_share);
        let band = RUNGS[2].band;
        assert_eq!((first.force_band, first.stroke_band, first.share_band), (band.force, band.stroke, band.share));
        // What fills the barrier later presses with its weight as well: the larger of that K and the one that is seen.
        let by_weight = crate::guideline::earth_pressure_by_weight(&design, &guideline);
        let k = |seen_k: Option<f64>| {
            shown_by(&RUNGS[2], &design, 0, &guideline, &simulated(vec![seen(40e3, seen_k, 1.0)])).earth_pressure
        };
        assert!(by_weight.is_some_and(|k| k > 0.1 && k < 0.8));
        assert_eq!((k(None), k(Some(0.1)), k(Some(0.8))), (by_weight, by_weight, Some(0.8)));
        // Mean and k₂ = 7.733 standard deviations of two, a fixed margin on one.
        assert!((first.hardest_push / (50e3 + 7.733 * 14.142e3) - 1.0).abs() < 1e-3, "{}", first.hardest_push);
        let alone = shown_by(&RUNGS[2], &design, 0, &guideline, &simulated(vec![seen(40e3, None, 1.0)]));
        assert_eq!(alone.hardest_push, 1.08 * 40e3);
        let hidden = simulated(vec![seen(40e3, None, 1.0)]);
        let mut one_event = design.clone();
        one_event.loads.to_the_top = false;
        assert_eq!(shown_by(&RUNGS[2], &one_event, 0, &guideline, &hidden).earth_pressure, None);
    }
}
