//! Load on what holds the lowest main rope to the bed, against its resistance, if that is known.

use crate::checks::outcome::{CheckName, Outcome, Resistance};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Bottom, Design};
use crate::sources::{ANCHOR_FACTOR, NO_LIMIT};

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    if net.bottom != Bottom::Fixed {
        return Vec::new();
    }
    let name = CheckName::new("bed_bolts", "Load on what holds the lowest rope to the bed, in all", "N", ANCHOR_FACTOR);
    vec![match net.bed_resistance {
        Some(characteristic) => {
            let resistance = Resistance { characteristic, factor: design.factors.anchor };
            Outcome::at_most(name, demands.bed_force, resistance, design.limits.anchor_utilisation)
        }
        None => Outcome::informative(CheckName { source: NO_LIMIT, ..name }, demands.bed_force),
    }]
}
