//! The common motion of the flow, taken out before it is asked whether a list has expired.
//!
//! Grains that fly side by side do not meet, however fast they fly. At a renewal a drift velocity V(x) is
//! fitted along the channel, piecewise linear with Lipschitz constant S (1/s), and every grain is given V at its centre.
//! After the time τ, a member of grain i has strayed from it by δ_i = |u_i − V_i τ|, with u_i its displacement. A pair of
//! members whose surfaces were a gap g apart has come closer by at most δ_i + δ_j + S τ (2 r + 2 o + g), with r the largest
//! radius and o the largest distance of a member from its grain's centre.

use crate::simd::quad::Quad;
use crate::tables::grain_table::GrainTable;
use crate::tables::moving_rows::Drifting;
use crate::workers;
use crate::{Vec3, larger_or_nan};

/// Pieces of the drift along the channel.
const PIECES: usize = 32;

/// Members that are looked at in one go.
const MEMBERS_IN_PART: usize = 2048;

/// How far members have gone since their lists were made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strayed {
    /// Largest displacement (m).
    pub moved: f64,
    /// Largest displacement from the drift (m).
    pub strayed: f64,
}

/// The drift V(x): velocities at evenly spaced places along the channel.
#[derive(Clone, Debug, Default)]
pub struct Drift {
    low: f64,
    spacing: f64,
    velocities: Vec<Vec3>,
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
        let steepest = velocities.windows(2).map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f64::max);
        let fastest = velocities.iter().map(Vec3::norm).fold(0.0, f64::max);
        // Two drifts rounded to single precision, told apart over the smallest distance that matters.
        let rounding = fastest * f64::from(f32::EPSILON) / widest;
        Self { low, spacing, velocities, steepness: steepest / spacing + rounding, fastest }
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

/// How far members with the given reference places have gone after `elapsed` (s); NaN if one is nowhere.
pub fn strayed(references: &[Vec3], grains: &GrainTable, drift: &[Drifting], elapsed: f64) -> Strayed {
    let rows = grains.rows();
    let per_grain = grains.shape.members();
    let parts = workers::map(references.chunks(MEMBERS_IN_PART), |part, references| {
        let mut squares = [0.0_f64; 2];
        for (index, reference) in (part * MEMBERS_IN_PART..).zip(references) {
            let gone = rows.sphere(index).0 - reference;
            let [x, y, z, _] = drift[index / per_grain].map(f64::from);
            let off = gone - Vec3::new(x, y, z) * elapsed;
            squares = larger_of(squares, [gone.norm_squared(), off.norm_squared()]);
        }
        squares
    });
    let [moved, strayed] = parts.into_iter().fold([0.0; 2], larger_of).map(f64::sqrt);
    Strayed { moved, strayed }
}

fn larger_of(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [larger_or_nan(a[0], b[0]), larger_or_nan(a[1], b[1])]
}
