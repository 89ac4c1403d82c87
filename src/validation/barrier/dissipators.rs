//! D18 to D20: the dissipator pulled to and fro, and stopping a mass, on a plateau and along a curve.

use crate::validation::barrier::stand::Stand;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use dem::Vec3;
use dem::elements::dissipator::Dissipator;
use dem::elements::segment::SegmentKind;
use dem::elements::yield_curve::YieldCurve;
use dem::tables::barrier::Barrier;
use dem::tables::nodes::Node;

pub const CYCLE: Case = Case {
    id: "D18",
    suite: Suite::Dissipator,
    title: "A dissipator pulled past its plateau, let go, pulled again, pulled past its stroke",
    source: "Plateau exact, unloading with the elastic slope, rigid link after the stroke",
    tier: Tier::ClosedForm,
    weakness: "quasi-static; the law is assumed, no rate effect",
    cost: Cost::Quick,
    run: cycle,
};

pub const STOPPING: Case = Case {
    id: "D19",
    suite: Suite::Dissipator,
    title: "A dissipator stops 1000 kg at 10 m/s",
    source: "½ m v² = ½ F²/k + F × stroke; times of the elastic and the plastic part",
    tier: Tier::ClosedForm,
    weakness: "no rope between",
    cost: Cost::Quick,
    run: stopping,
};

pub const CURVED: Case = Case {
    id: "D20",
    suite: Suite::Dissipator,
    title: "A dissipator whose force rises from 100 kN to 300 kN at 0.4 m and falls to 200 kN at 2.5 m stops 1000 kg and 2000 kg at 10 m/s",
    source: "½ m v² = ½ F²/k + area under the curve up to the stroke",
    tier: Tier::ClosedForm,
    weakness: "no rope between; no rate effect",
    cost: Cost::Quick,
    run: curved,
};

const PLATEAU: f64 = 250e3;
const STIFFNESS: f64 = 45.957e6;
const STROKE: f64 = 2.5;

fn dissipator() -> Dissipator {
    Dissipator {
        nodes: [0, 1],
        kind: SegmentKind::Main(0),
        rest_length: 1.0,
        radius: 0.016,
        stiffness: STIFFNESS,
        plateau: PLATEAU,
        curve: YieldCurve::default(),
        stroke: STROKE,
        used: 0.0,
    }
}

fn cycle() -> Result<Vec<Finding>, Broken> {
    let mut brake = dissipator();
    let elastic = PLATEAU / STIFFNESS;
    let mut largest = 0.0_f64;
    for number in 0..=1000 {
        largest = largest.max(brake.elongate(f64::from(number) * 1e-3).tension);
    }
    let half_way = brake.elongate(1.0 - 0.5 * elastic).tension;
    let slack = brake.elongate(1.0 - 1.01 * elastic).tension;
    let again = brake.elongate(1.0).tension;
    let residual = brake.used;
    let past = brake.elongate(STROKE + elastic + 1e-3).tension;
    Ok(vec![
        Finding::near("largest tension up to 1 m (N)", largest, PLATEAU, 1e-12),
        Finding::near("tension half-way back (N)", half_way, 0.5 * PLATEAU, 1e-3),
        Finding::close("tension when slack (N)", slack, 0.0, 0.0),
        Finding::near("tension pulled again (N)", again, PLATEAU, 1e-3),
        Finding::near("stroke left after 1 m (m)", residual, 1.0 - elastic, 1e-3),
        Finding::near("tension 1 mm past the stroke (N)", past, PLATEAU + 1e-3 * STIFFNESS, 1e-3),
        Finding::near("stroke never beyond (m)", brake.used, STROKE, 1e-12),
    ])
}

/// A mass at the end of a dissipator, moving away from its anchor.
fn thrown(mass: f64, speed: f64, dissipator: Dissipator) -> Stand {
    let node = |x: f64, fixed| Node { position: Vec3::x() * x, velocity: Vec3::zeros(), mass, fixed, radius: 0.016 };
    let mut barrier = Barrier { nodes: vec![node(0.0, true), node(1.0, false)], ..Barrier::default() };
    barrier.nodes[1].velocity.x = speed;
    barrier.dissipators = vec![dissipator];
    Stand::new(barrier, 2e-7)
}

/// Where a dissipator of the curve holds a mass that came with an energy (J): ∫ Y dp + Y²/2k = E, by bisection.
fn stop_by_hand(energy: f64) -> f64 {
    let force = |p: f64| if p < 0.4 { 100e3 + 500e3 * p } else { 300e3 - 100e3 / 2.1 * (p - 0.4) };
    let area =
        |p: f64| if p < 0.4 { 0.5 * p * (100e3 + force(p)) } else { 80e3 + 0.5 * (p - 0.4) * (300e3 + force(p)) };
    let (mut low, mut high) = (0.0, 2.5);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        let taken = area(middle) + force(middle) * force(middle) / (2.0 * STIFFNESS);
        if taken < energy { low = middle } else { high = middle }
    }
    low
}

fn curved() -> Result<Vec<Finding>, Broken> {
    let (curve, [plateau, stroke]) =
        (YieldCurve::new(&[[0.0, 1.0 / 3.0], [0.16, 1.0], [1.0, 2.0 / 3.0]]), [300e3, 2.5]);
    let mut findings = Vec::new();
    for mass in [1000.0, 2000.0] {
        let mut stand = thrown(mass, 10.0, Dissipator { plateau, stroke, curve: curve.clone(), ..dissipator() });
        let mut lost = 0.0;
        while stand.barrier.nodes[1].velocity.x > 0.0 {
            stand.step();
            lost += stand.net.lost_dissipators;
        }
        let by_hand = stop_by_hand(0.5 * mass * 100.0);
        let elastic = stand.net.stored;
        findings.push(Finding::near(
            format!("stroke of {mass} kg (m)"),
            stand.barrier.dissipators[0].used,
            by_hand,
            1e-4,
        ));
        let energy = (lost + elastic) / (0.5 * mass * 100.0);
        findings.push(Finding::near(format!("work over energy of {mass} kg"), energy, 1.0, 1e-4));
    }
    Ok(findings)
}

fn stopping() -> Result<Vec<Finding>, Broken> {
    let mut stand = thrown(1000.0, 10.0, dissipator());
    let (mut time, mut yielded) = (0.0, None);
    while stand.barrier.nodes[1].velocity.x > 0.0 {
        stand.step();
        time += stand.step;
        if yielded.is_none() && stand.barrier.dissipators[0].used > 0.0 {
            yielded = Some(time);
        }
    }
    let elastic_time = yielded.unwrap_or(f64::NAN);
    Ok(vec![
        Finding::near("way (m)", stand.barrier.nodes[1].position.x - 1.0, 0.20272, 0.005),
        Finding::near("stroke (m)", stand.barrier.dissipators[0].used, 0.19728, 0.005),
        Finding::near("time to the plateau (s)", elastic_time, 0.5452e-3, 0.005),
        Finding::near("time on the plateau (s)", time - elastic_time, 39.727e-3, 0.005),
    ])
}
