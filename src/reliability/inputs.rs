//! Inputs that scatter, some of them together, from independent standard normal numbers.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::reliability::distribution::Bounded;

/// Distributions, and how they hang together: a Gaussian copula. With z = L u, L the lower triangle of the correlation of the normal numbers, input i
/// is F_i⁻¹(Φ(z_i)).
#[derive(Clone, Debug)]
pub struct Inputs {
    each: Vec<Bounded>,
    /// Nothing where they are independent.
    lower: Option<DMatrix<f64>>,
}

/// Two inputs, by their numbers, and Spearman's rank correlation of them.
pub type Correlation = (usize, usize, f64);

impl Inputs {
    /// Nothing where no distribution has these correlations.
    pub fn new(each: Vec<Bounded>, correlations: &[Correlation]) -> Option<Self> {
        if correlations.is_empty() {
            return Some(Self { each, lower: None });
        }
        let mut matrix = DMatrix::identity(each.len(), each.len());
        for &(one, other, rank) in correlations {
            // Of the normal numbers beneath: ρ = 2 sin(π ρ_S / 6), whatever the distributions are.
            let of_normal = 2.0 * libm::sin(std::f64::consts::PI * rank / 6.0);
            (matrix[(one, other)], matrix[(other, one)]) = (of_normal, of_normal);
        }
        let lower = Cholesky::new(matrix)?.l();
        // What is next to singular leaves no digits.
        lower.diagonal().iter().all(|value| *value > 1e-6).then_some(Self { each, lower: Some(lower) })
    }

    pub fn independent(&self) -> bool {
        self.lower.is_none()
    }

    /// Values of the inputs at independent standard normal numbers.
    pub fn at(&self, u: &[f64]) -> Vec<f64> {
        let scores = match &self.lower {
            Some(lower) => (lower * DVector::from_column_slice(u)).as_slice().to_vec(),
            None => u.to_vec(),
        };
        self.each.iter().zip(scores).map(|(of, score)| of.at(score)).collect()
    }

    /// Weights of the inputs from those of the normal numbers: of correlated ones, γ = L⁻ᵀ α, scaled to length 1.
    pub fn weights(&self, alpha: &[f64]) -> Vec<f64> {
        let Some(lower) = &self.lower else { return alpha.to_vec() };
        let solved = lower.transpose().lu().solve(&DVector::from_column_slice(alpha));
        solved.map_or_else(|| alpha.to_vec(), |solved| solved.normalize().as_slice().to_vec())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reliability::distribution::Distribution;
    use crate::reliability::normal::draw_many;

    fn two(rank: f64) -> Option<Inputs> {
        let free = |of| Bounded { of, least: None, most: None };
        let each = vec![
            free(Distribution::Lognormal { mean: 2.0, deviation: 1.0 }),
            free(Distribution::Uniform { from: 0.0, to: 1.0 }),
        ];
        Inputs::new(each, &[(0, 1, rank)])
    }

    /// Ranks of 20 000 pairs, whose correlation scatters by 1/√n.
    #[test]
    fn pairs_have_the_rank_correlation_that_is_asked_for() {
        let inputs = two(-0.6).unwrap();
        let mut random = fastrand::Rng::with_seed(3);
        let pairs: Vec<Vec<f64>> = (0..20_000).map(|_| inputs.at(&draw_many(2, &mut random))).collect();
        let ranks = |of: usize| {
            let mut order: Vec<usize> = (0..pairs.len()).collect();
            order.sort_by(|a, b| pairs[*a][of].total_cmp(&pairs[*b][of]));
            let mut ranks = vec![0.0; pairs.len()];
            order.into_iter().enumerate().for_each(|(rank, place)| ranks[place] = rank as f64);
            ranks
        };
        let (a, b, middle) = (ranks(0), ranks(1), (pairs.len() - 1) as f64 / 2.0);
        let sum = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| (x - middle) * (y - middle)).sum::<f64>();
        let rank = sum(&a, &b) / sum(&a, &a);
        assert!((rank + 0.6).abs() < 0.02, "{rank}");
    }

    #[test]
    fn correlations_that_nothing_can_have_are_refused() {
        assert!(two(1.0).is_none() && two(0.99).is_some());
        let free = || Bounded { of: Distribution::Normal { mean: 0.0, deviation: 1.0 }, least: None, most: None };
        let each = vec![free(), free(), free()];
        assert!(Inputs::new(each, &[(0, 1, 0.9), (1, 2, 0.9), (0, 2, -0.9)]).is_none());
    }
}
