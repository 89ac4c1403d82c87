//! Small models that several tests share.
#![allow(dead_code)] // each test binary uses its own share of these

use barrier_check::dem::Vec3;
use barrier_check::dem::model::{Material, Model};
use barrier_check::dem::tables::grains::{Grain, GrainBody, GrainShape};
use barrier_check::dem::tables::surfaces::{Span, Surface, SurfaceRole};

pub fn material(restitution: f64, friction: f64) -> Material {
    Material { modulus: 1e8, restitution, tangential_ratio: 2.0 / 7.0, friction }
}

pub fn ball(id: u32, position: Vec3, radius: f64, density: f64) -> Grain {
    Grain::at(id, position, Vec3::x(), GrainBody::sphere(radius, density))
}

/// Grains in empty space, without gravity.
pub fn free_model(grains: Vec<Grain>, shape: GrainShape) -> Model {
    Model {
        shape,
        grains,
        surfaces: Vec::new(),
        barrier: None,
        material: material(0.3, 0.5),
        gravity: Vec3::zeros(),
        wall_levels: Vec::new(),
        outlet: f64::INFINITY,
    }
}

pub fn floor(friction: f64) -> Surface {
    Surface {
        role: SurfaceRole::Base,
        origin: Vec3::zeros(),
        normal: Vec3::z(),
        spans: [Span::unbounded(Vec3::x()), Span::unbounded(Vec3::y())],
        friction,
    }
}

/// A cloud of clumps thrown together: `count` grains on a jittered grid, flying towards the middle.
pub fn cloud(count: usize, seed: u64) -> Vec<Grain> {
    let mut random = fastrand::Rng::with_seed(seed);
    let side = (count as f64).cbrt().ceil() as usize;
    let spacing = 0.03;
    let middle = Vec3::repeat(0.5 * spacing * side as f64);
    (0..count)
        .map(|index| {
            let cell = Vec3::new((index % side) as f64, (index / side % side) as f64, (index / side / side) as f64);
            let jitter = Vec3::from_fn(|_, _| 0.2 * random.f64());
            let direction = Vec3::from_fn(|_, _| random.f64() - 0.5).normalize();
            let body = GrainBody::clump(0.015 + 0.008 * random.f64(), 1.5, 2600.0);
            let mut grain = Grain::at(index as u32, (cell + jitter) * spacing, direction, body);
            grain.velocity = (middle - grain.position) * 4.0;
            grain.angular_momentum = Vec3::from_fn(|_, _| random.f64() - 0.5) * (body.inertia_axial * 20.0);
            grain
        })
        .collect()
}
