//! Sphere against sphere, eight pairs side by side.

use crate::contact::law::{ContactPoint, LawConstants, Response, Spring, normal_before};
use crate::contact::pair_list::EightPairs;
use crate::simd::eight::{Eight, LANES, Row, each_lane, joined, parted};
use crate::simd::quad::Quad;
use crate::simd::real::{Triple, add_scaled, cross, dot, minus, plus, scaled};
use crate::tables::grain_rows::GrainRows;
use crate::tables::grain_table::side;

/// What the grain contacts of a run have in common.
#[derive(Clone, Copy, Debug)]
pub struct PairConstants<'a> {
    pub law: LawConstants,
    /// Contact modulus of the grains (Pa).
    pub modulus: f64,
    pub friction: f64,
    /// Of each grain; empty in a dry flow ([`crate::tables::grain_table::GrainTable::grip`]).
    pub grip: &'a [f64],
}

/// Signs that turn the sum of two rows into the difference of their vectors and the sum of their fourth entries.
const DIFFERENCE: Quad = Quad([-1.0, -1.0, -1.0, 1.0]);

/// Pairs of member spheres of spheres (`CLUMPS` false) or of clumps.
pub struct GrainTouch<E, const CLUMPS: bool> {
    pub point: ContactPoint<E>,
    /// 1/(the smaller radius) (1/m).
    pub inverse_radius: E,
    /// From each sphere's centre to the contact (m).
    reach: [E; 2],
    /// Clumps only: from each grain's centre of mass to the centre of the sphere (m).
    arm: [Triple<E>; 2],
}

impl<E: Eight, const CLUMPS: bool> GrainTouch<E, CLUMPS> {
    /// Normal along the line of centres, contact half-way into the overlap; lanes not in use do not touch.
    ///
    /// All reciprocals come from one: with X = r₁+r₂, Y = 2E r₁r₂, Z = 1/m₁+1/m₂ and the distance d, 1/(X Y Z d) gives
    /// k = Y/X, 1/k, 1/Z and 1/d by products.
    #[inline(always)]
    pub fn of(grains: GrainRows, eight: &EightPairs, constants: &PairConstants) -> Self {
        let difference = E::Row::load(&DIFFERENCE);
        let row = |lane: usize, party: usize| {
            let member = eight.pairs[lane][party] as usize;
            if CLUMPS { member / 2 } else { member }
        };
        let (between, sum) = parted(E::columns(each_lane!(|lane| {
            let [a, b] = [grains.place(row(lane, 0)), grains.place(row(lane, 1))];
            E::Row::load(&b) + difference * E::Row::load(&a)
        })));
        let (motion, inverse_mass) = parted(E::columns(each_lane!(|lane| {
            let [a, b] = [grains.motion(row(lane, 0)), grains.motion(row(lane, 1))];
            E::Row::load(&b) + difference * E::Row::load(&a)
        })));
        // The radius of the first rides in a fourth entry that is not wanted here.
        let (spin1, fourth1) = parted(E::columns(each_lane!(|lane| {
            let spin = E::Row::load(&grains.spin(row(lane, 0)));
            if CLUMPS { spin } else { spin.with_fourth_of(E::Row::load(&grains.place(row(lane, 0)))) }
        })));
        let (spin2, fourth2) = parted(E::columns(each_lane!(|lane| E::Row::load(&grains.spin(row(lane, 1))))));
        let (r1, arm) = if CLUMPS {
            let (axis1, r1) = parted(E::columns(each_lane!(|lane| {
                let axis = E::Row::load(&grains.axis(row(lane, 0)));
                axis.with_fourth_of(E::Row::load(&grains.place(row(lane, 0))))
            })));
            let (axis2, _) = parted(E::columns(each_lane!(|lane| E::Row::load(&grains.axis(row(lane, 1))))));
            let side1 = E::from_lanes(each_lane!(|lane| side(eight.pairs[lane][0])));
            let side2 = E::from_lanes(each_lane!(|lane| side(eight.pairs[lane][1])));
            (r1, [scaled(axis1, side1 * fourth1), scaled(axis2, side2 * fourth2)])
        } else {
            (fourth1, [[E::all(0.0); 3]; 2])
        };
        let between = if CLUMPS { plus(between, minus(arm[1], arm[0])) } else { between };

        let distance = dot(between, between).root();
        let r2 = sum - r1;
        let product = r1 * r2 * (2.0 * constants.modulus);
        let all = E::all(1.0) / (sum * product * (inverse_mass * distance));
        let but_distance = all * distance;
        let but_spring = but_distance * inverse_mass;
        let inverse_distance = all * (sum * product) * inverse_mass;
        let normal = scaled(between, inverse_distance);
        let numbers = E::from_lanes(each_lane!(|lane| lane as f64));
        let overlap = E::all(eight.count as f64).if_above(numbers, sum - distance, -sum);
        let reach = [r1 - overlap * 0.5, r2 - overlap * 0.5];
        let half_step = 0.5 * constants.law.time_step;
        let of_centres = if CLUMPS {
            let [first, second] = [turning(spin1, arm[0], half_step), turning(spin2, arm[1], half_step)];
            plus(motion, minus(second, first))
        } else {
            motion
        };
        let middle = normal_before(normal, of_centres, inverse_distance * half_step);
        // Surface velocities from the spins: Σ ω × (arm + reach n), the second body's reach being −reach n.
        let rim = add_scaled(scaled(spin1, reach[0]), reach[1], spin2);
        let velocity = minus(of_centres, cross(rim, middle));
        let stiffness = but_spring * product * product;
        let frequency = (stiffness * inverse_mass).root();
        let point = ContactPoint {
            normal,
            middle,
            overlap,
            velocity,
            twist: dot(plus(spin1, spin2), normal) * 0.5,
            spring: Spring {
                stiffness,
                compliance: but_spring * sum * sum,
                frequency,
                impedance: frequency * (but_distance * (sum * product)),
            },
            friction: if constants.grip.is_empty() {
                E::all(constants.friction)
            } else {
                let grip = |lane: usize, party: usize| constants.grip[row(lane, party)];
                let both = E::from_lanes(each_lane!(|lane| grip(lane, 0) + grip(lane, 1)));
                both * (0.5 * constants.friction)
            },
        };
        // 1/min(r₁, r₂) = 2E max(r₁, r₂)/Y.
        let inverse_radius = r1.or_larger(r2) * (2.0 * constants.modulus) * (but_spring * sum);
        Self { point, inverse_radius, reach, arm }
    }

    /// Force on the first grain (N) and torques on both (N m), in rows whose fourth entries are zero.
    #[inline(always)]
    pub fn loads(&self, response: &Response<E>) -> ([E::Row; LANES], [[E::Row; LANES]; 2]) {
        let (zero, force, normal) = (E::all(0.0), response.force, self.point.normal);
        let [torque1, torque2] = if CLUMPS {
            let lever1 = add_scaled(self.arm[0], self.reach[0], normal);
            let lever2 = add_scaled(self.arm[1], -self.reach[1], normal);
            [cross(lever1, force), cross(force, lever2)]
        } else {
            let turning = cross(normal, force);
            [scaled(turning, self.reach[0]), scaled(turning, self.reach[1])]
        };
        (E::rows(joined(force, zero)), [E::rows(joined(torque1, zero)), E::rows(joined(torque2, zero))])
    }
}

/// Velocity of the end of an arm of a turning body, half a step before the arm was as it is: ω × (a − ½Δt ω × a) (m/s).
#[inline(always)]
pub fn turning<E: Eight>(spin: Triple<E>, arm: Triple<E>, half_step: f64) -> Triple<E> {
    let now = cross(spin, arm);
    add_scaled(now, E::all(-half_step), cross(spin, now))
}
