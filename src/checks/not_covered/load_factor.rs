//! A partial factor on loads that is not given is not 1.

use super::context::CheckContext;
use crate::checks::outcome::{OpenReason, Outcome};

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    if context.design.factors.load_given {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.resistance.is_some() && outcome.utilisation.is_some()) {
        if outcome.holds() {
            outcome.leave_open(OpenReason::NotGiven(
                "no partial factor on loads is given (give factors.set, or factors.load: 1 if the design flow is a design value itself)".into(),
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::checks::not_covered::tests::{small_net, verdict};
    use crate::checks::outcome::CheckVerdict;
    use crate::guideline::guideline;

    #[test]
    fn a_partial_factor_on_loads_that_is_not_given_is_not_one() {
        let mut design = small_net();
        let first = guideline(&design).first_surge();
        assert_eq!(verdict(&design, "rope_2_tension", first), CheckVerdict::Pass);
        design.factors.load_given = false;
        assert_eq!(verdict(&design, "rope_2_tension", first), CheckVerdict::Open);
    }

    #[test]
    fn what_has_no_resistance_or_no_utilisation_needs_no_factor() {
        let mut design = small_net();
        let first = guideline(&design).first_surge();
        design.factors.load_given = false;
        assert_eq!(verdict(&design, "brake_plateau", first), CheckVerdict::Pass);
    }
}
