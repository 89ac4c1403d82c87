//! A wire rope, as it is designed.

/// A wire rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rope {
    pub diameter: f64,
    /// Modulus that, with the full circle of the diameter, gives the rope's EA (Pa).
    pub modulus: f64,
    /// N
    pub breaking_load: f64,
    /// Tension beyond which the simulated rope draws out and stays longer (N), if it does.
    pub elastic_limit: Option<f64>,
    /// Whether the simulated rope breaks at its breaking load.
    pub breaks: bool,
}

impl Rope {
    /// EA with the full circle of the diameter (N).
    pub fn axial_stiffness(&self) -> f64 {
        self.modulus * std::f64::consts::FRAC_PI_4 * self.diameter.powi(2)
    }
}

/// Equal ropes that run side by side at one height, each with dissipators and anchors of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Along the barrier (m).
    pub height: f64,
    pub ropes: u16,
    pub rope: Rope,
}
