//! Strips of net along the side walls change what is held and what is loaded, by a force that wall and deposit hold them with: what the
//! simulation shows with a default that nobody vouches for is open.

use super::context::CheckContext;
use crate::checks::outcome::{OpenReason, Outcome};
use crate::design::BarrierDesign;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let BarrierDesign::FlexibleNet(net) = &context.design.barrier else { return };
    if net.side_extension.is_none_or(|extension| extension.holding_force_given) {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.demand.simulation.is_some()) {
        if outcome.holds() {
            outcome.leave_open(OpenReason::NotGiven(
                "the simulation holds the strips along the side walls with a force that the design does not give (barrier.flexible_net.side_extension.holding_force)".into(),
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::checks::not_covered::tests::{net_holds, net_verdict, small_net};
    use crate::checks::outcome::CheckVerdict;
    use crate::design::{BarrierDesign, SideExtension};
    use crate::guideline::guideline;

    #[test]
    fn a_side_extension_held_by_a_default_leaves_the_simulation_open() {
        let mut design = small_net();
        let first = guideline(&design).largest_force;
        let mut extend = |holding_force_given| {
            let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            net.side_extension = Some(SideExtension { length: 1.0, holding_force: 1e3, holding_force_given });
            net_verdict(&design, 0.4 * net_holds(&design), first)
        };
        assert_eq!(extend(true), CheckVerdict::Pass);
        assert_eq!(extend(false), CheckVerdict::Open);
    }
}
