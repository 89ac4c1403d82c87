//! An inlet: grains come to it as one body, whatever touches them, and move freely once they have passed it.
//!
//! What stands behind the inlet keeps what has passed it from spreading back, as the rest of a flow would. While a grain is carried it has
//! [`BURDEN`] times its mass against everything that touches it, and what the others do to it in a step is read off that and taken back; the work
//! of what carries it is booked.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::ledger::Ledger;
use crate::tables::grain_table::GrainTable;
use crate::tables::grains::GrainShape;

/// Mass of a carried grain against what touches it, over its own.
const BURDEN: f64 = 1e6;

/// Where grains come from, and how fast.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Inlet {
    /// A point of the plane that grains pass (m), and the way on which they come, of length 1.
    pub place: Vec3,
    pub along: Vec3,
    /// Velocity at times that rise (s, m/s), straight between them; before and after as at the nearest.
    pub velocity: Vec<[f64; 2]>,
    /// Mass (kg), momentum along the way (kg m/s) and energy of motion (J) that have passed.
    pub passed: [f64; 3],
    /// Work that what carries the grains does against what touches them (J): on what stands in their way, and held back by what pulls.
    pub pushed: f64,
    /// Work that moves them on in the step just made (J): booked with the next, as their places are.
    moves_on: f64,
}

impl Inlet {
    pub fn new(place: Vec3, along: Vec3, velocity: Vec<[f64; 2]>) -> Self {
        Self { place, along, velocity, passed: [0.0; 3], pushed: 0.0, moves_on: 0.0 }
    }

    /// Velocity of what it carries at a time (s).
    pub fn velocity_at(&self, time: f64) -> f64 {
        let after = self.velocity.partition_point(|row| row[0] <= time);
        match (after.checked_sub(1).map(|before| self.velocity[before]), self.velocity.get(after)) {
            (Some([from, velocity]), Some([to, next])) => velocity + (next - velocity) * (time - from) / (to - from),
            (Some([_, last]), None) => last,
            (None, first) => first.map_or(0.0, |[_, first]| *first),
        }
    }

    /// How far a grain is before the plane (m).
    pub fn before(&self, place: &Vec3) -> f64 {
        (self.place - place).dot(&self.along)
    }

    /// Before a step that begins at a time (s): carried grains get the velocity that gravity makes the one that they are to have in it.
    pub(crate) fn carry(&mut self, grains: &mut GrainTable, ledger: &mut Ledger, during: &During) {
        ledger.carried_in += std::mem::take(&mut self.moves_on);
        let velocity = self.along * self.velocity_at(during.time + 0.5 * during.step) - during.gravity * during.step;
        for row in carried(grains) {
            grains.motion[row].set_vector(&velocity);
        }
    }

    /// After the step: takes back what others have done to carried grains, books the work of it, and lets go what has passed.
    pub(crate) fn let_go(&mut self, grains: &mut GrainTable, ledger: &mut Ledger, during: &During) {
        let &During { time, step, gravity } = during;
        let [before, now, next] = [-0.5, 0.5, 1.5].map(|steps| self.velocity_at(time + steps * step));
        let kept = self.along * now;
        for row in carried(grains) {
            let mass = grains.bodies[row].mass;
            // What others push it with, over its mass against them, has changed its velocity.
            let push = (grains.motion[row].vector() - kept).dot(&self.along) * mass * BURDEN / step;
            let against = -push * now * step;
            self.pushed += against;
            ledger.carried_in += against;
            grains.motion[row].set_vector(&kept);
            stop_spin(grains, row);
            let weight = mass * gravity.dot(&self.along) * now * step;
            if self.before(&grains.place[row].vector()) > 0.0 {
                self.moves_on += 0.5 * mass * now * (next - before) - weight;
            } else {
                // From the middle of the step on it moves by itself.
                self.moves_on += 0.5 * (mass * now * (now - before) - weight);
                free(grains, row);
                self.passed[0] += mass;
                self.passed[1] += mass * now;
                self.passed[2] += 0.5 * mass * now * now;
            }
        }
    }
}

/// The step that is made.
#[derive(Clone, Copy)]
pub(crate) struct During {
    /// At which it begins (s).
    pub time: f64,
    pub step: f64,
    pub gravity: Vec3,
}

/// Mass of a grain against what touches it, over its own.
pub(crate) fn burden_of(grains: &GrainTable, row: usize) -> f64 {
    if grains.carried.get(row) == Some(&true) { BURDEN } else { 1.0 }
}

/// Rows of the grains that are carried.
fn carried(grains: &GrainTable) -> Vec<usize> {
    grains.carried.iter().enumerate().filter(|(_, carried)| **carried).map(|(row, _)| row).collect()
}

fn stop_spin(grains: &mut GrainTable, row: usize) {
    grains.spin[row].set_vector(&Vec3::zeros());
    if let Some(momentum) = grains.momentum.get_mut(row) {
        momentum.set_vector(&Vec3::zeros());
    }
}

/// Gives a grain that is to be carried its burden.
pub(crate) fn burden(grains: &mut GrainTable, row: usize) {
    weigh(grains, row, BURDEN);
    grains.carried[row] = true;
}

fn free(grains: &mut GrainTable, row: usize) {
    weigh(grains, row, 1.0);
    grains.carried[row] = false;
}

/// Makes the mass and inertia of a grain so many times its own.
fn weigh(grains: &mut GrainTable, row: usize, factor: f64) {
    let body = grains.bodies[row];
    let [mass, axial, transverse] =
        [body.mass, body.inertia_axial, body.inertia_transverse].map(|own| 1.0 / (own * factor));
    grains.motion[row].0[3] = mass;
    match grains.shape {
        GrainShape::Sphere => grains.spin[row].0[3] = axial,
        GrainShape::Clump => {
            grains.axis[row].0[3] = transverse;
            grains.momentum[row].0[3] = axial - transverse;
        }
    }
}
