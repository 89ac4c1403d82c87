//! Contacts of grains with what does not move: surfaces and the ground.

use std::ops::Range;

use crate::Vec3;
use crate::contact::grain_touch::turning;
use crate::contact::lane_sums::LaneSums;
use crate::contact::law::{ContactPoint, LawConstants, Response, Spring, normal_before, respond};
use crate::contact::pair_list::{EightPairs, PairList, Separation};
use crate::ledger::ContactSums;
use crate::neighbours::clocks::Clock;
use crate::neighbours::memory_rows::MemoryRows;
use crate::simd::eight::{Eight, LANES, Row, each_lane, joined, parted};
use crate::simd::quad::Quad;
use crate::simd::real::{Triple, add_scaled, cross, dot, minus, negative, plus, scaled};
use crate::simd::widest::{Work, with_widest};
use crate::tables::fixed::Fixed;
use crate::tables::grain_rows::GrainRows;
use crate::tables::grain_table::GrainLoad;
use crate::tables::grains::GrainShape;
use crate::tables::surfaces::SurfaceRole;
use crate::tables::wall::WallShape;

/// What surface contacts read.
pub struct SurfaceContext<'a> {
    pub grains: GrainRows<'a>,
    pub fixed: Fixed<'a>,
    pub law: LawConstants,
    pub modulus: f64,
    pub grain_friction: f64,
    /// Of each grain; empty in a dry flow.
    pub grip: &'a [f64],
    /// Way that the block's grains and all nodes can have gone since the lists were made (m).
    pub clock: Clock,
    pub wall: &'a WallShape,
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
    /// Moment about its toe of the forces normal to the wall (N m).
    pub wall_moment: f64,
    /// Normal force on each wall segment (N).
    pub wall_segments: Vec<f64>,
    /// The normal forces, each over the width of the wall at its height, and their moment about the toe: what a metre takes that goes from
    /// the foot to the top (N/m, N m/m). Zeros for a wall that is equally wide all the way.
    pub wall_metre: [f64; 2],
}

impl SurfaceForces {
    pub fn reset(&mut self, segments: usize) {
        self.base = Vec3::zeros();
        self.sides = Vec3::zeros();
        self.wall = Vec3::zeros();
        self.wall_moment = 0.0;
        self.wall_segments.clear();
        self.wall_segments.resize(segments, 0.0);
        self.wall_metre = [0.0; 2];
    }

    pub fn add(&mut self, other: &Self) {
        self.base += other.base;
        self.sides += other.sides;
        self.wall += other.wall;
        self.wall_moment += other.wall_moment;
        for (mine, theirs) in self.wall_segments.iter_mut().zip(&other.wall_segments) {
            *mine += theirs;
        }
        self.wall_metre[0] += other.wall_metre[0];
        self.wall_metre[1] += other.wall_metre[1];
    }

    fn record(&mut self, role: SurfaceRole, force: Vec3, normal_force: f64, height: f64, wall: &WallShape) {
        match role {
            SurfaceRole::Base => self.base += force,
            SurfaceRole::Side | SurfaceRole::Gate => self.sides += force,
            SurfaceRole::Wall => {
                self.wall += force;
                self.wall_moment += normal_force * height;
                if let Some(sum) = self.wall_segments.get_mut(wall.segment(height)) {
                    *sum += normal_force;
                }
                if let Some(width) = wall.width(height) {
                    self.wall_metre[0] += normal_force / width;
                    self.wall_metre[1] += normal_force * height / width;
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
    with_widest(LoadSurfaces { list, context, start: range.start, loads, forces })
}

/// The surface contacts of one block, to be loaded.
struct LoadSurfaces<'a, 'b> {
    list: &'a mut PairList,
    context: &'a SurfaceContext<'b>,
    start: usize,
    loads: &'a mut [GrainLoad],
    forces: &'a mut SurfaceForces,
}

impl Work for LoadSurfaces<'_, '_> {
    type Output = ContactSums;

    #[inline(always)]
    fn run<E: Eight>(mut self) -> ContactSums {
        let context = self.context;
        let begun = self.list.touching.len();
        let on_fixed = OnFixed { grains: context.grains, fixed: context.fixed };
        self.list.sort_near(&context.clock, &on_fixed);
        on_fixed.hand_over(self.list, begun);
        let mut sums = LaneSums::<E>::default();
        let mut last = None;
        while let Some(eight) = self.list.eight_after(last) {
            let touch = SurfaceTouch::<E>::of(context, &eight);
            let response = respond(&touch.point, &self.list.memory_of(&eight), &context.law);
            sums.count(&response, touch.point.overlap / touch.radius);
            self.scatter(&eight, &touch, &response);
            self.list.remember(&eight, &response.memory, touch.point.overlap);
            last = Some(eight);
        }
        self.list.end_contacts();
        sums.total()
    }
}

impl LoadSurfaces<'_, '_> {
    #[inline(always)]
    fn scatter<E: Eight>(&mut self, eight: &EightPairs, touch: &SurfaceTouch<E>, response: &Response<E>) {
        let zero = E::all(0.0);
        let members = self.context.grains.shape.members();
        let forces = E::rows(joined(response.force, zero));
        let torques = E::rows(joined(cross(touch.lever, response.force), zero));
        let normal_forces = response.normal_force.lanes();
        for (lane, [member, _]) in eight.pairs[..eight.count].iter().enumerate() {
            let mut load = GrainLoad::default();
            forces[lane].store(&mut load.force);
            torques[lane].store(&mut load.torque);
            self.loads[*member as usize / members - self.start].join(&load);
            let square = normal_forces[lane] * touch.square[lane];
            let wall = self.context.wall;
            self.forces.record(touch.role[lane], -load.force.vector(), square, touch.height[lane], wall);
        }
    }
}

/// Spheres on surfaces, side by side. A surface takes part as an equal sphere of infinite mass, so k = E r and the
/// restitution is the nominal one.
struct SurfaceTouch<E> {
    point: ContactPoint<E>,
    /// m
    radius: E,
    /// From the grain's centre of mass to the nearest point (m).
    lever: Triple<E>,
    role: [SurfaceRole; LANES],
    /// As [`FixedTouch`](crate::tables::fixed::FixedTouch) has them.
    square: [f64; LANES],
    height: [f64; LANES],
}

impl<E: Eight> SurfaceTouch<E> {
    /// Lanes not in use do not touch.
    #[inline(always)]
    fn of(context: &SurfaceContext, eight: &EightPairs) -> Self {
        let grains = context.grains;
        let members = grains.shape.members();
        let (mut towards, mut lever, mut height) = ([Quad::default(); LANES], [Quad::default(); LANES], [0.0; LANES]);
        let (mut role, mut square, mut share) = ([SurfaceRole::Base; LANES], [0.0; LANES], [1.0; LANES]);
        let (mut hinge, mut hinged) = ([Quad::default(); LANES], false);
        for (lane, [member, number]) in eight.pairs.iter().enumerate() {
            let (centre, radius) = grains.sphere(*member as usize);
            let touch = context.fixed.touch(*number, &centre, radius);
            towards[lane] = Quad::new(&touch.towards, radius);
            let from_grain = touch.towards + centre - grains.place(*member as usize / members).vector();
            let friction = touch.friction.min(context.grain_friction);
            let grip = context.grip.get(*member as usize / members).copied().unwrap_or(1.0);
            lever[lane] = Quad::new(&from_grain, friction * grip);
            (role[lane], square[lane]) = (touch.role, touch.square);
            (share[lane], height[lane]) = (touch.share, touch.height);
            if let Some(axis) = touch.hinge {
                (hinge[lane], hinged) = (Quad::new(&axis, 1.0), true);
            }
        }
        let row = |lane: usize| eight.pairs[lane][0] as usize / members;
        let (towards, radius) = parted(E::columns(each_lane!(|lane| E::Row::load(&towards[lane]))));
        let (lever, friction) = parted(E::columns(each_lane!(|lane| E::Row::load(&lever[lane]))));
        let (motion, inverse_mass) = parted(E::columns(each_lane!(|lane| E::Row::load(&grains.motion(row(lane))))));
        let (spin, _) = parted(E::columns(each_lane!(|lane| E::Row::load(&grains.spin(row(lane))))));

        // A centre exactly on the surface has no normal; any will do, and the overlap limit will speak.
        let distance = dot(towards, towards).root() + f64::MIN_POSITIVE;
        let normal = scaled(towards, E::all(1.0) / distance);
        let numbers = E::from_lanes(each_lane!(|lane| lane as f64));
        let half_step = 0.5 * context.law.time_step;
        let of_centre = match grains.shape {
            GrainShape::Sphere => motion,
            GrainShape::Clump => plus(motion, turning(spin, minus(lever, towards), half_step)),
        };
        // Over an edge or a corner the normal turns as the centre passes.
        let middle = if hinged {
            let (axis, turns) = parted(E::columns(each_lane!(|lane| E::Row::load(&hinge[lane]))));
            let passing = add_scaled(of_centre, -dot(of_centre, axis), axis);
            normal_before(normal, negative(passing), turns * half_step / distance)
        } else {
            normal
        };
        let point = ContactPoint {
            normal,
            middle,
            overlap: E::all(eight.count as f64).if_above(numbers, radius - distance, -radius),
            velocity: negative(plus(of_centre, cross(spin, scaled(middle, distance)))),
            twist: dot(spin, normal) * 0.5,
            spring: match context.fixed.terrain {
                Some(_) => Spring::on_fixed(radius * context.modulus, inverse_mass).part(E::from_lanes(share)),
                None => Spring::on_fixed(radius * context.modulus, inverse_mass),
            },
            friction,
        };
        Self { point, radius, lever, role, square, height }
    }
}

/// Member spheres and what does not move.
pub struct OnFixed<'a> {
    pub grains: GrainRows<'a>,
    pub fixed: Fixed<'a>,
}

impl Separation for OnFixed<'_> {
    #[inline(always)]
    fn of(&self, [member, number]: [u32; 2]) -> (f64, f64) {
        let (centre, radius) = self.grains.sphere(member as usize);
        self.fixed.separation(number, &centre, radius)
    }
}

impl OnFixed<'_> {
    /// Hands the memory of contacts with facets that end in this step on to those that begin beside them, from the place `begun` of the
    /// list on: a sphere that rolls over a seam touches one ground all the time.
    fn hand_over(&self, list: &mut PairList, begun: usize) {
        if self.fixed.terrain.is_none() {
            return;
        }
        for new in begun..list.touching.len() {
            let [member, number] = list.touching[new];
            let before = list.touching[..begun].iter().zip(&list.memory);
            let ended =
                before.map(|(pair, memory)| (*pair, *memory)).enumerate().find(|(_, ([other, beside], memory))| {
                    *other == member && *memory != Quad::default() && self.follows(member, number, *beside)
                });
            if let Some((old, (_, memory))) = ended {
                list.memory[new] = memory;
                list.memory[old] = Quad::default();
            }
        }
    }

    /// Whether a contact of a member with a facet goes on from one with another facet, that it no longer touches.
    fn follows(&self, member: u32, number: u32, before: u32) -> bool {
        let Some(((terrain, facet), (_, other))) = self.fixed.facet(number).zip(self.fixed.facet(before)) else {
            return false;
        };
        let (centre, radius) = self.grains.sphere(member as usize);
        terrain.meet(facet, other) && terrain.touch(other, &centre, radius).is_none()
    }

    /// The same for lists that were just made anew: `memories` holds all contacts of before.
    pub fn hand_over_renewed(&self, list: &mut PairList, memories: &MemoryRows) {
        if self.fixed.terrain.is_none() {
            return;
        }
        for place in 0..list.touching.len() {
            let [member, number] = list.touching[place];
            if list.memory[place] == Quad::default()
                && let Some(memory) = memories.of_member(member).find_map(|(before, memory)| {
                    let ended = list.touching.binary_search(&[member, before]).is_err();
                    (ended && self.follows(member, number, before)).then_some(memory)
                })
            {
                list.memory[place] = memory.quad();
            }
        }
    }
}
