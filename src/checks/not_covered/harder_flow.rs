//! What the equations would fail, or would not be known for, with what the simulation shows of the flow where that is more than they were
//! given: its velocity and depth, the K of its deposit, and the λ with which they push as hard as it does. Surges over a deposit, and the
//! full barrier, are in the equations alone: with a λ that is too low for the first surge they are too low as well.

use super::context::{CheckContext, FirstSurge};
use crate::checks::check_all;
use crate::checks::freeboard;
use crate::checks::height::left_by_sag;
use crate::checks::outcome::{Kind, OpenReason, Outcome};
use crate::checks::range::leave_open_outside_range;
use crate::demand::Demands;
use crate::design::Design;
use crate::guideline::{
    Guideline, depth_as_released, earth_pressure_by_weight, filled, guideline_for, velocity_on_its_way,
};
use crate::larger::larger_or_nan;
use crate::loads::input::GuidelineInput;

pub fn leave_open(context: CheckContext, outcomes: &mut [Outcome]) {
    let CheckContext { design, guideline, seen } = context;
    let harder = match seen {
        Some(seen) => inputs(design, guideline, &seen),
        None => without_a_simulation(design, guideline),
    };
    for harder in harder {
        leave_open_with(design, guideline, harder, outcomes);
    }
}

/// What is known of the flow before it is simulated: the weight of a full deposit, and the velocity that the bed gives it on its way.
fn without_a_simulation(design: &Design, guideline: &Guideline) -> Vec<GuidelineInput> {
    let given = guideline.input;
    let by_weight = design.loads.to_the_top.then(|| earth_pressure_by_weight(design, guideline)).flatten();
    let earth_pressure = larger_or_nan(by_weight.unwrap_or(0.0), given.earth_pressure);
    let way = velocity_on_its_way(design);
    let velocity = if way > MUCH_FASTER * given.velocity { way } else { given.velocity };
    let released = depth_as_released(design);
    let depth = if released > MUCH_DEEPER * given.depth { released } else { given.depth };
    let harder = filled(design, GuidelineInput { earth_pressure, velocity, depth, ..given });
    if harder == given { Vec::new() } else { vec![harder] }
}

/// Velocity by the bed alone over the given one above which the given one is doubted: what arrives is often half of it.
const MUCH_FASTER: f64 = 2.5;

/// Depth in which the flow is released over the given one above which the given one is doubted: on its way a dam break becomes thinner, seldom by more.
const MUCH_DEEPER: f64 = 5.0;

/// What the equations are asked with: as fast and as deep as the flow is seen, and with the λ that pushes as hard; each with the K seen.
fn inputs(design: &Design, guideline: &Guideline, seen: &FirstSurge) -> Vec<GuidelineInput> {
    let given = guideline.input;
    let earth_pressure = larger_or_nan(seen.earth_pressure.unwrap_or(0.0), given.earth_pressure);
    let as_seen = filled(design, GuidelineInput { earth_pressure, ..arriving(given, seen) });
    let dynamic_pressure =
        larger_or_nan(lambda_that_pushes(design, guideline, seen.hardest_push), given.dynamic_pressure);
    let as_hard = GuidelineInput { earth_pressure, dynamic_pressure, ..given };
    [as_seen, as_hard].into_iter().filter(|harder| *harder != given).collect()
}

/// The flow as fast and as deep as it is seen, where that is more than given.
pub fn arriving(given: GuidelineInput, seen: &FirstSurge) -> GuidelineInput {
    GuidelineInput {
        velocity: larger_or_nan(seen.velocity, given.velocity),
        depth: larger_or_nan(seen.depth, given.depth),
        ..given
    }
}

/// The λ with which the equations' first surge pushes with a force (N): that force is linear in λ.
fn lambda_that_pushes(design: &Design, guideline: &Guideline, push: f64) -> f64 {
    let given = guideline.input;
    let doubled = GuidelineInput { dynamic_pressure: 2.0 * given.dynamic_pressure, ..given };
    let [once, twice] = [guideline.first_surge(), guideline_for(design, doubled).first_surge()];
    given.dynamic_pressure * (1.0 + (push - once) / (twice - once))
}

/// Largest force along the bed that the equations have for the barrier (N): with what is given, and with the K that is seen and the λ that pushes as
/// hard, where those are more.
pub fn largest_force(design: &Design, guideline: &Guideline, seen: &FirstSurge) -> f64 {
    let given = guideline.input;
    let earth_pressure = larger_or_nan(seen.earth_pressure.unwrap_or(0.0), given.earth_pressure);
    let dynamic_pressure = larger_or_nan(lambda_that_pushes(design, guideline, seen.push), given.dynamic_pressure);
    guideline_for(design, GuidelineInput { earth_pressure, dynamic_pressure, ..given }).largest_force
}

fn leave_open_with(design: &Design, guideline: &Guideline, harder: GuidelineInput, outcomes: &mut [Outcome]) {
    let given = guideline.input;
    let asked = guideline_for(design, harder);
    let mut checks = check_all(design, &Demands::by_equations(&asked, &design.factors));
    let before: Vec<bool> = checks.iter().map(Outcome::holds).collect();
    leave_open_outside_range(design, &asked, &mut checks);
    let found = in_words(given, harder);
    // Asked as "enough", so that what is not a number is not.
    let enough_left = left_by_sag(design, &asked).is_none_or(|left| left >= design.limits.residual_height);
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        let Some(place) = checks.iter().position(|then| then.id == outcome.id) else { continue };
        let (then, held) = (&checks[place], before[place]);
        let equations_count = outcome.governed_by_equations() || design.loads.to_the_top;
        // What cannot be asked, because something seen is not a number, does not hold.
        let unknown = then.demand.guideline.map_or(outcome.demand.guideline.is_some(), f64::is_nan);
        let sags = outcome.kind == Kind::HeightLeft && !enough_left;
        let goes_over = outcome.kind == Kind::Level && !freeboard::has_room(design, &asked, outcome);
        let why = if outcome.would_fail(then) || unknown || sags || goes_over {
            "the equations would fail this check"
        } else if held && !then.holds() && equations_count {
            "the equations would be used outside the range they are known for"
        } else {
            continue;
        };
        outcome.leave_open(OpenReason::Contradicted(format!("the flow {found}; with that, {why}")));
    }
}

/// A value in words, which may not have been measured.
fn measured(value: f64, unit: &str) -> String {
    if value.is_nan() { "a value that could not be measured".to_string() } else { format!("{value:.2} {unit}") }
}

/// What is harder than given.
fn in_words(given: GuidelineInput, harder: GuidelineInput) -> String {
    // Asked as "no more", so that what is not a number is told.
    let more = |harder: f64, given: f64, words: String| {
        let no_more = harder <= given;
        (!no_more).then_some(words)
    };
    let found = [
        more(
            harder.velocity,
            given.velocity,
            format!("arrives with {} (given: {:.2} m/s)", measured(harder.velocity, "m/s"), given.velocity),
        ),
        more(
            harder.depth,
            given.depth,
            format!("arrives {} deep (given: {:.2} m)", measured(harder.depth, "m"), given.depth),
        ),
        more(
            harder.dynamic_pressure,
            given.dynamic_pressure,
            format!(
                "pushes as with λ = {} (given: {:.2})",
                measured(harder.dynamic_pressure, "").trim_end(),
                given.dynamic_pressure
            ),
        ),
        more(
            harder.earth_pressure,
            given.earth_pressure,
            format!(
                "presses at rest, by its deposit or by the weight of a full one, with K = {} (given: {:.2})",
                measured(harder.earth_pressure, "").trim_end(),
                given.earth_pressure
            ),
        ),
    ];
    found.into_iter().flatten().collect::<Vec<_>>().join(" and ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::not_covered::context::FirstSurge;
    use crate::checks::not_covered::tests::small_net;
    use crate::checks::outcome::CheckVerdict;
    use crate::design::{BarrierDesign, Design};
    use crate::guideline::guideline;

    /// A net that the simulation leaves 60 % of its height has room for the given flow, not for one that arrives faster, which by the equations,
    /// with less sag, it would have.
    #[test]
    fn a_faster_flow_finds_no_more_height_than_the_simulation_left() {
        use crate::demand::Demand;
        use crate::quantities::{height, run_up};
        let mut design = small_net();
        (design.loads.to_the_top, design.limits.freeboard) = (false, Some(0.0));
        (design.flow.mass, design.flow.event_volume) = (1.0, 1.0 / design.flow.bulk_density);
        let crate::design::Arrival::Surge(surge) = &mut design.flow.arrival else { panic!("a surge") };
        (surge.depth, surge.velocity) = (0.2, 2.0);
        let guideline = guideline(&design);
        let level = guideline.level;
        let kept =
            Demand { simulation: Some(1.1 * level / crate::guideline::height_over_bed(&design)), ..Demand::default() };
        let demands = Demands::by_equations(&guideline, &design.factors).with(&height::RESIDUAL, &[kept]);
        let verdict = |velocity: f64| {
            let mut outcomes = check_all(&design, &demands);
            let seen = FirstSurge { velocity, ..FirstSurge::default() };
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            let outcome = outcomes.into_iter().find(|outcome| outcome.kind == Kind::Level).expect("a check");
            assert_eq!(outcome.demand, demands.one(&run_up::LEVEL));
            outcome.verdict
        };
        assert_eq!(verdict(2.0), CheckVerdict::Warn);
        assert_eq!(verdict(2.6), CheckVerdict::Open);
    }

    #[test]
    fn what_the_equations_would_fail_with_the_velocity_or_the_k_that_is_seen_is_open() {
        let design = small_net();
        let guideline = guideline(&design);
        let at = |velocity: f64, earth_pressure: Option<f64>| {
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let seen = FirstSurge { velocity, earth_pressure, ..FirstSurge::default() };
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
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

    /// The first surge pushes with a + b λ: half as much again is met by the λ that the equations then push with, and rope 3, which uses 57 %
    /// of what it holds under λ as given, is open once that λ makes it fail.
    #[test]
    fn a_first_surge_that_hits_harder_asks_the_later_ones_with_its_lambda() {
        let design = small_net();
        let guideline = guideline(&design);
        let push = 1.5 * guideline.first_surge();
        let lambda = lambda_that_pushes(&design, &guideline, push);
        let harder = GuidelineInput { dynamic_pressure: lambda, ..guideline.input };
        assert!((guideline_for(&design, harder).first_surge() / push - 1.0).abs() < 1e-12);
        assert!(lambda > 1.5 * guideline.input.dynamic_pressure);
        let verdict = |times: f64| {
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let seen = FirstSurge { hardest_push: times * guideline.first_surge(), ..FirstSurge::default() };
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            let rope = outcomes.into_iter().find(|outcome| outcome.id == "rope_3_tension").expect("a check");
            (rope.verdict, rope.open.map_or(String::new(), |open| open.words().to_string()))
        };
        assert_eq!(verdict(1.0).0, CheckVerdict::Pass);
        let (open, words) = verdict(4.0);
        assert_eq!(open, CheckVerdict::Open);
        assert!(words.contains("the flow pushes as with λ = "), "{words}");
        assert_eq!(verdict(f64::NAN).0, CheckVerdict::Open);
        // The full barrier as well is asked for with it.
        let seen = FirstSurge { push, ..FirstSurge::default() };
        assert!(largest_force(&design, &guideline, &seen) > 1.2 * guideline.largest_force);
        let gentle = FirstSurge { push: 0.5 * push, ..FirstSurge::default() };
        assert_eq!(largest_force(&design, &guideline, &gentle), guideline.largest_force);
    }

    #[test]
    fn only_what_is_harder_than_given_is_told() {
        let design = small_net();
        let guideline = guideline(&design);
        let given = guideline.input;
        let told = |velocity: f64, earth_pressure: Option<f64>| {
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let seen = FirstSurge { velocity, earth_pressure, ..FirstSurge::default() };
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            let opened = outcomes.into_iter().filter_map(|outcome| outcome.open);
            opened.map(|open| open.words().to_string()).find(|words| words.contains("the flow "))
        };
        let fast = told(2.0 * given.velocity, Some(0.5)).expect("words");
        assert!(fast.contains("arrives with 9.20 m/s (given: 4.60 m/s); with that"), "{fast}");
        let heavy = told(given.velocity, Some(20.0)).expect("words");
        assert!(
            heavy.contains(
                "the flow presses at rest, by its deposit or by the weight of a full one, with K = 20.00 (given: "
            ),
            "{heavy}"
        );
        let deep = {
            let seen = FirstSurge { depth: 5.0 * given.depth, ..FirstSurge::default() };
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            let opened = outcomes.into_iter().filter_map(|outcome| outcome.open);
            opened.map(|open| open.words().to_string()).find(|words| words.contains("arrives")).expect("words")
        };
        assert!(deep.contains("the flow arrives 3.00 m deep (given: 0.60 m)"), "{deep}");
        let both = told(2.0 * given.velocity, Some(20.0)).expect("words");
        assert!(both.contains("m/s) and presses at rest"), "{both}");
        assert_eq!(told(given.velocity, Some(given.earth_pressure)), None);
    }

    /// At 12 m/s a net is outside the range of its pressures, which a simulated force on a barrier of one event does not hang on.
    #[test]
    fn a_range_counts_where_the_equations_govern_or_later_surges_come() {
        use crate::demand::Demand;
        let mut design = small_net();
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.main_ropes.levels.iter_mut().for_each(|level| level.rope.breaking_load *= 100.0);
        net.dissipators = None;
        let verdict = |design: &Design| {
            let guideline = guideline(design);
            let demands = Demands::by_equations(&guideline, &design.factors);
            let mut outcomes = check_all(design, &demands);
            let rope = outcomes.iter_mut().find(|outcome| outcome.id == "rope_3_tension").expect("a check");
            let more = 1.1 * rope.demand.guideline.expect("a demand");
            rope.demand = Demand { simulation: Some(more), ..rope.demand };
            let seen = FirstSurge { velocity: 12.0, ..FirstSurge::default() };
            leave_open(CheckContext { design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "rope_3_tension").expect("it").verdict
        };
        assert_eq!(verdict(&design), CheckVerdict::Open);
        design.loads.to_the_top = false;
        assert_eq!(verdict(&design), CheckVerdict::Pass);
    }

    /// One event that fills no higher than its own depth of 0.6 m: one that arrives 1.5 m deep loads the wall as high as that, with more than twice
    /// the force that it was designed for.
    #[test]
    fn a_flow_deeper_than_the_fill_loads_the_barrier_as_high_as_it_is() {
        let text = include_str!("../../../tests/fixtures/tiny_wall.yaml");
        let mut design = crate::design::read::read_design("x", text.as_bytes()).unwrap().design;
        design.loads.to_the_top = false;
        // Deeper, its Froude number is lower: that alone is not to open the check.
        design.limits.outside_range = crate::design::OutsideRange::Warn;
        let mut guideline = guideline(&design);
        guideline.input.fill_height = guideline.input.depth;
        let guideline = guideline_for(&design, guideline.input);
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        wall.resistance = Some(2.0 * design.factors.load * guideline.face_force * wall.resistance_factor);
        let verdict = |depth: f64| {
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let seen = FirstSurge { depth, ..FirstSurge::default() };
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: Some(seen) }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "total_force").expect("a check").verdict
        };
        assert_eq!(verdict(guideline.input.depth), CheckVerdict::Pass);
        assert_eq!(verdict(2.5 * guideline.input.depth), CheckVerdict::Open);
    }

    /// A wall that the equations alone would pass: not with a full deposit whose weight presses with more than their K, nor with a velocity that
    /// the bed more than doubles on the way.
    #[test]
    fn without_a_simulation_the_weight_of_a_deposit_and_the_way_of_the_flow_are_asked() {
        let text = include_str!("../../../designs/rigid_wall.yaml");
        let design = crate::design::read::read_design("x", text.as_bytes()).unwrap().design;
        let harder = |change: fn(&mut Design)| {
            let mut design = design.clone();
            change(&mut design);
            let guideline = guideline(&design);
            without_a_simulation(&design, &guideline).first().map(|input| (input.earth_pressure, input.velocity))
        };
        let by_weight = harder(|design| (design.loads.to_the_top, design.channel.base_friction) = (true, 0.2))
            .expect("a steep and smooth bed");
        assert!(by_weight.0 > 2.0, "{by_weight:?}");
        assert_eq!(harder(|design| (design.loads.to_the_top, design.channel.base_friction) = (false, 0.5)), None);
        let slow = harder(|design| {
            design.loads.to_the_top = false;
            let crate::design::Arrival::DamBreak(block) = &mut design.flow.arrival else { panic!("a dam break") };
            block.velocity_at_barrier = Some(2.0);
        });
        assert!(slow.is_some_and(|(_, velocity)| velocity > 5.0), "{slow:?}");
        // A dam break that is said to come with a tenth of the depth at its gate, or with a third of it.
        let depth = |share: f64| {
            let mut design = design.clone();
            let crate::design::Arrival::DamBreak(block) = &mut design.flow.arrival else { panic!("a dam break") };
            let released = 4.0 / 9.0 * block.height;
            block.depth_at_barrier = Some(share * released);
            let found = without_a_simulation(&design, &guideline(&design));
            found.first().map_or(0.0, |input| input.depth / released)
        };
        assert!((depth(0.1) - 1.0).abs() < 1e-9 && depth(0.3) < 0.5, "{} {}", depth(0.1), depth(0.3));
    }
}
