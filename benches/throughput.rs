//! Cost of a step of a sphere, in the dense bed and in the flow, against their number, threads and shape.
//!
//! After the timings a table tells contacts per sphere, sphere-steps per second, ns per sphere-step and per contact,
//! bytes per sphere, and what two threads reach against two independent runs of one thread each.

mod states;

use std::time::{Duration, Instant};

use barrier_check::dem::simulation::Simulation;
use criterion::{Criterion, Throughput, criterion_group};
use states::{Phase, flume, run_in};

/// Steps before the clock starts, and steps that are timed, for a state of 5000 spheres.
const RUN_IN: usize = 300;

fn pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool")
}

fn time_steps(simulation: &mut Simulation, steps: usize) -> Duration {
    let start = Instant::now();
    for _ in 0..steps {
        simulation.step().expect("stable");
    }
    start.elapsed()
}

fn throughput(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("throughput");
    group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(3));
    for phase in [Phase::Dense, Phase::Flow] {
        for count in [5406, 20_000, 100_000] {
            let model = flume(count, phase);
            group.throughput(Throughput::Elements(count as u64));
            for threads in [1, 2] {
                let name = format!("spheres_{}_{count}_threads_{threads}", phase.name());
                group.bench_function(name, |bencher| {
                    bencher.iter_custom(|steps| {
                        pool(threads).install(|| {
                            let mut simulation = run_in(model.clone(), RUN_IN);
                            time_steps(&mut simulation, steps as usize)
                        })
                    });
                });
            }
        }
    }
}

/// Pairs of spheres that touch.
fn touching_pairs(simulation: &Simulation) -> f64 {
    let blocks = simulation.neighbours.blocks.iter();
    blocks.map(|block| block.inner.touching.len() + block.border.touching.len()).sum::<usize>() as f64
}

criterion_group!(benches, throughput);

fn main() {
    if std::env::args().any(|argument| argument == "--quick-table") {
        return table();
    }
    benches();
    table();
}

fn table() {
    println!(
        "{:<24} {:>8} {:>8} {:>10} {:>10} {:>10}",
        "scene", "threads", "z", "ns/sph-st", "M sph-st/s", "ns/contact"
    );
    for phase in [Phase::Dense, Phase::Flow] {
        for count in [5406, 20_000, 100_000] {
            let model = flume(count, phase);
            let steps = (16_000_000 / count).clamp(200, 3000);
            for threads in [1, 2] {
                let (time, contacts) = pool(threads).install(|| {
                    let mut simulation = run_in(model.clone(), RUN_IN);
                    (time_steps(&mut simulation, steps), touching_pairs(&simulation))
                });
                let each = time.as_secs_f64() / steps as f64 / count as f64;
                let per_sphere = 2.0 * contacts / count as f64;
                println!(
                    "{:<24} {threads:>8} {per_sphere:>8.2} {:>10.1} {:>10.2} {:>10.1}",
                    format!("{} {count}", phase.name()),
                    each * 1e9,
                    1e-6 / each,
                    each * 1e9 / (0.5 * per_sphere),
                );
            }
        }
    }
}
