//! What boulders do to the barrier: their push on it, and how hard the net pulls round them.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::segment::SegmentKind;
use crate::larger_or_nan;
use crate::recorders::body::BodyRecorder;
use crate::recorders::channels::{Channel, Channels, Rows};
use crate::recorders::setup::RecorderSetup;
use crate::simulation::Simulation;
use crate::tables::surfaces::SurfaceRole;

/// Force of the boulder that pushes hardest; none recorded where the flow has no boulders.
pub const FORCE: Channel = Channel { name: "boulder_force", unit: "n", rows: Rows::One };
/// Largest tension of the net within one mesh of a boulder that touches the barrier.
pub const NET: Channel = Channel { name: "boulder_net_largest", unit: "n", rows: Rows::One };

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OfBoulders {
    /// Sums over the steps: of the force of each boulder (N), and of the tension.
    force: Vec<Vec3>,
    net: f64,
}

impl BodyRecorder for OfBoulders {
    fn add_step(&mut self, simulation: &Simulation, setup: &RecorderSetup) {
        let [first, end] = setup.boulders;
        if end <= first {
            return;
        }
        let mut force = vec![Vec3::zeros(); (end - first) as usize];
        let ids = &simulation.grains.ids;
        let mut add = |row: usize, push: &Vec3| {
            if let Some(boulder) = ids[row].checked_sub(first).and_then(|boulder| force.get_mut(boulder as usize)) {
                *boulder += push;
            }
        };
        match &simulation.model.barrier {
            Some(_) => {
                let blocks = simulation.neighbours.blocks.iter();
                blocks.flat_map(|block| &block.ropes.pushes).for_each(|push| add(push.row as usize, &push.force));
            }
            None => {
                let on_the_wall = simulation.surface_contacts().filter(|contact| contact.role == SurfaceRole::Wall);
                on_the_wall.for_each(|contact| add(contact.row, &-contact.force));
            }
        }
        self.force.resize(force.len(), Vec3::zeros());
        self.force.iter_mut().zip(&force).for_each(|(sum, force)| *sum += force);
        self.net += net_round(simulation, setup, &force);
    }

    fn sample(&mut self, simulation: &Simulation, setup: &RecorderSetup, steps: u32, channels: &mut Channels) {
        let [first, end] = setup.boulders;
        if end <= first {
            return;
        }
        let done = std::mem::take(self);
        let mean = 1.0 / f64::from(steps);
        let hardest = done.force.iter().map(|force| mean * force.norm()).fold(0.0, larger_or_nan);
        channels.push(&FORCE, &[hardest]);
        if simulation.model.barrier.is_some() {
            channels.push(&NET, &[mean * done.net]);
        }
    }
}

/// Largest tension of the net within one mesh of the boulders that push on it (N).
fn net_round(simulation: &Simulation, setup: &RecorderSetup, force: &[Vec3]) -> f64 {
    let Some(barrier) = &simulation.model.barrier else { return 0.0 };
    let [first, _] = setup.boulders;
    let touches = |id: u32| {
        let boulder = id.checked_sub(first)?;
        force.get(boulder as usize).filter(|force| **force != Vec3::zeros())
    };
    let rows = simulation.grains.ids.iter().enumerate().filter(|(_, id)| touches(**id).is_some());
    let near: Vec<(Vec3, f64)> = rows
        .map(|(row, _)| {
            let body = &simulation.grains.bodies[row];
            (simulation.grains.place[row].vector(), body.radius + body.offset + setup.mesh)
        })
        .collect();
    if near.is_empty() {
        return 0.0;
    }
    let is_near = |node: u32| {
        let place = barrier.nodes[node as usize].position;
        near.iter().any(|(centre, reach)| (place - centre).norm() < *reach)
    };
    let near: Vec<bool> = (0..barrier.nodes.len()).map(|node| is_near(node as u32)).collect();
    let substeps = simulation.sums.net_in_substeps();
    let largest = substeps.iter().map(|net| {
        let mut largest = 0.0;
        net.each_axial_member(barrier, |member, tension| {
            if member.kind == SegmentKind::Net && member.nodes.iter().any(|node| near[*node as usize]) {
                largest = larger_or_nan(largest, tension);
            }
        });
        largest
    });
    largest.sum::<f64>() / substeps.len() as f64
}
