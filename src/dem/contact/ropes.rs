//! Contacts of grains with rope segments and nodes of a flexible barrier.
//!
//! A sphere meets a segment as a capsule. Where the nearest point of every segment at a node is the node
//! itself, the node is touched once, through the segment with the lowest number, so that a grain on a
//! crossing is not pushed once by each rope.

use std::ops::Range;

use crate::dem::Vec3;
use crate::dem::contact::candidates::CandidateList;
use crate::dem::contact::law::{ContactPoint, LawConstants, respond};
use crate::dem::geometry::point_segment::nearest_on_segment;
use crate::dem::ledger::ContactSums;
use crate::dem::tables::barrier::{Barrier, Node};
use crate::dem::tables::grains::{Member, MemberLoad};

/// Candidate pairs (member, segment) of one block, and the forces they put on nodes in this step.
#[derive(Clone, Debug, Default)]
pub struct RopeContacts {
    pub list: CandidateList,
    pub pushes: Vec<Push>,
}

/// Force of one grain on one segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    pub nodes: [u32; 2],
    /// Share of the force that the second node takes.
    pub share: f64,
    pub force: Vec3,
}

pub struct RopeContext<'a> {
    pub members: &'a [Member],
    pub barrier: &'a Barrier,
    pub law: LawConstants,
    pub grain_modulus: f64,
    pub grain_friction: f64,
    pub step: u32,
}

/// A sphere on a rope: the contact, its foot, and how the force is shared between the segment's nodes.
pub struct RopeTouch {
    pub point: ContactPoint,
    pub foot: Vec3,
    pub share: f64,
}

impl RopeContacts {
    /// Loads the members of the block that touch ropes and lists the pushes on the nodes.
    pub fn load(&mut self, context: &RopeContext, range: &Range<usize>, loads: &mut [MemberLoad]) -> ContactSums {
        let mut sums = ContactSums::default();
        self.pushes.clear();
        for slot in 0..self.list.pairs.len() {
            let [member_index, segment_index] = self.list.pairs[slot];
            let member = &context.members[member_index as usize];
            let Some(contact) = touch(member, segment_index, context) else {
                continue;
            };
            let memory = self.list.memory_at(slot, context.step);
            let response = respond(&contact.point, &memory, &context.law);
            self.list.remember_at(slot, context.step, response.memory);
            let force = Vec3::from(response.force);
            loads[member_index as usize - range.start].add(&force, &(contact.foot - member.centre()));
            let nodes = context.barrier.segments[segment_index as usize].nodes;
            self.pushes.push(Push { nodes, share: contact.share, force: -force });
            sums.count(&response, contact.point.overlap / member.radius());
        }
        sums
    }
}

/// Geometry of sphere against segment, or against the node a segment ends in.
pub fn touch(member: &Member, segment_index: u32, context: &RopeContext) -> Option<RopeTouch> {
    let barrier = context.barrier;
    let segment = &barrier.segments[segment_index as usize];
    let [a, b] = segment.nodes.map(|node| &barrier.nodes[node as usize]);
    let centre = member.centre();
    let along = nearest_on_segment(&centre, &a.position, &b.position);
    let towards = along.point - centre;
    let end = usize::from(along.share > 0.5);
    let rope_radius = if along.inside { segment.radius } else { [a, b][end].radius };
    let reach = member.radius() + rope_radius;
    let distance_squared = towards.norm_squared();
    if distance_squared >= reach * reach || distance_squared == 0.0 {
        return None;
    }
    if !along.inside && !owns_node(segment_index, segment.nodes[end], &centre, barrier) {
        return None;
    }
    let distance = distance_squared.sqrt();
    let overlap = reach - distance;
    let normal = towards / distance;
    let foot = centre + normal * (member.radius() - 0.5 * overlap);
    let rope_velocity = a.velocity * (1.0 - along.share) + b.velocity * along.share;
    let velocity = rope_velocity - member.velocity() - member.spin().cross(&(foot - centre));
    let grain = context.grain_modulus * member.radius();
    let rope = barrier.contact_modulus * rope_radius;
    let point = ContactPoint {
        normal: normal.into(),
        overlap,
        velocity: velocity.into(),
        twist: 0.5 * member.spin().dot(&normal),
        stiffness: 2.0 * grain * rope / (grain + rope),
        inverse_mass: member.motion[3] + inverse_mass_at(a, b, along.share),
        friction: barrier.friction.min(context.grain_friction),
    };
    Some(RopeTouch { point, foot, share: along.share })
}

/// 1/m felt at the point that divides a segment as (1−share):share; a fixed node counts as infinitely heavy.
fn inverse_mass_at(a: &Node, b: &Node, share: f64) -> f64 {
    let inverse = |node: &Node| if node.fixed { 0.0 } else { 1.0 / node.mass };
    (1.0 - share).powi(2) * inverse(a) + share.powi(2) * inverse(b)
}

/// Whether `segment` stands for its end `node` towards a sphere at `centre`: every segment at the node must
/// have the node as its nearest point, and this one must be the first of them.
fn owns_node(segment: u32, node: u32, centre: &Vec3, barrier: &Barrier) -> bool {
    let here = &barrier.nodes[node as usize];
    if here.segments.first() != Some(&segment) {
        return false;
    }
    let from_node = centre - here.position;
    here.segments.iter().all(|&other| {
        let [a, b] = barrier.segments[other as usize].nodes;
        let far = if a == node { b } else { a };
        from_node.dot(&(barrier.nodes[far as usize].position - here.position)) <= 0.0
    })
}
