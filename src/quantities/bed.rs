//! What holds a lowest rope that lies on the bed.

use crate::quantities::quantity::Unit::Newton;
use crate::quantities::quantity::{Demanded, Of, Quantity};
use dem::recorders::of_anchors;

/// Largest force on all of it.
pub const FORCE: Quantity =
    Quantity::new("bed_force", "Load on what holds the lowest rope to the bed", Newton, Of::Run, |run| {
        run.peak(&of_anchors::BED)
    })
    .json("bed_force_peak_n")
    .meaning("On what holds the lowest main rope to the bed.")
    .demanded(Demanded::Load(|guideline, _| guideline.bed_force));

/// Largest force on one of its bolts; 0 where their distance is not given.
pub const BOLT: Quantity =
    Quantity::new("bolt_force", "Load of the worst bolt of the lowest rope", Newton, Of::Run, |run| {
        run.peak(&of_anchors::BOLT)
    })
    .json("bolt_force_peak_n")
    .meaning("On its worst bolt; 0 where anchors.bed_bolt_spacing is not given.")
    .demanded(Demanded::Load(|guideline, _| guideline.bolt_force));
/// The same in any step.
pub const BOLT_AT_ONCE: Quantity =
    Quantity::new("bolt_force_at_once", "Load of the worst bolt at any instant", Newton, Of::Run, |run| {
        run.peak(&of_anchors::BOLT_AT_ONCE)
    })
    .json("bolt_force_at_once_n");
/// Largest lift of one of its bolts, likewise.
pub const BOLT_LIFT: Quantity =
    Quantity::new("bolt_lift", "Largest lift of a bolt", Newton, Of::Run, |run| run.peak(&of_anchors::BOLT_LIFT))
        .json("bolt_lift_peak_n")
        .meaning("The largest lift of one; 0 where anchors.bed_bolt_spacing is not given.");
/// Largest force on the lowest rope in a space between its bolts, likewise; by the equations, which spread it evenly, as much as on a bolt.
pub const SPACE: Quantity =
    Quantity::new("bolt_space_force", "Largest load on the lowest rope between two bolts", Newton, Of::Run, |run| {
        run.peak(&of_anchors::SPACE)
    })
    .json("bolt_space_force_peak_n")
    .meaning("On the lowest rope between two of its bolts; 0 where anchors.bed_bolt_spacing is not given.")
    .demanded(Demanded::Load(|guideline, _| guideline.bolt_force));
/// The same in any step.
pub const SPACE_AT_ONCE: Quantity = Quantity::new(
    "bolt_space_force_at_once",
    "Largest load on the lowest rope between two bolts at any instant",
    Newton,
    Of::Run,
    |run| run.peak(&of_anchors::SPACE_AT_ONCE),
)
.json("bolt_space_force_at_once_n");
