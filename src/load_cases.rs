//! The load combinations that are simulated, and where each partial factor stands.
//!
//! A partial factor γ on loads belongs on the action, so the flow is made γ times as heavy: its densities and the contact modulus
//! of its grains are multiplied by γ. Grains then move as before, overlap as before and hit γ times as hard, while barrier,
//! geometry, velocities and friction stay as they are. A net answers that with longer strokes and another shape, which no factor
//! on results can give; so the factored flow is simulated beside the characteristic one. The same answer comes of a barrier with
//! mass, EA, plateau and stiffness divided by γ under the characteristic flow, its forces multiplied by γ: every force in the model
//! is proportional to one of the two. A rigid wall does not yield, its forces grow by γ and nothing else changes, and nothing is
//! simulated twice.

use serde::{Deserialize, Serialize};

use crate::design::{BarrierDesign, Design, Factors, FlexibleNet, RigidWall};

/// Which flow a simulation lets go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LoadCase {
    /// As the design describes it.
    Characteristic,
    /// With the partial factor on loads on its weight.
    Factored,
}

/// The cases to be simulated, each with the design that makes it.
pub fn cases(design: &Design) -> Vec<(LoadCase, Design)> {
    let factored = factored(design).map(|design| (LoadCase::Factored, design));
    [(LoadCase::Characteristic, design.clone())].into_iter().chain(factored).collect()
}

/// The design under the factored flow; nothing where that would tell nothing new: without a factor, and for a rigid wall.
pub fn factored(design: &Design) -> Option<Design> {
    let factor = design.factors.load;
    if factor == 1.0 || matches!(design.barrier, BarrierDesign::RigidWall(_)) {
        return None;
    }
    let mut heavier = design.clone();
    heavier.flow.make_heavier(factor);
    heavier.flow.modulus *= factor;
    heavier.factors.load = 1.0;
    Some(heavier)
}

/// A row of the load combination table: what is factored, by what, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    pub what: &'static str,
    pub factor: f64,
    pub by_equations: &'static str,
    pub by_simulation: &'static str,
}

/// Where the factors of a design stand.
pub fn combinations(design: &Design) -> Vec<Combination> {
    let factors = &design.factors;
    let mut rows = vec![Combination {
        what: "Action of the flow, for forces and strokes",
        factor: factors.load,
        by_equations: "on the pressures; sag, tension and stroke follow under the factored load",
        by_simulation: match design.barrier {
            BarrierDesign::FlexibleNet(_) if factors.load == 1.0 => {
                "none: characteristic and factored flow are the same, and simulated once"
            }
            BarrierDesign::FlexibleNet(_) => {
                "applied to the densities and the contact modulus of the flow, so that grains move as before and every force of theirs grows by the factor; the factored flow is simulated as well as the characteristic one"
            }
            BarrierDesign::RigidWall(_) => "on the forces: a rigid wall's are proportional to the action",
        },
    }];
    rows.extend(match &design.barrier {
        BarrierDesign::FlexibleNet(net) => of_a_net(net, factors),
        BarrierDesign::RigidWall(wall) => of_a_wall(wall),
    });
    rows
}

fn of_a_net(net: &FlexibleNet, factors: &Factors) -> Vec<Combination> {
    let mut rows = Vec::new();
    rows.push(Combination {
        what: "Mass held and residual height",
        factor: 1.0,
        by_equations: "not given by the guideline",
        by_simulation: "the smaller of the values from the characteristic and the factored flow",
    });
    rows.push(Combination {
        what: "Resistance of ropes",
        factor: factors.rope,
        by_equations: "divides the breaking load that the rope ends hold",
        by_simulation: "the same",
    });
    rows.push(Combination {
        what: "Resistance of anchors and bolts",
        factor: factors.anchor,
        by_equations: "divides the characteristic resistance",
        by_simulation: "the same",
    });
    if net.dissipators.is_some() {
        let given = "where a dissipator yields, (factor − 1) × plateau, or × the largest force of its curve, is added to the load of its rope and anchor";
        let taken = "the same; not given, so taken as the factor on loads";
        rows.push(Combination {
            what: "Overstrength of dissipators",
            factor: factors.overstrength,
            by_equations: given,
            by_simulation: if factors.overstrength_given { "the same" } else { taken },
        });
    }
    rows
}

fn of_a_wall(wall: &RigidWall) -> Vec<Combination> {
    let mut rows = Vec::new();
    if wall.resistance.is_some() || wall.moment_resistance.is_some() {
        rows.push(Combination {
            what: "Resistance of the wall",
            factor: wall.resistance_factor,
            by_equations: "divides the characteristic resistance",
            by_simulation: "the same",
        });
    }
    if let Some(stability) = wall.stability {
        rows.push(Combination {
            what: "Resistance to sliding",
            factor: stability.sliding_factor,
            by_equations: "divides the friction under the base",
            by_simulation: "the same",
        });
        rows.push(Combination {
            what: "Moment that holds the wall",
            factor: stability.overturning_factor,
            by_equations: "divides the moment of its weight",
            by_simulation: "the same",
        });
        rows.push(Combination {
            what: "Bearing resistance under the wall",
            factor: stability.bearing_factor,
            by_equations: "divides the characteristic resistance; the weight of the wall stands with and without the factor on loads, whichever is the worse",
            by_simulation: "the same",
        });
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Boulders;
    use crate::design::read::read_design;

    #[test]
    fn a_net_has_a_factored_case_of_its_own_and_a_wall_has_none() {
        let read = |text: &str| read_design("x", text.as_bytes()).unwrap().design;
        let mut net = read(include_str!("../designs/small_net.yaml"));
        assert_eq!(cases(&net).len(), 1);
        net.factors.load = 1.5;
        net.flow.boulders = vec![Boulders { diameter: 0.8, number: 2, at_front: true, density: 2600.0 }];
        let heavier = factored(&net).unwrap();
        assert_eq!(heavier.flow.bulk_density, 1.5 * net.flow.bulk_density);
        assert_eq!(heavier.flow.volume(), net.flow.volume());
        // All of it is, its boulders too.
        assert!((heavier.flow.largest()[1] / net.flow.largest()[1] - 1.5).abs() < 1e-12);
        assert!((heavier.flow.mass_of_grains() / net.flow.mass_of_grains() - 1.5).abs() < 1e-12);
        assert_eq!((heavier.factors.load, heavier.barrier == net.barrier), (1.0, true));
        let mut wall = read(include_str!("../designs/rigid_wall.yaml"));
        wall.factors.load = 1.5;
        assert_eq!(cases(&wall).len(), 1);
    }
}
