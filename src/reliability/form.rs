//! The first-order reliability method: the point of failure that is nearest to the origin in u (the design point), by the improved algorithm of
//! Hasofer, Lind, Rackwitz and Fiessler (Zhang and Der Kiureghian 1995). Its probability Φ(−β) is exact for a plane alone.

use crate::reliability::normal::cumulative;

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignPoint {
    pub u: Vec<f64>,
    /// Distance from the origin; negative where the origin itself fails.
    pub index: f64,
    /// Unit vector from the origin towards failure: a positive number is an input whose larger values fail.
    pub alpha: Vec<f64>,
    pub evaluations: usize,
}

impl DesignPoint {
    pub fn probability(&self) -> f64 {
        cumulative(-self.index)
    }
}

/// Why there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPoint {
    /// The limit state does not change with the inputs, or is not a number.
    Flat,
    /// No failure lies within ten standard deviations of the medians in the direction that the search took.
    TooFar,
    /// The search did not settle.
    NotFound,
}

impl NoPoint {
    pub fn words(self) -> &'static str {
        match self {
            Self::Flat => "the check does not change with the inputs near their medians",
            Self::TooFar => "no failure within ten standard deviations",
            Self::NotFound => "the search for the design point did not settle",
        }
    }
}

/// Half the width of the differences that make a slope.
const WIDTH: f64 = 0.01;
const ITERATIONS: usize = 100;
/// Beyond this a probability is below 10⁻²³.
const FARTHEST: f64 = 10.0;

/// Seeks the design point of one check; `used` is its utilisation, which fails above 1.
pub fn form(dimensions: usize, used: &dyn Fn(&[f64]) -> f64) -> Result<DesignPoint, NoPoint> {
    let mut evaluations = 0;
    let mut reserve = |u: &[f64]| {
        evaluations += 1;
        1.0 - used(u)
    };
    let mut u = vec![0.0; dimensions];
    let mut here = reserve(&u);
    let scale = here.abs().max(1e-3);
    for _ in 0..ITERATIONS {
        let slope: Vec<f64> = (0..dimensions)
            .map(|number| {
                let mut at = |shift: f64| {
                    let mut there = u.clone();
                    there[number] += shift;
                    reserve(&there)
                };
                (at(WIDTH) - at(-WIDTH)) / (2.0 * WIDTH)
            })
            .collect();
        let steep = norm(&slope);
        if !here.is_finite() || !steep.is_finite() || steep < 1e-9 {
            return Err(NoPoint::Flat);
        }
        let alpha: Vec<f64> = slope.iter().map(|slope| -slope / steep).collect();
        let along = dot(&alpha, &u);
        let off = norm(&u.iter().zip(&alpha).map(|(u, alpha)| u - along * alpha).collect::<Vec<_>>());
        if here.abs() < 1e-4 * scale && off < 1e-2 * (1.0 + along.abs()) {
            return Ok(DesignPoint { index: along, u, alpha, evaluations });
        }
        // To the plane that touches here, and no farther than the merit |u|²/2 + c |g| falls.
        let target = along + here / steep;
        let toward: Vec<f64> = u.iter().zip(&alpha).map(|(u, alpha)| target * alpha - u).collect();
        let penalty = 2.0 * (norm(&u) / steep).max(0.5 * target * target / here.abs().max(1e-12)).max(1e-6);
        let merit = |u: &[f64], reserve: f64| 0.5 * dot(u, u) + penalty * reserve.abs();
        let before = merit(&u, here);
        let mut length = 1.0;
        loop {
            let there: Vec<f64> = u.iter().zip(&toward).map(|(u, toward)| u + length * toward).collect();
            let reached = reserve(&there);
            let inside = norm(&there) <= FARTHEST;
            if reached.is_finite() && inside && merit(&there, reached) < before || length < 1e-3 {
                if !inside {
                    return Err(NoPoint::TooFar);
                }
                if !reached.is_finite() {
                    return Err(NoPoint::NotFound);
                }
                (u, here) = (there, reached);
                break;
            }
            length *= 0.5;
        }
    }
    Err(if norm(&u) > 0.9 * FARTHEST { NoPoint::TooFar } else { NoPoint::NotFound })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_point_of_a_plane_is_at_its_distance() {
        let found = form(2, &|u: &[f64]| 1.0 + 0.3 * (0.6 * u[0] - 0.8 * u[1] - 2.5)).unwrap();
        assert_relative_eq!(found.index, 2.5, max_relative = 1e-6);
        assert_relative_eq!(found.alpha[0], 0.6, max_relative = 1e-6);
        assert_relative_eq!(found.alpha[1], -0.8, max_relative = 1e-6);
        // The origin may fail.
        let failed = form(1, &|u: &[f64]| 1.0 + 0.1 * (u[0] + 1.0)).unwrap();
        assert_relative_eq!(failed.index, -1.0, max_relative = 1e-6);
        assert_eq!(form(2, &|_: &[f64]| 0.4), Err(NoPoint::Flat));
        assert_eq!(form(2, &|_: &[f64]| f64::NAN), Err(NoPoint::Flat));
        assert_eq!(form(2, &|u: &[f64]| 0.1 + 0.01 * u[0]), Err(NoPoint::TooFar));
    }

    /// Strength and load, both lognormal, as ln R − ln S: β = (μ_r − μ_s)/√(σ_r² + σ_s²), where the ratio of the two is far from a plane.
    #[test]
    fn the_point_of_a_curved_limit_is_found() {
        let found = form(2, &|u: &[f64]| libm::exp(0.3 * u[0]) / (3.0 * libm::exp(0.2 * u[1]))).unwrap();
        let exact = libm::log(3.0) / 0.13_f64.sqrt();
        assert_relative_eq!(found.index, exact, max_relative = 1e-4);
        assert_relative_eq!(found.probability(), crate::reliability::normal::cumulative(-exact), max_relative = 2e-3);
    }
}
