//! A net in a surveyed section: each main rope from bank to bank, the mesh cut along the banks and the bed.
//!
//! The mesh is one lattice; a side of it that leads out of the net ends where it meets the edge: on the lateral rope along a bank, or on the
//! lowest rope. Knots that would lie closer to an edge than half their distance from each other are left out, so that no piece of rope is much
//! shorter than the others.

use std::collections::BTreeMap;

use crate::design::{Bank, Bottom, LateralTo};
use crate::lattice::Place;
use crate::scene::net::build::Builder;
use crate::scene::net::outline::{Edge, Outline, Point};
use crate::section::Survey;
use dem::elements::segment::SegmentKind;

/// Least distance of a knot from an edge, and of two nodes along an edge, over half a diagonal.
const CLEAR: f64 = 0.5;
const APART: f64 = 0.4;
/// Rounding, over half a diagonal, within which a knot lies on the lowest rope.
const ON_THE_ROPE: f64 = 1e-6;

/// A side of the mesh that ends on an edge.
#[derive(Clone, Copy, Debug)]
struct SideEnd {
    /// How far along the edge (m).
    way: f64,
    /// The knot from which it comes.
    knot: u32,
    /// The place of that knot, and the way from it.
    side: (Place, (i32, i32)),
}

/// Sides of the mesh that end on an edge.
type Ends = BTreeMap<(u8, usize), Vec<SideEnd>>;

fn key(edge: Edge) -> (u8, usize) {
    match edge {
        Edge::Bottom => (0, 0),
        Edge::Bank(side) => (1, side),
    }
}

impl Builder<'_> {
    /// The outline of the net in the section.
    pub(super) fn outline(&self, survey: &Survey) -> Outline {
        let lean = self.channel.slope + self.design.tilt;
        let opening = match self.design.bottom {
            Bottom::Fixed => None,
            Bottom::Opening(height) => Some(height),
        };
        let up = |z: f64| (z - opening.unwrap_or(0.0)) / libm::cos(lean);
        Outline::new(survey, up, self.design.height, self.design.side_gap(), opening)
    }

    /// Adds all of the net but side extensions.
    pub(super) fn add_cut_net(&mut self, survey: &Survey) {
        let outline = self.outline(survey);
        let ends = self.add_cut_mesh(&outline);
        self.add_lowest_rope(&outline, &ends);
        for rope in 1..self.grid.rope_rows.len() {
            self.add_hanging_rope(rope, &outline);
        }
        for side in 0..2 {
            self.add_lateral_rope(side, &outline, &ends);
        }
    }

    /// Half a diagonal of the mesh across the channel (m).
    fn half_diagonal(&self) -> f64 {
        self.across(1) - self.across(0)
    }

    /// The same, or half the diagonal along the barrier where that of a diamond is shorter.
    fn half_shorter(&self) -> f64 {
        let [across, along] = self.design.lattice().period();
        self.half_diagonal() * (along / across).min(1.0)
    }

    /// Adds the knots inside the outline and the sides between them; returns the sides that end on its edges.
    fn add_cut_mesh(&mut self, outline: &Outline) -> Ends {
        let (half, clear_by) = (self.half_diagonal(), CLEAR * self.half_shorter());
        let rows = self.grid.row_heights.len();
        let point =
            |builder: &Self, (column, row): Place| -> Point { [builder.across(column), builder.grid.row_heights[row]] };
        for row in 0..rows {
            for column in self.grid.knot_columns(row) {
                let place = point(self, (column, row));
                // On the lowest rope where that is level, or well inside.
                let on_the_rope =
                    outline.distance(place, |edge| edge == Edge::Bottom) <= ON_THE_ROPE * half && row == 0;
                let clear =
                    outline.is_inside(place) && outline.distance(place, |edge| edge == Edge::Bottom) >= clear_by;
                let beside = outline.distance(place, |edge| edge != Edge::Bottom) >= clear_by;
                if (clear || on_the_rope) && beside {
                    let held = row == 0 && self.design.bottom == Bottom::Fixed;
                    let node = self.add_node(self.place(place[0], place[1]), held);
                    self.knots.insert((column, row), node);
                }
            }
        }
        let mut ends = Ends::new();
        let knots: Vec<(Place, u32)> = self.knots.iter().map(|(place, node)| (*place, *node)).collect();
        for (place, node) in knots {
            for &step in self.grid.lattice.neighbours(place) {
                // Above the top there is nothing, and below the lowest rope neither; along a main rope it is the rope that goes on.
                let Some(other) = self.grid.from(place, step) else { continue };
                if step.1 == 0 && self.grid.rope_rows.contains(&place.1) {
                    continue;
                }
                match self.knots.get(&other).copied() {
                    Some(above) if other.1 > place.1 && self.design.rings.is_none() => {
                        self.add_side_of_mesh([node, above]);
                    }
                    Some(_) => {}
                    None => {
                        let from = point(self, place);
                        if let Some(crossing) = outline.crossing(from, beyond(from, point(self, other))) {
                            let end = SideEnd { way: crossing.way, knot: node, side: (place, step) };
                            ends.entry(key(crossing.edge)).or_default().push(end);
                        }
                    }
                }
            }
        }
        ends
    }

    /// Adds nodes along an edge for the sides that end there, no two too close to each other or to a `stop`; returns them with their way.
    fn add_ends(&mut self, edge: Edge, outline: &Outline, ends: &Ends, stops: &[f64], held: bool) -> Vec<(f64, u32)> {
        let apart = APART * self.half_shorter();
        let mut list = ends.get(&key(edge)).cloned().unwrap_or_default();
        for end in &mut list {
            end.way = clear_of(end.way, stops, apart);
        }
        list.sort_by(|a, b| a.way.total_cmp(&b.way));
        let mut nodes: Vec<(f64, u32)> = Vec::new();
        for SideEnd { way, knot, side } in list {
            let node = match nodes.last() {
                Some((before, node)) if way - before < apart => *node,
                _ => {
                    let [across, up] = outline.point(edge, way);
                    let node = self.add_node(self.place(across, up), held);
                    nodes.push((way, node));
                    node
                }
            };
            match &self.design.rings {
                Some(_) => _ = self.cut_sides.insert(side, node),
                None => self.add_side_of_mesh([knot, node]),
            }
        }
        nodes
    }

    fn add_lowest_rope(&mut self, outline: &Outline, ends: &Ends) {
        let fixed = self.design.bottom == Bottom::Fixed;
        let rope = *self.main_rope(0);
        let length = outline.length(Edge::Bottom);
        let start = outline.bottom[0][0];
        // Where its bed is level its knots are nodes of the mesh; where a side was cut there are nodes of its own.
        let knots: Vec<(f64, u32)> = self
            .knots_of_row(0)
            .into_iter()
            .map(|node| (self.barrier.nodes[node as usize].position.y - start, node))
            .collect();
        let stops: Vec<f64> = [0.0, length].into_iter().chain(knots.iter().map(|(way, _)| *way)).collect();
        let mut nodes = self.add_ends(Edge::Bottom, outline, ends, &stops, fixed);
        // The ground between, where the bed bends.
        let mut way = 0.0;
        let apart = APART * self.half_shorter();
        for pair in outline.bottom.windows(2) {
            way += libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
            let clear = stops.iter().chain(nodes.iter().map(|(way, _)| way)).all(|stop| (stop - way).abs() >= apart);
            if fixed && clear {
                nodes.push((way, self.add_node(self.place(pair[1][0], pair[1][1]), true)));
            }
        }
        nodes.extend(knots);
        for way in [0.0, length] {
            let [across, up] = outline.point(Edge::Bottom, way);
            nodes.push((way, self.add_node(self.place(across, up), fixed)));
        }
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let line: Vec<u32> = nodes.into_iter().map(|(_, node)| node).collect();
        self.add_rope(0, line, &rope, !fixed, outline);
    }

    fn add_hanging_rope(&mut self, number: usize, outline: &Outline) {
        let rope = *self.main_rope(number as u16);
        let row = self.grid.rope_rows[number];
        let up = self.grid.row_heights[row];
        let [right, left] = [0, 1].map(|side| {
            let [across, _] = outline.point(Edge::Bank(side), outline.way_to(side, up));
            self.add_node(self.place(across, up), false)
        });
        let mut line = [&[right], &self.knots_of_row(row)[..], &[left]].concat();
        if number + 1 == self.grid.rope_rows.len() {
            line = self.add_posts(line);
        }
        self.add_rope(number, line, &rope, true, outline);
    }

    /// Adds the pieces of a main rope along its nodes, and its ends where it is free.
    fn add_rope(&mut self, number: usize, line: Vec<u32>, rope: &crate::design::Rope, free: bool, outline: &Outline) {
        let row = self.grid.rope_rows[number];
        let first = self.barrier.segments.len() as u32;
        for pair in line.windows(2) {
            self.add_segment([pair[0], pair[1]], SegmentKind::Main(number as u16), rope);
        }
        if free {
            let segments = (first..self.barrier.segments.len() as u32).collect();
            self.add_chain(segments);
            let (gap, up) = (self.design.side_gap(), self.grid.row_heights[row]);
            for (side, end) in [line[0], line[line.len() - 1]].into_iter().enumerate() {
                let [across, _] = outline.point(Edge::Bank(side), outline.way_to(side, up));
                let bank = if side == 0 { across - gap } else { across + gap };
                let at = if side == 0 { Bank::Right } else { Bank::Left };
                self.add_rope_end(number as u16, end, self.place(bank, up), at);
            }
        }
        self.rope_nodes.insert(row, line);
    }

    /// The rope along a bank: from the lowest rope upwards through the sides of the mesh that end there, and by way of the ends of the main
    /// ropes or their anchors.
    fn add_lateral_rope(&mut self, side: usize, outline: &Outline, ends: &Ends) {
        let ways: Vec<f64> =
            self.grid.rope_rows.iter().map(|&row| outline.way_to(side, self.grid.row_heights[row])).collect();
        let mut line = self.add_ends(Edge::Bank(side), outline, ends, &ways, false);
        for (number, way) in ways.into_iter().enumerate() {
            line.push((way, self.lateral_stop_of(number, side)));
        }
        line.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in line.windows(2) {
            self.add_segment([pair[0].1, pair[1].1], SegmentKind::Lateral, &self.design.lateral_rope.clone());
        }
    }

    /// The node by which a lateral rope goes at a main rope.
    fn lateral_stop_of(&self, number: usize, side: usize) -> u32 {
        let mut anchors = self.barrier.anchors.iter().filter(|anchor| anchor.kind == SegmentKind::Main(number as u16));
        match (self.design.lateral_to, anchors.nth(side)) {
            (LateralTo::Anchors, Some(anchor)) => anchor.node,
            _ => {
                let nodes = &self.rope_nodes[&self.grid.rope_rows[number]];
                nodes[side * (nodes.len() - 1)]
            }
        }
    }
}

/// A point further on the same way: a knot that was left out may lie inside, near the edge.
fn beyond(from: Point, to: Point) -> Point {
    [0, 1].map(|axis| from[axis] + 3.0 * (to[axis] - from[axis]))
}

/// The way moved off the nearest stop that is too close.
fn clear_of(way: f64, stops: &[f64], apart: f64) -> f64 {
    let nearest = stops.iter().copied().min_by(|a, b| (a - way).abs().total_cmp(&(b - way).abs()));
    let (low, high) = (stops.iter().copied().fold(f64::INFINITY, f64::min), stops.iter().copied().fold(0.0, f64::max));
    match nearest {
        Some(stop) if (stop - way).abs() < apart => {
            // Never beyond the first or the last stop.
            let upwards = (way >= stop && stop < high) || stop <= low;
            if upwards { stop + apart } else { stop - apart }
        }
        _ => way,
    }
}

#[cfg(test)]
mod tests {
    use crate::design::read::read_design;
    use crate::design::{BarrierDesign, BarrierModel};
    use crate::scene::net::build::{BuiltNet, build};

    fn built(channel: &str, bottom: &str) -> (BuiltNet, f64) {
        built_of("squares", channel, bottom)
    }

    /// Sides of 200 mm, or hexagons of 300 mm with sides of 173 mm.
    fn built_of(shape: &str, channel: &str, bottom: &str) -> (BuiltNet, f64) {
        let mesh =
            if shape == "squares" { "mesh_opening: 200 mm" } else { "mesh_shape: hexagons\n    mesh_opening: 300 mm" };
        let text = include_str!("../../../designs/small_net.yaml")
            .replace("mesh_opening: 200 mm", mesh)
            .replace("spacing: 283 mm", if shape == "squares" { "spacing: 283 mm" } else { "spacing: 300 mm" })
            .replace("  width: 3 m\n", &format!("  section: {channel}\n"))
            .replace("  wall_height: 2.5 m", "  # wall_height: 2.5 m")
            .replace("      fixed: to_bed", &format!("      {bottom}"));
        let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        (build(net, &design.channel, BarrierModel::SlidingRopes, 1), net.side_gap())
    }

    const TRAPEZOID: &str = "{trapezoid: {bed_width: 2 m, left_bank: 45 deg, right_bank: 1:0.5, depth: 3 m}}";

    #[test]
    fn each_rope_hangs_from_bank_to_bank() {
        let (net, gap) = built(TRAPEZOID, "fixed: to_bed");
        let plumb = libm::cos(25_f64.to_radians());
        let top = 1.8 * plumb;
        // Banks of 45° and 1 : 0.5, with heights normal to the bed.
        for (row, z) in [(0, 0.0), (1, 0.5 * top), (2, top)] {
            let nodes = &net.rows[net.rope_rows[row]];
            let ends = [nodes[0], nodes[nodes.len() - 1]].map(|node| net.barrier.nodes[node as usize].position.y);
            let span = 2.0 + z / plumb * (1.0 + 0.5) - 2.0 * gap;
            approx::assert_relative_eq!(ends[1] - ends[0], span, max_relative = 1e-9);
        }
        // The lowest is bolted; the others have two dissipators each, at the banks.
        assert_eq!((net.barrier.dissipators.len(), net.barrier.anchors.len()), (4, 4));
    }

    /// All of the net hangs together, no piece is much shorter than the others, and nothing reaches into the ground.
    #[test]
    fn the_mesh_ends_at_its_edges() {
        let groove = "{points: [[-6 m, 6 m], [-2 m, 2 m], [0 m, 0 m], [1.5 m, 1.5 m], [4 m, 2 m], [5 m, 6 m]]}";
        let uneven = "{points: [[-3 m, 4 m], [-1.2 m, 0.1 m], [0 m, 0 m], [1.3 m, 0.2 m], [3 m, 4 m]]}";
        let sections = [
            (TRAPEZOID, "fixed: to_bed"),
            (TRAPEZOID, "opening: 0.3 m"),
            (groove, "opening: 0.6 m"),
            (uneven, "fixed: to_bed"),
        ];
        for (shape, (section, bottom)) in
            ["squares", "hexagons"].into_iter().flat_map(|shape| sections.map(|section| (shape, section)))
        {
            let (net, _) = built_of(shape, section, bottom);
            let barrier = &net.barrier;
            let shortest = barrier.segments.iter().map(|segment| segment.rest_length).fold(f64::INFINITY, f64::min);
            assert!(shortest > 0.3 * 0.1414, "{section} {bottom}: {shortest}");
            let longest = barrier.segments.iter().map(|segment| segment.rest_length).fold(0.0, f64::max);
            assert!(longest < 5.0 * 0.1414, "{section} {bottom}: {longest}");
            // Each node but those of anchors is a node of some rope, and all are one piece.
            let mut piece: Vec<usize> = (0..barrier.nodes.len()).collect();
            let pairs = barrier.segments.iter().map(|segment| segment.nodes);
            let pairs: Vec<[u32; 2]> = pairs.chain(barrier.dissipators.iter().map(|one| one.nodes)).collect();
            for _ in 0..barrier.nodes.len() {
                let before = piece.clone();
                for [a, b] in &pairs {
                    let least = piece[*a as usize].min(piece[*b as usize]);
                    (piece[*a as usize], piece[*b as usize]) = (least, least);
                }
                if before == piece {
                    break;
                }
            }
            assert!(piece.iter().all(|number| *number == piece[0]), "{section} {bottom}");
            // Knots inside have four sides, or three; each side has two ends.
            let sides_of_a_knot = if shape == "squares" { 4.0 } else { 3.0 };
            let share = barrier.segments.len() as f64 / (0.5 * sides_of_a_knot * barrier.nodes.len() as f64);
            assert!(share > 0.8, "{shape} {section} {bottom}: {share}");
        }
    }
}
