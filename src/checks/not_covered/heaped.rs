//! How high the later surges of an event heap up against the barrier follows from how fast they come: what the simulation shows to be faster
//! than the design says may go over it.

use super::context::CheckContext;
use super::harder_flow::arriving;
use crate::checks::outcome::{Kind, OpenReason, Outcome};
use crate::guideline::{event_fill, height_over_bed};

pub fn leave_open(CheckContext { design, guideline, seen }: CheckContext, outcomes: &mut [Outcome]) {
    let Some(seen) = seen.filter(|_| design.flow.is_part_of_its_event()) else { return };
    let faster = arriving(guideline.input, &seen);
    let heaped = event_fill(design, &faster).reach();
    // Asked as "below", so that what is not a number is not.
    let below = heaped <= height_over_bed(design);
    if below {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::MassHeld && outcome.holds()) {
        outcome.leave_open(OpenReason::Contradicted(format!(
            "the simulated flow arrives with {:.2} m/s (given: {:.2} m/s), and with that the last surge of the event may run up to {heaped:.1} m, from what the others leave, over the barrier's {:.1} m, so that what of the later surges is held is not known",
            faster.velocity,
            guideline.input.velocity,
            height_over_bed(design)
        )));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::not_covered::context::FirstSurge;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::{Demand, Demands};
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use crate::quantities::mass;

    /// Two surges in one: the faster they come the higher the second heaps up.
    #[test]
    fn what_comes_faster_than_given_may_heap_up_over_the_barrier() {
        let mut design = read_design("x", include_bytes!("../../../designs/gravity_wall.yaml")).unwrap().design;
        let guideline = guideline(&design);
        // An event that just stays below with the given velocity.
        let height = |volume: f64| {
            let mut with = design.clone();
            with.flow.event_volume = volume;
            event_fill(&with, &guideline.input).reach()
        };
        let (mut low, mut high) = (design.flow.volume(), 100.0 * design.flow.volume());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if height(middle) > height_over_bed(&design) { high = middle } else { low = middle }
        }
        design.flow.event_volume = 0.99 * low;
        let verdict = |velocity: f64| {
            let held = Demand { simulation: Some(1.0), ..Demand::default() };
            let mut outcomes = check_all(&design, &Demands::default().with(&mass::RETAINED, &[held]));
            let outcome = outcomes.iter_mut().find(|outcome| outcome.kind == Kind::MassHeld).expect("a check");
            (outcome.verdict, outcome.open) = (CheckVerdict::Pass, None);
            let seen = FirstSurge { velocity, ..FirstSurge::default() };
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.kind == Kind::MassHeld).expect("it").verdict
        };
        let given = guideline.input.velocity;
        assert_eq!((verdict(0.9 * given), verdict(3.0 * given)), (CheckVerdict::Pass, CheckVerdict::Open));
        assert_eq!(verdict(f64::NAN), CheckVerdict::Open);
    }
}
