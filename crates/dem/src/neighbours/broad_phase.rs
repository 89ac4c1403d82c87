//! Broad phase: which boxes overlap. The only file that names rapier (through its bounding-volume tree).

use std::cell::RefCell;

use rapier3d::math::Vector;
use rapier3d::parry::bounding_volume::Aabb;
use rapier3d::parry::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};

use crate::Vec3;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box3 {
    pub low: Vec3,
    pub high: Vec3,
}

impl Box3 {
    pub fn around(centre: &Vec3, half: f64) -> Self {
        let half = Vec3::repeat(half);
        Self { low: centre - half, high: centre + half }
    }

    pub fn joining(a: &Self, b: &Self) -> Self {
        Self { low: a.low.inf(&b.low), high: a.high.sup(&b.high) }
    }

    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    pub fn is_finite(&self) -> bool {
        self.low.iter().chain(self.high.iter()).all(|value| value.is_finite())
    }

    fn to_aabb(self) -> Aabb {
        let vector = |v: Vec3| Vector::new(v.x, v.y, v.z);
        Aabb::new(vector(self.low), vector(self.high))
    }
}

thread_local! {
    // As large as a tree itself, so the trees that one thread works on share it.
    static WORKSPACE: RefCell<BvhWorkspace> = RefCell::default();
}

/// A tree over boxes numbered from 0.
#[derive(Default)]
pub struct BoxTree {
    tree: Bvh,
    count: usize,
}

impl BoxTree {
    /// Builds the tree. Every box must be finite: a single NaN would silently hide other boxes' pairs.
    pub fn new(boxes: &[Box3]) -> Self {
        debug_assert!(boxes.iter().all(Box3::is_finite));
        let leaves: Vec<Aabb> = boxes.iter().map(|b| b.to_aabb()).collect();
        Self { tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves), count: boxes.len() }
    }

    /// Takes in the boxes: into the tree as it stands if there are as many as before, which is cheaper and good while
    /// neighbours stay neighbours; into a new one otherwise.
    pub fn fit(&mut self, boxes: &[Box3]) {
        if self.count != boxes.len() {
            *self = Self::new(boxes);
            return;
        }
        for (index, b) in boxes.iter().enumerate() {
            self.tree.insert_or_update_partially(b.to_aabb(), index as u32, 0.0);
        }
        WORKSPACE.with_borrow_mut(|workspace| self.tree.refit(workspace));
    }

    /// Calls `visit` once for every pair of overlapping boxes of this tree.
    pub fn pairs(&mut self, mut visit: impl FnMut(u32, u32)) {
        WORKSPACE.with_borrow_mut(|workspace| self.tree.traverse_bvtt_single_tree::<false>(workspace, &mut visit));
    }

    /// Calls `visit` once for every pair of a box of this tree and a box of the other that overlap.
    pub fn pairs_with(&self, other: &Self, mut visit: impl FnMut(u32, u32)) {
        for (mine, theirs) in self.tree.leaf_pairs(&other.tree, |a, b| a.intersects(b)) {
            visit(mine, theirs);
        }
    }
}
