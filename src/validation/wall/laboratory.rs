//! The laboratory wall of Jiang & Towhata 2013 as in Albaba 2015, chapter 3: one way to run it, and its variants.

use std::sync::atomic::AtomicBool;

use crate::design::Arrival;
use crate::design::read::read_design;
use crate::design::sizes::SizeCurve;
use crate::fidelity::choose;
use crate::guideline::guideline;
use crate::quantities::observed::Observed;
use crate::quantities::reading::Samples;
use crate::quantities::total_force;
use crate::scene::build::{SAMPLES_PER_WINDOW, build};
use crate::scene::event::{Ending, Ongoing, RunControl};
use crate::validation::case::Broken;
use dem::ledger::Ledger;
use dem::recorders::histories::{Histories, smoothed};

const DESIGN: &str = include_str!("../../../designs/flume_l44_h15_a40.yaml");
/// Length of the chute (m).
const CHUTE: f64 = 2.19;
/// Width and height of the sample box of the design (m), and the weight of the sample (N/m³).
const WIDTH: f64 = 0.30;
const HEIGHT: f64 = 0.15;
const UNIT_WEIGHT: f64 = 13.5e3;

/// A variant of the test.
#[derive(Clone, Copy, Debug)]
pub struct Variant {
    /// Length of the sample box (m).
    pub length: f64,
    /// rad
    pub slope: f64,
    pub restitution: f64,
    /// 1 for spheres.
    pub aspect: f64,
    /// All grain sizes over those of the design.
    pub coarser: f64,
    pub seed: u64,
}

impl Variant {
    /// The calibration test L44-H15-α40.
    pub fn calibration(seed: u64) -> Self {
        Self { length: 0.44, slope: 40_f64.to_radians(), restitution: 0.3, aspect: 1.5, coarser: 1.0, seed }
    }

    /// The test L34-H15-α45, a prediction.
    pub fn prediction(seed: u64) -> Self {
        Self { length: 0.34, slope: 45_f64.to_radians(), ..Self::calibration(seed) }
    }
}

/// What one run showed. Forces per metre of width.
pub struct Run {
    pub observed: Observed,
    pub histories: Histories,
    /// Samples in the smoothing window.
    pub window: usize,
    pub energy_error: f64,
}

impl Run {
    /// Total force normal to the wall, raw (N/m).
    pub fn force(&self) -> Vec<f64> {
        self.histories.force.iter().map(|force| force.x / WIDTH).collect()
    }

    pub fn peak(&self) -> f64 {
        self.observed.one(&total_force::PEAK) / WIDTH
    }

    pub fn residual(&self) -> f64 {
        self.observed.one(&total_force::RESIDUAL) / WIDTH
    }

    /// Time integral of the rotational over that of the kinetic energy between two times after the release (s).
    pub fn rotational_share(&self, from: f64, to: f64) -> f64 {
        let at = |time: f64| self.histories.time.partition_point(|t| *t < time);
        let ledgers = &self.histories.ledger[at(from)..at(to)];
        let sum = |part: fn(&Ledger) -> f64| ledgers.iter().map(part).sum::<f64>();
        sum(|ledger| ledger.rotational) / sum(|ledger| ledger.kinetic)
    }

    /// Fluctuation of the force from step to step in the 0.43 s before and the 0.07 s after its peak (N/m): standard
    /// deviation, and largest deviation above the smoothed force.
    pub fn fluctuation(&self) -> [f64; 2] {
        let smooth = smoothed(&self.force(), self.window);
        let at = |time: f64| self.histories.time.partition_point(|t| *t < time);
        let peak = self.observed.one(&total_force::PEAK_TIME);
        let stretch = at(peak - 0.43)..at(peak + 0.07);
        let count = stretch.len() as f64;
        let squares: f64 = stretch.clone().map(|index| self.histories.force_scatter[index].powi(2)).sum();
        let above = stretch.map(|index| self.histories.force_instant[index] / WIDTH - smooth[index]);
        [(squares / count).sqrt() / WIDTH, above.fold(0.0, f64::max)]
    }

    /// Share of the push of the grains at rest in the total force, at its peak and at the end.
    pub fn share_at_rest(&self) -> [f64; 2] {
        let total = smoothed(&self.force(), self.window);
        let at_rest = smoothed(&self.histories.push_at_rest, self.window);
        let last = total.len() - 1;
        let peak = (0..=last).max_by(|a, b| total[*a].total_cmp(&total[*b])).unwrap_or(last);
        [peak, last].map(|index| at_rest[index] / WIDTH / total[index])
    }
}

/// Runs one variant from packing to rest.
pub fn run_variant(variant: &Variant) -> Result<Run, Broken> {
    let file = read_design("flume", DESIGN.as_bytes()).map_err(|problems| Broken::Scene(problems.to_string()))?;
    let mut design = file.design;
    design.flow.mass = variant.length * WIDTH * HEIGHT * UNIT_WEIGHT / crate::units::GRAVITY;
    design.channel.slope = variant.slope;
    design.flow.restitution = variant.restitution;
    design.flow.aspect = variant.aspect;
    if let Arrival::DamBreak(release) = &mut design.flow.arrival {
        release.length = variant.length;
        release.distance = CHUTE - variant.length;
    }
    if let SizeCurve::ByNumber { smallest, largest } = &mut design.flow.sizes {
        *smallest *= variant.coarser;
        *largest *= variant.coarser;
    }
    let scene = build(&design, &choose(&design), variant.seed).map_err(|error| Broken::Scene(error.to_string()))?;
    let window = SAMPLES_PER_WINDOW as usize;
    let reading = Samples { window, tail: scene.samples_of_rest() };
    let watch = RunControl { progress: &|_| {}, stop: &AtomicBool::new(false), store: None };
    let event = Ongoing::begin(scene).go_on(&design, 1, &watch, |_, _| ());
    if let Ending::BrokeDown(unstable) = event.ending {
        return Err(unstable.into());
    }
    let observed = Observed::read(&event.histories, &design, &guideline(&design), reading);
    Ok(Run { observed, histories: event.histories, window, energy_error: event.energy_error })
}

/// Mean and standard deviation of a quantity over runs.
pub fn spread(runs: &[Run], quantity: impl Fn(&Run) -> f64) -> (f64, f64) {
    let values: Vec<f64> = runs.iter().map(quantity).collect();
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
    (mean, square.sqrt())
}
