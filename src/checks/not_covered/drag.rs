//! The drag of a flow over the barrier is known where its friction and length are given; a drag that is not given is not zero.

use super::context::CheckContext;
use crate::checks::check_all;
use crate::checks::outcome::{OpenReason, Outcome};
use crate::demand::Demands;
use crate::design::BarrierDesign;
use crate::guideline::guideline_for;
use crate::loads::cases::overtopped::DEFAULT_FRICTION;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let design = context.design;
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

/// A barrier that fills is overtopped whether the design says so or not: with a usual drag no check may fail.
fn leave_open_what_a_usual_drag_fails(CheckContext { design, guideline, .. }: CheckContext, outcomes: &mut [Outcome]) {
    if !guideline.input.fills() {
        return;
    }
    let mut dragged = design.clone();
    // It rides on the whole thickness of a wall.
    let thickness = match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.stability.map_or(0.0, |stability| stability.thickness),
        BarrierDesign::FlexibleNet(_) => 0.0,
    };
    dragged.loads.overflow_drag = Some((DEFAULT_FRICTION, guideline.input.depth.max(thickness)));
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
    use crate::design::Design;
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
