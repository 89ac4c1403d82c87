//! Contacts of grains with the lines of a flexible barrier, and with the nodes where they end.
//!
//! A sphere meets a line as a capsule. Lines that meet in a node overlap each other there, and a grain near the node must not be
//! pushed by each of them in full. So they count as one body: of the overlaps u_j with the node that the lines have which run on
//! from it towards the grain, each as thick as it is, only the largest counts, and every such line gives up the share
//! 1 − max u_j/Σ u_j of its own. For two alike lines this is the gradient of the energy ½k (u₁² + u₂² − u_node²) to first order in
//! the distance from the node. A node from which all lines lead away is touched once. So the force neither doubles nor
//! jumps by more than that order where a grain passes a node.
//!
//! The force acts on the axis of the line: a rope does not roll under a grain, its weave holds it. (Where nodes turn, the friction at the
//! surface, some 8 mm off the axis, would spin the knots of a net round and round.)
//!
//! The friction spring goes along when a grain slides from one line to the next.

use std::ops::Range;

use crate::Vec3;
use crate::contact::law::{ContactPoint, LawConstants, Memory, Spring, respond};
use crate::contact::pair_list::{PairList, Separation};
use crate::geometry::point_segment::{OnSegment, nearest_on_segment};
use crate::ledger::ContactSums;
use crate::neighbours::clocks::{Clock, STEPS_AHEAD};
use crate::simd::quad::Quad;
use crate::tables::barrier::{Barrier, Line, LineEnd};
use crate::tables::grain_rows::{GrainRows, Member};
use crate::tables::grain_table::GrainLoad;
use crate::tables::nodes::Node;
use crate::tables::prefetch::prefetch;

/// Gap over the grain's radius up to which grain and line are followed from the start of a step, whatever their velocities.
const ALWAYS_AHEAD: f64 = 0.01;

/// How many pairs ahead the nodes of a line are asked for: another thread may just have moved them.
const PAIRS_AHEAD: usize = 6;

/// Candidate pairs (member, line) of one block, and the forces they put on nodes in this step.
#[derive(Clone, Debug, Default)]
pub struct RopeContacts {
    pub list: PairList,
    pub pushes: Vec<Push>,
    /// Grains whose centre has gone through a line in this step.
    pub crossings: u32,
    /// How fast a grain and a node could come closer when the lists were made, at most (m/s).
    pub closing: f64,
    /// Scratch: the contact of every touching pair, and the nodes that the last grain has come to.
    touches: Vec<Option<RopeTouch>>,
    at_nodes: AtNodes,
}

/// Force of one grain on one line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// Row of the grain.
    pub row: u32,
    /// Place of grain and line among the pairs in contact.
    pub pair: u32,
    pub nodes: [u32; 2],
    /// Share of the force that the second node takes.
    pub share: f64,
    pub force: Vec3,
}

/// What all contacts of grains with the barrier have in common.
#[derive(Clone, Copy, Debug)]
pub struct OnBarrier {
    pub law: LawConstants,
    pub grain_modulus: f64,
    pub grain_friction: f64,
}

#[derive(Clone, Copy)]
pub struct RopeContext<'a> {
    pub grains: GrainRows<'a>,
    pub barrier: &'a Barrier,
    pub constants: OnBarrier,
    /// Way that grains and nodes together can have gone since the lists were made (m).
    pub clock: Clock,
}

/// A sphere on a line: the contact, its foot, and how the force is shared between the line's nodes.
#[derive(Clone, Copy, Debug)]
pub struct RopeTouch {
    pub point: ContactPoint,
    pub foot: Vec3,
    pub share: f64,
    /// Whether the centre has gone through the axis in the step just made.
    pub crossed: bool,
}

impl RopeContacts {
    /// Loads the grains of the block that touch ropes and lists the pushes on the nodes.
    pub fn load(&mut self, context: &RopeContext, range: &Range<usize>, loads: &mut [GrainLoad]) -> ContactSums {
        self.crossings = 0;
        let (grains, barrier) = (context.grains, context.barrier);
        self.list.sort_near(&context.clock, &OnRopes { grains, barrier });
        let pairs = std::mem::take(&mut self.list.touching);
        let mut pushes = std::mem::take(&mut self.pushes);
        pushes.clear();
        let sums = self.press(&pairs, context, loads, range.start, |row| row as u32, &mut pushes);
        (self.list.touching, self.pushes) = (pairs, pushes);
        self.list.end_contacts();
        sums
    }

    /// Takes all pairs that could touch within the step to come (s) for pairs in contact: [`Self::press`] tells which do. The nodes stand where
    /// they are in its first part, the grains `to_middle` (s) later. What is faster at the end of the step than now may touch unseen for the rest
    /// of it.
    pub fn wake(&mut self, context: &RopeContext, step: f64, to_middle: f64) {
        let (grains, barrier, clock) = (context.grains, context.barrier, context.clock);
        self.list.sort_near(&clock, &OnRopes { grains, barrier });
        // The first step has none before it.
        let way = STEPS_AHEAD * clock.tick.max(step * self.closing);
        self.list.wake(&Clock { now: clock.now + way, ..clock });
        self.list.take_near(|[member, line]| {
            let member = grains.member(member as usize);
            let thickness = barrier.lines[line as usize].thickness;
            let ends = barrier.lines[line as usize].nodes.map(|node| &barrier.nodes[node as usize].velocity);
            let closing = ends.map(|end| (member.velocity - end).norm_squared());
            let way = STEPS_AHEAD * step * closing[0].max(closing[1]).sqrt();
            let reach = member.radius * (1.0 + ALWAYS_AHEAD) + thickness + way;
            let first = member.centre - member.velocity * to_middle;
            Nearest::of(&first, line, barrier).square < reach * reach
        });
    }

    /// Loads the grains of `pairs`, those of the list as `context` numbers its members, and adds the forces on the nodes to `pushes`. Notes the
    /// pairs that do not touch.
    pub fn press(
        &mut self,
        pairs: &[[u32; 2]],
        context: &RopeContext,
        loads: &mut [GrainLoad],
        first: usize,
        named: impl Fn(usize) -> u32,
        pushes: &mut Vec<Push>,
    ) -> ContactSums {
        let mut sums = ContactSums { lost_friction: self.find_touches(pairs, context), ..ContactSums::default() };
        let (grains, barrier) = (context.grains, context.barrier);
        let per_grain = grains.shape.members();
        let Self { list, touches, crossings, .. } = self;
        for (place, ((pair, memory), contact)) in pairs.iter().zip(&mut list.memory).zip(touches).enumerate() {
            let [index, line] = *pair;
            let Some(contact) = contact else { continue };
            let member = grains.member(index as usize);
            let response = respond(&contact.point, &Memory::from_quad(*memory), &context.constants.law);
            *memory = response.memory.quad();
            let force = Vec3::from(response.force);
            let row = index as usize / per_grain;
            loads[row - first].add(&force, &(contact.foot - member.centre + member.arm));
            let nodes = barrier.lines[line as usize].nodes;
            pushes.push(Push { row: named(row), pair: place as u32, nodes, share: contact.share, force: -force });
            sums.count(&response, contact.point.overlap / member.radius);
            *crossings += u32::from(contact.crossed);
        }
        sums
    }

    /// Finds the contact of every touching pair, notes those that have ended, and hands the friction springs of pairs whose
    /// contact has passed to another line at the same node on to that. Returns the energy of springs that nobody takes (J).
    fn find_touches(&mut self, pairs: &[[u32; 2]], context: &RopeContext) -> f64 {
        let barrier = context.barrier;
        let Self { list, touches, at_nodes, .. } = self;
        touches.clear();
        list.ended.clear();
        at_nodes.forget();
        for (place, &[index, line]) in pairs.iter().enumerate() {
            if let Some([_, next]) = pairs.get(place + PAIRS_AHEAD) {
                let nodes = barrier.lines[*next as usize].nodes;
                for node in nodes.map(|node| &barrier.nodes[node as usize]) {
                    // It may lie across two lines of the cache.
                    prefetch(&node.position.x);
                    prefetch(&node.velocity.z);
                }
            }
            let (centre, radius) = context.grains.sphere(index as usize);
            let nearest = Nearest::of(&centre, line, barrier);
            let reach = radius + barrier.lines[line as usize].thickness;
            if nearest.square >= reach * reach {
                list.ended.push(place as u32);
                touches.push(None);
            } else {
                at_nodes.come_to(index);
                touches.push(touch_at(&context.grains.member(index as usize), line, &nearest, context, at_nodes));
            }
        }
        let mut lost = 0.0;
        for place in 0..touches.len() {
            let memory = Memory::from_quad(list.memory[place]);
            if touches[place].is_some() || memory == Memory::default() {
                continue;
            }
            list.memory[place] = Quad::default();
            let heir = heir(place, pairs, &list.memory, touches, barrier);
            match heir {
                Some(heir) => list.memory[heir] = memory.quad(),
                None => lost += self::stored(&memory, pairs[place], context),
            }
        }
        lost
    }
}

/// The pair of the same grain and of a line at the same node that has just begun to touch.
fn heir(
    place: usize,
    pairs: &[[u32; 2]],
    memory: &[Quad],
    touches: &[Option<RopeTouch>],
    barrier: &Barrier,
) -> Option<usize> {
    let [member, line] = pairs[place];
    let nodes = barrier.lines[line as usize].nodes;
    (0..touches.len()).find(|&other| {
        let [same, next] = pairs[other];
        same == member
            && touches[other].is_some()
            && memory[other] == Quad::default()
            && barrier.lines[next as usize].nodes.iter().any(|node| nodes.contains(node))
    })
}

/// Energy that a friction spring holds (J), taken as if the line had kept its whole overlap.
fn stored(memory: &Memory, [member, line]: [u32; 2], context: &RopeContext) -> f64 {
    let member = context.grains.member(member as usize);
    let line = &context.barrier.lines[line as usize];
    let [a, b] = line.nodes.map(|node| &context.barrier.nodes[node as usize]);
    let share = nearest_on_segment(&member.centre, &a.position, &b.position).share;
    let grain = context.constants.grain_modulus * member.radius;
    let rope = context.barrier.contact_modulus * line.radius;
    let spring = Spring::between([grain, rope], member.inverse_mass + inverse_mass_at(a, b, share));
    0.5 * Vec3::from(memory.tangential).norm_squared() * spring.compliance
        / context.constants.law.friction_spring(&spring).stiffness_ratio()
}

/// Member spheres and lines, taken as thick as the thicker of their ends: never closer than they are.
pub struct OnRopes<'a> {
    pub grains: GrainRows<'a>,
    pub barrier: &'a Barrier,
}

impl Separation for OnRopes<'_> {
    fn of(&self, [member, line]: [u32; 2]) -> (f64, f64) {
        let (centre, radius) = self.grains.sphere(member as usize);
        let line = &self.barrier.lines[line as usize];
        let [a, b] = line.nodes.map(|node| &self.barrier.nodes[node as usize].position);
        let nearest = nearest_on_segment(&centre, a, b).point;
        ((nearest - centre).norm_squared(), radius + line.thickness)
    }
}

/// Share of its overlap that a line keeps at least, whatever it gives up at its nodes.
const LEAST_KEPT: f64 = 0.1;

/// The point of a line nearest to a centre.
struct Nearest {
    along: OnSegment,
    towards: Vec3,
    /// Of its distance (m²).
    square: f64,
}

impl Nearest {
    fn of(centre: &Vec3, line: u32, barrier: &Barrier) -> Self {
        let [a, b] = barrier.lines[line as usize].nodes.map(|node| &barrier.nodes[node as usize].position);
        let along = nearest_on_segment(centre, a, b);
        let towards = along.point - centre;
        Self { along, towards, square: towards.norm_squared() }
    }
}

/// Geometry of sphere against line, or against the node a line ends in.
pub fn touch(member: &Member, line: u32, context: &RopeContext) -> Option<RopeTouch> {
    let nearest = Nearest::of(&member.centre, line, context.barrier);
    touch_at(member, line, &nearest, context, &mut AtNodes::default())
}

#[inline(always)]
fn touch_at(
    member: &Member,
    line_index: u32,
    nearest: &Nearest,
    context: &RopeContext,
    at_nodes: &mut AtNodes,
) -> Option<RopeTouch> {
    let barrier = context.barrier;
    let line = &barrier.lines[line_index as usize];
    if line.broken {
        return None;
    }
    let [a, b] = line.nodes.map(|node| &barrier.nodes[node as usize]);
    let centre = member.centre;
    let Nearest { along, towards, square: distance_squared } = *nearest;
    let end = usize::from(along.share > 0.5);
    let rope_radius = if along.inside { line.radius } else { [a, b][end].radius };
    let reach = member.radius + rope_radius;
    if distance_squared >= reach * reach || distance_squared == 0.0 {
        return None;
    }
    if !along.inside && !owns_node(line_index, line.nodes[end], &centre, barrier) {
        return None;
    }
    let distance = distance_squared.sqrt();
    let overlap = reach - distance;
    let normal = towards / distance;
    let foot = centre + normal * (member.radius - 0.5 * overlap);
    let rope_velocity = a.velocity * (1.0 - along.share) + b.velocity * along.share;
    let half_step = 0.5 * context.constants.law.time_step;
    let of_centres = rope_velocity - member.velocity_before(half_step);
    let turning =
        turning(&of_centres, &normal, distance, [a, b].map(|end| (&end.position, &end.velocity)), along.inside);
    let middle = normal - turning * half_step;
    let velocity = of_centres - member.spin.cross(&(middle * (member.radius - 0.5 * overlap)));
    let grain = context.constants.grain_modulus * member.radius;
    let rope = barrier.contact_modulus * rope_radius;
    let inverse_mass = member.inverse_mass + inverse_mass_at(a, b, along.share);
    let given_up = if along.inside { at_nodes.given_up(member, line, barrier) / overlap } else { 0.0 };
    let kept = (1.0 - given_up).max(LEAST_KEPT);
    let point = ContactPoint {
        normal: normal.into(),
        middle: middle.into(),
        overlap,
        velocity: velocity.into(),
        twist: 0.5 * member.spin.dot(&normal),
        spring: Spring::between([grain, rope], inverse_mass).part(kept),
        friction: barrier.friction.min(context.constants.grain_friction),
    };
    let before = towards - (rope_velocity - member.velocity) * context.constants.law.time_step;
    let crossed = before.dot(&towards) < 0.0;
    Some(RopeTouch { point, foot, share: along.share, crossed })
}

/// Rate at which the normal of a contact with a line turns (1/s): with what moves across it, and beside an end with all that moves; along a
/// line it stays square to it however that turns.
fn turning(of_centres: &Vec3, normal: &Vec3, distance: f64, ends: [(&Vec3, &Vec3); 2], inside: bool) -> Vec3 {
    let across = of_centres - normal * normal.dot(of_centres);
    if !inside {
        return across / distance;
    }
    let [(from, slow), (to, fast)] = ends;
    let line = to - from;
    let length = line.norm();
    let axis = line / length;
    let turned = (fast - slow) / length;
    (across - axis * axis.dot(&across)) / distance - axis * normal.dot(&turned)
}

/// How one grain overlaps the nodes of the lines that it touches: what every line that ends in a node would else find out anew.
#[derive(Clone, Debug, Default)]
struct AtNodes {
    member: Option<u32>,
    nodes: Vec<AtNode>,
}

/// A node that a grain has come to.
#[derive(Clone, Copy, Debug)]
struct AtNode {
    node: u32,
    /// Overlap with the bare point (m).
    bare: f64,
    /// Share of its overlap with the node that each line gives up there; nothing where it has not been asked for.
    given_up: Option<f64>,
}

impl AtNodes {
    fn forget(&mut self) {
        self.member = None;
        self.nodes.clear();
    }

    /// Goes on with the grain of this number.
    fn come_to(&mut self, member: u32) {
        if self.member != Some(member) {
            self.member = Some(member);
            self.nodes.clear();
        }
    }

    /// Overlap that a line gives up at its nodes because other lines have it as well (m).
    fn given_up(&mut self, member: &Member, line: &Line, barrier: &Barrier) -> f64 {
        let [first, last] = line.nodes;
        self.given_up_at(first, member, line, barrier) + self.given_up_at(last, member, line, barrier)
    }

    fn given_up_at(&mut self, node: u32, member: &Member, line: &Line, barrier: &Barrier) -> f64 {
        let place = self.nodes.iter().position(|known| known.node == node).unwrap_or_else(|| {
            let from_node = member.centre - barrier.nodes[node as usize].position;
            self.nodes.push(AtNode { node, bare: member.radius - from_node.norm(), given_up: None });
            self.nodes.len() - 1
        });
        let known = &mut self.nodes[place];
        let mine = known.bare + line.radius;
        if mine <= 0.0 {
            return 0.0;
        }
        mine * *known.given_up.get_or_insert_with(|| shared_at(node, &member.centre, known.bare, barrier))
    }
}

/// Share 1 − max u_j/Σ u_j of its overlap that each line gives up at a node, for a sphere at `centre` whose overlap with the bare point is `bare` (m).
fn shared_at(node: u32, centre: &Vec3, bare: f64, barrier: &Barrier) -> f64 {
    let here = barrier.nodes[node as usize].position;
    let from_node = centre - here;
    let (mut most, mut sum) = (0.0_f64, 0.0);
    for end in barrier.line_ends.at(node).iter().filter(|end| leads_to(end, &here, &from_node, barrier)) {
        let overlap = (bare + end.radius).max(0.0);
        most = most.max(overlap);
        sum += overlap;
    }
    if sum > 0.0 { 1.0 - most / sum } else { 0.0 }
}

/// Whether a line runs on from its end, at the place `here`, towards a point that lies `from_node` off it.
fn leads_to(end: &LineEnd, here: &Vec3, from_node: &Vec3, barrier: &Barrier) -> bool {
    from_node.dot(&(barrier.nodes[end.far as usize].position - here)) > 0.0
}

/// 1/m felt at the point that divides a line as (1−share):share; a fixed node counts as infinitely heavy.
fn inverse_mass_at(a: &Node, b: &Node, share: f64) -> f64 {
    let inverse = |node: &Node| if node.fixed { 0.0 } else { 1.0 / node.mass };
    (1.0 - share).powi(2) * inverse(a) + share.powi(2) * inverse(b)
}

/// Whether `line` stands for its end `node` towards a sphere at `centre`: every line at the node must
/// have the node as its nearest point, and this one must be the first of them.
fn owns_node(line: u32, node: u32, centre: &Vec3, barrier: &Barrier) -> bool {
    let here = barrier.nodes[node as usize].position;
    let (from_node, ends) = (centre - here, barrier.line_ends.at(node));
    ends.first().is_some_and(|first| first.line == line)
        && ends.iter().all(|end| !leads_to(end, &here, &from_node, barrier))
}
