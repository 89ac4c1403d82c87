//! Where steps break: small scenes of every kind of contact and element, each stepped at shares of the limit that the program
//! estimates, with the audit that would cut the step switched off.

use serde::{Deserialize, Serialize};

use crate::checks::credibility::{ENERGY_LIMIT, Numerics, doubts};
use crate::studies::stability_scenes::Scene;
use dem::simulation::Simulation;

/// How a run went.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StepOutcome {
    /// The energy account closes to the limit of credibility.
    Stable,
    /// It does not, but nothing grows without end.
    Drifting,
    /// Energy grows beyond twice what there was, or the run breaks down.
    Unstable,
    /// A grain goes through a rope.
    Tunnelling,
}

impl StepOutcome {
    pub fn word(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Drifting => "drifting",
            Self::Unstable => "unstable",
            Self::Tunnelling => "tunnelling",
        }
    }
}

/// One run at a share of the estimated limit.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trial {
    pub share: f64,
    pub fate: StepOutcome,
    /// Energy unaccounted for over the energy there was: the largest, and the largest that was made from nothing.
    pub imbalance: f64,
    pub made: f64,
    /// What the program's own guards say; empty if they see nothing.
    pub noticed: Vec<String>,
}

impl Trial {
    /// Whether there was clearly more energy than there could be: the step is above the true limit.
    fn makes_energy(&self) -> bool {
        // Asked so that a NaN counts.
        let within = self.made <= MADE;
        self.fate == StepOutcome::Unstable || !within
    }
}

/// A scene with its limits and all its trials.
#[derive(Clone, Debug)]
pub struct Mapped {
    pub name: &'static str,
    pub what: &'static str,
    pub linear: bool,
    pub limits: Limits,
}

/// What the runs of a scene have shown. All that is kept of them.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Limits {
    /// Critical step that the program estimates (s).
    pub estimated: f64,
    /// Largest share of it at which a run does not yet make energy from nothing.
    pub true_share: f64,
    pub trials: Vec<Trial>,
}

impl Mapped {
    /// The scene with what its runs have shown.
    pub fn new(scene: &Scene, limits: Limits) -> Self {
        let Scene { name, what, linear, .. } = *scene;
        Self { name, what, linear, limits }
    }

    /// The estimate is never above the true limit.
    pub fn safe(&self) -> bool {
        self.limits.true_share >= 1.0
    }

    /// Estimate over true limit.
    pub fn sharpness(&self) -> f64 {
        1.0 / self.limits.true_share
    }

    /// What the estimate is worth.
    pub fn word(&self) -> &'static str {
        match (self.linear, self.safe(), self.sharpness() >= SHARP) {
            (false, ..) => "not of the scene as built",
            (_, false, _) => "NOT SAFE",
            (_, true, false) => "safe, not sharp",
            (_, true, true) => "safe and sharp",
        }
    }

    /// Every run that went wrong was noticed, or stepped so that the audit would have cut the step.
    pub fn all_caught(&self) -> bool {
        let wrong = |trial: &&Trial| matches!(trial.fate, StepOutcome::Unstable | StepOutcome::Tunnelling);
        self.limits.trials.iter().filter(wrong).all(|trial| !trial.noticed.is_empty())
    }
}

/// Estimate over true limit from which on the estimate counts as sharp.
const SHARP: f64 = 0.6;

/// Steps between two looks at the energy.
const STEPS_PER_LOOK: usize = 20;
/// Growth of the energy that counts as unstable.
const GROWTH: f64 = 1.0;
/// Energy from nothing, over what there was, that tells a step above the true limit. Contacts and ropes whose force sets in within a
/// step make and lose up to a third of that by turns at any length of it.
const MADE: f64 = 5.0 * ENERGY_LIMIT;
/// Halvings of the bracket round the true limit.
const HALVINGS: usize = 7;

/// Maps a scene: `shares` of its estimated limit, `steps` steps each.
pub fn map(scene: &Scene, shares: &[f64], steps: usize) -> Limits {
    let estimated = limit(scene, steps);
    let trials: Vec<Trial> = shares.iter().map(|share| trial(scene, *share, estimated, steps)).collect();
    // Between the last share that makes no energy from nothing and the first that does. (A contact that opens may keep what a
    // step too long makes from growing without end, so that such a run drifts only.)
    let bad = |trial: &&Trial| trial.makes_energy();
    let first_bad = trials.iter().find(bad).map(|trial| trial.share);
    let last_good = trials.iter().take_while(|trial| !bad(trial)).map(|trial| trial.share).fold(0.0, f64::max);
    let mut bracket = [last_good, first_bad.unwrap_or(f64::INFINITY)];
    if bracket[1].is_finite() {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (bracket[0] + bracket[1]);
            let unstable = trial(scene, middle, estimated, steps).makes_energy();
            bracket[usize::from(unstable)] = middle;
        }
    }
    Limits { estimated, true_share: bracket[0], trials }
}

/// Critical step that the program estimates (s): the least over a run in short steps, as the audit of a run sees it.
fn limit(scene: &Scene, steps: usize) -> f64 {
    const STEP: f64 = 1e-6;
    let mut simulation = Simulation::new((scene.build)(), STEP, 0.01, 1e6);
    let first = STEP / simulation.step_over_critical();
    simulation = Simulation::new((scene.build)(), 0.1 * first, 0.01, 1e6);
    simulation.audited = false;
    let mut least = first;
    for step in 0..steps {
        if simulation.step().is_err() {
            break;
        }
        if step % STEPS_PER_LOOK == 0 {
            least = least.min(simulation.time_step / simulation.step_over_critical());
        }
    }
    least
}

fn trial(scene: &Scene, share: f64, estimated: f64, steps: usize) -> Trial {
    let mut simulation = Simulation::new((scene.build)(), share * estimated, 0.01, 1e6);
    simulation.audited = false;
    let mut numerics = Numerics { step_ratio: share, ..Numerics::default() };
    let (mut imbalance, mut made): (f64, f64) = (0.0, 0.0);
    let mut start = None;
    for step in 0..steps {
        let look = step % STEPS_PER_LOOK == 0;
        let done = if look { simulation.step_and_account() } else { simulation.step() };
        if let Err(unstable) = done {
            numerics.broke_down = Some(unstable.to_string());
            break;
        }
        if look {
            let ledger = simulation.ledger;
            let (first, scale) = *start.get_or_insert_with(|| {
                let there = ledger.kinetic.abs() + ledger.stored_contacts + ledger.stored_barrier;
                (ledger.total(), there.max(f64::MIN_POSITIVE))
            });
            let now = (ledger.total() - first) / scale;
            imbalance = if now.abs() > imbalance.abs() || now.is_nan() { now } else { imbalance };
            made = if now > made || now.is_nan() { now } else { made };
            if imbalance.is_nan() || imbalance.abs() > 1e6 {
                break;
            }
        }
    }
    numerics.energy_error = imbalance;
    numerics.overlap = simulation.extremes.overlap_ratio;
    numerics.crossings = simulation.extremes.crossings;
    let fate = if numerics.crossings > 0 {
        StepOutcome::Tunnelling
    } else if numerics.broke_down.is_some() || imbalance.is_nan() || imbalance.abs() > GROWTH {
        StepOutcome::Unstable
    } else if imbalance.abs() > ENERGY_LIMIT {
        StepOutcome::Drifting
    } else {
        StepOutcome::Stable
    };
    let mut noticed = doubts(&numerics);
    if share > 1.0 {
        noticed.push("the audit would have cut the step".into());
    }
    Trial { share, fate, imbalance, made, noticed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::stability_scenes::SCENES;

    #[test]
    fn the_estimate_of_a_row_is_that_of_the_closed_form() {
        // Balls between walls: ω² = 4 k/m at the most, the walls being twice as stiff a touch more.
        let mapped = Mapped::new(&SCENES[0], map(&SCENES[0], &[0.5, 1.5], 2000));
        assert!(mapped.safe() && mapped.sharpness() > 0.6, "{mapped:?}");
        assert_eq!(mapped.limits.trials[0].fate, StepOutcome::Stable);
        assert_eq!(mapped.limits.trials[1].fate, StepOutcome::Unstable);
        assert!(mapped.all_caught());
    }
}
