//! The bolts that hold the lowest main rope to the bed, and the rope between them.
//!
//! The load is not even along the rope: of the simulated examples the worst bolt takes two to three times the mean, and part of it
//! lifts. So the equations, which spread the load evenly, can fail the bolts but never pass them. Between its bolts the rope sags: with the
//! load P of the worst space between two bolts on each, a rope that lay straight is pulled along its span with H = (c P² EA/24)^⅓, where c tells how the
//! load is concentrated at the rings in a space ([`concentration`]); at its bolts its tension is T = √(H² + (P/2)²), which the bolts at its ends
//! hold, and the pull of the lateral ropes that end there as well. The bolts are taken as unyielding.

use crate::checks::between_bolts::{concentration, tension_between};
use crate::checks::outcome::{CheckName, Kind, LoadScaling, OpenReason, Outcome, Resistance};
use crate::checks::ropes::{leave_open_what_is_not_known, resistance};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Bottom, Design};
use crate::quantities::quantity::Unit;
use crate::quantities::{bed, other_ropes};
use crate::sources::{ANCHOR_FACTOR, NO_LIMIT, ROPE_FACTOR};
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "bed_bolts",
    meaning: "The load of the worst bolt that holds the lowest rope to the bed. The equations spread the load evenly and can fail the bolts, but never pass them: the worst bolt takes two to three times the mean.",
    formula: "T = √(H² + (P/2)²), H = (c P² EA/24)^⅓ ≤ anchor_utilisation · R_k/γ_M",
    source: ANCHOR_FACTOR,
}];

/// Ring spacings between two bolts up to which the lowest rope counts as held along its length.
const MOST_RINGS: f64 = 4.0;

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    if net.bottom != Bottom::Fixed {
        return Vec::new();
    }
    let name = CheckName::of(&bed::BOLT, 0, "bed_bolts", ANCHOR_FACTOR);
    let Some((bolts, characteristic)) = net.bed_bolts.and_then(|bolts| Some((bolts, bolts.resistance?))) else {
        let title = "Load on what holds the lowest rope to the bed, in all";
        let name = CheckName { title: title.into(), source: NO_LIMIT, ..name };
        let wanted = "anchors.bed_bolt_spacing and anchors.bed_bolt_resistance";
        return vec![Outcome::without_resistance(name, demands.one(&bed::FORCE), wanted)];
    };
    let width = design.channel.section().bed_length();
    let spacing = width / bolts.spaces(width) as f64;
    let lowest = &net.main_ropes.levels[0];
    // The bolts hold all ropes of the level; between them each bears its share.
    let ropes = f64::from(lowest.ropes);
    let more = concentration(spacing / net.main_ropes.ring_spacing);
    let axial = lowest.rope.axial_stiffness() * more;
    let lateral = demands.one(&other_ropes::LATERAL).simulation.unwrap_or(0.0);
    let in_a_space = demands.one(&bed::SPACE);
    // No less than the worst bolt along the rope.
    let at_an_end = each(in_a_space, |load| tension_between(load, ropes * axial)).or_larger(&demands.one(&bed::BOLT));
    // The lateral ropes end at the ends of the lowest rope: in the worst case their pull has its direction.
    let with_lateral = |load: Option<f64>| load.map(|load| load + lateral);
    let at_an_end = Demand {
        simulation: with_lateral(at_an_end.simulation),
        characteristic: with_lateral(at_an_end.characteristic),
        ..at_an_end
    };
    let between = each(in_a_space, |load| tension_between(load / ropes, axial));
    let bolt = Resistance { characteristic, factor: design.factors.anchor };
    let rope = resistance(design, &lowest.rope);
    let rope_name =
        CheckName::new("rope_1_tension", "Tension of main rope 1 between its bolts", Unit::Newton, ROPE_FACTOR)
            .each_of(lowest.ropes);
    let outcomes = [
        (Kind::Bolts, Outcome::at_most(name, at_an_end, bolt, design.limits.anchor_utilisation)),
        (Kind::BetweenBolts, Outcome::at_most(rope_name, between, rope, design.limits.rope_utilisation)),
    ];
    outcomes
        .into_iter()
        .map(|(kind, outcome)| {
            let mut outcome =
                outcome.only_by_simulation("the load is not even along the rope, and the equations spread it evenly");
            outcome.kind = kind;
            outcome.growth = LoadScaling::EndBolt { axial: ropes * axial, lateral };
            if kind == Kind::BetweenBolts {
                leave_open_what_is_not_known(design, &lowest.rope, &mut outcome);
                outcome.growth = LoadScaling::BetweenBolts { axial };
            }
            if outcome.holds() && spacing > MOST_RINGS * net.main_ropes.ring_spacing {
                outcome.leave_open(OpenReason::OutOfRange(format!(
                    "the lowest rope is modelled as held at every ring, and between bolts {spacing:.2} m apart it would hang free (at most {MOST_RINGS} ring spacings)"
                )));
            }
            outcome
        })
        .collect()
}

/// The demand with its loads made something else.
fn each(demand: Demand, change: impl Fn(f64) -> f64) -> Demand {
    Demand {
        guideline: demand.guideline.map(&change),
        simulation: demand.simulation.map(&change),
        characteristic: demand.characteristic.map(&change),
        cap: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::between_bolts::{end_bolt, end_bolt_under_more, tension_under_more};
    use crate::checks::outcome::CheckVerdict;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use crate::quantities::bed;
    use approx::assert_relative_eq;

    /// By hand: 40 kN on a space, EA of 12.57 MN: H³ = 1.6e9 · 12.57e6/24 = 8.38e14, H = 94.3 kN, sag over span 40/(8 · 94.3) = 5.3 %,
    /// stretch 8/3 · 0.053² = 0.75 % = 94.3/12 570. With half of 40 kN beside it the rope's tension is 96.4 kN, which the end bolt holds.
    /// Under 80 kN H is 2^⅔ as much, 149.7 kN, and T 155.0 kN.
    #[test]
    fn a_rope_between_bolts_is_pulled_by_its_sag_and_the_bolts_at_its_ends_hold_it() {
        assert_relative_eq!(tension_between(40e3, 12.57e6), 96.4e3, max_relative = 1e-3);
        assert_relative_eq!(tension_under_more(96.4e3, 2.0, 12.57e6), 155.0e3, max_relative = 1e-3);
        // A soft rope, of which half of the load is most of the tension: 20.41 kN under 40 kN, 40.51 kN under twice that.
        assert_relative_eq!(tension_between(40e3, 1e3), 20.41e3, max_relative = 1e-3);
        assert_relative_eq!(tension_under_more(20.41e3, 2.0, 1e3), 40.51e3, max_relative = 1e-3);
        assert!(tension_under_more(f64::NAN, 2.0, 12.57e6).is_nan());
        assert_relative_eq!(end_bolt(40e3, 12.57e6), 96.4e3, max_relative = 1e-3);
        // A soft rope sags so far that a bolt along it holds more.
        assert_eq!(end_bolt(40e3, 1e3), 40e3);
        assert_relative_eq!(end_bolt_under_more(96.4e3, 2.0, 12.57e6), 155.0e3, max_relative = 1e-3);
        assert_relative_eq!(end_bolt_under_more(40e3, 2.0, 1e3), 80e3, max_relative = 1e-3);
        assert!(end_bolt_under_more(f64::NAN, 2.0, 1e3).is_nan());
        assert!(end_bolt(f64::NAN, 1e6).is_nan());
    }

    #[test]
    fn bolts_are_as_far_apart_as_they_can_be_no_further() {
        use crate::design::BedBolts;
        let spaces = |spacing| BedBolts { spacing, resistance: None }.spaces(3.0);
        assert_eq!([spaces(2.01), spaces(1.0), spaces(0.7), spaces(5.0)], [2, 3, 5, 1]);
    }

    #[test]
    fn the_lowest_rope_and_its_end_bolts_are_held_against_their_resistance() {
        let mut design = read_design("x", include_bytes!("../../tests/fixtures/even_net.yaml")).unwrap().design;
        let verdicts = |design: &Design, load: f64| {
            let demand = Demand { simulation: Some(load), ..Demand::default() };
            let guideline = guideline(design);
            let demands = Demands::by_equations(&guideline, &design.factors)
                .with(&bed::BOLT, &[demand])
                .with(&bed::SPACE, &[demand]);
            check(design, &demands).iter().map(|outcome| outcome.verdict).collect::<Vec<_>>()
        };
        assert_eq!(verdicts(&design, 40e3), [CheckVerdict::Pass; 2]);
        // 144 kN in a rope that holds 372/1.5 = 248 kN with 40 kN on a space; 362 kN with 158 kN.
        assert_eq!(verdicts(&design, 158e3)[1], CheckVerdict::Fail);
        if let BarrierDesign::FlexibleNet(net) = &mut design.barrier {
            net.bed_bolts.as_mut().expect("bolts").resistance = Some(100e3);
        }
        assert_eq!(verdicts(&design, 40e3), [CheckVerdict::Fail, CheckVerdict::Pass]);
    }

    /// The rope and the bolts at its ends are pulled by what hangs in the worst space, and a bolt along it may bear more than both.
    #[test]
    fn the_load_of_a_space_pulls_the_rope_and_that_of_a_bolt_the_bolts() {
        let design = read_design("x", include_bytes!("../../tests/fixtures/even_net.yaml")).unwrap().design;
        let demand = |bolt: f64, space: f64| {
            let of = |value: f64| [Demand { simulation: Some(value), ..Demand::default() }];
            let demands = Demands::default().with(&bed::BOLT, &of(bolt)).with(&bed::SPACE, &of(space));
            let outcomes = check(&design, &demands);
            [0, 1].map(|place| outcomes[place].demand.simulation.expect("a load"))
        };
        let [[bolt, rope], [same, other]] = [demand(20e3, 20e3), demand(20e3, 40e3)];
        assert!(other > 1.5 * rope && same > 1.5 * bolt, "{bolt} {rope} {same} {other}");
        assert_eq!(demand(900e3, 20e3), [900e3, rope]);
    }

    /// Rings every 0.3 m: bolts 1 m apart hold the rope, bolts 1.5 m apart do not. In a channel of 3 m both are whole spaces.
    #[test]
    fn bolts_further_apart_than_four_rings_leave_their_checks_open() {
        let mut design = read_design("x", include_bytes!("../../tests/fixtures/even_net.yaml")).unwrap().design;
        let outcomes = |design: &Design| {
            let bolt_force = Demand { simulation: Some(20e3), ..Demand::default() };
            check(design, &Demands::default().with(&bed::BOLT, &[bolt_force]).with(&bed::SPACE, &[bolt_force]))
        };
        let mut verdict = |bolts: f64, rings: f64| {
            let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            net.bed_bolts.as_mut().expect("bolts").spacing = bolts;
            net.main_ropes.ring_spacing = rings;
            outcomes(&design).iter().map(|outcome| outcome.verdict).collect::<Vec<_>>()
        };
        assert_eq!(verdict(1.0, 0.3), [CheckVerdict::Pass; 2]);
        assert_eq!(verdict(1.0, 0.25), [CheckVerdict::Pass; 2]);
        assert_eq!(verdict(1.5, 0.3), [CheckVerdict::Open; 2]);
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.bed_bolts = None;
        let held = Demands::default().with(&bed::FORCE, &[Demand { simulation: Some(1.0), ..Demand::default() }]);
        let outcome = &check(&design, &held)[0];
        assert_eq!((outcome.verdict, outcome.source), (CheckVerdict::Open, NO_LIMIT));
        assert!(outcome.title.ends_with("in all"));
    }
}
