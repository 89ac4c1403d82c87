//! Load of the anchors against their design resistance.

use crate::checks::outcome::{CheckName, Outcome, Resistance};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::sources::ANCHOR_FACTOR;

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else {
        return Vec::new();
    };
    let capacity = Resistance { characteristic: net.anchor_resistance, factor: design.factors.anchor };
    let loads = demands.anchor_force.iter().enumerate().skip(net.ropes_held_by_bed());
    loads
        .map(|(index, demand)| {
            let rope = index + 1;
            let title = format!("Load of the anchors of main rope {rope}");
            let name = CheckName::new(format!("anchor_{rope}_load"), title, "N", ANCHOR_FACTOR);
            Outcome::at_most(name, *demand, capacity, design.limits.anchor_utilisation)
        })
        .collect()
}
