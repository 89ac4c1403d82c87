//! How probable it is that a barrier fails in its event, which inputs that hangs on, and how it grows with the event.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::reliability::form::{DesignPoint, NoPoint, form};
use crate::reliability::monte_carlo::{self, Counted, monte_carlo};
use crate::reliability::sobol::{Indices, sobol};
use crate::reliability::subset::{self, SubsetResult, rare};
use crate::reliability::surrogate::{self, Surrogate, SurrogateResult, learn};
use crate::reliability::{LimitStates, Probability, largest};
use crate::studies::limit_states::{Judged, Tally};

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted<'a> {
    /// Samples of a Monte Carlo run at the most.
    pub samples: usize,
    pub accuracy: f64,
    /// Simulations at the most, and packings at the medians.
    pub runs: usize,
    pub packings: usize,
    pub seed: u64,
    /// Standard normal numbers of the first input at which the probability is told.
    pub events: &'a [f64],
    pub independent: bool,
    pub workers: usize,
}

/// How the probability was found.
#[derive(Debug)]
pub enum Way {
    /// By the equations: samples, and where few of them fail, subset simulation.
    Equations { counted: Counted, rare: Option<SubsetResult> },
    /// By simulations and a surrogate.
    Simulations(Box<SurrogateResult>),
}

/// What came of it.
#[derive(Debug)]
pub struct Assessed {
    pub way: Way,
    /// That any check fails.
    pub probability: Probability,
    pub checks: Vec<OfCheck>,
    /// Of the largest utilisation; nothing where inputs hang together, or it does not vary.
    pub importance: Option<Vec<Indices>>,
    pub fragility: Vec<Probability>,
    /// Samples that are no valid design, by what refused them; they count as failed.
    pub refused: BTreeMap<String, usize>,
    /// Samples, subset simulation's among them, in which a formula was used outside its range.
    pub outside: usize,
    /// Evaluations of the equations or the surrogate in all.
    pub samples: usize,
}

#[derive(Debug)]
pub struct OfCheck {
    pub check: Judged,
    pub probability: Probability,
    pub point: Result<DesignPoint, NoPoint>,
}

/// What a probability is to a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    NotAsked,
    Exceeds,
    Undecided,
}

/// Failed samples below which subset simulation is asked as well.
const FEW: usize = 100;
/// Samples of a level and repeats of subset simulation.
const LEVEL: usize = 1000;
const REPEATS: usize = 10;
/// Samples for the indices of each input, and those of one event.
const OF_INDICES: usize = 2000;
const OF_EVENT: usize = 4000;
/// A utilisation beyond this is taken as this where the variance is told: a wall that tips has no bound.
const FAR_BEYOND: f64 = 5.0;

/// By the equations.
pub fn by_equations(
    dimensions: usize,
    states: &LimitStates,
    checks: &[Judged],
    tally: &Tally,
    wanted: &Wanted,
) -> Assessed {
    tally.take();
    let asked = monte_carlo::Asked {
        samples: wanted.samples,
        variation: wanted.accuracy,
        seed: wanted.seed,
        workers: wanted.workers,
    };
    let counted = monte_carlo(dimensions, states, &asked);
    let rare = (counted.failed < FEW).then(|| {
        // Of another seed, so that the two do not share samples.
        let asked =
            subset::Asked { samples: LEVEL, repeats: REPEATS, seed: !wanted.seed, workers: wanted.workers, floor: 0.0 };
        rare(dimensions, states, checks.len(), &counted, &asked)
    });
    let (refused, outside) = tally.take();
    let of_check = |(number, check): (usize, &Judged)| OfCheck {
        check: check.clone(),
        probability: rare.as_ref().map_or_else(|| counted.of_check(number), |rare| rare.each[number]),
        point: form(dimensions, &|u| states(u)[number]),
    };
    let of_checks: Vec<OfCheck> = checks.iter().enumerate().map(of_check).collect();
    let probability =
        rare.as_ref().map_or_else(|| counted.probability(), |rare| no_less_than_by_form(rare.any, &of_checks));
    Assessed {
        probability,
        checks: of_checks,
        importance: importance(dimensions, states, wanted),
        fragility: fragility(dimensions, states, wanted),
        refused,
        outside,
        samples: counted.samples + rare.as_ref().map_or(0, |rare| rare.evaluations),
        way: Way::Equations { counted, rare },
    }
}

/// A rare probability whose upper bound is no less than what the first-order method finds of any check: it starts from the medians and sees what no
/// sample has.
fn no_less_than_by_form(any: Probability, checks: &[OfCheck]) -> Probability {
    let by_form = checks.iter().filter_map(|check| Some(check.point.as_ref().ok()?.probability()));
    Probability { high: by_form.fold(any.high, f64::max), ..any }
}

/// By simulations.
pub fn by_simulations(
    dimensions: usize,
    runs: &surrogate::Runs,
    checks: &[Judged],
    tally: &Tally,
    wanted: &Wanted,
) -> Result<Assessed, String> {
    tally.take();
    let asked = surrogate::Asked {
        runs: wanted.runs,
        repeats: wanted.packings,
        variation: wanted.accuracy,
        seed: wanted.seed,
        workers: wanted.workers,
    };
    let learned = learn(dimensions, runs, &asked)?;
    let (refused, outside) = tally.take();
    let surrogate: &Surrogate = &learned.surrogate;
    let states = |u: &[f64]| surrogate.used(u);
    let of_check = |(number, check): (usize, &Judged)| OfCheck {
        check: check.clone(),
        probability: learned.of_checks[number],
        point: form(dimensions, &|u| states(u)[number]),
    };
    Ok(Assessed {
        probability: learned.probability,
        checks: checks.iter().enumerate().map(of_check).collect(),
        importance: importance(dimensions, &states, wanted),
        fragility: surrogate.at_events(wanted.events, &asked),
        refused,
        outside,
        samples: learned.runs,
        way: Way::Simulations(Box::new(learned)),
    })
}

fn importance(dimensions: usize, states: &LimitStates, wanted: &Wanted) -> Option<Vec<Indices>> {
    let output = |u: &[f64]| largest(&states(u)).min(FAR_BEYOND);
    wanted.independent.then(|| sobol(dimensions, &output, OF_INDICES, wanted.seed, wanted.workers)).flatten()
}

/// The probability at each event: the first number is fixed, all others scatter.
fn fragility(dimensions: usize, states: &LimitStates, wanted: &Wanted) -> Vec<Probability> {
    let at = |event: &f64| {
        let states = |rest: &[f64]| states(&[&[*event], rest].concat());
        let asked = monte_carlo::Asked {
            samples: OF_EVENT.min(wanted.samples),
            variation: 0.05,
            seed: wanted.seed,
            workers: wanted.workers,
        };
        monte_carlo(dimensions - 1, &states, &asked).probability()
    };
    wanted.events.iter().map(at).collect()
}

impl Assessed {
    /// What the probability is to a target. One that lies below it does not pass by itself: what a run of the design leaves open, because a load or a
    /// course of the event is not covered, is not in the probability.
    pub fn answer(&self, target: Option<f64>) -> Answer {
        match target {
            None => Answer::NotAsked,
            Some(target) if self.probability.low > target => Answer::Exceeds,
            Some(_) => Answer::Undecided,
        }
    }

    /// Simulations that could not be relied on.
    pub fn lost(&self) -> usize {
        match &self.way {
            Way::Equations { .. } => 0,
            Way::Simulations(learned) => learned.unjudged,
        }
    }

    /// The check that is most likely to fail: as it was counted, else by the first-order method, else that which uses most at the medians.
    pub fn governing(&self) -> Option<&OfCheck> {
        let order = |check: &OfCheck| {
            let by_form = check.point.as_ref().map_or(0.0, DesignPoint::probability);
            [check.probability.value, by_form, check.check.at_medians]
        };
        let compare = |a: &&OfCheck, b: &&OfCheck| {
            let pairs = order(a).into_iter().zip(order(b));
            pairs.map(|(a, b)| a.total_cmp(&b)).find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
        };
        self.checks.iter().max_by(compare)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reliability::normal::cumulative;

    /// Two checks: one is close to its limit and rises slowly, u₀ > 5, the other is far from it and rises late, u₁ > 4.3. Samples of both together
    /// follow the first; the second fails thirty times as often.
    #[test]
    fn the_check_that_rises_late_is_not_missed() {
        let states = |u: &[f64]| vec![0.95 + 0.01 * u[0], 0.2 + 0.8 * libm::exp(u[1] - 4.3)];
        let judged = |id: &str| Judged { id: id.into(), title: id.into(), at_medians: 0.0, partly: None };
        let checks = ["slow", "late"].map(judged);
        let exact = cumulative(-5.0) + cumulative(-4.3);
        for seed in 1..4 {
            let wanted = Wanted {
                samples: 20_000,
                accuracy: 0.05,
                runs: 0,
                packings: 0,
                seed,
                events: &[],
                independent: false,
                workers: 2,
            };
            let found = by_equations(2, &states, &checks, &Tally::default(), &wanted);
            let Probability { value, low, high } = found.probability;
            assert!(low <= exact && exact <= high && (0.5..2.0).contains(&(value / exact)), "{:?}", found.probability);
            assert_eq!(found.governing().map(|of| of.check.id.as_str()), Some("late"));
        }
    }
}
