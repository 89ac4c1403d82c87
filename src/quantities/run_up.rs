//! How high the flow stands at the barrier while it is stopped.

use crate::quantities::quantity::Unit::Metre;
use crate::quantities::quantity::{Demanded, Of, Quantity};
use dem::recorders::histories::peak;
use dem::recorders::of_level;

/// Highest level of the flow at the barrier, over the bed and normal to it. By the equations the level that the event reaches.
pub const LEVEL: Quantity =
    Quantity::new("run_up", "Highest level of the flow at the barrier", Metre, Of::Run, |run| {
        vec![peak(&run.smoothed(run.histories.barrier.series(&of_level::LEVEL))).1]
    })
    .json("run_up_m")
    .meaning("Highest level of the flow at the barrier, normal to the bed, without the few grains that fly above it.")
    .demanded(Demanded::Level(|guideline| guideline.level));
