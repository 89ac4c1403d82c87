//! Load of the anchors.

use crate::quantities::quantity::Unit::Newton;
use crate::quantities::quantity::{Demanded, Of, Quantity, Told};
use crate::quantities::reading::Reading;
use dem::recorders::of_anchors;

/// Largest load of each rope's higher loaded anchor.
pub const PEAK: Quantity = Quantity::new("anchor", "Load of the anchors of main rope", Newton, Of::EachRope, |run| {
    run.peaks(&of_anchors::LOAD)
})
.json("anchor_force_peak_n")
.told(Told::WhereLoaded)
.demanded(Demanded::RopeLoad { capped: true });

/// The same at any instant.
pub const AT_ONCE: Quantity =
    Quantity::new("anchor_at_once", "Load of the anchors at any instant, of main rope", Newton, Of::EachRope, |run| {
        run.peaks(&of_anchors::LOAD_AT_ONCE)
    })
    .json("anchor_force_at_once_n");

/// Largest load of each anchor.
pub const EACH: Quantity = Quantity::new("each_anchor", "Load of anchor", Newton, Of::EachAnchor, |run| {
    at_largest(run).into_iter().map(|[along, across, up]| libm::hypot(libm::hypot(along, across), up)).collect()
})
.json("each_anchor_peak_n")
.demanded(Demanded::LoadOfAnchor);

/// Parts of that load, by the level: down the valley, to the left, and up.
pub const ALONG: Quantity =
    Quantity::new("each_anchor_along", "Load along the valley of anchor", Newton, Of::EachAnchor, |run| part(run, 0))
        .json_in("each_anchor_at_peak_n", "along");
pub const ACROSS: Quantity =
    Quantity::new("each_anchor_across", "Load to the left of anchor", Newton, Of::EachAnchor, |run| part(run, 1))
        .json_in("each_anchor_at_peak_n", "to_the_left");
pub const UP: Quantity =
    Quantity::new("each_anchor_up", "Upward load of anchor", Newton, Of::EachAnchor, |run| part(run, 2))
        .json_in("each_anchor_at_peak_n", "up");

fn at_largest(run: &Reading) -> Vec<[f64; 3]> {
    run.vectors_at_largest(&of_anchors::EACH)
}

fn part(run: &Reading, part: usize) -> Vec<f64> {
    at_largest(run).into_iter().map(|vector| vector[part]).collect()
}
