//! An event surge by surge: what the simulation shows of each, beside the guideline's stage for the deposit that lay there, the depth and the
//! velocity of that surge.

use crate::design::Design;
use crate::guideline::input;
use crate::loads::cases::later_surge;
use crate::loads::input::GuidelineInput;
use crate::quantities::observed::Observed;
use crate::quantities::quantity::Quantity;
use crate::quantities::{
    anchor_load, dissipator, earth_pressure, incoming, other_ropes, rope_tension, run_up, total_force,
};
use crate::section::Section;
use crate::simulated::{Simulated, Start};
use crate::starts::Spread;

/// One surge of several. Forces without partial factors; spreads are over the packings.
#[derive(Clone, Debug, PartialEq)]
pub struct SurgeResult {
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
    /// λ that its largest force means for the depth and velocity that the design gives, over the deposit that lay there, with the design's K;
    /// nothing where less than half of the flow hits the barrier over that deposit.
    pub lambda: Option<Spread>,
    /// The same with what was measured just upstream of the barrier, and K of the deposit at rest after it, where every packing tells them.
    pub lambda_measured: Option<Spread>,
    pub k_at_rest: Option<Spread>,
}

/// The surges of a simulated event, in their order; empty where there is one only.
pub fn stages(design: &Design, simulated: &Simulated) -> Vec<SurgeResult> {
    let shown = simulated.starts.iter().map(|start| start.surges.len()).min().unwrap_or(0);
    (0..shown).map(|number| stage(design, simulated, number)).collect()
}

/// The surge whose force along the bed is largest, counted from 0.
pub fn hardest(stages: &[SurgeResult]) -> Option<usize> {
    (0..stages.len()).max_by(|a, b| stages[*a].force.mean.total_cmp(&stages[*b].force.mean))
}

/// The surges of a design as the equations see them, without wood, as it is simulated.
struct Equations {
    flow: GuidelineInput,
    section: Section,
}

impl Equations {
    fn of(design: &Design, number: usize) -> Self {
        let alone = Design { flow: design.flow.alone(number), ..design.clone() };
        Self { flow: input(&alone).without_wood(), section: design.channel.section() }
    }

    /// Force along the bed over a deposit of a depth (m), with a λ (N).
    fn force(&self, deposit: f64, lambda: f64) -> f64 {
        let flow = GuidelineInput { dynamic_pressure: lambda, ..self.flow };
        later_surge::case(&flow, deposit).total_force(&self.section)
    }

    /// λ that a push (N) over a deposit (m) means; nothing where less than half of the flow hits the barrier over it.
    fn lambda(&self, deposit: f64, push: f64) -> Option<f64> {
        let [without, once] = [0.0, 1.0].map(|lambda| self.force(deposit, lambda));
        let hits = self.flow.barrier_height - deposit >= 0.5 * self.flow.depth;
        hits.then(|| (push - without) / (once - without))
    }
}

/// Depth of the deposit that a surge of a start finds at the barrier (m).
fn deposit_before(start: &Start, number: usize) -> f64 {
    number.checked_sub(1).map_or(0.0, |before| start.surges[before].one(&incoming::DEPOSIT))
}

/// The push (N) of a surge of a start, counted from 0, as it would be on the empty barrier with the λ that it shows; nothing where it shows
/// none. `led` is the design led by it.
pub fn push_on_empty(led: &Design, start: &Start, number: usize) -> Option<f64> {
    let Some(seen) = start.surges.get(number).filter(|_| number > 0) else {
        return Some(start.first_surge().one(&total_force::PUSH));
    };
    let equations = Equations::of(led, 0);
    let lambda = equations.lambda(deposit_before(start, number), seen.one(&total_force::PUSH))?;
    Some(equations.force(0.0, lambda))
}

fn stage(design: &Design, simulated: &Simulated, number: usize) -> SurgeResult {
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
    let equations = Equations::of(design, number);
    let flow = equations.flow;
    let before = over(&|start| deposit_before(start, number));
    let lambda =
        |start: &Start| equations.lambda(deposit_before(start, number), start.surges[number].one(&total_force::PUSH));
    let lambda: Option<Vec<f64>> = starts.iter().map(lambda).collect();
    let added = |start: &Start| {
        let stroke = |surge: usize| most(&start.surges[surge], &dissipator::STROKE).unwrap_or(0.0);
        stroke(number) - number.checked_sub(1).map_or(0.0, stroke)
    };
    SurgeResult {
        volume: design.flow.alone(number).volume(),
        depth: flow.depth,
        velocity: flow.velocity,
        guideline: equations.force(before.mean, flow.dynamic_pressure),
        before,
        after: one(&incoming::DEPOSIT),
        force: one(&total_force::PUSH),
        level: one(&run_up::LEVEL),
        rope: largest(&rope_tension::PEAK),
        net: known(&other_ropes::NET).filter(|net| net.mean > 0.0),
        anchor: largest(&anchor_load::PEAK),
        stroke: largest(&dissipator::STROKE).map(|in_all| [in_all, over(&added)]),
        lost: over(&|start| start.surges[number].lost().iter().sum::<f64>()),
        lambda: lambda.map(|lambda| Spread::of(&lambda)),
        lambda_measured: known(&earth_pressure::DYNAMIC),
        k_at_rest: known(&earth_pressure::AT_REST),
    }
}
