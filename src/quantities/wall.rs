//! What a rigid wall bears, per metre of its width.

use crate::guideline::wall_of;
use crate::quantities::quantity::Unit::{NewtonMetrePerMetre, NewtonPerMetre};
use crate::quantities::quantity::{Demanded, Of, Quantity, Told};
use crate::quantities::reading::Reading;
use dem::recorders::histories::{peak, tail_mean};
use dem::recorders::of_wall;

/// Largest force on each segment, and that at rest.
pub const SEGMENT: Quantity =
    Quantity::new("segment_peak", "Largest force on wall segment", NewtonPerMetre, Of::EachSegment, |run| {
        let segments = run.histories.barrier.rows(&of_wall::SEGMENTS).iter();
        segments.map(|row| peak(&run.smoothed(row)).1 / run.width()).collect()
    })
    .json_in("wall", "segment_force_peak_n_per_m");
pub const SEGMENT_RESIDUAL: Quantity =
    Quantity::new("segment_residual", "Force at rest on wall segment", NewtonPerMetre, Of::EachSegment, |run| {
        let segments = run.histories.barrier.rows(&of_wall::SEGMENTS).iter();
        segments.map(|row| tail_mean(row, run.samples.tail) / run.width()).collect()
    })
    .json_in("wall", "segment_force_residual_n_per_m");

/// Largest moment about the toe.
pub const MOMENT: Quantity =
    Quantity::new("moment_peak", "Moment about the toe, largest", NewtonMetrePerMetre, Of::Run, |run| {
        vec![peak(&run.smoothed(run.histories.barrier.series(&of_wall::MOMENT))).1 / run.width()]
    })
    .json_in("wall", "moment_peak_n_m_per_m")
    .told(Told::OfWalls)
    .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.foot_moment)));

/// The same within one sampling interval.
pub const MOMENT_SAMPLED: Quantity =
    Quantity::new("moment_peak_sampled", "Moment about the toe, unsmoothed", NewtonMetrePerMetre, Of::Run, |run| {
        vec![peak(run.histories.barrier.series(&of_wall::MOMENT)).1 / run.width()]
    });

/// What the flow does to a wall that stands by its weight, at the most.
struct Base {
    slides: f64,
    tips: f64,
    presses: f64,
}

/// Zeros where the barrier is none.
fn base(run: &Reading) -> Base {
    let Some(wall) = wall_of(run.design) else { return Base { slides: 0.0, tips: 0.0, presses: 0.0 } };
    let part = |axis: usize| -> Vec<f64> {
        run.smoothed(&run.histories.force.iter().map(|force| force[axis] / run.width()).collect::<Vec<_>>())
    };
    let (along, off) = (part(0), part(2));
    let moment = run.histories.barrier.series(&of_wall::MOMENT).iter().map(|moment| moment / run.width());
    let moment = run.smoothed(&moment.collect::<Vec<_>>());
    let pushes = || along.iter().zip(&off);
    let largest = |values: &mut dyn Iterator<Item = f64>| peak(&values.collect::<Vec<_>>()).1;
    Base {
        slides: largest(&mut pushes().map(|(along, off)| wall.sliding_demand(*along, *off))),
        tips: largest(
            &mut pushes().zip(&moment).map(|((along, off), moment)| moment + wall.lift(*along, *off) * wall.base_width),
        ),
        presses: largest(&mut pushes().map(|(along, off)| wall.press(*along, *off))),
    }
}

/// Largest force that slides it along its base, with what the lift takes of its friction; by the guideline the load along the bed.
pub const SLIDING: Quantity =
    Quantity::new("wall_sliding", "Largest force along the base", NewtonPerMetre, Of::Run, |run| {
        vec![base(run).slides]
    })
    .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.metre_force)));

/// Largest moment about the upstream end of its base, with that of the lift; by the guideline that of the load along the bed.
pub const OVERTURNING: Quantity =
    Quantity::new("wall_overturning", "Largest moment about the base", NewtonMetrePerMetre, Of::Run, |run| {
        vec![base(run).tips]
    })
    .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.foot_moment)));

/// What presses on its base beside its weight, at the most; by the guideline the load along the bed.
pub const PRESS: Quantity =
    Quantity::new("wall_press", "Largest force on the base", NewtonPerMetre, Of::Run, |run| vec![base(run).presses])
        .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.metre_force)));
