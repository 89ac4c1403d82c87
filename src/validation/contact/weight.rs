//! A7: a ball at rest on the floor.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, MODULUS, ball, floor, free_model, material, run as step_on, simulate};
use dem::Vec3;
use dem::model::Model;
use dem::tables::grains::GrainShape;

pub const CASE: Case = Case {
    id: "A7",
    suite: Suite::Contact,
    title: "A ball at rest sinks in by its weight over the stiffness",
    source: "u = m g/k; YADE's checkWeight uses the same tolerance",
    tier: Tier::ClosedForm,
    weakness: "one contact",
    cost: Cost::Quick,
    run,
};

fn run() -> Result<Vec<Finding>, Broken> {
    let radius = 0.01;
    let grain = ball(0, Vec3::z() * radius, radius, 2600.0);
    let weight = grain.body.mass * GRAVITY;
    let mut model = Model {
        material: material(0.3, 0.5),
        gravity: Vec3::z() * -GRAVITY,
        ..free_model(vec![grain], GrainShape::Sphere)
    };
    model.surfaces = vec![floor(0.5)];
    let mut simulation = simulate(model, 2e-6, radius);
    step_on(&mut simulation, 40_000)?;
    let sunk = radius - simulation.grains.grain(0).position.z;
    Ok(vec![
        Finding::near("overlap (m)", sunk, weight / (MODULUS * radius), 1e-4),
        Finding::near("force on the floor (N)", -simulation.sums.surfaces.base.z, weight, 1e-4),
    ])
}
