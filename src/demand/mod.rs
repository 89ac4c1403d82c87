//! What the barrier must bear: the only place where the two load routes, guideline and simulation, meet.

pub mod coefficients;
pub mod from_histories;
pub mod from_loads;

use self::from_histories::Observed;
use self::from_loads::Guideline;
use crate::starts::Spread;

/// One quantity by both routes; a route that says nothing about it is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Demand {
    pub guideline: Option<f64>,
    pub simulation: Option<f64>,
    /// What the simulation's demand cannot exceed while a dissipator that caps it has stroke left; absent where none does, and
    /// where one is used up.
    pub cap: Option<f64>,
}

impl Demand {
    /// The larger of the two; NaN if either is.
    pub fn largest(&self) -> Option<f64> {
        self.guideline.into_iter().chain(self.simulation).reduce(larger)
    }

    /// Both multiplied by a partial factor.
    pub fn times(&self, factor: f64) -> Self {
        let [guideline, simulation, cap] =
            [self.guideline, self.simulation, self.cap].map(|value| value.map(|value| value * factor));
        Self { guideline, simulation, cap }
    }
}

/// Demands for every check, with the partial factor on loads. Lists go from the lowest main rope to the highest. The
/// guideline's rope states are computed under factored loads; forces of the simulation are multiplied by the factor, its
/// strokes are not, because a dissipator does not scale.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demands {
    /// N
    pub total_force: Demand,
    /// Force along the channel and moment about the toe of a rigid wall, per width (N/m, N m/m).
    pub wall_force: Demand,
    pub wall_moment: Demand,
    /// N
    pub rope_tension: Vec<Demand>,
    /// N
    pub anchor_force: Vec<Demand>,
    /// On what holds the lowest rope to the bed, in all (N).
    pub bed_force: Demand,
    /// Tension of the dissipators (N): by the guideline under factored loads, of the simulation without factor.
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
    /// Share of the mass held.
    pub retained: Demand,
    /// Final over initial height.
    pub residual_height: Demand,
}

impl Demands {
    /// `observed` holds what each start of the simulation showed; with several, a demand is the value that the next start
    /// exceeds (or, for what must be kept, falls below) with a probability of 5 %; what a dissipator caps stays at its cap as long
    /// as no start has gone beyond. None: equations alone.
    pub fn meet(guideline: &Guideline, observed: &[&Observed], load_factor: f64) -> Self {
        let [plateau, stroke] = guideline.dissipator.unwrap_or([f64::INFINITY; 2]);
        let tensions: Vec<f64> = guideline.ropes.iter().map(|rope| rope.state.tension).collect();
        let strokes: Vec<f64> = guideline.ropes.iter().map(|rope| rope.state.stroke).collect();
        let highest = |values: &[f64]| values.iter().copied().reduce(larger);
        let spread = |quantity: &dyn Fn(&Observed) -> f64| {
            (!observed.is_empty()).then(|| Spread::of(&observed.iter().map(|seen| quantity(seen)).collect::<Vec<_>>()))
        };
        let most = |quantity: &dyn Fn(&Observed) -> f64| spread(quantity).map(|spread| spread.upper());
        let least = |quantity: &dyn Fn(&Observed) -> f64| spread(quantity).map(|spread| spread.lower());
        let worst = |quantity: &dyn Fn(&Observed) -> f64| observed.iter().map(|seen| quantity(seen)).reduce(larger);
        let simulated = |simulation: Option<f64>| Demand { simulation, ..Demand::default() };
        // The factor goes on the simulation alone: the guideline's ropes have it already.
        let by_rope =
            |by_guideline: &[f64], quantity: &dyn Fn(&Observed) -> &Vec<f64>, factor: f64, cap: f64| -> Vec<Demand> {
                let of = |rope: usize| {
                    let largest = observed.iter().map(|seen| quantity(seen)[rope]).fold(0.0, larger);
                    let within = largest <= cap * CAP_TOLERANCE;
                    let capped = |value: f64| if value > cap && within { largest.max(cap) } else { value };
                    Demand {
                        guideline: by_guideline.get(rope).copied(),
                        simulation: most(&|seen| quantity(seen)[rope]).map(|value| factor * capped(value)),
                        cap: (within && cap.is_finite() && !observed.is_empty()).then_some(factor * largest.max(cap)),
                    }
                };
                let ropes = observed.first().map_or(by_guideline.len(), |seen| quantity(seen).len());
                (0..ropes).map(of).collect()
            };
        let total_force =
            Demand { guideline: Some(guideline.largest_force), simulation: most(&|seen| seen.force_peak), cap: None };
        let wall_force = Demand {
            guideline: Some(guideline.largest_force / guideline.width),
            simulation: most(&|seen| seen.force_peak / guideline.width),
            cap: None,
        };
        let wall_moment =
            Demand { guideline: Some(guideline.largest_moment), simulation: most(&|seen| seen.moment_peak), cap: None };
        Self {
            wall_force: wall_force.times(load_factor),
            wall_moment: wall_moment.times(load_factor),
            total_force: total_force.times(load_factor),
            rope_tension: by_rope(&tensions, &|seen| &seen.rope_tension_peak, load_factor, f64::INFINITY),
            anchor_force: by_rope(&tensions, &|seen| &seen.anchor_force_peak, load_factor, plateau),
            brake_force: Demand {
                guideline: highest(&tensions),
                // Capped at the plateau, and so judged by the largest of the starts.
                simulation: observed.iter().map(|seen| highest(&seen.brake_force_peak).unwrap_or(0.0)).reduce(larger),
                cap: None,
            },
            brake_stroke: uncapped(by_rope(&strokes, &|seen| &seen.brake_stroke, 1.0, stroke)),
            bed_force: Demand {
                guideline: guideline.bed_force,
                simulation: most(&|seen| seen.bed_force_peak).map(|force| load_factor * force),
                cap: None,
            },
            net_tension: simulated(most(&|seen| seen.net_tension_peak)).times(load_factor),
            lateral_tension: simulated(most(&|seen| seen.lateral_tension_peak)).times(load_factor),
            broken_pieces: simulated(worst(&|seen| seen.broken_pieces)),
            drawn_out: simulated(worst(&|seen| seen.drawn_out)),
            retained: simulated(least(&|seen| seen.retained)),
            residual_height: simulated(least(&|seen| seen.residual_height)),
        }
    }

    /// Leaves what the simulation says alone.
    pub fn leave_out_guideline(&mut self) {
        let single = [
            &mut self.total_force,
            &mut self.wall_force,
            &mut self.wall_moment,
            &mut self.bed_force,
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

/// A stroke that ends at its stop is used up: that caps nothing.
fn uncapped(demands: Vec<Demand>) -> Vec<Demand> {
    demands.into_iter().map(|demand| Demand { cap: None, ..demand }).collect()
}

/// Factor up to which a load counts as at its cap: rounding, and the elastic part of a dissipator, lift it a little above.
pub const CAP_TOLERANCE: f64 = 1.01;

/// The larger of two numbers; NaN if either is, so that nothing is judged by half of what is known.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demand::from_loads::guideline;
    use crate::design::read::read_design;
    use crate::starts::k_n;
    use approx::assert_relative_eq;

    /// Starts on `small_net`, whose dissipators have a plateau of 60 kN: its net's tension, the load of anchor 2, the share held.
    fn demands(starts: &[[f64; 3]]) -> Demands {
        let design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
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
        Demands::meet(&guideline(&design), &observed.iter().collect::<Vec<_>>(), 1.0)
    }

    #[test]
    fn scatter_lifts_a_load_and_lowers_what_must_be_kept() {
        let demands = demands(&[[1e3, 1e3, 0.98], [2e3, 1e3, 0.96], [3e3, 1e3, 0.94]]);
        assert_relative_eq!(demands.net_tension.simulation.unwrap(), 2e3 + k_n(3) * 1e3, max_relative = 1e-12);
        assert_relative_eq!(demands.retained.simulation.unwrap(), 0.96 - k_n(3) * 0.02, max_relative = 1e-9);
    }

    #[test]
    fn scatter_does_not_lift_a_dissipator_above_its_plateau_unless_a_start_went_there() {
        let at_work = demands(&[[0.0, 60e3, 1.0], [0.0, 60e3, 1.0], [0.0, 40e3, 1.0]]);
        assert_eq!(at_work.anchor_force[1].simulation, Some(60e3));
        assert_eq!(at_work.brake_force.simulation, Some(60e3));
        let used_up = demands(&[[0.0, 60e3, 1.0], [0.0, 90e3, 1.0], [0.0, 60e3, 1.0]]);
        assert!(used_up.anchor_force[1].simulation.unwrap() > 90e3);
        assert_eq!(used_up.brake_force.simulation, Some(90e3));
    }

    #[test]
    fn a_start_that_is_not_a_number_is_seen() {
        let demands = demands(&[[1e3, 60e3, 1.0], [f64::NAN, f64::NAN, 1.0]]);
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
}
