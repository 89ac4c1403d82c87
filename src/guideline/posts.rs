//! Posts under the guideline's loads: what the uppermost rope hands to their heads, and what presses on themselves.

use crate::design::{Design, Posts};
use crate::guideline::face::lean;
use crate::guideline::rope_load::RopeLoad;
use crate::larger::larger_or_nan;
use crate::loads::cases::load_case::LoadCase;
use crate::loads::posts::{BeamState, HeadState, PostInput, beam};
use crate::loads::rope::Yielding;

/// A post, with the partial factor on loads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PostLoad {
    /// m
    pub length: f64,
    /// On its head, normal to the net: from the rope over it, and from what presses on the post itself (N).
    pub from_rope: f64,
    pub own: BeamState,
    /// Largest pull along the rope by friction on the head (N).
    pub along: f64,
    pub head: HeadState,
    /// Force on its foundation (N).
    pub foot: f64,
    /// Stroke of the dissipators of its ropes (m): none below their force, and all of it above, because nothing else would hold the head.
    pub stroke: f64,
}

/// The bays of the uppermost rope from the right bank to the left (m): where it begins, the posts, where it ends.
pub fn stops(design: &Design, [from, to]: [f64; 2]) -> Vec<f64> {
    let posts = design.posts().map_or(Vec::new(), |posts| posts.at.clone());
    let mut places: Vec<f64> = posts.iter().map(|right| design.channel.across(*right)).collect();
    places.reverse();
    [from].into_iter().chain(places).chain([to]).collect()
}

/// How the dissipators of the ropes that retain posts yield, if there are any.
pub fn retaining(design: &Design) -> Option<Yielding> {
    design.posts()?.retaining.dissipators.as_ref().map(Yielding::from)
}

/// Where a post stands and is held: its foot on the ground at the barrier, its anchors on the section of the barrier over the bed upstream.
pub fn input(design: &Design, posts: &Posts, right: f64, top: f64) -> PostInput {
    let (channel, lean) = (&design.channel, lean(design));
    let across = channel.across(right);
    let ground = channel.ground_at(across);
    let [along, rises] = channel.bed(-posts.retaining.set_back);
    let anchor = |side: f64| [along, -side, rises + channel.ground_at(across - side) - ground];
    PostInput {
        length: (top - ground) / libm::cos(lean),
        lean,
        anchors: posts.retaining.sides().into_iter().map(anchor).collect(),
    }
}

/// Each post under the governing load of the uppermost rope.
pub fn loads(design: &Design, rope: Option<&RopeLoad>, stages: &[LoadCase], top: f64) -> Vec<PostLoad> {
    let (Some(posts), Some(rope)) = (design.posts(), rope) else { return Vec::new() };
    let ends = design.channel.section().banks(top);
    let stops = stops(design, ends);
    let retaining = retaining(design);
    let of = |(number, right): (usize, &f64)| {
        let post = input(design, posts, *right, top);
        let across = design.channel.across(*right);
        // The stops go from the right to the left, the posts from the left to the right.
        let at = stops.len() - 2 - number;
        let bays = [stops[at] - stops[at - 1], stops[at + 1] - stops[at]];
        // A point load may hit the head itself.
        let spread = rope.load - 2.0 * rope.point / rope.span;
        let from_rope = 0.5 * spread * (bays[0] + bays[1]) + rope.point;
        let own = worst_beam(design, posts, &post, design.channel.ground_at(across), stages);
        let along = design.factors.overstrength * rope.over_heads * friction(rope, bays, posts.head_friction);
        let head = post.under(from_rope + own.head, along);
        let least_share = posts.retaining.dissipators.as_ref().and_then(|given| given.lower_bound).unwrap_or(1.0);
        let yield_force = retaining.as_ref().map_or(f64::INFINITY, |given| least_share * given.least());
        // Asked so that a tension that is not a number uses it up.
        let below = head.tension <= yield_force;
        let stroke = retaining.as_ref().filter(|_| !below).map_or(0.0, |given| given.stroke);
        let foot = libm::hypot(head.compression, own.foot);
        PostLoad { length: post.length, from_rope, own, along, head, foot, stroke }
    };
    posts.at.iter().enumerate().map(of).collect()
}

/// What presses on the width of the post itself, in the stage that bends it most.
fn worst_beam(design: &Design, posts: &Posts, post: &PostInput, ground: f64, stages: &[LoadCase]) -> BeamState {
    let upright = libm::cos(post.lean);
    let of = |case: &LoadCase| {
        let pressed =
            beam(post.length, |place| design.factors.load * posts.width * case.diagram.at(ground + place * upright));
        // What hits at one place may hit the post.
        let hit = case.point.map_or(BeamState::default(), |point| {
            let share = ((point.height - ground) / (post.length * upright)).clamp(0.0, 1.0);
            let force = design.factors.load * point.force / upright;
            let moment = force * share * (1.0 - share) * post.length;
            BeamState { head: force * share, foot: force * (1.0 - share), moment }
        });
        BeamState { head: pressed.head + hit.head, foot: pressed.foot + hit.foot, moment: pressed.moment + hit.moment }
    };
    stages.iter().map(of).fold(BeamState::default(), |most, state| BeamState {
        head: larger_or_nan(most.head, state.head),
        foot: larger_or_nan(most.foot, state.foot),
        moment: larger_or_nan(most.moment, state.moment),
    })
}

/// Largest difference of the rope's pull on the two sides of a head, T (1 − e^(−μθ)), with the angle θ by which the rope turns over it.
fn friction(rope: &RopeLoad, bays: [f64; 2], friction: f64) -> f64 {
    let slope = |bay: f64| libm::atan(4.0 * rope.state.sag * bay / (rope.span * rope.span));
    let turn = slope(bays[0]) + slope(bays[1]);
    f64::from(rope.ropes) * rope.state.tension * -libm::expm1(-friction * turn)
}
