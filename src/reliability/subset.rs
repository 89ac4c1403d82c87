//! Subset simulation: a small probability as a product of larger ones, each that of a level given the one before (Au and Beck, Probabilistic
//! Engineering Mechanics 16, 2001), with conditional samples that adapt their spread (Papaioannou et al., Probabilistic Engineering Mechanics 41, 2015).
//!
//! Samples of a level depend on each other, so that no formula gives an honest interval: it is repeated, and the interval is that of the repeats.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::reliability::monte_carlo::{Counted, of_counts};
use crate::reliability::normal::{draw, draw_many};
use crate::reliability::{LimitStates, Probability, fails, largest, seed_of};
use crate::starts::{Spread, side_by_side};

/// What is asked of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    /// Samples of a level.
    pub samples: usize,
    /// Independent repeats.
    pub repeats: usize,
    pub seed: u64,
    pub workers: usize,
    /// Probability below which it is not followed further.
    pub floor: f64,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    pub probability: Probability,
    /// Of each repeat.
    pub repeats: Vec<f64>,
    /// Evaluations of the limit states in all.
    pub evaluations: usize,
    /// Whether a repeat met a plateau of the utilisation with nothing above it, and could not go on to where failure may be.
    pub stuck: bool,
}

/// Share of a level that goes on to the next.
const SHARE: f64 = 0.1;
/// Levels at the most: a probability below some 10⁻¹² is told as none.
const LEVELS: usize = 12;
/// Share of the probability of all checks together below which one of them alone does not matter, and the least that is sought of one alone.
const MATTERS: f64 = 1e-2;
const LEAST: f64 = 1e-8;
/// Share of moves that are to be accepted, and chains after which the spread of the moves adapts (Papaioannou et al.).
const ACCEPTED: f64 = 0.44;
const GROUP: usize = 10;

/// What came of all checks together and of each alone.
#[derive(Clone, Debug, PartialEq)]
pub struct SubsetResult {
    /// That any check fails, with what plain samples have seen.
    pub any: Probability,
    pub each: Vec<Probability>,
    /// How often all together were asked, and each.
    pub repeats: usize,
    pub evaluations: usize,
    pub stuck: bool,
}

/// The probability that any check fails, and each of the first `checks` of them, where plain samples saw too few failures to tell. All together
/// subset simulation follows the check whose utilisation rises first, which need not be the one that fails first: so each is asked of alone as well,
/// and where one fails more often than all are said to, the checks are taken to fail at different times, which is the most that they can.
pub fn rare(dimensions: usize, states: &LimitStates, checks: usize, plain: &Counted, asked: &Asked) -> SubsetResult {
    let together = subset(dimensions, states, asked);
    let mut evaluations = together.evaluations;
    let each: Vec<Probability> = (0..checks)
        .map(|number| {
            let seen = plain.of_check(number);
            if checks == 1 {
                return together.probability.or_seen(seen);
            }
            let matters = MATTERS * together.probability.value;
            let asked = Asked {
                seed: seed_of(asked.seed, 1000 + number as u64),
                floor: matters.max(LEAST).max(asked.floor),
                ..*asked
            };
            let mut alone = |asked: &Asked| {
                let found = subset(dimensions, &|u| vec![states(u)[number]], asked);
                evaluations += found.evaluations;
                found.probability
            };
            // A rough figure first: most checks are far from failing.
            let rough = alone(&Asked { samples: asked.samples.div_ceil(2), repeats: 2, ..asked });
            if rough.value > matters { alone(&asked).or_seen(seen) } else { seen }
        })
        .collect();
    let missed = each.iter().any(|of_check| of_check.value > together.probability.high);
    let any = match missed {
        true => Probability {
            value: each.iter().map(|it| it.value).sum::<f64>().min(1.0),
            low: each.iter().map(|it| it.low).fold(together.probability.low, f64::max),
            high: each.iter().map(|it| it.high).sum::<f64>().min(1.0),
        },
        false => together.probability,
    };
    let any = any.or_seen(plain.probability());
    SubsetResult { any, each, repeats: asked.repeats, evaluations, stuck: together.stuck }
}

/// The probability that any check fails, of all together.
pub fn subset(dimensions: usize, states: &LimitStates, asked: &Asked) -> Found {
    let used = |u: &[f64]| largest(&states(u));
    let ran = side_by_side(asked.workers, asked.repeats, |repeat| {
        let mut random = fastrand::Rng::with_seed(seed_of(asked.seed, repeat as u64));
        once(dimensions, &used, asked.samples, asked.floor, &mut random)
    });
    let repeats: Vec<f64> = ran.iter().map(|repeat| repeat.probability).collect();
    let stuck = ran.iter().any(|repeat| repeat.stuck);
    let mut probability = of_repeats(&repeats);
    if probability.value == 0.0 {
        // No more than the last level that was reached.
        probability.high = ran.iter().map(|repeat| repeat.reached).fold(0.0, f64::max);
    }
    if stuck {
        // All that is known is that of plain samples none has failed.
        let none = of_counts(0, asked.samples * asked.repeats);
        probability = Probability { low: 0.0, high: probability.high.max(none.high), ..probability };
    }
    Found { probability, evaluations: ran.iter().map(|repeat| repeat.evaluations).sum(), repeats, stuck }
}

/// Points that fail, as they come given failure, from one repeat; none where it finds none.
pub fn failing_points(dimensions: usize, states: &LimitStates, samples: usize, seed: u64) -> Vec<Vec<f64>> {
    once(dimensions, &|u| largest(&states(u)), samples, 0.0, &mut fastrand::Rng::with_seed(seed)).failing
}

/// Mean of independent estimates, with the interval of Student's distribution on its logarithm.
fn of_repeats(repeats: &[f64]) -> Probability {
    let spread = Spread::of(repeats);
    let value = spread.mean;
    if value == 0.0 || spread.starts < 2 {
        return Probability { value, low: 0.0, high: 1.0 };
    }
    let count = spread.starts as f64;
    let student = StudentsT::new(0.0, 1.0, count - 1.0).map_or(f64::NAN, |student| student.inverse_cdf(0.975));
    let width = libm::exp(student * spread.deviation / value / count.sqrt());
    Probability { value, low: value / width, high: (value * width).min(1.0) }
}

/// What one repeat found.
struct Repeat {
    probability: f64,
    /// Probability of the last level.
    reached: f64,
    evaluations: usize,
    stuck: bool,
    failing: Vec<Vec<f64>>,
}

fn once(
    dimensions: usize,
    used: &dyn Fn(&[f64]) -> f64,
    count: usize,
    floor: f64,
    random: &mut fastrand::Rng,
) -> Repeat {
    let mut level: Vec<(Vec<f64>, f64)> = (0..count)
        .map(|_| {
            let u = draw_many(dimensions, random);
            let value = used(&u);
            (u, value)
        })
        .collect();
    let mut repeat = Repeat { probability: 0.0, reached: 1.0, evaluations: count, stuck: false, failing: Vec::new() };
    let mut spread = 0.6;
    let seeds = ((SHARE * count as f64) as usize).max(1);
    for _ in 0..LEVELS {
        let failed = level.iter().filter(|(_, value)| fails(*value)).count();
        if failed >= seeds {
            repeat.reached *= failed as f64 / count as f64;
            repeat.probability = repeat.reached;
            repeat.failing = level.into_iter().filter(|(_, value)| fails(*value)).map(|(u, _)| u).collect();
            return repeat;
        }
        if repeat.reached <= floor {
            break;
        }
        level.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut threshold = level[seeds - 1].1;
        if level[count - 1].1 >= threshold {
            // All stand on one plateau but a few: these lead on.
            let higher = level.iter().map(|(_, value)| *value).take_while(|value| *value > threshold).last();
            match higher {
                Some(higher) => threshold = higher,
                None => {
                    repeat.stuck = true;
                    break;
                }
            }
        }
        let above = level.iter().filter(|(_, value)| *value >= threshold).count();
        repeat.reached *= above as f64 / count as f64;
        level.truncate(above);
        random.shuffle(&mut level);
        level = next(level, threshold, count, used, &mut spread, random);
        repeat.evaluations += count - above;
    }
    repeat
}

/// Samples of the next level: chains from those that are in it, none of which leaves it.
fn next(
    starts: Vec<(Vec<f64>, f64)>,
    threshold: f64,
    count: usize,
    used: &dyn Fn(&[f64]) -> f64,
    spread: &mut f64,
    random: &mut fastrand::Rng,
) -> Vec<(Vec<f64>, f64)> {
    let chains = starts.len();
    let mut samples = Vec::with_capacity(count);
    let (mut accepted, mut moved, mut groups) = (0, 0, 0.0);
    for (number, (mut u, mut value)) in starts.into_iter().enumerate() {
        // As many as leave the same number in all.
        let length = count / chains + usize::from(number < count % chains);
        for step in 0..length {
            if step > 0 {
                let turn = spread.min(1.0);
                let kept = (1.0 - turn * turn).sqrt();
                let there: Vec<f64> = u.iter().map(|u| kept * u + turn * draw(random)).collect();
                let reached = used(&there);
                moved += 1;
                if reached >= threshold {
                    (u, value) = (there, reached);
                    accepted += 1;
                }
            }
            samples.push((u.clone(), value));
        }
        if (number + 1) % GROUP == 0 && moved > 0 {
            groups += 1.0;
            let share = f64::from(accepted) / f64::from(moved);
            *spread *= libm::exp((share - ACCEPTED) / f64::sqrt(groups));
            (accepted, moved) = (0, 0);
        }
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reliability::normal::cumulative;

    /// A plane at the distance β fails with Φ(−β): of twenty intervals nineteen hold it, down to one in a million.
    #[test]
    fn nineteen_of_twenty_intervals_hold_the_probability_of_a_plane() {
        for beta in [2.0, 3.5, 4.75] {
            let states = |u: &[f64]| vec![1.0 + (u[0] + u[1] - u[2] + u[3]) / 2.0 - beta];
            let exact = cumulative(-beta);
            let inside = (0..20).filter(|seed| {
                let asked = Asked { samples: 1000, repeats: 10, seed: *seed, workers: 2, floor: 0.0 };
                let found = subset(4, &states, &asked);
                found.probability.low <= exact && exact <= found.probability.high
            });
            let inside = inside.count();
            assert!(inside >= 17, "{beta}: {inside}");
        }
    }

    /// Plain samples that failed are not overruled by a subset simulation that went another way.
    #[test]
    fn what_plain_samples_have_seen_stands() {
        let found = |low: f64, high: f64| Probability { value: 0.5 * (low + high), low, high };
        let plain = of_counts(2, 20_000);
        assert_eq!(found(0.0, 1e-12).or_seen(plain), plain);
        assert_eq!(found(5e-5, 2e-4).or_seen(plain).high, 2e-4);
    }

    #[test]
    fn what_cannot_fail_does_not_and_what_always_fails_does() {
        let asked = Asked { samples: 200, repeats: 4, seed: 1, workers: 1, floor: 0.0 };
        let never = subset(2, &|u: &[f64]| vec![1.0 + u[0] - 20.0], &asked);
        assert_eq!((never.probability.value, never.stuck), (0.0, false));
        // Twelve levels of a tenth; moves that were refused leave equal values, and with them a little more.
        assert!((0.99e-12..1e-10).contains(&never.probability.high), "{never:?}");
        let always = subset(2, &|_: &[f64]| vec![f64::NAN], &asked);
        assert_eq!((always.probability.value, always.evaluations), (1.0, 800));
        // On a plateau below the limit nothing is found above it, which does not say that nothing is.
        let flat = subset(2, &|_: &[f64]| vec![0.7], &asked);
        assert!(flat.stuck && flat.probability.value == 0.0 && flat.probability.high > 1e-3);
        // A few above a plateau lead on to failure: u₁ > 2, and then u₁ > 3.5.
        let stepped = |u: &[f64]| vec![if u[0] < 2.0 { 0.7 } else { 0.7 + 0.2 * (u[0] - 2.0) }];
        let found = subset(1, &stepped, &Asked { samples: 1000, repeats: 10, ..asked });
        let ratio = found.probability.value / cumulative(-3.5);
        assert!(!found.stuck && (0.6..1.6).contains(&ratio), "{found:?}");
    }
}
