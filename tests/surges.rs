//! Surges one after another: what is let in adds up, what happened stays, and nothing passes that was not simulated.

use std::sync::atomic::AtomicBool;

use barrier_check::design::read::{DesignFile, read_design};
use barrier_check::pipeline::{Run, Verdict, by_equations, restore, run};
use barrier_check::quantities::{dissipator, incoming, total_force};
use barrier_check::scene::event::RunControl;
use barrier_check::stages::{hardest, stages};

const THREE: &str = include_str!("fixtures/tiny_surges.yaml");
const ONE: &str = include_str!("fixtures/tiny.yaml");

fn file(text: &str) -> DesignFile {
    read_design("x.yaml", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}"))
}

fn simulated(text: &str) -> Run {
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    run(file(text), 1, &watch).expect("a run")
}

#[test]
fn three_surges_come_one_after_another_onto_what_lies_there() {
    let run = simulated(THREE);
    let seen = run.simulated.as_ref().expect("a simulation");
    let histories = &seen.histories;
    let flow = &run.file.design.flow;
    // The second has 0.5 m · 0.6 m · 3 m.
    assert!((flow.volume_of_all() - (0.9 + 0.9 + 1.5)).abs() < 1e-12);
    assert_eq!((histories.surges.len(), seen.starts[0].surges.len()), (2, 3));
    assert!(seen.facts.steady && run.doubts.is_empty(), "{:?}", run.doubts);

    // The mass that is there, at rest, moving or lost, is that of the surges let go.
    let released = |sample: usize| -> f64 {
        let gone = histories.surges.iter().filter(|start| sample >= **start).count();
        (0..=gone).map(|surge| flow.alone(surge).mass).sum::<f64>() / flow.mass_of_all()
    };
    for sample in 0..histories.time.len() {
        // Before the barrier is hit, what is at rest is not told.
        if histories.force[sample].norm() > 0.0 {
            let there = histories.dead[sample] + histories.moving[sample] + histories.lost[sample].iter().sum::<f64>();
            assert!((there - released(sample)).abs() < 1e-6, "{sample}: {there} of {}", released(sample));
        }
    }
    // What comes in brings its energy, and all of it is accounted for.
    let last = histories.ledger.last().expect("a ledger");
    assert!(last.carried_in > 0.0 && last.relative_error(&histories.at_release).abs() < 1e-3);
    assert!(seen.numerics.energy_error.abs() < 1e-3, "{}", seen.numerics.energy_error);

    // The second follows after the time that is given, the third when all rest.
    let let_go = |surge: usize| histories.time[histories.surges[surge - 1] - 1];
    assert!((let_go(1) - 0.8).abs() < 2.0 * seen.facts.sampling, "{}", let_go(1));
    assert!(histories.moving[histories.surges[1] - 1] < 0.02);

    let stages = stages(&run.file.design, seen);
    assert_eq!(stages.len(), 3);
    for pair in stages.windows(2) {
        assert_eq!(pair[0].after, pair[1].before);
        let [[before, _], [in_all, added]] = [&pair[0], &pair[1]].map(|stage| stage.stroke.expect("dissipators"));
        assert!(in_all.mean >= before.mean && (in_all.mean - before.mean - added.mean).abs() < 1e-12);
    }
    assert!(stages[0].before.mean == 0.0 && stages[2].after.mean > stages[0].after.mean);
    // Checks take the worst of all surges.
    let hardest = hardest(&stages).expect("a surge");
    let push = seen.first().one(&total_force::PUSH);
    assert!((stages[hardest].force.mean / push - 1.0).abs() < 0.02);
    let strokes = seen.first().each(&dissipator::STROKE).iter().copied().fold(0.0, f64::max);
    assert!(strokes > 0.01, "the dissipators of this example work");
    let [in_all, _] = stages[2].stroke.expect("dissipators");
    assert!((in_all.mean / strokes - 1.0).abs() < 1e-9);
    assert_eq!(seen.starts[0].surges[2].one(&incoming::DEPOSIT), seen.first().one(&incoming::DEPOSIT));

    // By hand: λ of the first surge on the empty barrier, R = (½ K ρ g' h² + λ ρ v² h) b.
    let unit = 1400.0 * 9.81 * libm::cos(25_f64.to_radians());
    let by_hand = (stages[0].force.mean / 3.0 - 0.5 * unit * 0.36) / (1400.0 * 4.6_f64.powi(2) * 0.6);
    let lambda = stages[0].lambda.expect("room for the flow").mean;
    assert!((lambda / by_hand - 1.0).abs() < 1e-3, "{} {by_hand}", lambda);

    // A surge that was given and not simulated is no PASS.
    let mut cut = seen.clone();
    cut.starts[0].surges.pop();
    let told = restore(file(THREE), Some(cut), Vec::new(), Vec::new());
    assert!(told.doubts.iter().any(|doubt| doubt.contains("surge 3 was not simulated")), "{:?}", told.doubts);
    assert_ne!(told.verdict, Verdict::Pass);
}

#[test]
fn a_list_of_one_surge_is_that_surge() {
    let listed = ONE
        .replace("  volume: 1.2 m3                       # with pores; or give the mass instead\n", "")
        .replace("    surge:  ", "    surges:  ")
        .replace(
            "      depth: 0.6 m\n      velocity: 4.6 m/s\n",
            "      - {volume: 1.2 m3, depth: 0.6 m, velocity: 4.6 m/s}\n",
        );
    let [alone, listed] = [ONE, &listed].map(|text| file(text).design);
    assert_eq!(alone, listed);
}

/// The equations alone take the hardest of the surges, whichever it is.
#[test]
fn the_equations_take_every_surge() {
    let largest = |velocity: &str| {
        let text = THREE.replace(
            "{volume: 1.5 m3, depth: 0.5 m, velocity: 4 m/s",
            &format!("{{volume: 1.5 m3, depth: 0.5 m, velocity: {velocity}"),
        );
        barrier_check::guideline::guideline(&file(&text).design).largest_force
    };
    assert_eq!(largest("4 m/s"), largest("3 m/s"));
    assert!(largest("7 m/s") > 1.5 * largest("4 m/s"));
}

/// A wall in a ravine under two surges; the event is over before it is cleared.
fn two_surges(first: &str, second: &str, change: [&str; 2]) -> String {
    let text = format!(
        "
project: {{name: Ravine, barrier: Wall}}
channel: {{width: 8 m, slope: 14 deg, wall_height: 8 m, base_friction: 12 deg, side_friction: 10 deg, barrier_friction: 20 deg}}
flow:
  bulk_density: 1750 kg/m3
  solid_density: 2800 kg/m3
  grain_sizes: {{curve: {{d1: 60 mm, d50: 120 mm, d99: 200 mm}}}}
  grain_friction: 38 deg
  contact_modulus: 1 GPa
  arrival: {{surges: [{{volume: 20 m3, {first}}}, {{volume: 20 m3, {second}}}]}}
barrier:
  rigid_wall: {{height: 6 m, tilt: 0 deg, resistance: 200 MN, moment_resistance: 40 MN m/m, resistance_factor: 1.5}}
limits: {{retained_mass: 80 %}}
factors: {{earth_pressure_k: 1.5, dynamic_lambda: 4, load: 1.35}}
loads: {{filling: one_event}}
"
    );
    assert!(change[0].is_empty() || text.contains(change[0]), "{change:?}");
    text.replacen(change[0], change[1], usize::from(!change[0].is_empty()))
}

/// Whatever the equations hold of the first surge they hold of a later one: formulas outside their range, the hit of the largest grain, a front like a
/// block, a run-up by energy that is no bound.
#[test]
fn the_order_of_the_surges_changes_no_verdict_of_the_equations() {
    let slow = "depth: 1.2 m, velocity: 3 m/s";
    let fast = "depth: 0.4 m, velocity: 6 m/s";
    let like = "depth: 0.5 m, velocity: 3.6 m/s";
    let coarse = "depth: 1.1 m, velocity: 12 m/s, grain_sizes: {uniform: {min: 700 mm, max: 900 mm}}";
    let block = "depth: 0.5 m, velocity: 3.6 m/s, front_angle: 90 deg, run_in: 0 m";
    for (pair, change, opened) in [
        ([fast, slow], ["dynamic_lambda: 4", "dynamic_lambda: 1.6"], "Froude number"),
        ([like, coarse], ["moment_resistance: 40 MN m/m", "moment_resistance: 6 MN m/m"], "the largest stone"),
        ([like, block], ["", ""], "run the simulation"),
        (
            [fast, slow],
            ["retained_mass: 80 %", "retained_mass: 80 %, freeboard: 0.5 m, run_up: energy"],
            "by energy is lower",
        ),
    ] {
        let verdicts = |first: &str, second: &str| {
            let run = by_equations(file(&two_surges(first, second, change)));
            let told = run
                .outcomes
                .iter()
                .any(|outcome| outcome.open.as_ref().is_some_and(|open| open.words().contains(opened)));
            assert!(told, "{opened} with {first} before {second}");
            run.outcomes.into_iter().map(|outcome| (outcome.id, outcome.verdict)).collect::<Vec<_>>()
        };
        assert_eq!(verdicts(pair[0], pair[1]), verdicts(pair[1], pair[0]), "{opened}");
    }
}

/// Half of the second surge is finer than anything that is given of it, and may pass a net.
#[test]
fn what_is_not_given_of_a_later_surge_is_not_held() {
    let given = THREE
        .replace("d30: 220 mm", "d1: 100 mm\n      d30: 220 mm")
        .replace("uniform: {min: 200 mm, max: 260 mm}", "curve: {d50: 230 mm, d90: 300 mm}");
    let run = simulated(&given);
    let held = run.outcomes.iter().find(|outcome| outcome.id == "retained_mass").expect("a check");
    assert!(held.open.as_ref().is_some_and(|open| open.words().contains("the finest 23 %")), "{held:?}");
}
