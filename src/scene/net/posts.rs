//! Posts in the plane of the barrier, the uppermost rope over their heads, and the ropes that retain them.
//!
//! A foot stands on the ground below the head, in the plane of the barrier. The ropes that retain a head run straight to their anchors in the
//! ground upstream, in pieces that are not shorter than the rings on a main rope stand apart, each of them with its dissipators at the anchor.

use std::f64::consts::PI;

use crate::design::{DissipatorDesign, Posts};
use crate::scene::ground::{gravity, height_at};
use crate::scene::net::build::{Builder, ROPE_DAMPING_RATIO, ROPE_DENSITY, dissipator};
use dem::elements::post::{MASS_AT_HEAD, Post, WEIGHT_AT_HEAD};
use dem::elements::segment::SegmentKind;
use dem::tables::barrier::Anchor;

/// Least distance of a head from the rings beside it, over the spacing of the rings: more than the rope has left where rings touch.
const CLEAR: f64 = 0.3;
/// Length of a piece of a retaining rope over the spacing of the rings, about.
const PIECE: f64 = 2.0;

impl Builder<'_> {
    /// Adds the posts to the nodes of the uppermost rope, from one end to the other; returns these with the heads among them.
    pub(super) fn add_posts(&mut self, line: Vec<u32>) -> Vec<u32> {
        let Some(posts) = self.design.posts.clone() else { return line };
        let mut line = line;
        for (number, right) in posts.at.iter().enumerate() {
            let across = self.clear_of_rings(&line, self.channel.across(*right));
            let head = self.add_node(self.place(across, self.design.height), false);
            self.add_post(number as u16, head, &posts);
            let place = line.partition_point(|node| self.barrier.nodes[*node as usize].position.y < across);
            line.insert(place, head);
            self.heads.push(head);
        }
        line
    }

    /// A place moved off a ring that is too close to it (m).
    fn clear_of_rings(&self, line: &[u32], across: f64) -> f64 {
        let clear = CLEAR * self.design.main_ropes.ring_spacing;
        let rings = line.iter().map(|node| self.barrier.nodes[*node as usize].position.y);
        let nearest = rings.min_by(|a, b| (a - across).abs().total_cmp(&(b - across).abs()));
        match nearest {
            Some(ring) if (ring - across).abs() < clear => ring + if across >= ring { clear } else { -clear },
            _ => across,
        }
    }

    fn add_post(&mut self, number: u16, head: u32, posts: &Posts) {
        let top = self.barrier.nodes[head as usize].position;
        let ground = self.channel.ground_at(top.y);
        let up = (ground - self.design.bottom.gap()) / self.directions()[0].z;
        let foot = self.add_node(self.place(top.y, up), true);
        let place = self.barrier.nodes[foot as usize].position;
        let rest_length = (top - place).norm();
        let mass = posts.mass(rest_length);
        let on_head = MASS_AT_HEAD * mass;
        self.barrier.nodes[head as usize].mass += on_head;
        self.barrier.nodes[foot as usize].mass += mass - on_head;
        let stiffness = posts.modulus * posts.area / rest_length;
        self.barrier.posts.push(Post {
            nodes: [foot, head],
            number,
            rest_length,
            stiffness,
            damping: 2.0 * ROPE_DAMPING_RATIO * (stiffness * on_head).sqrt(),
            radius: 0.5 * posts.width,
            weight: gravity(self.channel.slope) * (WEIGHT_AT_HEAD * mass),
        });
        for side in posts.retaining.sides() {
            self.add_retaining_rope(number, [foot, head], side, posts);
        }
    }

    /// A rope from the head of a post to its anchor, so far to the right of the post looking downstream (m).
    fn add_retaining_rope(&mut self, number: u16, [foot, head]: [u32; 2], side: f64, posts: &Posts) {
        let (retaining, kind) = (&posts.retaining, SegmentKind::Retaining(number));
        let [from, base] = [head, foot].map(|node| self.barrier.nodes[node as usize].position);
        let to = height_at(self.channel, base.x - retaining.set_back, base.y - side);
        let anchor = self.add_node(to, true);
        self.barrier.anchors.push(Anchor { node: anchor, kind });
        let gap = if retaining.dissipators.is_some() { self.design.side_gap() } else { 0.0 };
        let end = to + (from - to).normalize() * gap;
        let last = match &retaining.dissipators {
            Some(_) => self.add_node(end, false),
            None => anchor,
        };
        let piece = PIECE * self.design.main_ropes.ring_spacing;
        let pieces = ((from - end).norm() / piece).floor().max(1.0) as u32;
        let mut before = head;
        for number in 1..=pieces {
            let node = match number == pieces {
                true => last,
                false => self.add_node(from.lerp(&end, f64::from(number) / f64::from(pieces)), false),
            };
            self.add_segment([before, node], kind, &retaining.rope);
            before = node;
        }
        if let Some(design) = &retaining.dissipators {
            self.add_dissipator([anchor, last], kind, design, 0.5 * retaining.rope.diameter);
        }
    }

    /// A dissipator between an anchor and the end of its ropes, at rest as it lies.
    pub(super) fn add_dissipator(
        &mut self,
        nodes: [u32; 2],
        kind: SegmentKind,
        design: &DissipatorDesign,
        radius: f64,
    ) {
        let sharing = self.barrier.sharing(kind);
        let [a, b] = nodes.map(|node| self.barrier.nodes[node as usize].position);
        self.barrier.dissipators.push(dissipator(nodes, kind, (b - a).norm(), design, sharing, radius));
    }
}

/// Mass of a piece of a retaining rope (kg) and its stiffness (N/m), as its builder makes it.
pub fn piece_of_retaining_rope(posts: &Posts, ring_spacing: f64) -> [f64; 2] {
    let (rope, length) = (&posts.retaining.rope, PIECE * ring_spacing);
    let area = 0.25 * PI * rope.diameter * rope.diameter;
    [ROPE_DENSITY * area * length, rope.modulus * area / length]
}

#[cfg(test)]
mod tests {
    use crate::design::BarrierDesign;
    use crate::design::read::read_design;
    use crate::scene::net::build::{BuiltNet, build};
    use dem::elements::segment::SegmentKind;

    fn built(change: impl Fn(String) -> String) -> BuiltNet {
        let text = change(include_str!("../../../designs/net_with_posts.yaml").to_string());
        let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        build(net, &design.channel, design.simulation.barrier_model, 1)
    }

    #[test]
    fn the_uppermost_rope_runs_over_the_heads() {
        let net = built(|text| text);
        let barrier = &net.barrier;
        assert_eq!(barrier.posts.len(), 2);
        let top = net.rows.last().expect("rows");
        let across = |node: &u32| barrier.nodes[*node as usize].position.y;
        assert!(top.is_sorted_by(|a, b| across(a) < across(b)));
        let chain = barrier.chains.last().expect("a chain");
        assert_eq!(chain.segments.len(), chain.frictions.len() + 1);
        for post in &barrier.posts {
            let [foot, head] = post.nodes;
            assert!(top.contains(&head) && barrier.nodes[foot as usize].fixed);
            assert!(barrier.nodes[foot as usize].position.z.abs() < 1e-9);
            let joint = chain.segments.iter().position(|segment| barrier.segments[*segment as usize].nodes[0] == head);
            let others: Vec<f64> =
                chain.frictions.iter().enumerate().filter(|(at, _)| Some(at + 1) != joint).map(|(_, f)| *f).collect();
            assert!(chain.frictions[joint.expect("a joint") - 1] > others[0]);
        }
        // No piece of rope is so short that the rope could not slide.
        let spacing = chain.shortest / super::super::build::SHORTEST_SEGMENT;
        let shortest = chain.segments.iter().map(|segment| barrier.segments[*segment as usize].rest_length);
        assert!(shortest.fold(f64::INFINITY, f64::min) > chain.shortest, "{spacing}");
    }

    /// Two ropes to a post, each straight to its anchor on the bed, and at rest.
    #[test]
    fn the_heads_are_held_upstream() {
        let net = built(|text| text);
        let barrier = &net.barrier;
        let retaining = |kind: SegmentKind| matches!(kind, SegmentKind::Retaining(_));
        let anchors: Vec<_> = barrier.anchors.iter().filter(|anchor| retaining(anchor.kind)).collect();
        assert_eq!(anchors.len(), 4);
        for anchor in &anchors {
            let place = barrier.nodes[anchor.node as usize].position;
            assert!(place.z.abs() < 1e-9 && place.x < -2.0, "{place}");
        }
        assert_eq!(barrier.dissipators.iter().filter(|dissipator| retaining(dissipator.kind)).count(), 4);
        assert!(barrier.face() < 1.0 && net.reach() > 2.0);
        let stretched = barrier.segments.iter().filter(|segment| retaining(segment.kind)).map(|segment| {
            let [a, b] = segment.nodes.map(|node| barrier.nodes[node as usize].position);
            ((b - a).norm() - segment.rest_length).abs()
        });
        assert!(stretched.fold(0.0, f64::max) < 1e-12);
    }
}
