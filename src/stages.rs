//! An event surge by surge: what the simulation shows of each, beside the guideline's stage for the deposit that lay there, the depth and the
//! velocity of that surge.

use crate::design::{Arrival, Design};
use crate::guideline::input;
use crate::loads::cases::later_surge;
use crate::loads::input::GuidelineInput;
use crate::quantities::observed::Observed;
use crate::quantities::quantity::Quantity;
use crate::quantities::{
    anchor_load, dissipator, earth_pressure, incoming, other_ropes, rope_tension, run_up, total_force,
};
use crate::simulated::{Simulated, Start};
use crate::starts::Spread;

/// One surge of several. Forces without partial factors; spreads are over the packings.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// As the design gives it: volume with pores (m³), depth (m), velocity (m/s).
    pub volume: f64,
    pub depth: f64,
    pub velocity: f64,
    /// Depth of the deposit at the barrier before it comes, and after (m).
    pub before: Spread,
    pub after: Spread,
    /// Largest force along the bed in the simulation, and by the guideline over that deposit (N).
    pub force: Spread,
    pub guideline: f64,
    /// Highest level at the barrier (m).
    pub level: Spread,
    /// Largest tension of any main rope and load of any anchor (N), the longest stroke of a dissipator: in all since the first surge, and what of
    /// it this surge has added (m). Nothing on a wall, or without dissipators.
    pub rope: Option<Spread>,
    pub net: Option<Spread>,
    pub anchor: Option<Spread>,
    pub stroke: Option<[Spread; 2]>,
    /// Mass that went past the barrier, over that of the surge.
    pub lost: Spread,
    /// λ that its largest force means for the depth and velocity that the design gives, over the deposit that lay there, with the design's K.
    pub lambda: Spread,
    /// The same with what was measured just upstream of the barrier, and K of the deposit at rest after it, where every packing tells them.
    pub lambda_measured: Option<Spread>,
    pub k_at_rest: Option<Spread>,
}

/// The surges of a simulated event, in their order; empty where there is one only.
pub fn stages(design: &Design, simulated: &Simulated) -> Vec<Stage> {
    let shown = simulated.starts.iter().map(|start| start.surges.len()).min().unwrap_or(0);
    (0..shown).map(|number| stage(design, simulated, number)).collect()
}

/// The surge whose force along the bed is largest, counted from 0.
pub fn hardest(stages: &[Stage]) -> Option<usize> {
    (0..stages.len()).max_by(|a, b| stages[*a].force.mean.total_cmp(&stages[*b].force.mean))
}

fn stage(design: &Design, simulated: &Simulated, number: usize) -> Stage {
    let starts = &simulated.starts;
    let over = |value: &dyn Fn(&Start) -> f64| Spread::of(&starts.iter().map(value).collect::<Vec<_>>());
    let one = |quantity: &'static Quantity| over(&|start| start.surges[number].one(quantity));
    let known = |quantity: &'static Quantity| {
        let values: Option<Vec<f64>> = starts.iter().map(|start| start.surges[number].known(quantity)).collect();
        values.map(|values| Spread::of(&values))
    };
    let most =
        |seen: &Observed, quantity: &Quantity| seen.each(quantity).iter().copied().reduce(crate::larger::larger_or_nan);
    let largest = |quantity: &'static Quantity| {
        let values: Option<Vec<f64>> = starts.iter().map(|start| most(&start.surges[number], quantity)).collect();
        values.map(|values| Spread::of(&values))
    };
    let alone = Design { flow: design.flow.alone(number), ..design.clone() };
    let flow = input(&alone).without_wood();
    let of_before = |start: &Start, quantity: &Quantity| {
        number.checked_sub(1).map_or(0.0, |before| start.surges[before].one(quantity))
    };
    let deposit = |start: &Start| of_before(start, &incoming::DEPOSIT);
    let section = design.channel.section();
    let by_guideline = |flow: &GuidelineInput, deposit: f64| later_surge::case(flow, deposit).total_force(&section);
    let before = over(&deposit);
    let lambda = |start: &Start| {
        let at = |lambda: f64| by_guideline(&GuidelineInput { dynamic_pressure: lambda, ..flow }, deposit(start));
        (start.surges[number].one(&total_force::PUSH) - at(0.0)) / (at(1.0) - at(0.0))
    };
    let share = alone.flow.mass / design.flow.mass_of_all();
    let added = |start: &Start| {
        let stroke = |surge: usize| most(&start.surges[surge], &dissipator::STROKE).unwrap_or(0.0);
        stroke(number) - number.checked_sub(1).map_or(0.0, stroke)
    };
    Stage {
        volume: alone.flow.volume(),
        depth: flow.depth,
        velocity: match alone.flow.arrival {
            Arrival::Surge(surge) => surge.velocity,
            Arrival::DamBreak(_) => flow.velocity,
        },
        guideline: by_guideline(&flow, before.mean),
        before,
        after: one(&incoming::DEPOSIT),
        force: one(&total_force::PUSH),
        level: one(&run_up::LEVEL),
        rope: largest(&rope_tension::PEAK),
        net: known(&other_ropes::NET).filter(|net| net.mean > 0.0),
        anchor: largest(&anchor_load::PEAK),
        stroke: largest(&dissipator::STROKE).map(|in_all| [in_all, over(&added)]),
        lost: over(&|start| start.surges[number].lost().iter().sum::<f64>() / share),
        lambda: over(&lambda),
        lambda_measured: known(&earth_pressure::DYNAMIC),
        k_at_rest: known(&earth_pressure::AT_REST),
    }
}
