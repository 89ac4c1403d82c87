//! D29: a panel of rings and a panel of ropes, in a frame, hit by a ball at speed: the energy is accounted for.

use crate::ring_law::Wires;
use crate::validation::barrier::punching::Panel;
use crate::validation::barrier::ring_chains::{add_ring, contact};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{ball, free_model};
use dem::Vec3;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::barrier::Barrier;
use dem::tables::grains::GrainShape;

pub const CASE: Case = Case {
    id: "D29",
    suite: Suite::Net,
    title: "A panel of 3 m × 3 m of rings of 300 mm, and one of ropes in squares of 300 mm, pushed in by 0.5 m slowly and hit by a ball at 8 m/s",
    source: "Energy: what the ball loses is stored, moves, or is lost in dashpots; pushed slowly, the work of the body is the energy stored",
    tier: Tier::ClosedForm,
    weakness: "elastic rings; no panel test is compared",
    cost: Cost::Quick,
    run: panels,
};

const RADIUS: f64 = 0.34;
const DENSITY: f64 = 2600.0;
const SPEED: f64 = 8.0;
const STEP: f64 = 1e-5;
/// Speed of the slow push (m/s), how far it goes (m), and the slowing of the net meanwhile (1/s).
const SLOW: f64 = 0.5;
const DEPTH: f64 = 0.5;
const SLOWING: f64 = 5.0;

/// So many by so many rings of 12 windings in the plane z = 0; contacts on the frame are fixed.
pub fn ring_panel(across: i32) -> Barrier {
    let wires = Wires { windings: 12, diameter: 3e-3, strength: 1.77e9 };
    let diameter = 0.3;
    let mut barrier = Barrier { friction: 0.3, contact_modulus: 1e10, ..Barrier::default() };
    let mut numbers = std::collections::BTreeMap::new();
    let centre = |number: i32| (f64::from(number - across / 2) + 0.5) * diameter;
    // Contacts by twice their place in rings: right, above, left, below of a centre.
    for column in 0..across {
        for row in 0..across {
            let (x, y) = (2 * column + 1, 2 * row + 1);
            let nodes = [(x + 1, y), (x, y + 1), (x - 1, y), (x, y - 1)].map(|(i, j)| {
                *numbers.entry((i, j)).or_insert_with(|| {
                    let place = Vec3::new(
                        centre(column) + 0.5 * diameter * f64::from(i - x),
                        centre(row) + 0.5 * diameter * f64::from(j - y),
                        0.0,
                    );
                    let edge = [i, j].into_iter().any(|at| at == 0 || at == 2 * across);
                    barrier.nodes.push(contact(place, edge));
                    barrier.nodes.len() as u32 - 1
                })
            });
            add_ring(&mut barrier, &nodes, &wires, diameter, false);
        }
    }
    barrier.connect();
    barrier
}

fn rope_panel() -> Barrier {
    Panel { axial: 5e6, slack: 0.0, mesh: 0.3, pieces: 1 }.build()
}

fn hit_by(barrier: Barrier, density: f64, speed: f64) -> Simulation {
    let mut body = ball(0, Vec3::new(0.02, 0.03, RADIUS + 0.02), RADIUS, density);
    body.velocity.z = -speed;
    let model = Model { barrier: Some(barrier), ..free_model(vec![body], GrainShape::Sphere) };
    Simulation::new(model, STEP, 0.05, 1e3)
}

/// Error of the energy account over the energy of the ball, until it flies back, and the largest force on it (N).
fn thrown(barrier: Barrier) -> Result<[f64; 2], Broken> {
    let mut simulation = hit_by(barrier, DENSITY, SPEED);
    simulation.start_account();
    simulation.step_and_account()?;
    let (start, mut largest) = (simulation.ledger, 0.0_f64);
    while simulation.grains.motion[0].0[2] < 0.0 {
        simulation.step_and_account()?;
        largest = largest.max(simulation.sums.net.from_grains.norm());
        if simulation.time > 2.0 {
            return Err(Broken::Scene("the ball went through".into()));
        }
    }
    Ok([simulation.ledger.relative_error(&start), largest])
}

/// Work of a body that is pushed through slowly (J), energy that the net stores then, and the force (N).
fn pushed(barrier: Barrier) -> Result<[f64; 3], Broken> {
    let mut simulation = hit_by(barrier, 1e12, SLOW);
    simulation.start_account();
    let start = simulation.grains.place[0].0[2];
    let (mut work, mut force) = (0.0, 0.0);
    while start - simulation.grains.place[0].0[2] < DEPTH {
        simulation.step_and_account()?;
        let now = -simulation.sums.net.from_grains.z;
        work += now.max(0.0) * SLOW * STEP;
        force = now;
        let barrier = simulation.model.barrier.as_mut();
        let nodes = barrier.into_iter().flat_map(|barrier| &mut barrier.nodes);
        nodes.for_each(|node| node.velocity *= 1.0 - SLOWING * STEP);
    }
    Ok([work, simulation.ledger.stored_barrier + simulation.ledger.stored_contacts, force])
}

fn panels() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for (name, barrier) in [("rings", (|| ring_panel(10)) as fn() -> Barrier), ("ropes", rope_panel)] {
        let [error, largest] = thrown(barrier())?;
        findings.push(Finding::close(format!("energy not accounted for, {name}, over that put in"), error, 0.0, 1e-4));
        findings.push(Finding::told(format!("largest force on the ball, {name} (kN)"), largest * 1e-3));
        let [work, stored, force] = pushed(barrier())?;
        findings.push(Finding::near(
            format!("energy stored over the work of a slow push, {name}"),
            stored / work,
            1.0,
            0.1,
        ));
        findings.push(Finding::told(format!("force at 0.5 m, {name} (kN)"), force * 1e-3));
    }
    Ok(findings)
}
