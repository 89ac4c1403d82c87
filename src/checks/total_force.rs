//! Total force on the barrier against the resistance of a rigid wall; on one that goes on below the bed with what ground and water press with on its
//! buried face. A net's force is borne by its parts, which are checked one by
//! one; a wall that stands by its weight is checked against sliding and overturning.

use crate::checks::outcome::{CheckName, Kind, LoadScaling, Outcome, Resistance};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::guideline::buried_thrust;
use crate::quantities::quantity::Unit;
use crate::quantities::total_force;
use crate::sources::{DESIGN_LIMIT, NO_LIMIT};
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "total_force",
    meaning: "The largest total force on the barrier, normal to its face. A rigid wall is held against its resistance; for a net, and for a block that stands by its weight alone, it is told for information, because its parts are checked one by one.",
    formula: "γ_F F ≤ R_k/γ_M",
    source: DESIGN_LIMIT,
}];

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let width = design.channel.width;
    let [own, own_characteristic] = [true, false].map(|factored| width * buried_thrust(design, factored)[0]);
    let title = if own > 0.0 {
        "Total force on the wall, with the ground on its buried face"
    } else {
        "Total force on the barrier"
    };
    let name = |source| CheckName::new("total_force", title, Unit::Newton, source);
    let demand = demands.one(&total_force::PEAK).with_own(own, own_characteristic);
    let BarrierDesign::RigidWall(wall) = &design.barrier else {
        return vec![Outcome::informative(name(NO_LIMIT), demand)];
    };
    vec![match (wall.resistance, wall.stability) {
        (Some(characteristic), _) => {
            let resistance = Resistance { characteristic, factor: wall.resistance_factor };
            let growth = LoadScaling::InProportion { fixed: own };
            let outcome = Outcome::at_most(name(DESIGN_LIMIT), demand, resistance, 1.0);
            Outcome { kind: Kind::WallStrength, growth, ..outcome }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demand;
    use crate::design::Stability;
    use crate::design::read::read_design;
    use crate::quantities::total_force;

    /// Verdict of a wall under 100 kN with this resistance, over a factor of 1.3, and this base, of 2 m thickness.
    fn verdict(resistance: Option<f64>, base_width: Option<f64>) -> CheckVerdict {
        let mut design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        (wall.resistance, wall.resistance_factor) = (resistance, 1.3);
        wall.stability = base_width.map(|base_width| Stability {
            thickness: 2.0,
            density: 2400.0,
            base_width,
            base_slope: Some(0.0),
            founding_depth: 0.0,
            base_friction: 0.7,
            ground_density: 2200.0,
            sliding_factor: 1.1,
            overturning_factor: 1.5,
            bearing_resistance: None,
            bearing_factor: 1.4,
            block_length: None,
            water_head: Some(0.0),
        });
        let total_force = Demand { guideline: Some(100e3), ..Demand::default() };
        check(&design, &Demands::default().with(&total_force::PEAK, &[total_force]))[0].verdict
    }

    #[test]
    fn a_wall_is_held_against_its_resistance_or_is_a_plain_block() {
        assert_eq!(verdict(Some(150e3), None), CheckVerdict::Pass);
        assert_eq!(verdict(Some(135e3), None), CheckVerdict::Warn);
        assert_eq!(verdict(Some(125e3), None), CheckVerdict::Fail);
        assert_eq!(verdict(None, None), CheckVerdict::Open);
        assert_eq!(verdict(None, Some(2.0)), CheckVerdict::Info);
        assert_eq!(verdict(None, Some(2.5)), CheckVerdict::Open);
        assert_eq!(verdict(Some(125e3), Some(2.0)), CheckVerdict::Fail);
    }

    /// The shear of a founded wall is that of the flow and of the ground on its buried face; the metre that a point load hits bears its share of both.
    #[test]
    fn a_founded_wall_bears_the_ground_on_its_buried_face_as_well() {
        let mut design = read_design("x", include_bytes!("../../designs/gravity_wall.yaml")).unwrap().design;
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        wall.resistance = Some(1e9);
        let ground = buried_thrust(&design, true)[0];
        assert!(ground > 1e3, "{ground}");
        let of = |value: f64| Demand { simulation: Some(value), ..Demand::default() };
        let demands =
            Demands::default().with(&total_force::PEAK, &[of(7e5)]).with(&total_force::ON_A_METRE, &[of(7e4)]);
        let whole = check(&design, &demands)[0].demand.simulation.expect("a force");
        assert!((whole - 7e5 - design.channel.width * ground).abs() < 1e-3, "{whole}");
        let metre = crate::checks::wall_local::check(&design, &demands)[0].demand.simulation.expect("a force");
        assert!((metre - 7e4 - ground).abs() < 1e-3, "{metre}");
    }
}
