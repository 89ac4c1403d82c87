//! Dissipators of ropes.

use crate::yield_curve::YieldCurve;

/// Energy dissipators at one end of a rope; of ropes that run side by side, of each.
#[derive(Clone, Debug, PartialEq)]
pub struct DissipatorDesign {
    /// Plateau force (N), or the largest of the curve.
    pub plateau: f64,
    /// How the force goes with the stroke.
    pub curve: YieldCurve,
    /// m
    pub stroke: f64,
    /// Elastic stiffness before it yields and when it is unloaded (N/m).
    pub stiffness: f64,
    /// Least force over that of the curve, where it is known.
    pub lower_bound: Option<f64>,
    /// How many devices it is made of, in series and side by side.
    pub devices: f64,
}

impl DissipatorDesign {
    /// Least force (N) with which it may begin to yield.
    pub fn yields_at(&self) -> f64 {
        self.lower_bound.unwrap_or(1.0) * self.plateau * self.curve.least()
    }

    /// The same with the least forces of its tests; nothing where they are not less.
    pub fn weakest(&self) -> Option<Self> {
        let least = self.lower_bound.filter(|least| *least < 1.0)?;
        Some(Self { plateau: least * self.plateau, lower_bound: None, ..self.clone() })
    }
}
