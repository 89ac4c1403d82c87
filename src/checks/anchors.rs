//! Load of the anchors against their design resistance.

use crate::checks::outcome::{CheckName, Outcome, Resistance};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, FlexibleNet};
use crate::sources::ANCHOR_FACTOR;

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else {
        return Vec::new();
    };
    let capacity = Resistance { characteristic: net.anchor_resistance, factor: design.factors.anchor };
    let loads = demands.anchor_force.iter().enumerate().skip(net.ropes_held_by_bed());
    let by_load = loads.map(|(index, demand)| {
        let rope = index + 1;
        let title = format!("Load of the anchors of main rope {rope}");
        let name = CheckName::new(format!("anchor_{rope}_load"), title, "N", ANCHOR_FACTOR);
        Outcome::at_most(name, *demand, capacity, design.limits.anchor_utilisation)
    });
    by_load.chain(against_plateau(net, design, capacity)).collect()
}

/// A dissipator at work loads its anchor with its plateau, whatever the design flow shows.
fn against_plateau(net: &FlexibleNet, design: &Design, capacity: Resistance) -> Option<Outcome> {
    let plateau = net.dissipators?.plateau;
    let name = CheckName::new("anchor_plateau", "Anchors against the plateau of their dissipators", "N", ANCHOR_FACTOR);
    let demand = Demand { guideline: Some(design.factors.load * plateau), ..Demand::default() };
    Some(Outcome::at_most(name, demand, capacity, design.limits.anchor_utilisation))
}
