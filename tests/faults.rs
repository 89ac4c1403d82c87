//! Faults put into a run on purpose: each must be noticed, soon, by name, and must never end in a pass.

use std::sync::atomic::AtomicBool;

use barrier_check::checks::credibility::{ENERGY_LIMIT, doubts};
use barrier_check::design::Design;
use barrier_check::design::read::{DesignFile, read_design};
use barrier_check::fidelity::choose;
use barrier_check::pipeline::{Verdict, run};
use barrier_check::scene::build::{Scene, build};
use barrier_check::scene::event::{Ending, Event, Ongoing, RunControl};
use barrier_check::simulated::numerics;
use dem::Vec3;
use dem::recorders::recorder::Recorder;
use dem::simulation::Simulation;

fn file() -> DesignFile {
    read_design("tiny.yaml", include_bytes!("fixtures/tiny.yaml")).expect("a design")
}

fn watched<T>(work: impl FnOnce(&RunControl) -> T) -> T {
    work(&RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None })
}

/// The event with a fault in its scene at the moment of release.
fn with(fault: impl FnOnce(&mut Scene)) -> Event {
    let design = file().design;
    let mut scene = build(&design, &choose(&design), 1).expect("a scene");
    fault(&mut scene);
    watched(|watch| Ongoing::begin(scene).go_on(&design, 1, watch, |_, _| ()))
}

/// What is told of the event; it must be something.
fn told(event: &Event) -> String {
    let told = doubts(&numerics(event)).join("; ");
    assert!(!told.is_empty(), "nothing is noticed");
    told
}

/// Steps within which a value that is not finite, or out of all bounds, must end a run.
const SOON: u64 = 2000;

fn breaks_down_soon(fault: impl FnOnce(&mut Scene), named: &str) {
    let mut before = 0;
    let event = with(|scene| {
        before = scene.simulation.steps;
        fault(scene);
    });
    assert!(matches!(event.ending, Ending::BrokeDown(_)), "{:?}", event.ending);
    let steps = event.simulation.steps - before;
    assert!(steps <= SOON, "noticed after {steps} steps");
    assert!(told(&event).contains(named), "{}", told(&event));
}

#[test]
fn values_that_are_not_finite() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        breaks_down_soon(|scene| scene.simulation.grains.place[7].0[1] = value, "left all bounds");
        breaks_down_soon(|scene| scene.simulation.grains.motion[7].0[0] = value, "left all bounds");
        breaks_down_soon(
            |scene| scene.simulation.model.barrier.as_mut().expect("a net").nodes[40].position.z = value,
            "barrier node 40 left all bounds",
        );
        breaks_down_soon(
            |scene| scene.simulation.model.barrier.as_mut().expect("a net").segments[9].stiffness = value.abs(),
            "broke down",
        );
    }
}

#[test]
fn speeds_that_nothing_honest_has() {
    let fast = Vec3::new(1e5, 0.0, 0.0);
    breaks_down_soon(|scene| scene.simulation.grains.motion[3].set_vector(&fast), "left all bounds");
    breaks_down_soon(
        |scene| scene.simulation.model.barrier.as_mut().expect("a net").nodes[40].velocity.x = 1e5,
        "barrier node",
    );
}

#[test]
fn a_step_far_beyond_the_critical_one() {
    // Watched, it is told or cut until it is none; a barrier that grows ever so stiff leaves none.
    let stiffen = |factor: f64| {
        move |scene: &mut Scene| {
            let barrier = scene.simulation.model.barrier.as_mut().expect("a net");
            barrier.segments.iter_mut().for_each(|segment| segment.stiffness *= factor);
        }
    };
    breaks_down_soon(stiffen(1e3), "broke down");
    breaks_down_soon(stiffen(1e9), "broke down");
    let stiffer = with(stiffen(8.0));
    assert!(stiffer.simulation.step_cuts > 0 || matches!(stiffer.ending, Ending::BrokeDown(_)));
    // Not watched, the energy account tells, or the grains are gone.
    let unwatched = with(|scene| {
        scene.simulation.audited = false;
        scene.simulation.time_step *= 4.0;
    });
    let told = told(&unwatched);
    assert!(told.contains("energy") || told.contains("left all bounds") || told.contains("overlap"), "{told}");
}

/// All grains five percent faster, from one step to the next, after the account was opened.
#[test]
fn energy_from_nowhere() {
    let design = file().design;
    let Scene { mut simulation, recorder, .. } = build(&design, &choose(&design), 1).expect("a scene");
    let mut recorder = Recorder::new(recorder);
    let mut samples = |simulation: &mut Simulation, count: usize| {
        while recorder.histories.ledger.len() < count {
            recorder.step(simulation).expect("stable");
        }
        simulation.ledger.relative_error(&recorder.histories.ledger[0])
    };
    assert!(samples(&mut simulation, 5).abs() < 1e-3);
    for motion in &mut simulation.grains.motion {
        let faster = motion.vector() * 1.05;
        motion.set_vector(&faster);
    }
    let error = samples(&mut simulation, 6);
    assert!(error.abs() > ENERGY_LIMIT, "{error}");
}

#[test]
fn grains_pressed_into_each_other() {
    let event = with(|scene| scene.simulation.model.material.modulus *= 1e-4);
    assert!(told(&event).contains("overlap"), "{}", told(&event));
}

#[test]
fn grains_shot_through_the_net() {
    let event = with(|scene| {
        // Straight at a knot of the net, faster than a step can hold.
        let knot = scene.simulation.model.barrier.as_ref().expect("a net").nodes[40].position;
        for row in 0..5 {
            scene.simulation.put(row, &(knot - Vec3::new(0.5 + 0.5 * row as f64, 0.0, 0.0)));
            scene.simulation.grains.motion[row].set_vector(&Vec3::new(90.0, 0.0, 0.0));
        }
    });
    let told = told(&event);
    let named = ["slipped through a rope", "overlap", "left all bounds"];
    assert!(named.iter().any(|name| told.contains(name)), "{told}");
}

#[test]
fn grains_outside_the_channel() {
    let width = file().design.channel.width;
    for place in [Vec3::new(-3.0, width + 1.0, 0.5), Vec3::new(-3.0, -1.0, 0.5), Vec3::new(-3.0, 0.5 * width, -2.0)] {
        let event = with(|scene| scene.simulation.put(0, &place));
        assert!(
            told(&event).contains("gone through the bed or a side wall") || told(&event).contains("left all bounds"),
            "{}",
            told(&event)
        );
    }
}

/// The verdict of the whole run with the design changed.
fn verdict(change: impl FnOnce(&mut Design)) -> (Verdict, Vec<String>) {
    let mut file = file();
    change(&mut file.design);
    watched(|watch| run(file, 1, watch).map(|run| (run.verdict, run.doubts))).expect("a run")
}

#[test]
fn a_run_that_is_stopped_before_rest_or_never_met_the_barrier_is_undecided() {
    let (ended, doubts) = verdict(|design| design.simulation.longest = 0.3);
    assert_eq!(ended, Verdict::Undecided);
    assert!(doubts.join("").contains("had not come to rest"), "{doubts:?}");
    let (missed, doubts) = verdict(|design| {
        design.channel.slope = 0.0;
        design.channel.base_friction = 5.0;
        if let barrier_check::design::Arrival::Surge(surge) = &mut design.flow.arrival {
            surge.velocity = 0.05;
        }
    });
    assert_eq!(missed, Verdict::Undecided, "{doubts:?}");
    let mut event = with(|_| ());
    assert!(event.ending == Ending::Steady && !numerics(&event).missed && !numerics(&event).unfinished);
    event.histories.force.iter_mut().for_each(|force| *force = Vec3::zeros());
    assert!(told(&event).contains("without ever touching the barrier"), "{}", told(&event));
}

/// Each packing's doubts count, and an input whose runs cannot be relied on is said to say nothing.
#[test]
fn what_other_packings_and_varied_inputs_cannot_tell_is_told() {
    let mut file = file();
    file.design.simulation.longest = 0.3;
    let run = watched(|watch| {
        let mut run = run(file, 2, watch)?;
        barrier_check::pipeline::vary(&mut run, watch)?;
        Ok::<_, barrier_check::simulated::RunError>(run)
    })
    .expect("a run");
    assert_eq!(run.verdict, Verdict::Undecided);
    for seed in ["seed 1: ", "seed 2: "] {
        assert!(
            run.doubts.iter().any(|doubt| doubt.starts_with(seed) && doubt.contains("come to rest")),
            "{:?}",
            run.doubts
        );
    }
    assert!(!run.varied.is_empty());
    assert!(run.varied.iter().all(|swing| swing.down.utilisation.is_none() && swing.up.utilisation.is_none()));
}

#[test]
fn dissipators_past_their_stroke_are_no_pass() {
    let (used_up, _) = verdict(|design| {
        if let barrier_check::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier {
            let dissipators = net.dissipators.as_mut().expect("dissipators");
            (dissipators.plateau, dissipators.stroke) = (5e3, 0.01);
        }
    });
    assert_ne!(used_up, Verdict::Pass);
}

/// A terminal that is full or gone ends no command: what its product is says so, the others do their work.
#[cfg(target_os = "linux")]
#[test]
fn a_full_or_closed_terminal_ends_nothing() {
    use std::process::Stdio;
    let full = || Stdio::from(std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a full device"));
    let out = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("full_terminal");
    let out = out.to_str().expect("path");
    let run = |arguments: &[&str], stdout: Stdio, stderr: Stdio| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_barrier-check"));
        command.args(arguments).stdout(stdout).stderr(stderr).status().expect("the program starts").code()
    };
    assert_eq!(run(&["schema", "design"], full(), Stdio::null()), Some(2));
    assert_eq!(run(&["schema", "result"], full(), full()), Some(2));
    // The verdict is that of a terminal that listens.
    let loads = ["loads", "tests/fixtures/tiny.yaml", "--out", out];
    assert_eq!(run(&loads, full(), full()), run(&loads, Stdio::null(), Stdio::null()));
    assert_eq!(run(&["compare", out, out], full(), full()), run(&["compare", out, out], Stdio::null(), Stdio::null()));
    assert_eq!(run(&["report", "nowhere"], full(), full()), Some(2));
    assert_eq!(run(&["resume", "nowhere"], full(), full()), Some(2));
    assert_eq!(run(&["validate", "nothing"], full(), full()), Some(2));
}
