//! Everything that connects bodies now, as springs and dashpots: what the stable step depends on.

use crate::Vec3;
use crate::contact::law::{LawConstants, Spring};
use crate::contact::pair_list::Separation;
use crate::contact::ropes::{OnBarrier, OnRopes, RopeContext, touch as touch_rope};
use crate::elements::cylinder::Cylinder;
use crate::elements::ground::Footing;
use crate::elements::ring::{RingContext, RingSide};
use crate::elements::segment::SpringLink;
use crate::neighbours::blocks::Block;
use crate::neighbours::clocks::Clock;
use crate::tables::barrier::Barrier;
use crate::tables::fixed::Fixed;
use crate::tables::grain_rows::GrainRows;
use crate::workers;

/// Velocity and spin of a body, or force and torque on it.
pub type Twist = [Vec3; 2];

/// One body's end of a link.
#[derive(Clone, Copy, Debug, Default)]
pub struct End {
    /// Number of the body: grains first, then the nodes of the barrier.
    pub body: u32,
    /// Share of the link that the body takes, with sign.
    pub share: f64,
    /// From the body's centre to the link (m).
    pub arm: Vec3,
}

/// A spring and dashpot between up to four bodies, or bodies and the ground.
#[derive(Clone, Copy, Debug, Default)]
pub struct Link {
    ends: [End; 4],
    count: usize,
    direction: Vec3,
    /// Stiffness along the direction and across it (N/m).
    along: f64,
    across: f64,
    /// Dashpot along the direction (N s/m).
    damping: f64,
    /// Stiffness against turning of the second end relative to the first, across the direction and about it (N m).
    bending: f64,
    twisting: f64,
    /// Damping over stiffness along the direction, besides the dashpot, and of all else (s).
    damping_time: f64,
    turning_time: f64,
}

impl Link {
    fn between(ends: impl IntoIterator<Item = End>) -> Self {
        let mut link = Self::default();
        for (place, end) in link.ends.iter_mut().zip(ends) {
            *place = end;
            link.count += 1;
        }
        link
    }

    pub fn ends(&self) -> &[End] {
        &self.ends[..self.count]
    }

    /// How fast the ends part (m/s) and turn against each other (rad/s) in the given motion of all bodies.
    pub fn parting(&self, motion: &[Twist]) -> Twist {
        let mut parting = [Vec3::zeros(); 2];
        for end in self.ends() {
            let [velocity, spin] = &motion[end.body as usize];
            parting[0] += (velocity + spin.cross(&end.arm)) * end.share;
            parting[1] += spin * end.share;
        }
        parting
    }

    /// Forces and torques of springs and of dashpots to a displacement or velocity of the ends.
    pub fn pull(&self, [parting, turning]: &Twist) -> [Twist; 2] {
        let along = self.direction * self.direction.dot(parting);
        let about = self.direction * self.direction.dot(turning);
        let force = along * (self.along - self.across) + parting * self.across;
        let torque = about * (self.twisting - self.bending) + turning * self.bending;
        let sideways = parting - along;
        let lossy =
            along * (self.damping + self.along * self.damping_time) + sideways * (self.across * self.turning_time);
        [[force, torque], [lossy, torque * self.turning_time]]
    }

    /// Puts a force and a torque on all ends.
    pub fn push(&self, [force, torque]: &Twist, onto: &mut [Twist]) {
        for end in self.ends() {
            let [linear, turning] = &mut onto[end.body as usize];
            let share = force * end.share;
            *linear += share;
            *turning += end.arm.cross(&share) + torque * end.share;
        }
    }

    /// Sum of the stiffness against turning about all three directions (N m).
    pub fn turning_trace(&self) -> f64 {
        self.twisting + 2.0 * self.bending
    }

    /// Sum of the stiffness in all three directions (N/m).
    pub fn trace(&self) -> f64 {
        self.along + 2.0 * self.across
    }
}

/// A spring and dashpot that many bodies lengthen together, as the contacts of a ring do the way round it.
#[derive(Clone, Debug)]
pub struct Loop {
    /// Bodies, and by how much it grows as each moves.
    ways: Vec<(u32, Vec3)>,
    /// N/m
    stiffness: f64,
    /// N s/m
    damping: f64,
}

impl Loop {
    /// Bodies, and how stiff the loop is against the motion of each alone (N/m).
    pub fn ends(&self) -> impl Iterator<Item = (u32, f64)> {
        self.ways.iter().map(|(body, way)| (*body, self.stiffness * way.norm_squared()))
    }

    /// How fast it grows in the given motion of all bodies (m/s).
    pub fn growth(&self, motion: &[Twist]) -> f64 {
        self.ways.iter().map(|(body, way)| motion[*body as usize][0].dot(way)).sum()
    }

    /// Forces of spring and dashpot to a growth or its rate.
    pub fn pull(&self, growth: f64) -> [f64; 2] {
        [self.stiffness * growth, self.damping * growth]
    }

    /// Puts a force on all bodies.
    pub fn push(&self, force: f64, onto: &mut [Twist]) {
        for (body, way) in &self.ways {
            onto[*body as usize][0] += way * force;
        }
    }
}

/// All that ties bodies together.
#[derive(Clone, Debug, Default)]
pub struct Ties {
    /// In lists that may be worked side by side.
    pub links: Vec<Vec<Link>>,
    pub loops: Vec<Loop>,
}

impl Ties {
    /// Adds what another holds.
    pub fn extend(&mut self, other: Self) {
        self.links.extend(other.links);
        self.loops.extend(other.loops);
    }
}

/// What there is to be linked.
pub struct Linked<'a> {
    pub grains: GrainRows<'a>,
    pub fixed: Fixed<'a>,
    pub barrier: Option<&'a Barrier>,
    pub blocks: &'a [Block],
    pub law: LawConstants,
    pub modulus: f64,
    pub friction: f64,
    /// Whether the grains at the barrier take its steps, so that their contacts with it are of its part.
    pub finer: bool,
}

/// How much stiffer a rope counts that is held.
const HELD_STIFFER: f64 = 2.0;

impl Linked<'_> {
    /// All contacts that grains have in their own step, in a fixed order, with friction springs that stick. Where those with ropes are followed
    /// in finer steps they count as well, as if the ropes were held: neighbours push a grain in all parts alike, and where that and a rope are
    /// both stiff for the whole step, it swings up. In a model of one grain between two such contacts with dashpots of 0.07 and 0.36 of the
    /// critical that begins nowhere below the step that is stable with the rope twice as stiff.
    pub fn contacts(&self) -> Ties {
        let links = workers::map(self.blocks, |_, block| {
            let mut links = Vec::new();
            self.add_pairs(block, &mut links);
            self.add_surfaces(block, &mut links);
            self.add_ropes(block, &mut links, !self.finer);
            links
        });
        Ties { links, loops: Vec::new() }
    }

    /// What holds the barrier together: ropes as far as they are taut, and rings as if they touched their ropes; with the contacts of grains
    /// where these are followed as finely.
    pub fn within_barrier(&self) -> Ties {
        let Some(barrier) = self.barrier else { return Ties::default() };
        let mut ties = Ties {
            links: vec![self.elements(barrier), self.cylinders(barrier), self.rings(barrier), self.footings(barrier)],
            loops: Vec::new(),
        };
        self.add_net_rings(barrier, &mut ties);
        if self.finer {
            ties.links.extend(workers::map(self.blocks, |_, block| {
                let mut links = Vec::new();
                self.add_ropes(block, &mut links, true);
                links
            }));
        }
        ties
    }

    /// The tension of each ring of the net as one loop, and its sides, which the tension makes stiffer across.
    fn add_net_rings(&self, barrier: &Barrier, ties: &mut Ties) {
        let mut sides = Vec::new();
        for ring in &barrier.net_rings {
            let Some(taut) = ring.taut(&barrier.nodes) else { continue };
            let ways = ring
                .nodes
                .iter()
                .zip(taut.ways)
                .filter_map(|(node, way)| self.node_end(barrier, *node, 1.0).map(|end| (end.body, way)));
            ties.loops.push(Loop { ways: ways.collect(), stiffness: ring.stiffness, damping: ring.damping });
            for [a, b] in ring.sides() {
                let line = barrier.nodes[b as usize].position - barrier.nodes[a as usize].position;
                let ends = [(a, -1.0), (b, 1.0)];
                let ends = ends.into_iter().filter_map(|(node, share)| self.node_end(barrier, node, share));
                let length = line.norm();
                if length != 0.0 {
                    let across = taut.tension / length;
                    sides.push(Link { direction: line / length, across, ..Link::between(ends) });
                }
            }
        }
        if !sides.is_empty() {
            ties.links.push(sides);
        }
    }

    fn footings(&self, barrier: &Barrier) -> Vec<Link> {
        let Some(ground) = &barrier.ground else { return Vec::new() };
        let link = |footing: &Footing| {
            let link = Link::between(self.node_end(barrier, footing.node, 1.0));
            let spring = ground.spring(&barrier.nodes[footing.node as usize]);
            self.contact(link, ground.normal(footing, &barrier.nodes), &spring)
        };
        barrier.footings.iter().map(link).collect()
    }

    fn rings(&self, barrier: &Barrier) -> Vec<Link> {
        let context = RingContext {
            nodes: &barrier.nodes,
            frames: &barrier.frames,
            cylinders: &barrier.cylinders,
            moduli: barrier.ring_moduli,
        };
        let link = |ring: &RingSide| {
            let touch = ring.touch(&context);
            let bodies = [(ring.side, -1.0), (touch.near, 1.0)].into_iter().enumerate();
            let ends = bodies.flat_map(|(body, (cylinder, sign))| {
                let nodes = barrier.cylinders[cylinder as usize].nodes;
                let (share, arm) = (touch.shares[body], touch.arms[body]);
                [(nodes[0], 1.0 - share), (nodes[1], share)].map(|(node, share)| {
                    let end = self.node_end(barrier, node, share * sign);
                    end.map(|end| End { arm, ..end })
                })
            });
            let link = Link::between(ends.flatten());
            self.contact(link, Vec3::from(touch.point.normal), &touch.point.spring)
        };
        let whole = |cylinder: u32| !barrier.cylinders[cylinder as usize].strength.broken;
        barrier.rings.iter().filter(|ring| whole(ring.side) && whole(ring.near)).map(link).collect()
    }

    fn add_pairs(&self, block: &Block, links: &mut Vec<Link>) {
        for &[first, second] in block.inner.touching.iter().chain(&block.border.touching) {
            let (a, b) = (self.grains.member(first as usize), self.grains.member(second as usize));
            let line = b.centre - a.centre;
            let distance = line.norm();
            if distance >= a.radius + b.radius {
                continue;
            }
            let normal = line / distance;
            let foot = a.centre + normal * (0.5 * (distance + a.radius - b.radius));
            let link = Link::between([self.grain_end(first, &foot, -1.0), self.grain_end(second, &foot, 1.0)]);
            let sides = [self.modulus * a.radius, self.modulus * b.radius];
            let spring = Spring::between(sides, a.inverse_mass + b.inverse_mass);
            links.push(self.contact(link, normal, &spring));
        }
    }

    fn add_surfaces(&self, block: &Block, links: &mut Vec<Link>) {
        for &[index, surface] in &block.surfaces.touching {
            let member = self.grains.member(index as usize);
            let touch = self.fixed.touch(surface, &member.centre, member.radius);
            let (towards, foot) = (touch.towards, member.centre + touch.towards);
            let distance = towards.norm();
            if distance < member.radius && distance > 0.0 {
                let link = Link::between([self.grain_end(index, &foot, 1.0)]);
                let spring = Spring::on_fixed(self.modulus * member.radius, member.inverse_mass).part(touch.share);
                links.push(self.contact(link, towards / distance, &spring));
            }
        }
    }

    /// Adds the contacts with ropes; those that are not `free` to give way are held.
    fn add_ropes(&self, block: &Block, links: &mut Vec<Link>, free: bool) {
        let Some(barrier) = self.barrier else { return };
        let context = RopeContext {
            grains: self.grains,
            barrier,
            constants: OnBarrier { law: self.law, grain_modulus: self.modulus, grain_friction: self.friction },
            clock: Clock::default(),
        };
        let on_ropes = OnRopes { grains: self.grains, barrier };
        for &[index, line] in &block.ropes.list.touching {
            if on_ropes.gap([index, line]) >= 0.0 {
                continue;
            }
            let Some(contact) = touch_rope(&self.grains.member(index as usize), line, &context) else {
                continue;
            };
            let nodes = barrier.lines[line as usize].nodes;
            let on_nodes = [(nodes[0], 1.0 - contact.share), (nodes[1], contact.share)];
            let on_nodes = on_nodes.into_iter().filter(|_| free);
            let on_nodes = on_nodes.filter_map(|(node, share)| self.node_end(barrier, node, share));
            let link = Link::between([self.grain_end(index, &contact.foot, -1.0)].into_iter().chain(on_nodes));
            let normal = Vec3::from(contact.point.normal);
            let spring = &contact.point.spring;
            links.push(self.contact(link, normal, &if free { *spring } else { spring.part(HELD_STIFFER) }));
        }
    }

    fn elements(&self, barrier: &Barrier) -> Vec<Link> {
        let taut = barrier.springs().filter_map(|SpringLink { nodes, stiffness, damping, slack }| {
            let [a, b] = nodes.map(|node| &barrier.nodes[node as usize]);
            let line = b.position - a.position;
            let length = line.norm();
            let across = stiffness * (length - slack) / length;
            let ends = [(nodes[0], -1.0), (nodes[1], 1.0)];
            let ends = ends.into_iter().filter_map(|(node, share)| self.node_end(barrier, node, share));
            let link = Link { direction: line / length, along: stiffness, across, damping, ..Link::between(ends) };
            // Asked so that a NaN is seen.
            let slack = length < slack || length == 0.0;
            (!slack).then_some(link)
        });
        taut.collect()
    }

    /// Each cylinder as a spring at its middle with the shear stiffness 12 EI/L³ across, and springs against turning.
    fn cylinders(&self, barrier: &Barrier) -> Vec<Link> {
        let nodes = self.grains.len() as u32;
        let link = |cylinder: &Cylinder| {
            let [a, b] = cylinder.nodes.map(|node| barrier.nodes[node as usize].position);
            let line = b - a;
            let (length, section) = (cylinder.rest_length, &cylinder.section);
            // A node that is fixed may still turn.
            let end =
                |side: usize, share: f64| End { body: nodes + cylinder.nodes[side], share, arm: line * (0.5 * -share) };
            let shear = 12.0 * section.bending / length.powi(3);
            // A taut rope is stiffer across.
            let taut = section.axial / length * (line.norm() - length).max(0.0) / length;
            Link {
                direction: line.normalize(),
                along: section.axial / length,
                across: shear + taut,
                bending: section.bending / length,
                twisting: section.twisting / length,
                damping_time: cylinder.damping_time,
                turning_time: cylinder.turning_time,
                ..Link::between([end(0, -1.0), end(1, 1.0)])
            }
        };
        barrier.cylinders.iter().map(link).collect()
    }

    /// A contact with its normal spring and dashpot, and its friction spring.
    fn contact(&self, link: Link, normal: Vec3, spring: &Spring) -> Link {
        let (along, damping) = (spring.stiffness, self.law.damping(spring));
        Link {
            direction: normal,
            along,
            across: self.law.friction_spring(spring).stiffness_ratio() * along,
            damping,
            ..link
        }
    }

    fn grain_end(&self, member: u32, foot: &Vec3, share: f64) -> End {
        let row = member as usize / self.grains.shape.members();
        End { body: row as u32, share, arm: foot - self.grains.place(row).vector() }
    }

    /// Nothing for a node that never moves.
    fn node_end(&self, barrier: &Barrier, node: u32, share: f64) -> Option<End> {
        let body = self.grains.len() as u32 + node;
        (!barrier.nodes[node as usize].fixed).then(|| End { body, share, arm: Vec3::zeros() })
    }
}
