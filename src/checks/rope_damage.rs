//! Ropes that break or draw out in the simulation, where the design lets them.

use crate::checks::outcome::{CheckName, CheckVerdict, OpenReason, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design, Rope};
use crate::quantities::rope_damage;
use crate::sources::{NO_LIMIT, NOTHING_BREAKS};
use crate::text::Text;

pub(crate) const BROKEN_TEXTS: &[Text] = &[Text {
    id: "broken_pieces",
    meaning: "Whether any rope breaks in the simulation, where the design lets ropes break. How near a rope is to breaking, its tension tells.",
    formula: "no piece breaks",
    source: NOTHING_BREAKS,
}];

pub(crate) const DRAWN_OUT_TEXTS: &[Text] = &[Text {
    id: "drawn_out",
    meaning: "By how much ropes draw out at their elastic limit. The design gives no allowable elongation: more than 0.1 % leaves the check open.",
    formula: "permanent elongation ≤ 0.1 %",
    source: "",
}];

fn any_rope(design: &Design, allows: impl Fn(&Rope) -> bool) -> bool {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return false };
    net.ropes().any(allows)
}

/// Nothing may break. There is no utilisation to tell: how far from breaking a rope is, its tension tells.
pub fn check_broken(design: &Design, demands: &Demands) -> Vec<Outcome> {
    if !any_rope(design, |rope| rope.breaks) {
        return Vec::new();
    }
    let name = CheckName::of(&rope_damage::BROKEN, 0, "broken_pieces", NOTHING_BREAKS);
    let mut outcome = Outcome::informative(name, demands.one(&rope_damage::BROKEN));
    match outcome.demand.simulation {
        None => outcome.leave_open(OpenReason::NeedsSimulation(
            "whether ropes break is seen in the simulation alone (run it)".into(),
        )),
        Some(0.0) => outcome.verdict = CheckVerdict::Pass,
        Some(count) => (outcome.verdict, outcome.utilisation) = (CheckVerdict::Fail, Some(1.0 + count)),
    }
    vec![outcome]
}

/// Permanent elongation from which it is more than rounding.
const DRAWN_OUT: f64 = 1e-3;

/// A rope that has drawn out must be replaced; the simulation goes on with it, its tension cut off at the elastic limit. How far a rope
/// may draw out the design does not say: more than nothing leaves the check open.
pub fn tell_drawn_out(design: &Design, demands: &Demands) -> Vec<Outcome> {
    if !any_rope(design, |rope| rope.elastic_limit.is_some()) {
        return Vec::new();
    }
    let name = CheckName::of(&rope_damage::DRAWN_OUT, 0, "drawn_out", NO_LIMIT);
    let mut outcome = Outcome::informative(name, demands.one(&rope_damage::DRAWN_OUT));
    match outcome.demand.simulation {
        None => outcome.leave_open(OpenReason::NeedsSimulation(
            "whether ropes draw out is seen in the simulation alone (run it)".into(),
        )),
        Some(elongation) => {
            // Asked as "within", so that what is not a number is not.
            let within = elongation <= DRAWN_OUT;
            if !within {
                outcome.leave_open(OpenReason::NotGiven(format!(
                    "ropes draw out by up to {:.1} % at their elastic limit, which cuts off the tension that is checked, and the design gives no allowable elongation (without elastic_limit the check uses the tension instead)",
                    100.0 * elongation
                )));
            }
        }
    }
    vec![outcome]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demand::Demand;
    use crate::design::read::read_design;
    use crate::quantities::rope_damage;

    /// The net of the example, whose net ropes break or draw out.
    fn design(breaks: bool, elastic_limit: Option<f64>) -> Design {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        (net.net_rope.breaks, net.net_rope.elastic_limit) = (breaks, elastic_limit);
        design
    }

    fn demands(broken: Option<f64>, drawn_out: Option<f64>) -> Demands {
        let seen = |simulation| Demand { simulation, ..Demand::default() };
        Demands::default().with(&rope_damage::BROKEN, &[seen(broken)]).with(&rope_damage::DRAWN_OUT, &[seen(drawn_out)])
    }

    #[test]
    fn a_rope_that_breaks_fails_the_design_and_one_that_cannot_is_not_asked() {
        let verdict = |broken| check_broken(&design(true, None), &demands(broken, None))[0].verdict;
        assert_eq!(verdict(Some(0.0)), CheckVerdict::Pass);
        assert_eq!(verdict(Some(1.0)), CheckVerdict::Fail);
        assert_eq!(verdict(Some(f64::NAN)), CheckVerdict::Fail);
        assert_eq!(verdict(None), CheckVerdict::Open);
        assert!(check_broken(&design(false, None), &demands(Some(1.0), None)).is_empty());
        // Whichever of the ropes it is.
        for part in 0..3 {
            let mut design = design(false, None);
            let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            [&mut net.net_rope, &mut net.main_ropes.levels[1].rope, &mut net.lateral_rope][part].breaks = true;
            assert_eq!(check_broken(&design, &demands(Some(2.0), None))[0].verdict, CheckVerdict::Fail);
        }
    }

    #[test]
    fn a_rope_that_draws_out_leaves_the_design_open() {
        let design = design(false, Some(50e3));
        let verdict = |drawn_out| tell_drawn_out(&design, &demands(None, drawn_out))[0].verdict;
        assert_eq!(verdict(Some(0.0)), CheckVerdict::Info);
        assert_eq!(verdict(Some(0.002)), CheckVerdict::Open);
        assert_eq!(verdict(Some(f64::NAN)), CheckVerdict::Open);
        assert_eq!(verdict(None), CheckVerdict::Open);
    }

    /// Three pieces broken are told as three, beyond what may break by all of them.
    #[test]
    fn every_broken_piece_counts() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.net_rope.breaks = true;
        let broken_pieces = crate::demand::Demand { simulation: Some(3.0), ..Default::default() };
        let outcomes = check_broken(&design, &Demands::default().with(&rope_damage::BROKEN, &[broken_pieces]));
        assert_eq!(outcomes[0].utilisation, Some(4.0));
    }
}
