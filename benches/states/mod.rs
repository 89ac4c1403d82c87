//! The scenes of the throughput bench: a bed at rest behind a gate, and the flow that it becomes.
//!
//! Equal spheres of 15.27 mm in a flume of 2.19 m × 0.30 m at 40°, scaled with the cube root of their number so that the
//! shape of the bulk stays. States are kept as text, in the columns of a LAMMPS dump (`id x y z vx vy vz omegax omegay
//! omegaz`), in `target/bench_states/`: another code can start from the very same state, and a state made elsewhere
//! can be put there.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use barrier_check::dem::Vec3;
use barrier_check::dem::model::{Material, Model};
use barrier_check::dem::simulation::Simulation;
use barrier_check::dem::tables::grains::{Grain, GrainBody, GrainShape};
use barrier_check::dem::tables::surfaces::{Span, Surface, SurfaceRole};
use barrier_check::scene::flow::packing::{PackingBox, pack};

pub const RADIUS: f64 = 0.007635;
const DENSITY: f64 = 2701.0;
const MODULUS: f64 = 1e8;
/// Time step of the bench, the same for all codes (s).
pub const STEP: f64 = 1e-5;
/// Number of spheres at which the flume has its laboratory size.
const LABORATORY: f64 = 5406.0;
/// States larger than this are copies side by side.
const LARGEST_MADE: usize = 20_000;

/// Which part of the event a state is taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// At rest behind the gate, about three contacts to a sphere.
    Dense,
    /// 0.7 s (scaled) after the release: hardly any contacts.
    Flow,
}

impl Phase {
    pub fn name(self) -> &'static str {
        match self {
            Self::Dense => "dense",
            Self::Flow => "flow",
        }
    }
}

/// A flume with `count` spheres in the given phase, from its file or made now.
pub fn flume(count: usize, phase: Phase) -> Model {
    let path = folder().join(format!("{}_{count}.dump", phase.name()));
    let grains = read(&path).unwrap_or_else(|| {
        let grains = make(count, phase);
        write(&path, &grains);
        grains
    });
    model(grains, count, phase)
}

/// A simulation of `model` with the bench's time step, run in for `steps` steps.
pub fn run_in(model: Model, steps: usize) -> Simulation {
    let mut simulation = Simulation::new(model, STEP, 0.3 * RADIUS, 1e3);
    for _ in 0..steps {
        simulation.step().expect("stable");
    }
    simulation
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("../bench_states")
}

fn make(count: usize, phase: Phase) -> Vec<Grain> {
    if count > LARGEST_MADE {
        return side_by_side(count, phase);
    }
    eprintln!("making the state {} of {count} spheres, once", phase.name());
    let before = match phase {
        Phase::Dense => model(packed(count), count, Phase::Dense),
        Phase::Flow => flume(count, Phase::Dense),
    };
    let mut simulation = Simulation::new(before, 2.0 * STEP, 0.3 * RADIUS, 1e3);
    let scale = scale(count).sqrt();
    let (time, drag) = match phase {
        Phase::Dense => (0.5 * scale, 20.0),
        Phase::Flow => (0.7 * scale, 0.0),
    };
    if phase == Phase::Flow {
        simulation.remove_surfaces(SurfaceRole::Gate);
    }
    simulation.drag = drag;
    while simulation.time < time {
        simulation.step().expect("stable");
    }
    let mut grains = simulation.snapshot();
    grains.sort_by_key(|grain| grain.id);
    grains
}

/// Copies of the largest state that is made, next to each other across the flume.
fn side_by_side(count: usize, phase: Phase) -> Vec<Grain> {
    let one = flume(LARGEST_MADE, phase).grains;
    let width = 0.30 * scale(LARGEST_MADE);
    let copies = (0..count / LARGEST_MADE).flat_map(|copy| {
        one.iter().map(move |grain| Grain {
            id: grain.id + (copy * LARGEST_MADE) as u32,
            position: grain.position + Vec3::y() * (copy as f64 * width),
            ..grain.clone()
        })
    });
    copies.collect()
}

fn packed(count: usize) -> Vec<Grain> {
    let bodies = vec![GrainBody::sphere(RADIUS, DENSITY); count];
    let scale = scale(count);
    let room = PackingBox { size: Vec3::new(0.44, 0.30, 0.15) * scale };
    let (mut grains, length) = pack(&bodies, GrainShape::Sphere, room, 1).expect("fits");
    for grain in &mut grains {
        grain.position.x *= 0.44 * scale / length;
    }
    grains
}

fn scale(count: usize) -> f64 {
    (count.min(LARGEST_MADE) as f64 / LABORATORY).cbrt()
}

fn model(grains: Vec<Grain>, count: usize, phase: Phase) -> Model {
    let size = scale(count);
    let width = 0.30 * size * (count / LARGEST_MADE).max(1) as f64;
    let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
    let plane = |role, origin: Vec3, normal: Vec3, friction: f64| {
        let spans = [z, y, x].into_iter().filter(|axis| axis.dot(&normal) == 0.0).map(Span::unbounded);
        let spans: Vec<Span> = spans.collect();
        Surface { role, origin, normal, spans: [spans[0], spans[1]], friction }
    };
    let mut surfaces = vec![
        plane(SurfaceRole::Base, Vec3::zeros(), z, 0.4663),
        plane(SurfaceRole::Side, Vec3::zeros(), y, 0.2679),
        plane(SurfaceRole::Side, y * width, -y, 0.2679),
        plane(SurfaceRole::Side, Vec3::zeros(), x, 0.2679),
        plane(SurfaceRole::Wall, x * (2.19 * size), -x, 0.3839),
    ];
    if phase == Phase::Dense {
        surfaces.push(plane(SurfaceRole::Gate, x * (0.44 * size), -x, 0.2679));
    }
    let slope = 40_f64.to_radians();
    Model {
        shape: GrainShape::Sphere,
        grains,
        surfaces,
        barrier: None,
        material: Material { modulus: MODULUS, restitution: 0.3, tangential_ratio: 2.0 / 7.0, friction: 1.327 },
        gravity: Vec3::new(slope.sin(), 0.0, -slope.cos()) * 9.81,
        wall_levels: Vec::new(),
        outlet: f64::INFINITY,
    }
}

/// Grains of a dump; nothing where there is no file.
fn read(path: &Path) -> Option<Vec<Grain>> {
    let text = std::fs::read_to_string(path).ok()?;
    let body = GrainBody::sphere(RADIUS, DENSITY);
    let (_, rows) = text.split_once("ITEM: ATOMS")?;
    let mut grains: Vec<Grain> = rows
        .lines()
        .skip(1)
        .map(|line| {
            let v: Vec<f64> = line.split_whitespace().map(|word| word.parse().expect("a number")).collect();
            let mut grain = Grain::at(v[0] as u32 - 1, Vec3::new(v[1], v[2], v[3]), Vec3::x(), body);
            grain.velocity = Vec3::new(v[4], v[5], v[6]);
            grain.angular_momentum = Vec3::new(v[7], v[8], v[9]) * body.inertia_axial;
            grain
        })
        .collect();
    grains.sort_by_key(|grain| grain.id);
    Some(grains)
}

fn write(path: &Path, grains: &[Grain]) {
    let mut text = String::from("ITEM: ATOMS id x y z vx vy vz omegax omegay omegaz\n");
    for grain in grains {
        let _ = write!(text, "{}", grain.id + 1);
        for value in grain.position.iter().chain(&grain.velocity).chain(&grain.spin()) {
            let _ = write!(text, " {value:e}");
        }
        text.push('\n');
    }
    std::fs::create_dir_all(folder()).expect("folder of states");
    std::fs::write(path, text).expect("state is written");
}
