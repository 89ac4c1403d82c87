//! Tension of main, net and lateral ropes against their design resistance.

use crate::checks::outcome::{CheckName, Kind, OpenReason, Outcome, Resistance};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, FlexibleNet, Level, NetRings, Rope};
use crate::quantities::quantity::Unit;
use crate::quantities::{other_ropes, rope_tension};
use crate::sources::{RING_FACTOR, ROPE_FACTOR};
use crate::text::Text;

pub(crate) const MAIN_TEXTS: &[Text] = &[Text {
    id: "rope_N_tension",
    meaning: "The tension of a main rope, counted from the bottom, or between its bolts of one that the bed holds. By the equations a rope sags to a parabola under its share of the pressure; with dissipators they cap its pull.",
    formula: "T = √(H² + (q L/2)²), H = q L²/(8 f) ≤ rope_utilisation · F_br · rope_end/γ_M",
    source: ROPE_FACTOR,
}];

pub(crate) const NET_TEXTS: &[Text] = &[Text {
    id: "net_tension",
    meaning: "The tension of the ropes of the net, or the force of a leg of a ring of a ring net, as that of a chain of such rings that is as near to breaking.",
    formula: "T ≤ rope_utilisation · F_br · rope_end/γ_M; of rings 0.83 · half of what a chain holds/γ_M",
    source: RING_FACTOR,
}];

pub(crate) const LATERAL_TEXTS: &[Text] = &[Text {
    id: "lateral_tension",
    meaning: "The tension of the lateral ropes, which hold the edges of the net. The equations do not know it.",
    formula: "T ≤ rope_utilisation · F_br · rope_end/γ_M",
    source: ROPE_FACTOR,
}];

pub(crate) const PLATEAU_TEXTS: &[Text] = &[Text {
    id: "rope_plateau",
    meaning: "A rule of design, whatever the event: a main rope must hold the force of its yielding dissipators, with their overstrength.",
    formula: "overstrength · F_plateau ≤ rope_utilisation · F_br · rope_end/γ_M",
    source: ROPE_FACTOR,
}];

/// Main ropes that are free to move; one bolted to the bed is held all along and is not checked.
pub fn check_main(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let tensions = demands.each(&rope_tension::PEAK).iter().enumerate().skip(net.ropes_held_by_bed());
    tensions
        .filter_map(|(index, demand)| {
            let name = CheckName::of(&rope_tension::PEAK, index, format!("rope_{}_tension", index + 1), ROPE_FACTOR);
            let level = net.main_ropes.levels.get(index)?;
            let outcome = check(design, &level.rope, name.each_of(level.ropes), *demand).of_rope(index);
            let outcome = Outcome { kind: Kind::MainRope, ..outcome };
            Some(if net.runs_over_posts(index) { outcome.only_by_simulation(OVER_POSTS) } else { outcome })
        })
        .collect()
}

/// Why the equations alone do not judge the rope over posts.
pub const OVER_POSTS: &str = "the ropes below sag more than the one over the posts, the net hands their load to it, and the equations do not know how much";

pub fn check_net(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let demand = demands.one(&other_ropes::NET);
    let outcome = match &net.rings {
        Some(rings) => {
            let title = "Force of a leg of the net's rings, as in a chain";
            check_rings(design, rings, CheckName::new("net_tension", title, Unit::Newton, RING_FACTOR), demand)
        }
        None => {
            let name = CheckName::of(&other_ropes::NET, 0, "net_tension", ROPE_FACTOR);
            check(design, &net.net_rope, name, demand)
        }
    };
    vec![Outcome { kind: Kind::NetRopes, ..outcome }]
}

pub fn check_lateral(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let name = CheckName::of(&other_ropes::LATERAL, 0, "lateral_tension", ROPE_FACTOR);
    let outcome = check(design, &net.lateral_rope, name, demands.one(&other_ropes::LATERAL));
    vec![Outcome { kind: Kind::LateralRopes, ..outcome }]
}

pub(super) fn check(design: &Design, rope: &Rope, name: CheckName, demand: Demand) -> Outcome {
    let mut outcome = Outcome::at_most(name, demand, resistance(design, rope), design.limits.rope_utilisation);
    leave_open_what_is_not_known(design, rope, &mut outcome);
    outcome
}

/// The force of a leg of a ring, as that of a chain that is as near to breaking, against what such a chain holds.
fn check_rings(design: &Design, rings: &NetRings, name: CheckName, demand: Demand) -> Outcome {
    let mut outcome =
        Outcome::at_most(name, demand, resistance_of_rings(design, rings), design.limits.rope_utilisation);
    outcome = outcome.only_by_simulation("single grains load rings more than the even pressure of the equations");
    if outcome.holds() && rings.tested && rings.used() > MOST_USED {
        outcome.leave_open(OpenReason::NotGiven(format!(
            "the chain_test that is given uses {:.0} % of the strength of its wires, and no test that is known more than {:.0} % (give the wires as they are, or the test)",
            100.0 * rings.used(),
            100.0 * MOST_USED
        )));
    }
    if outcome.holds() && !rings.is_known() {
        outcome.leave_open(OpenReason::NotGiven(
            "it holds by the tests of rings of 300 mm with four contacts and 5 to 19 windings of 3 mm of 1770 MPa, and what rings of other kinds hold is not known (give net.rings.chain_test)".into(),
        ));
    }
    outcome
}

/// Largest share of its wires' strength that a chain of rings has used: 16 windings (Guo 2022).
const MOST_USED: f64 = 0.45;

/// What a leg of a ring holds: rings have no ends.
pub fn resistance_of_rings(design: &Design, rings: &NetRings) -> Resistance {
    Resistance { characteristic: rings.characteristic_leg(), factor: design.factors.rope }
}

/// What the net holds.
pub fn resistance_of_net(design: &Design, net: &FlexibleNet) -> Resistance {
    net.rings.map_or_else(|| resistance(design, &net.net_rope), |rings| resistance_of_rings(design, &rings))
}

/// What a rope holds: at its ends, or what it can bear without drawing out, if that is less.
pub fn resistance(design: &Design, rope: &Rope) -> Resistance {
    let ends = Resistance { characteristic: rope.breaking_load * design.factors.rope_end, factor: design.factors.rope };
    match rope.elastic_limit {
        Some(limit) if limit < ends.characteristic / ends.factor => Resistance { characteristic: limit, factor: 1.0 },
        _ => ends,
    }
}

/// Share of the elastic limit from which a simulated tension counts as cut off by it.
const CUT_OFF: f64 = 0.999;

/// Share of the breaking load that ferrules and grips hold at the least (EN 13411-3 and -5, not checked against the original: 0.8 to 0.9).
const WEAKEST_END: f64 = 0.8;

/// Leaves a check open where the rope would draw out, as far as nobody knows, and where it holds only with ends that nobody has described.
pub fn leave_open_what_is_not_known(design: &Design, rope: &Rope, outcome: &mut Outcome) {
    let Some((largest, capacity)) = outcome.demand.largest().zip(outcome.capacity) else { return };
    let breaks = rope.breaking_load * design.factors.rope_end / design.factors.rope;
    if rope.elastic_limit.is_some_and(|limit| limit < breaks && largest >= CUT_OFF * limit) && largest <= breaks {
        outcome.leave_open(OpenReason::NotGiven(
            "the rope would be pulled to its elastic limit and draw out, and how far it may the design does not say (give a stronger rope; without elastic_limit its breaking load decides)".into(),
        ));
    } else if outcome.holds() && !design.factors.rope_end_given && largest > WEAKEST_END * capacity {
        outcome.leave_open(holds_with_sockets_alone());
    }
}

fn holds_with_sockets_alone() -> OpenReason {
    OpenReason::NotGiven(format!(
        "it holds with ends that hold the whole breaking load, as sockets do, but not with ferrules or grips that hold {:.0} % of it (give factors.rope_end)",
        100.0 * WEAKEST_END
    ))
}

/// Where nobody has described the ends of the ropes, all rules are asked again with the weakest ones: what holds only with sockets is open.
pub fn leave_open_what_sockets_alone_hold(
    design: &Design,
    outcomes: &mut [Outcome],
    judge: impl Fn(&Design) -> Vec<Outcome>,
) {
    if design.factors.rope_end_given || matches!(design.barrier, BarrierDesign::RigidWall(_)) {
        return;
    }
    let mut weak = design.clone();
    (weak.factors.rope_end, weak.factors.rope_end_given) = (WEAKEST_END, true);
    let then = judge(&weak);
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        if then.iter().any(|then| then.id == outcome.id && !then.holds()) {
            outcome.leave_open(holds_with_sockets_alone());
        }
    }
}

/// A dissipator at work pulls the end of its rope with its plateau, overstrength included, whatever the design flow shows.
pub fn check_plateau(design: &Design, _: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let Some(dissipators) = &net.dissipators else { return Vec::new() };
    let own = Demand { guideline: Some(design.factors.overstrength * dissipators.plateau), ..Demand::default() };
    let name = CheckName::new(
        "rope_plateau",
        "Main ropes against the force of a yielding dissipator",
        Unit::Newton,
        ROPE_FACTOR,
    );
    // Each rope has dissipators of its own: the most loaded of those that have some. Over posts friction on their heads adds to it.
    let over_heads = net
        .posts
        .as_ref()
        .map_or(1.0, |_| crate::guideline::guideline(design).ropes.last().map_or(f64::NAN, |rope| rope.over_heads));
    let free = net.main_ropes.levels.iter().enumerate().skip(net.ropes_held_by_bed());
    let of = |(index, level): (usize, &Level)| {
        let more = if net.runs_over_posts(index) { over_heads } else { 1.0 };
        let demand = Demand { guideline: own.guideline.map(|pull| more * pull), ..own };
        check(design, &level.rope, name.clone(), demand).between_parts()
    };
    let used = |outcome: &Outcome| outcome.utilisation.unwrap_or(f64::NAN);
    free.map(of).max_by(|a, b| used(a).total_cmp(&used(b))).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::CheckVerdict;
    use crate::design::read::read_design;

    fn design_resistance(design: &Design, rope: &Rope) -> f64 {
        let Resistance { characteristic, factor } = resistance(design, rope);
        characteristic / factor
    }

    /// Of what a rope holds, its ends hold 0.8 where nobody says what they hold. One that draws out at a third of it is cut off there.
    #[test]
    fn a_rope_is_held_against_what_is_known_of_it() {
        let design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        let verdict = |limit: Option<f64>, given: bool, tension: f64| {
            let mut design = design.clone();
            design.factors.rope_end_given = given;
            let rope = Rope { elastic_limit: limit, ..net.main_ropes.levels[1].rope };
            let demand = Demand { guideline: Some(tension), ..Demand::default() };
            check(&design, &rope, CheckName::new("x", "x", Unit::Newton, "x"), demand).verdict
        };
        let holds = design_resistance(&design, &net.main_ropes.levels[1].rope) * design.limits.rope_utilisation;
        let limit = 0.36 * holds;
        assert_eq!(verdict(None, true, 0.85 * holds), CheckVerdict::Pass);
        assert_eq!(verdict(None, false, 0.85 * holds), CheckVerdict::Open);
        assert_eq!(verdict(None, false, 0.79 * holds), CheckVerdict::Pass);
        assert_eq!(verdict(None, false, 1.01 * holds), CheckVerdict::Fail);
        assert_eq!(verdict(Some(limit), true, 0.9 * limit), CheckVerdict::Pass);
        assert_eq!(verdict(Some(limit), true, 0.9995 * limit), CheckVerdict::Open);
        assert_eq!(verdict(Some(limit), true, 0.6 * holds), CheckVerdict::Open);
        assert_eq!(verdict(Some(limit), true, 1.01 * holds), CheckVerdict::Fail);
        assert_eq!(verdict(Some(limit), true, f64::NAN), CheckVerdict::Fail);
    }

    /// 12 windings of 3 mm: a leg holds 0.3835 × 150.1 kN = 57.6 kN, of which the lowest test leaves 0.83; over the factor of ropes. With 4
    /// windings nobody knows.
    #[test]
    fn rings_are_held_against_the_lowest_test_of_their_chain() {
        let text = include_str!("../../designs/ring_net.yaml");
        let verdict = |windings: &str, tension: f64| {
            let text = text.replace("windings: 12", &format!("windings: {windings}"));
            let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
            let demand = Demand { simulation: Some(tension), ..Demand::default() };
            let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
            let rings = net.rings.expect("rings");
            let outcome = check_rings(&design, &rings, CheckName::new("x", "x", Unit::Newton, "x"), demand);
            (outcome.verdict, design.factors.rope)
        };
        let factor = verdict("12", 0.0).1;
        let holds = 0.83 * 0.3835 * 150.15e3 / factor;
        assert_eq!(verdict("12", 0.69 * holds).0, CheckVerdict::Pass);
        assert_eq!(verdict("12", 1.01 * holds).0, CheckVerdict::Fail);
        assert_eq!(verdict("4", 0.1 * holds).0, CheckVerdict::Open);
        assert_eq!(verdict("12", f64::NAN).0, CheckVerdict::Fail);
    }

    #[test]
    fn main_ropes_hold_the_plateau_of_their_dissipators() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let verdict = |design: &Design| check_plateau(design, &Demands::default())[0].verdict;
        assert_eq!(verdict(&design), CheckVerdict::Pass);
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        let breaking_load = net.main_ropes.levels[2].rope.breaking_load;
        net.dissipators.as_mut().expect("dissipators").plateau = 0.9 * breaking_load;
        assert_eq!(verdict(&design), CheckVerdict::Fail);
    }

    /// Ends that nobody has described: all rules are asked again with 80 % of the breaking load.
    #[test]
    fn what_fails_anywhere_with_weak_ends_is_open_where_they_are_not_described() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        let tension = 0.75 * design_resistance(&design, &net.net_rope);
        let verdict = |design: &Design| {
            let name = || CheckName::new("net_tension", "x", Unit::Newton, "x");
            // A rule that asks for 1.2 times the tension that is shown.
            let judge = |design: &Design| {
                let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
                let demand = Demand { simulation: Some(1.2 * tension), ..Demand::default() };
                vec![Outcome::at_most(name(), demand, resistance(design, &net.net_rope), 1.0)]
            };
            let mut outcomes = judge(design);
            assert!(outcomes[0].holds());
            leave_open_what_sockets_alone_hold(design, &mut outcomes, judge);
            outcomes[0].verdict
        };
        design.factors.rope_end_given = true;
        assert_ne!(verdict(&design), CheckVerdict::Open);
        design.factors.rope_end_given = false;
        assert_eq!(verdict(&design), CheckVerdict::Open);
    }
}
