//! The base of a wall that is less steep than the bed comes out of the ground downstream, unless it is founded deep enough below the face: what
//! stands in the air bears nothing.

use super::context::CheckContext;
use crate::checks::outcome::{OpenReason, Outcome};
use crate::design::BarrierDesign;

/// How far the edge of a base may stand above the bed, over its width.
const LEVELLED: f64 = 0.01;

pub fn leave_open(CheckContext { design, .. }: CheckContext, outcomes: &mut [Outcome]) {
    let BarrierDesign::RigidWall(wall) = &design.barrier else { return };
    let Some((stability, base_slope)) = wall.stability.and_then(|stability| Some((stability, stability.base_slope?)))
    else {
        return;
    };
    let falls = libm::tan(design.channel.slope) - libm::tan(base_slope);
    let needed = stability.base_width * libm::cos(base_slope) * falls;
    // Asked as "in the ground", so that what is not a number is not.
    let in_the_ground = needed - stability.founding_depth <= LEVELLED * stability.base_width;
    if in_the_ground {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        if matches!(outcome.id.as_str(), "wall_sliding" | "wall_overturning" | "wall_bearing" | "wall_eccentricity") {
            outcome.leave_open(OpenReason::NotGiven(format!(
                "the base is less steep than the bed, and its downstream edge would stand {:.2} m above the ground (give barrier.rigid_wall.stability.founding_depth, {needed:.2} m or more, or a base as steep as the bed)",
                needed - stability.founding_depth
            )));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demands;
    use crate::design::read::read_design;
    use crate::guideline::guideline;

    /// 7 m of a level base on a bed of 14°: 1.745 m, of which 7 cm may be missing.
    #[test]
    fn a_level_base_on_a_slope_is_founded_below_the_bed() {
        let verdict = |depth: f64| {
            let mut design = read_design("x", include_bytes!("../../../designs/gravity_wall.yaml")).unwrap().design;
            let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
            wall.stability.as_mut().expect("stability").founding_depth = depth;
            let guideline = guideline(&design);
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let outcome = outcomes.iter_mut().find(|outcome| outcome.id == "wall_sliding").expect("a check");
            (outcome.verdict, outcome.open) = (CheckVerdict::Pass, None);
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "wall_sliding").expect("it").verdict
        };
        assert_eq!((verdict(1.68), verdict(1.67)), (CheckVerdict::Pass, CheckVerdict::Open));
        assert_eq!(verdict(f64::NAN), CheckVerdict::Open);
    }
}
