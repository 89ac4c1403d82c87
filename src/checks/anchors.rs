//! Load of the anchors against their design resistance.

use crate::checks::outcome::{CheckName, CheckVerdict, Kind, OpenReason, Outcome, Resistance};
use crate::checks::ropes::OVER_POSTS;
use crate::demand::{Demand, Demands};
use crate::design::{AnchorOf, Bank, BarrierDesign, Design, FlexibleNet, LateralTo};
use crate::larger::larger_or_nan;
use crate::quantities::quantity::Unit;
use crate::quantities::{anchor_load, other_ropes};
use crate::sources::ANCHOR_FACTOR;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[
    Text {
        id: "anchor_N_load",
        meaning: "The load of the anchors of a main rope: the higher of its two, or each where their resistances differ.",
        formula: "T ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "anchor_plateau",
        meaning: "A rule of design, whatever the event: an anchor must hold the force of the yielding dissipators at its rope, with their overstrength.",
        formula: "overstrength · F_plateau ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
];

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else {
        return Vec::new();
    };
    let by_load = loads_of_ropes(net, demands).into_iter().map(|(index, bank, demand)| {
        let ropes = net.main_ropes.levels.get(index).map_or(1, |level| level.ropes);
        let (id, title) = match bank {
            None => (format!("anchor_{}_load", index + 1), anchor_load::PEAK.title_of(index)),
            Some(bank) => (
                format!("anchor_{}_{}_load", index + 1, bank.word()),
                format!("Load of the {} anchor of main rope {}", bank.word(), index + 1),
            ),
        };
        let name = CheckName::new(id, title, Unit::Newton, ANCHOR_FACTOR).each_of(ropes);
        let (demand, beside) = match net.dissipators {
            Some(_) => (demand, 0.0),
            None => with_lateral(demand, demands),
        };
        let capacity = resistance(design, net, index, bank.unwrap_or(Bank::Right));
        let outcome = Outcome::at_most(name, demand, capacity, design.limits.anchor_utilisation).of_rope(index);
        let outcome = open_where_oblique(net, index, bank, Outcome { kind: Kind::Anchors, beside, ..outcome });
        let outcome = if net.runs_over_posts(index) { outcome.only_by_simulation(OVER_POSTS) } else { outcome };
        match net.lateral_to {
            LateralTo::RopeEnds if net.dissipators.is_some() => outcome,
            LateralTo::RopeEnds => outcome.only_by_simulation(
                "without dissipators the lateral ropes pull at the anchors, and the equations do not know their load",
            ),
            LateralTo::Anchors => outcome.only_by_simulation(
                "the lateral ropes are tied to the anchors, and the equations do not know their load",
            ),
        }
    });
    by_load.chain(against_plateau(net, design, demands)).collect()
}

/// The demand of each main rope's higher loaded anchor, or where its two anchors differ that of each.
fn loads_of_ropes(net: &FlexibleNet, demands: &Demands) -> Vec<(usize, Option<Bank>, Demand)> {
    let unknown = Demand { guideline: Some(f64::NAN), ..Demand::default() };
    let of = |index: usize| {
        let [right, left] = [Bank::Right, Bank::Left].map(|bank| net.anchor_designs.of(index, bank).resistance);
        if right == left {
            let demand = demands.each(&anchor_load::PEAK).get(index).copied();
            return demand.map(|demand| (index, None, demand)).into_iter().collect::<Vec<_>>();
        }
        let each = net.anchors().into_iter().enumerate().filter_map(move |(number, anchor)| match anchor {
            AnchorOf::Main { rope, bank } if rope == index => Some((number, bank)),
            _ => None,
        });
        let demand = |number: usize| demands.each(&anchor_load::EACH).get(number).copied().unwrap_or(unknown);
        each.map(|(number, bank)| (index, Some(bank), demand(number))).collect()
    };
    (net.ropes_held_by_bed()..net.main_ropes.levels.len()).flat_map(of).collect()
}

/// Angle between an anchor and the line of its rope up to which its resistance, which is that along its axis, stands for its load (rad): 30
/// degrees, from practice, not verified. The sag of the rope adds to it, which is told with the load.
const MOST_OBLIQUE: f64 = std::f64::consts::FRAC_PI_6;

/// Leaves the check of an anchor open whose rope would bend it rather than pull it.
fn open_where_oblique(net: &FlexibleNet, rope: usize, bank: Option<Bank>, mut outcome: Outcome) -> Outcome {
    let banks = bank.map_or(vec![Bank::Right, Bank::Left], |bank| vec![bank]);
    let axes = banks.into_iter().filter_map(|bank| net.anchor_designs.of(rope, bank).axis);
    let angle =
        axes.map(|[plunge, bearing]| libm::acos(libm::cos(plunge) * libm::cos(bearing))).fold(0.0, larger_or_nan);
    // Asked as "along", so that what is not a number is not.
    let along = angle <= MOST_OBLIQUE;
    if !along && outcome.holds() {
        outcome.leave_open(OpenReason::NotGiven(format!(
            "its rope pulls at {:.0} degrees to the axis of the anchor, along which its resistance counts (give a plunge and a bearing nearer to the line of the rope, or leave them out for a head that turns into it)",
            angle.to_degrees()
        )));
    }
    outcome
}

/// What an anchor of a main rope withstands.
pub fn resistance(design: &Design, net: &FlexibleNet, rope: usize, bank: Bank) -> Resistance {
    let given = net.anchor_designs.of(rope, bank).resistance;
    Resistance { characteristic: given.value(), factor: given.factor(design.factors.anchor) }
}

/// Design resistance of the weakest anchor of a main rope (N).
pub fn weakest(design: &Design, net: &FlexibleNet) -> f64 {
    let Resistance { characteristic, factor } = weakest_of(design, net);
    characteristic / factor
}

fn weakest_of(design: &Design, net: &FlexibleNet) -> Resistance {
    let free = net.ropes_held_by_bed()..net.main_ropes.levels.len();
    let all = free.flat_map(|rope| [Bank::Right, Bank::Left].map(|bank| resistance(design, net, rope, bank)));
    let holds = |resistance: &Resistance| resistance.characteristic / resistance.factor;
    let least = all.min_by(|a, b| holds(a).total_cmp(&holds(b)));
    least.unwrap_or_else(|| resistance(design, net, 0, Bank::Right))
}

/// Without dissipators a lateral rope pulls at the anchor wherever it is tied: what the equations have for the main rope and what the simulation
/// has for the lateral one, in the worst case in the same direction.
fn with_lateral(demand: Demand, demands: &Demands) -> (Demand, f64) {
    let lateral = demands.one(&other_ropes::LATERAL).simulation;
    let both = demand.guideline.zip(lateral).map(|(main, lateral)| main + lateral);
    (Demand { guideline: both.or(demand.guideline), ..demand }, both.and(lateral).unwrap_or(0.0))
}

/// Factor on its plateau with which a dissipator may pull, assumed; a load factor that is as large covers it.
const USUAL_OVERSTRENGTH: f64 = 1.15;

/// A dissipator at work loads its anchor with its plateau, overstrength included, whatever the design flow shows.
fn against_plateau(net: &FlexibleNet, design: &Design, demands: &Demands) -> Option<Outcome> {
    let capacity = weakest_of(design, net);
    let plateau = net.dissipators.as_ref()?.plateau;
    let name = CheckName::new(
        "anchor_plateau",
        "Anchors against the force of a yielding dissipator",
        Unit::Newton,
        ANCHOR_FACTOR,
    );
    let own = design.factors.overstrength * plateau;
    let lateral = demands.one(&other_ropes::LATERAL).simulation;
    let (demand, tied) = match net.lateral_to {
        LateralTo::RopeEnds => (Demand { guideline: Some(own), ..Demand::default() }, false),
        // What the lateral ropes bring comes on top, in the worst case in the same direction.
        LateralTo::Anchors => {
            let simulation = lateral.map(|lateral| own + lateral);
            (Demand { guideline: Some(own), simulation, ..Demand::default() }, true)
        }
    };
    let outcome = Outcome::at_most(name, demand, capacity, design.limits.anchor_utilisation);
    let outcome = outcome.between_parts();
    let outcome = match tied {
        true => outcome
            .only_by_simulation("the lateral ropes are tied to the anchors, and the equations do not know their load"),
        false => outcome,
    };
    let free = net.ropes_held_by_bed()..net.main_ropes.levels.len();
    let outcome = free.fold(outcome, |outcome, rope| open_where_oblique(net, rope, None, outcome));
    Some(open_without_overstrength(design, outcome))
}

/// Leaves a check against the force of a yielding dissipator open where nobody says how large that may be.
pub fn open_without_overstrength(design: &Design, mut outcome: Outcome) -> Outcome {
    let known = design.factors.overstrength_given || design.factors.load >= USUAL_OVERSTRENGTH;
    if !known && matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn) {
        outcome.leave_open(OpenReason::NotGiven(
            "how far above its plateau or curve a dissipator may pull is not given (give factors.dissipator_overstrength from its tests; 1 if what is given is the upper bound)".into(),
        ));
    }
    outcome
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use crate::quantities::other_ropes;

    /// An axis 29° off the line of the rope stands for it, one of 31° does not, nor one that is not a number.
    #[test]
    fn an_anchor_that_its_rope_bends_is_open() {
        let told = |plunge: f64, bearing: f64| {
            let degrees = [plunge, bearing].map(f64::to_radians);
            let off = |design: &mut Design| {
                let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
                net.anchor_designs.all.axis = Some(degrees);
            };
            plateau(off, None).verdict
        };
        assert_eq!([told(29.0, 0.0), told(0.0, -29.0), told(20.0, 20.0)], [CheckVerdict::Pass; 3]);
        assert_eq!([told(31.0, 0.0), told(0.0, 150.0), told(f64::NAN, 0.0)], [CheckVerdict::Open; 3]);
    }

    /// The check against the plateau of 150 kN, with a simulated tension of the lateral ropes (N).
    fn plateau(change: impl Fn(&mut Design), lateral: Option<f64>) -> Outcome {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        change(&mut design);
        let lateral_tension = Demand { simulation: lateral, ..Demand::default() };
        let demands =
            Demands::by_equations(&guideline(&design), &design.factors).with(&other_ropes::LATERAL, &[lateral_tension]);
        check(&design, &demands).into_iter().find(|outcome| outcome.id == "anchor_plateau").expect("a check")
    }

    fn tied(design: &mut Design) {
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.lateral_to = LateralTo::Anchors;
    }

    #[test]
    fn lateral_ropes_that_are_tied_to_anchors_pull_beside_the_plateau() {
        let overstrength = |design: &mut Design| design.factors.overstrength = 1.2;
        let apart = plateau(overstrength, Some(50e3)).demand;
        assert_eq!((apart.guideline, apart.simulation), (Some(180e3), None));
        let both = |design: &mut Design| {
            overstrength(design);
            tied(design);
        };
        let together = plateau(both, Some(50e3)).demand;
        assert_eq!((together.guideline, together.simulation), (Some(180e3), Some(230e3)));
        assert_eq!(plateau(both, None).verdict, CheckVerdict::Open);
    }

    #[test]
    fn an_overstrength_that_is_not_given_is_open_unless_a_factor_on_loads_stands_for_it() {
        let verdict = |given: bool, load: f64| {
            plateau(|design| (design.factors.overstrength_given, design.factors.load) = (given, load), None).verdict
        };
        assert_eq!(verdict(true, 1.0), CheckVerdict::Pass);
        assert_eq!(verdict(false, 1.0), CheckVerdict::Open);
        assert_eq!(verdict(false, 1.35), CheckVerdict::Pass);
    }

    /// Without dissipators what the equations have for the main rope and the simulated pull of the lateral rope meet at the anchor.
    #[test]
    fn without_dissipators_a_lateral_rope_pulls_at_the_anchor_as_well() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.dissipators = None;
        let lateral_tension = Demand { simulation: Some(30e3), ..Demand::default() };
        let equations = Demands::by_equations(&guideline(&design), &design.factors);
        let alone = equations.each(&anchor_load::PEAK)[1].guideline.expect("a load");
        let outcome = check(&design, &equations.clone().with(&other_ropes::LATERAL, &[lateral_tension])).remove(0);
        assert_eq!((outcome.demand.guideline, outcome.beside), (Some(alone + 30e3), 30e3));
        // The equations alone do not know it.
        assert_eq!(check(&design, &equations)[0].beside, 0.0);
        // Asked again with more of the equations, the lateral rope is still there.
        let capacity = outcome.capacity.expect("a capacity");
        let then = |load: f64| {
            let demand = Demand { guideline: Some(load), ..Demand::default() };
            check(&design, &equations.clone().with(&anchor_load::PEAK, &[demand; 3])).remove(0)
        };
        assert!(!outcome.would_fail(&then(capacity - 31e3)) && outcome.would_fail(&then(capacity - 29e3)));
    }
}
