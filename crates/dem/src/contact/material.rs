//! What the contact law is told of the grains.

use serde::{Deserialize, Serialize};

/// What the grains are made of, as contacts feel it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Contact modulus E (Pa): k = 2 E r₁ r₂/(r₁+r₂).
    pub modulus: f64,
    /// Normal restitution ε, 0 < ε ≤ 1.
    pub restitution: f64,
    /// k_t / k_n, 2/7 by Silbert 2001.
    pub tangential_ratio: f64,
    /// Friction coefficient between grains, tan φ.
    pub friction: f64,
}

impl Material {
    /// With the contact modulus (Pa), the restitution and the friction coefficient; whatever else a contact feels is as usual.
    pub const fn new(modulus: f64, restitution: f64, friction: f64) -> Self {
        Self { modulus, restitution, friction, tangential_ratio: 2.0 / 7.0 }
    }
}
