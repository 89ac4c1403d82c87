//! A fluid in all pores presses with at least the share ρ_f/ρ of the whole once it is at rest. A flow that is said to have less has pores that
//! are not full, or that widen as it moves, neither of which is simulated: its friction may be too high.

use super::context::CheckContext;
use crate::checks::outcome::{OpenReason, Outcome};

pub fn leave_open(CheckContext { design, seen, .. }: CheckContext, outcomes: &mut [Outcome]) {
    let Some(fluid) = design.flow.pore_fluid.filter(|_| seen.is_some()) else { return };
    let at_rest = fluid.density / design.flow.bulk_density;
    // Asked as "full", so that what is not a number is not; with room for the rounding of a ratio that is typed.
    let full = fluid.pressure_ratio >= at_rest - ROUNDED;
    if full {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.demand.simulation.is_some() && outcome.holds()) {
        outcome.leave_open(OpenReason::Contradicted(format!(
            "flow.pore_fluid.pressure_ratio is {:.2}, and a fluid that fills the pores has {at_rest:.2} at rest already, its density over that of the flow: the simulated flow has too much friction (give at least that ratio)",
            fluid.pressure_ratio
        )));
    }
}

/// Of a ratio with two digits.
const ROUNDED: f64 = 0.0051;

#[cfg(test)]
mod tests {
    use super::leave_open;
    use crate::checks::check_all;
    use crate::checks::not_covered::context::CheckContext;
    use crate::checks::not_covered::tests::{net_holds, pushing, small_net};
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::{Demand, Demands};
    use crate::design::PoreFluid;
    use crate::guideline::guideline;
    use crate::quantities::other_ropes;

    /// 1000 of 1900 kg/m³ are 0.526.
    #[test]
    fn less_pressure_than_that_of_the_fluid_at_rest_is_open() {
        let verdict = |pressure_ratio: Option<f64>| {
            let mut design = small_net();
            design.flow.bulk_density = 1900.0;
            design.flow.pore_fluid = pressure_ratio.map(|pressure_ratio| PoreFluid {
                density: 1000.0,
                pressure_ratio,
                drains_in: 60.0,
                drains_to: 0.0,
            });
            let guideline = guideline(&design);
            let pulled = Demand { simulation: Some(0.1 * net_holds(&design)), ..Demand::default() };
            let demands = Demands::default().with(&other_ropes::NET, &[pulled]);
            let mut outcomes = check_all(&design, &demands);
            let seen = Some(pushing(guideline.largest_force));
            leave_open(CheckContext { design: &design, guideline: &guideline, seen }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "net_tension").expect("a check").verdict
        };
        assert_eq!(verdict(None), CheckVerdict::Pass);
        assert_eq!((verdict(Some(0.53)), verdict(Some(0.9))), (CheckVerdict::Pass, CheckVerdict::Pass));
        assert_eq!((verdict(Some(0.51)), verdict(Some(0.0))), (CheckVerdict::Open, CheckVerdict::Open));
        assert_eq!(verdict(Some(f64::NAN)), CheckVerdict::Open);
    }
}
