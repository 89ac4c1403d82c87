//! The grains as the engine steps them: rows of four numbers, one table for each kind of quantity.
//!
//! Three entries are a vector, the fourth is a constant of the grain that is wanted at the same time. A row is one
//! vector register; updates leave the fourth entry alone because the fourth entries of forces and steps are zero.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::simd::quad::Quad;
use crate::tables::grains::{Grain, GrainBody, GrainShape};

/// Force (N) and torque about the grain's centre (N m), summed over its contacts; the fourth entries stay zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(64))]
pub struct GrainLoad {
    pub force: Quad,
    pub torque: Quad,
}

impl GrainLoad {
    /// Adds another load.
    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        for entry in 0..4 {
            self.force.0[entry] += other.force.0[entry];
            self.torque.0[entry] += other.torque.0[entry];
        }
    }

    /// Adds a force that acts at `arm` from the grain's centre.
    #[inline(always)]
    pub fn add(&mut self, force: &Vec3, arm: &Vec3) {
        let torque = arm.cross(force);
        for axis in 0..3 {
            self.force.0[axis] += force[axis];
            self.torque.0[axis] += torque[axis];
        }
    }
}

/// All grains of a model. Velocities and spins live at half steps (leapfrog), the rest at full steps.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct GrainTable {
    pub shape: GrainShape,
    /// Centre of mass (m); radius of each member sphere (m).
    pub place: Vec<Quad>,
    /// Velocity of the centre (m/s); 1/mass (1/kg).
    pub motion: Vec<Quad>,
    /// Angular velocity (rad/s); for spheres 1/I (1/(kg m²)), for clumps the distance of each member centre from
    /// the centre of mass (m).
    pub spin: Vec<Quad>,
    /// Clumps only: unit vector along the member centres; 1/I across it.
    pub axis: Vec<Quad>,
    /// Clumps only: angular momentum (kg m²/s); 1/I about the axis less 1/I across it.
    pub momentum: Vec<Quad>,
    pub bodies: Vec<GrainBody>,
    /// Numbers given at creation; they survive reordering and removal.
    pub ids: Vec<u32>,
    /// Share of its friction that acts on a grain, 1 − r_u ([`crate::tables::pores`]); empty in a dry flow, where all of it does.
    pub grip: Vec<f64>,
    /// Velocity (m/s) and spin (1/s) at the end of the last step less their means over it, which `motion` and `spin` hold: of grains that took
    /// the steps of the barrier ([`crate::time::at_barrier`]), zero for others. Empty where the barrier takes none of its own.
    pub ahead: Vec<[Vec3; 2]>,
    /// Whether a grain is carried to an inlet ([`crate::time::inlet`]); empty where there is none.
    pub carried: Vec<bool>,
}

impl GrainTable {
    pub fn of(shape: GrainShape, grains: &[Grain]) -> Self {
        let mut table = Self {
            shape,
            place: Vec::new(),
            motion: Vec::new(),
            spin: Vec::new(),
            axis: Vec::new(),
            momentum: Vec::new(),
            bodies: Vec::new(),
            ids: Vec::new(),
            grip: Vec::new(),
            ahead: Vec::new(),
            carried: Vec::new(),
        };
        table.extend(grains);
        table
    }

    /// Adds grains, whose numbers must be new.
    pub fn extend(&mut self, grains: &[Grain]) {
        grains.iter().for_each(|grain| self.push(grain));
    }

    fn push(&mut self, grain: &Grain) {
        let body = &grain.body;
        let (axial, transverse) = (1.0 / body.inertia_axial, 1.0 / body.inertia_transverse);
        self.place.push(Quad::new(&grain.position, body.radius));
        self.motion.push(Quad::new(&grain.velocity, 1.0 / body.mass));
        match self.shape {
            GrainShape::Sphere => self.spin.push(Quad::new(&grain.spin(), axial)),
            GrainShape::Clump => {
                self.spin.push(Quad::new(&grain.spin(), body.offset));
                self.axis.push(Quad::new(&grain.axis, transverse));
                self.momentum.push(Quad::new(&grain.angular_momentum, axial - transverse));
            }
        }
        self.bodies.push(*body);
        self.ids.push(grain.id);
    }

    pub fn len(&self) -> usize {
        self.place.len()
    }

    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }

    /// Number of member spheres of all grains.
    pub fn members(&self) -> usize {
        self.len() * self.shape.members()
    }

    /// The grain in `row` as it is now.
    pub fn grain(&self, row: usize) -> Grain {
        let body = self.bodies[row];
        let (angular_momentum, axis) = match self.shape {
            GrainShape::Sphere => (self.spin[row].vector() * body.inertia_axial, Vec3::x()),
            GrainShape::Clump => (self.momentum[row].vector(), self.axis[row].vector()),
        };
        Grain {
            id: self.ids[row],
            position: self.place[row].vector(),
            velocity: self.motion[row].vector(),
            angular_momentum,
            axis,
            body,
        }
    }

    /// All grains as they are now, in the order of the rows.
    pub fn grains(&self) -> Vec<Grain> {
        (0..self.len()).map(|row| self.grain(row)).collect()
    }

    /// Gives the grains of this table, those of the given rows of `ahead`, the motion that they have at the end of their step.
    pub fn speed_up(&mut self, rows: &[u32], ahead: &[[Vec3; 2]]) {
        for ((motion, spin), &row) in self.motion.iter_mut().zip(&mut self.spin).zip(rows) {
            let [faster, turning] = ahead[row as usize];
            motion.set_vector(&(motion.vector() + faster));
            spin.set_vector(&(spin.vector() + turning));
        }
    }

    /// Gives all grains the motion that they have at the end of their last step.
    pub fn catch_up(&mut self) {
        let ahead = std::mem::take(&mut self.ahead);
        let rows: Vec<u32> = (0..ahead.len() as u32).collect();
        self.speed_up(&rows, &ahead);
    }

    /// Puts the rows into the given order, which may leave rows out.
    pub fn arrange(&mut self, order: &[u32]) {
        fn pick<T: Copy>(rows: &mut Vec<T>, order: &[u32]) {
            if !rows.is_empty() {
                *rows = order.iter().map(|&row| rows[row as usize]).collect();
            }
        }
        pick(&mut self.place, order);
        pick(&mut self.motion, order);
        pick(&mut self.spin, order);
        pick(&mut self.axis, order);
        pick(&mut self.momentum, order);
        pick(&mut self.bodies, order);
        pick(&mut self.ids, order);
        pick(&mut self.grip, order);
        pick(&mut self.ahead, order);
        pick(&mut self.carried, order);
    }
}

/// On which side of its grain a member lies: +1 for the first of a clump, −1 for the second.
#[inline(always)]
pub fn side(member: u32) -> f64 {
    1.0 - 2.0 * f64::from(member & 1)
}
