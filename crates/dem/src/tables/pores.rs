//! Fluid in the pores, as one mixture with the grains.
//!
//! Its mass is part of the grains'. Of the pressure between them it carries the share r_u, the pore pressure ratio, so that friction is
//! (1 − r_u) tan φ; each grain keeps its own. The excess drains while a grain rests, r_u(t) = r_u exp(−t/τ), and does not come back when it
//! moves again.

use serde::{Deserialize, Serialize};

use crate::tables::grain_table::GrainTable;

/// Steps between two times that it is seen to.
pub const STEPS_BETWEEN: u64 = 16;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pores {
    /// r_u of the flow as it comes, 0 to 1.
    pub ratio: f64,
    /// τ (s).
    pub drains_in: f64,
    /// Speed below which a grain rests (m/s).
    pub rests_below: f64,
}

impl Pores {
    /// Share of its friction that acts on a grain as it comes.
    pub fn grip(&self) -> f64 {
        1.0 - self.ratio
    }

    /// Drains what has rested for a time (s).
    pub fn drain(&self, grains: &mut GrainTable, time: f64) {
        let keep = libm::exp(-time / self.drains_in);
        let limit = self.rests_below.powi(2);
        for (grip, motion) in grains.grip.iter_mut().zip(&grains.motion) {
            if motion.vector().norm_squared() < limit {
                *grip = 1.0 - (1.0 - *grip) * keep;
            }
        }
    }
}
