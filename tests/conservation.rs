//! What a result must not depend on. (What must be conserved are validation cases.)

use approx::assert_relative_eq;
use barrier_check::validation::scenes::{ball, cloud, floor, free_model, material};
use dem::Vec3;
use dem::contact::grain_pairs::Members;
use dem::contact::pair_list::Separation;
use dem::model::Model;
use dem::simulation::{Simulation, Unstable};
use dem::tables::grains::GrainShape;
use dem::workers::gather;

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let finish = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
        let run = || {
            let mut model =
                Model { gravity: Vec3::new(1.0, 0.0, -9.81), ..free_model(cloud(1500, 7), GrainShape::Clump) };
            model.surfaces = vec![floor(0.4)];
            let mut simulation = Simulation::new(model, 2e-5, 0.002, 1e6);
            for _ in 0..1500 {
                simulation.step().expect("stable");
            }
            simulation.snapshot().iter().map(|g| (g.id, g.position, g.angular_momentum)).collect::<Vec<_>>()
        };
        pool.install(|| gather(run))
    };
    let one = finish(1);
    assert_eq!(one, finish(2));
    assert_eq!(one, finish(3));
}

/// The candidate lists must hold every pair that touches: held against all pairs, over a run in which grains
/// move, are reordered and leave.
#[test]
fn no_touching_pair_is_missed() {
    let mut model =
        Model { gravity: Vec3::new(3.0, 0.0, -9.81), outlet: 0.35, ..free_model(cloud(650, 11), GrainShape::Clump) };
    model.surfaces = vec![floor(0.2)];
    let mut simulation = Simulation::new(model, 4e-5, 0.003, 1e6);
    let mut checked = 0;
    for step in 0..3000 {
        simulation.step().expect("stable");
        if step % 20 != 19 {
            continue;
        }
        // What the next step would do first: renew what has expired, find what touches.
        if simulation.neighbours.expired(&simulation.grains, None, false) {
            continue;
        }
        let mut touching_listed = std::collections::BTreeSet::new();
        for block in &mut simulation.neighbours.blocks {
            let clocks = block.clocks;
            for (list, clock) in [(&mut block.inner, clocks.inner), (&mut block.border, clocks.border)] {
                list.sort_near(&clock, &Members(simulation.grains.rows()));
                touching_listed.extend(list.touching.iter().map(|[a, b]| (*a.min(b), *a.max(b))));
            }
        }
        for a in 0..simulation.grains.members() as u32 {
            for b in a + 1..simulation.grains.members() as u32 {
                let touching = a / 2 != b / 2 && Members(simulation.grains.rows()).gap([a, b]) < 0.0;
                assert!(!touching || touching_listed.contains(&(a, b)), "step {step}: {a} and {b}");
            }
        }
        checked += 1;
    }
    assert!(checked > 50, "the lists had nearly always expired");
    assert!(simulation.grains.len() < 650, "no grain left the model");
}

/// Making the lists anew, and reordering the grains with them, must not lose what contacts remember.
#[test]
fn renewing_the_lists_changes_nothing() {
    let run = |steps_per_renewal: u64| {
        let model = free_model(cloud(700, 13), GrainShape::Clump);
        let mut simulation = Simulation::new(model, 1e-5, 0.002, 1e6);
        for step in 1..=2500 {
            if step % steps_per_renewal == 0 {
                simulation.neighbours.lose();
            }
            simulation.step_and_account().expect("stable");
        }
        simulation.ledger
    };
    let (seldom, often) = (run(u64::MAX), run(5));
    assert!(seldom.lost_friction > 0.0, "nothing slipped");
    assert_relative_eq!(seldom.lost_friction, often.lost_friction, max_relative = 1e-6);
    assert_relative_eq!(seldom.kinetic, often.kinetic, max_relative = 1e-6);
}

/// Two balls that start just outside each other's list must be listed before they touch: an elastic impact then keeps
/// their speed, while one noticed late would gain from the overlap it starts with.
#[test]
fn balls_from_outside_the_list_meet_without_a_jump() {
    let (radius, skin, speed) = (0.01, 0.004, 1.0);
    let mut left = ball(0, Vec3::new(-radius - 0.6 * skin, 0.0, 0.0), radius, 2600.0);
    let mut right = ball(1, Vec3::new(radius + 0.6 * skin, 0.0, 0.0), radius, 2600.0);
    left.velocity.x = speed;
    right.velocity.x = -speed;
    let model = Model { material: material(1.0, 0.0), ..free_model(vec![left, right], GrainShape::Sphere) };
    let mut simulation = Simulation::new(model, 2e-6, skin, 1e6);
    for _ in 0..3000 {
        simulation.step().expect("stable");
    }
    for grain in simulation.snapshot() {
        assert_relative_eq!(grain.velocity.norm(), speed, max_relative = 1e-3);
        assert!(grain.velocity.x * grain.position.x > 0.0, "the balls did not bounce");
    }
}

/// A value that is not finite must end the run at once, wherever it comes in; it must never be carried on, or hang.
#[test]
fn a_value_that_is_not_finite_ends_the_run() {
    for wrong in [f64::NAN, f64::INFINITY, 1e300] {
        for shape in [GrainShape::Sphere, GrainShape::Clump] {
            let mut model = free_model(cloud(50, 15), shape);
            model.surfaces = vec![floor(0.4)];
            let mut simulation = Simulation::new(model, 2e-5, 0.002, 1e6);
            (0..50).for_each(|_| simulation.step().expect("stable"));
            simulation.grains.motion[7].0[1] = wrong;
            let outcome = (0..3).try_for_each(|_| simulation.step());
            assert!(matches!(outcome, Err(Unstable::Grain { .. })), "{wrong} {shape:?}: {outcome:?}");
        }
    }
}
