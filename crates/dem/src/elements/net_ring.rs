//! A ring of a ring net: a closed bundle of wires that slides through its contacts with the rings beside it.
//!
//! The ring runs straight from contact to contact. Two springs stand for its two stages, after Volkwein 2004 and the ring element of Kratos:
//!
//! - **bending**: each pair of opposite contacts, further apart than the diameter D, is pulled together with f = b (d − D);
//! - **tension**: the ring slides freely, so that one tension acts all round: T = max(0, k (P − P₁) + c Ṗ) once the way round all contacts,
//!   P, is longer than P₁.
//!
//! Both come from a potential, ½ b Σ (d − D)₊² + ½ k (P − P₁)₊², so that a ring gives back what was put in, but for the dashpot c. Real rings
//! bend for good: what they take away by that is left out.
//!
//! The wires of one leg carry N = T + ½ max f, without what the dashpot adds. They break earlier the more sharply the ring is turned round a contact: N is told as that of
//! a chain of rings that breaks as soon, N' = N R₁₈₀ / R(θ), with R between R₉₀ at a turn of 90° or less and R₁₈₀ at 180°, in proportion
//! to −cos θ of the sharpest turn.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::segment::{AxialMember, SegmentKind, SpringLink};
use crate::tables::nodes::Node;

/// Most contacts of a ring, with those along an edge to which it was cut.
pub const MOST_CONTACTS: usize = 12;

/// A ring and its contacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NetRing {
    /// Contacts in their order round the ring: two or more, and an even number where it bends.
    pub nodes: Vec<u32>,
    /// Way round all contacts from which the ring is taut, P₁ (m).
    pub taut_from: f64,
    /// Stiffness of the taut ring against a longer way, k (N/m).
    pub stiffness: f64,
    /// Dashpot of the taut ring, c (N s/m).
    pub damping: f64,
    /// Stiffness of bending between two opposite contacts, b (N/m); nothing for a ring that is cut.
    pub bending: f64,
    /// D (m)
    pub diameter: f64,
    /// Radius of the bundle, with which grains touch it (m).
    pub radius: f64,
    /// Sides that grains touch: all but those along a rope.
    pub touched: Vec<[u32; 2]>,
    pub strength: RingStrength,
}

/// What the wires of one leg of a ring withstand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RingStrength {
    /// In a chain of rings, where each contact turns the ring by 180° (N), and in a net, where it turns it by 90°.
    pub in_chain: f64,
    pub in_net: f64,
    /// Whether it breaks there, or holds on.
    pub breaks: bool,
    pub broken: bool,
}

impl RingStrength {
    /// The force of a leg in a chain (N) that is as near to breaking as `force` is with this cosine of the sharpest turn.
    fn as_in_chain(&self, force: f64, cosine: f64) -> f64 {
        let sharpness = (-cosine).clamp(0.0, 1.0);
        force * self.in_chain / (self.in_net + (self.in_chain - self.in_net) * sharpness)
    }
}

/// What a ring does at the present places of its contacts.
#[derive(Clone, Debug, Default)]
pub struct RingPull {
    /// Tension all round (N).
    pub tension: f64,
    /// Force of a leg as that of a chain that is as near to breaking (N).
    pub as_in_chain: f64,
    /// Elastic energy (J).
    pub stored: f64,
    /// Dissipated in the step just made (J).
    pub lost: f64,
    /// Whether it has just broken.
    pub breaks: bool,
}

/// A ring that is taut, as it is now.
#[derive(Clone, Debug)]
pub struct TautRing {
    /// By how much the way round the ring grows as each contact moves, in the order of the contacts.
    pub ways: Vec<Vec3>,
    /// N
    pub tension: f64,
}

impl NetRing {
    /// Neighbouring contacts, the last with the first at the end.
    pub fn sides(&self) -> impl Iterator<Item = [u32; 2]> {
        let next = self.nodes[1..].iter().chain(&self.nodes[..1]);
        self.nodes.iter().zip(next).map(|(&from, &to)| [from, to])
    }

    /// Pairs of opposite contacts.
    fn diagonals(&self) -> impl Iterator<Item = [u32; 2]> {
        let bends = self.bending > 0.0 && !self.strength.broken;
        let count = if bends { self.nodes.len() / 2 } else { 0 };
        (0..count).map(move |contact| [self.nodes[contact], self.nodes[contact + count]])
    }

    pub fn axial_members(&self) -> impl Iterator<Item = AxialMember> {
        self.sides().map(|nodes| AxialMember { nodes, kind: SegmentKind::Net, rest_length: None })
    }

    /// Way round all contacts (m).
    fn way(&self, nodes: &[Node]) -> f64 {
        let length = |[a, b]: [u32; 2]| (nodes[b as usize].position - nodes[a as usize].position).norm();
        self.sides().map(length).sum()
    }

    /// Springs of bending, between opposite contacts.
    pub fn springs(&self) -> impl Iterator<Item = SpringLink> + '_ {
        self.diagonals().map(|nodes| SpringLink { nodes, stiffness: self.bending, damping: 0.0, slack: self.diameter })
    }

    /// The one spring of a taut ring, by which the way round it grows; nothing where it is slack.
    pub fn taut(&self, nodes: &[Node]) -> Option<TautRing> {
        let over = self.way(nodes) - self.taut_from;
        if over < 0.0 || self.strength.broken {
            return None;
        }
        // Two contacts at one place pull each other nowhere.
        let line = |[a, b]: [u32; 2]| nodes[b as usize].position - nodes[a as usize].position;
        let direction = |side| line(side).try_normalize(0.0).unwrap_or_default();
        let after: Vec<Vec3> = self.sides().map(direction).collect();
        let before = after[after.len() - 1..].iter().chain(&after[..after.len() - 1]);
        let ways = before.zip(&after).map(|(before, after)| before - after).collect();
        Some(TautRing { ways, tension: self.stiffness * over })
    }

    /// Puts its forces on the contacts, after a step of length `step` (s).
    pub fn pull(&self, nodes: &[Node], forces: &mut [Vec3], step: f64) -> RingPull {
        match self.nodes.len() {
            _ if self.strength.broken => RingPull::default(),
            4 => self.pull_on::<4>(nodes, forces, step),
            6 => self.pull_on::<6>(nodes, forces, step),
            _ => self.pull_on::<MOST_CONTACTS>(nodes, forces, step),
        }
    }

    /// The same for no more than `N` contacts.
    fn pull_on<const N: usize>(&self, nodes: &[Node], forces: &mut [Vec3], step: f64) -> RingPull {
        let count = self.nodes.len();
        let mut directions = [Vec3::zeros(); N];
        let (mut way, mut rate) = (0.0, 0.0);
        for ([from, to], kept) in self.sides().zip(&mut directions) {
            let [from, to] = [from, to].map(|node| &nodes[node as usize]);
            let line = to.position - from.position;
            let length = line.norm();
            // Two contacts at one place pull each other nowhere.
            let direction = if length > 0.0 { line / length } else { Vec3::zeros() };
            way += length;
            rate += (to.velocity - from.velocity).dot(&direction);
            *kept = direction;
        }
        let mut bending = [Vec3::zeros(); N];
        let bent = self.bend(nodes, &mut bending);
        let over = (way - self.taut_from).max(0.0);
        let spring = self.stiffness * over;
        let stored = 0.5 * spring * over + bent.stored;
        let before = |contact: usize| if contact == 0 { count - 1 } else { contact - 1 };
        let force = spring + 0.5 * bent.largest;
        let as_in_chain = if force > 0.0 {
            let cosine = |contact: usize| directions[before(contact)].dot(&directions[contact]);
            self.strength.as_in_chain(force, (0..count).map(cosine).fold(1.0, f64::min))
        } else {
            force
        };
        if self.strength.breaks && as_in_chain > self.strength.in_chain {
            // Had it held, the step would have put half of its forces times its displacements into it; it stores nothing more.
            let work = 0.5 * (spring * rate + bent.power) * step;
            return RingPull { lost: stored - work, breaks: true, ..RingPull::default() };
        }
        let tension = if over > 0.0 { (spring + self.damping * rate).max(0.0) } else { spring };
        for (contact, &node) in self.nodes.iter().enumerate() {
            forces[node as usize] += (directions[contact] - directions[before(contact)]) * tension + bending[contact];
        }
        RingPull { tension, as_in_chain, stored, lost: (tension - spring) * rate * step, breaks: false }
    }

    /// Forces of bending on the contacts.
    fn bend(&self, nodes: &[Node], forces: &mut [Vec3]) -> Bending {
        let mut sums = Bending::default();
        if self.bending <= 0.0 {
            return sums;
        }
        let half = self.nodes.len() / 2;
        for contact in 0..half {
            let [a, b] = [contact, contact + half].map(|contact| &nodes[self.nodes[contact] as usize]);
            let line = b.position - a.position;
            let square = line.norm_squared();
            if square <= self.diameter * self.diameter {
                continue;
            }
            let length = square.sqrt();
            let force = self.bending * (length - self.diameter);
            let pull = line * (force / length);
            forces[contact] += pull;
            forces[contact + half] -= pull;
            sums.largest = sums.largest.max(force);
            sums.stored += 0.5 * force * (length - self.diameter);
            sums.power += (b.velocity - a.velocity).dot(&pull);
        }
        sums
    }
}

/// Sums over the diagonals of a ring.
#[derive(Default)]
struct Bending {
    /// N
    largest: f64,
    /// J
    stored: f64,
    /// W
    power: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn node(x: f64, y: f64) -> Node {
        Node { position: Vec3::new(x, y, 0.0), velocity: Vec3::zeros(), mass: 1.0, fixed: false, radius: 0.0 }
    }

    fn ring(contacts: u32) -> NetRing {
        NetRing {
            nodes: (0..contacts).collect(),
            taut_from: 0.9,
            stiffness: 1000.0,
            damping: 0.0,
            bending: 10.0,
            diameter: 0.3,
            radius: 0.006,
            touched: Vec::new(),
            strength: RingStrength { in_chain: 38.0, in_net: 55.0, breaks: false, broken: false },
        }
    }

    /// By hand: contacts 0.5 m apart in a chain, a way of 1 m: tension 1000 × 0.1 = 100 N in each leg, bending 10 × 0.2 = 2 N.
    #[test]
    fn a_chain_pulls_with_both_legs_and_its_bending() {
        let nodes = [node(0.0, 0.0), node(0.5, 0.0)];
        let mut forces = [Vec3::zeros(); 2];
        let pull = ring(2).pull(&nodes, &mut forces, 1e-3);
        assert_relative_eq!(forces[0].x, 202.0, max_relative = 1e-12);
        assert_relative_eq!(forces[1].x, -202.0, max_relative = 1e-12);
        assert_relative_eq!(pull.as_in_chain, 101.0, max_relative = 1e-12);
        assert_relative_eq!(pull.stored, 0.5 * 1000.0 * 0.01 + 0.5 * 10.0 * 0.04, max_relative = 1e-12);
    }

    /// By hand: a square of diagonals 0.4 m has a way of 4 × 0.2828 = 1.1314 m, and pulls each contact inwards with √2 T and the bending of 1 N.
    #[test]
    fn a_ring_in_a_net_breaks_later_than_one_in_a_chain() {
        let nodes = [node(0.2, 0.0), node(0.0, 0.2), node(-0.2, 0.0), node(0.0, -0.2)];
        let mut forces = [Vec3::zeros(); 4];
        let pull = ring(4).pull(&nodes, &mut forces, 1e-3);
        let tension = 1000.0 * (0.8 * 2.0_f64.sqrt() - 0.9);
        assert_relative_eq!(forces[0].x, -(2.0_f64.sqrt() * tension + 1.0), max_relative = 1e-12);
        assert_relative_eq!(pull.as_in_chain, (tension + 0.5) * 38.0 / 55.0, max_relative = 1e-12);
        assert_eq!(forces.iter().sum::<Vec3>().norm(), 0.0);
    }

    /// The force is the slope of the energy, at places without any symmetry.
    #[test]
    fn forces_are_slopes_of_the_energy() {
        let mut nodes = [node(0.24, 0.02), node(0.03, 0.21), node(-0.2, -0.01), node(0.02, -0.22)];
        let ring = ring(4);
        let mut forces = [Vec3::zeros(); 4];
        ring.pull(&nodes, &mut forces, 1e-3);
        for (contact, force) in forces.iter().enumerate() {
            for (axis, force) in force.iter().enumerate() {
                let mut energy = |by: f64| {
                    nodes[contact].position[axis] += by;
                    let stored = ring.pull(&nodes, &mut [Vec3::zeros(); 4], 1e-3).stored;
                    nodes[contact].position[axis] -= by;
                    stored
                };
                let slope = (energy(1e-6) - energy(-1e-6)) / 2e-6;
                assert_relative_eq!(*force, -slope, epsilon = 1e-5);
            }
        }
    }

    /// A slack ring does nothing, a broken one neither, and one that breaks has lost what it had stored.
    #[test]
    fn a_ring_breaks_once() {
        let mut ring = ring(2);
        ring.strength.breaks = true;
        let mut forces = [Vec3::zeros(); 2];
        assert_eq!(ring.pull(&[node(0.0, 0.0), node(0.2, 0.0)], &mut forces, 1e-3).stored, 0.0);
        let wide = [node(0.0, 0.0), node(0.5, 0.0)];
        let pull = ring.pull(&wide, &mut forces, 1e-3);
        assert!(pull.breaks && pull.lost > 0.0 && pull.stored == 0.0);
        ring.strength.broken = true;
        assert!(!ring.pull(&wide, &mut forces, 1e-3).breaks);
        assert_eq!(forces, [Vec3::zeros(); 2]);
    }

    /// The way round a square of diagonals 0.4 m grows by √2 as one contact moves out by 1, and by nothing as it moves along the next two.
    #[test]
    fn a_taut_ring_is_one_spring() {
        let nodes = [node(0.2, 0.0), node(0.0, 0.2), node(-0.2, 0.0), node(0.0, -0.2)];
        let ring = ring(4);
        let taut = ring.taut(&nodes).expect("a taut ring");
        assert_relative_eq!(taut.tension, 1000.0 * (0.8 * 2.0_f64.sqrt() - 0.9), max_relative = 1e-12);
        for (way, node) in taut.ways.iter().zip(&nodes) {
            assert_relative_eq!((way - node.position / 0.2 * 2.0_f64.sqrt()).norm(), 0.0, epsilon = 1e-12);
        }
        assert_eq!(ring.springs().count(), 2);
        assert!(ring.taut(&nodes.map(|one| node(0.5 * one.position.x, 0.5 * one.position.y))).is_none());
    }
}
