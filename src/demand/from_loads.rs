//! Guideline loads on the design's barrier: stages of filling, total force, share of each main rope.

use std::f64::consts::FRAC_PI_4;

use crate::design::{Arrival, BarrierDesign, Bottom, DamBreak, Design, FlexibleNet};
use crate::loads::rope::{RopeInput, RopeState};
use crate::loads::volkwein::{GuidelineInput, LoadCase, level_deposit_height};
use crate::units::GRAVITY;

/// Guideline loads and what follows for the ropes.
#[derive(Clone, Debug, PartialEq)]
pub struct Guideline {
    pub input: GuidelineInput,
    pub cases: Vec<LoadCase>,
    /// Largest total force over the stages (N).
    pub largest_force: f64,
    /// Worst state of each main rope over the stages, from the bottom, with the partial factor on loads; rope 1 is at
    /// rest when the bed holds it.
    pub ropes: Vec<RopeState>,
}

/// Depth of the wave at the gate over the height behind it (Ritter 1892).
const RITTER: f64 = 4.0 / 9.0;

pub fn guideline(design: &Design) -> Guideline {
    let input = input(design);
    let cases = input.cases();
    let largest = cases.iter().map(|case| case.force_per_width).fold(0.0, f64::max);
    let ropes = match &design.barrier {
        BarrierDesign::RigidWall(_) => Vec::new(),
        BarrierDesign::FlexibleNet(net) => rope_states(net, design, &input),
    };
    Guideline { input, cases, largest_force: largest * design.channel.width, ropes }
}

fn input(design: &Design) -> GuidelineInput {
    let (depth, velocity) = incoming(design);
    let slope = design.channel.slope;
    let level = level_deposit_height(design.flow.volume() / design.channel.width, slope, lean(design));
    GuidelineInput {
        density: design.flow.bulk_density,
        gravity_normal: GRAVITY * slope.cos(),
        earth_pressure: design.factors.earth_pressure,
        dynamic_pressure: design.factors.dynamic_pressure,
        depth,
        velocity,
        fill_height: height_over_bed(design).min(level.max(depth)),
    }
}

/// Height of the barrier's top above the bed, normal to it (m).
pub fn height_over_bed(design: &Design) -> f64 {
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.height,
        BarrierDesign::FlexibleNet(net) => {
            let gap = match net.bottom {
                Bottom::Fixed => 0.0,
                Bottom::Opening(gap) => gap,
            };
            net.height * (design.channel.slope + net.tilt).cos() + gap
        }
    }
}

/// Depth and velocity with which the flow reaches the barrier. A surge has them; for a dam break the designer
/// may give them, else the depth is Ritter's and the velocity that of a block sliding on the bed with its friction.
fn incoming(design: &Design) -> (f64, f64) {
    match design.flow.arrival {
        Arrival::Surge { depth, velocity, .. } => (depth, velocity),
        Arrival::DamBreak(block) => (
            block.depth_at_barrier.unwrap_or(RITTER * block.height),
            block.velocity_at_barrier.unwrap_or_else(|| sliding_velocity(design, &block)),
        ),
    }
}

/// √(2 a s) with a = g (sin α − tan φ cos α), s from the block's centre to the barrier.
fn sliding_velocity(design: &Design, block: &DamBreak) -> f64 {
    let slope = design.channel.slope;
    let acceleration = GRAVITY * (slope.sin() - design.channel.base_friction * slope.cos());
    (2.0 * acceleration.max(0.0) * (block.distance + 0.5 * block.length)).sqrt()
}

/// Angle by which the barrier leans upstream from the bed's normal (rad).
fn lean(design: &Design) -> f64 {
    match &design.barrier {
        BarrierDesign::RigidWall(_) => 0.0,
        BarrierDesign::FlexibleNet(net) => design.channel.slope + net.tilt,
    }
}

/// Each rope under the largest load on its tributary height, with the partial factor on loads. The lowest rope also
/// takes what an open gap below it would let through.
fn rope_states(net: &FlexibleNet, design: &Design, input: &GuidelineInput) -> Vec<RopeState> {
    let rope = net.main_ropes.rope;
    let span = RopeInput {
        span: design.channel.width,
        axial_stiffness: rope.modulus * FRAC_PI_4 * rope.diameter.powi(2),
        dissipator: net.dissipators.map(|dissipator| [dissipator.plateau, dissipator.stroke]),
    };
    let top = height_over_bed(design);
    let heights = &net.main_ropes.heights;
    let above_bed = |along: f64| top - (net.height - along) * lean(design).cos();
    let middle = |a: usize, b: usize| above_bed(0.5 * (heights[a] + heights[b]));
    (0..heights.len())
        .map(|index| {
            if index == 0 && net.bottom == Bottom::Fixed {
                return RopeState::default();
            }
            let low = if index == 0 { 0.0 } else { middle(index - 1, index) };
            let high = if index + 1 == heights.len() { f64::INFINITY } else { middle(index, index + 1) };
            span.under(design.factors.load * input.governing_strip_force(low, high))
        })
        .collect()
}
