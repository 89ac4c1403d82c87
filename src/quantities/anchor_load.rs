//! Load of the anchors of the main ropes.

use crate::quantities::quantity::Unit::Newton;
use crate::quantities::quantity::{Demanded, Of, Quantity, Told};
use dem::recorders::of_anchors::LOAD;

/// Largest load of each rope's higher loaded anchor.
pub const PEAK: Quantity =
    Quantity::new("anchor", "Load of the anchors of main rope", Newton, Of::EachRope, |run| run.peaks(&LOAD))
        .json("anchor_force_peak_n")
        .told(Told::WhereLoaded)
        .demanded(Demanded::RopeLoad { capped: true });
