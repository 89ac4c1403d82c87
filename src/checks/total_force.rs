//! Total force on the barrier against the resistance of a rigid wall. A net's force is borne by its parts, which are checked one by
//! one; a wall that stands by its weight is checked against sliding and overturning.

use crate::checks::outcome::{CheckName, Outcome, Resistance};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::sources::{DESIGN_LIMIT, NO_LIMIT};

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let name = |source| CheckName::new("total_force", "Total force on the barrier", "N", source);
    let demand = demands.total_force;
    let BarrierDesign::RigidWall(wall) = &design.barrier else {
        return vec![Outcome::informative(name(NO_LIMIT), demand)];
    };
    vec![match (wall.resistance, wall.stability) {
        (Some(characteristic), _) => {
            let resistance = Resistance { characteristic, factor: wall.resistance_factor };
            Outcome::at_most(name(DESIGN_LIMIT), demand, resistance, 1.0)
        }
        // A plain block bears what it weighs; a foot that reaches out must be able to.
        (None, Some(stability)) if stability.base_width <= stability.thickness => {
            Outcome::informative(name(NO_LIMIT), demand)
        }
        (None, Some(_)) => Outcome::without_resistance(
            name(NO_LIMIT),
            demand,
            "barrier.rigid_wall.resistance: the strength of a wall on a foot wider than itself",
        ),
        (None, None) => Outcome::without_resistance(
            name(NO_LIMIT),
            demand,
            "barrier.rigid_wall.resistance or barrier.rigid_wall.stability",
        ),
    }]
}
