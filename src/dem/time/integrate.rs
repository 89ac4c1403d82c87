//! Leapfrog integration of grains and barrier nodes.

use crate::dem::Vec3;
use crate::dem::tables::barrier::Node;
use crate::dem::tables::grains::{Grain, Member, MemberLoad, place_members};

/// Sums over the grains of one block after a step, for the energy account.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionSums {
    /// Kinetic energy at the new half step (J).
    pub kinetic: f64,
    /// Its rotational part (J).
    pub rotational: f64,
    /// Gravity potential at the old full step (J).
    pub potential: f64,
}

impl MotionSums {
    pub fn add(&mut self, other: &Self) {
        self.kinetic += other.kinetic;
        self.rotational += other.rotational;
        self.potential += other.potential;
    }
}

/// Moves one block of grains through one step and rewrites its members.
///
/// v(t+½) = v(t−½) + Δt (F/m + g), x(t+Δt) = x(t) + Δt v(t+½), L(t+½) = L(t−½) + Δt T. The axis of a free
/// axisymmetric body turns about its angular momentum at the rate |L|/I_t exactly, so free rotation keeps
/// both momentum and energy to rounding. `drag` (1/s) slows everything down; it is zero but in preparation.
pub fn move_grains(
    grains: &mut [Grain],
    members: &mut [Member],
    loads: &[MemberLoad],
    gravity: &Vec3,
    time: Stretch,
) -> MotionSums {
    let per_grain = loads.len() / grains.len().max(1);
    let mut sums = MotionSums::default();
    let keep = (1.0 - time.drag * time.step).max(0.0);
    let rows = grains.iter_mut().zip(members.chunks_exact_mut(per_grain)).zip(loads.chunks_exact(per_grain));
    for ((grain, members), loads) in rows {
        let (force, torque) = resultant(grain, loads);
        sums.potential -= grain.body.mass * gravity.dot(&grain.position);
        grain.velocity = (grain.velocity + (force * grain.body.inverse[0] + gravity) * time.step) * keep;
        grain.angular_momentum = (grain.angular_momentum + torque * time.step) * keep;
        let rotational = 0.5 * grain.spin().dot(&grain.angular_momentum);
        sums.rotational += rotational;
        sums.kinetic += 0.5 * grain.body.mass * grain.velocity.norm_squared() + rotational;
        grain.position += grain.velocity * time.step;
        if grain.body.offset > 0.0 {
            turn_axis(grain, time.step);
        }
        place_members(grain, members);
    }
    sums
}

/// The stretch of time a step covers, and the drag during it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// s
    pub step: f64,
    /// 1/s
    pub drag: f64,
}

/// Force and torque about the grain's centre from its members' loads.
#[inline(always)]
fn resultant(grain: &Grain, loads: &[MemberLoad]) -> (Vec3, Vec3) {
    let vector = |row: &[f64; 4]| Vec3::new(row[0], row[1], row[2]);
    match loads {
        [only] => (vector(&only.force), vector(&only.torque)),
        [front, back] => {
            let (f, b) = (vector(&front.force), vector(&back.force));
            let arm = grain.axis * grain.body.offset;
            (f + b, vector(&front.torque) + vector(&back.torque) + arm.cross(&(f - b)))
        }
        _ => (Vec3::zeros(), Vec3::zeros()),
    }
}

/// Turns the axis about the angular momentum by the angle of one step (Rodrigues).
#[inline(always)]
fn turn_axis(grain: &mut Grain, step: f64) {
    let momentum = grain.angular_momentum;
    let magnitude = momentum.norm();
    if magnitude == 0.0 {
        return;
    }
    let line = momentum / magnitude;
    // Sine and cosine from their series: the angle of one step is small, and the result is the same on
    // every machine, which the system's library does not promise.
    let angle = magnitude * grain.body.inverse[2] * step;
    let half = small_tangent(0.5 * angle);
    let scale = 1.0 / (1.0 + half * half);
    let (sine, one_minus_cosine) = (2.0 * half * scale, 2.0 * half * half * scale);
    let axis = grain.axis;
    let turned = axis + line.cross(&axis) * sine + line.cross(&line.cross(&axis)) * one_minus_cosine;
    grain.axis = turned * (1.5 - 0.5 * turned.norm_squared());
}

/// tan x by its series up to x⁷; the rotation built from it is exact in length for any argument.
#[inline(always)]
fn small_tangent(x: f64) -> f64 {
    let square = x * x;
    x * (1.0 + square * (1.0 / 3.0 + square * (2.0 / 15.0 + square * (17.0 / 315.0))))
}

/// Moves the nodes of a barrier through one step; returns their kinetic energy at the new half step (J) and
/// their gravity potential at the old full step (J).
pub fn move_nodes(nodes: &mut [Node], forces: &[Vec3], gravity: &Vec3, step: f64) -> MotionSums {
    let mut sums = MotionSums::default();
    for (node, force) in nodes.iter_mut().zip(forces) {
        if node.fixed {
            continue;
        }
        sums.potential -= node.mass * gravity.dot(&node.position);
        node.velocity += (force / node.mass + gravity) * step;
        sums.kinetic += 0.5 * node.mass * node.velocity.norm_squared();
        node.position += node.velocity * step;
    }
    sums
}
