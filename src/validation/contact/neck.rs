//! A28: a small ball that rolls off the neck between two large ones.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, ball, free_model, simulate};
use dem::Vec3;
use dem::contact::law::contact_stiffness;
use dem::contact::material::Material;
use dem::contact::restitution::damping_ratio_for;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::GrainShape;
use dem::time::stable_step::critical_step_of_pair;

pub const CASE: Case = Case {
    id: "A28",
    suite: Suite::Contact,
    title: "A small ball rolls off the neck between two large ones, however much larger they are",
    source: "½ v² (1 + ⅖ (R + r)²/ρ²) = g ρ (cos θ₀ − cos θ) with ρ² = 2 R r + r², of a ball that rolls without slip on both; the test with three particles is that of Vyas et al. 2025",
    tier: Tier::ClosedForm,
    weakness: "spheres of one material; the large ones are held where they are",
    cost: Cost::Quick,
    run,
};

const RATIOS: [f64; 5] = [1.0, 3.0, 10.0, 30.0, 100.0];
/// Steps over the critical one.
const STEPS: [f64; 3] = [0.02, 0.1, 0.4];
/// Radius of the large balls (m).
const LARGE: f64 = 0.025;
const DENSITY: f64 = 2600.0;
const MATERIAL: Material = Material::new(1e6, 0.3, 0.5);
/// From where it rolls, from the top (deg).
const FROM: f64 = 1.0;
/// Where its speed is asked, from the middle of the neck down, over the radius of the circle on which it went.
const BELOW: f64 = 1.5;
/// Mass of what is to stay where it is (kg).
const HELD: f64 = 1e30;

fn run() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for ratio in RATIOS {
        for share in STEPS {
            let what = format!("speed over what it should be, size ratio {ratio}, {share} of the critical step");
            findings.push(Finding::close(what, Neck::of(ratio).speed(share)?, 1.0, 0.03));
        }
    }
    Ok(findings)
}

/// Two large balls that touch in the origin, beside each other along x, and a small one of radius r on both.
struct Neck {
    small: f64,
    /// Of the circle on which its centre goes (m).
    circle: f64,
}

impl Neck {
    fn of(ratio: f64) -> Self {
        let small = LARGE / ratio;
        Self { small, circle: (2.0 * LARGE * small + small * small).sqrt() }
    }

    /// Speed of the small ball at the end of its way over what it should be; nothing if it does not get there.
    fn speed(&self, share: f64) -> Result<f64, Broken> {
        let mass = ball(0, Vec3::zeros(), self.small, DENSITY).body.mass;
        let stiffness = contact_stiffness(MATERIAL.modulus * self.small, MATERIAL.modulus * LARGE);
        let critical = critical_step_of_pair(2.0 * stiffness, mass, damping_ratio_for(MATERIAL.restitution));
        let places = [Vec3::x() * -LARGE, Vec3::x() * LARGE];
        let from = FROM.to_radians();
        // Pressed into both by its weight.
        let reach = LARGE + self.small;
        let overlap = 0.5 * mass * GRAVITY * libm::cos(from) * reach / self.circle / stiffness;
        let height = ((reach - overlap).powi(2) - LARGE * LARGE).sqrt();
        let mut grains = vec![ball(0, Vec3::new(0.0, libm::sin(from), libm::cos(from)) * height, self.small, DENSITY)];
        for (id, place) in (1..).zip(places) {
            let mut large = ball(id, place, LARGE, DENSITY);
            large.body.mass = HELD;
            large.body.inertia_axial = HELD;
            large.body.inertia_transverse = HELD;
            grains.push(large);
        }
        let gravity = Vec3::z() * -GRAVITY;
        let model = Model { gravity, material: MATERIAL, ..free_model(grains, GrainShape::Sphere) };
        let mut simulation = simulate(model, share * critical, self.small);
        let (expected, time) = self.falls();
        while simulation.time < 2.0 * time {
            simulation.step()?;
            hold(&mut simulation, &places);
            let row = simulation.grains.ids.iter().position(|id| *id == 0).unwrap_or(0);
            let grain = simulation.grains.grain(row);
            // Where it was when it had its velocity.
            let place = grain.position - grain.velocity * (0.5 * simulation.time_step);
            if place.z < -BELOW * self.circle {
                return Ok(grain.velocity.norm() / expected);
            }
        }
        Ok(0.0)
    }

    /// Speed with which the ball falls through the height below (m/s), and when (s): it rolls as far as friction holds it, slips where it
    /// does not, and leaves the neck where nothing presses it any more. With N the sum of both normal forces, h = r ρ/(R + r) the lever of
    /// their friction F about the centre and ω its spin:
    /// N ρ/(R + r) = m g cos θ − m v²/ρ, m v' = m g sin θ − F, ⅖ m r² ω' = F h, F ≤ μ N.
    fn falls(&self) -> (f64, f64) {
        const STEP: f64 = 1e-6;
        let reach = LARGE + self.small;
        let lever = self.small * self.circle / reach;
        let turning = 0.4 * self.small.powi(2);
        let rolling = turning / (turning + lever * lever);
        let (mut angle, mut speed, mut spin, mut time) = (FROM.to_radians(), 0.0_f64, 0.0_f64, 0.0);
        let step = STEP * (self.circle / GRAVITY).sqrt() * 10.0;
        loop {
            let (sine, cosine) = libm::sincos(angle);
            let pressed = (GRAVITY * cosine - speed * speed / self.circle) * reach / self.circle;
            if pressed <= 0.0 {
                break;
            }
            let most = MATERIAL.friction * pressed;
            let sliding = speed - spin * lever;
            let rolls = rolling * GRAVITY * sine;
            let friction = if sliding <= 1e-9 && rolls <= most { rolls } else { most };
            speed += (GRAVITY * sine - friction) * step;
            spin += friction * lever / turning * step;
            angle += speed / self.circle * step;
            time += step;
        }
        let (sine, cosine) = libm::sincos(angle);
        let fall = self.circle * (cosine + BELOW);
        let end = (speed * speed + 2.0 * GRAVITY * fall).sqrt();
        (end, time + ((speed * sine).powi(2) + 2.0 * GRAVITY * fall).sqrt() / GRAVITY - speed * sine / GRAVITY)
    }
}

/// Puts the large balls back, as if nothing pulled at them.
fn hold(simulation: &mut Simulation, places: &[Vec3; 2]) {
    for row in 0..simulation.grains.len() {
        let Some(place) = (simulation.grains.ids[row] as usize).checked_sub(1).map(|large| places[large]) else {
            continue;
        };
        simulation.grains.place[row].set_vector(&place);
        simulation.grains.motion[row].set_vector(&Vec3::zeros());
    }
}
