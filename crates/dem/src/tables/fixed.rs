//! What does not move, under one numbering: flat surfaces, and the facets of the ground.

use crate::Vec3;
use crate::tables::surfaces::{Surface, SurfaceRole};
use crate::tables::terrain::Terrain;

/// Number of the first facet; surfaces are numbered from 0 on.
const FIRST_FACET: u32 = 1 << 30;

/// All that stands still.
#[derive(Clone, Copy, Debug)]
pub struct Fixed<'a> {
    pub surfaces: &'a [Surface],
    pub terrain: Option<&'a Terrain>,
}

/// How a sphere touches what does not move.
#[derive(Clone, Copy, Debug)]
pub struct FixedTouch {
    /// From the centre to the nearest point (m).
    pub towards: Vec3,
    /// Part of the spring that acts; less than 1 where several facets share a push.
    pub share: f64,
    pub friction: f64,
    pub role: SurfaceRole,
    /// Along the edge that is touched, or nothing of a length for a corner; none on a face. Over these the normal turns.
    pub hinge: Option<Vec3>,
    /// Cosine of the angle between the push and the normal of a surface: less than 1 on an edge.
    pub square: f64,
    /// Height of the nearest point over a surface's origin, along its first direction (m).
    pub height: f64,
}

impl<'a> Fixed<'a> {
    /// The facet of a number, if it is one, and the ground that it belongs to.
    #[inline(always)]
    pub fn facet(&self, number: u32) -> Option<(&'a Terrain, u32)> {
        self.terrain.filter(|_| number >= FIRST_FACET).map(|terrain| (terrain, number - FIRST_FACET))
    }

    /// Visits the numbers of all that may be nearer than `reach` to a point (m).
    pub fn near(&self, point: &Vec3, reach: f64, mut visit: impl FnMut(u32)) {
        (0..self.surfaces.len() as u32).for_each(&mut visit);
        if let Some(terrain) = self.terrain {
            terrain.near(point, reach, |facet| visit(FIRST_FACET + facet));
        }
    }

    /// Square of the distance of a sphere's centre from one of them (m²), and the distance at which they touch (m). A facet that is near but
    /// not touched, because another one is, counts as just out of touch.
    #[inline(always)]
    pub fn separation(&self, number: u32, centre: &Vec3, radius: f64) -> (f64, f64) {
        match self.facet(number) {
            None => (self.surfaces[number as usize].distance_squared(centre), radius),
            Some((terrain, facet)) => (terrain.separation(facet, centre, radius), radius),
        }
    }

    /// How a sphere touches one of them. Where it does not, the nearest point is further off than its radius.
    #[inline(always)]
    pub fn touch(&self, number: u32, centre: &Vec3, radius: f64) -> FixedTouch {
        if let Some((terrain, facet)) = self.facet(number) {
            return touch_facet(terrain, facet, centre, radius);
        }
        let surface = &self.surfaces[number as usize];
        let foot = surface.nearest(centre);
        let towards = foot - centre;
        let facing = towards.try_normalize(0.0).unwrap_or(surface.normal);
        FixedTouch {
            towards,
            share: 1.0,
            friction: surface.friction,
            role: surface.role,
            hinge: surface.hinge(centre),
            // On an edge the push leans away from the surface's own normal.
            square: facing.dot(&surface.normal).abs(),
            height: surface.spans[0].direction.dot(&(foot - surface.origin)),
        }
    }
}

fn touch_facet(terrain: &Terrain, facet: u32, centre: &Vec3, radius: f64) -> FixedTouch {
    let touch = terrain.touch(facet, centre, radius);
    let facet = terrain.facet(facet);
    let (towards, share, hinge) = match touch {
        // Below the ground the push is out of it all the same.
        Some((place, share)) => (place.normal * -place.height.max(f64::MIN_POSITIVE), share, place.hinge),
        None => (facet.normal * (-2.0 * radius), 1.0, None),
    };
    FixedTouch { towards, share, friction: facet.friction, role: facet.role, hinge, square: 1.0, height: 0.0 }
}
