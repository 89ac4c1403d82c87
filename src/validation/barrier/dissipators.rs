//! D18, D19: the dissipator pulled to and fro, and stopping a mass.

use crate::validation::barrier::stand::Stand;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use dem::Vec3;
use dem::elements::dissipator::Dissipator;
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

const PLATEAU: f64 = 250e3;
const STIFFNESS: f64 = 45.957e6;
const STROKE: f64 = 2.5;

fn dissipator() -> Dissipator {
    Dissipator {
        nodes: [0, 1],
        rope: 0,
        rest_length: 1.0,
        radius: 0.016,
        stiffness: STIFFNESS,
        plateau: PLATEAU,
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

fn stopping() -> Result<Vec<Finding>, Broken> {
    let (mass, speed) = (1000.0, 10.0);
    let node = |x: f64, fixed| Node {
        position: Vec3::x() * x,
        velocity: Vec3::zeros(),
        pace: Vec3::zeros(),
        mass,
        fixed,
        radius: 0.016,
        lines: Vec::new(),
    };
    let mut barrier = Barrier { nodes: vec![node(0.0, true), node(1.0, false)], ..Barrier::default() };
    barrier.nodes[1].velocity.x = speed;
    barrier.dissipators = vec![dissipator()];
    let mut stand = Stand::new(barrier, 2e-7);
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
