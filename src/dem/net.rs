//! Forces within a flexible barrier in one step.

use crate::dem::Vec3;
use crate::dem::contact::ropes::Push;
use crate::dem::elements::dissipator::Dissipator;
use crate::dem::elements::rope::pull;
use crate::dem::tables::barrier::Barrier;

/// Forces on the nodes and tensions of the elements.
#[derive(Clone, Debug, Default)]
pub struct NetForces {
    /// Force on each node (N).
    pub forces: Vec<Vec3>,
    /// Tension of each segment (N).
    pub tensions: Vec<f64>,
    /// Tension of each dissipator (N).
    pub brakes: Vec<f64>,
    /// Torque on each node that turns (N m).
    pub torques: Vec<Vec3>,
    /// Axial force of each cylinder (N), tension positive.
    pub axial: Vec<f64>,
    /// Force of all grains on the barrier (N).
    pub from_grains: Vec3,
    /// Elastic energy (J).
    pub stored: f64,
    /// Lost in rope damping in this step (J).
    pub lost_ropes: f64,
    /// Dissipators with the stroke of this step, to be taken over.
    slipped: Vec<Dissipator>,
    lost_dissipators: f64,
}

/// Stretches every element to the present places of the nodes.
pub fn pull_all(barrier: &Barrier, time_step: f64) -> NetForces {
    let mut net = NetForces {
        forces: vec![Vec3::zeros(); barrier.nodes.len()],
        torques: vec![Vec3::zeros(); barrier.frames.len()],
        tensions: Vec::with_capacity(barrier.segments.len()),
        slipped: barrier.dissipators.clone(),
        ..NetForces::default()
    };
    for segment in &barrier.segments {
        let [a, b] = segment.nodes.map(|node| node as usize);
        let result = pull(segment, &barrier.nodes[a], &barrier.nodes[b]);
        let force = result.direction * result.tension;
        net.forces[a] += force;
        net.forces[b] -= force;
        net.stored += result.stored;
        net.lost_ropes += result.power_lost * time_step;
        net.tensions.push(result.tension);
    }
    for dissipator in &mut net.slipped {
        let [anchor, end] = dissipator.nodes.map(|node| node as usize);
        let result = dissipator.stretch(&barrier.nodes[anchor], &barrier.nodes[end]);
        let force = result.direction * result.tension;
        net.forces[anchor] += force;
        net.forces[end] -= force;
        net.stored += result.stored;
        net.lost_dissipators += result.lost;
        net.brakes.push(result.tension);
    }
    for cylinder in &barrier.cylinders {
        let [a, b] = cylinder.nodes.map(|node| node as usize);
        let strain = cylinder.strain([&barrier.nodes[a], &barrier.nodes[b]], [&barrier.frames[a], &barrier.frames[b]]);
        net.forces[a] -= strain.force;
        net.forces[b] += strain.force;
        net.torques[a] += strain.moments[0];
        net.torques[b] += strain.moments[1];
        net.stored += strain.stored;
        net.lost_ropes += strain.power_lost * time_step;
        net.axial.push(strain.tension);
    }
    net
}

/// Lets ropes slide through their rings at the present places, before they pull; returns the energy lost since the last step,
/// which was of length `step` (J).
pub fn slide_all(barrier: &mut Barrier, step: f64) -> f64 {
    let Barrier { nodes, segments, chains, .. } = barrier;
    chains.iter().map(|chain| chain.slide(segments, nodes, step)).sum()
}

impl NetForces {
    /// Adds the force of a grain on a segment.
    pub fn push(&mut self, push: &Push) {
        let [a, b] = push.nodes.map(|node| node as usize);
        self.forces[a] += push.force * (1.0 - push.share);
        self.forces[b] += push.force * push.share;
        self.from_grains += push.force;
    }

    /// Hands the strokes of this step to the barrier; returns the energy they took (J).
    pub fn slip_dissipators(&mut self, barrier: &mut Barrier) -> f64 {
        barrier.dissipators.clone_from_slice(&self.slipped);
        self.lost_dissipators
    }
}
