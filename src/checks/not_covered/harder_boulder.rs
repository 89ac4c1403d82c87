//! A boulder in the simulation may hit a wall harder than the point load that the equations hold it against. The simulated demands share the hit
//! over the whole wall, so it is asked again of the metres, or of the block, that take it.

use super::context::CheckContext;
use crate::checks::check_all;
use crate::checks::outcome::{OpenReason, Outcome};
use crate::demand::Demands;
use crate::design::BarrierDesign;
use crate::guideline::{guideline_for, point_load};

pub fn leave_open(CheckContext { design, guideline, seen }: CheckContext, outcomes: &mut [Outcome]) {
    let (Some(seen), BarrierDesign::RigidWall(_)) = (seen, &design.barrier) else { return };
    let Some(hit) = point_load(design, &guideline.input) else { return };
    // Asked so that what is not a number goes on.
    if seen.boulder <= 0.0 {
        return;
    }
    let mut struck = design.clone();
    // It may come with any surge.
    struck.loads.point_load = Some((seen.boulder, None));
    let asked = guideline_for(&struck, guideline.input);
    let then = check_all(&struck, &Demands::by_equations(&asked, &design.factors));
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        let fails = then.iter().any(|then| then.id == outcome.id && outcome.would_fail(then));
        if fails || seen.boulder.is_nan() {
            outcome.leave_open(OpenReason::Contradicted(format!(
                "in the simulation a boulder hits the wall with {:.0} kN, where the point load is {:.0} kN, and under that at the surface of the highest surge it would fail (give loads.point_load, or more resistance)",
                seen.boulder / 1e3,
                hit.hardest() / 1e3
            )));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::not_covered::context::FirstSurge;
    use crate::checks::not_covered::tests::verdict_after;
    use crate::checks::outcome::CheckVerdict;
    use crate::design::read::read_design;

    /// The wall's base holds 100 kN on its 8 m, and not 10 MN.
    #[test]
    fn a_boulder_that_hits_harder_than_the_point_load_is_asked_again() {
        let design = read_design("x", include_bytes!("../../../designs/gravity_wall.yaml")).unwrap().design;
        let verdict = |boulder: f64| {
            let seen = FirstSurge { boulder, ..FirstSurge::default() };
            verdict_after(leave_open, &design, "wall_sliding", seen)
        };
        assert_eq!(verdict(0.0), CheckVerdict::Pass);
        assert_eq!(verdict(101e3), CheckVerdict::Pass);
        assert_eq!(verdict(10e6), CheckVerdict::Open);
        assert_eq!(verdict(f64::NAN), CheckVerdict::Open);
    }
}
