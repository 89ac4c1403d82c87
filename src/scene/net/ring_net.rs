//! Builds the rings of a ring net: each hangs in the contacts right, above, left and below of its centre, which lie as the knots of a mesh do,
//! and shares each of them with one other ring, or with a rope.
//!
//! In a surveyed section the rings along the edge are cut to it: such a ring runs along the edge between the places where the mesh of
//! contacts meets it, and is as much smaller. What is cut has no stiffness of bending.

use crate::design::NetRings;
use crate::ring_law::{IN_CHAIN, IN_NET, mass};
use crate::scene::net::build::{Builder, ROPE_DAMPING_RATIO, ROPE_DENSITY};
use dem::elements::net_ring::{NetRing, RingStrength};

/// Least part of a ring that a cut one is as large and as heavy as: a smaller one would swing faster than all others.
const LEAST_SHARE: f64 = 0.5;

/// A contact of a ring: its node, and whether it lies on the edge to which the ring was cut.
type Contact = (u32, bool);

impl Builder<'_> {
    /// Adds all rings, once every contact has its node.
    pub(super) fn add_net_rings(&mut self, rings: &NetRings) {
        for row in (1..self.grid.row_heights.len()).step_by(2) {
            for column in (1..self.grid.columns).step_by(2) {
                let contacts = self.contacts_of_ring(column, row);
                if contacts.len() > 1 {
                    self.add_net_ring(rings, &contacts, row);
                }
            }
        }
    }

    /// Contacts of the ring round a place, in their order.
    fn contacts_of_ring(&self, column: usize, row: usize) -> Vec<Contact> {
        let corners = [(column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1)];
        let mut contacts: Vec<Contact> = Vec::new();
        for (corner, &here) in corners.iter().enumerate() {
            let next = corners[(corner + 1) % 4];
            let knots = [here, next].map(|place| self.knots.get(&place).copied());
            contacts.extend(knots[0].map(|node| (node, false)));
            let side = match knots {
                [Some(_), None] => [here, next],
                [None, Some(_)] => [next, here],
                _ => continue,
            };
            contacts.extend(self.cut_sides.get(&side).map(|&node| (node, true)));
        }
        contacts.dedup_by_key(|contact| contact.0);
        if contacts.len() > 1 && contacts[0].0 == contacts[contacts.len() - 1].0 {
            contacts.pop();
        }
        contacts
    }

    fn add_net_ring(&mut self, rings: &NetRings, contacts: &[Contact], row: usize) {
        let law = rings.law();
        let nodes: Vec<u32> = contacts.iter().map(|(node, _)| *node).collect();
        let count = nodes.len();
        let place = |contact: usize| self.barrier.nodes[nodes[contact % count] as usize].position;
        let way: f64 = (0..count).map(|contact| (place(contact + 1) - place(contact)).norm()).sum();
        let whole = contacts.iter().all(|(_, on_edge)| !on_edge) && count == 4;
        // The mesh of contacts is stretched a little to fit between the ropes, and its rings with it.
        let across = self.across(2) - self.across(0);
        let up = self.grid.row_heights[row + 1] - self.grid.row_heights[row - 1];
        let diameter = rings.diameter.max(across).max(up);
        let fitted = 2.0 * libm::hypot(across, up);
        let stretched = (fitted / (4.0 * rings.mesh())).max(1.0);
        let share = if whole { 1.0 } else { (way / fitted).max(LEAST_SHARE) };
        let (taut_from, stiffness) = (law.taut_from * stretched * share, law.stiffness / (stretched * share));
        let mass = mass(&rings.wires, rings.diameter, ROPE_DENSITY) * stretched * share;
        for &node in &nodes {
            self.barrier.nodes[node as usize].mass += mass / count as f64;
        }
        let touched = (0..count).filter(|&contact| !(contacts[contact].1 && contacts[(contact + 1) % count].1));
        self.barrier.net_rings.push(NetRing {
            taut_from,
            stiffness,
            damping: ROPE_DAMPING_RATIO * critical_damping(stiffness, mass),
            bending: if whole { law.bending } else { 0.0 },
            diameter,
            radius: 0.5 * rings.wires.bundle(),
            touched: touched.map(|contact| [nodes[contact], nodes[(contact + 1) % count]]).collect(),
            strength: RingStrength {
                in_chain: rings.leg(),
                in_net: if rings.tested { rings.leg() } else { rings.leg() * IN_NET / IN_CHAIN },
                breaks: rings.breaks,
                broken: false,
            },
            nodes,
        });
    }
}

/// Of a ring of four contacts that breathes: all move out by u, the way grows by 4 √2 u, and ½ k (4 √2 u)² = ½ 32 k u² (N s/m).
fn critical_damping(stiffness: f64, mass: f64) -> f64 {
    2.0 * (stiffness * mass / 32.0).sqrt()
}

#[cfg(test)]
mod tests {
    use crate::design::read::read_design;
    use crate::design::{BarrierDesign, BarrierModel};
    use crate::scene::net::build::{BuiltNet, build};
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    const RINGS: &str = "net: {rings: {diameter: 300 mm, windings: 12, wire_diameter: 3 mm, wire_strength: 1770 MPa}}";

    fn built(section: Option<&str>) -> BuiltNet {
        let mut text = include_str!("../../../designs/small_net.yaml").to_string();
        let (from, to) = (text.find("    mesh_opening").unwrap(), text.find("    main_ropes:").unwrap());
        text.replace_range(from..to, &format!("    {RINGS}\n"));
        let mut text = text.replace("spacing: 283 mm", "spacing: 300 mm");
        if let Some(section) = section {
            text = text
                .replace("  width: 3 m\n", &format!("  section: {section}\n"))
                .replace("  wall_height: 2.5 m", "  # wall_height: 2.5 m");
        }
        let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        build(net, &design.channel, BarrierModel::SlidingRopes, 1)
    }

    /// 3 m less two gaps take ten rings across, and a bay of 0.9 m three of them: each contact is of two rings, or of one and a rope.
    #[test]
    fn every_contact_is_shared() {
        let net = built(None);
        let rings = &net.barrier.net_rings;
        assert_eq!(rings.len(), 10 * 6);
        let mut met = vec![0; net.barrier.nodes.len()];
        for node in rings.iter().flat_map(|ring| &ring.nodes) {
            met[*node as usize] += 1;
        }
        let ropes: Vec<u32> = net.barrier.segments.iter().flat_map(|segment| segment.nodes).collect();
        for (node, met) in met.into_iter().enumerate() {
            assert!(met == 2 || ropes.contains(&(node as u32)) || met == 0, "contact {node} of {met} rings");
        }
        // At rest nothing pulls, and the steel is that of the rings: 84.82 mm² round π 300 mm.
        let mut forces = vec![dem::Vec3::zeros(); net.barrier.nodes.len()];
        let stored: f64 = rings.iter().map(|ring| ring.pull(&net.barrier.nodes, &mut forces, 1e-4).stored).sum();
        assert!(stored < 1e-20, "{stored}");
        let of_one = 7850.0 * 84.823e-6 * PI * 0.3;
        let mass: f64 = net.barrier.nodes.iter().map(|node| node.mass).sum();
        let of_ropes = built(None)
            .barrier
            .segments
            .iter()
            .map(|segment| PI * segment.radius.powi(2) * segment.rest_length * 7850.0)
            .sum::<f64>();
        assert_relative_eq!(mass - of_ropes, 60.0 * of_one, max_relative = 1e-3);
    }

    /// Whatever the banks, no ring pulls while the net hangs as it is built: it would fly apart before anything comes.
    #[test]
    fn no_ring_pulls_at_rest_between_banks_of_any_slope() {
        for (bed, left, right) in
            [(2, 35, 35), (2, 40, 60), (3, 55, 55), (3, 55, 39), (2, 70, 35), (3, 60, 45), (2, 50, 65)]
        {
            let net = built(Some(&format!(
                "{{trapezoid: {{bed_width: {bed} m, left_bank: {left} deg, right_bank: {right} deg, depth: 3 m}}}}"
            )));
            let mut forces = vec![dem::Vec3::zeros(); net.barrier.nodes.len()];
            for ring in &net.barrier.net_rings {
                let stored = ring.pull(&net.barrier.nodes, &mut forces, 1e-4).stored;
                assert!(stored < 1e-20, "bed {bed} m, banks {left} and {right}: {stored} J in {ring:?}");
            }
            let lightest = net.barrier.nodes.iter().filter(|node| !node.fixed).map(|node| node.mass);
            assert!(lightest.fold(f64::INFINITY, f64::min) > 0.05, "bed {bed} m, banks {left} and {right}");
        }
    }

    #[test]
    fn rings_are_cut_to_the_banks() {
        let net = built(Some("{trapezoid: {bed_width: 2 m, left_bank: 45 deg, right_bank: 1:0.5, depth: 3 m}}"));
        let rings = &net.barrier.net_rings;
        let cut = rings.iter().filter(|ring| ring.bending == 0.0).count();
        assert!(cut > 4 && cut < rings.len() / 2, "{cut} of {}", rings.len());
        let mut forces = vec![dem::Vec3::zeros(); net.barrier.nodes.len()];
        for ring in rings {
            assert!(ring.pull(&net.barrier.nodes, &mut forces, 1e-4).stored < 1e-20);
            assert!(ring.sides().all(|[a, b]| a != b) && ring.stiffness.is_finite());
        }
        // No node hangs on nothing.
        let held = |node: u32| {
            rings.iter().any(|ring| ring.nodes.contains(&node))
                || net.barrier.segments.iter().any(|segment| segment.nodes.contains(&node))
                || net.barrier.dissipators.iter().any(|dissipator| dissipator.nodes.contains(&node))
        };
        assert!((0..net.barrier.nodes.len() as u32).all(held));
    }
}
