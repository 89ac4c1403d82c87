//! Tension and extension of the main ropes.

use crate::quantities::quantity::Unit::{Metre, Newton};
use crate::quantities::quantity::{Demanded, Of, Quantity};
use dem::recorders::of_ropes::{EXTENSION, LARGEST, LARGEST_AT_ONCE, MEAN};

/// Largest tension anywhere along each main rope, its dissipators included.
pub const PEAK: Quantity =
    Quantity::new("rope_tension_peak", "Tension of main rope", Newton, Of::EachRope, |run| run.peaks(&LARGEST))
        .json("rope_tension_peak_n")
        .demanded(Demanded::RopeLoad { capped: false });

/// The same at any instant; the others are largest means over a sample.
pub const AT_ONCE: Quantity =
    Quantity::new("rope_tension_at_once", "Tension of main rope at any instant", Newton, Of::EachRope, |run| {
        run.peaks(&LARGEST_AT_ONCE)
    })
    .json("rope_tension_at_once_n")
    .meaning("Largest at any instant of the simulation; the other tensions are largest means over a sample.");

/// Largest mean tension along each main rope, and its mean at the end.
pub const MEAN_PEAK: Quantity =
    Quantity::new("rope_tension_mean_peak", "Mean tension of main rope", Newton, Of::EachRope, |run| run.peaks(&MEAN))
        .json("rope_tension_mean_peak_n");
pub const MEAN_RESIDUAL: Quantity =
    Quantity::new("rope_tension_mean_residual", "Mean tension at rest of main rope", Newton, Of::EachRope, |run| {
        run.at_rest(&MEAN)
    })
    .json("rope_tension_mean_residual_n");

/// How far downstream each main rope bulged at the most.
pub const DEFLECTION: Quantity =
    Quantity::new("rope_extension", "Extension of main rope", Metre, Of::EachRope, |run| run.peaks(&EXTENSION))
        .json("rope_extension_m")
        .meaning("How far downstream each main rope bulged at the most.");
