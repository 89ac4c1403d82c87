//! What main, net and lateral ropes bear, and what shape the net takes.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::elements::segment::SegmentKind;
use crate::net::NetForces;
use crate::recorders::body::{BodyRecorder, add_shares, keep_larger, means};
use crate::recorders::channels::{Channel, Channels, Rows};
use crate::recorders::setup::RecorderSetup;
use crate::simulation::Simulation;
use crate::tables::barrier::Barrier;
use crate::{larger_or_nan, largest_or_nan};

/// Mean tension along each main rope; of one where several run side by side, here and below.
pub const MEAN: Channel = Channel { name: "rope_mean", unit: "n", rows: Rows::EachRope };
/// Largest tension along each main rope, its dissipators included.
pub const LARGEST: Channel = Channel { name: "rope_largest", unit: "n", rows: Rows::EachRope };
/// How far downstream the furthest point of each main rope is from where the rope hung at first.
pub const EXTENSION: Channel = Channel { name: "rope_extension", unit: "m", rows: Rows::EachRope };
/// Largest tension in the lateral ropes.
pub const LATERAL: Channel = Channel { name: "lateral_largest", unit: "n", rows: Rows::One };
/// Largest tension in the net's ropes; of a ring net, the force of a leg as that of a chain that is as near to breaking.
pub const NET: Channel = Channel { name: "net_largest", unit: "n", rows: Rows::One };
/// Largest tension in main ropes, net and lateral ropes at any instant of a sample; the others are means over it.
pub const LARGEST_AT_ONCE: Channel = Channel { name: "rope_largest_at_once", unit: "n", rows: Rows::EachRope };
pub const NET_AT_ONCE: Channel = Channel { name: "net_largest_at_once", unit: "n", rows: Rows::One };
pub const LATERAL_AT_ONCE: Channel = Channel { name: "lateral_largest_at_once", unit: "n", rows: Rows::One };
/// Pieces of rope, and rings of the net, that have broken so far.
pub const BROKEN: Channel = Channel { name: "broken_pieces", unit: "", rows: Rows::One };
/// Largest permanent elongation of a piece of rope so far, over its first length.
pub const DRAWN_OUT: Channel = Channel { name: "drawn_out", unit: "share", rows: Rows::One };
/// Lowest height of the top main rope above the bed.
pub const TOP_HEIGHT: Channel = Channel { name: "top_rope_height", unit: "m", rows: Rows::One };

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OfRopes {
    mean: Vec<f64>,
    largest: Vec<f64>,
    net: f64,
    lateral: f64,
    /// Largest at any instant: of each rope, of the net and the lateral ropes.
    at_once: Vec<f64>,
    net_and_lateral_at_once: [f64; 2],
    /// What pulls or pushes along a line, made anew for each sample.
    #[serde(skip)]
    groups: Vec<Group>,
}

/// Neighbours in the order of [`Barrier::axial_members`] that belong to the same part of the barrier.
#[derive(Clone, Debug)]
struct Group {
    kind: SegmentKind,
    members: Range<usize>,
    /// Unloaded length of each, of main ropes (m); 0 for a dissipator, which is no part of its rope.
    lengths: Vec<f64>,
}

impl Group {
    /// Takes the lengths anew, which change as ropes slide through their rings.
    fn measure(&mut self, barrier: &Barrier) {
        if matches!(self.kind, SegmentKind::Main(_)) {
            self.lengths.clear();
            self.lengths.extend(self.members.clone().map(|member| barrier.rest_length(member).unwrap_or(0.0)));
        }
    }
}

fn groups_of(barrier: &Barrier) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (place, member) in barrier.axial_members().enumerate() {
        match groups.last_mut().filter(|last| last.kind == member.kind) {
            Some(last) => last.members.end += 1,
            None => groups.push(Group { kind: member.kind, members: place..place + 1, lengths: Vec::new() }),
        }
    }
    groups
}

impl BodyRecorder for OfRopes {
    fn add_step(&mut self, simulation: &Simulation, setup: &RecorderSetup) {
        let Some(barrier) = &simulation.model.barrier else { return };
        let mut groups = std::mem::take(&mut self.groups);
        if groups.is_empty() {
            groups = groups_of(barrier);
        }
        groups.iter_mut().for_each(|group| group.measure(barrier));
        let substeps = simulation.sums.net_in_substeps();
        substeps.iter().for_each(|net| self.add_substep(net, barrier, &groups, setup.ropes, substeps.len()));
        self.groups = groups;
    }

    fn sample(&mut self, simulation: &Simulation, setup: &RecorderSetup, steps: u32, channels: &mut Channels) {
        let Some(barrier) = &simulation.model.barrier else { return };
        let done = std::mem::take(self);
        channels.push(&MEAN, &means(&done.mean, steps));
        channels.push(&LARGEST, &means(&done.largest, steps));
        channels.push(&NET, &means(&[done.net], steps));
        channels.push(&LATERAL, &means(&[done.lateral], steps));
        channels.push(&LARGEST_AT_ONCE, &done.at_once);
        let [net, lateral] = done.net_and_lateral_at_once;
        channels.push(&NET_AT_ONCE, &[net]);
        channels.push(&LATERAL_AT_ONCE, &[lateral]);
        let [broken, drawn_out] = wear(barrier);
        channels.push(&BROKEN, &[broken]);
        channels.push(&DRAWN_OUT, &[drawn_out]);
        let extension = |(&row, &place): (&usize, &f64)| {
            let nodes = setup.net_rows[row].iter().map(|&node| barrier.nodes[node as usize].position.x - place);
            nodes.fold(0.0, larger_or_nan)
        };
        let extensions: Vec<f64> = setup.rope_rows.iter().zip(&setup.rope_places).map(extension).collect();
        channels.push(&EXTENSION, &extensions);
        let top = setup.net_rows.last().into_iter().flatten();
        let lowest = top.map(|&node| barrier.nodes[node as usize].position.z).fold(f64::INFINITY, f64::min);
        channels.push(&TOP_HEIGHT, &[lowest]);
    }
}

impl OfRopes {
    /// Takes in one of the substeps of a step.
    fn add_substep(&mut self, net: &NetForces, barrier: &Barrier, groups: &[Group], ropes: usize, substeps: usize) {
        let (mut mean, mut largest) = (vec![[0.0, 0.0]; ropes], vec![0.0_f64; ropes]);
        let (mut net_largest, mut lateral) = (0.0_f64, 0.0_f64);
        let all: Vec<f64> = net.axial_tensions().collect();
        for Group { kind, members, lengths } in groups {
            let (tensions, sharing) = (&all[members.clone()], barrier.sharing(*kind));
            let most = match *kind {
                SegmentKind::Main(rope) => {
                    let [weighted, length] = &mut mean[rope as usize];
                    *weighted +=
                        tensions.iter().zip(lengths).map(|(tension, length)| tension * length).sum::<f64>() / sharing;
                    *length += lengths.iter().sum::<f64>();
                    &mut largest[rope as usize]
                }
                SegmentKind::Net => &mut net_largest,
                SegmentKind::Lateral => &mut lateral,
                SegmentKind::Ring | SegmentKind::Retaining(_) | SegmentKind::Post(_) => continue,
            };
            *most = larger_or_nan(*most, largest_or_nan(tensions) / sharing);
        }
        let mean: Vec<f64> = mean.iter().map(|[weighted, length]| weighted / length).collect();
        add_shares(&mut self.mean, &mean, substeps);
        add_shares(&mut self.largest, &largest, substeps);
        self.net += net_largest / substeps as f64;
        self.lateral += lateral / substeps as f64;
        keep_larger(&mut self.at_once, &largest);
        let [net_at_once, lateral_at_once] = self.net_and_lateral_at_once;
        self.net_and_lateral_at_once =
            [larger_or_nan(net_at_once, net_largest), larger_or_nan(lateral_at_once, lateral)];
    }
}

/// How many pieces of rope and rings of the net have broken, and the largest permanent elongation of one over its first length.
fn wear(barrier: &Barrier) -> [f64; 2] {
    let torn = barrier.net_rings.iter().filter(|ring| ring.strength.broken).count();
    barrier.strengths().fold([torn as f64, 0.0], |[broken, drawn_out], strength| {
        let elongation = strength.drawn_out / strength.first_length;
        [broken + f64::from(u8::from(strength.broken)), larger_or_nan(drawn_out, elongation)]
    })
}
