//! D28: chains of rings, and one ring between four others, pulled until they break.

use crate::ring_law::{RingLaw, Wires, chain_of, mass};
use crate::validation::barrier::stand::{DENSITY, Stand};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use dem::Vec3;
use dem::elements::net_ring::{NetRing, RingStrength};
use dem::tables::barrier::Barrier;
use dem::tables::nodes::Node;

pub const CASE: Case = Case {
    id: "D28",
    suite: Suite::Net,
    title: "Chains of three rings of 300 mm with 5 to 19 windings of 3 mm pulled to break, and a ring between four others",
    source: "break 45.0, 69.7, 81.9, 110.9, 178 and 209 kN with 5, 7, 9, 12, 16 and 19 windings; elongation then, of 0.9 m, as means of the two \
             versions of the file 527, 522, 505, 507, 497 and 472 mm (19: one version); share of its wires' strength that a ring between four \
             others uses, 0.551, 0.554 and 0.559 with 5, 7 and 9 (Guo 2022, Zenodo 6482654)",
    tier: Tier::Published,
    weakness: "fitted on 7 and 12 windings, the others are predicted; where bending ends is a share of force and elongation that the same \
               source states for all; pulled slowly",
    cost: Cost::Quick,
    run: chains,
};

const DIAMETER: f64 = 0.3;
/// Windings, break (N) and elongation (m) of the tests.
const TESTS: [(u32, f64, f64); 6] = [
    (5, 45.0e3, 0.527),
    (7, 69.7e3, 0.522),
    (9, 81.9e3, 0.505),
    (12, 110.9e3, 0.507),
    (16, 178.0e3, 0.4965),
    (19, 209.4e3, 0.472),
];
/// Windings, and share of the wires' strength that the middle one of five rings used.
const FIVE: [(u32, f64); 3] = [(5, 0.551), (7, 0.554), (9, 0.559)];
/// How fast a grip is drawn (m/s), and the step (s).
const SPEED: f64 = 0.2;
const STEP: f64 = 2e-5;
/// Viscous slowing of the contacts (1/s).
const SLOWING: f64 = 50.0;

fn wires(windings: u32) -> Wires {
    Wires { windings, diameter: 3e-3, strength: 1.77e9 }
}

pub(super) fn contact(position: Vec3, fixed: bool) -> Node {
    Node { position, velocity: Vec3::zeros(), mass: 0.0, fixed, radius: 0.006 }
}

/// Adds a ring through some contacts, which breaks as a chain of it does.
pub(super) fn add_ring(barrier: &mut Barrier, nodes: &[u32], wires: &Wires, diameter: f64, breaks: bool) {
    let chain = chain_of(wires);
    let law = RingLaw::of(&chain, diameter);
    let leg = 0.5 * chain[1][1];
    for node in nodes {
        barrier.nodes[*node as usize].mass += mass(wires, diameter, DENSITY) / nodes.len() as f64;
    }
    let next = nodes.iter().cycle().skip(1);
    barrier.net_rings.push(NetRing {
        taut_from: law.taut_from,
        stiffness: law.stiffness,
        damping: 0.0,
        bending: law.bending,
        diameter,
        radius: 0.5 * wires.bundle(),
        touched: nodes.iter().zip(next).map(|(a, b)| [*a, *b]).collect(),
        // What a ring of four contacts holds at the least is not asked here.
        strength: RingStrength { in_chain: leg, in_net: 10.0 * leg, breaks, broken: false },
        nodes: nodes.to_vec(),
    });
}

/// What was seen while the grips were drawn apart.
struct Pulled {
    /// Elongation of the whole (m) and force on the first grip (N), step by step, up to the break.
    curve: Vec<[f64; 2]>,
    /// Tension of the last ring at the break, without what bends it (N).
    leg: f64,
}

/// Draws each of the `grips` outwards from the origin until a ring breaks.
fn pull(barrier: Barrier, grips: &[usize]) -> Result<Pulled, Broken> {
    let mut stand = Stand::new(barrier, STEP);
    let directions: Vec<Vec3> = grips.iter().map(|&grip| stand.barrier.nodes[grip].position.normalize()).collect();
    let (mut curve, mut drawn) = (Vec::new(), 0.0);
    let last = stand.barrier.net_rings.len() - 1;
    let mut leg = 0.0;
    while stand.barrier.net_rings.iter().all(|ring| !ring.strength.broken) {
        for (&grip, direction) in grips.iter().zip(&directions) {
            stand.barrier.nodes[grip].position += direction * (SPEED * STEP);
        }
        drawn += SPEED * STEP;
        if drawn > DIAMETER {
            return Err(Broken::Scene("no ring broke".into()));
        }
        stand.step();
        stand.barrier.nodes.iter_mut().for_each(|node| node.velocity *= 1.0 - SLOWING * STEP);
        if stand.barrier.net_rings.iter().all(|ring| !ring.strength.broken) {
            curve.push([2.0 * drawn, -stand.net.forces[grips[0]].dot(&directions[0])]);
            let ring = &stand.barrier.net_rings[last];
            // Its tension, without what bending adds.
            let way: f64 = ring
                .sides()
                .map(|[a, b]| {
                    (stand.barrier.nodes[b as usize].position - stand.barrier.nodes[a as usize].position).norm()
                })
                .sum();
            leg = ring.stiffness * (way - ring.taut_from).max(0.0);
        }
    }
    Ok(Pulled { curve, leg })
}

/// Three rings in a row between two grips.
fn chain(windings: u32) -> Result<Pulled, Broken> {
    let mut barrier = Barrier::default();
    for number in 0..4 {
        let place = Vec3::x() * (DIAMETER * (f64::from(number) - 1.5));
        barrier.nodes.push(contact(place, number == 0 || number == 3));
    }
    for number in 0..3 {
        add_ring(&mut barrier, &[number, number + 1], &wires(windings), DIAMETER, true);
    }
    pull(barrier, &[0, 3])
}

/// One ring between four others, each of which hangs on a grip.
fn cross(windings: u32) -> Result<Pulled, Broken> {
    let mut barrier = Barrier::default();
    let outwards = [Vec3::x(), Vec3::y(), -Vec3::x(), -Vec3::y()];
    for fixed in [false, true] {
        let place = if fixed { 1.5 * DIAMETER } else { 0.5 * DIAMETER };
        barrier.nodes.extend(outwards.map(|direction| contact(direction * place, fixed)));
    }
    for arm in 0..4 {
        add_ring(&mut barrier, &[arm, arm + 4], &wires(windings), DIAMETER, true);
    }
    add_ring(&mut barrier, &[0, 1, 2, 3], &wires(windings), DIAMETER, true);
    pull(barrier, &[4, 5, 6, 7])
}

/// Where the curve turns steep: elongation and force at the largest rise of its slope over a hundredth of it.
fn knee(curve: &[[f64; 2]]) -> [f64; 2] {
    let span = curve.len() / 100;
    let slope = |from: usize| (curve[from + span][1] - curve[from][1]) / (curve[from + span][0] - curve[from][0]);
    let rise = |at: usize| slope(at) - slope(at - span);
    let at = (span..curve.len() - span).max_by(|a, b| rise(*a).total_cmp(&rise(*b))).unwrap_or(span);
    curve[at]
}

fn chains() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for (windings, force, elongation) in TESTS {
        let Pulled { curve, .. } = chain(windings)?;
        let [longest, strongest] = *curve.last().ok_or_else(|| Broken::Scene("nothing was seen".into()))?;
        findings.push(Finding::near(
            format!("break with {windings} windings (kN)"),
            strongest * 1e-3,
            force * 1e-3,
            0.15,
        ));
        findings.push(Finding::near(
            format!("elongation then with {windings} windings (mm)"),
            longest * 1e3,
            elongation * 1e3,
            0.1,
        ));
        let [bent, gentle] = knee(&curve);
        findings.push(Finding::near(
            format!("elongation where bending ends with {windings} windings, over that of the test's break"),
            bent / elongation,
            0.85,
            0.1,
        ));
        findings.push(Finding::near(
            format!("force where bending ends with {windings} windings, over that of the test's break"),
            gentle / force,
            0.15,
            0.15,
        ));
    }
    for (windings, used) in FIVE {
        let leg = cross(windings)?.leg / wires(windings).breaking_load();
        findings.push(Finding::near(
            format!("share of its wires that the ring between four others uses when one of these breaks, with {windings} windings"),
            leg,
            used,
            0.15,
        ));
    }
    Ok(findings)
}
