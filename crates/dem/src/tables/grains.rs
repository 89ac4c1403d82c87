//! Grains: rigid bodies of one sphere, or of two equal overlapping spheres (a clump).

use serde::{Deserialize, Serialize};

use crate::Vec3;

/// One rigid grain. Velocity and angular momentum live at half steps (leapfrog), the rest at full steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grain {
    /// Number given at creation; survives reordering and removal.
    pub id: u32,
    /// Centre of mass (m).
    pub position: Vec3,
    /// Velocity of the centre of mass (m/s).
    pub velocity: Vec3,
    /// Angular momentum about the centre of mass, in the fixed frame (kg m²/s).
    pub angular_momentum: Vec3,
    /// Unit vector along the line of member centres; meaningless for a single sphere.
    pub axis: Vec3,
    pub body: GrainBody,
}

/// What of a grain never changes: its size and its inertia.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GrainBody {
    /// Radius of each member sphere (m).
    pub radius: f64,
    /// Distance of each member centre from the centre of mass (m); 0 for a single sphere.
    pub offset: f64,
    /// kg
    pub mass: f64,
    /// Moment of inertia about the axis (kg m²).
    pub inertia_axial: f64,
    /// Moment of inertia about any line through the centre across the axis (kg m²).
    pub inertia_transverse: f64,
}

impl GrainBody {
    /// A solid sphere: I = 2/5 m r².
    pub fn sphere(radius: f64, density: f64) -> Self {
        Self::union_of_two(radius, 0.0, density)
    }

    /// A clump of the same volume as a sphere of the given `diameter`, with the given `aspect` ratio
    /// (length over width, 1 ≤ aspect ≤ 2; 1.5 is the clump of Albaba 2015, section 3.3.2).
    pub fn clump(diameter: f64, aspect: f64, density: f64) -> Self {
        let wanted_volume = std::f64::consts::PI / 6.0 * diameter.powi(3);
        let unit_volume = Self::union_of_two(1.0, aspect - 1.0, 1.0).mass;
        let radius = libm::cbrt(wanted_volume / unit_volume);
        Self::union_of_two(radius, (aspect - 1.0) * radius, density)
    }

    /// The same body `factor` times as large, of the same density.
    pub fn scaled(&self, factor: f64) -> Self {
        let (volume, fifth) = (factor.powi(3), factor.powi(5));
        Self {
            radius: factor * self.radius,
            offset: factor * self.offset,
            mass: volume * self.mass,
            inertia_axial: fifth * self.inertia_axial,
            inertia_transverse: fifth * self.inertia_transverse,
        }
    }

    /// Mass and inertia of the union of two spheres of uniform density (the overlap counts once), as a
    /// solid of revolution: V = ∫πρ²dx, I_axial = ∫½πρ⁴dx, I_transverse = ∫(¼πρ⁴ + πρ²x²)dx,
    /// with ρ² = r² − (|x| − offset)². The integrands are polynomials of degree four, so the three-point
    /// Gauss rule on each half is exact.
    fn union_of_two(radius: f64, offset: f64, density: f64) -> Self {
        use std::f64::consts::PI;
        let length = offset + radius;
        let root = 0.6_f64.sqrt();
        let rule = [(-root, 5.0 / 9.0), (0.0, 8.0 / 9.0), (root, 5.0 / 9.0)];
        let mut body = Self { radius, offset, mass: 0.0, inertia_axial: 0.0, inertia_transverse: 0.0 };
        for (node, weight) in rule {
            let x = 0.5 * length * (1.0 + node);
            let width_squared = radius * radius - (x - offset).powi(2);
            // Two halves of length `length`, each with Jacobian length/2.
            let factor = density * PI * weight * length;
            body.mass += factor * width_squared;
            body.inertia_axial += factor * 0.5 * width_squared.powi(2);
            body.inertia_transverse += factor * (0.25 * width_squared.powi(2) + width_squared * x * x);
        }
        body
    }
}

impl Grain {
    /// A grain at rest.
    pub fn at(id: u32, position: Vec3, axis: Vec3, body: GrainBody) -> Self {
        Self { id, position, velocity: Vec3::zeros(), angular_momentum: Vec3::zeros(), axis, body }
    }

    /// Angular velocity (rad/s) from angular momentum: ω = L/I_t + (a·L)(1/I_a − 1/I_t) a.
    pub fn spin(&self) -> Vec3 {
        let along = self.axis.dot(&self.angular_momentum);
        let (axial, transverse) = (1.0 / self.body.inertia_axial, 1.0 / self.body.inertia_transverse);
        self.angular_momentum * transverse + self.axis * (along * (axial - transverse))
    }

    /// Kinetic energy (J): of the whole motion, and its rotational part.
    pub fn kinetic_energy(&self) -> [f64; 2] {
        let rotational = 0.5 * self.spin().dot(&self.angular_momentum);
        [0.5 * self.body.mass * self.velocity.norm_squared() + rotational, rotational]
    }
}

/// How many member spheres every grain of a model has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum GrainShape {
    Sphere,
    Clump,
}

impl GrainShape {
    #[inline(always)]
    pub fn members(self) -> usize {
        match self {
            Self::Sphere => 1,
            Self::Clump => 2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn clump_has_the_closed_form_inertia() {
        // Two spheres r, centres r apart: I_axial = 17/40 M r², I_transverse = 59/80 M r² (case A17).
        let body = GrainBody::clump(1.0, 1.5, 2701.0);
        let scale = body.mass * body.radius.powi(2);
        assert_relative_eq!(body.inertia_axial, 17.0 / 40.0 * scale, max_relative = 1e-12);
        assert_relative_eq!(body.inertia_transverse, 59.0 / 80.0 * scale, max_relative = 1e-12);
        assert_relative_eq!(body.radius.powi(3), 16.0 / 27.0 * 0.125, max_relative = 1e-12);
    }

    #[test]
    fn sphere_is_a_clump_of_aspect_one() {
        let body = GrainBody::sphere(0.5, 1000.0);
        let mass = 1000.0 * std::f64::consts::PI / 6.0;
        assert_relative_eq!(body.mass, mass, max_relative = 1e-12);
        assert_relative_eq!(body.inertia_axial, 0.4 * mass * 0.25, max_relative = 1e-12);
        assert_relative_eq!(body.inertia_transverse, body.inertia_axial, max_relative = 1e-12);
    }
}
