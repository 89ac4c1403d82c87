//! A ring on its rope: cylinder against cylinder.
//!
//! A ring is a square of cylinders round a rope of cylinders. Each side touches the rope at the point where it comes nearest to it,
//! with the one contact law (k of Albaba 2015, Eq. 4.16, and Coulomb friction). The rope counts as one body: of the cylinders
//! near the ring only the nearest is touched, and the friction spring goes along from one to the next. Force and torque
//! go to the end nodes of both by the shares at the point of contact, so that momentum and angular momentum are conserved.

use serde::{Deserialize, Serialize};

use std::ops::Range;

use crate::Vec3;
use crate::contact::law::{ContactPoint, LawConstants, Memory, Response, Spring, respond};
use crate::elements::cylinder::Cylinder;
use crate::geometry::segment_segment::{BetweenSegments, nearest_of_segments};
use crate::tables::nodes::{Frame, Node};

/// A side of a ring and the rope it runs on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RingSide {
    /// Number of the side's cylinder.
    pub side: u32,
    /// Cylinders of the rope.
    pub rope: Range<u32>,
    /// The one that is nearest now.
    pub near: u32,
    /// What the contact remembers.
    pub memory: Memory,
    /// Friction coefficient.
    pub friction: f64,
}

/// How a side of a ring touches its rope.
#[derive(Clone, Copy, Debug)]
pub struct RingTouch {
    pub point: ContactPoint,
    /// Number of the rope's cylinder.
    pub near: u32,
    /// Shares of the second nodes of side and rope.
    pub shares: [f64; 2],
    /// From the axes of side and rope to the point of contact (m).
    pub arms: [Vec3; 2],
}

/// What the contact does in one step.
#[derive(Clone, Copy, Debug)]
pub struct RingForce {
    pub touch: RingTouch,
    pub response: Response,
}

/// Nodes, frames and cylinders of a barrier, which a ring sees.
#[derive(Clone, Copy)]
pub struct RingContext<'a> {
    pub nodes: &'a [Node],
    pub frames: &'a [Frame],
    pub cylinders: &'a [Cylinder],
    /// Moduli of ring and rope in contact (Pa).
    pub moduli: [f64; 2],
}

impl RingSide {
    /// The contact at the present places; its overlap is negative where they do not touch.
    pub fn touch(&self, context: &RingContext) -> RingTouch {
        let side = &context.cylinders[self.side as usize];
        let (number, nearest) = self.nearest(context);
        let rope = &context.cylinders[number as usize];
        let towards = nearest.points[1] - nearest.points[0];
        let distance = towards.norm();
        let radii = [side.section.radius, rope.section.radius];
        // A ring at a piece that has broken has come off its rope.
        let off = side.strength.broken || rope.strength.broken;
        let overlap = if off { -distance } else { radii[0] + radii[1] - distance };
        let normal = if distance > 0.0 { towards / distance } else { Vec3::zeros() };
        let inside = 0.5 * overlap.max(0.0);
        let arms = [normal * (radii[0] - inside), normal * -(radii[1] - inside)];
        let bodies = [side, rope];
        let [mine, theirs] = [0, 1].map(|body| {
            let ([a, b], share) = (bodies[body].nodes.map(|node| &context.nodes[node as usize]), nearest.shares[body]);
            let frames = bodies[body].nodes.map(|node| &context.frames[node as usize]);
            let spin = frames[0].spin * (1.0 - share) + frames[1].spin * share;
            let velocity = a.velocity * (1.0 - share) + b.velocity * share + spin.cross(&arms[body]);
            let inverse = |node: &Node| if node.fixed { 0.0 } else { node.mass.recip() };
            (velocity, spin, (1.0 - share).powi(2) * inverse(a) + share.powi(2) * inverse(b))
        });
        let inverse_mass = mine.2 + theirs.2;
        let sides = [context.moduli[0] * radii[0], context.moduli[1] * radii[1]];
        let point = ContactPoint {
            normal: normal.into(),
            // A ring's rod is thin, and its steps are short.
            middle: normal.into(),
            overlap,
            velocity: (theirs.0 - mine.0).into(),
            twist: 0.5 * (mine.1 + theirs.1).dot(&normal),
            spring: Spring::between(sides, inverse_mass),
            friction: self.friction,
        };
        RingTouch { point, near: number, shares: nearest.shares, arms }
    }

    /// The rope's cylinder that is nearest to the side, and where. Only when the nearest point is an end of the one that was nearest
    /// last can a neighbour be nearer.
    /// From a piece that has broken it moves to no other.
    fn nearest(&self, context: &RingContext) -> (u32, BetweenSegments) {
        let places = |cylinder: u32| {
            context.cylinders[cylinder as usize].nodes.map(|node| &context.nodes[node as usize].position)
        };
        let side = places(self.side);
        let here = nearest_of_segments(side, places(self.near));
        let next = match here.shares[1] {
            _ if context.cylinders[self.near as usize].strength.broken => None,
            share if share <= 0.0 => self.near.checked_sub(1),
            share if share >= 1.0 => Some(self.near + 1),
            _ => None,
        };
        let gap = |found: &BetweenSegments| (found.points[1] - found.points[0]).norm_squared();
        match next.filter(|next| self.rope.contains(next)).map(|next| (next, nearest_of_segments(side, places(next)))) {
            Some((next, there)) if gap(&there) < gap(&here) => (next, there),
            _ => (self.near, here),
        }
    }

    /// The contact and its force.
    pub fn force(&self, context: &RingContext, law: &LawConstants) -> RingForce {
        let touch = self.touch(context);
        let response = respond(&touch.point, &self.memory, law);
        RingForce { touch, response }
    }
}
