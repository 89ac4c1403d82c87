//! A heap at rest on a tilted floor against a rope, run on and on: nothing may creep. Places, the rope's tension, the friction
//! that contacts remember and the energy account must stand as they stood.

#![allow(clippy::print_stdout, reason = "who runs it wants to see how far it drifts")]
#![allow(clippy::field_reassign_with_default)] // a barrier is put together part by part

use barrier_check::validation::scenes::{floor, free_model};
use dem::Vec3;
use dem::contact::law::Memory;
use dem::contact::material::Material;
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::strength::Strength;
use dem::ledger::Ledger;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::barrier::Barrier;
use dem::tables::grains::{Grain, GrainBody, GrainShape};
use dem::tables::nodes::Node;

const RADIUS: f64 = 0.05;
/// Soft, so that a day takes 10⁸ steps.
const MODULUS: f64 = 4e5;
const STEP: f64 = 8e-4;

/// Three clumps on a floor of 20° that a rope across it holds back, with two more on top; the rope takes so many steps in one of the grains'.
fn heap(parts: u32) -> Simulation {
    let slope = 20_f64.to_radians();
    let clump = |id: u32, x: f64, y: f64, z: f64| {
        Grain::at(id, Vec3::new(x, y, z), Vec3::y(), GrainBody::clump(2.3 * RADIUS, 1.5, 2600.0))
    };
    let grains = vec![
        clump(0, -0.06, -0.16, 0.06),
        clump(1, -0.06, 0.0, 0.06),
        clump(2, -0.06, 0.16, 0.06),
        clump(3, -0.16, -0.08, 0.06),
        clump(4, -0.16, 0.08, 0.06),
    ];
    let mut barrier = Barrier::default();
    let nodes = 9;
    let place = |number: usize| Vec3::new(0.0, 0.5 * (number as f64 / (nodes - 1) as f64 - 0.5), 0.05);
    barrier.nodes = (0..nodes)
        .map(|number| Node {
            position: place(number),
            velocity: Vec3::zeros(),
            mass: 0.4,
            fixed: number == 0 || number == nodes - 1,
            radius: 0.0,
        })
        .collect();
    let piece = (place(1) - place(0)).norm();
    barrier.segments = (0..nodes as u32 - 1)
        .map(|first| Segment {
            nodes: [first, first + 1],
            kind: SegmentKind::Main(0),
            rest_length: piece,
            stiffness: 4e4,
            damping: 8.0,
            radius: 0.008,
            strength: Strength::default(),
        })
        .collect();
    barrier.friction = 0.4;
    barrier.contact_modulus = 4e6;
    barrier.connect();
    let material = Material::new(MODULUS, 0.3, 0.6);
    let model = Model {
        barrier: Some(barrier),
        material,
        surfaces: vec![floor(0.3)],
        gravity: Vec3::new(9.81 * libm::sin(slope), 0.0, -9.81 * libm::cos(slope)),
        ..free_model(grains, GrainShape::Clump)
    };
    let mut simulation = Simulation::new(model, STEP, 0.3 * RADIUS, 1e3);
    (simulation.barrier_substeps, simulation.barrier_step) = (parts, STEP / f64::from(parts));
    simulation.drag = 5.0;
    (0..60_000).for_each(|_| simulation.step().expect("stable"));
    simulation.drag = 0.0;
    (0..60_000).for_each(|_| simulation.step().expect("stable"));
    simulation
}

/// All that must stand: places of grains and knots (m), tensions (N), friction remembered (N) sorted by size.
fn state(simulation: &Simulation) -> [Vec<f64>; 3] {
    let mut grains = simulation.snapshot();
    grains.sort_by_key(|grain| grain.id);
    let nodes = simulation.model.barrier.iter().flat_map(|barrier| barrier.nodes.iter().map(|node| node.position));
    let places = grains.iter().map(|grain| grain.position).chain(nodes).flat_map(|place| [place.x, place.y, place.z]);
    let lists = simulation.neighbours.blocks.iter().flat_map(|block| {
        [&block.inner, &block.border, &block.surfaces, &block.ropes.list].map(|list| list.memory.iter().copied())
    });
    let friction = lists.flatten().map(|memory| Vec3::from(Memory::from_quad(memory).tangential).norm());
    let mut friction: Vec<f64> = friction.collect();
    friction.sort_by(f64::total_cmp);
    [places.collect(), simulation.sums.net.tensions.clone(), friction]
}

fn largest_change(before: &[f64], after: &[f64]) -> f64 {
    assert_eq!(before.len(), after.len());
    before.iter().zip(after).map(|(before, after)| (before - after).abs()).fold(0.0, f64::max)
}

fn nothing_creeps(steps: u64, parts: u32) {
    let mut simulation = heap(parts);
    simulation.step_and_account().expect("stable");
    let (before, opened): ([Vec<f64>; 3], Ledger) = (state(&simulation), simulation.ledger);
    let largest_tension = before[1].iter().copied().fold(0.0, f64::max);
    assert!(largest_tension > 5.0, "the rope holds nothing: {largest_tension}");
    for _ in 1..steps {
        simulation.step().expect("stable");
    }
    simulation.step_and_account().expect("stable");
    assert_eq!(simulation.barrier_substeps, parts);
    let after = state(&simulation);
    let [places, tensions, friction] = [0, 1, 2].map(|part| largest_change(&before[part], &after[part]));
    let energy = (simulation.ledger.total() - opened.total()).abs();
    println!(
        "{steps} steps: places {places:.1e} m, tensions {tensions:.1e} N, friction {friction:.1e} N, energy {energy:.1e} J"
    );
    assert!(
        places < 1e-6 && tensions < 1e-3 * largest_tension && friction < 1e-3 * largest_tension,
        "{places} {tensions} {friction}"
    );
    assert!(energy < 1e-6, "{energy}");
}

#[test]
fn a_heap_at_rest_stays_at_rest() {
    nothing_creeps(500_000, 1);
}

/// Friction springs that stick have no dashpot of their own: nor may they swing up where the rope and the grains on it take several steps in one.
#[test]
fn a_heap_at_rest_stays_at_rest_in_parts_of_a_step() {
    nothing_creeps(250_000, 4);
}

/// A day: `cargo test --release --test endurance -- --ignored --nocapture`.
#[test]
#[ignore = "takes some minutes"]
fn a_heap_at_rest_stays_at_rest_for_a_day() {
    nothing_creeps((24.0 * 3600.0 / STEP) as u64, 1);
}
