//! Several steps of the barrier within one step of the grains.
//!
//! The stiff, light parts of a barrier (short cylinders, rings) need shorter steps than grains do. So forces are parted: those of
//! the grains act on the nodes as one impulse F Δt at the start of a step Δt of the grains, those within the barrier act in each
//! of its m steps of Δt/m (the impulse method, r-RESPA, of Tuckerman, Berne & Martyna 1992). For m = 1 this is the
//! leapfrog itself. Grains feel the mean velocity of the nodes over their step, so that the way a contact slips is the way the
//! bodies have really gone.
//!
//! Such a method can resonate where a mode of the barrier swings with a whole number of half periods in a step of the grains, even
//! when both steps are short enough for themselves. What damps such modes here is the damping of the elements; what
//! would notice is the energy account.

use crate::contact::law::LawConstants;
use crate::contact::ropes::Push;
use crate::ledger::MotionEnergy;
use crate::net::{NetForces, pull_all};
use crate::tables::barrier::Barrier;
use crate::tables::nodes::{Frame, Node};
use crate::time::integrate::{Stretch, move_nodes, turn_frames};
use crate::{Vec3, larger_or_nan};

/// What a step of the grains made of the barrier.
#[derive(Clone, Debug, Default)]
pub struct BarrierStep {
    /// Forces and tensions, mean over the step; energy stored, at its start.
    pub net: NetForces,
    /// Motion at the start of the step, where it was asked for.
    pub motion: MotionEnergy,
    /// Largest mean speed of a node (m/s).
    pub fastest: f64,
    /// Lost in the parts after the first, which belong to the time after the instant of `motion`: in ropes, by rings, in
    /// dissipators (J).
    pub lost_later: [f64; 3],
}

/// Moves the barrier through one step of the grains, in `parts` steps of its own. `net` holds the forces at the start; `law` the
/// barrier's own step; `account` asks for the energy of its motion.
pub fn step_barrier<'a>(
    barrier: &mut Barrier,
    net: NetForces,
    pushes: impl Iterator<Item = &'a Push>,
    law: &LawConstants,
    time: &Stretch,
    parts: u32,
    account: bool,
) -> BarrierStep {
    let own = Stretch { step: time.step / f64::from(parts), ..*time };
    let several = parts > 1;
    let before: Vec<Vec3> = barrier.nodes.iter().filter(|_| several).map(|node| node.position).collect();
    let mut first = net;
    pushes.for_each(|push| first.push(push, f64::from(parts)));
    let at_start = account.then(|| (barrier.nodes.clone(), barrier.frames.clone()));
    // The impulse of the grains acts at once, that of gravity and of the elements over the first part.
    first.take_over(barrier);
    go(barrier, &first, &own);
    let motion = at_start
        .map_or(MotionEnergy::default(), |(nodes, frames)| motion_since(&nodes, &frames, barrier, &time.gravity));
    let mut lost_later = [0.0; 3];
    for _ in 1..parts {
        let later = pull_all(barrier, law);
        later.take_over(barrier);
        go(barrier, &later, &own);
        first.go_on(&later);
        lost_later.iter_mut().zip(later.losses()).for_each(|(sum, lost)| *sum += lost);
    }
    first.share_out(parts);
    let fastest = if several { note_paces(barrier, &before, time.step) } else { note_velocities(barrier) };
    BarrierStep { net: first, motion, fastest, lost_later }
}

/// Moves nodes and frames through one step.
fn go(barrier: &mut Barrier, net: &NetForces, own: &Stretch) {
    move_nodes(&mut barrier.nodes, &net.forces, &own.gravity, own.step);
    turn_frames(&mut barrier.frames, &net.torques, own.step);
}

/// Energies of motion and place at the instant between `nodes` and `frames` as they moved before it and the barrier as it moves now.
fn motion_since(nodes: &[Node], frames: &[Frame], barrier: &Barrier, gravity: &Vec3) -> MotionEnergy {
    let mut sums = MotionEnergy::default();
    for (before, after) in nodes.iter().zip(&barrier.nodes).filter(|(node, _)| !node.fixed) {
        sums.kinetic += 0.5 * before.mass * before.velocity.dot(&after.velocity);
        sums.potential -= before.mass * gravity.dot(&before.position);
    }
    for (before, after) in frames.iter().zip(&barrier.frames).filter(|(frame, _)| !frame.held) {
        let turning = 0.5 * before.inertia * before.spin.dot(&after.spin);
        sums.kinetic += turning;
        sums.rotational += turning;
    }
    sums
}

/// Notes the mean velocities over the step; returns the largest speed (m/s).
fn note_paces(barrier: &mut Barrier, before: &[Vec3], step: f64) -> f64 {
    let mut fastest = 0.0;
    for (node, before) in barrier.nodes.iter_mut().zip(before) {
        node.pace = (node.position - before) / step;
        fastest = larger_or_nan(fastest, node.pace.norm_squared());
    }
    fastest.sqrt()
}

/// The same where the barrier has taken a single step.
fn note_velocities(barrier: &mut Barrier) -> f64 {
    let fastest = barrier.nodes.iter_mut().fold(0.0, |fastest, node| {
        node.pace = node.velocity;
        larger_or_nan(fastest, node.pace.norm_squared())
    });
    fastest.sqrt()
}
