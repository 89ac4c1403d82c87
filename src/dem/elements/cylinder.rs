//! Cylinder: a straight piece of wire rope with axial, bending and twisting stiffness between two nodes that turn.
//!
//! The element is the Euler-Bernoulli beam in a frame that goes with it (co-rotational): the first axis e₁ runs from node to
//! node, the second lies between those of the two nodes, so that rigid motion strains nothing, however large. With L the
//! length now, L₀ at rest, θ₁ and θ₂ the rotations of the nodes against that frame,
//!
//! N = EA/L₀ (L − L₀),  M₁ = EI/L₀ (4 θ₁ + 2 θ₂),  M₂ = EI/L₀ (2 θ₁ + 4 θ₂) across e₁,  T = GJ/L₀ (θ₂ − θ₁) along it,
//!
//! and the shear force (M₁ + M₂)/L keeps the balance of moments, so that momentum and angular momentum are conserved
//! to rounding. For a round section I = πR⁴/4 and J = πR⁴/2; this is the pair k_t = 12 EI/L³ at mid-length and k_b = EI/L
//! of Albaba 2015, section 4.3.1, with the true I and J (the printed ones are half).

use nalgebra::UnitQuaternion;

use crate::dem::Vec3;
use crate::dem::tables::barrier::{Frame, Node, SegmentKind};

/// A cylinder between two nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    pub nodes: [u32; 2],
    pub kind: SegmentKind,
    /// m
    pub rest_length: f64,
    pub section: Section,
    /// Damping over stiffness, of all deformations alike (s).
    pub damping_time: f64,
    /// Frame of the cylinder at rest as each node sees it: turned by the node's orientation it is the node's own axes.
    pub rest_frames: [UnitQuaternion<f64>; 2],
}

/// Stiffness of a cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// m
    pub radius: f64,
    /// EA (N)
    pub axial: f64,
    /// EI (N m²)
    pub bending: f64,
    /// GJ (N m²)
    pub twisting: f64,
}

impl Section {
    /// A solid round section of `radius` (m), Young's modulus (Pa) and Poisson's ratio.
    pub fn round(radius: f64, modulus: f64, poisson: f64) -> Self {
        let area = std::f64::consts::PI * radius * radius;
        let bending = modulus * area * radius * radius / 4.0;
        // J = 2 I, G = E/(2 (1 + ν)).
        Self { radius, axial: modulus * area, bending, twisting: bending / (1.0 + poisson) }
    }
}

/// What a cylinder does to its nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strain {
    /// Axial force (N), tension positive.
    pub tension: f64,
    /// Force on the second node (N); the first gets the opposite.
    pub force: Vec3,
    /// Moments on the nodes (N m).
    pub moments: [Vec3; 2],
    /// Elastic energy (J).
    pub stored: f64,
    /// Dissipated power (W).
    pub power_lost: f64,
    /// Magnitude of the larger bending moment and of the twisting moment (N m), for elastic limits.
    pub bending: f64,
    pub twisting: f64,
}

impl Cylinder {
    /// A cylinder that is at rest as its nodes lie and are turned now.
    pub fn between(
        nodes: [u32; 2],
        kind: SegmentKind,
        section: Section,
        places: [&Vec3; 2],
        frames: [&Frame; 2],
    ) -> Self {
        let line = places[1] - places[0];
        let own = frame_along(&line);
        Self {
            nodes,
            kind,
            rest_length: line.norm(),
            section,
            damping_time: 0.0,
            rest_frames: frames.map(|frame| frame.orientation.inverse() * own),
        }
    }

    /// Strains the cylinder to the present places and orientations of its nodes.
    pub fn strain(&self, ends: [&Node; 2], frames: [&Frame; 2]) -> Strain {
        let line = ends[1].position - ends[0].position;
        let length = line.norm();
        let along = line / length;
        let axes = [0, 1].map(|end| frames[end].orientation * self.rest_frames[end]);
        let middle = axes[0] * Vec3::y() + axes[1] * Vec3::y();
        let third = along.cross(&middle).normalize();
        let second = third.cross(&along);
        let matrix = nalgebra::Matrix3::from_columns(&[along, second, third]);
        let frame = UnitQuaternion::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(matrix));
        let [first, last] = axes.map(|axes| (frame.inverse() * axes).scaled_axis());
        let Section { axial, bending, twisting, .. } = self.section;
        let (stretch, twist) = (length - self.rest_length, last.x - first.x);
        // Rates in the same frame; rigid turning of the frame, seen from the nodes, is that of the line between them.
        let turning = along.cross(&(ends[1].velocity - ends[0].velocity)) / length;
        let spin = frames.map(|node| frame.inverse() * (node.spin - turning));
        let rate = (ends[1].velocity - ends[0].velocity).dot(&along);
        let (k_bend, k_twist, k_axial) =
            (bending / self.rest_length, twisting / self.rest_length, axial / self.rest_length);
        let moment = |mine: &Vec3, other: &Vec3| {
            Vec3::new(0.0, 4.0 * mine.y + 2.0 * other.y, 4.0 * mine.z + 2.0 * other.z) * k_bend
        };
        let elastic = [moment(&first, &last), moment(&last, &first)];
        let lossy = [moment(&spin[0], &spin[1]), moment(&spin[1], &spin[0])].map(|part| part * self.damping_time);
        let torsion = k_twist * (twist + self.damping_time * (spin[1].x - spin[0].x));
        let tension = k_axial * (stretch + self.damping_time * rate);
        let local = [-(elastic[0] + lossy[0]) + Vec3::x() * torsion, -(elastic[1] + lossy[1]) - Vec3::x() * torsion];
        let moments = local.map(|local| frame * local);
        let force = along.cross(&(moments[0] + moments[1])) / length - along * tension;
        let stored = 0.5
            * (k_axial * stretch * stretch + elastic[0].dot(&first) + elastic[1].dot(&last) + k_twist * twist * twist);
        let spin_twist = spin[1].x - spin[0].x;
        let power_lost = self.damping_time * (k_axial * rate * rate + k_twist * spin_twist * spin_twist)
            + lossy[0].dot(&spin[0])
            + lossy[1].dot(&spin[1]);
        Strain {
            tension,
            force,
            moments,
            stored,
            power_lost,
            bending: elastic[0].norm().max(elastic[1].norm()),
            twisting: torsion.abs(),
        }
    }
}

/// A frame whose first axis runs along `line`.
pub fn frame_along(line: &Vec3) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between(&Vec3::x(), line)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vec3::z_axis(), std::f64::consts::PI))
}
