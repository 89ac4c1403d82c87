//! C1, C2 and C13: what the forces on a wall must add up to.

use crate::loads::cases::load_case::AdditionalActions;
use crate::loads::cases::{all, split};
use crate::loads::input::GuidelineInput;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{
    GRAVITY, MODULUS, ball, cloud, contact_time, floor, free_model, material, momenta, plane, simulate,
};
use dem::Vec3;
use dem::model::Model;
use dem::tables::grains::GrainShape;
use dem::tables::surfaces::SurfaceRole;
use dem::tables::wall::WallShape;

pub const BALANCE: Case = Case {
    id: "C1",
    suite: Suite::Wall,
    title: "The impulses of all surfaces and of gravity are the change of momentum",
    source: "Newton's second law for all grains together",
    tier: Tier::ClosedForm,
    weakness: "says nothing about how the force is shared between surfaces",
    cost: Cost::Quick,
    run: balance,
};

pub const BEAM: Case = Case {
    id: "C2",
    suite: Suite::Wall,
    title: "A sparse beam of balls on a wall",
    source: "total impulse N m v (1 + ε)",
    tier: Tier::ClosedForm,
    weakness: "no contacts between the balls",
    cost: Cost::Quick,
    run: beam,
};

pub const IDENTITY: Case = Case {
    id: "C13",
    suite: Suite::Wall,
    title: "The guideline's two parts add up to its pressure diagram",
    source: "F1 + F2 = ½ K ρ g cos α (H_d + h)² + λ ρ v² h (Volkwein 2014, Albaba 2015 Eq. 5.3 and 5.4 corrected)",
    tier: Tier::ClosedForm,
    weakness: "an identity",
    cost: Cost::Quick,
    run: identity,
};

fn balance() -> Result<Vec<Finding>, Broken> {
    let mut grains = cloud(600, 4);
    grains.iter_mut().for_each(|grain| grain.velocity += Vec3::new(3.0, 0.5, 0.0));
    let (before, _) = momenta(&grains);
    let mass: f64 = grains.iter().map(|grain| grain.body.mass).sum();
    let far = 0.5;
    let mut model = Model {
        gravity: Vec3::new(6.0, 0.0, -7.5),
        wall: WallShape { segment_tops: vec![0.5], widths: Vec::new() },
        ..free_model(grains, GrainShape::Clump)
    };
    model.surfaces = vec![
        floor(0.4),
        plane(SurfaceRole::Side, Vec3::zeros(), Vec3::y(), 0.3),
        plane(SurfaceRole::Side, Vec3::y() * 0.3, -Vec3::y(), 0.3),
        plane(SurfaceRole::Wall, Vec3::x() * far, -Vec3::x(), 0.3),
    ];
    let gravity = model.gravity;
    let mut simulation = simulate(model, 2e-5, 0.02);
    let (mut base, mut sides, mut wall) = (Vec3::zeros(), Vec3::zeros(), Vec3::zeros());
    for _ in 0..20_000 {
        simulation.step()?;
        let forces = &simulation.sums.surfaces;
        base += forces.base * simulation.time_step;
        sides += forces.sides * simulation.time_step;
        wall += forces.wall * simulation.time_step;
    }
    let (after, _) = momenta(&simulation.snapshot());
    let given = gravity * (mass * simulation.time) - base - sides - wall;
    let error = given - (after - before);
    let scale = wall.norm();
    let names = ["along", "across", "normal"];
    let mut findings: Vec<Finding> = (0..3)
        .map(|axis| Finding::close(format!("impulse left over, {}", names[axis]), error[axis] / scale, 0.0, 1e-9))
        .collect();
    findings.push(Finding::between("impulse on the wall over the momentum at the start", wall.x / before.x, 0.5, 10.0));
    Ok(findings)
}

fn beam() -> Result<Vec<Finding>, Broken> {
    let (radius, speed, restitution, count) = (0.01, 2.0, 0.3, 200);
    let grains: Vec<_> = (0..count)
        .map(|index| {
            let row = [f64::from(index / 10) * 0.03, f64::from(index % 10) * 0.03];
            let mut grain = ball(index as u32, Vec3::new(-0.05 - row[0], row[1], 0.05), radius, 2600.0);
            grain.velocity.x = speed;
            grain
        })
        .collect();
    let mass = grains[0].body.mass;
    let step = contact_time(MODULUS * radius, mass) / 40.0;
    let mut model = Model { material: material(restitution, 0.3), ..free_model(grains, GrainShape::Sphere) };
    // Balls that come back would meet those behind: each row is taken to the wall on its own line, so they are let through.
    model.surfaces = vec![plane(SurfaceRole::Wall, Vec3::zeros(), -Vec3::x(), 0.3)];
    let mut impulse = 0.0;
    let mut weighed = 0.0;
    for row in 0..20 {
        let mut one = model.clone();
        one.grains.retain(|grain| grain.id / 10 == row);
        weighed += one.grains.len() as f64 * mass;
        let mut simulation = simulate(one, step, radius);
        while simulation.time < (0.05 + 0.03 * f64::from(row)) / speed + 0.01 {
            simulation.step()?;
            impulse += simulation.sums.surfaces.wall.x * simulation.time_step;
        }
    }
    Ok(vec![Finding::near("impulse (N s)", impulse, weighed * speed * (1.0 + restitution), 0.01)])
}

fn identity() -> Result<Vec<Finding>, Broken> {
    let mut worst = 0.0_f64;
    for (depth, velocity, slope) in [(0.5, 3.0, 10.0_f64), (1.0, 6.0, 20.0), (2.0, 9.0, 35.0)] {
        let input = GuidelineInput {
            density: 1900.0,
            gravity_normal: GRAVITY * libm::cos(slope.to_radians()),
            earth_pressure: 1.2,
            dynamic_pressure: 0.7,
            wood: 1.0,
            depth,
            velocity,
            fill_height: 4.0,
            barrier_height: 4.2,
        };
        for case in all(&input, &AdditionalActions::default()) {
            let (first, second) = split(&input, &case);
            worst = worst.max((first + second - case.force_per_width()).abs() / case.force_per_width());
        }
    }
    Ok(vec![Finding::close("largest difference over the force", worst, 0.0, 1e-12)])
}
