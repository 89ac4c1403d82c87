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
pub enum FlowCase {
    /// As the design describes it.
    Characteristic,
    /// With the partial factor on loads on its weight.
    Factored,
    /// The same against dissipators that pull with the least force of their tests.
    WeakDissipators,
}

/// The cases to be simulated, each with the design that makes it.
pub fn cases(design: &Design) -> Vec<(FlowCase, Design)> {
    let factored = factored(design).map(|design| (FlowCase::Factored, design));
    let weak = weak(design).map(|design| (FlowCase::WeakDissipators, design));
    [(FlowCase::Characteristic, design.clone())].into_iter().chain(factored).chain(weak).collect()
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

/// The design under the factored flow with the least forces of its dissipators; nothing where none are known that are less.
pub fn weak(design: &Design) -> Option<Design> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let weaker = net.with_weakest_dissipators()?;
    let mut design = factored(design).unwrap_or_else(|| design.clone());
    design.barrier = BarrierDesign::FlexibleNet(Box::new(weaker));
    Some(design)
}

/// The case that forces and strokes are designed for: the factored one, or where there is none the flow as it is.
pub fn governing(design: &Design) -> Design {
    factored(design).unwrap_or_else(|| design.clone())
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
    let of_posts = net.posts.as_ref().and_then(|posts| posts.retaining.dissipators.as_ref());
    if net.dissipators.is_some() || of_posts.is_some() {
        let given = "where a dissipator yields, (factor − 1) × plateau, or × the largest force of its curve, is added to the load of its rope and anchor";
        let taken = "the same; not given, so taken as the factor on loads";
        rows.push(Combination {
            what: "Overstrength of dissipators",
            factor: factors.overstrength,
            by_equations: given,
            by_simulation: if factors.overstrength_given { "the same" } else { taken },
        });
    }
    let least = [
        ("Least force of the dissipators of main ropes", net.dissipators.as_ref()),
        ("Least force of the dissipators of retaining ropes", of_posts),
    ];
    for (what, factor) in least.into_iter().filter_map(|(what, given)| Some((what, given?.lower_bound?))) {
        rows.push(Combination {
            what,
            factor,
            by_equations: "multiplies plateau or curve for strokes, and for tensions where a stroke is used up by it",
            by_simulation: "simulated with the least forces as well, under the factored flow: the larger loads and strokes, the smaller share held and height",
        });
    }
    if net.posts.is_some() {
        rows.push(Combination {
            what: "Resistance of posts",
            factor: factors.post,
            by_equations: "divides the resistance to compression and bending; that of foundations is divided as that of anchors",
            by_simulation: "the same",
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
        // Against the least force of its dissipators the same heavier flow comes.
        assert!(weak(&net).is_none());
        let BarrierDesign::FlexibleNet(barrier) = &mut net.barrier else { panic!("a net") };
        barrier.dissipators.as_mut().expect("dissipators").lower_bound = Some(0.8);
        assert_eq!(cases(&net).len(), 3);
        let weaker = weak(&net).expect("a case");
        assert_eq!(weaker.flow, heavier.flow);
        let BarrierDesign::FlexibleNet(barrier) = &weaker.barrier else { panic!("a net") };
        assert_eq!(barrier.dissipators.as_ref().map(|given| given.plateau), Some(0.8 * 150e3));
        let mut wall = read(include_str!("../designs/rigid_wall.yaml"));
        wall.factors.load = 1.5;
        assert_eq!(cases(&wall).len(), 1);
    }
}
