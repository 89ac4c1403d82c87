//! What boulders do to the barrier.

use crate::quantities::quantity::Unit::Newton;
use crate::quantities::quantity::{Of, Quantity, Told};
use dem::recorders::of_boulders;

/// Largest force of one boulder on the barrier.
pub const FORCE: Quantity =
    Quantity::new("boulder_force", "Largest force of a boulder on the barrier", Newton, Of::Run, |run| {
        run.peak(&of_boulders::FORCE)
    })
    .json("boulder_force_peak_n")
    .told(Told::WhereLoaded);

/// Largest tension of the net beside a boulder.
pub const NET: Quantity = Quantity::new(
    "boulder_net_tension",
    "Tension of the net's ropes within one mesh of a boulder",
    Newton,
    Of::Run,
    |run| run.peak(&of_boulders::NET),
)
.json("boulder_net_tension_peak_n")
.told(Told::WhereLoaded);
