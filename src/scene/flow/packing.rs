//! Packs grains into a box at a wanted density, without overlaps.
//!
//! Grains start on a jittered grid in random order and direction and push each other apart without friction
//! or gravity, heavily damped. Below the density where frictionless grains jam (about 0.64 for spheres, 0.7
//! for clumps) this ends without overlaps.

use crate::dem::Vec3;
use crate::dem::simulation::{Material, Model, Simulation, Unstable};
use crate::dem::tables::grains::{Grain, GrainBody, GrainShape};
use crate::dem::tables::surfaces::{Span, Surface, SurfaceRole};

/// Largest overlap left, over the smaller radius.
pub const OVERLAP_ALLOWED: f64 = 0.01;
/// Steps after which packing gives up.
const MOST_STEPS: usize = 4000;

/// A box from the origin to `size` (m), in the channel frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackingBox {
    pub size: Vec3,
}

/// Why a packing failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PackingError {
    #[error("the grains do not fit: after {steps} steps the largest overlap is still {overlap:.3} of a radius")]
    DoesNotFit { steps: usize, overlap: f64 },
    #[error(transparent)]
    Unstable(#[from] Unstable),
}

/// Packs `bodies` into `room`; grain numbers follow the order of `bodies`.
pub fn pack(bodies: &[GrainBody], shape: GrainShape, room: PackingBox, seed: u64) -> Result<Vec<Grain>, PackingError> {
    let model = Model {
        shape,
        grains: scatter(bodies, room, seed),
        surfaces: walls(room),
        barrier: None,
        material: Material { modulus: 1.0, restitution: 0.1, tangential_ratio: 2.0 / 7.0, friction: 0.0 },
        gravity: Vec3::zeros(),
        wall_levels: Vec::new(),
        outlet: f64::INFINITY,
    };
    let (step, skin) = relaxation_scales(bodies);
    let mut simulation = Simulation::new(model, step, skin, f64::INFINITY);
    simulation.drag = 0.4 / step;
    for _ in 0..MOST_STEPS {
        simulation.step()?;
        if simulation.sums.contacts.overlap_ratio < 0.8 * OVERLAP_ALLOWED {
            return Ok(at_rest(simulation.model.grains));
        }
    }
    Err(PackingError::DoesNotFit { steps: MOST_STEPS, overlap: simulation.sums.contacts.overlap_ratio })
}

/// Step and skin for pushing apart: many grains may overlap at once, so the step is a fifth of a pair's.
fn relaxation_scales(bodies: &[GrainBody]) -> (f64, f64) {
    let lightest = bodies.iter().map(|body| body.mass / body.radius).fold(f64::INFINITY, f64::min);
    let radius = bodies.iter().map(|body| body.radius).sum::<f64>() / bodies.len().max(1) as f64;
    (0.3 * lightest.sqrt(), 0.4 * radius)
}

fn at_rest(mut grains: Vec<Grain>) -> Vec<Grain> {
    for grain in &mut grains {
        grain.velocity = Vec3::zeros();
        grain.angular_momentum = Vec3::zeros();
    }
    grains.sort_by_key(|grain| grain.id);
    grains
}

/// Grains on a jittered grid that fills the box, sizes and directions at random.
fn scatter(bodies: &[GrainBody], room: PackingBox, seed: u64) -> Vec<Grain> {
    let mut random = fastrand::Rng::with_seed(seed);
    let cell = (room.size.product() / bodies.len().max(1) as f64).cbrt();
    let mut counts = room.size.map(|length| (length / cell).round().max(1.0) as usize);
    while counts.product() < bodies.len() {
        let widest = room.size.component_div(&counts.map(|count| count as f64)).imax();
        counts[widest] += 1;
    }
    let mut cells: Vec<usize> = (0..counts.product()).collect();
    random.shuffle(&mut cells);
    let spacing = room.size.component_div(&counts.map(|count| count as f64));
    let place = |cell: usize, jitter: Vec3| {
        let index = Vec3::new(
            (cell % counts.x) as f64,
            (cell / counts.x % counts.y) as f64,
            (cell / (counts.x * counts.y)) as f64,
        );
        (index + jitter).component_mul(&spacing)
    };
    let mut grains = Vec::with_capacity(bodies.len());
    for (id, (body, cell)) in bodies.iter().zip(cells).enumerate() {
        let jitter = Vec3::from_fn(|_, _| 0.3 + 0.4 * random.f64());
        grains.push(Grain::at(id as u32, place(cell, jitter), random_direction(&mut random), *body));
    }
    grains
}

/// A direction uniform on the sphere.
fn random_direction(random: &mut fastrand::Rng) -> Vec3 {
    loop {
        let point = Vec3::from_fn(|_, _| 2.0 * random.f64() - 1.0);
        let length = point.norm();
        if length > 0.1 && length < 1.0 {
            return point / length;
        }
    }
}

/// The six walls of the box, frictionless.
fn walls(room: PackingBox) -> Vec<Surface> {
    let mut surfaces = Vec::new();
    for axis in 0..3 {
        let mut inward = Vec3::zeros();
        inward[axis] = 1.0;
        let spans = [(axis + 1) % 3, (axis + 2) % 3].map(|other| {
            let mut direction = Vec3::zeros();
            direction[other] = 1.0;
            Span::unbounded(direction)
        });
        for (origin, normal) in [(Vec3::zeros(), inward), (inward * room.size[axis], -inward)] {
            surfaces.push(Surface { role: SurfaceRole::Side, origin, normal, spans, friction: 0.0 });
        }
    }
    surfaces
}
