//! Loads and courses of the event that neither the equations nor the simulation of the first surge cover: checks that would pass without
//! them stay open, whatever `limits.outside_range` says, because that lets formulas stand, not gaps.

use crate::checks::check_all;
use crate::checks::outcome::{Kind, Opening, Outcome};
use crate::checks::range::leave_open_outside_range;
use crate::demand::Demands;
use crate::demand::from_loads::{Guideline, guideline_for};
use crate::design::{BarrierDesign, Design};
use crate::loads::input::GuidelineInput;

/// Simulated over the guideline's force of a first surge up to which its K and λ are taken to hold for the later ones too: the scatter
/// of measured pressures (Bugnion et al. 2012: 20 % and more).
pub const LIKE_FIRST_SURGES: f64 = 1.25;

/// What a simulation shows of the first surge.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstSurge {
    /// Its largest force, without partial factors (N).
    pub force: Option<f64>,
    /// The velocity with which it arrives (m/s).
    pub velocity: Option<f64>,
}

/// Leaves open what would hold only because something is not covered.
pub fn leave_open_not_covered(design: &Design, guideline: &Guideline, seen: FirstSurge, outcomes: &mut [Outcome]) {
    leave_open_full_barrier(design, guideline, seen.force, outcomes);
    leave_open_later_surges(design, guideline, seen.force, outcomes);
    leave_open_what_was_not_simulated(design, outcomes);
    leave_open_holds_not_given(design, outcomes);
    leave_open_without_drag(design, outcomes);
    if let Some(velocity) = seen.velocity {
        leave_open_faster_arrivals(design, guideline, velocity, outcomes);
    }
}

/// Surges over a deposit are in the equations alone: where the simulated first surge hits harder than theirs, so would the later ones.
fn leave_open_later_surges(design: &Design, guideline: &Guideline, first_surge: Option<f64>, outcomes: &mut [Outcome]) {
    let Some(ratio) = first_surge.map(|force| force / guideline.first_surge()) else { return };
    // Written so that a NaN counts as not alike.
    let alike = ratio <= LIKE_FIRST_SURGES;
    if alike || !design.loads.to_the_top {
        return;
    }
    let of_surges = |outcome: &&mut Outcome| {
        outcome.holds()
            && outcome.utilisation.is_some()
            && outcome.rests_on_pressures
            && outcome.demand.guideline.is_some()
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
        let by_simulation = outcome.demand.guideline.is_none() || outcome.kind == Kind::Bolts;
        let used = outcome.demand.simulation.zip(outcome.capacity).map(|(demand, capacity)| more * demand / capacity);
        // Written so that a NaN counts as not within.
        let within = used.is_none_or(|used| used <= 1.0);
        if outcome.holds() && by_simulation && !within {
            outcome.leave_open(Opening::OutOfRange(format!(
                "the simulation is of the first surge, and by the equations {more:.1} times as much presses on the full barrier, which it would not hold in proportion (simulate a larger flow, or say loads.filling: one_event)"
            )));
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
        // What has no utilisation is a dissipator at its plateau: its stroke tells. What is held has its own rule.
        if outcome.holds()
            && outcome.utilisation.is_some()
            && !outcome.governed_by_equations()
            && outcome.kind != Kind::MassHeld
        {
            outcome.leave_open(Opening::NotGiven(format!(
                "the simulation governs it and covers one surge on the empty barrier; it does not include {}",
                missing.join(", ")
            )));
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
        if outcome.holds() {
            outcome.leave_open(Opening::NotGiven(
                "the simulation holds the strips along the side walls with a force that the design does not give (barrier.flexible_net.side_extension.holding_force)".into(),
            ));
        }
    }
}

/// The drag of a flow over the barrier is known where its friction and length are given; a drag that is not given is not zero.
fn leave_open_without_drag(design: &Design, outcomes: &mut [Outcome]) {
    if design.loads.overflow_depth.is_none() || design.loads.overflow_drag.is_some() {
        return;
    }
    for outcome in outcomes.iter_mut() {
        if outcome.holds() && outcome.rests_on_pressures && outcome.demand.guideline.is_some() {
            outcome.leave_open(Opening::NotGiven(
                "the drag of the flow over the full barrier is not in it (give loads.overflow_friction and loads.overflow_length)".into(),
            ));
        }
    }
}

/// Leaves open what the equations would fail, or would not be known for, with the velocity that the simulated flow arrives with (m/s).
fn leave_open_faster_arrivals(design: &Design, guideline: &Guideline, velocity: f64, outcomes: &mut [Outcome]) {
    let given = guideline.input.velocity;
    if velocity <= given {
        return;
    }
    let faster = guideline_for(design, GuidelineInput { velocity, ..guideline.input });
    let mut then = check_all(design, &Demands::by_equations(&faster, &design.factors));
    let before: Vec<bool> = then.iter().map(Outcome::holds).collect();
    leave_open_outside_range(design, &faster, &mut then);
    for ((outcome, then), held) in outcomes.iter_mut().zip(&then).zip(before) {
        if !outcome.holds() || outcome.id != then.id {
            continue;
        }
        let equations_count = outcome.governed_by_equations() || design.loads.to_the_top;
        let why = if then.fails_by_equations() {
            "at that velocity they would fail this check"
        } else if held && !then.holds() && equations_count {
            "at that velocity they would be used outside the range they are known for"
        } else {
            continue;
        };
        outcome.leave_open(Opening::OutOfRange(format!(
            "the simulated flow arrives with {velocity:.2} m/s where the equations were given {given:.2} m/s: {why}"
        )));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Seen;
    use crate::demand::from_histories::Observed;
    use crate::demand::from_loads::guideline;
    use crate::design::read::read_design;
    use crate::design::{OutsideRange, SideExtension};

    fn design() -> Design {
        read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design
    }

    /// Verdict of a check by the equations, with what the simulation of the first surge shows.
    fn verdict(design: &Design, id: &str, first_surge: f64) -> CheckVerdict {
        let guideline = guideline(design);
        let mut outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
        let seen = FirstSurge { force: Some(first_surge), velocity: None };
        leave_open_not_covered(design, &guideline, seen, &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    /// Verdict of the net's tension, which the simulation alone judges, where the first surge pulls it with a tension (N).
    fn net_verdict(design: &Design, tension: f64, first_surge: f64) -> CheckVerdict {
        let guideline = guideline(design);
        let observed = Observed { net_tension_peak: tension, ..Observed::of_ropes(3) };
        let packings = Seen { characteristic: vec![&observed], factored: Vec::new() };
        let mut outcomes = check_all(design, &Demands::meet(&guideline, &packings, &design.factors));
        let seen = FirstSurge { force: Some(first_surge), velocity: None };
        leave_open_not_covered(design, &guideline, seen, &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == "net_tension").expect("a check").verdict
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
        let asked: [Ask; 6] = [
            |design| design.loads.overflow_depth = Some(0.05),
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
            // A gap is no formula outside its range.
            design.limits.outside_range = OutsideRange::Warn;
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
