//! What the equations would fail, or would not be known for, with the velocity that the simulated flow arrives with and the K that its
//! deposit shows at rest, where these are larger than what the equations were given.

use super::Known;
use crate::checks::check_all;
use crate::checks::outcome::{Opening, Outcome};
use crate::checks::range::leave_open_outside_range;
use crate::demand::Demands;
use crate::demand::from_loads::guideline_for;
use crate::loads::input::GuidelineInput;

pub fn leave_open(known: Known, outcomes: &mut [Outcome]) {
    let Known { design, guideline, seen: Some(seen) } = known else { return };
    let given = guideline.input;
    let harder = GuidelineInput {
        velocity: seen.velocity.max(given.velocity),
        earth_pressure: seen.earth_pressure.unwrap_or(0.0).max(given.earth_pressure),
        ..given
    };
    if harder == given {
        return;
    }
    let then = guideline_for(design, harder);
    let mut checks = check_all(design, &Demands::by_equations(&then, &design.factors));
    let before: Vec<bool> = checks.iter().map(Outcome::holds).collect();
    leave_open_outside_range(design, &then, &mut checks);
    let found = [
        (harder.velocity > given.velocity)
            .then(|| format!("arrives with {:.2} m/s (given: {:.2} m/s)", harder.velocity, given.velocity)),
        (harder.earth_pressure > given.earth_pressure).then(|| {
            format!("presses at rest with K = {:.2} (given: {:.2})", harder.earth_pressure, given.earth_pressure)
        }),
    ];
    let found = found.into_iter().flatten().collect::<Vec<_>>().join(" and ");
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        let Some(place) = checks.iter().position(|then| then.id == outcome.id) else { continue };
        let (then, held) = (&checks[place], before[place]);
        let equations_count = outcome.governed_by_equations() || design.loads.to_the_top;
        let why = if then.fails_by_equations() {
            "the equations would fail this check"
        } else if held && !then.holds() && equations_count {
            "the equations would be used outside the range they are known for"
        } else {
            continue;
        };
        outcome.leave_open(Opening::Contradicted(format!("the simulated flow {found}; with what it shows, {why}")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::not_covered::FirstSurge;
    use crate::checks::not_covered::tests::small_net;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::from_loads::guideline;

    #[test]
    fn what_the_equations_would_fail_with_the_velocity_or_the_k_that_is_seen_is_open() {
        let design = small_net();
        let guideline = guideline(&design);
        let at = |velocity: f64, earth_pressure: Option<f64>| {
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let seen = FirstSurge { velocity, earth_pressure, ..FirstSurge::default() };
            leave_open(Known { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            outcomes.iter().filter(|outcome| outcome.verdict == CheckVerdict::Open).count()
        };
        let given = guideline.input.velocity;
        let open = at(given, None);
        assert_eq!(at(0.9 * given, Some(0.5)), open);
        assert_eq!(at(1.1 * given, None), open);
        assert!(at(2.0 * given, None) > open);
        assert_eq!(at(given, Some(1.2)), open);
        assert!(at(given, Some(20.0)) > open);
    }
}
