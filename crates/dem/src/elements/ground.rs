//! Where a barrier lies on the channel: its nodes against the bed and the sides, with friction.
//!
//! A rope between two nodes is straight, so a plane is met by its nodes first: each node is a sphere of its rope's radius against the
//! ground, which is planes (a level bed between two walls) or facets that meet in seams ([`crate::tables::terrain`]). The contact is the one law
//! of all contacts ([`crate::contact::law`]), with k from the moduli of ground and rope and the rope's radius. A node that starts closer to the
//! ground than its radius lies on it and meets it where it started.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::contact::law::{ContactPoint, LawConstants, Memory, Response, Spring, respond};
use crate::tables::nodes::Node;
use crate::tables::terrain::Terrain;

/// A plane that nodes lie on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plane {
    /// A point of it (m), and its unit normal towards the barrier.
    pub origin: Vec3,
    pub normal: Vec3,
    /// Height over the bed up to which there is a plane (m).
    pub top: f64,
    /// Friction coefficient between rope and plane, tan φ.
    pub friction: f64,
}

/// Bed and side walls.
pub const PLANES: usize = 3;

/// What a barrier can lie on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ground {
    shape: Shape,
    /// Moduli of ground and rope in contact (Pa).
    pub moduli: [f64; 2],
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Shape {
    Planes {
        planes: [Plane; PLANES],
        /// Distance of its centre at which each node meets each plane (m).
        reaches: Vec<[f64; PLANES]>,
    },
    Facets {
        terrain: Box<Terrain>,
        /// Distance of its centre at which each node meets the ground (m).
        reaches: Vec<f64>,
    },
}

/// A node that touches a plane or a facet, and what the contact remembers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Footing {
    pub node: u32,
    pub part: u32,
    pub memory: Memory,
}

/// How a node touches one part of the ground.
struct Touch {
    normal: Vec3,
    /// m
    overlap: f64,
    /// Part of the spring that acts.
    share: f64,
    friction: f64,
}

impl Plane {
    fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(&(point - self.origin))
    }
}

/// Rings have no thickness to lie on: they hang on what has.
fn is_thin(node: &Node) -> bool {
    node.radius <= 0.0
}

impl Ground {
    /// Planes for a barrier as it stands at first.
    pub fn under(nodes: &[Node], planes: [Plane; PLANES], moduli: [f64; 2]) -> Self {
        let reach = |node: &Node| match is_thin(node) {
            true => [f64::NEG_INFINITY; PLANES],
            false => planes.map(|plane| node.radius.min(plane.height(&node.position))),
        };
        Self { shape: Shape::Planes { planes, reaches: nodes.iter().map(reach).collect() }, moduli }
    }

    /// Facets for a barrier as it stands at first.
    pub fn over(nodes: &[Node], terrain: Terrain, moduli: [f64; 2]) -> Self {
        let reach = |node: &Node| {
            let mut reach = node.radius;
            terrain.near(&node.position, node.radius, |facet| {
                if let Some(place) = terrain.place(facet, &node.position) {
                    reach = reach.min(place.height);
                }
            });
            if is_thin(node) { f64::NEG_INFINITY } else { reach }
        };
        let reaches = nodes.iter().map(reach).collect();
        Self { shape: Shape::Facets { terrain: Box::new(terrain), reaches }, moduli }
    }

    /// All contacts of `nodes` now, and those that `before` has and now end, in the order of nodes and parts, each with its force on the
    /// node.
    pub fn touch(
        &self,
        nodes: &[Node],
        before: &[Footing],
        law: &LawConstants,
        mut take: impl FnMut(Footing, &Response),
    ) {
        let mut known = before;
        let mut parts = Vec::new();
        for (index, node) in nodes.iter().enumerate() {
            let here = known.iter().take_while(|footing| footing.node as usize == index).count();
            let (own, rest) = known.split_at(here);
            known = rest;
            if node.fixed || own.is_empty() && self.is_clear(index, node) {
                continue;
            }
            self.parts_near(index, node, own, &mut parts);
            for &part in &parts {
                let memory = own.iter().find(|footing| footing.part == part).map(|footing| footing.memory);
                let touch = self.touch_of(part, index, node);
                if touch.overlap <= 0.0 && memory.is_none() {
                    continue;
                }
                let memory = memory.or_else(|| self.handed_over(own, part, index, node)).unwrap_or_default();
                let response = respond(&self.contact(node, &touch), &memory, law);
                take(Footing { node: index as u32, part, memory: response.memory }, &response);
            }
        }
    }

    /// Whether a node surely touches no part of the ground; as most do in most steps, it is asked first.
    #[inline]
    fn is_clear(&self, index: usize, node: &Node) -> bool {
        let Shape::Planes { planes, reaches } = &self.shape else { return false };
        let reaches = &reaches[index];
        // Asked together, so that no branch is in the way; what is not a number is not clear.
        let clear = std::array::from_fn::<bool, PLANES, _>(|part| {
            let plane = &planes[part];
            (node.position.z > plane.top) | (reaches[part] - plane.height(&node.position) <= 0.0)
        });
        clear.into_iter().fold(true, |all, one| all & one)
    }

    /// The planes or facets that a node may touch or has touched, rising.
    fn parts_near(&self, index: usize, node: &Node, before: &[Footing], parts: &mut Vec<u32>) {
        parts.clear();
        match &self.shape {
            Shape::Planes { .. } => parts.extend(0..PLANES as u32),
            Shape::Facets { terrain, reaches } => {
                if reaches[index] > f64::NEG_INFINITY {
                    terrain.near(&node.position, node.radius, |facet| {
                        if terrain.may_touch(facet, &node.position, node.radius) {
                            parts.push(facet);
                        }
                    });
                }
                parts.extend(before.iter().map(|footing| footing.part));
                parts.sort_unstable();
                parts.dedup();
            }
        }
    }

    fn touch_of(&self, part: u32, index: usize, node: &Node) -> Touch {
        match &self.shape {
            Shape::Planes { planes, reaches } => {
                let plane = &planes[part as usize];
                let overlap = reaches[index][part as usize] - plane.height(&node.position);
                let overlap = if node.position.z <= plane.top { overlap } else { 0.0 };
                Touch { normal: plane.normal, overlap, share: 1.0, friction: plane.friction }
            }
            Shape::Facets { terrain, reaches } => {
                let facet = terrain.facet(part);
                match terrain.touch(part, &node.position, reaches[index]) {
                    Some((place, share)) => Touch {
                        normal: place.normal,
                        overlap: reaches[index] - place.height,
                        share,
                        friction: facet.friction,
                    },
                    None => Touch { normal: facet.normal, overlap: 0.0, share: 1.0, friction: facet.friction },
                }
            }
        }
    }

    /// What a node remembers of a facet that it has just left for this one.
    fn handed_over(&self, before: &[Footing], part: u32, index: usize, node: &Node) -> Option<Memory> {
        let Shape::Facets { terrain, .. } = &self.shape else { return None };
        let left = |footing: &&Footing| {
            terrain.meet(footing.part, part) && self.touch_of(footing.part, index, node).overlap <= 0.0
        };
        before.iter().find(left).map(|footing| footing.memory)
    }

    /// Spring of a node on the ground.
    pub fn spring(&self, node: &Node) -> Spring {
        Spring::between(self.moduli.map(|modulus| modulus * node.radius), 1.0 / node.mass)
    }

    fn contact(&self, node: &Node, touch: &Touch) -> ContactPoint {
        let spring = self.spring(node);
        ContactPoint {
            normal: (-touch.normal).into(),
            // Nodes do not roll.
            middle: (-touch.normal).into(),
            overlap: touch.overlap,
            velocity: (-node.velocity).into(),
            twist: 0.0,
            spring: if touch.share < 1.0 { spring.part(touch.share) } else { spring },
            friction: touch.friction,
        }
    }

    /// Normal of the ground where a footing is.
    pub fn normal(&self, footing: &Footing, nodes: &[Node]) -> Vec3 {
        self.touch_of(footing.part, footing.node as usize, &nodes[footing.node as usize]).normal
    }

    /// Whether a footing still touches, rather than having ended in this very step.
    pub fn holds(&self, footing: &Footing, nodes: &[Node]) -> bool {
        self.touch_of(footing.part, footing.node as usize, &nodes[footing.node as usize]).overlap > 0.0
    }
}
