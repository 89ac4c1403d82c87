//! Monte Carlo: the share of samples that fail, with the interval of Clopper and Pearson (Biometrika 26, 1934).

use statrs::distribution::{Beta, ContinuousCDF};

use crate::reliability::normal::draw_many;
use crate::reliability::{LimitStates, Probability, fails, largest, seed_of};
use crate::starts::side_by_side;

/// What is asked of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    /// Samples at the most.
    pub samples: usize,
    /// Coefficient of variation of the barrier's probability from which on no more are drawn.
    pub variation: f64,
    pub seed: u64,
    pub workers: usize,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Counted {
    pub samples: usize,
    /// Samples in which any check failed.
    pub failed: usize,
    /// Samples in which each check failed.
    pub of_checks: Vec<usize>,
    /// Samples in which some check could not be judged; they count as failed.
    pub unjudged: usize,
    /// Largest utilisation of each sample, rising.
    pub used: Vec<f64>,
}

impl Counted {
    pub fn probability(&self) -> Probability {
        of_counts(self.failed, self.samples)
    }

    pub fn of_check(&self, number: usize) -> Probability {
        of_counts(self.of_checks[number], self.samples)
    }

    /// The utilisation that a share of the samples does not exceed.
    pub fn quantile(&self, share: f64) -> f64 {
        let place = (share * self.used.len() as f64) as usize;
        self.used.get(place.min(self.used.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
    }
}

/// The share of counts, with the exact interval of a binomial count.
pub fn of_counts(failed: usize, samples: usize) -> Probability {
    let (k, n) = (failed as f64, samples as f64);
    let bound = |a: f64, b: f64, share: f64| Beta::new(a, b).map_or(f64::NAN, |beta| beta.inverse_cdf(share));
    Probability {
        value: k / n,
        low: if failed == 0 { 0.0 } else { bound(k, n - k + 1.0, 0.025) },
        high: if failed == samples { 1.0 } else { bound(k + 1.0, n - k, 0.975) },
    }
}

/// Samples that are drawn from one seed, and blocks after which it is asked whether they are enough.
const BLOCK: usize = 250;
const BLOCKS: usize = 16;

/// Draws samples until the probability is known well enough, or there are as many as asked for. Does not depend on the number of workers.
pub fn monte_carlo(dimensions: usize, states: &LimitStates, asked: &Asked) -> Counted {
    let mut all = Counted { samples: 0, failed: 0, of_checks: Vec::new(), unjudged: 0, used: Vec::new() };
    let mut block = 0;
    while all.samples < asked.samples {
        let left = asked.samples - all.samples;
        let sizes: Vec<usize> =
            (0..BLOCKS).map(|number| left.saturating_sub(number * BLOCK).min(BLOCK)).filter(|size| *size > 0).collect();
        let parts = side_by_side(asked.workers, sizes.len(), |number| {
            let mut random = fastrand::Rng::with_seed(seed_of(asked.seed, block + number as u64));
            (0..sizes[number]).map(|_| states(&draw_many(dimensions, &mut random))).collect::<Vec<_>>()
        });
        block += sizes.len() as u64;
        for used in parts.into_iter().flatten() {
            all.add(&used);
        }
        if all.failed > 0 {
            let share = all.failed as f64 / all.samples as f64;
            let variation = ((1.0 - share) / all.failed as f64).sqrt();
            if variation <= asked.variation {
                break;
            }
        }
    }
    all.used.sort_by(f64::total_cmp);
    all
}

impl Counted {
    fn add(&mut self, used: &[f64]) {
        self.of_checks.resize(used.len(), 0);
        for (count, used) in self.of_checks.iter_mut().zip(used) {
            *count += usize::from(fails(*used));
        }
        let largest = largest(used);
        self.failed += usize::from(fails(largest));
        self.unjudged += usize::from(used.iter().any(|used| used.is_nan()));
        self.samples += 1;
        self.used.push(largest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reliability::normal::cumulative;
    use approx::assert_relative_eq;

    /// Limits of counts from the tables of Clopper and Pearson's interval.
    #[test]
    fn intervals_of_counts_are_those_of_the_tables() {
        let ten = of_counts(1, 10);
        assert_relative_eq!(ten.low, 0.002_529, max_relative = 1e-3);
        assert_relative_eq!(ten.high, 0.445_02, max_relative = 1e-4);
        // None of n: 1 − 0.025^(1/n).
        assert_relative_eq!(of_counts(0, 1000).high, 1.0 - libm::pow(0.025, 1e-3), max_relative = 1e-6);
        assert_eq!((of_counts(0, 10).low, of_counts(10, 10).high), (0.0, 1.0));
    }

    /// A plane at the distance β from the origin fails with Φ(−β); the interval holds that in 95 of 100 repeats.
    #[test]
    fn the_interval_holds_the_probability_of_a_plane() {
        let states = |u: &[f64]| vec![1.0 + (u[0] + u[1]) / 2.0_f64.sqrt() - 1.5, f64::NEG_INFINITY];
        let exact = cumulative(-1.5);
        let inside = (0..100).filter(|seed| {
            let asked = Asked { samples: 4000, variation: 0.0, seed: *seed, workers: 1 };
            let found = monte_carlo(2, &states, &asked).probability();
            found.low <= exact && exact <= found.high
        });
        let inside = inside.count();
        assert!((88..=100).contains(&inside), "{inside}");
    }

    #[test]
    fn samples_are_the_same_on_any_number_of_workers_and_stop_when_enough() {
        let states = |u: &[f64]| vec![u[0], if u[1] > 3.0 { f64::NAN } else { 0.0 }];
        let asked = |workers| Asked { samples: 100_000, variation: 0.05, seed: 1, workers };
        let [one, three] = [1, 3].map(|workers| monte_carlo(2, &states, &asked(workers)));
        assert_eq!(one, three);
        assert_eq!(one.samples, 4000);
        assert_eq!(one.unjudged, one.of_checks[1]);
        assert!(one.failed >= one.of_checks[0] && one.quantile(0.5).abs() < 0.1);
    }
}
