//! The scenes of the throughput bench: a bed at rest behind a gate, the flow that it becomes, and its impact on the wall.
//!
//! Grains of 15.27 mm in a flume of 2.19 m × 0.30 m at 40°, scaled with the cube root of their number so that the
//! shape of the bulk stays: equal spheres, or clumps of 9.8 to 19.7 mm as in the laboratory wall. States are kept as text,
//! those of spheres in the columns of a LAMMPS dump (`id x y z vx vy vz omegax omegay omegaz`), in `target/bench_states/`:
//! another code can start from the very same state, and a state made elsewhere can be put there.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use barrier_check::scene::flow::packing::{PackingRoom, pack};
use dem::Vec3;
use dem::contact::material::Material;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::grains::{Grain, GrainBody, GrainShape};
use dem::tables::surfaces::{Span, Surface, SurfaceRole};
use dem::tables::terrain::{Patch, Terrain};
use dem::tables::wall::WallShape;

/// Radius of the spheres (m).
pub const RADIUS: f64 = 0.007635;
const DENSITY: f64 = 2701.0;
const MODULUS: f64 = 1e8;
/// Largest clump over smallest.
const CLUMP_SPREAD: f64 = 2.0;
/// Equivalent diameter of the smallest clump (m).
const SMALLEST_CLUMP: f64 = 0.00983;
/// Time step of the bench, the same for all codes (s).
pub const STEP: f64 = 1e-5;
/// Diameter of a boulder over that of the other spheres.
const BOULDER: f64 = 20.0;
/// Number of grains at which the flume has its laboratory size.
const LABORATORY: f64 = 5406.0;
/// States larger than this are copies side by side.
const LARGEST_MADE: usize = 20_000;

/// A state of the bench.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct State {
    pub shape: GrainShape,
    pub phase: Phase,
    /// Number of grains.
    pub count: usize,
    /// Whether the bed is a height field, of the same plane, instead of a surface.
    pub field: bool,
    /// Whether two boulders of [`BOULDER`] times the diameter lie in the bed, in the place of the spheres that were there.
    pub boulders: bool,
}

/// Which part of the event a state is taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// At rest behind the gate, about three contacts to a sphere.
    Dense,
    /// 0.7 s (scaled) after the release: hardly any contacts.
    Flow,
    /// 1.15 s (scaled) after the release: the force on the wall is near its peak.
    Impact,
}

impl State {
    pub fn name(&self) -> String {
        if self.field { format!("{}_on_a_height_field", self.file_name()) } else { self.file_name() }
    }

    fn file_name(&self) -> String {
        let phase = match self.phase {
            Phase::Dense => "dense",
            Phase::Flow => "flow",
            Phase::Impact => "impact",
        };
        match self.shape {
            GrainShape::Sphere if self.boulders => format!("{phase}_{}_and_boulders", self.count),
            GrainShape::Sphere => format!("{phase}_{}", self.count),
            GrainShape::Clump => format!("clumps_{phase}_{}", self.count),
        }
    }

    /// The state from its file, or made now.
    pub fn model(&self) -> Model {
        let path = folder().join(format!("{}.dump", self.file_name()));
        let grains = self.read(&path).unwrap_or_else(|| {
            let grains = self.make();
            self.write(&path, &grains);
            grains
        });
        self.around(grains)
    }

    /// A simulation of the state with the bench's time step, run in for `steps` steps.
    pub fn run_in(&self, model: Model, steps: usize) -> Simulation {
        let mut simulation = Simulation::new(model, STEP, self.skin(), 1e3);
        for _ in 0..steps {
            simulation.step().expect("stable");
        }
        simulation
    }

    fn skin(&self) -> f64 {
        match self.shape {
            GrainShape::Sphere => SKIN * RADIUS,
            GrainShape::Clump => SKIN * 0.84 * RADIUS,
        }
    }

    fn scale(&self) -> f64 {
        libm::cbrt(self.count.min(LARGEST_MADE) as f64 / LABORATORY)
    }

    fn make(&self) -> Vec<Grain> {
        if self.count > LARGEST_MADE {
            return self.side_by_side();
        }
        eprintln!("making the state {}, once", self.name());
        let before = match self.phase {
            Phase::Dense => self.around(self.packed()),
            Phase::Flow | Phase::Impact => Self { phase: Phase::Dense, field: false, ..*self }.model(),
        };
        let mut simulation = Simulation::new(before, STEP, self.skin(), 1e3);
        let (time, drag) = match self.phase {
            Phase::Dense => (0.5, 20.0),
            Phase::Flow => (0.7, 0.0),
            Phase::Impact => (1.15, 0.0),
        };
        if self.phase != Phase::Dense {
            simulation.remove_surfaces(SurfaceRole::Gate);
        }
        simulation.drag = drag;
        while simulation.time < time * self.scale().sqrt() {
            simulation.step().expect("stable");
        }
        let mut grains = simulation.snapshot();
        grains.sort_by_key(|grain| grain.id);
        grains
    }

    /// Copies of the largest state that is made, next to each other across the flume.
    fn side_by_side(&self) -> Vec<Grain> {
        let one = Self { count: LARGEST_MADE, field: false, ..*self }.model().grains;
        let width = 0.30 * self.scale();
        let copies = (0..self.count / LARGEST_MADE).flat_map(|copy| {
            one.iter().map(move |grain| Grain {
                id: grain.id + (copy * LARGEST_MADE) as u32,
                position: grain.position + Vec3::y() * (copy as f64 * width),
                ..grain.clone()
            })
        });
        copies.collect()
    }

    fn body(&self, id: usize) -> GrainBody {
        match self.shape {
            GrainShape::Sphere if id >= self.count => GrainBody::sphere(BOULDER * RADIUS, DENSITY),
            GrainShape::Sphere => GrainBody::sphere(RADIUS, DENSITY),
            GrainShape::Clump => {
                // Evenly spread sizes, in an order that mixes them.
                let share = (id as f64 * 0.618_033_988_75).fract();
                GrainBody::clump(SMALLEST_CLUMP * (1.0 + (CLUMP_SPREAD - 1.0) * share), 1.5, DENSITY)
            }
        }
    }

    fn packed(&self) -> Vec<Grain> {
        let bodies: Vec<GrainBody> = (0..self.count).map(|id| self.body(id)).collect();
        let room = PackingRoom::level(Vec3::new(0.44, 0.30, 0.15) * self.scale(), false);
        let (mut grains, growth) = pack(&bodies, self.shape, room, 1).expect("fits");
        for grain in &mut grains {
            grain.position.x *= 0.44 * self.scale() / (growth * room.size.x);
        }
        if self.boulders { self.with_boulders(grains) } else { grains }
    }

    fn with_boulders(&self, mut grains: Vec<Grain>) -> Vec<Grain> {
        let body = self.body(self.count);
        for (number, place) in [[0.13, 0.10], [0.31, 0.20]].into_iter().enumerate() {
            let centre = Vec3::new(place[0] * self.scale(), place[1] * self.scale(), body.radius);
            grains.retain(|grain| (grain.position - centre).norm() > grain.body.radius + body.radius);
            grains.push(Grain::at((self.count + number) as u32, centre, Vec3::x(), body));
        }
        grains
    }

    /// The flume around the grains.
    fn around(&self, grains: Vec<Grain>) -> Model {
        let size = self.scale();
        let width = 0.30 * size * (self.count / LARGEST_MADE).max(1) as f64;
        let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
        let mut surfaces = vec![
            plane(SurfaceRole::Base, Vec3::zeros(), z, 0.4663),
            plane(SurfaceRole::Side, Vec3::zeros(), y, 0.2679),
            plane(SurfaceRole::Side, y * width, -y, 0.2679),
            plane(SurfaceRole::Side, Vec3::zeros(), x, 0.2679),
            plane(SurfaceRole::Wall, x * (2.19 * size), -x, 0.3839),
        ];
        let terrain = self.field.then(|| height_field([2.19 * size, width], 0.4663));
        if terrain.is_some() {
            surfaces.remove(0);
        }
        if self.phase == Phase::Dense {
            surfaces.push(plane(SurfaceRole::Gate, x * (0.44 * size), -x, 0.2679));
        }
        let slope = 40_f64.to_radians();
        Model {
            shape: self.shape,
            grains,
            surfaces,
            terrain,
            barrier: None,
            material: Material::new(MODULUS, 0.3, 1.327),
            pores: None,
            inlet: None,
            gravity: Vec3::new(libm::sin(slope), 0.0, -libm::cos(slope)) * 9.81,
            wall: WallShape::default(),
            outlet: f64::INFINITY,
        }
    }

    /// Grains of a file; nothing where there is none.
    fn read(&self, path: &Path) -> Option<Vec<Grain>> {
        let text = std::fs::read_to_string(path).ok()?;
        let (_, rows) = text.split_once("ITEM: ATOMS")?;
        let mut grains: Vec<Grain> = rows.lines().skip(1).map(|line| self.read_grain(line)).collect();
        grains.sort_by_key(|grain| grain.id);
        Some(grains)
    }

    fn read_grain(&self, line: &str) -> Grain {
        let v: Vec<f64> = line.split_whitespace().map(|word| word.parse().expect("a number")).collect();
        let id = v[0] as u32 - 1;
        let body = self.body(id as usize);
        let mut grain = Grain::at(id, Vec3::new(v[1], v[2], v[3]), Vec3::x(), body);
        grain.velocity = Vec3::new(v[4], v[5], v[6]);
        let turning = Vec3::new(v[7], v[8], v[9]);
        match self.shape {
            GrainShape::Sphere => grain.angular_momentum = turning * body.inertia_axial,
            GrainShape::Clump => {
                grain.axis = Vec3::new(v[10], v[11], v[12]);
                let along = grain.axis * grain.axis.dot(&turning);
                grain.angular_momentum = along * body.inertia_axial + (turning - along) * body.inertia_transverse;
            }
        }
        grain
    }

    fn write(&self, path: &Path, grains: &[Grain]) {
        let mut text = String::from("ITEM: ATOMS id x y z vx vy vz omegax omegay omegaz");
        text.push_str(if self.shape == GrainShape::Clump { " axisx axisy axisz\n" } else { "\n" });
        for grain in grains {
            let _ = write!(text, "{}", grain.id + 1);
            let axis = if self.shape == GrainShape::Clump { grain.axis.as_slice() } else { &[] };
            for value in grain.position.iter().chain(&grain.velocity).chain(&grain.spin()).chain(axis) {
                let _ = write!(text, " {value:e}");
            }
            text.push('\n');
        }
        std::fs::create_dir_all(folder()).expect("folder of states");
        std::fs::write(path, text).expect("state is written");
    }
}

/// Side of a cell of the height field, over the radius of a sphere: as a raster of 1 m has it under grains of 0.5 m.
const CELL: f64 = 4.0;

/// A bed of triangles from the origin to `size` (m), some cells wider on all sides.
fn height_field(size: [f64; 2], friction: f64) -> Terrain {
    let cell = CELL * RADIUS;
    let counts = size.map(|length| (length / cell).ceil() as usize + 4);
    let row = counts[0] + 1;
    let corner = |index: usize| Vec3::new((index % row) as f64 - 2.0, (index / row) as f64 - 2.0, 0.0) * cell;
    let corners = (0..row * (counts[1] + 1)).map(corner).collect();
    let cells = (0..counts[1]).flat_map(|y| (0..counts[0]).map(move |x| (y * row + x) as u32));
    let halves = cells.flat_map(|low| {
        let high = low + row as u32;
        [vec![low, low + 1, high + 1], vec![low, high + 1, high]]
    });
    let patches: Vec<Patch> = halves.map(|corners| Patch { corners, role: SurfaceRole::Base, friction }).collect();
    Terrain::new(corners, &patches)
}

/// Reach of the pair lists over the radius.
pub const SKIN: f64 = 0.6;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("../bench_states")
}

fn plane(role: SurfaceRole, origin: Vec3, normal: Vec3, friction: f64) -> Surface {
    let mut spans = [Vec3::z(), Vec3::y(), Vec3::x()].into_iter().filter(|axis| axis.dot(&normal) == 0.0);
    let spans = [(); 2].map(|()| Span::unbounded(spans.next().expect("two axes lie in the plane")));
    Surface::new(role, origin, normal, spans, friction)
}
