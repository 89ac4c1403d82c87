//! How long a step may be, from what is really connected.
//!
//! The leapfrog with damping taken from the last half step is stable while Δt² K + 2 Δt C ≤ 4 M (for one oscillator:
//! Δt < (2/ω)(√(1+ζ²) − ζ)). K and C hold every contact, with its friction spring taken as sticking, every taut rope and
//! every dissipator. The fastest mode u comes from a power iteration that starts where most stiffness meets; with
//! k = uᵀKu, c = uᵀCu (u of unit mass) the critical step is the root of k Δt² + 2 c Δt = 4. The iteration approaches the
//! largest eigenvalue from below, so a margin is put on its result.

use nalgebra::Matrix3;

use crate::dem::Vec3;
use crate::dem::contact::law::{LawConstants, Spring};
use crate::dem::contact::pair_list::Separation;
use crate::dem::contact::ropes::{OnRopes, RopeContext, touch as touch_rope};
use crate::dem::neighbours::blocks::Block;
use crate::dem::neighbours::clocks::Clock;
use crate::dem::tables::barrier::Barrier;
use crate::dem::tables::grain_table::GrainTable;
use crate::dem::tables::surfaces::Surface;

/// Rounds of the power iteration.
const ITERATIONS: usize = 16;
/// What is added to the largest eigenvalue for what the iteration may still have missed.
const MARGIN: f64 = 1.10;

/// All that an audit looks at.
pub struct Audit<'a> {
    pub grains: &'a GrainTable,
    pub surfaces: &'a [Surface],
    pub barrier: Option<&'a Barrier>,
    pub blocks: &'a [Block],
    pub law: LawConstants,
    pub modulus: f64,
    pub friction: f64,
}

/// Step over critical step, and whose mode is the fastest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepRatio {
    pub value: f64,
    /// Share of the mode's energy in the nodes of the barrier; the rest is in grains.
    pub in_barrier: f64,
}

/// Critical step (s) of two equal bodies in one contact: (2/ω)(√(1+ζ²) − ζ), ω² = k/m_r.
pub fn critical_step_of_pair(stiffness: f64, reduced_mass: f64, damping_ratio: f64) -> f64 {
    2.0 * (reduced_mass / stiffness).sqrt() * ((1.0 + damping_ratio * damping_ratio).sqrt() - damping_ratio)
}

/// Velocity and spin of a body, scaled by the roots of mass and inertia.
type Modal = [Vec3; 2];

/// One body's end of a link: its number, the share of the link it takes (with sign), the arm to it, and what scales its
/// velocity and spin.
struct End {
    body: usize,
    linear: f64,
    /// −[arm]× I^(−½), or zero.
    lever: Matrix3<f64>,
}

/// A spring and dashpot between two or three bodies, or a body and the ground.
struct Link {
    ends: Vec<End>,
    /// K as a tensor on the relative displacement (N/m).
    stiffness: Matrix3<f64>,
    /// C (N s/m)
    damping: Matrix3<f64>,
}

impl End {
    fn moves(&self, mode: &[Modal]) -> Vec3 {
        let [velocity, spin] = &mode[self.body];
        velocity * self.linear + self.lever * spin
    }

    fn push(&self, force: &Vec3, onto: &mut [Modal]) {
        let [velocity, spin] = &mut onto[self.body];
        *velocity += force * self.linear;
        *spin += self.lever.tr_mul(force);
    }
}

impl Audit<'_> {
    /// Step over critical step with the contacts of the last step; infinite if anything is not finite.
    pub fn ratio(&self) -> StepRatio {
        let links = self.links();
        let nodes = self.barrier.map_or(0, |barrier| barrier.nodes.len());
        let mut mode = first_guess(&links, self.grains.len() + nodes);
        let step = self.law.time_step;
        let (mut stiffness, mut damping) = (0.0, 0.0);
        for _ in 0..ITERATIONS {
            let size = mode.iter().map(|[a, b]| a.norm_squared() + b.norm_squared()).sum::<f64>();
            if size == 0.0 {
                return StepRatio::default();
            }
            let mut next = vec![[Vec3::zeros(); 2]; mode.len()];
            (stiffness, damping) = (0.0, 0.0);
            for link in &links {
                let relative: Vec3 = link.ends.iter().map(|end| end.moves(&mode)).sum();
                let (spring, dashpot) = (link.stiffness * relative, link.damping * relative);
                stiffness += relative.dot(&spring) / size;
                damping += relative.dot(&dashpot) / size;
                let force = spring * (step * step) + dashpot * (2.0 * step);
                link.ends.iter().for_each(|end| end.push(&force, &mut next));
            }
            // Dividing by four keeps the numbers near one; the size is taken out above.
            mode = next;
            mode.iter_mut().flatten().for_each(|part| *part *= 0.25);
        }
        let (stiffness, damping) = (MARGIN * stiffness, MARGIN * damping);
        let critical = ((damping * damping + 4.0 * stiffness).sqrt() - damping) / stiffness;
        let value = if critical.is_finite() { step / critical } else { f64::INFINITY };
        StepRatio { value, in_barrier: energy_share(&mode, self.grains.len()) }
    }

    fn links(&self) -> Vec<Link> {
        let mut links = Vec::new();
        for block in self.blocks {
            self.add_pairs(block, &mut links);
            self.add_surfaces(block, &mut links);
            self.add_ropes(block, &mut links);
        }
        if let Some(barrier) = self.barrier {
            self.add_elements(barrier, &mut links);
        }
        links
    }

    fn add_pairs(&self, block: &Block, links: &mut Vec<Link>) {
        for &[first, second] in block.inner.touching.iter().chain(&block.border.touching) {
            let (a, b) = (self.grains.rows().member(first as usize), self.grains.rows().member(second as usize));
            let line = b.centre - a.centre;
            let distance = line.norm();
            if distance >= a.radius + b.radius {
                continue;
            }
            let normal = line / distance;
            let stiffness = 2.0 * self.modulus * a.radius * b.radius / (a.radius + b.radius);
            let foot = a.centre + normal * (0.5 * (distance + a.radius - b.radius));
            let ends = vec![self.grain_end(first, &foot, -1.0), self.grain_end(second, &foot, 1.0)];
            links.push(self.contact(ends, &normal, stiffness, a.inverse_mass + b.inverse_mass));
        }
    }

    fn add_surfaces(&self, block: &Block, links: &mut Vec<Link>) {
        for &[index, surface] in &block.surfaces.touching {
            let member = self.grains.rows().member(index as usize);
            let foot = self.surfaces[surface as usize].nearest(&member.centre);
            let towards = foot - member.centre;
            let distance = towards.norm();
            if distance < member.radius && distance > 0.0 {
                let ends = vec![self.grain_end(index, &foot, 1.0)];
                let stiffness = self.modulus * member.radius;
                links.push(self.contact(ends, &(towards / distance), stiffness, member.inverse_mass));
            }
        }
    }

    fn add_ropes(&self, block: &Block, links: &mut Vec<Link>) {
        let Some(barrier) = self.barrier else { return };
        let context = RopeContext {
            grains: self.grains.rows(),
            barrier,
            law: self.law,
            grain_modulus: self.modulus,
            grain_friction: self.friction,
            clock: Clock::default(),
        };
        let on_ropes = OnRopes { grains: self.grains.rows(), barrier };
        for &[index, segment] in &block.ropes.list.touching {
            if on_ropes.gap([index, segment]) >= 0.0 {
                continue;
            }
            let member = self.grains.rows().member(index as usize);
            let Some(contact) = touch_rope(&member, segment, &context) else {
                continue;
            };
            let nodes = barrier.segments[segment as usize].nodes;
            let mut ends = vec![self.grain_end(index, &contact.foot, -1.0)];
            ends.extend(self.node_end(barrier, nodes[0], 1.0 - contact.share));
            ends.extend(self.node_end(barrier, nodes[1], contact.share));
            let normal = Vec3::from(contact.point.normal);
            links.push(self.contact(ends, &normal, contact.point.spring.stiffness, contact.inverse_mass));
        }
    }

    fn add_elements(&self, barrier: &Barrier, links: &mut Vec<Link>) {
        let ropes = barrier.segments.iter().map(|s| (s.nodes, s.stiffness, s.damping, s.rest_length));
        let brakes = barrier.dissipators.iter().map(|d| (d.nodes, d.stiffness, 0.0, d.rest_length + d.used));
        for (nodes, stiffness, damping, slack) in ropes.chain(brakes) {
            let [a, b] = nodes.map(|node| &barrier.nodes[node as usize]);
            let line = b.position - a.position;
            let length = line.norm();
            if length < slack || length == 0.0 {
                continue;
            }
            let direction = line / length;
            let along = direction * direction.transpose();
            let tension = stiffness * (length - slack);
            let sideways = (Matrix3::identity() - along) * (tension / length);
            let ends = [(nodes[0], -1.0), (nodes[1], 1.0)];
            let ends = ends.into_iter().filter_map(|(node, share)| self.node_end(barrier, node, share)).collect();
            links.push(Link { ends, stiffness: along * stiffness + sideways, damping: along * damping });
        }
    }

    /// A contact with its normal spring and dashpot, and its friction spring.
    fn contact(&self, ends: Vec<End>, normal: &Vec3, stiffness: f64, inverse_mass: f64) -> Link {
        let along = normal * normal.transpose();
        let damping = self.law.damping(&Spring::new(stiffness, inverse_mass));
        let across = (Matrix3::identity() - along) * (self.law.tangential_ratio * stiffness);
        Link { ends, stiffness: along * stiffness + across, damping: along * damping }
    }

    fn grain_end(&self, member: u32, foot: &Vec3, sign: f64) -> End {
        let row = member as usize / self.grains.shape.members();
        // Displacement at the foot from the grain's own: u + θ × arm = u − [arm]× θ.
        let arm = foot - self.grains.place[row].vector();
        let lever = arm.cross_matrix() * self.inverse_root_inertia(row) * -sign;
        End { body: row, linear: sign / self.grains.bodies[row].mass.sqrt(), lever }
    }

    /// Nothing for a node that never moves.
    fn node_end(&self, barrier: &Barrier, node: u32, share: f64) -> Option<End> {
        let here = &barrier.nodes[node as usize];
        let body = self.grains.len() + node as usize;
        (!here.fixed).then(|| End { body, linear: share / here.mass.sqrt(), lever: Matrix3::zeros() })
    }

    /// I^(−½) of the grain in `row`, in the fixed frame.
    fn inverse_root_inertia(&self, row: usize) -> Matrix3<f64> {
        let body = &self.grains.bodies[row];
        let (axial, transverse) = (body.inertia_axial.sqrt().recip(), body.inertia_transverse.sqrt().recip());
        match self.grains.axis.get(row) {
            Some(axis) => {
                let axis = axis.vector();
                Matrix3::identity() * transverse + axis * axis.transpose() * (axial - transverse)
            }
            None => Matrix3::identity() * axial,
        }
    }
}

/// A mode that is strong where much stiffness meets little mass, in directions that no symmetry can blind.
fn first_guess(links: &[Link], bodies: usize) -> Vec<Modal> {
    let mut strength = vec![0.0_f64; bodies];
    for link in links {
        let trace = link.stiffness.trace();
        for end in &link.ends {
            strength[end.body] += trace * (end.linear * end.linear + end.lever.norm_squared());
        }
    }
    let most = strength.iter().copied().fold(0.0, f64::max);
    let directions = |number: usize| {
        let turn = |factor: f64| (number as f64 * factor + 0.1).sin();
        [Vec3::new(turn(1.3), turn(2.7), turn(4.1)), Vec3::new(turn(5.3), turn(6.7), turn(8.9))]
    };
    let strengths = strength.iter().enumerate();
    // A NaN must not be lost in the largest of all.
    let scale = if strength.iter().any(|s| !s.is_finite()) { f64::NAN } else { most.max(f64::MIN_POSITIVE) };
    strengths.map(|(number, strength)| directions(number).map(|part| part * (strength / scale).powi(4))).collect()
}

/// Share of a mode's energy in the bodies from number `first` on.
fn energy_share(mode: &[Modal], first: usize) -> f64 {
    let energy = |bodies: &[Modal]| bodies.iter().flatten().map(Vec3::norm_squared).sum::<f64>();
    (energy(&mode[first..]) / energy(mode)).max(0.0)
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
