//! Limit states of which every evaluation is a simulation: a Kriging surrogate that learns where it is least sure on which side of the limit a point lies
//! (AK-MCS: Echard, Gayton and Lemaire, Structural Safety 33, 2011; for several checks the one that governs: Fauriat and Gayton, Reliability Engineering
//! and System Safety 123, 2014).
//!
//! Two equal barriers hit by two equal flows differ, because grains are packed at random. That scatter is measured by repeats at the medians,
//! kept out of the surrogate as noise of its data, and put back as a further random number of every check when the probability is counted.

use egobox_gp::correlation_models::Matern52Corr;
use egobox_gp::mean_models::LinearMean;
use egobox_gp::{GaussianProcess, GpParams};
use linfa::Dataset;
use linfa::traits::Fit;
use ndarray::{Array1, Array2};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::reliability::monte_carlo::{self, monte_carlo};
use crate::reliability::normal::draw_many;
use crate::reliability::subset::{self, failing_points, rare};
use crate::reliability::{Probability, seed_of};
use crate::starts::Spread;

/// Utilisations of a batch of runs; nothing for one that cannot be judged.
pub type Batch = Result<Vec<Option<Vec<f64>>>, String>;

/// Runs a batch of points, each with a packing of its number.
pub type Runs<'a> = dyn Fn(&[(Vec<f64>, u32)]) -> Batch + 'a;

/// What is asked of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    /// Runs at the most.
    pub runs: usize,
    /// Packings at the medians that measure the scatter; 1 where there is none.
    pub repeats: usize,
    /// Half the width of the interval over the probability from which on no more runs are asked for.
    pub variation: f64,
    pub seed: u64,
    pub workers: usize,
}

/// What came of it.
#[derive(Debug)]
pub struct SurrogateResult {
    /// With the interval by what the surrogate does not know, and by counting.
    pub probability: Probability,
    pub of_checks: Vec<Probability>,
    pub runs: usize,
    /// Runs that could not be judged.
    pub unjudged: usize,
    /// Whether the interval became as narrow as asked.
    pub settled: bool,
    /// Standard deviation of the logarithm of each check's utilisation over packings.
    pub scatter: Vec<f64>,
    /// Probability after each round, with the runs so far.
    pub history: Vec<(usize, Probability)>,
    /// For what is asked of the limit states beside the probability.
    pub surrogate: Surrogate,
}

/// Added to a utilisation before its logarithm is taken: a stroke that is not used at all has one as well.
const OFFSET: f64 = 0.1;

/// A utilisation beyond this is as good as any: what is used up without a measure of how far is infinite.
const FAR_BEYOND: f64 = 5.0;

fn transformed(used: f64) -> f64 {
    if used.is_nan() { f64::NAN } else { libm::log(used.clamp(0.0, FAR_BEYOND) + OFFSET) }
}

fn back(value: f64) -> f64 {
    libm::exp(value) - OFFSET
}

/// One Gaussian process for each check.
#[derive(Debug)]
pub struct Surrogate {
    checks: Vec<OfCheck>,
    inputs: usize,
    /// By how much the scatter of packings may be smaller and larger than their number shows.
    scatter_range: [f64; 2],
    /// Points of runs that could be judged, and of those that could not.
    judged: Vec<Vec<f64>>,
    lost: Vec<Vec<f64>>,
}

#[derive(Debug)]
struct OfCheck {
    /// Nothing where all data are alike.
    process: Option<GaussianProcess<f64, LinearMean, Matern52Corr>>,
    constant: f64,
    /// Standard deviation of the packings, of the transformed utilisation.
    scatter: f64,
}

impl Surrogate {
    fn fit(learner: &Learner) -> Result<Self, String> {
        let Learner { data, lost, scatter, repeats, .. } = learner;
        let inputs = data.first().map_or(0, |(u, _)| u.len());
        let checks = scatter.iter().enumerate().map(|(check, scatter)| {
            let known: Vec<(&[f64], f64)> = data
                .iter()
                .map(|(u, used)| (u.as_slice(), transformed(used[check])))
                .filter(|(_, value)| value.is_finite())
                .collect();
            OfCheck::fit(&known, *scatter)
        });
        let judged = data.iter().map(|(u, _)| u.clone()).collect();
        let checks = checks.collect::<Result<_, String>>()?;
        Ok(Self { checks, inputs, scatter_range: range_of_deviation(*repeats), judged, lost: lost.clone() })
    }

    /// Mean and standard deviation of each check's transformed utilisation.
    fn predict(&self, u: &[f64]) -> Vec<[f64; 2]> {
        self.checks.iter().map(|check| check.predict(&u[..self.inputs])).collect()
    }

    /// Utilisations by the mean of the surrogate, without the scatter of packings.
    pub fn used(&self, u: &[f64]) -> Vec<f64> {
        self.predict(u).into_iter().map(|[mean, _]| back(mean)).collect()
    }

    /// Whether the run next to a point could not be judged: what happens there is not known.
    fn unknown(&self, u: &[f64]) -> bool {
        !self.lost.is_empty() && nearest(&u[..self.inputs], &self.lost) < nearest(&u[..self.inputs], &self.judged)
    }

    /// Utilisations with so many standard deviations of what is not known, and the scatter of packings by further standard normal numbers.
    /// Where nothing is known all may fail.
    fn shifted(&self, u: &[f64], shift: f64) -> Vec<f64> {
        if shift > 0.0 && self.unknown(u) {
            return vec![f64::NAN; self.checks.len()];
        }
        let more = match shift {
            0.0 => 1.0,
            shift => self.scatter_range[usize::from(shift > 0.0)],
        };
        let at = self.predict(u).into_iter().zip(&self.checks).enumerate();
        at.map(|(number, ([mean, deviation], check))| {
            back(mean + shift * deviation + more * check.scatter * u[self.inputs + number])
        })
        .collect()
    }

    /// How many standard deviations the governing check is from its limit.
    fn sureness(&self, u: &[f64]) -> f64 {
        let limit = transformed(1.0);
        let governing = self.predict(u).into_iter().max_by(|a, b| a[0].total_cmp(&b[0]));
        governing.map_or(f64::INFINITY, |[mean, deviation]| (mean - limit).abs() / deviation.max(1e-9))
    }
}

impl OfCheck {
    fn fit(known: &[(&[f64], f64)], scatter: f64) -> Result<Self, String> {
        let values: Vec<f64> = known.iter().map(|(_, value)| *value).collect();
        let spread = Spread::of(&values);
        let flat = Self { process: None, constant: spread.mean, scatter };
        let varies = spread.deviation > 1e-9;
        if !varies {
            return Ok(flat);
        }
        let inputs = known[0].0.len();
        let points = Array2::from_shape_fn((known.len(), inputs), |(row, column)| known[row].0[column]);
        let data = Dataset::new(points, Array1::from(values));
        // The noise is given over the variance of the process, which is known once it is fitted.
        let mut variance = spread.deviation.powi(2);
        let mut process = None;
        for _ in 0..2 {
            let nugget = (scatter * scatter / variance).clamp(1e-8, 10.0);
            let params = GpParams::new(LinearMean::default(), Matern52Corr::default()).nugget(nugget);
            let fitted = params.fit(&data).map_err(|error| format!("the surrogate could not be fitted: {error}"))?;
            variance = fitted.variance().max(1e-12);
            process = Some(fitted);
        }
        Ok(Self { process, ..flat })
    }

    fn predict(&self, u: &[f64]) -> [f64; 2] {
        let Some(process) = &self.process else { return [self.constant, 0.0] };
        let point = Array2::from_shape_fn((1, u.len()), |(_, column)| u[column]);
        match process.predict_valvar(&point) {
            Ok((value, variance)) => [value[0], variance[0].max(0.0).sqrt()],
            Err(_) => [f64::NAN, f64::NAN],
        }
    }
}

/// Plain samples among which the next run is sought, and samples of a level of those that fail.
const CANDIDATES: usize = 1000;
/// Samples by which the probability is counted while it learns, and in the end.
const COUNTED: [usize; 2] = [2000, 20_000];
/// The same at one event.
const OF_EVENT: usize = 2000;
/// Standard deviations of a confidence of 95 %.
const WIDE: f64 = 1.96;
/// Spread of the first points, in standard deviations of the inputs: failures are not found at the medians.
const FIRST_SPREAD: f64 = 1.6;

/// Learns until the probability is known well enough or the runs are used up.
pub fn learn(inputs: usize, runs: &Runs, asked: &Asked) -> Result<SurrogateResult, String> {
    let mut learner = Learner::begin(inputs, runs, asked)?;
    let mut history = Vec::new();
    let (surrogate, settled) = loop {
        let surrogate = Surrogate::fit(&learner)?;
        let round = history.len() as u64;
        let counted = surrogate.count(COUNTED[0], asked, round).0;
        history.push((learner.ran, counted));
        let settled = counted.high - counted.low <= 2.0 * asked.variation * counted.value;
        let left = asked.runs.saturating_sub(learner.ran);
        if settled || left == 0 {
            break (surrogate, settled);
        }
        let points = surrogate.least_sure(asked.workers.min(left), seed_of(asked.seed, round));
        learner.run(points)?;
    };
    let (probability, of_checks) = surrogate.count(COUNTED[1], asked, u64::MAX);
    Ok(SurrogateResult {
        probability,
        of_checks,
        runs: learner.ran,
        unjudged: learner.lost.len(),
        settled,
        scatter: learner.scatter,
        history,
        surrogate,
    })
}

/// Runs so far.
struct Learner<'a> {
    runs: &'a Runs<'a>,
    data: Vec<(Vec<f64>, Vec<f64>)>,
    scatter: Vec<f64>,
    /// Points whose runs could not be judged.
    lost: Vec<Vec<f64>>,
    ran: usize,
    /// Runs at the medians.
    repeats: usize,
}

/// By what a standard deviation of so many values is to be multiplied for the ends of its interval with a confidence of 95 %: √((n − 1)/χ²).
fn range_of_deviation(count: usize) -> [f64; 2] {
    let free = count.saturating_sub(1) as f64;
    let end = |share: f64| ChiSquared::new(free).map_or(1.0, |of| (free / of.inverse_cdf(share)).sqrt());
    if count < 2 { [1.0; 2] } else { [end(0.975), end(0.025)] }
}

impl<'a> Learner<'a> {
    /// Repeats at the medians, and the first points.
    fn begin(inputs: usize, runs: &'a Runs<'a>, asked: &Asked) -> Result<Self, String> {
        let repeats = asked.repeats.max(1);
        let mut learner = Self { runs, data: Vec::new(), scatter: Vec::new(), lost: Vec::new(), ran: 0, repeats };
        learner.run(vec![vec![0.0; inputs]; repeats])?;
        if !learner.lost.is_empty() {
            return Err(
                "a simulation at the medians of the inputs cannot be relied on, so there is nothing to start from"
                    .into(),
            );
        }
        let of_check = |check: usize| {
            let values: Vec<f64> = learner.data.iter().map(|(_, used)| transformed(used[check])).collect();
            Spread::of(&values).deviation
        };
        learner.scatter = (0..learner.data[0].1.len()).map(of_check).collect();
        let first = (3 * inputs).max(10).min(asked.runs.saturating_sub(repeats));
        learner.run(spread_out(inputs, first, &mut fastrand::Rng::with_seed(asked.seed)))?;
        Ok(learner)
    }

    /// Runs points, each with a packing that no other has.
    fn run(&mut self, points: Vec<Vec<f64>>) -> Result<(), String> {
        let batch: Vec<(Vec<f64>, u32)> =
            points.into_iter().enumerate().map(|(number, u)| (u, (self.ran + number) as u32)).collect();
        let found = (self.runs)(&batch)?;
        self.ran += batch.len();
        for ((u, _), used) in batch.into_iter().zip(found) {
            match used {
                Some(used) => self.data.push((u, used)),
                None => self.lost.push(u),
            }
        }
        Ok(())
    }
}

/// Points far from each other: each the farthest from those before among some drawn ones.
fn spread_out(inputs: usize, count: usize, random: &mut fastrand::Rng) -> Vec<Vec<f64>> {
    let mut points: Vec<Vec<f64>> = vec![vec![0.0; inputs]];
    while points.len() <= count {
        let drawn = (0..50).map(|_| draw_many(inputs, random).iter().map(|u| FIRST_SPREAD * u).collect::<Vec<f64>>());
        // Within what comes at all.
        let within = drawn.filter(|point| point.iter().all(|u| u.abs() <= 3.0));
        let farthest = within.max_by(|a, b| nearest(a, &points).total_cmp(&nearest(b, &points)));
        points.extend(farthest);
    }
    points.split_off(1)
}

/// Squared distance to the nearest of some points.
fn nearest(point: &[f64], points: &[Vec<f64>]) -> f64 {
    let apart = |other: &Vec<f64>| point.iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    points.iter().map(apart).fold(f64::INFINITY, f64::min)
}

impl Surrogate {
    /// The probability of failure of any check where the first input has given standard normal numbers.
    pub fn at_events(&self, events: &[f64], asked: &Asked) -> Vec<Probability> {
        let at = |event: &f64| {
            let of = |shift: f64| {
                let states = |rest: &[f64]| self.shifted(&[&[*event], rest].concat(), shift);
                let plain =
                    monte_carlo::Asked { samples: OF_EVENT, variation: 0.05, seed: asked.seed, workers: asked.workers };
                monte_carlo(self.inputs - 1 + self.checks.len(), &states, &plain).probability()
            };
            wide([-WIDE, 0.0, WIDE].map(of))
        };
        events.iter().map(at).collect()
    }

    /// The points of which it is least sure, not next to each other nor to a run.
    fn least_sure(&self, count: usize, seed: u64) -> Vec<Vec<f64>> {
        let mut random = fastrand::Rng::with_seed(seed);
        let plain = (0..CANDIDATES).map(|_| draw_many(self.inputs, &mut random));
        let mut candidates: Vec<Vec<f64>> = plain.collect();
        candidates.extend(failing_points(self.inputs, &|u| self.used(u), CANDIDATES / 3, seed));
        let mut rated: Vec<(f64, Vec<f64>)> = candidates.into_iter().map(|u| (self.sureness(&u), u)).collect();
        rated.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut points: Vec<Vec<f64>> = Vec::new();
        let mut taken = [&self.judged[..], &self.lost[..]].concat();
        // Next to a run that could not be judged another would not be either: there only where nothing else is left.
        for (apart, anywhere) in [(0.3, false), (0.05, false), (0.0, true)] {
            for (_, u) in &rated {
                if points.len() < count && nearest(u, &taken) > apart * apart && (anywhere || !self.unknown(u)) {
                    points.push(u.clone());
                    taken.push(u.clone());
                }
            }
        }
        points
    }

    /// The probability of failure, of any check and of each, with what the surrogate does not know as the interval.
    fn count(&self, samples: usize, asked: &Asked, round: u64) -> (Probability, Vec<Probability>) {
        let dimensions = self.inputs + self.checks.len();
        let seed = seed_of(asked.seed, round);
        let at = |shift: f64| {
            let states = |u: &[f64]| self.shifted(u, shift);
            let plain = monte_carlo::Asked { samples, variation: 0.02, seed, workers: asked.workers };
            let counted = monte_carlo(dimensions, &states, &plain);
            if counted.failed >= 50 {
                let each = (0..self.checks.len()).map(|check| counted.of_check(check));
                return (counted.probability(), each.collect());
            }
            // While it learns a rough figure is enough.
            let repeats = if samples == COUNTED[0] { 2 } else { 6 };
            let asked_of_rare = subset::Asked { samples: 1000, repeats, seed, workers: asked.workers, floor: 0.0 };
            let found = rare(dimensions, &states, self.checks.len(), &counted, &asked_of_rare);
            (found.any, found.each)
        };
        let [low, middle, high] = [-WIDE, 0.0, WIDE].map(at);
        let each = low.1.iter().zip(&middle.1).zip(&high.1).map(|((low, middle), high)| wide([*low, *middle, *high]));
        (wide([low.0, middle.0, high.0]), each.collect())
    }
}

/// The middle one with the bounds of all three.
fn wide([low, middle, high]: [Probability; 3]) -> Probability {
    Probability { value: middle.value, low: low.low.min(middle.low), high: high.high.max(middle.high) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reliability::normal::cumulative;

    /// A load that grows with the square of one input over a strength, and a second check, with packings that scatter by 5 %.
    fn used(u: &[f64], noise: [f64; 2]) -> Vec<f64> {
        let load = (3.0 + 0.6 * u[0]).powi(2) * libm::exp(0.05 * noise[0]);
        vec![load / (20.0 * libm::exp(0.1 * u[1])), 0.3 * libm::exp(0.3 * u[2] + 0.02 * noise[1])]
    }

    fn runs(scatter: f64) -> impl Fn(&[(Vec<f64>, u32)]) -> Batch {
        move |batch| {
            let one = |(u, packing): &(Vec<f64>, u32)| {
                let mut random = fastrand::Rng::with_seed(u64::from(*packing));
                let noise = draw_many(2, &mut random);
                Some(used(u, [scatter * noise[0], scatter * noise[1]]))
            };
            Ok(batch.iter().map(one).collect())
        }
    }

    #[test]
    fn forty_runs_tell_what_a_million_samples_tell() {
        let asked = Asked { runs: 40, repeats: 5, variation: 0.1, seed: 1, workers: 2 };
        let learned = learn(3, &runs(1.0), &asked).unwrap();
        let plain = monte_carlo::Asked { samples: 1_000_000, variation: 0.0, seed: 9, workers: 2 };
        let states = |u: &[f64]| used(u, [u[3], u[4]]);
        let exact = monte_carlo(5, &states, &plain).probability();
        let found = learned.probability;
        assert!(found.low <= exact.high && found.high >= exact.low, "{found:?}, {exact:?}");
        assert!((found.value / exact.value - 1.0).abs() < 0.3, "{found:?}, {exact:?}");
        assert!(learned.runs <= 40 && learned.unjudged == 0);
    }

    /// Ends of the interval of a standard deviation from the tables of χ²: of five values 0.599 and 2.874 times, of two 0.446 and 31.9 times.
    #[test]
    fn a_scatter_of_few_packings_is_known_roughly() {
        for (count, ends) in [(5, [0.599, 2.874]), (2, [0.446, 31.91]), (1, [1.0, 1.0])] {
            for (found, end) in range_of_deviation(count).into_iter().zip(ends) {
                assert!((found / end - 1.0).abs() < 2e-3, "{count}: {found}");
            }
        }
    }

    #[test]
    fn a_small_probability_is_learned_too() {
        let states = |u: &[f64]| vec![0.5 * libm::exp(0.15 * (u[0] + u[1]))];
        let runs = |batch: &[(Vec<f64>, u32)]| Ok(batch.iter().map(|(u, _)| Some(states(u))).collect::<Vec<_>>());
        let learned = learn(2, &runs, &Asked { runs: 40, repeats: 1, variation: 0.2, seed: 3, workers: 1 }).unwrap();
        let exact = cumulative(-libm::log(2.0) / (0.15 * 2.0_f64.sqrt()));
        let found = learned.probability;
        assert!(found.low <= exact && exact <= found.high, "{found:?}, {exact}");
        assert!((found.value / exact - 1.0).abs() < 0.5, "{found:?}, {exact}");
    }

    #[test]
    fn runs_that_cannot_be_judged_are_counted_and_none_at_the_medians_is_an_error() {
        let asked = Asked { runs: 20, repeats: 2, variation: 0.01, seed: 3, workers: 2 };
        let broken = |batch: &[(Vec<f64>, u32)]| {
            Ok(batch.iter().map(|(u, _)| (u[0] < 1.0).then(|| vec![0.9 + 0.1 * u[0]])).collect::<Vec<_>>())
        };
        let learned = learn(1, &broken, &asked).unwrap();
        assert!(learned.unjudged > 0 && learned.runs <= 20);
        // All above u = 1 is unknown, and fails in truth: the interval says that it may.
        assert!(learned.probability.high > 0.8 * cumulative(-1.0), "{:?}", learned.probability);
        let none = |batch: &[(Vec<f64>, u32)]| Ok(vec![None; batch.len()]);
        assert!(learn(1, &none, &asked).is_err());
    }
}
