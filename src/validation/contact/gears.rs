//! A14: two balls whose surfaces move together.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{MODULUS, ball, contact_time, free_model, material, run as step_on, simulate};
use dem::Vec3;
use dem::model::Model;
use dem::tables::grains::GrainShape;

pub const CASE: Case = Case {
    id: "A14",
    suite: Suite::Contact,
    title: "Balls that meet like gears keep their spins",
    source: "Chung & Ooi test 7: surfaces that move together do not rub",
    tier: Tier::Published,
    weakness: "one geometry",
    cost: Cost::Quick,
    run,
};

fn run() -> Result<Vec<Finding>, Broken> {
    let (radius, speed, spin) = (0.1, 0.2, 3.0);
    let grains = [(0, -1.0), (1, 1.0)].map(|(id, side)| {
        let mut grain = ball(id, Vec3::x() * (side * radius * (1.0 + 1e-9)), radius, 2700.0);
        grain.velocity.x = -side * speed;
        grain.angular_momentum = Vec3::z() * (side * spin * grain.body.inertia_axial);
        grain
    });
    let step = contact_time(MODULUS * radius, 0.5 * grains[0].body.mass) / 500.0;
    let model = Model { material: material(0.5, 0.4), ..free_model(grains.to_vec(), GrainShape::Sphere) };
    let mut simulation = simulate(model, step, radius);
    step_on(&mut simulation, 1000)?;
    let grain = simulation.grains.grain(0);
    Ok(vec![
        Finding::close("change of spin over spin", grain.spin().z / -spin - 1.0, 0.0, 1e-10),
        Finding::close("tangential velocity over speed", grain.velocity.y / speed, 0.0, 1e-10),
    ])
}
