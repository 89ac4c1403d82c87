//! Builds the barrier's nodes and elements from the design.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use nalgebra::UnitQuaternion;

use crate::design::{Bank, BarrierModel, Bottom, Channel, DissipatorDesign, FlexibleNet, LateralTo, Rope};
use crate::lattice::Place;
use crate::scene::net::grid::Grid;
use crate::scene::net::ring_shape::{POISSON, ring_stand_off};
use dem::Vec3;
use dem::elements::cylinder::Section;
use dem::elements::dissipator::Dissipator;
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::sliding::Chain;
use dem::elements::strength::Strength;
use dem::elements::yield_curve::YieldCurve;
use dem::tables::barrier::{Anchor, Barrier};
use dem::tables::nodes::{Frame, Node};

/// Density of wire rope over its full circle (kg/m³): steel.
pub const ROPE_DENSITY: f64 = 7850.0;
/// Axial damping of a rope segment over critical (numerical; the thesis states none).
pub const ROPE_DAMPING_RATIO: f64 = 0.05;

/// Rest length, over the ring spacing, below which no rope is taken out between two rings: there they touch.
pub const SHORTEST_SEGMENT: f64 = 0.25;

/// A built barrier with the places of its knots, which recorders need.
#[derive(Clone, Debug)]
pub struct BuiltNet {
    pub barrier: Barrier,
    /// Node numbers of the knots, row by row from the bottom, each from one side to the other.
    pub rows: Vec<Vec<u32>>,
    /// Row of each main rope.
    pub rope_rows: Vec<usize>,
    /// The rows with the knots of the side extensions, if there are any: what a grain must have passed to be lost.
    pub screen_rows: Vec<Vec<u32>>,
}

impl BuiltNet {
    /// How far upstream of its foot the barrier reaches with all that holds it (m).
    pub fn reach(&self) -> f64 {
        self.barrier.nodes.iter().map(|node| -node.position.x).fold(0.0, f64::max)
    }
}

/// Builds the net of `design` across `channel`, each side of a mesh of so many straight `pieces`. The barrier's foot is at x = 0.
pub fn build(design: &FlexibleNet, channel: &Channel, model: BarrierModel, pieces: u32) -> BuiltNet {
    let section = channel.section();
    let top = design.height * libm::cos(channel.slope + design.tilt) + design.bottom.gap();
    let [starts, ends] = section.banks(top);
    let width = ends - starts;
    let bundles = design.main_ropes.bundles();
    let mut builder = Builder {
        design,
        pieces,
        channel,
        model,
        grid: Grid::fit(design, width),
        starts,
        width,
        barrier: Barrier {
            friction: channel.barrier_friction,
            contact_modulus: design.net_rope.modulus,
            ring_moduli: [design.main_ropes.ring_modulus, design.main_ropes.levels[0].rope.modulus],
            bundles: if bundles.iter().any(|ropes| *ropes > 1) { bundles } else { Vec::new() },
            ..Barrier::default()
        },
        knots: BTreeMap::new(),
        rope_nodes: BTreeMap::new(),
        wings: Vec::new(),
        cut_sides: BTreeMap::new(),
        heads: Vec::new(),
    };
    if let Some(survey) = &channel.survey {
        builder.add_cut_net(survey);
    } else {
        builder.add_knots();
        builder.add_sides();
        builder.add_main_ropes();
        builder.add_lateral_ropes();
    }
    if let Some(rings) = &design.rings {
        builder.add_net_rings(rings);
    }
    if let Some(extension) = &design.side_extension {
        builder.add_side_extensions(extension);
    }
    builder.finish()
}

pub(super) struct Builder<'a> {
    pub(super) design: &'a FlexibleNet,
    pub(super) channel: &'a Channel,
    model: BarrierModel,
    /// Of a side of a mesh.
    pieces: u32,
    pub(super) grid: Grid,
    /// Where the uppermost rope begins and how long it is, from bank to bank (m).
    starts: f64,
    pub(super) width: f64,
    pub(super) barrier: Barrier,
    pub(super) knots: BTreeMap<Place, u32>,
    /// Nodes of main ropes from end to end, by row.
    pub(super) rope_nodes: BTreeMap<usize, Vec<u32>>,
    /// Knots of the side extensions by row, on either side, from the net outwards.
    pub(super) wings: Vec<[Vec<u32>; 2]>,
    /// In a ring net, the node on the edge at which a side was cut, by the place that is left and the way from there to the other.
    pub(super) cut_sides: BTreeMap<(Place, (i32, i32)), u32>,
    /// Heads of posts.
    pub(super) heads: Vec<u32>,
}

impl Builder<'_> {
    /// Whether a main rope that is free to move runs along a row.
    fn has_free_rope(&self, row: usize) -> bool {
        self.grid.rope_rows.contains(&row) && (row > 0 || self.design.bottom != Bottom::Fixed)
    }

    /// The ropes of a level, one of them.
    pub(super) fn main_rope(&self, level: u16) -> &Rope {
        &self.design.main_ropes.levels[usize::from(level)].rope
    }

    /// The rope that runs along a row.
    fn rope_of_row(&self, row: usize) -> &Rope {
        let level = self.grid.rope_rows.iter().position(|&of| of == row).unwrap_or(0);
        &self.design.main_ropes.levels[level].rope
    }

    /// Place of a column across the channel (m).
    pub(super) fn across(&self, column: i32) -> f64 {
        let gap = self.design.side_gap();
        let inner = self.width - 2.0 * gap;
        self.starts + gap + inner * f64::from(column) / f64::from(self.grid.columns)
    }

    /// Unit vectors up the barrier's plane and out of it, upstream.
    pub(super) fn directions(&self) -> [Vec3; 2] {
        let lean = self.channel.slope + self.design.tilt;
        [Vec3::new(-libm::sin(lean), 0.0, libm::cos(lean)), Vec3::new(-libm::cos(lean), 0.0, -libm::sin(lean))]
    }

    /// A point of the barrier's plane: `across` from the first side wall, `up` along the plane.
    pub(super) fn place(&self, across: f64, up: f64) -> Vec3 {
        let lean = self.channel.slope + self.design.tilt;
        let lift = self.design.bottom.gap();
        Vec3::new(-libm::sin(lean) * up, across, libm::cos(lean) * up + lift)
    }

    pub(super) fn add_node(&mut self, position: Vec3, fixed: bool) -> u32 {
        self.barrier.nodes.push(Node { position, velocity: Vec3::zeros(), mass: 0.0, fixed, radius: 0.0 });
        if self.model == BarrierModel::Cylinders {
            self.barrier.frames.push(Frame {
                orientation: UnitQuaternion::identity(),
                spin: Vec3::zeros(),
                inertia: 0.0,
                held: true,
            });
        }
        self.barrier.nodes.len() as u32 - 1
    }

    fn add_knots(&mut self) {
        let bottom_fixed = self.design.bottom == Bottom::Fixed;
        let [_, upstream] = self.directions();
        for row in 0..self.grid.row_heights.len() {
            for column in self.grid.knot_columns(row).chain(self.edge_contacts(row)) {
                let mut position = self.place(self.across(column), self.grid.row_heights[row]);
                if self.model == BarrierModel::Cylinders && self.has_free_rope(row) {
                    position += upstream * ring_stand_off(&self.design.main_ropes, self.rope_of_row(row));
                }
                let node = self.add_node(position, bottom_fixed && row == 0);
                self.knots.insert((column, row), node);
            }
        }
    }

    /// Columns of the lateral ropes where a ring that meets six others would stand half outside: it is cut there, and hangs on the rope.
    fn edge_contacts(&self, row: usize) -> impl Iterator<Item = i32> + use<> {
        let lattice = self.grid.lattice;
        [0, self.grid.columns].into_iter().filter(move |column| lattice.has_centre((*column, row)))
    }

    /// Adds the sides of all meshes; a ring net has none.
    fn add_sides(&mut self) {
        if self.design.rings.is_some() {
            return;
        }
        let mut pairs = Vec::new();
        for (&place, &node) in &self.knots {
            for &step in self.grid.lattice.neighbours(place) {
                // Beside the net the lateral rope runs where a side would.
                let beside = step.0 == 0 && (place.0 == 0 || place.0 == self.grid.columns);
                let other = self.grid.from(place, step).filter(|other| other.1 > place.1 && !beside);
                pairs.extend(other.and_then(|other| self.knots.get(&other)).map(|&above| [node, above]));
            }
        }
        for knots in pairs {
            self.add_side_of_mesh(knots);
        }
    }

    /// A side of a mesh from knot to knot, in straight pieces.
    pub(super) fn add_side_of_mesh(&mut self, knots: [u32; 2]) {
        let [from, to] = knots.map(|knot| self.barrier.nodes[knot as usize].position);
        let pieces = self.pieces_of((to - from).norm());
        let inner = (1..pieces).map(|piece| from.lerp(&to, f64::from(piece) / f64::from(pieces)));
        let inner: Vec<u32> = inner.collect::<Vec<_>>().into_iter().map(|place| self.add_node(place, false)).collect();
        let nodes = [&knots[..1], &inner, &knots[1..]].concat();
        for pair in nodes.windows(2) {
            self.add_line([pair[0], pair[1]], SegmentKind::Net, &self.design.net_rope);
        }
    }

    /// Pieces of a side of this length: fewer where it was cut (m).
    fn pieces_of(&self, length: f64) -> u32 {
        let whole = self.grid.lattice.side();
        if length > 0.75 * whole || self.pieces == 1 {
            return self.pieces;
        }
        (f64::from(self.pieces) * length / whole).round().max(1.0) as u32
    }

    fn add_main_ropes(&mut self) {
        for (rope, row) in self.grid.rope_rows.clone().into_iter().enumerate() {
            let (rope, free) = (rope as u16, self.has_free_rope(row));
            let ends = [0, self.grid.columns].map(|column| {
                let place = self.place(self.across(column), self.grid.row_heights[row]);
                self.add_node(place, !free)
            });
            let mut first_segment = self.barrier.segments.len() as u32;
            let nodes = if self.model == BarrierModel::Cylinders && free {
                self.add_ringed_rope(rope, row, ends)
            } else {
                let mut nodes: Vec<u32> = [&ends[..1], &self.knots_of_row(row), &ends[1..]].concat();
                if usize::from(rope) + 1 == self.grid.rope_rows.len() {
                    nodes = self.add_posts(nodes);
                }
                first_segment = self.barrier.segments.len() as u32;
                for pair in nodes.windows(2) {
                    self.add_line([pair[0], pair[1]], SegmentKind::Main(rope), &self.main_rope(rope).clone());
                }
                nodes
            };
            self.rope_nodes.insert(row, nodes);
            if free {
                let segments = (first_segment..self.barrier.segments.len() as u32).collect();
                self.add_chain(segments);
                let up = self.grid.row_heights[row];
                self.add_rope_end(rope, ends[0], self.place(0.0, up), Bank::Right);
                self.add_rope_end(rope, ends[1], self.place(self.width, up), Bank::Left);
            }
        }
    }

    /// Lets a main rope run through its rings, if the model has it so.
    pub(super) fn add_chain(&mut self, segments: Vec<u32>) {
        if self.model == BarrierModel::SlidingRopes {
            let rings = &self.design.main_ropes;
            let shortest = SHORTEST_SEGMENT * rings.ring_spacing;
            let over_a_head = self.design.posts.as_ref().map_or(0.0, |posts| posts.head_friction);
            let friction = |segment: &u32| {
                let joint = self.barrier.segments[*segment as usize].nodes[0];
                if self.heads.contains(&joint) { over_a_head } else { rings.ring_friction }
            };
            let frictions = segments.iter().skip(1).map(friction).collect();
            self.barrier.chains.push(Chain { segments, frictions, shortest });
        }
    }

    /// Anchors one end of a main rope that comes to a bank at a place, through a dissipator where the design has them.
    pub(super) fn add_rope_end(&mut self, rope: u16, end: u32, place: Vec3, bank: Bank) {
        let set_back = self.design.anchor_designs.of(usize::from(rope), bank).set_back;
        let outwards = if bank == Bank::Right { -Vec3::y() } else { Vec3::y() };
        let (anchor, kind) = (self.add_node(place + outwards * set_back, true), SegmentKind::Main(rope));
        self.barrier.anchors.push(Anchor { node: anchor, kind });
        let radius = 0.5 * self.main_rope(rope).diameter;
        match &self.design.dissipators {
            Some(design) => {
                let (sharing, gap) = (self.barrier.sharing(kind), self.design.side_gap());
                let line = self.main_rope(rope);
                let mut made = dissipator([anchor, end], kind, gap + set_back, design, sharing, radius);
                if set_back > 0.0 {
                    // The rope between net and anchor stretches with it.
                    let of_rope = set_back / (sharing * line.axial_stiffness());
                    made.stiffness = (made.stiffness.recip() + of_rope).recip();
                }
                self.barrier.dissipators.push(made);
            }
            None => self.add_line([anchor, end], kind, &self.main_rope(rope).clone()),
        }
    }

    /// Ropes along both sides of the net, which meet its knots there; at each main rope they meet the rope's end or its anchor.
    fn add_lateral_ropes(&mut self) {
        for column in [0, self.grid.columns] {
            let stops = 0..self.grid.row_heights.len();
            let line: Vec<u32> = stops.filter_map(|row| self.lateral_stop(column, row)).collect();
            for pair in line.windows(2) {
                self.add_line([pair[0], pair[1]], SegmentKind::Lateral, &self.design.lateral_rope);
            }
        }
    }

    fn lateral_stop(&self, column: i32, row: usize) -> Option<u32> {
        let Some(rope) = self.grid.rope_rows.iter().position(|&rope_row| rope_row == row) else {
            return self.knots.get(&(column, row)).copied();
        };
        let side = usize::from(column > 0);
        let mut anchors = self.barrier.anchors.iter().filter(|anchor| anchor.kind == SegmentKind::Main(rope as u16));
        match (self.design.lateral_to, anchors.nth(side)) {
            (LateralTo::Anchors, Some(anchor)) => Some(anchor.node),
            _ => {
                let nodes = &self.rope_nodes[&row];
                Some(nodes[side * (nodes.len() - 1)])
            }
        }
    }

    pub(super) fn knots_of_row(&self, row: usize) -> Vec<u32> {
        (0..=self.grid.columns).filter_map(|column| self.knots.get(&(column, row)).copied()).collect()
    }

    /// Adds a straight rope between two nodes, as a segment or as a cylinder.
    pub(super) fn add_line(&mut self, nodes: [u32; 2], kind: SegmentKind, rope: &Rope) {
        if self.model == BarrierModel::Cylinders {
            let section = Section::round(0.5 * rope.diameter, rope.modulus, POISSON);
            self.add_cylinder(nodes, kind, section, strength_of(rope));
        } else {
            self.add_segment(nodes, kind, rope);
        }
    }

    /// Adds a straight rope between two nodes, unstretched as it lies or slack, half its mass to each.
    pub(super) fn add_segment(&mut self, nodes: [u32; 2], kind: SegmentKind, rope: &Rope) {
        let radius = 0.5 * rope.diameter;
        let area = PI * radius * radius;
        let [a, b] = nodes.map(|node| self.barrier.nodes[node as usize].position);
        let slack = if kind == SegmentKind::Net { self.design.net_slack } else { 0.0 };
        let rest_length = (b - a).norm() * (1.0 + slack);
        let sharing = self.barrier.sharing(kind);
        let stiffness = sharing * rope.modulus * area / rest_length;
        let half_mass = 0.5 * sharing * ROPE_DENSITY * area * rest_length;
        for node in nodes {
            let node = &mut self.barrier.nodes[node as usize];
            node.mass += half_mass;
        }
        let damping = 2.0 * ROPE_DAMPING_RATIO * (stiffness * half_mass).sqrt();
        let Strength { elastic, breaking, .. } = strength_of(rope);
        let strength = Strength {
            elastic: sharing * elastic,
            breaking: sharing * breaking,
            first_length: rest_length,
            ..Strength::default()
        };
        self.barrier.segments.push(Segment { nodes, kind, rest_length, stiffness, damping, radius, strength });
    }

    fn finish(mut self) -> BuiltNet {
        // Those of posts after all others.
        self.barrier.anchors.sort_by_key(|anchor| matches!(anchor.kind, SegmentKind::Retaining(_)));
        self.barrier.connect();
        // Along a main rope, the rope tells how high a row stands and how wide.
        let row = |row| self.rope_nodes.get(&row).cloned().unwrap_or_else(|| self.knots_of_row(row));
        let rows: Vec<Vec<u32>> = (0..self.grid.row_heights.len()).map(row).collect();
        let mut screen_rows = rows.clone();
        for (row, [first, last]) in screen_rows.iter_mut().zip(&self.wings) {
            row.splice(0..0, first.iter().rev().copied());
            row.extend(last);
        }
        BuiltNet { barrier: self.barrier, rows, rope_rows: self.grid.rope_rows, screen_rows }
    }
}

/// Dissipators at the end of so many ropes that run side by side, which go taut at a rest length (m).
pub(super) fn dissipator(
    nodes: [u32; 2],
    kind: SegmentKind,
    rest_length: f64,
    design: &DissipatorDesign,
    sharing: f64,
    radius: f64,
) -> Dissipator {
    Dissipator {
        nodes,
        kind,
        rest_length,
        radius,
        stiffness: sharing * design.stiffness,
        plateau: sharing * design.plateau,
        curve: YieldCurve::new(design.curve.points()),
        stroke: design.stroke,
        used: 0.0,
    }
}

/// What pieces of `rope` withstand.
pub(super) fn strength_of(rope: &Rope) -> Strength {
    Strength {
        elastic: rope.elastic_limit.unwrap_or(f64::INFINITY),
        breaking: if rope.breaks { rope.breaking_load } else { f64::INFINITY },
        ..Strength::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::BarrierDesign;
    use crate::design::read::read_design;

    /// The net hangs on rings alone: what pulls on the end of a main rope is the rope, its dissipator and the lateral ropes.
    #[test]
    fn no_rope_of_the_net_ends_at_the_end_of_a_main_rope() {
        let design = read_design("x", include_bytes!("../../../designs/site_a.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        for model in [BarrierModel::PinnedRopes, BarrierModel::SlidingRopes, BarrierModel::Cylinders] {
            let barrier = build(net, &design.channel, model, 1).barrier;
            let ends: Vec<u32> = barrier.dissipators.iter().map(|dissipator| dissipator.nodes[1]).collect();
            assert_eq!(ends.len(), 8);
            let segments = barrier.segments.iter().map(|segment| (segment.kind, segment.nodes));
            let lines = segments.chain(barrier.cylinders.iter().map(|cylinder| (cylinder.kind, cylinder.nodes)));
            let at = |kind: SegmentKind| {
                lines.clone().filter(|(of, nodes)| *of == kind && nodes.iter().any(|node| ends.contains(node))).count()
            };
            assert_eq!(at(SegmentKind::Net), 0);
            // Half a mesh from the end to the first knot.
            let lengths = barrier.segments.iter().map(|segment| segment.rest_length);
            let shortest = lengths.chain(barrier.cylinders.iter().map(|cylinder| cylinder.rest_length));
            assert!(shortest.fold(f64::INFINITY, f64::min) > 0.02, "{model:?}");
            // Up and down at each, but for the uppermost.
            assert_eq!(at(SegmentKind::Lateral), 14);
        }
    }
}
