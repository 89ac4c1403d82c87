//! Probability that a limit is exceeded when inputs scatter. Knows nothing of designs: limit states are functions of independent standard
//! normal numbers u, and [`inputs`] turns these into values of the inputs.
//!
//! | method | file | what for |
//! |---|---|---|
//! | Monte Carlo | [`monte_carlo`] | the reference; probabilities down to some ten over the number of samples |
//! | subset simulation | [`subset`] | small probabilities |
//! | first-order method (FORM) | [`form`] | the design point, the weight of each input; its probability is a hint |
//! | Sobol indices | [`sobol`] | share of the variance that each input brings |
//! | Kriging surrogate | [`surrogate`] | limit states that take a simulation each |

pub(crate) mod distribution;
pub(crate) mod form;
pub(crate) mod inputs;
pub(crate) mod monte_carlo;
pub(crate) mod normal;
#[cfg(test)]
mod published;
pub(crate) mod sobol;
pub(crate) mod subset;
pub(crate) mod surrogate;

use crate::larger::larger_or_nan;

/// Utilisations of checks at standard normal numbers, always of the same checks in the same order: a check fails above 1. What is not a number
/// could not be judged, and counts as failed.
pub type LimitStates<'a> = dyn Fn(&[f64]) -> Vec<f64> + Sync + 'a;

/// The largest of them: the barrier fails with its first check.
pub fn largest(used: &[f64]) -> f64 {
    let largest = used.iter().copied().fold(f64::NEG_INFINITY, larger_or_nan);
    if largest.is_nan() { f64::INFINITY } else { largest }
}

/// Whether a check has failed. Asked so that what is not a number has.
pub fn fails(used: f64) -> bool {
    let holds = used <= 1.0;
    !holds
}

/// A probability with the interval that holds it with a confidence of 95 %.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Probability {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

impl Probability {
    /// This one beside that of plain samples: what these have seen stands, as subset simulation may follow one way to failure and miss another.
    pub fn or_seen(self, plain: Self) -> Self {
        if self.high < plain.low { plain } else { self }
    }

    /// Reliability index β = −Φ⁻¹(p).
    pub fn index(&self) -> f64 {
        -normal::quantile(self.value)
    }
}

/// A seed for one part of the work.
fn seed_of(seed: u64, part: u64) -> u64 {
    // Odd multipliers spread neighbouring numbers over all bits.
    (seed ^ part.wrapping_mul(0x9e37_79b9_7f4a_7c15)).wrapping_mul(0xbf58_476d_1ce4_e5b9)
}
