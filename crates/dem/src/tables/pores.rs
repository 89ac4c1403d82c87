//! Fluid in the pores, as one mixture with the grains.
//!
//! Its mass is part of the grains'. Of the pressure between them it carries the share r_u, the pore pressure ratio, so that friction is
//! (1 − r_u) tan φ; each grain keeps its own. The excess over the ratio r_0 that stays drains while a grain rests, r_u(t) = r_0 + (r_u − r_0)
//! exp(−t/τ), and does not come back when it moves again.

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
    /// r_0, no more than `ratio`.
    pub drains_to: f64,
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
                let drained = 1.0 - self.drains_to;
                *grip = drained - (drained - *grip) * keep;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec3;
    use crate::tables::grains::{Grain, GrainBody, GrainShape};

    /// From 0.8 towards 0.5 in one τ: 0.5 + 0.3/e. What moves keeps its pressure.
    #[test]
    fn what_rests_drains_to_what_stays() {
        let pores = Pores { ratio: 0.8, drains_in: 2.0, drains_to: 0.5, rests_below: 0.1 };
        let grain = |id: u32, speed: f64| {
            let mut grain = Grain::at(id, Vec3::zeros(), Vec3::x(), GrainBody::sphere(0.1, 2600.0));
            grain.velocity.x = speed;
            grain
        };
        let mut table = GrainTable::of(GrainShape::Sphere, &[grain(0, 0.0), grain(1, 0.2)]);
        table.grip.resize(2, pores.grip());
        pores.drain(&mut table, 2.0);
        let by_hand = 1.0 - (0.5 + 0.3 * libm::exp(-1.0));
        assert!((table.grip[0] - by_hand).abs() < 1e-12 && (table.grip[1] - 0.2).abs() < 1e-12, "{:?}", table.grip);
        pores.drain(&mut table, 1e3);
        assert!((table.grip[0] - 0.5).abs() < 1e-12);
    }
}
