//! The contact law against closed forms (verification cases A1 to A21).

mod common;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use barrier_check::dem::Vec3;
use barrier_check::dem::model::Model;
use barrier_check::dem::simulation::Simulation;
use barrier_check::dem::tables::grains::{Grain, GrainBody, GrainShape};
use common::{ball, floor, free_model, material};

const RADIUS: f64 = 0.01;
const DENSITY: f64 = 2600.0;

/// Two equal balls about to meet along x at ±`speed`, with a step of the given share of the contact time.
fn head_on(restitution: f64, speed: f64, share: f64) -> Simulation {
    let gap = 1e-9;
    let mut left = ball(0, Vec3::new(-RADIUS - gap, 0.0, 0.0), RADIUS, DENSITY);
    let mut right = ball(1, Vec3::new(RADIUS + gap, 0.0, 0.0), RADIUS, DENSITY);
    left.velocity.x = speed;
    right.velocity.x = -speed;
    let model = Model { material: material(restitution, 0.0), ..free_model(vec![left, right], GrainShape::Sphere) };
    let contact_time = std::f64::consts::PI * (0.5 * model.grains[0].body.mass / (1e8 * RADIUS)).sqrt();
    Simulation::new(model, share * contact_time, 0.2 * RADIUS, 1e6)
}

fn run(simulation: &mut Simulation, steps: usize) {
    for _ in 0..steps {
        simulation.step().expect("stable");
    }
}

#[test]
fn measured_restitution_between_grains_is_the_nominal_one() {
    for nominal in [0.1, 0.3, 0.5, 0.7, 0.9, 1.0] {
        let mut simulation = head_on(nominal, 1.0, 1.0 / 400.0);
        run(&mut simulation, 1200);
        let measured = simulation.snapshot().iter().map(|g| g.velocity.x.abs()).sum::<f64>() / 2.0;
        assert_abs_diff_eq!(measured, nominal, epsilon = 0.01);
    }
}

#[test]
fn measured_restitution_at_a_wall_is_the_nominal_one() {
    for nominal in [0.2, 0.3, 0.6, 0.9] {
        let mut grain = ball(0, Vec3::new(0.0, 0.0, RADIUS + 1e-9), RADIUS, DENSITY);
        grain.velocity.z = -1.0;
        let contact_time = std::f64::consts::PI * (grain.body.mass / (1e8 * RADIUS)).sqrt();
        let mut model = Model { material: material(nominal, 0.0), ..free_model(vec![grain], GrainShape::Sphere) };
        model.surfaces = vec![floor(0.0)];
        let mut simulation = Simulation::new(model, contact_time / 400.0, 0.2 * RADIUS, 1e6);
        run(&mut simulation, 1200);
        assert_abs_diff_eq!(simulation.grains.grain(0).velocity.z, nominal, epsilon = 0.01);
    }
}

#[test]
fn clumps_meet_with_their_own_reduced_mass() {
    // Two clumps, axes across the line of centres of their touching members: a central impact at member
    // level would need the members' masses; with the clump's own the nominal restitution comes out end-on.
    let body = GrainBody::clump(0.02, 1.5, DENSITY);
    let reach = body.offset + body.radius;
    let make = |id: u32, side: f64| {
        let mut grain = Grain::at(id, Vec3::new(side * (reach + 1e-9), 0.0, 0.0), Vec3::x(), body);
        grain.velocity.x = -side;
        grain
    };
    let model =
        Model { material: material(0.3, 0.0), ..free_model(vec![make(0, -1.0), make(1, 1.0)], GrainShape::Clump) };
    let contact_time = std::f64::consts::PI * (0.5 * body.mass / (1e8 * body.radius)).sqrt();
    let mut simulation = Simulation::new(model, contact_time / 400.0, 0.002, 1e6);
    run(&mut simulation, 1200);
    assert_abs_diff_eq!(simulation.grains.grain(0).velocity.x.abs(), 0.3, epsilon = 0.01);
}

#[test]
fn a_ball_at_rest_sinks_in_by_its_weight_over_the_stiffness() {
    let mut model = Model {
        material: material(0.3, 0.5),
        gravity: Vec3::new(0.0, 0.0, -9.81),
        ..free_model(vec![ball(0, Vec3::new(0.0, 0.0, RADIUS), RADIUS, DENSITY)], GrainShape::Sphere)
    };
    model.surfaces = vec![floor(0.5)];
    let weight = model.grains[0].body.mass * 9.81;
    let mut simulation = Simulation::new(model, 2e-6, 0.2 * RADIUS, 1e6);
    run(&mut simulation, 20_000);
    let sunk = RADIUS - simulation.grains.grain(0).position.z;
    assert_relative_eq!(sunk, weight / (1e8 * RADIUS), max_relative = 1e-3);
    assert_relative_eq!(-simulation.sums.surfaces.base.z, weight, max_relative = 1e-4);
}

#[test]
fn a_slipping_ball_rolls_with_five_sevenths_of_its_speed() {
    let mut grain = ball(0, Vec3::new(0.0, 0.0, RADIUS), RADIUS, DENSITY);
    grain.velocity.x = 1.0;
    let mut model = Model {
        material: material(0.3, 0.3),
        gravity: Vec3::new(0.0, 0.0, -9.81),
        ..free_model(vec![grain], GrainShape::Sphere)
    };
    model.surfaces = vec![floor(0.3)];
    let mut simulation = Simulation::new(model, 5e-6, 0.2 * RADIUS, 1e6);
    // Rolls from t = 2 v0/(7 μ g) = 0.0971 s on.
    run(&mut simulation, 22_000);
    let grain = &simulation.grains.grain(0);
    assert_relative_eq!(grain.velocity.x, 5.0 / 7.0, max_relative = 0.01);
    assert_relative_eq!(grain.spin().y * RADIUS, grain.velocity.x, max_relative = 0.01);
}

#[test]
fn a_ball_rolls_down_a_slope_at_five_sevenths_of_gravity() {
    let slope = 40_f64.to_radians();
    let mut model = Model {
        material: material(0.3, 25_f64.to_radians().tan()),
        gravity: Vec3::new(9.81 * slope.sin(), 0.0, -9.81 * slope.cos()),
        ..free_model(vec![ball(0, Vec3::new(0.0, 0.0, RADIUS), RADIUS, DENSITY)], GrainShape::Sphere)
    };
    model.surfaces = vec![floor(25_f64.to_radians().tan())];
    let mut simulation = Simulation::new(model, 5e-6, 0.2 * RADIUS, 1e6);
    run(&mut simulation, 20_000);
    assert_relative_eq!(simulation.grains.grain(0).velocity.x / simulation.time, 4.504, max_relative = 0.005);
}

/// Oblique impact without damping on a wall, k_t = 2/7 k: e_t = 3/7 of the contact-point velocity is reversed
/// up to ψ = v_t/(μ v_n) = 3.5; beyond, e_t = 1 − 2/ψ and R ω/(μ v_n) = 5 (case A9).
#[test]
fn oblique_impact_follows_the_closed_form() {
    let friction = 0.3;
    for ratio in [1.0, 3.0, 5.0, 10.0] {
        let mut grain = ball(0, Vec3::new(0.0, 0.0, RADIUS), RADIUS, DENSITY);
        // Slow, so that the overlap stays far below the radius, as the closed form has it.
        let speed = 0.05;
        grain.velocity = Vec3::new(ratio * friction, 0.0, -1.0) * speed;
        let contact_time = std::f64::consts::PI * (grain.body.mass / (1e8 * RADIUS)).sqrt();
        let mut model = Model { material: material(1.0, friction), ..free_model(vec![grain], GrainShape::Sphere) };
        model.surfaces = vec![floor(friction)];
        let mut simulation = Simulation::new(model, contact_time / 2000.0, 0.2 * RADIUS, 1e6);
        run(&mut simulation, 3000);
        let grain = &simulation.grains.grain(0);
        let kept = grain.velocity.x / (ratio * friction * speed);
        if ratio <= 3.5 {
            assert_abs_diff_eq!(kept, 3.0 / 7.0, epsilon = 0.005);
            let rim = grain.velocity.x - RADIUS * grain.spin().y;
            assert_abs_diff_eq!(rim / (ratio * friction * speed), -1.0, epsilon = 0.01);
        } else {
            assert_abs_diff_eq!(kept, 1.0 - 2.0 / ratio, epsilon = 0.005);
            assert_relative_eq!(RADIUS * grain.spin().y / (friction * speed), 5.0, max_relative = 0.005);
        }
    }
}

#[test]
fn a_free_clump_keeps_momentum_and_energy() {
    let body = GrainBody::clump(0.02, 1.5, DENSITY);
    let mut grain = Grain::at(0, Vec3::zeros(), Vec3::new(1.0, 2.0, 2.0) / 3.0, body);
    grain.angular_momentum = Vec3::new(3.0, -1.0, 0.5) * (body.inertia_axial * 100.0);
    let energy = |grain: &Grain| 0.5 * grain.spin().dot(&grain.angular_momentum);
    let before = (energy(&grain), grain.angular_momentum);
    let model = free_model(vec![grain], GrainShape::Clump);
    let mut simulation = Simulation::new(model, 1e-4, 0.002, 1e6);
    run(&mut simulation, 20_000);
    let after = &simulation.grains.grain(0);
    assert_eq!(after.angular_momentum, before.1);
    assert_relative_eq!(energy(after), before.0, max_relative = 1e-9);
    assert_relative_eq!(after.axis.norm(), 1.0, max_relative = 1e-9);
}
