//! How high a flow runs up a barrier that stops it, h_u, by two balances. Heights and depths normal to the bed (m).
//!
//! Energy: what is not lost lifts the flow, h_u = h + v²/(2 g cos α). Momentum: a jump (bore) that fills the space behind the
//! barrier moves upstream through the flow, h_u = r h with the largest root of r³ − r² − (2 Fr²/κ + 1) r + 1 = 0, κ = 1 for a
//! pressure as in a fluid (Iverson, George & Logan 2016). In fast flows the energy balance is far above what is measured, in slow
//! ones the jump is above it; the larger of both bounds what a deposit may be heaped up to.

use crate::larger::larger_or_nan;
use crate::loads::input::GuidelineInput;

/// h + v²/(2 g cos α) (m).
pub fn by_energy(input: &GuidelineInput) -> f64 {
    input.depth + input.velocity.powi(2) / (2.0 * input.gravity_normal)
}

/// Height of the flow behind a momentum jump (m).
pub fn by_jump(input: &GuidelineInput) -> f64 {
    let froude = input.froude();
    let slope = 2.0 * froude * froude + 1.0;
    // Above r = 1 the cubic first falls below zero and then rises for good: its largest root lies between 1 and 1 + √slope.
    let cubic = |r: f64| r * r * r - r * r - slope * r + 1.0;
    let (mut low, mut high) = (1.0, 1.0 + slope.sqrt());
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if cubic(middle) < 0.0 { low = middle } else { high = middle }
    }
    high * input.depth
}

/// The larger of both (m).
pub fn bound(input: &GuidelineInput) -> f64 {
    larger_or_nan(by_energy(input), by_jump(input))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A flow on a level bed.
    fn flow(velocity: f64, depth: f64) -> GuidelineInput {
        GuidelineInput { gravity_normal: 9.81, velocity, depth, ..crate::loads::cases::tests::input() }
    }

    #[test]
    fn the_jump_is_that_of_the_flume_tests() {
        // Worked out for four moments of the USGS tests of 1994, measured run-up 1.2 to 2.05 m.
        for (velocity, depth, expected) in
            [(10.0, 0.10, 1.48), (10.0, 0.15, 1.83), (9.7, 0.20, 2.07), (10.0, 0.23, 2.29)]
        {
            assert_relative_eq!(by_jump(&flow(velocity, depth)), expected, max_relative = 5e-3);
        }
    }

    #[test]
    fn a_flow_that_stands_runs_up_nowhere_and_a_fast_one_less_far_by_the_jump_than_by_energy() {
        assert_relative_eq!(by_jump(&flow(1e-9, 1.0)), 1.0, max_relative = 1e-6);
        assert_relative_eq!(by_energy(&flow(10.0, 0.1)), 0.1 + 100.0 / 19.62, max_relative = 1e-12);
        assert!(by_jump(&flow(10.0, 0.1)) < by_energy(&flow(10.0, 0.1)));
        assert!(by_jump(&flow(2.0, 1.0)) > by_energy(&flow(2.0, 1.0)));
    }
}
