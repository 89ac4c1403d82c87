//! Main ropes of cylinders, with rings as squares of four cylinders round them (Albaba 2015, sections 4.2.2 and 4.2.3).
//!
//! A ring stands across its rope, with a corner upstream that one more cylinder ties to a knot of the net. So the knots on a main
//! rope stand a little upstream of it. Two diagonals hold a ring in shape.

use crate::scene::net::ring_shape::{POISSON, ring_side};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

use crate::design::Rope;
use crate::scene::net::build::{Builder, ROPE_DAMPING_RATIO, ROPE_DENSITY, strength_of};
use dem::Vec3;
use dem::contact::law::Memory;
use dem::elements::cylinder::{Cylinder, Section};
use dem::elements::ring::RingSide;
use dem::elements::segment::SegmentKind;
use dem::elements::strength::Strength;

/// Damping of a cylinder's own turning mode over critical: wires rub on each other when a rope bends.
const BENDING_DAMPING_RATIO: f64 = 0.2;

impl Builder<'_> {
    /// Adds a main rope of cylinders along `row` from end to end, and a ring at each knot; returns the rope's nodes.
    pub(super) fn add_ringed_rope(&mut self, rope: u16, row: usize, ends: [u32; 2]) -> Vec<u32> {
        let ropes = self.design.main_ropes.clone();
        let up = self.grid.row_heights[row];
        let columns: Vec<i32> = self.grid.knot_columns(row).collect();
        let stops = [&[0], &columns[..], &[self.grid.columns]].concat();
        let mut nodes = vec![ends[0]];
        let mut ring_places = Vec::new();
        for pair in stops.windows(2) {
            let [from, to] = [pair[0], pair[1]].map(|column| self.across(column));
            let parts = ((to - from) / ropes.element_length).round().max(1.0) as usize;
            let last = if pair[1] == self.grid.columns { parts - 1 } else { parts };
            for part in 1..=last {
                let across = from + (to - from) * part as f64 / parts as f64;
                nodes.push(self.add_node(self.place(across, up), false));
            }
            ring_places.push(nodes.len() as u32 - 1);
        }
        nodes.push(ends[1]);
        let line = *self.main_rope(rope);
        let section = Section::round(0.5 * line.diameter, line.modulus, POISSON);
        let first = self.barrier.cylinders.len() as u32;
        for pair in nodes.windows(2) {
            self.add_cylinder([pair[0], pair[1]], SegmentKind::Main(rope), section, strength_of(&line));
        }
        let cylinders = first..self.barrier.cylinders.len() as u32;
        for (column, place) in columns.into_iter().zip(ring_places) {
            let ring = RingSide {
                side: 0,
                rope: cylinders.clone(),
                near: first + place,
                memory: Memory::default(),
                friction: ropes.ring_friction,
            };
            self.add_ring(self.knots[&(column, row)], self.place(self.across(column), up), &line, &ring);
        }
        nodes
    }

    /// Adds a ring round `centre` and its `line`, tied to `knot`; `ring` tells of the rope.
    fn add_ring(&mut self, knot: u32, centre: Vec3, line: &Rope, ring: &RingSide) {
        let ropes = &self.design.main_ropes;
        let half_diagonal = ring_side(ropes, line) * FRAC_1_SQRT_2;
        let section = Section::round(0.5 * ropes.ring_diameter, ropes.ring_modulus, POISSON);
        let rod = Rope {
            diameter: ropes.ring_diameter,
            modulus: ropes.ring_modulus,
            breaking_load: f64::INFINITY,
            elastic_limit: None,
            breaks: false,
        };
        let [upward, upstream] = self.directions();
        let corners = [upstream, upward, -upstream, -upward]
            .map(|direction| self.add_node(centre + direction * half_diagonal, false));
        for corner in 0..4 {
            let side = self.barrier.cylinders.len() as u32;
            self.add_cylinder(
                [corners[corner], corners[(corner + 1) % 4]],
                SegmentKind::Ring,
                section,
                Strength::default(),
            );
            self.barrier.rings.push(RingSide { side, ..ring.clone() });
        }
        self.add_segment([corners[0], corners[2]], SegmentKind::Ring, &rod);
        self.add_segment([corners[1], corners[3]], SegmentKind::Ring, &rod);
        self.add_cylinder([corners[0], knot], SegmentKind::Ring, section, Strength::default());
    }

    /// Adds a cylinder between two nodes, at rest as it lies, half its mass and inertia to each.
    pub(super) fn add_cylinder(&mut self, nodes: [u32; 2], kind: SegmentKind, section: Section, strength: Strength) {
        let ends = nodes.map(|node| node as usize);
        let barrier = &mut self.barrier;
        let places = ends.map(|end| barrier.nodes[end].position);
        let frames = ends.map(|end| &barrier.frames[end]);
        let mut cylinder = Cylinder::between(nodes, kind, section, [&places[0], &places[1]], frames);
        cylinder.strength = Strength { first_length: cylinder.rest_length, ..strength };
        let (length, radius) = (cylinder.rest_length, section.radius);
        let half_mass = 0.5 * ROPE_DENSITY * PI * radius * radius * length;
        cylinder.damping_time = 2.0 * ROPE_DAMPING_RATIO * (half_mass * length / section.axial).sqrt();
        let half_inertia = half_mass * (length * length / 12.0 + radius * radius / 4.0);
        cylinder.turning_time = 2.0 * BENDING_DAMPING_RATIO * (half_inertia * length / (6.0 * section.bending)).sqrt();
        for end in ends {
            let node = &mut barrier.nodes[end];
            node.mass += half_mass;
            let frame = &mut barrier.frames[end];
            frame.inertia += half_inertia;
            frame.held = false;
        }
        barrier.cylinders.push(cylinder);
    }
}
