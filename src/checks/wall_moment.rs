//! Bending at the foot of a wall, per metre of width; of a wall that goes on below the bed about its base, with what ground and water press with on its
//! buried face. A plain block has no section of its own to bend there: it is held against
//! overturning.

use crate::checks::outcome::{CheckName, Kind, LoadScaling, Outcome, Resistance};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, RigidWall};
use crate::guideline::buried_thrust;
use crate::quantities::quantity::Unit;
use crate::quantities::{total_force, wall};
use crate::sources::{DESIGN_LIMIT, NO_LIMIT};
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "wall_moment",
    meaning: "The moment of flow and point load about the foot of a wall, per metre of width, or about its base where it is founded deeper.",
    formula: "γ_F (M + F d) ≤ M_k/γ_M, d the founding depth",
    source: DESIGN_LIMIT,
}];

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::RigidWall(wall) = &design.barrier else { return Vec::new() };
    let name = |source| {
        CheckName::new("wall_moment", "Moment at the foot of the wall, per width", Unit::NewtonMetrePerMetre, source)
    };
    let own = buried_thrust(design, true)[1];
    let demand = about_its_base(wall, demands).with_own(own, buried_thrust(design, false)[1]);
    vec![match (wall.moment_resistance, wall.stability) {
        (Some(characteristic), _) => {
            let resistance = Resistance { characteristic, factor: wall.resistance_factor };
            let growth = LoadScaling::InProportion { fixed: own };
            let outcome = Outcome::at_most(name(DESIGN_LIMIT), demand, resistance, 1.0);
            Outcome { kind: Kind::WallStrength, growth, ..outcome }
        }
        (None, Some(stability)) if stability.base_width <= stability.thickness => {
            Outcome::informative(name(NO_LIMIT), demand)
        }
        (None, Some(_)) => Outcome::without_resistance(
            name(NO_LIMIT),
            demand,
            "barrier.rigid_wall.moment_resistance: the strength of a wall on a foot wider than itself",
        ),
        (None, None) => Outcome::without_resistance(
            name(NO_LIMIT),
            demand,
            "barrier.rigid_wall.moment_resistance, or barrier.rigid_wall.stability for a plain block",
        ),
    }]
}

/// The moment, of a wall that goes on below the bed about its base.
fn about_its_base(design: &RigidWall, demands: &Demands) -> Demand {
    let (moment, force) = (demands.one(&wall::MOMENT), demands.one(&total_force::ON_A_METRE));
    let depth = design.stability.map_or(0.0, |stability| stability.founding_depth);
    if depth <= 0.0 {
        return moment;
    }
    let lowered =
        |moment: Option<f64>, force: Option<f64>| moment.zip(force).map(|(moment, force)| moment + force * depth);
    Demand {
        guideline: lowered(moment.guideline, force.guideline),
        simulation: lowered(moment.simulation, force.simulation),
        characteristic: lowered(moment.characteristic, force.characteristic),
        cap: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demand;
    use crate::design::read::read_design;
    use crate::quantities::wall;

    /// Verdict of a wall under 100 kN m/m with this resistance, over a factor of 1.3, and, if it has one, this base under 2 m of wall.
    fn verdict(moment_resistance: Option<f64>, base_width: Option<f64>) -> CheckVerdict {
        let text = include_str!("../../designs/rigid_wall.yaml");
        let base = base_width.map_or(String::new(), |width| {
            format!(
                "    stability: {{thickness: 2 m, base_width: {width} m, density: 2400 kg/m3, base_friction: 35 deg, sliding_factor: 1.1, overturning_factor: 1.5}}\n"
            )
        });
        let text = text.replace("  rigid_wall:\n", &format!("  rigid_wall:\n{base}"));
        let mut design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        (wall.moment_resistance, wall.resistance_factor) = (moment_resistance, 1.3);
        let wall_moment = Demand { simulation: Some(100e3), ..Demand::default() };
        check(&design, &Demands::default().with(&wall::MOMENT, &[wall_moment]))[0].verdict
    }

    #[test]
    fn a_wall_bends_no_more_than_it_resists_or_is_a_plain_block() {
        assert_eq!(verdict(Some(150e3), None), CheckVerdict::Pass);
        assert_eq!(verdict(Some(135e3), None), CheckVerdict::Warn);
        assert_eq!(verdict(Some(125e3), Some(2.0)), CheckVerdict::Fail);
        assert_eq!(verdict(None, None), CheckVerdict::Open);
        assert_eq!(verdict(None, Some(2.0)), CheckVerdict::Info);
        assert_eq!(verdict(None, Some(2.5)), CheckVerdict::Open);
    }

    /// 92.6 kN m/m at the bed and 77.6 kN/m: 240 kN m/m about a base 1.9 m deeper, and what the ground presses with on the buried face.
    #[test]
    fn the_moment_of_a_wall_that_goes_on_below_the_bed_is_about_its_base() {
        let mut design = read_design("x", include_bytes!("../../designs/gravity_wall.yaml")).unwrap().design;
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        wall.stability.as_mut().expect("stability").founding_depth = 1.9;
        let of = |value: f64| Demand { guideline: Some(value), ..Demand::default() };
        let demands =
            Demands::default().with(&wall::MOMENT, &[of(92.6e3)]).with(&total_force::ON_A_METRE, &[of(77.6e3)]);
        let found = check(&design, &demands)[0].demand.guideline.expect("a moment");
        let ground = buried_thrust(&design, true)[1];
        assert!(ground > 1e3 && ((found - ground) / 240.04e3 - 1.0).abs() < 1e-9, "{found} {ground}");
    }
}
