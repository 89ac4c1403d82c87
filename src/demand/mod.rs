//! What the barrier must bear: the only place where the two load routes, guideline and simulation, meet.

pub mod from_histories;
pub mod from_loads;

use self::from_histories::Observed;
use self::from_loads::Guideline;

/// One quantity by both routes; a route that says nothing about it is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Demand {
    pub guideline: Option<f64>,
    pub simulation: Option<f64>,
}

impl Demand {
    /// The larger of the two; NaN if either is.
    pub fn largest(&self) -> Option<f64> {
        self.guideline.into_iter().chain(self.simulation).reduce(larger)
    }

    /// Both multiplied by a partial factor.
    pub fn times(&self, factor: f64) -> Self {
        Self { guideline: self.guideline.map(|v| v * factor), simulation: self.simulation.map(|v| v * factor) }
    }
}

/// Demands for every check, with the partial factor on loads. Lists go from the lowest main rope to the highest. The
/// guideline's rope states are computed under factored loads; forces of the simulation are multiplied by the factor, its
/// strokes are not, because a dissipator does not scale.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demands {
    /// N
    pub total_force: Demand,
    /// N
    pub rope_tension: Vec<Demand>,
    /// N
    pub anchor_force: Vec<Demand>,
    /// Tension of the dissipators (N): by the guideline under factored loads, of the simulation without factor.
    pub brake_force: Demand,
    /// m
    pub brake_stroke: Vec<Demand>,
    /// N
    pub net_tension: Demand,
    /// N
    pub lateral_tension: Demand,
    /// Share of the mass held.
    pub retained: Demand,
    /// Final over initial height.
    pub residual_height: Demand,
}

impl Demands {
    pub fn meet(guideline: &Guideline, observed: &Observed, load_factor: f64) -> Self {
        let tensions: Vec<f64> = guideline.ropes.iter().map(|rope| rope.tension).collect();
        let strokes: Vec<f64> = guideline.ropes.iter().map(|rope| rope.stroke).collect();
        let simulated = |value: f64| Demand { guideline: None, simulation: Some(value) };
        let highest = |values: &[f64]| values.iter().copied().reduce(larger);
        let total_force = Demand { guideline: Some(guideline.largest_force), simulation: Some(observed.force_peak) };
        Self {
            total_force: total_force.times(load_factor),
            rope_tension: side_by_side(&tensions, &observed.rope_tension_peak, load_factor),
            anchor_force: side_by_side(&tensions, &observed.anchor_force_peak, load_factor),
            brake_force: Demand { guideline: highest(&tensions), simulation: highest(&observed.brake_force_peak) },
            brake_stroke: side_by_side(&strokes, &observed.brake_stroke, 1.0),
            net_tension: simulated(observed.net_tension_peak).times(load_factor),
            lateral_tension: simulated(observed.lateral_tension_peak).times(load_factor),
            retained: simulated(observed.retained),
            residual_height: simulated(observed.residual_height),
        }
    }
}

/// The larger of two numbers; NaN if either is, so that nothing is judged by half of what is known.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Guideline and simulation rope by rope; the factor goes on the simulation alone.
fn side_by_side(guideline: &[f64], simulation: &[f64], factor: f64) -> Vec<Demand> {
    let of =
        |rope: usize| Demand { guideline: guideline.get(rope).copied(), simulation: Some(factor * simulation[rope]) };
    (0..simulation.len()).map(of).collect()
}
