//! The ground as one body: plane facets that meet in seams.
//!
//! A sphere touches the ground where its distance from the centre is locally least: inside a facet, on a ridge between two facets, or on a
//! peak. In a hollow it may touch in several places at once. There each is pressed by its part of one push: with n the normals and δ the
//! overlaps, the parts a of the overlaps solve
//!
//! a ≥ 0,  Σ_j max(0, n_i · n_j) a_j ≥ δ_i,  with equality where a_i > 0,
//!
//! so that the push is k Σ a n. Two facets in one plane push as one, two that are at right angles or steeper as two springs, and in between
//! the force, which follows from the energy ½ k |Σ a n|², neither jumps nor doubles. Derived here.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::tables::surfaces::SurfaceRole;

/// No facet beyond a seam.
const NONE: u32 = u32::MAX;
/// Most corners of a facet.
const CORNERS: usize = 4;
/// Overlapping places of one sphere that are told apart at the most.
const MOST_PLACES: usize = 6;
/// Distance of the foot from all seams, over the radius, beyond which no other facet has a part in the push: at an angle of the normals of
/// less than 90°, the centre of a sphere that touches both is less than √2 radii from the seam.
const APART: f64 = 1.5;
/// Rounding in the height of a corner over a plane, over its distance.
const LEVEL: f64 = 1e-9;
/// Rounding in the parts of a push, over the largest overlap.
const ROUNDING: f64 = 1e-12;

/// A plane polygon of three or four corners, seen counterclockwise from above.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Facet {
    pub role: SurfaceRole,
    /// tan φ between grain and facet.
    pub friction: f64,
    /// Unit normal, out of the ground.
    pub normal: Vec3,
    corners: [u32; CORNERS],
    count: usize,
    /// Unit vectors in its plane out of it, across each edge, from its lower corner on.
    outwards: [Vec3; CORNERS],
    /// Where plane and edges lie along their normals (m).
    level: f64,
    edges: [f64; CORNERS],
    /// The facet beyond each edge.
    beyond: [u32; CORNERS],
    /// Whether the ground around it is nowhere below its plane: it has no ridge or peak on which a sphere beyond its edges could rest.
    open: bool,
}

impl Facet {
    /// Height of a point over the plane (m).
    #[inline(always)]
    fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(point) - self.level
    }

    /// How far a point is beyond an edge, in the plane (m).
    #[inline(always)]
    fn beyond_edge(&self, index: usize, point: &Vec3) -> f64 {
        self.outwards[index].dot(point) - self.edges[index]
    }

    /// How far a point is beyond the edge that it is furthest beyond; negative inside (m).
    #[inline(always)]
    fn beyond(&self, point: &Vec3) -> f64 {
        let [a, b, c] = [0, 1, 2].map(|index| self.beyond_edge(index, point));
        let most = a.max(b).max(c);
        if self.count > 3 { most.max(self.beyond_edge(3, point)) } else { most }
    }
}

/// A facet before it is joined to others: its corners counterclockwise from above.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    pub corners: Vec<u32>,
    pub role: SurfaceRole,
    /// tan φ between grain and facet.
    pub friction: f64,
}

/// The ground.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Terrain {
    corners: Vec<Vec3>,
    facets: Vec<Facet>,
    /// Facets that share a corner with each facet.
    around: Rows,
    /// Of them those that rise above its plane, or whose plane it rises above: only in a hollow a sphere touches two at once.
    rising: Rows,
    /// Corners at the other ends of the edges of each corner, and the lowest facet at it.
    edges: Rows,
    first_facet: Vec<u32>,
    places: Places,
}

/// Lists of numbers, one after the other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Rows {
    ends: Vec<u32>,
    items: Vec<u32>,
}

impl Rows {
    fn of(lists: impl Iterator<Item = Vec<u32>>) -> Self {
        let mut rows = Self::default();
        for list in lists {
            rows.items.extend(list);
            rows.ends.push(rows.items.len() as u32);
        }
        rows
    }

    fn row(&self, index: usize) -> &[u32] {
        let start = index.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.items[start as usize..self.ends[index] as usize]
    }
}

/// Where the ground is touched, if it were.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Point of the ground nearest to the centre (m).
    pub foot: Vec3,
    /// Unit normal at the foot, out of the ground.
    pub normal: Vec3,
    /// Distance of the centre from the foot along it, negative below the ground (m).
    pub height: f64,
    /// Along the ridge, or nothing of a length for a peak; none inside a facet. Over these the normal turns.
    pub hinge: Option<Vec3>,
}

impl Terrain {
    /// Joins facets over `corners` (m).
    pub fn new(corners: Vec<Vec3>, patches: &[Patch]) -> Self {
        let mut sides: BTreeMap<[u32; 2], [u32; 2]> = BTreeMap::new();
        let edge = |patch: &Patch, index: usize| {
            let (from, to) = (patch.corners[index], patch.corners[(index + 1) % patch.corners.len()]);
            ([from.min(to), from.max(to)], from > to)
        };
        for (number, patch) in patches.iter().enumerate() {
            for index in 0..patch.corners.len() {
                let (ends, turned) = edge(patch, index);
                sides.entry(ends).or_insert([NONE; 2])[usize::from(turned)] = number as u32;
            }
        }
        let facet = |(number, patch): (usize, &Patch)| {
            let count = patch.corners.len().min(CORNERS);
            let corner = |index: usize| corners[patch.corners[index % count] as usize];
            let normal = (corner(1) - corner(0)).cross(&(corner(2) - corner(0))).normalize();
            let mut facet = Facet {
                role: patch.role,
                friction: patch.friction,
                normal,
                corners: [0; CORNERS],
                count,
                outwards: [Vec3::zeros(); CORNERS],
                level: normal.dot(&corner(0)),
                edges: [0.0; CORNERS],
                beyond: [NONE; CORNERS],
                open: false,
            };
            for index in 0..count {
                let (ends, turned) = edge(patch, index);
                facet.corners[index] = patch.corners[index];
                let along = corners[ends[1] as usize] - corners[ends[0] as usize];
                let out = along.cross(&normal).normalize();
                // From its lower corner, so that a point is beyond the one or the other of two facets.
                let across = out.dot(&corners[ends[0] as usize]);
                (facet.outwards[index], facet.edges[index]) = if turned { (-out, -across) } else { (out, across) };
                facet.beyond[index] = sides[&ends].into_iter().find(|side| *side != number as u32).unwrap_or(NONE);
            }
            facet
        };
        let mut facets: Vec<Facet> = patches.iter().enumerate().map(facet).collect();
        let mut at_corner: Vec<Vec<u32>> = vec![Vec::new(); corners.len()];
        for (number, patch) in patches.iter().enumerate() {
            patch.corners.iter().for_each(|corner| at_corner[*corner as usize].push(number as u32));
        }
        let mut ends: Vec<Vec<u32>> = vec![Vec::new(); corners.len()];
        for [low, high] in sides.keys() {
            ends[*low as usize].push(*high);
            ends[*high as usize].push(*low);
        }
        let neighbours = |(number, patch): (usize, &Patch)| {
            let mut all: Vec<u32> =
                patch.corners.iter().flat_map(|corner| at_corner[*corner as usize].clone()).collect();
            all.sort_unstable();
            all.dedup();
            all.retain(|other| *other != number as u32);
            all
        };
        let around = Rows::of(patches.iter().enumerate().map(neighbours));
        // Whether the one has a corner above (1) or below (-1) the plane of the other.
        let off = |facets: &[Facet], plane: u32, other: u32, side: f64| {
            let (facet, patch) = (&facets[plane as usize], &patches[other as usize]);
            let base = corners[facet.corners[0] as usize];
            let rise = |corner: &u32| facet.normal.dot(&(corners[*corner as usize] - base));
            let size = patch.corners.iter().map(|corner| (corners[*corner as usize] - base).norm()).fold(0.0, f64::max);
            patch.corners.iter().any(|corner| side * rise(corner) > LEVEL * size)
        };
        let rising = |number: usize| {
            let one = number as u32;
            let list = around.row(number).iter().copied();
            list.filter(|other| off(&facets, one, *other, 1.0) || off(&facets, *other, one, 1.0)).collect::<Vec<u32>>()
        };
        let rising = Rows::of((0..facets.len()).map(rising));
        let open = |number: usize| {
            let facet = &facets[number];
            let joined = facet.beyond[..facet.count].iter().all(|beyond| *beyond != NONE);
            joined && !around.row(number).iter().any(|other| off(&facets, number as u32, *other, -1.0))
        };
        let open: Vec<bool> = (0..facets.len()).map(open).collect();
        facets.iter_mut().zip(open).for_each(|(facet, open)| facet.open = open);
        Self {
            around,
            rising,
            edges: Rows::of(ends.into_iter()),
            first_facet: at_corner.iter().map(|facets| facets.first().copied().unwrap_or(NONE)).collect(),
            places: Places::of(&corners, patches),
            corners,
            facets,
        }
    }

    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    pub fn facet(&self, number: u32) -> &Facet {
        &self.facets[number as usize]
    }

    /// Corners of a facet (m), counterclockwise from above.
    pub fn outline(&self, number: u32) -> impl Iterator<Item = Vec3> {
        let facet = self.facet(number);
        facet.corners[..facet.count].iter().map(|corner| self.corners[*corner as usize])
    }

    /// Where a sphere with this centre would touch the ground on a facet, its ridges and peaks included, each of which belongs to one facet
    /// alone.
    #[inline]
    pub fn place(&self, number: u32, centre: &Vec3) -> Option<Place> {
        self.place_and_margin(number, centre).0
    }

    /// The same, and how far the foot is from the nearest edge (m), where it is inside.
    #[inline]
    fn place_and_margin(&self, number: u32, centre: &Vec3) -> (Option<Place>, f64) {
        let facet = self.facet(number);
        let beyond = facet.beyond(centre);
        if beyond <= 0.0 {
            let height = facet.height(centre);
            let foot = centre - facet.normal * height;
            return (Some(Place { foot, normal: facet.normal, height, hinge: None }), -beyond);
        }
        (self.place_on_edge(number, centre), 0.0)
    }

    fn place_on_edge(&self, number: u32, centre: &Vec3) -> Option<Place> {
        let facet = self.facet(number);
        let mut nearest: Option<Place> = None;
        let mut take = |foot: Vec3, normal: &Vec3, hinge: Vec3| {
            let line = centre - foot;
            let height = line.norm();
            if nearest.is_none_or(|nearest| height < nearest.height) {
                let normal = line.try_normalize(0.0).unwrap_or(*normal);
                nearest = Some(Place { foot, normal, height, hinge: Some(hinge) });
            }
        };
        for index in 0..facet.count {
            let next = if index + 1 == facet.count { 0 } else { index + 1 };
            let (low, high) =
                (facet.corners[index].min(facet.corners[next]), facet.corners[index].max(facet.corners[next]));
            let (from, to) = (self.corners[low as usize], self.corners[high as usize]);
            let along = to - from;
            let way = along.dot(&(centre - from));
            let within = way > 0.0 && along.dot(&(centre - to)) < 0.0;
            let other = facet.beyond[index];
            if within && (other == NONE || number < other) && facet.beyond_edge(index, centre) > 0.0 {
                let outside_other = other == NONE || {
                    let other_facet = self.facet(other);
                    let same = (0..other_facet.count).find(|side| other_facet.beyond[*side] == number);
                    same.is_some_and(|side| other_facet.beyond_edge(side, centre) > 0.0)
                };
                if outside_other {
                    take(from + along * (way / along.norm_squared()), &facet.normal, along.normalize());
                }
            }
            let corner = facet.corners[index];
            if self.first_facet[corner as usize] == number && self.is_peak(corner, centre) {
                take(self.corners[corner as usize], &facet.normal, Vec3::zeros());
            }
        }
        nearest
    }

    /// Whether no way from a corner along its edges leads nearer to a point.
    fn is_peak(&self, corner: u32, point: &Vec3) -> bool {
        let here = self.corners[corner as usize];
        let line = point - here;
        self.edges.row(corner as usize).iter().all(|end| line.dot(&(self.corners[*end as usize] - here)) <= 0.0)
    }

    /// Where a sphere overlaps the ground on a facet, and the part of its spring there; nothing where it does not, or where the others
    /// push it out.
    #[inline]
    pub fn touch(&self, number: u32, centre: &Vec3, radius: f64) -> Option<(Place, f64)> {
        let (place, margin) = self.place_and_margin(number, centre);
        let place = place.filter(|place| place.height < radius)?;
        if margin > APART * radius {
            return Some((place, 1.0));
        }
        let share = self.share(number, centre, radius, &place, margin);
        (share > 0.0).then_some((place, share))
    }

    /// Part of its own overlap with which a place pushes.
    fn share(&self, number: u32, centre: &Vec3, radius: f64, own: &Place, margin: f64) -> f64 {
        let mut places = [(*own, radius - own.height, number); MOST_PLACES];
        let mut count = 1;
        // On a seam rounding may have the foot inside of two facets that are level.
        let others = if margin < LEVEL * radius { &self.around } else { &self.rising };
        for &other in others.row(number as usize) {
            if self.facet(other).height(centre) >= radius {
                continue;
            }
            let Some(place) = self.place(other, centre).filter(|place| place.height < radius) else { continue };
            if count < MOST_PLACES {
                places[count] = (place, radius - place.height, other);
                count += 1;
            }
        }
        if count == 1 {
            return 1.0;
        }
        let places = &mut places[..count];
        // In one order for all of them.
        places.sort_unstable_by_key(|(_, _, facet)| *facet);
        let mine = places.iter().position(|(_, _, facet)| *facet == number).unwrap_or(0);
        let mut normals = [Vec3::zeros(); MOST_PLACES];
        let mut overlaps = [0.0; MOST_PLACES];
        for (index, (place, overlap, _)) in places.iter().enumerate() {
            (normals[index], overlaps[index]) = (place.normal, *overlap);
        }
        parts(&normals[..count], &overlaps[..count])[mine] / overlaps[mine]
    }

    /// How near a sphere comes to touching a facet: the square of its radius and the way that it has to go at the least (m²). Just out of
    /// touch where the facet is near and not touched, because another one is.
    #[inline]
    pub fn separation(&self, number: u32, centre: &Vec3, radius: f64) -> f64 {
        let facet = self.facet(number);
        let (beyond, height) = (facet.beyond(centre).max(0.0), facet.height(centre));
        if facet.open && beyond > LEVEL * radius {
            // Its centre must come over the facet.
            let above = (height - radius).max(0.0);
            return (radius + (beyond * beyond + above * above).sqrt()).powi(2);
        }
        let square = height * height + beyond * beyond;
        let reach = radius * radius;
        let untouched = square < reach && beyond > 0.0 && self.place_on_edge(number, centre).is_none();
        if untouched { reach } else { square }
    }

    /// Whether a sphere may touch a facet: not where it is further from its plane, or beyond an edge, than its radius.
    #[inline]
    pub fn may_touch(&self, number: u32, centre: &Vec3, radius: f64) -> bool {
        let facet = self.facet(number);
        facet.height(centre) < radius && facet.beyond(centre) < radius
    }

    /// Whether two facets share a corner.
    pub fn meet(&self, number: u32, other: u32) -> bool {
        self.around.row(number as usize).binary_search(&other).is_ok()
    }

    /// Visits all facets whose outline, seen from above, may be nearer than `reach` to a point (m).
    pub fn near(&self, point: &Vec3, reach: f64, visit: impl FnMut(u32)) {
        self.places.near(point, reach, visit);
    }
}

/// Parts of the overlaps δ with which places of the given normals push.
fn parts(normals: &[Vec3], overlaps: &[f64]) -> [f64; MOST_PLACES] {
    let count = normals.len();
    let together = |i: usize, j: usize| if i == j { 1.0 } else { normals[i].dot(&normals[j]).max(0.0) };
    let tolerance = ROUNDING * overlaps.iter().copied().fold(0.0, f64::max);
    // Places that push are met by how their parts were solved.
    let holds = |parts: &[f64; MOST_PLACES]| {
        let met = |i: usize| (0..count).map(|j| together(i, j) * parts[j]).sum::<f64>() >= overlaps[i] - tolerance;
        (0..count).all(|i| parts[i] > 0.0 || met(i))
    };
    let mut all = [0.0; MOST_PLACES];
    for i in 0..count {
        let mut alone = [0.0; MOST_PLACES];
        alone[i] = overlaps[i];
        if holds(&alone) {
            return alone;
        }
    }
    for i in 0..count {
        for j in i + 1..count {
            let c = together(i, j);
            let left = 1.0 - c * c;
            if left <= ROUNDING {
                continue;
            }
            let mut two = [0.0; MOST_PLACES];
            (two[i], two[j]) = ((overlaps[i] - c * overlaps[j]) / left, (overlaps[j] - c * overlaps[i]) / left);
            if two[i] >= 0.0 && two[j] >= 0.0 && holds(&two) {
                return two;
            }
        }
    }
    for i in 0..count {
        for j in i + 1..count {
            for k in j + 1..count {
                let [a, b, c] = [together(i, j), together(i, k), together(j, k)];
                let matrix = nalgebra::Matrix3::new(1.0, a, b, a, 1.0, c, b, c, 1.0);
                let wanted = Vec3::new(overlaps[i], overlaps[j], overlaps[k]);
                let Some(solved) = matrix.cholesky().map(|root| root.solve(&wanted)) else { continue };
                let mut three = [0.0; MOST_PLACES];
                (three[i], three[j], three[k]) = (solved.x, solved.y, solved.z);
                if solved.min() >= 0.0 && holds(&three) {
                    return three;
                }
            }
        }
    }
    // More places than three directions: as springs side by side, which is on the stiff side.
    all[..count].copy_from_slice(overlaps);
    all
}

/// Which facets lie where, seen from above.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Places {
    low: [f64; 2],
    cell: [f64; 2],
    counts: [usize; 2],
    /// Facets over each cell.
    facets: Rows,
    /// First cell of each facet along x and y.
    first: Vec<[u32; 2]>,
    /// Highest corner of the facets over each cell (m).
    highest: Vec<f64>,
}

impl Places {
    fn of(corners: &[Vec3], patches: &[Patch]) -> Self {
        let bounds = |numbers: &mut dyn Iterator<Item = Vec3>| {
            numbers.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], corner| {
                [[low[0].min(corner.x), low[1].min(corner.y)], [high[0].max(corner.x), high[1].max(corner.y)]]
            })
        };
        let whole = bounds(&mut corners.iter().copied());
        let boxes: Vec<[[f64; 2]; 2]> = patches
            .iter()
            .map(|patch| bounds(&mut patch.corners.iter().map(|corner| corners[*corner as usize])))
            .collect();
        let mut places = Self { low: whole[0], ..Self::default() };
        for axis in 0..2 {
            let span = whole[1][axis] - whole[0][axis];
            let mean = boxes.iter().map(|[low, high]| high[axis] - low[axis]).sum::<f64>() / boxes.len().max(1) as f64;
            let count = if mean > 0.0 { (span / mean).ceil().clamp(1.0, 4096.0) } else { 1.0 };
            places.counts[axis] = count as usize;
            places.cell[axis] = if span > 0.0 { span / count } else { 1.0 };
        }
        let mut cells: Vec<Vec<u32>> = vec![Vec::new(); places.counts[0] * places.counts[1]];
        for (number, [low, high]) in boxes.iter().enumerate() {
            let [from, to] = [places.cell_of(*low), places.cell_of(*high)];
            places.first.push([from[0] as u32, from[1] as u32]);
            for x in from[0]..=to[0] {
                for y in from[1]..=to[1] {
                    cells[y * places.counts[0] + x].push(number as u32);
                }
            }
        }
        let top = |number: &u32| {
            let corners = patches[*number as usize].corners.iter().map(|corner| corners[*corner as usize].z);
            corners.fold(f64::NEG_INFINITY, f64::max)
        };
        places.highest = cells.iter().map(|facets| facets.iter().map(top).fold(f64::NEG_INFINITY, f64::max)).collect();
        places.facets = Rows::of(cells.into_iter());
        places
    }

    /// The cell over which a point lies; the nearest for points beside all.
    fn cell_of(&self, point: [f64; 2]) -> [usize; 2] {
        let along = |axis: usize| {
            let number = ((point[axis] - self.low[axis]) / self.cell[axis]).floor();
            (number.max(0.0) as usize).min(self.counts[axis].saturating_sub(1))
        };
        [along(0), along(1)]
    }

    fn near(&self, point: &Vec3, reach: f64, mut visit: impl FnMut(u32)) {
        if self.counts[0] * self.counts[1] == 0 {
            return;
        }
        let [from, to] =
            [self.cell_of([point.x - reach, point.y - reach]), self.cell_of([point.x + reach, point.y + reach])];
        for y in from[1]..=to[1] {
            for x in from[0]..=to[0] {
                // What is further above all facets here than it reaches, touches none of them.
                if point.z - reach > self.highest[y * self.counts[0] + x] {
                    continue;
                }
                for &facet in self.facets.row(y * self.counts[0] + x) {
                    let [first_x, first_y] = self.first[facet as usize];
                    // Of several cells that a facet lies over, the first that is visited tells it.
                    if x == from[0].max(first_x as usize) && y == from[1].max(first_y as usize) {
                        visit(facet);
                    }
                }
            }
        }
    }
}

/// Strips along the channel over a polyline across it: `points` (y, z) from the left to the right (m), for y rising or level, from x `from` to
/// `to`; for each strip its role and friction.
pub fn strips(points: &[[f64; 2]], [from, to]: [f64; 2], kinds: &[(SurfaceRole, f64)]) -> Terrain {
    let corners = points.iter().flat_map(|[y, z]| [Vec3::new(from, *y, *z), Vec3::new(to, *y, *z)]).collect();
    let patches: Vec<Patch> = kinds
        .iter()
        .enumerate()
        .map(|(strip, &(role, friction))| {
            let first = 2 * strip as u32;
            Patch { corners: vec![first, first + 1, first + 3, first + 2], role, friction }
        })
        .collect();
    Terrain::new(corners, &patches)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn groove(half_angle: f64) -> Terrain {
        let (sine, cosine) = libm::sincos(half_angle);
        let kinds = [(SurfaceRole::Side, 0.0); 2];
        strips(&[[-10.0 * sine, 10.0 * cosine], [0.0, 0.0], [10.0 * sine, 10.0 * cosine]], [-50.0, 50.0], &kinds)
    }

    /// All of the push on a sphere, over its stiffness (m).
    fn push(terrain: &Terrain, centre: Vec3, radius: f64) -> Vec3 {
        let one = |facet: usize| {
            let touch = terrain.touch(facet as u32, &centre, radius);
            touch.map_or(Vec3::zeros(), |(place, share)| place.normal * ((radius - place.height) * share))
        };
        (0..terrain.facets().len()).map(one).sum()
    }

    #[test]
    fn normals_point_out_of_the_ground() {
        let flat = strips(&[[0.0, 0.0], [2.0, 0.0]], [-1.0, 1.0], &[(SurfaceRole::Base, 0.5)]);
        assert_eq!(flat.facet(0).normal, Vec3::z());
    }

    /// Of one plane in two facets a sphere feels one plane, wherever it lies.
    #[test]
    fn a_flat_seam_is_not_felt() {
        let kinds = [(SurfaceRole::Base, 0.5); 3];
        let flat = strips(&[[-5.0, 0.0], [0.0, 0.0], [0.1, 0.0], [5.0, 0.0]], [-50.0, 50.0], &kinds);
        for step in -400..400 {
            let centre = Vec3::new(0.3, 0.001 * f64::from(step), 0.49);
            let push = push(&flat, centre, 0.5);
            assert_relative_eq!(push, Vec3::new(0.0, 0.0, 0.01), epsilon = 1e-15);
        }
    }

    /// With a half-angle b both sides press with N = W/(2 sin b): of the push upwards k δ each has a = δ/(2 sin b).
    #[test]
    fn a_groove_presses_from_both_sides() {
        for degrees in [10.0, 30.0, 45.0, 60.0, 85.0, 89.99_f64] {
            let half = degrees.to_radians();
            let terrain = groove(half);
            // Both sides are overlapped by 0.01.
            let centre = Vec3::new(0.0, 0.0, (0.5 - 0.01) / libm::sin(half));
            let touch = |facet: u32| terrain.touch(facet, &centre, 0.5).expect("a touch");
            let [left, right] = [touch(0), touch(1)];
            assert_relative_eq!(left.1, right.1, max_relative = 1e-6);
            // n · n' = −cos 2b: more than nothing from 45° on.
            let together = (-libm::cos(2.0 * half)).max(0.0);
            assert_relative_eq!(left.1, 1.0 / (1.0 + together), max_relative = 1e-6);
        }
    }

    /// The force is that of an energy: round a small circle through a hollow, over a ridge and beside a seam it does no work.
    #[test]
    fn the_push_does_no_work_round_a_circle() {
        let hollow = [[-5.0, 2.0], [0.0, 0.0], [5.0, 1.0]];
        let ridge = [[-5.0, -1.0], [0.0, 0.0], [5.0, -2.5]];
        for (points, middle) in [(hollow, Vec3::new(0.0, 0.05, 0.5)), (ridge, Vec3::new(0.0, 0.0, 0.46))] {
            let terrain = strips(&points, [-50.0, 50.0], &[(SurfaceRole::Base, 0.0); 2]);
            let steps = 40_000;
            let at = |step: i32| {
                let (sine, cosine) = libm::sincos(std::f64::consts::TAU * f64::from(step) / f64::from(steps));
                middle + Vec3::new(0.0, cosine, sine) * 0.03
            };
            let (mut work, mut way) = (0.0, 0.0);
            for step in 0..steps {
                let (from, to) = (at(step), at(step + 1));
                let force = push(&terrain, (from + to) * 0.5, 0.5);
                work += force.dot(&(to - from));
                way += force.norm() * (to - from).norm();
            }
            assert!(work.abs() < 1e-5 * way, "{work} of {way}");
        }
    }

    /// Over a seam of any bend the force changes by no more than the way says.
    #[test]
    fn the_push_does_not_jump() {
        for rise in [-3.0, -0.5, -0.01, 1e-9, 0.01, 0.5, 3.0, 50.0] {
            let kinds = [(SurfaceRole::Base, 0.0); 2];
            let terrain = strips(&[[-9.0, 0.0], [0.0, 0.0], [9.0, 9.0 * rise]], [-50.0, 50.0], &kinds);
            let at = |y: f64| push(&terrain, Vec3::new(0.0, y, 0.47), 0.5);
            let mut before = at(-0.6);
            for step in -6000..6000 {
                let now = at(1e-4 * f64::from(step));
                // No sphere of a credible run sinks in by a fifth of its radius.
                if now.norm() > 0.1 {
                    break;
                }
                assert!((now - before).norm() < 3.0e-4, "rise {rise} at {step}: {before} to {now}");
                before = now;
            }
        }
    }

    /// A pyramid of four triangles: over its peak the sphere touches once.
    #[test]
    fn a_peak_is_touched_once() {
        let corners = vec![
            Vec3::new(0.0, 0.0, 1.0),
            Vec3::new(1.0, 1.0, 0.0),
            Vec3::new(-1.0, 1.0, 0.0),
            Vec3::new(-1.0, -1.0, 0.0),
            Vec3::new(1.0, -1.0, 0.0),
        ];
        let side = |a: u32, b: u32| Patch { corners: vec![0, a, b], role: SurfaceRole::Base, friction: 0.0 };
        let terrain = Terrain::new(corners, &[side(1, 2), side(2, 3), side(3, 4), side(4, 1)]);
        for away in [Vec3::zeros(), Vec3::new(0.01, 0.02, 0.0), Vec3::new(-0.05, 0.0, 0.0)] {
            let centre = Vec3::new(0.0, 0.0, 1.45) + away;
            let touches = (0..4).filter_map(|facet| terrain.touch(facet, &centre, 0.5)).count();
            assert_eq!(touches, 1, "{away}");
            let line = centre - Vec3::new(0.0, 0.0, 1.0);
            assert_relative_eq!(push(&terrain, centre, 0.5), line.normalize() * (0.5 - line.norm()), epsilon = 1e-12);
        }
    }

    #[test]
    fn facets_are_found_from_where_they_are() {
        let terrain = groove(0.7);
        for (point, wanted) in [([0.0, -3.0], 0), ([0.0, -0.1], 1), ([0.0, 0.1], 0), ([40.0, 3.0], 1)] {
            let mut found = Vec::new();
            terrain.near(&Vec3::new(point[0], point[1], 0.0), 0.4, |facet| found.push(facet));
            assert!(found.iter().filter(|facet| **facet == wanted).count() == 1, "{point:?}: {found:?}");
        }
    }
}
