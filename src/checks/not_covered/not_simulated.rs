//! What the simulation alone judges, or judges more severely than the equations, where the design asks for loads that it does not hold:
//! later surges of a larger event, a boulder, wood, snow, a flow over the full barrier.

use super::context::CheckContext;
use crate::checks::outcome::{Kind, OpenReason, Outcome};

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let (flow, loads) = (&context.design.flow, &context.design.loads);
    let several = flow.is_part_of_its_event().then_some("the later surges of the event");
    let weight = loads.self_weight.map(|_| "the weight of the net as given");
    let of_cases = context.guideline.cases.iter().filter_map(|case| case.not_simulated);
    let wood = loads.wood_factor.filter(|factor| *factor > 1.0).map(|_| "the wood in the flow");
    let missing: Vec<&str> = several.into_iter().chain(of_cases).chain(weight).chain(wood).collect();
    if missing.is_empty() {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.demand.simulation.is_some()) {
        // What has no utilisation is a dissipator at its plateau: its stroke tells. What is held has its own rule.
        if outcome.holds()
            && outcome.utilisation.is_some()
            && !outcome.governed_by_equations()
            && outcome.kind != Kind::MassHeld
        {
            outcome.leave_open(OpenReason::NotGiven(format!(
                "the simulation governs it and covers {}; it does not contain {}",
                match flow.surges() {
                    1 => "one surge on the empty barrier".to_string(),
                    several => format!("{several} surges, the first on the empty barrier"),
                },
                missing.join(", ")
            )));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::checks::not_covered::tests::{net_holds, net_verdict, small_net};
    use crate::checks::outcome::CheckVerdict;
    use crate::design::{Design, OutsideRange};
    use crate::guideline::guideline;
    use crate::quantities::{dissipator, mass, other_ropes, rope_tension};

    #[test]
    fn what_the_simulation_governs_is_open_where_it_lacks_a_load_that_the_design_asks_for() {
        let first = |design: &Design| guideline(design).largest_force;
        type Ask = fn(&mut Design);
        let asked: [Ask; 6] = [
            |design| design.loads.overflow_depth = Some(0.05),
            |design| design.flow.event_volume = 2.0 * design.flow.volume(),
            |design| design.loads.point_load = Some((1e3, Some(1.0))),
            |design| design.loads.snow_pressure = Some(1e3),
            |design| design.loads.drained = Some((0.5, 1800.0)),
            |design| design.loads.self_weight = Some(50.0),
        ];
        for ask in asked {
            let mut design = small_net();
            assert_eq!(net_verdict(&design, 0.4 * net_holds(&design), first(&design)), CheckVerdict::Pass);
            ask(&mut design);
            assert_eq!(net_verdict(&design, 0.4 * net_holds(&design), first(&design)), CheckVerdict::Open);
            // A gap is no formula outside its range.
            design.limits.outside_range = OutsideRange::Warn;
            assert_eq!(net_verdict(&design, 0.4 * net_holds(&design), first(&design)), CheckVerdict::Open);
        }
    }

    #[test]
    fn what_is_held_what_fails_and_what_the_equations_govern_is_left_as_it_is() {
        use super::*;
        use crate::checks::check_all;
        use crate::demand::{Demand, Demands};
        let mut design = small_net();
        design.flow.event_volume = design.flow.volume() + 0.5;
        let guideline = guideline(&design);
        let simulated = |simulation: f64| Demand { simulation: Some(simulation), ..Demand::default() };
        let by_equations = Demands::by_equations(&guideline, &design.factors);
        let mut ropes = by_equations.each(&rope_tension::PEAK).to_vec();
        ropes[2].simulation = Some(1.0);
        let demands = by_equations
            .with(&mass::RETAINED, &[simulated(1.0)])
            .with(&other_ropes::NET, &[simulated(0.4 * net_holds(&design))])
            .with(&other_ropes::LATERAL, &[simulated(1e9)])
            .with(&rope_tension::PEAK, &ropes)
            .with(&dissipator::TENSION, &[simulated(1.0)]);
        let before = check_all(&design, &demands);
        let mut after = before.clone();
        leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut after);
        let changed: Vec<&str> = before
            .iter()
            .zip(&after)
            .filter(|(before, after)| before.verdict != after.verdict)
            .map(|(before, _)| before.id.as_str())
            .collect();
        assert_eq!(changed, ["net_tension"]);
        // A tenth of a percent is rounding.
        design.flow.event_volume = 1.0005 * design.flow.volume();
        let mut same = before.clone();
        leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut same);
        assert_eq!(same, before);
    }
}
