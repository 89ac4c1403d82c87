//! The push of the grains at rest on a rigid wall, from the static equilibrium of the zone they form.
//!
//! The zone of weight G rests on a bed at slope α with the reaction R₁ and leans on the wall normal to the bed with R₂. With
//! δ₁ = atan(R₁t/R₁n) and δ₂ = atan(R₂t/R₂n), both positive where friction holds the zone back (up the slope, and up the
//! wall), equilibrium gives the normal part of R₂:
//!
//! F_g = G sin(α − δ₁) cos δ₂ / cos(δ₁ + δ₂)
//!
//! (Albaba 2015, section 3.3.3, with the vertical equilibrium corrected). What is more than F_g on the wall is due to the
//! moving flow. Friction on side walls is left out, so F_g is too large by what they hold.

use crate::Vec3;
use crate::simulation::Simulation;
use crate::tables::grains::Grain;
use crate::tables::surfaces::SurfaceRole;

/// F_g of the grains that are `dead` (N); `grains` are those of the simulation in the order of its rows.
pub fn push_at_rest(simulation: &Simulation, grains: &[Grain], dead: &[bool]) -> f64 {
    let gravity = simulation.model.gravity;
    let mass: f64 = grains.iter().zip(dead).filter(|(_, dead)| **dead).map(|(grain, _)| grain.body.mass).sum();
    let (mut base, mut wall) = (Vec3::zeros(), Vec3::zeros());
    for contact in simulation.surface_contacts() {
        if !dead[contact.row] {
            continue;
        }
        match contact.role {
            SurfaceRole::Base => base += contact.force,
            SurfaceRole::Wall => wall += contact.force,
            SurfaceRole::Side | SurfaceRole::Gate => {}
        }
    }
    let slope = libm::atan2(gravity.x, -gravity.z);
    // On the grains: the base pushes up (z) and holds back (−x); the wall pushes back (−x) and holds up (z).
    let base_angle = libm::atan2(-base.x, base.z);
    let wall_angle = if wall.x == 0.0 { 0.0 } else { libm::atan(wall.z / -wall.x) };
    let weight = mass * gravity.norm();
    if base.z <= 0.0 || mass == 0.0 {
        return 0.0;
    }
    weight * libm::sin(slope - base_angle) * libm::cos(wall_angle) / libm::cos(base_angle + wall_angle)
}

/// Forces along the channel with which grains at rest and moving grains touch the barrier at this instant (N).
pub fn pushes_by_state(simulation: &Simulation, dead: &[bool]) -> [f64; 2] {
    let walls = simulation.surface_contacts().filter(|contact| contact.role == SurfaceRole::Wall);
    let on_wall = walls.map(|contact| (contact.row, -contact.force.x));
    let ropes = simulation.neighbours.blocks.iter().flat_map(|block| &block.ropes.pushes);
    let on_net = ropes.map(|push| (push.row as usize, push.force.x));
    let mut sums = [0.0; 2];
    for (row, force) in on_wall.chain(on_net) {
        sums[usize::from(!dead[row])] += force;
    }
    sums
}
