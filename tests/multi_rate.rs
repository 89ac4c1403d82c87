//! The barrier and the grains at it in several steps of theirs within one of the other grains'.

#![allow(clippy::field_reassign_with_default)] // a barrier is put together part by part

mod parts;

use approx::assert_relative_eq;
use barrier_check::validation::scenes::{ball, free_model, material};
use dem::Vec3;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::barrier::Barrier;
use dem::tables::grains::{Grain, GrainBody, GrainShape};
use parts::{node, segment};

/// Longest step of the barrier (s).
const BARRIER_STEP: f64 = 4e-5;
const RADIUS: f64 = 0.1;
const NODES_ON_SIDE: u32 = 7;
/// m
const MESH: f64 = 0.12;
const GRAVITY: f64 = 9.81;
/// Of time, over which pushes are averaged: what a touch begins with hangs on where it falls in a step (s).
const WINDOW: f64 = 24.0 * BARRIER_STEP;
/// m/s
const SPEED: f64 = 5.0;

/// A square net of ropes in the plane z = 0, held at its border, with nodes of a mass (kg).
fn net(mass: f64) -> Barrier {
    let mut barrier = Barrier::default();
    barrier.contact_modulus = 4e8;
    barrier.friction = 0.3;
    let side = NODES_ON_SIDE;
    let middle = MESH * f64::from(side - 1) / 2.0;
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let border = [i, j].iter().any(|&at| at == 0 || at == side - 1);
        let position = Vec3::new(f64::from(i) * MESH - middle, f64::from(j) * MESH - middle, 0.0);
        barrier.nodes.push(node(position, mass, border));
        let here = i * side + j;
        if i > 0 {
            barrier.segments.push(segment([here - side, here], MESH, 60.0));
        }
        if j > 0 {
            barrier.segments.push(segment([here - 1, here], MESH, 60.0));
        }
    }
    barrier.connect();
    barrier
}

const LIGHT: f64 = 0.2;

/// Grains above a net of light nodes, which take so many steps of the barrier in one of theirs.
fn above_the_net(grains: Vec<Grain>, shape: GrainShape, gravity: f64, parts: u32) -> Simulation {
    let mut model = Model { barrier: Some(net(LIGHT)), gravity: Vec3::z() * -gravity, ..free_model(grains, shape) };
    model.material.modulus = 2e7;
    model.material.restitution = material(0.3, 0.5).restitution;
    let mut simulation = Simulation::new(model, BARRIER_STEP * f64::from(parts), 0.02, 1e3);
    simulation.barrier_substeps = parts;
    simulation.barrier_step = BARRIER_STEP;
    simulation
}

/// A grain on the net's middle, and one on top of it, just apart.
fn stacked(shape: GrainShape) -> Vec<Grain> {
    let body = match shape {
        GrainShape::Sphere => GrainBody::sphere(RADIUS, 2600.0),
        GrainShape::Clump => GrainBody::clump(2.0 * RADIUS, 1.5, 2600.0),
    };
    let lying = |id: u32, height: f64| Grain::at(id, Vec3::new(0.013, 0.021, height), Vec3::x(), body);
    vec![lying(0, 1.2 * RADIUS), lying(1, 3.25 * RADIUS)]
}

#[test]
fn what_no_rope_touches_moves_to_the_last_bit_as_by_the_leapfrog() {
    let at_the_end = |parts: u32| {
        let far = Vec3::z() * 5.0;
        let mut grains = vec![ball(0, far, RADIUS, 2600.0), ball(1, far + Vec3::x() * 0.25, RADIUS, 2600.0)];
        grains[0].velocity = Vec3::new(2.0, 0.3, 0.0);
        let mut simulation = above_the_net(grains, GrainShape::Sphere, GRAVITY, 6);
        // Which are slow enough for the whole step.
        simulation.model.barrier = Some(net(500.0 * LIGHT));
        simulation.barrier_substeps = parts;
        (0..500).for_each(|_| simulation.step().expect("stable"));
        simulation.snapshot()
    };
    assert_eq!(at_the_end(6), at_the_end(1));
}

/// Its weight as an impulse at the start of each step would shake it at g Δt/2.
#[test]
fn a_grain_that_lies_in_a_mesh_is_at_rest_in_every_part() {
    let middle_of_a_mesh = Vec3::new(0.5, 0.5, 0.0) * MESH + Vec3::z() * RADIUS;
    let grain = ball(0, middle_of_a_mesh, RADIUS, 2600.0);
    let weight = GRAVITY * grain.body.mass;
    let mut simulation = above_the_net(vec![grain], GrainShape::Sphere, GRAVITY, 6);
    simulation.drag = 100.0;
    (0..40_000).for_each(|_| simulation.step().expect("stable"));
    assert_eq!(simulation.barrier_substeps, 6);
    let [faster, _] = simulation.grains.ahead[0];
    let (speed, shaken) = (simulation.grains.motion[0].vector().norm(), GRAVITY * simulation.time_step);
    assert!(speed < 0.5 * shaken, "it moves at {speed} m/s");
    assert!(faster.norm() < 0.01 * shaken, "it is faster by {} m/s", faster.norm());
    // The net still swings.
    assert_relative_eq!(-simulation.sums.net.from_grains.z, weight, max_relative = 0.05);
    for net in simulation.sums.net_in_substeps() {
        assert_relative_eq!(net.from_grains.z, simulation.sums.net.from_grains.z, max_relative = 1e-3);
    }
}

/// Two grains one after the other into the net: they come back as they do where all takes the step of the barrier.
#[test]
fn grains_come_back_from_a_net_in_six_parts_of_a_step_as_in_six_steps() {
    for shape in [GrainShape::Sphere, GrainShape::Clump] {
        let thrown = |parts: u32| {
            let mut grains = stacked(shape);
            grains.iter_mut().for_each(|grain| grain.velocity = Vec3::new(0.5, 0.0, -SPEED));
            let mut simulation = above_the_net(grains, shape, 0.0, parts);
            simulation.step_and_account().expect("stable");
            let start = simulation.ledger;
            let (mut worst, mut largest, mut pushed, mut window): (f64, f64, f64, f64) = (0.0, 0.0, 0.0, WINDOW);
            while simulation.time < 0.25 {
                simulation.step_and_account().expect("stable");
                worst = worst.max(simulation.ledger.relative_error(&start).abs());
                pushed -= simulation.sums.net.from_grains.z / (WINDOW / simulation.time_step);
                if simulation.time > window {
                    largest = largest.max(std::mem::take(&mut pushed));
                    window += WINDOW;
                }
            }
            assert_eq!(simulation.barrier_substeps, parts);
            let grains = simulation.snapshot();
            let mass: f64 = grains.iter().map(|grain| grain.body.mass).sum();
            let momentum: f64 = grains.iter().map(|grain| grain.body.mass * grain.velocity.z).sum();
            let lost = simulation.ledger.dissipated();
            [momentum + mass * SPEED, largest, lost, worst]
        };
        let [[impulse, largest, lost, worst], fine] = [6, 1].map(thrown);
        assert!(lost > 0.0);
        assert_relative_eq!(impulse, fine[0], max_relative = 0.005);
        assert_relative_eq!(largest, fine[1], max_relative = 0.02);
        assert_relative_eq!(lost, fine[2], max_relative = 0.01);
        assert!(worst < 3e-4 && fine[3] < 3e-4, "{shape:?}: the account is off by {worst} and {}", fine[3]);
    }
}
