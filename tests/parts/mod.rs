//! Parts of barriers that tests put together.

#![allow(dead_code)] // not every test uses every part

use barrier_check::validation::scenes::free_model;
use dem::Vec3;
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::strength::Strength;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::barrier::Barrier;
use dem::tables::grains::GrainShape;
use dem::tables::nodes::Node;

pub const AXIAL_STIFFNESS: f64 = 3.21699e6;

pub fn node(position: Vec3, mass: f64, fixed: bool) -> Node {
    Node { position, velocity: Vec3::zeros(), mass, fixed, radius: 0.016 }
}

pub fn segment(nodes: [u32; 2], rest_length: f64, damping: f64) -> Segment {
    let stiffness = AXIAL_STIFFNESS / rest_length;
    Segment {
        nodes,
        kind: SegmentKind::Main(0),
        rest_length,
        stiffness,
        damping,
        radius: 0.016,
        strength: Strength::default(),
    }
}

pub fn simulate(mut barrier: Barrier, gravity: Vec3, step: f64) -> Simulation {
    barrier.connect();
    let model = Model { barrier: Some(barrier), gravity, ..free_model(Vec::new(), GrainShape::Sphere) };
    Simulation::new(model, step, 0.1, 1e3)
}

pub fn nodes(simulation: &Simulation) -> &[Node] {
    &simulation.model.barrier.as_ref().expect("a barrier").nodes
}
