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
    /// The larger of the two.
    pub fn largest(&self) -> Option<f64> {
        self.guideline.into_iter().chain(self.simulation).max_by(f64::total_cmp)
    }

    /// Both multiplied by a partial factor.
    pub fn times(&self, factor: f64) -> Self {
        Self { guideline: self.guideline.map(|v| v * factor), simulation: self.simulation.map(|v| v * factor) }
    }
}

/// Demands for every check, before partial factors. Lists go from the lowest main rope to the highest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demands {
    /// N
    pub total_force: Demand,
    /// N
    pub rope_tension: Vec<Demand>,
    /// N
    pub anchor_force: Vec<Demand>,
    /// m
    pub brake_stroke: Vec<Demand>,
    /// N
    pub net_tension: Demand,
    /// Share of the mass held.
    pub retained: Demand,
    /// Final over initial height.
    pub residual_height: Demand,
}

impl Demands {
    pub fn meet(guideline: &Guideline, observed: &Observed) -> Self {
        let both = |guideline: &[f64], simulation: &[f64]| -> Vec<Demand> {
            (0..simulation.len())
                .map(|rope| Demand { guideline: guideline.get(rope).copied(), simulation: Some(simulation[rope]) })
                .collect()
        };
        let tensions: Vec<f64> = guideline.ropes.iter().map(|rope| rope.tension).collect();
        let strokes: Vec<f64> = guideline.ropes.iter().map(|rope| rope.stroke).collect();
        let simulated = |value: f64| Demand { guideline: None, simulation: Some(value) };
        Self {
            total_force: Demand { guideline: Some(guideline.largest_force), simulation: Some(observed.force_peak) },
            rope_tension: both(&tensions, &observed.rope_tension_peak),
            anchor_force: both(&tensions, &observed.anchor_force_peak),
            brake_stroke: both(&strokes, &observed.brake_stroke),
            net_tension: simulated(observed.net_tension_peak),
            retained: simulated(observed.retained),
            residual_height: simulated(observed.residual_height),
        }
    }
}
