//! A stone of the flow hits one metre of a wall, not all of it: where the design names no boulder, the hit of the largest stone, by the law of
//! contacts, must be held there as a named one would have to be.

use super::known::Known;
use crate::checks::check_all;
use crate::checks::outcome::{Kind, Opening, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::guideline::{guideline_for, height_over_bed};

pub fn leave_open(Known { design, guideline, .. }: Known, outcomes: &mut [Outcome]) {
    if !matches!(design.barrier, BarrierDesign::RigidWall(_)) || design.loads.point_load.is_some() {
        return;
    }
    let force = hit(design, guideline.input.velocity);
    if force.is_nan() {
        for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::WallStrength && outcome.holds()) {
            outcome.leave_open(Opening::NotGiven(
                "the grains of the flow are not given, and the largest one may break the metre of the wall that it hits (give flow.grain_sizes, solid_density and contact_modulus, or loads.point_load)".into(),
            ));
        }
        return;
    }
    let height = guideline.input.depth.min(height_over_bed(design));
    let mut struck = design.clone();
    struck.loads.point_load = Some((force, height));
    let asked = guideline_for(&struck, guideline.input);
    let then = check_all(&struck, &Demands::by_equations(&asked, &design.factors));
    let fails = |outcome: &Outcome| outcome.kind == Kind::WallStrength && outcome.fails_by_equations();
    if !then.iter().any(fails) {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::WallStrength && outcome.holds()) {
        outcome.leave_open(Opening::NotGiven(format!(
            "the largest stone of the flow may hit a metre of the wall with up to {:.0} kN, and that metre would not hold it (give loads.point_load, or more resistance)",
            force / 1e3
        )));
    }
}

/// Largest force (N) of an elastic hit of the largest stone on a wall, v √(k m) with k = E r: the dashpot makes it somewhat less.
fn hit(design: &Design, velocity: f64) -> f64 {
    let [diameter, mass] = design.flow.largest();
    velocity * (design.flow.modulus * 0.5 * diameter * mass).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::CheckVerdict;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use approx::assert_relative_eq;

    fn wall() -> Design {
        read_design("x", include_bytes!("../../../designs/rigid_wall.yaml")).unwrap().design
    }

    /// 0.6 m of 2650 kg/m³ are 299.7 kg, and k = E r = 30 MN/m: 6 m/s stop with 569 kN.
    #[test]
    fn a_hit_is_v_root_k_m() {
        let mut design = wall();
        (design.flow.modulus, design.flow.solid_density) = (1e8, 2650.0);
        design.flow.sizes = crate::design::sizes::SizeCurve::through(&[(0.0, 0.3), (1.0, 0.6)]);
        assert_relative_eq!(hit(&design, 6.0), 568.9e3, max_relative = 1e-3);
    }

    /// A wide wall that holds the flow as a whole, and its metres no stone.
    #[test]
    fn a_metre_that_a_stone_of_the_flow_breaks_is_open_unless_it_is_named() {
        let verdict = |change: &dyn Fn(&mut Design)| {
            let mut design = wall();
            change(&mut design);
            let guideline = guideline(&design);
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let outcome = outcomes.iter_mut().find(|outcome| outcome.id == "total_force").expect("a check");
            (outcome.verdict, outcome.open) = (CheckVerdict::Pass, None);
            leave_open(Known { design: &design, guideline: &guideline, seen: None }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "total_force").expect("it").verdict
        };
        let strength = |design: &mut Design, factor: f64| {
            let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
            wall.resistance = wall.resistance.map(|it| factor * it);
            wall.moment_resistance = wall.moment_resistance.map(|it| factor * it);
        };
        assert_eq!(verdict(&|design| strength(design, 100.0)), CheckVerdict::Pass);
        let harder = |design: &mut Design| {
            strength(design, 3.0);
            design.flow.modulus = 1e11;
        };
        assert_eq!(verdict(&harder), CheckVerdict::Open);
        let named = |design: &mut Design| {
            harder(design);
            design.loads.point_load = Some((1.0, 1.0));
        };
        assert_eq!(verdict(&named), CheckVerdict::Pass);
        // Nothing is known of grains that are not given.
        let unknown = |design: &mut Design| {
            strength(design, 100.0);
            design.flow.sizes = crate::design::sizes::SizeCurve::Unknown;
        };
        assert_eq!(verdict(&unknown), CheckVerdict::Open);
    }
}
