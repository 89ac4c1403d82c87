//! Tension of main ropes and net ropes against their design resistance.

use crate::checks::outcome::{CheckName, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::sources::ROPE_FACTOR;

pub fn check_main(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else {
        return Vec::new();
    };
    let capacity = net.main_ropes.rope.breaking_load / design.factors.rope;
    let tensions = demands.rope_tension.iter().enumerate();
    tensions
        .map(|(index, demand)| {
            let rope = index + 1;
            let name = CheckName::new(
                format!("rope_{rope}_tension"),
                format!("Tension of main rope {rope}"),
                "N",
                ROPE_FACTOR,
            );
            Outcome::at_most(name, demand.times(design.factors.load), capacity, design.limits.rope_utilisation)
        })
        .collect()
}

pub fn check_net(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else {
        return Vec::new();
    };
    let capacity = net.net_rope.breaking_load / design.factors.rope;
    let name = CheckName::new("net_tension", "Tension of the net's ropes", "N", ROPE_FACTOR);
    let demand = demands.net_tension.times(design.factors.load);
    vec![Outcome::at_most(name, demand, capacity, design.limits.rope_utilisation)]
}
