//! What the load equations need: the flow as it arrives, the coefficients, the height to be filled. SI.

/// Flow, coefficients and heights of one barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuidelineInput {
    /// ρ, bulk density (kg/m³).
    pub density: f64,
    /// g cos α (m/s²).
    pub gravity_normal: f64,
    /// K
    pub earth_pressure: f64,
    /// λ
    pub dynamic_pressure: f64,
    /// Factor on the dynamic pressure for wood in the flow, f_w; 1 without.
    pub wood: f64,
    /// Depth of the moving flow h (m).
    pub depth: f64,
    /// Velocity of the moving flow v (m/s).
    pub velocity: f64,
    /// Height to which the barrier fills, normal to the bed (m).
    pub fill_height: f64,
    /// Height of the barrier's top above the bed, normal to it (m).
    pub barrier_height: f64,
}

impl GuidelineInput {
    /// Froude number v/√(g cos α h).
    pub fn froude(&self) -> f64 {
        self.velocity / (self.gravity_normal * self.depth).sqrt()
    }

    /// Growth of the static pressure with depth, K ρ g cos α (Pa/m).
    pub fn unit_pressure(&self) -> f64 {
        self.earth_pressure * self.density * self.gravity_normal
    }

    /// f_w λ ρ v² (Pa).
    pub fn impact_pressure(&self) -> f64 {
        self.wood * self.dynamic_pressure * self.density * self.velocity.powi(2)
    }

    /// The same flow without its wood, as it is simulated.
    pub fn without_wood(&self) -> Self {
        Self { wood: 1.0, ..*self }
    }

    /// Depth of the flow, no more than what the barrier holds (m).
    pub fn moving_depth(&self) -> f64 {
        self.depth.min(self.fill_height)
    }

    /// Whether the design flow fills the barrier to its top.
    pub fn fills(&self) -> bool {
        self.fill_height >= self.barrier_height * (1.0 - 1e-9)
    }
}
