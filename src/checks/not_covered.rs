//! Loads and courses of the event that neither the equations nor the simulation of the first surge cover: checks that would pass without
//! them stay open, whatever `limits.outside_range` says, because that lets formulas stand, not gaps.

use crate::checks::check_all;
use crate::checks::outcome::{Kind, Opening, Outcome};
use crate::checks::range::leave_open_outside_range;
use crate::demand::Demands;
use crate::demand::from_loads::{Guideline, guideline_for};
use crate::design::{BarrierDesign, Design};
use crate::loads::cases::overtopped::DEFAULT_FRICTION;
use crate::loads::input::GuidelineInput;

/// Simulated over the guideline's force of a first surge up to which its K and λ are taken to hold for the later ones too: the scatter
/// of measured pressures (Bugnion et al. 2012: 20 % and more).
pub const LIKE_FIRST_SURGES: f64 = 1.25;

/// What a simulation shows of the first surge, without partial factors.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstSurge {
    /// Its largest force along the bed (N).
    pub push: f64,
    /// The velocity with which it arrives (m/s).
    pub velocity: f64,
    /// K that the deposit shows at rest, where there is one.
    pub earth_pressure: Option<f64>,
    /// By how much a finer model, or other packings, may show larger forces and strokes (over these, less one) and smaller shares.
    pub force_band: f64,
    pub stroke_band: f64,
    pub share_band: f64,
}

/// Leaves open what would hold only because something is not covered; `seen` is nothing where nothing was simulated.
pub fn leave_open_not_covered(
    design: &Design,
    guideline: &Guideline,
    seen: Option<FirstSurge>,
    outcomes: &mut [Outcome],
) {
    if let Some(seen) = seen {
        leave_open_full_barrier(design, guideline, seen, outcomes);
        leave_open_later_surges(design, guideline, seen.push, outcomes);
        leave_open_harder_flows(design, guideline, seen, outcomes);
    }
    leave_open_without_load_factor(design, outcomes);
    leave_open_what_was_not_simulated(design, outcomes);
    leave_open_holds_not_given(design, outcomes);
    leave_open_without_drag(design, guideline, outcomes);
}

/// Surges over a deposit are in the equations alone: where the simulated first surge pushes harder than theirs, so would the later ones.
fn leave_open_later_surges(design: &Design, guideline: &Guideline, push: f64, outcomes: &mut [Outcome]) {
    let ratio = push / guideline.first_surge();
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
        outcome.leave_open(Opening::Contradicted(format!(
            "the simulated first surge pushes {ratio:.2} times as hard as the guideline's, so that its later surges over a deposit are too low (raise factors.dynamic_lambda until they agree within {:.0} %, or say loads.filling: one_event)",
            100.0 * (LIKE_FIRST_SURGES - 1.0)
        )));
    }
}

/// What the simulation of a first surge governs, under the load that the equations have for the full barrier, or for the one event: they
/// tell how much more presses on it than the simulation shows. What would not hold that much more stays open, and so does what would hold it by less than
/// the simulation may be off.
fn leave_open_full_barrier(design: &Design, guideline: &Guideline, seen: FirstSurge, outcomes: &mut [Outcome]) {
    let more = guideline.largest_force / seen.push;
    if more <= 1.0 {
        return;
    }
    let (when, instead) = match design.loads.to_the_top {
        true => ("the full barrier", "simulate a larger flow, or say loads.filling: one_event"),
        false => ("the barrier", "give it more resistance, or simulate a flow that pushes as hard"),
    };
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        let Some([used, may_be]) = used_when_full(outcome, more, seen) else { continue };
        let full = if seen.push > 0.0 {
            format!(
                "the simulation is of the first surge, and by the equations {more:.1} times as much presses on {when}"
            )
        } else {
            "the simulated first surge does not push the barrier, and by the equations the full barrier is pushed"
                .into()
        };
        // Written so that a NaN counts as not within.
        let within = |used: f64| used <= 1.0;
        if !within(used) {
            outcome.leave_open(Opening::Contradicted(format!(
                "{full}, which it would not hold in proportion ({instead})"
            )));
        } else if !within(may_be) {
            outcome.leave_open(Opening::TooClose(format!(
                "{full}: in proportion it would hold, but by less than the simulation may be off (run with --seeds 5 or simulation.fidelity: auto)"
            )));
        }
    }
}

/// Utilisation by the simulation with `more` times the load, as simulated and with the largest error that the simulation may have;
/// nothing where that says nothing.
fn used_when_full(outcome: &Outcome, more: f64, seen: FirstSurge) -> Option<[f64; 2]> {
    let (demand, capacity) = (outcome.demand.simulation?, outcome.capacity?);
    match outcome.kind {
        // The share held has its own rule: what a full barrier does not hold is not asked for.
        Kind::MassHeld | Kind::DissipatorTension => return None,
        // A net that sinks in by a share under the first surge sinks in by that much more when it is full.
        Kind::HeightLeft => {
            let lost = |band: f64| more * (1.0 - demand + band) / (1.0 - capacity).max(1e-9);
            return Some([lost(0.0), lost(seen.share_band)]);
        }
        Kind::Any | Kind::Bolts | Kind::BetweenBolts => {}
    }
    // The equations spread the load evenly over the bolts, so theirs is no measure of the worst one.
    let of_bolts = matches!(outcome.kind, Kind::Bolts | Kind::BetweenBolts);
    let known = outcome.governed_by_equations() && !of_bolts;
    let power = if outcome.kind == Kind::BetweenBolts { 2.0 / 3.0 } else { 1.0 };
    let cap = outcome.demand.cap.map_or(f64::INFINITY, |cap| cap.max(demand));
    let used = |band: f64| {
        let full = demand * libm::pow(more * (1.0 + band), power);
        // Asked so that what is not a number stays so.
        (if full > cap { cap } else { full }) / capacity
    };
    // Where the equations, which know the full barrier, tell more, the simulation need only not contradict them.
    let band = match outcome.unit {
        _ if known => 0.0,
        "m" => seen.stroke_band,
        _ => seen.force_band,
    };
    Some([used(0.0), used(band)])
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

/// A partial factor on loads that is not given is not 1.
fn leave_open_without_load_factor(design: &Design, outcomes: &mut [Outcome]) {
    if design.factors.load_given {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.resistance.is_some() && outcome.utilisation.is_some()) {
        if outcome.holds() {
            outcome.leave_open(Opening::NotGiven(
                "no partial factor on loads is given (give factors.set, or factors.load: 1 if the design flow is a design value itself)".into(),
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
        if outcome.holds() {
            outcome.leave_open(Opening::NotGiven(
                "the simulation holds the strips along the side walls with a force that the design does not give (barrier.flexible_net.side_extension.holding_force)".into(),
            ));
        }
    }
}

/// The drag of a flow over the barrier is known where its friction and length are given; a drag that is not given is not zero.
fn leave_open_without_drag(design: &Design, guideline: &Guideline, outcomes: &mut [Outcome]) {
    if design.loads.overflow_drag.is_some() {
        return;
    }
    if design.loads.overflow_depth.is_none() {
        leave_open_what_a_usual_drag_fails(design, guideline, outcomes);
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

/// A barrier that fills is overtopped whether the design says so or not: with a usual drag no check may fail.
fn leave_open_what_a_usual_drag_fails(design: &Design, guideline: &Guideline, outcomes: &mut [Outcome]) {
    if !guideline.input.fills() {
        return;
    }
    let mut dragged = design.clone();
    dragged.loads.overflow_drag = Some((DEFAULT_FRICTION, guideline.input.depth));
    let with_drag = guideline_for(&dragged, guideline.input);
    let then = check_all(design, &Demands::by_equations(&with_drag, &design.factors));
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        if then.iter().any(|then| then.id == outcome.id && then.fails_by_equations()) {
            outcome.leave_open(Opening::NotGiven(
                "with a usual drag of the flow over the full barrier the equations would fail it (give loads.overflow_friction and loads.overflow_length)".into(),
            ));
        }
    }
}

/// Leaves open what the equations would fail, or would not be known for, with the velocity that the simulated flow arrives with and the
/// K that its deposit shows at rest, where these are larger than what the equations were given.
fn leave_open_harder_flows(design: &Design, guideline: &Guideline, seen: FirstSurge, outcomes: &mut [Outcome]) {
    let given = guideline.input;
    let harder = GuidelineInput {
        velocity: seen.velocity.max(given.velocity),
        earth_pressure: seen.earth_pressure.unwrap_or(0.0).max(given.earth_pressure),
        ..given
    };
    if harder == given {
        return;
    }
    let then = guideline_for(design, harder);
    let mut checks = check_all(design, &Demands::by_equations(&then, &design.factors));
    let before: Vec<bool> = checks.iter().map(Outcome::holds).collect();
    leave_open_outside_range(design, &then, &mut checks);
    let found = [
        (harder.velocity > given.velocity)
            .then(|| format!("arrives with {:.2} m/s (given: {:.2} m/s)", harder.velocity, given.velocity)),
        (harder.earth_pressure > given.earth_pressure).then(|| {
            format!("presses at rest with K = {:.2} (given: {:.2})", harder.earth_pressure, given.earth_pressure)
        }),
    ];
    let found = found.into_iter().flatten().collect::<Vec<_>>().join(" and ");
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        let Some(place) = checks.iter().position(|then| then.id == outcome.id) else { continue };
        let (then, held) = (&checks[place], before[place]);
        let equations_count = outcome.governed_by_equations() || design.loads.to_the_top;
        let why = if then.fails_by_equations() {
            "the equations would fail this check"
        } else if held && !then.holds() && equations_count {
            "the equations would be used outside the range they are known for"
        } else {
            continue;
        };
        outcome.leave_open(Opening::Contradicted(format!("the simulated flow {found}; with what it shows, {why}")));
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

    /// A first surge that pushes with a force (N), seen without error.
    fn pushing(push: f64) -> FirstSurge {
        FirstSurge { push, ..FirstSurge::default() }
    }

    /// Verdict of a check by the equations, with what the simulation of the first surge shows.
    fn verdict(design: &Design, id: &str, first_surge: f64) -> CheckVerdict {
        let guideline = guideline(design);
        let mut outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
        leave_open_not_covered(design, &guideline, Some(pushing(first_surge)), &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    /// Verdict of a check where the first surge shows certain numbers.
    fn simulated_verdict(design: &Design, id: &str, observed: &Observed, seen: FirstSurge) -> CheckVerdict {
        let guideline = guideline(design);
        let packings = Seen { characteristic: vec![observed], factored: Vec::new() };
        let mut outcomes = check_all(design, &Demands::meet(&guideline, &packings, &design.factors));
        leave_open_not_covered(design, &guideline, Some(seen), &mut outcomes);
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    /// Verdict of the net's tension, which the simulation alone judges, where the first surge pulls it with a tension (N).
    fn net_verdict(design: &Design, tension: f64, first_surge: f64) -> CheckVerdict {
        let observed = Observed { net_tension_peak: tension, ..Observed::of_ropes(3) };
        simulated_verdict(design, "net_tension", &observed, pushing(first_surge))
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

    /// Tension that the net of the design may bear (N).
    fn net_holds(design: &Design) -> f64 {
        let crate::design::BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        net.net_rope.breaking_load / design.factors.rope
    }

    #[test]
    fn what_would_not_hold_the_full_barrier_in_proportion_is_open() {
        let mut design = design();
        let holds = net_holds(&design);
        let first = guideline(&design).largest_force / 2.0;
        assert_eq!(net_verdict(&design, 0.45 * holds, first), CheckVerdict::Pass);
        assert_eq!(net_verdict(&design, 0.55 * holds, first), CheckVerdict::Open);
        assert_eq!(net_verdict(&design, 1.05 * holds, first), CheckVerdict::Fail);
        // Of one event the equations say more than the simulation as well.
        design.loads.to_the_top = false;
        let first = guideline(&design).largest_force / 2.0;
        assert_eq!(net_verdict(&design, 0.55 * holds, first), CheckVerdict::Open);
    }

    /// Twice the load on what uses 30 % is 60 %: beyond the limit with a simulation that may be off by 80 %, within with 60 %.
    #[test]
    fn the_full_barrier_is_open_where_the_simulation_is_not_accurate_enough_for_it() {
        let design = design();
        let observed = Observed { net_tension_peak: 0.3 * net_holds(&design), ..Observed::of_ropes(3) };
        let first = guideline(&design).largest_force / 2.0;
        let verdict = |force_band: f64| {
            simulated_verdict(&design, "net_tension", &observed, FirstSurge { force_band, ..pushing(first) })
        };
        assert_eq!(verdict(0.6), CheckVerdict::Pass);
        assert_eq!(verdict(0.8), CheckVerdict::Open);
    }

    /// Between bolts a rope that uses 60 % with P uses 60 % · 2^⅔ = 95 % with twice P; one that uses 64 % uses 102 %.
    #[test]
    fn the_rope_between_bolts_grows_less_than_their_load() {
        let design = design();
        let crate::design::BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        let rope = net.main_ropes.rope;
        let holds = rope.breaking_load * design.factors.rope_end / design.factors.rope;
        let first = guideline(&design).largest_force / 2.0;
        let verdict = |used: f64| {
            // The load on a space whose rope is pulled with that share of what it holds: T³ = P² EA/24.
            let load = ((used * holds).powi(3) * 24.0 / rope.axial_stiffness()).sqrt();
            let observed = Observed { bolt_force_peak: load, ..Observed::of_ropes(3) };
            simulated_verdict(&design, "rope_1_tension", &observed, pushing(first))
        };
        assert_eq!(verdict(0.60), CheckVerdict::Pass);
        assert_eq!(verdict(0.64), CheckVerdict::Open);
    }

    /// A net that loses 20 % of its height under the first surge loses 40 % under twice its load, of 50 % that it may.
    #[test]
    fn the_height_left_is_that_of_the_full_barrier() {
        let design = design();
        let first = guideline(&design).largest_force / 2.0;
        let verdict = |residual_height: f64, share_band: f64| {
            let observed = Observed { residual_height, ..Observed::of_ropes(3) };
            simulated_verdict(&design, "residual_height", &observed, FirstSurge { share_band, ..pushing(first) })
        };
        assert_eq!(verdict(0.8, 0.0), CheckVerdict::Pass);
        assert_eq!(verdict(0.7, 0.0), CheckVerdict::Open);
        assert_eq!(verdict(0.8, 0.06), CheckVerdict::Open);
        assert_eq!(verdict(0.8, 0.04), CheckVerdict::Pass);
    }

    /// A rope that the simulated first surge loads more than the equations load it under the full barrier.
    #[test]
    fn a_rope_that_the_simulation_governs_is_scaled_to_the_full_barrier_up_to_its_cap() {
        let design = design();
        let guideline = guideline(&design);
        let crate::design::BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        let holds = net.main_ropes.rope.breaking_load * design.factors.rope_end / design.factors.rope;
        let tension = 0.95 * holds;
        assert!(tension > guideline.ropes[2].state.tension);
        let observed = Observed { rope_tension_peak: vec![0.0, 0.0, tension], ..Observed::of_ropes(3) };
        let first = guideline.largest_force / 1.2;
        assert_eq!(simulated_verdict(&design, "rope_3_tension", &observed, pushing(first)), CheckVerdict::Open);
        let mut capped = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
        let rope = capped.iter_mut().find(|outcome| outcome.id == "rope_3_tension").expect("a check");
        rope.demand.simulation = Some(tension);
        rope.demand.cap = Some(tension);
        leave_open_full_barrier(&design, &guideline, pushing(first), &mut capped);
        let verdict = capped.iter().find(|outcome| outcome.id == "rope_3_tension").map(|outcome| outcome.verdict);
        assert_eq!(verdict, Some(CheckVerdict::Pass));
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
            assert_eq!(net_verdict(&design, 0.4 * net_holds(&design), first(&design)), CheckVerdict::Pass);
            ask(&mut design);
            assert_eq!(net_verdict(&design, 0.4 * net_holds(&design), first(&design)), CheckVerdict::Open);
            // A gap is no formula outside its range.
            design.limits.outside_range = OutsideRange::Warn;
            assert_eq!(net_verdict(&design, 0.4 * net_holds(&design), first(&design)), CheckVerdict::Open);
        }
    }

    #[test]
    fn a_side_extension_held_by_a_default_leaves_the_simulation_open() {
        let mut design = design();
        let first = guideline(&design).largest_force;
        let mut extend = |holding_force_given| {
            let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            net.side_extension = Some(SideExtension { length: 1.0, holding_force: 1e3, holding_force_given });
            net_verdict(&design, 0.4 * net_holds(&design), first)
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
    fn what_the_equations_would_fail_with_the_velocity_or_the_k_that_is_seen_is_open() {
        let design = design();
        let guideline = guideline(&design);
        let at = |velocity: f64, earth_pressure: Option<f64>| {
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let seen = FirstSurge { velocity, earth_pressure, ..FirstSurge::default() };
            leave_open_harder_flows(&design, &guideline, seen, &mut outcomes);
            outcomes.iter().filter(|outcome| outcome.verdict == CheckVerdict::Open).count()
        };
        let given = guideline.input.velocity;
        let open = at(given, None);
        assert_eq!(at(0.9 * given, Some(0.5)), open);
        assert_eq!(at(1.1 * given, None), open);
        assert!(at(2.0 * given, None) > open);
        assert_eq!(at(given, Some(1.2)), open);
        assert!(at(given, Some(20.0)) > open);
    }

    #[test]
    fn a_partial_factor_on_loads_that_is_not_given_is_not_one() {
        let mut design = design();
        let first = guideline(&design).first_surge();
        assert_eq!(verdict(&design, "rope_2_tension", first), CheckVerdict::Pass);
        design.factors.load_given = false;
        assert_eq!(verdict(&design, "rope_2_tension", first), CheckVerdict::Open);
    }

    /// On a bed of 45° with a friction of 20° a deposit of V presses with K = 2 V (tan 45° − tan 20°)/(b H²).
    #[test]
    fn the_weight_of_a_deposit_tells_k_where_it_is_not_seen() {
        use crate::demand::from_loads::earth_pressure_by_weight;
        let mut design = design();
        design.channel.slope = 45_f64.to_radians();
        design.channel.base_friction = libm::tan(20_f64.to_radians());
        let guideline = guideline(&design);
        let held = guideline.retention.expect("a deposit").volume / guideline.width;
        let by_hand = 2.0 * held * (1.0 - 0.363_970) / guideline.input.barrier_height.powi(2);
        let found = earth_pressure_by_weight(&design, &guideline).expect("K");
        assert!((found / by_hand - 1.0).abs() < 1e-5, "{found} {by_hand}");
        design.channel.base_friction = 2.0;
        assert_eq!(earth_pressure_by_weight(&design, &guideline), Some(0.0));
    }

    /// A design that fills says nothing of the flow over its top: a rope that holds the last surge and not the usual drag beside it is open.
    #[test]
    fn a_barrier_that_fills_holds_a_usual_drag_or_is_open() {
        let mut design = design();
        let top = |design: &Design| guideline(design).ropes[2].state.tension;
        let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.dissipators = None;
        // Slow enough for the overtopped barrier to govern the top rope.
        let crate::design::Arrival::Surge(surge) = &mut design.flow.arrival else { panic!("a surge") };
        surge.velocity = 0.5;
        let without = top(&design);
        let mut dragged = design.clone();
        dragged.loads.overflow_drag = Some((DEFAULT_FRICTION, guideline(&design).input.depth));
        let with = top(&dragged);
        assert!(with > without, "{with} {without}");
        let verdict_of = |holds: f64| {
            let mut design = design.clone();
            let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            net.main_ropes.rope.breaking_load = holds * design.factors.rope;
            let guideline = guideline(&design);
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            leave_open_without_drag(&design, &guideline, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "rope_3_tension").expect("a check").verdict
        };
        assert_eq!(verdict_of(1.2 * with), CheckVerdict::Pass);
        assert_eq!(verdict_of(0.5 * (with + without)), CheckVerdict::Open);
    }
}
