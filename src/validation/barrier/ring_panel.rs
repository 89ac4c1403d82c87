//! D29: panels of rings and of ropes, in a frame, hit by a ball at speed: the energy is accounted for.

use std::collections::BTreeMap;

use crate::lattice::Lattice;
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
    title: "Panels of 3 m × 3 m of rings of 300 mm that meet four others, or six, and of ropes in squares of 300 mm, or hexagons, pushed in slowly until they push back with 100 kN, and hit by a ball at 8 m/s",
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
/// Speed of the slow push (m/s), the force at which it ends (N) and how far that is at the most (m), and the slowing of the net meanwhile
/// (1/s).
const SLOW: f64 = 0.5;
const FORCE: f64 = 100e3;
const DEPTH: f64 = 1.5;
const SLOWING: f64 = 5.0;

/// Rings of 300 mm of 12 windings in the plane z = 0, so many across and about as far up; contacts of one ring alone are fixed.
pub fn ring_panel(lattice: Lattice, across: i32) -> Barrier {
    let wires = Wires { windings: 12, diameter: 3e-3, strength: 1.77e9 };
    let mut barrier = Barrier { friction: 0.3, contact_modulus: 1e10, ..Barrier::default() };
    let ([wide, tall], [columns, rows]) = (lattice.period(), lattice.steps());
    let columns = across * columns as i32;
    let rows = rows * (f64::from(across) * wide / tall).round() as usize;
    let middle = [f64::from(columns), rows as f64].map(|count| 0.5 * count);
    let pitch = [wide / lattice.steps()[0] as f64, tall / lattice.steps()[1] as f64];
    let mut numbers = BTreeMap::new();
    let mut rings = Vec::new();
    let centres = (0..=columns).flat_map(|column| (0..=rows).map(move |row| (column, row)));
    for (column, row) in centres.filter(|place| lattice.has_centre(*place)) {
        let corners = lattice.corners().iter().map(|(by, up)| (column + by, row as i32 + up));
        let nodes: Vec<u32> = corners
            .map(|(i, j)| {
                *numbers.entry((i, j)).or_insert_with(|| {
                    let [x, y] = [(f64::from(i) - middle[0]) * pitch[0], (f64::from(j) - middle[1]) * pitch[1]];
                    barrier.nodes.push(contact(Vec3::new(x, y, 0.0), true));
                    barrier.nodes.len() as u32 - 1
                })
            })
            .collect();
        rings.push(nodes);
    }
    let mut met = vec![0; barrier.nodes.len()];
    for nodes in &rings {
        nodes.iter().for_each(|node| met[*node as usize] += 1);
        add_ring(&mut barrier, nodes, &wires, DIAMETER, false);
    }
    barrier.nodes.iter_mut().zip(met).for_each(|(node, met)| node.fixed = met == 1);
    barrier.connect();
    barrier
}

/// Rings side by side, and as close as interlinked ones of 12 windings of 3 mm stand.
pub const FOUR: Lattice = Lattice::FourContacts { spacing: DIAMETER };
pub const SIX: Lattice = Lattice::SixContacts { spacing: 0.288 };
const DIAMETER: f64 = 0.3;

const ROPES: Panel = Panel { axial: 5e6, slack: 0.0, mesh: 0.3, pieces: 1 };

type Build = fn() -> Barrier;

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

/// Work of a body that is pushed in slowly (J), energy that the net stores then, and how far it came (m).
fn pushed(barrier: Barrier) -> Result<[f64; 3], Broken> {
    let mut simulation = hit_by(barrier, 1e12, SLOW);
    simulation.start_account();
    let start = simulation.grains.place[0].0[2];
    let (mut work, mut force) = (0.0, 0.0);
    let depth = |simulation: &Simulation| start - simulation.grains.place[0].0[2];
    while force < FORCE {
        simulation.step_and_account()?;
        let now = -simulation.sums.net.from_grains.z;
        work += now.max(0.0) * SLOW * STEP;
        force = now;
        let barrier = simulation.model.barrier.as_mut();
        let nodes = barrier.into_iter().flat_map(|barrier| &mut barrier.nodes);
        nodes.for_each(|node| node.velocity *= 1.0 - SLOWING * STEP);
        if depth(&simulation) > DEPTH {
            return Err(Broken::Scene(format!("{force:.0} N after {DEPTH} m")));
        }
    }
    Ok([work, simulation.ledger.stored_barrier + simulation.ledger.stored_contacts, depth(&simulation)])
}

fn panels() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    let panels: [(&str, Build); 4] = [
        ("rings", || ring_panel(FOUR, 10)),
        ("rings of six contacts", || ring_panel(SIX, 10)),
        ("ropes", || ROPES.build()),
        ("hexagons", || ROPES.build_hexagons()),
    ];
    for (name, barrier) in panels {
        let [error, largest] = thrown(barrier())?;
        findings.push(Finding::close(format!("energy not accounted for, {name}, over that put in"), error, 0.0, 1e-4));
        findings.push(Finding::told(format!("largest force on the ball, {name} (kN)"), largest * 1e-3));
        let [work, stored, depth] = pushed(barrier())?;
        findings.push(Finding::near(
            format!("energy stored over the work of a slow push, {name}"),
            stored / work,
            1.0,
            0.1,
        ));
        findings.push(Finding::told(format!("depth at 100 kN, {name} (m)"), depth));
    }
    Ok(findings)
}
