//! The course of an event for the eye: where grains and barrier are at even times, in single precision.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::segment::SegmentKind;
use crate::simulation::Simulation;
use crate::tables::barrier::Barrier;
use crate::tables::grains::Grain;
use crate::tables::surfaces::SurfaceRole;

/// Frames kept at the most; when there are as many, every other one goes, and from then on half as many are taken.
const MOST_FRAMES: usize = 128;
/// Of scenes so large that they would take more than this (bytes), fewer are kept, but so many in any case.
const MOST_BYTES: usize = 256 << 20;
const FEWEST_FRAMES: usize = 24;

/// Frames kept of so many grains at the most; an even number.
fn most_frames(grains: usize) -> usize {
    let fitting = MOST_BYTES / (grains * size_of::<Option<Pose>>()).max(1);
    fitting.clamp(FEWEST_FRAMES, MOST_FRAMES) / 2 * 2
}

/// Bytes that the film of so many grains takes at the most.
pub fn bytes_of(grains: usize) -> usize {
    most_frames(grains) * grains * size_of::<Option<Pose>>()
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Film {
    /// Radius of its spheres and their distance from its centre (m) of every grain, by its number.
    pub looks: Vec<[f32; 2]>,
    /// The barrier's ropes: nodes and kind.
    pub ropes: Vec<([u32; 2], SegmentKind)>,
    pub frames: Vec<Frame>,
    /// Samples from one frame to the next, and samples seen.
    stride: usize,
    seen: usize,
}

impl Film {
    /// From where to where along the channel there is ever a grain, or the barrier's foot (m).
    pub fn stretch(&self) -> [f64; 2] {
        let places =
            self.frames.iter().flat_map(|frame| frame.grains.iter().flatten().map(|pose| f64::from(pose.place[0])));
        places.fold([0.0; 2], |[from, to], place| [from.min(place), to.max(place)])
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// s
    pub time: f64,
    /// By the grain's number; nothing where it has left the model.
    pub grains: Vec<Option<Pose>>,
    /// Places of the barrier's nodes (m).
    pub nodes: Vec<[f32; 3]>,
    /// Tension of each rope (N).
    pub tensions: Vec<f32>,
}

/// A grain in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// m
    pub place: [f32; 3],
    /// Direction from its centre to its second sphere.
    pub axis: [f32; 3],
    /// m/s
    pub speed: f32,
    /// Force on the barrier (N).
    pub force: f32,
}

impl Film {
    /// Whether every frame has all grains, nodes and ropes.
    pub fn is_whole(&self) -> bool {
        let nodes = self.frames.first().map_or(0, |frame| frame.nodes.len());
        let ends = self.ropes.iter().flat_map(|(ends, _)| ends).all(|end| (*end as usize) < nodes);
        let whole = |frame: &Frame| {
            frame.grains.len() == self.looks.len()
                && frame.nodes.len() == nodes
                && frame.tensions.len() == self.ropes.len()
        };
        (ends || self.frames.is_empty()) && self.frames.iter().all(whole)
    }

    /// Takes a frame of the present sample, if it is one for it.
    pub fn take(&mut self, simulation: &Simulation, grains: &[Grain]) {
        self.stride = self.stride.max(1);
        let wanted = self.seen.is_multiple_of(self.stride);
        self.seen += 1;
        if !wanted {
            return;
        }
        if self.frames.is_empty() {
            self.introduce(simulation, grains);
        }
        self.introduce_grains(grains);
        if self.frames.len() >= most_frames(self.looks.len()) {
            let mut place = 0;
            self.frames.retain(|_| {
                place += 1;
                place % 2 == 1
            });
            self.stride *= 2;
        }
        let frame = self.frame(simulation, grains);
        self.frames.push(frame);
    }

    /// Takes the last frame, whatever the time since the one before.
    pub fn finish(&mut self, simulation: &Simulation, grains: &[Grain]) {
        self.introduce_grains(grains);
        if self.frames.last().is_some_and(|frame| frame.time < simulation.time) {
            let frame = self.frame(simulation, grains);
            self.frames.push(frame);
        }
    }

    fn introduce(&mut self, simulation: &Simulation, grains: &[Grain]) {
        self.introduce_grains(grains);
        let axial_members = simulation.model.barrier.iter().flat_map(Barrier::axial_members);
        self.ropes = axial_members.map(|member| (member.nodes, member.kind)).collect();
    }

    /// Grains with higher numbers than those known so far have come in; in earlier frames they are not there.
    fn introduce_grains(&mut self, grains: &[Grain]) {
        let count = grains.iter().map(|grain| grain.id as usize + 1).max().unwrap_or(0);
        if count <= self.looks.len() {
            return;
        }
        let known = self.looks.len();
        self.looks.resize(count, [0.0; 2]);
        for grain in grains.iter().filter(|grain| grain.id as usize >= known) {
            self.looks[grain.id as usize] = [grain.body.radius as f32, grain.body.offset as f32];
        }
        self.frames.iter_mut().for_each(|frame| frame.grains.resize(count, None));
    }

    fn frame(&self, simulation: &Simulation, grains: &[Grain]) -> Frame {
        let mut poses = vec![None; self.looks.len()];
        for grain in grains {
            poses[grain.id as usize] = Some(Pose {
                place: single(&grain.position),
                axis: single(&grain.axis),
                speed: grain.velocity.norm() as f32,
                force: 0.0,
            });
        }
        for (row, force) in pushes(simulation) {
            if let Some(Some(pose)) = poses.get_mut(simulation.grains.ids[row] as usize) {
                pose.force += force.norm() as f32;
            }
        }
        let net = &simulation.sums.net;
        let barrier = simulation.model.barrier.as_ref();
        let nodes = barrier.into_iter().flat_map(|barrier| &barrier.nodes);
        let mut tensions = Vec::new();
        if let Some(barrier) = barrier {
            net.each_axial_member(barrier, |_, tension| tensions.push(tension as f32));
        }
        Frame {
            time: simulation.time,
            grains: poses,
            nodes: nodes.map(|node| single(&node.position)).collect(),
            tensions,
        }
    }
}

/// What grains press on the barrier with, by their rows (N).
fn pushes(simulation: &Simulation) -> Vec<(usize, Vec3)> {
    let walls = simulation.surface_contacts().filter(|contact| contact.role == SurfaceRole::Wall);
    let on_wall = walls.map(|contact| (contact.row, contact.force));
    let pushes = simulation.neighbours.blocks.iter().flat_map(|block| &block.ropes.pushes);
    on_wall.chain(pushes.map(|push| (push.row as usize, push.force))).collect()
}

fn single(vector: &Vec3) -> [f32; 3] {
    [vector.x as f32, vector.y as f32, vector.z as f32]
}
