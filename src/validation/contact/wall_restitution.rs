//! A3: a ball against a wall; and clumps, which meet with the mass of the whole clump.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{MODULUS, ball, contact_time, floor, free_model, material, run as step_on, simulate};
use dem::Vec3;
use dem::model::Model;
use dem::tables::grains::{Grain, GrainBody, GrainShape};

pub const CASE: Case = Case {
    id: "A3",
    suite: Suite::Contact,
    title: "Restitution at a wall and between clumps is the nominal one",
    source: "reduced mass of a wall contact is the grain's own; of a clump the clump's",
    tier: Tier::ClosedForm,
    weakness: "central impacts only; off-centre impacts of clumps turn part of the energy into spin",
    cost: Cost::Quick,
    run,
};

const RADIUS: f64 = 0.01;
const STEPS_PER_CONTACT: f64 = 400.0;

fn run() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for nominal in [0.1, 0.3, 0.5, 0.9] {
        findings.push(Finding::close(format!("ball on wall, ε = {nominal}"), ball_on_wall(nominal)?, nominal, 0.01));
        findings.push(Finding::close(format!("clumps end-on, ε = {nominal}"), clumps_end_on(nominal)?, nominal, 0.01));
        let measured = clump_on_wall(nominal)?;
        findings.push(Finding::close(format!("clump end-on on wall, ε = {nominal}"), measured, nominal, 0.01));
    }
    Ok(findings)
}

fn ball_on_wall(nominal: f64) -> Result<f64, Broken> {
    let mut grain = ball(0, Vec3::new(0.0, 0.0, RADIUS + 1e-9), RADIUS, 2600.0);
    grain.velocity.z = -1.0;
    on_wall(grain, GrainShape::Sphere, nominal)
}

fn clump_on_wall(nominal: f64) -> Result<f64, Broken> {
    let body = GrainBody::clump(2.0 * RADIUS, 1.5, 2600.0);
    let mut grain = Grain::at(0, Vec3::z() * (body.offset + body.radius + 1e-9), Vec3::z(), body);
    grain.velocity.z = -1.0;
    on_wall(grain, GrainShape::Clump, nominal)
}

fn on_wall(grain: Grain, shape: GrainShape, nominal: f64) -> Result<f64, Broken> {
    let time = contact_time(MODULUS * grain.body.radius, grain.body.mass);
    let mut model = Model { material: material(nominal, 0.0), ..free_model(vec![grain], shape) };
    model.surfaces = vec![floor(0.0)];
    let mut simulation = simulate(model, time / STEPS_PER_CONTACT, RADIUS);
    step_on(&mut simulation, 3 * STEPS_PER_CONTACT as usize)?;
    Ok(simulation.grains.grain(0).velocity.z)
}

fn clumps_end_on(nominal: f64) -> Result<f64, Broken> {
    let body = GrainBody::clump(2.0 * RADIUS, 1.5, 2600.0);
    let reach = body.offset + body.radius + 1e-9;
    let clump = |id: u32, side: f64| {
        let mut grain = Grain::at(id, Vec3::x() * (side * reach), Vec3::x(), body);
        grain.velocity.x = -side;
        grain
    };
    let model = Model {
        material: material(nominal, 0.0),
        ..free_model(vec![clump(0, -1.0), clump(1, 1.0)], GrainShape::Clump)
    };
    let time = contact_time(MODULUS * body.radius, 0.5 * body.mass);
    let mut simulation = simulate(model, time / STEPS_PER_CONTACT, RADIUS);
    step_on(&mut simulation, 3 * STEPS_PER_CONTACT as usize)?;
    Ok(simulation.grains.grain(0).velocity.x.abs())
}
