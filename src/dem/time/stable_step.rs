//! How long a step may be, from what is really connected.
//!
//! The leapfrog with damping taken from the last half step is stable while Δt² K + 2 Δt C ≤ 4 M (for one
//! oscillator: Δt < (2/ω)(√(1+ζ²) − ζ)). The sum of all contacts is bounded body by body: for a contact of
//! stiffness k between bodies i and j, k|u_i − u_j|² ≤ k (w_i|u_i|² + w_j|u_j|²) with w_i = 1 + √(m_i/m_j).
//! Each body then needs only the largest eigenvalue of its own 6×6 matrix (3×3 for a node), which is bounded
//! from above by the Frobenius norm of its eighth power.

use nalgebra::{Matrix3, Matrix6, SMatrix};

use crate::dem::Vec3;
use crate::dem::contact::law::LawConstants;
use crate::dem::contact::pair_list::Separation;
use crate::dem::contact::ropes::{OnRopes, RopeContext, touch as touch_rope};
use crate::dem::neighbours::blocks::Block;
use crate::dem::neighbours::clocks::Clock;
use crate::dem::tables::barrier::Barrier;
use crate::dem::tables::grain_table::GrainTable;
use crate::dem::tables::surfaces::Surface;

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

/// Step over critical step, bounded from above, for the two kinds of bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepRatio {
    pub grains: f64,
    pub nodes: f64,
}

impl StepRatio {
    pub fn largest(&self) -> f64 {
        self.grains.max(self.nodes)
    }
}

/// Critical step (s) of two equal bodies in one contact: (2/ω)(√(1+ζ²) − ζ), ω² = k/m_r.
pub fn critical_step_of_pair(stiffness: f64, reduced_mass: f64, damping_ratio: f64) -> f64 {
    2.0 * (reduced_mass / stiffness).sqrt() * ((1.0 + damping_ratio * damping_ratio).sqrt() - damping_ratio)
}

/// Share w of a contact's stiffness that a body of mass `mass` must bear, with 1/m_r = `inverse_mass` (1/kg).
fn weight(mass: f64, inverse_mass: f64) -> f64 {
    1.0 + (mass * inverse_mass - 1.0).max(0.0).sqrt()
}

/// One contact as the stability bound sees it.
struct Link {
    normal: Vec3,
    stiffness: f64,
    inverse_mass: f64,
}

impl Audit<'_> {
    /// Bounds Δt/Δt_critical over all bodies, with the contacts of the last step.
    pub fn ratio(&self) -> StepRatio {
        let mut grain_tables = vec![Matrix6::zeros(); self.grains.len()];
        let mut node_tables = vec![Matrix3::zeros(); self.barrier.map_or(0, |barrier| barrier.nodes.len())];
        for block in self.blocks {
            self.add_pairs(block, &mut grain_tables);
            self.add_surfaces(block, &mut grain_tables);
            self.add_ropes(block, &mut grain_tables, &mut node_tables);
        }
        if let Some(barrier) = self.barrier {
            self.add_elements(barrier, &mut node_tables);
        }
        StepRatio {
            grains: (largest_bound(&grain_tables) / 4.0).sqrt(),
            nodes: (largest_bound(&node_tables) / 4.0).sqrt(),
        }
    }

    fn add_pairs(&self, block: &Block, tables: &mut [Matrix6<f64>]) {
        for &[first, second] in block.inner.touching.iter().chain(&block.border.touching) {
            let (a, b) = (self.grains.member(first as usize), self.grains.member(second as usize));
            let line = b.centre - a.centre;
            let distance = line.norm();
            if distance >= a.radius + b.radius {
                continue;
            }
            let normal = line / distance;
            let stiffness = 2.0 * self.modulus * a.radius * b.radius / (a.radius + b.radius);
            let link = Link { normal, stiffness, inverse_mass: a.inverse_mass + b.inverse_mass };
            let foot = a.centre + normal * (0.5 * (distance + a.radius - b.radius));
            self.add_to_grain(first, &foot, &link, tables);
            self.add_to_grain(second, &foot, &link, tables);
        }
    }

    fn add_surfaces(&self, block: &Block, tables: &mut [Matrix6<f64>]) {
        for &[index, surface] in &block.surfaces.touching {
            let member = self.grains.member(index as usize);
            let foot = self.surfaces[surface as usize].nearest(&member.centre);
            let towards = foot - member.centre;
            let distance = towards.norm();
            if distance < member.radius && distance > 0.0 {
                let stiffness = self.modulus * member.radius;
                let link = Link { normal: towards / distance, stiffness, inverse_mass: member.inverse_mass };
                self.add_to_grain(index, &foot, &link, tables);
            }
        }
    }

    fn add_ropes(&self, block: &Block, grains: &mut [Matrix6<f64>], nodes: &mut [Matrix3<f64>]) {
        let Some(barrier) = self.barrier else { return };
        let context = RopeContext {
            grains: self.grains,
            barrier,
            law: self.law,
            grain_modulus: self.modulus,
            grain_friction: self.friction,
            clock: Clock::default(),
        };
        for &[index, segment] in &block.ropes.list.touching {
            if (OnRopes { grains: self.grains, barrier }).gap([index, segment]) >= 0.0 {
                continue;
            }
            let member = self.grains.member(index as usize);
            let Some(contact) = touch_rope(&member, segment, &context) else {
                continue;
            };
            let normal = Vec3::from(contact.point.normal);
            let (stiffness, inverse_mass) = (contact.point.spring.stiffness, contact.inverse_mass);
            let link = Link { normal, stiffness, inverse_mass };
            self.add_to_grain(index, &contact.foot, &link, grains);
            let ends = barrier.segments[segment as usize].nodes;
            for (node, share) in ends.into_iter().zip([1.0 - contact.share, contact.share]) {
                if barrier.nodes[node as usize].fixed || share == 0.0 {
                    continue;
                }
                // u = Σ share u_node: k|u|² ≤ k Σ share |u_node|² (shares sum to one).
                let rope_inverse = link.inverse_mass - member.inverse_mass;
                let rope_weight = weight(1.0 / rope_inverse, link.inverse_mass);
                nodes[node as usize] += self.tensor(&link) * (share * rope_weight / barrier.nodes[node as usize].mass);
            }
        }
    }

    fn add_elements(&self, barrier: &Barrier, nodes: &mut [Matrix3<f64>]) {
        let step = self.law.time_step;
        let ropes = barrier.segments.iter().map(|s| (s.nodes, s.stiffness, s.damping, s.rest_length));
        let brakes = barrier.dissipators.iter().map(|d| (d.nodes, d.stiffness, 0.0, d.rest_length + d.used));
        for (ends, stiffness, damping, slack) in ropes.chain(brakes) {
            let [a, b] = ends.map(|node| &barrier.nodes[node as usize]);
            let line = b.position - a.position;
            let length = line.norm();
            if length < slack || length == 0.0 {
                continue;
            }
            let direction = line / length;
            let along = direction * direction.transpose();
            let tension = stiffness * (length - slack);
            let sideways = (Matrix3::identity() - along) * (tension / length);
            let matrix = along * (step * step * stiffness + 2.0 * step * damping) + sideways * (step * step);
            let inverse = |fixed: bool, mass: f64| if fixed { 0.0 } else { 1.0 / mass };
            let inverse_mass = inverse(a.fixed, a.mass) + inverse(b.fixed, b.mass);
            for (index, node) in ends.into_iter().zip([a, b]) {
                if !node.fixed {
                    nodes[index as usize] += matrix * (weight(node.mass, inverse_mass) / node.mass);
                }
            }
        }
    }

    /// Δt²K + 2ΔtC of one contact as a 3×3 tensor on relative displacement.
    fn tensor(&self, link: &Link) -> Matrix3<f64> {
        let step = self.law.time_step;
        let along = link.normal * link.normal.transpose();
        let damping = 2.0 * self.law.damping_ratio * (link.stiffness / link.inverse_mass).sqrt();
        let tangential = self.law.tangential_ratio * link.stiffness;
        along * (step * step * link.stiffness + 2.0 * step * damping)
            + (Matrix3::identity() - along) * (step * step * tangential)
    }

    /// Adds a contact at `foot` to the 6×6 matrix of the member's grain, scaled by the roots of mass and inertia.
    fn add_to_grain(&self, member: u32, foot: &Vec3, link: &Link, tables: &mut [Matrix6<f64>]) {
        let row = member as usize / self.grains.shape.members();
        let body = &self.grains.bodies[row];
        let tensor = self.tensor(link) * weight(body.mass, link.inverse_mass);
        // Displacement at the foot from the grain's own: u + θ × arm = u − [arm]× θ, θ scaled by the inertia about each
        // of its axes.
        let lever = -(foot - self.grains.place[row].vector()).cross_matrix() * self.inverse_root_inertia(row);
        let linear = 1.0 / body.mass.sqrt();
        let coupling = tensor * lever * linear;
        let table = &mut tables[row];
        let mut add = |r: usize, c: usize, part: &Matrix3<f64>| {
            let mut view = table.fixed_view_mut::<3, 3>(r, c);
            view += part;
        };
        add(0, 0, &(tensor * (linear * linear)));
        add(0, 3, &coupling);
        add(3, 0, &coupling.transpose());
        add(3, 3, &(lever.transpose() * tensor * lever));
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

/// Upper bound of the largest eigenvalue over all matrices.
fn largest_bound<const N: usize>(tables: &[SMatrix<f64, N, N>]) -> f64 {
    let mut largest: f64 = 0.0;
    for table in tables {
        // The trace bounds the eigenvalue too; most bodies are settled by it.
        let trace = table.trace();
        if !trace.is_finite() {
            return f64::INFINITY;
        }
        if trace > largest {
            largest = largest.max(eigenvalue_bound(table));
        }
    }
    largest
}

/// λ_max ≤ ‖A⁸‖_F^(1/8) for a symmetric A ≥ 0; at most 12 % above for 6×6.
fn eigenvalue_bound<const N: usize>(matrix: &SMatrix<f64, N, N>) -> f64 {
    let size = matrix.norm();
    if size == 0.0 {
        return 0.0;
    }
    let unit = matrix / size;
    let second = unit * unit;
    let fourth = second * second;
    let eighth = fourth * fourth;
    size * eighth.norm().powf(0.125)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn eigenvalue_bound_lies_just_above_the_eigenvalue() {
        let matrix = Matrix3::new(4.0, 1.0, 0.5, 1.0, 3.0, 0.2, 0.5, 0.2, 1.0);
        let exact = matrix.symmetric_eigenvalues().max();
        let bound = eigenvalue_bound(&matrix);
        assert!(bound >= exact && bound < 1.15 * exact, "{bound} against {exact}");
    }

    #[test]
    fn pair_step_matches_the_tabulated_factor() {
        // Undamped 2/ω; with ζ = 0.497 a factor 0.620 shorter.
        assert_relative_eq!(critical_step_of_pair(4.0, 1.0, 0.0), 1.0);
        assert_relative_eq!(critical_step_of_pair(4.0, 1.0, 0.497239), 0.6196, max_relative = 1e-3);
    }
}
