//! Ropes that break or draw out in the simulation, where the design lets them.

use crate::checks::outcome::{CheckName, CheckVerdict, Opening, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design, FlexibleNet, Rope};
use crate::sources::{NO_LIMIT, NOTHING_BREAKS};

fn any_rope(design: &Design, allows: impl Fn(&Rope) -> bool) -> bool {
    let ropes = |net: &FlexibleNet| [net.net_rope, net.main_ropes.rope, net.lateral_rope];
    matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if ropes(net).iter().any(allows))
}

/// Nothing may break. There is no utilisation to tell: how far from breaking a rope is, its tension tells.
pub fn check_broken(design: &Design, demands: &Demands) -> Vec<Outcome> {
    if !any_rope(design, |rope| rope.breaks) {
        return Vec::new();
    }
    let name = CheckName::new("broken_pieces", "Pieces of rope that broke", "", NOTHING_BREAKS);
    let mut outcome = Outcome::informative(name, demands.broken_pieces);
    match outcome.demand.simulation {
        None => outcome.leave_open(Opening::NeedsSimulation(
            "whether ropes break is seen in the simulation alone (run it)".into(),
        )),
        Some(0.0) => outcome.verdict = CheckVerdict::Pass,
        Some(count) => (outcome.verdict, outcome.utilisation) = (CheckVerdict::Fail, Some(1.0 + count)),
    }
    vec![outcome]
}

/// A rope that has drawn out must be replaced; the simulation goes on with it.
pub fn tell_drawn_out(design: &Design, demands: &Demands) -> Vec<Outcome> {
    if !any_rope(design, |rope| rope.elastic_limit.is_some()) {
        return Vec::new();
    }
    let title = "Largest permanent elongation of a rope";
    vec![Outcome::informative(CheckName::new("drawn_out", title, "-", NO_LIMIT), demands.drawn_out)]
}
