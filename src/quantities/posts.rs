//! What posts, their feet and the ropes that retain them bear.

use crate::quantities::quantity::Unit::{Metre, Newton, NewtonMetre};
use crate::quantities::quantity::{Demanded, Of, OverPlateau, Quantity, Told};
use crate::quantities::reading::Reading;
use dem::recorders::of_posts;

/// Largest compression of each post.
pub const COMPRESSION: Quantity =
    Quantity::new("post_compression", "Compression of post", Newton, Of::EachPost, |run| {
        run.peaks(&of_posts::COMPRESSION)
    })
    .json("post_compression_peak_n")
    .told(Told::WhereLoaded)
    .demanded(Demanded::LoadOfPost(|post| post.head.compression, OverPlateau::Grows));

/// Largest pull on each post.
pub const UPLIFT: Quantity = Quantity::new("post_uplift", "Pull on post", Newton, Of::EachPost, |run| {
    let rows = run.histories.barrier.rows(&of_posts::COMPRESSION);
    rows.iter().map(|row| row.iter().map(|compression| -compression).fold(0.0, dem::larger_or_nan)).collect()
})
.json("post_uplift_peak_n")
.demanded(Demanded::LoadOfPost(|post| -post.head.compression, OverPlateau::Grows));

/// Largest moment by which what presses on each post bends it.
pub const MOMENT: Quantity = Quantity::new("post_moment", "Bending moment of post", NewtonMetre, Of::EachPost, |run| {
    run.peaks(&of_posts::MOMENT)
})
.json("post_moment_peak_n_m")
.demanded(Demanded::LoadOfPost(|post| post.own.moment, OverPlateau::Stays));

/// Largest force of each post on its foundation.
pub const FOOT: Quantity =
    Quantity::new("foot_force", "Force on the foundation of post", Newton, Of::EachPost, |run| {
        at_largest(run).into_iter().map(|[along, across, up]| libm::hypot(libm::hypot(along, across), up)).collect()
    })
    .json("foot_force_peak_n")
    .demanded(Demanded::LoadOfPost(|post| post.foot, OverPlateau::Grows));

/// Parts of that force, by the level: down the valley, to the left, and up.
pub const FOOT_ALONG: Quantity = Quantity::new(
    "foot_force_along",
    "Force along the valley on the foundation of post",
    Newton,
    Of::EachPost,
    |run| part(run, 0),
)
.json_in("foot_force_at_peak_n", "along");
pub const FOOT_ACROSS: Quantity =
    Quantity::new("foot_force_across", "Force to the left on the foundation of post", Newton, Of::EachPost, |run| {
        part(run, 1)
    })
    .json_in("foot_force_at_peak_n", "to_the_left");
pub const FOOT_UP: Quantity =
    Quantity::new("foot_force_up", "Upward force on the foundation of post", Newton, Of::EachPost, |run| part(run, 2))
        .json_in("foot_force_at_peak_n", "up");

/// Largest tension of the ropes that retain each post.
pub const RETAINING: Quantity =
    Quantity::new("retaining_tension", "Tension of the retaining ropes of post", Newton, Of::EachPost, |run| {
        run.peaks(&of_posts::RETAINING)
    })
    .json("retaining_tension_peak_n")
    .told(Told::WhereLoaded)
    .demanded(Demanded::LoadOfPost(|post| post.head.tension, OverPlateau::Adds));

/// Both at any instant; the others are largest means over a sample.
pub const COMPRESSION_AT_ONCE: Quantity =
    Quantity::new("post_compression_at_once", "Compression at any instant of post", Newton, Of::EachPost, |run| {
        run.peaks(&of_posts::COMPRESSION_AT_ONCE)
    })
    .json("post_compression_at_once_n");
pub const RETAINING_AT_ONCE: Quantity = Quantity::new(
    "retaining_tension_at_once",
    "Tension at any instant of the retaining ropes of post",
    Newton,
    Of::EachPost,
    |run| run.peaks(&of_posts::RETAINING_AT_ONCE),
)
.json("retaining_tension_at_once_n");

/// Largest stroke used by the dissipators of the ropes that retain each post.
pub const STROKE: Quantity =
    Quantity::new("retaining_stroke", "Stroke of the dissipators of post", Metre, Of::EachPost, |run| {
        run.peaks(&of_posts::STROKE)
    })
    .json("retaining_stroke_m")
    .demanded(Demanded::StrokeOfPost);

fn at_largest(run: &Reading) -> Vec<[f64; 3]> {
    run.vectors_at_largest(&of_posts::FOOT)
}

fn part(run: &Reading, part: usize) -> Vec<f64> {
    at_largest(run).into_iter().map(|vector| vector[part]).collect()
}
