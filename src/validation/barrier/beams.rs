//! D2, D3, D5, D7, D8: cylinders in a row, clamped at one end, against the Euler-Bernoulli beam and the elastica.

use crate::validation::barrier::stand::{Stand, cantilever, line_mass, section};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::GRAVITY;
use dem::Vec3;
use dem::tables::barrier::Barrier;

const WEAKNESS: &str = "static shapes are found by relaxation; no contact";

pub const TIP_LOAD: Case = Case {
    id: "D2",
    suite: Suite::Rope,
    title: "Cylinders as a cantilever: small load at the tip",
    source: "P L³/3EI, I = πR⁴/4; exact at the nodes with any number of cylinders",
    tier: Tier::ClosedForm,
    weakness: WEAKNESS,
    cost: Cost::Quick,
    run: tip_load,
};

pub const ELASTICA: Case = Case {
    id: "D3",
    suite: Suite::Rope,
    title: "Cylinders as a cantilever: large load at the tip",
    source: "Elastica with a dead load at the tip (Mattiasson 1981)",
    tier: Tier::ClosedForm,
    weakness: WEAKNESS,
    cost: Cost::Quick,
    run: elastica,
};

pub const WEIGHT: Case = Case {
    id: "D5",
    suite: Suite::Rope,
    title: "Cylinders as a cantilever: its own weight",
    source: "ρA g L⁴/8EI",
    tier: Tier::ClosedForm,
    weakness: WEAKNESS,
    cost: Cost::Quick,
    run: own_weight,
};

pub const TWIST: Case = Case {
    id: "D7",
    suite: Suite::Rope,
    title: "Cylinders under a torque: bending and twist",
    source: "T L/GJ with J = πR⁴/2; M L/EI",
    tier: Tier::ClosedForm,
    weakness: WEAKNESS,
    cost: Cost::Quick,
    run: twist,
};

pub const VIBRATION: Case = Case {
    id: "D8",
    suite: Suite::Rope,
    title: "Cylinders as a cantilever: free vibration",
    source: "(β L)² √(EI/ρA)/(2π L²), β L = 1.8751 and 4.6941",
    tier: Tier::ClosedForm,
    weakness: "no damping in the scene",
    cost: Cost::Quick,
    run: vibration,
};

const LENGTH: f64 = 1.0;
/// Below the angular frequency of its slowest swing (rad/s), however it is lumped.
const SLOWEST: f64 = 13.0;

fn stand(parts: usize) -> Stand {
    // Turning governs: ω² ≈ 16 EI/(l I_node) and the axial mode 2 c/l.
    let part = LENGTH / parts as f64;
    let barrier = cantilever(LENGTH, parts);
    let axial = part / (section().axial / line_mass()).sqrt();
    let turning = 2.0 / (16.0 * section().bending / part / barrier.frames[1].inertia).sqrt();
    Stand::new(barrier, 0.4 * axial.min(turning))
}

fn tip(stand: &Stand) -> (Vec3, Vec3) {
    let barrier = &stand.barrier;
    (barrier.nodes[barrier.nodes.len() - 1].position, barrier.frames[barrier.nodes.len() - 1].orientation.scaled_axis())
}

fn tip_load() -> Result<Vec<Finding>, Broken> {
    let load = 0.01 * section().bending / LENGTH.powi(2);
    let expected = load * LENGTH.powi(3) / (3.0 * section().bending);
    let deflection = |parts| {
        let mut stand = stand(parts);
        stand.loads = vec![(parts, Vec3::z() * -load, Vec3::zeros())];
        stand.relax(SLOWEST);
        Finding::near(format!("{parts} cylinders: deflection (m)"), -tip(&stand).0.z, expected, 1e-3)
    };
    Ok([1, 4, 14].into_iter().map(deflection).collect())
}

fn elastica() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for (load, down, back, angle) in [(1.0, 0.301_721, 0.056_433, 0.461_352), (5.0, 0.713_792, 0.387_628, 1.215_368)] {
        let mut stand = stand(20);
        stand.loads = vec![(20, Vec3::z() * (-load * section().bending / LENGTH.powi(2)), Vec3::zeros())];
        stand.relax(SLOWEST);
        let (place, turned) = tip(&stand);
        let name = |what: &str| format!("P L²/EI = {load}: {what}");
        findings.push(Finding::near(name("w/L"), -place.z / LENGTH, down, 0.01));
        findings.push(Finding::near(name("u/L"), 1.0 - place.x / LENGTH, back, 0.01));
        findings.push(Finding::near(name("slope at the tip (rad)"), turned.norm(), angle, 0.01));
    }
    Ok(findings)
}

fn own_weight() -> Result<Vec<Finding>, Broken> {
    let mut stand = stand(20);
    stand.gravity = Vec3::z() * -GRAVITY;
    stand.relax(SLOWEST);
    let expected = line_mass() * GRAVITY * LENGTH.powi(4) / (8.0 * section().bending);
    Ok(vec![Finding::near("deflection (m)", -tip(&stand).0.z, expected, 0.02)])
}

fn twist() -> Result<Vec<Finding>, Broken> {
    let moment = 0.01 * section().bending / LENGTH;
    let mut findings = Vec::new();
    for (name, axis, stiffness) in
        [("twist (rad)", Vec3::x(), section().twisting), ("bending (rad)", Vec3::y(), section().bending)]
    {
        let mut stand = stand(14);
        stand.loads = vec![(14, Vec3::zeros(), axis * moment)];
        stand.relax(SLOWEST);
        findings.push(Finding::near(name, tip(&stand).1.dot(&axis), moment * LENGTH / stiffness, 1e-3));
    }
    Ok(findings)
}

fn vibration() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for (mode, root, tolerance) in [(1, 1.875_104, 0.01), (2, 4.694_091, 0.02)] {
        let mut stand = stand(20);
        let shape = Shape::of(root);
        for (node, frame) in stand.barrier.nodes.iter_mut().zip(&mut stand.barrier.frames) {
            let x = node.position.x;
            node.velocity.z = 0.01 * shape.value(x);
            frame.spin.y = -0.01 * shape.slope(x);
        }
        let share =
            |barrier: &Barrier| barrier.nodes.iter().map(|n| n.mass * shape.value(n.position.x) * n.position.z).sum();
        let expected =
            root * root * (section().bending / line_mass()).sqrt() / (std::f64::consts::TAU * LENGTH.powi(2));
        let frequency = 1.0 / stand.period(20.0 / expected, share)?;
        findings.push(Finding::near(format!("mode {mode}: frequency (Hz)"), frequency, expected, tolerance));
    }
    Ok(findings)
}

/// Shape of a mode of the clamped beam of length one.
struct Shape {
    root: f64,
    ratio: f64,
}

impl Shape {
    fn of(root: f64) -> Self {
        Self { root, ratio: (libm::cosh(root) + libm::cos(root)) / (libm::sinh(root) + libm::sin(root)) }
    }

    fn value(&self, x: f64) -> f64 {
        let s = self.root * x;
        libm::cosh(s) - libm::cos(s) - self.ratio * (libm::sinh(s) - libm::sin(s))
    }

    fn slope(&self, x: f64) -> f64 {
        let s = self.root * x;
        self.root * (libm::sinh(s) + libm::sin(s) - self.ratio * (libm::cosh(s) - libm::cos(s)))
    }
}
