//! Forces within a flexible barrier at one instant, and their mean over a step of the grains.

use crate::Vec3;
use crate::contact::law::{LawConstants, Memory};
use crate::contact::ropes::Push;
use crate::elements::cylinder::{Cylinder, strain_all};
use crate::elements::dissipator::Dissipator;
use crate::elements::ground::Footing;
use crate::elements::ring::{RingContext, RingForce, RingSide};
use crate::elements::rope::{self, Overload};
use crate::elements::segment::{AxialMember, Segment};
use crate::tables::barrier::Barrier;
use crate::tables::nodes::Node;

/// Forces on the nodes and tensions of the elements.
#[derive(Clone, Debug, Default)]
pub struct NetForces {
    /// Force on each node (N).
    pub forces: Vec<Vec3>,
    /// Tension of each segment (N).
    pub tensions: Vec<f64>,
    /// Tension of each dissipator (N).
    pub dissipators: Vec<f64>,
    /// Torque on each node that turns (N m).
    pub torques: Vec<Vec3>,
    /// Axial force of each post (N), tension positive.
    pub posts: Vec<f64>,
    /// Axial force of each cylinder (N), tension positive.
    pub axial: Vec<f64>,
    /// Force of a leg of each ring of the net, as that of a chain that is as near to breaking (N), at each of its sides.
    pub rings: Vec<f64>,
    /// Force of all grains on the barrier (N).
    pub from_grains: Vec3,
    /// Elastic energy (J).
    pub stored: f64,
    /// Lost in rope damping, and in ropes that draw out or break (J).
    pub lost_ropes: f64,
    /// Lost by rings sliding on their ropes, in their dashpots, by side extensions, and where the barrier lies on the ground (J).
    pub lost_rings: f64,
    /// Lost in dissipators (J).
    pub lost_dissipators: f64,
    /// Dissipators with the stroke of this step, and rings with what they remember now, to be taken over.
    slipped: Vec<Dissipator>,
    let_go: Vec<Dissipator>,
    slid: Vec<(u32, Memory)>,
    /// Where the barrier lies on the ground now.
    lies: Vec<Footing>,
    /// Pieces of rope that were overloaded.
    overloaded: Vec<(usize, Overload)>,
    bent: Vec<(usize, Cylinder)>,
    /// Rings of the net that broke.
    torn: Vec<usize>,
}

/// Stretches every element to the present places of the nodes, and rests them on the ground; `law` holds the barrier's own step.
pub fn pull_all(barrier: &Barrier, law: &LawConstants) -> NetForces {
    let mut net = pull(barrier, &barrier.segments, law);
    net.rest(OnGround::of(barrier, law));
    net
}

/// The same without the ground, after ropes have slid through their rings at those places, with what they have lost since the barrier's last step. The `segments`
/// are those of the barrier, taken out of it: meanwhile others may press grains on its lines, which needs no rest lengths.
pub fn slide_and_pull(barrier: &Barrier, segments: &mut [Segment], law: &LawConstants) -> NetForces {
    let slid = barrier.chains.iter().map(|chain| chain.slide(segments, &barrier.nodes, law.time_step));
    let lost: f64 = slid.sum();
    let mut net = pull(barrier, segments, law);
    net.lost_rings += lost;
    net
}

fn pull(barrier: &Barrier, segments: &[Segment], law: &LawConstants) -> NetForces {
    let mut net = NetForces {
        forces: vec![Vec3::zeros(); barrier.nodes.len()],
        torques: vec![Vec3::zeros(); barrier.frames.len()],
        tensions: Vec::with_capacity(segments.len()),
        axial: Vec::with_capacity(barrier.cylinders.len()),
        slipped: barrier.dissipators.clone(),
        let_go: barrier.holds.clone(),
        ..NetForces::default()
    };
    net.pull_segments(segments, &barrier.nodes, law.time_step);
    net.pull_rings(barrier, law.time_step);
    net.pull_dissipators(barrier);
    net.push_posts(barrier, law.time_step);
    net.hold(barrier);
    net.strain_cylinders(barrier, law.time_step);
    let context = RingContext {
        nodes: &barrier.nodes,
        frames: &barrier.frames,
        cylinders: &barrier.cylinders,
        moduli: barrier.ring_moduli,
    };
    for ring in &barrier.rings {
        net.touch_ring(ring, &ring.force(&context, law), barrier);
    }
    net
}

/// What the ground does to a barrier at one instant.
#[derive(Clone, Debug, Default)]
pub struct OnGround {
    /// Nodes and the forces on them (N).
    forces: Vec<(u32, Vec3)>,
    /// J
    stored: f64,
    lost: f64,
    /// Where the barrier lies now.
    lies: Vec<Footing>,
}

impl OnGround {
    /// At the present places of the nodes; `law` holds the barrier's own step.
    pub fn of(barrier: &Barrier, law: &LawConstants) -> Self {
        let mut here = Self::default();
        let Some(ground) = &barrier.ground else { return here };
        ground.touch(&barrier.nodes, &barrier.footings, law, |footing, response| {
            here.forces.push((footing.node, Vec3::from(response.force)));
            here.stored += response.stored;
            here.lost += response.lost_friction + response.lost_damping;
            if ground.holds(&footing, &barrier.nodes) {
                here.lies.push(footing);
            }
        });
        here
    }
}

impl NetForces {
    fn pull_segments(&mut self, segments: &[Segment], nodes: &[Node], step: f64) {
        for (number, segment) in segments.iter().enumerate() {
            let [a, b] = segment.nodes.map(|node| node as usize);
            let result = rope::pull(segment, &nodes[a], &nodes[b], step);
            let force = result.direction * result.tension;
            self.forces[a] += force;
            self.forces[b] -= force;
            self.stored += result.stored;
            self.lost_ropes += result.lost;
            self.tensions.push(result.tension);
            self.overloaded.extend(result.fate.map(|fate| (number, fate)));
        }
    }

    fn pull_rings(&mut self, barrier: &Barrier, step: f64) {
        for (number, ring) in barrier.net_rings.iter().enumerate() {
            let result = ring.pull(&barrier.nodes, &mut self.forces, step);
            self.stored += result.stored;
            self.lost_ropes += result.lost;
            self.rings.extend(std::iter::repeat_n(result.as_in_chain, ring.nodes.len()));
            if result.breaks {
                self.torn.push(number);
            }
        }
    }

    fn pull_dissipators(&mut self, barrier: &Barrier) {
        for dissipator in &mut self.slipped {
            let [anchor, end] = dissipator.nodes.map(|node| node as usize);
            let result = dissipator.stretch(&barrier.nodes[anchor], &barrier.nodes[end]);
            let force = result.direction * result.tension;
            self.forces[anchor] += force;
            self.forces[end] -= force;
            self.stored += result.stored;
            self.lost_dissipators += result.lost;
            self.dissipators.push(result.tension);
        }
    }

    fn push_posts(&mut self, barrier: &Barrier, step: f64) {
        for post in &barrier.posts {
            let [foot, head] = post.nodes.map(|node| node as usize);
            let result = post.push(&barrier.nodes, step);
            self.forces[foot] += result.on_foot;
            self.forces[head] += result.on_head;
            self.stored += result.stored;
            self.lost_ropes += result.lost;
            self.posts.push(-result.compression);
        }
    }

    /// Holds the knots of side extensions; what that loses is friction.
    fn hold(&mut self, barrier: &Barrier) {
        for hold in &mut self.let_go {
            let [pin, knot] = hold.nodes.map(|node| node as usize);
            let result = hold.stretch(&barrier.nodes[pin], &barrier.nodes[knot]);
            self.forces[knot] -= result.direction * result.tension;
            self.stored += result.stored;
            self.lost_rings += result.lost;
        }
    }

    /// Takes in what the ground does to the barrier.
    pub fn rest(&mut self, on_ground: OnGround) {
        for (node, force) in &on_ground.forces {
            self.forces[*node as usize] += force;
        }
        self.stored += on_ground.stored;
        self.lost_rings += on_ground.lost;
        self.lies = on_ground.lies;
    }

    fn strain_cylinders(&mut self, barrier: &Barrier, step: f64) {
        let (mut stored, mut power) = (0.0, 0.0);
        strain_all(&barrier.cylinders, &barrier.nodes, &barrier.frames, |number, strain| {
            let cylinder = &barrier.cylinders[number];
            let [a, b] = cylinder.nodes.map(|node| node as usize);
            let mut strain = *strain;
            if cylinder.doubtful(&strain)
                && let Some((after, given, lost)) = cylinder.give_way(&barrier.nodes, &barrier.frames, step)
            {
                self.lost_ropes += lost;
                self.bent.push((number, after));
                strain = given;
            }
            let force = Vec3::from(strain.force);
            self.forces[a] -= force;
            self.forces[b] += force;
            self.torques[a] += Vec3::from(strain.moments[0]);
            self.torques[b] += Vec3::from(strain.moments[1]);
            stored += strain.stored;
            power += strain.power_lost;
            self.axial.push(strain.tension);
        });
        self.stored += stored;
        self.lost_ropes += power * step;
    }

    fn touch_ring(&mut self, ring: &RingSide, result: &RingForce, barrier: &Barrier) {
        let RingForce { touch, response } = result;
        self.stored += response.stored;
        self.lost_rings += response.lost_friction + response.lost_damping;
        self.slid.push((touch.near, response.memory));
        if touch.point.overlap <= 0.0 {
            return;
        }
        let force = Vec3::from(response.force);
        for (body, cylinder, force) in [(0, ring.side, force), (1, touch.near, -force)] {
            let nodes = barrier.cylinders[cylinder as usize].nodes;
            let torque = touch.arms[body].cross(&force);
            self.put(&nodes, touch.shares[body], &force, &torque);
        }
    }

    /// Puts a force and a torque at a point that divides a line as (1−share):share on its nodes.
    fn put(&mut self, nodes: &[u32; 2], share: f64, force: &Vec3, torque: &Vec3) {
        for (node, share) in [(nodes[0] as usize, 1.0 - share), (nodes[1] as usize, share)] {
            self.forces[node] += force * share;
            if let Some(sum) = self.torques.get_mut(node) {
                *sum += torque * share;
            }
        }
    }

    /// Calls `take` for all that pulls or pushes along a line, in the order of [`Barrier::axial_members`], with its tension (N); that of one rope where
    /// several share it.
    pub fn each_axial_member(&self, barrier: &Barrier, mut take: impl FnMut(AxialMember, f64)) {
        let mut all = self.axial_tensions();
        barrier.axial_members().for_each(|member| {
            if let Some(tension) = all.next() {
                take(member, tension / barrier.sharing(member.kind));
            }
        });
    }

    /// Tension of each (N), in the same order; where several ropes share it, that of all.
    pub fn axial_tensions(&self) -> impl Iterator<Item = f64> {
        let all = self.tensions.iter().chain(&self.axial).chain(&self.rings).chain(&self.dissipators);
        all.chain(&self.posts).copied()
    }

    /// Adds the force of a grain on a line.
    pub fn push(&mut self, push: &Push) {
        self.put(&push.nodes, push.share, &push.force, &Vec3::zeros());
        self.from_grains += push.force;
    }

    /// Hands strokes, what rings remember and what became of overloaded ropes to the barrier.
    pub fn take_over(&self, barrier: &mut Barrier) {
        for (number, fate) in &self.overloaded {
            let segment = &mut barrier.segments[*number];
            match fate {
                Overload::Drawn(rest_length) => {
                    segment.strength.drawn_out += rest_length - segment.rest_length;
                    segment.set_rest_length(*rest_length);
                }
                Overload::Broken => {
                    let nodes = segment.nodes;
                    segment.part();
                    barrier.lose_line(nodes);
                }
            }
        }
        for (number, after) in &self.bent {
            let nodes = after.nodes;
            barrier.cylinders[*number] = after.clone();
            if after.strength.broken {
                barrier.lose_line(nodes);
            }
        }
        for &number in &self.torn {
            barrier.lose_ring(number);
        }
        barrier.dissipators.clone_from_slice(&self.slipped);
        barrier.holds.clone_from_slice(&self.let_go);
        barrier.footings.clone_from(&self.lies);
        for (ring, (near, memory)) in barrier.rings.iter_mut().zip(&self.slid) {
            (ring.near, ring.memory) = (*near, *memory);
        }
    }

    /// What was lost: in ropes, by rings, in dissipators (J).
    pub fn losses(&self) -> [f64; 3] {
        [self.lost_ropes, self.lost_rings, self.lost_dissipators]
    }

    /// Forces and tensions, mean over the substeps of a step.
    pub fn mean(parts: &[Self]) -> Self {
        let share = 1.0 / parts.len() as f64;
        let of_each = |of: fn(&Self) -> &Vec<f64>| {
            let mut sums = vec![0.0; parts.first().map_or(0, |part| of(part).len())];
            for part in parts {
                sums.iter_mut().zip(of(part)).for_each(|(sum, value)| *sum += share * value);
            }
            sums
        };
        let mut forces = vec![Vec3::zeros(); parts.first().map_or(0, |part| part.forces.len())];
        for part in parts {
            forces.iter_mut().zip(&part.forces).for_each(|(sum, force)| *sum += force * share);
        }
        Self {
            forces,
            tensions: of_each(|part| &part.tensions),
            dissipators: of_each(|part| &part.dissipators),
            posts: of_each(|part| &part.posts),
            axial: of_each(|part| &part.axial),
            rings: of_each(|part| &part.rings),
            from_grains: parts.iter().map(|part| part.from_grains * share).sum(),
            // Told part by part, or taken over in each.
            torques: Vec::new(),
            stored: 0.0,
            lost_ropes: 0.0,
            lost_rings: 0.0,
            lost_dissipators: 0.0,
            slipped: Vec::new(),
            let_go: Vec::new(),
            slid: Vec::new(),
            lies: Vec::new(),
            overloaded: Vec::new(),
            bent: Vec::new(),
            torn: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::material::Material;
    use crate::elements::segment::SegmentKind;
    use crate::elements::strength::Strength;

    /// Two ropes side by side that are stretched by a millimetre with 1 MN/m each: 2 kN together, 1 kN of each; the lateral rope is one.
    #[test]
    fn of_ropes_side_by_side_the_tension_of_one_is_told() {
        let node =
            |x: f64| Node { position: Vec3::x() * x, velocity: Vec3::zeros(), mass: 1.0, fixed: false, radius: 0.01 };
        let rope = |nodes: [u32; 2], kind: SegmentKind| Segment {
            nodes,
            kind,
            rest_length: 1.0,
            stiffness: 2e6,
            damping: 0.0,
            radius: 0.01,
            strength: Strength::default(),
        };
        let barrier = Barrier {
            nodes: vec![node(0.0), node(1.001), node(2.002)],
            segments: vec![rope([0, 1], SegmentKind::Main(0)), rope([1, 2], SegmentKind::Lateral)],
            bundles: vec![2],
            ..Barrier::default()
        };
        let net = pull_all(&barrier, &LawConstants::of(&Material::new(1.0, 1.0, 0.0), 1e-5));
        let mut told = Vec::new();
        net.each_axial_member(&barrier, |_, tension| told.push(tension));
        assert!((net.forces[0].x - 2e3).abs() < 1e-6 && (told[0] - 1e3).abs() < 1e-6 && (told[1] - 2e3).abs() < 1e-6);
    }
}
