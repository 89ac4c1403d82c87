//! B4: a tall column between rubbing walls (Janssen).

use crate::scene::flow::packing::{PackingRoom, pack};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, floor, free_model, material, plane, run_until, side_by_side};
use dem::Vec3;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::{GrainBody, GrainShape};
use dem::tables::surfaces::SurfaceRole;

pub const CASE: Case = Case {
    id: "B4",
    suite: Suite::Bulk,
    title: "A tall column between rubbing walls: the walls take what the floor does not",
    source: "Janssen: σ(h) = ρ g λ (1 − e^(−h/λ)), λ = D/(4 μ_w K)",
    tier: Tier::ClosedForm,
    weakness: "K is fitted; friction is mobilised by letting the floor down a little; mean of four packings",
    cost: Cost::Long,
    run,
};

const RADIUS: f64 = 0.005;
const SIDE: f64 = 0.10;
const FRICTION: f64 = 0.5;
const WALL_FRICTION: f64 = 0.4;
/// Three of Janssen's lengths deep: further down the stress stays as it is, and R² would see nothing but its scatter.
const COUNT: usize = 5600;
/// The law is one of the mean: a single packing of ten grains across strays from it by a tenth.
const PACKINGS: usize = 4;
/// Depths at which the stress is taken.
const LEVELS: usize = 24;
/// Room made after packing.
const SPREAD: f64 = 1.012;
/// How far the floor goes down, and how fast (m, m/s).
const LOWERING: f64 = 0.003;
const LOWERING_SPEED: f64 = 0.01;

fn run() -> Result<Vec<Finding>, Broken> {
    let columns: Vec<Column> =
        side_by_side(PACKINGS, |seed| column(seed as u64)).into_iter().collect::<Result<_, Broken>>()?;
    let mean = |of: &dyn Fn(&Column) -> f64| columns.iter().map(of).sum::<f64>() / columns.len() as f64;
    let profile: Vec<(f64, f64)> = (0..LEVELS - 1)
        .map(|level| (mean(&|column| column.profile[level].0), mean(&|column| column.profile[level].1)))
        .collect();
    let (earth_pressure, quality) = fit(&profile);
    let worst = columns.iter().map(|column| (column.carried - 1.0).abs()).fold(0.0, f64::max);
    let mut findings = vec![
        Finding::close("floor and walls together over weight: worst deviation", worst, 0.0, 1e-3),
        Finding::told("floor's share as filled", mean(&|column| column.as_filled)),
        Finding::between("floor's share after lowering", mean(&|column| column.floor_share), 0.05, 0.8),
        Finding::told("K of the best fit (0.4 to 1.2 are not checked against the original)", earth_pressure),
        Finding::between("R² of the fit to the mean of all packings", quality, 0.98, 1.0),
    ];
    for (number, column) in columns.iter().enumerate() {
        findings.push(Finding::told(format!("R² of packing {} alone", number + 1), fit(&column.profile).1));
    }
    Ok(findings)
}

/// What one packing shows.
struct Column {
    /// Load on floor and walls over weight.
    carried: f64,
    /// The floor's share of it before and after it was lowered.
    as_filled: f64,
    floor_share: f64,
    /// Depth below the top (m) and mean vertical stress there (Pa).
    profile: Vec<(f64, f64)>,
}

fn column(seed: u64) -> Result<Column, Broken> {
    let mut simulation = filled(seed)?;
    let weight: f64 = simulation.snapshot().iter().map(|grain| grain.body.mass).sum::<f64>() * GRAVITY;
    let as_filled = -simulation.sums.surfaces.base.z / weight;
    lower_floor(&mut simulation)?;
    let forces = &simulation.sums.surfaces;
    Ok(Column {
        carried: -(forces.base.z + forces.sides.z) / weight,
        as_filled,
        floor_share: -forces.base.z / weight,
        profile: profile(&simulation),
    })
}

fn filled(seed: u64) -> Result<Simulation, Broken> {
    let bodies = vec![GrainBody::sphere(RADIUS, 2600.0); COUNT];
    let height = COUNT as f64 * std::f64::consts::PI / 6.0 * (2.0 * RADIUS).powi(3) / (0.57 * SIDE * SIDE);
    let room = PackingRoom::level(Vec3::new(SIDE, SIDE, height), false);
    let (mut grains, growth) =
        pack(&bodies, GrainShape::Sphere, room, seed).map_err(|error| Broken::Scene(error.to_string()))?;
    let length = growth * room.size.x;
    // What overlap the packing has left would lock stresses in between the walls: everything is spread out a little.
    grains.iter_mut().for_each(|grain| grain.position *= SPREAD);
    let (length, side_length) = (length * SPREAD, SIDE * SPREAD);
    let mut model = Model {
        material: material(0.3, FRICTION),
        gravity: Vec3::z() * -GRAVITY,
        ..free_model(grains, GrainShape::Sphere)
    };
    let side = |origin: Vec3, normal: Vec3| plane(SurfaceRole::Side, origin, normal, WALL_FRICTION);
    model.surfaces = vec![
        floor(FRICTION),
        side(Vec3::zeros(), Vec3::x()),
        side(Vec3::x() * length, -Vec3::x()),
        side(Vec3::zeros(), Vec3::y()),
        side(Vec3::y() * side_length, -Vec3::y()),
    ];
    let mut simulation = Simulation::new(model, 1e-5, 0.5 * RADIUS, 1e3);
    // Slowly, so that the column does not come down as one piece.
    simulation.drag = 20.0;
    run_until(&mut simulation, 0.8)?;
    Ok(simulation)
}

fn lower_floor(simulation: &mut Simulation) -> Result<(), Broken> {
    // Pair lists may not outlive a motion of the floor they do not know of.
    let steps_per_list = 50;
    let steps = (LOWERING / LOWERING_SPEED / simulation.time_step) as usize;
    for step in 0..steps {
        simulation.model.surfaces[0].origin.z -= LOWERING_SPEED * simulation.time_step;
        if step % steps_per_list == 0 {
            simulation.neighbours.lose();
        }
        simulation.step()?;
    }
    simulation.drag = 20.0;
    let end = simulation.time + 0.4;
    run_until(simulation, end)?;
    Ok(())
}

/// Depth below the top (m) and mean vertical stress there (Pa), from the weight above less what the walls hold.
fn profile(simulation: &Simulation) -> Vec<(f64, f64)> {
    let grains = simulation.snapshot();
    let top = grains.iter().map(|grain| grain.position.z).fold(0.0, f64::max);
    let low = simulation.model.surfaces[0].origin.z;
    let walls: Vec<(f64, f64)> = simulation
        .surface_contacts()
        .filter(|contact| contact.role == SurfaceRole::Side)
        .map(|contact| (contact.place.z, contact.force.z))
        .collect();
    let section = (SIDE * SPREAD).powi(2);
    (1..LEVELS)
        .map(|level| {
            let z = top - (top - low) * level as f64 / LEVELS as f64;
            let weight: f64 = grains.iter().filter(|grain| grain.position.z > z).map(|grain| grain.body.mass).sum();
            let held: f64 = walls.iter().filter(|(place, _)| *place > z).map(|(_, force)| force).sum();
            (top - z, (weight * GRAVITY - held) / section)
        })
        .collect()
}

/// K of the best Janssen curve, and its R².
fn fit(profile: &[(f64, f64)]) -> (f64, f64) {
    let mean = profile.iter().map(|(_, stress)| stress).sum::<f64>() / profile.len() as f64;
    let all: f64 = profile.iter().map(|(_, stress)| (stress - mean).powi(2)).sum();
    let left = |length: f64| {
        // For a given length the best weight ρ g follows by least squares.
        let shape = |depth: f64| length * (1.0 - libm::exp(-depth / length));
        let (up, down) = profile.iter().fold((0.0, 0.0), |(up, down), (depth, stress)| {
            (up + shape(*depth) * stress, down + shape(*depth).powi(2))
        });
        profile.iter().map(|(depth, stress)| (stress - up / down * shape(*depth)).powi(2)).sum::<f64>()
    };
    let lengths = (1..2000).map(|index| SIDE * 0.005 * f64::from(index));
    let best = lengths.min_by(|a, b| left(*a).total_cmp(&left(*b))).unwrap_or(SIDE);
    (SIDE / (4.0 * WALL_FRICTION * best), 1.0 - left(best) / all)
}
