//! The drag of a flow over the barrier is known where its friction and length are given; a drag that is not given is not zero.

use super::context::CheckContext;
use crate::checks::check_all;
use crate::checks::outcome::{OpenReason, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::guideline::{flows, guideline_for};
use crate::larger::larger_or_nan;
use crate::loads::cases::overtopped::DEFAULT_FRICTION;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let design = context.design;
    leave_open_what_the_surge_itself_would_fail(context, outcomes);
    if design.loads.overflow_drag.is_some() {
        return;
    }
    if design.loads.overflow_depth.is_none() {
        leave_open_what_a_usual_drag_fails(context, outcomes);
        return;
    }
    for outcome in outcomes.iter_mut() {
        if outcome.holds() && outcome.rests_on_pressures && outcome.demand.guideline.is_some() {
            outcome.leave_open(OpenReason::NotGiven(
                "the drag of the flow over the full barrier is not in it (give loads.overflow_friction and loads.overflow_length)".into(),
            ));
        }
    }
}

/// A surge that comes to the full barrier goes over it as deep as it is, and rides on the whole thickness of a wall: where the design gives less, no
/// check may fail with that.
fn leave_open_what_the_surge_itself_would_fail(
    CheckContext { design, guideline, .. }: CheckContext,
    outcomes: &mut [Outcome],
) {
    let flows = flows(design, guideline.input);
    let deepest = flows.iter().filter(|flow| flow.fills()).map(|flow| flow.depth).fold(0.0, larger_or_nan);
    let thickness = thickness(design);
    let (depth, drag) = (design.loads.overflow_depth, design.loads.overflow_drag);
    // Asked as "enough", so that what is not a number is not.
    let enough = [depth.is_none_or(|depth| depth >= deepest), drag.is_none_or(|(_, length)| length >= thickness)];
    if enough == [true; 2] {
        return;
    }
    let mut over = design.clone();
    over.loads.overflow_depth = depth.map(|depth| larger_or_nan(depth, deepest));
    over.loads.overflow_drag = drag.map(|(friction, length)| (friction, length.max(thickness)));
    let asked = guideline_for(&over, guideline.input);
    let then = check_all(&over, &Demands::by_equations(&asked, &design.factors));
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        if deepest.is_nan() || then.iter().any(|then| then.id == outcome.id && outcome.would_fail(then)) {
            outcome.leave_open(OpenReason::Contradicted(format!(
                "a surge of {deepest:.2} m comes to the full barrier, and with that depth over it and a drag over its whole thickness the equations would fail this check (give loads.overflow_depth and loads.overflow_length that are no less)"
            )));
        }
    }
}

/// Of a wall that stands by its weight (m); what is known of no other barrier.
fn thickness(design: &Design) -> f64 {
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.stability.map_or(0.0, |stability| stability.thickness),
        BarrierDesign::FlexibleNet(_) => 0.0,
    }
}

/// A barrier that fills is overtopped whether the design says so or not: with a usual drag no check may fail.
fn leave_open_what_a_usual_drag_fails(CheckContext { design, guideline, .. }: CheckContext, outcomes: &mut [Outcome]) {
    if !guideline.input.fills() {
        return;
    }
    let mut dragged = design.clone();
    // It rides on the whole thickness of a wall.
    dragged.loads.overflow_drag = Some((DEFAULT_FRICTION, guideline.input.depth.max(thickness(design))));
    let with_drag = guideline_for(&dragged, guideline.input);
    let then = check_all(design, &Demands::by_equations(&with_drag, &design.factors));
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        if then.iter().any(|then| then.id == outcome.id && outcome.would_fail(then)) {
            outcome.leave_open(OpenReason::NotGiven(
                "with a usual drag of the flow over the full barrier the equations would fail it (give loads.overflow_friction and loads.overflow_length)".into(),
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::not_covered::tests::{pushing, small_net, verdict, verdict_after};
    use crate::checks::outcome::CheckVerdict;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use crate::quantities::other_ropes;

    #[test]
    fn a_flow_over_the_barrier_without_its_drag_leaves_pressures_open() {
        let mut design = small_net();
        let first = |design: &Design| guideline(design).first_surge();
        design.loads.overflow_depth = Some(0.05);
        assert_eq!(verdict(&design, "rope_3_tension", first(&design)), CheckVerdict::Open);
        design.loads.overflow_drag = Some((0.3, 0.5));
        assert_eq!(verdict(&design, "rope_3_tension", first(&design)), CheckVerdict::Pass);
    }

    /// A wall that holds the full barrier with a surge over it, given as deep as it is, by half of what the surge adds: with a depth of a millimetre it
    /// uses less, and is open.
    #[test]
    fn a_flow_over_the_barrier_is_no_thinner_than_the_surge_that_comes() {
        let mut design = read_design("x", include_bytes!("../../../designs/rigid_wall.yaml")).unwrap().design;
        (design.loads.to_the_top, design.loads.overflow_drag) = (true, Some((0.01, 10.0)));
        // So slow that the full barrier governs.
        let crate::design::Arrival::DamBreak(block) = &mut design.flow.arrival else { panic!("a dam break") };
        (block.depth_at_barrier, block.velocity_at_barrier) = (Some(1.0), Some(1.0));
        let surge = 1.0;
        let asked = |design: &Design| {
            let outcomes = check_all(design, &Demands::by_equations(&guideline(design), &design.factors));
            outcomes.into_iter().find(|outcome| outcome.id == "total_force").expect("a check")
        };
        let mut over = |depth: f64| {
            design.loads.overflow_depth = Some(depth);
            (design.clone(), asked(&design).demand.guideline.expect("a force"))
        };
        let [(thin, least), (deep, most)] = [1e-3, surge].map(&mut over);
        assert!(most > 1.02 * least, "{most} {least}");
        let verdict = |mut design: Design| {
            let crate::design::BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
            wall.resistance = Some(wall.resistance_factor * 0.5 * (least + most));
            let guideline = guideline(&design);
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut outcomes);
            outcomes.into_iter().find(|outcome| outcome.id == "total_force").expect("a check").verdict
        };
        assert_eq!(verdict(thin), CheckVerdict::Open);
        assert_eq!(verdict(deep), CheckVerdict::Fail);
    }

    /// A design that fills says nothing of the flow over its top: a rope that holds the last surge and not the usual drag beside it is open.
    #[test]
    fn a_barrier_that_fills_holds_a_usual_drag_or_is_open() {
        let mut design = small_net();
        let top = |design: &Design| guideline(design).ropes[2].state.tension;
        let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.dissipators = None;
        // Slow enough for the overtopped barrier to govern the top rope.
        let crate::design::Arrival::Surge(surge) = &mut design.flow.arrival else { panic!("a surge") };
        surge.velocity = 0.5;
        let without = top(&design);
        let mut dragged = design.clone();
        dragged.loads.overflow_drag = Some((DEFAULT_FRICTION, guideline(&design).input.depth));
        let with = top(&dragged);
        assert!(with > without, "{with} {without}");
        let verdict_of = |holds: f64| {
            let mut design = design.clone();
            let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            net.main_ropes.levels.iter_mut().for_each(|level| level.rope.breaking_load = holds * design.factors.rope);
            verdict_after(leave_open, &design, "rope_3_tension", pushing(0.0))
        };
        assert_eq!(verdict_of(1.2 * with), CheckVerdict::Pass);
        assert_eq!(verdict_of(0.5 * (with + without)), CheckVerdict::Open);
    }

    #[test]
    fn what_does_not_rest_on_pressures_or_is_simulated_alone_needs_no_drag() {
        use crate::demand::Demand;
        let mut design = small_net();
        design.loads.overflow_depth = Some(0.05);
        let guideline = guideline(&design);
        let net_tension = Demand { simulation: Some(1.0), ..Demand::default() };
        let demands = Demands::by_equations(&guideline, &design.factors).with(&other_ropes::NET, &[net_tension]);
        let mut outcomes = check_all(&design, &demands);
        leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut outcomes);
        let verdict = |id: &str| outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict;
        assert_eq!(verdict("net_tension"), CheckVerdict::Pass);
        assert_eq!(verdict("anchor_plateau"), CheckVerdict::Pass);
        assert_eq!(verdict("rope_3_tension"), CheckVerdict::Open);
    }
}
