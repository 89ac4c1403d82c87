//! The guideline's pressures were measured on flexible barriers: alone, without a simulation, they say little of a rigid wall.

use super::context::CheckContext;
use crate::checks::outcome::{OpenReason, Outcome, Route};
use crate::design::flow::RUN_IN;
use crate::design::resolve::granular_front;
use crate::design::{Arrival, BarrierDesign, Design};

/// Whether the design has a surge hit with a steeper front, or after a shorter way, than it would have by default.
fn hits_as_a_block(design: &Design) -> bool {
    let Arrival::Surge(surge) = design.flow.arrival else { return false };
    let front = granular_front(design.flow.effective(design.flow.grain_friction), design.channel.slope);
    // Asked as "like the default", so that what is not a number is not; where nothing is said of the grains the front is not known.
    let like_the_default = surge.front_angle <= front + 1e-6 && surge.run_in >= RUN_IN * surge.depth * (1.0 - 1e-6);
    !like_the_default && !design.flow.grain_friction.is_nan()
}

/// Simulated over the guideline's loads that may come out. The examples reach 1.8, 3.3 for bolts, and walls reached 2.2, and 4.6 under a vertical front at 20 m/s; the
/// rung of the equations in the ladder of models goes by it as well.
pub const SIMULATIONS_REACH: f64 = 5.0;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    if context.seen.is_some() || !matches!(context.design.barrier, BarrierDesign::RigidWall(_)) {
        return;
    }
    // Under a front that is made steeper than one of grains, or has no way to take shape, there is no such bound.
    let bounded = !hits_as_a_block(context.design);
    let close = |outcome: &&mut Outcome| {
        // Asked as "enough to spare", so that what is not a number has none.
        let reached = outcome.demand_under(Route::Guideline, SIMULATIONS_REACH).zip(outcome.capacity);
        let spare = bounded && reached.is_some_and(|(reached, capacity)| reached <= capacity);
        outcome.holds() && outcome.resistance.is_some() && outcome.rests_on_pressures && !spare
    };
    for outcome in outcomes.iter_mut().filter(close) {
        outcome.leave_open(OpenReason::NeedsSimulation(match bounded {
            true => format!(
                "the guideline's pressures were measured on flexible barriers, and a simulation may show up to {SIMULATIONS_REACH} times as much on a rigid wall (run the simulation)"
            ),
            false => "the surge has a steeper front or a shorter run-in than by default, and how much harder it hits a rigid wall than the guideline says is not known (run the simulation, or leave front_angle and run_in out)".to_string(),
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::not_covered::tests::{pushing, small_net};
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demands;
    use crate::design::Design;
    use crate::design::read::read_design;
    use crate::guideline::guideline;

    /// Verdict on a wall, or rope, that the equations load to a share of what it resists.
    fn verdict(design: &Design, id: &str, used: f64, simulated: bool) -> CheckVerdict {
        let guideline = guideline(design);
        let mut outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
        let outcome = outcomes.iter_mut().find(|outcome| outcome.id == id).expect("a check");
        outcome.demand.guideline = outcome.capacity.map(|capacity| used * capacity);
        (outcome.utilisation, outcome.verdict) = (Some(used), CheckVerdict::Pass);
        leave_open(
            CheckContext { design, guideline: &guideline, seen: simulated.then(|| pushing(1.0)) },
            &mut outcomes,
        );
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    #[test]
    fn a_wall_by_the_equations_alone_needs_much_to_spare() {
        let wall = read_design("x", include_bytes!("../../../designs/rigid_wall.yaml")).unwrap().design;
        assert_eq!(verdict(&wall, "total_force", 0.19, false), CheckVerdict::Pass);
        assert_eq!(verdict(&wall, "total_force", 0.21, false), CheckVerdict::Open);
        assert_eq!(verdict(&wall, "wall_moment", 0.21, false), CheckVerdict::Open);
        assert_eq!(verdict(&wall, "total_force", f64::NAN, false), CheckVerdict::Open);
        assert_eq!(verdict(&wall, "total_force", 0.56, true), CheckVerdict::Pass);
        assert_eq!(verdict(&small_net(), "rope_2_tension", 0.56, false), CheckVerdict::Pass);
    }
}
