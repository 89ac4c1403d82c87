//! Short peaks of the force on a wall. What is judged is a mean over a window; a boulder that hits is shorter than that. Whether a wall
//! follows so short a force is not known here, and a design that names the hit of its largest boulder has it in the equations.

use super::Known;
use crate::checks::outcome::{Kind, Opening, Outcome};

pub fn leave_open(known: Known, outcomes: &mut [Outcome]) {
    let Some(seen) = known.seen else { return };
    if known.design.loads.point_load.is_some() {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::WallStrength && outcome.holds()) {
        let Some((simulated, capacity)) = outcome.demand.simulation.zip(outcome.capacity) else { continue };
        let at_most = simulated * seen.sampled_over_smoothed;
        // Written so that a NaN counts as not within.
        let within = at_most <= capacity;
        if !within {
            outcome.leave_open(Opening::NotGiven(format!(
                "what is judged is a mean over a short time, and the largest single sample is {:.0} % of what the wall holds (give loads.point_load, the hit of the largest boulder, or more resistance)",
                100.0 * at_most / capacity
            )));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::checks::not_covered::FirstSurge;
    use crate::checks::not_covered::tests::{pushing, simulated_verdict};
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::from_histories::Observed;
    use crate::design::BarrierDesign;
    use crate::design::read::read_design;

    /// A wall that holds 10 MN and 2 MN m/m, under 4 MN and 0.8 MN m/m by the smoothed signal.
    #[test]
    fn a_wall_is_open_where_a_single_sample_is_more_than_it_holds_and_no_boulder_is_named() {
        let mut design = read_design("x", include_bytes!("../../../designs/rigid_wall.yaml")).unwrap().design;
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        (wall.resistance, wall.moment_resistance, wall.resistance_factor) = (Some(10e6), Some(2e6), 1.0);
        let observed = Observed { force_peak: 4e6, moment_peak: 0.8e6, ..Observed::of_ropes(0) };
        let verdicts = |design: &crate::design::Design, sampled_over_smoothed: f64| {
            let seen = FirstSurge { sampled_over_smoothed, ..pushing(1e9) };
            ["total_force", "wall_moment"].map(|id| simulated_verdict(design, id, &observed, seen))
        };
        assert_eq!(verdicts(&design, 2.4), [CheckVerdict::Pass; 2]);
        assert_eq!(verdicts(&design, 2.6), [CheckVerdict::Open; 2]);
        assert_eq!(verdicts(&design, f64::NAN), [CheckVerdict::Open; 2]);
        design.loads.point_load = Some((1e3, 1.0));
        assert_ne!(verdicts(&design, 2.6)[0], CheckVerdict::Fail);
    }
}
