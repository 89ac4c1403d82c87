//! Total force on the barrier against the resistance of a rigid wall, if that is known.

use crate::checks::outcome::{CheckName, Outcome, Resistance};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::sources::{DESIGN_LIMIT, NO_LIMIT};

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let name = CheckName::new("total_force", "Total force on the barrier", "N", DESIGN_LIMIT);
    let demand = demands.total_force;
    let resistance = match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.resistance,
        BarrierDesign::FlexibleNet(_) => None,
    };
    vec![match resistance {
        Some(resistance) => Outcome::at_most(name, demand, Resistance { characteristic: resistance, factor: 1.0 }, 1.0),
        None => Outcome::informative(CheckName { source: NO_LIMIT, ..name }, demand),
    }]
}
