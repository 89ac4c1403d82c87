//! Small scenes and steps that several cases share.

use dem::Vec3;
use dem::contact::material::Material;
use dem::model::Model;
use dem::simulation::{Simulation, Unstable};
use dem::tables::grains::{Grain, GrainBody, GrainShape};
use dem::tables::surfaces::{Surface, SurfaceRole};

/// m/s²
pub const GRAVITY: f64 = crate::units::GRAVITY;

/// The contact modulus of the small scenes (Pa).
pub const MODULUS: f64 = 1e8;

pub fn material(restitution: f64, friction: f64) -> Material {
    Material::new(MODULUS, restitution, friction)
}

/// A ball at rest.
pub fn ball(id: u32, position: Vec3, radius: f64, density: f64) -> Grain {
    Grain::at(id, position, Vec3::x(), GrainBody::sphere(radius, density))
}

/// Grains in empty space, without gravity.
pub fn free_model(grains: Vec<Grain>, shape: GrainShape) -> Model {
    Model { grains, material: material(0.3, 0.5), ..Model::empty(shape) }
}

/// An unbounded plane through `origin`.
pub fn plane(role: SurfaceRole, origin: Vec3, normal: Vec3, friction: f64) -> Surface {
    Surface::plane(role, origin, normal, friction)
}

/// The plane z = 0.
pub fn floor(friction: f64) -> Surface {
    plane(SurfaceRole::Base, Vec3::zeros(), Vec3::z(), friction)
}

/// Six frictionless walls around a box from the origin to `size` (m).
pub fn closed_box(size: Vec3) -> Vec<Surface> {
    [Vec3::x(), Vec3::y(), Vec3::z()]
        .into_iter()
        .flat_map(|axis| {
            let far = axis.component_mul(&size);
            [(Vec3::zeros(), axis), (far, -axis)].map(|(origin, normal)| plane(SurfaceRole::Side, origin, normal, 0.0))
        })
        .collect()
}

/// Duration π √(m_r/k) of an undamped contact (s).
pub fn contact_time(stiffness: f64, reduced_mass: f64) -> f64 {
    std::f64::consts::PI * (reduced_mass / stiffness).sqrt()
}

/// A simulation whose lists reach a fifth of `radius` further than contacts.
pub fn simulate(model: Model, step: f64, radius: f64) -> Simulation {
    Simulation::new(model, step, 0.2 * radius, 1e6)
}

pub fn run(simulation: &mut Simulation, steps: usize) -> Result<(), Unstable> {
    (0..steps).try_for_each(|_| simulation.step())
}

/// Runs until the simulation's clock shows `time` (s).
pub fn run_until(simulation: &mut Simulation, time: f64) -> Result<(), Unstable> {
    while simulation.time < time {
        simulation.step()?;
    }
    Ok(())
}

/// Linear and angular momentum of all grains about the origin.
pub fn momenta(grains: &[Grain]) -> (Vec3, Vec3) {
    grains.iter().fold((Vec3::zeros(), Vec3::zeros()), |(linear, angular), grain| {
        let momentum = grain.velocity * grain.body.mass;
        (linear + momentum, angular + grain.position.cross(&momentum) + grain.angular_momentum)
    })
}

/// A cloud of clumps thrown together: `count` grains on a jittered grid, flying towards the middle.
pub fn cloud(count: usize, seed: u64) -> Vec<Grain> {
    let mut random = fastrand::Rng::with_seed(seed);
    let side = libm::cbrt(count as f64).ceil() as usize;
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

/// Runs jobs side by side on all cores, each on one thread; results in the order of the jobs.
pub fn side_by_side<T: Send>(count: usize, job: impl Fn(usize) -> T + Sync) -> Vec<T> {
    crate::starts::side_by_side(std::thread::available_parallelism().map_or(1, usize::from), count, job)
}
