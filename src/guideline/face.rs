//! How the face of a barrier stands: its lean and its height over the bed.

use crate::design::{BarrierDesign, Design};

/// Height of the barrier's top above the bed, normal to it (m).
pub fn height_over_bed(design: &Design) -> f64 {
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.height * libm::cos(wall.lean),
        BarrierDesign::FlexibleNet(net) => net.height * libm::cos(design.channel.slope + net.tilt) + net.bottom.gap(),
    }
}

/// Angle by which the barrier leans upstream from the bed's normal (rad).
pub fn lean(design: &Design) -> f64 {
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.lean,
        BarrierDesign::FlexibleNet(net) => design.channel.slope + net.tilt,
    }
}
