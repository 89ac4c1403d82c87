//! Ropes that break or draw out.

use crate::quantities::quantity::Unit::{Number, Second, Share};
use crate::quantities::quantity::{Demanded, Of, Quantity};
use dem::recorders::of_ropes;

/// Pieces of rope that broke.
pub const BROKEN: Quantity =
    Quantity::new("broken_pieces", "Pieces of rope that broke", Number, Of::Run, |run| run.peak(&of_ropes::BROKEN))
        .demanded(Demanded::Worst);

/// When the first did.
pub const FIRST_BREAK: Quantity =
    Quantity::new("first_break", "Time of the first break", Second, Of::RunIfKnown, |run| {
        let broken = run.histories.barrier.series(&of_ropes::BROKEN);
        broken.iter().position(|count| *count > 0.0).map(|sample| run.time(sample)).into_iter().collect()
    });

/// Largest permanent elongation of a piece of rope, over its first length.
pub const DRAWN_OUT: Quantity =
    Quantity::new("drawn_out", "Largest permanent elongation of a rope", Share, Of::Run, |run| {
        run.peak(&of_ropes::DRAWN_OUT)
    })
    .demanded(Demanded::Worst);
