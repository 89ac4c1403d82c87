//! What the scene looks like at a few moments: grains with their speed, the barrier with its tensions.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::segment::SegmentKind;
use crate::net::NetForces;
use crate::simulation::Simulation;
use crate::tables::barrier::Barrier;
use crate::tables::grains::Grain;
use crate::tables::surfaces::SurfaceRole;

/// The moments kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Moment {
    FirstContact,
    LargestForce,
    HalfAtRest,
    End,
}

/// The scene at one moment.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Snapshot {
    pub moment: Moment,
    /// s
    pub time: f64,
    pub balls: Vec<Ball>,
    pub axial_members: Vec<AxialMember>,
    /// Where grains touch the barrier: height above the bed (m), and force along the channel (N).
    pub touches: Vec<[f64; 2]>,
}

/// One sphere of a grain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ball {
    pub place: Vec3,
    /// m
    pub radius: f64,
    /// Of its grain (m/s).
    pub speed: f64,
}

/// A segment or cylinder of the barrier.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AxialMember {
    pub ends: [Vec3; 2],
    pub kind: SegmentKind,
    /// N
    pub tension: f64,
}

impl Snapshot {
    pub fn of(moment: Moment, simulation: &Simulation, grains: &[Grain]) -> Self {
        let barrier = simulation.model.barrier.as_ref().map(|barrier| (barrier, &simulation.sums.net));
        let ball = |grain: &Grain, side: f64| Ball {
            place: grain.position + grain.axis * (side * grain.body.offset),
            radius: grain.body.radius,
            speed: grain.velocity.norm(),
        };
        let balls = grains.iter().flat_map(|grain| {
            let sides: &[f64] = if grain.body.offset > 0.0 { &[-1.0, 1.0] } else { &[0.0] };
            sides.iter().map(move |side| ball(grain, *side))
        });
        Self {
            moment,
            time: simulation.time,
            balls: balls.collect(),
            axial_members: barrier.map_or_else(Vec::new, axial_members),
            touches: touches(simulation),
        }
    }
}

fn touches(simulation: &Simulation) -> Vec<[f64; 2]> {
    let walls = simulation.surface_contacts().filter(|contact| contact.role == SurfaceRole::Wall);
    let on_wall = walls.map(|contact| [contact.place.z, -contact.force.x]);
    let nodes = simulation.model.barrier.as_ref().map_or(&[][..], |barrier| &barrier.nodes);
    let pushes = simulation.neighbours.blocks.iter().flat_map(|block| &block.ropes.pushes);
    let on_net = pushes.map(|push| {
        let [a, b] = push.nodes.map(|node| nodes[node as usize].position.z);
        [a + (b - a) * push.share, push.force.x]
    });
    on_wall.chain(on_net).collect()
}

fn axial_members((barrier, net): (&Barrier, &NetForces)) -> Vec<AxialMember> {
    let mut axial_members = Vec::new();
    net.each_axial_member(barrier, |member, tension| {
        let ends = member.nodes.map(|node| barrier.nodes[node as usize].position);
        axial_members.push(AxialMember { ends, kind: member.kind, tension });
    });
    axial_members
}
