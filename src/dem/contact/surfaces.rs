//! Contacts of grains with fixed surfaces.

use std::cell::RefCell;
use std::ops::Range;

use crate::dem::Vec3;
use crate::dem::contact::lanes::{LANES, Lane, LaneSums, Quads};
use crate::dem::contact::law::{ContactPoint, LawConstants, Memory, Spring, add_scaled, cross, dot, respond, scaled};
use crate::dem::contact::pair_list::{PairList, Separation};
use crate::dem::ledger::ContactSums;
use crate::dem::neighbours::clocks::Clock;
use crate::dem::tables::grain_table::{GrainLoad, GrainTable, Quad};
use crate::dem::tables::surfaces::{Surface, SurfaceRole};

/// What surface contacts read.
pub struct SurfaceContext<'a> {
    pub grains: &'a GrainTable,
    pub surfaces: &'a [Surface],
    pub law: LawConstants,
    pub modulus: f64,
    pub grain_friction: f64,
    /// Way that any grain can have gone since the lists were made (m).
    pub clock: Clock,
    /// Heights that part the rigid wall into segments, from the bottom up (m); the last is its top.
    pub wall_levels: &'a [f64],
}

/// Forces the grains of one block put on the surfaces in one step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceForces {
    /// Force on the base (N).
    pub base: Vec3,
    /// Force on the side walls, the back wall and the gate (N).
    pub sides: Vec3,
    /// Force on the rigid wall (N).
    pub wall: Vec3,
    /// Moment of the wall's normal force about its toe (N m).
    pub wall_moment: f64,
    /// Normal force on each wall segment (N).
    pub wall_segments: Vec<f64>,
}

impl SurfaceForces {
    pub fn reset(&mut self, segments: usize) {
        self.base = Vec3::zeros();
        self.sides = Vec3::zeros();
        self.wall = Vec3::zeros();
        self.wall_moment = 0.0;
        self.wall_segments.clear();
        self.wall_segments.resize(segments, 0.0);
    }

    pub fn add(&mut self, other: &Self) {
        self.base += other.base;
        self.sides += other.sides;
        self.wall += other.wall;
        self.wall_moment += other.wall_moment;
        for (mine, theirs) in self.wall_segments.iter_mut().zip(&other.wall_segments) {
            *mine += theirs;
        }
    }

    fn record(&mut self, role: SurfaceRole, force: Vec3, normal_force: f64, height: f64, levels: &[f64]) {
        match role {
            SurfaceRole::Base => self.base += force,
            SurfaceRole::Side | SurfaceRole::Gate => self.sides += force,
            SurfaceRole::Wall => {
                self.wall += force;
                self.wall_moment += normal_force * height;
                let segment = levels.iter().take_while(|&&top| height > top).count();
                if let Some(sum) = self.wall_segments.get_mut(segment.min(levels.len().saturating_sub(1))) {
                    *sum += normal_force;
                }
            }
        }
    }
}

/// Loads the grains of a block that touch surfaces; returns energies, adds to `forces`.
pub fn load_surfaces(
    list: &mut PairList,
    context: &SurfaceContext,
    range: &Range<usize>,
    loads: &mut [GrainLoad],
    forces: &mut SurfaceForces,
) -> ContactSums {
    let (grains, surfaces) = (context.grains, context.surfaces);
    list.sort_near(&context.clock, &OnSurfaces { grains, surfaces });
    let per_grain = grains.shape.members();
    let mut sums = LaneSums::default();
    let PairList { touching, memory, ended, .. } = list;
    BATCH.with_borrow_mut(|batch| {
        for (number, (pairs, memory)) in touching.chunks(LANES).zip(memory.chunks_mut(LANES)).enumerate() {
            for (lane, (pair, memory)) in pairs.iter().zip(&*memory).enumerate() {
                batch.gather(lane, context, *pair, memory);
            }
            for lane in pairs.len()..LANES {
                batch.clear(lane);
            }
            batch.evaluate(context, &mut sums);
            for (lane, ([index, surface], memory)) in pairs.iter().zip(memory).enumerate() {
                *memory = Memory::from_quad(batch.new.rows[lane]);
                let force = batch.force.rows[lane];
                let load = GrainLoad {
                    force: Quad([force.0[0], force.0[1], force.0[2], 0.0]),
                    torque: batch.torque.rows[lane],
                };
                loads[*index as usize / per_grain - range.start].join(&load);
                let surface = &surfaces[*surface as usize];
                let height = batch.height[lane];
                forces.record(surface.role, -force.vector(), force.fourth(), height, context.wall_levels);
                if batch.overlap[lane] <= 0.0 {
                    ended.push((number * LANES + lane) as u32);
                }
            }
        }
    });
    list.end_contacts();
    sums.total()
}

thread_local! {
    static BATCH: RefCell<SurfaceBatch> = RefCell::default();
}

/// Spheres on surfaces, side by side. A surface takes part as an equal sphere of infinite mass, so k = E r and the
/// restitution is the nominal one.
#[derive(Default)]
struct SurfaceBatch {
    /// From the sphere's centre to the nearest point of the surface (m); r (m).
    towards: Quads,
    /// Velocity of the grain's centre of mass (m/s); its 1/m (1/kg).
    motion: Quads,
    spin: Quads,
    /// From the grain's centre of mass to the nearest point (m); μ.
    arm: Quads,
    old: Quads,
    new: Quads,
    /// Force on the grain (N); the normal force (N).
    force: Quads,
    torque: Quads,
    overlap: Lane,
    /// Height of the nearest point over the surface's origin, along its first direction (m).
    height: Lane,
}

impl SurfaceBatch {
    /// Fills a lane with a unit sphere that does not touch.
    fn clear(&mut self, lane: usize) {
        self.towards.rows[lane] = Quad([3.0, 0.0, 0.0, 1.0]);
        self.motion.rows[lane] = Quad([0.0, 0.0, 0.0, 1.0]);
        self.old.rows[lane] = Quad::default();
    }

    #[inline(always)]
    fn gather(&mut self, lane: usize, context: &SurfaceContext, [index, surface]: [u32; 2], memory: &Memory) {
        let grains = context.grains;
        let row = index as usize / grains.shape.members();
        let surface = &context.surfaces[surface as usize];
        let (centre, radius) = grains.sphere(index as usize);
        let foot = surface.nearest(&centre);
        let friction = surface.friction.min(context.grain_friction);
        self.towards.rows[lane] = Quad::new(&(foot - centre), radius);
        self.motion.rows[lane] = grains.motion[row];
        self.spin.rows[lane] = grains.spin[row];
        self.arm.rows[lane] = Quad::new(&(foot - grains.place[row].vector()), friction);
        self.old.rows[lane] = memory.quad();
        self.height[lane] = surface.spans[0].direction.dot(&(foot - surface.origin));
    }

    /// With the widest vectors this processor has.
    fn evaluate(&mut self, context: &SurfaceContext, sums: &mut LaneSums) {
        #[cfg(target_arch = "x86_64")]
        {
            if std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512vl") {
                // SAFETY: the processor was just asked for these features.
                return unsafe { self.evaluate_avx512(context, sums) };
            }
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: as above.
                return unsafe { self.evaluate_avx2(context, sums) };
            }
        }
        self.evaluate_lanes(context, sums);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl")]
    fn evaluate_avx512(&mut self, context: &SurfaceContext, sums: &mut LaneSums) {
        self.evaluate_lanes(context, sums);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn evaluate_avx2(&mut self, context: &SurfaceContext, sums: &mut LaneSums) {
        self.evaluate_lanes(context, sums);
    }

    #[inline(always)]
    fn evaluate_lanes(&mut self, context: &SurfaceContext, sums: &mut LaneSums) {
        let Self { towards, motion, spin, arm, old, new, force, torque, .. } = self;
        [&mut *towards, &mut *motion, &mut *spin, &mut *arm, &mut *old].into_iter().for_each(Quads::turn_to_columns);
        for lane in 0..LANES {
            let way = towards.vector(lane);
            let (radius, inverse_mass) = (towards.fourth(lane), motion.fourth(lane));
            // A centre exactly on the surface has no normal; any will do, and the overlap limit will speak.
            let distance = dot(way, way).sqrt() + f64::MIN_POSITIVE;
            let normal = scaled(way, 1.0 / distance);
            let (turning, lever) = (spin.vector(lane), arm.vector(lane));
            let at_foot = add_scaled(motion.vector(lane), 1.0, cross(turning, lever));
            let point = ContactPoint {
                normal,
                overlap: radius - distance,
                velocity: scaled(at_foot, -1.0),
                twist: 0.5 * dot(turning, normal),
                spring: Spring::new(context.modulus * radius, inverse_mass),
                friction: arm.fourth(lane),
            };
            let response = respond(&point, &old.memory(lane), &context.law);
            force.put(lane, response.force, response.normal_force);
            torque.put(lane, cross(lever, response.force), 0.0);
            new.put(lane, response.memory.tangential, response.memory.dashpot);
            self.overlap[lane] = point.overlap;
            sums.count(lane, &response, point.overlap / radius);
        }
        [force, torque, new].into_iter().for_each(Quads::turn_to_rows);
    }
}

/// Member spheres and surfaces.
pub struct OnSurfaces<'a> {
    pub grains: &'a GrainTable,
    pub surfaces: &'a [Surface],
}

impl Separation for OnSurfaces<'_> {
    #[inline(always)]
    fn of(&self, [member, surface]: [u32; 2]) -> (f64, f64) {
        let (centre, radius) = self.grains.sphere(member as usize);
        (self.surfaces[surface as usize].distance_squared(&centre), radius)
    }
}
