//! Runs a scene from release until the answer no longer changes.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::dem::recorders::histories::{Histories, tail_mean};
use crate::dem::recorders::recorder::Recorder;
use crate::dem::simulation::{Simulation, Unstable};
use crate::scene::build::Scene;

/// Force may change by this share of itself from one stretch to the next and still count as steady.
const STEADY_FORCE: f64 = 0.01;
/// Shares of the mass that may still move, come to rest or get lost.
const STEADY_MOVING: f64 = 0.02;
const STEADY_DEAD: f64 = 0.005;
const STEADY_LOST: f64 = 0.002;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// Force, mass at rest and mass held no longer changed.
    Steady,
    /// The longest time allowed was reached first.
    OutOfTime,
    BrokeDown(Unstable),
    Interrupted,
}

/// What is told while the run goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProgressReport {
    pub time: f64,
    /// Rough share of the run that is done, 0 to 1.
    pub share: f64,
    /// Force on the barrier now (N).
    pub force: f64,
}

/// How a run is watched and stopped from outside.
pub struct Watch<'a> {
    pub progress: &'a (dyn Fn(ProgressReport) + Sync),
    pub stop: &'a AtomicBool,
}

/// A finished run.
pub struct Event {
    pub histories: Histories,
    pub ending: Ending,
    pub simulation: Simulation,
    /// Largest energy imbalance met, over the energy put in.
    pub energy_error: f64,
}

/// Runs `scene`; stops when steady, at `longest` (s), on breakdown or when asked to.
pub fn run(scene: Scene, longest: f64, watch: &Watch) -> Event {
    let stretch = scene.samples_of_rest();
    let Scene { mut simulation, recorder, expected_time, .. } = scene;
    let mut recorder = Recorder::new(recorder);
    let mut energy_error: f64 = 0.0;
    let ending = loop {
        match recorder.step(&mut simulation) {
            Err(unstable) => break Ending::BrokeDown(unstable),
            Ok(false) => continue,
            Ok(true) => {}
        }
        let histories = &recorder.histories;
        let error = simulation.ledger.relative_error(&histories.ledger[0]);
        energy_error = if error.abs() > energy_error.abs() || error.is_nan() { error } else { energy_error };
        let force = histories.force.last().map_or(0.0, |force| force.norm());
        let time = simulation.time;
        (watch.progress)(ProgressReport { time, share: (time / expected_time).min(0.99), force });
        if watch.stop.load(Ordering::Relaxed) {
            break Ending::Interrupted;
        }
        if steady(histories, stretch) {
            break Ending::Steady;
        }
        if time >= longest {
            break Ending::OutOfTime;
        }
    };
    recorder.finish(&simulation);
    Event { histories: recorder.histories, ending, simulation, energy_error }
}

/// Whether the last two stretches tell the same.
fn steady(histories: &Histories, stretch: usize) -> bool {
    let count = histories.time.len();
    if count < 2 * stretch || !histories.moving.last().is_some_and(|moving| *moving < STEADY_MOVING) {
        return false;
    }
    let force: Vec<f64> = histories.force[count - 2 * stretch..].iter().map(|force| force.norm()).collect();
    let (before, after) = (tail_mean(&force[..stretch], stretch), tail_mean(&force, stretch));
    let dead = (histories.dead[count - 1] - histories.dead[count - stretch]).abs();
    let lost = |index: usize| histories.lost[index].iter().sum::<f64>();
    (after - before).abs() <= STEADY_FORCE * after.max(before)
        && dead < STEADY_DEAD
        && lost(count - 1) - lost(count - stretch) < STEADY_LOST
}
