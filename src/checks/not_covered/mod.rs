//! Loads and courses of the event that neither the equations nor the simulation of the first surge cover, one file each: checks that
//! would pass without them stay open, whatever `limits.outside_range` says, because that lets formulas stand, not gaps.

pub mod drag;
pub mod full_barrier;
pub mod harder_flow;
pub mod later_surges;
pub mod load_factor;
pub mod not_simulated;
pub mod rigid_wall;
pub mod short_peaks;
pub mod side_strips;
pub mod thinner_flow;

use crate::checks::outcome::Outcome;
use crate::demand::from_loads::Guideline;
use crate::design::Design;

/// What a simulation shows of the first surge, without partial factors.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstSurge {
    /// Its largest force along the bed (N).
    pub push: f64,
    /// Its largest moment about the foot of a wall, per width (N m/m).
    pub moment: f64,
    /// Largest force, and moment, of one sample over the largest of the smoothed signal, which is judged.
    pub sampled_over_smoothed: f64,
    pub moment_sampled_over_smoothed: f64,
    /// The velocity with which it arrives (m/s).
    pub velocity: f64,
    /// Its depth then, at bulk density (m).
    pub depth: f64,
    /// Its momentum flux h v² over the one that the design gives; 1 where the design gives none.
    pub flux_share: f64,
    /// K that the deposit shows at rest, where there is one.
    pub earth_pressure: Option<f64>,
    /// By how much a finer model, or other packings, may show larger forces and strokes (over these, less one) and smaller shares.
    pub force_band: f64,
    pub stroke_band: f64,
    pub share_band: f64,
}

/// What a rule goes by.
#[derive(Clone, Copy)]
pub struct Known<'a> {
    pub design: &'a Design,
    pub guideline: &'a Guideline,
    /// Nothing where nothing was simulated.
    pub seen: Option<FirstSurge>,
}

/// All rules. Of several that leave a check open the first one tells why.
const RULES: &[fn(Known, &mut [Outcome])] = &[
    full_barrier::leave_open,
    later_surges::leave_open,
    harder_flow::leave_open,
    thinner_flow::leave_open,
    short_peaks::leave_open,
    rigid_wall::leave_open,
    load_factor::leave_open,
    not_simulated::leave_open,
    side_strips::leave_open,
    drag::leave_open,
];

/// Leaves open what would hold only because something is not covered.
pub fn leave_open_not_covered(known: Known, outcomes: &mut [Outcome]) {
    RULES.iter().for_each(|rule| rule(known, outcomes));
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::from_histories::Observed;
    use crate::demand::from_loads::guideline;
    use crate::demand::{Demands, Seen};
    use crate::design::read::read_design;

    pub fn small_net() -> Design {
        read_design("x", include_bytes!("../../../designs/small_net.yaml")).unwrap().design
    }

    /// A first surge that pushes with a force (N), seen without error.
    pub fn pushing(push: f64) -> FirstSurge {
        FirstSurge {
            push,
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
    pub fn verdict_after(rule: fn(Known, &mut [Outcome]), design: &Design, id: &str, seen: FirstSurge) -> CheckVerdict {
        let guideline = guideline(design);
        let mut outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
        rule(Known { design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    /// Verdict of a check where the first surge shows certain numbers.
    pub fn simulated_verdict(design: &Design, id: &str, observed: &Observed, seen: FirstSurge) -> CheckVerdict {
        let guideline = guideline(design);
        let packings = Seen { characteristic: vec![observed], factored: Vec::new() };
        let mut outcomes = check_all(design, &Demands::meet(&guideline, &packings, &design.factors));
        leave_open_not_covered(Known { design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    /// Verdict of the net's tension, which the simulation alone judges, where the first surge pulls it with a tension (N).
    pub fn net_verdict(design: &Design, tension: f64, first_surge: f64) -> CheckVerdict {
        let observed = Observed { net_tension_peak: tension, ..Observed::of_ropes(3) };
        simulated_verdict(design, "net_tension", &observed, pushing(first_surge))
    }

    /// Tension that the net of the design may bear (N).
    pub fn net_holds(design: &Design) -> f64 {
        let crate::design::BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        net.net_rope.breaking_load / design.factors.rope
    }
}
