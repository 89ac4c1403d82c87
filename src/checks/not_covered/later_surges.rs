//! Surges over a deposit are in the equations alone: where the simulated first surge pushes harder than theirs, so would the later ones.

use super::known::Known;
use crate::checks::outcome::{Opening, Outcome};

/// Simulated over the guideline's force of a first surge up to which its K and λ are taken to hold for the later ones too: the scatter
/// of measured pressures (Bugnion et al. 2012: 20 % and more).
pub const LIKE_FIRST_SURGES: f64 = 1.25;

pub fn leave_open(known: Known, outcomes: &mut [Outcome]) {
    let Some(seen) = known.seen else { return };
    let ratio = seen.push / known.guideline.first_surge();
    // Written so that a NaN counts as not alike.
    let alike = ratio <= LIKE_FIRST_SURGES;
    let flow = &known.design.flow;
    let several = known.design.loads.to_the_top || flow.event_volume > 1.001 * flow.volume();
    if alike || !several {
        return;
    }
    let of_surges = |outcome: &&mut Outcome| {
        outcome.holds()
            && outcome.utilisation.is_some()
            && outcome.rests_on_pressures
            && outcome.demand.guideline.is_some()
    };
    for outcome in outcomes.iter_mut().filter(of_surges) {
        outcome.leave_open(Opening::Contradicted(format!(
            "the simulated first surge pushes {ratio:.2} times as hard as the guideline's, so that its later surges over a deposit are too low (raise factors.dynamic_lambda until they agree within {:.0} %, or give an event of a single surge, loads.filling: one_event)",
            100.0 * (LIKE_FIRST_SURGES - 1.0)
        )));
    }
}

#[cfg(test)]
mod tests {
    use super::leave_open;
    use crate::checks::not_covered::tests::{pushing, small_net, verdict, verdict_after};
    use crate::checks::outcome::CheckVerdict;
    use crate::guideline::guideline;
    use crate::quantities::{dissipator, other_ropes, rope_tension};

    #[test]
    fn later_surges_are_open_where_the_first_hits_harder_than_the_guideline_has_it() {
        let mut design = small_net();
        let first = guideline(&design).first_surge();
        assert_eq!(verdict(&design, "rope_2_tension", 1.2 * first), CheckVerdict::Pass);
        assert_eq!(verdict(&design, "rope_2_tension", 1.3 * first), CheckVerdict::Open);
        assert_eq!(verdict(&design, "rope_2_tension", f64::NAN), CheckVerdict::Open);
        // One event of several surges has later ones too.
        design.loads.to_the_top = false;
        design.flow.event_volume = 2.0 * design.flow.volume();
        assert_eq!(verdict_after(leave_open, &design, "rope_2_tension", pushing(1.3 * first)), CheckVerdict::Open);
        design.flow.event_volume = design.flow.volume();
        assert_eq!(verdict(&design, "rope_2_tension", 1.3 * first), CheckVerdict::Pass);
    }

    /// What fails, what has no utilisation and what does not hang on pressures stays as it is.
    #[test]
    fn only_what_holds_by_pressures_is_opened() {
        use crate::checks::check_all;
        use crate::checks::not_covered::known::Known;
        use crate::demand::{Demand, Demands};
        let design = small_net();
        let guideline = guideline(&design);
        let by_equations = Demands::by_equations(&guideline, &design.factors);
        let simulated = |value: f64| Demand { simulation: Some(value), ..Demand::default() };
        let mut ropes = by_equations.each(&rope_tension::PEAK).to_vec();
        ropes[1].guideline = Some(1e9);
        let demands = by_equations
            .with(&other_ropes::NET, &[simulated(1.0)])
            .with(&dissipator::TENSION, &[Demand { guideline: Some(1.0), ..simulated(1.0) }])
            .with(&rope_tension::PEAK, &ropes);
        let mut outcomes = check_all(&design, &demands);
        let seen = Some(pushing(2.0 * guideline.first_surge()));
        leave_open(Known { design: &design, guideline: &guideline, seen }, &mut outcomes);
        let verdict = |id: &str| outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict;
        let ids = ["rope_2_tension", "net_tension", "brake_plateau", "anchor_plateau", "rope_3_tension"];
        use CheckVerdict::{Fail, Open, Pass};
        assert_eq!(ids.map(verdict), [Fail, Pass, Pass, Pass, Open]);
    }
}
