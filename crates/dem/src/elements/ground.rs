//! Where a barrier lies on the channel: its nodes against the bed and the side walls, with friction.
//!
//! A rope between two nodes is straight, so a plane is met by its nodes first: each node is a sphere of its rope's radius against the
//! plane. The contact is the one law of all contacts ([`crate::contact::law`]), with k from the moduli of ground and rope and the
//! rope's radius. A node that starts closer to a plane than its radius lies on it and meets it where it started.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::contact::law::{ContactPoint, LawConstants, Memory, Response, Spring, respond};
use crate::tables::nodes::Node;

/// A plane that nodes lie on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plane {
    /// A point of it (m), and its unit normal towards the barrier.
    pub origin: Vec3,
    pub normal: Vec3,
    /// Height over the bed up to which there is a plane (m).
    pub top: f64,
    /// Friction coefficient between rope and plane, tan φ.
    pub friction: f64,
}

/// Bed and side walls.
pub const PLANES: usize = 3;

/// What a barrier can lie on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ground {
    pub planes: [Plane; PLANES],
    /// Moduli of ground and rope in contact (Pa).
    pub moduli: [f64; 2],
    /// Distance of its centre at which each node meets each plane (m).
    reaches: Vec<[f64; PLANES]>,
}

/// A node that touches a plane, and what the contact remembers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Footing {
    pub node: u32,
    pub plane: u8,
    pub memory: Memory,
}

impl Plane {
    fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(&(point - self.origin))
    }
}

impl Ground {
    /// For a barrier as it stands at first.
    pub fn under(nodes: &[Node], planes: [Plane; PLANES], moduli: [f64; 2]) -> Self {
        // Rings have no thickness to lie on: they hang on what has.
        let thin = |node: &Node| node.radius <= 0.0;
        let reach = |node: &Node| match thin(node) {
            true => [f64::NEG_INFINITY; PLANES],
            false => planes.map(|plane| node.radius.min(plane.height(&node.position))),
        };
        Self { planes, moduli, reaches: nodes.iter().map(reach).collect() }
    }

    /// All contacts of `nodes` now, and those that `before` has and now end, in the order of nodes and planes, each with its force on the
    /// node.
    pub fn touch(
        &self,
        nodes: &[Node],
        before: &[Footing],
        law: &LawConstants,
        mut take: impl FnMut(Footing, &Response),
    ) {
        let mut known = before.iter().peekable();
        for (index, (node, reaches)) in nodes.iter().zip(&self.reaches).enumerate() {
            if node.fixed {
                continue;
            }
            for (number, plane) in self.planes.iter().enumerate() {
                let place = (index as u32, number as u8);
                let memory =
                    known.next_if(|footing| (footing.node, footing.plane) == place).map(|footing| footing.memory);
                let overlap = reaches[number] - plane.height(&node.position);
                let overlap = if node.position.z <= plane.top { overlap } else { 0.0 };
                if overlap <= 0.0 && memory.is_none() {
                    continue;
                }
                let response = respond(&self.contact(node, plane, overlap), &memory.unwrap_or_default(), law);
                take(Footing { node: place.0, plane: place.1, memory: response.memory }, &response);
            }
        }
    }

    /// Spring of a node on any plane.
    pub fn spring(&self, node: &Node) -> Spring {
        Spring::between(self.moduli.map(|modulus| modulus * node.radius), 1.0 / node.mass)
    }

    fn contact(&self, node: &Node, plane: &Plane, overlap: f64) -> ContactPoint {
        ContactPoint {
            normal: (-plane.normal).into(),
            overlap,
            velocity: (-node.velocity).into(),
            twist: 0.0,
            spring: self.spring(node),
            friction: plane.friction,
        }
    }

    /// Whether a footing still touches, rather than having ended in this very step.
    pub fn holds(&self, footing: &Footing, nodes: &[Node]) -> bool {
        let plane = &self.planes[footing.plane as usize];
        let place = &nodes[footing.node as usize].position;
        place.z <= plane.top && plane.height(place) < self.reaches[footing.node as usize][footing.plane as usize]
    }
}
