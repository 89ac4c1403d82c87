//! What posts, their feet and the ropes that retain them bear.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::post::Post;
use crate::elements::segment::SegmentKind;
use crate::larger_or_nan;
use crate::recorders::body::{BodyRecorder, add_rows, add_shares, keep_larger, means};
use crate::recorders::channels::{Channel, Channels, Rows};
use crate::recorders::setup::RecorderSetup;
use crate::simulation::Simulation;
use crate::tables::nodes::Node;

/// Compression of each post; negative where it is pulled.
pub const COMPRESSION: Channel = Channel { name: "post", unit: "n", rows: Rows::EachPost };
/// Moment by which grains that push on each post bend it, as a beam between foot and head: the sum of the largest moments of all pushes, which
/// is no less than that of all together.
pub const MOMENT: Channel = Channel { name: "post_moment", unit: "n_m", rows: Rows::EachPost };
/// Force of each post and of the grains that lean on it on its foot, in the channel frame.
pub const FOOT: [Channel; 3] = [
    Channel { name: "foot_x", unit: "n", rows: Rows::EachPost },
    Channel { name: "foot_y", unit: "n", rows: Rows::EachPost },
    Channel { name: "foot_z", unit: "n", rows: Rows::EachPost },
];
/// Largest tension of the ropes that retain each post, their dissipators included.
pub const RETAINING: Channel = Channel { name: "retaining_largest", unit: "n", rows: Rows::EachPost };
/// Both at any instant of a sample; no less than 0.
pub const COMPRESSION_AT_ONCE: Channel = Channel { name: "post_at_once", unit: "n", rows: Rows::EachPost };
pub const RETAINING_AT_ONCE: Channel = Channel { name: "retaining_largest_at_once", unit: "n", rows: Rows::EachPost };
/// Stroke used by the dissipators of the ropes that retain each post, the largest of them.
pub const STROKE: Channel = Channel { name: "retaining_stroke", unit: "m", rows: Rows::EachPost };

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OfPosts {
    compression: Vec<f64>,
    moment: Vec<f64>,
    feet: Vec<Vec3>,
    retaining: Vec<f64>,
    /// Largest at any instant: compression, and tension of the retaining ropes.
    at_once: [Vec<f64>; 2],
}

impl BodyRecorder for OfPosts {
    fn add_step(&mut self, simulation: &Simulation, _: &RecorderSetup) {
        let (Some(barrier), net) = (&simulation.model.barrier, &simulation.sums.net) else { return };
        if barrier.posts.is_empty() {
            return;
        }
        let compression: Vec<f64> = net.posts.iter().map(|tension| -tension).collect();
        add_rows(&mut self.compression, &compression);
        add_rows(&mut self.moment, &moments(simulation, &barrier.posts, &barrier.nodes));
        self.feet.resize(barrier.posts.len(), Vec3::zeros());
        for (sum, post) in self.feet.iter_mut().zip(&barrier.posts) {
            *sum += net.forces[post.nodes[0] as usize];
        }
        let substeps = simulation.sums.net_in_substeps();
        for net in substeps {
            let mut largest = vec![0.0_f64; barrier.posts.len()];
            net.each_axial_member(barrier, |member, tension| {
                if let SegmentKind::Retaining(post) = member.kind {
                    let of_post = &mut largest[usize::from(post)];
                    *of_post = larger_or_nan(*of_post, tension);
                }
            });
            add_shares(&mut self.retaining, &largest, substeps.len());
            let pressed: Vec<f64> = net.posts.iter().map(|tension| -tension).collect();
            let [compression, retaining] = &mut self.at_once;
            keep_larger(compression, &pressed);
            keep_larger(retaining, &largest);
        }
    }

    fn sample(&mut self, simulation: &Simulation, _: &RecorderSetup, steps: u32, channels: &mut Channels) {
        let Some(barrier) = &simulation.model.barrier else { return };
        let done = std::mem::take(self);
        channels.push(&COMPRESSION, &means(&done.compression, steps));
        channels.push(&MOMENT, &means(&done.moment, steps));
        for (axis, channel) in FOOT.iter().enumerate() {
            let along: Vec<f64> = done.feet.iter().map(|force| force[axis]).collect();
            channels.push(channel, &means(&along, steps));
        }
        channels.push(&RETAINING, &means(&done.retaining, steps));
        let [compression, retaining] = &done.at_once;
        channels.push(&COMPRESSION_AT_ONCE, compression);
        channels.push(&RETAINING_AT_ONCE, retaining);
        let mut strokes = vec![0.0_f64; barrier.posts.len()];
        for dissipator in &barrier.dissipators {
            if let SegmentKind::Retaining(post) = dissipator.kind {
                let of_post = &mut strokes[usize::from(post)];
                *of_post = larger_or_nan(*of_post, dissipator.used);
            }
        }
        channels.push(&STROKE, &strokes);
    }
}

/// Σ F a b/L over all pushes on a post, with F across it and its distances a and b from the ends (N m).
fn moments(simulation: &Simulation, posts: &[Post], nodes: &[Node]) -> Vec<f64> {
    let mut moments = vec![0.0; posts.len()];
    for push in simulation.neighbours.blocks.iter().flat_map(|block| &block.ropes.pushes) {
        let Some(number) = posts.iter().position(|post| post.nodes == push.nodes) else { continue };
        let [foot, head] = push.nodes.map(|node| nodes[node as usize].position);
        let line = head - foot;
        let along = push.force.dot(&line) / line.norm_squared();
        let across = (push.force - line * along).norm();
        moments[number] += across * push.share * (1.0 - push.share) * line.norm();
    }
    moments
}
