//! Grains that are softer than stone hit a net more gently than stone would. What the flow as a whole presses with does not depend on it; what
//! single grains do, to the net, its edges and the rope and bolts at the bed, does: with 1 GPa in place of 0.05 GPa the simulated loads of two rope
//! nets were 1.0 to 1.5 (lateral ropes), 1.2 to 1.8 (bolts), 1.25 to 1.9 (the rope between them) and 1.5 to 1.9 times as large, and those of main
//! ropes and anchors 0.8 to 1.1 times (95 % fractiles over four packings each). That is at most the fourth root of the ratio of the moduli, 2.1, which is asked
//! for here, on top of what the full barrier and the peak at an instant add; of an elastic hit on something that does not give it would be the square root.

use super::context::CheckContext;
use super::short_peaks::used_under;
use crate::checks::outcome::{Kind, OpenReason, Outcome};
use crate::design::BarrierDesign;

/// Contact modulus (Pa) from which harder grains are not asked for: beyond it the net gives, not the grain.
const STIFF: f64 = 1e9;

pub fn leave_open(CheckContext { design, seen, .. }: CheckContext, outcomes: &mut [Outcome]) {
    let BarrierDesign::FlexibleNet(_) = &design.barrier else { return };
    let softer = STIFF / design.flow.modulus;
    // Asked so that what is not a number goes on.
    if softer <= 1.0 {
        return;
    }
    let harder = softer.sqrt().sqrt();
    let of_single_grains = |outcome: &Outcome| {
        matches!(outcome.kind, Kind::Bolts | Kind::BetweenBolts | Kind::NetRopes | Kind::LateralRopes)
    };
    for outcome in outcomes.iter_mut().filter(|outcome| of_single_grains(outcome) && outcome.holds()) {
        let over = seen.and_then(|seen| seen.at_once.of(outcome.kind)).unwrap_or(1.0);
        let Some(used) = used_under(outcome, over * harder) else { continue };
        // Asked so that what is not a number is not within.
        let within = used <= 1.0;
        if !within {
            let more = if over > 1.0 || outcome.scaled.is_some() {
                ", at an instant and scaled up to the load by the guideline,"
            } else {
                ""
            };
            outcome.leave_open(OpenReason::Contradicted(format!(
                "the grains are softer than stone, and harder ones may load it {harder:.2} times as much, which{more} it would not hold (give flow.contact_modulus: 1 GPa, or more resistance)"
            )));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::checks::not_covered::tests::{net_holds, net_verdict, small_net};
    use crate::checks::outcome::CheckVerdict;

    /// Grains of 0.05 GPa: harder ones load the net 20^¼ = 2.115 times as much.
    #[test]
    fn a_net_that_holds_soft_grains_alone_is_open() {
        let verdict = |modulus: f64, share: f64| {
            let mut design = small_net();
            design.flow.modulus = modulus;
            let holds = net_holds(&design);
            net_verdict(&design, share * holds, 1e9)
        };
        assert_eq!(verdict(5e7, 0.47), CheckVerdict::Pass);
        assert_eq!(verdict(5e7, 0.48), CheckVerdict::Open);
        assert_eq!(verdict(1e9, 0.85), CheckVerdict::Pass);
        assert_eq!(verdict(f64::NAN, 0.1), CheckVerdict::Open);
    }

    /// Twice the load on the full barrier, and grains of 0.05 GPa: 2 · 2.115 times 0.23 is within, times 0.24 it is not.
    #[test]
    fn hardness_counts_on_top_of_the_full_barrier() {
        let mut design = small_net();
        design.flow.modulus = 5e7;
        let (holds, first) = (net_holds(&design), crate::guideline::guideline(&design).largest_force / 2.0);
        let verdict = |share: f64| net_verdict(&design, share * holds, first);
        assert_eq!((verdict(0.235), verdict(0.238)), (CheckVerdict::Pass, CheckVerdict::Open));
    }
}
