//! The force of the flow on the barrier as a whole.

use crate::quantities::quantity::Unit::{Newton, NewtonPerMetre, Second};
use crate::quantities::quantity::{Demanded, Of, Quantity, Told};
use crate::quantities::wall;
use crate::section::Section;
use dem::recorders::histories::{peak, tail_mean};

/// Largest total force of the smoothed signal.
pub const PEAK: Quantity =
    Quantity::new("force_total_peak", "Largest total force", Newton, Of::Run, |run| vec![peak(&run.smooth).1])
        .json("force_total_peak_n")
        .told(Told::Always)
        .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.face_force)));

pub const PEAK_TIME: Quantity =
    Quantity::new("force_total_peak_time", "Time of the largest total force", Second, Of::Run, |run| {
        vec![run.time(run.at_peak)]
    })
    .json("force_total_peak_time_s");

/// Largest total force within one sampling interval.
pub const PEAK_SAMPLED: Quantity =
    Quantity::new("force_total_peak_sampled", "Largest total force, unsmoothed", Newton, Of::Run, |run| {
        vec![peak(&run.force).1]
    })
    .json("force_total_peak_sampled_n")
    .meaning("Largest mean over one sampling interval.");

/// Mean total force over the last stretch of the run.
pub const RESIDUAL: Quantity = Quantity::new("force_total_residual", "Total force at rest", Newton, Of::Run, |run| {
    vec![tail_mean(&run.force, run.samples.tail)]
})
.json("force_total_residual_n")
.told(Told::Always);

/// Largest force along the bed of the smoothed signal.
pub const PUSH: Quantity =
    Quantity::new("push_peak", "Largest force along the bed", Newton, Of::Run, |run| vec![run.push]);

/// The same over the last stretch of the run.
pub const PUSH_RESIDUAL: Quantity =
    Quantity::new("push_residual", "Force along the bed at rest", Newton, Of::Run, |run| {
        let along: Vec<f64> = run.histories.force.iter().map(|force| force.x).collect();
        vec![tail_mean(&along, run.samples.tail)]
    });

/// Normal to the face of a wall, on the metre that takes the most.
pub const ON_A_METRE: Quantity =
    Quantity::new("wall_local_peak", "Largest force on a metre of the wall", NewtonPerMetre, Of::Run, |run| {
        vec![match &run.guideline.section {
            Section::Rectangle { .. } => peak(&run.smooth).1 / run.guideline.width,
            Section::Surveyed(_) => {
                let forces = run.force.iter().zip(wall::metre_widths(run));
                peak(&run.smoothed(&forces.map(|(force, width)| force / width).collect::<Vec<_>>())).1
            }
        }]
    })
    .demanded(Demanded::Load(|guideline, factors| {
        Some(factors.load * (guideline.metre_force / libm::cos(guideline.lean)))
    }));
