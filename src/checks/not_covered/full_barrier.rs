//! What the simulation of a first surge governs, under the load that the equations have for the full barrier, or for the one event: they
//! tell how much more presses on it than the simulation shows. What would not hold that much more stays open, and so does what would hold
//! it by less than the simulation may be off.

use super::context::{CheckContext, FirstSurge};
use super::harder_flow::largest_force;
use crate::checks::outcome::{Kind, OpenReason, Outcome, Route};
use crate::design::BarrierDesign;
use crate::larger::larger_or_nan;
use crate::quantities::quantity::Unit;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let Some(seen) = context.seen else { return };
    let more = largest_force(context.design, context.guideline, &seen) / seen.largest_push;
    // What stands higher has a longer lever as well, about a base that may lie deeper than the foot of the face.
    let deeper = match &context.design.barrier {
        BarrierDesign::RigidWall(wall) => wall.stability.map_or(0.0, |stability| stability.founding_depth),
        BarrierDesign::FlexibleNet(_) => 0.0,
    };
    let about_the_base = |moment: f64, force: f64| moment + deeper * force / context.guideline.width;
    let lever = about_the_base(context.guideline.face_moment, context.guideline.largest_force)
        / about_the_base(seen.moment, seen.largest_push);
    let more_moment = larger_or_nan(more, lever);
    let (when, instead) = match context.design.loads.to_the_top {
        true => ("the full barrier", "simulate a larger flow, or say loads.filling: one_event"),
        false => ("the barrier", "give it more resistance"),
    };
    let simulated = match context.design.flow.surges() {
        1 if context.design.flow.hydrograph.is_some() => "the hydrograph".to_string(),
        1 => "the first surge".to_string(),
        several => format!("an event of {several} surges"),
    };
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        let tips = outcome.unit == Unit::NewtonMetrePerMetre || outcome.kind == Kind::BaseActions;
        let more = if tips { more_moment } else { more };
        if more <= 1.0 {
            continue;
        }
        let Some([used, may_be]) = used_under_more(outcome, more, seen) else { continue };
        // What the equations have is of the full barrier; what is beside them is of the first surge.
        let beside = |band: f64| match outcome.demand.guideline.zip(outcome.capacity) {
            Some((demand, capacity)) => (demand + (more * (1.0 + band) - 1.0) * outcome.beside) / capacity,
            None => 0.0,
        };
        let [used, may_be] = match outcome.beside > 0.0 {
            true => [larger_or_nan(used, beside(0.0)), larger_or_nan(may_be, beside(seen.force_band))],
            false => [used, may_be],
        };
        let full = if seen.largest_push > 0.0 {
            format!("the simulation is of {simulated}, and by the guideline {more:.1} times as much presses on {when}")
        } else {
            format!(
                "the simulation is of {simulated}, which does not push the barrier, and by the guideline the full barrier is pushed"
            )
        };
        // Written so that a NaN counts as not within.
        let within = |used: f64| used <= 1.0;
        if !within(used) {
            outcome.leave_open(OpenReason::Contradicted(format!(
                "{full}, and scaled up to that it would fail ({instead})"
            )));
        } else if !within(may_be) {
            outcome.leave_open(OpenReason::TooClose(format!(
                "{full}: scaled up it would pass, but by less than the error of the simulation ({})",
                seen.known_better()
            )));
        } else if !known_by_equations(outcome) {
            outcome.scale_up(more, used);
        }
    }
}

/// Whether the equations, which know the full barrier, tell more than the simulation. They spread the load evenly over bolts and rings, so that theirs
/// is no measure of the worst one.
fn known_by_equations(outcome: &Outcome) -> bool {
    let spread = matches!(outcome.kind, Kind::Bolts | Kind::BetweenBolts | Kind::NetRopes);
    outcome.governed_by_equations() && !spread
}

/// Utilisation by the simulation with `more` times the load, as simulated and with the largest error that the simulation may have;
/// nothing where that says nothing.
pub fn used_under_more(outcome: &Outcome, more: f64, seen: FirstSurge) -> Option<[f64; 2]> {
    let (demand, capacity) = (outcome.demand.simulation?, outcome.capacity?);
    match outcome.kind {
        // The share held has its own rule: what a full barrier does not hold is not asked for.
        Kind::MassHeld | Kind::DissipatorTension | Kind::DissipatorCurve => return None,
        // A level does not grow with the load; what surges over a deposit reach is in the equations.
        Kind::Level => return None,
        // A net that sinks in by a share under the first surge sinks in by that much more when it is full.
        Kind::HeightLeft => {
            let lost = |band: f64| more * (1.0 - demand + band) / (1.0 - capacity).max(1e-9);
            return Some([lost(0.0), lost(seen.share_band)]);
        }
        Kind::Any
        | Kind::Anchors
        | Kind::Posts
        | Kind::WallStrength
        | Kind::Bolts
        | Kind::BetweenBolts
        | Kind::MainRope
        | Kind::LateralRopes
        | Kind::NetRopes
        | Kind::Stroke
        | Kind::BaseActions => {}
    }
    let known = known_by_equations(outcome);
    let cap = outcome.demand.cap.map_or(f64::INFINITY, |cap| cap.max(demand));
    let used = |band: f64| {
        let full = outcome.demand_under(Route::Simulation, more * (1.0 + band)).unwrap_or(f64::NAN);
        // Asked so that what is not a number stays so.
        (if full > cap { cap } else { full }) / capacity
    };
    // Where the equations, which know the full barrier, tell more, the simulation need only not contradict them, whichever run it is.
    let band = match outcome.kind {
        _ if known => seen.one_run,
        Kind::Stroke => seen.stroke_band,
        Kind::NetRopes => seen.net_band,
        _ => seen.force_band,
    };
    Some([used(0.0), used(band)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::between_bolts::concentration;
    use crate::checks::check_all;
    use crate::checks::not_covered::tests::{net_holds, net_verdict, pushing, simulated_verdict, small_net};
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demands;
    use crate::guideline::guideline;
    use crate::quantities::counts::Counts;
    use crate::quantities::observed::Observed;
    use crate::quantities::{bed, height, other_ropes, rope_tension};

    #[test]
    fn what_would_not_hold_the_full_barrier_in_proportion_is_open() {
        let mut design = small_net();
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
        let design = small_net();
        let observed = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
            .with(&other_ropes::NET, &[0.3 * net_holds(&design)]);
        let first = guideline(&design).largest_force / 2.0;
        let verdict = |net_band: f64| {
            simulated_verdict(&design, "net_tension", &observed, FirstSurge { net_band, ..pushing(first) })
        };
        assert_eq!(verdict(0.6), CheckVerdict::Pass);
        assert_eq!(verdict(0.8), CheckVerdict::Open);
    }

    /// Between bolts a rope that uses 59 % with P uses 59 % · 2^⅔ = 94 % with twice P, and somewhat more with half of P beside it; one that
    /// uses 64 % uses 102 %.
    #[test]
    fn the_rope_between_bolts_grows_less_than_their_load() {
        let mut design = small_net();
        // As hard as is asked for.
        design.flow.modulus = 1e9;
        let crate::design::BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        let rope = net.main_ropes.levels[0].rope;
        let holds = rope.breaking_load * design.factors.rope_end / design.factors.rope;
        let first = guideline(&design).largest_force / 2.0;
        let verdict = |used: f64| {
            // The load on a space whose rope is pulled along its span with that share of what it holds: H³ = c P² EA/24.
            // Of a space with one ring in it.
            let axial = rope.axial_stiffness() * concentration(1.0);
            let load = ((used * holds).powi(3) * 24.0 / axial).sqrt();
            let observed = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
                .with(&bed::SPACE, &[load])
                .with(&bed::BOLT, &[load]);
            simulated_verdict(&design, "rope_1_tension", &observed, pushing(first))
        };
        assert_eq!(verdict(0.59), CheckVerdict::Warn);
        assert_eq!(verdict(0.54), CheckVerdict::Pass);
        assert_eq!(verdict(0.64), CheckVerdict::Open);
    }

    /// A net that loses 20 % of its height under the first surge loses 40 % under twice its load, of 50 % that it may.
    #[test]
    fn the_height_left_is_that_of_the_full_barrier() {
        let design = small_net();
        let first = guideline(&design).largest_force / 2.0;
        let verdict = |residual_height: f64, share_band: f64| {
            let observed = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
                .with(&height::RESIDUAL, &[residual_height]);
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
        let design = small_net();
        let guideline = guideline(&design);
        let crate::design::BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        let holds = net.main_ropes.levels[2].rope.breaking_load * design.factors.rope_end / design.factors.rope;
        let tension = 0.95 * holds;
        assert!(tension > guideline.ropes[2].state.tension);
        let observed = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
            .with(&rope_tension::PEAK, &[0.0, 0.0, tension]);
        let first = guideline.largest_force / 1.2;
        assert_eq!(simulated_verdict(&design, "rope_3_tension", &observed, pushing(first)), CheckVerdict::Open);
        let mut capped = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
        let rope = capped.iter_mut().find(|outcome| outcome.id == "rope_3_tension").expect("a check");
        rope.demand.simulation = Some(tension);
        rope.demand.cap = Some(tension);
        leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(pushing(first)) }, &mut capped);
        let verdict = capped.iter().find(|outcome| outcome.id == "rope_3_tension").map(|outcome| outcome.verdict);
        // It holds, with less than a tenth to spare.
        assert_eq!(verdict, Some(CheckVerdict::Warn));
        let scaled = capped.iter().find(|outcome| outcome.id == "rope_3_tension").and_then(|outcome| outcome.scaled);
        let scaled = scaled.expect("more than was simulated");
        assert!(scaled.more > 1.2 && (scaled.used - 0.95).abs() < 1e-9, "{scaled:?}");
    }

    /// Half as much again as the first surge, of which the simulation shows half of what the part holds, and may show 60 % more.
    #[test]
    fn where_the_equations_tell_more_the_simulation_need_only_not_contradict_them_but_for_bolts() {
        let design = small_net();
        let guideline = guideline(&design);
        let seen = FirstSurge { force_band: 0.6, stroke_band: 0.2, ..pushing(guideline.largest_force / 1.5) };
        let after = |id: &str, share: f64, simulated: f64| {
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let outcome = outcomes.iter_mut().find(|outcome| outcome.id == id).expect("a check");
            let capacity = outcome.capacity.expect("a capacity");
            outcome.demand.guideline = Some(share * capacity);
            outcome.demand.simulation = Some(simulated * capacity);
            outcome.verdict = CheckVerdict::Pass;
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == id).expect("it").verdict
        };
        assert_eq!(after("rope_3_tension", 0.8, 0.5), CheckVerdict::Pass);
        assert_eq!(after("rope_3_tension", 0.4, 0.5), CheckVerdict::Open);
        assert_eq!(after("rope_3_tension", 0.8, 0.7), CheckVerdict::Open);
        assert_eq!(after("bed_bolts", 0.8, 0.6), CheckVerdict::Open);
        assert_eq!(after("bed_bolts", 0.8, 0.4), CheckVerdict::Pass);
        // A stroke has a band of its own: 0.5 · 1.5 · 1.2.
        assert_eq!(after("brake_3_stroke", 0.4, 0.5), CheckVerdict::Pass);
        assert_eq!(after("brake_3_stroke", 0.4, 0.6), CheckVerdict::Open);
    }

    #[test]
    fn a_surge_that_does_not_push_says_nothing_of_the_full_barrier() {
        let design = small_net();
        let guideline = guideline(&design);
        let why = |push: f64| {
            let net_tension =
                crate::demand::Demand { simulation: Some(0.9 * net_holds(&design)), ..Default::default() };
            let demands = Demands::by_equations(&guideline, &design.factors).with(&other_ropes::NET, &[net_tension]);
            let mut outcomes = check_all(&design, &demands);
            leave_open(
                CheckContext { design: &design, guideline: &guideline, seen: Some(pushing(push)) },
                &mut outcomes,
            );
            let net = outcomes.into_iter().find(|outcome| outcome.id == "net_tension").expect("a check");
            net.open.expect("a reason").words().to_string()
        };
        assert!(why(0.0).starts_with("the simulation is of the first surge, which does not push the barrier"));
        assert!(why(guideline.largest_force / 3.0).contains("3.0 times as much presses on the full barrier"));
    }

    /// A wall whose own pull and water use 30 % and whose flow uses 20 % uses 70 % under twice the flow; what its base bears is told by the
    /// equations where they tell more.
    #[test]
    fn what_is_there_without_the_flow_does_not_grow_with_it() {
        use crate::checks::outcome::{CheckName, LoadScaling, Resistance};
        use crate::demand::Demand;
        let used = |fixed: f64, kind: Kind, guideline: f64| {
            let demand = Demand { guideline: Some(guideline), simulation: Some(0.5), ..Demand::default() };
            let resistance = Resistance { characteristic: 1.0, factor: 1.0 };
            let outcome =
                Outcome::at_most(CheckName::new("x", "x", Unit::NewtonPerMetre, "x"), demand, resistance, 1.0);
            let outcome = Outcome { growth: LoadScaling::InProportion { fixed }, kind, ..outcome };
            used_under_more(&outcome, 2.0, FirstSurge::default()).map(|[used, _]| used)
        };
        assert_eq!(used(0.3, Kind::Any, 0.0), Some(0.7));
        assert_eq!(used(0.0, Kind::Any, 0.0), Some(1.0));
        assert_eq!(used(0.0, Kind::BaseActions, 0.6), Some(1.0));
        assert_eq!(used(0.0, Kind::BaseActions, 0.4), Some(1.0));
    }
}
