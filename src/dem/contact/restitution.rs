//! From restitution to damping for the linear dashpot that never pulls.
//!
//! Two bodies of reduced mass m_r meet with k u + γ u̇ ≥ 0. With ζ = γ/(2√(k m_r)) the contact ends when the
//! force vanishes, and the restitution is
//!
//! ε = exp(−2ζ arccos ζ / √(1−ζ²)) for ζ < 1, ε = exp(−2ζ arccosh ζ / √(ζ²−1)) for ζ > 1, ε = e⁻² at ζ = 1
//!
//! (Schwager & Pöschel 2007, truncated branch). The same expression without truncation, exp(−πζ/√(1−ζ²)), would
//! give 0.40 where 0.30 is asked.

/// Restitution of the truncated dashpot with damping ratio `zeta` ≥ 0.
pub fn restitution_of(zeta: f64) -> f64 {
    let gap = 1.0 - zeta * zeta;
    let ratio = if gap.abs() < 1e-9 {
        1.0
    } else if gap > 0.0 {
        zeta.acos() / gap.sqrt()
    } else {
        zeta.acosh() / (-gap).sqrt()
    };
    (-2.0 * zeta * ratio).exp()
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
    fn critical_damping_gives_e_to_the_minus_two() {
        assert_abs_diff_eq!(restitution_of(1.0), (-2.0_f64).exp(), epsilon = 1e-9);
        assert_abs_diff_eq!(restitution_of(1.0 - 1e-7), (-2.0_f64).exp(), epsilon = 1e-6);
        assert_abs_diff_eq!(restitution_of(1.0 + 1e-7), (-2.0_f64).exp(), epsilon = 1e-6);
    }
}
