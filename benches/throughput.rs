//! Cost of a step: in the dense bed, in the flow and at the impact, against the number of grains, threads and shape.
//!
//!     cargo bench                      timings by criterion, then the table
//!     cargo bench -- --table           the table alone
//!     cargo bench -- --elements        what the elements of a barrier cost
//!     cargo bench -- --cores [DESIGN]  what up to 64 cores would bring, for the states or the run of a design; `--message NS` gives the time
//!                                      of a message between threads instead of measuring it
//!     benches/peers/compare.sh         beside LAMMPS, LIGGGHTS and Yade, on the same states
//!
//! The table tells contacts per sphere z, ns per sphere-step, sphere-steps per second, ns per contact and bytes per sphere;
//! and what two threads reach against two independent runs of one thread each at the same time, on the same machine. How well two
//! threads work together depends on how far apart their cores are, and a virtual machine's cores may be moved at any time; so each
//! such row tells how long a message from one thread to the other took just then.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a bench prints its table")]
#![allow(unsafe_code)] // it counts what is allocated

mod cells;
mod many_cores;
mod states;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use barrier_check::validation::barrier::ring_panel::{FOUR, SIX, ring_panel};
use barrier_check::validation::barrier::stand::{cantilever, line, rope};
use criterion::{Criterion, Throughput, criterion_group};
use dem::Vec3;
use dem::contact::law::LawConstants;
use dem::contact::material::Material;
use dem::neighbours::broad_phase::{Box3, BoxTree};
use dem::net::pull_all;
use dem::simd::widest::{Vectors, limit};
use dem::simulation::Simulation;
use dem::tables::barrier::Barrier;
use dem::tables::grains::GrainShape;
use dem::workers::gather;
use states::{Phase, RADIUS, SKIN, State};

/// Steps before the clock starts.
const RUN_IN: usize = 300;
/// Sphere-steps that a row of the table times.
const SPHERE_STEPS: usize = 16_000_000;

/// Counts the bytes in use.
struct Counting;

static IN_USE: AtomicUsize = AtomicUsize::new(0);

// SAFETY: hands every call to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        IN_USE.fetch_add(layout.size(), Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        IN_USE.fetch_sub(layout.size(), Ordering::Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const STATES: [State; 13] = {
    const fn spheres(phase: Phase, count: usize) -> State {
        State { shape: GrainShape::Sphere, phase, count, field: false, boulders: false }
    }
    const fn clumps(phase: Phase) -> State {
        State { shape: GrainShape::Clump, phase, count: 5406, field: false, boulders: false }
    }
    [
        spheres(Phase::Dense, 5406),
        spheres(Phase::Dense, 20_000),
        spheres(Phase::Dense, 100_000),
        spheres(Phase::Flow, 5406),
        spheres(Phase::Flow, 20_000),
        spheres(Phase::Flow, 100_000),
        clumps(Phase::Dense),
        clumps(Phase::Flow),
        clumps(Phase::Impact),
        State { field: true, ..spheres(Phase::Dense, 20_000) },
        State { field: true, ..spheres(Phase::Flow, 20_000) },
        State { boulders: true, ..spheres(Phase::Dense, 20_000) },
        State { boulders: true, ..spheres(Phase::Flow, 20_000) },
    ]
};

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
    let mut group = criterion.benchmark_group("step");
    group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(3));
    for state in STATES {
        let model = state.model();
        for threads in [1, 2] {
            let pool = pool(threads);
            let mut simulation = pool.install(|| state.run_in(model.clone(), RUN_IN));
            group.throughput(Throughput::Elements(simulation.grains.members() as u64));
            group.bench_function(format!("{}/threads_{threads}", state.name()), |bencher| {
                bencher.iter_custom(|steps| pool.install(|| gather(|| time_steps(&mut simulation, steps as usize))));
            });
        }
    }
}

criterion_group!(benches, throughput);

fn main() {
    let after = |flag: &'static str| std::env::args().skip_while(move |argument| argument != flag).skip(1);
    if let Some(name) = after("--vectors").next() {
        limit(match name.as_str() {
            "plain" => Vectors::Plain,
            "avx2" => Vectors::Avx2,
            _ => Vectors::Avx512,
        });
    }
    let mut arguments = after("--one");
    if let Some(name) = arguments.next() {
        return tell_one(&name);
    }
    let mut arguments = std::env::args().skip_while(|argument| argument != "--cores");
    if arguments.next().is_some() {
        let designs: Vec<String> = arguments.filter(|argument| argument.ends_with(".yaml")).collect();
        return tell_cores(&designs);
    }
    if std::env::args().any(|argument| argument == "--elements") {
        return tell_all_elements();
    }
    if !std::env::args().any(|argument| argument == "--table") {
        benches();
    }
    println!(
        "{:<22} {:>7} {:>6} {:>10} {:>10} {:>10} {:>9} {:>9} {:>7}",
        "state", "threads", "z", "ns/sph-st", "M sph-st/s", "ns/contact", "ms/step", "bytes/sph", "of two"
    );
    STATES.iter().for_each(tell);
    println!();
    tell_all_elements();
    println!(
        "\nbroad phase, one thread: tree made anew, tree refitted, cell list (ms); refitting over all work of a run"
    );
    STATES
        .iter()
        .filter(|state| state.shape == GrainShape::Sphere && !state.field && !state.boulders)
        .for_each(tell_broad_phase);
}

fn tell_all_elements() {
    println!(
        "barrier, one thread: ns per element and step: tension-only segments, cylinders that bend, rings with four contacts, and with six"
    );
    [100, 1000, 10_000].into_iter().for_each(tell_elements);
}

/// What the elements of a barrier cost, and how that grows with their number.
fn tell_elements(count: usize) {
    const ELEMENT_STEPS: usize = 4_000_000;
    let end = Vec3::new(0.07 * count as f64, 0.0, 0.0);
    let across = (count as f64).sqrt() as i32;
    let rings = [FOUR, SIX].map(|lattice| {
        let mut taut = ring_panel(lattice, across);
        // Drawn apart, so that every ring pulls.
        taut.nodes.iter_mut().for_each(|node| node.position *= 1.06);
        taut
    });
    let ropes = [rope(&line(Vec3::zeros(), end, count), [true, true], 0.99), cantilever(end.x, count)];
    let law = LawConstants::of(&Material::new(1.0, 0.3, 0.0), 1e-5);
    let cost = |barrier: &Barrier| {
        let count = barrier.segments.len() + barrier.cylinders.len() + barrier.net_rings.len();
        let rounds = ELEMENT_STEPS / count;
        let start = Instant::now();
        for _ in 0..rounds {
            std::hint::black_box(pull_all(std::hint::black_box(barrier), &law));
        }
        start.elapsed().as_nanos() as f64 / (rounds * count) as f64
    };
    let told: String = ropes.iter().chain(&rings).map(|barrier| format!(" {:>8.1}", cost(barrier))).collect();
    println!("{count:>6} elements{told}");
}

/// What the search for neighbours costs, by rapier's tree and by a cell list, and its share of a run.
fn tell_broad_phase(state: &State) {
    let grains = state.model().grains;
    let (reach, half) = (2.0 * RADIUS * (1.0 + 0.5 * SKIN), RADIUS * (1.0 + 0.5 * SKIN));
    let boxes: Vec<Box3> = grains.iter().map(|grain| Box3::around(&grain.position, half)).collect();
    let mut tree = BoxTree::default();
    let search = |tree: &mut BoxTree| {
        let mut near = 0;
        tree.fit(&boxes);
        tree.pairs(|a, b| {
            let between = grains[a as usize].position - grains[b as usize].position;
            near += usize::from(between.norm_squared() < reach * reach);
        });
        near
    };
    let timed = |work: &mut dyn FnMut() -> usize| {
        let start = Instant::now();
        let found = work();
        (start.elapsed().as_secs_f64(), found)
    };
    let (anew, by_tree) = timed(&mut || search(&mut tree));
    let (refitted, again) = timed(&mut || search(&mut tree));
    let (cells, by_cells) = timed(&mut || cells::pairs(&grains, reach).len());
    assert!(by_tree == by_cells && again == by_cells, "tree {by_tree}, {again} and cells {by_cells} disagree");
    let (steps, mut simulation) = ((SPHERE_STEPS / grains.len()).max(100), state.run_in(state.model(), RUN_IN));
    let before = simulation.neighbours.renewals;
    let run = pool(1).install(|| time_steps(&mut simulation, steps)).as_secs_f64();
    let share = (simulation.neighbours.renewals - before) as f64 * refitted / run;
    println!(
        "{:<22} {:>9.2} {:>9.2} {:>9.2}   {:>5.1} %",
        state.name(),
        anew * 1e3,
        refitted * 1e3,
        cells * 1e3,
        100.0 * share
    );
}

/// ns per sphere-step and per contact of one state on one thread, for scripts.
fn tell_one(name: &str) {
    let Some(state) = STATES.iter().find(|state| state.name() == name) else {
        eprintln!("no such state: {name}");
        std::process::exit(2);
    };
    pool(1).install(|| {
        let mut simulation = state.run_in(state.model(), RUN_IN);
        let spheres = simulation.grains.members();
        let steps = (SPHERE_STEPS / spheres).max(100);
        let time = time_steps(&mut simulation, steps).as_secs_f64();
        let [sphere, contact] = [spheres as f64, touching_pairs(&simulation)].map(|n| time * 1e9 / (steps as f64 * n));
        println!("{sphere:.1} ns per sphere-step, {contact:.1} ns per contact");
    });
}

/// What many cores would bring, for the runs of the given designs or, if there are none, for the states.
fn tell_cores(designs: &[String]) {
    // On a busy machine messages take as long as the other threads' turns.
    let given = std::env::args().skip_while(|argument| argument != "--message").nth(1);
    let message = 1e-9 * given.and_then(|given| given.parse().ok()).unwrap_or_else(message_time);
    many_cores::heading(message);
    pool(1).install(|| {
        designs.iter().for_each(|path| many_cores::tell_design(path, message));
        for state in STATES.iter().filter(|_| designs.is_empty()) {
            let steps = (SPHERE_STEPS / 4 / state.count).max(100);
            let mut simulation = state.run_in(state.model(), RUN_IN);
            many_cores::tell_steps(&state.name(), message, || {
                time_steps(&mut simulation, steps);
            });
        }
    });
}

/// Rows of the table for one state: on one thread, on two, and two runs side by side.
fn tell(state: &State) {
    let model = state.model();
    let spheres = model.grains.len() * model.shape.members();
    let steps = (SPHERE_STEPS / spheres).max(100);
    let alone = row(state, 1, steps);
    let together = row(state, 2, steps);
    let message = message_time();
    let pair = two_runs(state, steps);
    let share = pair / together;
    println!(
        "{:<22} {:>7} {:>17.1} {:>62.2}   two threads over two runs; one thread {:.2} of them; a message takes {message:.0} ns",
        state.name(),
        "2 runs",
        pair * 1e9 / spheres as f64,
        share,
        pair / alone
    );
}

/// Times one state and prints its row; returns the time of a step (s).
fn row(state: &State, threads: usize, steps: usize) -> f64 {
    let timed = || {
        let model = state.model();
        let before = IN_USE.load(Ordering::Relaxed);
        let grains = model.grains.len() * size_of_val(&model.grains[0]);
        let mut simulation = state.run_in(model, RUN_IN);
        let time = time_steps(&mut simulation, steps).as_secs_f64() / steps as f64;
        let bytes = IN_USE.load(Ordering::Relaxed) + grains - before;
        let spheres = simulation.grains.members() as f64;
        let contacts = touching_pairs(&simulation);
        println!(
            "{:<22} {threads:>7} {:>6.2} {:>10.1} {:>10.2} {:>10.1} {:>9.3} {:>9.0}",
            state.name(),
            2.0 * contacts / spheres,
            time * 1e9 / spheres,
            1e-6 * spheres / time,
            time * 1e9 / contacts,
            time * 1e3,
            bytes as f64 / spheres,
        );
        time
    };
    pool(threads).install(|| gather(timed))
}

/// Time per step that two runs of one thread each need together, counted as if they shared one run (s).
fn two_runs(state: &State, steps: usize) -> f64 {
    let barrier = std::sync::Barrier::new(2);
    let times: Vec<f64> = std::thread::scope(|scope| {
        let run = || {
            pool(1).install(|| {
                let mut simulation = state.run_in(state.model(), RUN_IN);
                barrier.wait();
                time_steps(&mut simulation, steps).as_secs_f64() / steps as f64
            })
        };
        let runs = [scope.spawn(run), scope.spawn(run)];
        runs.into_iter().map(|run| run.join().expect("run ends")).collect()
    });
    // Each made one step in this time: together two, so one in half of it.
    0.25 * (times[0] + times[1])
}

/// Time in which one thread hears from another (ns).
fn message_time() -> f64 {
    const ROUNDS: u64 = 100_000;
    let turn = AtomicUsize::new(0);
    let take_turns = |mine: usize| {
        for _ in 0..ROUNDS {
            while turn.load(Ordering::Acquire) != mine {
                std::hint::spin_loop();
            }
            turn.store(1 - mine, Ordering::Release);
        }
    };
    let start = Instant::now();
    std::thread::scope(|scope| {
        scope.spawn(|| take_turns(1));
        take_turns(0);
    });
    start.elapsed().as_nanos() as f64 / (2 * ROUNDS) as f64
}

/// Pairs of spheres that touch.
fn touching_pairs(simulation: &Simulation) -> f64 {
    let blocks = simulation.neighbours.blocks.iter();
    blocks.map(|block| block.inner.touching.len() + block.border.touching.len()).sum::<usize>() as f64
}
