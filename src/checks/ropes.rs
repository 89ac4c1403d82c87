//! Tension of main, net and lateral ropes against their design resistance.

use crate::checks::outcome::{CheckName, Outcome, Resistance};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, Rope};
use crate::quantities::{other_ropes, rope_tension};
use crate::sources::ROPE_FACTOR;

/// Main ropes that are free to move; one bolted to the bed is held all along and is not checked.
pub fn check_main(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let tensions = demands.each(&rope_tension::PEAK).iter().enumerate().skip(net.ropes_held_by_bed());
    tensions
        .map(|(index, demand)| {
            let name = CheckName::of(&rope_tension::PEAK, index, format!("rope_{}_tension", index + 1), ROPE_FACTOR);
            check(design, &net.main_ropes.rope, name, *demand).of_rope(index)
        })
        .collect()
}

pub fn check_net(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let name = CheckName::of(&other_ropes::NET, 0, "net_tension", ROPE_FACTOR);
    vec![check(design, &net.net_rope, name, demands.one(&other_ropes::NET))]
}

pub fn check_lateral(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let name = CheckName::of(&other_ropes::LATERAL, 0, "lateral_tension", ROPE_FACTOR);
    vec![check(design, &net.lateral_rope, name, demands.one(&other_ropes::LATERAL))]
}

fn check(design: &Design, rope: &Rope, name: CheckName, demand: Demand) -> Outcome {
    Outcome::at_most(name, demand, resistance(design, rope), design.limits.rope_utilisation)
}

/// What a rope holds at its ends.
pub fn resistance(design: &Design, rope: &Rope) -> Resistance {
    Resistance { characteristic: rope.breaking_load * design.factors.rope_end, factor: design.factors.rope }
}
