//! Every knob alone, on every scene: cost, and error against the finest model.

use serde::{Deserialize, Serialize};

use crate::design::Design;
use crate::design::read::DesignFile;
use crate::guideline::guideline;
use crate::quantities::{anchor_load, dissipator, mass, total_force, wall};
use crate::scene::event::RunControl;
use crate::simulated::{Detail, RunError, Simulated, simulate};
use crate::starts::Spread;
use crate::studies::knobs::{Knob, turn};
use crate::studies::plan::Plan;

/// What one run says and costs. All that is kept of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    pub force_peak: f64,
    pub force_residual: f64,
    /// About the toe of a wall; 0 for a net.
    pub moment_peak: f64,
    pub anchor_peak: f64,
    pub stroke: f64,
    pub retained: f64,
    pub energy_error: f64,
    /// Whether the run can be relied on.
    pub reliable: bool,
    /// Steps times spheres, and times elements of the barrier.
    pub sphere_steps: f64,
    pub element_steps: f64,
    pub wall_clock: f64,
}

/// Reads an observable.
type Read = fn(&Point) -> f64;

/// Observables that errors are told of.
pub const OBSERVABLES: [(&str, Read); 6] = [
    ("largest force", |point| point.force_peak),
    ("force at rest", |point| point.force_residual),
    ("moment", |point| point.moment_peak),
    ("largest anchor load", |point| point.anchor_peak),
    ("longest stroke", |point| point.stroke),
    ("mass held", |point| point.retained),
];

impl Point {
    fn of(seen: &Simulated) -> Self {
        let first = seen.first();
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let facts = &seen.facts;
        let steps = facts.steps as f64;
        Self {
            force_peak: first.one(&total_force::PEAK),
            force_residual: first.one(&total_force::RESIDUAL),
            moment_peak: first.one(&wall::MOMENT),
            anchor_peak: largest(first.each(&anchor_load::PEAK)),
            stroke: largest(first.each(&dissipator::MEAN_STROKE)),
            retained: first.one(&mass::RETAINED),
            energy_error: seen.numerics.energy_error,
            reliable: seen.doubts.is_empty(),
            sphere_steps: steps * facts.spheres as f64,
            element_steps: steps * f64::from(facts.barrier_substeps) * facts.barrier_elements as f64,
            wall_clock: facts.wall_clock,
        }
    }
}

/// One run of a study, before it is made.
#[derive(Clone, Debug)]
pub struct Task {
    pub scene: usize,
    pub setting: Setting,
    pub seed: u64,
}

/// How a scene is modelled in a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Setting {
    AsItIs,
    Turned(Knob, f64),
    /// The finest, all knobs at once.
    Reference(Vec<(Knob, f64)>),
}

impl Setting {
    /// What tells it from the others, for people and for the names of results kept.
    pub fn word(&self) -> String {
        match self {
            Self::AsItIs => "as it is".into(),
            Self::Turned(knob, value) => format!("{}: {}", knob.title(), knob.word(*value)),
            Self::Reference(_) => "reference".into(),
        }
    }
}

/// All runs of a study, those that tell most first.
pub fn tasks(plan: &Plan, scenes: &[DesignFile]) -> Vec<Task> {
    let mut tasks = Vec::new();
    for (scene, file) in scenes.iter().enumerate() {
        let mut add = |setting: &Setting, starts: u32| {
            let seed = file.design.simulation.seed;
            tasks.extend((0..starts).map(|start| Task {
                scene,
                setting: setting.clone(),
                seed: seed.wrapping_add(u64::from(start)),
            }));
        };
        add(&Setting::AsItIs, plan.starts);
        add(&Setting::Reference(plan.reference.iter().map(|(knob, value)| (*knob, *value)).collect()), plan.starts);
        for (knob, values) in &plan.knobs {
            let turned = values.iter().filter(|value| **value != knob.default_of(&file.design));
            for value in turned.filter(|_| knob.turns(&file.design)) {
                add(&Setting::Turned(*knob, *value), plan.starts_of_knobs);
            }
        }
    }
    tasks
}

/// Makes one run.
pub fn make(task: &Task, design: &Design, watch: &RunControl) -> Result<Point, RunError> {
    let (design, fidelity) = match &task.setting {
        Setting::AsItIs => turn(design, &[]),
        Setting::Turned(knob, value) => turn(design, &[(*knob, *value)]),
        Setting::Reference(values) => turn(design, values),
    };
    Ok(Point::of(&simulate(&design, &fidelity, &guideline(&design), task.seed, Detail::Observed, watch)?))
}

/// What the runs of one setting come to on one scene.
#[derive(Clone, Debug)]
pub struct Told {
    pub setting: Setting,
    /// 0 where the scene could not be prepared.
    pub starts: usize,
    pub reliable: usize,
    /// Sphere-steps and element-steps weighed by their time, over those of the scene as it is.
    pub cost: f64,
    pub wall_clock: f64,
    /// Of every observable that the scene has: mean over the reference's, less one; and the standard error of that.
    pub errors: Vec<(&'static str, f64, f64)>,
}

impl Told {
    /// Largest error over the observables.
    pub fn error(&self) -> f64 {
        self.errors.iter().map(|(_, error, _)| error.abs()).fold(0.0, f64::max)
    }
}

/// Time of an element-step over that of a sphere-step (bench: 14 ns against 22 ns).
const ELEMENT_WEIGHT: f64 = 0.6;

/// Sums up the runs of one scene by setting: `runs` holds every setting with what its starts gave.
pub fn tell(runs: &[(Setting, Vec<Point>)]) -> Vec<Told> {
    let found =
        |wanted: &Setting| runs.iter().find(|(setting, _)| setting == wanted).map(|(_, points)| points.as_slice());
    let reference = runs.iter().find(|(setting, _)| matches!(setting, Setting::Reference(_)));
    let (Some(base), Some((_, reference))) = (found(&Setting::AsItIs), reference) else { return Vec::new() };
    if base.is_empty() || reference.is_empty() {
        return Vec::new();
    }
    let cost = |points: &[Point]| mean(points, |point| point.sphere_steps + ELEMENT_WEIGHT * point.element_steps);
    let unit = cost(base);
    runs.iter()
        .map(|(setting, points)| Told {
            setting: setting.clone(),
            starts: points.len(),
            reliable: points.iter().filter(|point| point.reliable).count(),
            cost: cost(points) / unit,
            wall_clock: mean(points, |point| point.wall_clock),
            errors: OBSERVABLES
                .iter()
                .filter(|_| !points.is_empty())
                .filter_map(|(name, read)| {
                    let [this, other] = [points.as_slice(), reference].map(|points| spread(points, *read));
                    let relative = |spread: Spread| spread.deviation / other.mean / (spread.starts as f64).sqrt();
                    (other.mean != 0.0)
                        .then(|| (*name, this.mean / other.mean - 1.0, libm::hypot(relative(this), relative(other))))
                })
                .collect(),
        })
        .collect()
}

/// Scatter of one start of a scene as it is, over the mean, of every observable that it has.
pub fn floor(points: &[Point]) -> Vec<(&'static str, f64)> {
    let scatter = |(name, read): &(&'static str, Read)| {
        let spread = spread(points, *read);
        (spread.mean != 0.0).then_some((*name, spread.deviation / spread.mean))
    };
    OBSERVABLES.iter().filter_map(scatter).collect()
}

fn spread(points: &[Point], read: Read) -> Spread {
    Spread::of(&points.iter().map(read).collect::<Vec<_>>())
}

fn mean(points: &[Point], read: impl Fn(&Point) -> f64) -> f64 {
    points.iter().map(read).sum::<f64>() / points.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn point(force_peak: f64, sphere_steps: f64) -> Point {
        Point {
            force_peak,
            force_residual: 1.0,
            moment_peak: 0.0,
            anchor_peak: 0.0,
            stroke: 0.0,
            retained: 1.0,
            energy_error: 0.0,
            reliable: true,
            sphere_steps,
            element_steps: 0.0,
            wall_clock: 1.0,
        }
    }

    #[test]
    fn errors_are_against_the_reference_and_costs_against_the_scene_as_it_is() {
        let runs = [
            (Setting::AsItIs, vec![point(100.0, 10.0), point(104.0, 10.0)]),
            (Setting::Reference(Vec::new()), vec![point(100.0, 40.0), point(100.0, 40.0)]),
            (Setting::Turned(Knob::Step, 0.8), vec![point(110.0, 5.0)]),
        ];
        let told = tell(&runs);
        assert_relative_eq!(told[2].cost, 0.5);
        let (name, error, _) = told[2].errors[0];
        assert_eq!(name, "largest force");
        assert_relative_eq!(error, 0.1, max_relative = 1e-12);
        // A wall has a moment, a net has not: what is zero in the reference is left out.
        assert_eq!(told[2].errors.len(), 3);
        assert_relative_eq!(floor(&runs[0].1)[0].1, 8_f64.sqrt() / 102.0, max_relative = 1e-12);
    }
}
