//! Contacts between grains: filter the candidates, gather, apply the law to batches, scatter.
//!
//! A block of members owns the candidate pairs whose first member it holds. Pairs inside the block load both
//! members; pairs across a block border stand in both blocks and load only the block's own member, so no two
//! blocks ever write the same row and the result does not depend on how many threads run.

use std::ops::Range;

use crate::dem::contact::candidates::CandidateList;
use crate::dem::contact::law::{ContactPoint, LawConstants, Memory, Response, add_scaled, cross, dot, respond};
use crate::dem::ledger::ContactSums;
use crate::dem::tables::grains::{Member, MemberLoad};

/// Contacts handled together; the arrays of a batch stay in the first-level cache.
const LANES: usize = 32;

/// What the grain contacts of a run have in common.
#[derive(Clone, Copy, Debug)]
pub struct PairConstants {
    pub law: LawConstants,
    /// Contact modulus of the grains (Pa).
    pub modulus: f64,
    pub friction: f64,
}

/// Which of the two members of a pair this block may load.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sides {
    Both,
    First,
}

impl CandidateList {
    /// Keeps in `active` the slots of the pairs whose spheres overlap now.
    fn find_touching(&mut self, members: &[Member]) {
        self.active.resize(self.pairs.len(), 0);
        let mut found = 0;
        for (slot, &[first, second]) in self.pairs.iter().enumerate() {
            let a = &members[first as usize].place;
            let b = &members[second as usize].place;
            let between = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
            let reach = a[3] + b[3];
            self.active[found] = slot as u32;
            found += usize::from(dot(between, between) < reach * reach);
        }
        self.active.truncate(found);
    }
}

/// Everything [`load_inner`] and [`load_border`] read besides the list itself.
pub struct PairContext<'a> {
    pub members: &'a [Member],
    pub constants: PairConstants,
    /// Number of this step, counted from 1.
    pub step: u32,
}

/// Loads both members of every touching pair inside the block; `loads` holds the rows of `range`.
pub fn load_inner(
    list: &mut CandidateList,
    context: &PairContext,
    range: &Range<usize>,
    loads: &mut [MemberLoad],
) -> ContactSums {
    load::<{ Sides::Both as u8 }>(list, context, range, loads)
}

/// Loads the first member of every touching pair across the block's border.
pub fn load_border(
    list: &mut CandidateList,
    context: &PairContext,
    range: &Range<usize>,
    loads: &mut [MemberLoad],
) -> ContactSums {
    load::<{ Sides::First as u8 }>(list, context, range, loads)
}

fn load<const SIDES: u8>(
    list: &mut CandidateList,
    context: &PairContext,
    range: &Range<usize>,
    loads: &mut [MemberLoad],
) -> ContactSums {
    list.find_touching(context.members);
    let mut batch = Batch::default();
    let mut sums = ContactSums::default();
    let CandidateList { pairs, memory, touched, active } = list;
    for slots in active.chunks(LANES) {
        for (lane, &slot) in slots.iter().enumerate() {
            let slot = slot as usize;
            let [first, second] = pairs[slot];
            let keep = f64::from(touched[slot] + 1 == context.step);
            touched[slot] = context.step;
            batch.gather(lane, &context.members[first as usize], &context.members[second as usize]);
            batch.remember(lane, &memory[slot], keep);
        }
        batch.evaluate(&context.constants);
        for (lane, &slot) in slots.iter().enumerate() {
            let slot = slot as usize;
            let [first, second] = pairs[slot];
            memory[slot] = batch.memory(lane);
            batch.add_to(lane, 0, 1.0, &mut loads[first as usize - range.start]);
            if SIDES == Sides::Both as u8 {
                batch.add_to(lane, 1, -1.0, &mut loads[second as usize - range.start]);
            }
        }
        batch.sum_into(slots.len(), &mut sums);
    }
    if SIDES == Sides::First as u8 {
        sums.halve_energies();
    }
    sums
}

/// Structure of arrays for up to [`LANES`] contacts.
struct Batch {
    between: [[f64; LANES]; 3],
    velocity: [[f64; LANES]; 3],
    /// r_1 ω_1 + r_2 ω_2
    rim_spin: [[f64; LANES]; 3],
    /// ω_1 + ω_2
    spin: [[f64; LANES]; 3],
    radius: [[f64; LANES]; 2],
    inverse_mass: [f64; LANES],
    old: [[f64; LANES]; 4],
    new: [[f64; LANES]; 4],
    force: [[f64; LANES]; 3],
    /// n × F; times the lever arm it is the torque.
    turn: [[f64; LANES]; 3],
    arm: [[f64; LANES]; 2],
    stored: [f64; LANES],
    lost_damping: [f64; LANES],
    lost_friction: [f64; LANES],
    overlap_ratio: [f64; LANES],
}

impl Default for Batch {
    fn default() -> Self {
        // Unused lanes hold a harmless contact: unit distance, unit masses.
        Self {
            between: [[1.0; LANES]; 3],
            velocity: [[0.0; LANES]; 3],
            rim_spin: [[0.0; LANES]; 3],
            spin: [[0.0; LANES]; 3],
            radius: [[1.0; LANES]; 2],
            inverse_mass: [1.0; LANES],
            old: [[0.0; LANES]; 4],
            new: [[0.0; LANES]; 4],
            force: [[0.0; LANES]; 3],
            turn: [[0.0; LANES]; 3],
            arm: [[0.0; LANES]; 2],
            stored: [0.0; LANES],
            lost_damping: [0.0; LANES],
            lost_friction: [0.0; LANES],
            overlap_ratio: [0.0; LANES],
        }
    }
}

impl Batch {
    #[inline(always)]
    fn gather(&mut self, lane: usize, a: &Member, b: &Member) {
        for axis in 0..3 {
            self.between[axis][lane] = b.place[axis] - a.place[axis];
            self.velocity[axis][lane] = b.motion[axis] - a.motion[axis];
            self.rim_spin[axis][lane] = a.place[3] * a.spin[axis] + b.place[3] * b.spin[axis];
            self.spin[axis][lane] = a.spin[axis] + b.spin[axis];
        }
        self.radius[0][lane] = a.place[3];
        self.radius[1][lane] = b.place[3];
        self.inverse_mass[lane] = a.motion[3] + b.motion[3];
    }

    #[inline(always)]
    fn remember(&mut self, lane: usize, memory: &Memory, keep: f64) {
        for axis in 0..3 {
            self.old[axis][lane] = memory.tangential[axis] * keep;
        }
        self.old[3][lane] = memory.dashpot * keep;
    }

    #[inline(always)]
    fn memory(&self, lane: usize) -> Memory {
        Memory { tangential: [self.new[0][lane], self.new[1][lane], self.new[2][lane]], dashpot: self.new[3][lane] }
    }

    #[inline(always)]
    fn add_to(&self, lane: usize, side: usize, sign: f64, load: &mut MemberLoad) {
        let arm = self.arm[side][lane];
        for axis in 0..3 {
            load.force[axis] += sign * self.force[axis][lane];
            load.torque[axis] += arm * self.turn[axis][lane];
        }
    }

    fn sum_into(&self, count: usize, sums: &mut ContactSums) {
        for lane in 0..count {
            sums.stored += self.stored[lane];
            sums.lost_damping += self.lost_damping[lane];
            sums.lost_friction += self.lost_friction[lane];
            if self.overlap_ratio[lane] > sums.overlap_ratio {
                sums.overlap_ratio = self.overlap_ratio[lane];
            }
        }
        sums.contacts += count as u64;
    }

    /// Applies the law to all lanes, with the widest vectors this processor has.
    fn evaluate(&mut self, constants: &PairConstants) {
        #[cfg(target_arch = "x86_64")]
        {
            if std::arch::is_x86_feature_detected!("avx512f") {
                // SAFETY: the processor was just asked for this feature.
                return unsafe { self.evaluate_avx512(constants) };
            }
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: as above.
                return unsafe { self.evaluate_avx2(constants) };
            }
        }
        self.evaluate_lanes(constants);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f")]
    fn evaluate_avx512(&mut self, constants: &PairConstants) {
        self.evaluate_lanes(constants);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn evaluate_avx2(&mut self, constants: &PairConstants) {
        self.evaluate_lanes(constants);
    }

    #[inline(always)]
    fn evaluate_lanes(&mut self, constants: &PairConstants) {
        for lane in 0..LANES {
            let (point, arms) = self.touch(lane, constants);
            let memory = Memory { tangential: column(&self.old, lane), dashpot: self.old[3][lane] };
            let response = respond(&point, &memory, &constants.law);
            self.store(lane, &point, arms, &response);
        }
    }

    /// Geometry of sphere against sphere: normal along the line of centres, contact half-way into the overlap.
    #[inline(always)]
    fn touch(&self, lane: usize, constants: &PairConstants) -> (ContactPoint, [f64; 2]) {
        let between = column(&self.between, lane);
        let (r1, r2) = (self.radius[0][lane], self.radius[1][lane]);
        let distance = dot(between, between).sqrt();
        let inverse = 1.0 / distance;
        let normal = [between[0] * inverse, between[1] * inverse, between[2] * inverse];
        let overlap = r1 + r2 - distance;
        let spin = column(&self.spin, lane);
        let rim = add_scaled(column(&self.rim_spin, lane), -0.5 * overlap, spin);
        let velocity = add_scaled(column(&self.velocity, lane), -1.0, cross(rim, normal));
        let point = ContactPoint {
            normal,
            overlap,
            velocity,
            twist: 0.5 * dot(spin, normal),
            stiffness: 2.0 * constants.modulus * (r1 * r2) / (r1 + r2),
            inverse_mass: self.inverse_mass[lane],
            friction: constants.friction,
        };
        (point, [r1 - 0.5 * overlap, r2 - 0.5 * overlap])
    }

    #[inline(always)]
    fn store(&mut self, lane: usize, point: &ContactPoint, arms: [f64; 2], response: &Response) {
        put(&mut self.force, lane, response.force);
        put(&mut self.turn, lane, cross(point.normal, response.force));
        put(&mut self.new, lane, response.memory.tangential);
        self.new[3][lane] = response.memory.dashpot;
        self.arm[0][lane] = arms[0];
        self.arm[1][lane] = arms[1];
        self.stored[lane] = response.stored;
        self.lost_damping[lane] = response.lost_damping;
        self.lost_friction[lane] = response.lost_friction;
        let (r1, r2) = (self.radius[0][lane], self.radius[1][lane]);
        let smaller = if r1 < r2 { r1 } else { r2 };
        self.overlap_ratio[lane] = point.overlap / smaller;
    }
}

#[inline(always)]
fn column<const N: usize>(rows: &[[f64; LANES]; N], lane: usize) -> [f64; 3] {
    [rows[0][lane], rows[1][lane], rows[2][lane]]
}

#[inline(always)]
fn put<const N: usize>(rows: &mut [[f64; LANES]; N], lane: usize, vector: [f64; 3]) {
    rows[0][lane] = vector[0];
    rows[1][lane] = vector[1];
    rows[2][lane] = vector[2];
}
