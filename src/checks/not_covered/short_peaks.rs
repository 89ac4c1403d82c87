//! Short peaks of the force on a wall and of its moment, and of what ropes, net, anchors, bolts and posts bear. What is judged is a mean over a time; a
//! boulder that hits is shorter than that. Whether a wall or a bolt follows so short a force is not known here: it holds it, or the check is open.

use super::context::CheckContext;
use crate::checks::outcome::{Kind, OpenReason, Outcome, Route, Scaled};
use crate::larger::larger_or_nan;
use crate::quantities::quantity::Unit;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let Some(seen) = context.seen else { return };
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        let Some(over) = seen.at_once.of(outcome.kind) else { continue };
        let Some(at_once) = used_under(outcome, over) else { continue };
        // Written so that a NaN counts as not within.
        let within = at_once <= 1.0;
        if !within {
            outcome.leave_open(OpenReason::Contradicted(format!(
                "what is judged is a mean over a short time; at one instant it bears {over:.2} times as much, {:.0} % of what it holds (give it more resistance)",
                100.0 * at_once
            )));
        }
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::WallStrength && outcome.holds()) {
        let Some((_, capacity)) = outcome.demand.simulation.zip(outcome.capacity) else { continue };
        let over = if outcome.unit == Unit::NewtonMetrePerMetre {
            seen.moment_sampled_over_smoothed
        } else {
            seen.sampled_over_smoothed
        };
        // Of what the flow does, not of what is there without it.
        let at_most = outcome.demand_under(Route::Simulation, over).unwrap_or(f64::NAN);
        // Written so that a NaN counts as not within.
        let within = |value: f64| value <= capacity;
        if within(at_most) && !within(at_most * (1.0 + seen.force_band)) {
            outcome.leave_open(OpenReason::TooClose(format!(
                "the largest single sample is {:.0} % of what the wall holds, and other runs may show larger ones ({})",
                100.0 * at_most / capacity,
                seen.known_better()
            )));
        } else if !within(at_most) {
            outcome.leave_open(OpenReason::NotGiven(format!(
                "what is judged is a mean over a short time, and the largest single sample is {:.0} % of what the wall holds (give it more resistance)",
                100.0 * at_most / capacity
            )));
        }
    }
}

/// Share of its capacity that a check uses under so many times the simulated load, on top of what the guideline has more than that.
pub fn used_under(outcome: &Outcome, times: f64) -> Option<f64> {
    let (simulated, capacity) = outcome.demand.simulation.zip(outcome.capacity)?;
    let scaled = outcome.scaled.unwrap_or(Scaled { more: 1.0, used: 0.0 });
    let full = outcome.demand_under(Route::Simulation, scaled.more * times).unwrap_or(f64::NAN);
    // Where dissipators yield no rope pulls harder than they let it; asked so that what is not a number stays so.
    let cap = outcome.demand.cap.map_or(f64::INFINITY, |cap| times * cap.max(simulated));
    let demand = if full > cap { cap } else { full };
    Some(larger_or_nan(demand / capacity, scaled.used))
}

#[cfg(test)]
mod tests {
    use crate::checks::not_covered::context::{AtOnce, FirstSurge};
    use crate::checks::not_covered::tests::{net_holds, pushing, simulated_verdict, small_net};
    use crate::checks::outcome::CheckVerdict;
    use crate::design::BarrierDesign;
    use crate::design::read::read_design;
    use crate::quantities::counts::Counts;
    use crate::quantities::observed::Observed;
    use crate::quantities::{other_ropes, total_force, wall};

    /// A net that uses 60 % in the mean over a sample, and half as much again, or seven tenths, at an instant.
    #[test]
    fn a_net_is_open_where_it_bears_more_at_an_instant_than_it_holds() {
        let design = small_net();
        let observed = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
            .with(&other_ropes::NET, &[0.6 * net_holds(&design)]);
        let verdict = |over: f64| {
            let at_once = AtOnce { net: over, ..AtOnce::default() };
            simulated_verdict(&design, "net_tension", &observed, FirstSurge { at_once, ..pushing(1e9) })
        };
        assert_eq!([1.5, 1.7, f64::NAN].map(verdict), [CheckVerdict::Pass, CheckVerdict::Open, CheckVerdict::Open]);
    }

    /// A wall that holds 10 MN and 2 MN m/m, under 4 MN and 0.8 MN m/m by the smoothed signal.
    #[test]
    fn a_wall_is_open_where_a_single_sample_is_more_than_it_holds() {
        let mut design = read_design("x", include_bytes!("../../../designs/rigid_wall.yaml")).unwrap().design;
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        (wall.resistance, wall.moment_resistance, wall.resistance_factor) = (Some(10e6), Some(2e6), 1.0);
        // So soft that no grain of the flow breaks a metre.
        (design.flow.modulus, design.loads.impact_reduction) = (1.0, Some(0.0));
        let observed =
            Observed::of_nothing(Counts::default()).with(&total_force::PEAK, &[4e6]).with(&wall::MOMENT, &[0.8e6]);
        let verdicts = |design: &crate::design::Design, force: f64, moment: f64| {
            let seen = FirstSurge {
                sampled_over_smoothed: force,
                moment_sampled_over_smoothed: moment,
                moment: 1e12,
                ..pushing(1e9)
            };
            ["total_force", "wall_moment"].map(|id| simulated_verdict(design, id, &observed, seen))
        };
        use CheckVerdict::{Open, Pass};
        assert_eq!(verdicts(&design, 2.4, 2.4), [Pass, Pass]);
        assert_eq!(verdicts(&design, 2.6, 2.4), [Open, Pass]);
        assert_eq!(verdicts(&design, 2.4, 2.6), [Pass, Open]);
        assert_eq!(verdicts(&design, f64::NAN, f64::NAN), [Open, Open]);
        // One packing may be the mildest.
        let seen = FirstSurge { sampled_over_smoothed: 2.0, force_band: 0.3, moment: 1e12, ..pushing(1e9) };
        assert_eq!(simulated_verdict(&design, "total_force", &observed, seen), Open);
        let seen = FirstSurge { force_band: 0.2, ..seen };
        assert_eq!(simulated_verdict(&design, "total_force", &observed, seen), Pass);
        // A boulder that is named is no excuse: the equations may have it smaller than what was seen.
        design.loads.point_load = Some((1.0, Some(0.1)));
        assert_eq!(verdicts(&design, 2.6, 2.4)[0], Open);
    }
}
