//! A flow that comes in by its hydrograph: what has come in follows the table, nothing overlaps, every account is closed.

use std::sync::atomic::AtomicBool;

use barrier_check::design::Design;
use barrier_check::design::entries::Purpose;
use barrier_check::design::read::{DesignFile, read_design, read_design_for};
use barrier_check::fidelity::choose;
use barrier_check::guideline::{flows, guideline};
use barrier_check::pipeline::{Run, Verdict, run};
use barrier_check::quantities::mass;
use barrier_check::scene::build::build;
use barrier_check::scene::event::RunControl;
use barrier_check::scene::flow::packing::overlaps;

const TINY: &str = include_str!("fixtures/tiny_inlet.yaml");

fn design(text: &str) -> Design {
    file(text).design
}

fn file(text: &str) -> DesignFile {
    read_design("x.yaml", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}"))
}

fn simulated(file: DesignFile) -> Run {
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    run(file, 1, &watch).expect("a run")
}

/// Finer grains, so that one of them is little of the whole, and a table of times (s), depths (m) and velocities (m/s).
fn with_table(rows: &[[f64; 3]], width: &str) -> String {
    let list = |column: usize, unit: &str| {
        rows.iter().map(|row| format!("{} {unit}", row[column])).collect::<Vec<_>>().join(", ")
    };
    let lists = format!("times: [{}], depths: [{}], velocities: [{}]", list(0, "s"), list(1, "m"), list(2, "m/s"));
    let (before, rest) = TINY.split_once("hydrograph: {").expect("a table");
    let (_, after) = rest.split_once(", run_in").expect("its end");
    let finer =
        [("d30: 220", "d30: 110"), ("d50: 260", "d50: 130"), ("d70: 300", "d70: 150"), ("d90: 360", "d90: 180")];
    let text = format!("{before}hydrograph: {{{lists}, run_in{after}");
    finer.into_iter().fold(text.replace("width: 3 m", width), |text, (from, to)| text.replace(from, to))
}

/// A block, a triangle, a steep front with a long tail, two waves, and one that fades to nothing.
const SHAPES: [&[[f64; 3]]; 5] = [
    &[[0.0, 0.5, 4.0], [1.4, 0.5, 4.0]],
    &[[0.0, 0.0, 3.0], [0.8, 0.8, 5.0], [1.6, 0.0, 3.0]],
    &[[0.0, 0.9, 6.0], [0.2, 0.8, 5.5], [0.6, 0.4, 4.0], [2.0, 0.15, 3.0]],
    &[[0.0, 0.3, 4.0], [0.4, 0.7, 5.0], [0.8, 0.3, 4.0], [1.2, 0.7, 5.0], [1.6, 0.3, 4.0]],
    &[[0.0, 0.6, 5.0], [1.0, 0.5, 3.0], [2.0, 0.0, 0.0]],
];

/// Mass within 1 % of the whole and momentum within 2 % at all times, and at the end all of it; nothing overlaps by more than a packing may
/// where it comes in.
#[test]
fn what_comes_in_follows_the_table() {
    for (shape, rows) in SHAPES.iter().enumerate() {
        let design = design(&with_table(rows, "width: 1.4 m"));
        let (hydrograph, section) = (design.flow.hydrograph.clone().expect("a table"), design.channel.section());
        let mut scene = build(&design, &choose(&design), 3).expect("a scene");
        let mut feed = scene.feed.take().expect("an inlet");
        let (density, last) = (design.flow.bulk_density, hydrograph.duration());
        let [whole, whole_momentum] = [hydrograph.volume(&section, last), hydrograph.momentum(&section, last)];
        assert!((density * whole / design.flow.mass - 1.0).abs() < 1e-9, "{shape}");
        let [mut off, mut off_in_momentum] = [0.0_f64; 2];
        while scene.simulation.time < last + 0.1 {
            scene.simulation.step().expect("a step");
            if scene.simulation.steps.is_multiple_of(20) {
                let before = scene.simulation.grains.len();
                feed.go_on(&design, &mut scene.simulation).expect("room");
                let grains = scene.simulation.snapshot();
                let (there, came) = grains.split_at(before);
                assert!(came.is_empty() || !overlaps(came, there.iter()), "{shape}: they overlap");
            }
            let time = scene.simulation.time;
            let passed = scene.simulation.model.inlet.as_ref().expect("an inlet").passed;
            off = off.max((passed[0] - density * hydrograph.volume(&section, time)).abs() / (density * whole));
            let momentum = density * hydrograph.momentum(&section, time);
            off_in_momentum = off_in_momentum.max((passed[1] - momentum).abs() / (density * whole_momentum));
        }
        let passed = scene.simulation.model.inlet.as_ref().expect("an inlet").passed;
        assert!(feed.is_over() && (passed[0] / design.flow.mass - 1.0).abs() < 1e-9, "{shape}: {passed:?}");
        assert!((passed[1] / (density * whole_momentum) - 1.0).abs() < 0.02, "{shape}: {passed:?}");
        assert!(off < 0.01 && off_in_momentum < 0.02, "{shape}: mass {off}, momentum {off_in_momentum}");
    }
}

#[test]
fn a_run_closes_its_accounts_and_judges_the_whole() {
    let run = simulated(file(TINY));
    let seen = run.simulated.as_ref().expect("a simulation");
    let histories = &seen.histories;
    assert!(seen.facts.steady && run.doubts.is_empty(), "{:?}", run.doubts);
    assert!(seen.numerics.energy_error.abs() < 1e-3, "{}", seen.numerics.energy_error);
    let flow = &run.file.design.flow;
    let [mass, ..] = *histories.entered.last().expect("what came in");
    assert!((mass / flow.mass - 1.0).abs() < 1e-9);
    // All of it is there at the end, at rest, moving or lost.
    let last = histories.time.len() - 1;
    let there = histories.dead[last] + histories.moving[last] + histories.lost[last].iter().sum::<f64>();
    assert!((there - 1.0).abs() < 1e-6, "{there}");
    assert!(seen.first().one(&mass::RETAINED) > 0.9 && seen.facts.grains > 50);
}

/// Where the deposit stands in the way of what comes in there is a doubt, and no PASS.
#[test]
fn a_flow_that_backs_up_to_its_inlet_is_no_pass() {
    let near = TINY.replace("run_in: 2 m", "run_in: 0 m").replace("0.4 s", "0.8 s").replace("0.9 s", "1.6 s");
    let run = simulated(file(&near));
    assert_ne!(run.verdict, Verdict::Pass);
    assert!(run.doubts.iter().any(|doubt| doubt.contains("inlet") || doubt.contains("come in")), "{:?}", run.doubts);
}

/// The equations take the hardest moments, each for itself, that of the largest momentum first.
#[test]
fn the_equations_take_the_hardest_moments() {
    let design =
        design(&with_table(&[[0.0, 0.2, 6.0], [1.0, 0.8, 5.0], [2.0, 1.1, 2.0], [3.0, 0.1, 1.0]], "width: 3 m"));
    let guideline = guideline(&design);
    let taken: Vec<[f64; 2]> = flows(&design, guideline.input).iter().map(|flow| [flow.depth, flow.velocity]).collect();
    assert_eq!(taken[0], [0.8, 5.0]);
    for [depth, velocity] in [[1.1, 2.0], [0.2, 6.0]] {
        // Or a little more, where many are taken together.
        let within = |value: f64, least: f64| (0.999 * least..1.25 * least).contains(&value);
        assert!(taken.iter().any(|row| within(row[0], depth) && within(row[1], velocity)), "{taken:?}");
    }
    // By hand: h v² is 20 m³/s² there, and 7.2 and 4.4 at the others.
    let unit = 1400.0 * 9.81 * libm::cos(25_f64.to_radians());
    let by_hand = (0.5 * unit * 0.64 + 2.0 * 1400.0 * 25.0 * 0.8) * 3.0;
    assert!((guideline.first_surge() / by_hand - 1.0).abs() < 1e-9);
}

/// A discharge with a velocity, or with a depth, is the same flow; so is a file of DebrisFrame's columns.
#[test]
fn a_table_is_the_same_however_it_is_told() {
    let lists = "times: [0 s, 0.4 s, 0.9 s], depths: [0.6 m, 0.5 m, 0.3 m], velocities: [4.6 m/s, 4.2 m/s, 3.6 m/s]";
    assert!(TINY.contains(lists));
    let own = design(TINY);
    // Over 3 m.
    for other in [
        "times: [2 s, 2.4 s, 2.9 s], discharges: [8.28 m3/s, 6.3 m3/s, 3240 l/s], velocities: [4.6 m/s, 4.2 m/s, 3.6 m/s]",
        "times: [0 s, 0.4 s, 0.9 s], depths: [0.6 m, 0.5 m, 0.3 m], discharges: [8.28 m3/s, 6.3 m3/s, 3.24 m3/s]",
    ] {
        let told = design(&TINY.replace(lists, other)).flow;
        let table = told.hydrograph.as_ref().expect("a table");
        let told_at = |time: f64| table.at(time.min(table.duration()));
        // Between the rows the discharge is straight here, and depth and velocity there.
        assert!((told.mass / own.flow.mass - 1.0).abs() < 0.01, "{other}");
        for (a, b) in own.flow.hydrograph.as_ref().expect("a table").rows.iter().map(|row| (told_at(row.time), row)) {
            assert!((a.time - b.time).abs() < 1e-9 && (a.depth - b.depth).abs() < 1e-9, "{a:?} {b:?}");
            assert!((a.velocity - b.velocity).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
    let open = |name: &str| match name {
        "flow.csv" => Ok(b"timestep,thickness,velocity\n40,0.6,4.6\n40.4,0.5,4.2\n40.9,0.3,3.6\n".to_vec()),
        other => Err(format!("no {other}")),
    };
    let text = TINY.replace(lists, "file: flow.csv");
    let read = read_design_for(Purpose::Simulation, "x.yaml", text.as_bytes(), &open).expect("a design");
    assert!((read.design.flow.mass / own.flow.mass - 1.0).abs() < 1e-9);
    assert!(read.attached.contains_key("flow.csv"));
}

/// What comes late runs up on what came before, as a later surge does: level, height of filling and force are no less than those of the two as
/// surges.
#[test]
fn a_late_peak_runs_up_on_what_came_before() {
    let table = [[0.0, 0.3, 2.5], [4.0, 0.3, 2.5], [4.2, 0.6, 5.0], [5.0, 0.6, 5.0]];
    let hydrograph = design(&with_table(&table, "width: 3 m"));
    let volume = hydrograph.flow.volume();
    let late = 3.0 * 0.6 * 5.0 * 0.8;
    let surges = format!(
        "surges: [{{volume: {} m3, depth: 0.3 m, velocity: 2.5 m/s}}, {{volume: {late} m3, depth: 0.6 m, velocity: 5 m/s}}]",
        volume - late
    );
    let text = with_table(&table, "width: 3 m");
    let (before, rest) = text.split_once("hydrograph: {").expect("a table");
    let (_, after) = rest.split_once('}').expect("its end");
    let surges = design(&format!("{before}{surges}{after}"));
    let [one, other] = [&hydrograph, &surges].map(guideline);
    assert!((surges.flow.volume_of_all() / volume - 1.0).abs() < 1e-9);
    assert!(one.level > 0.98 * other.level, "{} {}", one.level, other.level);
    assert!(one.largest_force > 0.98 * other.largest_force, "{} {}", one.largest_force, other.largest_force);
    assert!(one.level > 1.2 * guideline(&design(&with_table(&table[2..], "width: 3 m"))).level);
}

/// A thin fast front takes nothing off what a deep slow flow does, nor does it the other way round.
#[test]
fn what_comes_besides_lowers_no_load() {
    let loads = |rows: &[[f64; 3]]| {
        let design = design(&with_table(rows, "width: 3 m"));
        let guideline = guideline(&design);
        let mut loads: Vec<f64> = guideline.ropes.iter().map(|rope| rope.load).collect();
        loads.extend([guideline.largest_force, guideline.level, guideline.bolt_force.expect("bolts")]);
        loads
    };
    let [fast, middle, deep] = [[0.3, 7.0], [0.5, 6.0], [1.0, 4.3]];
    let table = |rows: &[[f64; 2]]| {
        let rows = rows.iter().enumerate();
        rows.flat_map(|(n, [h, v])| [[2.0 * n as f64, *h, *v], [2.0 * n as f64 + 1.0, *h, *v]]).collect::<Vec<_>>()
    };
    let all = loads(&table(&[fast, middle, deep]));
    for part in [vec![fast], vec![middle], vec![deep], vec![middle, deep]] {
        for (whole, part) in all.iter().zip(loads(&table(&part))) {
            assert!(*whole >= 0.999 * part, "{whole} {part}");
        }
    }
}

/// What is straight between the rows is what is given: a triangle of 8 m³/s over 10 s brings 40 m³, in any section, however it is told.
#[test]
fn a_discharge_keeps_its_volume() {
    let times = "times: [0 s, 5 s, 10 s]";
    let tables = [
        "discharges: [0 m3/s, 8 m3/s, 0 m3/s], velocity: 4 m/s",
        "discharges: [0 m3/s, 8 m3/s, 0 m3/s], velocities: [0 m/s, 4 m/s, 0 m/s]",
        "discharges: [0 m3/s, 8 m3/s, 0 m3/s], depths: [0 m, 0.7 m, 0 m]",
    ];
    let trapezoid = "section: {trapezoid: {bed_width: 2 m, left_bank: 45 deg, right_bank: 45 deg, depth: 3 m}}";
    for section in ["width: 3 m", trapezoid] {
        for table in tables {
            let lists =
                "times: [0 s, 0.4 s, 0.9 s], depths: [0.6 m, 0.5 m, 0.3 m], velocities: [4.6 m/s, 4.2 m/s, 3.6 m/s]";
            let mut text = TINY.replace(lists, &format!("{times}, {table}")).replace("width: 3 m", section);
            if section == trapezoid {
                text = text.lines().filter(|line| !line.contains("wall_height")).collect::<Vec<_>>().join("\n");
            }
            let volume = design(&text).flow.volume();
            assert!((volume / 40.0 - 1.0).abs() < 0.01, "{section} {table}: {volume}");
        }
    }
}
