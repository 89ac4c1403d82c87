//! Boulders that come with a surge: a part of its mass, watched as they hit, and on a wall a point load of the equations.

use std::sync::atomic::AtomicBool;

use barrier_check::design::read::{DesignFile, read_design};
use barrier_check::fidelity::choose;
use barrier_check::guideline::{input, point_load};
use barrier_check::pipeline::{Run, by_equations, run};
use barrier_check::quantities::{boulder, other_ropes};
use barrier_check::scene::build::build;
use barrier_check::scene::event::RunControl;
use barrier_check::validation::scenes::{free_model, material};
use dem::Vec3;
use dem::model::Model;
use dem::recorders::of_boulders;
use dem::simulation::Simulation;
use dem::tables::grains::{Grain, GrainBody, GrainShape};

const NET: &str = include_str!("fixtures/tiny.yaml");
const WALL: &str = include_str!("fixtures/tiny_wall.yaml");

fn with(text: &str, boulders: &str) -> DesignFile {
    let text = text.replacen("  arrival:\n", &format!("  boulders: [{boulders}]\n  arrival:\n"), 1);
    read_design("x.yaml", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}"))
}

fn simulated(file: DesignFile) -> Run {
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    run(file, 1, &watch).expect("a run")
}

/// One of 0.55 m, 231 kg, at the front with 4.6 m/s: it is stopped by no more than what it brings and its weight along the bed, and what pulls
/// beside it is a part of what pulls anywhere.
#[test]
fn a_boulder_hits_a_net_with_its_momentum() {
    let file = with(NET, "{diameter: 0.55 m, number: 1}");
    let flow = &file.design.flow;
    let mass = flow.mass;
    let boulder_mass = 2650.0 * std::f64::consts::PI / 6.0 * 0.55_f64.powi(3);
    assert!((flow.mass_of_grains() + boulder_mass - mass).abs() < 1e-9 * mass);
    let run = simulated(file);
    let seen = run.simulated.as_ref().expect("a simulation");
    assert!(seen.numerics.energy_error.abs() < 1e-3, "{}", seen.numerics.energy_error);
    let first = seen.first();
    assert!(first.one(&boulder::NET) > 0.0 && first.one(&boulder::NET) <= 1.001 * first.one(&other_ropes::NET));
    // Until it is stopped, a tenth of a second or so, the net takes the momentum of the boulder from it.
    let histories = &seen.histories;
    let force = histories.barrier.series(&of_boulders::FORCE);
    let start = force.iter().position(|force| *force > 0.0).expect("a hit");
    let step = histories.time[1] - histories.time[0];
    let within = (0.15 / step) as usize;
    let impulse: f64 = force[start..start + within].iter().sum::<f64>() * step;
    let momentum = boulder_mass * 4.6;
    assert!((0.5..2.5).contains(&(impulse / momentum)), "{impulse} of {momentum}");
    assert!(first.one(&boulder::FORCE) > 2.0 * momentum / 0.15, "{}", first.one(&boulder::FORCE));
}

/// One alone against the net, without weight: what the net took from it is what it lost, step by step, and the energy is accounted for. What
/// is not falls with the step: 3.0e-4 with 20 µs, 1.5e-4 with 10 µs.
#[test]
fn momentum_and_energy_of_a_boulder_in_a_net_are_accounted_for() {
    let file = read_design("x.yaml", NET.as_bytes()).unwrap_or_else(|problems| panic!("{problems}"));
    let scene = build(&file.design, &choose(&file.design), 1).expect("a scene");
    let body = GrainBody::sphere(0.275, 2650.0);
    let mut boulder = Grain::at(0, Vec3::new(-0.8, 1.43, 0.71), Vec3::x(), body);
    boulder.velocity = Vec3::new(4.6, 0.3, -0.2);
    let (momentum, boulder_speed) = (boulder.velocity * body.mass, boulder.velocity.norm());
    let mut model = Model { material: material(0.3, 0.8), ..free_model(vec![boulder], GrainShape::Sphere) };
    model.barrier = scene.simulation.model.barrier;
    let mut simulation = Simulation::new(model, 5e-6, 0.05, 1e3);
    simulation.start_account();
    let (mut taken, mut largest) = (Vec3::zeros(), 0.0_f64);
    simulation.step_and_account().expect("stable");
    let start = simulation.ledger;
    assert!(start.kinetic > 0.99 * 0.5 * body.mass * boulder_speed.powi(2), "{}", start.kinetic);
    for _ in 0..80_000 {
        simulation.step_and_account().expect("stable");
        taken += simulation.sums.net.from_grains * simulation.time_step;
        largest = largest.max(simulation.sums.net.from_grains.norm());
    }
    let boulder = &simulation.snapshot()[0];
    assert!(boulder.velocity.x < 0.0, "it was not thrown back: {}", boulder.velocity);
    let lost = momentum - boulder.velocity * body.mass;
    assert!((lost - taken).norm() < 1e-6 * momentum.norm(), "{lost} lost, {taken} taken");
    assert!(largest > 5e3, "{largest}");
    let error = simulation.ledger.relative_error(&start);
    assert!(error.abs() < 1e-4, "{error}");
}

/// One at the front lies anywhere across the channel, another place in each packing, and within its walls.
#[test]
fn where_a_boulder_comes_is_a_matter_of_chance() {
    let file = with(NET, "{diameter: 0.55 m, number: 1}");
    let width = file.design.channel.width;
    let place = |seed: u64| {
        let scene = build(&file.design, &choose(&file.design), seed).expect("a scene");
        let grains = scene.simulation.snapshot();
        let boulder = grains.iter().max_by(|a, b| a.body.mass.total_cmp(&b.body.mass)).expect("a boulder");
        (boulder.position.y, boulder.body.radius)
    };
    let places: Vec<(f64, f64)> = (1..=8).map(place).collect();
    assert!(places.iter().all(|(y, radius)| (*radius..=width - radius).contains(y)), "{places:?} of {width}");
    let across = |pick: fn(f64, f64) -> f64, from: f64| places.iter().map(|(y, _)| *y).fold(from, pick);
    let [least, most] = [across(f64::min, f64::INFINITY), across(f64::max, f64::NEG_INFINITY)];
    assert!(most - least > 0.4 * (width - 0.55), "{places:?} of {width}");
    assert_eq!(place(1), places[0]);
}

/// In whatever order boulders are listed they are the same flow.
#[test]
fn the_order_of_a_list_of_boulders_changes_nothing() {
    let [one, other] = ["{diameter: 0.5 m, number: 1}", "{diameter: 0.4 m, number: 2}"];
    let listed = |first: &str, then: &str| with(NET, &format!("{first}, {then}")).design.flow.boulders;
    assert_eq!(listed(one, other), listed(other, one));
}

/// Spread ones lie in the flow, none overlaps, and their mass is there.
#[test]
fn spread_boulders_are_packed_with_the_grains() {
    let file = with(NET, "{diameter: 0.5 m, number: 2, where: spread, density: 2400 kg/m3}");
    let run = simulated(file);
    let seen = run.simulated.as_ref().expect("a simulation");
    assert!(run.doubts.is_empty(), "{:?}", run.doubts);
    let last = seen.histories.time.len() - 1;
    let there = seen.histories.dead[last] + seen.histories.moving[last] + seen.histories.lost[last].iter().sum::<f64>();
    assert!((there - 1.0).abs() < 1e-6, "{there}");
}

/// A tenth of the elastic force, by hand: E* = 19.5 GPa, n = 4/3 E* √r, F = n^0.4 (5/4 m v²)^0.6.
#[test]
fn on_a_wall_the_equations_add_the_largest_boulder() {
    let file = with(WALL, "{diameter: 0.6 m, number: 1}, {diameter: 0.5 m, number: 2}");
    let velocity = match file.design.flow.arrival {
        barrier_check::design::Arrival::Surge(surge) => surge.velocity,
        other => panic!("{other:?}"),
    };
    let mass = 2650.0 * std::f64::consts::PI / 6.0 * 0.6_f64.powi(3);
    let stiffness = 4.0 / 3.0 * 19.5e9 * 0.3_f64.sqrt();
    let by_hand = 0.1 * libm::pow(stiffness, 0.4) * libm::pow(1.25 * mass * velocity * velocity, 0.6);
    let hit = point_load(&file.design, &input(&file.design)).expect("a point load");
    assert!(hit.height.is_none(), "it comes at the surface of the flow");
    let force = hit.of_boulder;
    assert!((force / by_hand - 1.0).abs() < 1e-9, "{force} {by_hand}");
    let with_boulders = by_equations(file);
    let without = by_equations(read_design("x.yaml", WALL.as_bytes()).expect("a design"));
    let added = with_boulders.guideline.largest_force - without.guideline.largest_force;
    assert!((added / force - 1.0).abs() < 1e-6, "{added} {force}");
}
