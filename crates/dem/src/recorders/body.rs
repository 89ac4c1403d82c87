//! What every recorder of a part of the barrier does: it takes in steps, and makes a sample of them.

use crate::larger_or_nan;
use crate::recorders::channels::Channels;
use crate::recorders::setup::RecorderSetup;
use crate::simulation::Simulation;

/// Records what one kind of part bears or does: sums over the steps of a sampling interval, so that a sample is a mean and no impulse is
/// lost.
pub trait BodyRecorder {
    /// Takes in a step.
    fn add_step(&mut self, simulation: &Simulation, setup: &RecorderSetup);

    /// Writes the sample of so many steps, and begins anew.
    fn sample(&mut self, simulation: &Simulation, setup: &RecorderSetup, steps: u32, channels: &mut Channels);
}

/// Adds values to sums, one by one.
pub fn add_rows(sums: &mut Vec<f64>, values: &[f64]) {
    sums.resize(values.len(), 0.0);
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += value;
    }
}

/// Adds to sums the means over so many lists of values, of which this is one.
pub fn add_shares(sums: &mut Vec<f64>, values: &[f64], lists: usize) {
    sums.resize(values.len(), 0.0);
    let share = 1.0 / lists as f64;
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += share * value;
    }
}

/// Keeps the larger of each two values, one by one.
pub fn keep_larger(largest: &mut Vec<f64>, values: &[f64]) {
    largest.resize(values.len(), 0.0);
    for (largest, &value) in largest.iter_mut().zip(values) {
        *largest = larger_or_nan(*largest, value);
    }
}

/// Means over so many steps.
pub fn means(sums: &[f64], steps: u32) -> Vec<f64> {
    let mean = 1.0 / f64::from(steps);
    sums.iter().map(|sum| sum * mean).collect()
}
