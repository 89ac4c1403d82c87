//! Ropes and cylinders at the limits of what they bear: they draw out, yield and break.

#![allow(clippy::field_reassign_with_default)] // a barrier is put together part by part

mod parts;

use approx::assert_relative_eq;
use dem::Vec3;
use dem::elements::cylinder::{Cylinder, Section};
use dem::elements::segment::SegmentKind;
use dem::elements::sliding::Chain;
use dem::tables::barrier::Barrier;
use dem::tables::nodes::Frame;
use nalgebra::UnitQuaternion;
use parts::{AXIAL_STIFFNESS, node, segment, simulate};

/// 1000 kg at 10 m/s on a rope of EA that yields at F: of the energy ½ m v² the part ½ F²/k is elastic, the rest draws the rope out.
#[test]
fn a_rope_draws_out_at_its_elastic_limit() {
    let mut barrier = Barrier::default();
    barrier.nodes = vec![node(Vec3::zeros(), 1.0, true), node(Vec3::new(10.0, 0.0, 0.0), 1000.0, false)];
    barrier.nodes[1].velocity.x = 10.0;
    let mut rope = segment([0, 1], 10.0, 0.0);
    rope.strength.elastic = 50e3;
    barrier.segments = vec![rope];
    let mut simulation = simulate(barrier, Vec3::zeros(), 1e-5);
    simulation.step_and_account().expect("stable");
    let start = simulation.ledger;
    for _ in 0..40_000 {
        simulation.step_and_account().expect("stable");
    }
    let rope = &simulation.model.barrier.as_ref().expect("a barrier").segments[0];
    // What is left beyond ½ F² L₀/EA goes into F ΔL, with ΔL the drawn-out length under tension.
    let beyond = 0.5 * 1000.0 * 100.0 - 0.5 * 50e3_f64.powi(2) / AXIAL_STIFFNESS * 10.0;
    let drawn = beyond / 50e3 / (1.0 + 50e3 / AXIAL_STIFFNESS);
    assert_relative_eq!(rope.strength.drawn_out, drawn, max_relative = 0.005);
    assert_relative_eq!(rope.rest_length, 10.0 + rope.strength.drawn_out, max_relative = 1e-12);
    assert_relative_eq!(rope.stiffness * rope.rest_length, AXIAL_STIFFNESS, max_relative = 1e-12);
    assert!(simulation.ledger.relative_error(&start).abs() < 1e-4, "{}", simulation.ledger.relative_error(&start));
}

/// A weight that the rope cannot hold falls freely once it has broken; the energy the rope had stored is lost, and nobody touches it.
#[test]
fn a_rope_breaks_at_its_breaking_load() {
    let mut barrier = Barrier::default();
    barrier.nodes = vec![node(Vec3::zeros(), 1.0, true), node(Vec3::new(0.0, 0.0, -1.0), 1000.0, false)];
    let mut rope = segment([0, 1], 1.0, 0.0);
    // Let go suddenly, the load doubles: 19.62 kN.
    rope.strength.breaking = 15e3;
    barrier.segments = vec![rope];
    let mut simulation = simulate(barrier, Vec3::new(0.0, 0.0, -9.81), 1e-5);
    simulation.step_and_account().expect("stable");
    let start = simulation.ledger;
    for _ in 0..50_000 {
        simulation.step_and_account().expect("stable");
    }
    let barrier = simulation.model.barrier.as_ref().expect("a barrier");
    assert!(barrier.segments[0].strength.broken && barrier.lines[0].broken && barrier.line_ends.at(1).is_empty());
    assert_eq!(simulation.sums.net.tensions, [0.0]);
    // Stretched to 15 kN it has stored F²L/2EA = 35 J.
    assert_relative_eq!(simulation.ledger.lost_ropes, 15e3_f64.powi(2) / (2.0 * AXIAL_STIFFNESS), max_relative = 0.01);
    let fall = -1.0 - barrier.nodes[1].position.z;
    assert!(fall > 1.1, "{fall}");
    assert!(simulation.ledger.relative_error(&start).abs() < 1e-4, "{}", simulation.ledger.relative_error(&start));
}

/// A rope that breaks beside a ring runs out through it, though the ring's friction is high.
#[test]
fn a_broken_rope_runs_out_through_its_rings() {
    let mut barrier = Barrier::default();
    barrier.nodes =
        [[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| node(Vec3::new(x, y, 0.0), 1.0, true)).to_vec();
    barrier.segments = vec![segment([0, 1], 0.98, 0.0), segment([1, 2], 0.98, 0.0), segment([2, 3], 0.98, 0.0)];
    barrier.segments[2].strength.breaking = 60e3;
    barrier.chains = vec![Chain { segments: vec![0, 1, 2], frictions: vec![0.4; 2], shortest: 0.1 }];
    let mut simulation = simulate(barrier, Vec3::zeros(), 1e-4);
    for _ in 0..20 {
        simulation.step().expect("stable");
    }
    for tension in &simulation.sums.net.tensions {
        assert!(*tension < 1e-3 * 60e3, "{tension}");
    }
    assert!(simulation.ledger.lost_ropes > 0.0 && simulation.ledger.lost_friction > 0.0);
}

/// A cylinder clamped at one end and turned at the other, slowly and further than it can bend: the end moment stays at F R/4, what
/// is beyond the elastic turn stays, and the work done is stored or lost.
#[test]
fn a_cylinder_yields_in_bending_and_twisting_at_the_limits_of_its_surface() {
    let (radius, limit) = (0.016, 10e3);
    let section = Section::round(radius, 4e9, 0.3);
    for (axis, most, stiffness) in [
        (Vec3::z(), limit * radius / 4.0, 4.0 * section.bending),
        (Vec3::x(), limit * radius / (2.0 * 3.0_f64.sqrt()), section.twisting),
    ] {
        let mut barrier = Barrier::default();
        let places = [Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0)];
        barrier.nodes = places.map(|place| node(place, 1.0, true)).to_vec();
        let frame = |held, spin| Frame { orientation: UnitQuaternion::identity(), spin, inertia: 1e9, held };
        let turned = 0.5;
        let steps = 10_000;
        let step = 1e-4;
        barrier.frames = vec![frame(true, Vec3::zeros()), frame(false, axis * (turned / (f64::from(steps) * step)))];
        let [a, b] = [&barrier.frames[0], &barrier.frames[1]];
        let mut cylinder = Cylinder::between([0, 1], SegmentKind::Net, section, [&places[0], &places[1]], [a, b]);
        cylinder.strength.elastic = limit;
        barrier.cylinders = vec![cylinder];
        let mut simulation = simulate(barrier, Vec3::zeros(), step);
        let mut work = 0.0;
        for _ in 0..steps {
            simulation.step().expect("stable");
            work -= simulation.sums.net.torques[1].dot(&axis) * turned / f64::from(steps);
        }
        assert_relative_eq!(-simulation.sums.net.torques[1].dot(&axis), most, max_relative = 1e-3);
        let stored = 0.5 * most * most / stiffness;
        let plastic = (turned - most / stiffness) * most;
        // Where the far end yields the clamped one stays elastic: half its moment.
        assert_relative_eq!(simulation.ledger.stored_barrier, stored, max_relative = 0.02);
        assert_relative_eq!(simulation.ledger.lost_ropes, plastic, max_relative = 0.02);
        assert_relative_eq!(work, stored + plastic, max_relative = 0.02);
    }
}

/// In several steps of the barrier within one of the grains' the account closes at every instant, that of the break too.
#[test]
fn a_rope_that_breaks_within_a_step_is_booked_at_its_instant() {
    let mut barrier = Barrier::default();
    barrier.nodes = vec![node(Vec3::zeros(), 1.0, true), node(Vec3::new(0.0, 0.0, -1.0), 1000.0, false)];
    let mut rope = segment([0, 1], 1.0, 0.0);
    rope.strength.breaking = 15e3;
    barrier.segments = vec![rope];
    let mut simulation = simulate(barrier, Vec3::new(0.0, 0.0, -9.81), 1e-4);
    simulation.barrier_substeps = 8;
    simulation.step_and_account().expect("stable");
    let opened = simulation.ledger;
    let mut worst: f64 = 0.0;
    for _ in 0..2000 {
        simulation.step_and_account().expect("stable");
        worst = worst.max((simulation.ledger.total() - opened.total()).abs());
    }
    assert!(simulation.ledger.lost_ropes > 30.0);
    // Of 35 J that the rope had stored.
    assert!(worst < 0.5, "{worst}");
}
