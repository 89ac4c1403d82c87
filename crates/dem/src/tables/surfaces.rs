//! Fixed flat surfaces: channel base, side walls, gate, rigid barrier.

use serde::{Deserialize, Serialize};

use crate::Vec3;

/// A rectangle in space, possibly unbounded, that grains touch from either side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    pub role: SurfaceRole,
    /// A point of the surface, from which extents are measured (m).
    pub origin: Vec3,
    /// Unit normal, towards the grains.
    pub normal: Vec3,
    /// Unit vectors in the surface with their (lowest, highest) extents (m); infinite where unbounded.
    pub spans: [Span; 2],
    /// Friction coefficient between grain and surface, tan φ.
    pub friction: f64,
}

/// One in-plane direction of a surface and how far the surface reaches along it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Span {
    pub direction: Vec3,
    pub low: f64,
    pub high: f64,
}

/// What a surface is for; recorders sum forces by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SurfaceRole {
    Base,
    Side,
    Gate,
    Wall,
}

impl Span {
    pub fn unbounded(direction: Vec3) -> Self {
        Self { direction, low: f64::NEG_INFINITY, high: f64::INFINITY }
    }

    pub fn bounded(direction: Vec3, low: f64, high: f64) -> Self {
        Self { direction, low, high }
    }
}

impl Surface {
    /// A rectangle; the first of `spans` points up the surface.
    pub fn new(role: SurfaceRole, origin: Vec3, normal: Vec3, spans: [Span; 2], friction: f64) -> Self {
        Self { role, origin, normal, spans, friction }
    }

    /// An unbounded plane through `origin`.
    pub fn plane(role: SurfaceRole, origin: Vec3, normal: Vec3, friction: f64) -> Self {
        // Two directions that complete the normal to a frame.
        let helper = if normal.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
        let first = normal.cross(&helper).normalize();
        let spans = [Span::unbounded(first), Span::unbounded(normal.cross(&first))];
        Self::new(role, origin, normal, spans, friction)
    }

    /// The point of the surface nearest to `point`.
    #[inline(always)]
    pub fn nearest(&self, point: &Vec3) -> Vec3 {
        if self.unbounded() {
            return point - self.normal * self.height_above(point);
        }
        let from_origin = point - self.origin;
        let mut nearest = self.origin;
        for span in &self.spans {
            nearest += span.direction * span.direction.dot(&from_origin).clamp(span.low, span.high);
        }
        nearest
    }

    /// Along the edge that is nearest to `point`, or nothing of a length where that is a corner; none where it is a point within.
    #[inline(always)]
    pub fn hinge(&self, point: &Vec3) -> Option<Vec3> {
        if self.unbounded() {
            return None;
        }
        let from_origin = point - self.origin;
        let beyond = |span: &Span| {
            let along = span.direction.dot(&from_origin);
            along < span.low || along > span.high
        };
        match [beyond(&self.spans[0]), beyond(&self.spans[1])] {
            [false, false] => None,
            [true, false] => Some(self.spans[1].direction),
            [false, true] => Some(self.spans[0].direction),
            [true, true] => Some(Vec3::zeros()),
        }
    }

    /// Square of the distance of `point` from the surface (m²).
    #[inline(always)]
    pub fn distance_squared(&self, point: &Vec3) -> f64 {
        let height = self.height_above(point);
        if self.unbounded() { height * height } else { (self.nearest(point) - point).norm_squared() }
    }

    fn unbounded(&self) -> bool {
        self.spans.iter().all(|span| span.low == f64::NEG_INFINITY && span.high == f64::INFINITY)
    }

    /// Signed distance of `point` from the plane the surface lies in (m).
    #[inline(always)]
    pub fn height_above(&self, point: &Vec3) -> f64 {
        self.normal.dot(&(point - self.origin))
    }
}
