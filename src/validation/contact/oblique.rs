//! A9, A11, A12 and A13: oblique impacts on a wall.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{ball, contact_time, floor, free_model, run as step_on, simulate};
use dem::Vec3;
use dem::contact::material::Material;
use dem::model::Model;
use dem::tables::grains::GrainShape;

pub const CLOSED_FORM: Case = Case {
    id: "A9",
    suite: Suite::Contact,
    title: "Oblique impact without damping, from sticking to sliding",
    source: "k_t = 2/7 k: ψ ≤ 3.5 reverses the contact point and e_t = 3/7; beyond, e_t = 1 − 2/ψ and R ω/(μ v_n) = 5",
    tier: Tier::ClosedForm,
    weakness: "the linear law's own closed form; a Hertzian ball differs where it sticks",
    cost: Cost::Quick,
    run: closed_form,
};

pub const ALUMINIUM_OXIDE: Case = Case {
    id: "A11",
    suite: Suite::Contact,
    title: "Aluminium oxide spheres on glass at 3.9 m/s, sliding branch",
    source: "Kharaz et al. 2001 and Chung & Ooi test 4: e_t = 1 − μ(1+ε)/tan θ, ω = −(5/2) μ(1+ε) v cos θ/R",
    tier: Tier::Published,
    weakness: "steeper than 32° a Hertzian ball sticks otherwise than a linear one; not judged there",
    cost: Cost::Quick,
    run: aluminium_oxide,
};

pub const SLIDING: Case = Case {
    id: "A12",
    suite: Suite::Contact,
    title: "Micrometre spheres with fast sliding",
    source: "Chung & Ooi test 5: recoil of the contact point v_t/(μ v_n) − 7 and R ω/(μ v_n) = −5 for v_t/(μ v_n) ≥ 7",
    tier: Tier::Published,
    weakness: "stiffness enters only through the contact staying small against the radius",
    cost: Cost::Quick,
    run: sliding,
};

pub const SPINNING: Case = Case {
    id: "A13",
    suite: Suite::Contact,
    title: "A ball that falls straight but spins",
    source: "Chung & Ooi test 6: β = X − 1 with X = 3.5 μ(1+ε) v_n/v_s ≤ 0.8",
    tier: Tier::Published,
    weakness: "a dashpot starts with a jump of the normal force that the friction spring has to follow: up to 7 % at the larger X",
    cost: Cost::Quick,
    run: spinning,
};

/// An impact on the plane z = 0.
struct Impact {
    radius: f64,
    density: f64,
    modulus: f64,
    restitution: f64,
    friction: f64,
    velocity: Vec3,
    /// About y (rad/s).
    spin: f64,
}

/// Velocity and spin about y afterwards.
fn after(impact: &Impact) -> Result<(Vec3, f64), Broken> {
    let radius = impact.radius;
    let mut grain = ball(0, Vec3::z() * (radius * (1.0 + 1e-9)), radius, impact.density);
    grain.velocity = impact.velocity;
    grain.angular_momentum = Vec3::y() * (impact.spin * grain.body.inertia_axial);
    let step = contact_time(impact.modulus * radius, grain.body.mass) / 2000.0;
    let mut model = Model {
        material: Material::new(impact.modulus, impact.restitution, impact.friction),
        ..free_model(vec![grain], GrainShape::Sphere)
    };
    model.surfaces = vec![floor(impact.friction)];
    let mut simulation = simulate(model, step, radius);
    step_on(&mut simulation, 4000)?;
    let grain = simulation.grains.grain(0);
    Ok((grain.velocity, grain.spin().y))
}

fn closed_form() -> Result<Vec<Finding>, Broken> {
    let (friction, speed, radius) = (0.3, 0.05, 0.01);
    let mut findings = Vec::new();
    for ratio in [1.0, 3.0, 5.0, 10.0] {
        let tangential = ratio * friction * speed;
        let (velocity, spin) = after(&Impact {
            radius,
            density: 2600.0,
            modulus: 1e8,
            restitution: 1.0,
            friction,
            velocity: Vec3::new(tangential, 0.0, -speed),
            spin: 0.0,
        })?;
        let kept = velocity.x / tangential;
        let rim = (velocity.x - radius * spin) / tangential;
        if ratio <= 3.5 {
            findings.push(Finding::near(format!("ψ = {ratio}: e_t"), kept, 3.0 / 7.0, 0.005));
            findings.push(Finding::close(format!("ψ = {ratio}: contact point"), rim, -1.0, 0.005));
        } else {
            findings.push(Finding::near(format!("ψ = {ratio}: e_t"), kept, 1.0 - 2.0 / ratio, 0.005));
            let turned = radius * spin / (friction * speed);
            findings.push(Finding::near(format!("ψ = {ratio}: R ω/(μ v_n)"), turned, 5.0, 0.005));
        }
    }
    Ok(findings)
}

fn aluminium_oxide() -> Result<Vec<Finding>, Broken> {
    let (radius, friction, restitution, speed) = (2.5e-3, 0.092, 0.98, 3.9);
    let mut findings = Vec::new();
    for (degrees, tangential, spin) in [(40.0_f64, 0.7829, -544.2), (60.0, 0.8948, -355.2), (80.0, 0.9679, -123.4)] {
        let angle = degrees.to_radians();
        let velocity = Vec3::new(libm::sin(angle), 0.0, -libm::cos(angle)) * speed;
        let (out, turning) =
            after(&Impact { radius, density: 4000.0, modulus: 1e10, restitution, friction, velocity, spin: 0.0 })?;
        findings.push(Finding::near(format!("{degrees}°: e_t"), out.x / velocity.x, tangential, 0.01));
        // Positive about y in our frame, negative in the published one.
        findings.push(Finding::near(format!("{degrees}°: ω (rad/s)"), -turning, spin, 0.01));
    }
    let angle = 10_f64.to_radians();
    let velocity = Vec3::new(libm::sin(angle), 0.0, -libm::cos(angle)) * speed;
    let (out, _) =
        after(&Impact { radius, density: 4000.0, modulus: 1e10, restitution, friction, velocity, spin: 0.0 })?;
    findings.push(Finding::told("10°: e_t (linear law 3/7)", out.x / velocity.x));
    Ok(findings)
}

fn sliding() -> Result<Vec<Finding>, Broken> {
    let (radius, friction, speed) = (1e-5, 0.3, 5.0);
    let mut findings = Vec::new();
    for ratio in [9.99, 12.96] {
        let tangential = ratio * friction * speed;
        let (velocity, spin) = after(&Impact {
            radius,
            density: 7850.0,
            modulus: 1e12,
            restitution: 1.0,
            friction,
            velocity: Vec3::new(tangential, 0.0, -speed),
            spin: 0.0,
        })?;
        let recoil = (velocity.x - radius * spin) / (friction * speed);
        findings.push(Finding::close(format!("v_t/(μ v_n) = {ratio}: recoil"), recoil, ratio - 7.0, 0.005 * ratio));
        findings.push(Finding::near("R ω/(μ v_n)", -radius * spin / (friction * speed), -5.0, 0.005));
    }
    Ok(findings)
}

fn spinning() -> Result<Vec<Finding>, Broken> {
    let (radius, friction, restitution, speed) = (0.1, 0.4, 0.5, 0.2);
    let mut findings = Vec::new();
    for (factor, published, share) in [(0.176_f64, -0.824, 0.02), (0.551, -0.445, 0.07)] {
        let surface = 3.5 * friction * (1.0 + restitution) * speed / factor;
        let (velocity, spin) = after(&Impact {
            radius,
            density: 2700.0,
            modulus: 1e9,
            restitution,
            friction,
            velocity: Vec3::new(0.0, 0.0, -speed),
            spin: surface / radius,
        })?;
        // Tangential restitution of the contact point, which starts with −R ω.
        let recoil = -(velocity.x - radius * spin) / (-surface);
        findings.push(Finding::near(format!("X = {factor}: β"), recoil, published, share));
    }
    Ok(findings)
}
