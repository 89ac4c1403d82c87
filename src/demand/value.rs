//! A demand by both routes, and the packings that the simulation's is made of.

use crate::larger::larger_or_nan;
use crate::quantities::observed::Observed;

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
    /// The same with what another simulation shows, if that is worse: of what must be kept the `least`, of all else the larger; NaN if either is.
    pub fn or_worse(&self, other: &Self, least: bool) -> Self {
        let worse = |a: f64, b: f64| match least {
            true => -larger_or_nan(-a, -b),
            false => larger_or_nan(a, b),
        };
        let simulation = self.simulation.into_iter().chain(other.simulation).reduce(worse);
        Self { simulation, cap: self.cap.zip(other.cap).map(|(a, b)| a.max(b)), ..*self }
    }

    /// The larger of two loads on one part, by each route; NaN if either is.
    pub fn or_larger(&self, other: &Self) -> Self {
        let larger = |a: Option<f64>, b: Option<f64>| a.into_iter().chain(b).reduce(larger_or_nan);
        Self {
            guideline: larger(self.guideline, other.guideline),
            simulation: larger(self.simulation, other.simulation),
            characteristic: larger(self.characteristic, other.characteristic),
            cap: None,
        }
    }

    /// The same with what is there without the flow, with partial factors and without.
    pub fn with_own(&self, own: f64, characteristic: f64) -> Self {
        Self {
            guideline: self.guideline.map(|value| value + own),
            simulation: self.simulation.map(|value| value + own),
            characteristic: self.characteristic.map(|value| value + characteristic),
            cap: self.cap.map(|cap| cap + own),
        }
    }

    /// The larger of the two; NaN if either is.
    pub fn largest(&self) -> Option<f64> {
        self.guideline.into_iter().chain(self.simulation).reduce(larger_or_nan)
    }
}

/// What the simulations showed, packing by packing.
#[derive(Clone, Debug, Default)]
pub struct SimulatedRuns<'a> {
    /// The flow as it is.
    pub characteristic: Vec<&'a Observed>,
    /// The flow with factored actions, where that was simulated; else forces are proportional to the action.
    pub factored: Vec<&'a Observed>,
    /// The same against dissipators with their least force, where that was simulated.
    pub weak: Vec<&'a Observed>,
}

impl SimulatedRuns<'_> {
    /// The case that forces and strokes are designed for, and the factor that is still to be put on its forces.
    pub fn governing(&self, load_factor: f64) -> (&[&Observed], f64) {
        if self.factored.is_empty() { (&self.characteristic, load_factor) } else { (&self.factored, 1.0) }
    }
}
