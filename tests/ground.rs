//! A barrier that lies on the bed: weight, sliding with friction, and the energy account.

use approx::assert_relative_eq;
use barrier_check::validation::scenes::free_model;
use dem::Vec3;
use dem::elements::ground::{Ground, Plane};
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::strength::Strength;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::barrier::Barrier;
use dem::tables::grains::GrainShape;
use dem::tables::nodes::Node;

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.008;
const FRICTION: f64 = 0.4;

/// A piece of rope with its two knots at a height over the bed, in a channel 4 m wide.
fn rope(height: f64, speed: f64, slope: f64) -> Simulation {
    let node = |across: f64| Node {
        position: Vec3::new(0.0, across, height),
        velocity: Vec3::new(speed, 0.0, 0.0),

        mass: 1.0,
        fixed: false,
        radius: 0.0,
    };
    let segment = Segment {
        nodes: [0, 1],
        kind: SegmentKind::Net,
        rest_length: 0.3,
        stiffness: 2e6,
        damping: 100.0,
        radius: RADIUS,
        strength: Strength::default(),
    };
    let mut barrier = Barrier { nodes: vec![node(1.0), node(1.3)], segments: vec![segment], ..Barrier::default() };
    barrier.connect();
    let plane = |origin, normal| Plane { origin, normal, top: 5.0, friction: FRICTION };
    let (y, z) = (Vec3::y(), Vec3::z());
    let planes = [plane(Vec3::zeros(), z), plane(Vec3::zeros(), y), plane(y * 4.0, -y)];
    barrier.ground = Some(Ground::under(&barrier.nodes, planes, [1e8, 4e9]));
    let gravity = Vec3::new(GRAVITY * libm::sin(slope), 0.0, -GRAVITY * libm::cos(slope));
    let model = Model { barrier: Some(barrier), gravity, ..free_model(Vec::new(), GrainShape::Sphere) };
    let mut simulation = Simulation::new(model, 2e-5, 0.1, 1e3);
    simulation.start_account();
    simulation
}

fn knot(simulation: &Simulation) -> &Node {
    &simulation.model.barrier.as_ref().expect("a barrier").nodes[0]
}

#[test]
fn a_rope_on_a_slope_slides_as_a_block_does_and_stands_where_friction_holds_it() {
    for (slope, expected) in
        [(30_f64, GRAVITY * (libm::sin(30_f64.to_radians()) - FRICTION * libm::cos(30_f64.to_radians()))), (15.0, 0.0)]
    {
        let mut simulation = rope(RADIUS, 0.0, slope.to_radians());
        let (settled, time) = (10_000, 50_000);
        let mut first = 0.0;
        for step in 0..settled + time {
            if step == settled {
                first = knot(&simulation).velocity.x;
            }
            simulation.step().expect("stable");
        }
        let gained = (knot(&simulation).velocity.x - first) / (f64::from(time) * simulation.time_step);
        assert!((gained - expected).abs() < 1e-4 * GRAVITY, "{slope}°: {gained} against {expected}");
    }
}

#[test]
fn a_rope_thrown_on_the_bed_comes_to_rest_on_it_and_its_energy_is_accounted_for() {
    let mut simulation = rope(0.3, 2.0, 0.0);
    simulation.step_and_account().expect("stable");
    let start = simulation.ledger;
    for _ in 0..100_000 {
        simulation.step().expect("stable");
    }
    simulation.step_and_account().expect("stable");
    assert!(simulation.ledger.relative_error(&start).abs() < 1e-4, "{}", simulation.ledger.relative_error(&start));
    let ground = simulation.model.barrier.as_ref().and_then(|barrier| barrier.ground.clone()).expect("a ground");
    let stiffness = ground.spring(knot(&simulation)).stiffness;
    // Friction springs have no dashpot: within what friction holds, it may swing on them.
    let swing = FRICTION * GRAVITY * (3.5 / stiffness).sqrt();
    assert!(knot(&simulation).velocity.norm() < swing, "it moves still");
    // It carries its weight: k u = m g.
    let sunk = RADIUS - knot(&simulation).position.z;
    assert_relative_eq!(stiffness * sunk, GRAVITY, max_relative = 1e-3);
}

#[test]
fn a_rope_pushed_against_a_side_wall_stays_in_the_channel() {
    let mut simulation = rope(0.5, 0.0, 0.0);
    simulation.model.gravity = Vec3::new(0.0, GRAVITY, 0.0);
    for _ in 0..150_000 {
        simulation.step().expect("stable");
    }
    let outer = simulation.model.barrier.as_ref().expect("a barrier").nodes.iter().map(|node| node.position.y);
    let furthest = outer.fold(0.0, f64::max);
    assert!((furthest - (4.0 - RADIUS)).abs() < 1e-3, "{furthest}");
}
