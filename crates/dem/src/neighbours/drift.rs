//! The common motion of the flow, taken out before it is asked whether a list has expired.
//!
//! Grains that fly side by side do not meet, however fast they fly. At a renewal a drift velocity V(x) is
//! fitted along the channel, piecewise linear with Lipschitz constant S (1/s), and every grain is given V at its centre.
//! After the time τ, a member of grain i has strayed from it by δ_i = |u_i − V_i τ|, with u_i its displacement. A pair of
//! members whose surfaces were a gap g apart has come closer by at most δ_i + δ_j + S τ (2 r + 2 o + g), with r the largest
//! radius, o the largest distance of a member from its grain's centre, and S the steepness between the two.

use crate::Vec3;
use crate::simd::quad::Quad;
use crate::tables::grain_table::GrainTable;
use crate::tables::moving_rows::Drifting;

/// Pieces of the drift along the channel.
const PIECES: usize = 32;

/// The drift V(x): velocities at evenly spaced places along the channel.
#[derive(Clone, Debug, Default)]
pub struct Drift {
    low: f64,
    spacing: f64,
    velocities: Vec<Vec3>,
    /// Steepness of the pieces (1/s).
    pieces: Vec<f64>,
    /// Lipschitz constant S (1/s).
    pub steepness: f64,
    /// Largest drift (m/s).
    pub fastest: f64,
}

impl Drift {
    /// Fits the drift to the velocities of all grains.
    pub fn fit(grains: &GrainTable) -> Self {
        let low = grains.place.iter().map(|place| place.0[0]).fold(f64::INFINITY, f64::min);
        let high = grains.place.iter().map(|place| place.0[0]).fold(f64::NEG_INFINITY, f64::max);
        let widest = grains.place.iter().map(Quad::fourth).fold(0.0, f64::max);
        if !(high - low).is_finite() {
            return Self::default();
        }
        let spacing = ((high - low) / PIECES as f64).max(4.0 * widest);
        let count = ((high - low) / spacing).ceil() as usize + 1;
        let mut sums = vec![(Vec3::zeros(), 0.0); count];
        for (place, motion) in grains.place.iter().zip(&grains.motion) {
            let (sum, number) = &mut sums[(((place.0[0] - low) / spacing).round() as usize).min(count - 1)];
            *sum += motion.vector();
            *number += 1.0;
        }
        let mut velocities: Vec<Vec3> = Vec::with_capacity(count);
        for (sum, number) in sums {
            // A place without grains takes its neighbour's drift; no pair depends on it.
            let last = velocities.last().copied().unwrap_or_default();
            velocities.push(if number > 0.0 { sum / number } else { last });
        }
        let fastest = velocities.iter().map(Vec3::norm).fold(0.0, f64::max);
        // Two drifts rounded to single precision, told apart over the smallest distance that matters.
        let rounding = fastest * f64::from(f32::EPSILON) / widest;
        let pieces = velocities.windows(2).map(|pair| (pair[1] - pair[0]).norm() / spacing + rounding);
        let pieces: Vec<f64> = pieces.collect();
        let steepness = pieces.iter().copied().fold(rounding, f64::max);
        Self { low, spacing, velocities, pieces, steepness, fastest }
    }

    /// Steepest drift within two pieces of place x (1/s).
    pub fn steepness_about(&self, x: f64) -> f64 {
        let piece = ((x - self.low) / self.spacing).max(0.0) as usize;
        let about = piece.saturating_sub(2)..(piece + 3).min(self.pieces.len());
        // Rounding is in each of them, and in the steepest where there is none.
        self.pieces.get(about).map_or(self.steepness, |pieces| pieces.iter().copied().fold(0.0, f64::max))
    }

    /// Distance along the channel over which [`Self::steepness_about`] speaks of all between two places (m).
    pub fn reaches_over(&self) -> f64 {
        2.0 * self.spacing
    }

    /// The drift at place x.
    pub fn at(&self, x: f64) -> Drifting {
        let along = ((x - self.low) / self.spacing).max(0.0);
        let index = (along as usize).min(self.velocities.len().saturating_sub(2));
        let drift = match (self.velocities.get(index), self.velocities.get(index + 1)) {
            (Some(a), Some(b)) => a + (b - a) * (along - index as f64).min(1.0),
            (Some(only), None) => *only,
            _ => Vec3::zeros(),
        };
        [drift.x as f32, drift.y as f32, drift.z as f32, 0.0]
    }
}
