//! How many parts of each kind a barrier has.

use crate::design::{BarrierDesign, Design};
use crate::quantities::quantity::Of;

/// Main ropes, posts and anchors of a net, segments of a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    pub ropes: usize,
    pub segments: usize,
    pub posts: usize,
    pub anchors: usize,
}

impl Counts {
    pub fn of(design: &Design) -> Self {
        match &design.barrier {
            BarrierDesign::FlexibleNet(net) => Self {
                ropes: net.main_ropes.levels.len(),
                segments: 0,
                posts: net.posts.as_ref().map_or(0, |posts| posts.at.len()),
                anchors: net.anchors().len(),
            },
            BarrierDesign::RigidWall(wall) => Self { segments: wall.segment_tops.len(), ..Self::default() },
        }
    }

    /// Values that a quantity has: at the least, and at the most.
    pub fn values(&self, of: Of) -> [usize; 2] {
        match of {
            Of::Run => [1; 2],
            Of::RunIfKnown => [0, 1],
            Of::EachRope => [self.ropes; 2],
            Of::EachSegment => [self.segments; 2],
            Of::EachPost => [self.posts; 2],
            Of::EachAnchor => [self.anchors; 2],
        }
    }
}
