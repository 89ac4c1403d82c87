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
use crate::guideline::{Guideline, elastic_hit, flows, guideline_for, height_over_bed};
use crate::larger::larger_or_nan;

/// Length of the block (m) that stands for one that nobody described: joints are no closer.
const SHORTEST_BLOCK: f64 = 1.0;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let CheckContext { design, guideline, seen } = context;
    if !matches!(design.barrier, BarrierDesign::RigidWall(_)) {
        return;
    }
    // As fast as any surge of the design, and as the flow is seen to come.
    let velocity = larger_or_nan(seen.map_or(0.0, |seen| seen.velocity), fastest(design, guideline));
    let known = |force: f64| if design.flow.tells_the_largest() { force } else { f64::NAN };
    let on_the_base = known(design.loads.impact_reduction.unwrap_or(1.0) * elastic_hit(design, velocity));
    let given = design.loads.point_load;
    if given.is_some_and(|(force, height)| stands_for(context, force, height, on_the_base)) {
        return;
    }
    // The law of contacts with a soft modulus hits more gently than stone does.
    let strength = larger_or_nan(hit(design, velocity), on_the_base);
    let told = Stone { given: given.map(|(force, _)| force), velocity, reduction: design.loads.impact_reduction };
    let then = struck(context, strength);
    if strength.is_nan() || then.iter().any(|then| then.kind == Kind::WallStrength && then.fails_by_equations()) {
        for outcome in outcomes.iter_mut().filter(|outcome| outcome.kind == Kind::WallStrength && outcome.holds()) {
            outcome.leave_open(OpenReason::NotGiven(match strength.is_nan() {
                true => unknown(design, "break the metre of the wall that it hits"),
                false => told.reason("a metre of the wall", strength, on_the_base, "that metre", "more resistance"),
            }));
        }
    }
    let then = struck(context, on_the_base);
    for outcome in outcomes.iter_mut().filter(|outcome| is_of_the_base(outcome) && outcome.holds()) {
        let holds = then.iter().any(|then| then.id == outcome.id && !outcome.would_fail(then));
        if on_the_base.is_nan() {
            outcome.leave_open(OpenReason::NotGiven(unknown(design, "move the block of the wall that it hits")));
        } else if !holds {
            let block = if block_is_given(design) { "its block" } else { "a block of one metre" };
            outcome.leave_open(OpenReason::NotGiven(told.reason(
                "the wall",
                on_the_base,
                on_the_base,
                block,
                if block_is_given(design) { "a heavier wall" } else { "barrier.rigid_wall.stability.block_length" },
            )));
        }
    }
}

/// Velocity of the fastest surge of the design (m/s).
fn fastest(design: &Design, guideline: &Guideline) -> f64 {
    flows(design, guideline.input).iter().map(|flow| flow.velocity).fold(0.0, larger_or_nan)
}

/// The hit of the largest stone on a metre of a wall, where no point load of the design stands for it: its force (N) and the share of what that metre
/// holds that it uses. Nothing where the stone is not known or the design gives no loads.impact_reduction.
pub fn hit_on_a_metre(design: &Design, guideline: &Guideline) -> Option<[f64; 2]> {
    let context = CheckContext { design, guideline, seen: None };
    let velocity = fastest(design, guideline);
    let reduced = design.loads.impact_reduction? * elastic_hit(design, velocity);
    let given = design.loads.point_load;
    if !design.flow.tells_the_largest()
        || given.is_some_and(|(force, height)| stands_for(context, force, height, reduced))
    {
        return None;
    }
    let force = larger_or_nan(hit(design, velocity), reduced);
    let then = struck(context, force);
    let of_the_metre = then.iter().filter(|then| then.kind == Kind::WallStrength);
    let used = of_the_metre.filter_map(Outcome::used).reduce(larger_or_nan)?;
    Some([force, used])
}

/// Whether a point load that the design gives stands for the stone: it is no smaller, and its moment is no less where the stone comes with a surge
/// over the highest deposit.
fn stands_for(
    CheckContext { design, guideline, .. }: CheckContext,
    force: f64,
    height: Option<f64>,
    stone: f64,
) -> bool {
    let surfaces = flows(design, guideline.input).into_iter().map(|flow| larger_or_nan(flow.fill_height, flow.depth));
    let highest = surfaces.fold(0.0, larger_or_nan).min(height_over_bed(design));
    force >= stone && height.is_none_or(|height| force * height >= stone * highest)
}

/// What is told of the stone.
struct Stone {
    given: Option<f64>,
    velocity: f64,
    /// Share of the elastic force that is asked with, where the design gives one.
    reduction: Option<f64>,
}

impl Stone {
    fn reason(&self, place: &str, force: f64, reduced: f64, part: &str, or: &str) -> String {
        let more =
            self.given.map_or(String::new(), |given| format!(", where loads.point_load is {:.1} kN", given / 1e3));
        let by = match self.reduction {
            _ if force > reduced => "by the contact law with flow.contact_modulus",
            None => "its whole elastic force, as loads.impact_reduction is not given",
            Some(_) => "its elastic force, reduced by loads.impact_reduction",
        };
        let give = if self.given.is_some() {
            "give as much at the surface of the highest surge"
        } else {
            "give loads.point_load"
        };
        format!(
            "the largest stone of the flow may hit {place} with up to {:.0} kN at {:.1} m/s ({by}){more}, and {part} would not hold it ({give}, loads.impact_reduction with its source, or {or})",
            force / 1e3,
            self.velocity
        )
    }
}

fn unknown(design: &Design, may: &str) -> String {
    let cut_short = design.flow.sizes.continued_from().filter(|_| !design.flow.tells_the_largest());
    let (what, give) = match cut_short {
        Some(share) => (
            format!("the grain sizes are given up to D{:.0}", 100.0 * share),
            "flow.grain_sizes up to d84 or coarser".to_string(),
        ),
        None => ("the grains of the flow are not given".to_string(), "flow.grain_sizes and solid_density".to_string()),
    };
    match design.loads.point_load {
        Some((force, _)) => format!(
            "{what}, so nobody can say whether the largest one hits harder than loads.point_load of {:.1} kN and may {may} (give {give})",
            force / 1e3
        ),
        None => format!("{what}, and the largest one may {may} (give {give}, and contact_modulus)"),
    }
}

fn is_of_the_base(outcome: &Outcome) -> bool {
    matches!(outcome.id.as_str(), "wall_sliding" | "wall_overturning" | "wall_bearing" | "wall_eccentricity")
}

fn block_is_given(design: &Design) -> bool {
    matches!(&design.barrier, BarrierDesign::RigidWall(wall) if wall.stability.is_some_and(|it| it.block_length.is_some()))
}

/// The checks of the wall where a stone hits it with a force (N) at the surface of each surge.
fn struck(CheckContext { design, guideline, .. }: CheckContext, force: f64) -> Vec<Outcome> {
    let mut struck = design.clone();
    struck.loads.point_load = Some((force, None));
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

    /// The stone may come with a surge over the highest deposit: a load of its force that acts at the depth of the flow does not stand for it, one at
    /// that surface does, and so does one that is as much larger as it acts lower.
    #[test]
    fn a_load_that_acts_too_low_does_not_stand_for_the_stone() {
        let design = read_design("x", include_bytes!("../../../designs/gravity_wall.yaml")).unwrap().design;
        let guideline = guideline(&design);
        let context = CheckContext { design: &design, guideline: &guideline, seen: None };
        let [depth, highest] = [guideline.input.depth, guideline.input.fill_height];
        assert!(highest > 2.0 * depth, "{highest} {depth}");
        let stands = |force: f64, height: Option<f64>| stands_for(context, force, height, 1e5);
        assert_eq!([Some(highest), None].map(|height| stands(1e5, height)), [true; 2]);
        assert!(!stands(1e5, Some(depth)));
        assert_eq!([0.999e5, 1.001e5].map(|force| stands(force * highest / depth, Some(depth))), [false, true]);
        assert!(!stands(0.99e5, None) && !stands(f64::NAN, None));
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
                design.loads.impact_reduction = Some(1.0);
                design.loads.point_load = Some((force, Some(1.0)));
            })
        };
        assert_eq!([1.0, 1e9].map(named), [CheckVerdict::Open, CheckVerdict::Pass]);
        // A token load takes nothing away: the law of contacts with a hard modulus still breaks the metre.
        let token = |force: f64| {
            verdict(&|design| {
                strength(design, 3.0);
                (design.flow.modulus, design.loads.impact_reduction) = (1e13, Some(1e-3));
                design.loads.point_load = (force > 0.0).then_some((force, Some(1.0)));
            })
        };
        assert_eq!([0.0, 1.0].map(token), [CheckVerdict::Open; 2]);
        // Of grains that are given up to their middle nobody knows the largest.
        let coarse_end = |coarsest: f64| {
            verdict(&|design| {
                strength(design, 100.0);
                design.flow.sizes = crate::design::sizes::SizeCurve::through(&[(0.1, 0.1), (coarsest, 0.3)]);
            })
        };
        assert_eq!([0.5, 0.9].map(coarse_end), [CheckVerdict::Open, CheckVerdict::Pass]);
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
                design.loads.point_load = force.map(|force| (force, Some(1.0)));
            })
        };
        assert_eq!([None, Some(1.0), Some(1e5)].map(unknown), [CheckVerdict::Open; 3]);
    }
}
