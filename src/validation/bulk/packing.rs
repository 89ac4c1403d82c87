//! B5 and B6: a bed poured into a box: what it weighs on the floor, and how dense it is.

use crate::scene::flow::packing::{PackingRoom, pack};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, floor, free_model, material, plane, run_until};
use dem::Vec3;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::{GrainBody, GrainShape};
use dem::tables::surfaces::SurfaceRole;

pub const CASE: Case = Case {
    id: "B6",
    suite: Suite::Bulk,
    title: "Poured spheres: packing fraction, and the floor carries the weight (B5)",
    source: "0.58 to 0.64 for random packings of spheres; YADE checkWeight for the force",
    tier: Tier::SecondHand,
    weakness: "walls loosen the packing; the fraction is that of the middle of the bed",
    cost: Cost::Quick,
    run,
};

const RADIUS: f64 = 0.01;
const DENSITY: f64 = 2600.0;
const SIDE: f64 = 0.20;
const COUNT: usize = 1500;

fn run() -> Result<Vec<Finding>, Broken> {
    let simulation = poured()?;
    let grains = simulation.snapshot();
    let weight: f64 = grains.iter().map(|grain| grain.body.mass).sum::<f64>() * GRAVITY;
    let top = 0.9 * grains.iter().map(|grain| grain.position.z).fold(0.0, f64::max);
    Ok(vec![
        Finding::between("packing fraction in the middle", fraction(&simulation, top), 0.58, 0.64),
        Finding::near("force on the floor over weight", -simulation.sums.surfaces.base.z / weight, 1.0, 1e-3),
    ])
}

/// Spheres let fall from a loose packing into a box whose sides do not rub.
fn poured() -> Result<Simulation, Broken> {
    let bodies = vec![GrainBody::sphere(RADIUS, DENSITY); COUNT];
    let height = COUNT as f64 * std::f64::consts::PI / 6.0 * (2.0 * RADIUS).powi(3) / (0.30 * SIDE * SIDE);
    let room = PackingRoom::level(Vec3::new(SIDE, SIDE, height), false);
    let (grains, growth) =
        pack(&bodies, GrainShape::Sphere, room, 6).map_err(|error| Broken::Scene(error.to_string()))?;
    let length = growth * room.size.x;
    let mut model =
        Model { material: material(0.3, 0.3), gravity: Vec3::z() * -GRAVITY, ..free_model(grains, GrainShape::Sphere) };
    let side = |origin: Vec3, normal: Vec3| plane(SurfaceRole::Side, origin, normal, 0.0);
    model.surfaces = vec![
        floor(0.3),
        side(Vec3::zeros(), Vec3::x()),
        side(Vec3::x() * length, -Vec3::x()),
        side(Vec3::zeros(), Vec3::y()),
        side(Vec3::y() * SIDE, -Vec3::y()),
    ];
    let mut simulation = Simulation::new(model, 2e-5, 0.5 * RADIUS, 1e3);
    run_until(&mut simulation, 0.7)?;
    // The last trembling fades under drag, so that the floor's force is the weight.
    simulation.drag = 50.0;
    run_until(&mut simulation, 1.0)?;
    Ok(simulation)
}

/// Share of solid in the middle of the bed, three radii from the walls, by sampling.
fn fraction(simulation: &Simulation, top: f64) -> f64 {
    let grains = simulation.snapshot();
    let mut random = fastrand::Rng::with_seed(6);
    let (low, high) = (4.0 * RADIUS, SIDE - 4.0 * RADIUS);
    let count = 20_000;
    let mut hits = 0;
    for _ in 0..count {
        let mut within = |low: f64, high: f64| low + (high - low) * random.f64();
        let point = Vec3::new(within(low, high), within(low, high), within(low, top - 4.0 * RADIUS));
        hits += usize::from(grains.iter().any(|grain| (grain.position - point).norm_squared() < RADIUS * RADIUS));
    }
    hits as f64 / count as f64
}
