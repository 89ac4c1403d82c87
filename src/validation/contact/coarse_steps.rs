//! A15: oblique impacts in steps as long as those of whole scenes, and in the longest that is allowed.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{MODULUS, ball, floor, free_model, run as step_on, simulate};
use dem::Vec3;
use dem::contact::material::Material;
use dem::contact::restitution::LONGEST_PHASE;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::{Grain, GrainShape};

pub const CASE: Case = Case {
    id: "A15",
    suite: Suite::Contact,
    title: "Oblique impacts of a damped sphere in steps of a fifth to a tenth of the contact",
    source: "the same impact in steps of a thousandth of the contact; where it slides all the time, R ω/(μ v_n) = 5/2 (1 + ε)",
    tier: Tier::ClosedForm,
    weakness: "single impacts, by where in a step the contact begins, are judged at an eighth and a tenth and below v_t/(μ v_n) = 9; beyond, up to 6 % off, and in longer steps up to 22 %, only their mean is, and not in the longest step at 9, where it is 5.4 % off",
    cost: Cost::Quick,
    run,
};

const RADIUS: f64 = 0.1;
const DENSITY: f64 = 2600.0;
const RESTITUTION: f64 = 0.3;
const FRICTION: f64 = 0.3;
/// Speed towards the wall (m/s).
const SPEED: f64 = 1.0;
/// Duration of the contact times ω₀ with this restitution (Schwager & Pöschel 2007, truncated).
const DURATION: f64 = 2.42131;
/// The longest step that is allowed, as steps in a contact.
const LONGEST: f64 = DURATION / LONGEST_PHASE;
/// Steps in a contact from which each single impact is judged.
const SINGLE_IMPACTS_HOLD: f64 = 8.0;
/// v_t/(μ v_n) from which it is told only.
const FAST: f64 = 9.0;
/// Places within a step at which the contact begins.
const PHASES: u32 = 32;

/// Against what the sphere is thrown.
#[derive(Clone, Copy)]
enum Target {
    Wall,
    Sphere,
}

fn run() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for (target, name) in [(Target::Wall, "wall"), (Target::Sphere, "sphere")] {
        for ratio in [0.5, 1.0, 2.0, 3.0, 5.0, 9.0] {
            let reference = spins(target, ratio, 1000.0, 1)?[0];
            for steps in [LONGEST, 6.0, 8.0, 10.0] {
                let shares: Vec<f64> =
                    spins(target, ratio, steps, PHASES)?.into_iter().map(|spin| spin / reference).collect();
                let mean = shares.iter().sum::<f64>() / shares.len() as f64;
                let furthest = shares.iter().fold(0.0_f64, |most, share| most.max((share - 1.0).abs()));
                let what = format!("{name}, v_t/(μ v_n) = {ratio}, {steps:.1} steps");
                let of_all = format!("{what}: mean spin over that of short steps");
                findings.push(match steps < 6.0 && ratio >= FAST {
                    true => Finding::told(of_all, mean),
                    false => Finding::near(of_all, mean, 1.0, 0.05),
                });
                let single = format!("{what}: the impact furthest from it");
                findings.push(match steps >= SINGLE_IMPACTS_HOLD && ratio < FAST {
                    true => Finding::close(single, furthest, 0.0, 0.05),
                    false => Finding::told(single, furthest),
                });
            }
        }
    }
    Ok(findings)
}

/// Spin (rad/s) with which the sphere leaves, by where in a step of a share 1/`steps` of the contact it begins.
fn spins(target: Target, ratio: f64, steps: f64, phases: u32) -> Result<Vec<f64>, Broken> {
    let body = ball(0, Vec3::zeros(), RADIUS, DENSITY).body;
    let (stiffness, reduced_mass) = match target {
        // A wall is as hard as the sphere: the stiffness is E r.
        Target::Wall => (MODULUS * RADIUS, body.mass),
        Target::Sphere => (MODULUS * RADIUS, 0.5 * body.mass),
    };
    let step = DURATION * (reduced_mass / stiffness).sqrt() / steps;
    (0..phases)
        .map(|phase| {
            let gap = SPEED * step * (f64::from(phase) + 0.5) / f64::from(phases);
            let mut simulation = scene(target, Vec3::new(ratio * FRICTION * SPEED, 0.0, -SPEED), gap, step);
            step_on(&mut simulation, (3.0 * steps) as usize)?;
            Ok(simulation.grains.grain(0).spin().y)
        })
        .collect()
}

/// A sphere above the plane z = 0, or above the middle of another, that flies towards it from a gap (m).
fn scene(target: Target, velocity: Vec3, gap: f64, step: f64) -> Simulation {
    let thrown = |height: f64, share: f64| -> Grain {
        Grain { velocity: velocity * share, ..ball(0, Vec3::z() * height, RADIUS, DENSITY) }
    };
    let grains = match target {
        Target::Wall => vec![thrown(RADIUS + gap, 1.0)],
        Target::Sphere => {
            vec![thrown(RADIUS + 0.5 * gap, 0.5), Grain { id: 1, ..thrown(-RADIUS - 0.5 * gap, -0.5) }]
        }
    };
    let material = Material::new(MODULUS, RESTITUTION, FRICTION);
    let mut model = Model { material, ..free_model(grains, GrainShape::Sphere) };
    if matches!(target, Target::Wall) {
        model.surfaces = vec![floor(FRICTION)];
    }
    simulate(model, step, RADIUS)
}
