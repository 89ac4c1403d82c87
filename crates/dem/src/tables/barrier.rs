//! Flexible barrier: point masses (nodes) joined by tension-only segments, dissipators, or cylinders that bend.

use serde::{Deserialize, Serialize};

use nalgebra::UnitQuaternion;

use crate::Vec3;
use crate::elements::cylinder::Cylinder;
use crate::elements::dissipator::Dissipator;
use crate::elements::ground::{Footing, Ground};
use crate::elements::ring::RingSide;
use crate::elements::sliding::Chain;
use crate::elements::strength::Strength;

/// A point mass of the net or of a rope.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Node {
    pub position: Vec3,
    /// At half steps, like the grains'; where the barrier takes several steps in one of the grains', at those.
    pub velocity: Vec3,
    /// Mean velocity over the last step of the grains, which is what they feel.
    pub pace: Vec3,
    /// kg
    pub mass: f64,
    /// A fixed node never moves: an anchor, or a rope bolted to the bed.
    pub fixed: bool,
    /// Radius with which grains touch the node (m): the thickest line that ends there; made by [`Barrier::connect`].
    pub radius: f64,
    /// Lines that end here; grains that touch the very node are found through it.
    pub lines: Vec<u32>,
}

/// How a node is turned, where cylinders meet in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    pub orientation: UnitQuaternion<f64>,
    /// Angular velocity (rad/s), at half steps.
    pub spin: Vec3,
    /// Moment of inertia, the same about all axes (kg m²).
    pub inertia: f64,
    /// A clamped node never turns.
    pub held: bool,
}

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

    /// Lets the segment break: it pulls no more.
    pub fn part(&mut self) {
        self.strength.broken = true;
        (self.stiffness, self.damping) = (0.0, 0.0);
    }
}

/// Which part of the barrier a segment or cylinder belongs to; `Main` carries the number of its rope from the bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SegmentKind {
    Net,
    Main(u16),
    Lateral,
    /// A ring, or what ties it to the net. Grains pass it by: it lies behind the net.
    Ring,
}

/// A segment or cylinder as grains touch it: a line between two nodes, with a thickness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    pub nodes: [u32; 2],
    /// m
    pub radius: f64,
    /// What has broken is touched no more.
    pub broken: bool,
}

/// An anchor point with the main rope it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Anchor {
    pub node: u32,
    pub rope: u16,
}

/// The flexible barrier as the engine sees it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Barrier {
    pub nodes: Vec<Node>,
    pub segments: Vec<Segment>,
    pub dissipators: Vec<Dissipator>,
    /// What holds knots of side extensions to where they lay: it yields like a dissipator, without end, and is not touched.
    pub holds: Vec<Dissipator>,
    /// Cylinders, and how each node is turned (one frame for each node, or none where there are no cylinders).
    pub cylinders: Vec<Cylinder>,
    pub frames: Vec<Frame>,
    pub anchors: Vec<Anchor>,
    /// What grains can touch; made by [`Self::connect`].
    pub lines: Vec<Line>,
    /// Ropes that slide through their rings; empty where rings are pinned.
    pub chains: Vec<Chain>,
    /// Sides of rings round ropes of cylinders, and the moduli of ring and rope in contact (Pa).
    pub rings: Vec<RingSide>,
    pub ring_moduli: [f64; 2],
    /// Friction coefficient between grain and rope, tan φ.
    pub friction: f64,
    /// Young's modulus of the rope in contact with a grain (Pa).
    pub contact_modulus: f64,
    /// What the barrier can lie on, if anything, and where it does.
    pub ground: Option<Ground>,
    pub footings: Vec<Footing>,
}

impl Barrier {
    /// Radius with which grains may touch a line or either of its nodes (m).
    pub fn thickness(&self, line: u32) -> f64 {
        let line = &self.lines[line as usize];
        let ends = line.nodes.map(|node| self.nodes[node as usize].radius);
        line.radius.max(ends[0]).max(ends[1])
    }

    /// Lets the piece of rope between two nodes be touched no more.
    pub fn lose_line(&mut self, nodes: [u32; 2]) {
        let Some(index) = self.lines.iter().position(|line| line.nodes == nodes) else { return };
        self.lines[index].broken = true;
        for node in nodes {
            self.nodes[node as usize].lines.retain(|&line| line as usize != index);
        }
    }

    /// What every piece of rope withstands and has suffered.
    pub fn strengths(&self) -> impl Iterator<Item = &Strength> {
        let cylinders = self.cylinders.iter().map(|cylinder| &cylinder.strength);
        self.segments.iter().map(|segment| &segment.strength).chain(cylinders)
    }

    /// Lists the lines that grains can touch, and at every node those that end there. Call once all elements stand.
    pub fn connect(&mut self) {
        let segments = self.segments.iter().map(|segment| (segment.kind, segment.nodes, segment.radius));
        let cylinders = self.cylinders.iter().map(|cylinder| (cylinder.kind, cylinder.nodes, cylinder.section.radius));
        let touchable = segments.chain(cylinders).filter(|(kind, ..)| *kind != SegmentKind::Ring);
        self.lines = touchable.map(|(_, nodes, radius)| Line { nodes, radius, broken: false }).collect();
        self.lines.extend(self.dissipators.iter().map(|dissipator| Line {
            nodes: dissipator.nodes,
            radius: dissipator.radius,
            broken: false,
        }));
        for node in &mut self.nodes {
            node.lines.clear();
            node.radius = 0.0;
        }
        for (index, line) in self.lines.iter().enumerate() {
            for node in line.nodes {
                let node = &mut self.nodes[node as usize];
                node.lines.push(index as u32);
                node.radius = node.radius.max(line.radius);
            }
        }
    }
}
