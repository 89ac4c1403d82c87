//! Strokes and tension of the dissipators. What is written into files keeps their short name there, `brake`.

use crate::quantities::quantity::Unit::{Metre, Newton};
use crate::quantities::quantity::{Demanded, Of, Quantity, Told};
use dem::recorders::of_dissipators;

/// Larger stroke used by each rope's two dissipators.
pub const STROKE: Quantity =
    Quantity::new("brake_stroke", "Stroke of the dissipators of main rope", Metre, Of::EachRope, |run| {
        run.peaks(&of_dissipators::STROKE)
    })
    .json("brake_stroke_m")
    .told(Told::WhereLoaded)
    .demanded(Demanded::Stroke);

/// Mean stroke used by each rope's two dissipators.
pub const MEAN_STROKE: Quantity =
    Quantity::new("brake_stroke_mean", "Mean stroke of the dissipators of main rope", Metre, Of::EachRope, |run| {
        run.peaks(&of_dissipators::MEAN_STROKE)
    })
    .json("brake_stroke_mean_m");

/// Largest tension of each rope's dissipators.
pub const TENSION: Quantity =
    Quantity::new("brake_force_peak", "Tension of the dissipators of main rope", Newton, Of::EachRope, |run| {
        run.peaks(&of_dissipators::TENSION)
    })
    .demanded(Demanded::Plateau);
