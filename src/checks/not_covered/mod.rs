//! Loads and courses of the event that neither the equations nor the simulation cover, one file each: checks that
//! would pass without them stay open, whatever `limits.outside_range` says, because that lets formulas stand, not gaps.

pub(crate) mod context;
pub(crate) mod cut_hydrograph;
pub(crate) mod drag;
pub(crate) mod full_barrier;
pub(crate) mod hanging_base;
pub(crate) mod harder_boulder;
pub(crate) mod harder_flow;
pub(crate) mod heaped;
pub(crate) mod largest_grain;
pub(crate) mod load_factor;
pub(crate) mod missed_boulder;
pub(crate) mod not_simulated;
pub(crate) mod pore_fluid;
pub(crate) mod rigid_wall;
pub(crate) mod short_peaks;
pub(crate) mod side_strips;
pub(crate) mod slack_posts;
pub(crate) mod soft_contacts;
pub(crate) mod thinner_flow;

use self::context::CheckContext;
use crate::checks::outcome::Outcome;

/// All rules. Of several that leave a check open the first one tells why.
const RULES: &[fn(CheckContext, &mut [Outcome])] = &[
    full_barrier::leave_open,
    harder_flow::leave_open,
    harder_boulder::leave_open,
    thinner_flow::leave_open,
    heaped::leave_open,
    hanging_base::leave_open,
    cut_hydrograph::leave_open,
    short_peaks::leave_open,
    soft_contacts::leave_open,
    rigid_wall::leave_open,
    largest_grain::leave_open,
    missed_boulder::leave_open,
    slack_posts::leave_open,
    load_factor::leave_open,
    not_simulated::leave_open,
    side_strips::leave_open,
    drag::leave_open,
    pore_fluid::leave_open,
];

/// Leaves open what would hold only because something is not covered.
pub fn leave_open_not_covered(context: CheckContext, outcomes: &mut [Outcome]) {
    RULES.iter().for_each(|rule| rule(context, outcomes));
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::not_covered::context::FirstSurge;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::{Demands, SimulatedRuns};
    use crate::design::Design;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use crate::quantities::counts::Counts;
    use crate::quantities::observed::Observed;
    use crate::quantities::other_ropes;

    pub fn small_net() -> Design {
        let mut design = read_design("x", include_bytes!("../../../designs/small_net.yaml")).unwrap().design;
        // Of stone, so that its softness opens nothing.
        design.flow.modulus = 1e9;
        design
    }

    /// A first surge that pushes with a force (N), seen without error.
    pub fn pushing(push: f64) -> FirstSurge {
        FirstSurge {
            push,
            largest_push: push,
            flux_share: 1.0,
            sampled_over_smoothed: 1.0,
            moment_sampled_over_smoothed: 1.0,
            ..FirstSurge::default()
        }
    }

    /// Verdict of a check by the equations, with what the simulation of the first surge shows.
    pub fn verdict(design: &Design, id: &str, first_surge: f64) -> CheckVerdict {
        verdict_after(leave_open_not_covered, design, id, pushing(first_surge))
    }

    /// The same after one rule alone.
    pub fn verdict_after(
        rule: fn(CheckContext, &mut [Outcome]),
        design: &Design,
        id: &str,
        seen: FirstSurge,
    ) -> CheckVerdict {
        let guideline = guideline(design);
        let mut outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
        rule(CheckContext { design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    /// A rule that is in no list opens nothing, and the test of its own file would not notice.
    #[test]
    fn every_rule_of_this_folder_is_in_the_list() {
        let (source, _) = include_str!("mod.rs").split_once("#[cfg(test)]").expect("tests");
        let modules = source.lines().filter_map(|line| line.strip_prefix("pub(crate) mod ")?.strip_suffix(';'));
        for module in modules.filter(|module| *module != "context") {
            assert!(source.contains(&format!("    {module}::leave_open,")), "{module}");
        }
    }

    /// Verdict of a check where the first surge shows certain numbers.
    pub fn simulated_verdict(design: &Design, id: &str, observed: &Observed, seen: FirstSurge) -> CheckVerdict {
        let guideline = guideline(design);
        let packings = SimulatedRuns { characteristic: vec![observed], ..SimulatedRuns::default() };
        let mut outcomes = check_all(design, &Demands::meet(&guideline, &packings, &design.factors));
        leave_open_not_covered(CheckContext { design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    /// Verdict of the net's tension, which the simulation alone judges, where the first surge pulls it with a tension (N).
    pub fn net_verdict(design: &Design, tension: f64, first_surge: f64) -> CheckVerdict {
        let observed =
            Observed::of_nothing(Counts { ropes: 3, ..Counts::default() }).with(&other_ropes::NET, &[tension]);
        simulated_verdict(design, "net_tension", &observed, pushing(first_surge))
    }

    /// Tension that the net of the design may bear (N).
    pub fn net_holds(design: &Design) -> f64 {
        let crate::design::BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        net.net_rope.breaking_load / design.factors.rope
    }
}
