//! The partial factor on loads: a flow γ times as heavy on the barrier, and the barrier's mass, stiffness and plateau divided by γ
//! under the flow as it is with forces multiplied by γ, are one and the same.

use barrier_check::design::Design;
use barrier_check::design::read::read_design;
use barrier_check::fidelity::choose;
use barrier_check::flow_cases::factored;
use barrier_check::scene::build::build;
use dem::tables::barrier::Barrier;

/// The barrier as a flow 1/γ times as heavy must meet it to move as it does under the factored flow.
fn lighter(mut barrier: Barrier, factor: f64) -> Barrier {
    for node in &mut barrier.nodes {
        node.mass /= factor;
    }
    for segment in &mut barrier.segments {
        segment.stiffness /= factor;
        segment.damping /= factor;
    }
    for dissipator in &mut barrier.dissipators {
        dissipator.stiffness /= factor;
        dissipator.plateau /= factor;
    }
    barrier.contact_modulus /= factor;
    if let Some(ground) = &mut barrier.ground {
        ground.moduli[1] /= factor;
    }
    barrier
}

fn design(factor: f64) -> Design {
    let mut design = read_design("tiny", include_bytes!("fixtures/tiny.yaml")).expect("a design").design;
    design.factors.load = factor;
    if let barrier_check::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier {
        // Within what the impact reaches, so that dissipators yield.
        net.dissipators.as_mut().expect("dissipators").plateau = 8e3;
    }
    design
}

/// Largest stroke, and tension of the first dissipator after each hundred steps.
fn course(design: &Design, scale: Option<f64>) -> (f64, Vec<f64>) {
    let step = 4e-5;
    let mut fidelity = choose(design);
    fidelity.time_step = step;
    let mut scene = build(design, &fidelity, 1).expect("a scene");
    if let Some(factor) = scale {
        let barrier = scene.simulation.model.barrier.take().expect("a net");
        scene.simulation.put_up(lighter(barrier, factor));
    }
    let mut tensions = Vec::new();
    let mut stroke: f64 = 0.0;
    dem::workers::gather(|| {
        for number in 0..22_000 {
            scene.simulation.step().expect("stable");
            if number % 100 == 0 {
                tensions.push(scene.simulation.sums.net.dissipators[0]);
            }
        }
    });
    for dissipator in &scene.simulation.model.barrier.as_ref().expect("a net").dissipators {
        stroke = stroke.max(dissipator.used);
    }
    (stroke, tensions)
}

/// Four, so that every quantity scales without rounding, the square roots in packing and dashpots included.
#[test]
fn a_heavier_flow_and_a_lighter_barrier_agree_to_the_last_bit() {
    let factor = 4.0;
    let design = design(factor);
    let heavier = factored(&design).expect("a factored case");
    let (long, high) = course(&heavier, None);
    let (same_long, same_high) = course(&design, Some(factor));
    assert!(long > 0.01, "no dissipator yields: {long}");
    assert_eq!(long, same_long);
    for (by_flow, by_barrier) in high.iter().zip(&same_high) {
        assert_eq!(*by_flow, factor * by_barrier);
    }
    // What no factor on results can give: the stroke grows far more than nothing.
    let (characteristic, _) = course(&design, None);
    assert!(long > 1.2 * characteristic, "{long} {characteristic}");
}
