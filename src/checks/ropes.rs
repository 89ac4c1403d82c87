//! Tension of main, net and lateral ropes against their design resistance.

use crate::checks::outcome::{CheckName, Outcome, Resistance};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, Rope};
use crate::sources::ROPE_FACTOR;

/// Main ropes that are free to move; one bolted to the bed is held all along and is not checked.
pub fn check_main(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let tensions = demands.rope_tension.iter().enumerate().skip(net.ropes_held_by_bed());
    tensions
        .map(|(index, demand)| {
            let number = index + 1;
            let title = format!("Tension of main rope {number}");
            check(design, &net.main_ropes.rope, format!("rope_{number}_tension"), title, *demand).of_rope(index)
        })
        .collect()
}

pub fn check_net(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    vec![check(design, &net.net_rope, "net_tension".into(), "Tension of the net's ropes".into(), demands.net_tension)]
}

pub fn check_lateral(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let title = "Tension of the lateral ropes".into();
    vec![check(design, &net.lateral_rope, "lateral_tension".into(), title, demands.lateral_tension)]
}

fn check(design: &Design, rope: &Rope, id: String, title: String, demand: Demand) -> Outcome {
    let resistance = resistance(design, rope);
    Outcome::at_most(CheckName::new(id, title, "N", ROPE_FACTOR), demand, resistance, design.limits.rope_utilisation)
}

/// What a rope holds at its ends.
pub fn resistance(design: &Design, rope: &Rope) -> Resistance {
    Resistance { characteristic: rope.breaking_load * design.factors.rope_end, factor: design.factors.rope }
}
