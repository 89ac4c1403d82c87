//! The standard normal distribution.

use std::f64::consts::{PI, SQRT_2};

/// Φ(u), exact to the last digits in both tails.
pub fn cumulative(u: f64) -> f64 {
    0.5 * libm::erfc(-u / SQRT_2)
}

/// Its density.
pub fn density(u: f64) -> f64 {
    libm::exp(-0.5 * u * u) / (2.0 * PI).sqrt()
}

/// Φ⁻¹(p): bisection, then Newton's method on the logarithm of the nearer tail. Infinite at 0 and 1, NaN outside.
pub fn quantile(p: f64) -> f64 {
    if p.is_nan() || !(0.0..=1.0).contains(&p) {
        return f64::NAN;
    }
    if p == 0.5 {
        return 0.0;
    }
    if p > 0.5 {
        return -quantile(1.0 - p);
    }
    if p == 0.0 {
        return f64::NEG_INFINITY;
    }
    let (mut low, mut high) = (-40.0, 0.0);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if cumulative(middle) < p { low = middle } else { high = middle }
    }
    let mut u = 0.5 * (low + high);
    for _ in 0..3 {
        let reached = cumulative(u);
        u -= libm::log(reached / p) * reached / density(u);
    }
    u
}

/// A standard normal number.
pub fn draw(random: &mut fastrand::Rng) -> f64 {
    // 1 − x is never 0.
    let radius = (-2.0 * libm::log(1.0 - random.f64())).sqrt();
    radius * libm::cos(2.0 * PI * random.f64())
}

/// So many of them.
pub fn draw_many(count: usize, random: &mut fastrand::Rng) -> Vec<f64> {
    (0..count).map(|_| draw(random)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Values of published tables of the normal distribution.
    #[test]
    fn tails_and_quantiles_are_those_of_the_tables() {
        assert_relative_eq!(cumulative(1.0), 0.841_344_746_068_543, max_relative = 1e-14);
        assert_relative_eq!(cumulative(-3.0), 1.349_898_031_630_09e-3, max_relative = 1e-13);
        assert_relative_eq!(cumulative(-8.0), 6.220_960_574_271_78e-16, max_relative = 1e-12);
        assert_relative_eq!(quantile(0.975), 1.959_963_984_540_05, max_relative = 1e-13);
        for u in [-12.0, -5.0, -0.1, 0.0, 0.3] {
            assert_relative_eq!(quantile(cumulative(u)), u, max_relative = 1e-12, epsilon = 1e-14);
        }
        assert!(quantile(0.0) == f64::NEG_INFINITY && quantile(1.0) == f64::INFINITY && quantile(1.1).is_nan());
    }

    #[test]
    fn what_is_drawn_has_its_moments() {
        let mut random = fastrand::Rng::with_seed(5);
        let drawn = draw_many(200_000, &mut random);
        let moment = |power: i32| drawn.iter().map(|u| u.powi(power)).sum::<f64>() / drawn.len() as f64;
        // Four standard errors each: 1/√n, √2/√n, √96/√n.
        assert!(moment(1).abs() < 0.009 && (moment(2) - 1.0).abs() < 0.013 && (moment(4) - 3.0).abs() < 0.09);
    }
}
