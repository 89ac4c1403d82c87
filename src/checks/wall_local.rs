//! What a boulder does to the metre of a wall that it hits: that resists no more than its share of what the whole wall does.

use crate::checks::outcome::{CheckName, Kind, LoadScaling, Outcome, Resistance};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::guideline::{buried_thrust, input, point_load};
use crate::quantities::quantity::Unit;
use crate::quantities::total_force;
use crate::sources::DESIGN_LIMIT;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "wall_local_force",
    meaning: "The force on the metre of a wall that the point load hits, per metre of width, with the pressure of the flow there.",
    formula: "γ_F (R + P/l) ≤ R_k/(γ_M b), l the length over which the point load spreads, b the width of the wall",
    source: DESIGN_LIMIT,
}];

const OF_A_BOULDER: &str = "limit of the design file; the load is no less than the elastic force of a boulder of flow.boulders (Hertz 1882) times loads.impact_reduction, which is uncertain";

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::RigidWall(wall) = &design.barrier else { return Vec::new() };
    let (Some(characteristic), Some(hit)) = (wall.resistance, point_load(design, &input(design))) else {
        return Vec::new();
    };
    let name = CheckName::new(
        "wall_local_force",
        "Force on the metre of the wall that the point load hits, per width",
        Unit::NewtonPerMetre,
        if hit.of_boulder > 0.0 { OF_A_BOULDER } else { DESIGN_LIMIT },
    );
    let resistance =
        Resistance { characteristic: characteristic / design.channel.width, factor: wall.resistance_factor };
    let own = buried_thrust(design, true)[0];
    let demand = demands.one(&total_force::ON_A_METRE).with_own(own, buried_thrust(design, false)[0]);
    let growth = LoadScaling::InProportion { fixed: own };
    vec![Outcome { kind: Kind::WallStrength, growth, ..Outcome::at_most(name, demand, resistance, 1.0) }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use approx::assert_relative_eq;

    /// 3 MN at 1 m spread at 45° to one side over half the height of the wall, not over the whole width.
    #[test]
    fn a_boulder_is_held_by_the_metres_that_it_hits() {
        let mut design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        let told = |design: &Design| {
            check(design, &Demands::by_equations(&guideline(design), &design.factors)).into_iter().next()
        };
        assert_eq!(told(&design), None);
        design.loads.point_load = Some((3e6, Some(1.0)));
        let without = {
            let mut without = design.clone();
            without.loads.point_load = Some((0.0, Some(1.0)));
            told(&without).expect("a check").demand.guideline.expect("a force")
        };
        let outcome = told(&design).expect("a check");
        let BarrierDesign::RigidWall(wall) = &design.barrier else { panic!("a wall") };
        let lean = libm::cos(wall.lean);
        let spread = 0.5 * wall.height * lean;
        let more = design.factors.load * 3e6 / spread / lean;
        assert_relative_eq!(outcome.demand.guideline.expect("a force"), without + more, max_relative = 1e-9);
        let resists = wall.resistance.expect("given") / wall.resistance_factor / design.channel.width;
        assert_relative_eq!(outcome.capacity.expect("a capacity"), resists, max_relative = 1e-12);
    }
}
