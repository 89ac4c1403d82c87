//! A6: a ball that bounces under gravity.

use crate::dem::Vec3;
use crate::dem::model::{Material, Model};
use crate::dem::tables::grains::GrainShape;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, ball, floor, free_model, material, simulate};

pub const CASE: Case = Case {
    id: "A6",
    suite: Suite::Contact,
    title: "Heights of the first three bounces",
    source: "h_k − r = (h_0 − r) ε^(2k) for stiff contacts; scene of Lethe's documentation and MFIX DEM02",
    tier: Tier::ClosedForm,
    weakness: "gravity acts during the contact too, which lowers soft bounces; judged at 5e8 N/m, and that the error shrinks",
    cost: Cost::Quick,
    run,
};

const RADIUS: f64 = 0.1;
const DROP: f64 = 0.5;

fn run() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for restitution in [0.5_f64, 0.7, 0.9] {
        for (bounce, height) in heights(5e8, restitution)?.into_iter().enumerate() {
            let expected = (DROP - RADIUS) * restitution.powi(2 * (bounce as i32 + 1));
            let what = format!("ε = {restitution}: bounce {} (m)", bounce + 1);
            findings.push(Finding::near(what, height, expected, 0.02));
        }
    }
    let error = |stiffness: f64| -> Result<f64, Broken> {
        let expected = (DROP - RADIUS) * 0.9_f64.powi(2);
        Ok((heights(stiffness, 0.9)?[0] - expected).abs() / expected)
    };
    let (soft, stiff) = (error(5e4)?, error(5e6)?);
    findings.push(Finding::between("error at 5e6 N/m over error at 5e4 N/m", stiff / soft, 0.0, 0.5));
    Ok(findings)
}

/// Heights of the ball's lowest point at the tops of the first three bounces (m).
fn heights(stiffness: f64, restitution: f64) -> Result<Vec<f64>, Broken> {
    let grain = ball(0, Vec3::z() * DROP, RADIUS, 2600.0);
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
