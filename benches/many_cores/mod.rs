//! What many cores would bring, told by dealing the recorded parts of one thread's work out to any number of workers ([`dem::schedule`]).

use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;

use barrier_check::design::read::read_design;
use barrier_check::pipeline::run;
use barrier_check::scene::event::RunControl;
use dem::schedule::{Stretch, record, time};

const WORKERS: [usize; 6] = [2, 4, 8, 16, 32, 64];

pub fn heading(message: f64) {
    let told: String = WORKERS.iter().map(|workers| format!(" {workers:>5}")).collect();
    println!("efficiency on many cores by the model, where a message takes {:.0} ns", message * 1e9);
    println!("{:<40} {:>8} {:>7}{told}", "", "s", "alone");
}

/// One row of the table: time of one thread, the share that is not shared out, and the efficiency on more.
fn tell(name: &str, stretches: &[Stretch], message: f64) {
    let all = time(stretches, 1, message);
    let alone: f64 = stretches.iter().filter(|s| s.first.len() < 2).map(Stretch::work).sum::<f64>()
        + stretches.iter().map(|s| s.alone).sum::<f64>();
    let efficiency = |workers: usize| all / (workers as f64 * time(stretches, workers, message));
    let told: String = WORKERS.iter().map(|&workers| format!(" {:>5.2}", efficiency(workers))).collect();
    println!("{name:<40} {all:>8.3} {:>5.1} %{told}", 100.0 * alone / all);
}

/// The table's row for some steps of a simulation.
pub fn tell_steps(name: &str, message: f64, steps: impl FnOnce()) {
    let ((), stretches) = record(steps);
    tell(name, &stretches, message);
}

/// Rows for the whole run of a design: in all, and for each place in the code that shares work out.
pub fn tell_design(path: &str, message: f64) {
    let text = std::fs::read(path).expect("design file");
    let design = read_design(path, &text).unwrap_or_else(|_| panic!("{path} is no design"));
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    let (_, stretches) = record(|| run(design, 1, &watch).map(|run| run.verdict));
    tell(path, &stretches, message);
    let mut places = BTreeMap::<String, Vec<Stretch>>::new();
    for stretch in stretches {
        places
            .entry(format!("  before and at {}:{}", stretch.place.file(), stretch.place.line()))
            .or_default()
            .push(stretch);
    }
    places.iter().for_each(|(place, stretches)| tell(place, stretches, message));
}
