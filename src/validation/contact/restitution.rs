//! A1: two equal balls meet head on.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{MODULUS, ball, contact_time, free_model, material, simulate};
use dem::Vec3;
use dem::contact::restitution::{begins_beyond, damping_ratio_for, first_weight};
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::GrainShape;

pub const CASE: Case = Case {
    id: "A1",
    suite: Suite::Contact,
    title: "Central collision: restitution, duration, largest overlap and force",
    source: "truncated dashpot, Schwager & Pöschel 2007; ε = exp(−2ζ arccos ζ/√(1−ζ²)), u_max ω0/v = √ε",
    tier: Tier::ClosedForm,
    weakness: "linear spring; real restitution falls with velocity",
    cost: Cost::Quick,
    run,
};

const RADIUS: f64 = 0.01;
const SPEED: f64 = 1.0;
const DENSITY: f64 = 2600.0;
/// ε and, for the truncated dashpot, t_c ω0, u_max ω0/v and F_max/(v √(k m_r)).
#[allow(clippy::approx_constant)] // √0.5 is one of many roots here
const TABLE: [(f64, f64, f64, f64); 5] = [
    (0.1, 1.85216, 0.31623, 2.48638),
    (0.3, 2.42131, 0.54772, 0.99454),
    (0.5, 2.71529, 0.70711, 0.81037),
    (0.7, 2.91843, 0.83666, 0.86229),
    (0.9, 3.07485, 0.94868, 0.95092),
];

fn run() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for (nominal, duration, overlap, force) in TABLE {
        let met = meet(nominal, 400.0)?;
        findings.push(Finding::close(format!("ε = {nominal}: measured ε"), met.restitution, nominal, 0.005));
        findings.push(Finding::near(format!("ε = {nominal}: t_c ω0"), met.duration, duration, 0.01));
        findings.push(Finding::near(format!("ε = {nominal}: u_max ω0/v"), met.overlap, overlap, 0.005));
        findings.push(Finding::near(format!("ε = {nominal}: F_max/(v √(k m_r))"), met.force, force, 0.02));
    }
    findings.push(Finding::close("ε = 0.3 at a coarse step (t_c/6), mean of all phases", coarse()?, 0.3, 0.005));
    findings.push(Finding::close("ζ that ε = 0.3 needs", damping_ratio_for(0.3), 0.497239, 1e-6));
    Ok(findings)
}

/// Restitution at the coarsest step a run may take, over all places within a step at which the contact may begin.
fn coarse() -> Result<f64, Broken> {
    const PHASES: usize = 40;
    let mut sum = 0.0;
    for phase in 0..PHASES {
        sum += meet_from(0.3, 6.0, (phase as f64 + 0.5) / PHASES as f64)?.restitution;
    }
    Ok(sum / PHASES as f64)
}

/// What was measured, made dimensionless.
struct Met {
    restitution: f64,
    duration: f64,
    overlap: f64,
    force: f64,
}

fn meet(nominal: f64, steps_per_contact: f64) -> Result<Met, Broken> {
    meet_from(nominal, steps_per_contact, 0.0)
}

/// Two balls a share of a step's way apart.
fn meet_from(nominal: f64, steps_per_contact: f64, phase: f64) -> Result<Met, Broken> {
    let stiffness = MODULUS * RADIUS;
    let reduced = 0.5 * ball(0, Vec3::zeros(), RADIUS, DENSITY).body.mass;
    let step = contact_time(stiffness, reduced) / steps_per_contact;
    let half_gap = 0.5 * phase * SPEED * step + 1e-12;
    let mut grains = [-1.0, 1.0].map(|side| {
        let mut grain = ball(0, Vec3::new(side * (RADIUS + half_gap), 0.0, 0.0), RADIUS, DENSITY);
        grain.velocity.x = -side * 0.5 * SPEED;
        grain
    });
    grains[1].id = 1;
    let omega = (stiffness / reduced).sqrt();
    let lighter = 1.0 - damping_ratio_for(nominal) * omega * step;
    let model = Model { material: material(nominal, 0.0), ..free_model(grains.to_vec(), GrainShape::Sphere) };
    let mut simulation = simulate(model, step, RADIUS);
    let (mut touching, mut deepest, mut strongest) = (0_u32, 0.0_f64, 0.0_f64);
    for _ in 0..(3.0 * steps_per_contact) as usize + 2 {
        simulation.step()?;
        let [a, b] = [0, 1].map(|row| simulation.grains.grain(row).position);
        // The first force stands for more than the instant.
        let weight =
            if touching == 0 && begins_beyond(nominal).is_finite() { first_weight(1.0 - phase, lighter) } else { 1.0 };
        let force = contact_force(&simulation) / weight;
        touching += u32::from(force > 1e-9 * stiffness * RADIUS);
        deepest = deepest.max(2.0 * RADIUS - (a - b).norm());
        strongest = strongest.max(force);
    }
    let [a, b] = [0, 1].map(|row| simulation.grains.grain(row).velocity);
    Ok(Met {
        restitution: (a - b).norm() / SPEED,
        duration: f64::from(touching) * step * omega,
        overlap: deepest * omega / SPEED,
        force: strongest / (SPEED * (stiffness * reduced).sqrt()),
    })
}

/// Normal force of the one contact in the step just made: its spring and its dashpot (N).
fn contact_force(simulation: &Simulation) -> f64 {
    let list = &simulation.neighbours.blocks[0].inner;
    let stored = simulation.sums.contacts.stored;
    let spring = (2.0 * stored * MODULUS * RADIUS).sqrt();
    list.memory.first().map_or(0.0, |memory| spring + memory.fourth())
}
