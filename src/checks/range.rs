//! Formulas used outside the range they are known for: a check that such a formula governs stays open, unless the design asks for a
//! warning alone (`limits.outside_range`).
//!
//! A check fails all the same: outside its range a formula may say too little, and what fails by it is not saved by that.

use crate::checks::detailing::{Bearing, LARGEST_SAG, LARGEST_STRAIN, LEAST_K, LEAST_LAMBDA, rules};
use crate::checks::outcome::{Kind, OpenReason, Outcome};
use crate::design::{BarrierDesign, Design, OutsideRange};
use crate::guideline::Guideline;

/// Leaves open what would hold by a formula that is used outside its range.
pub fn leave_open_outside_range(design: &Design, guideline: &Guideline, outcomes: &mut [Outcome]) {
    let stand = design.limits.outside_range == OutsideRange::Warn;
    let outside = |outcome: &mut Outcome, kind: fn(String) -> OpenReason, why: String| {
        // What is stretched beyond all sense stands by no wish.
        let absurd = strain_beyond(design, outcome).is_some_and(|strain| strain > 3.0 * LARGEST_STRAIN);
        if stand && !absurd {
            outcome.stand_despite(kind(why));
        } else if absurd {
            outcome.leave_open(kind(format!("{why} (give a stiffer rope)")));
        } else {
            outcome.leave_open(kind(format!("{why} (limits.outside_range: warn would let it stand)")));
        }
    };
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        if let Some(strain) = strain_beyond(design, outcome) {
            let why = format!(
                "the rope stretches by {:.0} %, beyond the {:.0} % up to which it is known to be elastic",
                100.0 * strain,
                100.0 * LARGEST_STRAIN
            );
            outside(outcome, OpenReason::Contradicted, why);
        }
    }
    let broken =
        rules(design, guideline).into_iter().filter(|rule| rule.bearing == Bearing::Pressures && !rule.holds());
    let of_pressures: Option<String> =
        broken.map(|rule| rule.title.to_string()).reduce(|all, more| format!("{all}, {more}"));
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.resistance.is_some()) {
        if !outcome.holds() || outcome.utilisation.is_none() {
            continue;
        }
        // A simulation is of the first surge: only the equations cover later surges and the full barrier.
        // With coefficients below those of the guideline it may govern for that reason alone.
        let low = guideline.input.earth_pressure < LEAST_K || guideline.input.dynamic_pressure < LEAST_LAMBDA;
        let alone =
            outcome.governed_by_equations() || ((design.loads.to_the_top || low) && outcome.demand.guideline.is_some());
        if !alone {
            continue;
        }
        let of_rope = outcome.rope.and_then(|rope| rope_outside(design, guideline, rope));
        let pressures = of_pressures.as_ref().filter(|_| outcome.rests_on_pressures);
        let why = of_rope.or_else(|| {
            pressures.map(|titles| format!("its pressures are used outside the range they are known for ({titles}; see the rules of detailing and range)"))
        });
        if let Some(why) = why {
            outside(outcome, OpenReason::OutOfRange, format!("the equations govern it and {why}"));
        }
    }
}

/// Strain of a rope in the simulation, where it is more than is known to be elastic.
fn strain_beyond(design: &Design, outcome: &Outcome) -> Option<f64> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let rope = match outcome.kind {
        // The law of rings is known up to their break.
        Kind::NetRopes if net.rings.is_some() => return None,
        Kind::NetRopes => &net.net_rope,
        Kind::LateralRopes => &net.lateral_rope,
        Kind::MainRope => &net.main_ropes.levels.get(outcome.rope?)?.rope,
        Kind::BetweenBolts => &net.main_ropes.levels[0].rope,
        _ => return None,
    };
    outcome.demand.simulation.map(|tension| tension / rope.axial_stiffness()).filter(|strain| *strain > LARGEST_STRAIN)
}

/// Why the parabola of a main rope is no longer known to hold, if so.
pub fn rope_outside(design: &Design, guideline: &Guideline, rope: usize) -> Option<String> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let (state, span) = guideline.ropes.get(rope).map(|rope| (&rope.state, rope.span))?;
    let line = net.main_ropes.levels.get(rope)?.rope;
    let (sag, strain) = (state.sag / span, state.tension / line.axial_stiffness());
    let within = sag <= LARGEST_SAG && strain <= LARGEST_STRAIN;
    (!within).then(|| {
        format!(
            "main rope {} sags {:.0} % of its span and stretches {:.0} %, beyond the {:.0} % and {:.0} % up to which a parabola with small strains holds",
            rope + 1,
            100.0 * sag,
            100.0 * strain,
            100.0 * LARGEST_SAG,
            100.0 * LARGEST_STRAIN
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demands;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use crate::quantities::other_ropes;

    fn design() -> Design {
        read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design
    }

    /// Verdict of a check by the equations.
    fn verdict(design: &Design, id: &str) -> CheckVerdict {
        let guideline = guideline(design);
        let mut outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
        leave_open_outside_range(design, &guideline, &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    #[test]
    fn a_check_that_pressures_outside_their_range_govern_stays_open_unless_the_design_says_otherwise() {
        let mut design = design();
        assert_eq!(verdict(&design, "rope_3_tension"), CheckVerdict::Pass);
        // Froude number 1.7, where λ = 2 is less than a model that follows it.
        let slow = |design: &mut Design| {
            design.factors.dynamic_pressure = 2.0;
            if let crate::design::Arrival::Surge(surge) = &mut design.flow.arrival {
                surge.velocity = 4.0;
            }
        };
        slow(&mut design);
        assert_eq!(verdict(&design, "rope_3_tension"), CheckVerdict::Open);
        assert_eq!(verdict(&design, "anchor_plateau"), CheckVerdict::Pass);
        design.limits.outside_range = OutsideRange::Warn;
        assert_eq!(verdict(&design, "rope_3_tension"), CheckVerdict::Warn);
        // What speaks against it is kept.
        let guideline = guideline(&design);
        let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
        leave_open_outside_range(&design, &guideline, &mut outcomes);
        let outcome = outcomes.iter().find(|outcome| outcome.id == "rope_3_tension").expect("a check");
        assert!(outcome.stands_despite[0].words().contains("Froude"), "{:?}", outcome.stands_despite);
    }

    #[test]
    fn a_rope_that_sags_beyond_its_parabola_stays_open() {
        let mut design = design();
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.dissipators.as_mut().expect("dissipators").plateau = 55e3;
        let guideline = guideline(&design);
        assert!(guideline.ropes[1].state.sag > LARGEST_SAG * guideline.ropes[1].span);
        assert!(rope_outside(&design, &guideline, 1).is_some());
        assert_eq!(verdict(&design, "anchor_2_load"), CheckVerdict::Open);
    }

    /// 7.2 kN in a rope of 12 mm with 0.1 GPa, EA of 11.3 kN, stretch it by 64 %; with 10 GPa by 0.6 %, with 0.5 GPa by 13 %.
    #[test]
    fn a_net_that_stretches_like_rubber_stays_open() {
        use crate::demand::Demand;
        let mut design = design();
        if let BarrierDesign::FlexibleNet(net) = &mut design.barrier {
            net.net_rope.diameter = 0.012;
        }
        let verdict = |design: &Design| {
            let guideline = guideline(design);
            let net_tension = Demand { simulation: Some(7.2e3), ..Demand::default() };
            let demands = Demands::by_equations(&guideline, &design.factors).with(&other_ropes::NET, &[net_tension]);
            let mut outcomes = check_all(design, &demands);
            leave_open_outside_range(design, &guideline, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "net_tension").expect("a check").verdict
        };
        assert_eq!(verdict(&design), CheckVerdict::Pass);
        if let BarrierDesign::FlexibleNet(net) = &mut design.barrier {
            net.net_rope.modulus = 0.1e9;
        }
        assert_eq!(verdict(&design), CheckVerdict::Open);
        // 64 % stand by no wish; 13 % do.
        design.limits.outside_range = OutsideRange::Warn;
        assert_eq!(verdict(&design), CheckVerdict::Open);
        if let BarrierDesign::FlexibleNet(net) = &mut design.barrier {
            net.net_rope.modulus = 0.5e9;
        }
        assert_eq!(verdict(&design), CheckVerdict::Warn);
    }

    /// Lateral ropes of 18 mm, main ropes of 22 mm, free and between bolts: 13 % of EA is beyond what is known to be elastic.
    #[test]
    fn lateral_ropes_and_the_rope_between_bolts_that_stretch_stay_open() {
        use crate::demand::Demand;
        let mut design = design();
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        let main = net.main_ropes.levels.iter_mut().map(|level| &mut level.rope);
        for rope in main.chain([&mut net.lateral_rope]) {
            rope.breaking_load = 1e12;
        }
        let of_level = |level: usize| net.main_ropes.levels[level].rope.axial_stiffness();
        let (lateral, bolted, main) = (net.lateral_rope.axial_stiffness(), of_level(0), of_level(1));
        let guideline = guideline(&design);
        for (id, axial) in [("lateral_tension", lateral), ("rope_1_tension", bolted), ("rope_2_tension", main)] {
            let verdict = |strain: f64| {
                let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
                let outcome = outcomes.iter_mut().find(|outcome| outcome.id == id).expect("a check");
                outcome.demand = Demand { simulation: Some(strain * axial), ..Demand::default() };
                (outcome.verdict, outcome.open) = (CheckVerdict::Pass, None);
                leave_open_outside_range(&design, &guideline, &mut outcomes);
                outcomes.iter().find(|outcome| outcome.id == id).expect("it").verdict
            };
            assert_eq!(verdict(0.09), CheckVerdict::Pass, "{id}");
            assert_eq!(verdict(0.13), CheckVerdict::Open, "{id}");
        }
    }

    /// In a bed of 49° pressures are those of a flow, in one of 51° nobody knows.
    #[test]
    fn a_bed_that_is_too_steep_is_outside_the_range() {
        let steep = |slope: f64| {
            let mut design = design();
            design.channel.slope = slope.to_radians();
            let rules = rules(&design, &guideline(&design));
            let rule = rules.into_iter().find(|rule| rule.title.starts_with("Slope of the bed")).expect("a rule");
            (rule.holds(), rule.bearing)
        };
        assert_eq!([49.0, 51.0].map(steep), [(true, Bearing::Pressures), (false, Bearing::Pressures)]);
    }

    /// What fails or is open already stays so; a simulated demand above that of the equations is theirs no longer, unless surges come until
    /// the barrier is full.
    #[test]
    fn a_range_bears_on_what_holds_by_the_equations() {
        let mut design = design();
        design.factors.dynamic_pressure = 2.0;
        if let crate::design::Arrival::Surge(surge) = &mut design.flow.arrival {
            surge.velocity = 4.0;
        }
        let after = |design: &Design, change: &dyn Fn(&mut Outcome)| {
            let guideline = guideline(design);
            let mut outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
            let outcome = outcomes.iter_mut().find(|outcome| outcome.id == "rope_3_tension").expect("a check");
            change(outcome);
            leave_open_outside_range(design, &guideline, &mut outcomes);
            outcomes.into_iter().find(|outcome| outcome.id == "rope_3_tension").expect("it").verdict
        };
        assert_eq!(after(&design, &|_| ()), CheckVerdict::Open);
        assert_eq!(after(&design, &|outcome| outcome.verdict = CheckVerdict::Fail), CheckVerdict::Fail);
        assert_eq!(after(&design, &|outcome| outcome.utilisation = None), CheckVerdict::Pass);
        let simulated = |outcome: &mut Outcome| {
            outcome.demand.simulation = outcome.demand.guideline.map(|guideline| 1.1 * guideline);
        };
        assert_eq!(after(&design, &simulated), CheckVerdict::Open);
        let alone = |outcome: &mut Outcome| {
            simulated(outcome);
            outcome.demand.guideline = None;
        };
        assert_eq!(after(&design, &alone), CheckVerdict::Pass);
        design.loads.to_the_top = false;
        assert_eq!(after(&design, &simulated), CheckVerdict::Pass);
    }
}
