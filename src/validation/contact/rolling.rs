//! A8 and A20: a ball that slips, then rolls; and a ball on a slope.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, ball, floor, free_model, material, run_until, simulate};
use dem::Vec3;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::GrainShape;

pub const SLIP: Case = Case {
    id: "A8",
    suite: Suite::Contact,
    title: "A slipping ball comes to roll with five sevenths of its speed",
    source: "rolls from t = 2 v0/(7 μ g); MFIX DEM04",
    tier: Tier::ClosedForm,
    weakness: "no rolling resistance, as real balls have",
    cost: Cost::Quick,
    run: slip,
};

pub const SLOPE: Case = Case {
    id: "A20",
    suite: Suite::Contact,
    title: "A ball rolls down a slope with five sevenths of gravity's part",
    source: "a = 5/7 g sin α as long as tan α ≤ 7/2 μ",
    tier: Tier::ClosedForm,
    weakness: "a single sphere; clumps tumble",
    cost: Cost::Quick,
    run: slope,
};

const RADIUS: f64 = 0.01;

fn on_floor(velocity: f64, friction: f64, slope: f64) -> Simulation {
    let mut grain = ball(0, Vec3::z() * RADIUS, RADIUS, 2600.0);
    grain.velocity.x = velocity;
    let mut model = Model {
        material: material(0.3, friction),
        gravity: Vec3::new(libm::sin(slope), 0.0, -libm::cos(slope)) * GRAVITY,
        ..free_model(vec![grain], GrainShape::Sphere)
    };
    model.surfaces = vec![floor(friction)];
    simulate(model, 5e-6, RADIUS)
}

fn slip() -> Result<Vec<Finding>, Broken> {
    let (speed, friction) = (1.0, 0.3);
    let mut simulation = on_floor(speed, friction, 0.0);
    let mut rolls_from = f64::NAN;
    while simulation.time < 0.13 {
        simulation.step()?;
        let grain = simulation.grains.grain(0);
        if rolls_from.is_nan() && grain.velocity.x - RADIUS * grain.spin().y < 1e-3 * speed {
            rolls_from = simulation.time;
        }
    }
    let grain = simulation.grains.grain(0);
    Ok(vec![
        Finding::near("rolls from (s)", rolls_from, 2.0 * speed / (7.0 * friction * GRAVITY), 0.01),
        Finding::near("speed (m/s)", grain.velocity.x, 5.0 / 7.0 * speed, 0.01),
        Finding::near("spin times radius (m/s)", grain.spin().y * RADIUS, 5.0 / 7.0 * speed, 0.01),
    ])
}

fn slope() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for degrees in [20.0_f64, 40.0, 58.0] {
        let slope = degrees.to_radians();
        let mut simulation = on_floor(0.0, libm::tan(25_f64.to_radians()), slope);
        run_until(&mut simulation, 0.1)?;
        let acceleration = simulation.grains.grain(0).velocity.x / simulation.time;
        let what = format!("acceleration on {degrees}° (m/s²)");
        findings.push(Finding::near(what, acceleration, 5.0 / 7.0 * GRAVITY * libm::sin(slope), 0.005));
    }
    Ok(findings)
}
