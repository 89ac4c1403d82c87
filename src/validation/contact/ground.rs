//! E1 to E4: the ground as one body of facets, against planes and against the balance of forces.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, ball, floor, free_model, material, run, run_until, simulate};
use dem::Vec3;
use dem::contact::material::Material;
use dem::ledger::Ledger;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::{Grain, GrainBody, GrainShape};
use dem::tables::surfaces::{Surface, SurfaceRole};
use dem::tables::terrain::{Patch, Terrain, strips};

pub const PLANE: Case = Case {
    id: "E1",
    suite: Suite::Contact,
    title: "Balls and clumps on a height field that is a plane move as on a plane",
    source: "the same scene on an unbounded plane",
    tier: Tier::ClosedForm,
    weakness: "a plane has flat seams alone",
    cost: Cost::Quick,
    run: plane,
};

pub const SEAMS: Case = Case {
    id: "E2",
    suite: Suite::Contact,
    title: "Over convex and concave seams energy is kept at any speed",
    source: "conservation of energy, without friction and damping",
    tier: Tier::ClosedForm,
    weakness: "one ball at a time, without friction",
    cost: Cost::Quick,
    run: seams,
};

pub const GROOVE: Case = Case {
    id: "E3",
    suite: Suite::Contact,
    title: "A ball at rest in a groove presses on both of its sides",
    source: "N = W/(2 sin b), b the half-angle of the groove",
    tier: Tier::ClosedForm,
    weakness: "without friction, which would leave the sharing to the history",
    cost: Cost::Quick,
    run: groove,
};

pub const FILLED: Case = Case {
    id: "E4",
    suite: Suite::Contact,
    title: "A funnel and a trapezoidal channel bear the weight of what fills them",
    source: "balance of forces",
    tier: Tier::ClosedForm,
    weakness: "some hundred grains",
    cost: Cost::Quick,
    run: filled,
};

const RADIUS: f64 = 0.01;
/// Contact modulus of the grains that fill channels (Pa).
const SOFT: f64 = 1e6;

/// A height field of triangles over a jittered grid on the plane z = 0.
fn flat_field(friction: f64) -> Terrain {
    let (along, across, cell) = (120, 30, 0.9 * RADIUS);
    let mut random = fastrand::Rng::with_seed(3);
    let corner = |index: usize| {
        let mut jitter = || 0.3 * (random.f64() - 0.5);
        let (x, y) = ((index % (along + 1)) as f64 + jitter(), (index / (along + 1)) as f64 + jitter());
        Vec3::new(cell * x - 0.05, cell * (y - 0.5 * across as f64), 0.0)
    };
    let corners: Vec<Vec3> = (0..(along + 1) * (across + 1)).map(corner).collect();
    let mut patches = Vec::new();
    for y in 0..across {
        for x in 0..along {
            let low = (y * (along + 1) + x) as u32;
            let high = low + along as u32 + 1;
            for corners in [[low, low + 1, high + 1], [low, high + 1, high]] {
                patches.push(Patch { corners: corners.to_vec(), role: SurfaceRole::Base, friction });
            }
        }
    }
    Terrain::new(corners, &patches)
}

fn on(ground: Result<Terrain, Surface>, grain: Grain, slope: f64, friction: f64) -> Simulation {
    let shape = if grain.body.offset > 0.0 { GrainShape::Clump } else { GrainShape::Sphere };
    let mut model = Model {
        material: material(0.3, friction),
        gravity: Vec3::new(libm::sin(slope), 0.0, -libm::cos(slope)) * GRAVITY,
        ..free_model(vec![grain], shape)
    };
    match ground {
        Ok(terrain) => model.terrain = Some(terrain),
        Err(surface) => model.surfaces = vec![surface],
    }
    simulate(model, 5e-6, RADIUS)
}

fn plane() -> Result<Vec<Finding>, Broken> {
    let friction = 0.4;
    let mut findings = Vec::new();
    let clump = |direction: Vec3| Grain::at(0, Vec3::z() * 0.02, direction, GrainBody::clump(0.02, 1.5, 2600.0));
    let rolling = ball(0, Vec3::z() * RADIUS, RADIUS, 2600.0);
    let bouncing = ball(0, Vec3::z() * 0.03, RADIUS, 2600.0);
    for (what, grain, velocity) in [
        ("a ball that slips, then rolls", rolling, Vec3::new(1.2, 0.1, 0.0)),
        ("a ball that bounces", bouncing, Vec3::new(1.0, -0.1, -1.0)),
        ("a clump that tumbles", clump(Vec3::new(1.0, 0.4, 0.2).normalize()), Vec3::new(0.8, 0.1, 0.0)),
        ("a clump that slides", clump(Vec3::x()), Vec3::new(0.3, 0.0, 0.0)),
    ] {
        let mut grain = grain;
        grain.velocity = velocity;
        let mut simulations =
            [Err(floor(friction)), Ok(flat_field(friction))].map(|ground| on(ground, grain.clone(), 0.5, friction));
        for simulation in &mut simulations {
            run_until(simulation, 0.35)?;
        }
        let [flat, field] = simulations.map(|simulation| simulation.grains.grain(0));
        let way = (flat.position - grain.position).norm();
        let off = (field.position - flat.position).norm() / way;
        findings.push(Finding::close(format!("{what}: way apart over way"), off, 0.0, 1e-6));
        let turned = (field.spin() - flat.spin()).norm() / flat.spin().norm();
        findings.push(Finding::close(format!("{what}: spin apart over spin"), turned, 0.0, 1e-6));
    }
    Ok(findings)
}

fn seams() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for (what, rises) in [("a hollow", [-0.3, 0.2]), ("a ridge", [0.2, -0.3]), ("a step in slope of 1 %", [0.0, 0.01])]
    {
        let mut worst = 0.0_f64;
        for speed in [0.1, 1.0, 10.0, 30.0] {
            let points = [[-2.0, -2.0 * rises[0]], [0.0, 0.0], [2.0, 2.0 * rises[1]]];
            let terrain = strips(&points, [-1.0, 1.0], &[(SurfaceRole::Base, 0.0); 2]);
            let along = Vec3::new(0.0, 1.0, rises[0]).normalize();
            let normal = Vec3::new(0.0, -rises[0], 1.0).normalize();
            let mut grain = ball(0, normal * (RADIUS * 0.9999) - along * (1.5 * RADIUS), RADIUS, 2600.0);
            grain.velocity = along * speed;
            let mut model = Model {
                material: material(1.0, 0.0),
                gravity: -Vec3::z() * GRAVITY,
                ..free_model(vec![grain], GrainShape::Sphere)
            };
            model.terrain = Some(terrain);
            let weight = model.grains[0].body.mass * GRAVITY;
            let mut simulation = simulate(model, (5e-7_f64).min(2e-6 / speed), RADIUS);
            simulation.step_and_account()?;
            let start = simulation.ledger;
            let steps = (6.0 * RADIUS / speed.max(0.3) / simulation.time_step) as usize;
            run(&mut simulation, steps)?;
            simulation.step_and_account()?;
            let of = |ledger: &Ledger| ledger.kinetic + ledger.potential + ledger.stored_contacts;
            // Beside its motion what falling over a few radii gives.
            let scale = start.kinetic + 3.0 * weight * RADIUS;
            worst = worst.max((of(&simulation.ledger) - of(&start)).abs() / scale);
        }
        findings.push(Finding::close(format!("{what}: energy apart over energy, 0.1 to 30 m/s"), worst, 0.0, 1e-4));
    }
    Ok(findings)
}

fn groove() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for degrees in [15.0, 30.0, 45.0, 60.0, 80.0_f64] {
        let (sine, cosine) = libm::sincos(degrees.to_radians());
        let points = [[-sine, cosine], [0.0, 0.0], [sine, cosine]];
        let grain = ball(0, Vec3::new(0.0, 0.0, RADIUS / sine), RADIUS, 2600.0);
        let weight = grain.body.mass * GRAVITY;
        let mut model = Model {
            material: material(0.1, 0.0),
            gravity: -Vec3::z() * GRAVITY,
            ..free_model(vec![grain], GrainShape::Sphere)
        };
        model.terrain = Some(strips(&points, [-1.0, 1.0], &[(SurfaceRole::Side, 0.0); 2]));
        let mut simulation = simulate(model, 5e-6, RADIUS);
        simulation.drag = 200.0;
        run_until(&mut simulation, 0.6)?;
        let forces: Vec<f64> = simulation.surface_contacts().map(|contact| contact.force.norm()).collect();
        let wanted = weight / (2.0 * sine);
        findings.push(Finding::close(format!("{degrees}°: sides pressed"), forces.len() as f64, 2.0, 0.0));
        for force in forces {
            findings.push(Finding::near(format!("{degrees}°: force of a side (N)"), force, wanted, 1e-6));
        }
    }
    Ok(findings)
}

fn filled() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    // A funnel of four sides, and a channel with a bed of 0.1 m and banks of 1 : 1 between two ends.
    let corners = vec![
        Vec3::zeros(),
        Vec3::new(0.3, 0.3, 0.25),
        Vec3::new(-0.3, 0.3, 0.25),
        Vec3::new(-0.3, -0.3, 0.25),
        Vec3::new(0.3, -0.3, 0.25),
    ];
    let side = |a: u32, b: u32| Patch { corners: vec![0, a, b], role: SurfaceRole::Side, friction: 0.4 };
    let funnel = Terrain::new(corners, &[side(1, 2), side(2, 3), side(3, 4), side(4, 1)]);
    let points = [[-0.35, 0.3], [-0.05, 0.0], [0.05, 0.0], [0.35, 0.3]];
    let kinds = [(SurfaceRole::Side, 0.4), (SurfaceRole::Base, 0.4), (SurfaceRole::Side, 0.4)];
    let channel = strips(&points, [-1.0, 1.0], &kinds);
    let ends = [(-1.0, Vec3::x()), (1.0, -Vec3::x())]
        .map(|(at, normal)| Surface::plane(SurfaceRole::Gate, Vec3::x() * (0.12 * at), normal, 0.0));
    for (what, terrain, surfaces) in [("funnel", funnel, Vec::new()), ("trapezoid", channel, ends.to_vec())] {
        let mut random = fastrand::Rng::with_seed(11);
        let grain = |index: u32| {
            let (layer, place) = (index / 16, index % 16);
            let jitter = 0.004 * random.f64();
            let position = Vec3::new(
                0.045 * f64::from(place % 4) - 0.068 + jitter,
                0.045 * f64::from(place / 4) - 0.068 - jitter,
                0.14 + 0.045 * f64::from(layer),
            );
            let axis = Vec3::new(random.f64() - 0.5, random.f64() - 0.5, random.f64() - 0.5).normalize();
            Grain::at(index, position, axis, GrainBody::clump(0.024 + 0.008 * random.f64(), 1.5, 2600.0))
        };
        let grains: Vec<Grain> = (0..160).map(grain).collect();
        let weight = grains.iter().map(|grain| grain.body.mass).sum::<f64>() * GRAVITY;
        let mut model = Model {
            material: Material { modulus: SOFT, ..material(0.2, 0.4) },
            gravity: -Vec3::z() * GRAVITY,
            ..free_model(grains, GrainShape::Clump)
        };
        (model.terrain, model.surfaces) = (Some(terrain), surfaces);
        let step = 0.1 * (4e-3 / (SOFT * RADIUS)).sqrt();
        let mut simulation = Simulation::new(model, step, 0.2 * RADIUS, 1e6);
        simulation.drag = 2.0;
        run_until(&mut simulation, 1.5)?;
        simulation.drag = 100.0;
        run_until(&mut simulation, 2.5)?;
        let up: f64 = simulation.surface_contacts().map(|contact| contact.force.z).sum();
        findings.push(Finding::near(format!("{what}: what it bears over the weight"), up / weight, 1.0, 1e-6));
        let low = simulation.snapshot().iter().map(|grain| grain.position.z).fold(f64::INFINITY, f64::min);
        findings.push(Finding::between(format!("{what}: lowest grain (m)"), low, 0.0, 0.1));
    }
    Ok(findings)
}
