//! Formulas used outside the range they are known for: a check that such a formula governs stays open, unless the design asks for a
//! warning alone (`limits.outside_range`).
//!
//! A check fails all the same: outside its range a formula may say too little, and what fails by it is not saved by that.

use crate::checks::check_all;
use crate::checks::detailing::{Bearing, rules};
use crate::checks::outcome::{CheckVerdict, Kind, Opening, Outcome};
use crate::demand::Demands;
use crate::demand::from_loads::{Guideline, guideline_for};
use crate::design::{BarrierDesign, Design, OutsideRange};
use crate::loads::input::GuidelineInput;

/// Sag over span, and strain, up to which a main rope's parabola with small strains is known to hold.
pub const LARGEST_SAG: f64 = 0.3;
pub const LARGEST_STRAIN: f64 = 0.1;

/// Simulated over the guideline's force of a first surge up to which its K and λ are taken to hold for the later ones too: the scatter
/// of measured pressures (Bugnion et al. 2012: 20 % and more).
pub const LIKE_FIRST_SURGES: f64 = 1.25;

/// Leaves open what would hold by a formula that is used outside its range. `first_surge` is the largest force that a simulation of
/// the first surge shows, without partial factors (N), if there is one.
pub fn leave_open_outside_range(
    design: &Design,
    guideline: &Guideline,
    first_surge: Option<f64>,
    outcomes: &mut [Outcome],
) {
    if design.limits.outside_range == OutsideRange::Warn {
        return;
    }
    leave_open_later_surges(design, guideline, first_surge, outcomes);
    leave_open_what_was_not_simulated(design, outcomes);
    leave_open_holds_not_given(design, outcomes);
    leave_open_without_drag(design, outcomes);
    let broken =
        rules(design, guideline).into_iter().filter(|rule| rule.bearing == Bearing::Pressures && !rule.holds());
    let of_pressures: Option<String> =
        broken.map(|rule| rule.title.to_string()).reduce(|all, more| format!("{all}, {more}"));
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.resistance.is_some()) {
        let holds = matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn);
        if !holds || outcome.utilisation.is_none() {
            continue;
        }
        // A simulation is of the first surge: of the later ones and the full barrier the equations alone tell.
        let alone = outcome.governed_by_equations() || (design.loads.to_the_top && outcome.demand.guideline.is_some());
        if !alone {
            continue;
        }
        let of_rope = outcome.rope.and_then(|rope| rope_outside(design, guideline, rope));
        let pressures = of_pressures.as_ref().filter(|_| outcome.rests_on_pressures);
        let why = of_rope.or_else(|| {
            pressures.map(|titles| format!("its pressures are used outside the range they are known for ({titles}; see the rules of detailing and range)"))
        });
        if let Some(why) = why {
            outcome.leave_open(Opening::OutOfRange(format!(
                "the equations govern it and {why} (limits.outside_range: warn would let it stand)"
            )));
        }
    }
}

/// Surges over a deposit are in the equations alone: where the simulated first surge hits harder than theirs, so would the later ones.
fn leave_open_later_surges(design: &Design, guideline: &Guideline, first_surge: Option<f64>, outcomes: &mut [Outcome]) {
    leave_open_full_barrier(design, guideline, first_surge, outcomes);
    let Some(ratio) = first_surge.map(|force| force / guideline.first_surge()) else { return };
    // Asked as "alike", so that what is not a number is not.
    let alike = ratio <= LIKE_FIRST_SURGES;
    if alike || !design.loads.to_the_top {
        return;
    }
    let of_surges = |outcome: &&mut Outcome| {
        let holds = matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn);
        holds && outcome.utilisation.is_some() && outcome.rests_on_pressures && outcome.demand.guideline.is_some()
    };
    for outcome in outcomes.iter_mut().filter(of_surges) {
        outcome.leave_open(Opening::OutOfRange(format!(
            "the simulated first surge pushes {ratio:.2} times as hard as the guideline's, so that its later surges over a deposit are too low (raise factors.dynamic_lambda until they agree within {:.0} %, or say loads.filling: one_event)",
            100.0 * (LIKE_FIRST_SURGES - 1.0)
        )));
    }
}

/// What the simulation of a first surge alone judges, with the load of the full barrier: where surges come until it is full, the equations
/// tell how much more presses on it then, and what would not hold that much more stays open.
fn leave_open_full_barrier(design: &Design, guideline: &Guideline, first_surge: Option<f64>, outcomes: &mut [Outcome]) {
    let Some(more) = first_surge.map(|force| guideline.largest_force / force) else { return };
    if more <= 1.0 || !design.loads.to_the_top {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.resistance.is_some()) {
        let holds = matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn);
        let by_simulation = outcome.demand.guideline.is_none() || outcome.kind == Kind::Bolts;
        let used = outcome.demand.simulation.zip(outcome.capacity).map(|(demand, capacity)| more * demand / capacity);
        // Asked as "within", so that what is not a number is not.
        let within = used.is_none_or(|used| used <= 1.0);
        if holds && by_simulation && !within {
            outcome.leave_open(Opening::OutOfRange(format!(
                "the simulation is of the first surge, and by the equations {more:.1} times as much presses on the full barrier, which it would not hold in proportion (simulate a larger flow, or say loads.filling: one_event)"
            )));
        }
    }
}

/// Leaves open what the equations would fail with the velocity that the simulated flow arrives with (m/s).
pub fn leave_open_faster_arrivals(design: &Design, guideline: &Guideline, velocity: f64, outcomes: &mut [Outcome]) {
    let given = guideline.input.velocity;
    if velocity <= given || design.limits.outside_range == OutsideRange::Warn {
        return;
    }
    let faster = guideline_for(design, GuidelineInput { velocity, ..guideline.input });
    let then = check_all(design, &Demands::by_equations(&faster, &design.factors));
    for (outcome, then) in outcomes.iter_mut().zip(&then) {
        let holds = matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn);
        if holds && outcome.id == then.id && then.fails_by_equations() {
            outcome.leave_open(Opening::OutOfRange(format!(
                "the simulated flow arrives with {velocity:.2} m/s where the equations were given {given:.2} m/s, and with that they would fail it"
            )));
        }
    }
}

/// The drag of a flow over the barrier is known where its friction and length are given; left out it is not nothing.
fn leave_open_without_drag(design: &Design, outcomes: &mut [Outcome]) {
    if design.loads.overflow_depth.is_none() || design.loads.overflow_drag.is_some() {
        return;
    }
    for outcome in outcomes.iter_mut() {
        let holds = matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn);
        if holds && outcome.rests_on_pressures && outcome.demand.guideline.is_some() {
            outcome.leave_open(Opening::NotGiven(
                "the drag of the flow over the full barrier is not in it (give loads.overflow_friction and loads.overflow_length)".into(),
            ));
        }
    }
}

/// Strips of net along the side walls change what is held and what is loaded, by a force that wall and deposit hold them with: what the
/// simulation shows with a default that nobody vouches for is open.
fn leave_open_holds_not_given(design: &Design, outcomes: &mut [Outcome]) {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return };
    if net.side_extension.is_none_or(|extension| extension.holding_force_given) {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.demand.simulation.is_some()) {
        if matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn) {
            outcome.leave_open(Opening::NotGiven(
                "the simulation holds the strips along the side walls with a force that the design does not give (barrier.flexible_net.side_extension.holding_force)".into(),
            ));
        }
    }
}

/// What the simulation alone judges, or judges more severely than the equations, where the design asks for loads that it does not hold:
/// later surges of a larger event, a boulder, snow, a flow over the full barrier.
fn leave_open_what_was_not_simulated(design: &Design, outcomes: &mut [Outcome]) {
    let (flow, loads) = (&design.flow, &design.loads);
    let missing = [
        (flow.event_volume > 1.001 * flow.volume(), "the later surges of the event"),
        (loads.point_load.is_some(), "the point load"),
        (loads.snow_pressure.is_some(), "the snow"),
        (loads.overflow_depth.is_some(), "the flow over the full barrier"),
        (loads.drained.is_some(), "the drained deposit"),
        (loads.self_weight.is_some(), "the weight of the net as given"),
    ];
    let missing: Vec<&str> = missing.into_iter().filter(|(asked, _)| *asked).map(|(_, what)| what).collect();
    if missing.is_empty() {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.demand.simulation.is_some()) {
        let holds = matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn);
        // What has no utilisation is a dissipator at its plateau: its stroke tells. What is held has its own rule.
        if holds && outcome.utilisation.is_some() && !outcome.governed_by_equations() && outcome.kind != Kind::MassHeld
        {
            outcome.leave_open(Opening::NotGiven(format!(
                "the simulation governs it and is of one surge on the empty barrier, without {}",
                missing.join(", ")
            )));
        }
    }
}

/// Why the parabola of a main rope is no longer known to hold, if so.
pub fn rope_outside(design: &Design, guideline: &Guideline, rope: usize) -> Option<String> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let state = &guideline.ropes.get(rope)?.state;
    let line = net.main_ropes.rope;
    let axial = line.modulus * std::f64::consts::FRAC_PI_4 * line.diameter.powi(2);
    let (sag, strain) = (state.sag / design.channel.width, state.tension / axial);
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
    use crate::demand::from_histories::Observed;
    use crate::demand::from_loads::guideline;
    use crate::demand::{Demands, Seen};
    use crate::design::SideExtension;
    use crate::design::read::read_design;

    fn design() -> Design {
        read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design
    }

    /// Verdict of a check by the equations, with what the simulation of the first surge shows.
    fn verdict(design: &Design, id: &str, first_surge: f64) -> CheckVerdict {
        let guideline = guideline(design);
        let mut outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
        leave_open_outside_range(design, &guideline, Some(first_surge), &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    #[test]
    fn a_check_that_pressures_outside_their_range_govern_stays_open_unless_the_design_says_otherwise() {
        let mut design = design();
        let like = |design: &Design| guideline(design).first_surge();
        assert_eq!(verdict(&design, "rope_3_tension", like(&design)), CheckVerdict::Pass);
        // Froude number 1.7, where λ = 2 is less than a model that follows it.
        let slow = |design: &mut Design| {
            design.factors.dynamic_pressure = 2.0;
            if let crate::design::Arrival::Surge(surge) = &mut design.flow.arrival {
                surge.velocity = 4.0;
            }
        };
        slow(&mut design);
        assert_eq!(verdict(&design, "rope_3_tension", like(&design)), CheckVerdict::Open);
        assert_eq!(verdict(&design, "anchor_plateau", like(&design)), CheckVerdict::Pass);
        design.limits.outside_range = OutsideRange::Warn;
        assert_eq!(verdict(&design, "rope_3_tension", like(&design)), CheckVerdict::Pass);
    }

    #[test]
    fn later_surges_are_open_where_the_first_hits_harder_than_the_guideline_has_it() {
        let mut design = design();
        let first = guideline(&design).first_surge();
        assert_eq!(verdict(&design, "rope_2_tension", 1.2 * first), CheckVerdict::Pass);
        assert_eq!(verdict(&design, "rope_2_tension", 1.3 * first), CheckVerdict::Open);
        assert_eq!(verdict(&design, "rope_2_tension", f64::NAN), CheckVerdict::Open);
        design.loads.to_the_top = false;
        assert_eq!(verdict(&design, "rope_2_tension", 1.3 * first), CheckVerdict::Pass);
    }

    #[test]
    fn a_rope_that_sags_beyond_its_parabola_stays_open() {
        let mut design = design();
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.dissipators.as_mut().expect("dissipators").plateau = 55e3;
        let guideline = guideline(&design);
        assert!(guideline.ropes[1].state.sag > LARGEST_SAG * design.channel.width);
        assert!(rope_outside(&design, &guideline, 1).is_some());
        assert_eq!(verdict(&design, "anchor_2_load", guideline.first_surge()), CheckVerdict::Open);
    }

    /// Verdict of the net's tension, which the simulation alone judges, where the first surge pulls it with a tension (N).
    fn net_verdict(design: &Design, tension: f64, first_surge: f64) -> CheckVerdict {
        let guideline = guideline(design);
        let seen = Observed { net_tension_peak: tension, ..Observed::of_ropes(3) };
        let seen = Seen { characteristic: vec![&seen], factored: Vec::new() };
        let mut outcomes = check_all(design, &Demands::meet(&guideline, &seen, &design.factors));
        leave_open_outside_range(design, &guideline, Some(first_surge), &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == "net_tension").expect("a check").verdict
    }

    #[test]
    fn what_would_not_hold_the_full_barrier_in_proportion_is_open() {
        let mut design = design();
        // The net holds 100 kN over 1.5.
        let first = guideline(&design).largest_force / 2.0;
        assert_eq!(net_verdict(&design, 30e3, first), CheckVerdict::Pass);
        assert_eq!(net_verdict(&design, 36e3, first), CheckVerdict::Open);
        assert_eq!(net_verdict(&design, 70e3, first), CheckVerdict::Fail);
        design.loads.to_the_top = false;
        assert_eq!(net_verdict(&design, 36e3, first), CheckVerdict::Pass);
    }

    #[test]
    fn what_the_simulation_governs_is_open_where_it_lacks_a_load_that_the_design_asks_for() {
        let first = |design: &Design| guideline(design).largest_force;
        type Ask = fn(&mut Design);
        let asked: [Ask; 5] = [
            |design| design.flow.event_volume = 2.0 * design.flow.volume(),
            |design| design.loads.point_load = Some((1e3, 1.0)),
            |design| design.loads.snow_pressure = Some(1e3),
            |design| design.loads.drained = Some((0.5, 1800.0)),
            |design| design.loads.self_weight = Some(50.0),
        ];
        for ask in asked {
            let mut design = design();
            assert_eq!(net_verdict(&design, 30e3, first(&design)), CheckVerdict::Pass);
            ask(&mut design);
            assert_eq!(net_verdict(&design, 30e3, first(&design)), CheckVerdict::Open);
        }
    }

    #[test]
    fn a_side_extension_held_by_a_default_leaves_the_simulation_open() {
        let mut design = design();
        let first = guideline(&design).largest_force;
        let mut extend = |holding_force_given| {
            let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            net.side_extension = Some(SideExtension { length: 1.0, holding_force: 1e3, holding_force_given });
            net_verdict(&design, 30e3, first)
        };
        assert_eq!(extend(true), CheckVerdict::Pass);
        assert_eq!(extend(false), CheckVerdict::Open);
    }

    #[test]
    fn a_flow_over_the_barrier_without_its_drag_leaves_pressures_open() {
        let mut design = design();
        let first = |design: &Design| guideline(design).first_surge();
        design.loads.overflow_depth = Some(0.05);
        assert_eq!(verdict(&design, "rope_3_tension", first(&design)), CheckVerdict::Open);
        design.loads.overflow_drag = Some((0.3, 0.5));
        assert_eq!(verdict(&design, "rope_3_tension", first(&design)), CheckVerdict::Pass);
    }

    #[test]
    fn what_the_equations_would_fail_at_the_velocity_that_arrives_is_open() {
        let design = design();
        let guideline = guideline(&design);
        let at = |velocity: f64| {
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            leave_open_faster_arrivals(&design, &guideline, velocity, &mut outcomes);
            outcomes.iter().filter(|outcome| outcome.verdict == CheckVerdict::Open).count()
        };
        let given = guideline.input.velocity;
        let open = at(given);
        assert_eq!(at(0.9 * given), open);
        assert_eq!(at(1.1 * given), open);
        assert!(at(2.0 * given) > open);
    }
}
