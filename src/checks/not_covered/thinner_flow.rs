//! A simulated surge that arrives with less momentum than the design says, as one does that draws out on its way: what the simulation governs
//! must hold in proportion to the momentum that was asked for.

use super::full_barrier::used_under_more;
use super::known::Known;
use crate::checks::outcome::{Opening, Outcome};

pub fn leave_open(known: Known, outcomes: &mut [Outcome]) {
    let Some(seen) = known.seen else { return };
    let more = 1.0 / seen.flux_share;
    if more <= 1.0 {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        let Some([used, _]) = used_under_more(known.design, outcome, more, seen) else { continue };
        // Written so that a NaN counts as not within.
        let within = used <= 1.0;
        if !within {
            outcome.leave_open(Opening::Contradicted(format!(
                "the simulated flow arrives with {:.0} % of the momentum flux h v² that the design gives it, and in proportion to the whole this would not hold (release it so that it arrives as it should: a shorter flow.arrival.surge.run_in, a larger depth)",
                100.0 * seen.flux_share
            )));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::not_covered::known::FirstSurge;
    use crate::checks::not_covered::tests::{net_holds, pushing, small_net};
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::{Demand, Demands};
    use crate::guideline::guideline;
    use crate::quantities::other_ropes;

    /// A net that uses 75 % under a flow that arrives with 80 % of its momentum uses 94 % under all of it, with 70 % 107 %.
    #[test]
    fn a_flow_that_arrives_with_less_momentum_is_held_in_proportion() {
        let design = small_net();
        let guideline = guideline(&design);
        let net_tension = Demand { simulation: Some(0.75 * net_holds(&design)), ..Demand::default() };
        let demands = Demands::default().with(&other_ropes::NET, &[net_tension]);
        let verdict = |flux_share: f64| {
            let seen = FirstSurge { flux_share, ..pushing(guideline.largest_force) };
            let mut outcomes = check_all(&design, &demands);
            leave_open(Known { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "net_tension").expect("a check").verdict
        };
        assert_eq!(verdict(1.0), CheckVerdict::Pass);
        assert_eq!(verdict(1.3), CheckVerdict::Pass);
        assert_eq!(verdict(0.8), CheckVerdict::Pass);
        assert_eq!(verdict(0.7), CheckVerdict::Open);
        assert_eq!(verdict(f64::NAN), CheckVerdict::Open);
    }
}
