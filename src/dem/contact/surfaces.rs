//! Contacts of grains with fixed surfaces.

use std::ops::Range;

use crate::dem::Vec3;
use crate::dem::contact::candidates::CandidateList;
use crate::dem::contact::law::{ContactPoint, LawConstants, respond};
use crate::dem::ledger::ContactSums;
use crate::dem::tables::grains::{Member, MemberLoad};
use crate::dem::tables::surfaces::{Surface, SurfaceRole};

/// What surface contacts read.
pub struct SurfaceContext<'a> {
    pub members: &'a [Member],
    pub surfaces: &'a [Surface],
    pub law: LawConstants,
    pub modulus: f64,
    pub grain_friction: f64,
    pub step: u32,
    /// Heights that part the rigid wall into segments, from the bottom up (m); the last is its top.
    pub wall_levels: &'a [f64],
}

/// Forces the grains of one block put on the surfaces in one step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceForces {
    /// Force on the base (N).
    pub base: Vec3,
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
        self.wall = Vec3::zeros();
        self.wall_moment = 0.0;
        self.wall_segments.clear();
        self.wall_segments.resize(segments, 0.0);
    }

    pub fn add(&mut self, other: &Self) {
        self.base += other.base;
        self.wall += other.wall;
        self.wall_moment += other.wall_moment;
        for (mine, theirs) in self.wall_segments.iter_mut().zip(&other.wall_segments) {
            *mine += theirs;
        }
    }

    fn record(&mut self, role: SurfaceRole, force: Vec3, normal_force: f64, height: f64, levels: &[f64]) {
        match role {
            SurfaceRole::Base => self.base += force,
            SurfaceRole::Side | SurfaceRole::Gate => {}
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

/// Loads the members of a block that touch surfaces; returns energies, adds to `forces`.
pub fn load_surfaces(
    list: &mut CandidateList,
    context: &SurfaceContext,
    range: &Range<usize>,
    loads: &mut [MemberLoad],
    forces: &mut SurfaceForces,
) -> ContactSums {
    let mut sums = ContactSums::default();
    for slot in 0..list.pairs.len() {
        let [member_index, surface_index] = list.pairs[slot];
        let member = &context.members[member_index as usize];
        let surface = &context.surfaces[surface_index as usize];
        let Some((point, foot)) = touch(member, surface, context) else {
            continue;
        };
        let response = respond(&point, &list.memory_at(slot, context.step), &context.law);
        list.remember_at(slot, context.step, response.memory);
        let force = Vec3::from(response.force);
        loads[member_index as usize - range.start].add(&force, &(foot - member.centre()));
        let height = (foot - surface.origin).dot(&surface.spans[0].direction);
        forces.record(surface.role, -force, response.normal_force, height, context.wall_levels);
        sums.count(&response, point.overlap / member.radius());
    }
    sums
}

/// Geometry of sphere against rectangle: the contact is the nearest point of the rectangle. The surface
/// takes part as an equal sphere of infinite mass, so k = E r and the restitution is the nominal one.
#[inline]
fn touch(member: &Member, surface: &Surface, context: &SurfaceContext) -> Option<(ContactPoint, Vec3)> {
    let centre = member.centre();
    let radius = member.radius();
    if surface.height_above(&centre).abs() >= radius {
        return None;
    }
    let foot = surface.nearest(&centre);
    let towards = foot - centre;
    let distance = towards.norm();
    if distance >= radius {
        return None;
    }
    let normal = if distance > 0.0 { towards / distance } else { -surface.normal };
    let velocity = -(member.velocity() + member.spin().cross(&towards));
    let point = ContactPoint {
        normal: normal.into(),
        overlap: radius - distance,
        velocity: velocity.into(),
        twist: 0.5 * member.spin().dot(&normal),
        stiffness: context.modulus * radius,
        inverse_mass: member.motion[3],
        friction: surface.friction.min(context.grain_friction),
    };
    Some((point, foot))
}
