//! A27: standing waves of a chain of masses and springs.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{free_model, simulate};
use dem::Vec3;
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::strength::Strength;
use dem::model::Model;
use dem::tables::barrier::Barrier;
use dem::tables::grains::GrainShape;
use dem::tables::nodes::Node;

pub const CASE: Case = Case {
    id: "A27",
    suite: Suite::Contact,
    title: "Frequencies of a chain of masses and springs",
    source: "ω = 2 √(k/m) sin(π p/(2(N+1)))",
    tier: Tier::ClosedForm,
    weakness: "taut all the time: rope springs pull only",
    cost: Cost::Quick,
    run,
};

const MASSES: usize = 9;
const MASS: f64 = 0.5;
const STIFFNESS: f64 = 2e4;

fn run() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for mode in [1, 2, 3] {
        let angle = 0.5 * std::f64::consts::PI * f64::from(mode) / (MASSES as f64 + 1.0);
        let expected = 2.0 * (STIFFNESS / MASS).sqrt() * libm::sin(angle);
        findings.push(Finding::near(format!("mode {mode}: ω (rad/s)"), measured(mode, expected)?, expected, 0.001));
    }
    Ok(findings)
}

/// Frequency from the time of ten passages through the middle.
fn measured(mode: u32, expected: f64) -> Result<f64, Broken> {
    let mut barrier = Barrier::default();
    for index in 0..MASSES + 2 {
        let shape = libm::sin(std::f64::consts::PI * f64::from(mode) * index as f64 / (MASSES as f64 + 1.0));
        let fixed = index == 0 || index == MASSES + 1;
        barrier.nodes.push(Node {
            position: Vec3::x() * (index as f64 + if fixed { 0.0 } else { 1e-3 * shape }),
            velocity: Vec3::zeros(),
            mass: MASS,
            fixed,
            radius: 0.01,
        });
    }
    for index in 0..=MASSES as u32 {
        barrier.segments.push(Segment {
            nodes: [index, index + 1],
            kind: SegmentKind::Main(0),
            rest_length: 0.9,
            stiffness: STIFFNESS,
            damping: 0.0,
            radius: 0.01,
            strength: Strength::default(),
        });
    }
    barrier.connect();
    let step = 0.002 / expected;
    let mut simulation =
        simulate(Model { barrier: Some(barrier), ..free_model(Vec::new(), GrainShape::Sphere) }, step, 0.1);
    // The mass nearest to a crest of the mode.
    let crest = ((MASSES as f64 + 1.0) / (2.0 * f64::from(mode))).round() as usize;
    let (mut passages, mut before) = (Vec::new(), 1.0);
    while passages.len() < 11 && simulation.time < 40.0 * std::f64::consts::TAU / expected {
        simulation.step()?;
        let position = simulation.model.barrier.as_ref().map_or(f64::NAN, |barrier| barrier.nodes[crest].position.x);
        let off = position - crest as f64;
        if before * off < 0.0 {
            // Between the two last places, by proportion.
            passages.push(simulation.time - step * off.abs() / (off.abs() + f64::abs(before)));
        }
        before = off;
    }
    let [first, .., last] = passages.as_slice() else {
        return Err(Broken::Scene("the chain did not swing".to_string()));
    };
    Ok(std::f64::consts::PI * (passages.len() - 1) as f64 / (last - first))
}
