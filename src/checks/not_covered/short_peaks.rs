//! Short peaks of the force on a wall, and of its moment. What is judged is a mean over a window; a boulder that hits is shorter than that.
//! Whether a wall follows so short a force is not known here: it holds it, or the check is open.

use super::context::CheckContext;
use crate::checks::outcome::{Kind, OpenReason, Outcome};
use crate::quantities::quantity::Unit;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let Some(seen) = context.seen else { return };
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::WallStrength && outcome.holds()) {
        let Some((simulated, capacity)) = outcome.demand.simulation.zip(outcome.capacity) else { continue };
        let over =
            if outcome.unit == Unit::Newton { seen.sampled_over_smoothed } else { seen.moment_sampled_over_smoothed };
        let at_most = simulated * over;
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

#[cfg(test)]
mod tests {
    use crate::checks::not_covered::context::FirstSurge;
    use crate::checks::not_covered::tests::{pushing, simulated_verdict};
    use crate::checks::outcome::CheckVerdict;
    use crate::design::BarrierDesign;
    use crate::design::read::read_design;
    use crate::quantities::counts::Counts;
    use crate::quantities::observed::Observed;
    use crate::quantities::{total_force, wall};

    /// A wall that holds 10 MN and 2 MN m/m, under 4 MN and 0.8 MN m/m by the smoothed signal.
    #[test]
    fn a_wall_is_open_where_a_single_sample_is_more_than_it_holds() {
        let mut design = read_design("x", include_bytes!("../../../designs/rigid_wall.yaml")).unwrap().design;
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        (wall.resistance, wall.moment_resistance, wall.resistance_factor) = (Some(10e6), Some(2e6), 1.0);
        // So soft that no grain of the flow breaks a metre.
        design.flow.modulus = 1.0;
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
