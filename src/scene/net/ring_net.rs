//! Builds the rings of a ring net: each hangs in the contacts round its centre, and shares each of them with one other ring, or with a rope.
//!
//! In a surveyed section the rings along the edge are cut to it: such a ring runs along the edge between the places where the mesh of
//! contacts meets it, and is as much smaller. What is cut has no stiffness of bending.

use crate::design::NetRings;
use crate::lattice::Place;
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
        let (lattice, columns) = (self.grid.lattice, self.grid.columns);
        for row in 0..self.grid.row_heights.len() {
            for column in (0..=columns).filter(|column| lattice.has_centre((*column, row))) {
                let contacts = self.contacts_of_ring((column, row));
                if contacts.len() > 1 {
                    self.add_net_ring(rings, &contacts, row);
                }
            }
        }
    }

    /// Contacts of the ring round a place, in their order.
    fn contacts_of_ring(&self, centre: Place) -> Vec<Contact> {
        let corners = self.grid.lattice.corners();
        let mut contacts: Vec<Contact> = Vec::new();
        // Half of a ring between side walls hangs on the lateral rope by its middle.
        let mut middle = self.knots.get(&centre).map(|&node| (node, true));
        for (number, here) in corners.iter().enumerate() {
            let next = corners[(number + 1) % corners.len()];
            let places = [*here, next].map(|corner| self.grid.from(centre, corner));
            let knots = places.map(|place| place.and_then(|place| self.knots.get(&place)).copied());
            contacts.extend(knots[0].map(|node| (node, false)));
            let way = (next.0 - here.0, next.1 - here.1);
            let cut = match (knots, places) {
                ([Some(_), None], [Some(from), _]) => self.cut_sides.get(&(from, way)),
                ([None, Some(_)], [_, Some(from)]) => self.cut_sides.get(&(from, (-way.0, -way.1))),
                _ => continue,
            };
            contacts.extend(cut.map(|&node| (node, true)).or_else(|| middle.take()));
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
        let corners = self.grid.lattice.corners();
        let whole = contacts.iter().all(|(_, on_edge)| !on_edge) && count == corners.len();
        // The lattice is stretched a little to fit between the ropes, and its rings with it.
        let across = (self.across(2) - self.across(0)) / 2.0;
        let up = (self.grid.row_heights[row + 1] - self.grid.row_heights[row - 1]) / 2.0;
        let next = corners[1..].iter().chain(&corners[..1]);
        let sides = corners.iter().zip(next).map(|(here, next)| [next.0 - here.0, next.1 - here.1].map(f64::from));
        let fitted: f64 = sides.map(|[by, to]| libm::hypot(by * across, to * up)).sum();
        let stretched = (fitted / (corners.len() as f64 * self.grid.lattice.side())).max(1.0);
        let widest = corners.iter().map(|(by, to)| 2.0 * libm::hypot(f64::from(*by) * across, f64::from(*to) * up));
        let diameter = widest.fold(rings.diameter, f64::max);
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
            damping: ROPE_DAMPING_RATIO * critical_damping(stiffness, mass, corners.len() as f64),
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

/// Of a ring of n contacts that breathes: all move out by u, the way grows by 2 n s u, s = sin(π/n), and ½ k (2 n s u)² = ½ (4 n² s² k) u²
/// (N s/m).
fn critical_damping(stiffness: f64, mass: f64, contacts: f64) -> f64 {
    let way = 2.0 * contacts * libm::sin(std::f64::consts::PI / contacts);
    2.0 * (stiffness * mass).sqrt() / way
}

#[cfg(test)]
mod tests {
    use crate::design::read::read_design;
    use crate::design::{BarrierDesign, BarrierModel};
    use crate::scene::net::build::{BuiltNet, build};
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    const RINGS: &str = "net: {rings: {diameter: 300 mm, windings: 12, wire_diameter: 3 mm, wire_strength: 1770 MPa}}";

    const SIX: &str = ", contacts: 6}}";

    fn built(section: Option<&str>) -> BuiltNet {
        built_of(section, RINGS, "300 mm")
    }

    /// Rings of six contacts, 288 mm apart: a bay of 0.9 m takes four rows of 249 mm, pressed together by a tenth.
    fn built_of_six(section: Option<&str>) -> BuiltNet {
        built_of(section, &RINGS.replace("}}", SIX), "144 mm")
    }

    fn built_of(section: Option<&str>, rings: &str, spacing: &str) -> BuiltNet {
        let mut text = include_str!("../../../designs/small_net.yaml").to_string();
        let (from, to) = (text.find("    mesh_opening").unwrap(), text.find("    main_ropes:").unwrap());
        text.replace_range(from..to, &format!("    {rings}\n"));
        let mut text = text.replace("spacing: 283 mm", &format!("spacing: {spacing}"));
        if let Some(section) = section {
            text = text
                .replace("  width: 3 m\n", &format!("  section: {section}\n"))
                .replace("  wall_height: 2.5 m", "  # wall_height: 2.5 m");
        }
        let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        build(net, &design.channel, BarrierModel::SlidingRopes, 1)
    }

    /// Each contact is of two rings, or of one and a rope.
    fn contacts_are_shared(net: &BuiltNet) {
        let mut met = vec![0; net.barrier.nodes.len()];
        for node in net.barrier.net_rings.iter().flat_map(|ring| &ring.nodes) {
            met[*node as usize] += 1;
        }
        let ropes: Vec<u32> = net.barrier.segments.iter().flat_map(|segment| segment.nodes).collect();
        for (node, met) in met.into_iter().enumerate() {
            assert!(met == 2 || ropes.contains(&(node as u32)) || met == 0, "contact {node} of {met} rings");
        }
    }

    /// 3 m less two gaps take ten rings across, and a bay of 0.9 m three of them: each contact is of two rings, or of one and a rope.
    #[test]
    fn every_contact_is_shared() {
        let net = built(None);
        let rings = &net.barrier.net_rings;
        assert_eq!(rings.len(), 10 * 6);
        contacts_are_shared(&net);
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

    /// 2.86 m take ten rings of six contacts across and a bay of 0.9 m four rows of them. Every second row has nine whole ones and a half at
    /// either side.
    #[test]
    fn every_contact_of_six_is_shared() {
        let net = built_of_six(None);
        let rings = &net.barrier.net_rings;
        let [whole, half] =
            [true, false].map(|whole| rings.iter().filter(|ring| (ring.bending > 0.0) == whole).count());
        assert_eq!((whole, half), (4 * 10 + 4 * 9, 4 * 2));
        assert!(rings.iter().all(|ring| ring.nodes.len() == if ring.bending > 0.0 { 6 } else { 4 }));
        contacts_are_shared(&net);
        let mut forces = vec![dem::Vec3::zeros(); net.barrier.nodes.len()];
        let stored: f64 = rings.iter().map(|ring| ring.pull(&net.barrier.nodes, &mut forces, 1e-4).stored).sum();
        assert!(stored < 1e-20, "{stored}");
        // Every ring hangs as a regular hexagon but for the little by which it is fitted.
        for ring in rings.iter().filter(|ring| ring.bending > 0.0) {
            for [a, b] in ring.sides() {
                let side = (net.barrier.nodes[a as usize].position - net.barrier.nodes[b as usize].position).norm();
                assert_relative_eq!(side, 0.144, max_relative = 0.1);
            }
        }
    }

    /// Whatever the banks, no ring pulls while the net hangs as it is built: it would fly apart before anything comes.
    #[test]
    fn no_ring_pulls_at_rest_between_banks_of_any_slope() {
        for (bed, left, right) in
            [(2, 35, 35), (2, 40, 60), (3, 55, 55), (3, 55, 39), (2, 70, 35), (3, 60, 45), (2, 50, 65)]
        {
            let section = format!(
                "{{trapezoid: {{bed_width: {bed} m, left_bank: {left} deg, right_bank: {right} deg, depth: 3 m}}}}"
            );
            for net in [built(Some(&section)), built_of_six(Some(&section))] {
                let mut forces = vec![dem::Vec3::zeros(); net.barrier.nodes.len()];
                for ring in &net.barrier.net_rings {
                    let stored = ring.pull(&net.barrier.nodes, &mut forces, 1e-4).stored;
                    assert!(stored < 1e-20, "bed {bed} m, banks {left} and {right}: {stored} J in {ring:?}");
                }
                let lightest = net.barrier.nodes.iter().filter(|node| !node.fixed).map(|node| node.mass);
                assert!(lightest.fold(f64::INFINITY, f64::min) > 0.05, "bed {bed} m, banks {left} and {right}");
            }
        }
    }

    #[test]
    fn rings_are_cut_to_the_banks() {
        let section = Some("{trapezoid: {bed_width: 2 m, left_bank: 45 deg, right_bank: 1:0.5, depth: 3 m}}");
        for net in [built(section), built_of_six(section)] {
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
}
