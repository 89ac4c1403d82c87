//! Sobol indices of independent inputs: the share of the variance of an output that an input brings alone (first order) and with all others
//! (total), from two sets of samples of which one column at a time is exchanged (Saltelli et al., Computer Physics Communications 181, 2010; the total
//! index by Jansen, Computer Physics Communications 117, 1999).

use crate::reliability::normal::draw_many;
use crate::reliability::seed_of;
use crate::starts::{Spread, side_by_side};

/// Indices of one input, each with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indices {
    pub first: [f64; 2],
    pub total: [f64; 2],
}

/// Parts of the samples, whose scatter gives the errors.
const PARTS: usize = 10;

/// The indices of every input, from `samples` · (inputs + 2) evaluations; nothing where the output does not vary.
pub fn sobol(
    dimensions: usize,
    output: &(dyn Fn(&[f64]) -> f64 + Sync),
    samples: usize,
    seed: u64,
    workers: usize,
) -> Option<Vec<Indices>> {
    let each = (samples / PARTS).max(2);
    let parts = side_by_side(workers, PARTS, |part| {
        let mut random = fastrand::Rng::with_seed(seed_of(seed, part as u64));
        of_one_part(dimensions, output, each, &mut random)
    });
    let parts: Option<Vec<Vec<[f64; 2]>>> = parts.into_iter().collect();
    let parts = parts?;
    let over = |input: usize, which: usize| {
        let spread = Spread::of(&parts.iter().map(|part| part[input][which]).collect::<Vec<_>>());
        [spread.mean, spread.deviation / (PARTS as f64).sqrt()]
    };
    Some((0..dimensions).map(|input| Indices { first: over(input, 0), total: over(input, 1) }).collect())
}

/// First and total index of each input.
fn of_one_part(
    dimensions: usize,
    output: &dyn Fn(&[f64]) -> f64,
    samples: usize,
    random: &mut fastrand::Rng,
) -> Option<Vec<[f64; 2]>> {
    let mut draws = || -> Vec<Vec<f64>> { (0..samples).map(|_| draw_many(dimensions, random)).collect() };
    let [a, b] = [draws(), draws()];
    let of = |rows: &[Vec<f64>]| -> Vec<f64> { rows.iter().map(|row| output(row)).collect() };
    let [at_a, at_b] = [of(&a), of(&b)];
    let both = Spread::of(&[at_a.clone(), at_b.clone()].concat());
    let variance = both.deviation * both.deviation;
    // Asked so that what is not a number has none.
    let varies = variance > 1e-18;
    if !varies {
        return None;
    }
    let of_input = |input: usize| {
        let mut mixed = a.clone();
        mixed.iter_mut().zip(&b).for_each(|(row, other)| row[input] = other[input]);
        let at_mixed = of(&mixed);
        let mean = |of: &dyn Fn(usize) -> f64| (0..samples).map(of).sum::<f64>() / samples as f64;
        let first = mean(&|n| (at_b[n] - both.mean) * (at_mixed[n] - at_a[n])) / variance;
        let total = mean(&|n| (at_a[n] - at_mixed[n]).powi(2)) / (2.0 * variance);
        [first, total]
    };
    Some((0..dimensions).map(of_input).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Ishigami's function sin x₁ + a sin² x₂ + b x₃⁴ sin x₁ of three inputs even from −π to π, a = 7, b = 0.1: its published indices
    /// (Ishigami and Homma 1990) are 0.3139, 0.4424, 0 and in total 0.5576, 0.4424, 0.2437.
    #[test]
    fn indices_of_ishigamis_function_are_the_published_ones() {
        let output = |u: &[f64]| {
            let x: Vec<f64> = u.iter().map(|u| PI * (2.0 * crate::reliability::normal::cumulative(*u) - 1.0)).collect();
            libm::sin(x[0]) + 7.0 * libm::sin(x[1]).powi(2) + 0.1 * x[2].powi(4) * libm::sin(x[0])
        };
        let found = sobol(3, &output, 20_000, 4, 2).unwrap();
        for (input, [first, total]) in [[0.3139, 0.5576], [0.4424, 0.4424], [0.0, 0.2437]].into_iter().enumerate() {
            for ([value, error], exact) in [(found[input].first, first), (found[input].total, total)] {
                assert!((value - exact).abs() < 4.0 * error && error < 0.02, "{input}: {value} ± {error}, {exact}");
            }
        }
        assert_eq!(sobol(2, &|_: &[f64]| 1.0, 100, 1, 1), None);
    }
}
