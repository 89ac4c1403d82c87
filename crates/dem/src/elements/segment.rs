//! A straight piece of wire rope between two nodes, and which part of the barrier it belongs to.

use serde::{Deserialize, Serialize};

use crate::elements::strength::Strength;

/// A straight piece of wire rope: a spring that pulls and never pushes, with a little damping.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segment {
    pub nodes: [u32; 2],
    pub kind: SegmentKind,
    /// Length at which tension starts (m).
    pub rest_length: f64,
    /// Axial stiffness over length, EA/L0 (N/m).
    pub stiffness: f64,
    /// Axial damping (N s/m), active while taut.
    pub damping: f64,
    /// Radius with which grains touch (m).
    pub radius: f64,
    pub strength: Strength,
}

impl Segment {
    /// Changes the rest length; the stiffness EA/L0 follows. The damping stays: it is a share of what the piece it came with had
    /// critical, between those two nodes' masses.
    pub fn set_rest_length(&mut self, rest_length: f64) {
        self.stiffness *= self.rest_length / rest_length;
        self.rest_length = rest_length;
    }

    pub fn member(&self) -> AxialMember {
        AxialMember { nodes: self.nodes, kind: self.kind, rest_length: Some(self.rest_length) }
    }

    pub fn taut(&self) -> SpringLink {
        SpringLink { nodes: self.nodes, stiffness: self.stiffness, damping: self.damping, slack: self.rest_length }
    }

    /// Lets the segment break: it pulls no more.
    pub fn part(&mut self) {
        self.strength.broken = true;
        (self.stiffness, self.damping) = (0.0, 0.0);
    }
}

/// Which part of the barrier an element belongs to; `Main` carries the number of its rope from the bottom, `Retaining` and `Post` that of the
/// post, both from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SegmentKind {
    Net,
    Main(u16),
    Lateral,
    /// A ring, or what ties it to the net. Grains pass it by: it lies behind the net.
    Ring,
    /// A rope that holds the head of a post.
    Retaining(u16),
    Post(u16),
}

/// What pulls on two nodes, as it is recorded and shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxialMember {
    pub nodes: [u32; 2],
    pub kind: SegmentKind,
    /// Unloaded length of a piece of rope or a post (m); nothing for a dissipator, which is no part of its rope.
    pub rest_length: Option<f64>,
}

/// A spring between two nodes, and the length up to which it is slack, as the stable step depends on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringLink {
    pub nodes: [u32; 2],
    /// N/m
    pub stiffness: f64,
    /// N s/m
    pub damping: f64,
    /// m
    pub slack: f64,
}
