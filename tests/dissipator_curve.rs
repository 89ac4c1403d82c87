//! Dissipators by the curve of a test: told in several ways, and held to the plateau that they replace.

use std::sync::atomic::AtomicBool;

use barrier_check::design::entries::Purpose;
use barrier_check::design::read::{read_design, read_design_for};
use barrier_check::design::{BarrierDesign, DissipatorDesign};
use barrier_check::pipeline::{Run, run};
use barrier_check::quantities::dissipator;
use barrier_check::scene::event::RunControl;

const TINY: &str = include_str!("fixtures/tiny.yaml");

/// The design with other dissipators, of a stiffness of 8 MN/m.
fn with(dissipators: &str) -> String {
    let (before, rest) = TINY.split_once("      plateau_force: 100 kN\n      stroke: 0.9 m\n").expect("a plateau");
    format!("{before}{dissipators}{rest}")
}

fn told(text: &str) -> DissipatorDesign {
    let table = b"Displacement [mm];Force [kN]\n0;0\n7.5;60\n215;120\n".to_vec();
    let open = |_: &str| Ok(table.clone());
    let file = read_design_for(Purpose::Simulation, "x.yaml", text.as_bytes(), &open).unwrap_or_else(|p| panic!("{p}"));
    let BarrierDesign::FlexibleNet(net) = file.design.barrier else { panic!("a net") };
    net.dissipators.expect("dissipators")
}

fn simulated(text: &str) -> Run {
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    run(read_design("x.yaml", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")), 1, &watch)
        .expect("a run")
}

/// 60 kN at once, 120 kN at 0.2 m: after unloading, under load (15 mm of it elastic at 120 kN, 7.5 mm at 60 kN), from a table.
#[test]
fn a_curve_is_the_same_however_it_is_told() {
    let by_stroke = told(&with("      curve: {after_unloading: [[0 m, 60 kN], [200 mm, 120 kN]]}\n"));
    assert_eq!([by_stroke.plateau, by_stroke.stroke, by_stroke.stiffness], [120e3, 0.2, 8e6]);
    for other in [
        "      curve: {under_load: [[0 m, 0 kN], [7.5 mm, 60 kN], [215 mm, 120 kN]]}\n",
        "      curve: {file: brake.csv}\n",
    ] {
        let other = told(&with(other));
        assert!((other.stroke - 0.2).abs() < 1e-12 && other.plateau == 120e3);
        for share in [0.0, 0.3, 1.0] {
            assert!((other.curve.force(share) - by_stroke.curve.force(share)).abs() < 1e-9);
        }
    }
    let six = told(&with(
        "      curve: {after_unloading: [[0 m, 60 kN], [200 mm, 120 kN]]}\n      in_series: 3\n      side_by_side: 2\n",
    ));
    assert_eq!([six.plateau, six.stroke, six.stiffness], [2.0 * 120e3, 3.0 * 0.2, 8e6 * 2.0 / 3.0]);
}

/// Stiff again after it has yielded: the flat part stays flat, and the area under it.
#[test]
fn a_second_stiff_part_does_not_lift_the_first() {
    let two_stage = told(&with(
        "      curve: {under_load: [[0 mm, 0 kN], [6 mm, 48 kN], [566 mm, 48 kN], [578 mm, 144 kN], [600 mm, 144 kN]]}\n",
    ));
    assert!((two_stage.plateau * two_stage.curve.force(0.5 * 0.56 / two_stage.stroke) - 48e3).abs() < 1.0);
    assert!((two_stage.plateau * two_stage.curve.force(0.999 * 0.56 / two_stage.stroke) - 48e3).abs() < 1.0);
    assert!((two_stage.stroke - (0.6 - 144e3 / 8e6)).abs() < 1e-12 && two_stage.plateau == 144e3);
}

/// A curve of two points with one force gives the bits of a plateau; one that begins softer pays out more.
#[test]
fn a_curve_of_one_force_is_a_plateau() {
    let plateau = simulated(&with("      plateau_force: 40 kN\n      stroke: 0.9 m\n"));
    let flat = simulated(&with("      curve: {after_unloading: [[0 m, 40 kN], [0.9 m, 40 kN]]}\n"));
    let soft = simulated(&with("      curve: {after_unloading: [[0 m, 10 kN], [0.9 m, 40 kN]]}\n"));
    let [plateau, flat, soft] = [&plateau, &flat, &soft].map(|run| run.simulated.as_ref().expect("a simulation"));
    assert_eq!(plateau.histories.force, flat.histories.force);
    let stroke = |seen: &barrier_check::simulated::Simulated| {
        seen.first().each(&dissipator::STROKE).iter().copied().fold(0.0, f64::max)
    };
    assert!(stroke(plateau) > 0.005, "{}", stroke(plateau));
    assert_eq!(stroke(plateau).to_bits(), stroke(flat).to_bits());
    assert!(stroke(soft) > 1.3 * stroke(plateau), "{} {}", stroke(soft), stroke(plateau));
    assert!(soft.numerics.energy_error.abs() < 1e-3, "{}", soft.numerics.energy_error);
}
