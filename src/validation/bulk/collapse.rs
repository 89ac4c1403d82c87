//! B1, B2 and B8: columns that collapse on a level floor.

use crate::scene::flow::packing::{PackingRoom, pack};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{GRAVITY, floor, free_model, material, plane, run_until, side_by_side};
use dem::Vec3;
use dem::contact::material::Material;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::{Grain, GrainBody, GrainShape};
use dem::tables::surfaces::SurfaceRole;

pub const COLUMN: Case = Case {
    id: "B1",
    suite: Suite::Bulk,
    title: "Run-out of a round column",
    source: "(R∞ − R0)/R0 = 1.24 a (a < 1.7), 1.6 √a above (Lube et al. 2004); 1.0 a (a < 0.74), 2.0 √a (Lajeunesse et al. \
             2004); another DEM 1.25 and 3.42 at a = 1 and 3",
    tier: Tier::SecondHand,
    weakness: "24 grains across; where the deposit ends is a matter of definition (here a fifth of the floor covered)",
    cost: Cost::Long,
    run: column,
};

pub const FLOORS: Case = Case {
    id: "B2",
    suite: Suite::Bulk,
    title: "Run-out of tall columns over floors of different friction",
    source: "1.6 √a (Lube et al. 2004), 2.0 √a (Lajeunesse et al. 2004) on rough floors; the more a floor rubs, the shorter",
    tier: Tier::SecondHand,
    weakness: "floors are plane, those of the experiments rough: grains roll on where they would lock, so that the laws are told, not judged",
    cost: Cost::Long,
    run: floors,
};

pub const DAM: Case = Case {
    id: "B8",
    suite: Suite::Bulk,
    title: "Dam break of a sand column",
    source: "Lethe documentation after Evangelista 2014: height 0.20 m at x = 0.4 m falls to about 0.025 m at 0.8 m",
    tier: Tier::Published,
    weakness: "10 mm clumps for 1.6 mm sand; final profile only",
    cost: Cost::Long,
    run: dam,
};

const DIAMETER: f64 = 0.01;
const DENSITY: f64 = 2600.0;
/// Soft enough for long steps, stiff enough that grains overlap by less than a hundredth.
const MODULUS: f64 = 2e7;
const STEP: f64 = 4e-5;
/// Tangents of the friction between grains, and on the floor.
const FRICTION: f64 = 0.5;

/// Share of the floor covered where a deposit ends.
const EDGE: f64 = 0.2;

/// Clumps packed into a box with a corner at the origin.
fn packed(size: Vec3, seed: u64) -> Result<Vec<Grain>, Broken> {
    let body = GrainBody::clump(DIAMETER, 1.5, DENSITY);
    let count = (0.60 * size.product() * DENSITY / body.mass) as usize;
    let room = PackingRoom::level(size, false);
    let (grains, _) =
        pack(&vec![body; count], GrainShape::Clump, room, seed).map_err(|error| Broken::Scene(error.to_string()))?;
    Ok(grains)
}

fn on_floor(grains: Vec<Grain>, friction: f64) -> Model {
    let mut model = Model {
        material: Material { modulus: MODULUS, ..material(0.3, FRICTION) },
        gravity: Vec3::z() * -GRAVITY,
        ..free_model(grains, GrainShape::Clump)
    };
    model.surfaces = vec![floor(friction)];
    model
}

fn column() -> Result<Vec<Finding>, Broken> {
    let aspects = [0.5, 1.0, 3.0];
    let runouts = side_by_side(aspects.len(), |index| runout(aspects[index], FRICTION));
    let mut findings = Vec::new();
    for (aspect, runout) in aspects.into_iter().zip(runouts) {
        let lube = if aspect < 1.7 { 1.24 * aspect } else { 1.6 * f64::sqrt(aspect) };
        let lajeunesse = if aspect < 0.74 { aspect } else { 2.0 * f64::sqrt(aspect) };
        let (low, high) = (0.85 * lube.min(lajeunesse), 1.15 * lube.max(lajeunesse));
        findings.push(Finding::between(format!("a = {aspect}: (R∞ − R0)/R0"), runout?, low, high));
    }
    Ok(findings)
}

fn floors() -> Result<Vec<Finding>, Broken> {
    const ASPECTS: [f64; 1] = [4.0];
    const FLOORS: [f64; 3] = [0.3, 0.5, 1.0];
    let runs = side_by_side(ASPECTS.len() * FLOORS.len(), |job| {
        runout(ASPECTS[job / FLOORS.len()], FLOORS[job % FLOORS.len()])
    });
    let runs = runs.into_iter().collect::<Result<Vec<f64>, _>>()?;
    let mut findings = Vec::new();
    for (aspect, runs) in ASPECTS.into_iter().zip(runs.chunks(FLOORS.len())) {
        for (friction, run) in FLOORS.into_iter().zip(runs) {
            let [lube, lajeunesse] = [1.6, 2.0].map(|factor| run / (factor * aspect.sqrt()));
            findings.push(Finding::told(format!("a = {aspect}, floor {friction}: (R∞ − R0)/R0"), *run));
            findings.push(Finding::told("over 1.6 √a", lube));
            findings.push(Finding::told("over 2.0 √a", lajeunesse));
        }
        for (pair, between) in runs.windows(2).zip(FLOORS.windows(2)) {
            let what = format!("a = {aspect}: run-out on a floor of {} over that of {}", between[1], between[0]);
            findings.push(Finding::between(what, pair[1] / pair[0], 0.5, 1.0));
        }
    }
    Ok(findings)
}

/// (R∞ − R0)/R0 of a column of height a R0 on a floor with a coefficient of friction.
fn runout(aspect: f64, friction: f64) -> Result<f64, Broken> {
    let radius = 12.0 * DIAMETER;
    let height = aspect * radius;
    let middle = Vec3::new(radius, radius, 0.0);
    let flat = |grain: &Grain| (grain.position - middle).xy().norm();
    let mut grains = packed(Vec3::new(2.0 * radius, 2.0 * radius, height), 3)?;
    grains.retain(|grain| flat(grain) < radius - 0.5 * DIAMETER);
    let mut simulation = Simulation::new(on_floor(grains, friction), STEP, 0.3 * DIAMETER, 1e3);
    run_until(&mut simulation, 6.0 * (height / GRAVITY).sqrt().max(0.08))?;
    let grains = simulation.snapshot();
    // Share of the floor covered by grains, over rings of one diameter, outwards from the middle.
    let covered = |inner: f64| {
        let outer = inner + DIAMETER;
        let count = grains.iter().filter(|grain| (inner..outer).contains(&flat(grain))).count();
        count as f64 * 0.25 * DIAMETER * DIAMETER / (outer * outer - inner * inner)
    };
    let mut end = radius;
    while covered(end) > EDGE {
        end += DIAMETER;
    }
    // Between the middles of the last two rings, by proportion.
    let (last, beyond) = (covered(end - DIAMETER), covered(end));
    end += DIAMETER * ((last - EDGE) / (last - beyond) - 0.5);
    Ok((end - radius) / radius)
}

fn dam() -> Result<Vec<Finding>, Broken> {
    let (length, height, width) = (0.60, 0.20, 0.08);
    let grains = packed(Vec3::new(length, width, height), 8)?;
    let mut model = on_floor(grains, FRICTION);
    model.surfaces.extend([
        plane(SurfaceRole::Side, Vec3::zeros(), Vec3::x(), 0.3),
        plane(SurfaceRole::Side, Vec3::zeros(), Vec3::y(), 0.0),
        plane(SurfaceRole::Side, Vec3::y() * width, -Vec3::y(), 0.0),
    ]);
    let mut simulation = Simulation::new(model, STEP, 0.3 * DIAMETER, 1e3);
    run_until(&mut simulation, 1.2)?;
    let grains = simulation.snapshot();
    let surface = |x: f64| {
        let near = grains.iter().filter(|grain| (grain.position.x - x).abs() < DIAMETER);
        let mut heights: Vec<f64> = near.map(|grain| grain.position.z + 0.5 * DIAMETER).collect();
        heights.sort_by(f64::total_cmp);
        heights.get(heights.len().saturating_sub(heights.len() / 20 + 1)).copied().unwrap_or(0.0)
    };
    Ok(vec![
        Finding::close("height at x = 0.4 m (m)", surface(0.4), 0.20, 0.02),
        Finding::close("height at x = 0.8 m (m)", surface(0.8), 0.025, 0.02),
        Finding::told("height at x = 0.6 m (m)", surface(0.6)),
    ])
}
