//! B11 to B13: grains with a fluid in their pores, as one mixture.

use crate::scene::flow::packing::{PackingRoom, pack};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, ball, floor, free_model, material, plane, run_until, side_by_side, simulate};
use dem::Vec3;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::{GrainBody, GrainShape};
use dem::tables::pores::Pores;
use dem::tables::surfaces::SurfaceRole;

pub const SLIDES: Case = Case {
    id: "B11",
    suite: Suite::Bulk,
    title: "A block with pore pressure under it slides as (1 − r_u) tan φ lets it",
    source: "a = g (sin α − (1 − r_u) tan φ cos α)",
    tier: Tier::ClosedForm,
    weakness: "one body that cannot turn",
    cost: Cost::Quick,
    run: slides,
};

pub const DRAINS: Case = Case {
    id: "B12",
    suite: Suite::Bulk,
    title: "A bed that has drained stands on a slope on which it would have flowed",
    source: "r_u(t) = r_u exp(−t/τ) at rest; a bed of friction tan φ stands below φ",
    tier: Tier::ClosedForm,
    weakness: "the pressure drains where a grain rests, whatever lies above it: no path of drainage",
    cost: Cost::Quick,
    run: drains,
};

pub const PRESSES: Case = Case {
    id: "B13",
    suite: Suite::Bulk,
    title: "A mixture that floats presses on a wall nearly as a fluid does",
    source: "½ ρ g H² per width of a fluid, as Σ m g z over the length of the bed; beads without friction keep an angle of internal friction of 5.76° (Peyneau & Roux 2008), so that K is between 0.82 and 1.22 by how they came to rest, here on the mean of six packings",
    tier: Tier::ClosedForm,
    weakness: "the bound is wide: the fluid's pressure is carried by the contacts of the grains, not by a fluid of its own",
    cost: Cost::Quick,
    run: presses,
};

fn pores(ratio: f64, drains_in: f64) -> Pores {
    Pores { ratio, drains_in, drains_to: 0.0, rests_below: 0.05 }
}

fn slides() -> Result<Vec<Finding>, Broken> {
    let (radius, friction, slope) = (0.05, libm::tan(35_f64.to_radians()), 30_f64.to_radians());
    let mut findings = Vec::new();
    for ratio in [0.3, 0.5, 0.9] {
        let mut block = ball(0, Vec3::z() * radius, radius, 2000.0);
        (block.body.inertia_axial, block.body.inertia_transverse) = (1e30, 1e30);
        // Pressed in as deep as its weight presses it.
        let weight = block.body.mass * GRAVITY * libm::cos(slope);
        block.position.z -= weight / (crate::validation::scenes::MODULUS * radius);
        // Already faster than what rests.
        block.velocity.x = 1.0;
        let mut model = Model {
            material: material(0.3, friction),
            gravity: Vec3::new(libm::sin(slope), 0.0, -libm::cos(slope)) * GRAVITY,
            pores: Some(pores(ratio, 1.0)),
            ..free_model(vec![block], GrainShape::Sphere)
        };
        model.surfaces = vec![floor(friction)];
        let mut simulation = simulate(model, 1e-5, radius);
        run_until(&mut simulation, 0.5)?;
        let (speed, time) = (simulation.grains.grain(0).velocity.x - 1.0, simulation.time);
        let wanted = GRAVITY * (libm::sin(slope) - (1.0 - ratio) * friction * libm::cos(slope));
        findings.push(Finding::near(format!("acceleration with r_u = {ratio} (m/s²)"), speed / time, wanted, 1e-4));
    }
    Ok(findings)
}

const RADIUS: f64 = 0.01;
const DENSITY: f64 = 3600.0;
/// Length, width and number of spheres of a bed, some four of them deep.
const LENGTH: f64 = 0.6;
const WIDTH: f64 = 0.06;
const COUNT: usize = 350;

/// A bed of spheres that has come to rest in a box whose downstream end is the wall.
fn bed(shape: GrainShape, friction: f64, pores: Pores, seconds: f64, packing: u64) -> Result<Simulation, Broken> {
    let aspect = if shape == GrainShape::Clump { 1.5 } else { 1.0 };
    // Of several sizes: equal ones lie in rows, which carry themselves.
    let sizes = (0..COUNT).map(|number| 2.0 * RADIUS * (0.7 + 0.1 * (number % 7) as f64));
    let bodies: Vec<GrainBody> = sizes.map(|size| GrainBody::clump(size, aspect, DENSITY)).collect();
    let solid = bodies.iter().map(|body| body.mass / DENSITY).sum::<f64>();
    let room = PackingRoom::level(Vec3::new(LENGTH, WIDTH, solid / (0.45 * LENGTH * WIDTH)), false);
    let (grains, growth) = pack(&bodies, shape, room, packing).map_err(|error| Broken::Scene(error.to_string()))?;
    let length = growth * room.size.x;
    let mut model = Model {
        material: material(0.3, friction),
        gravity: Vec3::z() * -GRAVITY,
        pores: Some(pores),
        ..free_model(grains, shape)
    };
    let side = |role, origin: Vec3, normal: Vec3| plane(role, origin, normal, 0.0);
    model.surfaces = vec![
        floor(friction),
        side(SurfaceRole::Side, Vec3::zeros(), Vec3::x()),
        side(SurfaceRole::Wall, Vec3::x() * length, -Vec3::x()),
        side(SurfaceRole::Side, Vec3::zeros(), Vec3::y()),
        side(SurfaceRole::Side, Vec3::y() * WIDTH, -Vec3::y()),
    ];
    let mut simulation = Simulation::new(model, 2e-5, 0.5 * RADIUS, 1e3);
    simulation.drag = 10.0;
    run_until(&mut simulation, seconds)?;
    // The last trembling fades.
    simulation.drag = 60.0;
    run_until(&mut simulation, seconds + 0.3)?;
    Ok(simulation)
}

fn drains() -> Result<Vec<Finding>, Broken> {
    let friction = libm::tan(30_f64.to_radians());
    // Clumps: what is round would roll on the floor. How fast it goes once it is tilted to 15° and its end is taken away: with all its pressure, or drained before.
    let speed = |drains_in: f64| -> Result<[f64; 2], Broken> {
        let mut simulation = bed(GrainShape::Clump, friction, pores(0.95, drains_in), 0.6, 3)?;
        let slope = 15_f64.to_radians();
        simulation.drag = 0.0;
        simulation.model.gravity = Vec3::new(libm::sin(slope), 0.0, -libm::cos(slope)) * GRAVITY;
        simulation.remove_surfaces(SurfaceRole::Wall);
        let grip = simulation.grains.grip.iter().sum::<f64>() / simulation.grains.len() as f64;
        let end = simulation.time + 0.6;
        run_until(&mut simulation, end)?;
        // Of the upstream half, which a slump of the free end does not reach.
        let mut places: Vec<[f64; 2]> =
            simulation.snapshot().iter().map(|grain| [grain.position.x, grain.velocity.x]).collect();
        places.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let upstream = &places[..places.len() / 4];
        Ok([grip, upstream.iter().map(|place| place[1]).sum::<f64>() / upstream.len() as f64])
    };
    let ([wet_grip, wet], [drained_grip, drained]) = (speed(1e4)?, speed(0.02)?);
    Ok(vec![
        Finding::close("share of the friction that acts, undrained", wet_grip, 0.05, 1e-3),
        Finding::close("share of the friction that acts, drained", drained_grip, 1.0, 1e-3),
        Finding::between("speed of the undrained bed after 0.6 s (m/s)", wet, 0.3, 1.5),
        Finding::close("speed of the drained bed (m/s)", drained, 0.0, 0.01),
    ])
}

fn presses() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for shape in [GrainShape::Sphere, GrainShape::Clump] {
        let packings = side_by_side(PACKINGS, |packing| -> Result<[f64; 2], Broken> {
            let simulation = bed(shape, 0.5, pores(1.0, 1e9), 0.8, packing as u64)?;
            let length = simulation.model.surfaces.iter().map(|surface| surface.origin.x).fold(0.0, f64::max);
            let weight = simulation.snapshot().iter().map(|grain| grain.body.mass).sum::<f64>() * GRAVITY;
            let on_wall = simulation.sums.surfaces.wall.x * length / of_a_fluid(&simulation);
            Ok([-simulation.sums.surfaces.base.z / weight, on_wall])
        });
        let packings = packings.into_iter().collect::<Result<Vec<_>, _>>()?;
        let mean = |of: usize| packings.iter().map(|packing| packing[of]).sum::<f64>() / PACKINGS as f64;
        let of = if shape == GrainShape::Sphere { "spheres" } else { "clumps" };
        findings.push(Finding::near(format!("force of {of} on the floor over their weight"), mean(0), 1.0, 5e-3));
        findings.push(Finding::between(
            format!("force of {of} on the wall over that of a fluid"),
            mean(1),
            ACTIVE,
            1.0 / ACTIVE,
        ));
    }
    Ok(findings)
}

/// tan²(45° − φ/2) with the 5.76° of beads without friction.
const ACTIVE: f64 = 0.8176;
/// Packings that are made: the force on the wall scatters by 0.065 from one to the next.
const PACKINGS: usize = 6;

/// ½ ρ g H² of a bed, times its length, whatever its density at each height: Σ m g z (N m).
fn of_a_fluid(simulation: &Simulation) -> f64 {
    simulation.snapshot().iter().map(|grain| grain.body.mass * GRAVITY * grain.position.z).sum()
}
