//! How long a step may be, from what is really connected.
//!
//! The leapfrog with damping taken from the last half step is stable while Δt² K + 2 Δt C ≤ 4 M (for one oscillator:
//! Δt < (2/ω)(√(1+ζ²) − ζ)). K and C hold every contact, with its friction spring taken as sticking, every taut rope and
//! every dissipator. The fastest mode u comes from a power iteration that starts where most stiffness meets; with
//! k = uᵀKu, c = uᵀCu (u of unit mass) the critical step is the root of k Δt² + 2 c Δt = 4. The iteration approaches the
//! largest eigenvalue from below, so a margin is put on its result.

use serde::{Deserialize, Serialize};

use std::ops::Range;

use crate::Vec3;
use crate::tables::barrier::Barrier;
use crate::tables::grain_table::GrainTable;
use crate::time::inlet::burden_of;
use crate::time::links::{Link, Loop, Ties, Twist};
use crate::workers;

/// Rounds of the power iteration.
const ITERATIONS: usize = 16;
/// What is added to the largest eigenvalue for what the iteration may still have missed.
const MARGIN: f64 = 1.10;

/// Step over critical step, and whose mode is the fastest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepRatio {
    pub value: f64,
    /// Share of the mode's energy in the nodes of the barrier; the rest is in grains.
    pub in_barrier: f64,
}

/// Critical step (s) of two equal bodies in one contact: (2/ω)(√(1+ζ²) − ζ), ω² = k/m_r.
pub fn critical_step_of_pair(stiffness: f64, reduced_mass: f64, damping_ratio: f64) -> f64 {
    2.0 * (reduced_mass / stiffness).sqrt() * ((1.0 + damping_ratio * damping_ratio).sqrt() - damping_ratio)
}

/// Resistance of a body to motion.
#[derive(Clone, Copy, Debug)]
struct Inertia {
    /// 1/kg
    inverse_mass: f64,
    /// 1/I about the axis and across it (1/(kg m²)).
    inverse_axial: f64,
    inverse_transverse: f64,
    axis: Vec3,
}

impl Inertia {
    /// What force and torque do to the body.
    fn moved(&self, [force, torque]: &Twist) -> Twist {
        let along = self.axis * self.axis.dot(torque);
        let spin = torque * self.inverse_transverse + along * (self.inverse_axial - self.inverse_transverse);
        [force * self.inverse_mass, spin]
    }
}

/// Step over critical step of the given ties at a step (s); infinite if anything is not finite.
pub fn step_ratio(ties: &Ties, grains: &GrainTable, barrier: Option<&Barrier>, step: f64) -> StepRatio {
    let inertias = inertias(grains, barrier);
    let links = ties.links.as_slice();
    let groups = groups_of(links);
    let mut forces = first_forces(ties, &inertias);
    let mut motion = vec![[Vec3::zeros(); 2]; inertias.len()];
    let mut sheets: Vec<Vec<Twist>> = groups.iter().map(|_| vec![[Vec3::zeros(); 2]; inertias.len()]).collect();
    let (mut stiffness, mut damping) = (0.0, 0.0);
    let mut in_barrier = 0.0;
    for _ in 0..ITERATIONS {
        let size = next_motion(&forces, &inertias, &mut motion);
        if size == 0.0 {
            return StepRatio::default();
        }
        in_barrier = (energy_of(&motion[grains.len()..], &forces[grains.len()..]) / size).max(0.0);
        let works = workers::map(groups.iter().zip(&mut sheets), |_, (group, sheet)| {
            sheet.fill([Vec3::zeros(); 2]);
            strain(&links[group.clone()], &motion, step, sheet)
        });
        add_up(&sheets, &mut forces);
        let of_loops = strain_loops(&ties.loops, &motion, step, &mut forces);
        let sum = |part: usize| works.iter().chain([&of_loops]).map(|work| work[part]).sum::<f64>() / size;
        (stiffness, damping) = (sum(0), sum(1));
    }
    let (stiffness, damping) = (MARGIN * stiffness, MARGIN * damping);
    let critical = ((damping * damping + 4.0 * stiffness).sqrt() - damping) / stiffness;
    StepRatio { value: if critical.is_finite() { step / critical } else { f64::INFINITY }, in_barrier }
}

/// Groups into which the links are parted, at most; the number depends on the model alone, never on the threads.
const MOST_GROUPS: usize = 4;
/// Bodies that are handled in one go.
const BODIES_IN_PART: usize = 1024;

/// Neighbouring lists put together into groups of about as many links.
fn groups_of(links: &[Vec<Link>]) -> Vec<Range<usize>> {
    let all: usize = links.iter().map(Vec::len).sum();
    let share = all.div_ceil(MOST_GROUPS).max(1);
    let mut groups: Vec<Range<usize>> = Vec::new();
    let mut before = 0;
    for (number, list) in links.iter().enumerate() {
        let begun = groups.len();
        match groups.last_mut() {
            Some(last) if before / share < begun => last.end = number + 1,
            _ => groups.push(number..number + 1),
        }
        before += list.len();
    }
    groups
}

/// The motion that the forces give, and twice its energy, uᵀMu = uᵀF. Dividing by four keeps the numbers near one.
fn next_motion(forces: &[Twist], inertias: &[Inertia], motion: &mut [Twist]) -> f64 {
    let parts =
        motion.chunks_mut(BODIES_IN_PART).zip(forces.chunks(BODIES_IN_PART)).zip(inertias.chunks(BODIES_IN_PART));
    let energies = workers::map(parts, |_, ((motion, forces), inertias)| {
        for ((motion, force), inertia) in motion.iter_mut().zip(forces).zip(inertias) {
            *motion = inertia.moved(force).map(|part| part * 0.25);
        }
        energy_of(motion, forces)
    });
    energies.iter().sum()
}

fn energy_of(motion: &[Twist], forces: &[Twist]) -> f64 {
    motion.iter().zip(forces).map(|(motion, force)| 0.25 * work(motion, force)).sum::<f64>()
}

/// Puts the forces of Δt² K + 2 Δt C in the given motion onto `forces`; returns the works uᵀKu and uᵀCu.
fn strain(links: &[Vec<Link>], motion: &[Twist], step: f64, forces: &mut [Twist]) -> [f64; 2] {
    let mut works = [0.0; 2];
    for link in links.iter().flatten() {
        let parting = link.parting(motion);
        let [spring, dashpot] = link.pull(&parting);
        works[0] += work(&parting, &spring);
        works[1] += work(&parting, &dashpot);
        let force = [0, 1].map(|part| spring[part] * (step * step) + dashpot[part] * (2.0 * step));
        link.push(&force, forces);
    }
    works
}

/// The same for loops.
fn strain_loops(loops: &[Loop], motion: &[Twist], step: f64, forces: &mut [Twist]) -> [f64; 2] {
    let mut works = [0.0; 2];
    for one in loops {
        let growth = one.growth(motion);
        let [spring, dashpot] = one.pull(growth);
        works[0] += growth * spring;
        works[1] += growth * dashpot;
        one.push(spring * (step * step) + dashpot * (2.0 * step), forces);
    }
    works
}

/// Adds up the forces of all groups, in their order.
fn add_up(sheets: &[Vec<Twist>], forces: &mut [Twist]) {
    workers::for_each(forces.chunks_mut(BODIES_IN_PART), |part, forces| {
        let from = part * BODIES_IN_PART;
        for (row, force) in forces.iter_mut().enumerate() {
            *force = [Vec3::zeros(); 2];
            for sheet in sheets {
                let more = &sheet[from + row];
                *force = [0, 1].map(|part| force[part] + more[part]);
            }
        }
    });
}

/// Work of a force and torque in a motion.
fn work(motion: &Twist, force: &Twist) -> f64 {
    motion[0].dot(&force[0]) + motion[1].dot(&force[1])
}

/// Of all grains, then of all nodes.
fn inertias(grains: &GrainTable, barrier: Option<&Barrier>) -> Vec<Inertia> {
    let grain = grains.bodies.iter().enumerate().map(|(row, body)| {
        let burden = burden_of(grains, row);
        Inertia {
            inverse_mass: (body.mass * burden).recip(),
            inverse_axial: (body.inertia_axial * burden).recip(),
            inverse_transverse: (body.inertia_transverse * burden).recip(),
            axis: grains.axis.get(row).map_or(Vec3::zeros(), |axis| axis.vector()),
        }
    });
    let nodes = barrier.iter().flat_map(|barrier| {
        barrier.nodes.iter().enumerate().map(|(number, node)| {
            let turns = barrier.frames.get(number).filter(|frame| !frame.held);
            let inverse_inertia = turns.map_or(0.0, |frame| frame.inertia.recip());
            Inertia {
                inverse_mass: if node.fixed { 0.0 } else { node.mass.recip() },
                inverse_axial: inverse_inertia,
                inverse_transverse: inverse_inertia,
                axis: Vec3::zeros(),
            }
        })
    });
    grain.chain(nodes).collect()
}

/// Forces that are strong where much stiffness meets little mass, in directions that no symmetry can blind.
fn first_forces(ties: &Ties, inertias: &[Inertia]) -> Vec<Twist> {
    let mut strength = vec![0.0_f64; inertias.len()];
    for (body, stiffness) in ties.loops.iter().flat_map(Loop::ends) {
        strength[body as usize] += stiffness * inertias[body as usize].inverse_mass;
    }
    for link in ties.links.iter().flatten() {
        for end in link.ends() {
            let inertia = &inertias[end.body as usize];
            let yielding = inertia.inverse_mass + end.arm.norm_squared() * inertia.inverse_transverse;
            let turning = link.turning_trace() * inertia.inverse_transverse;
            strength[end.body as usize] += link.trace() * end.share * end.share * yielding + turning;
        }
    }
    let most = strength.iter().copied().fold(0.0, f64::max);
    // A NaN must not be lost in the largest of all.
    let scale = if strength.iter().any(|s| !s.is_finite()) { f64::NAN } else { most.max(f64::MIN_POSITIVE) };
    let bodies = strength.iter().zip(inertias).enumerate();
    bodies
        .map(|(number, (strength, inertia))| {
            let strength = (strength / scale).powi(4);
            // A fixed node does not move, and a node without cylinders does not turn.
            let against = |inverse: f64| if inverse == 0.0 { 0.0 } else { strength / inverse.sqrt() };
            let (force, torque) = (against(inertia.inverse_mass), against(inertia.inverse_transverse));
            [scattered(2 * number as u32) * force, scattered(2 * number as u32 + 1) * torque]
        })
        .collect()
}

/// A vector that differs without order from one number to the next, each entry between −1 and 1.
fn scattered(number: u32) -> Vec3 {
    let mut bits = number.wrapping_add(1).wrapping_mul(0x9e37_79b9);
    Vec3::from_fn(|_, _| {
        bits = (bits ^ (bits >> 15)).wrapping_mul(0x85eb_ca6b);
        bits = (bits ^ (bits >> 13)).wrapping_mul(0xc2b2_ae35);
        f64::from(bits) / f64::from(u32::MAX) * 2.0 - 1.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn pair_step_matches_the_tabulated_factor() {
        // Undamped 2/ω; with ζ = 0.497 a factor 0.620 shorter.
        assert_relative_eq!(critical_step_of_pair(4.0, 1.0, 0.0), 1.0);
        assert_relative_eq!(critical_step_of_pair(4.0, 1.0, 0.497239), 0.6196, max_relative = 1e-3);
    }
}
