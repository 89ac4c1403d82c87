//! Ropes, rings and dissipators against closed forms (verification cases D1, D13, D19), and the stability of
//! what cannot be stable.

#![allow(clippy::field_reassign_with_default)] // a barrier is put together part by part

mod parts;

use approx::assert_relative_eq;
use barrier_check::validation::scenes::{ball, free_model};
use dem::Vec3;
use dem::contact::law::Memory;
use dem::elements::cylinder::{Cylinder, Section};
use dem::elements::dissipator::Dissipator;
use dem::elements::ring::RingSide;
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::sliding::Chain;
use dem::elements::yield_curve::YieldCurve;
use dem::model::Model;
use dem::simulation::{Simulation, Unstable};
use dem::tables::barrier::Barrier;
use dem::tables::grains::GrainShape;
use dem::tables::nodes::{Frame, Node};
use nalgebra::UnitQuaternion;
use parts::{AXIAL_STIFFNESS, node, nodes, segment, simulate};

/// A straight rope of 15.2 m with a load in the middle sags by δ under F = 2EA(√(a²+δ²)/a − 1) δ/√(a²+δ²).
#[test]
fn a_rope_with_a_load_in_its_middle_finds_the_closed_form() {
    let (half, load) = (7.6, 7.2346e3);
    let mut barrier = Barrier::default();
    let mass = load / 9.81;
    barrier.nodes = vec![
        node(Vec3::zeros(), 1.0, true),
        node(Vec3::new(half, 0.0, 0.0), mass, false),
        node(Vec3::new(2.0 * half, 0.0, 0.0), 1.0, true),
    ];
    barrier.segments = vec![segment([0, 1], half, 2e4), segment([1, 2], half, 2e4)];
    let mut simulation = simulate(barrier, Vec3::new(0.0, 0.0, -9.81), 1e-3);
    for _ in 0..60_000 {
        simulation.step().expect("stable");
    }
    assert_relative_eq!(-nodes(&simulation)[1].position.z, 1.0, max_relative = 0.005);
}

/// 1000 kg at 10 m/s on a dissipator of 45.957 MN/m and 250 kN: 202.72 mm in all, 197.28 mm of them plastic.
#[test]
fn a_dissipator_stops_a_mass_over_its_plateau() {
    let mut barrier = Barrier::default();
    barrier.nodes = vec![node(Vec3::zeros(), 1.0, true), node(Vec3::new(1.0, 0.0, 0.0), 1000.0, false)];
    barrier.nodes[1].velocity.x = 10.0;
    barrier.dissipators = vec![Dissipator {
        nodes: [0, 1],
        kind: SegmentKind::Main(0),
        rest_length: 1.0,
        radius: 0.016,
        stiffness: 45.957e6,
        plateau: 250e3,
        curve: YieldCurve::default(),
        stroke: 2.5,
        used: 0.0,
    }];
    let mut simulation = simulate(barrier, Vec3::zeros(), 1e-6);
    let mut furthest: f64 = 0.0;
    for _ in 0..60_000 {
        simulation.step().expect("stable");
        furthest = furthest.max(nodes(&simulation)[1].position.x - 1.0);
    }
    let used = simulation.model.barrier.as_ref().expect("a barrier").dissipators[0].used;
    assert_relative_eq!(furthest, 0.20272, max_relative = 0.005);
    assert_relative_eq!(used, 0.19728, max_relative = 0.005);
    assert_relative_eq!(simulation.ledger.lost_dissipators, 250e3 * used, max_relative = 1e-9);
}

/// A rope bent by a ring: with friction μ and wrap θ the two sides' tensions differ by at most e^(μθ).
#[test]
fn a_rope_slides_through_its_ring_up_to_the_capstan_limit() {
    let ring = Vec3::new(0.0, 0.0, 0.0);
    for friction in [0.0, 0.1, 0.4] {
        let mut barrier = Barrier::default();
        barrier.nodes = vec![
            node(Vec3::new(-1.0, 0.0, 0.0), 1.0, true),
            node(ring, 1.0, true),
            node(Vec3::new(0.0, 1.0, 0.0), 1.0, true),
        ];
        barrier.segments = vec![segment([0, 1], 0.95, 0.0), segment([1, 2], 0.999, 0.0)];
        barrier.chains = vec![Chain { segments: vec![0, 1], frictions: vec![friction], shortest: 0.1 }];
        let total = 0.95 + 0.999;
        let mut simulation = simulate(barrier, Vec3::zeros(), 1e-4);
        for _ in 0..20 {
            simulation.step().expect("stable");
        }
        let segments = &simulation.model.barrier.as_ref().expect("a barrier").segments;
        let [a, b] = [0, 1].map(|index| segments[index].stiffness * (1.0 - segments[index].rest_length));
        assert_relative_eq!(a / b, libm::exp(friction * std::f64::consts::FRAC_PI_2), max_relative = 1e-3);
        assert_relative_eq!(segments[0].rest_length + segments[1].rest_length, total, max_relative = 1e-12);
        assert!(simulation.ledger.lost_friction >= 0.0);
    }
}

/// Far beyond the critical step the run must notice, by cutting the step or by giving up, never carry on.
#[test]
fn a_step_beyond_the_critical_one_is_noticed() {
    let build = || {
        let mut barrier = Barrier::default();
        barrier.nodes = (0..5).map(|i| node(Vec3::new(f64::from(i), 0.0, 0.0), 1.0, i == 0 || i == 4)).collect();
        barrier.segments = (0..4).map(|i| segment([i, i + 1], 0.99, 0.0)).collect();
        barrier.nodes[2].velocity.z = 1.0;
        barrier
    };
    // ω² ≤ 4 k/m = 1.3e7: critical step about 5.5e-4 s.
    let mut simulation = simulate(build(), Vec3::zeros(), 1e-2);
    let outcome = (0..2000).try_for_each(|_| simulation.step());
    assert!(matches!(outcome, Err(Unstable::Node { .. } | Unstable::Step { .. })), "{outcome:?}");
    let mut simulation = simulate(build(), Vec3::zeros(), 3e-4);
    (0..2000).try_for_each(|_| simulation.step()).expect("stable below the critical step");
    assert!(simulation.extremes.step_ratio.value < 1.0);
}

/// Four springs in a row between two walls, three equal masses: ω² = (2 + √2) k/m along the row, and the audit adds its
/// margin of 1.10 to what it finds. A step beyond the critical one is cut to just below it.
#[test]
fn the_audit_finds_the_closed_form_of_a_row_of_masses() {
    let build = || {
        let mut barrier = Barrier::default();
        barrier.nodes = (0..5).map(|i| node(Vec3::new(f64::from(i), 0.0, 0.0), 1.0, i == 0 || i == 4)).collect();
        barrier.segments = (0..4).map(|i| segment([i, i + 1], 0.999_99, 0.0)).collect();
        barrier
    };
    let stiffness = AXIAL_STIFFNESS / 0.999_99;
    let critical = 2.0 / ((2.0 + std::f64::consts::SQRT_2) * stiffness).sqrt();
    let ratio = |share: f64| {
        let mut simulation = simulate(build(), Vec3::zeros(), share * critical);
        (0..600).try_for_each(|_| simulation.step()).map(|()| (simulation.extremes.step_ratio.value, simulation))
    };
    let (found, simulation) = ratio(0.5).expect("stable");
    assert_relative_eq!(found, 0.5 * 1.1_f64.sqrt(), max_relative = 0.01);
    assert_eq!(simulation.step_cuts, 0);
    // At rest, so that nothing grows before the audit comes.
    let (found, simulation) = ratio(1.3).expect("cut in time");
    assert_relative_eq!(found, 1.3 * 1.1_f64.sqrt(), max_relative = 0.01);
    assert_eq!(simulation.step_cuts, 1);
    assert!(simulation.time_step < critical);
}

/// A grain on a knot from which all ropes lead away is pushed once, not once by each rope.
#[test]
fn a_grain_on_a_knot_is_pushed_once() {
    let radius = 0.2;
    let mut barrier = Barrier::default();
    barrier.contact_modulus = 4e9;
    barrier.nodes = vec![node(Vec3::zeros(), 1.0, true)];
    for (index, [x, y]) in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].into_iter().enumerate() {
        barrier.nodes.push(node(Vec3::new(x, y, -0.5), 1.0, true));
        barrier.segments.push(segment([0, index as u32 + 1], 2.0, 0.0));
    }
    barrier.connect();
    let grain = ball(0, Vec3::new(0.0, 0.0, radius + 0.016 - 0.001), radius, 2600.0);
    let model = Model { barrier: Some(barrier), ..free_model(vec![grain], GrainShape::Sphere) };
    let mut simulation = Simulation::new(model, 1e-5, 0.05, 1e3);
    simulation.step().expect("stable");
    assert_eq!(simulation.neighbours.blocks[0].ropes.pushes.len(), 1);
    let (grain, rope) = (1e8 * radius, 4e9 * 0.016);
    let stiffness = 2.0 * grain * rope / (grain + rope);
    assert_relative_eq!(-simulation.sums.net.from_grains.z, stiffness * 0.001, max_relative = 1e-9);
}

/// A grain that lies near a flat crossing of two ropes: what both ropes have at the crossing counts once, so that the force does
/// not jump when the grain leaves the middle. Energy ½k (u₁² + u₂² − u_k²) and its gradient, with the feet of both ropes apart.
#[test]
fn a_grain_beside_a_flat_crossing_is_not_pushed_twice() {
    let (radius, above) = (0.2, 0.215);
    let push_at = |x: f64, y: f64| {
        let mut barrier = Barrier::default();
        barrier.contact_modulus = 4e9;
        barrier.nodes = vec![node(Vec3::zeros(), 1.0, true)];
        for (index, [x, y]) in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].into_iter().enumerate() {
            barrier.nodes.push(node(Vec3::new(x, y, 0.0), 1.0, true));
            barrier.segments.push(segment([0, index as u32 + 1], 2.0, 0.0));
        }
        barrier.connect();
        let grain = ball(0, Vec3::new(x, y, above), radius, 2600.0);
        let model = Model { barrier: Some(barrier), ..free_model(vec![grain], GrainShape::Sphere) };
        let mut simulation = Simulation::new(model, 1e-6, 0.05, 1e3);
        simulation.step().expect("stable");
        -simulation.sums.net.from_grains.z
    };
    let middle = push_at(0.0, 0.0);
    assert_relative_eq!(push_at(1e-4, 0.0), middle, max_relative = 1e-3);
    assert_relative_eq!(push_at(1e-4, 1e-4), middle, max_relative = 1e-3);
    assert_relative_eq!(push_at(-1e-4, 2e-4), middle, max_relative = 1e-3);
    // Far from the crossing each rope pushes for itself: its overlap, less what the crossing has of it.
    let (at, reach) = (0.01_f64, radius + 0.016);
    let overlap = reach - (above * above + at * at).sqrt();
    let shared = reach - (above * above + 2.0 * at * at).sqrt();
    let wanted = (2.0 * overlap - shared) / (reach - above) * middle;
    assert_relative_eq!(push_at(at, at), wanted, max_relative = 2e-3);
}

/// A grain that slides along a rope past a node keeps its friction: the force along the rope does not drop out there.
#[test]
fn friction_goes_along_from_one_line_to_the_next() {
    let radius = 0.2;
    let mut barrier = Barrier::default();
    barrier.contact_modulus = 4e9;
    barrier.friction = 0.3;
    barrier.nodes = (0..5).map(|i| node(Vec3::new(f64::from(i) - 2.0, 0.0, 0.0), 1.0, true)).collect();
    barrier.segments = (0..4).map(|i| segment([i, i + 1], 1.0, 0.0)).collect();
    barrier.connect();
    let mut grain = ball(0, Vec3::new(-0.02, 0.0, radius + 0.016 - 1e-4), radius, 2600.0);
    grain.velocity.x = 2.0;
    let model = Model {
        barrier: Some(barrier),
        gravity: Vec3::new(0.0, 0.0, -9.81),
        ..free_model(vec![grain], GrainShape::Sphere)
    };
    let mut simulation = Simulation::new(model, 1e-5, 0.05, 1e3);
    let mut least = f64::INFINITY;
    for step in 0..2000 {
        simulation.step().expect("stable");
        let force = simulation.sums.net.from_grains;
        if step > 300 {
            least = least.min(force.x / -force.z);
        }
    }
    assert!(simulation.grains.place[0].0[0] > 0.005, "the grain has passed the node");
    // Sliding throughout: the friction stays at its limit, the smaller of the two.
    assert_relative_eq!(least, 0.3, max_relative = 1e-3);
}

/// A grain thrown so hard that its centre goes through a rope is counted.
#[test]
fn a_grain_that_slips_through_a_rope_is_noticed() {
    let crossings = |speed: f64| {
        let mut barrier = Barrier::default();
        barrier.contact_modulus = 4e9;
        barrier.nodes = vec![node(Vec3::x() * -1.0, 1.0, true), node(Vec3::x(), 1.0, true)];
        barrier.segments = vec![segment([0, 1], 2.0, 0.0)];
        barrier.connect();
        let mut grain = ball(0, Vec3::new(0.0, 0.0, 0.25), 0.2, 2600.0);
        grain.velocity.z = -speed;
        let model = Model { barrier: Some(barrier), ..free_model(vec![grain], GrainShape::Sphere) };
        let mut simulation = Simulation::new(model, 1e-5, 0.05, 1e4);
        (0..30_000).try_for_each(|_| simulation.step()).expect("stable");
        simulation.extremes.crossings
    };
    assert_eq!(crossings(1.0), 0);
    assert_eq!(crossings(400.0), 1);
}

/// A free ring on a free rope, thrown against it at an angle and spinning: momentum and angular momentum stay, and the energy
/// account closes, with the barrier at several steps to one of the grains'.
#[test]
fn a_ring_on_its_rope_conserves_momentum_and_energy() {
    let mut barrier = Barrier::default();
    barrier.ring_moduli = [8e9, 4e9];
    let section = |radius: f64, modulus: f64| Section::round(radius, modulus, 0.3);
    let add = |barrier: &mut Barrier, position: Vec3, velocity: Vec3| {
        barrier.nodes.push(Node { velocity, radius: 0.0, ..node(position, 0.4, false) });
        barrier.frames.push(Frame {
            orientation: UnitQuaternion::identity(),
            spin: Vec3::new(3.0, 1.0, -2.0),
            inertia: 2e-4,
            held: false,
        });
        barrier.nodes.len() as u32 - 1
    };
    let cylinder = |barrier: &Barrier, nodes: [u32; 2], kind, section| {
        let places = nodes.map(|node| barrier.nodes[node as usize].position);
        let frames = nodes.map(|node| &barrier.frames[node as usize]);
        Cylinder::between(nodes, kind, section, [&places[0], &places[1]], frames)
    };
    for part in 0..11 {
        add(&mut barrier, Vec3::new(0.0, 0.07 * f64::from(part), 0.0), Vec3::zeros());
    }
    for part in 0..10 {
        let made = cylinder(&barrier, [part, part + 1], SegmentKind::Main(0), section(0.016, 4e9));
        barrier.cylinders.push(made);
    }
    let velocity = Vec3::new(2.0, 1.0, 0.7);
    let corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]
        .map(|[x, z]| add(&mut barrier, Vec3::new(0.0354 * x, 0.35, 0.0354 * z), velocity));
    for corner in 0..4 {
        let side = barrier.cylinders.len() as u32;
        let nodes = [corners[corner], corners[(corner + 1) % 4]];
        let made = cylinder(&barrier, nodes, SegmentKind::Ring, section(0.008, 8e9));
        barrier.cylinders.push(made);
        barrier.rings.push(RingSide { side, rope: 0..10, near: 5, memory: Memory::default(), friction: 0.0875 });
    }
    let momenta = |simulation: &Simulation| {
        let barrier = simulation.model.barrier.as_ref().expect("a barrier");
        let mut sums = [Vec3::zeros(); 2];
        for (node, frame) in barrier.nodes.iter().zip(&barrier.frames) {
            // Places at whole steps, velocities at half: the way between is along the velocity and adds nothing.
            sums[0] += node.velocity * node.mass;
            sums[1] += node.position.cross(&(node.velocity * node.mass)) + frame.spin * frame.inertia;
        }
        sums
    };
    let mut simulation = simulate(barrier.clone(), Vec3::zeros(), 1e-5);
    simulation.put_up(simulation.model.barrier.clone().expect("a barrier"));
    let start = momenta(&simulation);
    simulation.step_and_account().expect("stable");
    let account = simulation.ledger;
    for _ in 0..20_000 {
        simulation.step_and_account().expect("stable");
    }
    let end = momenta(&simulation);
    assert!((end[0] - start[0]).norm() < 1e-10 * start[0].norm());
    assert!((end[1] - start[1]).norm() < 1e-10 * start[1].norm());
    assert!(simulation.ledger.lost_friction > 0.1 * account.kinetic, "the ring slides and knocks");
    assert!((simulation.ledger.total() / account.total() - 1.0).abs() < 2e-3);
    let barrier = simulation.model.barrier.as_ref().expect("a barrier");
    let ring = corners.map(|corner| barrier.nodes[corner as usize].position).iter().sum::<Vec3>() / 4.0;
    let rope = barrier.nodes[..11].iter().map(|node| (node.position - ring).norm()).fold(f64::INFINITY, f64::min);
    assert!(rope < 0.07, "the ring is still on its rope");
}

/// Thin net ropes at a thick main rope that alone is touched take nothing from it.
#[test]
fn ropes_that_are_not_touched_take_no_part() {
    let (radius, thick) = (0.2, 0.016);
    let push_at = |x: f64| {
        let mut barrier = Barrier::default();
        barrier.contact_modulus = 4e9;
        barrier.nodes = vec![node(Vec3::zeros(), 1.0, true)];
        for (index, [x, y]) in [[1.0, 0.0], [-1.0, 0.0], [1.0, 1.0], [-1.0, 1.0]].into_iter().enumerate() {
            barrier.nodes.push(node(Vec3::new(x, y, 0.0), 1.0, true));
            let radius = if y == 0.0 { thick } else { 0.008 };
            barrier.segments.push(Segment { radius, ..segment([0, index as u32 + 1], 2.0, 0.0) });
        }
        barrier.connect();
        let grain = ball(0, Vec3::new(x, 0.0, radius + thick - 0.003), radius, 2600.0);
        let model = Model { barrier: Some(barrier), ..free_model(vec![grain], GrainShape::Sphere) };
        let mut simulation = Simulation::new(model, 1e-6, 0.05, 1e3);
        simulation.step().expect("stable");
        -simulation.sums.net.from_grains.z
    };
    let beside = push_at(0.1);
    for x in [0.0, 1e-4, 0.01, 0.03] {
        assert_relative_eq!(push_at(x), beside, max_relative = 1e-9);
    }
}

/// What a dissipator has paid out lies in the way of grains: one that flies against its middle comes back.
#[test]
fn grains_meet_what_a_dissipator_has_paid_out() {
    let mut barrier = Barrier::default();
    barrier.contact_modulus = 4e9;
    barrier.nodes = vec![node(Vec3::zeros(), 1.0, true), node(Vec3::y() * 2.0, 1.0, true)];
    barrier.dissipators = vec![Dissipator {
        nodes: [0, 1],
        kind: SegmentKind::Main(0),
        rest_length: 0.07,
        radius: 0.016,
        stiffness: 46e6,
        plateau: 250e3,
        curve: YieldCurve::default(),
        stroke: 2.5,
        used: 1.9,
    }];
    barrier.connect();
    let mut grain = ball(0, Vec3::new(-0.1, 1.0, 0.0), 0.05, 2600.0);
    grain.velocity = Vec3::x() * 2.0;
    let model = Model { barrier: Some(barrier), ..free_model(vec![grain], GrainShape::Sphere) };
    let mut simulation = Simulation::new(model, 1e-5, 0.02, 1e3);
    for _ in 0..10_000 {
        simulation.step().expect("stable");
    }
    assert!(simulation.grains.grain(0).velocity.x < 0.0, "the grain went through");
    assert_eq!(simulation.extremes.crossings, 0);
}

/// The loss of a rope that slides belongs to the barrier's own step: the account closes as well where the barrier takes several in
/// one of the grains'.
#[test]
fn the_account_of_a_sliding_rope_closes_in_any_number_of_steps() {
    let imbalance = |parts: u32| {
        let mut barrier = Barrier::default();
        barrier.nodes = vec![
            node(Vec3::zeros(), 1.0, true),
            node(Vec3::new(1.0, 0.0, 0.0), 50.0, false),
            node(Vec3::new(2.5, 0.0, 0.0), 80.0, false),
            node(Vec3::new(4.0, 0.0, 0.0), 1.0, true),
        ];
        barrier.segments = vec![segment([0, 1], 1.0, 0.0), segment([1, 2], 1.5, 0.0), segment([2, 3], 1.5, 0.0)];
        barrier.chains = vec![Chain { segments: vec![0, 1, 2], frictions: vec![0.1; 2], shortest: 0.2 }];
        let mut simulation = simulate(barrier, Vec3::new(0.0, 0.0, -9.81), 2e-4 * f64::from(parts));
        simulation.barrier_substeps = parts;
        simulation.step_and_account().expect("stable");
        let start = simulation.ledger;
        let mut worst: f64 = 0.0;
        for _ in 0..8000 / parts {
            simulation.step_and_account().expect("stable");
            worst = worst.max(simulation.ledger.relative_error(&start).abs());
        }
        assert!(simulation.ledger.lost_friction > 0.01 * start.potential.abs().max(1.0), "nothing slid");
        worst
    };
    for parts in [1, 4] {
        let found = imbalance(parts);
        assert!(found < 0.004, "{parts} steps in one: {found}");
    }
}
