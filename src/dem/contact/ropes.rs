//! Contacts of grains with rope segments and nodes of a flexible barrier.
//!
//! A sphere meets a segment as a capsule. Where the nearest point of every segment at a node is the node
//! itself, the node is touched once, through the segment with the lowest number, so that a grain on the convex side of a
//! crossing is not pushed once by each rope. On a flat crossing a grain still touches each rope that it reaches.

use std::ops::Range;

use crate::dem::Vec3;
use crate::dem::contact::law::{ContactPoint, LawConstants, Memory, Spring, contact_stiffness, respond};
use crate::dem::contact::pair_list::{PairList, Separation};
use crate::dem::geometry::point_segment::nearest_on_segment;
use crate::dem::ledger::ContactSums;
use crate::dem::neighbours::clocks::Clock;
use crate::dem::tables::barrier::{Barrier, Node};
use crate::dem::tables::grain_rows::{GrainRows, Member};
use crate::dem::tables::grain_table::{GrainLoad, Quad};

/// Candidate pairs (member, segment) of one block, and the forces they put on nodes in this step.
#[derive(Clone, Debug, Default)]
pub struct RopeContacts {
    pub list: PairList,
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
    pub grains: GrainRows<'a>,
    pub barrier: &'a Barrier,
    pub law: LawConstants,
    pub grain_modulus: f64,
    pub grain_friction: f64,
    /// Way that grains and nodes together can have gone since the lists were made (m).
    pub clock: Clock,
}

/// A sphere on a rope: the contact, its foot, and how the force is shared between the segment's nodes.
pub struct RopeTouch {
    pub point: ContactPoint,
    /// 1/m_r (1/kg).
    pub inverse_mass: f64,
    pub foot: Vec3,
    pub share: f64,
}

impl RopeContacts {
    /// Loads the grains of the block that touch ropes and lists the pushes on the nodes.
    pub fn load(&mut self, context: &RopeContext, range: &Range<usize>, loads: &mut [GrainLoad]) -> ContactSums {
        let mut sums = ContactSums::default();
        self.pushes.clear();
        let Self { list, pushes } = self;
        let (grains, barrier) = (context.grains, context.barrier);
        let on_ropes = OnRopes { grains, barrier };
        list.sort_near(&context.clock, &on_ropes);
        let per_grain = grains.shape.members();
        let PairList { touching, memory, ended, .. } = list;
        for (place, (pair, memory)) in touching.iter().zip(memory).enumerate() {
            let [index, segment] = *pair;
            let member = grains.member(index as usize);
            if on_ropes.gap(*pair) >= 0.0 {
                ended.push(place as u32);
                continue;
            }
            let Some(contact) = touch(&member, segment, context) else {
                *memory = Quad::default();
                continue;
            };
            let response = respond(&contact.point, &Memory::from_quad(*memory), &context.law);
            *memory = response.memory.quad();
            let force = Vec3::from(response.force);
            let row = index as usize / per_grain - range.start;
            loads[row].add(&force, &(contact.foot - member.centre + member.arm));
            let nodes = barrier.segments[segment as usize].nodes;
            pushes.push(Push { nodes, share: contact.share, force: -force });
            sums.count(&response, contact.point.overlap / member.radius);
        }
        list.end_contacts();
        sums
    }
}

/// Member spheres and rope segments, taken as thick as the thicker of their ends: never closer than they are.
pub struct OnRopes<'a> {
    pub grains: GrainRows<'a>,
    pub barrier: &'a Barrier,
}

impl Separation for OnRopes<'_> {
    fn of(&self, [member, segment]: [u32; 2]) -> (f64, f64) {
        let (centre, radius) = self.grains.sphere(member as usize);
        let ends = self.barrier.segments[segment as usize].nodes;
        let [a, b] = ends.map(|node| &self.barrier.nodes[node as usize].position);
        let nearest = nearest_on_segment(&centre, a, b).point;
        ((nearest - centre).norm_squared(), radius + self.barrier.thickness(segment))
    }
}

/// Geometry of sphere against segment, or against the node a segment ends in.
pub fn touch(member: &Member, segment_index: u32, context: &RopeContext) -> Option<RopeTouch> {
    let barrier = context.barrier;
    let segment = &barrier.segments[segment_index as usize];
    let [a, b] = segment.nodes.map(|node| &barrier.nodes[node as usize]);
    let centre = member.centre;
    let along = nearest_on_segment(&centre, &a.position, &b.position);
    let towards = along.point - centre;
    let end = usize::from(along.share > 0.5);
    let rope_radius = if along.inside { segment.radius } else { [a, b][end].radius };
    let reach = member.radius + rope_radius;
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
    let foot = centre + normal * (member.radius - 0.5 * overlap);
    let rope_velocity = a.velocity * (1.0 - along.share) + b.velocity * along.share;
    let velocity = rope_velocity - member.velocity - member.spin.cross(&(foot - centre));
    let grain = context.grain_modulus * member.radius;
    let rope = barrier.contact_modulus * rope_radius;
    let inverse_mass = member.inverse_mass + inverse_mass_at(a, b, along.share);
    let point = ContactPoint {
        normal: normal.into(),
        overlap,
        velocity: velocity.into(),
        twist: 0.5 * member.spin.dot(&normal),
        spring: Spring::new(contact_stiffness(grain, rope), inverse_mass),
        friction: barrier.friction.min(context.grain_friction),
    };
    Some(RopeTouch { point, inverse_mass, foot, share: along.share })
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
