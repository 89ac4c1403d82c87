//! The height that a net keeps.

use crate::quantities::quantity::Unit::{Metre, Share};
use crate::quantities::quantity::{Demanded, Of, Quantity};
use dem::recorders::of_ropes::TOP_HEIGHT;

/// Lowest height of the top rope at the end.
pub const TOP_ROPE: Quantity = Quantity::new("top_rope_height", "Height left", Metre, Of::RunIfKnown, |run| {
    run.histories.barrier.series(&TOP_HEIGHT).last().copied().into_iter().collect()
})
.json("residual_height_m");

/// The same over its initial height; 1 for a wall.
pub const RESIDUAL: Quantity = Quantity::new("residual_height", "Height left over height", Share, Of::Run, |run| {
    let height = run.histories.barrier.series(&TOP_HEIGHT);
    vec![match (height.first(), height.last()) {
        (Some(first), Some(last)) if *first > 0.0 => last / first,
        _ => 1.0,
    }]
})
.demanded(Demanded::Kept);
