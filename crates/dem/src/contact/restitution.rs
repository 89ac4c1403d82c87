//! From restitution to damping for the linear non-adhesive dashpot.
//!
//! Two bodies of reduced mass m_r meet with k u + γ u̇ ≥ 0. With ζ = γ/(2√(k m_r)) the contact ends when the
//! force vanishes, and the restitution is
//!
//! ε = exp(−2ζ arccos ζ / √(1−ζ²)) for ζ < 1, ε = exp(−2ζ arccosh ζ / √(ζ²−1)) for ζ > 1, ε = e⁻² at ζ = 1
//!
//! (Schwager & Pöschel 2007, truncated branch). The same expression without truncation, exp(−πζ/√(1−ζ²)), would
//! give 0.40 where 0.30 is asked.

use serde::{Deserialize, Serialize};

use crate::simd::real::Real;

/// Restitution of the truncated dashpot with damping ratio `zeta` ≥ 0.
pub fn restitution_of(zeta: f64) -> f64 {
    let gap = 1.0 - zeta * zeta;
    let ratio = if gap.abs() < 1e-9 {
        1.0
    } else if gap > 0.0 {
        libm::acos(zeta) / gap.sqrt()
    } else {
        libm::acosh(zeta) / (-gap).sqrt()
    };
    libm::exp(-2.0 * zeta * ratio)
}

/// Damping ratio ζ whose truncated restitution is `restitution` (0 < ε ≤ 1), by bisection: ε falls
/// monotonically with ζ.
pub fn damping_ratio_for(restitution: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while restitution_of(high) > restitution && high < 1e6 {
        high *= 2.0;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if restitution_of(middle) > restitution {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// How the damping ratio must change with the step so that the restitution stays the nominal one.
///
/// With the dashpot taken from the last half step, a contact of angular frequency ω0 = √(k/m_r) in steps of Δt loses a little
/// more than it should: at ω0 Δt = 0.5 a nominal 0.30 comes out as 0.27 on the average over where in a step the contact
/// begins. The ratio ζ (1 + a x + b x²), x = ω0 Δt, brings the average back; a and b are found once for each ε by
/// playing the contact through in steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepCorrection {
    pub linear: f64,
    pub quadratic: f64,
}

/// Longest step, as ω0 Δt, up to which the correction holds: there the mean restitution is the nominal one within 0.005 for ε of 0.2
/// and more. A single impact scatters around it by where in a step it begins: at ε = 0.3 and ω0 Δt = 0.4 between 0.29 and 0.31.
pub const LONGEST_PHASE: f64 = 0.5;

/// Values of x at which the correction is fitted; the others are for strong damping, where the first has no answer.
const FITTED_AT: [[f64; 2]; 3] = [[0.25, 0.5], [0.2, 0.4], [0.1, 0.2]];
/// Places within a step at which a contact may begin.
const PHASES: u32 = 64;

impl StepCorrection {
    pub fn of(restitution: f64) -> Self {
        let zeta = damping_ratio_for(restitution);
        if restitution >= 1.0 {
            return Self::default();
        }
        let fit = |[near, far]: [f64; 2]| {
            let slope = |x: f64| stepped_ratio(restitution, zeta, x).map(|ratio| (ratio / zeta - 1.0) / x);
            let (at_near, at_far) = (slope(near)?, slope(far)?);
            let quadratic = (at_far - at_near) / (far - near);
            Some(Self { linear: at_near - quadratic * near, quadratic })
        };
        FITTED_AT.into_iter().find_map(fit).unwrap_or_default()
    }
}

/// Damping ratio that gives `restitution` in steps of x = ω0 Δt, near the `exact` one; nothing where there is none.
fn stepped_ratio(restitution: f64, exact: f64, x: f64) -> Option<f64> {
    let weighted = restitution <= WEIGHTED_UP_TO;
    let (mut low, mut high) = (0.5 * exact, 1.2 * exact);
    if stepped_restitution(low, x, weighted) < restitution || stepped_restitution(high, x, weighted) > restitution {
        return None;
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if stepped_restitution(middle, x, weighted) > restitution {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

/// Weight of the first force of a contact that began a `part` of a step before, with `lighter` = 1 − ζ ω₀ Δt. It stands for the time
/// up to the middle of the next step, part + ½ of a step, in which the dashpot slows the bodies down to second order.
#[inline(always)]
pub fn first_weight<R: Real>(part: R, lighter: R) -> R {
    (part + 0.5) * ((lighter + -1.0) * (part + -0.5) + 1.0)
}

/// Restitution up to which the first force of a contact is weighted. What jumps when a contact begins is the dashpot's force; with little of
/// it the force rises from nothing, and plain steps are the better ones.
const WEIGHTED_UP_TO: f64 = 0.8;

/// How many times its overlap the way of a step must be for a contact to have begun in it, as far as its force is weighted.
pub fn begins_beyond(restitution: f64) -> f64 {
    if restitution <= WEIGHTED_UP_TO { 1.0 } else { f64::INFINITY }
}

/// Restitution of a contact played through in steps of x, in units of ω0 and the reduced mass; mean over all phases.
fn stepped_restitution(zeta: f64, x: f64, weighted: bool) -> f64 {
    let rebound = |phase: u32| {
        let mut closing = 1.0_f64;
        let part = (f64::from(phase) + 0.5) / f64::from(PHASES);
        let mut overlap = x * part;
        let mut weight = if weighted { first_weight(part, 1.0 - zeta * x) } else { 1.0 };
        while overlap > 0.0 || closing > 0.0 {
            closing -= x * weight * (overlap + 2.0 * zeta * closing).max(0.0);
            overlap += x * closing;
            weight = 1.0;
        }
        -closing
    };
    (0..PHASES).map(rebound).sum::<f64>() / f64::from(PHASES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn matches_the_tabulated_damping_ratios() {
        // Table 1 of the verification cases: ε against ζ (truncated).
        let table = [(0.1, 1.243188), (0.2, 0.731247), (0.3, 0.497239), (0.5, 0.255276), (0.9, 0.034265)];
        for (restitution, zeta) in table {
            assert_abs_diff_eq!(damping_ratio_for(restitution), zeta, epsilon = 1e-6);
        }
    }

    #[test]
    fn the_correction_brings_the_restitution_back_at_coarse_steps() {
        for nominal in [0.2, 0.3, 0.5, 0.7, 0.9] {
            let zeta = damping_ratio_for(nominal);
            let StepCorrection { linear, quadratic } = StepCorrection::of(nominal);
            for x in [0.05, 0.3, LONGEST_PHASE] {
                let stepped =
                    stepped_restitution(zeta * (1.0 + x * (linear + x * quadratic)), x, nominal <= WEIGHTED_UP_TO);
                assert_abs_diff_eq!(stepped, nominal, epsilon = 0.005);
            }
        }
        assert_eq!(StepCorrection::of(1.0), StepCorrection::default());
    }

    #[test]
    fn critical_damping_gives_e_to_the_minus_two() {
        assert_abs_diff_eq!(restitution_of(1.0), libm::exp(-2.0_f64), epsilon = 1e-9);
        assert_abs_diff_eq!(restitution_of(1.0 - 1e-7), libm::exp(-2.0_f64), epsilon = 1e-6);
        assert_abs_diff_eq!(restitution_of(1.0 + 1e-7), libm::exp(-2.0_f64), epsilon = 1e-6);
    }
}
