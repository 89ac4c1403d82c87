//! Sphere against sphere, for a batch of pairs.

use crate::dem::contact::grain_pairs::PairConstants;
use crate::dem::contact::lanes::{LANES, Lane, LaneSums, Quads};
use crate::dem::contact::law::{ContactPoint, Spring, add_scaled, cross, dot, respond, scaled};
use crate::dem::tables::grain_table::{GrainLoad, GrainTable, Quad, side};

/// Pairs of member spheres, of spheres (`CLUMPS` false) or of clumps.
#[derive(Default)]
pub struct GrainBatch<const CLUMPS: bool> {
    /// From centre to centre (m); r₁ + r₂ (m).
    between: Quads,
    /// Velocity of the second grain's centre of mass less that of the first (m/s); 1/m₁ + 1/m₂ (1/kg).
    velocity: Quads,
    spin: [Quads; 2],
    /// Clumps only: from each grain's centre of mass to the centre of the sphere (m).
    arm: [Quads; 2],
    /// r₁ (m)
    radius: Lane,
    pub old: Quads,
    pub new: Quads,
    /// Force on the first grain (N).
    force: Quads,
    /// Torque on each clump (N m); for spheres n × F, the same for both but for the arm (N).
    torque: [Quads; 2],
    /// Spheres only: from each centre to the contact (m).
    reach: [Lane; 2],
    pub overlap: Lane,
}

/// Signs that turn the sum of two rows into the difference of their vectors and the sum of their fourth entries.
const DIFFERENCE: [f64; 4] = [-1.0, -1.0, -1.0, 1.0];

impl<const CLUMPS: bool> GrainBatch<CLUMPS> {
    /// Fills a lane with two unit spheres that do not touch.
    #[inline(always)]
    pub fn clear(&mut self, lane: usize) {
        self.between.rows[lane] = Quad([3.0, 0.0, 0.0, 2.0]);
        self.velocity.rows[lane] = Quad([0.0, 0.0, 0.0, 2.0]);
        self.radius[lane] = 1.0;
        self.old.rows[lane] = Quad::default();
    }

    #[inline(always)]
    pub fn gather(&mut self, lane: usize, grains: &GrainTable, pair: [u32; 2]) {
        let [a, b] = pair.map(|member| if CLUMPS { member as usize / 2 } else { member as usize });
        let (first, second) = (&grains.place[a].0, &grains.place[b].0);
        let mut between = [0.0; 4];
        for entry in 0..4 {
            between[entry] = second[entry] + DIFFERENCE[entry] * first[entry];
        }
        if CLUMPS {
            let [arm1, arm2] = [(a, pair[0]), (b, pair[1])].map(|(row, member)| {
                let length = side(member) * grains.spin[row].0[3];
                let axis = &grains.axis[row].0;
                [axis[0] * length, axis[1] * length, axis[2] * length, 0.0]
            });
            for entry in 0..4 {
                between[entry] += arm2[entry] - arm1[entry];
            }
            self.arm[0].rows[lane] = Quad(arm1);
            self.arm[1].rows[lane] = Quad(arm2);
        }
        self.between.rows[lane] = Quad(between);
        let (first, second) = (&grains.motion[a].0, &grains.motion[b].0);
        let mut velocity = [0.0; 4];
        for entry in 0..4 {
            velocity[entry] = second[entry] + DIFFERENCE[entry] * first[entry];
        }
        self.velocity.rows[lane] = Quad(velocity);
        self.spin[0].rows[lane] = grains.spin[a];
        self.spin[1].rows[lane] = grains.spin[b];
        self.radius[lane] = grains.place[a].0[3];
    }

    #[inline(always)]
    pub fn evaluate(&mut self, constants: &PairConstants, sums: &mut LaneSums) {
        let inputs = [&mut self.between, &mut self.velocity, &mut self.old];
        inputs.into_iter().chain(&mut self.spin).for_each(Quads::turn_to_columns);
        if CLUMPS {
            self.arm.iter_mut().for_each(Quads::turn_to_columns);
        }
        for lane in 0..LANES {
            let touch = self.touch(lane, constants);
            let response = respond(&touch.point, &self.old.memory(lane), &constants.law);
            let force = response.force;
            self.force.put(lane, force, 0.0);
            if CLUMPS {
                let lever1 = add_scaled(self.arm[0].vector(lane), touch.reach[0], touch.point.normal);
                let lever2 = add_scaled(self.arm[1].vector(lane), -touch.reach[1], touch.point.normal);
                self.torque[0].put(lane, cross(lever1, force), 0.0);
                self.torque[1].put(lane, cross(force, lever2), 0.0);
            } else {
                self.torque[0].put(lane, cross(touch.point.normal, force), 0.0);
                self.reach[0][lane] = touch.reach[0];
                self.reach[1][lane] = touch.reach[1];
            }
            self.new.put(lane, response.memory.tangential, response.memory.dashpot);
            self.overlap[lane] = touch.point.overlap;
            sums.count(lane, &response, touch.point.overlap * touch.inverse_radius);
        }
        self.force.turn_to_rows();
        self.torque[0].turn_to_rows();
        self.new.turn_to_rows();
        if CLUMPS {
            self.torque[1].turn_to_rows();
        }
    }

    /// Loads on the two grains of a lane.
    #[inline(always)]
    pub fn loads(&self, lane: usize) -> [GrainLoad; 2] {
        let force = self.force.rows[lane];
        let back = Quad(force.0.map(|entry| -entry));
        let torque = |party: usize| match CLUMPS {
            true => self.torque[party].rows[lane],
            false => Quad(self.torque[0].rows[lane].0.map(|entry| entry * self.reach[party][lane])),
        };
        [GrainLoad { force, torque: torque(0) }, GrainLoad { force: back, torque: torque(1) }]
    }

    /// Normal along the line of centres, contact half-way into the overlap.
    ///
    /// All reciprocals come from one: with X = r₁+r₂, Y = 2E r₁r₂, Z = 1/m₁+1/m₂ and the distance d, 1/(X Y Z d) gives
    /// k = Y/X, 1/k, 1/Z and 1/d by products.
    #[inline(always)]
    fn touch(&self, lane: usize, constants: &PairConstants) -> Touch {
        let between = self.between.vector(lane);
        let distance = dot(between, between).sqrt();
        let sum = self.between.fourth(lane);
        let (r1, r2) = (self.radius[lane], sum - self.radius[lane]);
        let inverse_mass = self.velocity.fourth(lane);
        let product = 2.0 * constants.modulus * (r1 * r2);
        let all = 1.0 / (sum * product * (inverse_mass * distance));
        let but_distance = all * distance;
        let but_spring = but_distance * inverse_mass;
        let normal = scaled(between, all * (sum * product) * inverse_mass);
        let overlap = sum - distance;
        let reach = [r1 - 0.5 * overlap, r2 - 0.5 * overlap];
        let (spin1, spin2) = (self.spin[0].vector(lane), self.spin[1].vector(lane));
        // Surface velocities from the spins: Σ ω × (arm + reach n), the second body's reach being −reach n.
        let rim = add_scaled(scaled(spin1, reach[0]), reach[1], spin2);
        let mut velocity = add_scaled(self.velocity.vector(lane), -1.0, cross(rim, normal));
        if CLUMPS {
            velocity = add_scaled(velocity, 1.0, cross(spin2, self.arm[1].vector(lane)));
            velocity = add_scaled(velocity, -1.0, cross(spin1, self.arm[0].vector(lane)));
        }
        let larger = if r1 > r2 { r1 } else { r2 };
        let stiffness = but_spring * product * product;
        let frequency = (stiffness * inverse_mass).sqrt();
        let point = ContactPoint {
            normal,
            overlap,
            velocity,
            twist: 0.5 * dot(add_scaled(spin1, 1.0, spin2), normal),
            spring: Spring {
                stiffness,
                compliance: but_spring * sum * sum,
                frequency,
                impedance: frequency * (but_distance * (sum * product)),
            },
            friction: constants.friction,
        };
        // 1/min(r₁, r₂) = 2E max(r₁, r₂)/Y.
        Touch { point, reach, inverse_radius: 2.0 * constants.modulus * larger * (but_spring * sum) }
    }
}

/// Two spheres that meet: the contact, the distances from their centres to it, and 1/(the smaller radius).
struct Touch {
    point: ContactPoint,
    reach: [f64; 2],
    inverse_radius: f64,
}
