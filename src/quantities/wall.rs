//! What a rigid wall bears, per metre of its width.

use crate::design::{BarrierDesign, Design};
use crate::guideline::wall_of;
use crate::quantities::quantity::Unit::{NewtonMetrePerMetre, NewtonPerMetre};
use crate::quantities::quantity::{Demanded, Of, Quantity, Told};
use crate::quantities::reading::Reading;
use crate::section::Section;
use dem::recorders::histories::{Histories, peak, tail_mean};
use dem::recorders::of_wall;

/// Largest force on each segment, and that at rest.
pub const SEGMENT: Quantity =
    Quantity::new("segment_peak", "Largest force on wall segment", NewtonPerMetre, Of::EachSegment, |run| {
        let segments = run.histories.barrier.rows(&of_wall::SEGMENTS).iter().enumerate();
        segments.map(|(index, row)| peak(&run.smoothed(row)).1 / segment_width(run.design, index)).collect()
    })
    .json_in("wall", "segment_force_peak_n_per_m");
pub const SEGMENT_RESIDUAL: Quantity =
    Quantity::new("segment_residual", "Force at rest on wall segment", NewtonPerMetre, Of::EachSegment, |run| {
        let segments = run.histories.barrier.rows(&of_wall::SEGMENTS).iter().enumerate();
        segments.map(|(index, row)| tail_mean(row, run.samples.tail) / segment_width(run.design, index)).collect()
    })
    .json_in("wall", "segment_force_residual_n_per_m");

/// Mean width of a segment of the wall (m).
pub fn segment_width(design: &Design, index: usize) -> f64 {
    let (BarrierDesign::RigidWall(wall), section @ Section::Surveyed(_)) = (&design.barrier, design.channel.section())
    else {
        return design.channel.width;
    };
    let upright = libm::cos(wall.lean);
    let ends = [if index == 0 { 0.0 } else { wall.segment_tops[index - 1] }, wall.segment_tops[index]];
    let [low, high] = ends.map(|along| section.area(along * upright));
    (high - low) / ((ends[1] - ends[0]) * upright)
}

/// Moment about the toe, and the width over which it is what a metre takes that goes from the foot to the top: in a rectangle the mean.
pub fn metre_moment<'a>(histories: &'a Histories, design: &Design) -> (&'a [f64], f64) {
    match histories.barrier.series(&of_wall::METRE_MOMENT) {
        [] => (histories.barrier.series(&of_wall::MOMENT), design.channel.width),
        told => (told, 1.0),
    }
}

/// Widths over which the force on the wall is what that metre takes, sample by sample (m): that of a rectangle; in another section the force
/// normal to the wall over that on the metre, or the least width where there is none.
pub fn metre_widths(run: &Reading) -> Vec<f64> {
    let channels = &run.histories.barrier;
    let told = channels.series(&of_wall::METRE_FORCE);
    let segments = channels.rows(&of_wall::SEGMENTS);
    let width = |sample: usize| {
        let Some(metre) = told.get(sample) else { return run.width() };
        let whole: f64 = segments.iter().map(|row| row[sample]).sum();
        if *metre > 0.0 { whole / metre } else { segment_width(run.design, 0) }
    };
    (0..run.histories.force.len()).map(width).collect()
}

/// Largest moment about the toe.
pub const MOMENT: Quantity =
    Quantity::new("moment_peak", "Moment about the toe, largest", NewtonMetrePerMetre, Of::Run, |run| {
        let (moment, width) = metre_moment(run.histories, run.design);
        vec![peak(&run.smoothed(moment)).1 / width]
    })
    .json_in("wall", "moment_peak_n_m_per_m")
    .told(Told::OfWalls)
    .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.foot_moment)));

/// The same within one sampling interval.
pub const MOMENT_SAMPLED: Quantity =
    Quantity::new("moment_peak_sampled", "Moment about the toe, unsmoothed", NewtonMetrePerMetre, Of::Run, |run| {
        let (moment, width) = metre_moment(run.histories, run.design);
        vec![peak(moment).1 / width]
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
    let widths = metre_widths(run);
    let part = |axis: usize| -> Vec<f64> {
        let forces = run.histories.force.iter().zip(&widths);
        run.smoothed(&forces.map(|(force, width)| force[axis] / width).collect::<Vec<_>>())
    };
    let (along, off) = (part(0), part(2));
    let (moment, width) = metre_moment(run.histories, run.design);
    let moment = run.smoothed(&moment.iter().map(|moment| moment / width).collect::<Vec<_>>());
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
    .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.on_the_base.slides)));

/// Largest moment about the upstream end of its base, with that of the lift; by the guideline that of the load along the bed.
pub const OVERTURNING: Quantity =
    Quantity::new("wall_overturning", "Largest moment about the base", NewtonMetrePerMetre, Of::Run, |run| {
        vec![base(run).tips]
    })
    .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.on_the_base.tips)));

/// What presses on its base beside its weight, at the most; by the guideline the load along the bed.
pub const PRESS: Quantity =
    Quantity::new("wall_press", "Largest force on the base", NewtonPerMetre, Of::Run, |run| vec![base(run).presses])
        .demanded(Demanded::Load(|guideline, factors| Some(factors.load * guideline.on_the_base.pushes)));
