//! What holds the barrier: the anchors of the main ropes, and the bolts of a lowest rope that lies on the bed.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::elements::segment::SegmentKind;
use crate::larger_or_nan;
use crate::recorders::body::{BodyRecorder, add_shares, keep_larger, means};
use crate::recorders::bolts::BoltedRope;
use crate::recorders::channels::{Channel, Channels, Rows};
use crate::recorders::setup::RecorderSetup;
use crate::simulation::Simulation;
use crate::tables::barrier::Barrier;

/// Load of the higher loaded anchor of each main rope; where several ropes run side by side each has its own, and takes its share.
pub const LOAD: Channel = Channel { name: "anchor", unit: "n", rows: Rows::EachRope };
/// The same at any instant of a sample.
pub const LOAD_AT_ONCE: Channel = Channel { name: "anchor_at_once", unit: "n", rows: Rows::EachRope };
/// Force on each anchor in the channel frame; where several ropes run side by side that on the anchor of one.
pub const EACH: [Channel; 3] = [
    Channel { name: "anchor_x", unit: "n", rows: Rows::EachAnchor },
    Channel { name: "anchor_y", unit: "n", rows: Rows::EachAnchor },
    Channel { name: "anchor_z", unit: "n", rows: Rows::EachAnchor },
];
/// Force on what holds the lowest main rope to the bed.
pub const BED: Channel = Channel { name: "bed_force", unit: "n", rows: Rows::One };
/// Largest force on one of the bolts that hold the lowest main rope to the bed, the same at any instant of a sample, and the largest lift of one;
/// not recorded where their distance is not known.
pub const BOLT: Channel = Channel { name: "bolt_largest", unit: "n", rows: Rows::One };
pub const BOLT_AT_ONCE: Channel = Channel { name: "bolt_largest_at_once", unit: "n", rows: Rows::One };
pub const BOLT_LIFT: Channel = Channel { name: "bolt_lift", unit: "n", rows: Rows::One };
/// Largest force on that rope in one of the spaces between its bolts, and the same at any instant of a sample; likewise.
pub const SPACE: Channel = Channel { name: "bolt_space_largest", unit: "n", rows: Rows::One };
pub const SPACE_AT_ONCE: Channel = Channel { name: "bolt_space_largest_at_once", unit: "n", rows: Rows::One };

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OfAnchors {
    load: Vec<f64>,
    each: Vec<Vec3>,
    bed: Vec3,
    bolts: Vec<Vec3>,
    spaces: Vec<Vec3>,
    /// Largest at any instant: load of each rope's anchor, force on a bolt, and on the rope in a space between bolts.
    at_once: Vec<f64>,
    bolt_at_once: f64,
    space_at_once: f64,
}

impl BodyRecorder for OfAnchors {
    fn add_step(&mut self, simulation: &Simulation, setup: &RecorderSetup) {
        let (Some(barrier), forces) = (&simulation.model.barrier, &simulation.sums.net.forces) else { return };
        self.bed += bed_force(barrier, forces, &setup.net_rows);
        let substeps = simulation.sums.net_in_substeps();
        for net in substeps {
            let loads = anchor_loads(barrier, &net.forces, setup.ropes);
            add_shares(&mut self.load, &loads, substeps.len());
            keep_larger(&mut self.at_once, &loads);
        }
        self.each.resize(barrier.anchors.len(), Vec3::zeros());
        for (sum, anchor) in self.each.iter_mut().zip(&barrier.anchors) {
            *sum += forces[anchor.node as usize] / barrier.sharing(anchor.kind);
        }
        if setup.bolt_spaces > 0 {
            let BoltedRope { bolts, spaces } = bolted_rope(barrier, setup, forces);
            for (sums, loads) in [(&mut self.bolts, &bolts), (&mut self.spaces, &spaces)] {
                sums.resize(loads.len(), Vec3::zeros());
                sums.iter_mut().zip(loads).for_each(|(sum, load)| *sum += load);
            }
            for net in substeps {
                let BoltedRope { bolts, spaces } = bolted_rope(barrier, setup, &net.forces);
                for (largest, loads) in [(&mut self.bolt_at_once, &bolts), (&mut self.space_at_once, &spaces)] {
                    *largest = loads.iter().map(Vec3::norm).fold(*largest, larger_or_nan);
                }
            }
        }
    }

    fn sample(&mut self, simulation: &Simulation, setup: &RecorderSetup, steps: u32, channels: &mut Channels) {
        if simulation.model.barrier.is_none() {
            return;
        }
        let done = std::mem::take(self);
        channels.push(&LOAD, &means(&done.load, steps));
        channels.push(&LOAD_AT_ONCE, &done.at_once);
        for (axis, channel) in EACH.iter().enumerate() {
            let along: Vec<f64> = done.each.iter().map(|force| force[axis]).collect();
            channels.push(channel, &means(&along, steps));
        }
        channels.push(&BED, &means(&[done.bed.norm()], steps));
        if setup.bolt_spaces > 0 {
            let most =
                |loads: &[Vec3], of: fn(&Vec3) -> f64| means(&[loads.iter().map(of).fold(0.0, larger_or_nan)], steps);
            channels.push(&BOLT, &most(&done.bolts, |load| load.norm()));
            channels.push(&BOLT_AT_ONCE, &[done.bolt_at_once]);
            channels.push(&BOLT_LIFT, &most(&done.bolts, |load| load.z));
            channels.push(&SPACE, &most(&done.spaces, |load| load.norm()));
            channels.push(&SPACE_AT_ONCE, &[done.space_at_once]);
        }
    }
}

/// Force on the fixed knots of the lowest row: what the bolts of a rope held by the bed must bear (N).
fn bed_force(barrier: &Barrier, forces: &[Vec3], rows: &[Vec<u32>]) -> Vec3 {
    let lowest = rows.first().into_iter().flatten().map(|&node| node as usize);
    lowest.filter(|&node| barrier.nodes[node].fixed).map(|node| forces[node]).sum()
}

/// Load of each rope's higher loaded anchor: the vector sum of all that is tied to it.
fn anchor_loads(barrier: &Barrier, forces: &[Vec3], ropes: usize) -> Vec<f64> {
    let mut loads = vec![0.0_f64; ropes];
    for anchor in &barrier.anchors {
        let SegmentKind::Main(rope) = anchor.kind else { continue };
        let load = &mut loads[usize::from(rope)];
        *load = larger_or_nan(*load, forces[anchor.node as usize].norm() / barrier.sharing(anchor.kind));
    }
    loads
}

/// The lowest rope between its bolts.
fn bolted_rope(barrier: &Barrier, setup: &RecorderSetup, forces: &[Vec3]) -> BoltedRope {
    let lowest = setup.net_rows.first().into_iter().flatten().map(|&node| node as usize);
    let held = lowest.filter(|&node| barrier.nodes[node].fixed);
    let knots = held.map(|node| (barrier.nodes[node].position.y, forces[node]));
    BoltedRope::of(knots, setup.bolt_spaces, setup.bolted)
}
