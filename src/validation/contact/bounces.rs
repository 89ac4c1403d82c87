//! A6: a ball that bounces under gravity.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, ball, floor, free_model, material, simulate};
use dem::Vec3;
use dem::contact::material::Material;
use dem::contact::restitution::damping_ratio_for;
use dem::model::Model;
use dem::tables::grains::GrainShape;

pub const CASE: Case = Case {
    id: "A6",
    suite: Suite::Contact,
    title: "Heights of the first three bounces",
    source: "h_k − r = (h_0 − r) ε^(2k) for stiff contacts (scene of Lethe's documentation and MFIX DEM02); the damped oscillator under \
             gravity for soft ones",
    tier: Tier::ClosedForm,
    weakness: "gravity acts during the contact too, which lowers soft bounces: at 5e4 to 5e6 N/m they are judged by the oscillator, since \
               the stiff limit is off by what is told",
    cost: Cost::Quick,
    run,
};

const RADIUS: f64 = 0.1;
const DROP: f64 = 0.5;
const DENSITY: f64 = 2600.0;

fn run() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for restitution in [0.5_f64, 0.7, 0.9] {
        for (bounce, height) in heights(5e8, restitution)?.into_iter().enumerate() {
            let expected = (DROP - RADIUS) * restitution.powi(2 * (bounce as i32 + 1));
            let what = format!("ε = {restitution}: bounce {} (m)", bounce + 1);
            findings.push(Finding::near(what, height, expected, 0.02));
        }
    }
    for stiffness in [5e4, 5e5, 5e6] {
        for restitution in [0.5_f64, 0.9] {
            let mut expected = DROP - RADIUS;
            for (bounce, height) in heights(stiffness, restitution)?.into_iter().enumerate() {
                expected = bounced(expected, stiffness, restitution);
                let what = format!("{stiffness:.0e} N/m, ε = {restitution}: bounce {} (m)", bounce + 1);
                findings.push(Finding::near(what, height, expected, 0.02));
                let stiff = (DROP - RADIUS) * restitution.powi(2 * (bounce as i32 + 1));
                findings.push(Finding::told("over that of the stiff limit", height / stiff));
            }
        }
    }
    Ok(findings)
}

/// Height (m) that a ball reaches which falls from `height` on a spring of a stiffness (N/m) with its dashpot, under gravity all the while:
/// the overlap swings about the weight's, and the contact ends when its force vanishes.
fn bounced(height: f64, stiffness: f64, restitution: f64) -> f64 {
    let mass = ball(0, Vec3::zeros(), RADIUS, DENSITY).body.mass;
    let (frequency, zeta) = ((stiffness / mass).sqrt(), damping_ratio_for(restitution));
    let damped = frequency * (1.0 - zeta * zeta).sqrt();
    let speed = (2.0 * GRAVITY * height).sqrt();
    let weight = GRAVITY / (frequency * frequency);
    // Overlap and its rate at a time, from overlap 0 and the speed of the fall.
    let at = |time: f64| {
        let sine = (speed - zeta * frequency * weight) / damped;
        let (s, c) = libm::sincos(damped * time);
        let decay = libm::exp(-zeta * frequency * time);
        let swing = sine * s - weight * c;
        let rate = damped * (sine * c + weight * s) - zeta * frequency * swing;
        (weight + decay * swing, decay * rate)
    };
    let force = |time: f64| {
        let (overlap, rate) = at(time);
        frequency * frequency * overlap + 2.0 * zeta * frequency * rate
    };
    // The force is above zero half a swing long and below it afterwards.
    let (mut early, mut late) = (0.0, 1.2 * std::f64::consts::PI / damped);
    let steps = 1000;
    if let Some(step) = (1..=steps).find(|step| force(late * f64::from(*step) / f64::from(steps)) < 0.0) {
        (early, late) = (late * f64::from(step - 1) / f64::from(steps), late * f64::from(step) / f64::from(steps));
    }
    for _ in 0..60 {
        let middle = 0.5 * (early + late);
        if force(middle) > 0.0 { early = middle } else { late = middle }
    }
    let (overlap, rate) = at(late);
    rate * rate / (2.0 * GRAVITY) - overlap
}

/// Heights of the ball's lowest point at the tops of the first three bounces (m).
fn heights(stiffness: f64, restitution: f64) -> Result<Vec<f64>, Broken> {
    let grain = ball(0, Vec3::z() * DROP, RADIUS, DENSITY);
    let step = 0.002 * std::f64::consts::PI * (grain.body.mass / stiffness).sqrt();
    let mut model = Model {
        material: Material { modulus: stiffness / RADIUS, ..material(restitution, 0.0) },
        gravity: Vec3::z() * -GRAVITY,
        ..free_model(vec![grain], GrainShape::Sphere)
    };
    model.surfaces = vec![floor(0.0)];
    let mut simulation = simulate(model, step, RADIUS);
    let mut tops = Vec::new();
    let mut rising = false;
    while tops.len() < 3 && simulation.time < 5.0 {
        simulation.step()?;
        let grain = simulation.grains.grain(0);
        let rises = grain.velocity.z > 0.0;
        if rising && !rises {
            tops.push(grain.position.z - RADIUS);
        }
        rising = rises;
    }
    tops.resize(3, f64::NAN);
    Ok(tops)
}
