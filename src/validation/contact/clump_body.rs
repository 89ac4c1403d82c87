//! A17 and A21: mass and inertia of clumps, their free rotation, and what collisions conserve.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{cloud, free_model, material, momenta, run as step_on, simulate};
use dem::Vec3;
use dem::model::Model;
use dem::tables::grains::{Grain, GrainBody, GrainShape};

pub const BODY: Case = Case {
    id: "A17",
    suite: Suite::Contact,
    title: "Mass and inertia of a clump, and its free rotation",
    source: "union of two spheres r at distance r: V = 9π/4 r³, 17/40 M r², 59/80 M r²; torque-free precession",
    tier: Tier::ClosedForm,
    weakness: "one aspect ratio in closed form; others against sampling",
    cost: Cost::Quick,
    run: body,
};

pub const CONSERVED: Case = Case {
    id: "A21",
    suite: Suite::Contact,
    title: "Colliding clumps keep linear and angular momentum",
    source: "no external force",
    tier: Tier::ClosedForm,
    weakness: "says nothing about how large the contact forces are",
    cost: Cost::Quick,
    run: conserved,
};

fn body() -> Result<Vec<Finding>, Broken> {
    let clump = GrainBody::clump(1.0, 1.5, 2701.0);
    let scale = clump.mass * clump.radius.powi(2);
    let mut findings = vec![
        Finding::near(
            "V/r³ over 9π/4",
            clump.mass / 2701.0 / clump.radius.powi(3) / (2.25 * std::f64::consts::PI),
            1.0,
            1e-9,
        ),
        Finding::near("I_axial/(M r²)", clump.inertia_axial / scale, 17.0 / 40.0, 1e-9),
        Finding::near("I_transverse/(M r²)", clump.inertia_transverse / scale, 59.0 / 80.0, 1e-9),
    ];
    for aspect in [1.2, 2.0] {
        let clump = GrainBody::clump(1.0, aspect, 1.0);
        let [mass, axial, transverse] = sampled(&clump);
        findings.push(Finding::near(format!("aspect {aspect}: M against sampling"), clump.mass, mass, 0.005));
        findings.push(Finding::near(format!("aspect {aspect}: I_axial"), clump.inertia_axial, axial, 0.005));
        findings.push(Finding::near(
            format!("aspect {aspect}: I_transverse"),
            clump.inertia_transverse,
            transverse,
            0.005,
        ));
    }
    findings.extend(precession()?);
    Ok(findings)
}

/// Mass and moments of inertia of a clump of unit density, from a million random points.
fn sampled(clump: &GrainBody) -> [f64; 3] {
    let mut random = fastrand::Rng::with_seed(17);
    let length = clump.offset + clump.radius;
    let count = 1_000_000;
    let volume = 8.0 * length * clump.radius * clump.radius / count as f64;
    let mut sums = [0.0; 3];
    for _ in 0..count {
        let mut signed = |reach: f64| (2.0 * random.f64() - 1.0) * reach;
        let (x, y, z) = (signed(length), signed(clump.radius), signed(clump.radius));
        if (x.abs() - clump.offset).powi(2) + y * y + z * z < clump.radius.powi(2) {
            for (sum, part) in sums.iter_mut().zip([1.0, y * y + z * z, x * x + z * z]) {
                *sum += part * volume;
            }
        }
    }
    sums
}

/// A free clump's axis turns about its angular momentum at the rate |L|/I_t.
fn precession() -> Result<Vec<Finding>, Broken> {
    let clump = GrainBody::clump(0.02, 1.5, 2600.0);
    let mut grain = Grain::at(0, Vec3::zeros(), Vec3::new(1.0, 0.0, 1.0).normalize(), clump);
    grain.angular_momentum = Vec3::z() * (clump.inertia_transverse * 50.0);
    let before = grain.kinetic_energy()[0];
    let mut simulation = simulate(free_model(vec![grain], GrainShape::Clump), 1e-5, 0.01);
    let turns = 20.0;
    let steps = (turns * std::f64::consts::TAU / 50.0 / 1e-5).round() as usize;
    step_on(&mut simulation, steps)?;
    let grain = simulation.grains.grain(0);
    let angle = libm::atan2(grain.axis.y, grain.axis.x);
    let expected = (steps as f64 * 1e-5 * 50.0).rem_euclid(std::f64::consts::TAU);
    let off = (angle - expected + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    Ok(vec![
        Finding::close("angle off after 20 turns of precession (rad)", off, 0.0, 1e-6),
        Finding::close("energy drift over energy", grain.kinetic_energy()[0] / before - 1.0, 0.0, 1e-9),
    ])
}

fn conserved() -> Result<Vec<Finding>, Broken> {
    let grains = cloud(700, 3);
    let (linear, angular) = momenta(&grains);
    let scale: f64 = grains.iter().map(|grain| grain.body.mass * grain.velocity.norm()).sum();
    let model = Model { material: material(0.3, 0.5), ..free_model(grains, GrainShape::Clump) };
    let mut simulation = simulate(model, 1e-5, 0.01);
    step_on(&mut simulation, 4000)?;
    let (linear_after, angular_after) = momenta(&simulation.snapshot());
    Ok(vec![
        Finding::between("largest overlap over radius", simulation.extremes.overlap_ratio, 1e-4, 0.2),
        Finding::close("change of momentum", (linear_after - linear).norm() / scale, 0.0, 1e-10),
        Finding::close("change of angular momentum", (angular_after - angular).norm() / scale, 0.0, 1e-8),
    ])
}
