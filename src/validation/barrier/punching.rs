//! D27: a net panel in a frame, pushed through its middle.

use crate::dem::Vec3;
use crate::dem::elements::strength::Strength;
use crate::dem::model::Model;
use crate::dem::simulation::{Simulation, Unstable};
use crate::dem::tables::barrier::{Barrier, Node, Segment, SegmentKind};
use crate::dem::tables::grains::GrainShape;
use crate::validation::barrier::stand::DENSITY;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{ball, free_model};

pub const CASE: Case = Case {
    id: "D27",
    suite: Suite::Net,
    title: "A net panel of 3 m × 3 m with squares of 300 mm, pushed through by a body of 680 mm",
    source: "36.5 kN at 225 mm, slack up to 150 mm (Bonati & Galimberti 2004, quoted by Albaba 2015, section 4.4.1)",
    tier: Tier::SecondHand,
    weakness: "the body is a sphere, the experiment's a cone; slack and stiffness are both fitted to the two numbers that are quoted, and \
               where slack ends is a matter of reading the curve; ropes that only pull",
    cost: Cost::Quick,
    run: punching,
};

/// Half the side of the panel, and the side of its squares (m).
const HALF: f64 = 1.5;
const MESH: f64 = 0.3;
const ROPE_RADIUS: f64 = 0.005;
const BODY_RADIUS: f64 = 0.34;
/// Displacements at which the net becomes taut and at which it fails (m), and the force then (N).
const TAUT: f64 = 0.150;
const FAILS: f64 = 0.225;
const FORCE: f64 = 36.5e3;
/// The thesis's modulus of the net (Pa).
const MODULUS: f64 = 4e9;
/// Speed of the push (m/s), and its step (s).
const SPEED: f64 = 0.2;
const STEP: f64 = 4e-5;
/// Viscous slowing of the net's nodes (1/s): less than 20 N in all.
const SLOWING: f64 = 10.0;
/// Forces at which the net may count as taut, over that at which it fails: the curve rises by and by.
const TOUCHED: [f64; 2] = [0.01, 0.05];

fn area() -> f64 {
    std::f64::consts::PI * ROPE_RADIUS * ROPE_RADIUS
}

/// The panel in the plane z = 0; nodes on the frame are fixed. Rest lengths are (1 + `slack`) of the squares' sides.
fn panel(axial: f64, slack: f64) -> Barrier {
    let halves = (HALF / (MESH * std::f64::consts::FRAC_1_SQRT_2)).round() as i32;
    let spacing = HALF / f64::from(halves);
    let mut barrier = Barrier { friction: 0.3, contact_modulus: MODULUS, ..Barrier::default() };
    let mut numbers = std::collections::BTreeMap::new();
    for column in -halves..=halves {
        for row in (-halves..=halves).filter(|row| (row + column) % 2 == 0) {
            let fixed = column.abs() == halves || row.abs() == halves;
            numbers.insert((column, row), barrier.nodes.len() as u32);
            barrier.nodes.push(Node {
                position: Vec3::new(f64::from(column), f64::from(row), 0.0) * spacing,
                velocity: Vec3::zeros(),
                pace: Vec3::zeros(),
                mass: 0.0,
                fixed,
                radius: ROPE_RADIUS,
                lines: Vec::new(),
            });
        }
    }
    let side = spacing * std::f64::consts::SQRT_2;
    for (&(column, row), &node) in &numbers {
        for other in [(column + 1, row + 1), (column + 1, row - 1)] {
            let Some(&other) = numbers.get(&other) else { continue };
            let rest_length = side * (1.0 + slack);
            let half_mass = 0.5 * DENSITY * area() * side;
            let stiffness = axial / rest_length;
            barrier.segments.push(Segment {
                nodes: [node, other],
                kind: SegmentKind::Net,
                rest_length,
                stiffness,
                damping: 0.4 * (stiffness * half_mass).sqrt(),
                radius: ROPE_RADIUS,
                strength: Strength::default(),
            });
            for node in [node, other] {
                barrier.nodes[node as usize].mass += half_mass;
            }
        }
    }
    barrier.connect();
    barrier
}

/// Force (N) on the body, as a mean over the last millimetre, at each of the displacements (m), rising.
fn push(axial: f64, slack: f64, at: &[f64]) -> Result<Vec<f64>, Unstable> {
    let mut body = ball(0, Vec3::new(0.0, 0.0, BODY_RADIUS + ROPE_RADIUS), BODY_RADIUS, 1e12);
    body.velocity.z = -SPEED;
    let model = Model { barrier: Some(panel(axial, slack)), ..free_model(vec![body], GrainShape::Sphere) };
    let mut simulation = Simulation::new(model, STEP, 0.05, 1e3);
    let start = simulation.grains.place[0].0[2];
    let mut forces = Vec::new();
    for &displacement in at {
        let (mut sum, mut steps) = (0.0, 0);
        while start - simulation.grains.place[0].0[2] < displacement {
            simulation.step()?;
            // The net is light; what is left of its swinging is slowed.
            let barrier = simulation.model.barrier.as_mut();
            barrier
                .into_iter()
                .flat_map(|barrier| &mut barrier.nodes)
                .for_each(|node| node.velocity *= 1.0 - SLOWING * STEP);
            if start - simulation.grains.place[0].0[2] > displacement - 1e-3 {
                (sum, steps) = (sum - simulation.sums.net.from_grains.z, steps + 1);
            }
        }
        forces.push(sum / f64::from(steps.max(1)));
    }
    Ok(forces)
}

/// The value between `low` and `high` at which the rising `of` reaches `target`.
fn solve(mut low: f64, mut high: f64, target: f64, of: impl Fn(f64) -> Result<f64, Unstable>) -> Result<f64, Unstable> {
    for _ in 0..9 {
        let middle = 0.5 * (low + high);
        if of(middle)? < target { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

/// Slack and EA (N) that meet both quoted numbers if the net counts as taut at the given share of the force.
fn fitted(touched: f64) -> Result<[f64; 2], Unstable> {
    let (mut slack, mut axial) = (0.0, 5e6);
    // Each depends a little on the other.
    for _ in 0..3 {
        // Less slack makes it taut earlier.
        slack = -solve(-0.02, 0.0, touched * FORCE, |less| Ok(push(axial, -less, &[TAUT])?[0]))?;
        axial = solve(1e6, 2e7, FORCE, |axial| Ok(push(axial, slack, &[FAILS])?[0]))?;
    }
    Ok([slack, axial])
}

fn punching() -> Result<Vec<Finding>, Broken> {
    let thesis = push(MODULUS * area(), 0.0, &[TAUT, FAILS])?;
    let [early, late] = [fitted(TOUCHED[0])?, fitted(TOUCHED[1])?];
    let between = push(late[1], late[0], &[0.1, 0.5 * (TAUT + FAILS), FAILS])?;
    Ok(vec![
        Finding::told("force at 225 mm, fitted (kN)", between[2] * 1e-3),
        Finding::between("force half-way from taut to failure, over that at failure", between[1] / FORCE, 0.1, 0.5),
        Finding::told("force at 100 mm (kN)", between[0] * 1e-3),
        Finding::told("EA if taut means 1 % of the force (MN); an independent truss gave 4.4 to 6", early[1] * 1e-6),
        Finding::between("EA if taut means 5 % of the force (MN)", late[1] * 1e-6, 0.8 * 4.4, 1.2 * 6.0),
        Finding::told("slack if taut means 1 % of the force (% of the length)", 100.0 * early[0]),
        Finding::told("slack if taut means 5 % of the force (% of the length)", 100.0 * late[0]),
        Finding::told("EA of 4 GPa on the full circle (MN)", MODULUS * area() * 1e-6),
        Finding::told("without slack, with 4 GPa: force at 150 mm (kN)", thesis[0] * 1e-3),
        Finding::told("without slack, with 4 GPa: force at 225 mm (kN)", thesis[1] * 1e-3),
    ])
}
