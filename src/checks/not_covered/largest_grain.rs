//! A stone of the flow hits one metre of a wall, not all of it: where the design names no boulder, the hit of the largest stone must be held
//! there as a named one would have to be: by the strength of the metre that is hit, under the hit by the law of contacts or the reduced hit of a
//! boulder, whichever is harder; and by the base of a wall that stands by its weight, under the latter. Where joints of the wall are not
//! described, by a block of one metre. A point load that the design gives stands for the stone if it is no smaller than that reduced hit; where
//! the grains are not given, nobody can say whether it is.

use super::context::CheckContext;
use crate::checks::check_all;
use crate::checks::outcome::{Kind, OpenReason, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::guideline::{guideline_for, height_over_bed, hit_of_the_largest};
use crate::larger::larger_or_nan;

/// Length of the block (m) that stands for one that nobody described: joints are no closer.
const SHORTEST_BLOCK: f64 = 1.0;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let design = context.design;
    if !matches!(design.barrier, BarrierDesign::RigidWall(_)) {
        return;
    }
    let on_the_base = hit_of_the_largest(design);
    let given = design.loads.point_load.map(|(force, _)| force);
    if given.is_some_and(|given| on_the_base <= given) {
        return;
    }
    let strength = match given {
        Some(_) => on_the_base,
        // The law of contacts with a soft modulus hits more gently than stone does.
        None => larger_or_nan(hit(design, context.guideline.input.velocity), on_the_base),
    };
    let more_than_given =
        given.map_or(String::new(), |given| format!(", more than loads.point_load of {:.1} kN", given / 1e3));
    let then = struck(context, strength);
    if strength.is_nan() || then.iter().any(|then| then.kind == Kind::WallStrength && then.fails_by_equations()) {
        for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::WallStrength && outcome.holds()) {
            outcome.leave_open(OpenReason::NotGiven(match strength.is_nan() {
                true => unknown("break the metre of the wall that it hits", given),
                false => format!(
                    "the largest stone of the flow may hit a metre of the wall with up to {:.0} kN{more_than_given}, and that metre would not hold it ({}, or more resistance)",
                    strength / 1e3,
                    if given.is_some() { "give as much, or loads.impact_reduction" } else { "give loads.point_load" }
                ),
            }));
        }
    }
    if given.is_none() && !design.flow.boulders.is_empty() {
        // They are the point load of the base already.
        return;
    }
    let then = struck(context, on_the_base);
    for outcome in outcomes.iter_mut().filter(|outcome| is_of_the_base(outcome) && outcome.holds()) {
        let holds = then.iter().any(|then| then.id == outcome.id && !outcome.would_fail(then));
        if on_the_base.is_nan() {
            outcome.leave_open(OpenReason::NotGiven(unknown("move the block of the wall that it hits", given)));
        } else if !holds {
            outcome.leave_open(OpenReason::NotGiven(format!(
                "the largest stone of the flow may hit the wall with {:.0} kN{more_than_given}, and {} would not hold it ({}, and barrier.rigid_wall.stability.block_length)",
                on_the_base / 1e3,
                if block_is_given(design) { "its block" } else { "a block of one metre" },
                if given.is_some() { "give as much, or loads.impact_reduction" } else { "give loads.point_load or flow.boulders" }
            )));
        }
    }
}

fn unknown(may: &str, given: Option<f64>) -> String {
    let what = match given {
        Some(force) => format!(
            "so nobody can say whether the largest one hits harder than loads.point_load of {:.1} kN and may {may} (give flow.grain_sizes and solid_density)",
            force / 1e3
        ),
        None => format!("and the largest one may {may} (give flow.grain_sizes, solid_density and contact_modulus)"),
    };
    format!("the grains of the flow are not given, {what}")
}

fn is_of_the_base(outcome: &Outcome) -> bool {
    matches!(outcome.id.as_str(), "wall_sliding" | "wall_overturning" | "wall_bearing" | "wall_eccentricity")
}

fn block_is_given(design: &Design) -> bool {
    matches!(&design.barrier, BarrierDesign::RigidWall(wall) if wall.stability.is_some_and(|it| it.block_length.is_some()))
}

/// The checks of the wall where a stone hits it with a force (N) at the surface of the flow.
fn struck(CheckContext { design, guideline, .. }: CheckContext, force: f64) -> Vec<Outcome> {
    let mut struck = design.clone();
    struck.loads.point_load = Some((force, guideline.input.depth.min(height_over_bed(design))));
    if let BarrierDesign::RigidWall(wall) = &mut struck.barrier
        && let Some(stability) = &mut wall.stability
    {
        stability.block_length = stability.block_length.or(Some(SHORTEST_BLOCK));
    }
    let asked = guideline_for(&struck, guideline.input);
    check_all(&struck, &Demands::by_equations(&asked, &design.factors))
}

/// Largest force (N) of an elastic hit of the largest stone on a wall, v √(k m) with k = E r: the dashpot makes it somewhat less.
fn hit(design: &Design, velocity: f64) -> f64 {
    let [diameter, mass] = design.flow.largest();
    velocity * (design.flow.modulus * 0.5 * diameter * mass).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::not_covered::context::FirstSurge;
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
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut outcomes);
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
        // A load that is given stands for the stone, unless the stone hits harder.
        let named = |force: f64| {
            verdict(&|design| {
                strength(design, 3.0);
                design.flow.modulus = 1e11;
                design.loads.impact_reduction = 1.0;
                design.loads.point_load = Some((force, 1.0));
            })
        };
        assert_eq!([1.0, 1e9].map(named), [CheckVerdict::Open, CheckVerdict::Pass]);
        // The base of a wall that stands by its weight: a pebble moves no block, a stone of 6 t does.
        let on_its_base = |largest: f64| {
            let mut design = read_design("x", include_bytes!("../../../designs/gravity_wall.yaml")).unwrap().design;
            design.loads.point_load = None;
            design.flow.boulders.clear();
            design.flow.sizes = crate::design::sizes::SizeCurve::through(&[(0.0, 0.5 * largest), (1.0, largest)]);
            crate::checks::not_covered::tests::verdict_after(leave_open, &design, "wall_sliding", FirstSurge::default())
        };
        assert_eq!([0.02, 1.6].map(on_its_base), [CheckVerdict::Pass, CheckVerdict::Open]);
        assert_eq!(on_its_base(f64::NAN), CheckVerdict::Open);
        // Nothing is known of grains that are not given, whatever load stands for them.
        let unknown = |force: Option<f64>| {
            verdict(&|design| {
                strength(design, 100.0);
                design.flow.sizes = crate::design::sizes::SizeCurve::Unknown;
                design.loads.point_load = force.map(|force| (force, 1.0));
            })
        };
        assert_eq!([None, Some(1.0), Some(1e5)].map(unknown), [CheckVerdict::Open; 3]);
    }
}
