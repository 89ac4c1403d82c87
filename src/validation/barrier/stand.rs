//! A test stand: a barrier alone, with loads on its nodes, stepped by the engine's own forces and motion.

use crate::validation::case::Broken;
use dem::Vec3;
use dem::contact::law::LawConstants;
use dem::contact::material::Material;
use dem::elements::cylinder::{Cylinder, Section};
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::strength::Strength;
use dem::net::{NetForces, pull_all};
use dem::tables::barrier::Barrier;
use dem::tables::nodes::{Frame, Node};
use dem::time::integrate::{move_nodes, turn_frames};

/// The main rope of Albaba 2015: E = 4 GPa, R = 16 mm, 7850 kg/m³.
pub const MODULUS: f64 = 4e9;
pub const RADIUS: f64 = 0.016;
pub const DENSITY: f64 = 7850.0;
pub const POISSON: f64 = 0.3;

/// Its section; EA = 3.217 MN, EI = 205.9 N m².
pub fn section() -> Section {
    Section::round(RADIUS, MODULUS, POISSON)
}

/// Its mass per length (kg/m).
pub fn line_mass() -> f64 {
    DENSITY * std::f64::consts::PI * RADIUS * RADIUS
}

pub struct Stand {
    pub barrier: Barrier,
    pub gravity: Vec3,
    /// Force (N) and torque (N m) on single nodes.
    pub loads: Vec<(usize, Vec3, Vec3)>,
    /// s
    pub step: f64,
    pub net: NetForces,
}

impl Stand {
    pub fn new(barrier: Barrier, step: f64) -> Self {
        Self { barrier, gravity: Vec3::zeros(), loads: Vec::new(), step, net: NetForces::default() }
    }

    pub fn step(&mut self) {
        self.net = pull_all(&self.barrier, &LawConstants::of(&Material::new(1.0, 1.0, 0.0), self.step));
        for (node, force, torque) in &self.loads {
            self.net.forces[*node] += force;
            if let Some(sum) = self.net.torques.get_mut(*node) {
                *sum += torque;
            }
        }
        self.net.take_over(&mut self.barrier);
        move_nodes(&mut self.barrier.nodes, &self.net.forces, &self.gravity, self.step);
        turn_frames(&mut self.barrier.frames, &self.net.torques, self.step);
    }

    /// Steps to rest under viscous slowing. `slowest` is the angular frequency of the slowest motion (rad/s), which is damped
    /// critically and dies down to e⁻²⁰.
    pub fn relax(&mut self, slowest: f64) {
        let steps = (20.0 / slowest / self.step).ceil() as usize;
        let keep = 1.0 - 2.0 * slowest * self.step;
        for _ in 0..steps {
            self.step();
            self.barrier.nodes.iter_mut().for_each(|node| node.velocity *= keep);
            self.barrier.frames.iter_mut().for_each(|frame| frame.spin *= keep);
        }
    }

    /// Period (s) of `of`, a measure that swings about zero, from ten of its passages; takes at most `longest` (s).
    pub fn period(&mut self, longest: f64, of: impl Fn(&Barrier) -> f64) -> Result<f64, Broken> {
        let (mut passages, mut before, mut time) = (Vec::new(), of(&self.barrier), 0.0);
        while passages.len() < 11 {
            self.step();
            time += self.step;
            let now = of(&self.barrier);
            if before * now < 0.0 {
                passages.push(time - self.step * now.abs() / (now.abs() + before.abs()));
            }
            if now != 0.0 {
                before = now;
            }
            if time > longest {
                return Err(Broken::Scene("it did not swing".to_string()));
            }
        }
        Ok(2.0 * (passages[10] - passages[0]) / 10.0)
    }
}

fn node(position: Vec3, mass: f64, fixed: bool) -> Node {
    Node { position, velocity: Vec3::zeros(), mass, fixed, radius: RADIUS }
}

/// Masses of the nodes of a line cut into `parts` equal parts.
fn masses(length: f64, parts: usize) -> impl Iterator<Item = f64> {
    let part = line_mass() * length / parts as f64;
    (0..=parts).map(move |number| if number == 0 || number == parts { 0.5 * part } else { part })
}

/// A row of cylinders along x from the origin, clamped there.
pub fn cantilever(length: f64, parts: usize) -> Barrier {
    let mut barrier = Barrier::default();
    let part = length / parts as f64;
    for (number, mass) in masses(length, parts).enumerate() {
        barrier.nodes.push(node(Vec3::x() * (part * number as f64), mass, number == 0));
        barrier.frames.push(Frame {
            orientation: nalgebra::UnitQuaternion::identity(),
            spin: Vec3::zeros(),
            inertia: mass * (part * part / 12.0 + RADIUS * RADIUS / 4.0),
            held: number == 0,
        });
    }
    for number in 0..parts {
        let ends = [number, number + 1];
        let places = ends.map(|end| &barrier.nodes[end].position);
        let frames = ends.map(|end| &barrier.frames[end]);
        let nodes = ends.map(|end| end as u32);
        barrier.cylinders.push(Cylinder::between(nodes, SegmentKind::Main(0), section(), places, frames));
    }
    barrier
}

/// A rope of tension-only segments through the given points; the ends are fixed as told. Its rest length over that of the
/// line through the points is `slack`.
pub fn rope(points: &[Vec3], fixed: [bool; 2], slack: f64) -> Barrier {
    let parts = points.len() - 1;
    let lengths: Vec<f64> = points.windows(2).map(|pair| (pair[1] - pair[0]).norm() * slack).collect();
    let mut barrier = Barrier::default();
    for (number, (point, mass)) in points.iter().zip(masses(lengths.iter().sum(), parts)).enumerate() {
        let held = number == 0 && fixed[0] || number == parts && fixed[1];
        barrier.nodes.push(node(*point, mass, held));
    }
    for (number, &rest_length) in lengths.iter().enumerate() {
        barrier.segments.push(Segment {
            nodes: [number as u32, number as u32 + 1],
            kind: SegmentKind::Main(0),
            rest_length,
            stiffness: section().axial / rest_length,
            damping: 0.0,
            radius: RADIUS,
            strength: Strength::default(),
        });
    }
    barrier.connect();
    barrier
}

/// Points at equal distances from `a` to `b`.
pub fn line(a: Vec3, b: Vec3, parts: usize) -> Vec<Vec3> {
    (0..=parts).map(|number| a + (b - a) * (number as f64 / parts as f64)).collect()
}
