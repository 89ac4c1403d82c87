//! A small run's last state, down to the bits: the same on every thread, in debug and in release builds, from run to run and from
//! version to version unless something is meant to change. Where it is, write the new number down with the change.

use barrier_check::design::BarrierModel;
use barrier_check::design::read::read_design;
use barrier_check::fidelity::choose;
use barrier_check::scene::build::build;
use sha2::Digest;

/// Digest of places and velocities of grains and knots after `steps` steps of the small recorded design.
fn digest(model: BarrierModel, threads: usize, steps: usize) -> String {
    let mut design = read_design("tiny", include_bytes!("fixtures/tiny.yaml")).expect("a design").design;
    design.simulation.barrier_model = model;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let mut simulation = build(&design, &choose(&design), 1).expect("a scene").simulation;
        dem::workers::gather(|| {
            for _ in 0..steps {
                simulation.step().expect("stable");
            }
        });
        let mut hash = sha2::Sha256::new();
        let mut take = |values: &[f64]| values.iter().for_each(|value| hash.update(value.to_le_bytes()));
        let grains = simulation.snapshot();
        for grain in &grains {
            take(grain.position.as_slice());
            take(grain.velocity.as_slice());
            take(grain.angular_momentum.as_slice());
        }
        for node in &simulation.model.barrier.as_ref().expect("a net").nodes {
            take(node.position.as_slice());
            take(node.velocity.as_slice());
        }
        hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
    })
}

/// The same on every machine: what the standard rounds exactly is left to the machine, all else goes through the crate libm, and nothing
/// is fused. `machines.rs` shows it for x86-64 with and without fused multiplication.
#[test]
fn the_last_bit_is_as_it_was() {
    assert_eq!(digest(BarrierModel::SlidingRopes, 1, 6000), "9b26a6045bf85fbe");
    assert_eq!(digest(BarrierModel::Cylinders, 2, 400), "e4f82a00717a9625");
}

#[test]
fn threads_do_not_change_a_bit() {
    let one = digest(BarrierModel::SlidingRopes, 1, 2500);
    assert_eq!(one, digest(BarrierModel::SlidingRopes, 2, 2500));
    assert_eq!(one, digest(BarrierModel::SlidingRopes, 7, 2500));
}
