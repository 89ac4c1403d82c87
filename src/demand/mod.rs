//! What the barrier must bear: the only place where the two load routes, guideline and simulation, meet.

pub(crate) mod coefficients;
pub mod from_histories;
pub mod from_loads;
pub(crate) mod larger;

use self::from_histories::Observed;
use self::from_loads::{Guideline, RopeLoad};
pub use self::larger::larger;
use crate::design::Factors;
use crate::starts::Spread;

/// One quantity by both routes; a route that says nothing about it is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Demand {
    pub guideline: Option<f64>,
    pub simulation: Option<f64>,
    /// Of the simulation of the characteristic flow, without partial factors, where loads carry one; for information.
    pub characteristic: Option<f64>,
    /// What the simulation's demand cannot exceed while a dissipator that caps it has stroke left; absent where none does, and
    /// where one is used up.
    pub cap: Option<f64>,
}

impl Demand {
    /// The larger of the two; NaN if either is.
    pub fn largest(&self) -> Option<f64> {
        self.guideline.into_iter().chain(self.simulation).reduce(larger)
    }
}

/// Demands for every check, under factored actions. Lists go from the lowest main rope to the highest.
///
/// Guideline and simulation follow one rule: the partial factor is on the action, so that what yields, stretches or is used up does
/// so under the factored load. The guideline's rope states are computed under factored pressures; the simulation runs the factored
/// flow beside the characteristic one ([`crate::load_cases`]). Where the response is proportional to the action, as on a rigid
/// wall, the characteristic result times the factor is the same. A dissipator that yields pulls with its plateau times the
/// overstrength: what is beyond the plateau is added to the load of its rope and anchor, by both routes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demands {
    /// N
    pub total_force: Demand,
    /// Of a wall that stands by its weight, per width: by the guideline the load along the bed and its moment about the upstream end of
    /// the base (N/m, N m/m); of the simulation what slides the wall along its base and what tips it, lift included.
    pub wall_sliding: Demand,
    pub wall_overturning: Demand,
    /// Likewise what presses on its base beside its weight, per width: by the guideline the load along the bed (N/m).
    pub wall_press: Demand,
    /// Normal to the face of a wall, on the metre that takes the most, per width (N/m).
    pub wall_local: Demand,
    /// About the foot of a wall, per width (N m/m).
    pub wall_moment: Demand,
    /// N
    pub rope_tension: Vec<Demand>,
    /// N
    pub anchor_force: Vec<Demand>,
    /// On what holds the lowest rope to the bed, in all (N).
    pub bed_force: Demand,
    /// On the worst bolt of the lowest rope (N).
    pub bolt_force: Demand,
    /// Tension of the dissipators, without overstrength (N).
    pub brake_force: Demand,
    /// m
    pub brake_stroke: Vec<Demand>,
    /// N
    pub net_tension: Demand,
    /// N
    pub lateral_tension: Demand,
    /// Pieces of rope that broke, and the largest permanent elongation of one: of the worst start.
    pub broken_pieces: Demand,
    pub drawn_out: Demand,
    /// Share of the mass held, the smaller of the characteristic and the factored case.
    pub retained: Demand,
    /// Final over initial height, likewise.
    pub residual_height: Demand,
}

/// What the simulations showed, packing by packing.
#[derive(Clone, Debug, Default)]
pub struct Seen<'a> {
    /// The flow as it is.
    pub characteristic: Vec<&'a Observed>,
    /// The flow with factored actions, where that was simulated; else forces are proportional to the action.
    pub factored: Vec<&'a Observed>,
}

impl Seen<'_> {
    /// The case that forces and strokes are designed for, and the factor that is still to be put on its forces.
    fn governing(&self, load_factor: f64) -> (&[&Observed], f64) {
        if self.factored.is_empty() { (&self.characteristic, load_factor) } else { (&self.factored, 1.0) }
    }
}

type Quantity<'q> = &'q dyn Fn(&Observed) -> f64;

fn spread(observed: &[&Observed], quantity: Quantity) -> Option<Spread> {
    (!observed.is_empty()).then(|| Spread::of(&observed.iter().map(|seen| quantity(seen)).collect::<Vec<_>>()))
}

impl Demands {
    /// By the equations alone.
    pub fn by_equations(guideline: &Guideline, factors: &Factors) -> Self {
        Self::meet(guideline, &Seen::default(), factors)
    }

    /// With several packings a demand is the value that the next one exceeds (or, for what must be kept, falls below) with a
    /// probability of 5 %; what a dissipator caps stays at its cap as long as no packing has gone beyond.
    pub fn meet(guideline: &Guideline, seen: &Seen, factors: &Factors) -> Self {
        let (governing, factor) = seen.governing(factors.load);
        let meeting = Meeting { guideline, seen, governing, factor, overstrength: factors.overstrength };
        let simulated = |simulation: Option<f64>| Demand { simulation, ..Demand::default() };
        let worst = |quantity: Quantity| governing.iter().map(|seen| quantity(seen)).reduce(larger);
        let by_guideline = |value: f64| Some(factors.load * value);
        Self {
            total_force: meeting.force(by_guideline(guideline.face_force), &|seen| seen.force_peak),
            wall_sliding: meeting.force(by_guideline(guideline.metre_force), &|seen| seen.wall_sliding_peak),
            wall_overturning: meeting.force(by_guideline(guideline.foot_moment), &|seen| seen.wall_overturning_peak),
            wall_press: meeting.force(by_guideline(guideline.metre_force), &|seen| seen.wall_press_peak),
            wall_local: meeting.force(by_guideline(guideline.metre_force / libm::cos(guideline.lean)), &|seen| {
                seen.force_peak / guideline.width
            }),
            wall_moment: meeting.force(by_guideline(guideline.foot_moment), &|seen| seen.moment_peak),
            rope_tension: meeting.by_rope(&RopeQuantity {
                guideline: |rope| rope.state.tension,
                observed: |seen| &seen.rope_tension_peak,
                capped: false,
            }),
            anchor_force: meeting.by_rope(&RopeQuantity {
                guideline: |rope| rope.state.tension,
                observed: |seen| &seen.anchor_force_peak,
                capped: true,
            }),
            brake_force: Demand {
                guideline: guideline.ropes.iter().map(|rope| rope.state.tension).reduce(larger),
                // Capped at the plateau, and so judged by the largest of the packings.
                simulation: worst(&|seen| seen.brake_force_peak.iter().copied().reduce(larger).unwrap_or(0.0)),
                ..Demand::default()
            },
            brake_stroke: meeting.strokes(),
            bed_force: meeting.force(guideline.bed_force, &|seen| seen.bed_force_peak),
            bolt_force: meeting.force(guideline.bolt_force, &|seen| seen.bolt_force_peak),
            net_tension: meeting.force(None, &|seen| seen.net_tension_peak),
            lateral_tension: meeting.force(None, &|seen| seen.lateral_tension_peak),
            broken_pieces: simulated(worst(&|seen| seen.broken_pieces)),
            drawn_out: simulated(worst(&|seen| seen.drawn_out)),
            retained: meeting.kept(&|seen| seen.retained),
            residual_height: meeting.kept(&|seen| seen.residual_height),
        }
    }

    /// Leaves what the simulation says alone.
    pub fn leave_out_guideline(&mut self) {
        let single = [
            &mut self.total_force,
            &mut self.wall_sliding,
            &mut self.wall_overturning,
            &mut self.wall_press,
            &mut self.wall_local,
            &mut self.wall_moment,
            &mut self.bed_force,
            &mut self.bolt_force,
            &mut self.brake_force,
            &mut self.net_tension,
            &mut self.lateral_tension,
            &mut self.retained,
            &mut self.residual_height,
        ];
        let by_rope = [&mut self.rope_tension, &mut self.anchor_force, &mut self.brake_stroke];
        single.into_iter().chain(by_rope.into_iter().flatten()).for_each(|demand| demand.guideline = None);
    }
}

/// NaN if any is; 0 for none.
fn largest(observed: &[&Observed], quantity: Quantity) -> f64 {
    observed.iter().map(|seen| quantity(seen)).fold(0.0, larger)
}

/// What the next packing exceeds with a probability of 5 %; no more than the cap as long as no packing has gone beyond it.
fn capped(observed: &[&Observed], quantity: Quantity, cap: f64) -> Option<f64> {
    let most = largest(observed, quantity);
    let upper = spread(observed, quantity)?.upper();
    Some(if upper > cap && most <= cap * CAP_TOLERANCE { most.max(cap) } else { upper })
}

/// A quantity of every main rope by both routes.
struct RopeQuantity {
    guideline: fn(&RopeLoad) -> f64,
    observed: fn(&Observed) -> &Vec<f64>,
    /// Whether a dissipator at its plateau caps it.
    capped: bool,
}

/// Where the two routes meet.
struct Meeting<'a> {
    guideline: &'a Guideline,
    seen: &'a Seen<'a>,
    /// What the factored actions did, and the factor still to be put on its forces.
    governing: &'a [&'a Observed],
    factor: f64,
    overstrength: f64,
}

impl Meeting<'_> {
    /// Whether the characteristic values differ from those that are judged.
    fn is_factored(&self) -> bool {
        !self.seen.factored.is_empty() || self.factor != 1.0
    }

    fn characteristic(&self, quantity: Quantity) -> Option<f64> {
        spread(&self.seen.characteristic, quantity).filter(|_| self.is_factored()).map(|spread| spread.upper())
    }

    /// A force or moment; the guideline's value is factored already.
    fn force(&self, guideline: Option<f64>, quantity: Quantity) -> Demand {
        Demand {
            guideline,
            simulation: spread(self.governing, quantity).map(|spread| self.factor * spread.upper()),
            characteristic: self.characteristic(quantity),
            cap: None,
        }
    }

    /// A share that must be kept, in the characteristic and in the factored case.
    fn kept(&self, quantity: Quantity) -> Demand {
        let lower = |observed: &[&Observed]| spread(observed, quantity).map(|spread| spread.lower());
        let smaller = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) };
        let both = lower(self.governing).into_iter().chain(lower(&self.seen.characteristic));
        let characteristic = lower(&self.seen.characteristic).filter(|_| !self.seen.factored.is_empty());
        Demand { simulation: both.reduce(smaller), characteristic, ..Demand::default() }
    }

    /// What a dissipator of a rope may pull with beyond its plateau (N).
    fn excess(&self) -> f64 {
        self.guideline.dissipator.map_or(0.0, |[plateau, _]| (self.overstrength - 1.0) * plateau)
    }

    fn plateau(&self) -> f64 {
        self.guideline.dissipator.map_or(f64::INFINITY, |[plateau, _]| plateau)
    }

    /// Whether a load of this size means that a dissipator yields.
    fn yields(&self, load: f64) -> bool {
        load >= self.plateau() / CAP_TOLERANCE
    }

    fn ropes(&self, observed: fn(&Observed) -> &Vec<f64>) -> usize {
        self.governing.first().map_or(self.guideline.ropes.len(), |seen| observed(seen).len())
    }

    fn by_rope(&self, quantity: &RopeQuantity) -> Vec<Demand> {
        let observed = quantity.observed;
        let cap = if quantity.capped && self.guideline.anchors_capped { self.plateau() } else { f64::INFINITY };
        let of = |rope: usize| {
            let value = |seen: &Observed| observed(seen).get(rope).copied().unwrap_or(0.0);
            let yields = self.yields(largest(self.governing, &|seen: &Observed| {
                seen.brake_force_peak.get(rope).copied().unwrap_or(0.0)
            }));
            let excess = if yields { self.excess() } else { 0.0 };
            let most = largest(self.governing, &value);
            let within = most <= cap * CAP_TOLERANCE;
            Demand {
                guideline: self.by_equations(rope, quantity.guideline),
                simulation: capped(self.governing, &value, cap).map(|upper| self.factor * upper + excess),
                characteristic: capped(&self.seen.characteristic, &value, cap).filter(|_| self.is_factored()),
                cap: (within && cap.is_finite() && !self.governing.is_empty())
                    .then_some(self.factor * most.max(cap) + excess),
            }
        };
        (0..self.ropes(observed)).map(of).collect()
    }

    /// By the equations, with the overstrength of a dissipator that yields; nothing where they put no load on the rope.
    fn by_equations(&self, rope: usize, quantity: fn(&RopeLoad) -> f64) -> Option<f64> {
        let rope = self.guideline.ropes.get(rope).filter(|rope| rope.load > 0.0)?;
        let excess = if self.yields(rope.state.tension) { self.excess() } else { 0.0 };
        Some(quantity(rope) + excess)
    }

    /// Strokes end at their stop, whatever the scatter says.
    fn strokes(&self) -> Vec<Demand> {
        let stop = self.guideline.dissipator.map_or(f64::INFINITY, |[_, stroke]| stroke);
        let of = |rope: usize| {
            let quantity = |seen: &Observed| seen.brake_stroke[rope];
            // Asked so that what is not a number stays so.
            let stopped = |stroke: f64| if stroke > stop { stop } else { stroke };
            Demand {
                guideline: self.guideline.ropes.get(rope).filter(|rope| rope.load > 0.0).map(|rope| rope.state.stroke),
                simulation: spread(self.governing, &quantity).map(|spread| stopped(spread.upper())),
                characteristic: self.characteristic(&quantity).map(stopped),
                cap: None,
            }
        };
        (0..self.ropes(|seen| &seen.brake_stroke)).map(of).collect()
    }
}

/// Factor up to which a load counts as at its cap: rounding, and the elastic part of a dissipator, lift it a little above.
pub const CAP_TOLERANCE: f64 = 1.01;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demand::from_loads::guideline;
    use crate::design::Design;
    use crate::design::read::read_design;
    use crate::starts::k_n;
    use approx::assert_relative_eq;

    /// `small_net` with dissipators of a plateau of 100 kN.
    fn small_net() -> Design {
        let text =
            include_str!("../../designs/small_net.yaml").replace("plateau_force: 150 kN", "plateau_force: 100 kN");
        read_design("x", text.as_bytes()).unwrap().design
    }

    /// Starts on that net: its net's tension, the load of anchor 2, the share held.
    fn demands(starts: &[[f64; 3]]) -> Demands {
        let design = small_net();
        let observed: Vec<Observed> = starts
            .iter()
            .map(|&[net, anchor, retained]| Observed {
                net_tension_peak: net,
                anchor_force_peak: vec![0.0, anchor, 0.0],
                rope_tension_peak: vec![0.0; 3],
                brake_stroke: vec![0.0; 3],
                brake_force_peak: vec![anchor],
                retained,
                ..Observed::default()
            })
            .collect();
        let seen = Seen { characteristic: observed.iter().collect(), factored: Vec::new() };
        Demands::meet(&guideline(&design), &seen, &design.factors)
    }

    #[test]
    fn scatter_lifts_a_load_and_lowers_what_must_be_kept() {
        let demands = demands(&[[1e3, 1e3, 0.98], [2e3, 1e3, 0.96], [3e3, 1e3, 0.94]]);
        assert_relative_eq!(demands.net_tension.simulation.unwrap(), 2e3 + k_n(3) * 1e3, max_relative = 1e-12);
        assert_relative_eq!(demands.retained.simulation.unwrap(), 0.96 - k_n(3) * 0.02, max_relative = 1e-9);
    }

    #[test]
    fn scatter_does_not_lift_a_dissipator_above_its_plateau_unless_a_start_went_there() {
        let at_work = demands(&[[0.0, 100e3, 1.0], [0.0, 100e3, 1.0], [0.0, 40e3, 1.0]]);
        assert_eq!(at_work.anchor_force[1].simulation, Some(100e3));
        assert_eq!(at_work.brake_force.simulation, Some(100e3));
        let used_up = demands(&[[0.0, 100e3, 1.0], [0.0, 120e3, 1.0], [0.0, 100e3, 1.0]]);
        assert!(used_up.anchor_force[1].simulation.unwrap() > 120e3);
        assert_eq!(used_up.brake_force.simulation, Some(120e3));
    }

    #[test]
    fn a_start_that_is_not_a_number_is_seen() {
        let demands = demands(&[[1e3, 80e3, 1.0], [f64::NAN, f64::NAN, 1.0]]);
        assert!(demands.net_tension.simulation.unwrap().is_nan());
        assert!(demands.anchor_force[1].simulation.unwrap().is_nan());
        assert!(demands.brake_force.simulation.unwrap().is_nan());
    }

    #[test]
    fn nothing_of_the_guideline_is_left_where_the_simulation_alone_is_asked() {
        let mut demands = demands(&[[1e3, 1e3, 1.0]]);
        demands.leave_out_guideline();
        // Written out, so that a demand added later is not forgotten: it stands in the text of all of them.
        assert!(!format!("{demands:?}").contains("guideline: Some"), "{demands:?}");
    }

    /// Worked by hand on that net: plateau 100 kN, overstrength 1.25, a factor of 1.5 on loads whose case is simulated.
    #[test]
    fn the_factored_case_gives_forces_and_strokes_and_the_worse_case_what_is_kept() {
        let mut design = small_net();
        (design.factors.load, design.factors.overstrength) = (1.5, 1.25);
        let seen = |net: f64, anchor: f64, stroke: f64, retained: f64| Observed {
            net_tension_peak: net,
            anchor_force_peak: vec![0.0, anchor, 30e3],
            rope_tension_peak: vec![0.0, 70e3, 40e3],
            brake_stroke: vec![0.0, stroke, 0.0],
            brake_force_peak: vec![0.0, anchor, 30e3],
            retained,
            residual_height: retained,
            ..Observed::default()
        };
        let (characteristic, factored) = (seen(20e3, 60e3, 0.0, 0.97), seen(26e3, 100e3, 0.3, 0.95));
        let both = Seen { characteristic: vec![&characteristic], factored: vec![&factored] };
        let demands = Demands::meet(&guideline(&design), &both, &design.factors);
        // Forces and strokes as the factored flow makes them, never multiplied again.
        assert_eq!(demands.net_tension.simulation, Some(26e3));
        assert_eq!(demands.net_tension.characteristic, Some(20e3));
        assert_eq!(demands.brake_stroke[1].simulation, Some(0.3));
        // Where a dissipator yields, a quarter of its plateau comes on top of anchor and rope; where it does not, nothing.
        assert_eq!(demands.anchor_force[1].simulation, Some(100e3 + 25e3));
        assert_eq!(demands.rope_tension[1].simulation, Some(70e3 + 25e3));
        assert_eq!(demands.anchor_force[2].simulation, Some(30e3));
        assert_eq!(demands.retained.simulation, Some(0.95));
        // By the equations the same, on top of the tension under the factored load.
        let tension = guideline(&design).ropes[1].state.tension;
        let beyond = if tension >= 99.1e3 { 25e3 } else { 0.0 };
        assert_eq!(demands.anchor_force[1].guideline, Some(tension + beyond));
        // Without a simulation of its own the factored case is proportional, as on a rigid wall.
        let alone = Seen { characteristic: vec![&characteristic], factored: Vec::new() };
        let demands = Demands::meet(&guideline(&design), &alone, &design.factors);
        assert_eq!(demands.net_tension.simulation, Some(30e3));
        assert_eq!(demands.retained.simulation, Some(0.97));
    }

    #[test]
    fn the_simulation_s_answer_is_without_the_equations() {
        let design = small_net();
        let mut demands = Demands::by_equations(&guideline(&design), &design.factors);
        assert!(demands.total_force.guideline.is_some() && demands.rope_tension[1].guideline.is_some());
        demands.leave_out_guideline();
        let single = [demands.total_force, demands.bed_force, demands.bolt_force, demands.brake_force];
        let by_rope = [&demands.rope_tension, &demands.anchor_force, &demands.brake_stroke];
        assert!(single.iter().chain(by_rope.into_iter().flatten()).all(|demand| demand.guideline.is_none()));
        assert!(demands.wall_sliding.guideline.is_none() && demands.wall_overturning.guideline.is_none());
    }

    #[test]
    fn without_a_factor_nothing_is_told_apart_as_characteristic() {
        let alone = demands(&[[1e3, 1e3, 0.9]]);
        assert_eq!((alone.net_tension.characteristic, alone.anchor_force[1].characteristic), (None, None));
        assert_eq!(alone.retained.characteristic, None);
        let seen = |net: f64| Observed { net_tension_peak: net, ..Observed::of_ropes(3) };
        let [one, two] = [seen(1e3), seen(2e3)];
        let both = Seen { characteristic: vec![&one], factored: vec![&two] };
        let design = small_net();
        let met = Demands::meet(&guideline(&design), &both, &design.factors);
        assert_eq!((met.net_tension.simulation, met.net_tension.characteristic), (Some(2e3), Some(1e3)));
        assert_eq!(met.retained.characteristic, Some(1.0));
    }

    #[test]
    fn a_share_that_is_not_a_number_in_either_case_is_none() {
        let design = small_net();
        let seen = |retained: f64| Observed { retained, ..Observed::of_ropes(3) };
        for (one, other) in [(0.9, f64::NAN), (f64::NAN, 0.9)] {
            let [one, other] = [seen(one), seen(other)];
            let both = Seen { characteristic: vec![&one], factored: vec![&other] };
            let met = Demands::meet(&guideline(&design), &both, &design.factors);
            assert!(met.retained.simulation.is_some_and(f64::is_nan));
        }
    }

    /// A plateau of 100 kN, and half a percent more than it in one of three packings.
    #[test]
    fn what_a_dissipator_caps_says_so_as_long_as_none_is_used_up() {
        let capped = demands(&[[0.0, 100.5e3, 1.0], [0.0, 100e3, 1.0], [0.0, 40e3, 1.0]]).anchor_force[1];
        assert_eq!((capped.simulation, capped.cap), (Some(100.5e3), Some(100.5e3)));
        let idle = demands(&[[0.0, 60e3, 1.0]]).anchor_force[1];
        assert_eq!(idle.cap, Some(100e3));
        let used_up = demands(&[[0.0, 120e3, 1.0]]);
        assert_eq!(used_up.anchor_force[1].cap, None);
        // The rope itself is pulled beside its dissipators as well.
        assert_eq!(used_up.rope_tension[1].cap, None);
        assert_eq!(demands(&[[0.0, 60e3, 1.0]]).rope_tension[1].cap, None);
        // Nothing was simulated.
        let design = small_net();
        assert_eq!(Demands::by_equations(&guideline(&design), &design.factors).anchor_force[1].cap, None);
        // With a factor of 1.5 and an overstrength of 1.25: 1.5 · 100 + 0.25 · 100.
        let mut design = small_net();
        (design.factors.load, design.factors.overstrength) = (1.5, 1.25);
        let seen = Observed {
            anchor_force_peak: vec![0.0, 100e3, 0.0],
            brake_force_peak: vec![0.0, 100e3, 0.0],
            ..Observed::of_ropes(3)
        };
        let alone = Seen { characteristic: vec![&seen], factored: Vec::new() };
        let met = Demands::meet(&guideline(&design), &alone, &design.factors);
        assert_eq!(met.anchor_force[1].cap, Some(175e3));
        // With the lateral ropes at the anchors nothing caps their load.
        let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.lateral_to = crate::design::LateralTo::Anchors;
        let met = Demands::meet(&guideline(&design), &alone, &design.factors);
        assert_eq!(met.anchor_force[1].cap, None);
    }

    /// Strokes of 0.9, 0.5 and 0.7 m scatter to 1.4 m; the stop is at 1 m. One that is not a number stays so.
    #[test]
    fn a_stroke_scatters_no_further_than_its_stop() {
        let mut design = small_net();
        let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.dissipators.as_mut().expect("dissipators").stroke = 1.0;
        let stroke = |values: &[f64]| {
            let seen: Vec<Observed> = values
                .iter()
                .map(|stroke| Observed { brake_stroke: vec![0.0, *stroke, 0.0], ..Observed::of_ropes(3) })
                .collect();
            let seen = Seen { characteristic: seen.iter().collect(), factored: Vec::new() };
            let met = Demands::meet(&guideline(&design), &seen, &design.factors);
            met.brake_stroke[1].simulation.expect("a stroke")
        };
        assert_eq!(stroke(&[0.9, 0.5, 0.7]), 1.0);
        assert_eq!(stroke(&[0.5]), 0.5);
        assert!(stroke(&[f64::NAN]).is_nan());
    }

    #[test]
    fn a_rope_that_the_equations_do_not_load_has_no_demand_of_theirs() {
        let design = small_net();
        let mut guideline = guideline(&design);
        guideline.ropes[2].load = 0.0;
        let met = Demands::by_equations(&guideline, &design.factors);
        assert_eq!((met.rope_tension[2].guideline, met.brake_stroke[2].guideline), (None, None));
        assert!(met.rope_tension[1].guideline.is_some());
    }

    #[test]
    fn what_broke_or_drew_out_is_that_of_the_worst_packing() {
        let design = small_net();
        let seen = |broken_pieces: f64, drawn_out: f64| Observed { broken_pieces, drawn_out, ..Observed::of_ropes(3) };
        let [one, other] = [seen(2.0, 0.1), seen(0.0, 0.3)];
        let both = Seen { characteristic: vec![&one, &other], factored: Vec::new() };
        let met = Demands::meet(&guideline(&design), &both, &design.factors);
        assert_eq!((met.broken_pieces.simulation, met.drawn_out.simulation), (Some(2.0), Some(0.3)));
    }

    /// 600 kN on a wall of 15.2 m, by a factor of 1.35: 53.3 kN on each metre.
    #[test]
    fn a_metre_of_a_wall_takes_its_share_of_what_is_simulated() {
        let mut design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        (design.factors.load, design.channel.width) = (1.35, 15.2);
        let observed = Observed { force_peak: 600e3, ..Observed::default() };
        let seen = Seen { characteristic: vec![&observed], factored: Vec::new() };
        let demands = Demands::meet(&guideline(&design), &seen, &design.factors);
        assert_relative_eq!(demands.wall_local.simulation.unwrap(), 1.35 * 600e3 / 15.2, max_relative = 1e-12);
    }
}
