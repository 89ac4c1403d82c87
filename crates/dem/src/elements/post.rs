//! A post of a barrier: a strut on a hinged foot, whose head carries ropes.
//!
//! It pushes back when it is shortened and pulls when it is stretched: N = k (L0 − L) − c L̇, compression positive, with k = EA/L0. Its foot
//! turns freely and does not move. It stays straight: bending and buckling are checked, not simulated.
//!
//! A slender post of mass m that turns about its foot has the moment of inertia m L²/3 and is turned by its weight like a mass of m/2 at
//! its head. So m/3 is put on the node of its head, and the weight of another m/6 pulls there without inertia.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::segment::{AxialMember, SegmentKind, SpringLink};
use crate::tables::nodes::Node;

/// Share of a post's mass that is put on its head, and share whose weight pulls there besides.
pub const MASS_AT_HEAD: f64 = 1.0 / 3.0;
pub const WEIGHT_AT_HEAD: f64 = 1.0 / 6.0;

/// A post between its foot (first node) and its head (second node).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Post {
    pub nodes: [u32; 2],
    /// From one bank to the other, from 0.
    pub number: u16,
    /// m
    pub rest_length: f64,
    /// k (N/m)
    pub stiffness: f64,
    /// c (N s/m)
    pub damping: f64,
    /// Radius with which grains touch it (m).
    pub radius: f64,
    /// Weight that pulls at the head besides that of its node (N).
    pub weight: Vec3,
}

/// What a post does at the present places of its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Push {
    /// Axial force, compression positive (N).
    pub compression: f64,
    /// Force on the head (N); the foot takes the opposite of what the post pushes with.
    pub on_head: Vec3,
    pub on_foot: Vec3,
    /// Elastic energy and the height of the weight that has no mass (J).
    pub stored: f64,
    /// Dissipated in the step just made (J).
    pub lost: f64,
}

impl Post {
    pub fn member(&self) -> AxialMember {
        AxialMember { nodes: self.nodes, kind: SegmentKind::Post(self.number), rest_length: Some(self.rest_length) }
    }

    /// As a spring that never goes slack.
    pub fn taut(&self, nodes: &[Node]) -> SpringLink {
        let [foot, head] = self.nodes.map(|node| nodes[node as usize].position);
        SpringLink { nodes: self.nodes, stiffness: self.stiffness, damping: self.damping, slack: (head - foot).norm() }
    }

    /// What the post does after a step of length `step` (s).
    pub fn push(&self, nodes: &[Node], step: f64) -> Push {
        let [foot, head] = self.nodes.map(|node| &nodes[node as usize]);
        let line = head.position - foot.position;
        let length = line.norm();
        let direction = line / length;
        let shortened = self.rest_length - length;
        let rate = (head.velocity - foot.velocity).dot(&direction);
        let spring = self.stiffness * shortened;
        let compression = spring - self.damping * rate;
        let thrust = direction * compression;
        Push {
            compression,
            on_head: thrust + self.weight,
            on_foot: -thrust,
            stored: 0.5 * spring * shortened - self.weight.dot(&line),
            lost: self.damping * rate * rate * step,
        }
    }
}
