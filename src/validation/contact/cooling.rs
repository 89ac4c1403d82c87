//! A25: a granular gas that cools.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{MODULUS, ball, contact_time, free_model, material, simulate};
use dem::Vec3;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::{Grain, GrainShape};

pub const CASE: Case = Case {
    id: "A25",
    suite: Suite::Contact,
    title: "Cooling of a dilute gas of inelastic balls (Haff's law)",
    source: "T = T0/(1 + t/τ0)², 1/τ0 = (1 − ε²) ν/6 with Enskog's ν = 4 √π n d² g √(T0/m)",
    tier: Tier::ClosedForm,
    weakness: "512 balls between mirrors instead of in a periodic box (their missing partners are allowed for); half the energy is kept",
    cost: Cost::Quick,
    run,
};

const SIDE: usize = 8;
const RADIUS: f64 = 0.005;
const FRACTION: f64 = 0.02;
const RESTITUTION: f64 = 0.9;

fn run() -> Result<Vec<Finding>, Broken> {
    let measured = [1, 2, 3, 4].map(cooling_time);
    let mut mean = 0.0;
    let mut expected = 0.0;
    for outcome in measured {
        let (time, theory) = outcome?;
        mean += 0.25 * time;
        expected = theory;
    }
    Ok(vec![Finding::near("τ0 (s), mean of four runs", mean, expected, 0.05)])
}

/// Measured and expected cooling time (s).
fn cooling_time(seed: u64) -> Result<(f64, f64), Broken> {
    let count = SIDE.pow(3);
    let volume = count as f64 * std::f64::consts::PI / 6.0 * (2.0 * RADIUS).powi(3) / FRACTION;
    let size = libm::cbrt(volume);
    let mut simulation = simulate_gas(size, seed);
    let mass = simulation.grains.bodies[0].mass;
    // Elastic at first, so that the velocities become Maxwell's.
    for _ in 0..20_000 {
        step_between_mirrors(&mut simulation, size)?;
    }
    let mut model = simulation.model.clone();
    model.grains = simulation.snapshot();
    model.material = material(RESTITUTION, 0.0);
    let step = simulation.time_step;
    let mut simulation = simulate(model, step, RADIUS);
    let start = temperature(&simulation);
    let contact_value = (1.0 - 0.5 * FRACTION) / (1.0 - FRACTION).powi(3);
    let density = count as f64 / volume;
    // A ball near a mirror has partners on one side only: of its collision sphere a quarter lies outside on the average
    // over a layer of one diameter at each of the six mirrors.
    let inside = 1.0 - 6.0 * 0.25 * 2.0 * RADIUS / size;
    let rate = 4.0
        * std::f64::consts::PI.sqrt()
        * density
        * (2.0 * RADIUS).powi(2)
        * contact_value
        * (start / mass).sqrt()
        * inside;
    let expected = 6.0 / ((1.0 - RESTITUTION * RESTITUTION) * rate);
    while temperature(&simulation) > 0.5 * start {
        for _ in 0..100 {
            step_between_mirrors(&mut simulation, size)?;
        }
    }
    // T0/T = (1 + t/τ0)²
    Ok((simulation.time / ((start / temperature(&simulation)).sqrt() - 1.0), expected))
}

fn simulate_gas(size: f64, seed: u64) -> Simulation {
    let mut random = fastrand::Rng::with_seed(seed);
    let spacing = size / SIDE as f64;
    let grains: Vec<Grain> = (0..SIDE.pow(3))
        .map(|index| {
            let cell = [index % SIDE, index / SIDE % SIDE, index / SIDE / SIDE].map(|i| (i as f64 + 0.5) * spacing);
            let mut grain = ball(index as u32, Vec3::from(cell), RADIUS, 2600.0);
            grain.velocity = Vec3::from_fn(|_, _| 2.0 * random.f64() - 1.0) * 0.5;
            grain
        })
        .collect();
    let step = contact_time(MODULUS * RADIUS, 0.5 * grains[0].body.mass) / 20.0;
    let model = Model { material: material(1.0, 0.0), ..free_model(grains, GrainShape::Sphere) };
    Simulation::new(model, step, 4.0 * RADIUS, 1e6)
}

/// Balls whose centres have left the box are sent back: mirrors take no energy, and no part of the gas is shut out.
fn step_between_mirrors(simulation: &mut Simulation, size: f64) -> Result<(), Broken> {
    simulation.step()?;
    for (place, motion) in simulation.grains.place.iter().zip(&mut simulation.grains.motion) {
        for axis in 0..3 {
            let (x, v) = (place.0[axis], motion.0[axis]);
            if (x < 0.0 && v < 0.0) || (x > size && v > 0.0) {
                motion.0[axis] = -v;
            }
        }
    }
    Ok(())
}

/// m⟨v²⟩/3 (J).
fn temperature(simulation: &Simulation) -> f64 {
    let grains = simulation.snapshot();
    let sum: f64 = grains.iter().map(|grain| grain.body.mass * grain.velocity.norm_squared()).sum();
    sum / (3.0 * grains.len() as f64)
}
