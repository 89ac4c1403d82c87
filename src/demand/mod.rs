//! What the barrier must bear: the only place where the two load routes, guideline and simulation, meet.

mod meeting;
mod value;

use std::collections::BTreeMap;

use self::meeting::Meeting;
pub use self::meeting::{CAP_TOLERANCE, USED_UP};
pub use self::value::{Demand, SimulatedRuns};
use crate::design::Factors;
use crate::guideline::Guideline;
use crate::larger::larger_or_nan;
use crate::quantities::QUANTITIES;
use crate::quantities::quantity::{Demanded, Quantity};

/// Demands for every check, under factored actions. Lists go from the lowest main rope to the highest.
///
/// Guideline and simulation follow one rule: the partial factor is on the action, so that what yields, stretches or is used up does
/// so under the factored load. The guideline's rope states are computed under factored pressures; the simulation runs the factored
/// flow beside the characteristic one ([`crate::flow_cases`]). Where the response is proportional to the action, as on a rigid
/// wall, the characteristic result times the factor is the same. A dissipator that yields pulls with its plateau times the
/// overstrength: what is beyond the plateau is added to the load of its rope and anchor, by both routes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demands(BTreeMap<&'static str, Vec<Demand>>);

impl Demands {
    /// By the equations alone.
    pub fn by_equations(guideline: &Guideline, factors: &Factors) -> Self {
        Self::meet(guideline, &SimulatedRuns::default(), factors)
    }

    /// With several packings a demand is the value that the next one exceeds (or, for what must be kept, falls below) with a
    /// probability of 5 %; what a dissipator caps stays at its cap as long as no packing has gone beyond.
    pub fn meet(guideline: &Guideline, seen: &SimulatedRuns, factors: &Factors) -> Self {
        let (governing, factor) = seen.governing(factors.load);
        let meeting = Meeting { guideline, factors, seen, governing, factor };
        let weakest = guideline.with_weakest_dissipators();
        let weak = (!seen.weak.is_empty()).then(|| Meeting {
            guideline: &weakest,
            factors,
            seen,
            governing: &seen.weak,
            factor: 1.0,
        });
        let demanded = QUANTITIES.iter().filter(|quantity| quantity.demanded.is_some());
        let demands = |quantity: &Quantity| {
            let mut demands = meeting.demands(quantity);
            if !matches!(quantity.demanded, Some(Demanded::Kept)) {
                // The flow as it is may load a part more than the heavier one, which comes another way.
                let both = |demand: &Demand| demand.simulation.into_iter().chain(demand.characteristic);
                demands.iter_mut().for_each(|demand| demand.simulation = both(demand).reduce(larger_or_nan));
            }
            if let Some(weak) = &weak {
                let least = matches!(quantity.demanded, Some(Demanded::Kept));
                for (demand, other) in demands.iter_mut().zip(weak.demands(quantity)) {
                    *demand = demand.or_worse(&other, least);
                }
            }
            (quantity.id, demands)
        };
        Self(demanded.map(|quantity| demands(quantity)).collect())
    }

    /// The demand of a quantity of the barrier as a whole.
    pub fn one(&self, quantity: &Quantity) -> Demand {
        self.each(quantity).first().copied().unwrap_or_default()
    }

    /// The demands of a quantity of each main rope, from the lowest to the highest.
    pub fn each(&self, quantity: &Quantity) -> &[Demand] {
        self.0.get(quantity.id).map_or(&[], Vec::as_slice)
    }

    /// The same with other demands for a quantity.
    pub fn with(mut self, quantity: &Quantity, demands: &[Demand]) -> Self {
        self.0.insert(quantity.id, demands.to_vec());
        self
    }

    /// Leaves what the simulation says alone.
    pub fn leave_out_guideline(&mut self) {
        self.0.values_mut().flatten().for_each(|demand| demand.guideline = None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use crate::quantities::counts::Counts;
    use crate::quantities::observed::Observed;
    use crate::quantities::{
        anchor_load, bed, dissipator, height, mass, other_ropes, rope_damage, rope_tension, total_force, wall,
    };
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
        let mut design = small_net();
        design.factors.overstrength = 1.0;
        let observed: Vec<Observed> = starts
            .iter()
            .map(|&[net, anchor, retained]| {
                Observed::of_nothing(Counts::default())
                    .with(&other_ropes::NET, &[net])
                    .with(&anchor_load::PEAK, &[0.0, anchor, 0.0])
                    .with(&rope_tension::PEAK, &[0.0; 3])
                    .with(&dissipator::STROKE, &[0.0; 3])
                    .with(&dissipator::TENSION, &[0.0, anchor, 0.0])
                    .with(&mass::RETAINED, &[retained])
            })
            .collect();
        let seen = SimulatedRuns { characteristic: observed.iter().collect(), ..SimulatedRuns::default() };
        Demands::meet(&guideline(&design), &seen, &design.factors)
    }

    #[test]
    fn scatter_lifts_a_load_and_lowers_what_must_be_kept() {
        let demands = demands(&[[1e3, 1e3, 0.98], [2e3, 1e3, 0.96], [3e3, 1e3, 0.94]]);
        assert_relative_eq!(
            demands.one(&other_ropes::NET).simulation.unwrap(),
            2e3 + k_n(3) * 1e3,
            max_relative = 1e-12
        );
        assert_relative_eq!(
            demands.one(&mass::RETAINED).simulation.unwrap(),
            0.96 - k_n(3) * 0.02,
            max_relative = 1e-9
        );
    }

    #[test]
    fn scatter_does_not_lift_a_dissipator_above_its_plateau_unless_a_start_went_there() {
        let at_work = demands(&[[0.0, 100e3, 1.0], [0.0, 100e3, 1.0], [0.0, 40e3, 1.0]]);
        assert_eq!(at_work.each(&anchor_load::PEAK)[1].simulation, Some(100e3));
        assert_eq!(at_work.one(&dissipator::TENSION).simulation, Some(100e3));
        let used_up = demands(&[[0.0, 100e3, 1.0], [0.0, 120e3, 1.0], [0.0, 100e3, 1.0]]);
        assert!(used_up.each(&anchor_load::PEAK)[1].simulation.unwrap() > 120e3);
        assert_eq!(used_up.one(&dissipator::TENSION).simulation, Some(120e3));
    }

    #[test]
    fn a_start_that_is_not_a_number_is_seen() {
        let demands = demands(&[[1e3, 80e3, 1.0], [f64::NAN, f64::NAN, 1.0]]);
        assert!(demands.one(&other_ropes::NET).simulation.unwrap().is_nan());
        assert!(demands.each(&anchor_load::PEAK)[1].simulation.unwrap().is_nan());
        assert!(demands.one(&dissipator::TENSION).simulation.unwrap().is_nan());
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
        let seen = |net: f64, anchor: f64, stroke: f64, retained: f64| {
            Observed::of_nothing(Counts::default())
                .with(&other_ropes::NET, &[net])
                .with(&anchor_load::PEAK, &[0.0, anchor, 30e3])
                .with(&rope_tension::PEAK, &[0.0, 70e3, 40e3])
                .with(&dissipator::STROKE, &[0.0, stroke, 0.0])
                .with(&dissipator::TENSION, &[0.0, anchor, 30e3])
                .with(&mass::RETAINED, &[retained])
                .with(&height::RESIDUAL, &[retained])
        };
        let (characteristic, factored) = (seen(20e3, 60e3, 0.0, 0.97), seen(26e3, 100e3, 0.3, 0.95));
        let both = SimulatedRuns {
            characteristic: vec![&characteristic],
            factored: vec![&factored],
            ..SimulatedRuns::default()
        };
        let demands = Demands::meet(&guideline(&design), &both, &design.factors);
        // Forces and strokes as the factored flow makes them, never multiplied again.
        assert_eq!(demands.one(&other_ropes::NET).simulation, Some(26e3));
        assert_eq!(demands.one(&other_ropes::NET).characteristic, Some(20e3));
        assert_eq!(demands.each(&dissipator::STROKE)[1].simulation, Some(0.3));
        // Where a dissipator yields, a quarter of its plateau comes on top of anchor and rope; where it does not, nothing.
        assert_eq!(demands.each(&anchor_load::PEAK)[1].simulation, Some(100e3 + 25e3));
        assert_eq!(demands.each(&rope_tension::PEAK)[1].simulation, Some(70e3 + 25e3));
        assert_eq!(demands.each(&anchor_load::PEAK)[2].simulation, Some(30e3));
        assert_eq!(demands.one(&mass::RETAINED).simulation, Some(0.95));
        // By the equations the same, on top of the tension under the factored load.
        let tension = guideline(&design).ropes[1].state.tension;
        let beyond = if tension >= 99.1e3 { 25e3 } else { 0.0 };
        assert_eq!(demands.each(&anchor_load::PEAK)[1].guideline, Some(tension + beyond));
        // Without a simulation of its own the factored case is proportional, as on a rigid wall.
        let alone = SimulatedRuns { characteristic: vec![&characteristic], ..SimulatedRuns::default() };
        let demands = Demands::meet(&guideline(&design), &alone, &design.factors);
        assert_eq!(demands.one(&other_ropes::NET).simulation, Some(30e3));
        assert_eq!(demands.one(&mass::RETAINED).simulation, Some(0.97));
    }

    #[test]
    fn the_simulation_s_answer_is_without_the_equations() {
        let design = small_net();
        let mut demands = Demands::by_equations(&guideline(&design), &design.factors);
        let loaded =
            [&total_force::PEAK, &rope_tension::PEAK, &bed::FORCE, &bed::BOLT, &dissipator::TENSION, &wall::SLIDING];
        let told = |demands: &Demands| {
            loaded.map(|quantity| demands.each(quantity).iter().any(|demand| demand.guideline.is_some()))
        };
        assert_eq!(told(&demands), [true; 6]);
        demands.leave_out_guideline();
        assert_eq!(told(&demands), [false; 6]);
    }

    #[test]
    fn without_a_factor_nothing_is_told_apart_as_characteristic() {
        let alone = demands(&[[1e3, 1e3, 0.9]]);
        assert_eq!(
            (alone.one(&other_ropes::NET).characteristic, alone.each(&anchor_load::PEAK)[1].characteristic),
            (None, None)
        );
        assert_eq!(alone.one(&mass::RETAINED).characteristic, None);
        let seen =
            |net: f64| Observed::of_nothing(Counts { ropes: 3, ..Counts::default() }).with(&other_ropes::NET, &[net]);
        let [one, two] = [seen(1e3), seen(2e3)];
        let both = SimulatedRuns { characteristic: vec![&one], factored: vec![&two], ..SimulatedRuns::default() };
        let design = small_net();
        let met = Demands::meet(&guideline(&design), &both, &design.factors);
        assert_eq!(
            (met.one(&other_ropes::NET).simulation, met.one(&other_ropes::NET).characteristic),
            (Some(2e3), Some(1e3))
        );
        assert_eq!(met.one(&mass::RETAINED).characteristic, Some(1.0));
    }

    #[test]
    fn a_share_that_is_not_a_number_in_either_case_is_none() {
        let design = small_net();
        let seen = |retained: f64| {
            Observed::of_nothing(Counts { ropes: 3, ..Counts::default() }).with(&mass::RETAINED, &[retained])
        };
        for (one, other) in [(0.9, f64::NAN), (f64::NAN, 0.9)] {
            let [one, other] = [seen(one), seen(other)];
            let both = SimulatedRuns { characteristic: vec![&one], factored: vec![&other], ..SimulatedRuns::default() };
            let met = Demands::meet(&guideline(&design), &both, &design.factors);
            assert!(met.one(&mass::RETAINED).simulation.is_some_and(f64::is_nan));
        }
    }

    /// A plateau of 100 kN, and half a percent more than it in one of three packings.
    #[test]
    fn what_a_dissipator_caps_says_so_as_long_as_none_is_used_up() {
        let capped = demands(&[[0.0, 100.5e3, 1.0], [0.0, 100e3, 1.0], [0.0, 40e3, 1.0]]).each(&anchor_load::PEAK)[1];
        assert_eq!((capped.simulation, capped.cap), (Some(100.5e3), Some(100.5e3)));
        let idle = demands(&[[0.0, 60e3, 1.0]]).each(&anchor_load::PEAK)[1];
        assert_eq!(idle.cap, Some(100e3));
        let used_up = demands(&[[0.0, 120e3, 1.0]]);
        assert_eq!(used_up.each(&anchor_load::PEAK)[1].cap, None);
        // The rope itself is pulled beside its dissipators as well.
        assert_eq!(used_up.each(&rope_tension::PEAK)[1].cap, None);
        assert_eq!(demands(&[[0.0, 60e3, 1.0]]).each(&rope_tension::PEAK)[1].cap, None);
        // Nothing was simulated.
        let design = small_net();
        assert_eq!(Demands::by_equations(&guideline(&design), &design.factors).each(&anchor_load::PEAK)[1].cap, None);
        // With a factor of 1.5 and an overstrength of 1.25: 1.5 · 100 + 0.25 · 100.
        let mut design = small_net();
        (design.factors.load, design.factors.overstrength) = (1.5, 1.25);
        let seen = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
            .with(&anchor_load::PEAK, &[0.0, 100e3, 0.0])
            .with(&dissipator::TENSION, &[0.0, 100e3, 0.0]);
        let alone = SimulatedRuns { characteristic: vec![&seen], ..SimulatedRuns::default() };
        let met = Demands::meet(&guideline(&design), &alone, &design.factors);
        assert_eq!(met.each(&anchor_load::PEAK)[1].cap, Some(175e3));
        // With the lateral ropes at the anchors nothing caps their load.
        let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.lateral_to = crate::design::LateralTo::Anchors;
        let met = Demands::meet(&guideline(&design), &alone, &design.factors);
        assert_eq!(met.each(&anchor_load::PEAK)[1].cap, None);
    }

    /// Along a curve that falls from 100 to 40 kN over 1 m: at its end nothing caps the anchor, and from 40 kN on it may yield, so that overstrength
    /// comes on top.
    #[test]
    fn a_curve_caps_while_stroke_is_left_and_yields_from_its_least_force_on() {
        let mut design = small_net();
        design.factors.overstrength = 1.25;
        let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        let given = net.dissipators.as_mut().expect("dissipators");
        let (curve, [plateau, stroke]) = crate::yield_curve::YieldCurve::of(&[[0.0, 100e3], [1.0, 40e3]]);
        (given.curve, given.plateau, given.stroke) = (curve, plateau, stroke);
        let met = |tension: f64, stroke: f64| {
            let seen = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
                .with(&anchor_load::PEAK, &[0.0, tension, 0.0])
                .with(&dissipator::TENSION, &[0.0, tension, 0.0])
                .with(&dissipator::STROKE, &[0.0, stroke, 0.0]);
            let seen = SimulatedRuns { characteristic: vec![&seen], ..SimulatedRuns::default() };
            Demands::meet(&guideline(&design), &seen, &design.factors).each(&anchor_load::PEAK)[1]
        };
        assert_eq!((met(60e3, 0.5).simulation, met(60e3, 0.5).cap), (Some(85e3), Some(125e3)));
        assert_eq!((met(60e3, 1.0).simulation, met(60e3, 1.0).cap), (Some(85e3), None));
        assert_eq!(met(30e3, 0.0).simulation, Some(30e3));
        assert_eq!(met(60e3, f64::NAN).cap, None);
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
                .map(|stroke| {
                    Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
                        .with(&dissipator::STROKE, &[0.0, *stroke, 0.0])
                })
                .collect();
            let seen = SimulatedRuns { characteristic: seen.iter().collect(), ..SimulatedRuns::default() };
            let met = Demands::meet(&guideline(&design), &seen, &design.factors);
            met.each(&dissipator::STROKE)[1].simulation.expect("a stroke")
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
        assert_eq!(
            (met.each(&rope_tension::PEAK)[2].guideline, met.each(&dissipator::STROKE)[2].guideline),
            (None, None)
        );
        assert!(met.each(&rope_tension::PEAK)[1].guideline.is_some());
    }

    #[test]
    fn what_broke_or_drew_out_is_that_of_the_worst_packing() {
        let design = small_net();
        let seen = |broken_pieces: f64, drawn_out: f64| {
            Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
                .with(&rope_damage::BROKEN, &[broken_pieces])
                .with(&rope_damage::DRAWN_OUT, &[drawn_out])
        };
        let [one, other] = [seen(2.0, 0.1), seen(0.0, 0.3)];
        let both = SimulatedRuns { characteristic: vec![&one, &other], ..SimulatedRuns::default() };
        let met = Demands::meet(&guideline(&design), &both, &design.factors);
        assert_eq!(
            (met.one(&rope_damage::BROKEN).simulation, met.one(&rope_damage::DRAWN_OUT).simulation),
            (Some(2.0), Some(0.3))
        );
    }

    /// 600 kN on a wall of 15.2 m, by a factor of 1.35: 53.3 kN on each metre.
    #[test]
    fn a_metre_of_a_wall_takes_its_share_of_what_is_simulated() {
        let mut design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        (design.factors.load, design.channel.width) = (1.35, 15.2);
        let observed = Observed::of_nothing(Counts::default()).with(&total_force::ON_A_METRE, &[600e3 / 15.2]);
        let seen = SimulatedRuns { characteristic: vec![&observed], ..SimulatedRuns::default() };
        let demands = Demands::meet(&guideline(&design), &seen, &design.factors);
        assert_relative_eq!(
            demands.one(&total_force::ON_A_METRE).simulation.unwrap(),
            1.35 * 600e3 / 15.2,
            max_relative = 1e-12
        );
    }

    /// Weaker dissipators pay out more and, used up, pull more: of loads and strokes the larger counts, of the mass held the smaller; by the
    /// equations the stroke is that of the weaker ones.
    #[test]
    fn the_worse_of_both_bounds_of_a_dissipator_counts() {
        let mut design = small_net();
        let by_equations = |design: &Design| {
            Demands::by_equations(&guideline(design), &design.factors).each(&dissipator::STROKE)[1].guideline
        };
        let nominal = by_equations(&design).expect("a stroke");
        let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.dissipators.as_mut().expect("dissipators").lower_bound = Some(0.8);
        assert!(by_equations(&design).expect("a stroke") > nominal);
        let run = |stroke: f64, tension: f64, held: f64| {
            Observed::of_nothing(Counts { ropes: 3, ..Counts::default() })
                .with(&dissipator::STROKE, &[0.0, stroke, 0.0])
                .with(&other_ropes::NET, &[tension])
                .with(&mass::RETAINED, &[held])
        };
        let (usual, weak) = (run(0.2, 9e3, 0.99), run(0.5, 7e3, 0.97));
        let seen = SimulatedRuns { characteristic: vec![&usual], weak: vec![&weak], ..SimulatedRuns::default() };
        let met = Demands::meet(&guideline(&design), &seen, &design.factors);
        assert_eq!(met.each(&dissipator::STROKE)[1].simulation, Some(0.5));
        assert_eq!(met.one(&other_ropes::NET).simulation, Some(9e3));
        assert_eq!(met.one(&mass::RETAINED).simulation, Some(0.97));
        let lost = run(f64::NAN, 7e3, f64::NAN);
        let seen = SimulatedRuns { characteristic: vec![&usual], weak: vec![&lost], ..SimulatedRuns::default() };
        let met = Demands::meet(&guideline(&design), &seen, &design.factors);
        assert!(met.each(&dissipator::STROKE)[1].simulation.is_some_and(f64::is_nan));
        assert!(met.one(&mass::RETAINED).simulation.is_some_and(f64::is_nan));
    }
}
