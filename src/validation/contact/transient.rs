//! A5: where a ball is in the middle of a contact.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{ball, free_model, run as step_on, simulate};
use dem::Vec3;
use dem::contact::material::Material;
use dem::contact::restitution::restitution_of;
use dem::model::Model;
use dem::tables::grains::GrainShape;

pub const CASE: Case = Case {
    id: "A5",
    suite: Suite::Contact,
    title: "Displacement inside a contact after 0.05 s",
    source: "damped oscillator, with the stiffness and damping of YADE's checkViscElPM",
    tier: Tier::ClosedForm,
    weakness: "before the dashpot is cut off, so it says nothing about the end of the contact",
    cost: Cost::Quick,
    run,
};

const RADIUS: f64 = 0.1;
/// Each ball's own spring (N/m) and dashpot (N s/m); two in series make the contact.
const STIFFNESS: f64 = 2370.68;
const DAMPING: f64 = 100.864;
const TIME: f64 = 0.05;

fn run() -> Result<Vec<Finding>, Broken> {
    let grains = [(0, -1.0), (1, 1.0)].map(|(id, side)| {
        let mut grain = ball(id, Vec3::x() * (side * RADIUS), RADIUS, 2000.0);
        grain.velocity.x = -2.0 * side;
        grain
    });
    let reduced = 0.5 * grains[0].body.mass;
    let (stiffness, damping) = (0.5 * STIFFNESS, 0.5 * DAMPING);
    let zeta = damping / (2.0 * (stiffness * reduced).sqrt());
    let step = 1e-6;
    let model = Model {
        material: Material::new(stiffness / RADIUS, restitution_of(zeta), 0.0),
        ..free_model(grains.to_vec(), GrainShape::Sphere)
    };
    let mut simulation = simulate(model, step, RADIUS);
    step_on(&mut simulation, (TIME / step).round() as usize)?;
    let moved = simulation.grains.grain(0).position.x + RADIUS;
    Ok(vec![Finding::near("displacement (m)", moved, 0.066_630_9, 1e-4)])
}
