//! Flexible barrier: point masses (nodes) joined by tension-only segments, dissipators, or cylinders that bend.

use serde::{Deserialize, Serialize};

use crate::elements::cylinder::Cylinder;
use crate::elements::dissipator::Dissipator;
use crate::elements::ground::{Footing, Ground};
use crate::elements::net_ring::NetRing;
use crate::elements::post::Post;
use crate::elements::ring::RingSide;
use crate::elements::segment::{AxialMember, SpringLink};
use crate::elements::segment::{Segment, SegmentKind};
use crate::elements::sliding::Chain;
use crate::elements::strength::Strength;
use crate::tables::nodes::{Frame, Node};

/// A segment or cylinder as grains touch it: a line between two nodes, with a thickness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    pub nodes: [u32; 2],
    /// m
    pub radius: f64,
    /// Radius with which grains may touch it or either of its nodes (m).
    pub thickness: f64,
    /// What has broken is touched no more.
    pub broken: bool,
}

/// The end of a line at a node.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LineEnd {
    pub line: u32,
    /// The node at its other end.
    pub far: u32,
    /// Of the line (m).
    pub radius: f64,
}

/// For each node the lines that end there; grains that touch the very node are found through it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LineEnds {
    /// Where the ends at each node begin, and after the last where they all end.
    starts: Vec<u32>,
    ends: Vec<LineEnd>,
}

impl LineEnds {
    /// Those of lines that are not broken, in their order.
    fn of(lines: &[Line], nodes: usize) -> Self {
        let mut at_nodes = vec![Vec::new(); nodes];
        for (index, line) in lines.iter().enumerate().filter(|(_, line)| !line.broken) {
            let [a, b] = line.nodes;
            for [here, far] in [[a, b], [b, a]] {
                at_nodes[here as usize].push(LineEnd { line: index as u32, far, radius: line.radius });
            }
        }
        let mut table = Self { starts: vec![0], ends: Vec::new() };
        for ends in at_nodes {
            table.ends.extend(ends);
            table.starts.push(table.ends.len() as u32);
        }
        table
    }

    pub fn at(&self, node: u32) -> &[LineEnd] {
        let node = node as usize;
        &self.ends[self.starts[node] as usize..self.starts[node + 1] as usize]
    }
}

/// An anchor point with the rope it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Anchor {
    pub node: u32,
    pub kind: SegmentKind,
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
    /// Equal ropes that run side by side at each level of main ropes: its segments, cylinders and dissipators stand for all of them. What is
    /// not listed is one rope.
    pub bundles: Vec<u16>,
    /// What grains can touch, and where it ends; made by [`Self::connect`].
    pub lines: Vec<Line>,
    pub line_ends: LineEnds,
    /// Ropes that slide through their rings; empty where rings are pinned.
    pub chains: Vec<Chain>,
    /// Rings of a ring net.
    pub net_rings: Vec<NetRing>,
    /// Posts, from one bank to the other.
    pub posts: Vec<Post>,
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
    /// All that pulls or pushes along a line, in the order of [`NetForces::each_axial_member`](crate::net::NetForces::each_axial_member). A new element is listed here.
    pub fn axial_members(&self) -> impl Iterator<Item = AxialMember> {
        let segments = self.segments.iter().map(Segment::member);
        segments
            .chain(self.cylinders.iter().map(Cylinder::member))
            .chain(self.net_rings.iter().flat_map(NetRing::axial_members))
            .chain(self.dissipators.iter().map(Dissipator::member))
            .chain(self.posts.iter().map(Post::member))
    }

    /// Unloaded length of one of these, by its place in that order (m); nothing for a dissipator.
    pub fn rest_length(&self, member: usize) -> Option<f64> {
        let segments = self.segments.len();
        match self.segments.get(member) {
            Some(segment) => Some(segment.rest_length),
            None => match self.cylinders.get(member - segments) {
                Some(cylinder) => Some(cylinder.rest_length),
                None => self.axial_members().nth(member)?.rest_length,
            },
        }
    }

    /// Ropes that share what an element of this kind bears.
    pub fn sharing(&self, kind: SegmentKind) -> f64 {
        match kind {
            SegmentKind::Main(rope) => f64::from(self.bundles.get(usize::from(rope)).copied().unwrap_or(1)),
            SegmentKind::Net
            | SegmentKind::Lateral
            | SegmentKind::Ring
            | SegmentKind::Retaining(_)
            | SegmentKind::Post(_) => 1.0,
        }
    }

    /// All springs between two nodes, in a fixed order: ropes and rings go slack, posts do not. The tension of rings is none of them.
    pub fn springs(&self) -> impl Iterator<Item = SpringLink> {
        let segments = self.segments.iter().map(Segment::taut);
        let rings = self.net_rings.iter().flat_map(NetRing::springs);
        let posts = self.posts.iter().map(|post| post.taut(&self.nodes));
        segments.chain(self.dissipators.iter().chain(&self.holds).map(Dissipator::taut)).chain(rings).chain(posts)
    }

    /// How far upstream of its foot the net reaches (m): what holds its posts lies further upstream.
    pub fn face(&self) -> f64 {
        let mut of_net = vec![true; self.nodes.len()];
        let retaining = self.segments.iter().map(|segment| (segment.kind, segment.nodes));
        let retaining = retaining.chain(self.dissipators.iter().map(|dissipator| (dissipator.kind, dissipator.nodes)));
        for (_, nodes) in retaining.filter(|(kind, _)| matches!(kind, SegmentKind::Retaining(_))) {
            nodes.iter().for_each(|node| of_net[*node as usize] = false);
        }
        self.posts.iter().for_each(|post| of_net[post.nodes[1] as usize] = true);
        let nodes = self.nodes.iter().zip(&of_net).filter(|(_, of_net)| **of_net);
        nodes.map(|(node, _)| -node.position.x).fold(0.0, f64::max)
    }

    /// Lets the piece of rope between two nodes be touched no more.
    pub fn lose_line(&mut self, nodes: [u32; 2]) {
        let Some(index) = self.lines.iter().position(|line| line.nodes == nodes) else { return };
        self.lines[index].broken = true;
        self.line_ends = LineEnds::of(&self.lines, self.nodes.len());
    }

    /// Lets a ring of the net break.
    pub fn lose_ring(&mut self, number: usize) {
        self.net_rings[number].strength.broken = true;
        for side in std::mem::take(&mut self.net_rings[number].touched) {
            self.lose_line(side);
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
        let mut touched: Vec<([u32; 2], f64)> = touchable.map(|(_, nodes, radius)| (nodes, radius)).collect();
        for ring in &self.net_rings {
            touched.extend(ring.touched.iter().map(|&nodes| (nodes, ring.radius)));
        }
        touched.extend(self.dissipators.iter().map(|dissipator| (dissipator.nodes, dissipator.radius)));
        touched.extend(self.posts.iter().map(|post| (post.nodes, post.radius)));
        let line = |(nodes, radius)| Line { nodes, radius, thickness: radius, broken: false };
        self.lines = touched.into_iter().map(line).collect();
        self.line_ends = LineEnds::of(&self.lines, self.nodes.len());
        self.nodes.iter_mut().for_each(|node| node.radius = 0.0);
        for line in &self.lines {
            for node in line.nodes {
                let node = &mut self.nodes[node as usize];
                node.radius = node.radius.max(line.radius);
            }
        }
        for line in &mut self.lines {
            let ends = line.nodes.map(|node| self.nodes[node as usize].radius);
            line.thickness = line.radius.max(ends[0]).max(ends[1]);
        }
    }
}
