//! A boulder that comes to rest before the barrier, or passes it by, loads nothing of it in the simulation; and on a net the equations have no boulder
//! of the flow. Another packing may bring it: what the simulation has shown of the net is then not all of the flow that was asked for.

use super::context::CheckContext;
use crate::checks::outcome::{Kind, OpenReason, Outcome};
use crate::design::BarrierDesign;

pub fn leave_open(CheckContext { design, seen, .. }: CheckContext, outcomes: &mut [Outcome]) {
    let (Some(seen), BarrierDesign::FlexibleNet(_)) = (seen, &design.barrier) else { return };
    let Some(hit) = seen.gentlest_boulder else { return };
    // Asked as "hits", so that what is not a number does not. What is recorded is the hardest of all: of those within the flow some may come late and
    // softly, or not at all, behind one that hits.
    let hits = hit > 0.0;
    let all_at_front = design.flow.boulders.iter().all(|boulders| boulders.at_front);
    if hits && all_at_front {
        return;
    }
    let why = if hits {
        "boulders within the flow may come to rest before they reach the net, so that their impact may be in no load (let boulders come at the front: `where: front`)"
    } else {
        "in a simulation no boulder of flow.boulders reaches the net, so that its impact is in no load (let boulders come at the front: `where: front`)"
    };
    // No load that the design gives stands for it: how hard it would hit the net is not known.
    let of_the_flow = |outcome: &&mut Outcome| {
        outcome.holds() && !outcome.of_parts && !matches!(outcome.kind, Kind::MassHeld | Kind::Level)
    };
    for outcome in outcomes.iter_mut().filter(of_the_flow) {
        outcome.leave_open(OpenReason::NotGiven(why.into()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::not_covered::context::FirstSurge;
    use crate::checks::not_covered::tests::{pushing, small_net, verdict_after};
    use crate::checks::outcome::CheckVerdict;
    use crate::guideline::guideline;

    #[test]
    fn a_net_that_a_boulder_of_the_flow_never_touches_is_open() {
        let mut design = small_net();
        let verdict = |design: &crate::design::Design, hit: Option<f64>| {
            let seen = FirstSurge { gentlest_boulder: hit, ..pushing(guideline(design).first_surge()) };
            verdict_after(leave_open, design, "rope_3_tension", seen)
        };
        let hits = [None, Some(1e3), Some(0.0), Some(f64::NAN)];
        let [pass, open] = [CheckVerdict::Pass, CheckVerdict::Open];
        assert_eq!(hits.map(|hit| verdict(&design, hit)), [pass, pass, open, open]);
        let boulder = |at_front: bool| crate::design::Boulders { diameter: 0.5, number: 1, at_front, density: 2650.0 };
        design.flow.boulders = vec![boulder(true)];
        assert_eq!(verdict(&design, Some(1e3)), pass);
        // Of one within the flow beside it nobody knows.
        design.flow.boulders.push(boulder(false));
        assert_eq!(verdict(&design, Some(1e3)), open);
        // A token load changes nothing.
        design.loads.point_load = Some((1.0, Some(0.5)));
        assert_eq!(verdict(&design, Some(0.0)), open);
    }
}
