//! The common motion of the flow, taken out before it is asked whether a list has expired.
//!
//! Grains that fly side by side do not meet, however fast they fly. At a renewal a drift velocity V(x) is
//! fitted along the channel, piecewise linear with Lipschitz constant S (1/s). After the time τ, grain i has strayed
//! from it by δ_i = |u_i − V(x_i) τ|, with u_i its displacement. A pair that was further apart than its radii plus the skin
//! s has come closer by at most δ_i + δ_j + S τ times its distance, so no such pair touches while
//!
//! 2 max δ < s − S τ (2 r_max + s), S τ < 1.

use crate::dem::Vec3;
use crate::dem::tables::grains::Member;

/// Pieces of the drift along the channel.
const PIECES: usize = 32;

/// Where a member was when its lists were made, and the drift it was given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reference {
    pub place: [f64; 3],
    pub drift: [f64; 3],
}

/// How far the members of one block have gone since their reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strayed {
    /// Largest squared displacement (m²).
    pub moved: f64,
    /// Largest squared displacement from the drift (m²).
    pub strayed: f64,
}

impl Strayed {
    pub const NOWHERE: Self = Self { moved: 0.0, strayed: 0.0 };
    /// Expires every list.
    pub const LOST: Self = Self { moved: f64::INFINITY, strayed: f64::INFINITY };
}

/// The drift V(x): velocities at evenly spaced places along the channel.
#[derive(Clone, Debug, Default)]
pub struct Drift {
    low: f64,
    spacing: f64,
    velocities: Vec<Vec3>,
    /// Lipschitz constant S (1/s).
    pub steepness: f64,
}

impl Drift {
    /// Fits the drift to the members' velocities.
    pub fn fit(members: &[Member]) -> Self {
        let low = members.iter().map(|member| member.place[0]).fold(f64::INFINITY, f64::min);
        let high = members.iter().map(|member| member.place[0]).fold(f64::NEG_INFINITY, f64::max);
        let widest = members.iter().map(|member| member.place[3]).fold(0.0, f64::max);
        if !(high - low).is_finite() {
            return Self::default();
        }
        let spacing = ((high - low) / PIECES as f64).max(4.0 * widest);
        let count = ((high - low) / spacing).ceil() as usize + 1;
        let mut sums = vec![(Vec3::zeros(), 0.0); count];
        for member in members {
            let (sum, number) = &mut sums[(((member.place[0] - low) / spacing).round() as usize).min(count - 1)];
            *sum += member.velocity();
            *number += 1.0;
        }
        let mut velocities: Vec<Vec3> = Vec::with_capacity(count);
        for (sum, number) in sums {
            // A place without grains takes its neighbour's drift; no pair depends on it.
            let last = velocities.last().copied().unwrap_or_default();
            velocities.push(if number > 0.0 { sum / number } else { last });
        }
        let steepest = velocities.windows(2).map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f64::max);
        Self { low, spacing, velocities, steepness: steepest / spacing }
    }

    /// Reference of a member now.
    pub fn reference(&self, member: &Member) -> Reference {
        let place = [member.place[0], member.place[1], member.place[2]];
        let along = ((place[0] - self.low) / self.spacing).max(0.0);
        let index = (along as usize).min(self.velocities.len().saturating_sub(2));
        let drift = match (self.velocities.get(index), self.velocities.get(index + 1)) {
            (Some(a), Some(b)) => a + (b - a) * (along - index as f64).min(1.0),
            (Some(only), None) => *only,
            _ => Vec3::zeros(),
        };
        Reference { place, drift: drift.into() }
    }
}

/// How far `members` have gone from their references after `elapsed` (s); infinitely far if any is not finite.
#[inline(always)]
pub fn strayed(references: &[Reference], members: &[Member], elapsed: f64) -> Strayed {
    let (mut moved, mut strayed, mut total) = (0.0, 0.0, 0.0);
    for (reference, member) in references.iter().zip(members) {
        let (mut whole, mut rest) = (0.0, 0.0);
        for axis in 0..3 {
            let gone = member.place[axis] - reference.place[axis];
            let off = gone - reference.drift[axis] * elapsed;
            whole += gone * gone;
            rest += off * off;
        }
        moved = if whole > moved { whole } else { moved };
        strayed = if rest > strayed { rest } else { strayed };
        total += whole;
    }
    if total < f64::INFINITY { Strayed { moved, strayed } } else { Strayed::LOST }
}
